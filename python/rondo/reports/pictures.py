# SPDX-License-Identifier: BSD-3-Clause
"""Figures of matplotlib in a page: PNG in the text itself, on white in light and dark."""
from __future__ import annotations

import base64

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from .. import style
from .encoding import escaped

DPI = 160


def picture(figure: Figure, words: str, is_wide: bool = True) -> str:
    """A figure with what it shows in words, which it is closed by."""
    data = style.png_of(figure, DPI)
    width, height = figure.get_size_inches()
    plt.close(figure)
    return drawn_picture(data, (float(width), float(height)), words, is_wide)


def drawn_picture(png: bytes, size_in: tuple[float, float], words: str, is_wide: bool = True) -> str:
    """The same of a figure that is a PNG already. size_in: its width and height [in]."""
    data, (width, height) = base64.b64encode(png).decode(), size_in
    size = f'width="{round(100 * width)}" height="{round(100 * height)}"'
    kind = "picture" if is_wide else "picture narrow"
    return (f'<figure class="{kind}"><img alt="{escaped(words)}" {size} '
            f'src="data:image/png;base64,{data}"><figcaption>{escaped(words)}</figcaption></figure>')

# SPDX-License-Identifier: BSD-3-Clause
"""How all figures look: widths, colours, line styles, and how they are written to files.

Colours are those of Okabe and Ito, told apart by colour-blind readers; each curve has a line style
and a grey level of its own besides, so that a print in grey is read as well.
"""
import contextlib
import io
import pathlib
from collections.abc import Iterator
from typing import Any

import matplotlib
from matplotlib.colors import Colormap, LinearSegmentedColormap
from matplotlib.figure import Figure
from PIL import Image

COLUMN = 3.35  # width of one column (in)
PAGE = 7.0  # width of two columns (in)
DPI = 200  # of PNG files and of what is rasterised inside SVG files

BLACK = "#000000"
BLUE = "#0072b2"
VERMILLION = "#d55e00"
SKY = "#56b4e9"
ORANGE = "#e69f00"
PURPLE = "#cc79a7"
GREEN = "#009e73"

GROUND = "0.72"  # the ground, in grey
RIM = "0.88"  # what the rim fills, lighter than the ground
OUTLINE = "0.15"  # the edge of a body
MESH = "0.35"  # sides of cells
CONTACT = BLUE  # nodes in contact, in all figures

# One after another for the curves of a panel: colour, line style, grey level all differ.
CURVES: tuple[dict[str, Any], ...] = (
    {"color": BLUE, "linestyle": "-"},
    {"color": VERMILLION, "linestyle": "--"},
    {"color": BLACK, "linestyle": ":"},
    {"color": ORANGE, "linestyle": "-."},
    {"color": GREEN, "linestyle": (0, (5, 1, 1, 1, 1, 1))},
    {"color": PURPLE, "linestyle": (0, (3, 1))},
)

# Magnitudes: light where nothing happens, darker with every step upwards, so also in grey.
SEQUENTIAL: Colormap = matplotlib.colormaps["magma_r"]

# Signed quantities: grey at zero, darker and bluer below, lighter and yellower above. A print in
# grey then tells the signs apart, and so do colour-blind readers: blue and yellow differ to most
# of them. In steps, an odd number, so that zero has one of its own.
DIVERGING: Colormap = LinearSegmentedColormap.from_list(
    "rondo_diverging",
    ["#04164f", "#0b4a9b", "#8a8a8a", "#d9b83f", "#fff7b8"], N=33)

RC: dict[str, object] = {
    "font.size": 8.0,
    "axes.titlesize": 8.0,
    "axes.labelsize": 8.0,
    "xtick.labelsize": 7.0,
    "ytick.labelsize": 7.0,
    "legend.fontsize": 7.0,
    "legend.frameon": False,
    "legend.handlelength": 2.4,
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "lines.linewidth": 1.0,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.minor.width": 0.4,
    "ytick.minor.width": 0.4,
    "xtick.major.size": 2.5,
    "ytick.major.size": 2.5,
    "xtick.minor.size": 1.5,
    "ytick.minor.size": 1.5,
    "figure.constrained_layout.use": True,
    "figure.dpi": DPI,
    "savefig.dpi": DPI,
    "savefig.facecolor": "white",
    "svg.fonttype": "none",
    "svg.hashsalt": "rondo",
}


@contextlib.contextmanager
def paper() -> Iterator[None]:
    """Within this context (or as a decorator) figures look as in a journal: 8 pt type, thin axes,
    constrained layout."""
    with matplotlib.rc_context(RC):
        yield


def png_of(figure: Figure, dpi: int = DPI) -> bytes:
    """A PNG with a palette of 256 colours, see save()."""
    drawn, written = io.BytesIO(), io.BytesIO()
    with paper():
        figure.savefig(drawn, format="png", dpi=dpi)
    with Image.open(drawn) as image:
        # Of Pillow's palettes this one follows rare colours too; the others lose colour bars.
        # Without k-means greys take a hue and gradients show steps.
        few = image.convert("RGB").quantize(256, Image.Quantize.MAXCOVERAGE, kmeans=1,
                                            dither=Image.Dither.NONE)
        few.save(written, "PNG", optimize=True, dpi=(dpi, dpi))
    return written.getvalue()


def save(figure: Figure, path: str | pathlib.Path) -> list[pathlib.Path]:
    """Writes `path`.png and `path`.svg and returns both; the same figure gives the same bits.

    The files have the width of the figure: nothing is cut off or added. Text in the SVG is text.
    The PNG has a palette of 256 colours, which makes it a third as large and changes none by more
    than is to be seen.
    """
    path = pathlib.Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    png, svg = (path.with_name(path.name + ending) for ending in (".png", ".svg"))
    png.write_bytes(png_of(figure))
    with paper():
        layout = figure.get_layout_engine()
        figure.set_layout_engine("none")  # done for the PNG; it takes the larger part of the time
        figure.savefig(svg, dpi=DPI, metadata={"Date": None, "Creator": None})
        figure.set_layout_engine(layout)
    return [png, svg]

# SPDX-License-Identifier: BSD-3-Clause
"""The figures of `rondo modes`: shapes at the first spin, and frequencies over the spin."""
from __future__ import annotations

import os
import pathlib
from typing import TYPE_CHECKING

import matplotlib.pyplot as plt

from .. import style
from ..data.names import FRAME

if TYPE_CHECKING:
    from ..data.modes import Modes


def draw_modes(modes: Modes, folder: str | os.PathLike[str]) -> list[pathlib.Path]:
    """Writes what there is data for, each as PNG and SVG; returns the files."""
    figures = {}
    if modes.has_shapes or not modes.has_branches:
        figures["shapes"] = modes.plot_shapes()
    if modes.has_branches and len(modes.spins) > 1:
        figures[f"campbell-{FRAME}"] = modes.plot_campbell(FRAME)
    written = []
    for name, figure in figures.items():
        written += style.save(figure, pathlib.Path(folder) / name)
        plt.close(figure)
    return written

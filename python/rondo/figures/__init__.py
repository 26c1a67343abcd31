# SPDX-License-Identifier: BSD-3-Clause
"""The figures of the paper study (`rondo paper`), as those of the paper, and more."""
from __future__ import annotations

import os
import pathlib
from typing import TYPE_CHECKING

import matplotlib.pyplot as plt

from .. import style

if TYPE_CHECKING:
    from ..data.paper import Paper


def draw_paper(paper: Paper, folder: str | os.PathLike[str]) -> list[pathlib.Path]:
    """Draws figures 2 to 6 of a study into `folder`, each as .png and .svg; returns the files."""
    from . import figure_2, figure_3, figure_4, figure_5, figure_6

    written = []
    for module in (figure_2, figure_3, figure_4, figure_5, figure_6):
        for name, figure in module.draw(paper).items():
            written += style.save(figure, pathlib.Path(folder) / name)
            plt.close(figure)
    return written

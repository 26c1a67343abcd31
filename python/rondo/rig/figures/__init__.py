# SPDX-License-Identifier: BSD-3-Clause
"""The figures of a rig, of all tests that have points (docs/rig.md)."""
from __future__ import annotations

import os
import pathlib
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import matplotlib.pyplot as plt

from ... import style
from ...data.tir import Tir, read_tir

if TYPE_CHECKING:
    from ...data.rig import Rig
    from ..against import Comparison
    from .drawing import Drawn

TIR = "tyre.tir"


@dataclass(frozen=True)
class Picture:
    """A figure that is drawn. size_in: width and height [in]; files: where it was written."""

    test: str
    words: str
    png: bytes
    size_in: tuple[float, float]
    files: tuple[pathlib.Path, ...] = ()


def draw(rig: Rig, folder: str | os.PathLike[str], against: Comparison | None = None) -> list[pathlib.Path]:
    """Writes all figures of a rig into `folder`, each as PNG and SVG; returns their files. Where the rig has its
    tyre.tir, the fitted curves are beside the points; measurements are where a comparison is given."""
    return [file for one in pictures_of(rig, against, folder) for file in one.files]


def pictures_of(rig: Rig, against: Comparison | None = None, folder: str | os.PathLike[str] | None = None) -> list[Picture]:
    """The same figures for the report, each drawn once; they are written where a folder is given."""
    drawn = []
    for one in figures_of(rig, against):
        width, height = one.figure.get_size_inches()
        files = () if folder is None else tuple(style.save(one.figure, pathlib.Path(folder) / one.name))
        png = files[0].read_bytes() if files else style.png_of(one.figure)
        drawn.append(Picture(one.test, one.words, png, (float(width), float(height)), files))
        plt.close(one.figure)
    return drawn


def figures_of(rig: Rig, against: Comparison | None = None) -> Iterator[Drawn]:
    """One after another, in the order of the tests; the caller closes them."""
    from . import combined, courses, footprint, modes, relaxation, rolling, slip, stiffness
    from .drawing import Given

    given = Given(rig, tir_of(rig), against)
    for module in (stiffness, footprint, slip, combined, rolling, relaxation, courses, modes):
        with style.paper():
            yield from module.draw(given)


def tir_of(rig: Rig) -> Tir | None:
    """The fitted parameters beside the results."""
    file = rig.directory / TIR
    return read_tir(file) if file.is_file() else None

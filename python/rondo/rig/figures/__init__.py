# SPDX-License-Identifier: BSD-3-Clause
"""The figures of a rig, of all tests that have points (docs/rig.md)."""
from __future__ import annotations

import os
import pathlib
from collections.abc import Iterator
from typing import TYPE_CHECKING

import matplotlib.pyplot as plt

from ... import style
from ...data.tir import Tir, read_tir

if TYPE_CHECKING:
    from ...data.rig import Rig
    from ..against import Comparison
    from .drawing import Drawn

TIR = "tyre.tir"


def draw(rig: Rig, folder: str | os.PathLike[str], against: Comparison | None = None) -> list[pathlib.Path]:
    """Writes all figures of a rig into `folder`, each as PNG and SVG; returns their files. Where the rig has its
    tyre.tir, the fitted curves are beside the points; measurements are where a comparison is given."""
    written: list[pathlib.Path] = []
    for one in figures_of(rig, against):
        written += style.save(one.figure, pathlib.Path(folder) / one.name)
        plt.close(one.figure)
    return written


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

# SPDX-License-Identifier: BSD-3-Clause
"""The figures of a wheel in three dimensions: those of a run, and of a sweep as of a tyre."""
from __future__ import annotations

import os
import pathlib
from collections.abc import Sequence
from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from .. import style
from ..data.errors import Error
from ..data.tyre import name_of, numbers_of, others_of, pairs, table_of, with_values
from ..plots.solid.tyre import MAKES_SLIP, plot_friction_ellipse, plot_tyre_curves, slip_by

if TYPE_CHECKING:
    from ..data.sweep import Sweep


def draw_tyre(sweep: Sweep, folder: str | os.PathLike[str], more: Sequence[Sweep] = (),
              axes: str | None = None) -> list[pathlib.Path]:
    """Writes `tyre-KEY`, curves over the slip angle for each value of that parameter with the rest
    at its middle values (`tyre` where none varies), with the members of `more` sweeps beside them;
    where spin or speed varies, `friction-ellipse` at all its values, curves at its middle one; and of two sweeps `tyre.txt`, a table of the
    members that both have. axes: of the curves, by default rondo's own; their names then end in it. Figures as PNG and SVG; returns their files. An error where the slip
    angle does not vary."""
    into = pathlib.Path(folder)
    written: list[pathlib.Path] = []

    def keep(name: str, figure: Figure) -> None:
        written.extend(style.save(figure, into / name))
        plt.close(figure)

    sweeps = [sweep, *more]
    others = others_of(sweep)
    keys: list[str | None] = [*(key for key in others if key not in MAKES_SLIP)]
    for key in keys or [None]:
        middle = {rest: middle_of(sweep, rest) for rest in others if rest != key}
        chosen = [with_values(one, middle) for one in sweeps]
        keep("-".join(filter(None, ("tyre", key, axes))), plot_tyre_curves(*chosen, by=key, axes=axes))
    slip = next((key for key in others if key in MAKES_SLIP), None)
    if slip:
        middle = {rest: middle_of(sweep, rest) for rest in others if rest != slip}
        chosen_one = with_values(sweep, middle)
        slip_by(chosen_one)
        keep("friction-ellipse", plot_friction_ellipse(chosen_one).figure)
    if len(more) == 1:
        into.mkdir(parents=True, exist_ok=True)
        path = into / "tyre.txt"
        path.write_text(table_of(pairs(sweep, more[0]), [name_of(one) for one in sweeps]) + "\n")
        written.append(path)
    elif len(more) > 2:
        raise Error("at most three sweeps beside each other")
    return written


def middle_of(sweep: Sweep, name: str) -> float:
    """Of the values of a parameter, of an even number of them the lower one."""
    values = np.unique(numbers_of(sweep, name))
    return float(values[(len(values) - 1) // 2])

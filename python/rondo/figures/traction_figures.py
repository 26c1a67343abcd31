# SPDX-License-Identifier: BSD-3-Clause
"""The figures of a sweep over slip: traction curves, and carpets over slip and load."""
from __future__ import annotations

import os
import pathlib
from collections.abc import Iterator
from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from .. import style
from ..plots.traction import others_of

if TYPE_CHECKING:
    from ..data.sweep import Sweep

LOADS = ("analysis.load", "rim.force_y")
MOST = 12  # carpets


def draw_traction(sweep: Sweep, folder: str | os.PathLike[str]) -> list[pathlib.Path]:
    """Writes `traction-KEY`, curves for each value of that parameter with the rest at its middle
    values (`traction` where none varies), and `carpet`, where a load varies, for each value of the
    rest. Each as PNG and SVG; returns their files. An error where slip does not vary."""
    written: list[pathlib.Path] = []

    def keep(name: str, figure: Figure) -> None:
        written.extend(style.save(figure, pathlib.Path(folder) / name))
        plt.close(figure)

    others = others_of(sweep)
    for key in others:
        middle = {rest: _middle(sweep, rest) for rest in others if rest != key}
        keep(f"traction-{key}", sweep.select(middle).plot_traction(key).figure)
    if not others:
        keep("traction", sweep.plot_traction().figure)
    for load in (key for key in LOADS if key in others):
        for chosen in _each(sweep, [key for key in others if key != load]):
            name = "-".join(["carpet", *(f"{value:g}" if isinstance(value, float) else value
                                         for value in chosen.values())])
            keep(name, sweep.select(chosen).plot_carpet(load).figure)
    return written


def _middle(sweep: Sweep, key: str) -> float | str:
    values = np.unique(sweep[key])
    found: float | str = values[len(values) // 2].item()
    return found


def _each(sweep: Sweep, keys: list[str]) -> Iterator[dict[str, float | str]]:
    """All values of these parameters together that members have, MOST of them at the most."""
    there = dict.fromkeys(tuple(sweep[key][row].item() for key in keys) for row in range(len(sweep)))
    for values in list(there)[:MOST]:
        yield dict(zip(keys, values))

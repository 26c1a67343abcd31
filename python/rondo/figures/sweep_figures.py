# SPDX-License-Identifier: BSD-3-Clause
"""The figures of a sweep: main effects, spread, and the maps and curves that are asked for."""
from __future__ import annotations

import os
import pathlib
from collections.abc import Sequence
from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from .. import style
from ..data.errors import Error
from ..plots.sweep import figure_of, is_nothing, members_with
from ..plots.sweep_curves import check_curves
from ..plots.sweep_map import check_sides
from ..plots.sweep_spread import SHOWN, rows_of

if TYPE_CHECKING:
    from ..data.sweep import Sweep

# Of which main effects are drawn unless others are asked for.
FIGURES = ("force_x_mean", "force_y_mean", "force_y_fluctuation", "contact_length_mean_m",
           "friction_power", "force_x", "force_y", "contact_length_m", "pressure_max_pa",
           "rolling_resistance", "force_lateral_mean", "moment_aligning_mean", "force_lateral",
           "moment_aligning", "outer_radius_m", "width_m", "cord_force_max_n", "cord_force_min_n")


def draw_sweep(sweep: Sweep, folder: str | os.PathLike[str], figures: Sequence[str] = (),
               maps: Sequence[Sequence[str]] = (), curves: Sequence[Sequence[str]] = ()
               ) -> list[pathlib.Path]:
    """Writes main effects and spread of `figures`, without any those of the usual ones that the
    sweep has values of; and of the same maps over pairs (x, y) and curves over x by another
    parameter (x, by). Each as PNG and SVG; returns their files."""
    _check(sweep, figures, maps, curves)
    written: list[pathlib.Path] = []

    def keep(name: str, figure: Figure) -> None:
        written.extend(style.save(figure, pathlib.Path(folder) / name))
        plt.close(figure)

    drawn = list(figures) or usual(sweep)
    for name in drawn if sweep.varied else []:
        keep(f"main-effects-{name}", sweep.plot_main_effects(name))
    if rows_of(sweep, figures or [name for name in SHOWN if name in sweep]):
        keep("spread", sweep.plot_spread(figures or None).figure)
    for name in drawn:
        for x, y in maps:
            keep(f"map-{name}-{x}-{y}", sweep.plot_map(name, x, y).figure)
        for x, by in curves:
            keep(f"curves-{name}-{x}-{by}", sweep.plot_curves(name, x, by).figure)
    return written


def _check(sweep: Sweep, figures: Sequence[str], maps: Sequence[Sequence[str]],
           curves: Sequence[Sequence[str]]) -> None:
    """That all names are there: an error before any figure is drawn."""
    for name in figures:
        figure_of(sweep, name)
    for x, y in maps:
        check_sides(sweep, x, y)
    for x, by in curves:
        check_curves(sweep, x, by)


def usual(sweep: Sweep) -> list[str]:
    """Those of FIGURES that are not nothing in all members that are done."""
    members_with(sweep, [])
    names = [name for name in FIGURES if name in sweep and not is_nothing(sweep, name)]
    if not names:
        raise Error(f"{sweep.directory}: the ground does nothing in any member; there are: "
                    f"{', '.join(sweep.figures)}")
    return names

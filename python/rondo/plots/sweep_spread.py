# SPDX-License-Identifier: BSD-3-Clause
"""How far the figures of a sweep differ among its members."""
from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from .. import style
from ..data.errors import Error
from .marks import minus
from .sweep import Array, Quantity, figure_of, heading, is_nothing, members_with

if TYPE_CHECKING:
    from ..data.sweep import Sweep

# Drawn unless others are asked for: what the ground does to the body.
SHOWN = ("force_x_mean", "force_x_peak", "force_x_fluctuation", "force_y_mean", "force_y_peak",
         "force_y_fluctuation", "torque_mean", "torque_peak", "torque_fluctuation",
         "contact_length_mean_m", "contact_length_peak_m", "friction_power", "impact_power",
         "force_x", "force_y", "torque", "contact_length_m", "pressure_max_pa", "shear_max_pa",
         "strain", "outer_radius_m", "width_m", "cavity_volume_m3", "stretch_max", "cord_force_max_n",
         "cord_force_min_n")  # from outer_radius_m on of an inflation
HEIGHT = 0.42  # in, of a row
LEAST = 1e-3  # width of the axis
SMALL = 0.02  # median over greatest size of a figure that is not to be divided by it
FAR = 30.0  # greatest over least for a logarithmic scale
GOLDEN = 0.5 * (np.sqrt(5.0) - 1.0)


def plot_spread(sweep: Sweep, figures: Sequence[str] | None = None, ax: Axes | None = None
                ) -> Axes:
    """Figures over their median, a row each: every member as a dot, and a box from the first to the
    third quartile with a line at the median and whiskers to the least and the greatest. Without
    `figures` those of the ground's action on the body, or of an inflation. The title names those that are left out,
    since they have both signs or a median too near to zero."""
    import matplotlib.pyplot as plt

    if isinstance(figures, str):
        figures = [figures]
    names = [name for name in SHOWN if name in sweep] if figures is None else list(figures)
    if not names:
        raise Error(f"{sweep.directory}: no figures to draw; there are: {', '.join(sweep.figures)}")
    members = members_with(sweep, [])
    rows = rows_of(sweep, names)
    left_out = [name for name in names if name not in [row.drawn.name for row in rows]]
    if not rows:
        raise Error(f"{sweep.directory}: {', '.join(left_out)}: with both signs, or a median near "
                    "zero: no spread relative to it; plot_main_effects draws the values")
    with style.paper():
        if ax is None:
            ax = plt.figure(figsize=(style.PAGE, 0.9 + HEIGHT * len(rows))).add_subplot()
        for place, row in enumerate(rows):
            _draw(ax, place, row.values / row.median)
        ax.set_yticks(range(len(rows)), [row.said for row in rows])
        ax.set_ylim(len(rows) - 0.5, -0.5)  # the first on top
        _scale(ax, np.concatenate([row.values / row.median for row in rows]))
        ax.set_xlabel("value over the median of its row (–)")
        ax.set_title(heading([members.said(), f"left out, with both signs or a median near zero: "
                              f"{', '.join(left_out)}" if left_out else ""], 5.0))
    return ax


@dataclass(frozen=True)
class Row:
    """A figure and its values (m,) in the members that have one."""

    drawn: Quantity
    values: Array

    @property
    def median(self) -> float:
        return float(np.median(self.values))

    @property
    def is_divisible(self) -> bool:
        """Whether a value over the median says something."""
        if not len(self.values) or self.values.min() < 0 < self.values.max():
            return False
        return abs(self.median) > SMALL * float(np.abs(self.values).max())

    @property
    def said(self) -> str:
        unit = "" if self.drawn.unit == "–" else f" {self.drawn.unit}"
        median = minus(f"{self.median:.4g}")
        return f"{self.drawn.title}\nmedian {median}{unit}, n = {len(self.values)}"


def rows_of(sweep: Sweep, names: Sequence[str]) -> list[Row]:
    """Those of the figures that can be drawn over their median: all but zero, both signs."""
    drawn = [figure_of(sweep, name) for name in names]
    rows = [Row(q, q.values[sweep.done & np.isfinite(q.values)]) for q in drawn
            if not is_nothing(sweep, q.name)]
    return [row for row in rows if row.is_divisible]


def _draw(ax: Axes, place: int, values: Array) -> None:
    # The same places each time, spread evenly over the height of the row.
    beside = place + 0.5 * (np.mod(np.arange(len(values)) * GOLDEN, 1.0) - 0.5)
    ax.plot(values, beside, ".", color=style.SKY, markersize=3, zorder=1,
            rasterized=len(values) > 2000)
    ax.boxplot(values, positions=[place], vert=False, widths=0.55, whis=(0, 100),
               manage_ticks=False, medianprops={"color": style.VERMILLION, "linewidth": 1.2},
               boxprops={"linewidth": 0.8}, whiskerprops={"linewidth": 0.8},
               capprops={"linewidth": 0.8})


def _scale(ax: Axes, values: Array) -> None:
    """Logarithmic where values are far apart; not closer than the least that is to be seen."""
    if values.min() > 0 and values.max() > FAR * values.min():
        ax.set_xscale("log")
        return
    ax.ticklabel_format(axis="x", useOffset=False)
    if np.ptp(values) < LEAST:
        ax.set_xlim(1 - LEAST, 1 + LEAST)

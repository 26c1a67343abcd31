# SPDX-License-Identifier: BSD-3-Clause
"""Main effects: a figure of a sweep over each of its parameters."""
from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from .. import style
from ..data.errors import Error
from .labels import steady_scale
from .marks import letter
from .sweep import (Array, Levels, Members, Quantity, by_level, figure_of, heading, mark_lost,
                    members_with, quantity, scale_axis)

if TYPE_CHECKING:
    from ..data.sweep import Sweep

ACROSS = 3  # panels in a row
IN_BIN = 10  # least number of members in a mean of sampled ones
MOST_BINS = 10
MANY = 20  # values in a panel
HEIGHT = 1.9  # in, of a panel


def plot_main_effects(sweep: Sweep, figure: str) -> Figure:
    """A panel for each parameter that varies: at each of its values the mean of the figure over
    all members that have it, that is over the other parameters, with a bar from the least to the
    greatest. Of a sampled parameter all members, and means of neighbours along it, as many in
    each, with bars of twice the standard error.

    The level line is the mean of all. Crosses at the bottom: members without a value."""
    import matplotlib.pyplot as plt

    names = sweep.varied
    if not names:
        raise Error(f"{sweep.directory}: no parameter differs among these {len(sweep)} members")
    drawn = figure_of(sweep, figure)
    parameters = [quantity(sweep, name) for name in names]
    members = members_with(sweep, [drawn, *parameters])
    columns = min(len(names), ACROSS) if len(names) != 4 else 2
    rows = -(-len(names) // columns)
    with style.paper():
        width = style.PAGE if columns > 1 else style.COLUMN
        page = plt.figure(figsize=(width, HEIGHT * rows + 0.4))
        grid = page.subplots(rows, columns, sharey=True, squeeze=False).ravel()
        for k, (ax, parameter) in enumerate(zip(grid, parameters)):
            _panel(ax, drawn.values, parameter, members)
            scale_axis(ax, "x", parameter, width / columns - 0.6)
            if len(names) > 1:
                letter(ax, chr(ord("a") + k))
        for ax in grid[len(names):]:
            ax.remove()
        for ax in grid[:len(names):columns]:
            scale_axis(ax, "y", drawn, HEIGHT - 0.3)
        steady_scale(grid[0], drawn.values[members.used], drawn.unit)
        page.suptitle(heading(_said(drawn, parameters, members), width), fontsize=8)
    return page


def _said(drawn: Quantity, parameters: list[Quantity], members: Members) -> list[str]:
    """Of the title."""
    way = ""
    if len(parameters) > 1:
        bars = {False: "from least to greatest", True: "twice the standard error"}
        kinds = sorted({p.sampled for p in parameters})
        way = f"means over the other parameters, bars {' or '.join(bars[kind] for kind in kinds)}"
    said = members.said(*(p.values for p in parameters))
    return [f"{drawn.title}: {said}", way]


def _panel(ax: Axes, values: Array, parameter: Quantity, members: Members) -> None:
    x, y = parameter.values[members.used], values[members.used]
    ax.axhline(y.mean(), color="0.8", linewidth=0.6, zorder=0)
    mark_lost(ax, parameter.values[members.lost])
    if parameter.sampled:
        ax.plot(x, y, ".", color="0.65", markersize=3, zorder=1, rasterized=len(x) > 2000,
                label="members")
    level = by_bin(x, y) if parameter.sampled else by_level(x, y)
    bar, dot = (2.0, 3.5) if len(level.at) < MANY else (1.0, 2.0)
    ax.vlines(level.at, level.low, level.high, color=style.SKY, linewidth=bar, zorder=2,
              label="range")
    ax.plot(level.at, level.mean, "o", color=style.BLUE, markersize=dot, zorder=3,
            linestyle="none" if parameter.texts else "-", label="mean")


def by_bin(x: Array, y: Array) -> Levels:
    """Means of y over neighbours in x, as many in each group, at the means of their x, with twice
    the standard error to both sides; none of fewer than 20."""
    count = min(len(x) // IN_BIN, MOST_BINS)
    if count < 2:
        return Levels(*(np.empty(0),) * 4)
    parts = np.array_split(np.argsort(x, kind="stable"), count)
    at, mean, error = (np.array(numbers) for numbers in (
        [x[part].mean() for part in parts], [y[part].mean() for part in parts],
        [y[part].std(ddof=1) / np.sqrt(len(part)) for part in parts]))
    return Levels(at, mean, mean - 2 * error, mean + 2 * error)

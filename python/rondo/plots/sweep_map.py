# SPDX-License-Identifier: BSD-3-Clause
"""A map: a figure of a sweep over two of its parameters."""
from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib import patheffects
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator
from matplotlib.tri import Triangulation
from numpy.typing import NDArray

from .. import style
from ..data.errors import Error
from .sweep import (Array, Members, Quantity, figure_of, heading, members_with, others, quantity,
                    scale_axis)

if TYPE_CHECKING:
    from ..data.sweep import Sweep

SIZE = (4.6, 3.2)  # in
IN_CELL = 4  # members in a cell of sampled ones, in the mean
MOST_CELLS = 12  # along an axis
CONTOURS = 12  # at most
FEWEST = 10  # members for contours
FLAT = 1e-6  # second over first extent of places that are on a line
EMPTY = "0.88"


def plot_map(sweep: Sweep, figure: str, x: str, y: str, ax: Axes | None = None) -> Axes:
    """Colours over two columns. Where both have values that are shared, a cell for each pair; where
    members are sampled and nothing else varies, contours through them; where more varies, cells
    with the means of the members in them. Dots: sampled members, in the colour of their own value.

    Cells without a value are grey. Crosses: members without a value."""
    import matplotlib.pyplot as plt

    drawn = figure_of(sweep, figure)
    sides = check_sides(sweep, x, y)
    members = members_with(sweep, [drawn, *sides])
    for side in sides:
        if len(np.unique(side.values[members.used])) < 2:
            value = side.said(side.values[members.used][0])
            raise Error(f"{sweep.directory}: {side.name} is {value} in all members that are done: "
                        "choose another for a map")
    with style.paper():
        if ax is None:
            ax = plt.figure(figsize=SIZE).add_subplot()
        rest = others(sweep, x, y)
        colours = _colours(drawn.values[members.used])
        contours = all(side.sampled for side in sides) and len(sweep.varied) <= 2 and _spread(
            *(side.values[members.used] for side in sides))
        draw = _contours if contours else _cells
        said = draw(ax, drawn, sides, members, colours, rest)
        _crosses(ax, sides, members)
        for which, side in zip("xy", sides):
            scale_axis(ax, which, side, 2.6)
        counted = members.said(*(side.values for side in sides))
        ax.set_title(heading([f"{drawn.title}: {counted}", said], SIZE[0]))
    return ax


def check_sides(sweep: Sweep, x: str, y: str) -> list[Quantity]:
    """What a map goes along."""
    if x == y:
        raise Error(f"a map takes two parameters; {x!r} was given twice")
    return [quantity(sweep, name) for name in (x, y)]


def _colours(values: Array) -> dict[str, Any]:
    """From the least to the greatest; where they have both signs, zero in the middle."""
    low, high = float(values.min()), float(values.max())
    if low < 0 < high:
        high = max(-low, high)
        return {"cmap": style.DIVERGING, "vmin": -high, "vmax": high}
    if low == high:
        low, high = low - 0.1 * abs(low) - 1e-9, high + 0.1 * abs(high) + 1e-9
    return {"cmap": style.SEQUENTIAL, "vmin": low, "vmax": high}


def _spread(x: Array, y: Array) -> bool:
    """Whether there are places enough, and not on a line."""
    if len(x) < FEWEST:
        return False
    extents = np.linalg.svd(_unit_square(x, y) - 0.5, compute_uv=False)
    return bool(extents[1] > FLAT * extents[0])


def _unit_square(x: Array, y: Array) -> Array:
    """(m, 2): places with both sides from 0 to 1; of another shape triangles would be slivers."""
    return np.stack([(side - side.min()) / np.ptp(side) for side in (x, y)], axis=1)


def _contours(ax: Axes, drawn: Quantity, sides: list[Quantity], members: Members,
              colours: dict[str, Any], rest: list[str]) -> str:
    x, y = (side.values[members.used] for side in sides)
    values = drawn.values[members.used]
    corners = Triangulation(*_unit_square(x, y).T).triangles
    levels = MaxNLocator(CONTOURS).tick_values(colours["vmin"], colours["vmax"])  # round numbers
    colours |= {"vmin": levels[0], "vmax": levels[-1]}
    filled = ax.tricontourf(Triangulation(x, y, corners), values, levels=levels, **colours)
    _dots(ax, x, y, values, colours)
    ax.figure.colorbar(filled, ax=ax, label=drawn.label)
    return "linear between members"


def _dots(ax: Axes, x: Array, y: Array, values: Array, colours: dict[str, Any]) -> None:
    ax.scatter(x, y, c=values, s=9, edgecolors="0.3", linewidths=0.4, zorder=2,
               rasterized=len(x) > 2000, **colours)


@dataclass(frozen=True)
class Side:
    """Cells along an axis: edges (k + 1,), and where each of m members is among them."""

    edges: Array
    place: NDArray[np.int64]


def _cells(ax: Axes, drawn: Quantity, sides: list[Quantity], members: Members,
           colours: dict[str, Any], rest: list[str]) -> str:
    across, up = _sides(sides, members)
    shape = (len(up.edges) - 1, len(across.edges) - 1)
    values = drawn.values[members.used]
    total, count = np.zeros(shape), np.zeros(shape)
    np.add.at(total, (up.place, across.place), values)
    np.add.at(count, (up.place, across.place), 1)
    means = np.ma.masked_where(count == 0, total / np.maximum(count, 1))
    ax.set_facecolor(EMPTY)
    cells = ax.pcolormesh(across.edges, up.edges, means, rasterized=means.size > 5000, **colours)
    ax.figure.colorbar(cells, ax=ax, label=drawn.label)
    if any(side.sampled for side in sides):
        x, y = (side.values[members.used] for side in sides)
        _dots(ax, x, y, values, colours)
        return "cells: means of the members in them"
    return f"mean over {', '.join(rest)}" if rest else ""


def _sides(sides: list[Quantity], members: Members) -> list[Side]:
    """Cells about the values of a parameter, also of members that are lost; along a sampled one as
    many that some members are in each."""
    shared = [len(side.levels) for side in sides if not side.sampled]
    cells = max(4.0, members.used.sum() / IN_CELL)
    along = cells / shared[0] if shared else np.sqrt(cells)
    out = []
    for side in sides:
        values = side.values[members.used]
        if side.sampled:
            edges = np.linspace(values.min(), values.max(), 1 + int(np.clip(along, 2, MOST_CELLS)))
        else:
            edges = _edges(side.levels, side.is_log)
        place = np.searchsorted(edges, values, side="right") - 1
        out.append(Side(edges, np.clip(place, 0, len(edges) - 2)))
    return out


def _edges(levels: Array, log: bool) -> Array:
    """(k + 1,): midway between k values, and as far beyond the first and the last."""
    at = np.log(levels) if log else levels
    middle = 0.5 * (at[1:] + at[:-1])
    ends = np.concatenate([[2 * at[0] - middle[0]], middle, [2 * at[-1] - middle[-1]]])
    return np.exp(ends) if log else ends


def _crosses(ax: Axes, sides: list[Quantity], members: Members) -> None:
    """At the members without a value."""
    x, y = (side.values[members.lost] for side in sides)
    there = np.isfinite(x) & np.isfinite(y)
    crosses, = ax.plot(x[there], y[there], "x", color=style.VERMILLION, markersize=5, zorder=4,
                       markeredgewidth=1.2, label="_lost")
    crosses.set_path_effects([patheffects.withStroke(linewidth=2.6, foreground="white")])

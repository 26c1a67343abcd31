# SPDX-License-Identifier: BSD-3-Clause
"""Curves: a figure of a sweep over one column, one for each value of another."""
from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import ListedColormap, Normalize

from .. import style
from ..data.errors import Error
from .labels import axes_of, steady_scale
from .sweep import (Array, Mask, Members, Quantity, by_level, figure_of, heading, mark_lost,
                    members_with, others, quantity, scale_axis)

if TYPE_CHECKING:
    from ..data.sweep import Sweep

HEIGHT = 2.8  # in
MOST = 40  # curves
MARKERS = "o^sDvP"  # where points are not joined
BESIDE = 0.08  # of the distance of texts at the axis
SHADES = ListedColormap(style.SEQUENTIAL(np.linspace(0.25, 1.0, 256)))  # all seen on white


def plot_curves(sweep: Sweep, figure: str, x: str, by: str | None = None,
                ax: Axes | None = None) -> Axes:
    """A figure over the column x, which may be a figure as well (a traction curve: force_x_mean
    over slip_ratio_mean), with a curve for each value of the parameter `by`.

    Where other parameters vary too, a curve is the mean over them and a band goes from the least to
    the greatest. Where x is sampled or a figure, each member is a point; points are joined in order
    of x if one parameter alone leads along the curve. Crosses at the bottom: members without a
    value, at which lines break; where x has none either, it is read off the curve over the
    parameter that leads along it."""
    drawn = figure_of(sweep, figure)
    along, parted = check_curves(sweep, x, by)
    members = members_with(sweep, [drawn, along, *([parted] if parted else [])])
    rest = others(sweep, x, *([by] if by else []))
    joined = len(rest) <= (0 if x in sweep.varied else 1)
    if along.sampled and len(rest) == 1:
        along = _placed(along, parted, quantity(sweep, rest[0]), members)
    with style.paper():
        ax = axes_of(ax, HEIGHT)
        lines = _lines(ax, parted, members)
        apart = min(BESIDE, 0.8 / len(lines))
        values = np.where(members.lost, np.nan, drawn.values)
        for k, (mask, line) in enumerate(lines):
            if along.sampled:
                _points(ax, along.values[mask], values[mask], line,
                        "" if joined else MARKERS[k % len(MARKERS)])
            else:
                beside = apart * (k - 0.5 * (len(lines) - 1)) if along.texts else 0.0
                _means(ax, along, mask, values, line, beside)
        mark_lost(ax, along.values[members.lost])
        if ax.get_legend_handles_labels()[1]:
            ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), title=by)
        steady_scale(ax, drawn.values[members.used], drawn.unit)
        scale_axis(ax, "x", along, 5.0)
        scale_axis(ax, "y", drawn, HEIGHT - 0.6)
        way = (f"means over {', '.join(rest)}, {'bars' if along.texts else 'bands'} from least to "
               "greatest")
        ax.set_title(heading([f"{drawn.title}: {members.said(along.values)}",
                              way if rest and not along.sampled else ""], 5.5))
    return ax


def check_curves(sweep: Sweep, x: str, by: str | None) -> tuple[Quantity, Quantity | None]:
    """What the curves go along, and by what they are told apart: values that members share."""
    if x == by:
        raise Error(f"curves over {x!r} for each value of it: choose another one")
    along = quantity(sweep, x)
    if by is None:
        return along, None
    parted = quantity(sweep, by)
    if parted.sampled:
        raise Error(f"{sweep.directory}: {by} has another value in each member: curves take a "
                    "parameter with values that members share; plot_map draws sampled ones")
    most = len(style.CURVES) if parted.texts else MOST
    if len(parted.levels) > most:
        raise Error(f"{sweep.directory}: {by} has {len(parted.levels)} values; at most {most} "
                    "curves can be told apart: select() some")
    return along, parted


def _lines(ax: Axes, parted: Quantity | None, members: Members
           ) -> list[tuple[Mask, dict[str, Any]]]:
    """The members of each curve, those that are lost too, and how it looks; many values as shades,
    with a colour bar."""
    there = members.used | members.lost
    if parted is None:
        return [(there, dict(style.CURVES[0]))]
    of_level = [there & (parted.values == level) for level in parted.levels]
    if len(parted.levels) <= len(style.CURVES):
        looks = [{**line, "label": parted.said(level)}
                 for level, line in zip(parted.levels, style.CURVES)]
    else:
        shade = ScalarMappable(Normalize(parted.levels[0], parted.levels[-1]), SHADES)
        ax.figure.colorbar(shade, ax=ax, label=parted.label)
        looks = [{"color": shade.to_rgba(level)} for level in parted.levels]
    return [(mask, look) for mask, look in zip(of_level, looks) if (mask & members.used).any()]


def _placed(along: Quantity, parted: Quantity | None, lead: Quantity, members: Members) -> Quantity:
    """With a value at members that are lost and have none: between those of their curve, or beyond
    them, linearly in the parameter `lead`."""
    values = along.values.copy()
    levels = np.zeros(len(values)) if parted is None or lead.texts else parted.values
    for level in () if lead.texts else np.unique(levels[members.lost]):
        known = np.flatnonzero(members.used & (levels == level))
        known = known[np.argsort(lead.values[known])]
        steps = lead.values[known]
        if len(known) < 2 or np.any(np.diff(steps) <= 0):
            continue
        for row in np.flatnonzero(members.lost & (levels == level) & ~np.isfinite(values)):
            after = int(np.clip(np.searchsorted(steps, lead.values[row]), 1, len(known) - 1))
            before, after = known[after - 1], known[after]
            share = (lead.values[row] - lead.values[before]) / (lead.values[after] - lead.values[before])
            values[row] = values[before] + share * (values[after] - values[before])
    return dataclasses.replace(along, values=values)


def _points(ax: Axes, x: Array, y: Array, line: dict[str, Any], marker: str) -> None:
    """A point for each member; joined without a marker of their own. What has a place but no value
    breaks the line."""
    order = np.argsort(x, kind="stable")
    order = order[np.isfinite(x[order]) & (np.isfinite(y[order]) | (not marker))]
    look = {**line, "linestyle": "none"} if marker else line
    ax.plot(x[order], y[order], marker=marker or ".", markersize=3.5, **look)


def _means(ax: Axes, along: Quantity, mask: Mask, values: Array, line: dict[str, Any],
           beside: float) -> None:
    """Means and what they are of; those at texts are moved `beside` each other, not joined. A line
    breaks where no member has a value."""
    level = by_level(along.values[mask], values[mask])
    look = {**line, "linestyle": "none"} if along.texts else line
    ax.plot(level.at + beside, level.mean, marker=".", markersize=3.5, **look)
    if along.texts:
        ax.vlines(level.at + beside, level.low, level.high, color=line["color"], linewidth=0.8)
    elif np.any(level.high > level.low):
        ax.fill_between(level.at, level.low, level.high, color=line["color"], alpha=0.18,
                        linewidth=0, zorder=1)

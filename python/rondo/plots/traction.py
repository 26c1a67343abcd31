# SPDX-License-Identifier: BSD-3-Clause
"""Traction of a sweep: the longitudinal force over slip, as curves and as a carpet."""
from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from .. import style
from ..data.errors import Error
from ..data.names import find_figure
from .labels import axes_of
from .marks import minus
from .sweep import Array, Mask, Quantity, heading, members_with, quantity
from .sweep_curves import plot_curves

if TYPE_CHECKING:
    from ..data.sweep import Sweep

FORCE, LOAD, SLIP, SHARE = "force_x", "force_y", "slip_ratio", "Fx/Fy"
MOVE = ("motion.speed", "motion.angular_velocity", "analysis.traction", "analysis.torque")  # the slip
HEIGHT = 3.4  # in
SHIFT = 1.0  # of the whole range of slips: how far a carpet's last curve is from its first
MOST_SAID = 9  # slips named along the edge of a carpet
SAME = 1e-6  # slips of a carpet that are one
LEAST = 0.005  # %, of a slip that is not called 0
NAMES = 7  # pt, of what names curves


def others_of(sweep: Sweep) -> list[str]:
    """The parameters that differ, without those that make the slip; an error where none does."""
    slip = find_figure(SLIP, sweep)
    if slip is None or find_figure(FORCE, sweep) is None:
        raise Error(f"{sweep.directory}: no {SLIP} or {FORCE} among its figures; a sweep of rolling "
                    "has them")
    values = sweep[slip][sweep.done]
    if not len(values) or np.ptp(values) < SAME:
        raise Error(f"{sweep.directory}: all members have one slip: vary motion.speed at a given "
                    "motion.angular_velocity (or the other way round)")
    return [key for key in sweep.varied if key not in MOVE]


def plot_traction(sweep: Sweep, by: str | None = None, ax: Axes | None = None,
                  share: bool = False) -> Axes:
    """Longitudinal force over the slip ratio, a curve for each value of the parameter `by`, by
    default the only one that varies besides; `share`: over the vertical force. The force of free
    rolling is 0, its slip is marked by the line through it."""
    rest = others_of(sweep)
    if by is None and len(rest) == 1:
        by = rest[0]
    more = [key for key in rest if key != by]
    if more:
        raise Error(f"{sweep.directory}: {', '.join(more)} vary as well: select() one value of each, "
                    f"or another by=")
    force, slip = (str(find_figure(name, sweep)) for name in (FORCE, SLIP))
    if share:
        load = sweep[str(find_figure(LOAD, sweep))]
        sweep, force = sweep.with_figure(SHARE, sweep[force] / load, "1"), SHARE
    ax = plot_curves(sweep, force, slip, by, ax)
    with style.paper():
        for line in (ax.axhline, ax.axvline):
            line(0.0, color="0.8", linewidth=0.6, zorder=0)
    return ax


@style.paper()
def plot_carpet(sweep: Sweep, by: str = "analysis.load", ax: Axes | None = None) -> Axes:
    """Longitudinal force over slip and a second parameter, by default the load, in one net: a curve
    over slip for each value of `by`, each drawn further to the right in proportion to it, and
    curves across them that join equal slips. There is no axis of slips then: they are named along
    the lowest curve, values of `by` at the ends. A grid of members is needed."""
    more = [key for key in others_of(sweep) if key != by]
    if more:
        raise Error(f"{sweep.directory}: a carpet is over slip and {by}, and {', '.join(more)} vary "
                    "as well: select() one value of each")
    force, slip, parted = (quantity(sweep, name) for name in (
        str(find_figure(FORCE, sweep)), str(find_figure(SLIP, sweep)), by))
    members = members_with(sweep, [force, slip, parted])
    slips, values, net = _net(sweep, slip, parted, force.values, members.used)
    ax = axes_of(ax, HEIGHT)
    place = slips[None, :] + SHIFT * np.ptp(slips) * ((values - values[0]) / np.ptp(values))[:, None]
    for row in range(len(values)):
        ax.plot(place[row], net[row], color=style.BLUE, label="_over slip")
    for column in _said(slips):
        ax.plot(place[:, column], net[:, column], color=style.VERMILLION, linewidth=0.7,
                linestyle="--", label="_equal slip")
    _name_edges(ax, place, net, slips, [parted.said(value) for value in values])
    ax.axhline(0.0, color="0.8", linewidth=0.6, zorder=0)
    ax.set_ylabel(force.label)
    ax.set_xticks([])
    ax.spines["bottom"].set_visible(False)
    ax.set_title(heading([f"{force.title} over slip ratio (–) and {parted.label}: {members.said()}"],
                         5.5))
    return ax


def _net(sweep: Sweep, slip: Quantity, parted: Quantity, force: Array, used: Mask
         ) -> tuple[Array, Array, Array]:
    """(s,) slips, (b,) values of the other parameter, (b, s) forces; NaN where a member is lost."""
    values = np.unique(parted.values[used])
    along = np.sort(slip.values[used])
    slips = along[np.append(True, np.diff(along) > SAME)]
    if len(values) < 2 or len(slips) < 2:
        raise Error(f"{sweep.directory}: a carpet needs two slips and two values of {parted.name} at "
                    f"least; here are {len(slips)} and {len(values)}")
    net = np.full((len(values), len(slips)), np.nan)
    rows = np.searchsorted(values, parted.values[used])
    columns = np.abs(slips[None, :] - slip.values[used][:, None]).argmin(axis=1)
    net[rows, columns] = force[used]
    if np.isnan(net).mean() > 0.5:
        raise Error(f"{sweep.directory}: the members are no grid over slip and {parted.name}: slips "
                    "are to be the same for each value, as those of a given speed and spin are")
    return slips, values, net


def _said(slips: Array) -> list[int]:
    """Which slips are named: all, or evenly some of them, zero among them if it is there."""
    step = -(-len(slips) // MOST_SAID)
    first = int(np.abs(slips).argmin()) % step
    return list(range(first, len(slips), step))


def _name_edges(ax: Axes, place: Array, net: Array, slips: Array, names: list[str]) -> None:
    """Slips along the last curve, values of the other parameter at the left end of each."""
    for column in _said(slips):
        if np.isfinite(net[-1, column]):
            percent = 100 * float(slips[column])
            said = f"{percent:.2g}" if abs(percent) > LEAST else "0"
            ax.annotate(minus(f"{said} %"), (place[-1, column], net[-1, column]), fontsize=NAMES,
                        color=style.VERMILLION, ha="left", va="top", xytext=(4, 1),
                        textcoords="offset points")
    for row, name in enumerate(names):
        seen = np.flatnonzero(np.isfinite(net[row]))
        if len(seen):
            ax.annotate(name, (place[row, seen[0]], net[row, seen[0]]), color=style.BLUE,
                        fontsize=NAMES, ha="right", va="center", xytext=(-4, 0),
                        textcoords="offset points")
    ax.margins(x=0.12)

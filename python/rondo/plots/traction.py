# SPDX-License-Identifier: BSD-3-Clause
"""Traction of a sweep: the longitudinal force over slip, as curves and as a carpet."""
from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from .. import style
from ..data.errors import Error
from ..data.names import find_figure
from .labels import axes_of, parameter_label
from .marks import minus
from .sweep import Array, Mask, Quantity, heading, members_with, quantity
from .sweep_curves import plot_curves

if TYPE_CHECKING:
    from ..data.sweep import Sweep

FORCE, LOAD, SLIP, SHARE = "force_x", "force_y", "slip_ratio", "Fx/Fy"
SPEED, SPIN = "motion.speed", "motion.angular_velocity"
FOUND = ("analysis.traction", "analysis.torque")  # with these the speed is found
MOVE = (SPEED, SPIN, *FOUND)  # the slip
HEIGHT = 3.4  # in
WIDTH = 5.5  # in, of a title
SHIFT = 1.0  # of the whole range of slips: how far a carpet's last curve is from its first
MOST_SAID = 9  # slips named along the edge of a carpet
ROUND = (1.0, 2.0, 5.0)  # times a power of ten: steps between slips
SAME = 1e-6  # slips of a carpet that are one
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
    _need_slip_that_is_made(sweep)
    return [key for key in sweep.varied if key not in MOVE]


def _need_slip_that_is_made(sweep: Sweep) -> None:
    """An error of steady rolling whose speed was found while no traction or torque varies: its slip
    is what comes of the other parameters, and nothing to draw a curve over."""
    speed = find_figure("speed", sweep)
    if sweep.analysis != "steady-rolling" or speed is None or set(sweep.varied) & {SPEED, *FOUND}:
        return
    values = sweep[speed][sweep.done]
    if np.ptp(values) > SAME * np.abs(values).max():
        raise Error(f"{sweep.directory}: the speed is found from a traction or torque that is the same "
                    f"for all members, so that the slip is a result, and no curve goes along it. Vary "
                    f"{SPEED} at a given {SPIN} (or the other way round), with a height or "
                    "analysis.load, and without analysis.traction or analysis.torque; or vary one "
                    "of these two. Figures of this sweep over its parameters: "
                    f"rondo figures {sweep.directory}")


def _constants(sweep: Sweep) -> list[str]:
    """What the parameters are in which these members, as those of a select(), are alike."""
    alike = [quantity(sweep, key) for key in sweep.parameters if len(np.unique(sweep[key])) == 1]
    return [f"{parameter_label(q.name).replace('friction ', '')} = "
            f"{q.said(q.values[0])}" for q in alike]


def in_percent(sweep: Sweep) -> tuple[Sweep, str]:
    """With the slip ratio in %, and the name of that column."""
    slip = str(find_figure(SLIP, sweep))
    name = slip.replace(SLIP, "slip_percent")
    return (sweep if name in sweep else sweep.with_figure(name, 100 * sweep[slip], "%")), name


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
    force = str(find_figure(FORCE, sweep))
    constants = _constants(sweep)
    sweep, slip = in_percent(sweep)
    if share:
        load = sweep[str(find_figure(LOAD, sweep))]
        sweep, force = sweep.with_figure(SHARE, sweep[force] / load, "1"), SHARE
    ax = plot_curves(sweep, force, slip, by, ax)
    with style.paper():
        for line in (ax.axhline, ax.axvline):
            line(0.0, color="0.8", linewidth=0.6, zorder=0)
        if (legend := ax.get_legend()) is not None:
            legend.set_title(parameter_label(str(by)))
        ax.set_title(heading([" ".join(ax.get_title().split()), *constants], WIDTH))
    return ax


@style.paper()
def plot_carpet(sweep: Sweep, by: str = "analysis.load", ax: Axes | None = None) -> Axes:
    """Longitudinal force over slip and a second parameter, by default the load, in one net: a curve
    over slip for each value of `by`, each drawn further to the right in proportion to it, and
    curves across them that join equal slips, round ones, between members if need be. There is no
    axis of slips then: they are named along the last curve, values of `by` at the ends. A grid of
    members is needed."""
    more = [key for key in others_of(sweep) if key != by]
    if more:
        raise Error(f"{sweep.directory}: a carpet is over slip and {by}, and {', '.join(more)} vary "
                    "as well: select() one value of each")
    sweep, percent = in_percent(sweep)
    force, slip, parted = (quantity(sweep, name) for name in (
        str(find_figure(FORCE, sweep)), percent, by))
    members = members_with(sweep, [force, slip, parted])
    slips, values, net = _net(sweep, slip, parted, force.values, members.used)
    ax = axes_of(ax, HEIGHT)
    shifts = SHIFT * np.ptp(slips) * (values - values[0]) / np.ptp(values)
    for row, shift in enumerate(shifts):
        ax.plot(slips + shift, net[row], color=style.BLUE, label="_over slip")
    for level in round_slips(slips[0], slips[-1]):
        across = np.array([np.interp(level, slips, row) for row in net])  # NaN beside a gap
        ax.plot(level + shifts, across, color=style.VERMILLION, linewidth=0.7, linestyle="--",
                label="_equal slip")
        _name(ax, level + shifts[-1], across[-1], minus(f"{level:g} %"), style.VERMILLION, "left")
    for row, value in enumerate(values):
        seen = np.flatnonzero(np.isfinite(net[row]))
        if len(seen):
            _name(ax, slips[seen[0]] + shifts[row], net[row, seen[0]], parted.said(value), style.BLUE,
                  "right")
    ax.margins(x=0.12)
    ax.axhline(0.0, color="0.8", linewidth=0.6, zorder=0)
    ax.set_ylabel(force.label)
    ax.set_xticks([])
    ax.spines["bottom"].set_visible(False)
    ax.set_title(heading([f"{force.title} over slip ratio (%) and {parameter_label(by)} "
                          f"({parted.unit}): {members.said()}", *_constants(sweep)], WIDTH))
    return ax


def _net(sweep: Sweep, slip: Quantity, parted: Quantity, force: Array, used: Mask
         ) -> tuple[Array, Array, Array]:
    """(s,) slips, (b,) values of the other parameter, (b, s) forces; NaN where a member is lost."""
    values = np.unique(parted.values[used])
    along = np.sort(slip.values[used])
    slips = along[np.append(True, np.diff(along) > 100 * SAME)]
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


def round_slips(low: float, high: float) -> Array:
    """Slips (%) from low to high at the least round step that leaves MOST_SAID of them at most."""
    decade = 10.0 ** np.floor(np.log10((high - low) / MOST_SAID))
    steps = [factor * decade for factor in (*ROUND, 10 * ROUND[0])]
    step = next(s for s in steps if np.floor(high / s + SAME) - np.ceil(low / s - SAME) < MOST_SAID)
    count = np.arange(np.ceil(low / step - SAME), np.floor(high / step + SAME) + 1)
    return np.clip(np.round(count * step, 12), low, high) + 0.0  # no −0


def _name(ax: Axes, x: float, y: float, text: str, colour: str, side: str) -> None:
    """Below the end of a curve, to the left of it or to the right, with no line through it."""
    if np.isfinite(y):
        beside = (4, 1) if side == "left" else (-3, -2)
        ax.annotate(text, (x, y), fontsize=NAMES, color=colour, ha=side, va="top", xytext=beside,
                    textcoords="offset points", zorder=4,
                    bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.4})

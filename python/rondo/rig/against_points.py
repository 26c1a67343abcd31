# SPDX-License-Identifier: BSD-3-Clause
"""What a rig says at the states of a measurement: its points, interpolated along the slip and over the load."""
from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from .points import Array, middle

BEYOND = 0.02  # of the load: how far beyond the loads of the rig a measured one is still taken as the last of them
EDGE = 0.005   # of the extent of a curve, likewise: files round their numbers


@dataclass(frozen=True)
class Axis:
    """A setting that measured states must share with a curve of the rig, and how far they may be apart."""

    name: str
    apart: float
    relative: bool = False

    def distance(self, mine: float, theirs: Array) -> Array:
        """Over what is allowed. A state that does not say it agrees, and so does any with what is 0 and relative: the
        pressure of a wheel without air."""
        unit = (self.apart * abs(mine) or np.inf) if self.relative else self.apart
        return np.where(np.isfinite(theirs), np.abs(theirs - mine) / unit, 0.0)


@dataclass(frozen=True)
class Way:
    """How the points of a test are interpolated."""

    along: str                # column along which its curves go
    fixed: tuple[Axis, ...]   # what tells curves apart besides the load
    by_load: bool = True      # curves have a load each, over which is interpolated


def interpolated(points: Mapping[str, Array], channel: str, way: Way, states: Mapping[str, Array]) -> Array:
    """(states,) NaN where a state lies beyond the points. points and states: columns of one length each. Of curves
    that agree equally well with a state, as where it does not say its camber, that nearest to the nominal one counts."""
    rows = len(states[way.along])
    found, best = np.full(rows, np.nan), np.full(rows, np.inf)
    for values in _nominal_first(points, way.fixed):
        apart = np.max([axis.distance(value, states[axis.name]) for axis, value in zip(way.fixed, values)], axis=0)
        mine = np.all([points[axis.name] == value for axis, value in zip(way.fixed, values)], axis=0)
        chosen = (apart <= 1.0) & (apart < best)
        if not chosen.any():
            continue
        here = {name: column[mine] for name, column in points.items()}
        theirs = {name: column[chosen] for name, column in states.items()}
        at = _over_loads(here, channel, way.along, theirs) if way.by_load else _along(here, channel, way.along, theirs)
        there = np.flatnonzero(chosen)[np.isfinite(at)]
        found[there], best[there] = at[np.isfinite(at)], apart[there]
    return found


def _nominal_first(points: Mapping[str, Array], fixed: tuple[Axis, ...]) -> Array:
    """(curves, axes): the settings that tell curves apart."""
    sets = np.unique(np.stack([points[axis.name] for axis in fixed], axis=1), axis=0)
    away = np.max([axis.distance(middle(points[axis.name]), sets[:, k]) for k, axis in enumerate(fixed)], axis=0)
    return np.asarray(sets[np.argsort(away, kind="stable")])


def _along(points: Mapping[str, Array], channel: str, along: str, states: Mapping[str, Array]) -> Array:
    there = np.isfinite(points[channel]) & np.isfinite(points[along])
    if int(there.sum()) < 2:
        return np.full(len(states[along]), np.nan)
    order = np.argsort(points[along][there])
    x, y = points[along][there][order], points[channel][there][order]
    edge = EDGE * (x[-1] - x[0])
    inside = (states[along] >= x[0] - edge) & (states[along] <= x[-1] + edge)
    return np.asarray(np.where(inside, np.interp(states[along], x, y), np.nan))


def _over_loads(points: Mapping[str, Array], channel: str, along: str, states: Mapping[str, Array]) -> Array:
    loads = np.unique(points["load"])
    curves = np.stack([_along({name: column[points["load"] == load] for name, column in points.items()}, channel, along,
                              states) for load in loads])
    wanted = np.where(np.isfinite(states["load"]), states["load"], np.nan)
    inside = (wanted >= loads[0] * (1 - BEYOND)) & (wanted <= loads[-1] * (1 + BEYOND))
    if len(loads) == 1:
        return np.asarray(np.where(inside, curves[0], np.nan))
    left = np.clip(np.searchsorted(loads, wanted) - 1, 0, len(loads) - 2)
    share = np.clip((wanted - loads[left]) / (loads[left + 1] - loads[left]), 0.0, 1.0)
    rows = np.arange(len(wanted))
    between = (1 - share) * curves[left, rows] + share * curves[left + 1, rows]
    # At a load of the rig the other curve does not count, which may be shorter.
    between = np.where(share == 0, curves[left, rows], np.where(share == 1, curves[left + 1, rows], between))
    return np.asarray(np.where(inside, between, np.nan))

# SPDX-License-Identifier: BSD-3-Clause
"""Flash temperature of a surface on which heat comes in while it passes (docs/wear.md)."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .errors import Error
from .friction import need_power

Array = NDArray[np.float64]
SAME = 1e-6  # of the width: nodes at one place across
LEAST_PECLET = 10.0  # below it heat also flows along the surface, which the formula leaves out


@dataclass(frozen=True)
class Heat:
    """A material, and the share of the friction power that goes into it.

    conductivity: W/(m K); density: kg/m3; capacity: J/(kg K), of heat; share: 0 to 1."""

    conductivity: float
    density: float
    capacity: float
    share: float = 0.5

    def __post_init__(self) -> None:
        for name in ("conductivity", "density", "capacity"):
            if not (getattr(self, name) > 0 and np.isfinite(getattr(self, name))):
                raise Error(f"{name} {getattr(self, name):g}: not > 0; steel has about 50 W/(m K), 7850 "
                            "kg/m3 and 450 J/(kg K), rubber 0.25, 1150 and 1700")
        if not 0 <= self.share <= 1:
            raise Error(f"share {self.share:g}: not in 0 to 1; 0.5 if both surfaces are of one material")

    @property
    def diffusivity(self) -> float:
        """[m2/s]"""
        return self.conductivity / (self.density * self.capacity)


@dataclass(frozen=True)
class FlashTemperature:
    """m nodes in the footprint.

    node: (m,) of steady rolling the number within its sector; place: (m, 2) m, ahead of the center and
    to its right; power: (m,) W/m2, that friction takes; rise: (m,) K, above the temperature with which
    the tread comes into the footprint; speed: m/s, at which it passes."""

    node: NDArray[np.int64]
    place: Array
    power: Array
    rise: Array
    speed: float

    @property
    def largest(self) -> float:
        """[K]; 0 where nothing touches."""
        return float(self.rise.max(initial=0.0))


def flash_temperature(way: Array, power: Array, speed: float, heat: Heat, reach: float) -> Array:
    """(m,) rise of the surface temperature [K] of a half-space at the places `way` [m], ascending: its
    surface passes them one after the other at the speed [m/s], and takes the share of `power` [W/m2]
    there. Between the places the power is linear, before the first and after the last it falls to zero
    within `reach` [m]. Exact for such a power, and for heat that flows into the depth
    alone (Jaeger 1942; Ertz and Knothe 2002, doi 10.1016/S0043-1648(02)00120-5)."""
    way, power = np.asarray(way, dtype=float), np.asarray(power, dtype=float)
    if not len(way) or not (np.diff(way) > 0).all() or len(power) != len(way) or not (speed > 0 and reach > 0):
        raise Error(f"flash_temperature: {len(way)} places and {len(power)} powers at {speed:g} m/s, reach "
                    f"{reach:g} m: places are to ascend, with a power at each; speed and reach are > 0")
    knots = np.concatenate([[way[0] - reach], way, [way[-1] + reach]])
    values = np.concatenate([[0.0], power, [0.0]])
    slope = np.diff(values) / np.diff(knots)
    # Of each piece: the integral of (q0 + slope (s0 - s)) / sqrt(s) over the distance s behind.
    far = np.maximum(way[:, None] - knots[None, :-1], 0.0)
    near = np.maximum(way[:, None] - knots[None, 1:], 0.0)
    pieces = (2 * (values[:-1] + slope * far) * (np.sqrt(far) - np.sqrt(near))
              - 2 / 3 * slope * (far**1.5 - near**1.5))
    total: Array = np.where(far > 0, pieces, 0.0).sum(axis=1)
    return heat.share * total / np.sqrt(np.pi * heat.conductivity * heat.density * heat.capacity * speed)


def flash_of(run: Any, heat: Heat, time: float | None = None) -> FlashTemperature:
    """Of steady rolling: each node of a sector through all its places. Of steps in time: at the snapshot
    nearest to `time`, by default the last with contact, as if what is seen there stayed as it is; nodes
    behind each other follow each other."""
    rows = need_power(run)
    if run.is_steady:
        if time is not None:
            raise Error(f"{run.directory}: time={time:g}: steady rolling has one temperature; leave time out")
        chosen = np.ones(len(rows["time_s"]), dtype=bool)
    else:
        k = run.index(float(rows["time_s"][-1]) if len(rows["time_s"]) else 0.0) if time is None else run.index(time)
        chosen = np.abs(run.times[:, None] - rows["time_s"][None, :]).argmin(axis=0) == k
    if not chosen.any():
        raise Error(f"{run.directory}: nothing touches the ground there: choose another time")
    found = {name: values[chosen] for name, values in rows.items()}
    ahead = found["x_m"] - np.interp(found["time_s"], run.times, run.center[:, 0])
    right = (found["z_m"] - np.interp(found["time_s"], run.times, run.lateral) if run.is_solid
             else np.zeros(len(ahead)))
    node = found["node"].astype(np.int64)
    lines, name, spacing = _lines(run, node)
    speed, forth = _passing(run, float(found["time_s"][-1]))
    rise = np.zeros(len(node))
    for line in np.unique(lines):
        on = np.flatnonzero(lines == line)
        order = on[np.argsort(-forth * ahead[on], kind="stable")]
        rise[order] = flash_temperature(-forth * ahead[order], found["friction_power"][order], speed, heat, spacing)
    _demand_fast(run, ahead, speed, heat)
    return FlashTemperature(name, np.stack([ahead, right], axis=1), found["friction_power"], rise, speed)


def _lines(run: Any, node: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.int64], float]:
    """(m,) number of the line along which each node passes, what the node is called, and the distance of two
    places of a line [m]."""
    mesh, around = run.mesh, 2 * np.pi * run.outer_radius
    if run.is_steady:
        assert mesh.sector is not None and mesh.sector_node is not None
        places = (int(mesh.sector.max()) + 1) * run.n_snapshots
        return mesh.sector_node[node], mesh.sector_node[node], around / places
    if not run.is_solid:
        return np.zeros(len(node), dtype=np.int64), node, around / len(mesh.boundary)
    across = mesh.coordinates[:, 2]
    step = SAME * float(np.ptp(across))
    rows = len(np.unique(np.round(across[mesh.boundary] / step)))
    lines = np.unique(np.round(across[node] / step), return_inverse=True)[1]
    return lines, node, around * rows / len(mesh.boundary)


def _passing(run: Any, time: float) -> tuple[float, float]:
    """Speed at which the tread passes its footprint [m/s], and 1 for a wheel that rolls forth, -1 back."""
    if run.is_steady:
        spin = run.spin
    elif run.n_snapshots > 1:
        k = min(max(int(np.searchsorted(run.times, time)), 1), run.n_snapshots - 1)
        spin = -float(run.angle[k] - run.angle[k - 1]) / float(run.times[k] - run.times[k - 1])
    else:
        spin = 0.0
    speed = abs(spin) * run.outer_radius
    if speed == 0.0:
        raise Error(f"{run.directory}: the wheel does not turn at {time:g} s, so that nothing passes the "
                    "footprint: a flash temperature is of a surface that passes")
    return speed, 1.0 if spin > 0 else -1.0


def _demand_fast(run: Any, ahead: Array, speed: float, heat: Heat) -> None:
    half = 0.5 * float(np.ptp(ahead))
    peclet = speed * half / (2 * heat.diffusivity)
    if peclet < LEAST_PECLET:
        raise Error(f"{run.directory}: the surface passes {2e3 * half:g} mm at {speed:g} m/s, a Péclet number "
                    f"of {peclet:.2g}: below {LEAST_PECLET:g} heat also flows along the surface, which the "
                    "formula leaves out; a faster wheel, or a material that conducts less")

# SPDX-License-Identifier: BSD-3-Clause
"""What tyres do over load and pressure, as a measured one did: does a rig show the same?

Measured: Hoosier 43075 16x7.5-10 on a rim of 7 in at 40 km/h, Calspan, data of the FSAE Tire Test Consortium as
published in github.com/teasit/magic-formula-tyre-library; straight lines through slip angles below 1 degree, camber 0.
A racing tyre of 10 in: its trends are what counts, not its values."""
from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .points import Array, Columns, chosen, levels, nominal
from .slopes import cornering, load_deflection

if TYPE_CHECKING:
    from ..data.rig import Rig

LEAST = 3  # loads of a curve whose bend counts


@dataclass(frozen=True)
class Trend:
    """A statement on tyres."""

    name: str
    measured: str
    found: str         # what the rig says
    holds: bool | None  # None: the rig does not say it


def trends(rig: Rig) -> list[Trend]:
    """All that are known, with the numbers of a rig beside those of the measured tyre."""
    turned, stands = cornering(rig), load_deflection(rig)
    upright = _ordered(chosen(turned, np.isclose(turned["pressure"], nominal(rig, "pressure", turned["pressure"]), rtol=1e-6)),
                       "load")
    return [_concave(upright), _softer_with_pressure(turned), _trail(upright), _radial(stands)]


def _concave(one: Columns) -> Trend:
    """The chords from no load on at the nominal pressure: each is less steep than the one before."""
    stiffness = 1e-3 * np.radians(one["stiffness"])
    holds = None if len(stiffness) < LEAST else bool((np.diff(_chords(one["load"], stiffness)) < 0).all())
    return Trend("Cornering stiffness grows ever less with the load",
                 "0.319, 0.530, 0.686, 0.832 kN/° at 0.48, 1.07, 1.60, 2.71 kN and 69 kPa",
                 _told(stiffness, "kN/°", 1e-3 * one["load"], "kN") + _air(one), holds)


def _softer_with_pressure(found: Columns) -> Trend:
    """At the lowest load with several pressures."""
    one = _lowest_load(found)
    stiffness = 1e-3 * np.radians(one["stiffness"])
    at = f" and {1e-3 * one['load'][0]:.3g} kN" if len(stiffness) else ""
    return Trend("Cornering stiffness at a low load falls with the pressure", "0.319, 0.300, 0.263 kN/° at 69, 83, 97 kPa and 0.48 kN",
                 _told(stiffness, "kN/°", 1e-3 * one["pressure"], "kPa") + at, _falls(stiffness))


def _trail(upright: Columns) -> Trend:
    one = chosen(upright, np.isfinite(upright["trail"]))
    return Trend("Pneumatic trail grows with the load", "22, 29, 34, 49 mm at 0.48, 1.07, 1.60, 2.71 kN and 69 kPa",
                 _told(1e3 * one["trail"], "mm", 1e-3 * one["load"], "kN") + _air(one), _falls(-one["trail"]))


def _radial(curves: dict[float, Columns]) -> Trend:
    """The slopes at the load in the middle of those that all pressures have."""
    least = max((one["load"].min() for one in curves.values()), default=np.nan)
    most = min((one["load"].max() for one in curves.values()), default=np.nan)
    load = 0.5 * (least + most)
    slopes = np.array([np.interp(load, one["load"], one["stiffness"]) for one in curves.values()]) if load > 0 else np.empty(0)
    at = f" and {1e-3 * load:.3g} kN" if len(slopes) else ""
    return Trend("Radial stiffness grows with the pressure", "197, 236 N/mm at 69, 97 kPa",
                 _told(1e-3 * slopes, "N/mm", 1e-3 * np.array(list(curves)[:len(slopes)]), "kPa") + at, _falls(-slopes))


def _chords(x: Array, y: Array) -> Array:
    return np.asarray(np.diff(y, prepend=0.0) / np.diff(x, prepend=0.0))


def _falls(values: Array) -> bool | None:
    return None if len(values) < 2 or not np.isfinite(values).all() else bool((np.diff(values) < 0).all())


def _lowest_load(found: Columns) -> Columns:
    for load in levels(found["load"]):
        one = chosen(found, np.isclose(found["load"], load, rtol=1e-6))
        if len(levels(one["pressure"])) > 1:
            return _ordered(one, "pressure")
    return chosen(found, np.zeros(len(found["load"]), dtype=bool))


def _ordered(found: Columns, name: str) -> Columns:
    return chosen(found, np.argsort(found[name]))


def _air(one: Columns) -> str:
    return f" and {1e-3 * one['pressure'][0]:.3g} kPa" if len(one["pressure"]) and one["pressure"][0] else ""


def _told(values: Array, unit: str, places: Sequence[float] | Array, place_unit: str) -> str:
    if not len(values):
        return "no points"
    return (f"{', '.join(f'{value:.4g}' for value in values)} {unit} at {', '.join(f'{place:.3g}' for place in places)} "
            f"{place_unit}").replace("-", "−")

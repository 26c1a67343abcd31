# SPDX-License-Identifier: BSD-3-Clause
"""Units in files of others, and what they are in SI."""
from __future__ import annotations

import difflib
import math
from dataclasses import dataclass

POUND_FORCE, INCH, PSI = 4.4482216152605, 0.0254, 6894.757293168361  # N, m, Pa: exact or to the last digit


@dataclass(frozen=True)
class Unit:
    """A number times `factor` is in `si`."""

    si: str
    factor: float


_TURN = 2 * math.pi
_TABLE: dict[str, dict[str, float]] = {
    "1": {"1": 1.0, "-": 1.0, "": 1.0, "%": 0.01},
    "s": {"s": 1.0, "sec": 1.0, "ms": 1e-3, "min": 60.0, "h": 3600.0},
    "m": {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "km": 1e3, "in": INCH, "inch": INCH, "ft": 12 * INCH},
    "m/s": {"m/s": 1.0, "mm/s": 1e-3, "km/h": 1 / 3.6, "kph": 1 / 3.6, "mph": 1609.344 / 3600},
    "m/s2": {"m/s2": 1.0, "m/s^2": 1.0, "m/s**2": 1.0},
    "rad": {"rad": 1.0, "deg": math.pi / 180, "\u00b0": math.pi / 180},
    "rad/s": {"rad/s": 1.0, "deg/s": math.pi / 180, "\u00b0/s": math.pi / 180, "1/min": _TURN / 60, "rpm": _TURN / 60,
              "U/min": _TURN / 60},
    "N": {"N": 1.0, "kN": 1e3, "daN": 10.0, "lbf": POUND_FORCE},
    "N m": {"Nm": 1.0, "N m": 1.0, "N*m": 1.0, "kNm": 1e3, "Nmm": 1e-3},
    "Pa": {"Pa": 1.0, "hPa": 100.0, "kPa": 1e3, "bar": 1e5, "MPa": 1e6, "psi": PSI, "N/m2": 1.0, "N/m^2": 1.0,
           "N/mm2": 1e6, "N/mm^2": 1e6},
    "N/m": {"N/m": 1.0, "N/mm": 1e3, "kN/m": 1e3},
    "N s/m": {"Ns/m": 1.0, "N s/m": 1.0, "Ns/mm": 1e3},
    "N m/rad": {"Nm/rad": 1.0, "Nm/deg": 180 / math.pi},
    "N/rad": {"N/rad": 1.0, "N/deg": 180 / math.pi},
    "kg": {"kg": 1.0},  # not g, which may be an acceleration
    "kg m2": {"kgm2": 1.0, "kg m2": 1.0, "kg*m2": 1.0, "kgm^2": 1.0, "kg*m^2": 1.0},
    "1/m": {"1/m": 1.0, "1/mm": 1e3},
    "Hz": {"Hz": 1.0, "1/s": 1.0},
    "W": {"W": 1.0, "kW": 1e3},
    "degC": {"degC": 1.0, "deg C": 1.0, "\u00b0C": 1.0}}  # stays: no multiple of a kelvin
UNITS: dict[str, Unit] = {name: Unit(si, factor) for si, row in _TABLE.items() for name, factor in row.items()}
_LOWER = {name.lower(): [other for other in UNITS if other.lower() == name.lower()] for name in UNITS}


def unit_named(name: str) -> Unit | None:
    """Of a unit as files write it, in another case too where that is no other unit; None: not known."""
    bare = " ".join(name.strip("[] \t").split())
    if bare in UNITS:
        return UNITS[bare]
    alike = _LOWER.get(bare.lower(), [])
    return UNITS[alike[0]] if len({UNITS[other] for other in alike}) == 1 else None


def near(name: str) -> str:
    """Known units that look like this one, for a message."""
    found = difflib.get_close_matches(name.strip(), UNITS, 3, 0.5)
    return ", ".join(found) if found else "N, Nm, deg, rad, %, m, mm, m/s, km/h, kPa, bar, s, rad/s, 1/min, -"

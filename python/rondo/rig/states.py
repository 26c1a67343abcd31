# SPDX-License-Identifier: BSD-3-Clause
"""What the test `vertical` found, which other tests begin with: heights and effective radii of free rolling."""
from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from ..data.errors import Error

Row = Mapping[str, Any]
Found = tuple[float, float] | str  # height and effective radius [m]; a text: why there are none


@dataclass(frozen=True)
class States:
    """`by_load`: by pressure (None: a wheel without air) and load, at the nominal speed. `by_speed`: at other speeds, under the
    nominal load and pressure. Nothing is interpolated: all loads and pressures of the rig are points of `vertical`."""

    by_load: Mapping[tuple[float | None, float], Found] = field(default_factory=dict)
    by_speed: Mapping[float, Found] = field(default_factory=dict)
    unit: str = "N"  # of loads

    def height(self, pressure: float | None, load: float) -> float:
        """m, of the center above the ground. @raise Error: that state failed."""
        return self._at(pressure, load)[0]

    def effective_radius(self, pressure: float | None, load: float) -> float:
        """m: speed over spin of free rolling. @raise Error: that state failed."""
        return self._at(pressure, load)[1]

    def at_speed(self, speed: float) -> tuple[float, float]:
        """Height and effective radius [m]. @raise Error: that state failed."""
        return _demand(self.by_speed.get(speed), f"at {speed:g} m/s, which failed")

    def _at(self, pressure: float | None, load: float) -> tuple[float, float]:
        air = "" if pressure is None else f" at {1e-3 * pressure:g} kPa"
        return _demand(self.by_load.get((pressure, load)), f"under {load:g} {self.unit}{air}, which the test vertical does not have")


def _demand(found: Found | None, which: str) -> tuple[float, float]:
    if isinstance(found, tuple):
        return found
    raise Error(f"this point begins with the height and the effective radius of free rolling {which}: "
                f"{found or 'it was not computed'}")


def states_of(rows: Iterable[Row], by_speed: Mapping[float, Found], unit: str) -> States:
    """Of the rows of `vertical`."""
    return States({(row["pressure"], row["load"]): (row["height"], row["effective_radius"]) if row["status"] == "done"
                   else str(row["reason"]) for row in rows}, by_speed, unit)

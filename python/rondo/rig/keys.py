# SPDX-License-Identifier: BSD-3-Clause
"""The keys of a rig file: what the tests of the rig vary, with units, bounds and meanings."""
from __future__ import annotations

import sys
from dataclasses import dataclass

from .plane import LEFT_OUT
from .units import of_width

MOST = sys.float_info.max
NUMBER, NUMBERS, COUNT, TEXT = "a number", "a list of numbers", "a whole number", "a text"
ALL, PLANE, SPACE = "all wheels", "plane wheels", "wheels in three dimensions"


@dataclass(frozen=True)
class Key:
    name: str
    kind: str     # one of the four above
    unit: str     # "1" without dimension
    meaning: str
    low: float = float("-inf")
    high: float = float("inf")
    above: bool = False  # `low` itself is not allowed
    wheels: str = ALL    # that have it

    def contains(self, value: float) -> bool:
        """Within the bounds. Infinite numbers, NaN and whole numbers beyond all floats are not."""
        return max(self.low, -MOST) <= value <= min(self.high, MOST) and not (self.above and value == self.low)

    def allowed(self, per_metre: bool = False) -> str:
        """In words, for messages."""
        bounds = []
        if self.low > float("-inf"):
            bounds.append(f"{'>' if self.above else '>='} {self.low:g}")
        if self.high < float("inf"):
            bounds.append(f"<= {self.high:g}")
        unit = "" if self.unit == "1" else f" in {of_width(self.unit, per_metre)}"
        return f"{self.kind}{unit}{', ' if bounds else ''}{' and '.join(bounds)}"


def _angles(name: str, meaning: str) -> Key:
    return Key(name, NUMBERS, "degrees", meaning, -44.0, 44.0, wheels=SPACE)


def _ratios(name: str, meaning: str, wheels: str = ALL) -> Key:
    return Key(name, NUMBERS, "1", meaning, -0.9, 0.9, wheels=wheels)


TOP = "at the top"
LEAST_LOAD, LEAST_PRESSURE = 20.0, 1e4  # N, Pa: less is taken for kN and bar
MOST_LOAD, MOST_PRESSURE = 1e8, 1e7     # N, Pa: a hundred times those of the largest tyres
LEAST_SPEED, MOST_SPEED = 0.5, 500.0    # m/s: of runs in time, which would take hours; of any wheel
MOST_FRICTION = 100.0                   # as in a case
MOST_DAMPING = 500.0                    # 1/s: critical at 40 Hz
LEAST_WIDTH, MOST_WIDTH = 1e-3, 5.0     # m: more is taken for mm
_LOADS = Key("loads", NUMBERS, "N", "loads of the ground on the wheel", LEAST_LOAD, MOST_LOAD)
_PRESSURES = Key("pressures", NUMBERS, "Pa", "pressures of the air; the nominal one is added", LEAST_PRESSURE, MOST_PRESSURE)
_CAMBERS = _angles("cambers_deg", "inclination angles of ISO 8855: > 0 leans the top of the wheel to the right")
_ANGLES = _angles("slip_angles_deg", "slip angles of ISO 8855: > 0 moves the wheel to the left of its heading")
_RATIOS = _ratios("slip_ratios", "slip ratios of ISO 8855: < 0 brakes")
_SPEEDS = Key("speeds", NUMBERS, "m/s", "speeds", 0.0, MOST_SPEED, above=True)
_IN_TIME = Key("speeds", NUMBERS, "m/s", "speeds", LEAST_SPEED, MOST_SPEED)
_MODES = Key("modes", COUNT, "1", "modes of the reduced wheel", 10, 600)
_DAMPING = Key("mass_damping", NUMBER, "1/s", "damping.mass of these runs: 25 is 5 % of critical damping at 40 Hz", 0.0, MOST_DAMPING)

TABLES: dict[str, tuple[Key, ...]] = {
    TOP: (
        Key("schema", COUNT, "1", "version of the format of rig files", 1, 1),
        Key("load", NUMBER, "N", "nominal load, of tests with one load", LEAST_LOAD, MOST_LOAD),
        Key("pressure", NUMBER, "Pa", "nominal pressure of the air", LEAST_PRESSURE, MOST_PRESSURE),
        Key("width", NUMBER, "m", "width that multiplies the forces of a plane wheel; without it they are per metre of width",
            LEAST_WIDTH, MOST_WIDTH, wheels=PLANE),
        Key("speed", NUMBER, "m/s", "the wheel turns at this speed over its unloaded radius", LEAST_SPEED, MOST_SPEED),
        Key("friction", NUMBER, "1", "coefficient of friction, in place of that of the case", 0.0, MOST_FRICTION, above=True),
        Key("sectors", COUNT, "1", "columns of elements around the wheel", 12, 2000),
        Key("samples_per_sector", COUNT, "1", "samples of steady rolling in the pass of a sector", 1, 16),
        _LOADS, _PRESSURES, _CAMBERS),
    "vertical": (_LOADS, _PRESSURES),
    "footprint": (_LOADS, _CAMBERS),
    "longitudinal": (
        _LOADS, _PRESSURES, _RATIOS, _ratios("few_slip_ratios", "slip ratios at pressures that are not the nominal one", SPACE)),
    "lateral": (
        _LOADS, _PRESSURES, _CAMBERS, _ANGLES,
        _angles("few_slip_angles_deg", "slip angles at pressures that are not the nominal one, and with camber")),
    "combined": (_LOADS, _ANGLES, _RATIOS),
    "rolling-resistance": (_LOADS, _PRESSURES, _SPEEDS),
    "relaxation": (
        _LOADS, Key("slip_angle_step_deg", NUMBER, "degrees", "step of the slip angle", 0.001, 5.0, wheels=SPACE),
        Key("slip_ratio_step", NUMBER, "1", "step of the slip ratio", 1e-5, 0.1),
        Key("distance", NUMBER, "m", "distance rolled after a step", 0.01, 100.0),
        Key("mass_damping", NUMBER, "1/s", "damping.mass of these runs in time: 100 is 9 % of critical damping at 90 Hz", 0.0,
            wheels=PLANE)),
    "cleat": (_IN_TIME, Key("height", NUMBER, "m", "height of the cleat; its ramps are of 45 degrees, or as flat as the mesh needs", 0.0, 0.1, above=True),
              Key("length", NUMBER, "m", "length of its top along the way", 0.0, 1.0, above=True), _MODES, _DAMPING),
    "modes": (Key("count", COUNT, "1", "modes of the free wheel, and of the standing one of wheels in three dimensions", 1, 400),),
    "road": (Key("length", NUMBER, "m", "length of road that is rolled over; its first meter is not measured", 2.0, 1000.0),
             Key("roughness", NUMBER, "m3", "displacement spectrum of the road at 0.1 cycles a metre, as in ISO 8608: "
                 "1.6e-5 is the middle of class A, 6.4e-5 of B", 0.0, 0.1, above=True),
             Key("seed", COUNT, "1", "seed of the road", 0, 2**31), _IN_TIME, _MODES, _DAMPING),
}
TESTS = tuple(name for name in TABLES if name != TOP)


def tables_of(wheels: str) -> dict[str, tuple[Key, ...]]:
    """The keys that these wheels have; tests without any are not theirs."""
    found = {table: tuple(key for key in keys if key.wheels in (ALL, wheels)) for table, keys in TABLES.items()}
    return {table: keys for table, keys in found.items() if wheels == SPACE or table not in LEFT_OUT}

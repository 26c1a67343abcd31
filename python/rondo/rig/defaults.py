# SPDX-License-Identifier: BSD-3-Clause
"""What a rig file leaves out: loads and pressures as multiples of those of the case, slips, speeds."""
from __future__ import annotations

from ..data.errors import InputError
from .keys import LEAST_SPEED, TABLES, TOP, Key, tables_of
from .settings import Settings, Values, is_per_metre
from .tyre import Tyre
from .units import of_width

FEWEST = 60  # sectors that a footprint needs


def nominal(tyre: Tyre, given: Settings, quick: bool) -> Values:
    """The values at the top that need no run: load, pressure, friction, sectors, samples.
    @raise InputError: neither the case nor the rig file says a load or a speed."""
    top = given[TOP]
    values: Values = {"schema": 1, "load": _load_of(tyre, top), "pressure": tyre.pressure, "friction": tyre.friction,
                      "sectors": _coarser(tyre.sectors) if quick and not tyre.is_plane else tyre.sectors,
                      "samples_per_sector": _samples_of(tyre, quick), **top}
    if tyre.has_tread and values["sectors"] != tyre.sectors:
        raise InputError(f"{tyre.path}: has a tread of {tyre.sectors} pitches, and the rig file has sectors = {values['sectors']} "
                         "(allowed: leave sectors out; disk.tread.pitches of the case)")
    for key, unit, there in (("load", "1.0e5 in N/m, or width and load in N," if tyre.is_plane else "4000.0",
                              "no analysis.load above 0, and no rim.force_y below 0 at its end"),
                             ("speed", "13.7", "no motion.angular_velocity above 0")):
        if key not in values or values[key] is None:
            if key == "speed" and tyre.spin is not None:
                continue
            raise InputError(f"{tyre.path}: has {there}, and the rig needs it: give {key} = {unit} in a rig file (--rig)")
    _demand_bounds(tyre, top, values)
    if values["friction"] == 0.0:
        raise InputError(f"{tyre.path}: has no ground.friction, and without it there is no force over slip: give friction = 0.9 "
                         "in a rig file (--rig)")
    if not tyre.has_air and ("pressure" in top or any("pressures" in one for one in given.values())):
        raise InputError(f"{tyre.path}: has no [inflation], and the rig file varies its pressure: leave pressures out")
    return values


def with_defaults(tyre: Tyre, given: Settings, quick: bool, radius: float) -> Settings:
    """All values of all tests. `radius`: of the wheel without load [m]."""
    top = nominal(tyre, given, quick)
    load, pressure = float(top["load"]), top["pressure"]
    if "speed" not in top:
        top["speed"] = _short((tyre.spin or 0.0) * radius)
    if not _key("speed").contains(top["speed"]):
        why = ", at which cleat and road would take hours" if top["speed"] < LEAST_SPEED else ""
        raise InputError(f"{tyre.path}: motion.angular_velocity: {tyre.spin or 0.0:g} rad/s are {top['speed']:g} m/s{why} (allowed: "
                         f"{_key('speed').allowed()}; or speed = 13.7 in a rig file, --rig)")
    top.setdefault("loads", _times(load, (0.5, 1.0, 1.5) if quick else (0.5, 0.75, 1.0, 1.5)))
    top.setdefault("pressures", _times(pressure, (0.8, 1.0) if quick else (0.8, 1.0, 1.2)) if pressure else [])
    top.setdefault("cambers_deg", [0.0, 3.0] if quick else [-3.0, 0.0, 3.0])
    settings: Settings = {TOP: top}
    tables = tables_of(tyre.wheels)
    for name, defaults in _of_tests(top, quick, radius, tyre.is_plane).items():
        if name in tables:
            settings[name] = defaults | given.get(name, {})
    for values in settings.values():  # tests compare with these
        for key, always in (("pressures", pressure), ("cambers_deg", 0.0)):
            if key in values and always is not None:
                values[key] = _united([values[key], [always]])
    for key in ("slip_angles_deg", "few_slip_angles_deg") if "lateral" in settings else ():
        settings["lateral"][key] = _united([settings["lateral"][key], [0.0]])
    for key in ("loads", "pressures"):  # other tests begin with its heights and radii
        settings["vertical"][key] = _united([one[key] for one in settings.values() if key in one] + [[load]] * (key == "loads"))
    return {table: {key.name: settings[table][key.name] for key in keys if settings[table].get(key.name) not in (None, [])}
            for table, keys in tables.items()}


def _key(name: str) -> Key:
    """One at the top of a rig file."""
    return next(key for key in TABLES[TOP] if key.name == name)


def _demand_bounds(tyre: Tyre, top: Values, values: Values) -> None:
    """The case is held to the bounds of a rig file."""
    per_metre = is_per_metre(tyre.wheels, top)
    for name, where in (("load", tyre.says_load), ("pressure", "inflation.pressure")):
        value, key = values[name], _key(name)
        if name not in top and value is not None and not key.contains(value):
            raise InputError(f"{tyre.path}: {where}: {value:g} {of_width(key.unit, per_metre)} (allowed: {key.allowed(per_metre)}; or another "
                             f"{name} in a rig file, --rig)")


def _load_of(tyre: Tyre, top: Values) -> float | None:
    """N of the case, in the unit of the rig file."""
    return tyre.load * float(top.get("width", 1.0)) if tyre.load is not None else None


def _samples_of(tyre: Tyre, quick: bool) -> int:
    return min(tyre.samples, 4) if quick else tyre.samples


def _coarser(sectors: int) -> int:
    """Half as many, as long as a footprint still has some columns."""
    return max(min(sectors, FEWEST), sectors // 2)


def _united(lists: list[list[float]]) -> list[float]:
    return sorted({value for one in lists for value in one})


def _short(value: float) -> float:
    """To six digits, so that a file that says it is short."""
    return float(f"{value:.6g}")


def _times(value: float, factors: tuple[float, ...]) -> list[float]:
    return [value if factor == 1.0 else _short(value * factor) for factor in factors]


def _speeds(speed: float, factors: tuple[float, ...]) -> list[float]:
    return [one for one in _times(speed, factors) if _key("speed").contains(one)]


def _of_tests(top: Values, quick: bool, radius: float, is_plane: bool) -> Settings:
    loads, pressures, load, speed = top["loads"], top["pressures"], top["load"], top["speed"]
    of_loads = {"loads": loads, "pressures": pressures}
    vertical = (0.25, 0.5, 1.0, 1.5) if quick else (0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75, 2.0)
    speeds = _speeds(speed, (1.0, 2.0) if quick else (0.5, 1.0, 1.5, 2.0))
    return {
        "vertical": {"loads": _times(load, vertical), "pressures": pressures},
        "footprint": {"loads": [load] if quick else loads, "cambers_deg": [0.0] if quick else [0.0, 3.0]},
        "longitudinal": {
            **of_loads,
            "slip_ratios": [-0.1, -0.03, -0.01, 0.01, 0.03, 0.1] if quick else
            [-0.2, -0.14, -0.1, -0.07, -0.045, -0.03, -0.02, -0.01, 0.01, 0.02, 0.03, 0.045, 0.07, 0.1],
            "few_slip_ratios": [-0.05, -0.01, 0.01] if quick else [-0.1, -0.04, -0.01, 0.01, 0.04]},
        "lateral": {
            **of_loads, "cambers_deg": top["cambers_deg"],
            "slip_angles_deg": [-8.0, -3.0, -1.0, 0.0, 1.0, 3.0, 8.0] if quick else
            [-12.0, -8.0, -5.0, -3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0, 5.0, 8.0, 12.0],
            "few_slip_angles_deg": [-4.0, -1.0, 0.0, 1.0, 4.0] if quick else [-8.0, -4.0, -1.0, 0.0, 1.0, 4.0, 8.0]},
        "combined": {"loads": [load] if quick else [loads[0], loads[-1]],
                     "slip_angles_deg": [-4.0, 2.0] if quick else [-5.0, -2.0, 2.0, 5.0],
                     "slip_ratios": [-0.06, 0.02] if quick else [-0.14, -0.07, -0.03, 0.03, 0.07]},
        "rolling-resistance": {**of_loads, "speeds": speeds},
        "relaxation": {"loads": [load] if quick else loads, "slip_angle_step_deg": 0.1,
                       "slip_ratio_step": 0.005 if is_plane else 0.001,  # steps in time need a larger one
                       "distance": _short(6.0 * radius), "mass_damping": 100.0},
        "cleat": {"speeds": [speed] if quick else _speeds(speed, (0.5, 1.0, 2.0)), "height": 0.01, "length": 0.02,
                  "modes": 60 if quick else 200, "mass_damping": 25.0},
        "modes": {"count": 6 if quick else 20},
        "road": {"length": 4.0 if quick else 20.0, "roughness": 1.6e-5, "seed": 1, "speeds": [speed],
                 "modes": 60 if quick else 200, "mass_damping": 25.0}}

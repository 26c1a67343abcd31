# SPDX-License-Identifier: BSD-3-Clause
"""Figures of merit of the tests, from their rows, in SI and with the signs of ISO 8855."""
from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from .blocks import Bench
from .rows import done, those
from .states import Row

Found = dict[str, list[dict[str, Any]]]
_LARGE_RIPPLE, _OTHER_LOAD = 0.05, 0.1  # of the load
_LARGE_SHARE = 0.05  # of the discretisation in the power, above which rondo warns


def find(bench: Bench, test: str, rows: Sequence[Row]) -> Found:
    """{} of tests without any, or without points."""
    finder = _FINDERS.get(test)
    return {name: values for name, values in finder(bench, rows).items() if values} if finder else {}


def _vertical(bench: Bench, rows: Sequence[Row]) -> Found:
    """Slopes of the load over the deflection."""
    stiffness = []
    for pressure in sorted({row["pressure"] for row in done(rows)}, key=lambda p: p or 0.0):
        curve = sorted((row["load"], row["deflection"]) for row in done(rows, pressure=pressure))
        loads, depths = np.array(curve).T
        if len(loads) > 1:
            slopes = np.gradient(loads, depths)
            stiffness += [{"pressure": pressure, "load": float(load), "value": float(slope)} for load, slope in zip(loads, slopes)]
    radii = [{"load": row["load"], "pressure": row["pressure"], "value": row["effective_radius"]} for row in done(rows)]
    return {"radial_stiffness": stiffness, "effective_radius": radii}


def _lateral(bench: Bench, rows: Sequence[Row]) -> Found:
    """Cornering stiffness by the solver's slope; trail from the moment's difference to both sides of straight rolling."""
    straight = [row for row in done(rows, camber=0.0, slip_angle=0.0) if not row.get("mirrored")]
    mirrored = {row["load"]: row for row in done(rows, mirrored=1)}
    merits: Found = {name: [] for name in ("cornering_stiffness", "pneumatic_trail", "ply_steer_force", "conicity_force")}
    for row in straight:
        at = {"load": row["load"], "pressure": row["pressure"]}
        merits["cornering_stiffness"].append({**at, "value": row["cornering_stiffness"]})
        if (trail := _trail(those(rows, camber=0.0, load=row["load"], pressure=row["pressure"]))) is not None:
            merits["pneumatic_trail"].append({**at, "value": trail})
        if (other := mirrored.get(row["load"])) is not None and row["pressure"] == bench.pressure:
            merits["ply_steer_force"].append({**at, "value": 0.5 * (row["Fy"] - other["Fy"])})
            merits["conicity_force"].append({**at, "value": 0.5 * (row["Fy"] + other["Fy"])})
    return merits


def _trail(rows: Sequence[Row]) -> float | None:
    """m: minus the moment's over the force's difference between the smallest slip angles of both signs."""
    pair = _smallest([row for row in rows if not row.get("mirrored")], "slip_angle")
    return None if pair is None else float(-(pair[1]["Mz"] - pair[0]["Mz"]) / (pair[1]["Fy"] - pair[0]["Fy"]))


def _smallest(rows: Sequence[Row], slip: str) -> tuple[Row, Row] | None:
    """Those with the smallest slips below and above 0. None: there are none, or one of them failed: a slope over the next larger
    slip would be that of a contact that slides more."""
    below = max((row for row in rows if row[slip] < 0.0), key=lambda row: row[slip], default=None)
    above = min((row for row in rows if row[slip] > 0.0), key=lambda row: row[slip], default=None)
    if below is None or above is None or not done([below]) or not done([above]):
        return None
    return below, above


def _longitudinal(bench: Bench, rows: Sequence[Row]) -> Found:
    """Difference over the smallest slip ratios of both signs."""
    stiffness = []
    for load, pressure in sorted({(row["load"], row["pressure"]) for row in done(rows)}, key=str):
        if (pair := _smallest(those(rows, load=load, pressure=pressure), "slip_ratio")) is not None:
            brakes, drives = pair
            value = (drives["Fx"] - brakes["Fx"]) / (drives["slip_ratio"] - brakes["slip_ratio"])
            stiffness.append({"load": load, "pressure": pressure, "value": float(value)})
    return {"slip_stiffness": stiffness}


def _rolling_resistance(bench: Bench, rows: Sequence[Row]) -> Found:
    return {"coefficient": [{"load": row["load"], "pressure": row["pressure"], "speed": row["speed"], "value": row["coefficient"]}
                            for row in done(rows)]}


def doubt_of(name: str, rows: Sequence[Row]) -> str:
    """What is to be known of the rows of a test before they are used; "": nothing."""
    if name in ("cleat", "road"):
        return _doubt_of_courses(name, done(rows))
    share = max((abs(row.get("scheme_share") or 0.0) for row in done(rows)), default=0.0)
    if name != "rolling-resistance" or share <= _LARGE_SHARE:
        return ""
    return (f"the discretisation takes up to {100 * share:.0f} % of the power, and resistances may be wrong by as much: "
            "try another samples_per_sector, larger ones first, or more sectors")


def _doubt_of_courses(name: str, rows: Sequence[Row]) -> str:
    """What is in the forces before the cleat or the road: another load than the one asked for, and a swing."""
    said = []
    ripple = max((row["ripple_Fz"] / row["load"] for row in rows), default=0.0)
    apart = max((abs(row["mean_Fz"] / row["load"] - 1.0) for row in rows), default=0.0)
    if ripple > _LARGE_RIPPLE:
        said.append(f"before the {name} the vertical force swings by up to {100 * ripple:.0f} % of the load (standard deviation), as nodes pass the "
                    "contact, and peaks and rms contain this swing: try more sectors")
    if apart > _OTHER_LOAD:
        said.append(f"at the height of the load the reduced wheel has a vertical force that differs from it by up to {100 * apart:.0f} %: try "
                    "more modes")
    return "; ".join(said)


def _relaxation(bench: Bench, rows: Sequence[Row]) -> Found:
    return {"length": [{"load": row["load"], "pressure": row["pressure"], "step": row["step"],
                        "value": row["relaxation_length_63"]} for row in done(rows)]}


def _cleat(bench: Bench, rows: Sequence[Row]) -> Found:
    return {f"peak_to_peak_{name}": _at_speeds(rows, f"peak_to_peak_{name}") for name in ("Fx", "Fz")}


def _road(bench: Bench, rows: Sequence[Row]) -> Found:
    return {f"rms_{name}": _at_speeds(rows, f"rms_{name}") for name in ("Fx", "Fz")}


def _at_speeds(rows: Sequence[Row], name: str) -> list[dict[str, Any]]:
    return [{"load": row["load"], "pressure": row["pressure"], "speed": row["speed"], "value": row[name]} for row in done(rows)]


def _modes(bench: Bench, rows: Sequence[Row]) -> Found:
    def first(standing: int) -> list[dict[str, Any]]:
        return [{**({"load": row["load"]} if standing else {}), "pressure": row["pressure"], "value": row["frequency"]}
                for row in done(rows, standing=standing, mode=1)]

    return {f"first_frequency_{name}": first(standing) for name, standing in (("free", 0), ("standing", 1))}


_FINDERS: Mapping[str, Callable[[Bench, Sequence[Row]], Found]] = {
    "vertical": _vertical, "lateral": _lateral, "longitudinal": _longitudinal, "rolling-resistance": _rolling_resistance,
    "relaxation": _relaxation, "cleat": _cleat, "road": _road, "modes": _modes}

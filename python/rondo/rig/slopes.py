# SPDX-License-Identifier: BSD-3-Clause
"""Slopes that a rig's points give over load and pressure: radial, cornering and slip stiffness, pneumatic trail."""
from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .points import Array, Columns, chosen, levels, points

if TYPE_CHECKING:
    from ..data.rig import Rig

SMALL_ANGLE, SMALL_SLIP = np.radians(1.01), 0.0101  # up to which forces are taken as straight lines
UPRIGHT = np.radians(0.1)
NAMES = ("load", "pressure", "stiffness", "trail")


def load_deflection(rig: Rig) -> dict[float, Columns]:
    """By pressure: deflection, load and stiffness, the slope of the curve, of the upright wheel."""
    found = points(rig, "vertical", ("load", "pressure", "camber", "deflection"))
    found = chosen(found, np.isfinite(found["deflection"]) & ~(np.abs(found["camber"]) > UPRIGHT))
    curves = {}
    for pressure in levels(found["pressure"]):
        one = chosen(found, np.isclose(found["pressure"], pressure, rtol=1e-6))
        order = np.argsort(one["load"])
        load, depth = one["load"][order], one["deflection"][order]
        slope = np.gradient(load, depth) if len(load) > 1 else np.full(len(load), np.nan)
        curves[float(pressure)] = {"deflection": depth, "load": load, "stiffness": slope}
    return curves


def cornering(rig: Rig) -> Columns:
    """By load and pressure of the upright wheel: stiffness -dF_y/dalpha > 0 in N/rad and trail -dM_z/dF_y in m: the
    figures of merit in rig.json, or the straight lines through the points of small slip angles."""
    found = _merits(rig, "lateral", "cornering_stiffness", "pneumatic_trail")
    return _slopes(rig, "lateral", "slip_angle", SMALL_ANGLE) if found is None else found


def slip_stiffness(rig: Rig) -> Columns:
    """By load and pressure of the upright wheel: stiffness dF_x/dkappa in N, in the same way."""
    found = _merits(rig, "longitudinal", "slip_stiffness")
    return _slopes(rig, "longitudinal", "slip_ratio", SMALL_SLIP) if found is None else found


def _merits(rig: Rig, test: str, stiffness: str, trail: str = "") -> Columns | None:
    """None: rig.json does not have this figure of merit."""
    found = rig.figures.get(test, {})
    rows = found.get(stiffness)
    if rows is None:
        return None
    trails = {(one["load"], one["pressure"]): one["value"] for one in found.get(trail, [])}
    values = [(one["load"], one["pressure"] or 0.0, abs(one["value"]), trails.get((one["load"], one["pressure"]), np.nan))
              for one in rows if one["value"] is not None]
    return dict(zip(NAMES, np.array(values, dtype=float).reshape(-1, len(NAMES)).T))


def _slopes(rig: Rig, test: str, along: str, small: float) -> Columns:
    found = points(rig, test, ("load", "pressure", "camber", along, "Fx", "Fy", "Mz"))
    found = chosen(found, (np.abs(found[along]) <= small) & ~(np.abs(found["camber"]) > UPRIGHT))
    rows: list[tuple[float, float, float, float]] = []
    for load in levels(found["load"]):
        for pressure in levels(found["pressure"]):
            one = chosen(found, np.isclose(found["load"], load, rtol=1e-6) & np.isclose(found["pressure"], pressure, rtol=1e-6))
            if len(levels(one[along])) < 2:
                continue
            force = _line(one[along], one["Fy"] if along == "slip_angle" else one["Fx"])
            moment = _line(one[along], one["Mz"])
            rows.append((load, pressure, -force if along == "slip_angle" else force, -moment / force if force else np.nan))
    return dict(zip(NAMES, np.array(rows).reshape(-1, 4).T))


def _line(x: Array, y: Array) -> float:
    there = np.isfinite(y)
    return float(np.polyfit(x[there], y[there], 1)[0]) if int(there.sum()) > 1 else float("nan")

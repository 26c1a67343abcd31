# SPDX-License-Identifier: BSD-3-Clause
"""Rows of the tables of the rig, from what its blocks wrote: a row for each point, also of those that failed."""
from __future__ import annotations

import csv
import math
import pathlib
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from ..data import axes
from ..data.errors import Error
from ..data.files import read_json
from ..data.plain_files import text_of
from ..data.run import Run, open_run
from ..data.sweep import open_sweep
from .blocks import MODES, RESULTS, SWEEP, Bench, Block, Point, ground_of
from .checks.step_size import demand_small, friction_of
from .plane.slip_step import slip_step_of
from .states import Row, States
from .time_tests import SETTLING, measured_from

DONE, FAILED = "done", "failed"
IN_PLANE, OUT_OF_PLANE = ("force_x", "force_y", "torque"), ("force_lateral", "moment_aligning", "moment_overturning")
FORCE_OF = {"slip-angle": "force_lateral", "slip-ratio": "force_x"}  # by the step


def rows_of_block(bench: Bench, states: States, block: Block, runs: pathlib.Path, failure: str) -> list[Row]:
    """@param failure: what the command said where it failed; "": it did not. Of a sweep that failed, the points that are done
    count; another command that failed has no results, whatever it wrote until then."""
    cannot = [_failed(p, "", why) for p, why in block.cannot]
    folder = runs / block.name / RESULTS
    where = f"runs/{block.name}/{RESULTS}"
    try:
        if failure and (block.kind != SWEEP or not (folder / "results.csv").exists()):
            raise Error(failure)
        return [*_rows(bench, states, block, folder, where, failure), *cannot]
    except (Error, KeyError, IndexError, TypeError, ValueError) as reason:
        said = failure or f"its results cannot be read: {_words(reason)}"
        return [*(_failed(p, where, said) for p in block.points), *cannot]


def _failed(p: Point, where: str, reason: str) -> Row:
    return {**_asked(p), "run": where, "status": FAILED, "reason": "; ".join(reason.splitlines())}


def _words(reason: Exception) -> str:
    return f"{reason} is missing" if isinstance(reason, KeyError) and not isinstance(reason, Error) else str(reason)


def _rows(bench: Bench, states: States, block: Block, folder: pathlib.Path, where: str, failure: str) -> Iterator[Row]:
    if block.kind == SWEEP:
        yield from _of_sweep(bench, states, block, folder, where, failure)
    elif block.kind == MODES:
        yield from _of_modes(block, folder, where)
    elif block.test in ("cleat", "road"):
        yield _of_history(bench, block, folder, where)
    elif block.test == "relaxation" and bench.tyre.is_plane:
        yield _step_in_time(block.points[0], open_run(folder), where)
    else:
        info = read_json(folder / "run.json")
        _demand_done(info)
        yield _relaxation(bench, block.points[0], info, where) if block.test == "relaxation" else \
            _of_steady(bench, states, block.points[0], info, where)


def _asked(p: Point) -> dict[str, Any]:
    return {"load": p.load, "pressure": p.pressure, "camber": p.camber, "slip_angle": p.slip_angle,
            "slip_ratio": p.slip_ratio, "speed": p.speed, **p.extra}


def _demand_done(info: Mapping[str, Any]) -> None:
    if info.get("status") != DONE:
        raise Error(str(info.get("message") or f'status "{info.get("status")}"'))


# Steady rolling

def _of_sweep(bench: Bench, states: States, block: Block, folder: pathlib.Path, where: str, failure: str
              ) -> Iterator[Row]:
    sweep = open_sweep(folder, unfinished=True)
    for k, p in enumerate(block.points):
        found = {name: sweep[name][k] for name in sweep.names}
        place = f"{where} {k + 1}"
        if found["status"] == DONE:
            yield _row(bench, states, p, found, place)
        else:
            reason = sweep.failures.get(k + 1) or failure or f"status {found['status']}"
            yield _failed(p, place, reason)


def _of_steady(bench: Bench, states: States, p: Point, info: Mapping[str, Any], where: str) -> Row:
    found = dict(info["steady"])
    in_contact = found["stick_length"] + found["slip_length"] if bench.tyre.is_plane else None
    found |= {"height_m": found["height"], "footprint_length_m": found.get("footprint_length"), "contact_length_m": in_contact,
              "footprint_width_m": found.get("footprint_width"), "pressure_mean_pa": found.get("pressure_mean"),
              "contact_area_m2": found.get("stick_area", 0.0) + found.get("slip_area", 0.0)}
    return _row(bench, states, p, found, where)


def free_radius(found: Mapping[str, Any], spin: float) -> float:
    """m: that of the slip ratio (w R - V) / max(|V|, |w R|) of a state, which is the wheel's without load."""
    slip, speed = float(found["slip_ratio"]), float(found["speed"])
    return speed / (1.0 - slip) / spin if slip >= 0.0 else speed * (1.0 + slip) / spin


def _row(bench: Bench, states: States, p: Point, found: Mapping[str, Any], where: str) -> Row:
    if bench.tyre.is_plane:
        length = float(found["contact_length_m"])
        found = {**found, **dict.fromkeys(OUT_OF_PLANE, 0.0), "footprint_length_m": length,
                 "pressure_mean_pa": float(found["force_y"]) / length, "rolling_resistance": bench.width * float(found["rolling_resistance"])}
    forces: dict[str, Any] = {name: bench.width * float(found[name]) for name in (*IN_PLANE, *OUT_OF_PLANE)}
    tyre = axes.convert(axes.own(**forces, height=found["height_m"], camber=-p.camber, slip_angle=-p.slip_angle), "iso-w")
    spin, ahead = bench.spin(p.speed), float(found["speed"]) * np.cos(p.slip_angle)
    free = p.slip_angle == 0.0 and p.camber == 0.0 and p.slip_ratio is None
    return {
        **_asked(p), "slip_ratio": 0.0 if free else _slip_ratio(states, p, spin, ahead), "speed": float(found["speed"]),
        "height": float(found["height_m"]), "deflection": free_radius({**found, "speed": ahead}, spin) - float(found["height_m"]),
        "effective_radius": ahead / spin if p.slip_ratio is None else None, "contact_length": found.get("footprint_length_m"),
        "contact_width": found.get("footprint_width_m"), "contact_area": found.get("contact_area_m2"),
        "mean_pressure": found.get("pressure_mean_pa"),
        **{name: float(getattr(tyre, name)) for name in ("Fx", "Fy", "Fz", "Mx", "My", "Mz")},
        "cornering_stiffness": found.get("cornering_stiffness"), "mirrored": p.extra.get("mirrored", 0), "resistance": found.get("rolling_resistance"),
        "coefficient": 1e3 * float(found["rolling_resistance"]) / p.load, "scheme_share": found.get("scheme_share"),
        "run": where, "status": DONE, "reason": ""}


def _slip_ratio(states: States, p: Point, spin: float, ahead: float) -> float | None:
    """By the effective radius of straight free rolling; None: that state failed. Forces do not depend on it."""
    try:
        return spin * states.effective_radius(p.pressure, p.load) / ahead - 1.0
    except Error:
        return None


def _relaxation(bench: Bench, p: Point, info: Mapping[str, Any], where: str) -> Row:
    name = FORCE_OF[p.extra["step"]]
    found = info["slip_step"][name]
    row = {**_asked(p), "run": where, "status": DONE, "reason": ""}
    try:
        _demand_small_step(bench, p, abs(float(found["after"]) - float(found["before"])), name)
    except Error as reason:
        return row | {"status": FAILED, "reason": str(reason)}
    if found["relaxation_length"] is None:
        return row | {"status": FAILED, "reason": f"{name} reaches {100.0 * found['share']:.0f} % of its change: roll farther "
                      "(relaxation.distance)"}
    return row | {"relaxation_length_63": found["relaxation_length"], "relaxation_length_fit": found["fitted_length"]}


def _demand_small_step(bench: Bench, p: Point, change: float, force: str) -> None:
    own = bench.settings["relaxation"]
    by_angle = p.extra["step"] == "slip-angle"
    slip = math.tan(math.radians(own["slip_angle_step_deg"])) if by_angle else own["slip_ratio_step"]
    carried = friction_of({"ground": ground_of(bench)}, slip * p.speed) * p.load
    step = f"slip angle, {own['slip_angle_step_deg']:g} degrees" if by_angle else f"slip ratio, {slip:g}"
    demand_small(change, carried, step, force, "slip_angle_step_deg" if by_angle else "slip_ratio_step")


# In time

def _step_in_time(p: Point, run: Run, where: str) -> Row:
    row = {**_asked(p), "run": where, "status": DONE, "reason": ""}
    try:
        found = slip_step_of(run)
    except Error as reason:
        return row | {"status": FAILED, "reason": str(reason)}
    return row | {"relaxation_length_63": found.length, "relaxation_length_fit": found.fitted}


def _of_history(bench: Bench, block: Block, folder: pathlib.Path, where: str) -> Row:
    """Peaks and rms of the ground's forces from the cleat or the road on; mean and standard deviation before them."""
    run, p = open_run(folder), block.points[0]
    time, along, up = (np.asarray(run.history[name]) for name in ("time_s", "force_x", "force_y"))
    piece, before = time >= measured_from(bench, block), (time >= 0.8 * SETTLING) & (time < SETTLING)
    if piece.sum() < 2:
        raise Error("the run ends before all of the contact is on the cleat or the road")
    along, up = bench.width * along, bench.width * up
    row = {**_asked(p), "mean_Fz": float(up[before].mean()), "ripple_Fz": float(up[before].std()),
           "run": where, "status": DONE, "reason": ""}
    if block.test == "cleat":
        return row | {"peak_to_peak_Fx": float(np.ptp(along[piece])), "peak_to_peak_Fz": float(np.ptp(up[piece]))}
    return row | {"rms_Fx": float(along[piece].std()), "rms_Fz": float(up[piece].std())}


def _of_modes(block: Block, folder: pathlib.Path, where: str) -> Iterator[Row]:
    p = block.points[0]
    for row in csv.DictReader(text_of(folder / "modes.csv").splitlines()):
        yield {**_asked(p), "mode": int(row["mode"]), "frequency": float(row["frequency_hz"]),
               "damping_ratio": float(row["damping_ratio"] or "nan"), "nodal_diameter": row["nodal_diameters"] or None,
               "run": where, "status": DONE, "reason": ""}


def done(rows: Sequence[Row], **wanted: Any) -> list[Row]:
    """Those that are done and have these values."""
    return those(rows, status=DONE, **wanted)


def those(rows: Sequence[Row], **wanted: Any) -> list[Row]:
    """Those that have these values."""
    return [row for row in rows if all(row.get(name) == value for name, value in wanted.items())]

# SPDX-License-Identifier: BSD-3-Clause
"""Directories of a tyre test rig, written by hand: forces of a Magic Formula with known coefficients."""
from __future__ import annotations

import csv
import itertools
import json
import pathlib
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import solids
from tyre_sets import appendix_3

from rondo import magic_formula
from rondo.data.tir import Tir

COLUMNS = ("load", "pressure", "camber", "slip_angle", "slip_ratio", "speed", "height", "deflection", "contact_length",
           "contact_width", "contact_area", "mean_pressure", "Fx", "Fy", "Fz", "Mx", "My", "Mz", "run", "status", "reason")
LOADS, PRESSURES, CAMBERS = (2000.0, 4000.0, 6000.0), (1.9e5, 2.2e5, 2.5e5), (-4.0, 0.0, 4.0)
LOAD, PRESSURE, SPEED = 4000.0, 2.2e5, 16.7
ANGLES = np.radians([-12, -8, -5, -3, -2, -1, 0, 1, 2, 3, 5, 8, 12])
SLIPS = np.array([-.3, -.15, -.1, -.06, -.03, -.01, 0, .01, .03, .06, .1, .15, .3])
RADIUS, SOFT, STIFF, BY_PRESSURE = 0.3135, 1.6e5, 1.2e6, 0.8  # m, N/m, N/m², 1 of the load over the deflection

Row = dict[str, Any]


def truth() -> Tir:
    """What is to be found again: coefficients that a fit finds, without those of M_x that it leaves."""
    return appendix_3().with_values({f"QSX{k}": 0.0 for k in range(4, 10)})


def states() -> dict[str, list[Row]]:
    """Settings of the points of lateral, longitudinal and combined slip."""
    settings = [(load, PRESSURE, 0.0) for load in LOADS] + \
        [(load, PRESSURE, np.radians(camber)) for load in LOADS for camber in CAMBERS if camber] + \
        [(load, pressure, 0.0) for load in LOADS for pressure in PRESSURES if pressure != PRESSURE]
    names = ("load", "pressure", "camber", "slip_angle", "slip_ratio", "speed")

    def rows(values: Iterable[Sequence[float]]) -> list[Row]:
        return [dict(zip(names, (*one, SPEED))) for one in values]

    both = itertools.product(LOADS, np.radians([-6, -3, 3, 6]), SLIPS[SLIPS != 0])
    return {"lateral": rows((*one, angle, 0.0) for one in settings for angle in ANGLES),
            "longitudinal": rows((*one, 0.0, slip) for one in settings for slip in SLIPS),
            "combined": rows((load, PRESSURE, 0.0, angle, slip) for load, angle, slip in both)}


def with_forces(rows: list[Row], tir: Tir) -> list[Row]:
    """The rows with the forces of these coefficients."""
    inputs = {name: np.array([row[name] for row in rows], dtype=float)
              for name in ("load", "pressure", "camber", "slip_angle", "slip_ratio", "speed")}
    forces = magic_formula.evaluate(tir, **inputs)
    channels = {name: getattr(forces, name) for name in ("Fx", "Fy", "Fz", "Mx", "My", "Mz")}
    return [row | {name: float(values[k]) for name, values in channels.items()} for k, row in enumerate(rows)]


def vertical() -> list[Row]:
    """The load is (SOFT x + STIFF x²) (1 + BY_PRESSURE dpi)."""
    rows = []
    for pressure, depth in itertools.product(PRESSURES, np.linspace(.005, .03, 6)):
        load = (SOFT * depth + STIFF * depth ** 2) * (1 + BY_PRESSURE * (pressure / PRESSURE - 1))
        rows.append({"load": load, "Fz": load, "pressure": pressure, "camber": 0.0, "deflection": depth,
                     "height": RADIUS - depth})
    return rows


def rolling_resistance(tir: Tir) -> list[Row]:
    """M_y of the coefficients, and a force as it follows."""
    rows = with_forces([{"load": load, "pressure": pressure, "camber": 0.0, "slip_angle": 0.0, "slip_ratio": 0.0,
                         "speed": speed} for load, pressure, speed in itertools.product(LOADS, PRESSURES, (8.0, 16.7, 30.0))],
                       tir)
    return [row | {"resistance": -row["My"] / RADIUS, "coefficient": -1e3 * row["My"] / RADIUS / row["load"]} for row in rows]


def all_tests(tir: Tir | None = None) -> dict[str, list[Row]]:
    """Rows of the tests that a Magic Formula gives, and of the standing wheel."""
    known = tir or truth()
    return {"vertical": vertical(), **{name: with_forces(rows, known) for name, rows in states().items()},
            "rolling-resistance": rolling_resistance(known)}


def write(directory: pathlib.Path, tests: Mapping[str, list[Row]], more: Mapping[str, Row] | None = None,
          settings: Mapping[str, Any] | None = None, **info: Any) -> pathlib.Path:
    """rig.json and a table for each test. more: what rig.json says of a test besides, and tests that have no table."""
    directory.mkdir(parents=True, exist_ok=True)
    said: dict[str, Row] = {}
    for name, rows in tests.items():
        full = [{"status": "done", "reason": ""} | row for row in rows]
        write_table(directory / f"{name}.csv", full)
        failed = sum(row["status"] == "failed" for row in full)
        said[name] = {"status": "finished", "points": len(full), "failed": failed, "seconds": 1.5, "csv": f"{name}.csv",
                      "figures": {}}
    for name, one in (more or {}).items():
        said[name] = said.get(name, {}) | one
    (directory / "rig.json").write_text(json.dumps({"schema": 1, "title": "A tyre by formula", "case": "case.toml",
                                                    "version": "0", "settings": dict(settings or {}), "tests": said, **info}))
    return directory


def write_table(path: pathlib.Path, rows: list[Row]) -> None:
    extra = [name for row in rows for name in row if name not in COLUMNS]
    names = [*(name for name in COLUMNS if any(name in row for row in rows)), *dict.fromkeys(extra)]
    with path.open("w", newline="") as stream:
        table = csv.DictWriter(stream, names, lineterminator="\n")
        table.writeheader()
        table.writerows({name: repr(value) if isinstance(value, float) else value for name, value in row.items()}
                        for row in ({k: float(v) if isinstance(v, np.floating) else v for k, v in row.items()} for row in rows))


def tests_with_runs(directory: pathlib.Path) -> dict[str, list[Row]]:
    """Footprint, relaxation, cleat, road and modes, with runs under `directory`."""
    for name in ("upright", "leaning"):
        solids.write_run(directory / "runs" / name, camber=0.0 if name == "upright" else 0.06)
    footprint = [{"load": load, "pressure": PRESSURE, "camber": camber, "contact_length": .1 + 1e-5 * load,
                  "contact_width": .15 - camber, "contact_area": .012 + 1e-6 * load, "mean_pressure": 2e5 + 10 * load,
                  "run": f"runs/{'leaning' if camber else 'upright'}"}
                 for load in LOADS for camber in ((0.0, 0.06) if load == LOAD else (0.0,))]
    relaxation = [{"load": load, "pressure": PRESSURE, "step": step, "relaxation_length_63": length * load / LOAD,
                   "relaxation_length_fit": 0.9 * length * load / LOAD,
                   "run": write_step(directory, f"runs/{step}-{load:g}", step, length * load / LOAD)}
                  for load in LOADS for step, length in (("slip-angle", .4), ("slip-ratio", .2))]
    courses = [{"load": LOAD, "pressure": PRESSURE, "speed": speed, "peak_to_peak_Fx": 800.0, "peak_to_peak_Fz": 2000.0,
                "run": write_course(directory, f"runs/course-{speed:g}", speed)} for speed in (8.0, 16.0)]
    modes = [{"pressure": pressure, "standing": standing, "mode": mode, "frequency": 40.0 + 15 * mode + 1e-4 * pressure,
              "damping_ratio": .02 + .002 * mode, "nodal_diameter": float("nan") if standing else mode,
              "description": "radial", "run": "runs/modes"}
             for pressure in PRESSURES for standing in (0, 1) for mode in range(1, 9)]
    road = [{key: value for key, value in row.items() if "peak" not in key} | {"rms_Fx": 90.0, "rms_Fz": 300.0}
            for row in courses]
    return {"footprint": footprint, "relaxation": relaxation, "cleat": courses, "modes": modes, "road": road}


def write_step(directory: pathlib.Path, name: str, step: str, length: float) -> str:
    """A steady run with a step of the slip: exponentials of this relaxation length. The folder's name."""
    folder = solids.write_run(directory / name, snapshots=1, camber=0.0, steady=True)
    column = "force_lateral" if step == "slip-angle" else "force_x"
    distance = np.linspace(0.0, 1.5, 61)
    force = 10.0 + 500.0 * (1 - np.exp(-distance / length))
    lines = [f"{x!r},{y!r}" for x, y in zip(distance.tolist(), force.tolist())]
    (folder / "slip-step.csv").write_text("\n".join([f"distance_m,{column}", *lines]) + "\n")
    said = json.loads((folder / "run.json").read_text())
    (folder / "run.json").write_text(json.dumps(said | {"slip_step": {column: {"before": 10.0, "after": 510.0}}}))
    return name


def write_course(directory: pathlib.Path, name: str, speed: float) -> str:
    """A motion whose forces swing at 35 and 80 Hz behind 1 m of way. The folder's name."""
    folder = solids.write_run(directory / name, camber=0.0)
    time = np.arange(1, 401) * 1e-3
    after = np.maximum(time - 1.0 / speed, 0.0)
    swing = {"force_x": -400 * np.sin(2 * np.pi * 35 * after) * np.exp(-after / .05),
             "force_y": LOAD + 900 * np.sin(2 * np.pi * 80 * after) * np.exp(-after / .05)}
    columns = {column: swing.get(column, np.zeros(len(time))) for column in solids.HISTORY} | {"time_s": time}
    rows = zip(*(values.tolist() for values in columns.values()))
    (folder / "history.csv").write_text("\n".join([",".join(columns), *(",".join(map(repr, row)) for row in rows)]) + "\n")
    said = json.loads((folder / "run.json").read_text())
    (folder / "run.json").write_text(json.dumps(said | {"end_time": float(time[-1])}))
    return name

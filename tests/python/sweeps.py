# SPDX-License-Identifier: BSD-3-Clause
"""Sweep directories as `rondo sweep` leaves them, with figures that the tests know."""
from __future__ import annotations

import csv
import io
import itertools
import json
import pathlib
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

FIGURES = ["steps", "end_time_s", "force_x_mean", "force_x_peak", "force_x_fluctuation",
           "force_y_mean", "force_y_peak", "force_y_fluctuation", "torque_mean", "torque_peak",
           "torque_fluctuation", "contact_length_mean_m", "contact_length_peak_m",
           "slip_ratio_mean", "center_y_mean", "speed_mean", "spin_mean", "friction_power", "impact_power", "energy_residual_relative",
           "contact_residual_max", "penetration_max_m", "strain_max", "jacobian_min"]
CRUSH_FIGURES = ["steps", "end_time_s", "depth_m", "force_x", "force_y", "torque",
                 "contact_length_m", "pressure_max_pa", "shear_max_pa", "strain",
                 "dissipation_friction", "energy_residual_relative", "contact_residual_max",
                 "penetration_max_m", "strain_max", "jacobian_min"]

Row = dict[str, Any]
FRICTION, SPIN, SCHEME = "ground.friction", "motion.angular_velocity", "solver.scheme"
FRICTIONS, SPINS = (0.1, 0.3, 0.5), (30.0, 33.0, 36.0, 40.0)


def write(directory: pathlib.Path, parameters: Sequence[tuple[str, str, str]], rows: Sequence[Row],
          figures: Sequence[str] = FIGURES, targets: Sequence[str] = (), **info: Any
          ) -> pathlib.Path:
    """A sweep: parameters as (key, unit, kind), a row for each member with its parameters,
    figures, and its status if it is not done."""
    directory.mkdir(parents=True)
    keys = [key for key, _, _ in parameters]
    inputs = [*targets, *keys] if targets else keys
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(["run", *inputs, "status", *figures])
    for number, row in enumerate(rows, 1):
        table.writerow([number, *(_said(row[key]) for key in inputs), row.get("status", "done"),
                        *(_said(row.get(name, float("nan"))) for name in figures)])
    (directory / "results.csv").write_text(text.getvalue())
    status = [row.get("status", "done") for row in rows]
    said = {"format": "rondo sweep 1", "status": "failed" if "failed" in status else "done",
            "title": "a study", "version": "0.1.0", "analysis": "dynamic", "study": "study.toml",
            "base": "base.toml", "window": {"from": None, "to": None}, "members": len(rows),
            "done": status.count("done"), "failed": status.count("failed"), "wall_s": 1.5,
            "failures": [{"run": number, "message": "it blew up"}
                         for number, state in enumerate(status, 1) if state == "failed"],
            "parameters": [{"key": key, "unit": unit, "kind": kind}
                           for key, unit, kind in parameters],
            "columns": [{"name": name, "unit": unit_of(name)} for name in figures]}
    (directory / "sweep.json").write_text(json.dumps({**said, **info}))
    (directory / "timings.csv").write_text("run,worker,wall_s\n" + "".join(
        f"{number},{number % 2},0.25\n" for number in range(1, len(rows) + 1)))
    return directory


def unit_of(name: str) -> str:
    """As the program gives it in sweep.json."""
    if name == "strain_max":
        return "1"
    for begin, unit in (("force_", "N/m"), ("torque", "N·m/m"), ("strain", "J/m"),
                        ("dissipation", "J/m")):
        if name.startswith(begin):
            return unit
    for end, unit in (("_power", "W/m"), ("_m", "m"), ("_pa", "Pa"), ("_s", "s")):
        if name.endswith(end):
            return unit
    return "1"


def _said(value: Any) -> str:
    return f"{value:.17g}" if isinstance(value, (int, float)) else str(value)


def forces(friction: float, spin: float) -> Row:
    """Figures in closed form: the horizontal force is friction times slip, up to a bound."""
    slip = (spin - 33.0) / 33.0
    vertical = 2e5 * (1 + 0.01 * slip)
    pull = vertical * friction * np.tanh(8 * slip / friction)
    return {"steps": 6000, "end_time_s": 0.1, "force_x_mean": pull, "force_x_peak": 1.3 * pull,
            "force_x_fluctuation": 0.1 * abs(pull), "force_y_mean": vertical,
            "force_y_peak": 1.2 * vertical, "force_y_fluctuation": 0.05 * vertical,
            "torque_mean": -0.3 * pull, "torque_peak": 0.4 * abs(pull),
            "torque_fluctuation": 0.03 * abs(pull), "contact_length_mean_m": 0.04 + 0.01 * friction,
            "contact_length_peak_m": 0.05, "slip_ratio_mean": slip, "center_y_mean": 0.29,
            "speed_mean": 10.0, "spin_mean": spin,
            "friction_power": abs(pull * slip) * 10.0, "impact_power": 12.0,
            "energy_residual_relative": 2e-15, "contact_residual_max": 1e-14,
            "penetration_max_m": 1e-12, "strain_max": 0.05, "jacobian_min": 0.9}


def grid(directory: pathlib.Path, frictions: Sequence[float] = FRICTIONS,
         spins: Sequence[float] = SPINS, schemes: Sequence[str] = ("symplectic",),
         failed: Sequence[int] = (), change: Callable[[Row], None] | None = None,
         **info: Any) -> pathlib.Path:
    """Friction by spin by scheme, the last the fastest; "as-printed" has 1 % more of all."""
    rows: list[Row] = []
    for friction, spin, scheme in itertools.product(frictions, spins, schemes):
        row = {FRICTION: friction, SPIN: spin, SCHEME: scheme}
        if len(rows) + 1 in failed:
            row["status"] = "failed"
        else:
            more = 1.01 if scheme == "as-printed" else 1.0
            row |= {name: more * value for name, value in forces(friction, spin).items()}
        if change:
            change(row)
        rows.append(row)
    parameters = [(FRICTION, "-", "values"), (SPIN, "rad/s", "values"), (SCHEME, "-", "values")]
    return write(directory, parameters, rows, **info)


MODULUS, DEPTH, HEIGHT, LOAD = ("material.youngs_modulus", "disk.tread.depth", "motion.height",
                                "target.force_y")


def sampled(directory: pathlib.Path, members: int = 120, failed: Sequence[int] = ()
            ) -> pathlib.Path:
    """A Latin hypercube of friction, modulus and depth of the tread."""
    random = np.random.default_rng(7)
    places = (np.stack([random.permutation(members) for _ in range(3)], axis=1) + 0.5) / members
    rows: list[Row] = []
    for a, b, c in places:
        row: Row = {FRICTION: 0.1 + 0.8 * a, MODULUS: 1e7 + 2e7 * b, DEPTH: 0.005 + 0.01 * c}
        if len(rows) + 1 in failed:
            row["status"] = "failed"
        else:
            row |= forces(row[FRICTION], 36.0)
            row["force_y_mean"] = 1e-2 * row[MODULUS] + 1e6 * row[DEPTH]
        rows.append(row)
    parameters = [(FRICTION, "-", "uniform"), (MODULUS, "Pa", "uniform"), (DEPTH, "m", "uniform")]
    return write(directory, parameters, rows)


def loaded(directory: pathlib.Path) -> pathlib.Path:
    """Crushes to a load, for which the program finds the height."""
    rows: list[Row] = []
    for load, friction in itertools.product((1e5, 2e5, 3e5), (0.0, 0.4)):
        depth = 0.01 * load / 2e5 - 0.001 * friction
        rows.append({LOAD: load, HEIGHT: 0.3 - depth, FRICTION: friction, "steps": 40,
                     "end_time_s": 0.0, "depth_m": depth, "force_x": 1e-10,
                     "force_y": load * (1 + 1e-10), "torque": 0.0,
                     "contact_length_m": 0.2 * depth**0.5, "pressure_max_pa": 3e6,
                     "shear_max_pa": 1e6 * friction, "strain": load * depth / 2,
                     "dissipation_friction": friction, "energy_residual_relative": 1e-15,
                     "contact_residual_max": 1e-14, "penetration_max_m": 1e-12,
                     "strain_max": 0.05, "jacobian_min": 0.9})
    parameters = [(HEIGHT, "m", "target"), (FRICTION, "-", "values")]
    return write(directory, parameters, rows, CRUSH_FIGURES, targets=[LOAD], analysis="crush")

# SPDX-License-Identifier: BSD-3-Clause
"""Sweeps of a wheel in three dimensions over slip angle, camber, height and spin, with forces in
closed form."""
from __future__ import annotations

import itertools
import json
import pathlib

import numpy as np
import sweeps

ANGLE, CAMBER, HEIGHT, SPIN = ("motion.slip_angle", "motion.camber", "motion.height",
                               "motion.angular_velocity")
STIFFNESS, MU, FREE_SPIN = 9.2e4, 0.3, 33.76455
DYNAMIC = ["force_x_mean", "force_y_mean", "force_lateral_mean", "moment_aligning_mean",
           "moment_overturning_mean", "slip_ratio_mean", "friction_power"]
STEADY = ["force_x", "force_y", "force_lateral", "moment_aligning", "moment_overturning",
          "slip_ratio", "friction_power"]
UNITS = {"force": "N", "moment": "N·m", "slip": "1", "friction": "W"}
DEGREES = (-4.0, -1.0, 0.0, 0.5, 2.0, 6.0)


def load_at(height: float) -> float:
    return 1.78e6 * (0.3 - height)


def figures(angle: float, camber: float = 0.0, height: float = 0.29, spin: float = FREE_SPIN,
            more: float = 1.0) -> list[float]:
    """As the columns: the forces of a brush whose direction is that of the slip."""
    load, slip = load_at(height), spin / FREE_SPIN - 1.0
    pull = np.array([4.0 * STIFFNESS * slip, -STIFFNESS * np.tan(angle) + 2.1e4 * camber]) * more
    size = np.linalg.norm(pull)
    bound = MU * load
    force = pull / size * bound * np.tanh(size / bound) if size else pull
    moment = 0.022 * force[1] * np.exp(-size / bound)
    return [force[0], load, force[1], moment, 3.0 * camber, slip, 100.0 * size * abs(slip)]


def write(directory: pathlib.Path, keys: list[tuple[str, str]], members: list[tuple[float, ...]],
          steady: bool, failed: tuple[int, ...] = ()) -> pathlib.Path:
    names = STEADY if steady else DYNAMIC
    rows = []
    for number, values in enumerate(members, 1):
        row = {key: value for (key, _), value in zip(keys, values)}
        chosen = {key.split(".")[1].removesuffix("_velocity"): value for key, value in row.items()}
        found = figures(chosen["slip_angle"], chosen.get("camber", 0.0), chosen.get("height", 0.29),
                        chosen.get("angular", FREE_SPIN), 1.05 if steady else 1.0)
        row |= {"status": "failed"} if number in failed else dict(zip(names, found))
        rows.append(row)
    sweeps.write(directory, [(key, unit, "values") for key, unit in keys], rows, names,
                 analysis="steady-rolling" if steady else "dynamic", title="a box wheel")
    said = json.loads((directory / "sweep.json").read_text())
    said["columns"] = [{"name": name, "unit": UNITS[name.split("_")[0]]} for name in names]
    (directory / "sweep.json").write_text(json.dumps(said))
    return directory


def angles(directory: pathlib.Path, steady: bool = False, failed: tuple[int, ...] = ()
           ) -> pathlib.Path:
    """Slip angle by camber by height."""
    members = list(itertools.product(np.radians(DEGREES), (0.0, 0.06), (0.29, 0.293)))
    return write(directory, [(ANGLE, "rad"), (CAMBER, "rad"), (HEIGHT, "m")], members, steady, failed)


def combined(directory: pathlib.Path) -> pathlib.Path:
    """Slip angle by spin."""
    members = list(itertools.product(np.radians((0.0, 1.0, 3.0, 8.0)),
                                     FREE_SPIN * np.array([0.9, 0.97, 1.0, 1.03, 1.1])))
    return write(directory, [(ANGLE, "rad"), (SPIN, "rad/s")], members, False)

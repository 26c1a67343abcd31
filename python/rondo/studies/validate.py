# SPDX-License-Identifier: BSD-3-Clause
"""rondo validate: how far off the predictions of reduced wheels are, from the results of reduced
runs and of the full runs that they are to predict (docs/reduced.md)."""
from __future__ import annotations

import csv
import json
import math
import os
import pathlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..data.errors import Error
from ..data.run import Run, open_run
from .validate_measures import (Means, Window, field_errors, mean_profile, profile_error, share_of)

FORMAT = "rondo validation 1"
APART = ("title", "output", "time", "solver")  # tables in which the two cases may differ
PROFILES = ("angle_rad", "pressure_full_pa", "pressure_reduced_pa", "shear_full_pa",
            "shear_reduced_pa")

SMALL = 0.01  # share of F_y below which F_x is called small

Figures = dict[str, float]

# Columns of validation.csv and their units.
COLUMNS = {
    "from_s": "s", "to_s": "s", "snapshots": "1",
    "displacement_error": "1", "velocity_error": "1",
    "displacement_mean_error": "1", "velocity_mean_error": "1",
    "pressure_error": "1", "shear_error": "1",
    "force_x_error": "1", "force_y_error": "1", "friction_error": "1",
    "force_x_own_error": "1", "shear_own_error": "1",
    "force_x_full_n_m": "N/m", "force_x_reduced_n_m": "N/m",
    "force_y_full_n_m": "N/m", "force_y_reduced_n_m": "N/m",
    "force_x_fluctuation_full_n_m": "N/m", "force_x_fluctuation_reduced_n_m": "N/m",
    "force_y_fluctuation_full_n_m": "N/m", "force_y_fluctuation_reduced_n_m": "N/m",
    "friction_power_full_w_m": "W/m", "friction_power_reduced_w_m": "W/m",
    "steps_full": "1", "steps_reduced": "1", "loop_wall_full_s": "s", "loop_wall_reduced_s": "s",
    "speed_up": "1", "threads_full": "1", "threads_reduced": "1", "same_host": "1",
}


@dataclass(frozen=True)
class Validated:
    """A prediction and the run that it is to predict."""

    name: str  # of the full run's directory, made unique
    full: Run
    reduced: Run
    figures: Figures = field(default_factory=dict)
    profiles: np.ndarray | None = None  # (5, m) in the order of PROFILES


def validate(pairs: Sequence[tuple[pathlib.Path, pathlib.Path]], directory: pathlib.Path,
             from_time: float | None = None, to_time: float | None = None) -> list[Validated]:
    """Compares each (reduced, full) and writes validation.csv, validation.json and the profiles
    into `directory`. The window is the last quarter of each full run if not given."""
    if len({full.resolve() for _, full in pairs}) < len(pairs):
        raise Error("a full run is named twice: each once, after the reduced run that predicts it")
    if (directory / "run.json").exists():
        raise Error(f"{directory}: holds a run, not a validation; choose another -o")
    runs = [(_reduced(reduced), _full(full)) for reduced, full in pairs]
    found = []
    for name, (reduced, full) in zip(_names([full.directory for _, full in runs]), runs):
        _check_pair(reduced, full)
        found.append(_compared(_window(full, from_time, to_time), name, reduced, full))
    _write(directory, found)
    return found


# What can be compared


def _full(directory: pathlib.Path) -> Run:
    run = _finished(directory)
    if run.is_crush:
        raise Error(f"{directory}: a crush does not roll: there is no motion to predict")
    if run.is_inflation:
        raise Error(f"{directory}: an inflation is an equilibrium: there is no motion to predict")
    if run.info.keys() & {"wheel_modes", "reduced_modes"}:  # the latter of an earlier version
        raise Error(f"{directory}: is a reduced run itself; REDUCED and then the full run that it "
                    "predicts are to be named in turn")
    if run.n_snapshots < 2:
        raise Error(f"{directory}: {run.n_snapshots} snapshots are nothing to compare with; run it "
                    "with output.snapshots of 2 or more")
    return run


def _reduced(directory: pathlib.Path) -> Run:
    run = _finished(directory)
    if "wheel_modes" not in run.info:
        raise Error(f"{directory}: is no run of a reduced wheel; rondo run CASE --reduced makes one, "
                    "and the full run that it predicts is named after it")
    run.need_snapshots()
    return run


def _finished(directory: pathlib.Path) -> Run:
    run = open_run(directory, unfinished=True)
    if run.status != "done":
        raise Error(f"{directory}: the run is not finished (status {run.status}); finish it (rondo "
                    "run), or leave it out")
    return run


def _check_pair(reduced: Run, full: Run) -> None:
    """One mesh, one case."""
    a, b = reduced.mesh, full.mesh
    for what in ("coordinates", "cells", "boundary", "tributary", "mass", "sector", "sector_node"):
        if not np.array_equal(getattr(a, what), getattr(b, what)):
            raise Error(f"{reduced.directory}: is of another mesh than {full.directory}: {what} "
                        "differ")
    mine, theirs = ({key: part for key, part in run.case.items() if key not in APART}
                    for run in (reduced, full))
    differs = _difference(mine, theirs)
    if differs:
        raise Error(f"{reduced.directory}: does not predict {full.directory}: {differs}; run the "
                    "same case with and without --reduced")


def _difference(a: Any, b: Any, key: str = "") -> str:
    """Where two cases differ first, in words."""
    if not isinstance(a, dict) or not isinstance(b, dict):
        return "" if a == b else f"{key} = {a} against {b}"
    for name in sorted({*a, *b}):
        found = _difference(a.get(name), b.get(name), f"{key}.{name}" if key else name)
        if found:
            return found
    return ""


def _window(full: Run, from_time: float | None, to_time: float | None) -> Window:
    end = full.times[-1] if to_time is None else to_time
    window = Window(0.75 * end if from_time is None else from_time, end)
    if not window.holds(full.times).any():
        raise Error(f"{full.directory}: no snapshot between {window.begin:.9g} and "
                    f"{window.end:.9g} s; its {full.n_snapshots} are between {full.times[0]:.9g} "
                    f"and {full.times[-1]:.9g} s: other --from, --to")
    return window


def _names(directories: Sequence[pathlib.Path]) -> list[str]:
    """Of the directories, made unique."""
    names: list[str] = []
    for directory in directories:
        name = directory.resolve().name
        unique, k = name, 2
        while unique in names:
            unique, k = f"{name}-{k}", k + 1
        names.append(unique)
    return names


# What is measured


def _compared(window: Window, name: str, reduced: Run, full: Run) -> Validated:
    figures: Figures = {"from_s": window.begin, "to_s": window.end}
    compared = []
    for quantity in ("displacement", "velocity"):
        errors = field_errors(window, full, reduced, quantity)
        figures |= {f"{quantity}_error": errors.error, f"{quantity}_mean_error": errors.mean}
        compared.append(errors.compared)
    figures["snapshots"] = min(compared)
    profiles = _compare_profiles(window, reduced, full, figures)
    for side, run in (("full", full), ("reduced", reduced)):
        _take_history(Means(run, window), side, figures)
        for key, column in (("steps_done", f"steps_{side}"), ("threads", f"threads_{side}"),
                            ("loop_wall_s", f"loop_wall_{side}_s")):
            value = run.info.get(key)
            figures[column] = float(value) if isinstance(value, (int, float)) else math.nan
    load = figures["force_y_full_n_m"]
    for force in ("force_x", "force_y"):
        missed = figures[f"{force}_reduced_n_m"] - figures[f"{force}_full_n_m"]
        figures[f"{force}_error"] = share_of(missed, load)
        if force == "force_x":
            figures["force_x_own_error"] = share_of(missed, abs(figures["force_x_full_n_m"]))
    lost = figures["friction_power_full_w_m"]
    figures["friction_error"] = share_of(figures["friction_power_reduced_w_m"] - lost, lost)
    figures["speed_up"] = share_of(figures["loop_wall_full_s"], figures["loop_wall_reduced_s"])
    host = full.info.get("host")
    figures["same_host"] = float(bool(host) and host == reduced.info.get("host"))
    return Validated(name, full, reduced, figures, profiles)


def _compare_profiles(window: Window, reduced: Run, full: Run,
                      figures: Figures) -> np.ndarray | None:
    figures |= {"pressure_error": math.nan, "shear_error": math.nan, "shear_own_error": math.nan}
    mine, theirs = mean_profile(full, window), mean_profile(reduced, window)
    if mine is None or theirs is None:
        return None
    figures["pressure_error"] = profile_error(mine[1], theirs[1], mine[1])
    figures["shear_error"] = profile_error(mine[2], theirs[2], mine[1])  # shear may vanish
    figures["shear_own_error"] = profile_error(mine[2], theirs[2], mine[2])
    return np.stack([mine[0], mine[1], theirs[1], mine[2], theirs[2]])


def _take_history(means: Means, side: str, figures: Figures) -> None:
    for force in ("force_x", "force_y"):
        figures[f"{force}_{side}_n_m"] = means.mean(force)
        figures[f"{force}_fluctuation_{side}_n_m"] = means.fluctuation(force)
    figures[f"friction_power_{side}_w_m"] = means.rate("dissipation_friction")


# What is written and printed


def _write(directory: pathlib.Path, runs: Sequence[Validated]) -> None:
    try:
        directory.mkdir(parents=True, exist_ok=True)
        for run in runs:
            if run.profiles is not None:
                (directory / run.name).mkdir(exist_ok=True)
                _write_csv(directory / run.name / "profiles.csv", PROFILES, run.profiles.T.tolist())
        rows = [[run.name, *(run.figures[column] for column in COLUMNS)] for run in runs]
        _write_csv(directory / "validation.csv", ("run", *COLUMNS), rows)
        (directory / "validation.json").write_text(
            json.dumps(_record(directory, runs), indent=2, ensure_ascii=False) + "\n")
    except OSError as reason:
        raise Error(f"{reason.filename or directory}: cannot be written: {reason.strerror}; choose "
                    "another -o") from None


def _write_csv(path: pathlib.Path, header: Sequence[str], rows: Sequence[Sequence[Any]]) -> None:
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)


def _record(directory: pathlib.Path, runs: Sequence[Validated]) -> dict[str, Any]:
    """Directories are relative to that of the validation."""
    def entry(run: Validated) -> dict[str, Any]:
        full, reduced = (os.path.relpath(side.directory, directory)
                         for side in (run.full, run.reduced))
        wheel = {key: run.reduced.info.get(key) for key in ("wheel_modes", "wheel_basis", "wheel_file")}
        return {"name": run.name, "full": full, "reduced": reduced, **wheel,
                "profiles": run.profiles is not None}

    first = runs[0].reduced.info
    program = {key: first.get(key) for key in ("version", "build", "build_id", "build_record", "host")}
    return {"format": FORMAT, "status": "done", **program, "runs": [entry(run) for run in runs],
            "units": COLUMNS}


def _percent(column: str) -> Callable[[Figures], str]:
    return lambda f: "-" if math.isnan(f[column]) else f"{100 * f[column]:.2f} %"


def _both(column: str, unit: str = "", digits: int = 6) -> Callable[[Figures], str]:
    return lambda f: " | ".join("-" if math.isnan(f[name]) else f"{f[name]:.{digits}g}" for name in
                                (f"{column}_full{unit}", f"{column}_reduced{unit}"))


def _force_x(f: Figures) -> str:
    """A small F_x beside the load is named: then it is a difference of larger forces."""
    share = abs(share_of(f["force_x_full_n_m"], f["force_y_full_n_m"]))
    small = f" of {100 * share:.2g} % of F_y" if share < SMALL else ""
    return _percent("force_x_own_error")(f) + small


_LINES: list[tuple[str, Callable[[Figures], str]]] = [
    ("window, s", lambda f: f"{f['from_s']:.6g} to {f['to_s']:.6g}"),
    ("snapshots compared", lambda f: f"{f['snapshots']:g}"),
    ("errors of the prediction", lambda f: ""),
    ("  displacement", _percent("displacement_error")),
    ("  velocity", _percent("velocity_error")),
    ("  displacement, mean", _percent("displacement_mean_error")),
    ("  velocity, mean", _percent("velocity_mean_error")),
    ("  pressure, mean profile", _percent("pressure_error")),
    ("  shear, over the pressure", _percent("shear_error")),
    ("  shear, over itself", _percent("shear_own_error")),
    ("  F_x, over F_y", _percent("force_x_error")),
    ("  F_x, over itself", _force_x),
    ("  F_y", _percent("force_y_error")),
    ("  friction, dissipated", _percent("friction_error")),
    ("full | reduced", lambda f: ""),
    ("  F_x, mean, N/m", _both("force_x", "_n_m")),
    ("  F_y, mean, N/m", _both("force_y", "_n_m")),
    ("  F_x, fluctuation, N/m", _both("force_x_fluctuation", "_n_m")),
    ("  F_y, fluctuation, N/m", _both("force_y_fluctuation", "_n_m")),
    ("  friction, dissipated, W/m", _both("friction_power", "_w_m")),
    ("  steps", _both("steps")),
    ("  threads", _both("threads")),
    ("  time of the loop and its snapshots, s", _both("loop_wall", "_s", 3)),
    ("speed-up, snapshots included",
     lambda f: f"{f['speed_up']:.3g}{'' if f['same_host'] else ' (other machines)'}"),
]


def text_of(runs: Sequence[Validated]) -> str:
    """A line for each figure, a column for each run."""
    columns = [["full run", *(what for what, _ in _LINES)],
               *([run.name, *(line(run.figures) for _, line in _LINES)] for run in runs)]
    widths = [max(map(len, column)) for column in columns]
    return "\n".join("  ".join(f"{cell:{'>' if k else '<'}{width}}" for k, (cell, width)
                               in enumerate(zip(row, widths))).rstrip() for row in zip(*columns))

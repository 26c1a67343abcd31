# SPDX-License-Identifier: BSD-3-Clause
"""Tables of forces in other axes beside history.csv and results.csv, which stay in rondo's own: `rondo axes`,
and the option --axes of the commands (docs/conventions.md)."""
from __future__ import annotations

import json
import pathlib
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .axes import QUANTITIES, SLIP_RATIOS, Quantities, system
from .errors import Error, FileError
from .files import write_table

if TYPE_CHECKING:
    from .run import Run
    from .sweep import Sweep


@dataclass(frozen=True)
class AxesTable:
    """The rows of a run, or the members of a sweep, in other axes."""

    axes: str                         # as it was asked for: the name of the file
    source: pathlib.Path              # history.csv or results.csv
    first: dict[str, np.ndarray]      # columns before the quantities
    found: Quantities
    effective_radius: float | None
    said: str                         # the last row, or the means, in words

    @property
    def path(self) -> pathlib.Path:
        """Where it goes by itself: history-iso-w.csv beside history.csv."""
        return self.source.with_name(f"{self.source.stem}-{self.axes}.csv")


def table_of_run(run: Run, axes: str, effective_radius: float | None = None) -> AxesTable:
    """A row for each row of history.csv."""
    history = run.history
    found = history.in_axes(axes, effective_radius)
    if not history.n_rows:
        raise Error(f"{history.path}: has no rows yet: nothing to give in other axes")
    if run.is_steady:
        said = f"mean over a sector's pass: {in_words(found.mean(np.ones(history.n_rows)))}"
    else:
        last = np.arange(history.n_rows) == history.n_rows - 1
        said = f"last row, to {history['time_s'][-1]:.6g} s: {in_words(found.mean([1.0], last))}"
    return AxesTable(axes, history.path, {"time_s": history["time_s"]}, found, effective_radius, said)


def table_of_sweep(sweep: Sweep, axes: str, effective_radius: float | None = None) -> AxesTable:
    """A row for each member: its number, its parameters as in results.csv, its status."""
    found = sweep.in_axes(axes, effective_radius)
    first = {name: sweep[name] for name in ("run", *sweep.parameters, "status")}
    done = np.flatnonzero(sweep.done)
    said = f"{len(done)} of {len(sweep)} members have forces"
    if len(done):
        last = np.arange(len(sweep)) == done[-1]
        said += f"; the last of them, run {sweep['run'][done[-1]]}: {in_words(found.mean([1.0], last))}"
    return AxesTable(axes, sweep.directory / "results.csv", first, found, effective_radius, said)


def write_axes_table(table: AxesTable, file: pathlib.Path | None = None) -> list[pathlib.Path]:
    """The table, by itself beside its source, and a .json that says what its columns are."""
    path = table.path if file is None else file
    if path.suffix != ".csv":
        raise Error(f"-o {path}: a table ends in .csv")
    write_table(path, {**table.first, **{f"{name}{end}": getattr(table.found, name)
                                         for name, (_, end) in QUANTITIES.items()}})
    beside = path.with_suffix(".json")
    try:
        beside.write_text(json.dumps(_description(table, path), indent=2, ensure_ascii=False) + "\n")
    except OSError as reason:
        raise FileError(f"{beside}: cannot be written: {reason.strerror}; choose another -o") from None
    return [path, beside]


def _description(table: AxesTable, path: pathlib.Path) -> dict[str, object]:
    row = system(table.axes)
    columns = [{"name": f"{name}{end}", "unit": unit} for name, (unit, end) in QUANTITIES.items()]
    beside = path.resolve().parent == table.source.resolve().parent
    return {"table": path.name, "source": table.source.name if beside else str(table.source), "axes": row.name, "title": row.title,
            "forces": "of the ground on the wheel", "y": row.y, "z": row.z, "moments_about": row.origin,
            "axes_lean_with_the_wheel": row.leans, "normal_force_is_the_load": row.load_positive,
            "positive_slip_angle": "the wheel moves to the " + ("right" if row.slip_angle > 0 else "left"),
            "positive_camber": "the top leans to the " + ("left" if row.camber > 0 else "right"),
            "positive_turn_slip": "the path bends to the " + ("left" if row.turn_slip > 0 else "right"),
            "slip_ratio": SLIP_RATIOS[row.slip_ratio],
            "radius_of_slip_ratio_m": table.effective_radius or "the outer radius of the undeformed wheel",
            "other_columns": f"as in {table.source.name}; keys of the case have rondo's own signs",
            "columns": columns}


def in_words(one: Quantities) -> str:
    """Forces, moments and slips of a row, in the axes of `one`."""
    parts = [f"{name} {float(getattr(one, name)):.6g} {QUANTITIES[name][0]}" for name in ("Fx", "Fy", "Fz", "Mx", "My", "Mz")]
    angles = [f"{name.replace('_', ' ')} {np.degrees(float(getattr(one, name))):.4g}°" for name in ("slip_angle", "camber")]
    return f"axes {one.system}: {', '.join([*parts, *angles])}, slip ratio {100 * float(one.slip_ratio):.4g} %"

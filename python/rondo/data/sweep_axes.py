# SPDX-License-Identifier: BSD-3-Clause
"""The members of a sweep of wheels in three dimensions in other axes and signs (docs/conventions.md).
A Sweep is Any here: its module imports this one."""
from __future__ import annotations

import json
import tomllib
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .axes import Quantities, convert, own
from .errors import Error
from .names import find_figure
from .solid import is_below_zero
from .sweep_table import column_of

Array = NDArray[np.float64]
FORCES = ("force_x", "force_y", "force_lateral", "moment_aligning", "moment_overturning", "torque", "slip_ratio")
ANGLE = "motion.slip_angle"


def sweep_in_axes(sweep: Any, system: str, effective_radius: float | None) -> Quantities:
    """See Sweep.in_axes."""
    if sweep.analysis not in ("dynamic", "steady-rolling") or find_figure("force_lateral", sweep) is None:
        raise Error(f"{sweep.directory}: axes are of wheels in three dimensions that roll on a ground, and these "
                    f'members ({sweep.analysis}) have no force_lateral of one: use the columns as they are')
    case = _case_of(sweep)
    _demand_ahead(sweep, case)
    height = find_figure("center_y", sweep) or "height"
    found = own(**{name: column_of(sweep, name) for name in FORCES}, height=column_of(sweep, height),
                slip_angle=_slip_angles(sweep, case), camber=_numbers(sweep, case, "motion.camber"),
                turn_slip=_numbers(sweep, case, "motion.turn_slip"))
    radius = None if effective_radius is None else _radii(sweep, case)
    return convert(found, system, effective_radius, radius)


def _case_of(sweep: Any) -> Mapping[str, Any]:
    """The case of run 1, with all keys: what all members have that is no parameter."""
    text = sweep.info.get("case")
    if text is None:
        path = sweep.run_directory(1) / "case.toml"
        if not path.is_file():
            raise Error(f"{sweep.directory}: was made by an earlier version of rondo, and its files do not say how the "
                        "wheels stand: run the sweep again")
        text = path.read_text()
    try:
        return tomllib.loads(str(text))
    except ValueError as reason:
        raise Error(f"{sweep.directory / 'sweep.json'}: damaged: its case: {reason}") from None


def _given(case: Mapping[str, Any], key: str, default: Any = 0.0) -> Any:
    table, name = key.split(".")
    return case.get(table, {}).get(name, default)


def _values(sweep: Any, case: Mapping[str, Any], key: str) -> list[Any]:
    """Of a key, for each member: numbers, and tables over time as lists."""
    if key not in sweep.parameters:
        return [_given(case, key)] * len(sweep)
    column = sweep[key].tolist()
    return [json.loads(value) if isinstance(value, str) else value for value in column]


def _numbers(sweep: Any, case: Mapping[str, Any], key: str) -> Array:
    return np.array(_values(sweep, case, key), dtype=float)


def _slip_angles(sweep: Any, case: Mapping[str, Any]) -> Array:
    """Steady rolling has that of its case, a motion its mean."""
    return _numbers(sweep, case, ANGLE) if sweep.analysis == "steady-rolling" else column_of(sweep, "slip_angle")


def _radii(sweep: Any, case: Mapping[str, Any]) -> Array:
    """Outer radii [m]."""
    if "disk" in case:
        return _numbers(sweep, case, "disk.outer_radius")
    if not sweep.run_directory(1).is_dir():
        raise Error(f"{sweep.directory}: the outer radius of a [section], which an effective radius replaces, is "
                    "that of its mesh, and the sweep has not kept its runs: snapshots = true in the study keeps "
                    "them; or leave the effective radius out")
    return np.full(len(sweep), sweep.run(1, unfinished=True).outer_radius)


def _demand_ahead(sweep: Any, case: Mapping[str, Any]) -> None:
    for key in ("motion.speed", "motion.angular_velocity"):
        back = [int(run) for run, value in zip(sweep["run"], _values(sweep, case, key)) if is_below_zero(value)]
        if back:
            raise Error(f"{sweep.directory}: run {back[0]} rolls backwards ({key} < 0), for which the systems define "
                        "their signs differently: run the mirror image, with speed and angular_velocity > 0")

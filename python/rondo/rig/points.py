# SPDX-License-Identifier: BSD-3-Clause
"""The points of a rig's tests as columns: what the fit, the figures and the comparison read."""
from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .units import column_name

if TYPE_CHECKING:
    from ..data.rig import Rig

Array = NDArray[np.float64]
Columns = dict[str, Array]

DONE = "done"
ALIKE = 0.03  # relative: speeds of one spin differ by as much, because radii do with load and pressure


def points(rig: Rig, test: str, names: Iterable[str]) -> Columns:
    """The columns `names` of the points of a test that are done, (rows,) each; NaN: the test does not have the column;
    pressure 0: a wheel without air; camber and slip angle 0: a wheel in the plane. Forces are N, or N/m of a rig per metre of
    width. Points of the mirrored tyre are left out. No rows where the rig has not come to the test."""
    wanted = list(names)
    if test not in rig.tests:
        return {name: np.empty(0) for name in wanted}
    table = rig.tests[test].table
    done = done_rows(rig, test)
    there = {name: column_name(name, rig.per_metre) for name in wanted}
    found = {name: np.asarray(table[column], dtype=float)[done] if column in table else np.full(len(done), np.nan)
             for name, column in there.items()}
    for name in ("pressure", *(("camber", "slip_angle") if rig.plane else ())):
        if name in found:
            found[name] = np.nan_to_num(found[name], nan=0.0)
    return found


def texts(rig: Rig, test: str, name: str) -> list[str]:
    """A column of texts of the same points; "": the test does not have it."""
    table = rig.tests[test].table if test in rig.tests else {}
    return [str(table[name][k]) if name in table else "" for k in done_rows(rig, test)]


def done_rows(rig: Rig, test: str) -> NDArray[np.int64]:
    """Numbers of the rows of the table."""
    table = rig.tests[test].table if test in rig.tests else {}
    if "status" not in table:
        return np.empty(0, dtype=np.int64)
    mask = np.asarray(table["status"]) == DONE
    return np.flatnonzero(mask & ~(table["mirrored"] > 0) if "mirrored" in table else mask)


def nominal(rig: Rig, name: str, values: Array) -> float:
    """The nominal load, pressure, speed or camber of these values: that of the settings where it is among them, or that
    of most of them."""
    said = rig.settings.get(name)
    if isinstance(said, (int, float)) and np.isclose(values, said, rtol=ALIKE if name == "speed" else 1e-6).any():
        return float(said)
    return middle(values)


def chosen(columns: Columns, mask: NDArray[np.bool_] | NDArray[np.int64]) -> Columns:
    """The rows of a mask, or of numbers in their order."""
    return {name: values[mask] for name, values in columns.items()}


def levels(values: Array, apart: float = 1e-6) -> Array:
    """The values that occur, those within `apart` of the largest taken as one."""
    found = np.unique(values[np.isfinite(values)])
    if not len(found):
        return found
    step = apart * max(float(np.abs(found).max()), 1e-300)
    return found[np.concatenate([[True], np.diff(found) > step])]


def middle(values: Array) -> float:
    """The level that most of the values have, of several such ones the middle one: the nominal one of a rig. NaN: there
    are no values."""
    found = levels(values)
    if not len(found):
        return float("nan")
    counts = np.array([np.isclose(values, level, rtol=1e-6, atol=1e-12).sum() for level in found])
    most = found[counts == counts.max()]
    return float(most[(len(most) - 1) // 2])

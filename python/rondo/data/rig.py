# SPDX-License-Identifier: BSD-3-Clause
"""Results of a tyre test rig: rig.json and a table, <test>.csv, for each of its tests (docs/rig.md)."""
from __future__ import annotations

import csv
import os
import pathlib
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .errors import Error
from .files import read_json, require
from .plain_files import text_of

TEXTS = ("status", "reason", "run", "step", "force", "description")  # columns that are no numbers


@dataclass(frozen=True)
class RigTest:
    """One test: its points, and what rig.json says of it."""

    name: str
    info: dict[str, Any]           # status, reason, points, failed, doubt, figures
    table: dict[str, np.ndarray]   # (points,) each, SI and ISO-W; {}: none yet

    @property
    def failed(self) -> int:
        """Points that failed; each has its reason in the table."""
        return int((np.asarray(self.table.get("status", ()), dtype=str) == "failed").sum())


@dataclass(frozen=True)
class Rig:
    """rig.tests["lateral"].table["Fy"] is a column in SI, in the axes ISO-W. Of a plane wheel without a width it is
    "Fx_per_m", in N/m."""

    directory: pathlib.Path
    info: dict[str, Any]           # rig.json
    tests: dict[str, RigTest] = field(default_factory=dict)

    @property
    def title(self) -> str:
        return str(self.info.get("title", self.directory.name))

    @property
    def settings(self) -> dict[str, Any]:
        return dict(self.info.get("settings", {}))

    @property
    def plane(self) -> str:
        """"strain" or "stress" of a wheel in the plane; "" of a wheel in three dimensions."""
        return str(self.info.get("wheel", {}).get("plane", ""))

    @property
    def width(self) -> float | None:
        """m, by which the forces of a plane wheel are multiplied; None: they are per metre of width, or the wheel is one
        in three dimensions."""
        return self.info.get("wheel", {}).get("width")

    @property
    def per_metre(self) -> bool:
        """Forces and moments are per metre of width: columns of them end in _per_m."""
        return bool(self.plane) and self.width is None

    @property
    def figures(self) -> dict[str, dict[str, Any]]:
        """Figures of merit by test."""
        return {name: dict(test.info.get("figures", {})) for name, test in self.tests.items()}


def open_rig(path: str | os.PathLike[str]) -> Rig:
    """The results in a directory, of a rig that has not ended too.
    @raise NotARunError: there is no rig.json; Error: a file is damaged."""
    directory = require(path, "rig.json")
    info = read_json(directory / "rig.json")
    tests = info.get("tests")
    if not isinstance(tests, dict) or not all(isinstance(one, dict) for one in tests.values()):
        raise Error(f'{directory / "rig.json"}: damaged: "tests" has to be an object of objects')
    return Rig(directory, info, {name: RigTest(name, one, _table(directory / f"{name}.csv")) for name, one in tests.items()})


def _table(path: pathlib.Path) -> dict[str, np.ndarray]:
    if not path.exists():
        return {}
    try:
        head, *rows = [row for row in csv.reader(text_of(path).splitlines(), strict=True) if row]
        if any(len(row) != len(head) for row in rows):
            raise ValueError(f"{len(head)} columns are named, and a row has another number of them")
        return {name: np.array([row[k] for row in rows], dtype=str) if name in TEXTS
                else np.array([row[k] or "nan" for row in rows], dtype=float) for k, name in enumerate(head)}
    except (ValueError, csv.Error) as reason:
        raise Error(f"{path}: damaged: {reason}") from None

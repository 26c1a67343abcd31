# SPDX-License-Identifier: BSD-3-Clause
"""A validation of reduced runs: the directory that `rondo validate` writes."""
from __future__ import annotations

import csv
import io
import os
import pathlib
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import Error, unknown
from .files import check_format, read_json, read_table, require
from .plain_files import text_of
from .run import Run, open_run

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def open_validation(path: str | os.PathLike[str]) -> Validation:
    """Opens the directory of a validation."""
    return Validation(require(path, "validation.json", beside="validation.csv"))


class Validation:
    """A row for each full run that was predicted, r rows: validation["force_y_error"] is a column (r,). What
    there is nothing to measure by is NaN.

    directory; info: validation.json; names: (r) of the full runs' directories; units: of each
    column, "1" without dimension."""

    # Pictures: what rondo/pictures.py gives this class, as nothing here knows how to draw.
    plot: Callable[..., Figure]

    def __init__(self, directory: pathlib.Path) -> None:
        self.directory = directory
        path = directory / "validation.json"
        self.info: dict[str, Any] = read_json(path)
        check_format(path, "validation", self.info.get("format"))
        try:
            self.units = {str(name): str(unit) for name, unit in self.info["units"].items()}
            self._reduced = {str(run["name"]): str(run["reduced"]) for run in self.info["runs"]}
            self._has_profiles = {str(run["name"]): bool(run["profiles"])
                                  for run in self.info["runs"]}
        except (KeyError, TypeError, AttributeError) as reason:
            raise Error(f"{path}: damaged: {reason!r}") from None
        self.names, self._columns = _read(directory / "validation.csv")
        if self.names != list(self._has_profiles) or set(self.units) != set(self._columns):
            raise Error(f"{directory}: validation.json and validation.csv are not of one "
                        "validation; rondo validate writes both anew")

    def __repr__(self) -> str:
        return f"Validation({self.directory}: {', '.join(self.names)})"

    def __getitem__(self, column: str) -> np.ndarray:
        if column not in self._columns:
            raise unknown(self.directory, "column", column, self._columns)
        return self._columns[column]

    def row(self, name: str) -> dict[str, float]:
        """The figures of one run."""
        place = self._place(name)
        return {column: float(values[place]) for column, values in self._columns.items()}

    def prediction(self, name: str) -> Run:
        """The reduced run."""
        self._place(name)
        return open_run(self.directory / self._reduced[name])

    def profiles(self, name: str) -> dict[str, np.ndarray] | None:
        """Mean tractions over the angle in space: angle_rad, pressure_full_pa,
        pressure_reduced_pa, shear_full_pa, shear_reduced_pa, (m,) each. None without contact."""
        self._place(name)
        if not self._has_profiles[name]:
            return None
        return read_table(self.directory / name / "profiles.csv")

    def _place(self, name: str) -> int:
        if name not in self.names:
            raise unknown(self.directory, "run", name, self.names)
        return self.names.index(name)


def _read(path: pathlib.Path) -> tuple[list[str], dict[str, np.ndarray]]:
    try:
        header, *rows = list(csv.reader(io.StringIO(text_of(path)))) or [[]]
        values = [[float(text) for text in row[1:]] for row in rows]
    except (csv.Error, ValueError) as reason:
        raise Error(f"{path}: cannot be read: {reason}") from None
    if header[:1] != ["run"] or any(len(row) != len(header) for row in rows):
        raise Error(f"{path}: damaged: a column run and as many numbers in each row as there are "
                    "columns are expected")
    table = np.array(values).reshape(len(rows), len(header) - 1)
    return [row[0] for row in rows], dict(zip(header[1:], table.T.copy()))

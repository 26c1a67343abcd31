# SPDX-License-Identifier: BSD-3-Clause
"""results.csv of a sweep: a row for each member. A Sweep is Any here: its module imports this one."""
from __future__ import annotations

import csv
import pathlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .errors import Error
from .names import find_figure
from .plain_files import text_of


def read_members(path: pathlib.Path) -> tuple[list[str], dict[str, np.ndarray]]:
    """Names of the parameters, and all columns, (r,) each. A parameter is of numbers if all its
    values are, else of texts. The last line may be one at which the program was killed: without
    its end of line it is left out."""
    header, rows = _lines(path)
    if header[:1] != ["run"] or "status" not in header or len(set(header)) < len(header):
        raise Error(f"{path}: damaged: the columns of a sweep are run, parameters, status, figures;"
                    f" found {', '.join(header)}")
    inputs = header[1:header.index("status")]
    columns: dict[str, np.ndarray] = {}
    for place, name in enumerate(header):
        texts = [row[place] for row in rows]
        if name == "status":
            columns[name] = np.array(texts, dtype=str)
        else:
            columns[name] = _column(path, name, texts, or_text=name in inputs)
    columns["run"] = _numbers_of_runs(path, columns["run"])
    return inputs, columns


def _lines(path: pathlib.Path) -> tuple[list[str], list[list[str]]]:
    """Header and rows, as many texts in each."""
    try:
        text = text_of(path)
    except ValueError as reason:
        raise Error(f"{path}: cannot be read: {reason}") from None
    whole = text[: text.rfind("\n") + 1].splitlines()
    if not whole:
        raise Error(f"{path}: damaged: it has no header")
    try:
        header, *rows = csv.reader(whole, strict=True)
    except csv.Error as reason:
        raise Error(f"{path}: damaged: {reason}") from None
    for line, row in enumerate(rows, 2):
        if len(row) != len(header):
            raise Error(f"{path}: damaged: {len(header)} columns are named, but line {line} has "
                        f"{len(row)}")
    return header, rows


def _column(path: pathlib.Path, name: str, texts: list[str], or_text: bool) -> np.ndarray:
    try:
        return np.array(texts, dtype=float)
    except ValueError as reason:
        if or_text:
            return np.array(texts, dtype=str)
        raise Error(f"{path}: damaged: {name}: {reason}") from None


def _numbers_of_runs(path: pathlib.Path, numbers: np.ndarray) -> np.ndarray:
    """The column "run" as integers; each once, in order."""
    if np.any(np.diff(numbers, prepend=0.0) <= 0) or np.any(numbers != np.floor(numbers)):
        raise Error(f"{path}: damaged: runs are numbered 1, 2, ... in order")
    return numbers.astype(int)


def column_of(sweep: Any, figure: str) -> NDArray[np.float64]:
    """(members,) a figure, of means over time as of steady rolling; NaN where there is none."""
    found = find_figure(figure, sweep)
    if found is None:
        raise Error(f"{sweep.directory}: no {figure} among its figures: it is no sweep of a wheel in "
                    f"three dimensions that touches the ground; there are: {', '.join(sweep.figures)}")
    return np.where(sweep.done, np.asarray(sweep[found], dtype=float), np.nan)

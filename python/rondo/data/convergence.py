# SPDX-License-Identifier: BSD-3-Clause
"""convergence.csv: what the iterations of LATIN came to."""
from __future__ import annotations

import pathlib
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from .errors import Error, unknown
from .files import read_table


class Convergence(Mapping[str, np.ndarray]):
    """convergence["indicator"]: array (iterations,). Columns: iteration, from 1; indicator and
    residual; of LATIN-PGD modes, after the iteration, and solves, so far. None has a unit."""

    def __init__(self, directory: pathlib.Path, analysis: Mapping[str, Any]) -> None:
        """directory: of a run; analysis: of its case."""
        self.path = path = directory / "convergence.csv"
        if not path.exists():
            raise Error(f'{path}: no such file: a crush with analysis.solver = "latin" or '
                        f'"latin-pgd" writes it; this run has analysis.kind = '
                        f'"{analysis.get("kind", "dynamic")}", solver = '
                        f'"{analysis.get("solver", "direct")}"')
        self._columns = read_table(path)
        for name in ("iteration", "indicator", "residual"):
            if name not in self._columns:
                raise Error(f"{path}: damaged: it has no column {name}")

    def __getitem__(self, name: str) -> np.ndarray:
        if name not in self._columns:
            raise unknown(self.path, "column", name, self._columns)
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        """Number of columns."""
        return len(self._columns)

    def __repr__(self) -> str:
        return (f"Convergence({self.path}, {len(self['iteration'])} iterations: "
                f"{', '.join(self._columns)})")

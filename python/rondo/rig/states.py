# SPDX-License-Identifier: BSD-3-Clause
"""What the test `vertical` found, which other tests begin with: heights and effective radii over load and pressure."""
from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..data.errors import Error

Row = Mapping[str, Any]


@dataclass(frozen=True)
class States:
    """Of the points of `vertical` that are done: by pressure, (load, height, effective radius) over rising load.
    `by_speed`: (height, effective radius) at the nominal load and pressure at other speeds."""

    curves: Mapping[float, np.ndarray]
    by_speed: Mapping[float, tuple[float, float]] = field(default_factory=dict)

    def height(self, pressure: float | None, load: float) -> float:
        """m, of the center above the ground."""
        return self._at(pressure, load, 1)

    def effective_radius(self, pressure: float | None, load: float) -> float:
        """m: speed over spin of free rolling."""
        return self._at(pressure, load, 2)

    def _at(self, pressure: float | None, load: float, column: int) -> float:
        known = sorted(self.curves)
        wanted = known[0] if pressure is None and known else float(pressure or 0.0)
        if not known:
            raise Error("the test vertical has no point that is done, and this test begins with its heights and radii")
        found = [_between(load, self.curves[one][:, 0], self.curves[one][:, column], "N") for one in known]
        return _between(wanted, np.array(known), np.array(found), "Pa")


def _between(wanted: float, at: np.ndarray, values: np.ndarray, unit: str) -> float:
    if not at[0] * (1.0 - 1e-9) <= wanted <= at[-1] * (1.0 + 1e-9):
        raise Error(f"the test vertical has no point that is done beyond {at[0]:g} to {at[-1]:g} {unit}, and {wanted:g} "
                    f"{unit} are asked for")
    return float(np.interp(wanted, at, values))


def states_of(rows: Iterable[Row], by_speed: Mapping[float, tuple[float, float]]) -> States:
    curves: dict[float, list[tuple[float, float, float]]] = {}
    for row in rows:
        if row["status"] == "done":
            curves.setdefault(float(row["pressure"] or 0.0), []).append((row["load"], row["height"], row["effective_radius"]))
    return States({pressure: np.array(sorted(found)) for pressure, found in curves.items()}, by_speed)

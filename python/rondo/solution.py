# SPDX-License-Identifier: BSD-3-Clause
"""A case solved in this process into arrays: rondo.solve, rondo.crush, rondo.steady_rolling."""
from __future__ import annotations

import json
import pathlib
from collections.abc import Mapping
from typing import Any

import numpy as np

from .data.errors import Error, NumericalError
from .data.history import History
from .data.html import table
from .data.mesh import Mesh
from .data.solid import RollingWheel, outer_radius_of
from .native import Place, core, documented, options_in, place_of, settings_of
from .simulation import RowsInMemory


class Solution:
    """What an analysis found, n nodes and t snapshots, as arrays in memory; names and frames are
    those of a run.

    info: as run.json; mesh; history; times, times_velocity (t,) [s], of a crush or an inflation the
    share of its load; angle, angle_velocity (t,) [rad]; center (t, 2) [m], (t, 3) of a wheel in three
    dimensions; displacement, velocity (t, n, 2) or (t, n, 3); contact_force (t, nb, 2) or
    (t, nb, 3) at mesh.boundary, as /contact/force of results.h5: normal, tangential along J n, which
    on flat ground points to -x [N/m]; None where nothing can be touched."""

    def __init__(self, found: dict[str, Any]) -> None:
        self.info: dict[str, Any] = json.loads(found["info"])
        self.mesh = Mesh(**found["mesh"])
        self.times: np.ndarray = found["times"]
        self.times_velocity: np.ndarray = found["times_velocity"]
        self.angle: np.ndarray = found["angle"]
        self.angle_velocity: np.ndarray = found["angle_velocity"]
        self.center: np.ndarray = found["center"]
        self.displacement: np.ndarray = found["displacement"]
        self.velocity: np.ndarray = found["velocity"]
        self.contact_force: np.ndarray | None = found.get("contact_force")
        columns: list[Mapping[str, Any]] = [{"name": name, "unit": unit}
                                            for name, unit in found["columns"]]
        self.history: History = RowsInMemory(
            "solution", [name for name, _ in found["columns"]], found["rows"], columns,
            crush=self.analysis == "crush", ground=self.contact_force is not None,
            instants=self.analysis == "steady-rolling")
        if self.mesh.is_solid and "steady" in self.info:
            steady = self.info["steady"]
            self.history.wheel = RollingWheel(steady["camber"], steady["turn_slip"], outer_radius_of({}, self.mesh),
                                              steady["speed"] < 0)

    @property
    def title(self) -> str:
        return str(self.info["title"])

    @property
    def analysis(self) -> str:
        """ "dynamic", "crush", "steady-rolling", "inflation"."""
        return str(self.info["analysis"])

    @property
    def steady(self) -> dict[str, Any]:
        """What run.json says of steady rolling: forces, slopes, powers; an error of others."""
        if "steady" not in self.info:
            raise Error(f'{self.title}: no steady rolling: analysis.kind is "{self.analysis}"')
        return dict(self.info["steady"])

    @property
    def n_snapshots(self) -> int:
        return len(self.times)

    def __repr__(self) -> str:
        return (f"Solution({self.title}; {self.analysis}, {self.mesh.n_nodes} nodes, "
                f"{self.n_snapshots} snapshots)")

    def _repr_html_(self) -> str:
        rows: list[tuple[str, Any]] = [("analysis", self.analysis), ("nodes", self.mesh.n_nodes),
                                       ("cells", self.mesh.n_cells),
                                       ("snapshots", self.n_snapshots)]
        found = self.info.get("steady", {})
        rows += [(name, found[name]) for name in ("force_x", "force_y", "slip_ratio", "height")
                 if name in found]
        return table(self.title, ("", ""), rows)


@documented("run")
def solve(case: Place, settings: Mapping[str, Any] | None = None, *, threads: int | None = None,
          reduced: Place | None = None, modes: int | None = None, estimate: bool = False,
          reduced_step: float | None = None, law_residual: float | None = None,
          modes_from: Place | None = None) -> Solution:
    """Solves a case of any analysis in this process and keeps what it finds in memory: no files,
    the same numbers as `rondo run`, but for the stress. output.snapshots says how many snapshots.
    A failure of the numerics is a NumericalError, a wrong case an InputError."""
    options = options_in("run", locals())
    found = core().solve(place_of(case), settings_of(settings), options)
    status, message = found["outcome"]
    if status == "failed":
        raise NumericalError(message)
    return Solution(found)


def crush(case: Place, settings: Mapping[str, Any] | None = None, **options: Any) -> Solution:
    """Solves a crush (docs/cases.md) into arrays; analysis.kind of the case must be "crush"."""
    return _of_kind("crush", solve(case, settings, **options))


def steady_rolling(case: Place, settings: Mapping[str, Any] | None = None,
                   **options: Any) -> Solution:
    """Solves steady rolling (docs/steady.md) into arrays; analysis.kind of the case must be
    "steady-rolling". steady has its forces and slopes."""
    return _of_kind("steady-rolling", solve(case, settings, **options))


def _of_kind(kind: str, solution: Solution) -> Solution:
    if solution.analysis != kind:
        raise Error(f'{solution.title}: analysis.kind is "{solution.analysis}", not "{kind}": '
                    f'another case, {{"analysis.kind": "{kind}"}} with what that needs among the '
                    "settings, or rondo.solve")
    return solution

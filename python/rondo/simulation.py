# SPDX-License-Identifier: BSD-3-Clause
"""A motion in this process, step by step: rondo.Simulation("case.toml")."""
from __future__ import annotations

import json
import math
import pathlib
import tomllib
import weakref
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import TracebackType
from typing import TYPE_CHECKING, Any

import numpy as np

from .data.errors import Error, InputError, NumericalError, UnknownNameError, unknown
from .data.history import History, units_of
from .data.html import table
from .data.mesh import Mesh
from .data.solid import outer_radius_of, rolling_wheel
from .data.names import find_name
from .matrices import Matrices, matrices_of
from .native import Place, core, documented, options_in, pairs_of, place_of, settings_of, whole_number

if TYPE_CHECKING:
    from ._core import Steps


MOST_STEPS = 2**62  # that the library can be asked for


class Row(Mapping[str, float]):
    """row["force_y"]: a column of history.csv over the steps since the row before: forces and
    torques as means, all else as it is at their end. step: steps made; time [s]; units."""

    def __init__(self, step: int, time: float, names: list[str], units: Mapping[str, str],
                 values: list[float]) -> None:
        self.step, self.time, self.units = step, time, units
        self._values = dict(zip(names, values, strict=True)) if values else {}

    def __getitem__(self, name: str) -> float:
        found = find_name(name, self._values)
        if not self._values:
            raise UnknownNameError(f"step {self.step}: there is no row before a step: advance(1)")
        if found is None:
            raise unknown(f"step {self.step}", "column", name, self._values)
        return self._values[found]

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __repr__(self) -> str:
        return f"Row(step {self.step}, t = {self.time:g} s: {', '.join(self._values)})"


def _number(key: str, value: Any) -> float:
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        fault = {"file": "", "line": 0, "column": 0, "key": key, "found": repr(value),
                 "message": "is no number", "allowed": "a number"}
        raise InputError(f"{key} = {value!r}: is no number (allowed: a number)", [fault]) from None


class RowsInMemory(History):
    """The history of a run in memory, as that of one in files."""

    def __init__(self, where: str, names: list[str], rows: np.ndarray,
                 columns: list[Mapping[str, Any]], crush: bool = False, ground: bool = True,
                 instants: bool = False) -> None:
        self.path, self.crush, self.ground = pathlib.Path(where), crush, ground
        self.instants = instants
        self._columns = {name: rows[:, k] for k, name in enumerate(names)}
        self.units = units_of(self._columns, columns)


@dataclass(frozen=True)
class Touching:
    """Contacts of the last step, c of them, as /contact/force of results.h5: normal, and
    tangential along J n, which on flat ground points to -x [N/m]; of a wheel in three dimensions
    also along t2 [N]. A node that two facets or bodies hold is there twice."""

    nodes: np.ndarray   # (c,)
    force: np.ndarray   # (c, 2) or (c, 3); normal > 0 presses
    gap: np.ndarray     # (c,) at the end of the step, <= 0 [m]
    sticks: np.ndarray  # (c,) bool


class Simulation:
    """A motion in time, made step by step by the library in this process: the same bits as
    `rondo run`.

    case: file, or a results directory that is resumed. settings: keys of the case, as
    {"ground.friction": 0.6}. output: results directory, written as by `rondo run`; without it
    nothing is written, and history has all rows. reduced: "case" for a reduced wheel that is made of
    the case, or a file of `rondo reduce` with its modes."""

    @documented("run")
    def __init__(self, case: Place, settings: Mapping[str, Any] | None = None,
                 output: Place | None = None, *, threads: int | None = None,
                 overwrite: bool = False, resume: bool = False, reduced: Place | None = None,
                 modes: int | None = None, reduced_step: float | None = None) -> None:
        """Begins a motion, or resumes one."""
        options = options_in("run", locals())
        file = place_of(case)
        if resume and file.is_dir():
            output, file = output or file, file / "case.toml"
        self.directory = None if output is None else place_of(output)
        self._steps: Steps = core().Steps(file, settings_of(settings),
                                          "" if self.directory is None else str(self.directory),
                                          options)
        self._close = weakref.finalize(self, self._steps.close)  # at the latest when Python ends
        columns = self._steps.columns()
        self._names = [name for name, _ in columns]
        self.units: dict[str, str] = dict(columns)
        self._ground = "ground" in self.case
        self._mesh: Mesh | None = None

    # Steps

    def advance(self, steps: int = 1) -> int:
        """Makes so many steps, fewer where the run ends before; returns how many. Ctrl-C ends it
        after the step in hand: the simulation can go on, and has written a checkpoint where it
        writes files. Other threads run meanwhile."""
        made = self._steps.advance(min(whole_number("advance: steps", steps, 0), MOST_STEPS))
        if self._steps.trouble():
            raise NumericalError(self._steps.trouble())
        return made

    def advance_to(self, time: float) -> int:
        """To the first step at or after a time [s]."""
        time = _number("advance_to: time", time)
        if not math.isfinite(time):
            raise InputError(f"advance_to: time = {time!r}: is no time [s]")
        last = math.ceil(min(max(0.0, time / self.dt * (1.0 - 1e-12)), float(self.n_steps)))
        return self.advance(max(0, last - self.step))

    def steps(self, every: int = 1) -> Iterator[Row]:
        """To the end, a row after each so many steps: `for row in simulation.steps(100)`."""
        every = whole_number("steps: every", every, 1)
        while not self.is_over:
            self.advance(every)
            yield self.now

    def run(self) -> Simulation:
        """All steps that are left."""
        self.advance(self.n_steps - self.step)
        return self

    def set(self, settings: Mapping[str, float], over: float = 0.0) -> None:
        """Leads motion and loads of the case over to new values, {"rim.brake": 300.0}: linearly in
        a time `over` [s], by default within half a step, from the next step but one on. What a
        table of the case says of later times is dropped. Only keys that are tables in time:
        `keys`; all others, and values that are not allowed, are an InputError, and nothing is set."""
        self._steps.drive([(key, _number(key, value)) for key, value in pairs_of(settings)],
                          _number("over", over))

    def get(self, key: str) -> float:
        """What a table in time of the case says now."""
        return self._steps.driven(key)

    @property
    def keys(self) -> list[str]:
        """Of the case's tables in time, which set() takes."""
        return self._steps.driven_keys()

    @property
    def case_text(self) -> str:
        """The case as TOML, all defaults and what was set written out: `rondo run` makes the same
        motion of it."""
        return self._steps.case_text()

    @property
    def case(self) -> dict[str, Any]:
        """The same, read."""
        return tomllib.loads(self.case_text)

    # Where it is

    @property
    def step(self) -> int:
        """Steps made."""
        return self._steps.step()

    @property
    def n_steps(self) -> int:
        """Steps of the whole run."""
        return self._steps.n_steps()

    @property
    def dt(self) -> float:
        """Length of a step [s]."""
        return self._steps.dt()

    @property
    def time(self) -> float:
        """Of the displacement [s]."""
        return self._steps.time()

    @property
    def is_over(self) -> bool:
        """At its end, failed or closed: there are no more steps to make."""
        return self._steps.is_over()

    # What is there. Arrays look at the simulation's own memory: a later step changes them.

    @property
    def displacement(self) -> np.ndarray:
        """(n, 2) or (n, 3) [m], co-rotating frame, of free bodies fixed frame; read-only. What it
        shows is of the last step: copy() keeps it."""
        return self._there(self._steps.displacement())

    @property
    def velocity(self) -> np.ndarray:
        """(n, 2) or (n, 3) [m/s], as the displacement, half a step before it."""
        return self._there(self._steps.velocity())

    @property
    def angle(self) -> float:
        """Of the co-rotating frame, counter-clockwise [rad]."""
        return float(self._there(self._steps.frame())[0])

    @property
    def center(self) -> np.ndarray:
        """(2,) in the fixed frame [m]; (3,) of a wheel in three dimensions: along t1, n and t2."""
        center: np.ndarray = self._there(self._steps.frame())[1]
        return center

    @property
    def position(self) -> np.ndarray:
        """(n, 2) or (n, 3) places of the nodes in the fixed frame [m], as Run.position(): an array
        of its own, which later steps do not change."""
        arms = self.mesh.coordinates + self.displacement
        if self.mesh.is_solid:
            raise Error("position: of a wheel in three dimensions displacement, angle and center "
                        "are at hand; a run in files has position(k)")
        cos, sin = math.cos(self.angle), math.sin(self.angle)
        places = self.center + arms @ np.array([[cos, sin], [-sin, cos]])
        return np.where(self.mesh.free[:, None], arms, places)

    @property
    def touching(self) -> Touching:
        """Nodes in contact in the last step."""
        nodes, force, gap, sticks = self._there(self._steps.contacts())
        return Touching(nodes, force, gap, sticks.astype(bool))

    @property
    def now(self) -> Row:
        """What history.csv would say of the steps since the last call of advance(); empty before
        the first."""
        return Row(self.step, self.time, self._names, self.units, self._steps.row())

    @property
    def history(self) -> History:
        """All rows so far. Of a run in files, what has been written of history.csv."""
        columns: list[Mapping[str, Any]] = [{"name": name, "unit": unit}
                                            for name, unit in self.units.items()]
        rows = self._steps.rows()
        history: History
        if rows is None:
            assert self.directory is not None
            history = History(self.directory / "history.csv", ground=self._ground, columns=columns)
        else:
            history = RowsInMemory("simulation", self._names, rows, columns, ground=self._ground)
        if self.mesh.is_solid:
            case = self.case
            history.wheel = rolling_wheel(case, outer_radius_of(case, self.mesh))
        return history

    @property
    def mesh(self) -> Mesh:
        if self._mesh is None:
            self._mesh = Mesh(**self._steps.mesh())
        return self._mesh

    @property
    def info(self) -> dict[str, Any]:
        """run.json as far as it has come."""
        info: dict[str, Any] = json.loads(self._steps.info())
        return info

    def matrices(self) -> Matrices:
        """Mass, damping, stiffness and gyroscopic matrix of the motion as scipy.sparse has them, and
        rows of its contacts: docs/operators.md. Those of a body with a constant stiffness."""
        return matrices_of(self._steps, lambda: (self.angle, self.center, self.displacement))

    # Its end

    def save(self) -> None:
        """A checkpoint in the results directory, from which `rondo run --resume` goes on."""
        self._steps.save()

    def close(self) -> None:
        """Ends it where it is. Files are closed: before its end it is an interrupted run, which can
        be resumed. Arrays stay."""
        self._close()

    def __enter__(self) -> Simulation:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self.close()

    def __repr__(self) -> str:
        where = "in memory" if self.directory is None else str(self.directory)
        return (f"Simulation({self.info['title']}; {where}, step {self.step} of {self.n_steps}, "
                f"t = {self.time:g} s)")

    def _repr_html_(self) -> str:
        where = "in memory" if self.directory is None else self.directory
        rows: list[tuple[str, Any]] = [("step", f"{self.step} of {self.n_steps}"),
                                       ("time (s)", self.time), ("step length (s)", self.dt),
                                       ("nodes", self.mesh.n_nodes), ("results", where)]
        if self._steps.trouble():
            rows.append(("failed", self._steps.trouble()))
        rows += [(key, self.get(key)) for key in self.keys]
        return table(self.info["title"], ("", ""), rows)

    def _there(self, found: Any) -> Any:
        if found is None:
            why = self._steps.trouble() or (
                "the run had come to its end when it was resumed: rondo.open reads it"
                if self.is_over else "no step has been made since the run was resumed: advance(1)")
            raise Error(f"step {self.step}: its fields are not at hand: {why}")
        return found

# SPDX-License-Identifier: BSD-3-Clause
"""A parametric study: the directory that `rondo sweep` writes, as a table."""
from __future__ import annotations

import os
import pathlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from .axes import Quantities
from .errors import STATUS, Error, UnfinishedRunError, unknown
from .files import check_format, read_json, read_table, require, some
from .history import units_of
from .html import sweep_html
from .names import find_figure
from .run import Run, open_run
from .sweep_axes import sweep_in_axes
from .sweep_table import read_members
from .tables import frame_of

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

UNITS = {"run": "1", "steps": "1", "end_time_s": "s"}  # of the columns before the results
TARGET = "target."  # what begins the column of a target, as "target.force_y"
SAME = 1e-9  # relative: a number that is asked for and one of the table


@dataclass(frozen=True)
class Parameter:
    """What the members differ in. kind: "values"; "uniform", sampled between two bounds; of
    earlier versions "target", found for each member such that the force in the column "target.…"
    before it is reached. goes_with: the first of the keys whose values go together; "": by itself."""

    key: str
    unit: str  # "1" without dimension
    kind: str
    goes_with: str = ""


def open_sweep(path: str | os.PathLike[str], unfinished: bool = False) -> Sweep:
    """Opens the directory of a sweep. `unfinished`: also one that has not come to its end; what is
    done of it is read. A sweep of which some members failed has come to its end."""
    _demand_collected(pathlib.Path(path))
    sweep = _read(require(path, "sweep.json", beside="results.csv"))
    if sweep.status not in ("done", "failed") and not unfinished:
        meaning = STATUS.get(sweep.status, "not known to this package")
        raise UnfinishedRunError(
            f'{sweep.directory}: a sweep of status "{sweep.status}": {meaning}. '
            f"{counts(sweep)}. {goes_on(sweep)}; "
            f'rondo.open_sweep("{sweep.directory}", unfinished=True) reads what is there')
    return sweep


def _demand_collected(directory: pathlib.Path) -> None:
    """Of a sweep that was made in shards, its tables."""
    shards = sorted(found.parent.name for found in directory.glob("shards/*/rows.json"))
    if shards and not (directory / "sweep.json").is_file():
        raise UnfinishedRunError(f"{directory}: shards of a sweep, which have no table yet "
                                 f"({some(shards)}): \"rondo sweep STUDY.toml -o {directory} --collect\" "
                                 "writes it")


def goes_on(sweep: Sweep) -> str:
    """What to do about a sweep that has not come to its end."""
    return (f'"rondo sweep {sweep.info.get("study", "STUDY.toml")} -o {sweep.directory} --resume" '
            "goes on with it")


def counts(sweep: Sweep) -> str:
    """How many members there are of each status: "200 members: 198 done, 2 failed"."""
    status, number = np.unique(sweep["status"], return_counts=True)
    parts = [f"{n} {name}" for name, n in sorted(zip(status, number), key=lambda part: -part[1])]
    return f"{len(sweep)} members: {', '.join(parts) or 'none'}"


class Sweep:
    """A table with a row for each member, r rows: sweep["force_y_mean"], sweep["ground.friction"]
    are its columns (r,); of texts, arrays of str. Figures of a member without results are NaN.

    directory; info: sweep.json; parameters: by their key, with those of targets; figures: names;
    units: of each column but the status, "1" without dimension."""

    # Pictures: what rondo/pictures.py gives this class, as nothing here knows how to draw.
    plot_main_effects: Callable[..., Figure]
    plot_map: Callable[..., Axes]
    plot_curves: Callable[..., Axes]
    plot_spread: Callable[..., Axes]
    plot_traction: Callable[..., Axes]
    plot_carpet: Callable[..., Axes]
    plot_tyre_curves: Callable[..., Figure]
    plot_friction_ellipse: Callable[..., Axes]
    report: Callable[..., pathlib.Path]

    def __init__(self, directory: pathlib.Path, info: dict[str, Any],
                 parameters: dict[str, Parameter], columns: dict[str, np.ndarray],
                 units: dict[str, str]) -> None:
        self.directory, self.info, self.parameters = directory, info, parameters
        self.units = units
        self._columns = columns
        self.figures = [name for name in columns
                        if name not in parameters and name not in ("run", "status")]

    def __repr__(self) -> str:
        return f"Sweep({self.directory}: {self.title}; {self.analysis}, {counts(self)})"

    def __str__(self) -> str:
        """With a line for each parameter."""
        wide = max((len(key) for key in self.parameters), default=0)
        lines = [f"  {key:{wide}}  {_extent(self[key], parameter)}"
                 for key, parameter in self.parameters.items()]
        return "\n".join([repr(self), *lines])

    def _repr_html_(self) -> str:
        return sweep_html(self)

    def to_pandas(self) -> pandas.DataFrame:
        """A pandas.DataFrame: a row for each member, index "run"; attrs["units"] of the columns."""
        return frame_of(self._columns, self.units, "sweep.to_pandas()", "run")

    # What it is

    @property
    def title(self) -> str:
        return str(self.info.get("title", self.directory.name))

    @property
    def status(self) -> str:
        """Of the whole sweep: "done"; "failed", some members did; "running" or "interrupted"."""
        return str(self.info.get("status"))

    @property
    def analysis(self) -> str:
        """ "dynamic", "crush", "steady-rolling" or "inflation"."""
        return str(self.info.get("analysis"))

    @property
    def failures(self) -> dict[int, str]:
        """What was the matter with the members that failed, by their number; of all members, in a
        selection as well."""
        return {int(told["run"]): str(told["message"]) for told in self.info.get("failures", [])}

    # Its columns

    @property
    def names(self) -> list[str]:
        """Of all columns."""
        return list(self._columns)

    def __getitem__(self, name: str) -> np.ndarray:
        found = find_figure(name, self._columns)
        if found is None:
            raise unknown(self.directory, "column", name, self._columns)
        return self._columns[found]

    def unit_of(self, name: str) -> str:
        """Of the column that `sweep[name]` is."""
        return self.units.get(find_figure(name, self.units) or name, "unknown")

    def __contains__(self, name: object) -> bool:
        """Whether there is a column of just this name."""
        return name in self._columns

    def __len__(self) -> int:
        """Number of members."""
        return len(self._columns["run"])

    @cached_property
    def done(self) -> np.ndarray:
        """(r,) mask of the members with results."""
        return np.asarray(self["status"] == "done")

    @property
    def varied(self) -> list[str]:
        """The parameters in which these members differ, without those that a target or another
        parameter decides."""
        return [key for key, parameter in self.parameters.items()
                if parameter.kind != "target" and len(np.unique(self[key])) > 1
                and not self._is_decided(parameter)]

    def leader_of(self, key: str) -> str:
        """Of keys whose values go together the first; of others the key itself."""
        return self.parameters[key].goes_with or key

    def _is_decided(self, parameter: Parameter) -> bool:
        """By the first of the keys that it goes with: a value for each of that one's."""
        if not parameter.goes_with:
            return False
        pairs = set(zip(self[parameter.goes_with].tolist(), self[parameter.key].tolist()))
        return len(pairs) == len(np.unique(self[parameter.goes_with]))

    def is_sampled(self, name: str) -> bool:
        """Whether values are not shared by members: of a sampled parameter, one that a target
        decides, a figure."""
        return name not in self.parameters or self.parameters[name].kind in ("uniform", "target")

    # Its rows

    def rows(self) -> Iterator[dict[str, Any]]:
        """The members one after another, column by column."""
        for k in range(len(self)):
            yield {name: column[k].item() for name, column in self._columns.items()}

    def __iter__(self) -> Iterator[dict[str, Any]]:
        return self.rows()

    def select(self, wanted: Mapping[str, Any]) -> Sweep:
        """The members with these values: {"ground.friction": 0.3}; of a list, with one of them."""
        mask = np.ones(len(self), dtype=bool)
        for name, values in wanted.items():
            several = isinstance(values, (Sequence, np.ndarray)) and not isinstance(values, str)
            matching = np.zeros(len(self), dtype=bool)
            for value in values if several else [values]:
                matching |= _equal(self[name], value)
            if not matching.any():
                raise Error(f"{self.directory}: no member with {name} {values!r}; there are: "
                            f"{some(np.unique(self[name]))}")
            mask &= matching
        if not mask.any():
            raise Error(f"{self.directory}: no member with all of {dict(wanted)}")
        return self.where(mask)

    def where(self, mask: Any) -> Sweep:
        """The members of a mask (r,): sweep.where(sweep["ground.friction"] > 0.2)."""
        chosen = np.asarray(mask)
        if chosen.dtype != bool or chosen.shape != (len(self),):
            raise Error(f"{self.directory}: a mask has True or False for each of the {len(self)} "
                        f"members; this is {chosen.dtype} of shape {chosen.shape}")
        if not chosen.any():
            raise Error(f"{self.directory}: no member is chosen by this mask")
        columns = {name: column[chosen] for name, column in self._columns.items()}
        return Sweep(self.directory, self.info, self.parameters, columns, self.units)

    def with_figure(self, name: str, values: Any, unit: str) -> Sweep:
        """With one figure more, (r,) numbers in `unit`, "1" without dimension:
        sweep.with_figure("traction", sweep["force_x_mean"] / sweep["force_y_mean"], "1")."""
        if name in self._columns:
            raise Error(f"{self.directory}: there is a column {name!r} already")
        column = np.asarray(values, dtype=float)
        if column.shape != (len(self),):
            raise Error(f"{self.directory}: {name}: a number for each of the {len(self)} members "
                        f"is expected; this is of shape {column.shape}")
        return Sweep(self.directory, self.info, self.parameters, {**self._columns, name: column},
                     {**self.units, name: unit})

    def in_axes(self, system: str, effective_radius: float | None = None) -> Quantities:
        """Forces and moments of the ground on wheels in three dimensions, slip angle, camber and slip ratio
        as arrays (r,) in the axes and signs of a system, as of History.in_axes(); NaN of members without
        results. Of motions in time they are made of the means, with the mean height of the center.
        An error of other bodies, of crushes, and of members that roll backwards."""
        return sweep_in_axes(self, system, effective_radius)

    def run_directory(self, number: int) -> pathlib.Path:
        """Where the results of a member are; `number` as in the column "run", from 1."""
        members = int(self.info["members"])
        if not 1 <= number <= members:
            raise unknown(self.directory, "run", number, [f"1 to {members}"])
        return self.directory / "runs" / f"{number:0{max(4, len(str(members)))}d}"

    def run(self, number: int, unfinished: bool = False) -> Run:
        """The run of a member, by its number in the column "run", from 1. One that the table itself
        calls failed is opened as well."""
        directory = self.run_directory(number)
        status = self["status"][self["run"] == number]
        if "waiting" in status:
            raise UnfinishedRunError(f"{self.directory}: run {number} has not begun; "
                                     f"{goes_on(self)}")
        return open_run(directory, unfinished=unfinished or "failed" in status)

    @cached_property
    def timings(self) -> dict[str, np.ndarray]:
        """timings.csv: "run", "worker", "wall_s", a row for each member computed so far; all of
        them, of a selection as well."""
        return read_table(self.directory / "timings.csv")


def _extent(values: np.ndarray, parameter: Parameter) -> str:
    """What a parameter goes through, in words."""
    there = np.unique(values)
    unit = "" if parameter.unit == "1" or values.dtype.kind == "U" else f" {parameter.unit}"
    if values.dtype.kind == "U":
        return some(there)
    there = there[np.isfinite(there)]
    if not len(there):
        return "no values yet"
    ends = " to ".join(f"{value:g}" for value in np.unique([there[0], there[-1]]))
    how = {"uniform": "sampled", "target": "for the target"}.get(parameter.kind,
                                                               f"{len(there)} values")
    return f"{ends}{unit}, {how}" if len(there) > 1 else f"{ends}{unit}"


def _equal(column: np.ndarray, value: Any) -> np.ndarray:
    """(r,) mask: where a column has a value."""
    if column.dtype.kind == "U":
        return np.asarray(column == (str(value).lower() if isinstance(value, bool) else str(value)))
    try:
        return np.isclose(column, float(value), rtol=SAME, atol=0)
    except (TypeError, ValueError):
        return np.zeros(len(column), dtype=bool)


def _read(directory: pathlib.Path) -> Sweep:
    path = directory / "sweep.json"
    info = read_json(path)
    check_format(path, "sweep", info.get("format"))
    try:
        members, status = int(info["members"]), str(info["status"])
        said = [Parameter(str(p["key"]), "1" if p["unit"] == "-" else str(p["unit"]),
                          str(p["kind"]), str(p.get("with", ""))) for p in info["parameters"]]
    except (KeyError, TypeError, ValueError) as reason:
        raise Error(f"{path}: damaged: {reason!r}") from None
    table = directory / "results.csv"
    inputs, columns = read_members(table)
    targets = {name: Parameter(name, "N/m", "values")
               for name in inputs if name.startswith(TARGET)}
    known = {parameter.key: parameter for parameter in said} | targets
    if set(known) != set(inputs):
        raise Error(f"{table}: damaged: its parameters are {', '.join(inputs) or 'none'}, but "
                    f"those of sweep.json {', '.join(p.key for p in said) or 'none'}")
    rows = len(columns["run"])
    if rows > members or (rows < members and status in ("done", "failed")):
        raise Error(f"{table}: damaged: {rows} members, but there are {members} in sweep.json")
    said_units = UNITS | units_of(columns, info.get("columns", ()))
    units = {name: known[name].unit if name in known else said_units.get(name, "unknown")
             for name in columns if name != "status"}
    return Sweep(directory, info, {key: known[key] for key in inputs}, columns, units)

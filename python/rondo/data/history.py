# SPDX-License-Identifier: BSD-3-Clause
"""history.csv: forces, contact and energies against time; of an inflation its figures against the share
of the loads."""
from __future__ import annotations

import pathlib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from .axes import Quantities, convert, own
from .errors import Error, unknown
from .files import read_table
from .html import history_html
from .names import ENDINGS, find_name
from .tables import frame_of

if TYPE_CHECKING:
    import pandas

    from .solid import RollingWheel

FORCES = ("force_x", "force_y", "force_lateral", "torque", "moment_aligning",
          "moment_overturning")  # of the ground on the body
TIME, SHARE = "time_s", "load_share"  # what rows go over; the latter of an inflation


def between(from_time: float | None, to_time: float | None, unit: str = "s") -> str:
    """A window of time in words."""
    ends = [f"{word} {time:g}" for word, time in (("from", from_time), ("to", to_time))
            if time is not None]
    return f"{' '.join(ends)} {unit}" if ends else "at any time"


def units_of(names: Iterable[str], columns: Sequence[Mapping[str, Any]]) -> dict[str, str]:
    """Unit of each column that has a known one. columns: "columns" of run.json, empty where a run
    of an earlier version has none: then by the endings of the names."""
    said = {str(column["name"]): str(column["unit"]) for column in columns}
    if said:
        return {name: said[name] for name in names if name in said}
    return {name: unit for name in names for ending, unit in ENDINGS.items()
            if name.endswith(ending)}


class History(Mapping[str, np.ndarray]):
    """history["force_y"]: array (rows,); history.units["force_y"]: its unit.

    wheel: what its axes are, of the motion of a wheel in three dimensions; else None."""

    wheel: RollingWheel | None = None

    def __init__(self, path: pathlib.Path, crush: bool = False, ground: bool = True,
                 columns: Sequence[Mapping[str, Any]] = (), instants: bool = False) -> None:
        self.path, self.crush, self.ground, self.instants = path, crush, ground, instants
        self._columns = read_table(path)
        try:
            self.units = units_of(self._columns, columns)
        except (KeyError, TypeError) as reason:
            raise Error(f"{path.parent / 'run.json'}: damaged: its columns: {reason!r}") from None
        if crush:
            self.units[TIME] = "1"  # also where run.json does not say so

    def __getitem__(self, name: str) -> np.ndarray:
        found = find_name(name, self._columns)
        if found is None:
            raise unknown(self.path, "column", name, self._columns)
        return self._columns[found]

    def unit_of(self, name: str) -> str:
        """Of the column that `history[name]` is."""
        return self.units.get(find_name(name, self.units) or name, "unknown")

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        """Number of columns."""
        return len(self._columns)

    def __repr__(self) -> str:
        return f"History({self.path}, {self.n_rows} rows: {', '.join(self._columns)})"

    def _repr_html_(self) -> str:
        return history_html(self)

    def to_pandas(self) -> pandas.DataFrame:
        """A pandas.DataFrame: a row for each interval, index "time_s", of an inflation "load_share";
        attrs["units"] of the columns."""
        return frame_of(self._columns, self.units, "history.to_pandas()", self.abscissa)

    @property
    def abscissa(self) -> str:
        """What rows go over: "time_s"; of an inflation "load_share"."""
        return SHARE if SHARE in self._columns else TIME

    @property
    def n_rows(self) -> int:
        return len(self[self.abscissa])

    @property
    def names(self) -> list[str]:
        return list(self._columns)

    def check_end(self, end: float | None = None, rows: int | None = None) -> None:
        """That the history of a run that is done reaches its end, the last time [s] or the number
        of rows: an error where the file has lost some."""
        time = self[self.abscissa]
        if rows is not None and len(time) != rows:
            raise Error(f"{self.path}: damaged: {len(time)} rows, but run.json says that the run "
                        f"is done, with {rows}")
        last = time[-1] if len(time) else 0.0
        if end is not None and abs(last - end) > 1e-9 * abs(end):
            raise Error(f"{self.path}: damaged: it ends at {last:g} s, but run.json says that the "
                        f"run is done, to {end:g} s")

    def need_time(self, what: str) -> None:
        """An error of an inflation: what is of a course in time only."""
        if self.abscissa == SHARE:
            raise Error(f"{self.path}: an inflation has no {what}: its rows are equilibria, over the "
                        f"column {SHARE}")

    def need_ground(self, name: str) -> None:
        """An error where a column is of the ground's forces and there is no ground."""
        if not self.ground and name in FORCES:
            raise Error(f"{self.path}: no ground: the case has no [ground], so {name} is zero all "
                        "along")

    def window(self, from_time: float | None = None, to_time: float | None = None) -> np.ndarray:
        """Mask (rows,) of the rows whose whole interval is between the two times [s]; None: no
        bound. At least one, or an error."""
        self.need_time("rows between two times")
        end = self[TIME]
        begin = end if self.instants else np.append(0.0, end)[:-1]
        chosen: np.ndarray = np.ones(len(end), dtype=bool)
        if from_time is not None:
            chosen &= begin >= from_time
        if to_time is not None:
            chosen &= end <= to_time
        if not chosen.any():
            there = f"there are {begin[0]:g} to {end[-1]:g} s" if len(end) else "it has no rows"
            raise Error(f"{self.path}: no rows {between(from_time, to_time)}; {there}")
        return chosen

    def mean(self, name: str, from_time: float | None = None,
             to_time: float | None = None) -> float:
        """Mean over time of a column, in its unit: rows weighted by their intervals, of which
        forces and torque are the means. Of steady rolling over the places of a sector's pass."""
        chosen, weights = self.weights(from_time, to_time)
        self.need_ground(name)
        return float(np.average(self[name][chosen], weights=weights))

    def weights(self, from_time: float | None = None,
                to_time: float | None = None) -> tuple[np.ndarray, np.ndarray]:
        """Of means over time: the mask (rows,) of window(), and the weights of the rows chosen by it. An
        error of what has no course in time."""
        if self.crush:
            raise Error(f"{self.path}: a crush has no means over time")
        self.need_time("means over time")
        chosen = self.window(from_time, to_time)
        time = self[TIME]
        spans = np.ones(len(time)) if self.instants else np.diff(time, prepend=0.0)
        return chosen, spans[chosen]

    def in_axes(self, system: str, effective_radius: float | None = None) -> Quantities:
        """Forces and moments of the ground on a wheel in three dimensions, slip angle, camber and slip ratio
        as arrays (rows,) in the axes and signs of a system: "iso-w", "tydex-h", "tydex-c", "sae",
        "adapted-sae" or "rondo" (docs/conventions.md). Moments are reduced with the height of the center at
        the end of each row. effective_radius [m], V / w of free rolling: that of the slip ratio; None: the
        slip ratio has the outer radius, as the column. An error of other bodies, and of rolling backwards."""
        if "force_lateral" not in self:
            raise Error(f"{self.path}: no wheel in three dimensions on a ground: other bodies have no axes beside "
                        "rondo's own; use the columns as they are")
        wheel = self.wheel
        if wheel is None:
            raise Error(f"{self.path}: axes are of wheels that roll, and this history does not say how the wheel "
                        "stands: it is a crush, or was solved into memory; write the run with rondo.run and open its "
                        "directory")
        if wheel.backwards:
            raise Error(f"{self.path}: the wheel rolls backwards, for which the systems define their signs "
                        "differently: run the mirror image, with speed and angular_velocity > 0")
        columns = ("force_x", "force_y", "force_lateral", "moment_aligning", "moment_overturning", "torque",
                   "slip_angle", "slip_ratio")
        found = own(**{name: self[name] for name in columns}, height=self["center_y_m"], camber=wheel.camber,
                    turn_slip=wheel.turn_slip, time=np.asarray(self[TIME], dtype=float))
        return convert(found, system, effective_radius, None if effective_radius is None else wheel.radius)

# SPDX-License-Identifier: BSD-3-Clause
"""What a sweep of a wheel in three dimensions says of it as a tyre: lateral force and aligning moment
over the slip angle, and two such sweeps beside each other (docs/wheel3d.md)."""
from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .errors import Error
from .sweep_table import column_of

if TYPE_CHECKING:
    from .sweep import Sweep

Array = NDArray[np.float64]
ANGLE = "motion.slip_angle"
LATERAL, ALIGNING, ALONG, LOAD, SLIP = ("force_lateral", "moment_aligning", "force_x", "force_y",
                                        "slip_ratio")
LOADS = {"rim.force_y": "analysis.load"}  # what is the load too, with the other sign
SAME = 1e-9  # relative: values of a parameter that are one
NAMES = {"dynamic": "transient", "steady-rolling": "steady"}  # of analyses, in figures


def name_of_parameter(key: str) -> str:
    """A load is one, whether a rim bears it in time or a steady state is asked for at it."""
    return LOADS.get(key, key)


def key_of(sweep: Sweep, name: str) -> str | None:
    """The parameter of the sweep that has this name."""
    return next((key for key in sweep.parameters if name_of_parameter(key) == name), None)


def numbers_of(sweep: Sweep, name: str) -> Array:
    """(members,) a parameter as a number, of a table in time its last value; loads are > 0."""
    key = key_of(sweep, name)
    if key is None:
        raise Error(f"{sweep.directory}: no parameter {name}; there are: {', '.join(sweep.parameters)}")
    column = sweep[key]
    if column.dtype.kind == "U":
        try:
            tables = [json.loads(text) for text in column.tolist()]
            column = np.array([table[-1][1] if isinstance(table, list) else table for table in tables],
                              dtype=float)
        except (ValueError, TypeError, IndexError):
            raise Error(f"{sweep.directory}: {key} is neither a number nor a table over time: curves "
                        "of a tyre are told apart by numbers; select() one value of it") from None
    return np.asarray(column, dtype=float) * (-1.0 if key in LOADS else 1.0)


def with_values(sweep: Sweep, wanted: Mapping[str, float]) -> Sweep:
    """The members with these values of parameters, by their names."""
    mask = np.ones(len(sweep), dtype=bool)
    for name, value in wanted.items():
        if key_of(sweep, name) is not None:
            mask &= np.isclose(numbers_of(sweep, name), value, rtol=SAME, atol=1e-12)
    if not mask.any():
        raise Error(f"{sweep.directory}: no member with all of {dict(wanted)}")
    return sweep.where(mask)


def need_angles(sweep: Sweep) -> None:
    """An error where the slip angle does not vary."""
    if ANGLE not in sweep.varied:
        raise Error(f"{sweep.directory}: {ANGLE} does not vary, over which curves of a tyre go; vary "
                    f"it in the study; what varies: {', '.join(sweep.varied) or 'nothing'}")


def others_of(sweep: Sweep) -> list[str]:
    """The names of the parameters that vary besides the slip angle."""
    need_angles(sweep)
    return [name_of_parameter(key) for key in sweep.varied if key != ANGLE]


def name_of(sweep: Sweep) -> str:
    """ "transient" or "steady"."""
    return NAMES.get(sweep.analysis, sweep.analysis)


@dataclass(frozen=True)
class Pair:
    """A member of one sweep and that of another with the same values of all parameters that both
    vary. Forces in N, moments in N·m: (2,) first and second."""

    parameters: dict[str, float]
    load: Array
    lateral: Array
    aligning: Array

    @property
    def difference(self) -> float:
        """Of the lateral forces, second less first, over the vertical force [1]."""
        return float((self.lateral[1] - self.lateral[0]) / self.load[0])


def pairs(first: Sweep, second: Sweep) -> list[Pair]:
    """The members that both have, in the order of the first."""
    of_second = [name_of_parameter(key) for key in second.parameters]
    keys = [name for name in map(name_of_parameter, first.parameters) if name in of_second]
    if ANGLE not in keys:
        raise Error(f"{second.directory}: no {ANGLE} that it shares with {first.directory}")
    for sweep, other in ((first, second), (second, first)):
        alone = [key for key in sweep.varied if name_of_parameter(key) not in keys]
        if alone:
            raise Error(f"{sweep.directory}: {', '.join(alone)} varies, and {other.directory} does "
                        "not have it: select() one value of it")
    columns = [[column_of(sweep, name) for name in (LOAD, LATERAL, ALIGNING)]
               for sweep in (first, second)]
    of_first, beside_them = ({key: numbers_of(sweep, key) for key in keys} for sweep in (first, second))
    found = []
    for row in range(len(first)):
        values = {key: float(of_first[key][row]) for key in keys}
        beside = _row_with(beside_them, values)
        if beside is None:
            continue
        figures = [np.array([one[row], other[beside]]) for one, other in zip(*columns)]
        if np.isfinite(figures).all():
            found.append(Pair(values, *figures))
    if not found:
        raise Error(f"{first.directory} and {second.directory} have no member in common that is done "
                    f"in both, by {', '.join(keys)}")
    return found


def _row_with(columns: dict[str, Array], values: dict[str, float]) -> int | None:
    rows = np.logical_and.reduce([np.isclose(columns[key], value, rtol=SAME, atol=1e-12)
                                  for key, value in values.items()])
    return int(np.flatnonzero(rows)[0]) if rows.any() else None


def table_of(found: Sequence[Pair], names: Sequence[str]) -> str:
    """The pairs as text, a line each; "of F_n": how far the lateral forces are apart, over the
    vertical one. names: of the two sweeps."""
    keys = list(found[0].parameters)
    heads = [*(_head(key) for key in keys), "F_n (N)", "F_lateral (N)", names[1], "M_n (N m)",
             names[1], "of F_n"]
    rows = [[*(_said(key, value) for key, value in pair.parameters.items()), f"{pair.load[0]:.0f}",
             *(f"{value:.1f}" for value in (*pair.lateral, *pair.aligning)),
             f"{100 * pair.difference:+.2f} %"] for pair in found]
    wide = [max(len(row[k]) for row in [heads, *rows]) for k in range(len(heads))]
    return "\n".join("  ".join(text.rjust(width) for text, width in zip(row, wide))
                     for row in [heads, *rows])


def _is_angle(key: str) -> bool:
    return key.endswith(("slip_angle", "camber"))


def _head(key: str) -> str:
    return key.split(".")[-1] + (" (deg)" if _is_angle(key) else "")


def _said(key: str, value: float) -> str:
    return f"{np.degrees(value):.4g}" if _is_angle(key) else f"{value:.6g}"

# SPDX-License-Identifier: BSD-3-Clause
"""What the figures of a sweep share: columns as they are drawn, members that have no value."""
from __future__ import annotations

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from .. import style
from ..data.errors import Error, unknown
from .labels import LABELS, column_label, readable
from .marks import minus

if TYPE_CHECKING:
    from ..data.sweep import Sweep

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

OVER_TIME = ("mean", "peak", "fluctuation")  # in names of figures
FIGURE_LABELS = {"energy_residual_relative": "imbalance of energy, relative",
                 "contact_residual_max": "largest contact residual", "end_time_s": "end time",
                 "dissipation_friction": "dissipated by friction",
                 "friction_power": "power of friction", "impact_power": "power of impacts",
                 "material_power": "power of viscous materials", "damping_power": "power of damping",
                 "scheme_share": "share of the discretisation in the power"}
ROUND_OFF = 1e-10  # of the greatest force: what is nothing beside it
LONGEST = 18  # characters of a text at an axis
NUMBER = 0.36  # in, for a number at an axis
DECADE = 10.0  # least ratio of values for an axis with a logarithmic scale


@dataclass(frozen=True)
class Quantity:
    """A column as it is drawn."""

    name: str
    title: str  # what it is, in words
    unit: str  # "–" without dimension
    values: Array  # (r,) in this unit; of texts their places among `texts`
    texts: tuple[str, ...]  # in the order in which the members have them; of numbers none
    sampled: bool  # each member has a value of its own

    @property
    def label(self) -> str:
        """With the unit, for an axis."""
        return self.title if self.texts else f"{self.title} ({self.unit})"

    @cached_property
    def levels(self) -> Array:
        """(k,) its values, ascending."""
        return np.unique(self.values[np.isfinite(self.values)])

    def said(self, value: float) -> str:
        """One of its values, with the unit."""
        if self.texts:
            return self.texts[int(value)]
        return f"{value:g}" if self.unit == "–" else f"{value:g} {self.unit}"

    @cached_property
    def is_log(self) -> bool:
        """Whether its values are more even on a logarithmic scale."""
        if self.sampled or self.texts or len(self.levels) < 3 or self.levels[0] <= 0:
            return False
        steps, ratios = np.diff(self.levels), np.diff(np.log(self.levels))
        return bool(self.levels[-1] > DECADE * self.levels[0]
                    and ratios.std() / ratios.mean() < steps.std() / steps.mean())


def quantity(sweep: Sweep, name: str) -> Quantity:
    """A column of a sweep."""
    column = sweep[name]
    if column.dtype.kind == "U":
        texts = list(dict.fromkeys(column.tolist()))
        places = np.array([texts.index(text) for text in column.tolist()], dtype=float)
        return Quantity(name, name, "–", places, tuple(texts), False)
    numbers = column.astype(float)
    largest = float(np.abs(numbers[np.isfinite(numbers)]).max(initial=0.0))
    factor, unit = readable(largest, sweep.unit_of(name))
    for power in "23":  # kg/m3
        unit = unit.replace(f"m{power}", f"m{'²³'[int(power) - 2]}").replace(f"s{power}", "s²")
    title = name if name in sweep.parameters else figure_title(name)
    return Quantity(name, title, unit, numbers * factor, (), sweep.is_sampled(name))


def figure_title(name: str) -> str:
    """What a figure is: "vertical force, mean"."""
    for which in OVER_TIME:
        if f"_{which}" in name:
            return f"{column_label(name.replace(f'_{which}', ''))}, {which}"
    return FIGURE_LABELS.get(name, LABELS.get(name, name.replace("_", " ")))


def figure_of(sweep: Sweep, name: str) -> Quantity:
    """A column of numbers that is drawn over parameters."""
    if name not in sweep:
        raise unknown(sweep.directory, "figure", name, sweep.figures)
    if sweep[name].dtype.kind == "U":
        raise Error(f"{sweep.directory}: {name} is no figure, but a text; there are: "
                    f"{', '.join(sweep.figures)}")
    return quantity(sweep, name)


CROSS = "×"  # of members without a value


def is_nothing(sweep: Sweep, name: str) -> bool:
    """Whether a figure is zero, or without a value, in all members that are done; a force or a
    torque also if it is but round-off of the greatest force."""
    def size(figure: str) -> float:
        values = sweep[figure][sweep.done]
        return float(np.abs(values[np.isfinite(values)]).max(initial=0.0))

    if sweep.unit_of(name) not in ("N/m", "N·m/m", "N·m", "N"):
        return size(name) == 0.0
    forces = [figure for figure in sweep.figures if sweep.units[figure] in ("N/m", "N")]
    return size(name) <= ROUND_OFF * max(size(figure) for figure in [name, *forces])


@dataclass(frozen=True)
class Members:
    """Who is drawn. used: (r,) done and with a value of all that is drawn; lost: (r,) failed, or
    done without a value; missing: how many are not used, by what is the matter with them."""

    used: Mask
    lost: Mask
    missing: dict[str, int]

    def said(self, *places: Array) -> str:
        """How many they are, in words; with the cross of those that are lost if they are marked,
        at places (r,) on the axes."""
        if not self.missing:
            return f"{len(self.used)} members"
        marked = bool(places) and all(np.isfinite(place[self.lost]).any() for place in places)
        parts = [f"{count} {what}{' ' + CROSS if marked and what in LOST else ''}"
                 for what, count in self.missing.items()]
        return f"{self.used.sum()} of {len(self.used)} members ({', '.join(parts)})"


LOST = ("failed", "without a value")


def members_with(sweep: Sweep, drawn: Sequence[Quantity]) -> Members:
    """The members that have values of all that is drawn; at least one, or an error."""
    finite = np.all([np.isfinite(sweep["run"]), *(np.isfinite(q.values) for q in drawn)], axis=0)
    used = np.asarray(sweep.done & finite)
    if not used.any():
        names = f" with a value of {', '.join(q.name for q in drawn)}" if drawn else ""
        raise Error(f"{sweep.directory}: none of {len(sweep)} members is done{names}")
    matter = np.where(sweep.done, LOST[1], sweep["status"])
    names, counts = np.unique(matter[~used], return_counts=True)
    return Members(used, ~used & np.isin(matter, LOST),
                   {str(name): int(count) for name, count in zip(names, counts)})


def others(sweep: Sweep, *drawn: str) -> list[str]:
    """The parameters that vary besides those that are drawn."""
    return [name for name in sweep.varied if name not in drawn]


def heading(parts: Sequence[str], width: float) -> str:
    """Parts of a title, in as many lines as a width (in) needs."""
    return textwrap.fill("; ".join(part for part in parts if part), int(15 * width))


def scale_axis(ax: Axes, which: str, drawn: Quantity, width: float = 2.0) -> None:
    """Label and scale of the axis "x" or "y", about `width` in long, over a column."""
    axis = ax.xaxis if which == "x" else ax.yaxis
    axis.set_label_text(textwrap.fill(drawn.label, max(12, int(15 * width))))
    if drawn.texts:
        axis.set_ticks(range(len(drawn.texts)), [_short(text) for text in drawn.texts])
        getattr(ax, f"set_{which}lim")(-0.5, len(drawn.texts) - 0.5)
    elif drawn.is_log:
        getattr(ax, f"set_{which}scale")("log")
    else:
        ax.ticklabel_format(axis=which, useOffset=False)
        if not drawn.sampled and _are_apart(drawn.levels, width):
            axis.set_ticks(drawn.levels, [minus(f"{level:g}") for level in drawn.levels])


def _are_apart(levels: Array, width: float) -> bool:
    """Whether each of these values has room for its number on an axis of `width` in."""
    if len(levels) < 2:
        return False
    return bool(np.diff(levels).min() / np.ptp(levels) * width > NUMBER)


def _short(text: str) -> str:
    return text if len(text) <= LONGEST else f"{text[:LONGEST - 1]}…"


def mark_lost(ax: Axes, places: Array) -> None:
    """Crosses at the bottom of the axes where members have no value."""
    there = places[np.isfinite(places)]
    ax.plot(there, np.full(len(there), 0.02), "x", color=style.VERMILLION, markersize=4,
            transform=ax.get_xaxis_transform(), zorder=4, label="_lost")


@dataclass(frozen=True)
class Levels:
    """Figures of members with the same value of a parameter: (k,) each."""

    at: Array
    mean: Array
    low: Array
    high: Array


def by_level(places: Array, values: Array) -> Levels:
    """Mean, least and greatest of the values (m,) at each of the places (m,), NaN where none has a
    value; what has none among others is left out."""
    at, which = np.unique(places, return_inverse=True)
    groups = [values[which == k] for k in range(len(at))]
    groups = [group[np.isfinite(group)] if np.isfinite(group).any() else group for group in groups]
    return Levels(at, np.array([group.mean() for group in groups]),
                  np.array([group.min() for group in groups]),
                  np.array([group.max() for group in groups]))

# SPDX-License-Identifier: BSD-3-Clause
"""What the figures of a rig share: panels, curves by a setting, points beside the fitted curve, legends."""
from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ... import style
from ...plots.labels import readable
from ...plots.marks import minus
from ..points import Array
from ..units import of_width

if TYPE_CHECKING:
    from ...data.tir import Tir
    from ..against import Comparison
    from ...data.rig import Rig

HEIGHT = 2.9         # in, of one row of panels
TOP, LINE = 0.12, 0.19  # in, of a legend below the panels: its margin, and each of its rows
BESIDE = 6           # entries of a legend below a wide figure in a row
MOST = len(style.CURVES)
SHOWN = 2000         # measured points that are drawn at most, evenly spread over the rows
MARKS: tuple[str, ...] = ("o", "s", "^", "v", "D", "P")
MEASURED: dict[str, Any] = {"marker": ".", "markersize": 2.0, "linestyle": "none", "color": "0.55", "zorder": 1}


@dataclass(frozen=True)
class Given:
    """What figures are drawn of."""

    rig: Rig
    tir: Tir | None             # the fitted parameters; None: there are none yet
    against: Comparison | None  # measurements

    def said(self, name: str, value: float) -> str:
        """A level of a setting, as legends and sentences have it."""
        return said(name, value, self.rig.per_metre)

    def unit(self, unit: str) -> str:
        """The unit of a force, a moment or a stiffness of this rig."""
        return of_width(unit, self.rig.per_metre)

    def scaled(self, channel: Channel, values: Array) -> tuple[float, str]:
        """Factor and label of an axis: angles in degrees, slip ratios in percent, forces in kN."""
        if channel.unit == "rad":
            return 180 / np.pi, f"{channel.label} (°)"
        if channel.name == "slip_ratio":
            return 100.0, f"{channel.label} (%)"
        size = float(np.nanmax(np.abs(values))) if np.isfinite(values).any() else 1.0
        factor, unit = readable(size, self.unit(channel.unit))
        return factor, f"{channel.label} ({unit})"

    def airs(self, pressures: Sequence[float]) -> list[str]:
        """Levels of the pressure for a legend; none of a plane wheel, which has no air."""
        return [] if self.rig.plane else [self.said("pressure", pressure) for pressure in pressures]

    @property
    def load_label(self) -> str:
        return f"load $F_z$ ({self.unit('kN')})"


@dataclass(frozen=True)
class Drawn:
    """A figure of a test, with what it shows in words."""

    test: str
    name: str
    words: str
    figure: Figure


@dataclass(frozen=True)
class Channel:
    """A quantity of an axis: its column, symbol with the axes named once in the figure, and unit in SI."""

    name: str
    label: str
    unit: str


SLIP_ANGLE = Channel("slip_angle", r"slip angle $\alpha$", "rad")
SLIP_RATIO = Channel("slip_ratio", r"slip ratio $\kappa$", "1")
FX = Channel("Fx", "longitudinal force $F_x$", "N")
FY = Channel("Fy", "lateral force $F_y$", "N")
MX = Channel("Mx", "overturning moment $M_x$", "N·m")
MY = Channel("My", "rolling resistance moment $M_y$", "N·m")
MZ = Channel("Mz", "aligning moment $M_z$", "N·m")
AXES = "ISO 8855 (TYDEX W): x ahead, y to the left, z up"


def panels(columns: int, rows: int = 1, height: float = HEIGHT, narrow: bool = False) -> tuple[Figure, list[Axes]]:
    figure = plt.figure(figsize=(style.COLUMN * 1.25 if narrow else style.PAGE, height * rows))
    return figure, list(np.atleast_1d(figure.subplots(rows, columns, squeeze=False)).ravel())


def said(name: str, value: float, per_metre: bool = False) -> str:
    """A level of a setting in words. per_metre: loads are per metre of width."""
    if name in ("camber", "slip_angle"):
        symbol = {"camber": "γ", "slip_angle": "α"}[name]
        return minus(f"{symbol} = {np.degrees(value) + 0.0:.3g}°")
    if name == "slip_ratio":
        return minus(f"κ = {100 * value:.3g} %")
    if name == "pressure" and not value:
        return "without air"
    if name == "pressure":
        return f"{value / 1e5:.3g} bar"
    if name == "speed":
        return f"{3.6 * value:.3g} km/h"
    return f"{value / 1e3:.3g} {of_width('kN', per_metre)}" if name == "load" else f"{value:g}"


def by_air(pressures: Sequence[float]) -> str:
    """What tells the curves of these pressures apart, for a sentence; "": they are of wheels without air."""
    return ", by pressure of the air" if any(pressures) else ""


def cross(ax: Axes) -> None:
    """The axes through zero."""
    for line in (ax.axhline, ax.axvline):
        line(0.0, color="0.85", linewidth=0.6, zorder=0)


def curve(ax: Axes, k: int, x: Array, y: Array, fitted: tuple[Array, Array] | None = None, marked: bool = True,
          order: Array | None = None) -> None:
    """The points of the k-th level as marks, with the fitted curve through them, or joined where there is none: in the
    order of x, or of `order`; not marked: a course of many points."""
    look = style.CURVES[k % MOST]
    rows = np.argsort(x if order is None else order)
    ax.plot(x[rows], y[rows], **(_mark(k) if marked else {}),
            **(look if fitted is None else {"color": look["color"], "linestyle": "none"}))
    if fitted is not None:
        ax.plot(*fitted, **look)


def _mark(k: int) -> dict[str, Any]:
    return {"marker": MARKS[k % MOST], "markersize": 3.2, "markerfacecolor": "none", "markeredgewidth": 0.8}


def measured(ax: Axes, x: Array, y: Array) -> None:
    """Measurements as grey dots behind the curves."""
    there = np.flatnonzero(np.isfinite(x) & np.isfinite(y))
    if len(there) > SHOWN:
        there = there[np.linspace(0, len(there) - 1, SHOWN).round().astype(int)]
    ax.plot(x[there], y[there], **MEASURED)


def legend(figure: Figure, texts: Sequence[str], has_fit: bool = False, has_measured: bool = False, marks: bool = True,
           lines: bool = True) -> None:
    """Below the panels, so that it covers no data: levels, then what marks and curves are. marks, lines: which of the
    two the levels have."""
    handles = [Line2D([], [], **(_mark(k) if marks else {}),
                      **(style.CURVES[k % MOST] if lines else {"color": style.CURVES[k % MOST]["color"], "linestyle": "none"}))
               for k in range(len(texts))]
    labels = list(texts)
    if has_fit:
        handles += [Line2D([], [], marker="o", markersize=3.2, markerfacecolor="none", linestyle="none", color="0.3"),
                    Line2D([], [], color="0.3")]
        labels += ["points of the rig", "fitted tyre.tir"]
    if has_measured:
        handles.append(Line2D([], [], **{**MEASURED, "markersize": 5.0}))
        labels.append("measured")
    if not handles:
        return
    rows = -(-len(handles) // (BESIDE if figure.get_size_inches()[0] >= style.PAGE else BESIDE // 2))
    columns = -(-len(handles) // rows)
    share = (TOP + LINE * rows) / float(figure.get_size_inches()[1])
    made = figure.legend(handles, labels, loc="lower center", ncols=columns)
    made.set_in_layout(False)
    figure.get_layout_engine().set(rect=(0, share, 1, 1 - share))


def few(levels: Sequence[float] | Array) -> list[float]:
    """At most MOST of the levels, the first and the last among them, evenly spread."""
    values = [float(value) for value in levels]
    if len(values) <= MOST:
        return values
    return [values[k] for k in np.linspace(0, len(values) - 1, MOST).round().astype(int)]

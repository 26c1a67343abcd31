# SPDX-License-Identifier: BSD-3-Clause
"""Curves of a tyre: lateral force and aligning moment over the slip angle, and the force along and
across at combined slip within the bound of friction."""
from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Circle
from matplotlib.text import Annotation
from numpy.typing import NDArray

from ... import style
from ...data.axes import sense_in
from ...data.errors import Error
from ...data.sweep_table import column_of
from ...data.tyre import (ALIGNING, ALONG, ANGLE, LATERAL, LOAD, SLIP, key_of, name_of,
                          name_of_parameter, need_angles, numbers_of, others_of)
from ..labels import column_label, parameter_label, readable
from ..marks import minus
from ..sweep import heading

if TYPE_CHECKING:
    from ...data.sweep import Sweep

Array = NDArray[np.float64]
PANELS = ((LATERAL, "N"), (ALIGNING, "N·m"))
IN_AXES = {LATERAL: " $F_y$", ALIGNING: " $M_z$"}
HEIGHT = 2.9  # in
BELOW = 0.1  # of the height, for the legend
SQUARE = 4.2  # in
SWEEPS: tuple[dict[str, Any], ...] = (  # how the points of one sweep after the other look
    {"marker": "o", "markersize": 2.5},
    {"marker": "s", "markersize": 4.5, "markerfacecolor": "none", "linestyle": "none"},
    {"marker": "^", "markersize": 4.5, "markerfacecolor": "none", "linestyle": "none"})
APART = 0.025  # of places with texts of one colour in the figure of combined slip
FRICTION = "ground.friction"
MAKES_SLIP = ("motion.angular_velocity", "motion.speed")


def plot_tyre_curves(sweep: Sweep, *more: Sweep, by: str | None = None,
                     names: Sequence[str] = (), axes: str | None = None) -> Figure:
    """Lateral force and aligning moment over the slip angle, in two panels, with a curve for each
    value of the parameter `by` (load, height, camber), by default the only one that varies besides.
    Members of `more` sweeps, as steady ones beside transient ones, are open marks in the colours of
    the same values. names: of the sweeps, by default "transient" and "steady". axes: "iso-w", "sae", ... for force,
    moment and slip angle in that system (docs/conventions.md); None: rondo's own."""
    sweeps = [sweep, *more]
    by = by or parted_by(sweep)
    for one in sweeps:
        rest = [key for key in others_of(one) if key != by]
        if rest:
            raise Error(f"{one.directory}: {', '.join(rest)} vary as well: select() one value of "
                        "each, or another by=")
    levels = np.unique(numbers_of(sweep, by)) if by else np.zeros(1)
    if len(levels) > len(style.CURVES):
        raise Error(f"{sweep.directory}: {by} has {len(levels)} values; at most "
                    f"{len(style.CURVES)} curves can be told apart: select() some")
    with style.paper():
        figure = plt.figure(figsize=(style.PAGE, HEIGHT))
        for ax, (name, unit) in zip(figure.subplots(1, 2), PANELS):
            draw_panel(ax, sweeps, name, unit, by, levels, axes)
        draw_legend(figure, sweeps, by, levels, names, axes)
        said = [f"axes {axes}"] if axes else []
        figure.suptitle(heading([sweep.title, *said, *constants(sweep, axes)], style.PAGE),
                        fontsize=style.RC["axes.titlesize"])
    return figure


def parted_by(sweep: Sweep) -> str | None:
    """The only parameter that varies besides the slip angle; None: there is none."""
    others = others_of(sweep)
    if len(others) > 1:
        raise Error(f"{sweep.directory}: {', '.join(others)} vary besides the slip angle: say by "
                    "which of them curves are told apart (by=), and select() one value of the rest")
    return others[0] if others else None


def draw_panel(ax: Axes, sweeps: Sequence[Sweep], name: str, unit: str, by: str | None,
               levels: Array, axes: str | None = None) -> None:
    curves = [curve_of(one, name, axes) for one in sweeps]
    factor, shown = readable(float(np.nanmax(np.abs(np.concatenate([y for _, y in curves])))), unit)
    for one, (angles, column), look in zip(sweeps, curves, SWEEPS):
        for level, curve in zip(levels, style.CURVES):
            chosen = np.isfinite(column)
            if by is not None:
                chosen &= np.isclose(numbers_of(one, by), level)
            angle = np.degrees(angles[chosen])
            order = np.argsort(angle)
            ax.plot(angle[order], factor * column[chosen][order], **{**curve, **look})
    for line in (ax.axhline, ax.axvline):
        line(0.0, color="0.8", linewidth=0.6, zorder=0)
    ax.set(xlabel="slip angle (°)", ylabel=f"{column_label(name)}{IN_AXES[name] if axes else ''} ({shown})")


def curve_of(sweep: Sweep, name: str, axes: str | None) -> tuple[Array, Array]:
    """(members,) slip angle [rad] and force or moment, in rondo's axes or in others."""
    if axes is None or axes == "rondo":
        return np.asarray(sweep[ANGLE], dtype=float), column_of(sweep, name)
    found = sweep.in_axes(axes)
    return found.slip_angle, found.Fy if name == LATERAL else found.Mz


def draw_legend(figure: Figure, sweeps: Sequence[Sweep], by: str | None, levels: Array,
                names: Sequence[str], axes: str | None = None) -> None:
    """Values of the parameter by their colours, then the sweeps by their marks."""
    handles, texts = [], []
    if by is not None:
        scale = [said_level(by, level, unit_of(sweeps[0], by), axes) for level in levels]
        handles += [Line2D([], [], **curve) for _, curve in zip(levels, style.CURVES)]
        texts += [f"{parameter_label(by)} {text}" for text in scale]
    if len(sweeps) > 1:
        handles += [Line2D([], [], color=style.BLACK, **look) for _, look in zip(sweeps, SWEEPS)]
        texts += list(names) or [name_of(one) for one in sweeps]
    if handles:
        legend = figure.legend(handles, [minus(text) for text in texts], loc="lower center", ncols=6)
        legend.set_in_layout(False)
        figure.get_layout_engine().set(rect=(0, BELOW, 1, 1 - BELOW))  # room for the legend


def said_level(key: str, value: float, unit: str, axes: str | None = None) -> str:
    """A value of a parameter: angles in degrees, lengths in mm. With the sign that it has in these
    axes: a camber or a turn slip."""
    value = value * (sense_in(axes, key) if axes else 1) + 0.0
    if key.endswith(("slip_angle", "camber")):
        return f"{np.degrees(value):.3g}°"
    if key.endswith("height"):
        return f"{1e3 * value:g} mm"
    factor, shown = readable(abs(value), unit)
    return f"{factor * value:g}" if shown == "–" else f"{factor * value:g} {shown}"


def constants(sweep: Sweep, axes: str | None = None) -> list[str]:
    """What the parameters are in which these members are alike, as after a select()."""
    alike = [name_of_parameter(key) for key in sweep.parameters
             if key != ANGLE and len(np.unique(sweep[key])) == 1]
    return [f"{parameter_label(name)} "
            f"{said_level(name, float(numbers_of(sweep, name)[0]), unit_of(sweep, name), axes)}"
            for name in alike]


def unit_of(sweep: Sweep, name: str) -> str:
    """Of a parameter by its name: loads are in N, whatever the key says of plane bodies."""
    unit = sweep.unit_of(key_of(sweep, name) or name)
    return "N" if unit.startswith("N/m") else unit


@style.paper()
def plot_friction_ellipse(sweep: Sweep, ax: Axes | None = None) -> Axes:
    """The force along over the lateral one, both over the vertical force, at combined slip: a curve
    over the slip for each slip angle, dashed ones across for each value of the parameter that makes
    the slip (spin or speed), and the bound of friction where it is known."""
    key = slip_by(sweep)
    vertical = column_of(sweep, LOAD)
    along, across = column_of(sweep, ALONG) / vertical, column_of(sweep, LATERAL) / vertical
    slip, angle = column_of(sweep, SLIP), np.asarray(sweep[ANGLE], dtype=float)
    if ax is None:
        ax = plt.figure(figsize=(SQUARE, SQUARE)).add_subplot()
    for value in np.unique(sweep[key]):
        rows = ordered(np.flatnonzero(sweep[key] == value), angle)
        ax.plot(across[rows], along[rows], color=style.VERMILLION, linestyle="--", linewidth=0.7)
        least = rows[np.abs(angle[rows]).argmin()]
        say(ax, across, along, np.array([least]), f"{100 * slip[least]:.2g} %", style.VERMILLION, -2)
    for value in np.unique(angle):
        rows = ordered(np.flatnonzero(angle == value), slip)
        ax.plot(across[rows], along[rows], color=style.BLUE, marker=".", markersize=3)
        least = rows[np.abs(np.nan_to_num(slip[rows], nan=np.inf)).argmin()]
        say(ax, across, along, np.array([least]), f"{np.degrees(value):.3g}°", style.BLUE, -9)
    friction = friction_of(sweep)
    if friction is not None:
        ax.add_patch(Circle((0.0, 0.0), friction, fill=False, edgecolor="0.5", linewidth=0.8))
        ax.set(xlim=(-1.15 * friction, 1.15 * friction), ylim=(-1.15 * friction, 1.15 * friction))
    for line in (ax.axhline, ax.axvline):
        line(0.0, color="0.85", linewidth=0.6, zorder=0)
    bound = "" if friction is None else f"; circle: friction {friction:g}"
    ax.set(aspect="equal", xlabel="lateral force over vertical force (–)",
           ylabel="force along over vertical force (–)")
    ax.set_title(heading([f"{sweep.title}: slip angles (blue) and slip ratios (dashed){bound}",
                          *constants(sweep)], SQUARE - 0.4))
    return ax


def slip_by(sweep: Sweep) -> str:
    """The parameter that makes the slip; an error where none varies, or others do."""
    need_angles(sweep)
    rest = [key for key in sweep.varied if key != ANGLE]
    makes = [key for key in rest if key in MAKES_SLIP]
    if len(makes) != 1 or len(rest) > 1:
        raise Error(f"{sweep.directory}: combined slip takes a slip angle and one of "
                    "motion.angular_velocity and motion.speed that vary, and nothing else: "
                    f"here vary {', '.join(sweep.varied)}; select() one value of the rest")
    return makes[0]


def ordered(rows: NDArray[np.int64], by: Array) -> NDArray[np.int64]:
    return rows[np.argsort(by[rows], kind="stable")]


def say(ax: Axes, x: Array, y: Array, rows: NDArray[np.int64], text: str, colour: str,
        above: float = 3.0) -> None:
    """Beside the points of these members that have a value, and no text of this colour yet."""
    there = {(round(text_.xy[0] / APART), round(text_.xy[1] / APART)) for text_ in ax.texts
             if isinstance(text_, Annotation) and text_.get_color() == colour}
    for row in rows[np.isfinite(x[rows]) & np.isfinite(y[rows])]:
        if (round(x[row] / APART), round(y[row] / APART)) in there:
            continue
        ax.annotate(minus(text), (x[row], y[row]), fontsize=6, color=colour, xytext=(3, above),
                    textcoords="offset points", zorder=4,
                    bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.2})


def friction_of(sweep: Sweep) -> float | None:
    """μ of all members: a parameter with one value, or what the case of a run says."""
    if FRICTION in sweep.parameters:
        values = np.unique(sweep[FRICTION])
        return float(values[0]) if len(values) == 1 else None
    try:
        return sweep.run(int(sweep["run"][sweep.done][0])).friction
    except (Error, IndexError):  # members of steady sweeps have no directories
        return None

# SPDX-License-Identifier: BSD-3-Clause
"""Curves of a run's history: forces, energies, spectra."""
from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import LogLocator

from .. import style
from ..data.errors import Error, unknown
from ..data.history import between
from .labels import axes_of, column_label, readable, steady_scale
from .marks import energy, relative_residual

if TYPE_CHECKING:
    from ..data.run import Run

# What changes the energy, with its sign in the ledger (docs/theory.md, 5); the same colours in all
# figures.
TERMS: dict[str, tuple[int, str, dict[str, Any]]] = {
    "work_frame": (1, "work of the co-rotating frame", {"color": style.BLUE, "linestyle": "--"}),
    "work_rim": (1, "work of the rim", {"color": style.SKY, "linestyle": "-", "linewidth": 1.8}),
    "work_load": (1, "work of pressures", {"color": "0.3", "linestyle": "--"}),
    "dissipation_friction": (-1, "friction", {"color": style.VERMILLION, "linestyle": "-."}),
    "loss_impact": (-1, "impacts", {"color": style.PURPLE, "linestyle": ":"}),
    "dissipation_mass": (-1, "mass damping", {"color": style.GREEN, "linestyle": (0, (6, 1.5))}),
    "dissipation_stiffness": (-1, "stiffness damping",
                              {"color": style.ORANGE, "linestyle": (0, (4, 1, 1, 1, 1, 1))}),
    "work_scheme": (1, "created by the scheme", {"color": "0.5", "linestyle": (0, (1, 1))}),
    # Of a [rim] only: then there is no work of a frame, of a rim against the ground.
    "work_gravity": (1, "work of gravity", {"color": style.BLUE, "linestyle": "--"}),
    "work_rim_load": (1, "work of the load", {"color": style.SKY, "linestyle": "-"}),
    "work_torque": (1, "work of the torque", {"color": style.SKY, "linestyle": "-."}),
    "work_held": (1, "work of what holds the rim", {"color": style.BLUE, "linestyle": "-"}),
    "dissipation_brake": (-1, "brake", {"color": style.VERMILLION, "linestyle": "-"}),
    "dissipation_support": (-1, "dashpots of the rim", {"color": "0.5", "linestyle": "-"}),
}

PITCHES: dict[str, Any] = {"color": "0.75", "linewidth": 0.8}
NODES: dict[str, Any] = {"color": style.VERMILLION, "linewidth": 0.8, "linestyle": (0, (2, 2))}

MIN_ROWS = 16  # for a spectrum
NO_COURSE = "course in time, and no spectrum"  # of an inflation
ROUND_OFF = 1e-13  # size over that of the energy of a part of the ledger that is zero
FLOOR = 1e-18  # of the residual's axis


def _abscissa(run: Run) -> tuple[np.ndarray, str]:
    """What a history is drawn over, (rows,), and its label: time, the depth of a crush, or the share
    of the loads of an inflation."""
    if run.is_crush:
        return run.history["depth_m"] * 1e3, "depth (mm)"
    if run.is_inflation:
        return run.history["load_share"], f"{column_label('load_share')} (–)"
    return run.history["time_s"] * 1e3, "time (ms)"


@style.paper()
def plot_history(run: Run, *columns: str, ax: Axes | None = None) -> Axes:
    """Columns of the history over time, of a crush over depth, of an inflation over the share of the
    loads; without any, the forces of the ground on the body, the energies where there is no ground, and
    of an inflation the extremes of the forces of cords, or the outer radius. Columns in one axes have one
    unit."""
    history = run.history
    names = columns or _usual(run)
    for name in names:
        history.need_ground(name)
    x, x_label = _abscissa(run)
    values = [history[name] for name in names]
    units = {history.unit_of(name) for name in names}
    if len(units) > 1:
        raise Error(f"{', '.join(names)}: of different units ({', '.join(sorted(units))}); "
                    "draw them in axes of their own")
    if len(names) > len(style.CURVES):
        raise Error(f"{len(names)} columns: at most {len(style.CURVES)} can be told apart in one "
                    "axes")
    factor, unit = readable(max((np.abs(v).max(initial=0.0) for v in values)), units.pop())
    ax = axes_of(ax, 2.2)
    for name, value, line in zip(names, values, style.CURVES):
        ax.plot(x, value * factor, label=column_label(name), **line)
    ax.set_ylabel(f"{_together(names, unit)} ({unit})")
    if len(names) > 1:
        ax.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=min(len(names), 3))
    steady_scale(ax, np.concatenate(values) * factor, unit)
    ax.set_xlabel(x_label)
    if len(x) and x[-1] > min(x[0], 0.0):
        ax.set_xlim(min(x[0], 0.0), x[-1])
    return ax


def _usual(run: Run) -> tuple[str, ...]:
    """Columns that are drawn where none is asked for."""
    if run.is_inflation:
        return ("cord_force_max_n", "cord_force_min_n") if run.case.get("cords") else ("outer_radius_m",)
    return ("force_y", "force_x") if run.history.ground else ("kinetic", "strain")


def _together(names: Sequence[str], unit: str) -> str:
    """What the columns in one axes are."""
    if len(names) == 1:
        return column_label(names[0])
    if set(names) <= {"moment_aligning", "moment_overturning", "moment_aligning_iso",
                      "moment_overturning_iso"}:
        return "moment of the ground\non the body"
    if set(names) <= {"force_x", "force_y", "force_lateral"}:
        return "force of the ground\non the body"
    if set(names) <= {"cord_force_max_n", "cord_force_min_n"}:
        return "force of a cord"
    if set(names) <= {"contact_nodes", "sticking_nodes"}:
        return "nodes"
    return "energy" if unit.endswith(("J/m", "J")) else "value"


@style.paper()
def plot_energy(run: Run, ax: Axes | None = None) -> Axes:
    """The energy balance: the body's energy, kinetic and strain, and what has changed it, each with
    its sign: but for the energy at the start they sum up to it. Below, what the ledger leaves open
    over the energy exchanged. Given axes are divided in two. Returns the upper ones."""
    if run.is_steady:
        raise Error(f"{run.directory}: steady rolling has powers instead of energies that pass over "
                    "time: run.steady[\"power\"]")
    if run.is_inflation:
        raise Error(f"{run.directory}: an inflation has no energies that pass over time: plot_section and "
                    "plot_cords draw its equilibrium, plot_history its figures over the share of the loads")
    ax = axes_of(ax, 4.0)
    spec = getattr(ax, "get_subplotspec", lambda: None)()  # not there before matplotlib 3.7
    if spec is None:
        raise Error("plot_energy divides its axes: give it some of a grid, as from plt.subplots()")
    grid = spec.subgridspec(2, 1, height_ratios=(2.2, 1), hspace=0.08)
    ax.set_subplotspec(grid[0])
    below = ax.figure.add_subplot(grid[1], sharex=ax)
    x, x_label = _abscissa(run)
    total = energy(run)
    largest = np.abs(total).max(initial=0.0)
    drawn = {name: sign * run.history[name] for name, (sign, _, _) in TERMS.items()
             if name in run.history
             and np.abs(run.history[name]).max(initial=0.0) > ROUND_OFF * largest}
    size = max(np.abs(curve).max(initial=0.0) for curve in (total, *drawn.values()))
    factor, unit = readable(size, f"J{run.per_width}")
    ax.axhline(0.0, color="0.8", linewidth=0.6, zorder=0)
    ax.plot(x, total * factor, color=style.BLACK, linewidth=1.4, zorder=3,
            label=f"energy: kinetic and strain{', with the rim' if run.has_rim else ''}")
    for name, curve in drawn.items():
        ax.plot(x, curve * factor, label=_said(run, name), **TERMS[name][2])
    ax.set_ylabel(f"energy ({unit})")
    ax.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3)
    ax.tick_params(labelbottom=False)
    residual = relative_residual(run)
    below.semilogy(x, np.where(residual > 0, residual, np.nan), color=style.BLACK, linewidth=0.8)
    below.set_ylim(FLOOR, max(1e-12, 10 * residual.max(initial=0.0)))
    below.yaxis.set_major_locator(LogLocator(numticks=5))
    below.set_ylabel("imbalance over\nenergy exchanged (–)")
    below.set_xlabel(x_label)
    if len(x):
        below.set_xlim(min(x[0], 0.0), x[-1])
    return ax


def _said(run: Run, name: str) -> str:
    """What a term of the ledger is in this run: a frame that turns does work on held bodies only,
    on free ones gravity alone."""
    if name == "work_frame" and run.mesh.free.all():
        return "work of gravity"
    both = run.mesh.free.any() or np.any(run.case.get("motion", {}).get("gravity", 0.0))
    return f"{TERMS[name][1]}{', gravity' if name == 'work_frame' and both else ''}"


def force_spectrum(run: Run, column: str = "force_y", from_time: float | None = None,
                   to_time: float | None = None) -> tuple[np.ndarray, np.ndarray]:
    """(frequency (f,) [Hz], amplitude (f,) in the column's unit): one-sided, of the rows between
    two times [s], their mean removed, under a Hann window whose gain is undone.

    A sine whose periods fit in the window has its own amplitude there; between two lines it shows
    up to 15 % less, in both. Rows are as even_rows() has them."""
    step, signal = even_rows(run, column, from_time, to_time)
    rows = len(signal)
    window = 0.5 - 0.5 * np.cos(2 * np.pi * np.arange(rows) / rows)
    amplitude = np.abs(np.fft.rfft((signal - signal.mean()) * window)) / window.sum()
    amplitude[1: (rows + 1) // 2] *= 2  # the other half of the spectrum; not of 0 nor of Nyquist's
    return np.fft.rfftfreq(rows, step), amplitude


def even_rows(run: Run, column: str, from_time: float | None,
              to_time: float | None) -> tuple[float, np.ndarray]:
    """Step [s] and values (rows,) of a column between two times [s], for a spectrum. Rows are the
    means over their intervals, taken as values at their middles; where intervals differ they are
    resampled evenly, linearly."""
    if run.is_crush:
        raise Error(f"{run.directory}: a crush has no course in time, and no spectrum")
    run.history.need_time(NO_COURSE)
    if run.is_steady:
        raise Error(f"{run.directory}: steady rolling has no course in time, and no spectrum; what "
                    "repeats with each sector is in its history")
    chosen = run.history.window(from_time, to_time)
    rows = int(chosen.sum())
    if rows < MIN_ROWS:
        raise Error(f"{run.directory}: {rows} rows of the history {between(from_time, to_time)}; "
                    f"a spectrum takes at least {MIN_ROWS}: widen the window or lower "
                    "output.history_interval")
    end = run.history["time_s"]
    begin = np.append(0.0, end)[:-1]
    middle = 0.5 * (begin + end)[chosen]
    even = np.linspace(middle[0], middle[-1], rows)
    return float(even[1] - even[0]), np.interp(even, middle, run.history[column][chosen])


@style.paper()
def plot_force_spectrum(run: Run, column: str = "force_y", from_time: float | None = None,
                        to_time: float | None = None, ax: Axes | None = None) -> Axes:
    """Amplitude spectrum (see force_spectrum) of a column over frequency. Marked are the multiples
    of the frequencies at which the pitches of a tread and the columns of the mesh pass: ripple at
    those of the mesh is of the nodes, not of the body."""
    run.history.need_time(NO_COURSE)
    if column not in run.history:
        raise unknown(run.history.path, "column", column, run.history)
    run.history.need_ground(column)
    frequency, amplitude = force_spectrum(run, column, from_time, to_time)
    ax = axes_of(ax, 2.4)
    mark_passing(ax, run, frequency[-1])
    line: dict[str, Any] = {**style.CURVES[0], "linewidth": 0.8}
    ax.plot(frequency[1:], amplitude[1:], **line)
    top = amplitude.max()
    if top > 0:
        ax.set_yscale("log")
        ax.set_ylim(max(amplitude[1:].min(), 1e-6 * top), 3 * top)
    ax.set_xlim(0, frequency[-1])
    ax.set_xlabel("frequency (Hz)")
    unit = run.history.unit_of(column)
    ax.set_ylabel(f"amplitude of the\n{column_label(column)} ({'–' if unit == '1' else unit})")
    return ax


def mark_passing(ax: Axes, run: Run, highest: float) -> None:
    """The multiples, up to a frequency [Hz], of those at which pitches and columns pass."""
    marks = (("tread (pitches × spin)", run.pitch_frequency, PITCHES),
             ("mesh (columns × spin)", run.mesh_frequency, NODES))
    for name, base, look in marks:
        if not base or base > highest:
            continue
        places = base * np.arange(1, int(highest / base) + 1)
        multiples = " and its multiples" if len(places) > 1 else ""
        ax.vlines(places, 0, 1, transform=ax.get_xaxis_transform(), zorder=0, **look,
                  label=f"{name}: {base:.0f} Hz{multiples}")
    if ax.collections:
        ax.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2)

# SPDX-License-Identifier: BSD-3-Clause
"""The forces of figure 3: the whole history, a few periods, and the spectrum, of both disks."""
from __future__ import annotations

from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from .. import style
from ..plots.contact import ground_of
from ..plots.curves import force_spectrum
from ..plots.marks import edge_nodes, letter

if TYPE_CHECKING:
    from ..data.paper import Paper
    from ..data.run import Run

PERIODS = 6  # in the close view
MULTIPLES = 8  # of the pitch frequency in the spectrum of the treaded disk


def draw(paper: Paper) -> dict[str, Figure]:
    runs = (paper.run("turn-smooth"), paper.run("turn-treaded"))
    with style.paper():
        figure = plt.figure(figsize=(style.PAGE, 5.2))
        grid = figure.add_gridspec(3, 2, height_ratios=(1.15, 1, 1))
        axes = [[figure.add_subplot(grid[row, column]) for column in range(2)] for row in range(3)]
        for column, (run, name) in enumerate(zip(runs, ("smooth", "treaded"))):
            _history(axes[0][column], run)
            _periods(axes[1][column], run)
            _spectrum(axes[2][column], run, frequency_shown(runs[1]))
            for row in range(3):
                letter(axes[row][column], "abcdef"[2 * row + column], name if row == 0 else "")
        for left, right in axes:  # compared: the same scale
            low, high = zip(left.get_ylim(), right.get_ylim())
            left.set_ylim(min(low), max(high))
            right.set_ylim(min(low), max(high))
        axes[0][0].legend(loc="center right", bbox_to_anchor=(1.0, 0.63), ncol=2)
    return {"figure-3-forces": figure}


def steady_from(run: Run) -> float:
    """s: from here the run has snapshots; the study lets them begin when rolling is steady."""
    return float(run.times[0])


def frequency(run: Run) -> tuple[float, str]:
    """Hz, and its name: that of the pitches, or of the nodes where the disk is smooth."""
    if run.pitch_frequency is not None:
        return float(run.pitch_frequency), "pitches"
    return len(edge_nodes(run)) * abs(run.spin) / (2 * np.pi), "nodes"


def frequency_shown(treaded: Run) -> float:
    """Hz: end of the axis of the spectra."""
    return MULTIPLES * frequency(treaded)[0] * 1.03


def climbing(run: Run) -> tuple[float, float]:
    """s: first touch, and when the whole contact has come to the last facet of the ground."""
    h, ground = run.history, ground_of(run)
    touching = h["force_y"] > 0
    rear = h["center_x_m"] - 0.5 * h["contact_length_m"]
    flat = touching & (rear > ground.corners[-2, 0] + ground.radii[-2])
    return float(h["time_s"][np.argmax(touching)]), float(h["time_s"][np.argmax(flat)])


def _history(ax: Axes, run: Run) -> None:
    h = run.history
    time = h["time_s"] * 1e3
    ax.plot(time, h["force_y"] / 1e3, label="vertical", **style.CURVES[0])
    ax.plot(time, h["force_x"] / 1e3, label="horizontal", **style.CURVES[1])
    ax.axhline(0, color="0.6", lw=0.5, zorder=0)
    touch, flat = (1e3 * t for t in climbing(run))
    steady = 1e3 * steady_from(run)
    regime = "quasi-periodic" if run.pitch_frequency is not None else "stationary"
    top = 1.3 * h["force_y"].max() / 1e3
    bounds = (0.0, touch, flat, steady, time[-1])
    for number, (start, end) in enumerate(zip(bounds, bounds[1:]), start=1):
        ax.axvline(end, color="0.75", lw=0.6, zorder=0)
        ax.text(0.5 * (start + end), 0.97, str(number), transform=ax.get_xaxis_transform(),
                ha="center", va="top", weight="bold")
    ax.text(0.98, 0.52, f"1 before contact, 2 climbing,\n3 settling, 4 {regime}", fontsize=7,
            transform=ax.transAxes, ha="right", va="top")
    ax.set(xlim=(0, time[-1]), ylim=(-0.2 * top, top), xlabel="time (ms)",
           ylabel="force of the\nground (kN/m)")


def _periods(ax: Axes, run: Run) -> None:
    h, (rate, name) = run.history, frequency(run)
    start = steady_from(run)
    spans = np.diff(h["time_s"], prepend=0.0)
    shown = (h["time_s"] >= start) & (h["time_s"] <= start + PERIODS / rate)
    mean = np.average(h["force_y"][h["time_s"] >= start], weights=spans[h["time_s"] >= start])
    middle = h["time_s"][shown] - 0.5 * spans[shown]  # rows are means over their intervals
    ax.plot((middle - start) * rate, 100 * (h["force_y"][shown] / mean - 1), lw=1.0,
            color=style.BLUE, marker="o", markersize=2)
    ax.axhline(0, color="0.6", lw=0.5, zorder=0)
    for period in range(PERIODS + 1):
        ax.axvline(period, color="0.85", lw=0.6, zorder=0)
    ax.set(xlim=(0, PERIODS), xlabel=f"time over the period of the {name}, {1e3 / rate:.2f} ms (–)",
           ylabel="vertical force,\noff its mean (%)")


def _spectrum(ax: Axes, run: Run, end: float) -> None:
    frequencies, amplitude = force_spectrum(run, "force_y", from_time=steady_from(run))
    ax.semilogy(frequencies, amplitude, color=style.BLUE, lw=0.8)
    rate, name = frequency(run)
    ax.set(xlim=(0, end), ylim=(1.0, 2e4), xlabel="frequency (Hz)",
           ylabel="amplitude of the\nvertical force (N/m)")
    for multiple in range(1, int(end / rate) + 1):
        ax.plot(multiple * rate, 2.6e3, "v", color=style.VERMILLION, markersize=3.5,
                markeredgewidth=0)
    ax.text(0.98, 0.98, f"marks: {rate:.1f} Hz ({name}) and multiples", transform=ax.transAxes,
            ha="right", va="top", fontsize=7)

# SPDX-License-Identifier: BSD-3-Clause
"""What friction takes in the footprint and around the tread, and the flash temperature there."""
from __future__ import annotations

from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from .. import style
from ..data.errors import Error
from ..data.friction import Wear, need_power
from ..data.heat import FlashTemperature, Heat

if TYPE_CHECKING:
    from ..data.run import Run

Array = NDArray[np.float64]
HEIGHT = 2.6  # in, of a panel
DOT = 14.0  # pt², of a node
TO_THE_RIGHT = "to the right of the center (mm)"
AHEAD = "ahead of the center (mm)"


def scale_of(values: Array, unit: str) -> tuple[float, str]:
    """Factor and unit for numbers that are read: 3.2e6 J/m² is 3.2 MJ/m²."""
    size = float(np.abs(values).max(initial=0.0))
    for factor, prefix in ((1e-6, "M"), (1e-3, "k")):
        if size * factor >= 1:
            return factor, prefix + unit
    return 1.0, unit


@style.paper()
def plot_wear(run: Run, from_time: float | None = None, to_time: float | None = None) -> Figure:
    """Left the footprint: of steady rolling the power that friction takes, of steps in time the energy by
    place; right the tread: the energy that friction takes at its nodes, of steady rolling in a turn."""
    wear = run.wear(from_time, to_time)
    has_places = run.is_steady or run.friction_work.places is not None
    figure = plt.figure(figsize=(style.PAGE, HEIGHT))
    axes = figure.subplots(1, 2 if has_places else 1, squeeze=False)[0]
    if run.is_steady:
        _draw_power(run, axes[0])
    elif has_places:
        _draw_places(run, axes[0], from_time, to_time)
    _draw_tread(run, axes[-1], wear)
    if not run.is_steady:
        first, last = _ends(run, from_time, to_time)
        axes[-1].set_title(f"{run.times[first]:.4g} to {run.times[last]:.4g} s, {wear.turns:.3g} turns",
                           fontsize="small")
    return figure


def _ends(run: Run, from_time: float | None, to_time: float | None) -> tuple[int, int]:
    """The snapshots between which energies are."""
    return (0 if from_time is None else run.index(from_time),
            run.n_snapshots - 1 if to_time is None else run.index(to_time))


def _draw_power(run: Run, ax: Axes) -> None:
    rows = need_power(run)
    ahead = 1e3 * (rows["x_m"] - np.interp(rows["time_s"], run.times, run.center[:, 0]))
    factor, unit = scale_of(rows["friction_power"], "W/m²")
    if run.is_solid:
        right = 1e3 * (rows["z_m"] - np.interp(rows["time_s"], run.times, run.lateral))
        _dots(ax, ahead, right, factor * rows["friction_power"], f"friction power ({unit})")
        return
    order = np.argsort(ahead, kind="stable")
    ax.plot(ahead[order], factor * rows["friction_power"][order], ".", markersize=2, color=style.VERMILLION)
    ax.set(xlabel=AHEAD, ylabel=f"friction power ({unit})")


def _draw_places(run: Run, ax: Axes, from_time: float | None, to_time: float | None) -> None:
    found = run.friction_work
    assert found.places is not None
    first, last = _ends(run, from_time, to_time)
    energy = np.asarray(found.places[last]) - np.asarray(found.places[first])
    factor, unit = scale_of(energy, "J/m²")
    across = energy if energy.ndim == 1 else np.abs(energy).max(axis=1)
    there = np.flatnonzero(across != 0.0)
    if not len(there):
        ax.set(xlabel=AHEAD, title="no friction")
        return
    shown = slice(max(int(there[0]) - 1, 0), int(there[-1]) + 2)
    x = 1e3 * found.along[shown]
    if energy.ndim == 1:
        ax.step(x, factor * energy[shown], where="mid", color=style.VERMILLION)
        ax.set(xlabel=AHEAD, ylabel=f"energy by place ({unit})")
        return
    assert found.across is not None
    mesh = ax.pcolormesh(x, 1e3 * found.across, factor * energy[shown].T, cmap=style.SEQUENTIAL,
                         shading="nearest", rasterized=True)
    ax.figure.colorbar(mesh, ax=ax, label=f"energy by place ({unit})")
    sides = 1e3 * found.across[[0, -1]]  # whose places have half of the width
    ax.set(xlabel=AHEAD, ylabel=TO_THE_RIGHT, ylim=(sides[1], sides[0]))


def _draw_tread(run: Run, ax: Axes, wear: Wear) -> None:
    what = "energy in a turn" if run.is_steady else "energy"
    factor, unit = scale_of(wear.work, "J/m²")
    label = f"{what} ({unit})"
    if run.is_solid and run.is_steady:  # the same at every turn of a sector
        order = np.argsort(wear.across, kind="stable")
        ax.plot(1e3 * wear.across[order], factor * wear.work[order], ".", markersize=3, color=style.BLUE)
        ax.set(xlabel="along the axle, to the right (mm)", ylabel=label)
        return
    degrees = np.degrees(wear.angle)
    if run.is_solid:
        _dots(ax, degrees, 1e3 * wear.across, factor * wear.work, label)
        ax.set(xlabel="around the wheel (°)", ylabel="along the axle (mm)")
        return
    order = np.argsort(degrees, kind="stable")
    ax.plot(degrees[order], factor * wear.work[order], ".-", markersize=2, linewidth=0.5, color=style.BLUE)
    ax.set(xlabel="around the wheel, from straight down (°)", ylabel=label)


def _dots(ax: Axes, x: Array, y: Array, values: Array, label: str) -> None:
    dots = ax.scatter(x, y, c=values, s=DOT, marker="s", linewidths=0, cmap=style.SEQUENTIAL, rasterized=True)
    ax.figure.colorbar(dots, ax=ax, label=label)
    ax.set(xlabel=AHEAD, ylabel=TO_THE_RIGHT)
    ax.invert_yaxis()


@style.paper()
def plot_flash_temperature(run: Run, heat: Heat, time: float | None = None) -> Figure:
    """Left the power that friction takes at the nodes of the footprint, right the rise of the tread's
    temperature there."""
    return draw_flash(run, run.flash_temperature(heat, time))


@style.paper()
def draw_flash(run: Run, found: FlashTemperature) -> Figure:
    if not len(found.node):
        raise Error(f"{run.directory}: nothing touches the ground")
    figure = plt.figure(figsize=(style.PAGE, HEIGHT))
    left, right = figure.subplots(1, 2, sharex=True)
    factor, unit = scale_of(found.power, "W/m²")
    x, z = 1e3 * found.place.T
    for ax, values, label in ((left, factor * found.power, f"friction power ({unit})"),
                              (right, found.rise, "flash temperature (K)")):
        if run.is_solid:
            _dots(ax, x, z, values, label)
            continue
        lines = found.node if run.is_steady else np.zeros_like(found.node)
        for number, line in enumerate(np.unique(lines)):
            on = np.flatnonzero(lines == line)
            on = on[np.argsort(x[on], kind="stable")]
            ax.plot(x[on], values[on], **style.CURVES[number % len(style.CURVES)])
        ax.set(xlabel=AHEAD, ylabel=label)
    figure.suptitle(f"largest {found.largest:.4g} K, at {found.speed:.4g} m/s",
                    fontsize=style.RC["axes.titlesize"])
    return figure

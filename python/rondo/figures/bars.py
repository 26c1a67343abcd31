# SPDX-License-Identifier: BSD-3-Clause
"""The bars of docs/validation.md, V2 and V3, beside the exact solutions.

    python3 -m rondo.figures.bars FOLDER -o OUTPUT

FOLDER holds the results of cases/bar-on-wall.toml as `bar-on-wall`, of the same with
time.safety = 1 as `bar-on-wall-critical`, of cases/bouncing-bar.toml as `bouncing-bar`.
"""
from __future__ import annotations

import argparse
import os
import pathlib
import sys
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from .. import style
from ..data.run import open_run
from ..data.errors import Error
from ..plots.marks import energy, letter

if TYPE_CHECKING:
    from ..data.run import Run

# Of the mesh and the cases: m, m, kg/m3, m/s, m/s2; gap (m) and speed (m/s) at first touch.
LENGTH, WIDTH, DENSITY, WAVE, GRAVITY = 10.0, 0.1, 1.0, 30.0, 10.0
GAP, SPEED = 5.0, 10.0
TRANSIT = LENGTH / WAVE  # s: of a wave along the bar
TOUCH = GAP / SPEED  # s: of the bar on the wall
PERIOD = 16 * TRANSIT  # s: of the bouncing bar

EXACT: dict[str, Any] = {"color": "0.7", "linestyle": "-", "linewidth": 3.0, "zorder": 0}


def wall_pressure(time: np.ndarray) -> np.ndarray:
    """Pa: of the wall on the foot, exact: ρcv while a wave goes up and comes back."""
    pressed = (time >= TOUCH) & (time < TOUCH + 2 * TRANSIT)
    return DENSITY * WAVE * SPEED * pressed


def bounce_pressure(time: np.ndarray) -> np.ndarray:
    """Pa, exact: the foot is held against a fall that goes on; the second contact of a period is
    the first one backwards."""
    since = _mirrored(time) - 3 * TRANSIT
    pressed = (since >= 0) & (since < 2 * TRANSIT)
    return DENSITY * WAVE * (SPEED + GRAVITY * since) * pressed


def bounce_height(time: np.ndarray) -> np.ndarray:
    """m, exact: how far the center of mass is above its place in a bar that stands on the ground.
    The integral of weight and pressure, and free flight."""
    mirrored = _mirrored(time)
    since = np.clip(mirrored - 3 * TRANSIT, 0, 2 * TRANSIT)
    flight = np.clip(mirrored - 5 * TRANSIT, 0, None)
    until = mirrored - flight
    push = WAVE / LENGTH * (SPEED * since**2 / 2 + GRAVITY * since**3 / 6)
    return GAP - GRAVITY * until**2 / 2 + push + SPEED * flight - GRAVITY * flight**2 / 2


def _mirrored(time: np.ndarray) -> np.ndarray:
    """s: the time in the first half of the period that shows the same."""
    within = np.mod(time, PERIOD)
    return np.minimum(within, PERIOD - within)


def draw_wall(run: Run, critical: Run) -> Figure:
    with style.paper():
        figure = plt.figure(figsize=(style.PAGE, 2.4))
        pressure, velocity = figure.subplots(1, 2)
        runs = {"Courant number 0.9": run, "Courant number 1": critical}
        _pressures(pressure, runs, wall_pressure, (TOUCH - TRANSIT / 2, TOUCH + 3 * TRANSIT))
        pressure.legend(loc="center", bbox_to_anchor=(0.46, 0.5), fontsize=6.5)
        letter(pressure, "a", "pressure of the wall")
        _velocities(velocity, run)
        letter(velocity, "b", "velocities, Courant number 0.9")
    return figure


def draw_bounce(run: Run) -> Figure:
    with style.paper():
        figure = plt.figure(figsize=(style.PAGE, 4.4))
        grid = figure.add_gridspec(2, 2)
        heights = figure.add_subplot(grid[0, :])
        _heights(heights, run)
        letter(heights, "a", "height")
        pressure = figure.add_subplot(grid[1, 0])
        _pressures(pressure, {"computed": run}, bounce_pressure, (0.0, PERIOD))
        pressure.legend(loc="upper center")
        letter(pressure, "b", "pressure of the ground")
        left = figure.add_subplot(grid[1, 1])
        _energy(left, run)
        letter(left, "c", "energy")
    return figure


def _pressures(ax: Axes, runs: dict[str, Run], exact: Callable[[np.ndarray], np.ndarray],
               shown: tuple[float, float]) -> None:
    fine = np.linspace(*shown, 4000)
    ax.plot(fine, exact(fine), label="exact", **EXACT)
    for (name, run), line in zip(runs.items(), style.CURVES):
        time = run.history["time_s"]
        middle = time - 0.5 * np.diff(time, prepend=0.0)  # rows are means over their intervals
        inside = (middle >= shown[0]) & (middle <= shown[1])
        ax.plot(middle[inside], run.history["force_y"][inside] / WIDTH, label=name,
                **{**line, "linewidth": 0.9})
    ax.set(xlim=shown, xlabel="time (s)", ylabel="pressure (Pa)")


def _velocities(ax: Axes, run: Run) -> None:
    history = run.history
    time = history["time_s"]
    center = np.gradient(history["center_y_m"], time)
    for (name, value), line in zip((("foot", history["foot_vy"]), ("top", history["top_vy"]),
                                    ("center of mass", center)), style.CURVES):
        ax.plot(time, value, label=name, **{**line, "linewidth": 0.9})
    ramp = np.interp(time, (TOUCH, TOUCH + 2 * TRANSIT), (-SPEED, SPEED))
    ax.plot(time, ramp, label="exact, center", **EXACT)
    ax.set(xlim=(TOUCH - TRANSIT / 2, TOUCH + 3 * TRANSIT), xlabel="time (s)",
           ylabel="upward velocity (m/s)")
    ax.legend(loc="lower right", fontsize=6.5)


def _heights(ax: Axes, run: Run) -> None:
    history = run.history
    time = history["time_s"]
    ax.plot(time, bounce_height(time), label="exact, center of mass", **EXACT)
    ax.plot(time, history["center_y_m"] - LENGTH / 2, label="center of mass, less half the length",
            **style.CURVES[0])
    ax.plot(time, GAP + history["foot_uy"], label="foot", **style.CURVES[1])
    ax.axhline(0, color=style.GROUND, lw=0.8, zorder=0)
    ax.set(xlim=(0, time[-1]), ylim=(None, 7.5), xlabel="time (s)", ylabel="height (m)")
    ax.legend(loc="upper center", ncols=3)


def _energy(ax: Axes, run: Run) -> None:
    history = run.history
    mass = DENSITY * LENGTH * WIDTH
    start = mass * GRAVITY * GAP
    center = history["center_y_m"]  # one row a step: the energies are of the time half before it
    height = 0.5 * (np.append(GAP + LENGTH / 2, center[:-1]) + center) - LENGTH / 2
    total = (energy(run) + mass * GRAVITY * height) / start
    ax.plot(history["time_s"], total, label="kinetic, strain and weight", **style.CURVES[0])
    ax.plot(history["time_s"], 1 - history["loss_impact"] / start, label="1 less losses in impacts",
            **style.CURVES[1])
    ax.set(xlim=(0, history["time_s"][-1]), xlabel="time (s)",
           ylabel="energy over\nthat at the start")
    ax.legend(loc="lower left")


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(prog="python3 -m rondo.figures.bars",
                                     description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("folder", type=pathlib.Path, help="folder with the three results directories")
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True, metavar="FOLDER",
                        help="folder for the .png and .svg files")
    options = parser.parse_args(arguments)
    matplotlib.use("Agg")
    try:
        for path in draw(options.folder, options.output):
            print(path)
    except Error as reason:
        print(f"rondo: {reason}", file=sys.stderr)
        return 2
    return 0


def draw(folder: str | os.PathLike[str], output: str | os.PathLike[str]) -> list[pathlib.Path]:
    """Draws both figures into `output`, each as .png and .svg; returns the files."""
    results = pathlib.Path(folder)
    wall, critical, bounce = (open_run(results / name) for name in
                              ("bar-on-wall", "bar-on-wall-critical", "bouncing-bar"))
    written = []
    for name, figure in (("bar-on-wall", draw_wall(wall, critical)),
                         ("bouncing-bar", draw_bounce(bounce))):
        written += style.save(figure, pathlib.Path(output) / name)
        plt.close(figure)
    return written


if __name__ == "__main__":
    sys.exit(main())

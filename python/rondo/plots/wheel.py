# SPDX-License-Identifier: BSD-3-Clause
"""A wheel on a rim that forces move: height, speeds, slip, forces with the load, reactions and
torques at the hub, energy of the rim, all over time."""
from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from .. import style
from ..data.errors import Error
from .labels import readable, steady_scale

if TYPE_CHECKING:
    from ..data.run import Run

Array = NDArray[np.float64]
ROW = 1.55  # in, height of a row of panels
TOP = 1.25  # of a panel's range: room for names above its curves
LETTERS = 60  # of a line of the legend, with 8 for each curve: more would reach beyond the axes
FREE = ("speed", "height")  # of the directions x and y
ENERGIES = {"kinetic_rim": "kinetic, of the rim", "support_energy": "springs",
            "work_torque": "work of the torque", "work_held": "work of what holds",
            "dissipation_brake": "into the brake", "dissipation_support": "into dashpots"}


@dataclasses.dataclass(frozen=True)
class Panel:
    """Curves over time in one unit; each (rows,) as its name."""

    label: str
    unit: str
    curves: dict[str, Array]


@style.paper()
def plot_wheel(run: Run) -> Figure:
    """A run with a [rim], in panels of what there is: height of the hub; its speed and that of the
    tread, omega R_o; slip ratio; force of the ground with load and weight; forces that hold the
    hub; torques; energies of the rim. An error of other runs."""
    need_rim(run)
    panels = [panel for panel in _panels(run) if panel.curves]
    rows = (len(panels) + 1) // 2
    figure = plt.figure(figsize=(style.PAGE, ROW * rows + 0.3))
    grid = figure.add_gridspec(rows, 2)
    for k, panel in enumerate(panels):
        row, column = divmod(k, 2)
        alone = k == len(panels) - 1 and column == 0
        ax = figure.add_subplot(grid[row, slice(None) if alone else column])
        _draw(ax, run.history["time_s"] * 1e3, panel)
        if alone or k + 2 + len(panels) % 2 >= len(panels):  # the last of its width in its column
            ax.set_xlabel("time (ms)")
        else:
            ax.tick_params(labelbottom=False)
    return figure


def need_rim(run: Run) -> None:
    """An error where the run's history has no columns of a rim."""
    if run.is_inflation:
        raise Error(f"{run.directory}: an inflation is an equilibrium, in which no rim moves: rondo figures "
                    "draws its section and its cords")
    if not run.has_rim or "spin_rad_s" not in run.history:
        raise Error(f"{run.directory}: no [rim] in the case, so that its history has no spin_rad_s, "
                    "speed_y, hub_force_x, ...: give the case a [rim] (free = [] for the reactions "
                    "alone), or draw the forces of the ground: rondo figures")


def given(run: Run, key: str) -> Array:
    """(rows,): a number or table of [rim] at the times of the history."""
    return _at(run.case["rim"].get(key, 0.0), run.history["time_s"])


def _at(value: float | list[list[float]], times: Array) -> Array:
    if not isinstance(value, list):
        return np.full(len(times), float(value))
    table = np.asarray(value, dtype=float)
    return np.asarray(np.interp(times, table[:, 0], table[:, 1]))


def _weight(run: Run) -> Array:
    """(rows,) N/m, in three dimensions N: of body and rim, along y."""
    motion = run.case["motion"]
    gravity = _at(motion.get("gravity", 0.0), run.history["time_s"])
    mass = float(run.mesh.mass.sum()) + float(run.case["rim"].get("mass", 0.0))
    return mass * gravity * np.cos(float(motion.get("slope", 0.0)))


def _panels(run: Run) -> list[Panel]:
    h = run.history
    tread = h["spin_rad_s"] * run.outer_radius
    held = [axis for axis, free in zip("xy", FREE) if free not in run.case["rim"]["free"]]
    forces = {f"that holds, along {axis}": h[f"hub_force_{axis}"] for axis in held}
    energies = {name: h[column] for column, name in ENERGIES.items()}
    return [
        Panel("height of\nthe hub", "m", {"": h["center_y_m"]}),
        Panel("speed", "m/s", {"of the hub, V": h["speed_x"], "of the tread, ωR": tread}),
        Panel("slip ratio", "1", {"": h["slip_ratio"]}),
        Panel("force of\nthe ground", f"N{run.per_width}", _ground(run)),
        *([Panel("moment of\nthe ground", "N·m", _moments(run))] if run.is_solid else []),
        Panel("force on\nthe hub", f"N{run.per_width}", forces if "ground" in run.case else {}),
        Panel("torque", f"N·m{run.per_width}", _torques(run)),
        Panel("energy", f"J{run.per_width}", _seen(energies))]


def _ground(run: Run) -> dict[str, Array]:
    """Its forces, and what they have to bear."""
    if "ground" not in run.case:
        return {}
    curves = {"upwards": run.history["force_y"], "along x": run.history["force_x"]}
    if run.is_solid:
        curves["lateral"] = run.history["force_lateral"]
    return curves | _seen({"load and weight": _weight(run) - given(run, "force_y")})


def _moments(run: Run) -> dict[str, Array]:
    """Of a wheel in three dimensions: about the normal and the heading."""
    if "ground" not in run.case:
        return {}
    return {name: run.history[f"moment_{name}"] for name in ("aligning", "overturning")}


def _torques(run: Run) -> dict[str, Array]:
    """> 0 drives, as the spin has it."""
    held = "angular_velocity" not in run.case["rim"]["free"]
    hub = {"that holds": run.history["hub_torque"]} if held else {}
    brake = -_sense(run.history["spin_rad_s"]) * given(run, "brake")
    ground = {"of the ground": 0.0 - run.history["torque"]} if "ground" in run.case else {}
    return ground | hub | _seen({"given": given(run, "torque"), "brake, at most": brake})


def _sense(spin: Array) -> Array:
    """(rows,) 1, -1: the way the rim turns, or turned before it stood; before it ever did, 1."""
    rows = np.arange(len(spin))
    last = np.maximum.accumulate(np.where(spin != 0, rows, -1))
    return np.where(last < 0, 1.0, np.sign(spin[last]))


def _seen(curves: dict[str, Array]) -> dict[str, Array]:
    """Those that are not zero all along."""
    return {name: curve for name, curve in curves.items() if np.any(curve)}


def _draw(ax: Axes, time: Array, panel: Panel) -> None:
    values = np.concatenate(list(panel.curves.values()))
    factor, unit = (1e3, "mm") if panel.unit == "m" else readable(float(np.abs(values).max()),
                                                                   panel.unit)
    for (name, curve), line in zip(panel.curves.items(), style.CURVES):
        ax.plot(time, curve * factor, label=name, **line)
    steady_scale(ax, values * factor, unit)
    ax.set_ylabel(f"{panel.label} ({unit})")
    if len(time):
        ax.set_xlim(0.0, time[-1])
    if "" not in panel.curves:
        rows = 1 if sum(len(name) + 8 for name in panel.curves) <= LETTERS else 2
        low, high = ax.get_ylim()
        ax.set_ylim(low, low + (high - low) * (1.0 + rows * (TOP - 1.0)))
        ax.legend(loc="upper left", ncols=-(-len(panel.curves) // rows), handlelength=1.6,
                  columnspacing=1.0, borderaxespad=0.1)

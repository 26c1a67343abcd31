# SPDX-License-Identifier: BSD-3-Clause
"""A validation of reduced runs: tractions under the axle, full against reduced, and errors."""
from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.gridspec import GridSpec
from numpy.typing import NDArray

from .. import style
from ..data.errors import Error
from .labels import readable
from .marks import letter

if TYPE_CHECKING:
    from ..data.validation import Validation

Profiles = dict[str, NDArray[np.float64]]

ACROSS = 3  # panels in a row
HEIGHT = 1.9  # in, of a panel
LEGEND = 0.25  # in, above them
BAR = 0.12  # in, of a bar
LEAST = 0.01  # %, where bars begin
MARGIN = 0.15  # of the contact, shown to either side of it

# Column of the table, and what it is called.
ERRORS = {
    "displacement_error": "displacement", "displacement_mean_error": "displacement, mean",
    "velocity_error": "velocity", "velocity_mean_error": "velocity, mean",
    "pressure_error": "pressure, mean", "shear_error": "shear, mean,\nover the pressure",
    "shear_own_error": "shear, mean",
    "force_x_error": "horizontal force,\nover the vertical", "force_x_own_error": "horizontal force",
    "force_y_error": "vertical force",
    "friction_error": "dissipated by friction",
}


@style.paper()
def plot_validation(validation: Validation, names: Sequence[str] = ()) -> Figure:
    """For each full run the mean pressure and shear over the angle in space, of the full run
    and of its prediction; below them the sizes of all errors, on a logarithmic axis. `names`: of
    these runs only."""
    import matplotlib.pyplot as plt

    chosen = list(names) or validation.names
    if len(chosen) > len(style.CURVES):
        raise Error(f"{validation.directory}: {len(chosen)} runs: at most {len(style.CURVES)} can "
                    "be told apart in one figure; name some of them")
    rows = {name: validation.row(name) for name in chosen}
    found = {name: validation.profiles(name) for name in chosen}
    profiles = {name: profile for name, profile in found.items() if profile is not None}
    above = -(-len(profiles) // ACROSS)
    below = len(ERRORS) * (len(chosen) + 1) * BAR + 0.5
    height = above * HEIGHT + below + LEGEND
    figure = plt.figure(figsize=(style.PAGE, height))
    figure.get_layout_engine().set(rect=(0, 0, 1, 1 - LEGEND / height))
    grid = figure.add_gridspec(above + 1, min(max(len(profiles), 1), ACROSS),
                               height_ratios=[HEIGHT] * above + [below])
    if profiles:
        _draw_profiles(figure, grid, profiles)
    _draw_errors(figure.add_subplot(grid[above, :]), rows, len(profiles))
    return figure


def _draw_profiles(figure: Figure, grid: GridSpec, profiles: dict[str, Profiles]) -> None:
    panels: list[Axes] = []
    size = max(abs(p[key]).max() for p in profiles.values() for key in p if key != "angle_rad")
    factor, unit = readable(size, "Pa")
    for k, (name, profile) in enumerate(profiles.items()):
        shared = {"sharex": panels[0], "sharey": panels[0]} if panels else {}
        ax = figure.add_subplot(grid[k // ACROSS, k % ACROSS], **shared)
        panels.append(ax)
        angle = np.degrees(profile["angle_rad"])
        for quantity, color in ("pressure", style.BLUE), ("shear", style.VERMILLION):
            ax.plot(angle, factor * profile[f"{quantity}_full_pa"], "-", color=color,
                    label=f"{quantity}, full")
            ax.plot(angle, factor * profile[f"{quantity}_reduced_pa"], "o", color=color,
                    markersize=2.5, markerfacecolor="white", markeredgewidth=0.7,
                    label=f"{quantity}, reduced")
        ax.axhline(0.0, color="0.8", linewidth=0.6, zorder=0)
        letter(ax, chr(ord("a") + k), name)
        ax.set_xlabel("angle from straight down (°)")
        if k % ACROSS == 0:
            ax.set_ylabel(f"mean traction ({unit})")
        else:
            ax.tick_params(labelleft=False)
    panels[0].set_xlim(*_contact(profiles))
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper center", ncols=4).set_in_layout(False)


def _contact(profiles: dict[str, Profiles]) -> tuple[float, float]:
    """Degrees, where any of them presses, and a little more."""
    pressed = [np.degrees(p["angle_rad"][p[key] > 1e-3 * p[key].max(initial=0.0)])
               for p in profiles.values() for key in ("pressure_full_pa", "pressure_reduced_pa")]
    angles = np.concatenate(pressed)
    if not len(angles):
        return -180.0, 180.0
    around = MARGIN * max(float(np.ptp(angles)), 1.0)
    return float(angles.min()) - around, float(angles.max()) + around


def _draw_errors(ax: Axes, rows: dict[str, dict[str, float]], panels: int) -> None:
    count = len(rows)
    height = 1.0 / (count + 1)
    places = np.arange(len(ERRORS))
    for k, ((name, row), look) in enumerate(zip(rows.items(), style.CURVES)):
        sizes = np.array([100.0 * abs(row.get(column, np.nan)) for column in ERRORS])
        at = places + (k - 0.5 * (count - 1)) * height
        known = np.isfinite(sizes)
        ax.barh(at[known], np.maximum(sizes[known] - LEAST, 0.0), 0.9 * height, left=LEAST,
                color=look["color"], label=name)
        for y, size in zip(at[known], sizes[known]):
            ax.annotate(f"{size:.2g}", (max(size, LEAST), y), xytext=(2, 0), fontsize=6,
                        textcoords="offset points", va="center")
    ax.set_yticks(places, list(ERRORS.values()))
    ax.set_ylim(len(ERRORS) - 0.4, -0.6)
    ax.set_xscale("log")
    ax.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
    ax.set_xlim(left=LEAST)
    ax.tick_params(axis="y", length=0)
    ax.set_xlabel("size of the error of the prediction (%)")
    letter(ax, chr(ord("a") + panels))
    if count > 1:
        ax.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=3)

# SPDX-License-Identifier: BSD-3-Clause
"""The footprint of steady rolling: what touches at all places of a sector's pass, folded together."""
from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import NDArray

from .. import style
from ..data.errors import Error
from .labels import readable

if TYPE_CHECKING:
    from ..data.run import Run

Array = NDArray[np.float64]
HEIGHT = 3.6  # in
DARKEST = 0.84  # grey of where all sticks
MARGIN = 0.08  # of the length of the contact, on both sides


@dataclasses.dataclass(frozen=True)
class Footprint:
    """The m pairs of a contact node and a place at which it touches, in the order of `place`.

    place: (m,) m along x from beneath the center; node: (m,) number within the sector, the same for
    those that follow each other round the wheel; pressure, shear: (m,) Pa, shear > 0 pushes the body
    along +x; slip: (m,) m/s, velocity over the ground, along +x; sticks: (m,); spacing: m between
    two places of a node."""

    place: Array
    node: NDArray[np.int64]
    pressure: Array
    shear: Array
    slip: Array
    sticks: NDArray[np.bool_]
    spacing: float


def footprint_of(run: Run) -> Footprint:
    """An error of other runs than of steady rolling, and of those of earlier versions."""
    if not run.is_steady:
        raise Error(f"{run.directory}: a footprint is of analysis.kind = \"steady-rolling\", whose "
                    "places of a sector are one contact; of a motion, plot_contact(time) draws the "
                    "contact at a time")
    run.need_snapshots()
    assert run.contact is not None  # with snapshots
    assert run.mesh.sector is not None and run.mesh.sector_node is not None  # of a disk
    rows = run.contact.rows
    if "slip_speed" not in rows:
        raise Error(f"{run.contact.path}: no column slip_speed: the run is of an earlier version; "
                    "run it again")
    place = rows["x_m"] - np.interp(rows["time_s"], run.times, run.center[:, 0])
    order = np.argsort(place, kind="stable")
    node = run.mesh.sector_node[rows["node"].astype(np.int64)]
    turn = (int(run.mesh.sector.max()) + 1) * run.n_snapshots
    return Footprint(place[order], node[order], rows["pressure_pa"][order],
                     -rows["shear_pa"][order],  # in the files to the left
                     rows["slip_speed"][order], rows["sticks"][order] > 0.5,
                     2 * np.pi * run.outer_radius / turn)


@style.paper()
def plot_footprint(run: Run) -> Figure:
    """Above pressure and shear within its bounds, ± μ times the pressure; below the slip speed. All
    contact nodes at all places of a sector's pass are drawn at where they are along x; of a tread a
    line of another kind for each contact node of a pitch. Grey is where nodes stick, the darker the more of them."""
    print_ = footprint_of(run)
    figure = plt.figure(figsize=(style.PAGE, HEIGHT))
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(1.7, 1))
    friction = run.friction or 0.0
    factor, unit = readable(float(print_.pressure.max(initial=0.0)), "Pa")
    for k, chosen in enumerate(_lines(print_)):
        x, p, s = (values[chosen] for values in (1e3 * print_.place, factor * print_.pressure,
                                                 factor * print_.shear))
        look = {"linestyle": style.CURVES[k % len(style.CURVES)]["linestyle"]}
        begin = "_" if k else ""  # said once
        if friction:
            above.fill_between(x, -friction * p, friction * p, linewidth=0, zorder=0.2, alpha=0.3,
                               color=style.SKY, label=f"{begin}within ± μp, μ = {friction:g}")
        above.plot(x, p, color=style.BLUE, label=f"{begin}pressure p", **look)
        above.plot(x, s, color=style.VERMILLION, label=f"{begin}shear, > 0 pushes along +x", **look)
        below.plot(x, print_.slip[chosen], color=style.VERMILLION, label="_slip", **look)
    for ax in (above, below):
        ax.axhline(0.0, color="0.8", linewidth=0.6, zorder=0.1)
        _shade(ax, print_)
    above.set_ylabel(f"traction ({unit})")
    below.set_ylabel("slip speed (m/s)")
    below.set_xlabel(f"along the ground, from beneath the center (mm), rolls {_way(run)}")
    _frame(above, below, print_)
    handles, names = above.get_legend_handles_labels()
    if print_.sticks.any():
        handles, names = [*handles, Patch(facecolor=str(DARKEST))], [*names, "sticks"]
    above.legend(handles, names, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=4)
    figure.suptitle(_title(run), fontsize=style.RC["axes.titlesize"])
    return figure


def _lines(print_: Footprint) -> list[NDArray[np.int64]]:
    """The pairs of each contact node of a sector."""
    return [np.flatnonzero(print_.node == node) for node in np.unique(print_.node)]


def _way(run: Run) -> str:
    return "to the right" if run.spin > 0 else "to the left"


def _title(run: Run) -> str:
    s = run.steady
    force, unit = readable(max(abs(s["force_x"]), abs(s["force_y"])), "N/m")
    slip = round(100 * s["slip_ratio"], 2) + 0.0  # no −0
    texts = [f"$F_x$ = {force * s['force_x']:.4g} {unit}", f"$F_y$ = {force * s['force_y']:.4g} {unit}",
             f"slip ratio {slip:g} %"]
    return ", ".join(texts).replace("-", "−")


def _shade(ax: Axes, print_: Footprint) -> None:
    """Grey behind the places, by how many of the nodes there stick."""
    cells = np.round((print_.place - print_.place[0]) / print_.spacing).astype(int) if len(
        print_.place) else np.empty(0, dtype=int)
    count = np.bincount(cells)
    share = np.bincount(cells, weights=print_.sticks) / np.maximum(count, 1)
    for cell in np.flatnonzero(share):
        middle = 1e3 * (print_.place[0] + cell * print_.spacing)
        half = 0.5e3 * print_.spacing
        ax.axvspan(middle - half, middle + half, color=str(1.0 - (1.0 - DARKEST) * share[cell]), linewidth=0, zorder=0)


def _frame(above: Axes, below: Axes, print_: Footprint) -> None:
    if not len(print_.place):
        return
    low, high = 1e3 * print_.place[0], 1e3 * print_.place[-1]
    beside = MARGIN * (high - low) + 1e3 * print_.spacing
    below.set_xlim(low - beside, high + beside)
    most = float(np.abs(print_.slip).max())
    if most < 1e-9:  # round-off of what sticks
        below.set_ylim(-1.0, 1.0)

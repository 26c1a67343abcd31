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
BELOW_TITLE = 0.17  # in, of the legend from the top
COLUMNS = 6  # panels beside each other
STICKS = "0.84"  # grey of where nodes stick
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
    """Above pressure and shear within its bounds, ± μ times the pressure; below the slip velocity.
    A contact node is drawn at all places of a sector's pass, at where it is along x; of a tread each
    node of a pitch has panels of its own, from the leading to the trailing one. Grey is where it
    sticks."""
    print_ = footprint_of(run)
    nodes = _leading_first(run, np.unique(print_.node))
    columns = max(1, min(len(nodes), COLUMNS))
    bands = max(1, -(-len(nodes) // columns))
    figure = plt.figure(figsize=(style.PAGE, HEIGHT * bands))
    axes = figure.subplots(2 * bands, columns, sharex=True, squeeze=False,
                           height_ratios=(1.7, 1) * bands)
    above, below = (axes[k::2].ravel() for k in (0, 1))
    _share_y(above)
    _share_y(below)
    factor, unit = readable(float(print_.pressure.max(initial=0.0)), "Pa")
    for k, node in enumerate(nodes):
        _draw_node(above[k], below[k], print_, np.flatnonzero(print_.node == node), factor,
                   run.friction or 0.0)
        if len(nodes) > 1:
            above[k].set_title(f"node {k + 1} of {len(nodes)}" + _edge(k, len(nodes)))
    for ax in (*above[len(nodes):], *below[len(nodes):]):
        ax.set_visible(len(nodes) == 0)
    for k in range(0, len(above), columns):
        above[k].set_ylabel(f"traction ({unit})")
        below[k].set_ylabel("slip velocity (m/s)")
    figure.supxlabel(f"along the ground, from beneath the center (mm), rolls {_way(run)}",
                     fontsize=style.RC["axes.labelsize"])
    _frame(below, print_)
    _legend(figure, above, bool(print_.sticks.any()))
    figure.suptitle(f"{_title(run)}\n\n", fontsize=style.RC["axes.titlesize"])
    return figure


def _leading_first(run: Run, nodes: NDArray[np.int64]) -> NDArray[np.int64]:
    """Contact nodes of a sector in the order in which they come to the ground, beginning after the
    groove: a disk that rolls to the right turns clockwise, smaller angles first."""
    if len(nodes) < 2:
        return nodes
    mesh = run.mesh
    assert mesh.sector is not None and mesh.sector_node is not None
    first = [int(np.flatnonzero((mesh.sector == 0) & (mesh.sector_node == node))[0]) for node in nodes]
    turn = 2 * np.pi / (int(mesh.sector.max()) + 1)
    angle = np.arctan2(mesh.coordinates[first, 1], mesh.coordinates[first, 0]) % turn
    ring = nodes[np.argsort(angle)]
    gaps = np.diff(np.sort(angle), append=angle.min() + turn)
    joined = _joined(run, nodes)
    gaps[[pair in joined for pair in zip(ring, np.roll(ring, -1))]] = 0.0
    ring = np.roll(ring, -1 - int(gaps.argmax()))
    return ring if run.spin > 0 else ring[::-1]


def _joined(run: Run, nodes: NDArray[np.int64]) -> set[tuple[int, int]]:
    """Pairs of these nodes of a sector that are sides of a cell, the one at the smaller angle first."""
    mesh = run.mesh
    assert mesh.sector_node is not None
    sides = np.stack([mesh.cells, np.roll(mesh.cells, -1, axis=1)], axis=-1).reshape(-1, 2)
    sides = sides[np.isin(mesh.sector_node[sides], nodes).all(axis=1)]
    one, other = mesh.coordinates[sides[:, 0]], mesh.coordinates[sides[:, 1]]
    back = one[:, 0] * other[:, 1] < one[:, 1] * other[:, 0]
    sides[back] = sides[back, ::-1]
    return {(int(a), int(b)) for a, b in mesh.sector_node[sides]}


def _edge(k: int, count: int) -> str:
    return ", leading" if k == 0 else ", trailing" if k == count - 1 else ""


def _share_y(axes: NDArray[np.object_]) -> None:
    for ax in axes[1:]:
        ax.sharey(axes[0])
        ax.tick_params(labelleft=ax.get_subplotspec().is_first_col())


def _draw_node(above: Axes, below: Axes, print_: Footprint, chosen: NDArray[np.int64],
               factor: float, friction: float) -> None:
    """One contact node at its places."""
    x, p, s = (values[chosen] for values in (1e3 * print_.place, factor * print_.pressure,
                                             factor * print_.shear))
    if friction:
        above.fill_between(x, -friction * p, friction * p, linewidth=0, zorder=0.2, alpha=0.3,
                           color=style.SKY, label=f"within ± μp, μ = {friction:g}")
    above.plot(x, p, color=style.BLUE, label="pressure p")
    above.plot(x, s, color=style.VERMILLION, linestyle="--", label="shear, > 0 pushes along +x")
    below.plot(x, print_.slip[chosen], color=style.VERMILLION, linestyle="--", label="_slip")
    width = 1e3 * print_.spacing
    sticks = x[print_.sticks[chosen]]
    runs = np.split(sticks, np.flatnonzero(np.diff(sticks) > 1.5 * width) + 1) if len(sticks) else []
    for ax in (above, below):
        ax.axhline(0.0, color="0.8", linewidth=0.6, zorder=0.1)
        for run in runs:
            ax.axvspan(run[0] - 0.5 * width, run[-1] + 0.5 * width, color=STICKS, linewidth=0, zorder=0)


def _legend(figure: Figure, above: NDArray[np.object_], sticks: bool) -> None:
    handles, names = above[0].get_legend_handles_labels()
    if sticks:
        handles, names = [*handles, Patch(facecolor=STICKS)], [*names, "sticks"]
    legend = figure.legend(handles, names, loc="upper center", ncols=4,
                           bbox_to_anchor=(0.5, 1.0 - BELOW_TITLE / figure.get_figheight()))
    legend.set_in_layout(False)  # the title has an empty line for it


def _way(run: Run) -> str:
    return "to the right" if run.spin > 0 else "to the left"


def _title(run: Run) -> str:
    s = run.steady
    force, unit = readable(max(abs(s["force_x"]), abs(s["force_y"])), "N/m")
    slip = round(100 * s["slip_ratio"], 2) + 0.0  # no −0
    texts = [f"$F_x$ = {force * s['force_x']:.4g} {unit}", f"$F_y$ = {force * s['force_y']:.4g} {unit}",
             f"slip ratio {slip:g} %"]
    return ", ".join(texts).replace("-", "−")


def _frame(below: NDArray[np.object_], print_: Footprint) -> None:
    if not len(print_.place):
        return
    low, high = 1e3 * print_.place[0], 1e3 * print_.place[-1]
    beside = MARGIN * (high - low) + 1e3 * print_.spacing
    below[0].set_xlim(low - beside, high + beside)
    most = float(np.abs(print_.slip).max())
    if most < 1e-9:  # round-off of what sticks
        below[0].set_ylim(-1.0, 1.0)

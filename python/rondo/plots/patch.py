# SPDX-License-Identifier: BSD-3-Clause
"""Pressure and shear over the contact patch of a run, at one time and over all of them."""
from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from .. import style
from ..data.errors import Error
from ..data.ground import Ground
from .cells import outline
from .field import full_range, snapshot_title
from .labels import axes_of, readable

if TYPE_CHECKING:
    from ..data.run import Run

Array = NDArray[np.float64]
QUANTITIES = ("pressure", "shear")
STICKS = 1 - 1e-9  # shear over μp up to which a node sticks
MOST_ROWS, MOST_COLUMNS = 600, 600  # of a map
FINE = 8  # columns of a map for a node


@dataclasses.dataclass(frozen=True)
class Patch:
    """The m nodes in contact at a snapshot, in the order of their places.

    nodes: (m,); place: (m,) m along the patch, see `patch_of`; ends: (m, 2) m, between which each
    is drawn: half way to a neighbour, else half the boundary that it stands for; joined: (m,) whether
    the next one is a neighbour on the boundary; pressure, shear: (m,) Pa, shear > 0 pushes the body
    towards growing places. Of bodies that touch each other the nodes of one after the other.
    """

    nodes: NDArray[np.int64]
    place: Array
    ends: Array
    joined: NDArray[np.bool_]
    pressure: Array
    shear: Array


@dataclasses.dataclass(frozen=True)
class Rows:
    """contact.csv by snapshots: `index` of the snapshot and the columns, (r,) each; the ground that
    presses these nodes, None where bodies do; sides of the boundary as n × the lower node + the
    other."""

    index: NDArray[np.int64]
    columns: dict[str, Array]
    ground: Ground | None
    sides: NDArray[np.int64]


def rows_of(run: Run) -> Rows:
    run.need_snapshots()
    if run.contact is None:
        raise Error(f"{run.directory}: no contact: the case has neither [ground] nor [contact] of "
                    "bodies")
    ground = Ground.from_case(run.case)
    columns = run.contact.rows
    index = np.searchsorted(run.times, columns["time_s"]).clip(max=run.n_snapshots - 1)
    chosen = run.times[index] == columns["time_s"]
    if ground is not None:
        chosen &= np.isfinite(columns["abscissa_m"])
    sides = np.sort(outline(run.mesh.cells), axis=1) @ np.array([run.mesh.n_nodes, 1])
    return Rows(index[chosen], {name: values[chosen] for name, values in columns.items()}, ground,
                sides)


def patch_of(run: Run, rows: Rows, k: int, moving: bool = True) -> Patch:
    """The patch of snapshot k. Places on the ground are lengths along it, to the right: from what
    is straight beneath the center of the body, or, not `moving`, from x = 0. Where bodies touch
    each other they are along the line nearest to the nodes in contact, from their middle."""
    assert run.contact is not None
    there = rows.index == k
    part = {name: values[there] for name, values in rows.columns.items()}
    nodes = part["node"].astype(np.int64)
    if rows.ground is None:
        place, sense = _along(np.stack([part["x_m"], part["y_m"]], axis=1)), 1.0
    else:
        origin = float(run.middle(k)[0]) if moving else 0.0
        place = part["abscissa_m"] - _abscissa(rows.ground, origin)
        sense = -1.0  # in the files shear is counted to the left of the normal
    bodies = np.zeros(len(nodes)) if run.mesh.free_body is None else run.mesh.free_body[nodes]
    order = np.lexsort((place, bodies))
    nodes, place = nodes[order], place[order]
    pairs = np.sort(np.stack([nodes[:-1], nodes[1:]], axis=1), axis=1)
    joined = np.append(np.isin(pairs @ np.array([run.mesh.n_nodes, 1]), rows.sides), False)
    return Patch(nodes, place, _ends(_widths(run, part, nodes, order), place, joined), joined[:len(nodes)],
                 part["pressure_pa"][order], sense * part["shear_pa"][order])


def _widths(run: Run, part: dict[str, Array], nodes: NDArray[np.int64],
            order: NDArray[np.int64]) -> Array:
    """(m,) m: length of the deformed boundary that each node stands for; of runs of earlier
    versions, which do not say it, as it is undeformed."""
    assert run.contact is not None
    if "length_m" in part:
        return part["length_m"][order]
    width = np.zeros(run.mesh.n_nodes)
    width[run.contact.nodes] = run.contact.tributary
    return width[nodes]


def _ends(width: Array, place: Array, joined: NDArray[np.bool_]) -> Array:
    """(m, 2) m, see Patch."""
    ends = place[:, None] + 0.5 * width[:, None] * np.array([-1.0, 1.0])
    between = np.flatnonzero(joined)
    ends[between, 1] = ends[between + 1, 0] = 0.5 * (place[between] + place[between + 1])
    return ends


def _abscissa(ground: Ground, x: float) -> float:
    """m: length along the ground from the first point of its profile to where it is at x."""
    reach = float(np.abs(ground.corners[:, 0]).max()) + abs(x) + 1.0
    line = ground.points((-reach, reach))
    lengths = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1)))
    lengths -= np.linalg.norm(ground.corners[0] - line[0])
    return float(np.interp(x, line[:, 0], lengths))


def _along(points: Array) -> Array:
    """(m,) m: places along the line nearest to the points (m, 2), to the right or upwards."""
    if len(points) < 2:
        return np.zeros(len(points))
    arms = points - points.mean(axis=0)
    line = np.linalg.svd(arms, full_matrices=False)[2][0]
    decisive = line[np.abs(line).argmax()]
    along: Array = arms @ (line * np.sign(decisive))
    return along


def _friction(run: Run, ground: Ground | None) -> float:
    """0: none, or there is no one coefficient whose bounds could be drawn."""
    if ground is None:
        return float(run.case["contact"].get("friction", 0.0))
    return run.friction or 0.0


@style.paper()
def plot_contact(run: Run, time: float, ax: Axes | None = None) -> Axes:
    """Pressure and shear at the nodes in contact of the snapshot nearest to `time` (s; of a crush:
    share of the depth), with the bounds of friction, ± μ times the pressure. Full dots of the shear
    stick, open ones slip; lines join neighbours along the boundary."""
    index = run.index(time)
    rows = rows_of(run)
    patch = patch_of(run, rows, index)
    friction = _friction(run, rows.ground)
    ax = axes_of(ax, 2.4)
    _draw_patch(ax, patch, friction)
    ax.axhline(0.0, color="0.8", linewidth=0.6, zorder=0)
    ax.set_xlabel(_place_label(rows.ground))
    count = {0: "no contact", 1: "1 node in contact"}.get(len(patch.nodes),
                                                           f"{len(patch.nodes)} nodes in contact")
    ax.set_title(f"{snapshot_title(run, index)}, {count}", loc="left")
    ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return ax


def _place_label(ground: Ground | None, moving: bool = True) -> str:
    if ground is None:
        return "along the contact, from its middle (mm)"
    return f"along the ground, from {'beneath the center' if moving else 'x = 0'} (mm)"


def _draw_patch(ax: Axes, patch: Patch, friction: float) -> None:
    factor, unit = readable(float(patch.pressure.max(initial=0.0)), "Pa")
    apart = np.flatnonzero(~patch.joined) + 1  # a gap in the lines
    place, pressure, shear = (np.insert(values * scale, apart, np.nan) for values, scale in (
        (patch.place, 1e3), (patch.pressure, factor), (patch.shear, factor)))
    ax.plot(place, pressure, ".-", color=style.BLUE, label="pressure p")
    if friction == 0:
        ax.plot(place, shear, ".-", color=style.VERMILLION, label="shear")
    else:
        _draw_shear(ax, place, shear, friction * pressure, f"± μp, μ = {friction:g}")
    ax.set_ylabel(f"traction ({unit})")


def _draw_shear(ax: Axes, place: Array, shear: Array, bound: Array, said: str) -> None:
    """The shear within its bounds, with dots by whether a node sticks."""
    ax.fill_between(place, -bound, bound, color="0.9", linewidth=0, zorder=0.1)
    for sign in (-1, 1):
        ax.plot(place, sign * bound, color="0.5", linewidth=0.7, linestyle=(0, (4, 2)), marker="_",
                markersize=4, zorder=0.2, label=said if sign > 0 else "_bound")
    ax.plot(place, shear, "-", color=style.VERMILLION, label="_shear")
    sticks = np.abs(shear) < STICKS * bound
    for chosen, face, name in ((sticks, style.VERMILLION, "shear, sticks"),
                               (~sticks & np.isfinite(shear), "white", "shear, slips")):
        if chosen.any():
            ax.plot(place[chosen], shear[chosen], "o", color=style.VERMILLION, label=name,
                    markersize=3, markerfacecolor=face, markeredgewidth=0.8)


@style.paper()
def plot_contact_map(run: Run, quantity: str = "pressure", ax: Axes | None = None,
                     moving: bool = True) -> Axes:
    """Pressure or shear over place and time, of a crush over place and depth: each node in contact
    as wide as half way to its neighbours, white where nothing touches. moving: places are from
    beneath the center of the body, else from x = 0."""
    if quantity not in QUANTITIES:
        raise Error(f'quantity "{quantity}": allowed are "pressure" and "shear"')
    rows = rows_of(run)
    if not len(rows.index):
        raise Error(f"{run.directory}: nothing touches at any of the {run.n_snapshots} snapshots")
    chosen = np.unique(np.linspace(0, run.n_snapshots - 1, MOST_ROWS).round().astype(int))
    patches = [patch_of(run, rows, int(k), moving) for k in chosen]
    edges = _columns(patches)
    values = np.ma.masked_invalid([_row(patch, quantity, edges) for patch in patches])
    factor, unit = readable(float(np.abs(values).max()), "Pa")
    low, high = full_range(values.compressed() * factor, quantity == "shear")
    ax = axes_of(ax, 3.0)
    colours: dict[str, Any] = {"cmap": style.DIVERGING if quantity == "shear" else style.SEQUENTIAL,
                               "vmin": low, "vmax": high}
    course, label = _course(run)
    drawn = ax.pcolormesh(edges * 1e3, _between(course[chosen]), values * factor, rasterized=True,
                          **colours)
    ax.figure.colorbar(drawn, ax=ax, label=f"{quantity} ({unit})")
    ax.set(xlabel=_place_label(rows.ground, moving), ylabel=label)
    return ax


def _course(run: Run) -> tuple[Array, str]:
    if run.crush is not None:
        return run.crush.depth * 1e3, "depth (mm)"
    return run.times * 1e3, "time (ms)"


def _between(values: Array) -> Array:
    """(k + 1,): midway between k growing values, and the first and the last."""
    if len(values) == 1:
        return values[0] + np.array([-0.5, 0.5])
    return np.concatenate([values[:1], 0.5 * (values[1:] + values[:-1]), values[-1:]])


def _columns(patches: list[Patch]) -> Array:
    """Edges of the columns of a map."""
    ends = np.concatenate([patch.ends for patch in patches])
    if not len(ends):  # contact only between the snapshots that are drawn
        return np.array([-0.5, 0.5])
    low, high = ends.min(), ends.max()
    count = FINE * (high - low) / np.median(ends[:, 1] - ends[:, 0])
    return np.linspace(low, high, int(np.clip(count, 2, MOST_COLUMNS)) + 1)


def _row(patch: Patch, quantity: str, edges: Array) -> Array:
    """A row of a map; nan where nothing touches."""
    middle = 0.5 * (edges[1:] + edges[:-1])
    row = np.full(len(middle), np.nan)
    for value, ends in zip(getattr(patch, quantity), patch.ends):
        row[slice(*np.searchsorted(middle, ends))] = value
    return row

# SPDX-License-Identifier: BSD-3-Clause
"""The footprint of a wheel in three dimensions: pressure, shear, and what sticks and slips."""
from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import NDArray

from ... import style
from ...data.errors import Error
from ...data.solid import contact_faces
from ..labels import readable, share_of_loads
from ..marks import minus

if TYPE_CHECKING:
    from ...data.run import Run

Array = NDArray[np.float64]
MARGIN = 0.06  # of the larger side of the footprint, all round
STICKS, SLIPS = style.SKY, style.ORANGE
ARROW = 0.09  # longest arrow over the larger side of the footprint
APART = 0.06  # the same of the places of two arrows: of closer ones the longer is drawn
BETWEEN = 0.72  # in, of colour bar and labels of a panel
LEAST, MOST = 2.2, 7.0  # in, height of the figure
COLUMNS = {"x": "x_m", "z": "z_m", "pressure": "pressure_pa", "shear": "shear_x_pa",
           "lateral": "shear_lateral_pa", "sticks": "sticks"}  # of contact.csv


@dataclasses.dataclass(frozen=True)
class Footprint:
    """What touches at one snapshot: m nodes, and the pieces of the surface that they stand for.

    place: (m, 2) m along t1 and t2, from beneath the center; node: (m,); pressure: (m,) Pa; shear:
    (m, 2) Pa along t1 and t2, of the ground on the body; sticks: (m,); pieces: (p, 4, 2) m, corners;
    owner: (p,) place of their node among the m."""

    place: Array
    node: NDArray[np.int64]
    pressure: Array
    shear: Array
    sticks: NDArray[np.bool_]
    pieces: Array
    owner: NDArray[np.int64]


def touching(run: Run, k: int) -> dict[str, Array]:
    """The rows of contact.csv of snapshot k, by what they are."""
    run.need_snapshots()
    if run.is_inflation:
        raise Error(f"{run.directory}: an inflation is an equilibrium off the ground: no contact, and so no "
                    "footprint")
    if run.contact is None:
        raise Error(f"{run.directory}: no ground, and so no footprint: the case has no [ground]")
    rows = run.contact.rows
    missing = [name for name in COLUMNS.values() if name not in rows]
    if missing:
        raise Error(f"{run.contact.path}: no column {', '.join(missing)}: damaged, or of another "
                    "version; run the case again")
    nearest = np.abs(run.times[:, None] - rows["time_s"][None, :]).argmin(axis=0)
    chosen = nearest == k
    found = {what: rows[name][chosen] for what, name in COLUMNS.items()}
    return found | {"node": rows["node"][chosen]}


def footprint_of(run: Run, k: int) -> Footprint:
    """Of snapshot k."""
    rows = touching(run, k)
    node = rows["node"].astype(np.int64)
    on_ground = run.on_ground(k)[:, [0, 2]]
    pieces, owner = pieces_of(on_ground, contact_faces(run.mesh), node)
    return Footprint(on_ground[node], node, rows["pressure"],
                     np.stack([rows["shear"], rows["lateral"]], axis=1), rows["sticks"] > 0.5,
                     pieces, owner)


def folded(run: Run) -> Footprint:
    """Of steady rolling all places of a sector's pass together: a node of the next sector comes to
    where one of this sector was, so that each stands for a strip as wide as its way between two
    places. Only where a sector has one column of nodes."""
    found = [footprint_of(run, k) for k in range(run.n_snapshots)]
    before = np.cumsum([0, *(len(one.node) for one in found)])
    pieces = []
    for one in found:
        narrow = one.pieces.copy()
        middle = one.place[one.owner, None, 0]
        narrow[..., 0] = middle + (narrow[..., 0] - middle) / run.n_snapshots
        pieces.append(narrow)
    def joined(name: str) -> NDArray[Any]:
        return np.concatenate([getattr(one, name) for one in found])

    return Footprint(joined("place"), joined("node"), joined("pressure"), joined("shear"),
                     joined("sticks"), np.concatenate(pieces),
                     np.concatenate([one.owner + begin for one, begin in zip(found, before)]))


def can_fold(run: Run) -> bool:
    """Steady rolling whose candidates of a sector all stand at one angle."""
    mesh = run.mesh
    if not run.is_steady or mesh.sector is None:
        return False
    x, y = mesh.coordinates[mesh.boundary[mesh.sector[mesh.boundary] == 0], :2].T
    return bool(len(x) and np.ptp(np.arctan2(y, x)) < 1e-9)


def pieces_of(points: Array, faces: NDArray[np.int64], nodes: NDArray[np.int64]
              ) -> tuple[Array, NDArray[np.int64]]:
    """(p, 4, 2) and (p,): the quarter of each face that lies next to one of the nodes, and the place
    of that node. points: (n, 2)."""
    place = np.full(len(points), -1)
    place[nodes] = np.arange(len(nodes))
    corner = points[faces]
    middle = corner.mean(axis=1)
    after = 0.5 * (corner + np.roll(corner, -1, axis=1))
    before = np.roll(after, 1, axis=1)
    quarters = np.stack([corner, after, np.broadcast_to(middle[:, None], corner.shape), before],
                        axis=2)
    owner = place[faces]
    return quarters[owner >= 0], owner[owner >= 0]


@style.paper()
def plot_footprint(run: Run, time: float | None = None) -> Figure:
    """The footprint at the snapshot nearest to `time`, by default the last one with contact, of steady
    rolling all places of a sector's pass together where a sector has one column; seen from above, the wheel rolling to the right: left the pressure with arrows of the shear by which
    the ground pushes the body, right what sticks and what slips. Each node has the colour of the
    part of the surface that it stands for; dots are the nodes."""
    k = last_contact(run) if time is None else run.index(time)
    folds = time is None and can_fold(run)
    found = folded(run) if folds else footprint_of(run, k)
    if not len(found.node):
        raise Error(f"{run.directory}: nothing touches the ground at {run.times[k]:g} "
                    f"{run.time_unit}: choose another time")
    low, high = window(found)
    figure = plt.figure(figsize=(style.PAGE, height_of(low, high)))
    left, right = figure.subplots(1, 2, sharex=True, sharey=True)
    draw_pressure(left, found)
    draw_sticking(right, found)
    for ax in (left, right):
        ax.set(xlim=(low[0], high[0]), ylim=(high[1], low[1]), aspect="equal",
               xlabel="ahead of the center (mm)")
    left.set_ylabel("to the right of the center (mm)")
    right.tick_params(labelleft=False)
    told = heading(run, k).replace(place_of(run, k), "steady rolling") if folds else heading(run, k)
    figure.suptitle(", ".join([told, forces(run, k)]), fontsize=style.RC["axes.titlesize"])
    return figure


def last_contact(run: Run) -> int:
    """The last snapshot at which something touches; the last one where nothing ever does."""
    run.need_snapshots()
    rows = run.contact.rows["time_s"] if run.contact is not None else np.empty(0)
    return run.index(float(rows[-1])) if len(rows) else run.n_snapshots - 1


def window(found: Footprint) -> tuple[Array, Array]:
    """(2,) mm each: the lowest and the highest place that is shown."""
    points = 1e3 * np.concatenate([found.pieces.reshape(-1, 2), found.place, tips(found)])
    low, high = points.min(axis=0), points.max(axis=0)
    beside = MARGIN * max(float((high - low).max()), 1.0)
    return low - beside, high + beside


def tips(found: Footprint) -> Array:
    """(m, 2) m: where the arrows of shear end."""
    size = float(np.linalg.norm(found.shear, axis=1).max())
    return found.place + found.shear * (ARROW * extent(found) / size if size else 0.0)


def height_of(low: Array, high: Array) -> float:
    """Of a figure of two panels with equal scales (in)."""
    width, height = high - low
    panel = 0.5 * style.PAGE - BETWEEN
    return float(np.clip(panel * height / width + 1.1, LEAST, MOST))


def draw_pressure(ax: Axes, found: Footprint) -> None:
    factor, unit = readable(float(found.pressure.max()), "Pa")
    cells = PolyCollection(1e3 * found.pieces, array=factor * found.pressure[found.owner],
                           cmap=style.SEQUENTIAL, edgecolors="face", linewidths=0.2, rasterized=True)
    cells.set_clim(0.0, factor * float(found.pressure.max()))
    ax.add_collection(cells)
    ax.figure.colorbar(cells, ax=ax, label=f"pressure ({unit})", shrink=0.8, pad=0.02)
    size = float(np.linalg.norm(found.shear, axis=1).max())
    if size <= 1e-9 * float(found.pressure.max()):
        ax.set_title("no shear")
        return
    shown = apart(found)
    starts = 1e3 * found.place[shown]
    # White with a dark edge: seen on the light and on the dark.
    ax.quiver(*starts.T, *(1e3 * tips(found)[shown] - starts).T, angles="xy", scale_units="xy", scale=1.0,
              facecolor="white", edgecolor=style.BLACK, linewidth=0.4, width=0.009, headwidth=3.2,
              headlength=3.4, headaxislength=3.0, minlength=0.2, zorder=4)
    factor, unit = readable(size, "Pa")
    ax.set_title(f"shear on the body, longest arrow {size * factor:.3g} {unit}")


def extent(found: Footprint) -> float:
    """The larger side of the footprint [m]."""
    points = np.concatenate([found.pieces.reshape(-1, 2), found.place])
    return float(np.ptp(points, axis=0).max()) or 0.01


def apart(found: Footprint) -> NDArray[np.int64]:
    """Nodes whose arrows do not hide each other, the longest first."""
    least, kept = APART * extent(found), np.empty(0, dtype=np.int64)
    for node in np.argsort(-np.linalg.norm(found.shear, axis=1), kind="stable"):
        if (np.linalg.norm(found.place[kept] - found.place[node], axis=1) >= least).all():
            kept = np.append(kept, node)
    return kept


def draw_sticking(ax: Axes, found: Footprint) -> None:
    sticks = found.sticks[found.owner]
    for mask, colour in ((sticks, STICKS), (~sticks, SLIPS)):
        ax.add_collection(PolyCollection(1e3 * found.pieces[mask], facecolors=colour,
                                         edgecolors=colour, linewidths=0.2))
    for mask, face in ((found.sticks, style.BLACK), (~found.sticks, "white")):
        ax.plot(*(1e3 * found.place[mask].T), "o", markersize=2.0, markerfacecolor=face,
                markeredgecolor=style.BLACK, markeredgewidth=0.4)
    count = int(found.sticks.sum())
    ax.legend(handles=[Patch(facecolor=STICKS, label=f"sticks ({count})"),
                       Patch(facecolor=SLIPS, label=f"slips ({len(found.sticks) - count})")],
              loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2)


def heading(run: Run, k: int) -> str:
    """Time, slip angle and camber; of a wheel that stands its depth and camber."""
    parts = [place_of(run, k)]
    slip = value_at(run, "slip_angle", float(run.times[k]))
    if slip is not None and not run.is_crush:
        parts.append(f"slip angle {np.degrees(slip):.3g}°")
    if run.camber:
        parts.append(f"camber {np.degrees(run.camber):.3g}°")
    return minus(", ".join(parts))


FORCES = (("force_y", "$F_n$", "N"), ("force_x", "$F_x$", "N"), ("force_lateral", "$F_{lat}$", "N"),
          ("moment_aligning", "$M_n$", "N·m"))


def forces(run: Run, k: int) -> str:
    """Those of the ground about snapshot k."""
    parts = []
    for name, text, unit in FORCES:
        value = value_at(run, name, float(run.times[k]))
        if value is not None:
            factor, shown = readable(abs(value), unit)
            parts.append(f"{text} = {factor * value:.4g} {shown}")
    return minus(", ".join(parts))


def place_of(run: Run, k: int) -> str:
    if run.is_steady:
        return f"place {k + 1} of {run.n_snapshots}"
    if run.crush is not None:
        return f"depth {1e3 * float(run.crush.depth[k]):.3g} mm"
    if run.is_inflation:
        return share_of_loads(float(run.times[k]))
    return f"t = {1e3 * float(run.times[k]):.1f} ms"


def value_at(run: Run, column: str, time: float) -> float | None:
    """Of the history, at the row nearest to a time; of steady rolling its mean."""
    history = run.history
    if column not in history or not len(history["time_s"]):
        return None
    if run.is_steady:
        return float(history[column].mean())
    return float(history[column][np.abs(history["time_s"] - time).argmin()])

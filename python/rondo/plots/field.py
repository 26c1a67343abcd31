# SPDX-License-Identifier: BSD-3-Clause
"""Fields of a run drawn on the deformed body, in the fixed or in the turning frame."""
from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from .. import style
from ..data.errors import Error
from ..data.ground import Ground

if TYPE_CHECKING:
    from ..data.run import Run

Array = NDArray[np.float64]
FRAMES = ("fixed", "turning")
COMPONENTS = ("x", "y", "radial", "tangential")
VECTORS = ("displacement", "velocity")
NAMES = {"von_mises": "von Mises stress"}  # in figures, where not the name of the field itself
SHOWN_IN = {  # units of results: factor, unit of figures
    "m": (1e3, "mm"), "Pa": (1e-6, "MPa"), "1": (1.0, "–"),
}


@dataclasses.dataclass(frozen=True)
class Nodal:
    """A quantity at the nodes: values (n,) in `unit`; signed if it may be negative."""

    values: Array
    label: str
    unit: str
    signed: bool


def turned(vectors: Array, angle: float) -> Array:
    """(..., 2): the vectors turned by the angle (rad), counter-clockwise."""
    cos, sin = np.cos(angle), np.sin(angle)
    x, y = vectors[..., 0], vectors[..., 1]
    return np.stack([cos * x - sin * y, sin * x + cos * y], axis=-1)


def component(vectors: Array, coordinates: Array, name: str) -> Array:
    """(n,): a component ("x", "y", "radial", "tangential") of vectors (n, 2) at nodes of the
    reference coordinates (n, 2); the tangential one is counter-clockwise."""
    if name in ("x", "y"):
        return vectors[:, "xy".index(name)]
    radius = np.maximum(np.linalg.norm(coordinates, axis=1), 1e-300)
    radial = coordinates / radius[:, None]
    if name == "tangential":
        radial = turned(radial, 0.5 * np.pi)
    return np.sum(vectors * radial, axis=1)


def nodal(run: Run, index: int, quantity: str, frame: str = "fixed") -> Nodal:
    """A quantity of the snapshot `index` at the nodes.

    quantity: "displacement" or "velocity" (as the turning frame sees them): their magnitude; with
    "_x", "_y" a component along the axes of `frame`, with "_radial", "_tangential" about the
    centre; or a field with one number per node that the run holds, as "von_mises".
    """
    base, _, ending = quantity.partition("_")
    if base in VECTORS and (ending in COMPONENTS or not ending):
        source = run.field(base)
        vectors = np.asarray(source[index], dtype=float)
        signed = bool(ending)
        if signed:
            angles = run.angle if base == "displacement" else run.angle_velocity
            if frame == "fixed" and ending in ("x", "y"):
                seen = turned(vectors, float(angles[index]))
                vectors = np.where(run.mesh.free[:, None], vectors, seen)
            values = component(vectors, run.mesh.coordinates, ending)
            label = f"{base}, {ending}"
        else:
            values, label = np.linalg.norm(vectors, axis=1), base
    else:
        source = run.field(quantity)
        values = np.asarray(source[index], dtype=float)
        if values.ndim != 1:
            raise Error(f"{quantity}: {values.shape[-1]} numbers at each node; allowed are "
                        "displacement and velocity, alone or with _x, _y, _radial, _tangential, "
                        "and fields with one number at each node, as von_mises")
        signed, label = bool(values.min() < 0), NAMES.get(quantity, quantity.replace("_", " "))
    factor, unit = SHOWN_IN.get(source.units, (1.0, source.units))
    return Nodal(values * factor, label, unit, signed)


def positions(run: Run, index: int, frame: str = "fixed", deformation: float = 1.0) -> Array:
    """(n, 2) m: the nodes of a snapshot, the displacement magnified by `deformation`. Free bodies
    are where they are, in both frames."""
    if frame not in FRAMES:
        raise Error(f'frame "{frame}": allowed are "fixed" and "turning"')
    if deformation != 1.0 and run.mesh.free.any():
        raise Error(f"deformation = {deformation:g}: nothing holds some bodies of this run, whose "
                    "displacement is their whole motion; 1 alone is allowed")
    if frame == "fixed" and deformation == 1.0:
        return run.position(index)
    arms = run.mesh.coordinates + deformation * np.asarray(run.displacement[index])
    if frame == "turning":
        return arms
    return np.asarray(run.center[index]) + turned(arms, float(run.angle[index]))


def outline(cells: NDArray[np.integer[Any]]) -> NDArray[np.int64]:
    """(k, 2): the sides that belong to one cell only, as their two nodes."""
    following = np.roll(cells, -1, axis=1)
    if cells.shape[1] == 4:  # a triangle among quadrilaterals has -1 in the last place
        triangle = cells[:, 3] < 0
        following[triangle, 2] = cells[triangle, 0]
    sides = np.stack([cells.ravel(), following.ravel()], axis=1).astype(np.int64)
    sides = sides[(sides >= 0).all(axis=1)]
    _, where, count = np.unique(np.sort(sides, axis=1), axis=0, return_index=True,
                                return_counts=True)
    return sides[np.sort(where[count == 1])]


def loops(sides: NDArray[np.int64]) -> list[NDArray[np.int64]]:
    """The sides of `outline` joined end to end: nodes of each closed line, the first once more at
    its end. Drawn as one line each they have round corners, and SVG files stay small."""
    following: dict[int, list[int]] = {}
    for start, end in sides.tolist():
        following.setdefault(start, []).append(end)
    found = []
    while following:
        line = [next(iter(following))]
        while line[-1] in following:
            ends = following[line[-1]]
            node = ends.pop()
            if not ends:
                del following[line[-1]]
            line.append(node)
        found.append(np.array(line))
    return found


def corners(points: Array, cells: NDArray[np.integer[Any]]) -> Array:
    """(e, 4 or 3, 2): the corners of the cells; a triangle among quadrilaterals has its last
    corner twice."""
    filled = np.where(cells < 0, np.roll(cells, 1, axis=1), cells)
    return points[filled]


def cell_means(values: Array, cells: NDArray[np.integer[Any]]) -> Array:
    """(e,): the mean of the nodes of each cell."""
    there = cells >= 0
    return np.where(there, values[cells], 0.0).sum(axis=1) / there.sum(axis=1)


@dataclasses.dataclass
class Body:
    """A body on an axes; `update` shows another snapshot, for animations."""

    run: Run
    quantity: str
    frame: str
    deformation: float
    cells: PolyCollection
    edge: LineCollection
    lines: list[NDArray[np.int64]]

    def update(self, index: int) -> None:
        points = positions(self.run, index, self.frame, self.deformation)
        values = nodal(self.run, index, self.quantity, self.frame).values
        self.cells.set_verts(corners(points, self.run.mesh.cells))
        self.cells.set_array(cell_means(values, self.run.mesh.cells))
        self.edge.set_segments([points[line] for line in self.lines])


def draw_cells(ax: Axes, points: Array, cells: NDArray[np.integer[Any]], values: Array,
               limits: tuple[float, float], signed: bool = False,
               mesh_width: float = 0.1) -> tuple[PolyCollection, LineCollection]:
    """Cells (e, 4 or 3) with nodes at points (n, 2), coloured by the mean of their nodal values
    (n,), and the edge of the body. `mesh_width` (pt) is that of the sides of the cells."""
    patches = PolyCollection(corners(points, cells), array=cell_means(values, cells),
                             cmap=style.DIVERGING if signed else style.SEQUENTIAL,
                             edgecolors=style.MESH, linewidths=mesh_width, rasterized=True)
    if mesh_width == 0:
        patches.set_antialiased(False)  # else the background shines through between cells
    patches.set_clim(*limits)
    edge = LineCollection([points[line] for line in loops(outline(cells))], colors=style.OUTLINE,
                          linewidths=0.6, joinstyle="round")
    ax.add_collection(patches)
    ax.add_collection(edge)
    return patches, edge


def draw_body(ax: Axes, run: Run, index: int, quantity: str = "displacement", frame: str = "fixed",
              deformation: float = 1.0, limits: tuple[float, float] | None = None,
              mesh_width: float = 0.1) -> Body:
    """The body of the snapshot `index`; its `cells` go to a colour bar. `limits` of the colours are
    in the unit of the figure (see `nodal`); None: those of the cells of this snapshot, as one
    corner node may have far more."""
    field = nodal(run, index, quantity, frame)
    points = positions(run, index, frame, deformation)
    patches, edge = draw_cells(ax, points, run.mesh.cells, field.values,
                               limits or full_range(cell_means(field.values, run.mesh.cells),
                                                    field.signed), field.signed, mesh_width)
    return Body(run, quantity, frame, deformation, patches, edge, loops(outline(run.mesh.cells)))


def full_range(values: Array, signed: bool) -> tuple[float, float]:
    """Limits of colour: from 0, or the same on both sides of 0."""
    top = float(np.abs(values).max()) or 1.0
    return (-top if signed else 0.0, top)


def draw_ground(ax: Axes, ground: Ground | None, window: tuple[float, float],
                bottom: float) -> None:
    """The ground between window[0] and window[1] (m along x), filled down to `bottom` (m)."""
    if ground is None:
        return
    line = ground.points(window)
    lower = min(bottom, line[:, 1].min())
    closed = np.concatenate([line, [[line[-1, 0], lower], [line[0, 0], lower]]])
    ax.fill(closed[:, 0], closed[:, 1], color=style.GROUND, linewidth=0, zorder=0)
    ax.plot(line[:, 0], line[:, 1], color=style.OUTLINE, linewidth=0.6, zorder=0.5)


@dataclasses.dataclass
class ContactZone:
    """The nodes in contact drawn on an axes; `update` shows another snapshot."""

    run: Run
    frame: str
    deformation: float
    lines: tuple[LineCollection, LineCollection]
    dots: tuple[Line2D, Line2D]
    sides: NDArray[np.int64]

    def update(self, index: int) -> None:
        if self.run.contact is None:
            return
        touching = np.zeros(self.run.mesh.n_nodes, dtype=bool)
        forces = np.asarray(self.run.contact.force[index])[:, 0]
        touching[self.run.mesh.boundary[forces > 0]] = True
        points = positions(self.run, index, self.frame, self.deformation)
        zone = self.sides[touching[self.sides].all(axis=1)]
        alone = np.setdiff1d(np.flatnonzero(touching), zone)
        for line in self.lines:
            line.set_segments(list(points[zone]))
        for dot in self.dots:
            dot.set_data(*points[alone].T)


def draw_contact(ax: Axes, run: Run, index: int, width: float = 2.0, frame: str = "fixed",
                 deformation: float = 1.0) -> ContactZone:
    """The nodes in contact with the ground as a thick line along the edge of the body, with a white
    seam that parts it from any colour; a node without a neighbour in contact is a dot. Nothing
    where the run has no ground."""
    lines, dots = [], []
    for color, wide, above in (("white", width + 1.2, 4.0), (style.CONTACT, width, 4.1)):
        lines.append(LineCollection([], colors=color, linewidths=wide, capstyle="round",
                                    zorder=above))
        ax.add_collection(lines[-1])
        dots += ax.plot([], [], "o", color=color, markersize=wide, markeredgewidth=0, zorder=above)
    drawn = ContactZone(run, frame, deformation, (lines[0], lines[1]), (dots[0], dots[1]),
                        outline(run.mesh.cells))
    drawn.update(index)
    return drawn


def plot_field(run: Run, time: float, quantity: str = "displacement", ax: Axes | None = None,
               frame: str = "fixed", deformation: float = 1.0,
               limits: tuple[float, float] | None = None, colorbar: bool = True) -> Axes:
    """The body at the snapshot nearest to `time` (s; of a crush: share of the depth, 0 to 1).

    frame: "fixed" (with the ground) or "turning"; nodes in contact are marked in both.
    deformation: factor on the displacement; limits: of the colours, in the unit of the colour bar
    (mm, m/s, MPa); by default those of the cells as drawn.
    """
    index = run.index(time)
    with style.paper():
        if ax is None:
            ax = plt.figure(figsize=(style.COLUMN, 0.85 * style.COLUMN)).add_subplot()
        body = draw_body(ax, run, index, quantity, frame, deformation, limits)
        frame_axes(ax, run, index, frame, deformation)
        draw_contact(ax, run, index, frame=frame, deformation=deformation)
        ax.set_title(snapshot_title(run, index))
        if colorbar:
            field = nodal(run, index, quantity, frame)
            ax.figure.colorbar(body.cells, ax=ax, label=f"{field.label} ({field.unit})", shrink=0.8)
    return ax


def snapshot_title(run: Run, index: int) -> str:
    """The time of a snapshot, or the depth of an increment of a crush."""
    if run.crush is not None:
        return f"depth {float(run.crush.depth[index]) * 1e3:.3g} mm"
    return f"t = {float(run.times[index]) * 1e3:.1f} ms"


def frame_axes(ax: Axes, run: Run, index: int, frame: str, deformation: float = 1.0) -> None:
    """Limits, equal scales, labels and ground about the body of a snapshot."""
    points = positions(run, index, frame, deformation)
    low, high = points.min(axis=0), points.max(axis=0)
    margin = 0.08 * (high - low).max()
    ax.set_xlim(low[0] - margin, high[0] + margin)
    ax.set_ylim(low[1] - margin, high[1] + margin)
    ax.set_aspect("equal")
    ax.set_xlabel("x (m)" if frame == "fixed" else "X (m)")
    ax.set_ylabel("y (m)" if frame == "fixed" else "Y (m)")
    if frame == "fixed":
        draw_ground(ax, Ground.from_case(run.case), ax.get_xlim(), low[1] - 2 * margin)

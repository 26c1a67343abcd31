# SPDX-License-Identifier: BSD-3-Clause
"""Fields of a run drawn on the deformed body, in the fixed or in the co-rotating frame."""
from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from .. import style
from ..data.errors import Error
from ..data.ground import Ground
from ..data.names import FRAME, frame_named
from .cells import Array, Cells, cell_means, component, corners, loops, outline, turned
from .labels import share_of_loads
from .rim import Rim, draw_rim

if TYPE_CHECKING:
    from ..data.run import Run

FRAMES = ("fixed", FRAME)
COMPONENTS = ("x", "y", "radial", "tangential")
VECTORS = ("displacement", "deformation", "velocity")
NAMES = {"von_mises": "von Mises stress"}  # in figures, where not the name of the field itself
SLIM = 0.4  # least width of a picture over its height, or the other way round
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


def nodal(run: Run, index: int, quantity: str, frame: str = "fixed") -> Nodal:
    """A quantity of the snapshot `index` at the nodes.

    quantity: "displacement" or "velocity" (as the co-rotating frame sees them), "deformation" (the
    displacement without the motion of free bodies as rigid ones): their magnitude; with "_x", "_y"
    a component along the axes of `frame`, with "_radial", "_tangential" about the center; or a
    field with one number per node that the run holds, as "von_mises".
    """
    base, _, ending = quantity.partition("_")
    if base in VECTORS and (ending in COMPONENTS or not ending):
        values = _part_of_vectors(run, index, base, ending, frame)
        signed, label = bool(ending), f"{base}, {ending}" if ending else base
        units = run.field("displacement" if base == "deformation" else base).units
    else:
        source = run.field(quantity)
        values, units = np.asarray(source[index], dtype=float), source.units
        if values.ndim != 1:
            raise Error(f"{quantity}: {values.shape[-1]} numbers at each node; allowed are "
                        "displacement, deformation and velocity, alone or with _x, _y, _radial, "
                        "_tangential, and fields with one number at each node, as von_mises")
        signed, label = bool(values.min() < 0), NAMES.get(quantity, quantity.replace("_", " "))
    factor, unit = SHOWN_IN.get(units, (1.0, units))
    return Nodal(values * factor, label, unit, signed)


def _part_of_vectors(run: Run, index: int, base: str, ending: str, frame: str) -> Array:
    """(n,): the magnitude of a vector, or one of its components."""
    coordinates = run.mesh.coordinates
    angle: Any = float((run.angle_velocity if base == "velocity" else run.angle)[index])
    if base == "deformation":
        rigid = run.rigid(index)
        vectors, coordinates = rigid.deformation, coordinates - rigid.center
        angle = np.where(run.mesh.free, rigid.angle, angle)
    else:
        vectors = np.asarray(run.field(base)[index], dtype=float)
        angle = np.where(run.mesh.free, 0.0, angle)  # free bodies: along the fixed axes as they are
    if not ending:
        return np.linalg.norm(vectors, axis=1)
    if ending in ("x", "y"):
        vectors = turned(vectors, angle * ((frame == "fixed") | run.mesh.free))
    return component(vectors, coordinates, ending)


def positions(run: Run, index: int, frame: str = "fixed", deformation: float = 1.0) -> Array:
    """(n, 2) m: the nodes of a snapshot, the displacement magnified by `deformation`; of free
    bodies what is not their motion as rigid ones. These are where they are, in both frames."""
    frame = frame_named(frame)
    if frame not in FRAMES:
        raise Error(f'frame "{frame}": allowed are "fixed" and "{FRAME}"')
    if frame == "fixed" and deformation == 1.0:
        return run.position(index)
    rigid = run.rigid(index)
    arms = run.mesh.coordinates + deformation * rigid.deformation
    if frame == "fixed":
        arms = np.asarray(run.center[index]) + turned(arms, float(run.angle[index]))
    free = rigid.places + deformation * turned(rigid.deformation, rigid.angle)
    return np.where(run.mesh.free[:, None], free, arms)


@dataclasses.dataclass
class Body:
    """A body on an axes; `update` shows another snapshot, for animations."""

    run: Run
    quantity: str
    frame: str
    deformation: float
    cells: Cells
    edge: LineCollection
    lines: list[NDArray[np.int64]]
    rim: Rim | None

    def update(self, index: int) -> Array:
        """Returns the places of the nodes."""
        points = positions(self.run, index, self.frame, self.deformation)
        values = nodal(self.run, index, self.quantity, self.frame).values
        self.cells.move(corners(points, self.run.mesh.cells))
        self.cells.set_array(cell_means(values, self.run.mesh.cells))
        self.edge.set_segments([points[line] for line in self.lines])
        if self.rim is not None:
            self.rim.update(index)
        return points


def draw_cells(ax: Axes, points: Array, cells: NDArray[np.integer[Any]], values: Array,
               limits: tuple[float, float], signed: bool = False,
               mesh_width: float = 0.1) -> tuple[Cells, LineCollection]:
    """Cells (e, 4 or 3) with nodes at points (n, 2), coloured by the mean of their nodal values
    (n,), and the edge of the body. `mesh_width` (pt) is that of the sides of the cells."""
    patches = Cells(corners(points, cells), array=cell_means(values, cells),
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
    """The body of the snapshot `index` and the rim that holds it; its `cells` go to a colour bar.
    `limits` of the colours are in the unit of the figure (see `nodal`); None: those of the cells of
    this snapshot, as one corner node may have far more."""
    field = nodal(run, index, quantity, frame)
    points = positions(run, index, frame, deformation)
    patches, edge = draw_cells(ax, points, run.mesh.cells, field.values,
                               limits or full_range(cell_means(field.values, run.mesh.cells),
                                                    field.signed), field.signed, mesh_width)
    return Body(run, quantity, frame, deformation, patches, edge, loops(outline(run.mesh.cells)),
                draw_rim(ax, run, index, frame))


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

    def update(self, index: int, points: Array | None = None) -> None:
        """points: the places of the nodes, where they are known."""
        if self.run.contact is None:
            return
        touching = np.zeros(self.run.mesh.n_nodes, dtype=bool)
        forces = np.asarray(self.run.contact.force[index])[:, 0]
        touching[self.run.mesh.boundary[forces > 0]] = True
        if points is None:
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

    frame: "fixed" (with the ground) or "co-rotating"; nodes in contact are marked in both.
    deformation: factor on the displacement, of free bodies on what is not their motion as rigid
    ones; limits: of the colours, in the unit of the colour bar
    (mm, m/s, MPa); by default those of the cells as drawn.
    """
    frame, index = frame_named(frame), run.index(time)
    with style.paper():
        if ax is None:
            ax = plt.figure(figsize=(style.COLUMN, 0.85 * style.COLUMN)).add_subplot()
        body = draw_body(ax, run, index, quantity, frame, deformation, limits)
        frame_axes(ax, run, index, frame, deformation)
        draw_contact(ax, run, index, frame=frame, deformation=deformation)
        ax.set_title(snapshot_title(run, index, deformation))
        if colorbar:
            field = nodal(run, index, quantity, frame)
            ax.figure.colorbar(body.cells, ax=ax, label=f"{field.label} ({field.unit})", shrink=0.8)
    return ax


def snapshot_title(run: Run, index: int, deformation: float = 1.0) -> str:
    """The time of a snapshot, the depth of an increment of a crush, the share of the loads of an inflation, or
    the place of a sector's pass in steady rolling, and the factor on the deformation."""
    factor = "" if deformation == 1.0 else f", deformation × {deformation:g}"
    if run.crush is not None:
        return f"depth {float(run.crush.depth[index]) * 1e3:.3g} mm{factor}"
    if run.is_inflation:
        return share_of_loads(float(run.times[index])) + factor
    if run.is_steady:
        return f"place {index + 1} of {run.n_snapshots}{factor}"
    return f"t = {float(run.times[index]) * 1e3:.1f} ms{factor}"


def frame_axes(ax: Axes, run: Run, index: int, frame: str, deformation: float = 1.0) -> None:
    """Limits, equal scales, labels and ground about the body of a snapshot."""
    points = positions(run, index, frame, deformation)
    low, high = points.min(axis=0), points.max(axis=0)
    margin = np.maximum(0.08 * (high - low).max(),
                        0.5 * (SLIM * (high - low).max() - (high - low)))
    ax.set_xlim(low[0] - margin[0], high[0] + margin[0])
    ax.set_ylim(low[1] - margin[1], high[1] + margin[1])
    ax.set_aspect("equal")
    for axis, size in zip((ax.xaxis, ax.yaxis), high - low):
        if size < SLIM * (high - low).max():
            axis.set_major_locator(MaxNLocator(2))
    ax.set_xlabel("x (m)" if frame == "fixed" else "X (m)")
    ax.set_ylabel("y (m)" if frame == "fixed" else "Y (m)")
    if frame == "fixed":
        draw_ground(ax, Ground.from_case(run.case), ax.get_xlim(), low[1] - 2 * margin[1])

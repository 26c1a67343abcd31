# SPDX-License-Identifier: BSD-3-Clause
"""Shapes of the modes of a wheel in three dimensions: from the side, in its section, and the motion
of its tread over the angle."""
from __future__ import annotations

from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from numpy.typing import NDArray

from ... import style
from ...data.solid import FACES, outer_faces
from ..cells import loops, outline
from ..marks import letter, minus
from ..modes import COLUMNS
from ..shapes import BEFORE, Shape, heading, shapes_of
from .section import TINTS
from .surface import component
from .view import View, visible

if TYPE_CHECKING:
    from ...data.mesh import Mesh
    from ...data.modes import Modes

Array = NDArray[np.float64]
Whole = NDArray[np.int64]
PARTS = {"radial": "radial", "tangential": "tangential", "axial": "lateral"}  # of `component`
LARGEST = 0.15  # longest vector as drawn, over the outer radius
SAME = 1e-6  # of the outer radius, or rad: places that are one
SPOKES = 12
# Places in the figure (in): what is left of the blocks of modes and between them, and their width;
LEFT, GAP, BLOCK = 0.6, 0.3, (style.PAGE - 0.6 - 2 * 0.3 - 0.15) / COLUMNS
VIEW, NAME, CURVES = 0.5 * BLOCK, 0.2, 0.55  # a view, its name below, the curves,
NUMBERS, TITLE = 0.42, 0.42  # what is below those, and above the views
ROW = TITLE + VIEW + NAME + CURVES + NUMBERS
TOP, BOTTOM = 0.2, 0.62  # above and below all blocks


def plot_shapes(modes: Modes, count: int = 6, spin: float | None = None) -> Figure:
    """The first modes of a wheel at this spin (rad/s), by default the first there is. Of each:

    - the wheel from its right side, moved by the real part of the shape, the longest vector 0.15 of
      the radius. Colours are the lateral part over the longest vector: yellow moves towards the eye,
      blue away from it. The line at the outside is the middle of the tread, dashed where it is
      undeformed; the spokes, from the rim to it, show how it turns about the axle.
    - the section where it moves most in its plane, over the undeformed one (dashed), seen with the
      axle to the right. The angle is counter-clockwise from straight down, at the time 0.
    - the radial (outwards), tangential (counter-clockwise) and lateral part of the motion of the
      middle of the tread over the angle, over the longest vector of the wheel.

    The two waves of a pair at rest have one picture, because the second is the first one turned by a
    quarter of a wave. A travelling wave is drawn at phase 0; it keeps its shape and travels in the
    sense that the title says. What is not quite a travelling wave takes the shape of minus the
    imaginary part (`modes.shape(row).imag`) a quarter of a period later. Where the wheel stands, the
    ground is drawn over what lies below it, as the shapes are on the body that is not pressed flat."""
    shapes, ring = shapes_of(modes, count, spin), tread_ring(modes.mesh)
    rows = -(-len(shapes) // COLUMNS)
    with style.paper():
        figure = plt.figure(figsize=(style.PAGE, TOP + rows * ROW + BOTTOM))
        figure.set_layout_engine("none")  # it shrinks views whose names are wider than they are
        for number, shape in enumerate(shapes):
            row, column = divmod(number, COLUMNS)
            left = LEFT + column * (BLOCK + GAP)
            curves = draw_block(figure, modes, shape, ring, (left, BOTTOM + (rows - 1 - row) * ROW))
            letter(figure.axes[-3], "abcdefghijklmnopqrstuvwxyz"[number % 26], shape.title)
            if column:
                curves.set_ylabel("")
                curves.tick_params(labelleft=False)
        beneath = 1.0 - 0.05 / figure.get_figheight()
        figure.text(0.01, beneath, heading(modes, spin), verticalalignment="top")
        figure.legend(*curves.get_legend_handles_labels(), loc="upper right", ncol=3, borderpad=0.0,
                      borderaxespad=0.0, bbox_to_anchor=(0.99, beneath))
        figure.colorbar(ScalarMappable(Normalize(-1.0, 1.0), style.DIVERGING), orientation="horizontal",
                        cax=_panel(figure, 0.3 * style.PAGE, 0.4, 0.4 * style.PAGE, 0.08),
                        label="lateral part over the longest vector (–)")
    return figure


def draw_block(figure: Figure, modes: Modes, shape: Shape, ring: Whole, corner: tuple[float, float]
               ) -> Axes:
    """A mode with its lower left corner there (in); returns the axes of the curves, the last of three."""
    left, bottom = corner[0], corner[1] + NUMBERS
    above = bottom + CURVES + NAME
    side = _panel(figure, left, above, VIEW, VIEW)
    draw_side(side, modes, shape.vectors, ring)
    section = _panel(figure, left + VIEW, above, VIEW, VIEW)
    draw_section(section, modes.mesh, shape.vectors, ring)
    curves = _panel(figure, left, bottom, BLOCK, CURVES)
    draw_curves(curves, modes.mesh, shape.vectors, ring)
    return curves


def _panel(figure: Figure, *place: float) -> Axes:
    """Axes at left, bottom, width and height (in)."""
    width, height = figure.get_size_inches()
    ax: Axes = figure.add_axes([place[0] / width, place[1] / height, place[2] / width, place[3] / height])
    return ax


def tread_ring(mesh: Mesh) -> Whole:
    """The nodes around the middle of the tread, by their angle: of the circles of most nodes within a
    tenth of the tread's width of its middle the largest."""
    z, radius = mesh.coordinates[:, 2], _radius(mesh)
    low, high = z[mesh.boundary].min(), z[mesh.boundary].max()
    away, tolerance = np.abs(z - 0.5 * (low + high)), SAME * radius.max()
    assert mesh.sector is not None  # no other wheels have modes
    begin = np.flatnonzero(mesh.sector == mesh.sector[mesh.boundary[0]])
    begin = begin[away[begin] <= max(0.1 * (high - low), away[begin].min() + tolerance)]
    circles = np.unique(np.round(np.stack([radius[begin], z[begin]], axis=1) / tolerance), axis=0)
    rings = [_circle(mesh, radius, circle * tolerance) for circle in circles]
    most = max(len(ring) for ring in rings)
    ring = max((ring for ring in rings if len(ring) == most),
               key=lambda nodes: float(np.mean(radius[nodes] - away[nodes])))
    return ring[np.argsort(angles(mesh.coordinates[ring]))]


def _circle(mesh: Mesh, radius: Array, place: Array) -> Whole:
    """The nodes at a radius and a place along the axle."""
    near = 2.0 * SAME * radius.max()
    return np.flatnonzero((np.abs(radius - place[0]) < near)
                          & (np.abs(mesh.coordinates[:, 2] - place[1]) < near))


def _radius(mesh: Mesh) -> Array:
    found: Array = np.linalg.norm(mesh.coordinates[:, :2], axis=1)
    return found


def angles(places: Array) -> Array:
    """rad, -pi to pi: counter-clockwise from straight down."""
    return np.arctan2(places[..., 0], -places[..., 1])


def moved(mesh: Mesh, vectors: Array) -> Array:
    """(n, 3) m: the nodes, moved as drawn."""
    places: Array = mesh.coordinates + LARGEST * _radius(mesh).max() * vectors
    return places


def draw_side(ax: Axes, modes: Modes, vectors: Array, ring: Whole) -> None:
    """From the right, coloured by the lateral part."""
    mesh, view, faces = modes.mesh, View(0.0, 0.0), outer_faces(modes.mesh.cells)
    points, inner, outer = moved(mesh, vectors), _radius(mesh).min(), _radius(mesh).max()
    faces = faces[visible(view, points, faces)]
    surface = PolyCollection(points[faces][..., :2], array=vectors[faces, 2].mean(axis=1),
                             cmap=style.DIVERGING, linewidths=0, rasterized=True, antialiased=False)
    surface.set_clim(-1.0, 1.0)
    ax.add_collection(surface)
    ax.add_patch(Circle((0, 0), inner, facecolor=style.RIM, edgecolor=style.OUTLINE, linewidth=0.6))
    closed = np.append(ring, ring[0])
    ax.plot(*points[closed, :2].T, color=style.OUTLINE, linewidth=0.9, label="_tread")
    ax.add_collection(LineCollection([mesh.coordinates[closed, :2]], **BEFORE, label="_undeformed"))
    ends = ring[np.linspace(0, len(ring), SPOKES, endpoint=False).astype(int)]
    begins = mesh.coordinates[ends, :2] * (inner / _radius(mesh)[ends])[:, None]
    ax.add_collection(LineCollection(list(np.stack([begins, points[ends, :2]], axis=1)),
                                     colors=style.OUTLINE, linewidths=0.5, label="_spokes"))
    reach = (1.0 + 1.1 * LARGEST) * outer
    if standing := modes.summary.get("standing"):
        height = float(standing["height"])
        ax.fill_between([-reach, reach], -reach, -height, color=style.GROUND, linewidth=0, zorder=3)
        ax.axhline(-height, color=style.OUTLINE, linewidth=0.6, zorder=3)
    ax.set(xlim=(-reach, reach), ylim=(-reach, reach))
    _bare(ax, "from the right")


def draw_section(ax: Axes, mesh: Mesh, vectors: Array, ring: Whole) -> None:
    """Where it moves most: z to the right, r upwards."""
    place = place_of_section(mesh, vectors, ring)
    angle, faces = float(angles(mesh.coordinates[ring[place]])), faces_at(mesh, ring, place)
    before = np.stack([mesh.coordinates[:, 2], _radius(mesh)], axis=1)
    moves = np.stack([vectors[:, 2], component(vectors, mesh.coordinates, "radial")], axis=1)
    after = before + LARGEST * _radius(mesh).max() * moves
    ax.add_collection(PolyCollection(after[faces], facecolors=[TINTS[3]], edgecolors="face",
                                     linewidths=0.1))
    lines = loops(outline(faces))
    ax.add_collection(LineCollection([after[line] for line in lines], colors=style.OUTLINE,
                                     linewidths=0.6, joinstyle="round"))
    ax.add_collection(LineCollection([before[line] for line in lines], **BEFORE, label="_undeformed"))
    used = before[np.unique(faces)]
    room = 1.05 * LARGEST * _radius(mesh).max()
    low, high = used.min(axis=0) - room, used.max(axis=0) + room
    ax.set(xlim=(low[0], high[0]), ylim=(used[:, 1].min() - 0.2 * room, high[1]))
    _bare(ax, minus(f"section at {round(np.degrees(angle)) + 0}°"))


def place_of_section(mesh: Mesh, vectors: Array, ring: Whole) -> int:
    """The place in the ring at whose angle the wheel moves most in the plane of its section; of several
    the one closest to straight down."""
    at, of_nodes = angles(mesh.coordinates[ring]), angles(mesh.coordinates)
    closed = np.concatenate([at[-1:] - 2 * np.pi, at, at[:1] + 2 * np.pi])
    nearest = np.searchsorted(0.5 * (closed[1:] + closed[:-1]), of_nodes) - 1
    in_plane = np.hypot(component(vectors, mesh.coordinates, "radial"), vectors[:, 2])
    most = np.zeros(len(ring))
    np.maximum.at(most, nearest % len(ring), in_plane)
    among = np.flatnonzero(most >= most.max() - 1e-3)
    return int(among[np.abs(at[among]).argmin()])


def faces_at(mesh: Mesh, ring: Whole, place: int) -> Whole:
    """(f, 4): the faces of hexahedra across the wheel at the angle of this place of the ring, each
    once. An inflated wheel has twisted a little, so that they are not quite in a plane."""
    at = angles(mesh.coordinates[ring])
    spacing = min(np.ptp(at[[place - 1, place]]), np.ptp(at[[place, (place + 1) % len(at)]]))
    apart = np.abs((angles(mesh.coordinates) - at[place] + np.pi) % (2 * np.pi) - np.pi)
    there = apart < 0.3 * spacing
    cells = np.asarray(mesh.cells, dtype=np.int64)
    faces = cells[there[cells].any(axis=1)][:, np.array(FACES)].reshape(-1, 4)
    faces = faces[there[faces].all(axis=1)]
    _, first = np.unique(np.sort(faces, axis=1), axis=0, return_index=True)
    once: Whole = faces[first]
    return once


def draw_curves(ax: Axes, mesh: Mesh, vectors: Array, ring: Whole) -> None:
    """The parts of the motion of the ring over the angle."""
    degrees = np.degrees(angles(mesh.coordinates[ring]))
    around = np.concatenate([degrees[-1:] - 360.0, degrees, degrees[:1] + 360.0])
    for (part, name), curve in zip(PARTS.items(), style.CURVES):
        values = component(vectors[ring], mesh.coordinates[ring], part)
        ax.plot(around, np.concatenate([values[-1:], values, values[:1]]), label=name, **curve)
    ax.axhline(0, color="0.6", lw=0.5, zorder=0)
    ax.set(xlim=(-180.0, 180.0), ylim=(-1.1, 1.1), xticks=(-180, -90, 0, 90, 180),
           xlabel="angle from straight down (°)", ylabel="tread over the\nlongest vector (–)")


def _bare(ax: Axes, name: str) -> None:
    """Equal scales, no axes, a name below."""
    ax.set(aspect="equal", xticks=[], yticks=[], xlabel=name, anchor="S")
    ax.xaxis.labelpad = 1.0
    ax.spines[:].set_visible(False)

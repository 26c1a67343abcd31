# SPDX-License-Identifier: BSD-3-Clause
"""A wheel in three dimensions drawn: its outer surface, deformed and coloured, over the ground."""
from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import Normalize
from numpy.typing import NDArray

from ... import style
from ...data.errors import Error
from ...data.ground import Ground
from ...data.solid import ground_axes, outer_faces, turned_about_axle
from ..field import NAMES
from .footprint import heading, touching
from .view import View, normals, shaded, visible

if TYPE_CHECKING:
    from ...data.run import Run

Array = NDArray[np.float64]
Window = tuple[float, float, float, float]
VECTORS = ("displacement", "deformation", "velocity")
COMPONENTS = ("x", "y", "z", "radial", "tangential", "axial")
PRESSURE = "pressure"  # of the contact
SHOWN_IN = {"m": (1e3, "mm"), "Pa": (1e-6, "MPa"), "1": (1.0, "–")}
GROUND_REACH = (1.35, 1.0)  # outer radii that the ground is drawn along t1, and t2 beside the wheel
LINES = 0.5  # outer radii between lines on the ground
BARE = (0.85, 0.85, 0.85, 1.0)  # of faces that nothing presses
MARK = 0.6  # darkness of the sector that is marked, so that the wheel is seen to turn
FINE = 4000  # faces: of more their sides are not drawn
BELOW = -28.0  # elevation (degrees) from which the contact is seen, through the ground
ABOVE = 18.0
HEIGHT = 4.2  # in


@dataclasses.dataclass(frozen=True)
class Values:
    """A quantity at the nodes (n,) in `unit`; signed if it may be negative."""

    values: Array
    label: str
    unit: str
    signed: bool


def values_of(run: Run, k: int, quantity: str) -> Values:
    """A quantity of snapshot k. "displacement", "deformation" or "velocity": their magnitude as the
    turning frame sees them; with _x, _y, _z a component along the axes of the wheel, which do not
    turn, with _radial, _tangential, _axial about its axle; "pressure" of the contact, 0 where
    nothing touches; or a field with one number at each node, as "von_mises"."""
    base, _, ending = quantity.partition("_")
    if quantity == PRESSURE:
        rows, values = touching(run, k), np.zeros(run.mesh.n_nodes)
        values[rows["node"].astype(np.int64)] = rows["pressure"]
        return Values(1e-6 * values, "contact pressure", "MPa", False)
    if base in VECTORS and (ending in COMPONENTS or not ending):
        name = "displacement" if base == "deformation" else base
        vectors = np.asarray(run.field(name)[k], dtype=float)
        angle = float((run.angle_velocity if base == "velocity" else run.angle)[k])
        values, units = component(vectors, run.mesh.coordinates, ending, angle), run.field(name).units
        label = f"{base}, {ending}" if ending else base
    else:
        source = run.field(quantity)
        values, units = np.asarray(source[k], dtype=float), source.units
        label, ending = NAMES.get(quantity, quantity.replace("_", " ")), ""
        if values.ndim != 1:
            raise Error(f"{quantity}: {values.shape[-1]} numbers at each node; allowed are "
                        "displacement and velocity, alone or with _x, _y, _z, _radial, _tangential, "
                        "_axial, pressure, and fields with one number at each node, as von_mises")
    factor, unit = SHOWN_IN.get(units, (1.0, units))
    return Values(factor * values, label, unit, bool(ending) or bool(values.min(initial=0.0) < 0))


def component(vectors: Array, coordinates: Array, name: str, angle: float = 0.0) -> Array:
    """(n,): a component of vectors (n, 3) of the turning frame; "": their length."""
    if not name:
        return np.linalg.norm(vectors, axis=1)
    if name in ("z", "axial"):
        return vectors[:, 2]
    if name in ("x", "y"):
        return turned_about_axle(vectors, angle)[:, "xy".index(name)]
    radius = np.maximum(np.linalg.norm(coordinates[:, :2], axis=1), 1e-300)
    x, y = (coordinates[:, :2] / radius[:, None]).T
    radial, tangential = vectors[:, 0] * x + vectors[:, 1] * y, vectors[:, 1] * x - vectors[:, 0] * y
    return radial if name == "radial" else tangential


class Picture:
    """The wheel in an axes; `show` shows another snapshot, for films. Places are from the center of
    the wheel, along the axes of the wheel."""

    def __init__(self, ax: Axes, run: Run, quantity: str, limits: tuple[float, float], signed: bool,
                 view: View, deformation: float = 1.0) -> None:
        self.ax, self.run, self.quantity, self.view = ax, run, quantity, view
        self.deformation = deformation
        self.faces = outer_faces(run.mesh.cells)
        self.marked = marked_faces(run, self.faces)
        self.touches = faces_of(run, quantity, self.faces)
        self.colours = ScalarMappable(Normalize(*limits),
                                      style.DIVERGING if signed else style.SEQUENTIAL)
        below = view.elevation < 0
        self.ground = PolyCollection([], facecolors=style.GROUND, linewidths=0, zorder=3 if below else 0,
                                     alpha=0.15 if below else 1.0)
        self.lines = LineCollection([], colors="0.5", linewidths=0.5, zorder=3.1 if below else 0.1)
        fine = len(self.faces) > FINE  # lines would hide the colours
        self.body = PolyCollection([], linewidths=0.2 if fine else 0.15,
                                   edgecolors="face" if fine else style.MESH, zorder=1)
        self.rim = PolyCollection([], facecolors=style.RIM, edgecolors=style.OUTLINE, linewidths=0.6,
                                  zorder=2)
        self.spoke = LineCollection([], colors=style.OUTLINE, linewidths=1.2, zorder=2.1)
        for artist in (self.ground, self.lines, self.body, self.rim, self.spoke):
            ax.add_collection(artist)
        left, right, low, high = frame_of(run, view)
        ax.set(xlim=(left, right), ylim=(low, high), aspect="equal")
        ax.set_axis_off()

    def show(self, k: int) -> None:
        run = self.run
        arms = run.mesh.coordinates + self.deformation * np.asarray(run.displacement[k])
        points = turned_about_axle(arms, float(run.angle[k]))
        order = visible(self.view, points, self.faces)
        faces = self.faces[order]
        values = values_of(run, k, self.quantity).values
        means = values[faces].mean(axis=1)
        colours = self.colours.to_rgba(means)
        if self.quantity == PRESSURE:
            colours[(means == 0.0) | ~self.touches[order]] = BARE
        colours = shaded(colours, normals(points, faces))
        colours[self.marked[order], :3] *= MARK
        self.body.set_verts(self.view.seen(points[faces])[..., :2])
        self.body.set_facecolor(colours)
        self.show_rim(float(run.angle[k]))
        self.show_ground(k)

    def show_rim(self, angle: float) -> None:
        """The disk that the rim fills on the side of the eye, with a line that turns."""
        circle, radius = rim_circle(self.run)
        if circle is None:
            return
        turned = turned_about_axle(circle, angle)
        self.rim.set_verts([self.view.seen(turned)[:, :2]])
        across = np.array([[0.0, -radius, circle[0, 2]], [0.0, 0.0, circle[0, 2]]])
        self.spoke.set_segments([self.view.seen(turned_about_axle(across, angle))[:, :2]])

    def show_ground(self, k: int) -> None:
        profile, half = ground_profile(self.run, k)
        if not len(profile):
            return
        self.ground.set_verts([self.view.seen(strip)[:, :2] for strip in ground_strips(self.run, k)])
        self.lines.set_segments(self.ground_lines(profile, half, float(self.run.center[k][0]),
                                                  float(self.run.lateral[k])))

    def ground_lines(self, profile: Array, half: float, along: float, lateral: float) -> list[Array]:
        """Lines that stand still on the ground, so that the wheel is seen to go along and aside."""
        step = LINES * self.run.outer_radius
        lines = []
        shear = edge_shear(self.run)
        for at in np.arange(np.ceil((along + profile[0, 0]) / step),
                            np.floor((along + profile[-1, 0]) / step) + 1) * step - along:
            height = float(np.interp(at, profile[:, 0], profile[:, 1]))
            sides = np.array([-half, half])
            lines.append(self.on_screen(np.stack([at + shear * (lateral + sides), [height] * 2], axis=1),
                                        sides))
        for at in np.arange(np.ceil((lateral - half) / step),
                            np.floor((lateral + half) / step) + 1) * step - lateral:
            lines.append(self.on_screen(profile + [shear * (lateral + at), 0.0],
                                        np.full(len(profile), at)))
        return lines

    def on_screen(self, plane: Array, lateral: Array) -> Array:
        """(m, 2) of points along t1 and n (m, 2) and t2 (m,), from the center."""
        return self.view.seen(in_wheel_axes(self.run, plane, lateral))[:, :2]


def in_wheel_axes(run: Run, plane: Array, lateral: Array) -> Array:
    """(m, 3) of components along t1 and n (m, 2) and t2 (m,)."""
    axes = ground_axes(run.camber)
    return plane @ axes[:2] + lateral[:, None] * axes[2]


def ground_profile(run: Run, k: int) -> tuple[Array, float]:
    """(m, 2) along t1 and n from the center, what is drawn of the ground, and half of its width
    [m]; none without ground."""
    ground = Ground.from_case(run.case)
    half = 0.5 * width_of(run) + GROUND_REACH[1] * run.outer_radius
    if ground is None:
        return np.empty((0, 2)), half
    along, height = (float(value) for value in run.center[k])
    reach = GROUND_REACH[0] * run.outer_radius + abs(edge_shear(run)) * half
    profile = ground.points((along - reach, along + reach))
    return clipped(profile, along - reach, along + reach) - [along, height], half


def edge_shear(run: Run) -> float:
    """How far edges of the ground go along t1 over a way along t2."""
    ground = Ground.from_case(run.case)
    return float(np.tan(ground.angle)) if ground else 0.0


def ground_strips(run: Run, k: int) -> Array:
    """(s, 4, 3): the ground in strips across, in the axes of the wheel, from its center [m]."""
    profile, half = ground_profile(run, k)
    sides = np.array([-half, half, half, -half])
    aside = np.stack([edge_shear(run) * (float(run.lateral[k]) + sides), np.zeros(4)], axis=1)
    strips = [in_wheel_axes(run, np.repeat(piece, 2, axis=0) + aside, sides)
              for piece in zip(profile[:-1], profile[1:])]
    return np.array(strips).reshape(-1, 4, 3)


def clipped(profile: Array, low: float, high: float) -> Array:
    """The profile between two places along it, whose ends are put there."""
    inside = profile[(profile[:, 0] > low) & (profile[:, 0] < high)]
    ends = [[at, float(np.interp(at, profile[:, 0], profile[:, 1]))] for at in (low, high)]
    return np.concatenate([ends[:1], inside, ends[1:]])


def width_of(run: Run) -> float:
    return float(np.ptp(run.mesh.coordinates[:, 2]))


def rim_circle(run: Run) -> tuple[Array | None, float]:
    """(m, 3) m: the circle that the rim fills, at the side of the eye, and its radius."""
    held = np.flatnonzero(run.held)
    if not len(held):
        return None, 0.0
    places = run.mesh.coordinates[held]
    radius = float(np.linalg.norm(places[:, :2], axis=1).max())
    angle = np.linspace(0.0, 2 * np.pi, 181)[:-1]
    circle = np.stack([radius * np.cos(angle), radius * np.sin(angle),
                       np.full(len(angle), places[:, 2].max())], axis=1)
    return circle, radius


def marked_faces(run: Run, faces: NDArray[np.int64]) -> NDArray[np.bool_]:
    """(f,) the faces of one sector, or of the first sixtieth of a turn where sectors are finer."""
    middle = run.mesh.coordinates[faces].mean(axis=1)
    angle = (np.arctan2(middle[:, 1], middle[:, 0]) + 0.5 * np.pi) % (2 * np.pi)
    sectors = 60 if run.mesh.sector is None else min(60, int(run.mesh.sector.max()) + 1)
    return np.asarray(angle < 2 * np.pi / sectors)


def frame_of(run: Run, view: View) -> Window:
    """Left, right, low and high end of the picture, about the center [m]."""
    radius, half = run.outer_radius, 0.5 * width_of(run)
    axes = view.axes
    wheel = 1.04 * radius * np.linalg.norm(axes[:2, :2], axis=1) + half * np.abs(axes[:2, 2])
    left, right, low, high = -wheel[0], wheel[0], -wheel[1], wheel[1]
    if "ground" in run.case:
        along, aside = GROUND_REACH[0] * radius, half + GROUND_REACH[1] * radius
        height = float(run.center[0][1]) if len(run.center) else radius
        corners = np.array([[x, -height, z] for x in (-along, along) for z in (-aside, aside)])
        seen = view.seen(corners)
        left, right = min(left, seen[:, 0].min()), max(right, seen[:, 0].max())
        low, high = min(low, seen[:, 1].min()), max(high, seen[:, 1].max())
    return float(left), float(right), float(low), float(high)


def faces_of(run: Run, quantity: str, faces: NDArray[np.int64]) -> NDArray[np.bool_]:
    """(f,) the faces that have the quantity: of the contact's pressure those that may touch."""
    if quantity != PRESSURE:
        return np.ones(len(faces), dtype=bool)
    candidate = np.zeros(run.mesh.n_nodes, dtype=bool)
    candidate[run.mesh.boundary] = True
    return np.asarray(candidate[faces].all(axis=1))


def limits_of(drawn: list[Values], faces: NDArray[np.int64]) -> tuple[float, float]:
    """Of the colours: as far as the means of faces go, from 0, or to both sides of 0."""
    top = max(float(np.abs(v.values[faces].mean(axis=1)).max()) for v in drawn) or 1.0
    return (-top if any(v.signed for v in drawn) else 0.0, top)


def default_view(quantity: str) -> View:
    return View(elevation=BELOW if quantity == PRESSURE else ABOVE)


def plot_surface(run: Run, time: float, quantity: str = "displacement", ax: Axes | None = None,
                 deformation: float = 1.0, limits: tuple[float, float] | None = None,
                 colorbar: bool = True, view: View | None = None) -> Axes:
    """The outer surface of the wheel at the snapshot nearest to `time`, deformed and coloured, with
    the ground; of the contact's pressure seen from below, through the ground. quantity: see
    values_of. deformation: factor on the displacement. limits: of the colours, in the unit of the
    colour bar; by default those of the faces. One sector is darker."""
    k = run.index(time)
    shown = values_of(run, k, quantity)
    with style.paper():
        if ax is None:
            ax = plt.figure(figsize=(style.PAGE * 0.75, HEIGHT)).add_subplot()
        faces = outer_faces(run.mesh.cells)
        limits = limits or limits_of([shown], faces[faces_of(run, quantity, faces)])
        picture = Picture(ax, run, quantity, limits, shown.signed, view or default_view(quantity),
                          deformation)
        picture.show(k)
        factor = "" if deformation == 1.0 else f", deformation × {deformation:g}"
        ax.set_title(heading(run, k) + factor)
        if colorbar:
            ax.figure.colorbar(picture.colours, ax=ax, label=f"{shown.label} ({shown.unit})",
                               shrink=0.7, pad=0.02)
    return ax

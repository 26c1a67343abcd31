# SPDX-License-Identifier: BSD-3-Clause
"""Modes of a POD of a wheel in three dimensions: its outer surface in the shape of each."""
from __future__ import annotations

from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ... import style
from ...data.errors import Error
from ...data.solid import outer_faces
from ..marks import letter
from ..modes import COLUMNS, LARGEST, course_shown, draw_course, percent, sign, tidy
from .surface import component
from .view import View, normals, shaded, visible

if TYPE_CHECKING:
    from ...data.pod import Pod

Array = NDArray[np.float64]
PARTS = ("radial", "tangential", "axial")
TALL, COURSE = 1.9, 0.7  # in, of the shapes and of their courses in time


def plot_modes(pod: Pod, count: int = 6) -> Figure:
    """The first modes, each with its course in time below: the outer surface moved by the mode, its
    largest vector 0.12 of the radius, and coloured by the part of it (radial, tangential or axial)
    that has the largest share in its norm, over the largest of all faces."""
    if pod.field == "contact":
        raise Error(f"{pod.directory}: modes of the contact of a wheel in three dimensions have three "
                    "numbers at each contact node and are not drawn: pod.spatial (modes, nodes, 3), "
                    "or modes.xdmf in ParaView")
    if count < 1:
        raise Error(f"count = {count}: at least 1 mode")
    count = min(count, pod.n_modes)
    if count < 1:
        raise Error(f"{pod.directory}: the POD has no modes: all its snapshots are zero")
    rows = -(-count // COLUMNS)
    with style.paper():
        figure = plt.figure(figsize=(style.PAGE, rows * (TALL + 1.5)))
        grid = figure.add_gridspec(2 * rows, COLUMNS, height_ratios=(TALL, COURSE) * rows)
        shown = course_shown(pod, count)
        space: list[Axes] = []
        course: list[Axes] = []
        colours = ScalarMappable(Normalize(-1.0, 1.0), style.DIVERGING)
        for mode in range(count):
            row, column = divmod(mode, COLUMNS)
            space.append(figure.add_subplot(grid[2 * row, column]))
            course.append(figure.add_subplot(grid[2 * row + 1, column]))
            part = draw_mode(space[mode], pod, mode, colours)
            draw_course(course[mode], pod, mode, shown)
            letter(space[mode], "abcdefghijklmnopqrstuvwxyz"[mode % 26],
                   f"mode {mode + 1}: {percent(pod.energy[mode])}, {part}")
        tidy(course)
        figure.colorbar(colours, ax=figure.axes, shrink=0.5, aspect=30, pad=0.01,
                        label="named part over its largest (–)")
    return figure


def draw_mode(ax: Axes, pod: Pod, mode: int, colours: ScalarMappable) -> str:
    """Returns the part that the colours are of."""
    view, faces, places = View(), outer_faces(pod.mesh.cells), pod.mesh.coordinates
    vectors = sign(pod, mode) * np.asarray(pod.spatial[mode])
    vectors = vectors / np.linalg.norm(vectors, axis=1).max()
    parts = {part: component(vectors, places, part) for part in PARTS}
    part = max(parts, key=lambda name: float(pod.weights @ parts[name] ** 2))
    radius = float(np.linalg.norm(places[:, :2], axis=1).max())
    points = places + LARGEST * radius * vectors
    means = parts[part][faces].mean(axis=1)
    means = means / (np.abs(means).max() or 1.0)
    order = visible(view, points, faces)
    colour = shaded(colours.to_rgba(means[order]), normals(points, faces[order]))
    seen = view.seen(points[faces[order]])[..., :2]
    ax.add_collection(PolyCollection(seen, facecolors=colour, edgecolors=style.MESH, linewidths=0.1,
                                     rasterized=True))
    low, high = seen.min(axis=(0, 1)), seen.max(axis=(0, 1))
    ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
    ax.set_axis_off()
    return part

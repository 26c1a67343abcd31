# SPDX-License-Identifier: BSD-3-Clause
"""Cells of a mesh and vectors at its nodes, as figures take them."""
from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.path import Path
from numpy.typing import NDArray

Array = NDArray[np.float64]


def turned(vectors: Array, angle: float | Array) -> Array:
    """(..., 2): the vectors turned by the angle (rad), counter-clockwise, or each by its own."""
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


class Cells(PolyCollection):
    """Cells with these corners (e, m, 2) [m], which move without being made anew."""

    def __init__(self, places: Array, **options: Any) -> None:
        super().__init__([], **options)
        self._corners = np.concatenate([places, places[:, :1]], axis=1)
        codes = np.array([Path.MOVETO, *[Path.LINETO] * (places.shape[1] - 1), Path.CLOSEPOLY],
                         dtype=Path.code_type)
        self.get_paths().extend(Path(cell, codes) for cell in self._corners)  # views of them

    def move(self, places: Array) -> None:
        self._corners[:, :-1], self._corners[:, -1] = places, places[:, 0]
        self.stale = True

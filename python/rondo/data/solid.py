# SPDX-License-Identifier: BSD-3-Clause
"""A wheel in three dimensions: its surface, and the axes of the ground that it leans over
(docs/wheel3d.md)."""
from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .mesh import Mesh

Array = NDArray[np.float64]
Whole = NDArray[np.int64]

# Of a hexahedron (a face, then the one opposite, corner by corner): its faces, each
# counter-clockwise as seen from outside.
FACES = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))


def ground_axes(camber: float) -> Array:
    """(3, 3): t1, n and t2 in the axes of the wheel, x along its heading, y up, z along the axle to
    the right. Camber > 0 (rad) leans the top of the wheel to -t2."""
    cos, sin = np.cos(camber), np.sin(camber)
    return np.array([[1.0, 0.0, 0.0], [0.0, cos, sin], [0.0, -sin, cos]])


def outer_faces(hexahedra: NDArray[np.integer[Any]]) -> Whole:
    """(f, 4): the faces of one hexahedron only, counter-clockwise as seen from outside."""
    faces = np.asarray(hexahedra, dtype=np.int64)[:, np.array(FACES)].reshape(-1, 4)
    _, where, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True,
                                return_counts=True)
    return faces[np.sort(where[count == 1])]


def contact_faces(mesh: Mesh) -> Whole:
    """(f, 4): the outer faces that may touch the ground: all four corners are candidates."""
    faces = outer_faces(mesh.cells)
    candidate = np.zeros(mesh.n_nodes, dtype=bool)
    candidate[mesh.boundary] = True
    return faces[candidate[faces].all(axis=1)]


def turned_about_axle(vectors: Array, angle: float) -> Array:
    """(n, 3): vectors of the turning frame in the axes of the wheel, which do not turn."""
    cos, sin = np.cos(angle), np.sin(angle)
    x, y, z = vectors[:, 0], vectors[:, 1], vectors[:, 2]
    return np.stack([cos * x - sin * y, sin * x + cos * y, z], axis=1)

# SPDX-License-Identifier: BSD-3-Clause
"""A wheel in three dimensions: its surface, and the axes of the ground that it leans over
(docs/wheel3d.md)."""
from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
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


@dataclass(frozen=True)
class RollingWheel:
    """What the axes of a history depend on beside its columns."""

    camber: float     # rad, > 0 leans the top to the left
    turn_slip: float  # 1/m, > 0 turns to the left
    radius: float     # m, outer radius, of the slip ratio
    backwards: bool   # it rolls backwards


def rolling_wheel(case: Mapping[str, Any], radius: float) -> RollingWheel:
    """Of the case of a wheel in three dimensions; radius: its outer radius [m]."""
    motion = case["motion"]
    backwards = any(is_below_zero(motion.get(key, 0.0)) for key in ("speed", "angular_velocity"))
    return RollingWheel(float(motion.get("camber", 0.0)), float(motion.get("turn_slip", 0.0)), radius, backwards)


def outer_radius_of(case: Mapping[str, Any], mesh: Mesh) -> float:
    """R_o of a disk [m]; of a mesh from a file its largest distance from the axle."""
    if "disk" in case:
        return float(case["disk"]["outer_radius"])
    return float(np.linalg.norm(mesh.coordinates[:, :2], axis=1).max())


def is_below_zero(value: Any) -> bool:
    """Of a number, or of a table over time at any time."""
    return any(row[1] < 0 for row in value) if isinstance(value, list) else float(value) < 0

# SPDX-License-Identifier: BSD-3-Clause
"""Looking at a wheel in three dimensions: where the eye is, and what it sees of a surface."""
from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
LIGHT = np.array([0.35, 0.85, 0.4])  # direction to it, in the axes of the wheel
AMBIENT = 0.8  # of the light that all faces get


@dataclasses.dataclass(frozen=True)
class View:
    """A parallel projection. The eye is to the right of the wheel (its side z > 0), turned by
    `azimuth` (degrees) towards the way it rolls and raised by `elevation` above its axle; < 0 looks
    from below, through the ground."""

    azimuth: float = 35.0
    elevation: float = 18.0

    @property
    def axes(self) -> Array:
        """(3, 3): rows are what is to the right, upwards, and towards the eye."""
        a, e = np.radians([self.azimuth, self.elevation])
        toward = np.array([np.cos(e) * np.sin(a), np.sin(e), np.cos(e) * np.cos(a)])
        right = np.cross([0.0, 1.0, 0.0], toward)
        right = right / np.linalg.norm(right)
        return np.array([right, np.cross(toward, right), toward])

    def seen(self, points: Array) -> Array:
        """(..., 3): to the right, upwards, towards the eye."""
        return points @ self.axes.T


def normals(points: Array, faces: NDArray[np.int64]) -> Array:
    """(f, 3): outward, of length 1."""
    a, b, c, d = (points[faces[:, k]] for k in range(4))
    cross = np.cross(c - a, d - b)
    return cross / np.maximum(np.linalg.norm(cross, axis=1), 1e-300)[:, None]


def visible(view: View, points: Array, faces: NDArray[np.int64]) -> NDArray[np.int64]:
    """The faces (places in `faces`) that look towards the eye, the farthest first."""
    toward = view.axes[2]
    looking = np.flatnonzero(normals(points, faces) @ toward > 0.0)
    depth = points[faces[looking]].mean(axis=1) @ toward
    return looking[np.argsort(depth, kind="stable")]


def shaded(colours: Array, normals_: Array) -> Array:
    """(f, 4): the colours under a light from above."""
    light = LIGHT / np.linalg.norm(LIGHT)
    share = AMBIENT + (1.0 - AMBIENT) * np.maximum(normals_ @ light, 0.0)
    out = colours.copy()
    out[:, :3] *= share[:, None]
    return out

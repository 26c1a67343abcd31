# SPDX-License-Identifier: BSD-3-Clause
"""Fields of a reduced run that has kept the coordinates of its modes (rondo run --snapshots modes):
lifted to the mesh as they are read (docs/reduced.md, 7)."""
from __future__ import annotations

import pathlib
from functools import cached_property
from typing import Any

import numpy as np

from .arrays import LazyArray
from .errors import Error
from .files import opened
from .mesh import Mesh

UNITS = {"displacement": "m", "velocity": "m/s"}


class Coordinates:
    """/reduced of results.h5: r modes of n nodes, and their coordinates in t snapshots."""

    def __init__(self, path: pathlib.Path, mesh: Mesh, length: int) -> None:
        self.path, self.mesh, self.length = path, mesh, length

    @cached_property
    def modes(self) -> np.ndarray:
        """(r, n) x + iy of each mode, in the frame of the model."""
        with opened(self.path) as file:
            modes: np.ndarray = file["reduced/modes"][:] @ np.array([1, 1j])
        return modes

    @cached_property
    def rectified(self) -> bool:
        """The modes stand still while the disk turns through them."""
        with opened(self.path) as file:
            return str(file["reduced/modes"].attrs["frame"]) == "rectified"

    def lift(self, name: str, snapshots: np.ndarray) -> np.ndarray:
        """(k, n, 2): displacement or velocity of these snapshots in the co-rotating frame."""
        with opened(self.path) as file:
            q = file[f"reduced/{name}"][:self.length][snapshots]
            angles = file["reduced/angle"][:self.length, list(UNITS).index(name)][snapshots]
        fields = q @ self.modes
        if self.rectified:
            fields = moved_back(fields, angles, self.mesh, self.path)
        return np.stack([fields.real, fields.imag], axis=-1)


def moved_back(fields: np.ndarray, angles: np.ndarray, mesh: Mesh,
               path: pathlib.Path) -> np.ndarray:
    """T(-θ): (k, n) x + iy of the rectified frame in the turning one. The radial and tangential
    parts of each ring of nodes are moved by their harmonics over the sectors, the highest of an
    even number stays (docs/theory.md, 7.3)."""
    if mesh.sector is None or mesh.sector_node is None:
        raise Error(f"{path}: damaged: modes of the rectified frame on a mesh without sectors")
    order, n = np.lexsort((mesh.sector, mesh.sector_node)), int(mesh.sector.max()) + 1
    polar = np.exp(2j * np.pi * np.arange(n) / n)
    k = np.fft.fftfreq(n, 1 / n)
    # The angle itself may be of many turns: times a harmonic it would lose digits.
    phase = np.exp(1j * k * np.arctan2(np.sin(angles), np.cos(angles))[:, None])
    phase[:, 2 * abs(k) == n] = 1
    rings = np.fft.fft(fields[:, order].reshape(len(fields), -1, n) / polar) * phase[:, None]
    moved = np.empty_like(fields)
    moved[:, order] = (np.fft.ifft(rings) * polar).reshape(len(fields), -1)
    return moved


class LiftedArray(LazyArray):
    """Displacement or velocity (t, n, 2), indexed like a numpy array: each indexing lifts the
    snapshots that are asked for."""

    def __init__(self, coordinates: Coordinates, name: str) -> None:
        super().__init__(coordinates.path, f"reduced/{name}", coordinates.length)
        self.coordinates, self.name = coordinates, name
        self.shape = (self.shape[0], coordinates.mesh.n_nodes, 2)
        self.units = UNITS[name]
        self.description = f"{name} of each node, co-rotating frame, lifted from {self.dataset}"

    def __getitem__(self, key: Any) -> Any:
        """As numpy's indexing: integers, slices, lists of integers, masks; no new axes."""
        parts = self._parts(key)
        snapshots = np.arange(self.shape[0])[parts[0]]
        first: Any = slice(None)
        if isinstance(parts[0], int):
            first = 0
        elif isinstance(parts[0], np.ndarray):
            first = np.arange(len(snapshots))
        return self.coordinates.lift(self.name, np.atleast_1d(snapshots))[(first, *parts[1:])]

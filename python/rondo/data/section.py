# SPDX-License-Identifier: BSD-3-Clause
"""The section of an inflated wheel, whose columns all deform alike, before and after."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .arrays import LazyArray
from .cords import CordLayer
from .mesh import Mesh

Array = NDArray[np.float64]
Whole = NDArray[np.int64]
NEAR = 0.05  # of an edge: how far points of cords may be from where they are on it


@dataclass(frozen=True)
class Section:
    """The section of a wheel, m nodes and e quadrilaterals.

    nodes: (m,) their numbers in the mesh; cells: (e, 4) corners, as places among these nodes,
    counter-clockwise with z to the right and r upwards; region: (e,) place in region_names, None: the
    case has none; coordinates: (m, 2) r and z, undeformed [m]; position: (t, m, 2) r and z at each
    snapshot [m]. r is the distance from the axle, also of what has turned about it."""

    nodes: Whole
    cells: Whole
    region: NDArray[np.integer[Any]] | None
    region_names: tuple[str, ...]
    coordinates: Array
    position: Array
    sectors: int

    def nodes_along(self, layer: CordLayer, k: int) -> list[Whole] | None:
        """Nodes along each line of a layer of cords, places among those of the section, by where its
        points are at snapshot k; None: they are those of another state, on no sides of the cells."""
        return _chains(_sides_with(self, layer, k))


def section_of(mesh: Mesh, displacement: LazyArray) -> Section:
    """Of a wheel of one column of cells a sector: the faces at which the first column begins."""
    assert mesh.sector is not None
    first = (mesh.sector[mesh.cells[:, :4]] == 0).all(axis=1)
    nodes, corners = np.unique(mesh.cells[first, :4], return_inverse=True)
    before = mesh.coordinates[nodes]
    return Section(nodes, corners.reshape(-1, 4), None if mesh.region is None else mesh.region[first],
                   mesh.region_names, _in_section(before),
                   _in_section(before + np.asarray(displacement[:, nodes], dtype=float)),
                   int(mesh.sector.max()) + 1)


def _in_section(places: Array) -> Array:
    """(..., 2) distance from the axle, and z."""
    return np.stack([np.linalg.norm(places[..., :2], axis=-1), places[..., 2]], axis=-1)


def _sides_with(section: Section, layer: CordLayer, k: int) -> Whole | None:
    """(edges, 2) the side of a cell, in the sense of the curve, on which each two points are."""
    cells, places = section.cells, section.position[k]
    sides = np.stack([cells, np.roll(cells, -1, axis=1)], axis=-1).reshape(-1, 2)
    sides = np.unique(np.concatenate([sides, sides[:, ::-1]]), axis=0)
    # Gauss points, along the side as around the sector, whose faces are straight.
    along, slope = 1.0 / np.sqrt(3.0), np.tan(np.pi / section.sectors)
    sagging = np.cos(np.pi / section.sectors) * np.hypot(1.0, along * slope)
    ends = places[sides]
    middle, half = ends.mean(axis=1), 0.5 * (ends[:, 1] - ends[:, 0])
    wanted = np.stack([middle - along * half, middle + along * half], axis=1)
    points = np.stack([layer.r / sagging, layer.z], axis=1).reshape(-1, 2, 2)
    apart = np.linalg.norm(points[:, None] - wanted[None], axis=-1).max(axis=-1)
    chosen = apart.argmin(axis=1)
    length = 2.0 * np.linalg.norm(half[chosen], axis=1)
    found: Whole = sides[chosen]
    return found if (apart[np.arange(len(points)), chosen] < NEAR * length).all() else None


def _chains(sides: Whole | None) -> list[Whole] | None:
    """The nodes of sides that follow one another, line by line."""
    if sides is None or not len(sides):
        return None
    begins = np.flatnonzero(sides[1:, 0] != sides[:-1, 1]) + 1
    return [np.append(line[:, 0], line[-1, 1]) for line in np.split(sides, begins)]

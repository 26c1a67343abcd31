# SPDX-License-Identifier: BSD-3-Clause
"""The mesh of a run or of a POD."""
from __future__ import annotations

from dataclasses import dataclass

import h5py
import numpy as np


@dataclass(frozen=True)
class Mesh:
    """n nodes, e cells, nb contact nodes (nodes that may touch something); all numbered from 0."""

    coordinates: np.ndarray  # (n, 2) reference position X [m], co-rotating frame; of free bodies
    #                          fixed; (n, 3) of a wheel in three dimensions, z along the axle
    cells: np.ndarray        # (e, 4) or (e, 3) corner nodes, counter-clockwise; -1: none; (e, 8) of
    #                          a wheel in three dimensions, a face and the one opposite
    boundary: np.ndarray     # (nb,) candidates, in order along the boundary
    tributary: np.ndarray    # (nb,) length of boundary that each candidate stands for [m]; area [m2]
    mass: np.ndarray         # (n,) lumped mass [kg/m]; [kg]
    sector: np.ndarray | None       # (n,) counter-clockwise from straight down; None: not cyclic
    sector_node: np.ndarray | None  # (n,) number within the sector, the same in all; or None
    free_body: np.ndarray | None = None  # (n,) free body that a node belongs to, which moves in the
    #                                      fixed frame; -1: co-rotating frame; None: all of them
    region: np.ndarray | None = None     # (e,) place of a cell's physical surface in region_names
    region_names: tuple[str, ...] = ()   # of the mesh file

    @property
    def free(self) -> np.ndarray:
        """(n,) True where a node moves in the fixed frame."""
        if self.free_body is None:
            return np.zeros(self.n_nodes, dtype=bool)
        free: np.ndarray = self.free_body >= 0
        return free

    @property
    def is_solid(self) -> bool:
        """Whether it is of a wheel in three dimensions."""
        return self.coordinates.shape[1] == 3

    @property
    def n_nodes(self) -> int:
        return len(self.coordinates)

    @property
    def n_cells(self) -> int:
        return len(self.cells)


def read_mesh(file: h5py.File) -> Mesh:
    """/mesh of results.h5 or pod.h5."""
    mesh = file["mesh"]
    cyclic = "sector" in mesh
    cells = mesh["hexahedra" if "hexahedra" in mesh else "cells"][:]
    regions = mesh["region"].attrs if "region" in mesh else {}
    return Mesh(coordinates=mesh["coordinates"][:], cells=cells,
                boundary=mesh["boundary"][:], tributary=mesh["tributary"][:], mass=mesh["mass"][:],
                sector=mesh["sector"][:] if cyclic else None,
                sector_node=mesh["sector_node"][:] if cyclic else None,
                free_body=mesh["free_body"][:] if "free_body" in mesh else None,
                region=mesh["region"][:] if "region" in mesh else None,
                region_names=tuple(str(regions[f"name_{k}"]) for k in range(len(regions))
                                   if f"name_{k}" in regions))

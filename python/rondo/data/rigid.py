# SPDX-License-Identifier: BSD-3-Clause
"""The motion of free bodies parted into that of a rigid body and the deformation."""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .mesh import Mesh

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Rigid:
    """What each of n nodes would do if its body were rigid, and what is left.

    places: (n, 2) m, fixed frame; deformation: (n, 2) m, along the axes that turn with the body;
    angle: (n,) rad by which these have turned; center: (n, 2) m, the center of mass of the body in
    its reference position. Nodes of the co-rotating frame have their displacement as deformation,
    and nan as places."""

    places: Array
    deformation: Array
    angle: Array
    center: Array


def rigid_motion(mesh: Mesh, displacement: Array) -> Rigid:
    """Of each free body the motion nearest to its displacement (n, 2): least squares by mass, so
    the deformation moves neither its center of mass nor turns it about that."""
    reference = mesh.coordinates
    places = np.full_like(displacement, np.nan)
    deformation = displacement.copy()
    angle, center = np.zeros(mesh.n_nodes), np.zeros_like(displacement)
    bodies = mesh.free_body if mesh.free_body is not None else np.empty(0, dtype=int)
    for body in np.unique(bodies[bodies >= 0]):
        nodes = np.flatnonzero(bodies == body)
        mass = mesh.mass[nodes, None] / mesh.mass[nodes].sum()
        before, after = reference[nodes], reference[nodes] + displacement[nodes]
        middle, moved = (mass * before).sum(axis=0), (mass * after).sum(axis=0)
        arms, now = before - middle, after - moved
        turn = np.arctan2(np.sum(mass[:, 0] * (arms[:, 0] * now[:, 1] - arms[:, 1] * now[:, 0])),
                          np.sum(mass * arms * now))
        axes = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
        places[nodes] = moved + arms @ axes
        deformation[nodes] = now @ axes.T - arms
        angle[nodes], center[nodes] = turn, middle
    return Rigid(places, deformation, angle, center)

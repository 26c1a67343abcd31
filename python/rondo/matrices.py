# SPDX-License-Identifier: BSD-3-Clause
"""The operators of a motion as sparse matrices of scipy: Simulation.matrices()."""
from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from .data.errors import InputError
from .data.tables import installed

if TYPE_CHECKING:
    from ._core import Steps


@dataclass(frozen=True)
class ContactRows:
    """Rows of all b contact nodes, whether they touch the ground or not, each with the facet that is
    nearest to it. H takes displacements and velocities of the free nodes to normal and tangential
    ones, H.T takes contact forces to the nodes. c components: 2, of a wheel in three dimensions 3."""

    rows: Any                      # H (c b, unknowns) csr_matrix: of a node n, J n and t2, in turn
    normal: np.ndarray             # (b, c) out of the ground, fixed frame
    normal_corotating: np.ndarray  # (b, c) co-rotating frame
    gap: np.ndarray                # (b,) signed distance, > 0 outside [m]


@dataclass(frozen=True)
class Matrices:
    """M u'' + (C + s G) u' + (K - s² Z + ½ s' G) u = s² Z X - ½ s' G X + f + H.T λ for the f nodes that
    are not clamped, in the frame that turns with the rim at s = -motion.angular_velocity. Unknown
    c k + i is component i of nodes[k]. Units are those of the case, per metre of width in the plane."""

    mass: Any         # M csr_matrix, diagonal [kg/m]
    damping: Any      # C = alpha M + beta K [N s/m2]
    stiffness: Any    # K, symmetric [N/m2]
    gyroscopic: Any   # G = 2 M J, skew [kg/m]
    centrifugal: Any  # Z: M without the axial components [kg/m]
    nodes: np.ndarray          # (f,) numbers of the mesh
    clamped: np.ndarray        # nodes where u = 0
    reference: np.ndarray      # (f, c) X [m]
    contact_nodes: np.ndarray  # (b,) that may touch the ground; none without a ground
    _rows: Callable[..., ContactRows] = field(repr=False)

    def unknowns_of(self, nodes: Any) -> np.ndarray:
        """(k c,) unknowns of nodes of the mesh, node by node."""
        wanted = np.atleast_1d(np.asarray(nodes))
        place = np.searchsorted(self.nodes, wanted)
        found = self.nodes[np.minimum(place, len(self.nodes) - 1)] == wanted
        if not found.all():
            raise InputError(f"unknowns_of: node {wanted[~found][0]} is no free node of the mesh "
                             "(allowed: nodes, which has those that are not clamped)")
        c = self.reference.shape[1]
        unknowns: np.ndarray = (c * place[:, None] + np.arange(c)).ravel()
        return unknowns

    def contact_rows(self, time: float | None = None, displacement: Any = None, *,
                     angle: float | None = None,
                     center: Sequence[float] | None = None) -> ContactRows:
        """Rows, normals and gaps of the contact nodes. Of the simulation as it is now; with a time [s],
        of the undeformed body where the tables of its motion take it. angle [rad], center [m] and
        displacement, (unknowns,) or (nodes of the mesh, c) [m], are taken instead where they are given."""
        return self._rows(time, displacement, angle, center)


def matrices_of(steps: Steps,
                now: Callable[[], tuple[float, np.ndarray, np.ndarray]]) -> Matrices:
    """now: angle, center and displacement of the simulation as it is.
    @raise Error: no scipy; InputError: a body without a constant stiffness."""
    installed("scipy", "Simulation.matrices()")
    from scipy.sparse import csr_matrix

    found = steps.operators()
    sparse = {name: csr_matrix(tuple(value[:3]), shape=value[3])
              for name, value in found.items() if isinstance(value, tuple)}
    nodes, c = found["nodes"], found["reference"].shape[1]
    shape = now()[2].shape

    def of_all_nodes(displacement: Any) -> np.ndarray:
        u = np.asarray(displacement, float)
        if u.shape == (c * len(nodes),):
            everywhere = np.zeros(shape)
            everywhere[nodes] = u.reshape(-1, c)
            u = everywhere
        if u.shape != shape or not np.isfinite(u).all():
            raise InputError(f"contact_rows: displacement has the shape {u.shape}, or numbers that are not "
                             f"finite (allowed: finite numbers, ({c * len(nodes)},) or {shape})")
        return u

    def frame_of(time: float | None, angle: float | None,
                 center: Sequence[float] | None) -> tuple[float, list[float]]:
        if angle is None or center is None:
            there = now()[:2] if time is None else steps.frame_at(time)
            angle = there[0] if angle is None else angle
            center = list(there[1]) if center is None else center
        numbers = [float(x) for x in center]
        if len(numbers) != c or not all(map(math.isfinite, [float(angle), *numbers])):
            raise InputError(f"contact_rows: angle = {angle}, center = {numbers}: are no angle and center "
                             f"(allowed: finite numbers, {c} of the center)")
        return float(angle), numbers

    def rows(time: float | None, displacement: Any, angle: float | None,
             center: Sequence[float] | None) -> ContactRows:
        if displacement is None and time is None and angle is None and center is None:
            displacement = now()[2]
        u = [] if displacement is None else of_all_nodes(displacement).ravel().tolist()
        at_angle, at_center = frame_of(time, angle, center)
        there = steps.contact_rows(at_angle, at_center, u)
        data, indices, indptr, size = there.pop("rows")
        return ContactRows(csr_matrix((data, indices, indptr), shape=size), **there)

    arrays = {name: value for name, value in found.items() if name not in sparse}
    return Matrices(**sparse, **arrays, _rows=rows)

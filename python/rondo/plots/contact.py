# SPDX-License-Identifier: BSD-3-Clause
"""Contact of steady rolling as the ground sees it: means over the snapshots, by place."""
from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..errors import Error

if TYPE_CHECKING:
    from ..run import Run

Array = NDArray[np.float64]


@dataclasses.dataclass(frozen=True)
class TractionProfile:
    """Mean traction of the ground on the body in bins along x, from the centre of the disk (m).

    x: (b,) m, middles of the bins; width: m; pressure: (b,) Pa; shear_x: (b,) Pa, > 0 pushes the
    body towards +x (contact.csv and results.h5 count shear towards -x, to the left of the normal).
    """

    x: Array
    width: float
    pressure: Array
    shear_x: Array

    def force(self) -> Array:
        """(2,) N/m: the integrals of shear and pressure: mean horizontal and vertical force."""
        return np.array([self.shear_x.sum(), self.pressure.sum()]) * self.width


def traction_profile(run: Run, bins_per_node: int = 2) -> TractionProfile:
    """The mean over all snapshots of a run that rolls steadily on level ground.

    In one snapshot the few nodes in contact stand at certain places; in the next ones they have
    moved on, so that together they sample every place. The forces of all nodes of all snapshots
    are summed by the place of the node, in bins of half the spacing of the nodes along the edge
    (1/`bins_per_node`), and divided by the number of snapshots and the width of a bin. So the
    profile has exactly the mean force of the snapshots as its integral.
    """
    if run.contact is None:
        raise Error(f"{run.directory}: no contact in this run; it needs [ground] and snapshots")
    width = float(np.median(run.contact.tributary)) / bins_per_node
    reach = np.ceil(run.outer_radius / width) * width
    edges = np.arange(-reach, reach + 1.5 * width, width) - 0.5 * width
    sums = np.zeros((len(edges) - 1, 2))
    for k in range(run.n_snapshots):
        force = np.asarray(run.contact.force[k])
        touching = np.flatnonzero(force[:, 0] > 0)
        x = run.position(k)[run.contact.nodes[touching], 0] - run.center[k][0]
        for which in range(2):
            sums[:, which] += np.histogram(x, edges, weights=force[touching, which])[0]
    mean = sums / (run.n_snapshots * width)
    return TractionProfile(0.5 * (edges[:-1] + edges[1:]), width, mean[:, 0], -mean[:, 1])


def mean_force(run: Run) -> Array:
    """(2,) N/m: horizontal and vertical force on the body on level ground, mean of the snapshots."""
    force = np.asarray(run.contact.force[:]).sum(axis=1).mean(axis=0)
    return np.array([-force[1], force[0]])

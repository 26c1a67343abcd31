# SPDX-License-Identifier: BSD-3-Clause
"""Contact as figures show it: arrows at the body, and means over the snapshots by place."""
from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from .. import style
from ..data.errors import Error
from ..data.ground import Ground

if TYPE_CHECKING:
    from ..data.run import Contact, Run

Array = NDArray[np.float64]


def contact_of(run: Run) -> Contact:
    """The contact of a run that must have it."""
    ground_of(run)
    run.need_snapshots()
    assert run.contact is not None  # with ground and snapshots
    return run.contact


def ground_of(run: Run) -> Ground:
    """The ground of a run that must have it."""
    ground = Ground.from_case(run.case)
    if ground is None:
        raise Error(f"{run.directory}: no ground: the case has no [ground]")
    return ground


@dataclasses.dataclass(frozen=True)
class TractionProfile:
    """Mean traction of the ground on the body in windows along x, from the center of the disk (m).

    x: (b,) m, middles of the windows, half a window apart, so that each overlaps the next; window:
    m, their width; pressure: (b,) Pa; shear_x: (b,) Pa, > 0 pushes the body towards +x (contact.csv
    and results.h5 count shear towards -x, to the left of the normal).
    """

    x: Array
    window: float
    pressure: Array
    shear_x: Array

    def force(self) -> Array:
        """(2,) N/m: the integrals of shear and pressure: mean horizontal and vertical force."""
        return np.array([self.shear_x.sum(), self.pressure.sum()]) * 0.5 * self.window


def traction_profile(run: Run) -> TractionProfile:
    """The mean over all snapshots of a run that rolls steadily on level ground.

    In one snapshot the few nodes in contact stand at certain places; in the next ones they have
    moved on, so that together they sample every place. The forces of all nodes of all snapshots
    are summed by the place of the node, in windows as wide as the spacing of the nodes along the
    edge, one at each half of it, and divided by the number of snapshots and the width. So the
    profile has exactly the mean force of the snapshots as its integral. Narrower windows hold now
    more nodes, now fewer, which the snapshots of a finite run do not even out.
    """
    contact = contact_of(run)
    half = 0.5 * float(np.median(contact.tributary))
    reach = np.ceil(run.outer_radius / half) * half
    edges = np.arange(-reach, reach + 1.5 * half, half) - 0.5 * half
    sums = np.zeros((len(edges) - 1, 2))
    for k in range(run.n_snapshots):
        force = np.asarray(contact.force[k])
        touching = np.flatnonzero(force[:, 0] > 0)
        x = run.position(k)[contact.nodes[touching], 0] - run.center[k][0]
        for which in range(2):
            sums[:, which] += np.histogram(x, edges, weights=force[touching, which])[0]
    mean = (sums[:-1] + sums[1:]) / (run.n_snapshots * 2 * half)
    return TractionProfile(edges[1:-1], 2 * half, mean[:, 0], -mean[:, 1])


def mean_force(run: Run) -> Array:
    """(2,) N/m: horizontal and vertical force on a body on level ground, mean of the snapshots."""
    force = np.asarray(contact_of(run).force[:]).sum(axis=1).mean(axis=0)
    return np.array([-force[1], force[0]])


def draw_tractions(ax: Axes, run: Run, index: int, length: float) -> None:
    """Arrows of the ground's traction on the body that end at the nodes in contact, in the fixed
    frame, `length` m for each Pa; none where nothing touches."""
    traction = np.asarray(contact_of(run).traction[index])
    touching = traction[:, 0] > 0
    if not touching.any():
        return
    nodes = run.mesh.boundary[touching]
    force = np.asarray(run.field("contact_force")[index])[nodes, :2]  # along the fixed axes
    size = np.linalg.norm(force, axis=1)
    arrows = force * (np.linalg.norm(traction[touching], axis=1) / size * length)[:, None]
    tips = run.position(index)[nodes]
    ax.quiver(*tips.T, *arrows.T, pivot="tip", angles="xy", scale_units="xy", scale=1.0,
              color=style.BLUE, width=0.006, headwidth=4, headlength=4.5, headaxislength=4,
              zorder=5)

# SPDX-License-Identifier: BSD-3-Clause
"""Small pieces that several figures share."""
from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from .. import style

if TYPE_CHECKING:
    from ..run import Run

Array = NDArray[np.float64]


def letter(ax: Axes, name: str, title: str = "") -> None:
    """The panel's letter and title, above its left edge."""
    ax.set_title(f"({name}) {title}".rstrip(), loc="left")


def edge_nodes(run: Run) -> NDArray[np.int64]:
    """The nodes on the outer edge of a disk: those farthest from the centre."""
    radius = np.linalg.norm(run.mesh.coordinates, axis=1)
    return np.flatnonzero(radius > radius.max() * (1 - 1e-9))


def edge_displacement(run: Run) -> Array:
    """(t,) m: radial displacement of the outer edge, mean over its nodes, at each snapshot."""
    nodes = edge_nodes(run)
    outward = run.mesh.coordinates[nodes]
    outward = outward / np.linalg.norm(outward, axis=1)[:, None]
    means = [np.mean(np.sum(np.asarray(run.displacement[k])[nodes] * outward, axis=1))
             for k in range(run.n_snapshots)]
    return np.array(means)


def energy(run: Run) -> Array:
    """(rows of the history,) J/m: kinetic and strain energy together."""
    return run.history["kinetic"] + run.history["strain"]


WORKS = ("work_frame", "work_contact", "dissipation_mass", "dissipation_stiffness", "work_scheme")


def relative_residual(run: Run) -> Array:
    """(rows,): what the ledger leaves open, over the energy exchanged so far (theory, 5.6). The
    history has not each step, so the energy exchanged is that of its rows."""
    exchanged = np.abs(energy(run)) + sum(np.abs(run.history[name]) for name in WORKS)
    so_far = np.maximum.accumulate(exchanged)
    return np.abs(run.history["energy_residual"]) / np.where(so_far > 0, so_far, 1.0)


def draw_tractions(ax: Axes, run: Run, index: int, length: float) -> bool:
    """Arrows of the ground's traction on the body that end at the nodes in contact, in the fixed
    frame, `length` m for each Pa; False where nothing touches."""
    traction = np.asarray(run.contact.traction[index])
    touching = traction[:, 0] > 0
    if not touching.any():
        return False
    nodes = run.mesh.boundary[touching]
    force = np.asarray(run.field("contact_force")[index])[nodes, :2]  # along the fixed axes
    size = np.linalg.norm(force, axis=1)
    arrows = force * (np.linalg.norm(traction[touching], axis=1) / size * length)[:, None]
    tips = run.position(index)[nodes]
    ax.quiver(*tips.T, *arrows.T, pivot="tip", angles="xy", scale_units="xy", scale=1.0,
              color=style.BLUE, width=0.006, headwidth=4, headlength=4.5, headaxislength=4, zorder=5)
    return True

# SPDX-License-Identifier: BSD-3-Clause
"""Small pieces that several figures share."""
from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

if TYPE_CHECKING:
    from ..data.run import Run

Array = NDArray[np.float64]


def letter(ax: Axes, name: str, title: str = "") -> None:
    """The panel's letter and title, above its left edge."""
    ax.set_title(f"({name}) {title}".rstrip(), loc="left")


def minus(text: str) -> str:
    """The text with minus signs as the axes have them."""
    return text.replace("-", "\N{MINUS SIGN}")


def edge_nodes(run: Run) -> NDArray[np.int64]:
    """The nodes on the outer edge of a disk: those farthest from the center."""
    radius = np.linalg.norm(run.mesh.coordinates, axis=1)
    return np.flatnonzero(radius > radius.max() * (1 - 1e-9))


def edge_displacement(run: Run) -> Array:
    """(t,) m: radial displacement of the outer edge, mean over its nodes, at each snapshot."""
    nodes = edge_nodes(run)
    outward = run.mesh.coordinates[nodes]
    outward = outward / np.linalg.norm(outward, axis=1)[:, None]
    blocks = range(0, run.n_snapshots, 64)  # some megabytes at once
    means = [np.sum(run.displacement[k:k + 64, nodes] * outward, axis=2).mean(axis=1)
             for k in blocks]
    return np.concatenate(means)


def energy(run: Run) -> Array:
    """(rows of the history,) J/m: kinetic and strain energy together, with those of a [rim]."""
    of_rim = [run.history[name] for name in ("kinetic_rim", "support_energy")
              if name in run.history]
    return run.history["kinetic"] + run.history["strain"] + sum(of_rim)


# Runs of earlier versions have no work_load, runs without [rim] none of those after work_scheme.
WORKS = ("work_frame", "work_contact", "work_load", "dissipation_mass", "dissipation_stiffness",
         "work_scheme", "work_gravity", "work_rim_load", "work_torque", "work_held",
         "dissipation_brake", "dissipation_support")


def relative_residual(run: Run) -> Array:
    """(rows,): what the ledger leaves open, over the energy exchanged so far (theory, 5.6). The
    history has not each step, so the energy exchanged is that of its rows."""
    exchanged = np.abs(energy(run)) + sum(np.abs(run.history[name]) for name in WORKS
                                        if name in run.history)
    so_far = np.maximum.accumulate(exchanged)
    return np.abs(run.history["energy_residual"]) / np.where(so_far > 0, so_far, 1.0)

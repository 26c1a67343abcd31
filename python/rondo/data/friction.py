# SPDX-License-Identifier: BSD-3-Clause
"""What friction takes: by contact node, by place in the footprint, by turn (docs/wear.md)."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .arrays import LazyArray
from .errors import Error
from .files import opened

Array = NDArray[np.float64]


@dataclass(frozen=True)
class FrictionWork:
    """Energy that friction has taken from the start of a run to each of its t snapshots, at nb contact
    nodes and at the places of the footprint.

    nodes: (t, nb) over the undeformed length or area of the node [J/m2]; places: (t, nx) of a plane
    body, (t, nx, nz) of a wheel in three dimensions, over that of the place [J/m2], None of free
    bodies; along: (nx,) middles of the places ahead of the center [m], empty of free bodies; across:
    (nz,) those to its right [m], None of a plane body."""

    nodes: LazyArray
    places: LazyArray | None
    along: Array
    across: Array | None


@dataclass(frozen=True)
class Wear:
    """Energy that friction takes at m nodes of the tread, per area.

    node: (m,); angle: (m,) rad, of the undeformed node, > 0 counter-clockwise from straight down;
    across: (m,) m, along the axle, 0 of a plane body; work: (m,) J/m2 from the first to the last
    snapshot looked at, of steady rolling in a turn; turns: that the wheel makes meanwhile; tributary:
    (m,) m, m2: what each node stands for, undeformed."""

    node: NDArray[np.int64]
    angle: Array
    across: Array
    work: Array
    turns: float
    tributary: Array

    @property
    def per_turn(self) -> Array:
        """(m,) J/m2 in a turn; NaN where the wheel does not turn."""
        return self.work / self.turns if self.turns > 0 else np.full(len(self.work), np.nan)

    @property
    def total(self) -> float:
        """Of all nodes together [J/m], [J]."""
        return float((self.work * self.tributary).sum())


def need_power(run: Any) -> dict[str, Array]:
    """The rows of contact.csv; an error where they have no friction_power."""
    run.need_snapshots()
    if run.contact is None:
        raise Error(f"{run.directory}: nothing can be touched, and so there is no friction: the case has no "
                    "[ground]")
    rows = run.contact.rows
    if "friction_power" not in rows:
        raise Error(f"{run.contact.path}: no column friction_power: a crush, a reduced run or one with the "
                    "scheme \"hati\" has none, and runs of earlier versions; run the full case again")
    return rows


def wear_of(run: Any, from_time: float | None = None, to_time: float | None = None) -> Wear:
    """Of steady rolling in a turn, from its powers; of steps in time between the snapshots nearest to
    the two times, by default the first and the last, which needs output.friction_work."""
    if not run.is_steady:
        return _between(run, from_time, to_time)
    if from_time is not None or to_time is not None:
        raise Error(f"{run.directory}: steady rolling has the wear of a turn: leave the times out")
    return _of_a_turn(run)


def _of_a_turn(run: Any) -> Wear:
    """Every node of a turn does what the nodes of a sector do: at each place it stays for the time
    between two places."""
    rows = need_power(run)
    assert run.contact is not None
    mesh = run.mesh
    assert mesh.sector is not None and mesh.sector_node is not None
    sectors = int(mesh.sector.max()) + 1
    stay = 2 * np.pi / abs(run.spin) / (sectors * run.n_snapshots)
    extent = rows["area_m2" if run.is_solid else "length_m"]
    energy = np.bincount(mesh.sector_node[rows["node"].astype(np.int64)],
                         weights=rows["friction_power"] * extent * stay,
                         minlength=int(mesh.sector_node.max()) + 1)
    work = energy[mesh.sector_node[mesh.boundary]] / run.contact.tributary
    return _at_nodes(run, work, 1.0)


def _between(run: Any, from_time: float | None, to_time: float | None) -> Wear:
    found = run.friction_work
    first = 0 if from_time is None else run.index(from_time)
    last = run.n_snapshots - 1 if to_time is None else run.index(to_time)
    if last <= first:
        raise Error(f"{run.directory}: the snapshots at {run.times[first]:g} s and {run.times[last]:g} s have "
                    "no time between them: choose a later --to, or more snapshots")
    turns = abs(float(run.angle[last] - run.angle[first])) / (2 * np.pi)
    return _at_nodes(run, np.asarray(found.nodes[last]) - np.asarray(found.nodes[first]), turns)


def _at_nodes(run: Any, work: Array, turns: float) -> Wear:
    assert run.contact is not None
    node = run.mesh.boundary.astype(np.int64)
    at = run.mesh.coordinates[node]
    angle = np.arctan2(at[:, 0], -at[:, 1])
    across = at[:, 2] if run.is_solid else np.zeros(len(node))
    return Wear(node, angle, across, work, turns, np.asarray(run.contact.tributary))


def read_friction_work(run: Any) -> FrictionWork:
    """An error where the run has none."""
    run.need_snapshots()
    names = run.contact_datasets
    if "friction_work" not in names:
        raise Error(f"{run.directory}: no friction work: run the case again with output.friction_work = "
                    "true; Run.wear() of steady rolling has that of a turn without")

    with opened(run.path) as file:
        along, across = (np.asarray(file[f"contact/{name}"][:]) if name in names else None
                         for name in ("friction_along", "friction_across"))
    places = (LazyArray(run.path, "contact/friction_places", run.n_snapshots)
              if "friction_places" in names else None)
    return FrictionWork(LazyArray(run.path, "contact/friction_work", run.n_snapshots), places,
                        np.empty(0) if along is None else along, across)

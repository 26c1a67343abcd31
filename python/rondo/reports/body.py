# SPDX-License-Identifier: BSD-3-Clause
"""The deformed body of a run for the canvas of a page: mesh, snapshots, fields, forces, ground."""
from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..data.arrays import LazyArray
from ..data.errors import Error
from ..data.files import kept
from ..data.ground import Ground
from ..data.run import Run
from ..data.solid import ground_axes, outer_faces
from ..plots.cells import loops, outline
from ..plots.field import SHOWN_IN, snapshot_title
from ..plots.rim import shape
from .encoding import packed, quantised, shades, size_of

Array = NDArray[np.float64]
Whole = NDArray[np.int64]
BUDGET = 3_000_000  # characters of a page
TRIAL = 6  # snapshots from which the size of the others is told
MOST = 400  # snapshots
SHOWN = ("velocity", "von_mises", "cauchy_stress", "contact_force")  # besides the displacement
MOST_MESH = 2.0  # of the budget


def body_of(run: Run, budget: int = BUDGET) -> tuple[dict[str, Any], str]:
    """What assets/viewer.js draws, in at most about `budget` characters, and a sentence on the
    snapshots that had to be left out; "" where all are there. The run has snapshots."""
    with kept(run.path):
        whole = _finite(run)
        trial = _body(run, whole[_spread(len(whole), TRIAL)])
        mesh = size_of(trial["mesh"])
        if mesh > MOST_MESH * budget:
            raise Error(f"the mesh alone, {run.mesh.n_nodes} nodes, would make the page too large; "
                        "ParaView shows such bodies (fields.vtkhdf, fields.xdmf)")
        each = max(1.0, (size_of(trial) - mesh) / len(trial["labels"]))
        chosen = whole[_spread(len(whole), min(MOST, max(TRIAL, int((budget - mesh) / each))))]
        found = _body(run, chosen) if len(chosen) != len(trial["labels"]) else trial
    lost = "" if len(whole) == run.n_snapshots else (
        f"{run.n_snapshots - len(whole)} of {run.n_snapshots} snapshots are not shown: their numbers are not "
        f"finite, from {snapshot_title(run, _first_lost(run, whole))} on. ")
    if len(chosen) == len(whole):
        return found, lost
    return found, lost + (f"Of {run.n_snapshots} snapshots {len(chosen)}, evenly spread, are in this page, so "
                   "that it stays small; all of them are in the directory of the run.")


def _finite(run: Run) -> Whole:
    """Numbers of the snapshots of finite numbers alone."""
    moved = np.isfinite(run.angle) & np.isfinite(run.center).all(axis=1)
    fields = [run.field(name) for name in SHOWN if name in run.field_names]
    found = [k for k in range(run.n_snapshots) if moved[k] and np.isfinite(run.displacement[k]).all()
             and all(np.isfinite(field[k]).all() for field in fields)]
    if not found:
        raise Error("the numbers of no snapshot are finite (NaN or infinite): the run has blown up")
    return np.array(found)


def _first_lost(run: Run, whole: Whole) -> int:
    return int(np.setdiff1d(np.arange(run.n_snapshots), whole)[0])


def _spread(count: int, most: int) -> Whole:
    """Numbers of at most `most` of `count` things, the first and the last among them."""
    return np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(np.int64))


def _body(run: Run, chosen: Whole) -> dict[str, Any]:
    nodes, mesh = surface(run.mesh) if run.is_solid else plane(run.mesh)
    frames = _Frames(run, nodes)
    deformation = np.stack([frames.at(int(k)) for k in chosen])
    return {"dimensions": 3 if run.is_solid else 2, "mesh": mesh | _rim(run),
            "frame": packed(frames.of_node, "uint8"), "middle": frames.middle.tolist(),
            "motion": packed(np.array(frames.motion), "float32"),
            "labels": [snapshot_title(run, int(k)) for k in chosen], "wait": _words(run, chosen),
            "displacement": {**quantised(deformation), "name": _name(run), "unit": "mm",
                             "factor": 1e3},
            "fields": _fields(run, chosen, nodes), "forces": _forces(run, chosen, nodes),
            "ground": _ground(run, frames), "follow": frames.goes_far(run.outer_radius)}


def _name(run: Run) -> str:
    return "deformation" if run.mesh.free.any() else "displacement"


def _words(run: Run, chosen: Whole) -> dict[str, Any]:
    """How time passes: what one second of the picture is of the motion is told beside it."""
    span = float(run.times[chosen[-1]] - run.times[chosen[0]])
    kinds = {"crush": "crush", "inflation": "inflation", "steady-rolling": "pass"}
    return {"span": span, "kind": kinds.get(run.analysis, "motion")}


class _Frames:
    """Frames in which nodes are deformed: the co-rotating one, or that of each free body."""

    def __init__(self, run: Run, nodes: Whole) -> None:
        self.run, self.nodes = run, nodes
        free = run.mesh.free_body
        bodies = np.full(run.mesh.n_nodes, -1) if free is None else free
        self.bodies, numbers = np.unique(bodies, return_inverse=True)
        self.of_node = numbers.reshape(-1)[nodes]
        self.first = [int(np.flatnonzero(bodies == body)[0]) for body in self.bodies]
        self.middle = np.zeros((len(self.bodies), 3))
        self.motion: list[Array] = []  # of each snapshot (frames, 4): place, angle

    def at(self, k: int) -> Array:
        """(nodes, 2 or 3) m deformation at snapshot k, along the axes of the frames; keeps how these
        have moved."""
        run, motion = self.run, np.zeros((len(self.bodies), 4))
        if run.is_solid:
            motion[0] = [*run.middle(k), float(run.angle[k])]
            self.motion.append(motion)
            return np.asarray(run.displacement[k], dtype=float)[self.nodes]
        rigid = run.rigid(k)
        for number, (body, node) in enumerate(zip(self.bodies, self.first)):
            if body < 0:
                motion[number] = [*run.center[k], 0.0, float(run.angle[k])]
                continue
            angle = float(rigid.angle[node])
            self.middle[number, :2] = rigid.center[node]
            arm = run.mesh.coordinates[node] - rigid.center[node]
            cos, sin = np.cos(angle), np.sin(angle)
            turned = np.array([cos * arm[0] - sin * arm[1], sin * arm[0] + cos * arm[1]])
            motion[number] = [*(rigid.places[node] - turned), 0.0, angle]
        self.motion.append(motion)
        return rigid.deformation[self.nodes]

    def goes_far(self, radius: float) -> bool:
        places = np.array(self.motion)[:, 0, :2]
        return bool(np.ptp(places, axis=0).max() > 2.0 * radius)

    def reach(self) -> tuple[float, float]:
        """m: what the bodies need along x, with room on both sides."""
        places = np.array(self.motion)[:, :, 0]
        arms = np.abs(self.run.mesh.coordinates[:, :2]).max() if not self.run.mesh.free.any() else \
            np.ptp(self.run.mesh.coordinates, axis=0).max()
        return float(places.min() - 3 * arms), float(places.max() + 3 * arms)


def plane(mesh: Any) -> tuple[Whole, dict[str, Any]]:
    """All nodes; cells with four corners, the last of a triangle once more, and the edges."""
    cells = np.where(mesh.cells < 0, np.roll(mesh.cells, 1, axis=1), mesh.cells)
    if cells.shape[1] == 3:
        cells = np.concatenate([cells, cells[:, 2:]], axis=1)
    lines = loops(outline(mesh.cells))
    return np.arange(mesh.n_nodes), {
        "coordinates": packed(mesh.coordinates, "float32"), "cells": packed(cells, "uint32"),
        "edges": [packed(line, "uint32") for line in lines]}


def surface(mesh: Any) -> tuple[Whole, dict[str, Any]]:
    """Nodes and faces of the surface, these numbered among them."""
    faces = outer_faces(mesh.cells)
    nodes, numbers = np.unique(faces, return_inverse=True)
    return nodes, {"coordinates": packed(mesh.coordinates[nodes], "float32"),
                   "cells": packed(numbers.reshape(-1, 4), "uint32"), "edges": []}


def _rim(run: Run) -> dict[str, Any]:
    if run.is_solid or not run.held.any():
        return {"rim": 0.0}
    return {"rim": shape(run.mesh.coordinates, run.mesh.cells, run.held)[0]}


def _fields(run: Run, chosen: Whole, nodes: Whole) -> list[dict[str, Any]]:
    """Numbers at the nodes for colours, besides the displacement: those that the run has."""
    found = []

    def add(name: str, units: str, values: Callable[[int], Array]) -> None:
        factor, unit = SHOWN_IN.get(units, (1.0, units))
        numbers = np.stack([values(int(k)) for k in chosen]) * factor
        # One at the edge of a patch of contact may be far above all others, and means are drawn.
        found.append({**shades(numbers), "name": name, "unit": unit,
                      "signed": bool(numbers.min(initial=0.0) < 0)})

    there = run.field_names
    if "velocity" in there and not run.is_inflation:  # of an equilibrium it is zero
        speed = run.velocity
        add("velocity", speed.units,
            lambda k: np.linalg.norm(np.asarray(speed[k], dtype=float)[nodes], axis=-1))
    if run.is_solid and run.contact is not None:
        add("contact pressure", "Pa", lambda k: _pressure(run, k)[nodes])
    for name in ("von_mises", "stress_xx", "stress_yy", "stress_xy"):
        if name in there:
            source = run.field(name)
            words = "von Mises stress" if name == "von_mises" else f"stress {name[7:]}, fixed axes"
            add(words, source.units, partial(_nodal, source, nodes))
    return found


def _nodal(source: LazyArray, nodes: Whole, k: int) -> Array:
    return np.asarray(source[k], dtype=float)[nodes]


def _pressure(run: Run, k: int) -> Array:
    assert run.contact is not None
    values = np.zeros(run.mesh.n_nodes)
    values[run.mesh.boundary] = np.asarray(run.contact.traction[k])[:, 0]
    return values


def _forces(run: Run, chosen: Whole, nodes: Whole) -> dict[str, Any] | None:
    """Forces of contact on the body at its nodes, along the fixed axes; None where nothing may be
    touched."""
    if "contact_force" not in run.field_names or not nodes.size:
        return None
    place = np.full(run.mesh.n_nodes, -1)
    place[nodes] = np.arange(len(nodes))
    counts, where, vectors = [], [], []
    for k in chosen:
        force = np.asarray(run.field("contact_force")[int(k)], dtype=float)
        touching = np.flatnonzero((np.abs(force).max(axis=1) > 0) & (place >= 0))
        counts.append(len(touching))
        where.append(place[touching])
        vectors.append(force[touching])
    unit = "N" if run.is_solid else "N/m"
    every = np.concatenate(vectors)
    return {"counts": packed(counts, "uint32"), "nodes": packed(np.concatenate(where), "uint32"),
            "vectors": packed(every, "float32"), "unit": unit,
            "largest": float(np.linalg.norm(every, axis=1).max(initial=0.0))}


def _ground(run: Run, frames: _Frames) -> dict[str, Any] | None:
    """The profile as a line, and of a wheel in three dimensions the axes that it is along."""
    ground = Ground.from_case(run.case)
    if ground is None:
        return None
    found: dict[str, Any] = {"line": ground.points(frames.reach()).round(6).tolist()}
    if run.is_solid:
        beside = 2.5 * float(np.abs(run.mesh.coordinates[:, 2]).max())
        # Along t2 the center may drift: the strip is as wide as to be under it all along.
        drift = [float(run.lateral.min(initial=0.0)), float(run.lateral.max(initial=0.0))]
        found |= {"axes": ground_axes(run.camber).tolist(), "from": drift[0] - beside,
                  "to": drift[1] + beside}
    return found


def modes_of(pod: Any, most: int) -> dict[str, Any]:
    """The first modes of a POD of displacement or velocity, each over its largest vector."""
    nodes, mesh = surface(pod.mesh) if pod.mesh.is_solid else plane(pod.mesh)
    shapes = np.asarray(pod.spatial[:most], dtype=float)[:, nodes]
    largest = np.linalg.norm(shapes, axis=2).max(axis=1)
    shapes = shapes / np.where(largest > 0, largest, 1.0)[:, None, None]
    radius = float(np.linalg.norm(pod.mesh.coordinates[:, :2], axis=1).max())
    labels = [f"mode {k + 1}: {100 * share:.4g} % of the energy"
              for k, share in enumerate(pod.energy[:len(shapes)])]
    return {"dimensions": 3 if pod.mesh.is_solid else 2, "modes": True, "mesh": mesh | {"rim": 0.0},
            "frame": packed(np.zeros(len(nodes)), "uint8"), "middle": [[0.0, 0.0, 0.0]],
            "motion": packed(np.zeros((len(shapes), 1, 4)), "float32"), "labels": labels,
            "wait": {"span": 0.0, "kind": "modes"}, "ground": None, "forces": None, "fields": [],
            "follow": False, "amplitude": 0.1 * radius,
            "displacement": {**quantised(shapes), "name": "size of the mode", "unit": "of its largest",
                             "factor": 1.0}}

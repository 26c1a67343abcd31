# SPDX-License-Identifier: BSD-3-Clause
"""Directories of runs of a wheel in three dimensions, written by hand: a box section revolved, with
fields that the tests know in closed form."""
from __future__ import annotations

import json
import pathlib
from dataclasses import dataclass

import h5py
import numpy as np

INNER, OUTER, WIDTH = 0.15, 0.30, 0.10
HEIGHT = 0.29
PRESSURE, FRICTION, HALF = 1.0e6, 0.3, 0.06  # peak; μ; half length of the contact
SPIN, SPEED, SLIP, CAMBER = -33.0, 10.0, 0.05, 0.02


@dataclass
class Box:
    """A wheel of layers × axial × sectors hexahedra; sector 0 begins straight down."""

    points: np.ndarray
    hexahedra: np.ndarray
    boundary: np.ndarray
    tributary: np.ndarray
    mass: np.ndarray
    sector: np.ndarray
    sector_node: np.ndarray


def box(layers: int = 2, axial: int = 4, sectors: int = 60) -> Box:
    radius, z = np.linspace(INNER, OUTER, layers + 1), np.linspace(-0.5, 0.5, axial + 1) * WIDTH
    angle = -0.5 * np.pi + 2 * np.pi * np.arange(sectors) / sectors
    # Nodes: sector, layer, place along the axle.
    s, r, k = np.meshgrid(np.arange(sectors), np.arange(layers + 1), np.arange(axial + 1), indexing="ij")
    points = np.stack([radius[r] * np.cos(angle[s]), radius[r] * np.sin(angle[s]), z[k]], axis=-1)
    number = np.arange(s.size).reshape(s.shape)
    nextward = np.roll(number, -1, axis=0)
    corners = []
    for node, i, j in ((number, 0, 0), (number, 1, 0), (nextward, 1, 0), (nextward, 0, 0),
                       (number, 0, 1), (number, 1, 1), (nextward, 1, 1), (nextward, 0, 1)):
        corners.append(node[:, i:layers + i, j:axial + j].ravel())
    boundary = np.flatnonzero(r.ravel() == layers)
    width = np.full(axial + 1, WIDTH / axial)
    width[[0, -1]] /= 2
    tributary = width[k.ravel()[boundary]] * 2 * np.pi * OUTER / sectors
    mass = np.full(s.size, 0.01)
    return Box(points.reshape(-1, 3), np.stack(corners, axis=1), boundary, tributary, mass,
               s.ravel(), (r * (axial + 1) + k).ravel())


def axes(camber: float) -> np.ndarray:
    """t1, n, t2 in the axes of the wheel."""
    cos, sin = np.cos(camber), np.sin(camber)
    return np.array([[1, 0, 0], [0, cos, sin], [0, -sin, cos]])


def turn(angle: float) -> np.ndarray:
    cos, sin = np.cos(angle), np.sin(angle)
    return np.array([[cos, -sin, 0], [sin, cos, 0], [0, 0, 1]])


def flattened(body: Box, angle: float, camber: float) -> np.ndarray:
    """(n, 3) u in the turning frame: what would lie below the ground lies on it."""
    places = body.points @ turn(angle).T
    n = axes(camber)[1]
    below = np.minimum(places @ n + HEIGHT, 0.0)
    return (-below[:, None] * n) @ turn(angle)


def touching(body: Box, angle: float, camber: float) -> dict[str, np.ndarray]:
    """Rows of contact.csv: a parabola of pressure; nodes of the rear half slip along +t2."""
    places = (body.points + flattened(body, angle, camber)) @ turn(angle).T @ axes(camber).T
    x, height, z = places[body.boundary].T
    inside = np.flatnonzero((np.abs(x) < HALF) & (height + HEIGHT < 1e-12))
    node, x, z = body.boundary[inside], x[inside], z[inside]
    pressure = PRESSURE * (1 - (x / HALF) ** 2)
    sticks = x > 0
    share = np.where(sticks, (HALF - x) / HALF, 1.0)
    return {"candidate": inside, "node": node, "x_m": x, "z_m": z, "pressure_pa": pressure,
            "shear_x_pa": 0.25 * FRICTION * share * pressure,
            "shear_lateral_pa": -np.sqrt(1 - 0.25**2) * FRICTION * share * pressure,
            "sticks": sticks.astype(float)}


def case_text(camber: float, kind: str = "dynamic") -> str:
    return f"""schema = 1
title = "a wheel that corners"
[disk]
outer_radius = {OUTER}
inner_radius = {INNER}
rim = "bonded"
width = {WIDTH}
[disk.mesh]
radial = 2
circumferential = 60
axial = 4
[motion]
angular_velocity = {-SPIN}
speed = {SPEED}
height = {HEIGHT}
slip_angle = {SLIP}
camber = {camber}
[ground]
profile = "flat"
friction = {FRICTION}
[analysis]
kind = "{kind}"
[time]
end = 0.02
[output]
snapshots = 5
"""


def write_run(folder: pathlib.Path, snapshots: int = 5, camber: float = CAMBER,
              steady: bool = False) -> pathlib.Path:
    """A run of `snapshots` snapshots, every 5 ms, or of so many places of a sector's pass."""
    body = box()
    folder.mkdir(parents=True)
    spacing = 2 * np.pi / 60 / snapshots / -SPIN if steady else 0.005
    times = spacing * np.arange(snapshots)
    kind = "steady-rolling" if steady else "dynamic"
    angle = SPIN * times
    lateral = SPEED * np.sin(SLIP) * times
    center = np.stack([SPEED * np.cos(SLIP) * times, np.full(snapshots, HEIGHT)], axis=1)
    u = np.array([flattened(body, a, camber) for a in angle])
    rows = [touching(body, a, camber) for a in angle]
    write_results(folder / "results.h5", body, times, angle, center, lateral, u, rows, kind)
    names = ["time_s", "node", "x_m", "z_m", "pressure_pa", "shear_x_pa", "shear_lateral_pa",
             "sticks"]
    lines = [",".join(names)]
    for k, row in enumerate(rows):
        shown = row | {"time_s": np.full(len(row["node"]), times[k]),
                       "x_m": row["x_m"] + center[k, 0], "z_m": row["z_m"] + lateral[k]}
        lines += [",".join(f"{shown[name][i]:.17g}" for name in names)
                  for i in range(len(row["node"]))]
    (folder / "contact.csv").write_text("\n".join(lines) + "\n")
    write_history(folder, times, kind)
    (folder / "case.toml").write_text(case_text(camber, kind))
    return folder


def write_results(path: pathlib.Path, body: Box, times: np.ndarray, angle: np.ndarray,
                  center: np.ndarray, lateral: np.ndarray, u: np.ndarray,
                  rows: list[dict[str, np.ndarray]], kind: str) -> None:
    force = np.zeros((len(times), len(body.boundary), 3))
    for k, row in enumerate(rows):
        traction = np.stack([row["pressure_pa"], -row["shear_x_pa"], row["shear_lateral_pa"]], axis=1)
        force[k, row["candidate"]] = traction * body.tributary[row["candidate"], None]
    with h5py.File(path, "w") as file:
        file.attrs["format"], file.attrs["analysis"] = "rondo results 1", kind

        def put(name: str, values: np.ndarray, units: str) -> None:
            data = file.create_dataset(name, data=values)
            data.attrs["units"], data.attrs["description"] = units, name

        put("mesh/coordinates", body.points, "m")
        put("mesh/hexahedra", body.hexahedra.astype(np.int32), "1")
        put("mesh/boundary", body.boundary.astype(np.int32), "1")
        put("mesh/tributary", body.tributary, "m2")
        put("mesh/mass", body.mass, "kg")
        put("mesh/sector", body.sector.astype(np.int32), "1")
        put("mesh/sector_node", body.sector_node.astype(np.int32), "1")
        put("frame/time", times, "s")
        put("frame/time_velocity", times, "s")
        put("frame/angle", angle, "rad")
        put("frame/angle_velocity", angle, "rad")
        put("frame/center", center, "m")
        put("frame/lateral", lateral, "m")
        put("snapshots/displacement", u, "m")
        put("snapshots/velocity", np.zeros_like(u), "m/s")
        put("contact/force", force, "N")
        put("contact/traction", force / body.tributary[None, :, None], "Pa")


HISTORY = {"time_s": "s", "force_x": "N", "force_y": "N", "force_lateral": "N", "torque": "N·m",
           "moment_aligning": "N·m", "moment_overturning": "N·m", "slip_angle": "rad",
           "kinetic": "J", "strain": "J", "work_frame": "J", "dissipation_friction": "J",
           "loss_impact": "J", "energy_residual": "J"}


def write_history(folder: pathlib.Path, times: np.ndarray, kind: str) -> None:
    values = {"force_x": 400.0, "force_y": 17800.0, "force_lateral": -1500.0, "torque": 3.0,
              "moment_aligning": -29.0, "moment_overturning": 12.0, "slip_angle": SLIP,
              "kinetic": 20.0, "strain": 60.0, "work_frame": 84.0,
              "dissipation_friction": 4.0, "loss_impact": 0.0, "energy_residual": 1e-14}
    lines = [",".join(HISTORY)]
    for time in times[1:] if kind == "dynamic" else times:
        lines.append(",".join([f"{time:.17g}", *(f"{values[name]:.17g}" for name in HISTORY
                                                 if name != "time_s")]))
    (folder / "history.csv").write_text("\n".join(lines) + "\n")
    (folder / "run.json").write_text(json.dumps({
        "status": "done", "title": "a wheel that corners", "analysis": kind, "dimensions": 3,
        "end_time": float(times[-1]), "step": 1e-4,
        "columns": [{"name": name, "unit": unit} for name, unit in HISTORY.items()]}))

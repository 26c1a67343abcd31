# SPDX-License-Identifier: BSD-3-Clause
"""A run: the directory that `rondo run` writes (docs/results.md)."""
from __future__ import annotations

import os
import pathlib
from collections.abc import Callable, Iterable
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from .arrays import LazyArray
from .contact import Contact, Crush
from .convergence import Convergence
from .cords import Cords
from .errors import STATUS, Error, UnfinishedRunError, unknown
from .files import check_format, opened, read_case, read_json, require
from .friction import FrictionWork, Wear, read_friction_work, wear_of
from .heat import FlashTemperature, Heat, flash_of
from .history import History
from .html import run_html
from .labelled import STRESS, run_dataset
from .mesh import Mesh, read_mesh
from .names import frame_named
from .pod import Pod, Pods
from .rigid import Rigid, rigid_motion
from .section import Section, section_of
from .solid import ground_axes, outer_radius_of, rolling_wheel, turned_about_axle

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def open_run(path: str | os.PathLike[str], unfinished: bool = False) -> Run:
    """Opens a run. `unfinished`: also one that has not ended, was interrupted or has failed; its
    complete snapshots are read."""
    directory = require(path, "run.json", beside="results.h5")
    run = Run(directory)
    if run.status != "done" and not unfinished:
        meaning = STATUS.get(run.status, "not known to this package")
        message = f": {run.info['message']}" if run.info.get("message") else ""
        raise UnfinishedRunError(
            f'{directory}: status "{run.status}": {meaning}{message}. {run.n_snapshots} snapshots '
            f'are there; rondo.open("{directory}", unfinished=True) reads them')
    return run


class Run:
    """What a run left, n nodes and t complete snapshots.

    directory; info: run.json; case: case.toml; times, times_velocity: (t,) [s], of a crush the
    share of its depth, of an inflation that of its loads; angle, angle_velocity: (t,) of the
    co-rotating frame at these times [rad]; center: (t, 2) in the fixed frame [m]; mesh."""

    # Pictures: what rondo/pictures.py gives this class, as nothing here knows how to draw.
    plot_field: Callable[..., Axes]
    plot_history: Callable[..., Axes]
    plot_energy: Callable[..., Axes]
    plot_spectrum: Callable[..., Axes]
    plot_psd: Callable[..., Axes]
    plot_contact: Callable[..., Axes]
    plot_contact_map: Callable[..., Axes]
    plot_modes: Callable[..., Figure]
    plot_wheel: Callable[..., Figure]
    plot_footprint: Callable[..., Figure]
    plot_wear: Callable[..., Figure]
    plot_flash_temperature: Callable[..., Figure]
    plot_convergence: Callable[..., Axes]
    plot_section: Callable[..., Axes]
    plot_cords: Callable[..., Axes]
    animate: Callable[..., pathlib.Path]
    report: Callable[..., pathlib.Path]

    def __init__(self, directory: pathlib.Path) -> None:
        self.directory = directory
        self.info: dict[str, Any] = read_json(directory / "run.json")
        self.case: dict[str, Any] = read_case(directory / "case.toml")
        self.path = directory / "results.h5"
        with opened(self.path) as file:
            check_format(self.path, "results", file.attrs.get("format"))
            # Runs of earlier versions do not say what they are: motions.
            self.analysis = str(file.attrs.get("analysis", "dynamic"))
            self.mesh: Mesh = read_mesh(file)
            times = file["frame/time"][:] if "frame" in file else np.empty(0)
            missing = np.flatnonzero(np.isnan(times))  # the time of a snapshot is written last
            t = int(missing[0]) if len(missing) else len(times)
            self.times: np.ndarray = times[:t]
            frame = {name: file[f"frame/{name}"][:t] if "frame" in file else np.empty(0)
                     for name in ("time_velocity", "angle", "angle_velocity", "center")}
            # Of a wheel in three dimensions, along t2; else the center stays in the plane.
            self.lateral: np.ndarray = (file["frame/lateral"][:t] if "frame/lateral" in file
                                        else np.zeros(t))
            self._has_contact = "contact" in file
            self._datasets = [f"{group}/{name}" for group in ("snapshots", "fields")
                              if group in file for name in file[group]]
            self.contact_datasets: tuple[str, ...] = tuple(file.get("contact", ()))  # of results.h5
            self._of_modes = "reduced" in file  # a reduced run of an earlier version
        self._fields: dict[str, LazyArray] = {}  # those asked for so far
        self.times_velocity: np.ndarray = frame["time_velocity"]
        self.angle: np.ndarray = frame["angle"]
        self.angle_velocity: np.ndarray = frame["angle_velocity"]
        self.center: np.ndarray = frame["center"].reshape(-1, 2)

    def __repr__(self) -> str:
        return (f"Run({self.directory}: {self.title}; {self.analysis}, {self.status}, "
                f"{self.mesh.n_nodes} nodes, {self.n_snapshots} snapshots)")

    def _repr_html_(self) -> str:
        return run_html(self)

    # What it is

    @property
    def title(self) -> str:
        return str(self.case.get("title", self.directory.name))

    @property
    def status(self) -> str:
        """ "done", "running", "interrupted" or "failed"."""
        return str(self.info.get("status"))

    @property
    def is_crush(self) -> bool:
        return self.analysis == "crush"

    @property
    def is_inflation(self) -> bool:
        """Whether it is of a wheel that is brought into equilibrium under its air, and no more: its
        snapshots and rows are equilibria."""
        return self.analysis == "inflation"

    @property
    def is_solid(self) -> bool:
        """Whether the body is a wheel in three dimensions: vectors have three components, forces
        are in N, energies in J."""
        return self.mesh.is_solid

    @property
    def per_width(self) -> str:
        """What ends the units of forces and energies: "/m" of a plane body, "" in three dimensions."""
        return "" if self.is_solid else "/m"

    def need_plane(self, what: str, instead: str) -> None:
        """An error of a wheel in three dimensions: what is plane only, and what there is instead."""
        if self.is_solid:
            raise Error(f"{self.directory}: {what} is of plane bodies, and this is a wheel in three "
                        f"dimensions: {instead}")

    def need_inflation(self, what: str) -> None:
        """An error of other runs."""
        if not self.is_inflation:
            raise Error(f'{self.directory}: no {what}: it is of analysis.kind = "inflation", and this run '
                        f'has "{self.analysis}"')

    @property
    def camber(self) -> float:
        """Angle by which a wheel in three dimensions leans [rad]; > 0 leans its top to the left."""
        return float(self.case["motion"].get("camber", 0.0))

    @property
    def is_steady(self) -> bool:
        """Whether it is of steady rolling: snapshots and rows are places of a sector's pass."""
        return self.analysis == "steady-rolling"

    @property
    def steady(self) -> dict[str, Any]:
        """What run.json says of steady rolling: forces, slopes, powers (docs/results.md); an error
        of other runs."""
        if not self.is_steady or "steady" not in self.info:
            raise Error(f"{self.directory}: no steady rolling: analysis.kind is \"{self.analysis}\", "
                        f"status \"{self.status}\"")
        return dict(self.info["steady"])

    @property
    def has_rim(self) -> bool:
        """Whether the case has a [rim]: the rim is a body with mass, free or held."""
        return "rim" in self.case

    @property
    def time_unit(self) -> str:
        """Of times: "s", or "1" for the share of the depth of a crush, of the loads of an inflation."""
        return "1" if self.is_crush or self.is_inflation else "s"

    @property
    def n_snapshots(self) -> int:
        return len(self.times)

    @property
    def outer_radius(self) -> float:
        """R_o of a disk [m]; of a mesh from a file its largest distance from the origin."""
        return outer_radius_of(self.case, self.mesh)

    @property
    def inner_radius(self) -> float:
        """R_i of a disk [m]; 0 of a mesh from a file."""
        return float(self.case.get("disk", {}).get("inner_radius", 0.0))

    @property
    def friction(self) -> float | None:
        """The one coefficient of friction; None without ground, and where it is by a table or patches."""
        ground = self.case.get("ground", {})
        value = ground.get("friction")
        return float(value) if isinstance(value, (int, float)) and "patch" not in ground else None

    @property
    def pitches(self) -> int:
        """Of the tread; 0: smooth."""
        return int(self.case.get("disk", {}).get("tread", {}).get("pitches", 0))

    @property
    def spin(self) -> float:
        """Angular velocity of the rim at the end [rad/s]; > 0 rolls towards +x; 0 in a crush and
        where nothing is held."""
        if self.is_inflation:
            return float(self.case["inflation"].get("spin", 0.0))
        if self.is_crush or "angular_velocity" not in self.case["motion"]:
            return 0.0
        given = self.case["motion"]["angular_velocity"]
        if not isinstance(given, list):
            return float(given)
        table = np.array(given, dtype=float)
        return float(np.interp(self.case["time"]["end"], table[:, 0], table[:, 1]))

    @property
    def pitch_frequency(self) -> float | None:
        """Pitches that pass a second at the end [Hz]; None for a smooth or still disk."""
        return self.pitches * abs(self.spin) / (2 * np.pi) or None

    @property
    def columns(self) -> int:
        """Columns of cells round a generated disk; 0 of a mesh from a file."""
        if "section" in self.case:
            return int(self.case["section"]["sectors"])
        disk = self.case.get("disk", {})
        if "tread" in disk:
            tread = disk["tread"]
            return self.pitches * (int(tread["land_columns"]) + int(tread["groove_columns"]))
        return int(disk.get("mesh", {}).get("circumferential", 0))

    @property
    def mesh_frequency(self) -> float | None:
        """Columns × spin / 2π: how often a node comes to the ground at the end [Hz]. None of a mesh
        from a file and of a still disk."""
        return self.columns * abs(self.spin) / (2 * np.pi) or None

    @cached_property
    def held(self) -> np.ndarray:
        """(n,) True where a node is held by the rim: on the inner circle of a disk; of a mesh from
        a file where nothing has moved in the co-rotating frame."""
        mesh = self.mesh
        if "disk" in self.case:
            radius: np.ndarray = np.linalg.norm(mesh.coordinates[:, :2], axis=1)
            return ~mesh.free & (radius <= self.inner_radius * (1 + 1e-9))
        if mesh.free.all() or not self.n_snapshots:
            return np.zeros(mesh.n_nodes, dtype=bool)
        still: np.ndarray = ~mesh.free & ~np.asarray(self.displacement[-1]).any(axis=1)
        return still & ~still.all()

    # Its fields

    @property
    def field_names(self) -> list[str]:
        """What field() takes."""
        names = {name.split("/")[1] for name in self._datasets}
        if "cauchy_stress" in names:
            names |= {f"stress_{component}" for component in STRESS}
        return sorted(names)

    def field(self, name: str) -> LazyArray:
        """A field of all snapshots: "displacement", "velocity" (t, n, 2) in the co-rotating frame,
        of free bodies in the fixed one; "von_mises", "stress_xx", "stress_xy", ... (t, n) and
        "cauchy_stress" (t, n, 6) with stress; "position", "contact_force" (t, n, 3) for pictures:
        these along the fixed axes. Stress is the mean of the cells around a node; that of a probe
        is of its cell alone, and on coarse meshes they differ (docs/results.md).
        "fields/displacement", "fields/velocity": along the fixed axes."""
        if name in self._fields:
            return self._fields[name]
        component = None
        dataset = name
        if name.startswith("stress_") and name[7:] in STRESS:
            dataset, component = "cauchy_stress", STRESS.index(name[7:])
        for candidate in (dataset, f"snapshots/{dataset}", f"fields/{dataset}"):
            if candidate in self._datasets:
                self._fields[name] = LazyArray(self.path, candidate, self.n_snapshots, component)
                return self._fields[name]
        self.need_snapshots()
        if self._of_modes:
            raise Error(f"{self.directory}: was written with --snapshots modes of an earlier version: run "
                        "the case again")
        raise unknown(self.directory, "field", name, self.field_names)

    @property
    def displacement(self) -> LazyArray:
        """(t, n, 2) u in the co-rotating frame [m]."""
        return self.field("displacement")

    @property
    def velocity(self) -> LazyArray:
        """(t, n, 2) du/dt in the co-rotating frame, at times_velocity [m/s]; in a crush du over the
        share of the depth [m]."""
        return self.field("velocity")

    def position(self, k: int) -> np.ndarray:
        """(n, 2) places of the nodes at snapshot k in the fixed frame: c + R(θ)(X + u), of free
        bodies X + u [m]. Of a wheel in three dimensions (n, 3), in its own axes, which do not turn."""
        arms = self.mesh.coordinates + self.displacement[k]
        if self.is_solid:
            return self.middle(k) + turned_about_axle(arms, float(self.angle[k]))
        cos, sin = np.cos(self.angle[k]), np.sin(self.angle[k])
        turn = np.array([[cos, -sin], [sin, cos]])
        places = self.center[k] + arms @ turn.T
        return np.where(self.mesh.free[:, None], arms, places)

    def on_ground(self, k: int) -> np.ndarray:
        """(n, 3) places of the nodes of a wheel in three dimensions at snapshot k along t1, n and
        t2, from the center's projection on the ground [m]; n is the height above y = 0."""
        if not self.is_solid:
            raise Error(f"{self.directory}: a plane body has no axes of the ground beside its own: "
                        "position()")
        arms = self.position(k) - self.middle(k)
        return np.asarray(arms @ ground_axes(self.camber).T + [0.0, float(self.center[k][1]), 0.0])

    def rigid(self, k: int) -> Rigid:
        """The motion of free bodies at snapshot k as that of rigid ones, and their deformation."""
        self.need_plane("rigid()", "no wheel in three dimensions is free; position() has its nodes")
        return rigid_motion(self.mesh, np.asarray(self.displacement[k], dtype=float))

    def deformation(self, k: int) -> np.ndarray:
        """(n, 2) displacement at snapshot k without the motion of each free body as a rigid one,
        along the axes that turn with it; of held bodies the displacement [m]."""
        if self.is_solid:
            return np.asarray(self.displacement[k])
        return self.rigid(k).deformation

    def middle(self, k: int) -> np.ndarray:
        """(2,) m: the center of the co-rotating frame; where nothing is constrained, the center of
        mass. Of a wheel in three dimensions (3,), in its own axes."""
        if self.is_solid:
            along, up = self.center[k]
            return np.asarray([along, up, self.lateral[k]] @ ground_axes(self.camber))
        if not self.mesh.free.all():
            return np.asarray(self.center[k])
        return np.average(self.position(k), axis=0, weights=self.mesh.mass)

    def index(self, time: float) -> int:
        """The snapshot nearest to a time [s] (of a crush: share of the depth, of an inflation: of the
        loads)."""
        self.need_snapshots()
        first, last = self.times[0], self.times[-1]
        spacing = np.diff(self.times).max() if self.n_snapshots > 1 else 0.0
        slack = max(spacing, self.info.get("step") or 0.0)
        if not first - slack <= time <= last + slack:
            raise Error(f"{self.directory}: no snapshot near {time:g} {self.time_unit}; they are "
                        f"from {first:g} to {last:g} {self.time_unit}")
        return int(np.argmin(np.abs(self.times - time)))

    def need_snapshots(self) -> None:
        """An error where there are none, which says why."""
        if self.n_snapshots:
            return
        why = " yet"
        if self.case.get("output", {}).get("snapshots") == 0:
            why = ": output.snapshots was 0; run it again with more"
        raise Error(f"{self.directory}: the run has no snapshots{why}")

    @cached_property
    def contact(self) -> Contact | None:
        """None where nothing may be touched, or without snapshots."""
        if not self.n_snapshots or not self._has_contact:
            return None
        force, traction = (LazyArray(self.path, f"contact/{name}", self.n_snapshots)
                           for name in ("force", "traction"))
        return Contact(force, traction, self.mesh.boundary, self.mesh.tributary,
                       self.directory / "contact.csv")

    @cached_property
    def friction_work(self) -> FrictionWork:
        """What friction has taken at each contact node and place of the footprint, with
        output.friction_work; an error of other runs."""
        return read_friction_work(self)

    def wear(self, from_time: float | None = None, to_time: float | None = None) -> Wear:
        """What friction takes around the tread: of steady rolling in a turn, of steps in time between two
        times, which needs output.friction_work."""
        return wear_of(self, from_time, to_time)

    def flash_temperature(self, heat: Heat, time: float | None = None) -> FlashTemperature:
        """Rise of the tread's temperature through the footprint of steady rolling, or at a snapshot; see
        rondo.data.heat.flash_of."""
        return flash_of(self, heat, time)

    @cached_property
    def crush(self) -> Crush | None:
        """None for a motion."""
        if not self.is_crush:
            return None
        extent = "contact_area" if self.is_solid else "contact_length"
        with opened(self.path) as file:
            return Crush(*(file[f"crush/{name}"][:self.n_snapshots]
                           for name in ("depth", "force", extent, "pressure_max")))

    @cached_property
    def history(self) -> History:
        """history.csv, a row for each interval of output. Of a run that is done it is whole. The
        stress of a probe is that of its cell; field() averages stress at the nodes."""
        history = History(self.directory / "history.csv", self.is_crush, "ground" in self.case,
                          self.info.get("columns", ()), instants=self.is_steady)
        if self.status == "done":
            solved = (self.info.get("increments_done") if self.is_crush else
                      self.info.get("equilibria") if self.is_inflation else None)
            history.check_end(None if self.is_crush else self.info.get("end_time"),
                              None if solved is None else solved + 1)
        if self.is_solid and not (self.is_crush or self.is_inflation):
            history.wheel = rolling_wheel(self.case, self.outer_radius)
        return history

    @cached_property
    def convergence(self) -> Convergence:
        """convergence.csv of a crush by LATIN, a row for each iteration; an error of other runs."""
        return Convergence(self.directory, self.case.get("analysis", {}))

    @cached_property
    def section(self) -> Section:
        """The section of an inflated wheel, before and at each snapshot; an error of other runs."""
        self.need_inflation("section of an inflated wheel")
        self.need_snapshots()
        return section_of(self.mesh, self.displacement)

    @cached_property
    def cords(self) -> Cords:
        """cords.csv of an inflation: forces, angles and stretches along each layer of cords, under the
        loads reached; an error where there are none."""
        return Cords(self.directory, self.case)

    def to_xarray(self, names: Iterable[str] | None = None) -> Any:
        """An xarray.Dataset of fields, read when asked for; names: those of field(), and "force",
        "traction" of `contact`; None: displacement, velocity, force."""
        return run_dataset(self, names)

    @cached_property
    def pods(self) -> Pods:
        return Pods(self.directory / "pod")

    def pod(self, field: str, frame: str = "co-rotating") -> Pod:
        """The POD of a field in a frame ("co-rotating", "rectified"), or "pgd": that of LATIN-PGD."""
        return self.pods.of(field, frame_named(frame))

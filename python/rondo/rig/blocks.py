# SPDX-License-Identifier: BSD-3-Clause
"""What the rig runs: blocks of points, each a command of the program on files under DIR/runs that people can run by hand."""
from __future__ import annotations

import copy
import hashlib
import pathlib
import shutil
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from ..data.errors import Error, FileError
from .keys import TOP
from .settings import Settings, is_per_metre
from .toml_text import toml_text
from .tyre import Tyre

SWEEP, RUN, MODES, FMU = "sweep", "run", "modes", "fmu"  # kinds of blocks: commands of the program
MADE_OF = "made-of"  # the file with the identity of a block whose command has ended
RESULTS = "results"  # their directory; of an FMU the file itself is this with .fmu
_KEPT = ("section", "disk", "material", "cords", "inflation", "damping")  # tables of a case that are the tyre's own


@dataclass(frozen=True)
class Point:
    """A state that is asked for, in SI and with the signs of ISO 8855."""

    load: float
    pressure: float | None  # None: a wheel without air
    speed: float            # m/s: the spin times the radius without load
    camber: float = 0.0
    slip_angle: float = 0.0
    slip_ratio: float | None = None  # None: rolls freely
    extra: Mapping[str, Any] = field(default_factory=dict)  # columns of the test's own


@dataclass(frozen=True)
class Block:
    """`keys` and `values`: what the members of a sweep differ in, a row for each point. `cannot`: points that cannot begin,
    and why: they are no part of the command, and a block that has no others is not run."""

    test: str
    name: str  # of the folder under DIR/runs
    kind: str
    case: dict[str, Any]
    points: tuple[Point, ...]
    keys: tuple[str, ...] = ()
    values: tuple[tuple[float, ...], ...] = ()
    options: tuple[str, ...] = ()
    cannot: tuple[tuple[Point, str], ...] = ()

    @property
    def count(self) -> int:
        """Of its points, with those that cannot begin."""
        return len(self.points) + len(self.cannot)

    def texts(self) -> dict[str, str]:
        """Its files: name, content."""
        texts = {"case.toml": toml_text(self.case)}
        if self.kind == SWEEP:
            vary = {"keys": list(self.keys), "values": [list(row) for row in self.values]} if len(self.keys) > 1 else \
                {"key": self.keys[0], "values": [row[0] for row in self.values]}
            study = {"schema": 1, "title": self.name, "base": "case.toml", "vary": [vary]}
            texts["study.toml"] = toml_text(study)
        return texts

    def identity(self, build_id: str, mesh: bytes) -> str:
        """Of all that its results depend on."""
        parts = [build_id, self.kind, *self.options, *(text for pair in self.texts().items() for text in pair)]
        return hashlib.sha256("\0".join(parts).encode() + mesh).hexdigest()

    def arguments(self, folder: pathlib.Path) -> list[str]:
        """Of the command, without the program."""
        if self.kind == FMU:
            return [FMU, str(folder / "case.toml"), "-o", str(folder / f"{RESULTS}.fmu"), "--quiet", *self.options]
        file = "study.toml" if self.kind == SWEEP else "case.toml"
        alone = [] if self.kind == MODES else ["--jobs", "1"]
        return [self.kind, str(folder / file), "-o", str(folder / RESULTS), "--overwrite", "--quiet", *alone, *self.options]

    def is_there(self, folder: pathlib.Path, identity: str) -> bool:
        """Its results are there, and were made of the same."""
        try:
            return (folder / MADE_OF).read_text(encoding="utf-8") == identity and (folder / self.result).exists()
        except (OSError, ValueError):
            return False

    @property
    def result(self) -> str:
        """The file by which its results are known to be there."""
        ends = {SWEEP: "/results.csv", RUN: "/run.json", MODES: "/modes.csv", FMU: ".fmu"}
        return f"{RESULTS}{ends[self.kind]}"

    def write(self, folder: pathlib.Path) -> None:
        """Anew: results of another time go."""
        try:
            (folder / MADE_OF).unlink(missing_ok=True)
            shutil.rmtree(folder / RESULTS, ignore_errors=True)
            folder.mkdir(parents=True, exist_ok=True)
            for name, text in self.texts().items():
                (folder / name).write_text(text, encoding="utf-8")
        except OSError as reason:
            raise FileError(f"{folder}: cannot be written: {reason.strerror or reason}") from None


@dataclass(frozen=True)
class Bench:
    """The tyre on the rig. `mesh`: name of the file of its section under DIR/runs; "": none. `radius`: without load
    [m]; 0: not yet known."""

    tyre: Tyre
    settings: Settings
    mesh: str = ""
    radius: float = 0.0
    stable_step: float = 0.0  # s, of runs of a plane wheel in time; 0: not known, or not needed
    no_steps: str = ""        # why a plane wheel cannot run in time; "": it can

    @property
    def top(self) -> dict[str, Any]:
        return self.settings[TOP]

    @property
    def pressure(self) -> float | None:
        """Pa, nominal; None of a wheel without air."""
        found = self.top.get("pressure")
        return None if found is None else float(found)

    @property
    def per_metre(self) -> bool:
        """Forces are per metre of width."""
        return is_per_metre(self.tyre.wheels, self.top)

    @property
    def width(self) -> float:
        """m, by which forces of the program are multiplied."""
        return float(self.top.get("width", 1.0))

    def spin(self, speed: float | None = None) -> float:
        """rad/s, at which the radius without load has this speed [m/s]; None: the nominal one."""
        return (self.top["speed"] if speed is None else speed) / self.radius


def block_or_why_not(test: str, point: Point, made: Callable[[], Block]) -> Block:
    """A block of one point; where it cannot begin, the block says why."""
    try:
        return made()
    except Error as reason:
        return Block(test, "", RUN, {}, (), cannot=((point, str(reason)),))


def tyre_case(bench: Bench, title: str, pressure: float | None) -> dict[str, Any]:
    """The tables that are the tyre's own."""
    found = bench.tyre.case
    case: dict[str, Any] = {"schema": 1, "title": title}
    case |= {name: copy.deepcopy(found[name]) for name in _KEPT if name in found}
    if "section" in case:
        case["section"] |= {"file": f"../{bench.mesh}", "sectors": bench.top["sectors"]}
    elif not bench.tyre.has_tread:
        case["disk"]["mesh"]["circumferential"] = bench.top["sectors"]
    if pressure is not None:
        case["inflation"]["pressure"] = pressure
    return case


def ground_of(bench: Bench, profile: Any = "flat") -> dict[str, Any]:
    """The friction of the case, or that of the rig file."""
    friction = bench.top.get("friction")
    found = bench.tyre.case.get("ground", {}).get("friction", 0.0)
    return {"profile": profile, "friction": copy.deepcopy(found) if friction is None else friction}


def steady_case(bench: Bench, title: str, pressure: float | None, spin: float, load: float | None = None,
                **analysis: Any) -> dict[str, Any]:
    """A state of steady rolling; a sweep varies the rest. `load`: None: the nominal one."""
    own = bench.tyre.case.get("analysis", {})
    case = tyre_case(bench, title, pressure)
    case["motion"] = {"angular_velocity": spin}
    case["ground"] = ground_of(bench)
    case["analysis"] = {
        "kind": "steady-rolling", "load": (bench.top["load"] if load is None else load) / bench.width,
        "samples_per_sector": bench.top["samples_per_sector"],
        "estimate_slip_error": False, "accept_scheme_power": True,
        **{name: own[name] for name in ("inertia", "slip", "massless_contact") if name in own}, **analysis}
    case["output"] = {"stress": False}
    return case


def steady_block(bench: Bench, test: str, name: str, points: Sequence[Point], speeds: Sequence[float] = (),
                 **tables: Any) -> Block:
    """States of one pressure and one spin, in a sweep that shares their harmonics.
    @param speeds along the path of each point [m/s]; none: they roll freely
    @param tables in place of those of the case"""
    first = points[0]
    analysis = {} if speeds else {"torque": 0.0}
    case = steady_case(bench, name, first.pressure, bench.spin(first.speed), **analysis) | tables
    angles = () if bench.tyre.is_plane else ("motion.slip_angle", "motion.camber")
    keys = ("analysis.load", *angles, *(("motion.speed",) if speeds else ()))
    values = tuple((p.load / bench.width, *((0.0 - p.slip_angle, 0.0 - p.camber) if angles else ()), *speeds[k:k + 1])
                   for k, p in enumerate(points))
    return Block(test, name, SWEEP, case, tuple(points), keys, values)

# SPDX-License-Identifier: BSD-3-Clause
"""rondo rig: a tyre through all tests, several runs at once, into one directory (docs/rig.md)."""
from __future__ import annotations

import pathlib
import shutil
import sys
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from ..data.errors import Error, InputError
from ..data.files import read_json
from ..studies.jobs import INTERRUPTED, NUMERICAL, Job, Stop, processors, run_jobs
from ..studies.lock import Lock
from ..studies.program import find_program
from ..studies.progress import Progress
from .against_reading import read_measured
from .blocks import MADE_OF, RESULTS, SWEEP, Bench, Block
from .checks.case import demand_right
from .checks.values import demand_bearable
from .defaults import nominal, with_defaults
from .findings import doubt_of, find
from .keys import TOP
from .plane import NOTES, WITHOUT_WIDTH, fmu_note, left_out_of
from .plane.damping import lowest_of, with_damping_below
from .planning import cost_of, plan_text
from .record import FORMAT, read_record, replace_text, write_channels, write_json, write_table
from .rows import DONE, FAILED, free_radius, rows_of_block
from .settings import Settings, is_per_metre, read_settings, settings_text
from .states import Found, Row, States, states_of
from .steady_tests import at_speeds, reference
from .tests_table import TESTS
from .time_tests import fmu, lowest_mode, stable_step
from .tyre import Tyre, read_mesh, read_tyre
from .units import of_width, units_of

GUESS = 0.3      # m: the radius by which a speed of a rig file is a spin, until the reference tells the radius
FIRST = "vertical"  # the test that others begin with


@dataclass(frozen=True)
class Request:
    case: pathlib.Path
    directory: pathlib.Path
    rig: pathlib.Path | None = None
    tests: tuple[str, ...] = ()  # none: all that the wheel can do
    quick: bool = False
    jobs: int = 0            # at once; 0: as many as there are cores
    overwrite: bool = False  # do again what is there
    quiet: bool = False
    against: pathlib.Path | None = None  # a file of measurements
    fmu: bool = False


def plan(request: Request) -> str:
    """Tests, points, time and disk of a rig, of a state of the reference in a folder that is removed."""
    with tempfile.TemporaryDirectory() as folder:
        rig = Rig(replace(request, directory=pathlib.Path(folder)))
        rig.begin(Stop())
        return plan_text(rig.bench, rig.wanted(), rig.left_out, rig.point_s, rig.disk, request.jobs or processors())


def defaults_text(request: Request) -> str:
    """A rig file with all values of the tyre."""
    with tempfile.TemporaryDirectory() as folder:
        rig = Rig(replace(request, directory=pathlib.Path(folder)))
        rig.begin(Stop())
        return settings_text(rig.bench.settings, rig.bench.tyre.title, rig.bench.tyre.wheels)


def run_rig(request: Request) -> int:
    """What is complete in the directory, of the same program and the same files, is kept: a rig that was killed goes on
    where it was. Returns the exit code."""
    if request.against is not None:
        read_measured(request.against)  # what is wrong with it is told now, not at the end
        demand_newtons(request)
    try:
        request.directory.mkdir(parents=True, exist_ok=True)
    except OSError as reason:
        raise InputError(f"{request.directory}: cannot create directory: {reason.strerror}; choose another -o") from None
    with Lock(request.directory), Stop() as stop:
        rig = Rig(request)
        rig.demand_same()
        rig.begin(stop)
        if not stop.asked:
            rig.do_tests(stop)
        return rig.end(stop)


def demand_newtons(request: Request) -> None:
    """@raise InputError: measurements beside forces per metre of width."""
    tyre = read_tyre(request.case)
    if is_per_metre(tyre.wheels, read_settings(request.rig, tyre.wheels)[TOP]):
        raise InputError(f"--against: {request.against}: measurements are in newtons, and {WITHOUT_WIDTH}")


class Rig:
    """The rig as it goes on, and what is written of it."""

    def __init__(self, request: Request) -> None:
        if unknown := [name for name in request.tests if name not in TESTS]:
            raise InputError(f"--tests: {', '.join(name or 'nothing' for name in unknown)}: no such test (allowed: {', '.join(TESTS)})")
        self.request, self.program = request, find_program()
        demand_right(self.program, request.case)
        self.tyre: Tyre = read_tyre(request.case)
        self.given: Settings = read_settings(request.rig, self.tyre.wheels)
        self.left_out: Mapping[str, str] = left_out_of(self.tyre.case) if self.tyre.is_plane else {}  # tests that the wheel cannot do, and why
        for name in request.tests:
            if name in self.left_out:
                raise InputError(f"--tests: {name}: {self.left_out[name]} (allowed: "
                                 f"{', '.join(one for one in TESTS if one not in self.left_out)})")
        self.fmu: dict[str, Any] = {}    # what rig.json says of tyre.fmu
        self.known: dict[str, Any] = {}  # tests of the same rig that were done before
        self.blocks: dict[str, list[Block]] = {}
        self.rows: dict[str, list[Row]] = {}
        self.tests: dict[str, dict[str, Any]] = {}
        self.failures: dict[str, str] = {}  # of commands, by block
        self.states = States()
        self.point_s = 0.0  # of the solver, for a point of the reference
        self.disk = 0       # bytes of its results
        self._mesh, mesh_name = read_mesh(self.tyre)
        top = nominal(self.tyre, self.given, request.quick)
        self.bench = Bench(self.tyre, {TOP: top}, mesh_name)

    @property
    def runs(self) -> pathlib.Path:
        return self.request.directory / "runs"

    # What is there already

    def demand_same(self) -> None:
        """Of what rig.json says: the same tyre and settings, unless --overwrite."""
        path = self.request.directory / "rig.json"
        foreign = [name for name in ("run.json", "sweep.json", "paper.json") if (self.request.directory / name).exists()]
        if foreign:
            raise InputError(f"{self.request.directory}: holds {foreign[0]}, and is no directory of a rig; choose another -o")
        if not path.exists():
            return
        try:
            known = read_record(path)
        except Error:
            if not self.request.overwrite:
                raise
            known = {}
        changed = [name for name, value in self._sources().items() if known.get("sources", {}).get(name) != value]
        if not changed and known.get("format") == FORMAT:
            self.known, self.fmu = known.get("tests", {}), known.get("fmu", {})
            return
        if not self.request.overwrite:
            raise InputError(f"{self.request.directory}: holds a rig of another {' and another '.join(changed) or 'format'}; "
                             "choose another -o, or give --overwrite, which runs what has changed")
        self._remove_tables()

    def _remove_tables(self) -> None:
        """Those of another rig."""
        names = [f"{test}{end}" for test in TESTS for end in (".csv", ".tdx")]
        for name in [*names, "tyre.tir", "tyre.fmu", "against.csv", "report.html"]:
            (self.request.directory / name).unlink(missing_ok=True)
        shutil.rmtree(self.request.directory / "figures", ignore_errors=True)

    def _sources(self) -> dict[str, Any]:
        rig = self.request.rig
        return {"case": self.tyre.text, "rig file": rig.read_text() if rig else "", "--quick": self.request.quick}

    def _is_there(self, block: Block) -> bool:
        return bool(self.program.build_id) and block.is_there(self.runs / block.name, self._identity(block))

    def _identity(self, block: Block) -> str:
        return block.identity(self.program.build_id, self._mesh)

    # As it goes on

    def begin(self, stop: Stop) -> None:
        """The reference: radius, cost of a point; then all settings are known."""
        try:
            self.runs.mkdir(parents=True, exist_ok=True)
            if self._mesh:
                (self.runs / self.bench.mesh).write_bytes(self._mesh)
        except OSError as reason:
            raise InputError(f"{self.runs}: cannot be written: {reason.strerror}; choose another -o") from None
        spin = self.tyre.spin if "speed" not in self.bench.top else self.bench.top["speed"] / GUESS
        block = reference(self.bench, spin or 0.0)
        self._run([block], stop, quiet=True)
        if stop.asked:
            return
        if block.name in self.failures:
            said = self.failures[block.name].replace(f"{self.runs}/", "runs/")
            unit = of_width("N", self.bench.per_metre)
            raise Error(f"{self.tyre.path}: the wheel does not roll under its nominal load, {self.bench.top['load']:g} {unit} at {spin or 0.0:g} "
                        f"rad/s: {said}")
        info = read_json(self.runs / block.name / RESULTS / "run.json")
        radius = free_radius(info["steady"], spin or 0.0)
        self.point_s = float(info["solve_wall_s"])
        self.disk = int(sum(path.stat().st_size for path in (self.runs / block.name / RESULTS).iterdir()))
        settings = with_defaults(self.tyre, self.given, self.request.quick, radius)
        self.bench = Bench(self.tyre, settings, self.bench.mesh, radius)
        demand_bearable(self.bench, self.given, self.request.rig, radius - float(info["steady"]["height"]), self.wanted())
        if self.tyre.is_plane and "relaxation" in self.wanted() and "relaxation" not in self.left_out:
            self._prepare_time_steps(stop)

    def _prepare_time_steps(self, stop: Stop) -> None:
        """Damping and time step of the relaxation of a plane wheel. Where they cannot be found, its points cannot begin."""
        mode = self._begun(lowest_mode(self.bench), "its lowest mode", stop)
        if mode is None:
            return
        self.bench = replace(self.bench, settings=with_damping_below(lowest_of(mode), self.bench.settings, self.given, self.request.rig))
        turned = self._begun(stable_step(self.bench), "a run in time", stop)
        if turned is not None:
            self.bench = replace(self.bench, stable_step=float(read_json(turned / "run.json")["step"]))

    def _begun(self, block: Block, what: str, stop: Stop) -> pathlib.Path | None:
        """Its results; None: interrupted, or failed, which is why there is no relaxation."""
        self._run([block], stop, quiet=True)
        if block.name in self.failures:
            self.bench = replace(self.bench, no_steps="; ".join(f"of this wheel {what} fails: {self.failures[block.name]}".splitlines()))
        return None if stop.asked or block.name in self.failures else self.runs / block.name / RESULTS

    def do_tests(self, stop: Stop) -> None:
        wanted = self.wanted()
        if FIRST in wanted:
            others = at_speeds(self.bench, wanted)
            self._do([FIRST], others, stop)
            self.states = states_of(self.rows[FIRST], self._by_speed(others), of_width("N", self.bench.per_metre))
        if stop.asked:  # what other tests begin with is not known
            self.tests |= {name: self.known.get(name, {"status": "unfinished"}) for name in wanted if name not in self.tests}
            self.write()
        else:
            self._do([name for name in wanted if name != FIRST], [], stop)

    def _do(self, tests: Sequence[str], others: Sequence[Block], stop: Stop) -> None:
        blocks = []
        for name in tests:
            why = self.left_out.get(name)
            self.blocks[name] = [] if why else TESTS[name].blocks(self.bench, self.states)
            self.tests[name] = {"status": "left out", "reason": why} if why else {"status": "running"}
            if self.tyre.is_plane and name in NOTES and not why:
                self.tests[name]["note"] = NOTES[name]
            blocks += [block for block in self.blocks[name] if block.points]
        if blocks:
            self._run([*blocks, *others], stop, self.request.quiet)
        for name in tests:
            self._settle(name)

    def _by_speed(self, blocks: Sequence[Block]) -> dict[float, Found]:
        """Height and effective radius, or why there are none."""
        found: dict[float, Found] = {}
        for block in blocks:
            speed = block.points[0].speed
            if self._is_there(block):
                state = read_json(self.runs / block.name / RESULTS / "run.json")["steady"]
                found[speed] = (float(state["height"]), float(state["speed"]) / self.bench.spin(speed))
            elif block.name in self.failures:
                found[speed] = self.failures[block.name]
        return found

    def wanted(self) -> list[str]:
        """The tests asked for, and that with which they begin."""
        asked = [name for name in TESTS if name in (self.request.tests or TESTS)]
        needs = self.request.fmu or any(map(self._begins_with_states, asked))
        return [FIRST, *asked] if needs and FIRST not in asked else asked

    @staticmethod
    def _begins_with_states(name: str) -> bool:
        return name not in (FIRST, "modes")

    def _run(self, blocks: Sequence[Block], stop: Stop, quiet: bool) -> None:
        jobs, of = [], {}
        for block in blocks:
            job = self._job(block)
            of[job.name] = block
            jobs.append(job)
        waiting = [job for job in jobs if job.status == "waiting"]
        if kept := len(jobs) - len(waiting):
            _say(quiet, f"info: {kept} of {len(jobs)} parts are there already and kept")
        weights = {job.name: cost_of(of[job.name], self.point_s) for job in waiting}
        progress = Progress(len(waiting), quiet, weights)

        def ended(job: Job) -> None:
            progress.ended(job)
            block = of[job.name]
            if job.status == "done":
                replace_text(self.runs / block.name / MADE_OF, self._identity(block))
            elif job.status == "failed":
                self.failures[block.name] = job.message
            self._settle(block.test)

        waiting.sort(key=lambda job: -weights[job.name])
        try:
            run_jobs(self.program, waiting, self.request.jobs or processors(), stop, ended, progress.watch)
        finally:
            progress.close()

    def _job(self, block: Block) -> Job:
        folder = self.runs / block.name

        def accepts(code: int) -> str | None:
            if code != NUMERICAL or block.kind != SWEEP or not (folder / RESULTS / "sweep.json").exists():
                return None
            return "some points failed"

        job = Job(block.name, block.arguments(folder), before=lambda: block.write(folder), accepts=accepts)
        if self._is_there(block):
            job.kept, job.status = True, "done"
        return job

    def _make_fmu(self, stop: Stop) -> None:
        """DIR/tyre.fmu, or why there is none."""
        file = self.request.directory / "tyre.fmu"
        try:
            block = fmu(self.bench, self.states)
            self._run([block], stop, self.request.quiet)
            if stop.asked:
                return
            if block.name in self.failures:
                raise Error(self.failures[block.name])
            shutil.copyfile(self.runs / block.name / f"{RESULTS}.fmu", file)
            self.fmu = {"status": DONE} | ({"note": fmu_note(self.bench.top.get("width"))} if self.tyre.is_plane else {})
        except (Error, OSError) as reason:
            file.unlink(missing_ok=True)
            self.fmu = {"status": FAILED, "reason": "; ".join(str(reason).splitlines())}
        self.write()

    # What is written

    def _settle(self, name: str) -> None:
        """The table of a test, and rig.json."""
        if name not in self.blocks:
            return
        begun = [block for block in self.blocks[name] if self._has_ended(block)]
        rows = [row for block in begun
                for row in rows_of_block(self.bench, self.states, block, self.runs, self.failures.get(block.name, ""))]
        self.rows[name] = rows
        told = self.tests[name]
        if self.blocks[name]:
            failed = sum(row["status"] == FAILED for row in rows)
            told |= {"status": "finished" if len(begun) == len(self.blocks[name]) else "unfinished",
                     "points": sum(block.count for block in self.blocks[name]), "failed": failed}
            if rows and failed == len(rows):
                told["status"] = "failed"
            told["csv"] = write_table(self.request.directory, name, rows, self.bench)
            told["tdx"] = write_channels(self.request.directory, name, rows, self.bench)
            told["figures"] = find(self.bench, name, rows)
            told |= {"doubt": doubt} if (doubt := doubt_of(name, rows)) else {}
        self.write()

    def _has_ended(self, block: Block) -> bool:
        return not block.points or self._is_there(block) or block.name in self.failures

    def write(self) -> None:
        settings, found = self.bench.settings, self.known | self.tests
        write_json(self.request.directory / "rig.json", {
            "format": FORMAT, "schema": 1, "title": self.tyre.title, "case": self.tyre.path.name,
            "version": self.program.version, "build_id": self.program.build_id, "quick": self.request.quick,
            "radius": self.bench.radius, **self._wheel(found), **({"fmu": self.fmu} if self.fmu else {}),
            "settings": {**settings[TOP], **{k: v for k, v in settings.items() if k != TOP}},
            "tests": {name: found[name] for name in TESTS if name in found}, "sources": self._sources()})

    def _wheel(self, tests: Mapping[str, Any]) -> dict[str, Any]:
        """What the forces of the wheel are, and the units of all columns and figures of merit."""
        plane, per_metre = self.tyre.is_plane, self.bench.per_metre
        columns = [name for test in tests if test not in self.left_out for name in TESTS[test].columns_of(plane)]
        figures = [name for told in tests.values() for name in told.get("figures", {})]
        wheel = {"plane": self.tyre.plane_kind, "width": self.bench.top.get("width")} if plane else {}
        return {"wheel": wheel, "units": units_of(columns, figures, per_metre)}

    def end(self, stop: Stop) -> int:
        if stop.asked:
            _say(False, "warning: interrupted; the same command goes on")
            return INTERRUPTED
        from .pages import pages_are_there, write_pages
        if self.request.fmu:
            self._make_fmu(stop)
            if stop.asked:
                return self.end(stop)
        if not pages_are_there(self.request.directory, self.request.against):
            for path in write_pages(self.request.directory, self.request.against):
                _say(self.request.quiet, f"info: {path}")
        failed = [f"{name}: {told.get('failed', 0)} of {told['points']} points failed" for name, told in self.tests.items()
                  if told.get("failed")]
        if self.request.fmu and self.fmu["status"] == FAILED:
            failed.append(f"tyre.fmu: failed: {self.fmu['reason']}")
        for line in failed + [f"{name}: {told['doubt']}" for name, told in self.tests.items() if told.get("doubt")]:
            _say(False, f"warning: {line}")
        return NUMERICAL if failed else 0


def _say(quiet: bool, text: str) -> None:
    if not quiet:
        print(f"rondo: {text}", file=sys.stderr, flush=True)

# SPDX-License-Identifier: BSD-3-Clause
"""rondo paper: the study of the paper, its runs and decompositions, several at once,
into one directory, and the table of ours against expected (docs/paper.md, docs/results.md)."""
from __future__ import annotations

import json
import math
import os
import pathlib
import shlex
import socket
import sys
import time
from dataclasses import dataclass, field
from typing import Any

from ..data.errors import Error
from ..data.files import read_json
from .jobs import FILES, INTERRUPTED, NUMERICAL, Job, Stop, processors, run_jobs
from .lock import FilesError, Lock
from .paper_kept import has_ended, identity, pod_is_there, remove_unfinished, run_is_there
from .paper_plan import Plan, PlannedPod, PlannedRun, read_plan, study_folder
from .paper_table import Row, make_table, table_text
from .program import Program, find_program
from .progress import Progress

FORMAT = "rondo paper 1"


@dataclass(frozen=True)
class Request:
    directory: pathlib.Path
    quick: bool = False
    jobs: int = 0            # at once; 0: as many as there are cores
    overwrite: bool = False  # do again what is there
    quiet: bool = False
    study: pathlib.Path = field(default_factory=study_folder)  # the folder of study.toml


def run_paper(request: Request) -> int:
    """What is complete in the directory, of the same program and the same cases, is kept: a study
    that was killed goes on where it was. Returns the exit code."""
    plan = read_plan(request.study, request.quick)
    program = find_program()
    known = _prepare(request, plan)
    with Lock(request.directory):
        study = _Study(request, plan, program, known)
        study.write("running")
        try:
            with Stop() as stop:
                study.do_jobs(stop)
            study.judge()
        except (OSError, Error) as reason:
            study.message = str(reason)
            study.write("failed")
            raise FilesError(study.message) from None
        study.write(study.status)
    return study.tell()


def _refuse(directory: pathlib.Path, what: str, advice: str = "choose another -o") -> Error:
    return Error(f"{directory}: {what}; {advice}")


def _prepare(request: Request, plan: Plan) -> dict[str, Any]:
    """A directory that holds no study, or one of the same kind, which goes on. Nothing is made
    before it is known to be right. Returns the identities of the runs on record."""
    directory, known = request.directory, {}
    if directory.exists() and not directory.is_dir():
        raise _refuse(directory, "is there and is not a directory")
    runs = directory / "runs"
    foreign = [path.name for path in (runs.iterdir() if runs.is_dir() else ())
               if path.name not in {run.name for run in plan.runs}]
    if (directory / "paper.json").exists():
        known = _known(request)
    elif (directory / "run.json").exists():
        raise _refuse(directory, "holds a run, not a study")
    elif foreign:
        raise _refuse(directory, f"holds runs/{foreign[0]}, which is not of this study")
    try:
        runs.mkdir(parents=True, exist_ok=True)
    except OSError as reason:
        raise FilesError(f"{runs}: cannot create directory: {reason.strerror}; choose another -o") \
            from None
    return known


def _known(request: Request) -> dict[str, Any]:
    """What paper.json says of its study; with `overwrite` it may say anything."""
    if request.overwrite:
        return {}
    try:
        info = read_json(request.directory / "paper.json")
    except Error as reason:
        raise FilesError(f"{reason}: --overwrite makes the study anew") from None
    if info.get("format") != FORMAT:
        raise _refuse(request.directory, f"holds a study of format \"{info.get('format')}\", not "
                                         f'"{FORMAT}"')
    if info.get("quick") != request.quick:
        kind = "the quick study" if info.get("quick") else "the study in full"
        raise _refuse(request.directory, f"holds {kind}", "choose another -o, or give --overwrite")
    runs = info.get("runs")
    return {run["name"]: run.get("identity") for run in (runs if isinstance(runs, list) else [])
            if isinstance(run, dict) and "name" in run}


class _Study:
    """The study as it goes on, and what is written of it."""

    def __init__(self, request: Request, plan: Plan, program: Program,
                 known: dict[str, Any]) -> None:
        self.request, self.plan, self.program = request, plan, program
        self.status, self.code, self.message = "running", 0, ""
        self.table: list[Row] = []
        self._begin = time.monotonic()
        self.identities: dict[str, str] = {}
        self.runs = {run.name: self._run_job(run, known.get(run.name)) for run in plan.runs}
        self.pods = [self._pod_job(pod) for pod in plan.pods]

    @property
    def jobs(self) -> list[Job]:
        return [*self.runs.values(), *self.pods]

    def _directory(self, run: str) -> pathlib.Path:
        return self.request.directory / "runs" / run

    # What is to be done

    def _run_job(self, run: PlannedRun, known: object) -> Job:
        directory = self._directory(run.name)

        def accepts(code: int) -> str | None:
            if code != NUMERICAL or not run.may_fail:
                return None
            info = read_json(directory / "run.json")
            ended = has_ended(info, run)
            return f"failed, as it should: {info.get('message')}" if ended else None

        arguments = ["run", str(run.case), "-o", str(directory), "--overwrite", "--quiet",
                     "--threads", "1"]
        for setting in run.settings:
            arguments += ["--set", setting]
        job = Job(run.name, arguments, before=lambda: remove_unfinished(directory),
                  accepts=accepts)
        if not self.request.overwrite and run_is_there(directory, run, self.program, known):
            job.kept, job.status = True, "done"
            self.identities[run.name] = str(known)
            if read_json(directory / "run.json")["status"] == "failed":
                job.code, job.message = NUMERICAL, accepts(NUMERICAL) or ""
        return job

    def _pod_job(self, pod: PlannedPod) -> Job:
        after, run = self.runs[pod.run], self._directory(pod.run)
        frame = "co-rotating" if pod.frame == "rotating" else pod.frame
        arguments = ["pod", str(run), "--field", pod.field, "--frame", frame, "--modes",
                     str(self.plan.modes), "--reconstruct", "0", "--quiet"]
        job = Job(f"{pod.run} {pod.name}", arguments, after,
                  before=lambda: remove_unfinished(run / "pod" / pod.name))
        # A run made again takes its PODs with it.
        if after.kept and pod_is_there(run, pod, self.plan.modes, self.program):
            job.kept, job.status = True, "done"
        return job

    # As it goes on

    def do_jobs(self, stop: Stop) -> None:
        waiting = [job for job in self.jobs if job.status == "waiting"]
        kept = len(self.jobs) - len(waiting)
        if kept and not self.request.quiet:
            _say(f"info: {kept} of {len(self.jobs)} jobs are there already and kept")
        progress = Progress(len(waiting), self.request.quiet)

        def ended(job: Job) -> None:
            progress.ended(job)
            for run in self.plan.runs:
                if run.name == job.name and job.status == "done":
                    self.identities[run.name] = identity(self._directory(run.name), run)
            self.write("running")

        at_once = self.request.jobs or processors()
        try:
            run_jobs(self.program, waiting, at_once, stop, ended, progress.watch)
        finally:
            progress.close()

    def judge(self) -> None:
        """How the jobs ended, and the table once all are done."""
        failed = [job for job in self.jobs if job.status == "failed"]
        if failed:
            self.status, self.code = "failed", failed[0].code
            self.message = f"{failed[0].name}: {failed[0].message}"
        elif any(job.status == "interrupted" for job in self.jobs):
            self.status, self.code = "interrupted", INTERRUPTED
        else:
            self.table = make_table(self.request.directory, self.plan)
            wrong = sum(not row["pass"] for row in self.table)
            self.status, self.code = ("failed", NUMERICAL) if wrong else ("done", 0)
            if wrong:
                self.message = f"{wrong} of {len(self.table)} rows of the table are not as expected"

    def write(self, status: str) -> None:
        """paper.json, whole or not at all."""
        path = self.request.directory / "paper.json"
        beside = path.with_name(f"paper.json.{os.getpid()}.tmp")
        try:
            beside.write_text(json.dumps(_plain(self._record(status)), indent=2,
                                         ensure_ascii=False) + "\n")
            beside.replace(path)
        except OSError as reason:
            beside.unlink(missing_ok=True)
            raise FilesError(f"{path}: cannot be written: {reason.strerror}") from None

    def _record(self, status: str) -> dict[str, Any]:
        passed = sum(row["pass"] for row in self.table)
        message = {"message": self.message} if self.message else {}
        return {"format": FORMAT, "status": status, **message, "quick": self.request.quick,
                "version": self.program.version, "build": self.program.build,
                "build_id": self.program.build_id, "host": socket.gethostname(),
                "wall_s": time.monotonic() - self._begin,
                "runs": [self._run_entry(run) for run in self.plan.runs],
                "pods": [self._pod_entry(pod, job) for pod, job in zip(self.plan.pods, self.pods)],
                "table": self.table, "passed": passed, "failed": len(self.table) - passed}

    def _run_entry(self, run: PlannedRun) -> dict[str, Any]:
        command = ["rondo", "run", _readable(run.case), "-o", str(self._directory(run.name))]
        for setting in run.settings:
            command += ["--set", setting]
        return {"name": run.name, "directory": f"runs/{run.name}", "command": shlex.join(command),
                "identity": self.identities.get(run.name), **_outcome(self.runs[run.name])}

    def _pod_entry(self, pod: PlannedPod, job: Job) -> dict[str, Any]:
        command = ["rondo", *job.arguments[:-1]]  # without --quiet
        return {"run": pod.run, "field": pod.field, "frame": pod.frame,
                "directory": f"runs/{pod.run}/pod/{pod.name}", "command": shlex.join(command),
                **_outcome(job)}

    def tell(self) -> int:
        """What came of it, on stdout and stderr; the exit code."""
        directory, jobs = self.request.directory, self.jobs
        if self.status == "interrupted":
            done = sum(job.status == "done" for job in jobs)
            _say(f"warning: interrupted with {done} of {len(jobs)} jobs done; the same command "
                 "goes on")
        elif not self.table:
            _say(f"error: {self.message}; what is done stays in {directory}, and the same command "
                 "goes on")
        else:
            print(table_text(self.table))
            passed = sum(row["pass"] for row in self.table)
            print(f"\n{passed} of {len(self.table)} as expected, in "
                  f"{time.monotonic() - self._begin:.1f} s; data and paper.json in {directory}\n"
                  f"figures: rondo figures {directory}")
            if self.message:
                _say(f"error: {self.message}")
        return self.code


def _outcome(job: Job) -> dict[str, Any]:
    """A run that may fail is done as a job, and has failed as a run."""
    status = {"running": "waiting"}.get(job.status, job.status)
    message = {"message": job.message} if job.message else {}
    return {"status": "failed" if status == "done" and job.code else status, **message,
            "kept": job.kept, "wall_s": job.wall_s}


def _readable(case: pathlib.Path) -> str:
    """From here, if it is below."""
    here = pathlib.Path.cwd()
    return str(case.relative_to(here) if case.is_relative_to(here) else case)


def _plain(value: Any) -> Any:
    """JSON has no number that is not finite: null."""
    if isinstance(value, dict):
        return {key: _plain(part) for key, part in value.items()}
    if isinstance(value, list):
        return [_plain(part) for part in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _say(text: str) -> None:
    print(f"rondo: {text}", file=sys.stderr)


def command(directory: pathlib.Path | None, quick: bool, jobs: int | None, overwrite: bool,
            quiet: bool, study: pathlib.Path | None) -> int:
    """rondo paper"""
    where = directory or pathlib.Path("paper-quick" if quick else "paper")
    try:
        return run_paper(Request(where, quick, jobs or 0, overwrite, quiet,
                                 study or study_folder()))
    except FilesError as reason:
        _say(f"error: {reason}")
        return FILES

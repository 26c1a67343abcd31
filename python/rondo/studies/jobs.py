# SPDX-License-Identifier: BSD-3-Clause
"""Commands of the program rondo, several at once, some after others."""
from __future__ import annotations

import os
import signal
import subprocess
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import IO

from ..data.errors import Error
from .program import Program, start

INTERRUPTED, NUMERICAL, FILES = 130, 3, 4  # exit codes, as the program's
_PERIOD = 0.02  # s, between two looks at what runs


@dataclass
class Job:
    """A command. status: "waiting", "running", "done", "failed" or "interrupted"."""

    name: str
    arguments: list[str]
    after: Job | None = None
    before: Callable[[], None] = lambda: None  # called as it starts
    # What a code other than 0 means that is no failure of the job: a text to go with "done".
    accepts: Callable[[int], str | None] = lambda code: None
    status: str = "waiting"
    code: int = 0
    message: str = ""
    kept: bool = False  # it was done already
    wall_s: float = 0.0


@dataclass
class _Process:
    job: Job
    process: subprocess.Popen[str]
    errors: IO[str]
    begin: float = field(default_factory=time.monotonic)


class Stop:
    """Set by SIGINT, SIGTERM and SIGHUP as long as it is entered. What is ignored from the start
    (nohup) stays so."""

    def __init__(self) -> None:
        self.asked = False
        self._before: dict[int, object] = {}

    def __enter__(self) -> Stop:
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            if signal.getsignal(number) != signal.SIG_IGN:
                self._before[number] = signal.signal(number, self._ask)
        return self

    def __exit__(self, *_: object) -> None:
        for number, handler in self._before.items():
            signal.signal(number, handler)  # type: ignore[arg-type]

    def _ask(self, *_: object) -> None:
        self.asked = True


def processors() -> int:
    """As many as this process may use: the library knows of quotas, too, where it is built."""
    from ..native import core  # which imports modules of this folder
    try:
        return int(core().allowed_processors())
    except Error:
        return len(os.sched_getaffinity(0))


def run_jobs(program: Program, jobs: Sequence[Job], at_once: int, stop: Stop,
             ended: Callable[[Job], None], watch: Callable[[Sequence[Job]], None]) -> None:
    """Does the jobs that wait, in their order as far as they may. One whose predecessor failed
    fails without a start. A failure stops nothing else. `ended` is called with each as it ends,
    `watch` now and then with those that run."""
    running: list[_Process] = []
    told = False
    try:
        while True:
            if stop.asked and not told:
                told = True
                for one in running:
                    one.process.terminate()
            _refuse(jobs, told, ended)
            for job in jobs:
                if len(running) < at_once and not told and _may_start(job):
                    running.append(_started(program, job))
            if not running:
                return
            watch([one.job for one in running])
            time.sleep(_PERIOD)
            for one in [one for one in running if one.process.poll() is not None]:
                running.remove(one)
                _finish(one, told)
                ended(one.job)
    finally:
        for one in running:  # an exception: nothing is left behind
            one.process.terminate()
            one.process.wait()


def _may_start(job: Job) -> bool:
    return job.status == "waiting" and (job.after is None or job.after.status == "done")


def _refuse(jobs: Sequence[Job], stopped: bool, ended: Callable[[Job], None]) -> None:
    """Ends the jobs that will never start. Predecessors stand before."""
    for job in jobs:
        if job.status != "waiting":
            continue
        if job.after is not None and job.after.status == "failed":
            job.status, job.code = "failed", job.after.code
            job.message = f"not started: {job.after.name}, which it needs, failed"
        elif stopped:
            job.status, job.code, job.message = "interrupted", INTERRUPTED, "not started"
        else:
            continue
        ended(job)


def _started(program: Program, job: Job) -> _Process:
    job.before()
    errors = tempfile.TemporaryFile("w+", errors="replace")
    process = start(program, job.arguments, errors)
    job.status = "running"
    return _Process(job, process, errors)


def _finish(one: _Process, stopped: bool) -> None:
    job, code = one.job, one.process.returncode
    job.wall_s = time.monotonic() - one.begin
    one.errors.seek(0)
    said = one.errors.read()
    one.errors.close()
    accepted = job.accepts(code) if code else ""
    if accepted is not None:
        job.status, job.code, job.message = "done", code, accepted
    elif code == INTERRUPTED or (stopped and code < 0):
        job.status, job.code = "interrupted", INTERRUPTED
    elif code < 0:
        job.status, job.code = "failed", FILES if code == -signal.SIGKILL else NUMERICAL
        job.message = f"killed by signal {-code} ({signal.strsignal(-code)})"
    else:
        job.status, job.code, job.message = "failed", code, _reason(said)


def _reason(said: str) -> str:
    """The errors among what a command wrote to stderr; all of it where there are none."""
    mark = "rondo: error: "
    lines = [line.partition(mark)[2] for line in said.splitlines() if mark in line]
    return "\n".join(lines) or said.strip() or "it says nothing"

# SPDX-License-Identifier: BSD-3-Clause
"""Which runs and PODs of a study are there already: complete, of the very same program and the same
case. What cannot be read is not there."""
from __future__ import annotations

import hashlib
import pathlib
import shutil
from typing import Any

from ..data.errors import Error
from ..data.files import read_json
from ..data.plain_files import text_of
from ..data.pod import open_pod
from ..data.run import open_run
from .paper_plan import PlannedPod, PlannedRun
from .program import Program


def identity(directory: pathlib.Path, run: PlannedRun) -> str:
    """Of the case that is asked for and of the one that was kept beside its results."""
    asked = [text_of(run.case), *run.settings]
    try:
        asked.append(text_of(directory / "case.toml"))
    except (Error, ValueError):
        return ""
    return hashlib.sha256("\0".join(asked).encode()).hexdigest()


def run_is_there(directory: pathlib.Path, run: PlannedRun, program: Program,
                 known: object) -> bool:
    """@param known: the identity on record."""
    try:
        info = read_json(directory / "run.json")
        return (bool(program.build_id) and info.get("build_id") == program.build_id
                and bool(known) and known == identity(directory, run)
                and has_ended(info, run) and _is_whole(directory, info))
    except (Error, OSError, KeyError, TypeError, ValueError, IndexError):
        return False


def has_ended(info: dict[str, Any], run: PlannedRun) -> bool:
    """A run that may fail did so by itself, at a step: not for want of space on the disk."""
    failed = run.may_fail and info["status"] == "failed"
    return info["status"] == "done" or (failed and
                                        ("steps_done" in info or "increments_done" in info))


def _is_whole(directory: pathlib.Path, info: dict[str, Any]) -> bool:
    """The files hold what run.json says, as far as their ends and heads tell."""
    run = open_run(directory, unfinished=True)
    if info["status"] != "done":
        run.history.check_end(info["end_time"])
    if info.get("solver") == "latin-pgd" and not run.pod("displacement", "pgd").n_modes:
        return False
    return (len(run.history["time_s"]) > 0 and run.n_snapshots == info["snapshots"]
            and (run.n_snapshots == 0 or (directory / "fields.xdmf").is_file()))


def pod_is_there(run: pathlib.Path, pod: PlannedPod, modes: int, program: Program) -> bool:
    """What a POD of the study has, and of all snapshots of its run."""
    try:
        directory = run / "pod" / pod.name
        found = open_pod(directory)
        info = found.info
        return (info["build_id"] == program.build_id and info["status"] == "done"
                and (found.field, found.frame) == (pod.field, pod.frame)
                and found.weight == ("delassus" if pod.field == "contact" else "mass")
                and info.get("shift", "") == ("fourier" if pod.frame == "rectified" else "")
                and info["snapshots"] == read_json(run / "run.json")["snapshots"]
                and info["modes_kept"] in (modes, info["rank"])
                and text_of(directory / "spectrum.csv").count("\n") > 1)
    except (Error, OSError, KeyError, TypeError, ValueError):
        return False


def remove_unfinished(directory: pathlib.Path) -> None:
    """What a program left that was killed while it wrote."""
    for left in [*directory.glob("*.tmp"), *directory.glob(".*.tmp")]:
        if left.is_dir():
            shutil.rmtree(left, ignore_errors=True)
        else:
            left.unlink(missing_ok=True)

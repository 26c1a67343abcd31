# SPDX-License-Identifier: BSD-3-Clause
"""What a study computes and expects: studies/paper/study.toml."""
from __future__ import annotations

import math
import pathlib
import tomllib
from dataclasses import dataclass
from typing import Any

from ..data.errors import Error
from ..data.plain_files import text_of
from .program import CHECKOUT

SHIPPED = pathlib.Path(__file__).resolve().parents[1] / "shipped"  # in an installed package


@dataclass(frozen=True)
class PlannedRun:
    name: str            # its directory is runs/<name>
    case: pathlib.Path
    settings: list[str]  # "a.b=value" on top of it
    may_fail: bool       # by its numbers: that is the point


@dataclass(frozen=True)
class PlannedPod:
    run: str
    field: str
    frame: str

    @property
    def name(self) -> str:
        return f"{self.field}-{self.frame}"


@dataclass(frozen=True)
class Plan:
    runs: list[PlannedRun]
    pods: list[PlannedPod]
    modes: int                  # kept of each POD
    rows: list[dict[str, Any]]  # of the table, as in the file
    path: pathlib.Path          # the file


def study_folder() -> pathlib.Path:
    """studies/paper of the checkout; of an installed package what was shipped with it."""
    found = CHECKOUT / "studies" / "paper"
    return found if (found / "study.toml").is_file() else SHIPPED / "studies" / "paper"


def read_plan(folder: pathlib.Path, quick: bool) -> Plan:
    path = folder / "study.toml"
    try:
        study = tomllib.loads(text_of(path))
    except (Error, ValueError) as reason:
        raise Error(f"{path}: cannot be read: {reason}; --study names the folder of a study.toml") \
            from None
    try:
        return _plan(folder, study, quick)
    except (KeyError, TypeError, AttributeError) as reason:
        raise Error(f"{path}: is not the plan of a study: {reason!r}") from None


def _plan(folder: pathlib.Path, study: dict[str, Any], quick: bool) -> Plan:
    kind = "quick" if quick else "full"
    runs = [PlannedRun(run["name"], (folder / run["case"]).resolve(),
                       [*run.get("set", []), *run.get(kind, [])], run.get("may_fail", False))
            for run in study["run"]]
    frames = study["pod"]["frames"]
    pods = [PlannedPod(run, field, frame) for run in frames for field in study["pod"]["fields"]
            for frame in frames[run]]
    rows = _counts(study["counts"]) + study["row"]
    rows = [{**row, **row.get("quick", {})} if quick else row for row in rows
            if not (quick and row.get("full_only"))]
    return Plan(runs, pods, int(study["pod"]["modes"]), sorted(rows, key=lambda row: row["figure"]),
                folder / "study.toml")


def _counts(counts: dict[str, Any]) -> list[dict[str, Any]]:
    """Rows of numbers of modes: ± 1 below ten, ± 10 % above."""
    return [{"figure": counts["figure"], "name": f"{of['run']}-{of['pod']}-{share}",
             "quantity": f"modes for {share}, {of['run']}, {of['pod']}", "unit": "1",
             "ours": ["modes_for", share, of["run"], of["pod"]], "within": float(number),
             "tolerance": 1.0 if number < 10 else math.ceil(0.1 * number),
             "source": counts["source"], "full_only": True}
            for of in counts["of"] for share, number in zip(counts["shares"], of["modes"])]

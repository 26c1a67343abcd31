# SPDX-License-Identifier: BSD-3-Clause
"""A paper study: the directory that `rondo paper` writes."""
from __future__ import annotations

import os
import pathlib
from collections.abc import Callable
from typing import Any

from .errors import Error, UnfinishedRunError, unknown
from .files import check_format, read_json, require
from .pod import Pod
from .run import Run, open_run


def open_paper(path: str | os.PathLike[str], unfinished: bool = False) -> Paper:
    """Opens the directory of a paper study. `unfinished`: also one that has not come to its table,
    which is made last; what is done of it is read."""
    paper = Paper(require(path, "paper.json"))
    if paper.status != "done" and not paper.table and not unfinished:
        parts = [part.get("status") for part in (*paper._runs.values(), *paper._pods)]
        failed = f", {parts.count('failed')} have failed" if "failed" in parts else ""
        quick = " --quick" if paper.quick else ""
        raise UnfinishedRunError(
            f'{paper.directory}: a study of status "{paper.status}", without its table: '
            f"{parts.count('done')} of {len(parts)} parts are done{failed}. "
            f'"rondo paper -o {paper.directory}{quick}" goes on with it; '
            f'rondo.open_paper("{paper.directory}", unfinished=True) reads what is there')
    return paper


class Paper:
    """directory; info: paper.json; table: list of rows, our figures against those expected."""

    report: Callable[..., pathlib.Path]  # rondo/pictures.py gives it

    def __init__(self, directory: pathlib.Path) -> None:
        self.directory = directory
        path = directory / "paper.json"
        self.info: dict[str, Any] = read_json(path)
        check_format(path, "paper", self.info.get("format"))
        try:
            self.status = str(self.info["status"])
            self.quick = bool(self.info["quick"])
            self.table: list[dict[str, Any]] = list(self.info["table"])
            self._rows = {row["name"]: row for row in self.table}
            self._runs = {run["name"]: run for run in self.info["runs"]}
            self._pods = list(self.info["pods"])
        except (KeyError, TypeError) as reason:
            raise Error(f"{path}: damaged: {reason!r}") from None
        self._opened: dict[str, Run] = {}

    def __repr__(self) -> str:
        return (f"Paper({self.directory}: {self.status}, {len(self._runs)} runs, "
                f"{len(self.table)} figures{', quick' if self.quick else ''})")

    @property
    def run_names(self) -> list[str]:
        return list(self._runs)

    def row(self, name: str) -> dict[str, Any]:
        """A row of the table."""
        if name not in self._rows:
            raise unknown(self.directory, "row of the table", name, self._rows)
        return self._rows[name]

    def run(self, name: str) -> Run:
        """A run of the study. One that paper.json itself calls failed is opened as well: the study
        has runs that are to fail."""
        if name not in self._runs:
            raise unknown(self.directory, "run", name, self._runs)
        if name not in self._opened:
            entry = self._runs[name]
            self._opened[name] = open_run(self.directory / entry["directory"],
                                          unfinished=entry.get("status") == "failed")
        return self._opened[name]

    def pod(self, run: str, field: str, frame: str = "co-rotating") -> Pod:
        """A POD of a run of the study."""
        return self.run(run).pod(field, frame)

# SPDX-License-Identifier: BSD-3-Clause
"""The runs behind the points of a rig, for figures of what no table has: pressures, courses in time."""
from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from ...data.errors import Error
from ...data.run import open_run
from ..points import Columns, chosen, points, texts

if TYPE_CHECKING:
    from ...data.rig import Rig
    from ...data.run import Run


class Missing:
    """Counts the runs that cannot be read, and keeps the first reason: results that were moved or deleted must not keep
    the rest of a page from being drawn."""

    def __init__(self) -> None:
        self.count, self.reason = 0, ""

    @property
    def words(self) -> str:
        if not self.count:
            return ""
        number = "One run is" if self.count == 1 else f"{self.count} runs are"
        return f" {number} not drawn: {self.reason}."

    def note(self, reason: object) -> None:
        self.count, self.reason = self.count + 1, self.reason or str(reason).rstrip(".")


def with_runs(rig: Rig, test: str, names: tuple[str, ...]) -> tuple[Columns, list[str]]:
    """The points of a test that have a run, and its folder; "row": their numbers among all that are done."""
    found, folders = points(rig, test, names), texts(rig, test, "run")
    there = np.array([k for k, folder in enumerate(folders) if folder], dtype=int)
    return chosen(found, there) | {"row": there.astype(float)}, [folders[k] for k in there]


def opened(rig: Rig, folder: str, missing: Missing) -> Iterator[Run]:
    """The run, or nothing."""
    try:
        yield open_run(rig.directory / folder)
    except Error as reason:
        missing.note(str(reason).replace(f"{rig.directory}/", ""))

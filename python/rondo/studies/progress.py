# SPDX-License-Identifier: BSD-3-Clause
"""Progress of jobs on stderr: on a terminal one line with a bar, elsewhere a line as each ends.
Failures are printed always."""
from __future__ import annotations

import shutil
import sys
import time
from collections.abc import Mapping, Sequence

from .jobs import Job

_BAR = 20  # characters


def readable_time(seconds: float) -> str:
    """42 s, 3 min 20 s, 1 h 05 min"""
    s = round(seconds)
    if s < 60:
        return f"{s} s"
    if s < 3600:
        return f"{s // 60} min {s % 60:02} s"
    return f"{s // 3600} h {s % 3600 // 60:02} min"


def ended_line(ended: int, total: int, job: Job) -> str:
    """ " 3 of 35  turn-smooth: done in 1.4 s"; lines of a message beyond the first are indented."""
    text = f"{ended:{len(str(total))}} of {total}  {job.name}: "
    if job.status == "done":
        text += f"done in {job.wall_s:.1f} s"
    else:
        text += job.status + (f" after {job.wall_s:.1f} s" if job.wall_s > 0 else "")
    return text + (": " + job.message.replace("\n", "\n    ") if job.message else "")


def bar_line(ended: int, total: int, seconds: float, running: Sequence[Job], width: int, left: str = "") -> str:
    """ "[####    ]  8 of 35  3 min 20 s  turn-smooth, turn-treaded", shorter than `width`. `left`: ", 40 s left"."""
    names = ", ".join(job.name for job in running)
    text = (f"[{'#' * (_BAR * ended // total):{_BAR}}] {ended} of {total}  "
            f"{readable_time(seconds)}{left}  {names}")
    return text[:max(width - 1, 1)]  # some terminals go to the next line once the last is written


class Progress:
    """`weights`: work of the jobs by their names, from which the time left is told; without them it is not."""

    def __init__(self, total: int, quiet: bool, weights: Mapping[str, float] | None = None) -> None:
        self._total, self._quiet, self._weights = total, quiet, dict(weights or {})
        self._whole, self._done = sum(self._weights.values()), 0.0
        self._terminal = sys.stderr.isatty()
        self._ended, self._open, self._begin = 0, False, time.monotonic()

    def ended(self, job: Job) -> None:
        self._ended += 1
        self._done += self._weights.get(job.name, 0.0)
        failed = job.status == "failed"
        if failed or not (self._quiet or self._terminal):
            self._print(("\r\033[K" if self._open else "")
                        + ended_line(self._ended, self._total, job) + self._left() + "\n")
            self._open = False

    def watch(self, running: Sequence[Job]) -> None:
        if not self._terminal or self._quiet:
            return
        width = shutil.get_terminal_size().columns
        bar = bar_line(self._ended, self._total, time.monotonic() - self._begin, running, width, self._left())
        self._print(f"\r{bar}\033[K")
        self._open = True

    def _left(self) -> str:
        """By the work that is done in the time until now."""
        if not 0.0 < self._done < self._whole:
            return ""
        seconds = (time.monotonic() - self._begin) * (self._whole / self._done - 1.0)
        return f", {readable_time(seconds)} left"

    def close(self) -> None:
        if self._open:
            self._print("\n")
            self._open = False

    @staticmethod
    def _print(text: str) -> None:
        try:
            sys.stderr.write(text)
            sys.stderr.flush()
        except OSError:  # a stream that breaks ends no job
            pass

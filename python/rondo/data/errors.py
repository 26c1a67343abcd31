# SPDX-License-Identifier: BSD-3-Clause
"""What can go wrong in reading results. Every error of this package is a rondo.Error."""
from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any


class Error(Exception):
    """What was found, where, and what to do."""


class NotARunError(Error):
    """The directory is no run (or no POD, paper study, sweep)."""


class UnfinishedRunError(Error):
    """The run has not ended, was interrupted or killed, or has failed."""


class NewerSchemaError(Error):
    """The files are of a later version of rondo than this package."""


STATUS = {  # what it means that a run is not done
    "running": "it is still running, or was killed",
    "interrupted": "it was stopped before its end",
    "failed": "it ended with an error",
}


class UnknownNameError(Error, KeyError):
    """No such field, column, run, POD; the message names those that are there."""

    __str__ = Exception.__str__  # KeyError's would put the message in quotes


class InputError(Error, ValueError):
    """A case, a study or a call is wrong. faults: what is wrong, each a dict of "file", "line",
    "column" (0: none), "key", "found", "message" and "allowed"."""

    def __init__(self, text: str, faults: Iterable[Mapping[str, Any]] = ()) -> None:
        super().__init__(text)
        self.faults: list[Mapping[str, Any]] = list(faults)


class FileError(Error, OSError):
    """A file cannot be written or read, or is damaged."""


class NumericalError(Error):
    """The numerics have failed: not finite, or a residual out of bound. What was done before is
    kept."""


def unknown(where: object, what: str, name: object, there: Iterable[str]) -> UnknownNameError:
    """The error of a name that is not among those `there`."""
    return UnknownNameError(f"{where}: no {what} {name!r}; there are: {', '.join(there) or 'none'}")

# SPDX-License-Identifier: BSD-3-Clause
"""What can go wrong in reading results. Every error of this package is a rondo.Error."""
from __future__ import annotations

from collections.abc import Iterable


class Error(Exception):
    """What was found, where, and what to do."""


class NotARunError(Error):
    """The directory is no run (or no POD, paper study, sweep)."""


class UnfinishedRunError(Error):
    """The run has not ended, was interrupted or killed, or has failed."""


class NewerSchemaError(Error):
    """The files are of a later version of rondo than this package."""


class UnknownNameError(Error, KeyError):
    """No such field, column, run, POD; the message names those that are there."""

    __str__ = Exception.__str__  # KeyError's would put the message in quotes


def unknown(where: object, what: str, name: object, there: Iterable[str]) -> UnknownNameError:
    """The error of a name that is not among those `there`."""
    return UnknownNameError(f"{where}: no {what} {name!r}; there are: {', '.join(there) or 'none'}")

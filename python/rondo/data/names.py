# SPDX-License-Identifier: BSD-3-Clause
"""Names of columns, each of which may be asked for without its unit as well, and in a sweep a
result of a crush as that of a run (docs/results.md, Names of columns); names of frames."""
from __future__ import annotations

import sys
import warnings
from collections.abc import Container, Iterator

# Endings of names that are units.
ENDINGS = {"_s": "s", "_m": "m", "_rad": "rad", "_pa": "Pa"}
ALIKE = {"dissipation_impact": "loss_impact"}  # named as that of friction is


FRAME = "co-rotating"
OLDER_FRAMES = ("turning", "rotating")  # as it was called


def find_name(name: str, there: Container[str]) -> str | None:
    """The column that is meant; None where there is none."""
    return next((found for found in _names(name) if found in there), None)


def find_figure(name: str, there: Container[str]) -> str | None:
    """The column of a sweep that is meant: of crushes force_y is force_y_mean too, and the other
    way round. None where there is none."""
    return next((found for names in (_names, _mean_names) for found in names(name)
                 if found in there), None)


def frame_named(frame: str) -> str:
    """With "co-rotating" for what it was called before, which is warned of."""
    if frame not in OLDER_FRAMES:
        return frame
    level, caller = 2, sys._getframe(1)
    while caller.f_back and caller.f_globals.get("__name__", "").startswith("rondo."):
        level, caller = level + 1, caller.f_back  # to the caller of the package
    warnings.warn(f'frame "{frame}" is called "{FRAME}"', DeprecationWarning, level)
    return FRAME


def _names(name: str) -> Iterator[str]:
    yield ALIKE.get(name, name)
    yield from (name + known for known in ENDINGS)


def _mean_names(name: str) -> Iterator[str]:
    stem, ending = name, ""
    for known in ENDINGS:
        if name.endswith(known):
            stem, ending = name.removesuffix(known), known
    other = stem.removesuffix("_mean") if stem.endswith("_mean") else f"{stem}_mean"
    yield other + ending
    if not ending:
        yield from (other + known for known in ENDINGS)

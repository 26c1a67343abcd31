# SPDX-License-Identifier: BSD-3-Clause
"""Names of columns: each may be asked for without its unit as well, and a result of a crush as that
of a run is (docs/results.md, Names of columns)."""
from __future__ import annotations

from collections.abc import Container, Iterator

# Endings of names that are units.
ENDINGS = {"_s": "s", "_m": "m", "_rad": "rad", "_pa": "Pa"}
ALIKE = {"dissipation_impact": "loss_impact"}  # named as that of friction is


def find_name(name: str, there: Container[str]) -> str | None:
    """The column that is meant; None where there is none."""
    return next((found for found in _names(name) if found in there), None)


def _names(name: str) -> Iterator[str]:
    yield ALIKE.get(name, name)
    stem, ending = name, ""
    for known in ENDINGS:
        yield name + known
        if name.endswith(known):
            stem, ending = name.removesuffix(known), known
    other = stem.removesuffix("_mean") if stem.endswith("_mean") else f"{stem}_mean"
    yield other + ending
    if not ending:
        yield from (other + known for known in ENDINGS)

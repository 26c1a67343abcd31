# SPDX-License-Identifier: BSD-3-Clause
"""The points of a rig to which a Magic Formula is fitted: rows of its steady tests in the axes ISO-W."""
from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .points import Array, Columns, chosen, points

if TYPE_CHECKING:
    from ..data.rig import Rig

FORCES = ("Fx", "Fy", "Mx", "Mz")
# The channels that each test gives. The rolling resistance moment is taken from its own test alone: the others roll
# with a damping that is chosen for the solver.
CHANNELS_OF = {"lateral": FORCES, "longitudinal": FORCES, "combined": FORCES, "rolling-resistance": ("My",)}
CHANNELS = ("Fx", "Fy", "Mx", "My", "Mz")
INPUTS = ("slip_angle", "slip_ratio", "camber", "load", "pressure", "speed")


@dataclass(frozen=True)
class Rows:
    """States of the wheel and what was found at them, one row after another."""

    inputs: Columns          # (rows,) of INPUTS
    channels: Columns        # (rows,) of CHANNELS that some test has; NaN: this test does not give it
    tests: NDArray[np.str_]  # (rows,) the test that each row is from

    def __len__(self) -> int:
        return len(self.tests)

    def where(self, mask: NDArray[np.bool_]) -> Rows:
        return Rows(chosen(self.inputs, mask), chosen(self.channels, mask), self.tests[mask])


def rows_of(rig: Rig, tests: Iterable[str] = tuple(CHANNELS_OF)) -> Rows:
    """The points of these tests that are done; none where the rig has not come to them."""
    parts, names = [], []
    for test in tests:
        found = points(rig, test, (*INPUTS, *CHANNELS))
        if test == "lateral":  # rolls freely, which counts as no slip ratio
            found["slip_ratio"] = np.zeros_like(found["slip_ratio"])
        for name in set(CHANNELS) - set(CHANNELS_OF[test]):
            found[name] = np.full_like(found[name], np.nan)
        parts.append(found)
        names += [test] * len(found["load"])

    def joined(name: str) -> Array:
        return np.concatenate([part[name] for part in parts])

    channels = {name: joined(name) for name in CHANNELS}
    return Rows({name: joined(name) for name in INPUTS},
                {name: values for name, values in channels.items() if np.isfinite(values).any()}, np.array(names, str))

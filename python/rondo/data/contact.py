# SPDX-License-Identifier: BSD-3-Clause
"""What a run has of its contact, and of a crush."""
from __future__ import annotations

import pathlib
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from .arrays import LazyArray
from .files import read_table
from .names import ENDINGS
from .tables import frame_of

if TYPE_CHECKING:
    import pandas

UNITS = {"node": "1", "sticks": "1", "slip_speed": "m/s", "friction_power": "W/m2"}  # of columns that do not end in theirs


@dataclass(frozen=True)
class Contact:
    """Contact of t snapshots at nb candidates. Normal is positive in compression; tangential is
    along t = J n, to the left. Of a wheel in three dimensions there is a third component, along t2
    to the right of travel; forces are in N and tributaries areas [m2]."""

    force: LazyArray       # (t, nb, 2) normal, tangential, mean over the step before [N/m]
    traction: LazyArray    # (t, nb, 2) pressure, shear over the deformed boundary [Pa]
    nodes: np.ndarray      # (nb,) candidates, as mesh.boundary
    tributary: np.ndarray  # (nb,) length that each stands for, undeformed [m]
    path: pathlib.Path     # contact.csv

    @cached_property
    def rows(self) -> dict[str, np.ndarray]:
        """contact.csv: a row for each node in contact at each snapshot, by the names of its columns
        (docs/results.md), as "pressure_pa"."""
        return read_table(self.path)

    def to_pandas(self) -> pandas.DataFrame:
        """`rows` as a pandas.DataFrame; attrs["units"] of the columns."""
        units = UNITS | {name: unit for name in self.rows for ending, unit in ENDINGS.items()
                         if name.endswith(ending)}
        return frame_of(self.rows, units, "contact.to_pandas()")


@dataclass(frozen=True)
class Crush:
    """Curves of a quasi-static crush, a row for each of t increments."""

    depth: np.ndarray           # (t,) of the center below first touch [m]
    # (t, 2) of the ground on the body: normal, tangential [N/m]; of a wheel in three dimensions
    # (t, 3): normal, along the heading, to its right [N]
    force: np.ndarray
    contact_length: np.ndarray  # (t,) [m]; of a wheel in three dimensions its area [m2]
    pressure_max: np.ndarray    # (t,) [Pa]

# SPDX-License-Identifier: BSD-3-Clause
"""What `rondo modes` wrote: frequencies over the spin."""
from __future__ import annotations

import csv
import os
import pathlib
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from . import files
from .errors import Error

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Branch:
    """One wave over the spin: `order` counts those of the same n and sense, from 1."""

    diameters: int  # -1: not known, off disks
    wave: str  # "backward", "forward", "standing", "rigid"; "" off disks
    order: int
    spin: Array  # (k,) rad/s, ascending, > 0 rolls towards +x
    frequency: Array  # (k,) rad/s, in the co-rotating frame
    frequency_fixed: Array  # (k,) rad/s, in the fixed frame; NaN off disks


class Modes:
    """A directory of `rondo modes`."""

    # Pictures: what rondo/pictures.py gives this class, as nothing here knows how to draw.
    plot_campbell: Callable[..., Figure]

    def __init__(self, directory: pathlib.Path) -> None:
        self.directory = directory
        self.summary = files.read_json(directory / "modes.json")
        path = directory / "campbell.csv"
        if not path.is_file():
            raise Error(f"{directory}: has no campbell.csv: the modes of one spin only; "
                        "rondo modes --spins FROM:TO:NUMBER writes it")
        self.branches = _branches(path)

    @property
    def spins(self) -> Array:
        """(k,) rad/s, ascending: all for which there is a frequency."""
        return np.unique(np.concatenate([b.spin for b in self.branches]))


def _branches(path: pathlib.Path) -> list[Branch]:
    rows: dict[tuple[int, str, int], list[tuple[float, float, float]]] = {}
    try:
        with open(path, newline="") as file:
            for row in csv.DictReader(file):
                key = (int(row["nodal_diameters"] or -1), row["wave"], int(row["order"]))
                fixed = float(row["frequency_fixed_rad_s"] or "nan")
                rows.setdefault(key, []).append(
                    (float(row["spin_rad_s"]), float(row["frequency_rad_s"]), fixed))
    except (OSError, ValueError, KeyError, TypeError) as reason:
        raise Error(f"{path}: cannot be read: {reason}") from None
    if not rows:
        raise Error(f"{path}: holds no frequency: every spin is beyond the softening limit")
    out = []
    for (diameters, wave, order), values in sorted(rows.items()):
        columns = np.array(sorted(values)).T
        out.append(Branch(diameters, wave, order, columns[0], columns[1], columns[2]))
    return out


def open_modes(path: str | os.PathLike[str]) -> Modes:
    """Opens a directory of `rondo modes` that holds several spins."""
    return Modes(files.require(path, "modes.json"))

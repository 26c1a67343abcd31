# SPDX-License-Identifier: BSD-3-Clause
"""What `rondo modes` wrote: frequencies at the spins asked for, and over the spin."""
from __future__ import annotations

import contextlib
import csv
import io
import os
import pathlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np
from numpy.typing import NDArray

from . import files
from .errors import Error
from .html import modes_html
from .mesh import Mesh, read_mesh
from .plain_files import text_of
from .tables import frame_of

if TYPE_CHECKING:
    import pandas
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
    """A directory of `rondo modes`.

    table: columns of modes.csv, a row for each mode at each spin of its own: "mode" (from 1),
    "frequency_rad_s", "frequency_hz", "nodal_diameters" (-1: not known), "wave", "spin_rad_s",
    "residual", "damping_ratio" (NaN: of a rigid-body motion). branches: over the spins of --spins.
    mesh: that of the shapes."""

    # Pictures: what rondo/pictures.py gives this class, as nothing here knows how to draw.
    plot_campbell: Callable[..., Figure]
    plot_shapes: Callable[..., Figure]

    def __init__(self, directory: pathlib.Path) -> None:
        self.directory = directory
        self.summary = files.read_json(directory / "modes.json")
        self.has_branches = (directory / "campbell.csv").is_file()
        if self.has_branches or not (directory / "modes.csv").is_file():
            _ = self.branches  # an error where they cannot be read

    @cached_property
    def branches(self) -> list[Branch]:
        """Waves over the spin; an error where only single spins were asked for."""
        if not self.has_branches:
            raise Error(f"{self.directory}: has no campbell.csv: the modes of single spins only, "
                        "which `table` has; rondo modes --spins FROM:TO:NUMBER "
                        "(rondo.modes(sweep=...)) writes it")
        return _branches(self.directory / "campbell.csv")

    @cached_property
    def table(self) -> dict[str, NDArray[Any]]:
        return _table(self.directory / "modes.csv")

    @property
    def has_shapes(self) -> bool:
        return (self.directory / "modes.h5").is_file()

    @cached_property
    def mesh(self) -> Mesh:
        with self._shapes() as file:
            return read_mesh(file)

    def shape(self, row: int) -> NDArray[np.complex128]:
        """(n, 2) or (n, 3): the shape of this row of `table`, in the co-rotating frame. The motion
        is the real part of shape · e^(iωt)."""
        with self._shapes() as file:
            real, imaginary = file["modes/real"], file["modes/imaginary"]
            if not len(real) == len(imaginary) == len(self.table["mode"]):
                raise Error(f"{self.directory}: damaged: modes.h5 has not the modes of modes.csv")
            found: NDArray[np.complex128] = real[row] + 1j * imaginary[row]
        return found

    def rows_at(self, spin: float | None = None) -> NDArray[np.int64]:
        """The rows of `table` at this spin (rad/s), by default the first there is."""
        spins = self.table["spin_rad_s"]
        if not len(spins):
            raise Error(f"{self.directory}: has no modes")
        wanted = float(spins[0]) if spin is None else spin
        rows = np.flatnonzero(np.isclose(spins, wanted, rtol=1e-6, atol=1e-12))
        if not len(rows):
            raise Error(f"{self.directory}: spin={wanted:g}: there are modes at "
                        f"{files.some(f'{s:g}' for s in np.unique(spins))} rad/s")
        return rows

    @contextlib.contextmanager
    def _shapes(self) -> Iterator[h5py.File]:
        if not self.has_shapes:
            raise Error(f"{self.directory}: has no modes.h5, and so no shapes: rondo modes "
                        "writes them when all spins of --spin are done")
        path = self.directory / "modes.h5"
        with files.opened(path) as file:
            files.check_format(path, "modes", file.attrs.get("format"))
            yield file

    def _repr_html_(self) -> str:
        return modes_html(self)

    def to_pandas(self) -> pandas.DataFrame:
        """A pandas.DataFrame: a row for each wave at each spin, without --spins the rows of `table`;
        attrs["units"] of the columns."""
        if not self.has_branches:
            return frame_of(self.table, dict(_UNITS), "modes.to_pandas()")
        lengths = [len(b.spin) for b in self.branches]
        columns = {name: np.repeat(np.array([getattr(b, name) for b in self.branches]), lengths)
                   for name in ("diameters", "wave", "order")}
        for name in ("spin", "frequency", "frequency_fixed"):
            columns[name] = np.concatenate([getattr(b, name) for b in self.branches])
        units = dict.fromkeys(("spin", "frequency", "frequency_fixed"), "rad/s")
        return frame_of(columns, units | {"diameters": "1", "order": "1"}, "modes.to_pandas()")

    @property
    def spins(self) -> Array:
        """(k,) rad/s, ascending: all for which there is a frequency."""
        if not self.has_branches:
            return np.unique(self.table["spin_rad_s"])
        return np.unique(np.concatenate([b.spin for b in self.branches]))


_TYPES: dict[str, Callable[[str], Any]] = {
    "mode": int, "frequency_rad_s": float, "frequency_hz": float,
    "nodal_diameters": lambda text: int(text or -1), "wave": str, "spin_rad_s": float,
    "residual": float, "damping_ratio": lambda text: float(text or "nan")}
_UNITS = {"mode": "1", "frequency_rad_s": "rad/s", "frequency_hz": "Hz", "nodal_diameters": "1",
          "spin_rad_s": "rad/s", "residual": "1", "damping_ratio": "1"}


def _table(path: pathlib.Path) -> dict[str, NDArray[Any]]:
    try:
        rows = list(csv.DictReader(io.StringIO(text_of(path))))
        for row in rows:
            row.setdefault("damping_ratio", "")  # not there in tables of earlier versions
        return {name: np.array([kind(row[name]) for row in rows]) for name, kind in _TYPES.items()}
    except (csv.Error, ValueError, KeyError, TypeError) as reason:
        raise Error(f"{path}: cannot be read: {reason}") from None


def _branches(path: pathlib.Path) -> list[Branch]:
    rows: dict[tuple[int, str, int], list[tuple[float, float, float]]] = {}
    try:
        for row in csv.DictReader(io.StringIO(text_of(path))):
            key = (int(row["nodal_diameters"] or -1), row["wave"], int(row["order"]))
            fixed = float(row["frequency_fixed_rad_s"] or "nan")
            rows.setdefault(key, []).append(
                (float(row["spin_rad_s"]), float(row["frequency_rad_s"]), fixed))
    except (csv.Error, ValueError, KeyError, TypeError) as reason:
        raise Error(f"{path}: cannot be read: {reason}") from None
    if not rows:
        raise Error(f"{path}: holds no frequency: every spin is beyond the softening limit")
    out = []
    for (diameters, wave, order), values in sorted(rows.items()):
        columns = np.array(sorted(values)).T
        out.append(Branch(diameters, wave, order, columns[0], columns[1], columns[2]))
    return out


def open_modes(path: str | os.PathLike[str]) -> Modes:
    """Opens a directory of `rondo modes`."""
    return Modes(files.require(path, "modes.json"))

# SPDX-License-Identifier: BSD-3-Clause
"""A POD: the directory that `rondo pod` writes (docs/results.md, "The directory of a POD")."""
from __future__ import annotations

import os
import pathlib
from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import Error, unknown
from .files import check_format, opened, read_json, require
from .mesh import Mesh, read_mesh

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def open_pod(path: str | os.PathLike[str]) -> Pod:
    """Opens the directory of a POD."""
    return Pod(require(path, "pod.json", beside="pod.h5"))


class Pod:
    """Modes of a field: p points (nodes, or candidates for contact), r modes kept, k singular
    values, t snapshots. [q] is the unit of the field, [w] that of the weight. Arrays are read when
    first asked for.

    directory; info: pod.json; mesh; field: "displacement", "velocity" or "contact"; frame:
    "rotating" or "rectified"; weight: "mass", "delassus" or "none"; unit: [q];
    time_unit: "s" or "1"."""

    # Pictures: what rondo/pictures.py gives this class, as nothing here knows how to draw.
    plot_spectrum: Callable[..., Axes]
    plot_modes: Callable[..., Figure]

    def __init__(self, directory: pathlib.Path) -> None:
        self.directory = directory
        self.info: dict[str, Any] = read_json(directory / "pod.json")
        self.path = directory / "pod.h5"
        try:
            self.field, self.frame, self.weight, self.unit, self.time_unit = (
                str(self.info[key]) for key in ("field", "frame", "weight", "unit", "time_unit"))
            self.modes_for = {float(share): None if count is None else int(count)
                              for share, count in self.info["modes_for"].items()}
        except (KeyError, ValueError, AttributeError) as reason:
            raise Error(f"{directory / 'pod.json'}: damaged: {reason!r}") from None
        with opened(self.path) as file:
            check_format(self.path, "pod", file.attrs.get("format"))
            self.mesh: Mesh = read_mesh(file)

    def __repr__(self) -> str:
        return (f"Pod({self.directory}: {self.field}, {self.frame}, weight {self.weight}, "
                f"{len(self.time)} snapshots, {self.n_modes} modes)")

    def _read(self, dataset: str, *empty: int) -> np.ndarray:
        """A dataset; of shape `empty` where it would hold no number and is therefore not there."""
        with opened(self.path) as file:
            if empty and dataset not in file:
                return np.empty(empty)
            return file[dataset][:]

    @property
    def name(self) -> str:
        """ "velocity-rectified"."""
        return f"{self.field}-{self.frame}"

    @property
    def n_modes(self) -> int:
        """r, modes kept."""
        return int(self.info["modes_kept"])

    @property
    def points(self) -> np.ndarray:
        """(p,) node of each point."""
        return self.mesh.boundary if self.field == "contact" else np.arange(self.mesh.n_nodes)

    @cached_property
    def weights(self) -> np.ndarray:
        """(p,) W of each point [w]."""
        return self._read("weight")

    @cached_property
    def spatial(self) -> np.ndarray:
        """(r, p, 2) modes, orthonormal under W; x, y, or normal, tangential; (r, p, 3) of a wheel in
        three dimensions [w^(-1/2)]."""
        return self._read("modes/spatial", 0, len(self.points), self.mesh.coordinates.shape[1])

    @cached_property
    def temporal(self) -> np.ndarray:
        """(t, v) columns of norm 1, r or more of them [1]."""
        return self._read("modes/temporal", len(self.time), 0)

    @cached_property
    def coefficients(self) -> np.ndarray:
        """(t, r) of the spatial modes in each snapshot [q w^(1/2)]."""
        return self._read("modes/coefficients", len(self.time), 0)

    @cached_property
    def singular_value(self) -> np.ndarray:
        """(k,) falling [q w^(1/2)]."""
        return self._read("spectrum/singular_value", 0)

    @cached_property
    def energy(self) -> np.ndarray:
        """(k,) share of each mode in the energy of the snapshots [1]."""
        return self._read("spectrum/energy", 0)

    @cached_property
    def cumulative_energy(self) -> np.ndarray:
        """(k,) share of the modes up to each [1]."""
        return self._read("spectrum/cumulative_energy", 0)

    @cached_property
    def discarded_energy(self) -> np.ndarray:
        """(k,) share of the modes after each [1]."""
        return self._read("spectrum/discarded_energy", 0)

    @cached_property
    def time(self) -> np.ndarray:
        """(t,) of each snapshot [time_unit]."""
        return self._read("snapshots/time")

    @cached_property
    def angle(self) -> np.ndarray:
        """(t,) of the co-rotating frame at the time of the field [rad]."""
        return self._read("snapshots/angle")

    @cached_property
    def run(self) -> np.ndarray:
        """(t,) number of the run that each snapshot is of; info["runs"] has their directories."""
        return self._read("snapshots/run")

    def reconstruct(self, k: int, modes: int | None = None) -> np.ndarray:
        """(p, 2 or 3) snapshot k from its first modes (None: all kept), frame of the analysis [q]."""
        count = self.n_modes if modes is None else modes
        if not 0 <= count <= self.n_modes:
            raise Error(f"{self.directory}: {self.n_modes} modes are kept; {count} were asked for: "
                        "rondo pod --modes keeps more")
        return np.tensordot(self.coefficients[k, :count], self.spatial[:count], axes=1)


class Pods(Mapping[str, Pod]):
    """The PODs in a run's folder pod/, by name ("velocity-rectified"); opened when asked for."""

    def __init__(self, folder: pathlib.Path) -> None:
        self.folder = folder
        self._names = sorted(found.parent.name for found in folder.glob("*/pod.json"))
        self._opened: dict[str, Pod] = {}

    def __getitem__(self, name: str) -> Pod:
        if name not in self._names:
            raise unknown(self.folder, "POD", name, self._names)
        if name not in self._opened:
            self._opened[name] = open_pod(self.folder / name)
        return self._opened[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __repr__(self) -> str:
        return f"Pods({', '.join(self._names)})"

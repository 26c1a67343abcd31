# SPDX-License-Identifier: BSD-3-Clause
"""A POD: the directory that `rondo pod` writes, and a run with analysis.solver = "latin-pgd"
(docs/results.md, "The directory of a POD")."""
from __future__ import annotations

import os
import pathlib
from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import Error, unknown
from .files import check_format, opened, read_json, require
from .html import pod_html
from .labelled import pod_dataset
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
    "rotating" or "rectified"; weight: "mass", "delassus", "none", or of a PGD "search-direction";
    unit: [q]; time_unit: "s" or "1"."""

    # Pictures: what rondo/pictures.py gives this class, as nothing here knows how to draw.
    plot_spectrum: Callable[..., Axes]
    plot_modes: Callable[..., Figure]
    report: Callable[..., pathlib.Path]

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
        return (f"Pod({self.directory}: {self.field}, {self.kind}, weight {self.weight}, "
                f"{len(self.time)} snapshots, {self.n_modes} modes)")

    def _repr_html_(self) -> str:
        return pod_html(self)

    def to_xarray(self) -> Any:
        """An xarray.Dataset of the modes: spatial (mode, node, component), coefficients
        (snapshot, mode), singular_value and energy (rank)."""
        return pod_dataset(self)

    def _read(self, dataset: str, *empty: int) -> np.ndarray:
        """A dataset; of shape `empty` where it would hold no number and is therefore not there."""
        with opened(self.path) as file:
            if empty and dataset not in file:
                return np.empty(empty)
            return file[dataset][:]

    @property
    def is_pgd(self) -> bool:
        """Whether its modes are those of LATIN-PGD, orthonormal in uᵀ(K + k HᵀH)u, and its
        spectrum that of the solution before the last cut."""
        return bool(self.info.get("method") == "latin-pgd")

    @property
    def kind(self) -> str:
        """The frame; of LATIN-PGD "pgd": what Run.pod takes."""
        return "pgd" if self.is_pgd else self.frame

    @property
    def name(self) -> str:
        """ "velocity-rectified", "displacement-pgd"."""
        return f"{self.field}-{self.kind}"

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
        """(p,) W of each point [w]; an error of a PGD, whose norm is not of points."""
        if self.is_pgd:
            raise Error(f"{self.directory}: modes of LATIN-PGD have no weights of points: they are "
                        "orthonormal in the energy uᵀ(K + k HᵀH)u; pod.info[\"orthonormality\"] "
                        "says how well")
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
            hint = "" if self.is_pgd else ": rondo pod --modes keeps more"
            raise Error(f"{self.directory}: {self.n_modes} modes are kept; {count} were asked for"
                        f"{hint}")
        return np.tensordot(self.coefficients[k, :count], self.spatial[:count], axes=1)

    def angles(self, other: Pod, modes: int | None = None) -> np.ndarray:
        """(a,) principal angles between the spaces of the modes of this POD and of another of the
        same field and mesh, rising [rad]; `modes`: of the first ones of each, None: of all kept;
        a: of the one that has fewer. In the norm of the mass, for contact in that of `weights`,
        whatever norm the modes were found in."""
        if self.field != other.field or not _same(self.mesh, other.mesh):
            raise Error(f"{self.directory}: its modes are of {self.field} on {self.mesh.n_nodes} "
                        f"nodes; those of {other.directory} of {other.field} on "
                        f"{other.mesh.n_nodes}: the fields and the meshes must be the same")
        few, many = sorted((pod._orthonormal(modes) for pod in (self, other)),
                           key=lambda columns: columns.shape[1])
        along = many.T @ few
        cosine = np.linalg.svd(along, compute_uv=False)
        sine = np.linalg.svd(few - many @ along, compute_uv=False)[::-1]
        # Each where it is exact: the cosine of a small angle is 1 in numbers.
        angles: np.ndarray = np.where(cosine**2 > 0.5, np.arcsin(np.clip(sine, 0, 1)),
                                      np.arccos(np.clip(cosine, 0, 1)))
        return angles

    def projection_error(self, fields: np.ndarray) -> np.ndarray:
        """(r + 1,) what the first 0, 1, ... r modes leave at best of fields (t, p, 2 or 3), such as
        run.displacement[:], over their norm [1]: of all t together, in the norm of `angles`."""
        values = np.asarray(fields, dtype=float)
        wanted = (len(self.points), self.mesh.coordinates.shape[1])
        if values.ndim != 3 or values.shape[1:] != wanted:
            raise Error(f"{self.directory}: fields of shape {values.shape}; (any, {wanted[0]}, "
                        f"{wanted[1]}) is expected")
        rest = (values * self._root()).reshape(len(values), -1).T
        left = [np.linalg.norm(rest)]
        for column in self._orthonormal(None).T:
            rest = rest - np.outer(column, column @ rest)
            left.append(np.linalg.norm(rest))
        return np.array(left) / (left[0] or 1.0)

    def _root(self) -> np.ndarray:
        """(p, 1) root of the weights of the points, in which PODs are compared."""
        weights = self.weights if self.field == "contact" else self.mesh.mass
        root: np.ndarray = np.sqrt(weights)[:, None]
        return root

    def _orthonormal(self, modes: int | None) -> np.ndarray:
        """(2p, r) or (3p, r) columns, of which the first i span what the first i modes do."""
        count = self.n_modes if modes is None else modes
        if not 1 <= count <= self.n_modes:
            raise Error(f"{self.directory}: {self.n_modes} modes are kept; {count} are to be "
                        "compared")
        columns: np.ndarray = np.linalg.qr(
            (self.spatial[:count] * self._root()).reshape(count, -1).T)[0]
        return columns


def _same(a: Mesh, b: Mesh) -> bool:
    return (a.coordinates.shape == b.coordinates.shape and a.cells.shape == b.cells.shape
            and np.array_equal(a.coordinates, b.coordinates) and np.array_equal(a.cells, b.cells))


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

    def of(self, field: str, kind: str) -> Pod:
        """That of a field ("displacement", "velocity", "contact") in a frame ("co-rotating",
        "rectified"), or by LATIN-PGD ("pgd")."""
        name = f"{field}-{kind.removeprefix('co-')}"
        if name not in self:
            run = self.folder.parent
            make = (f"to make it: rondo pod {run} --field {field} --frame {kind}" if kind != "pgd"
                    else 'to make it: rondo run --set \'analysis.solver="latin-pgd"\' of a crush, '
                         "displacement alone")
            raise unknown(run, "POD", name, [*self, make])
        return self[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __repr__(self) -> str:
        return f"Pods({', '.join(self._names)})"

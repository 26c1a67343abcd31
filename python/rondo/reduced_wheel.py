# SPDX-License-Identifier: BSD-3-Clause
"""What `rondo reduce` keeps of a reduced wheel, as arrays: rondo.ReducedWheel("wheel.h5")."""
from __future__ import annotations

import pathlib
import shutil
import tempfile
import weakref
from collections.abc import Mapping
from functools import cached_property
from typing import Any

import numpy as np

from .calls import reduce
from .data.errors import Error, InputError
from .data.files import check_format, opened
from .data.mesh import Mesh, read_mesh
from .native import Place, place_of
from .simulation import Simulation

WHEEL, OLD_MODEL = "rondo reduced wheel", "rondo reduced model"  # formats, each before a number


class ReducedWheel:
    """m modes of a ring of N = n_sectors equal sectors (a mesh without these is one), of which n_local
    nodes are free and C may touch, and what forces on these do beyond the modes (docs/reduced.md).
    Each array is read when it is asked for.

    The displacement in the frame of sector j, which is that of sector 0 turned by φ_j = 2π j / N, is
    Σ w_k Re exp(i k (φ_j + θ)) U_k with w_k = 1 for k = 0 and 2 for k > 0; θ is the angle of the rim.

    path; basis: "eigenmodes" or "pod"; runs: those behind a POD; n_sectors; harmonic: (m,) k of each
    mode, rising; contact_rows: (C,) rows of a sector that may touch."""

    def __init__(self, file: Place) -> None:
        self.path = place_of(file)
        with opened(self.path) as found:
            _check(self.path, found.attrs)
            self.basis = str(found.attrs["basis"])
            self.runs: list[str] = str(found.attrs["runs"]).splitlines()
            self.n_sectors, self._nodes_per_sector = map(int, found["sector/counts"][:])
            self._nodes: np.ndarray = found["sector/node"][:]
            self.contact_rows: np.ndarray = found["sector/contact"][:]
            self.harmonic: np.ndarray = found["modes/harmonic"][:]

    @classmethod
    def of(cls, case: Place, settings: Mapping[str, Any] | None = None, *,
           modes: int | None = None) -> ReducedWheel:
        """That of a case, which is made by rondo.reduce and read as a whole. Its file is a temporary
        one, and there as long as this object."""
        folder = tempfile.mkdtemp(prefix="rondo-wheel-")
        try:
            wheel = cls(reduce(case, pathlib.Path(folder) / "wheel.h5", settings, modes=modes))
            wheel._read_all()
        except BaseException:
            shutil.rmtree(folder, ignore_errors=True)
            raise
        weakref.finalize(wheel, shutil.rmtree, folder, ignore_errors=True)
        return wheel

    def __repr__(self) -> str:
        return (f"ReducedWheel({self.path}: {self.n_modes} modes ({self.basis}), {self.n_sectors} "
                f"sectors of {len(self._nodes)} free nodes, {len(self.contact_rows)} of contact)")

    def simulation(self, case: Place, settings: Mapping[str, Any] | None = None,
                   **options: Any) -> Simulation:
        """A motion of a case of this body, step by step; options are those of Simulation."""
        return Simulation(case, settings, reduced=self.path, **options)

    @property
    def n_modes(self) -> int:
        """Real modes: one of a harmonic above 0 counts for two."""
        return int(np.where(self.harmonic > 0, 2, 1).sum())

    def node(self, row: Any, sector: Any) -> Any:
        """The node of the mesh in a row of a sector; of arrays, an array. Sectors go round."""
        return self._nodes[row] + np.asarray(sector) % self.n_sectors * self._nodes_per_sector

    # Its modes

    @cached_property
    def frequency(self) -> np.ndarray:
        """(m,) angular frequency at rest [rad/s]."""
        return np.sqrt(self._array("modes/square"))

    @cached_property
    def shape(self) -> np.ndarray:
        """(m, n_local, 2) complex φ, φᴴ M φ = 1 over the masses of one sector [(m/kg)^½]."""
        return self._complex("modes/shape")

    @cached_property
    def contact(self) -> np.ndarray:
        """(m, C, 2) complex: the same at the contact rows."""
        return self._complex("modes/contact")

    @cached_property
    def coriolis(self) -> np.ndarray:
        """(m, m) complex φᴴ M J φ, 0 between harmonics; J turns by +90°."""
        return self._complex("modes/coriolis")

    @cached_property
    def reference(self) -> np.ndarray:
        """(m,) complex φᴴ M X of harmonic 0, else 0 [(kg m)^½]."""
        return self._complex("modes/reference")

    @cached_property
    def turned(self) -> np.ndarray:
        """(m,) complex φᴴ M J X of harmonic 0, else 0 [(kg m)^½]."""
        return self._complex("modes/turned")

    @cached_property
    def translation(self) -> np.ndarray:
        """(m,) complex φᵀ M (1, -i) of the harmonic that moves the center, else 0 [(kg/m)^½]."""
        return self._complex("modes/translation")

    # Beyond the modes

    @cached_property
    def spins(self) -> np.ndarray:
        """(t,) of the tables, rising: one, or three for all spins up to largest_spin [rad/s]."""
        return np.sqrt(self._array("residual/spin_squared"))

    @property
    def largest_spin(self) -> float:
        """Up to which the tables are good [rad/s]: three are at Chebyshev's points of the square."""
        ends = self.spins[[0, -1]] if len(self.spins) > 1 else self.spins
        return float(np.linalg.norm(ends))

    def compliance(self, spin: float | None = None, *, later: bool = False) -> np.ndarray:
        """(N, 2C, 2C) [d, i, j]: component i of the displacement of the contact nodes of sector s + d by
        component j of a unit force on those of sector s, beyond the modes, of a force pattern that
        stands still in space [m2/N]. spin: by default the largest. Of a viscous wheel it answers to the
        lagging force of the first term of the creep, with later=True to those of all others."""
        if later and len(self.creep) == 1:
            raise InputError(f"{self.path}: later = True: the wheel is elastic, and nothing in it is later "
                             "(allowed: False; or the wheel of a case with [[material.viscosity]])")
        table = self._later if later else self._compliance
        return np.tensordot(self._shares(spin), table, 1).transpose(0, 2, 1)

    @cached_property
    def creep(self) -> np.ndarray:
        """(terms, 2) share of the compliance and time of creep [s] of each term, of which the first one is
        the fastest: [[1, 0]] of an elastic wheel."""
        return self._array_or("residual/creep", np.array([[1.0, 0.0]]))

    @cached_property
    def branches(self) -> np.ndarray:
        """(b, 2) relative modulus and time of relaxation [s] of each viscous branch; none if it is elastic."""
        return self._array_or("material/branches", np.empty((0, 2)))

    def centrifugal(self, spin: float | None = None) -> np.ndarray:
        """(n_local, 2) displacement by the spin beyond the modes [m]."""
        return np.asarray(np.tensordot(self._shares(spin), self._centrifugal, 1))

    def _shares(self, spin: float | None) -> np.ndarray:
        """(t,) of each table: the polynomial in the square of the spin that goes through all."""
        last, least = self.largest_spin, 0.0 if len(self.spins) > 1 else self.largest_spin
        spin = last if spin is None else float(spin)
        if not least * (1 - 1e-9) <= spin <= last * (1 + 1e-9):
            allowed = f"0 to {last:g} rad/s, a magnitude" if least < last else (
                f"{last:g} rad/s; of a case whose spin changes, from 0 on")
            raise InputError(f"{self.path}: spin = {spin:g}: is none of its tables (allowed: {allowed})")
        squares = self.spins**2
        return np.array([np.prod([(spin**2 - b) / (a - b) for b in squares if b != a])
                         for a in squares])

    @cached_property
    def _compliance(self) -> np.ndarray:
        return self._array("residual/compliance")

    @cached_property
    def _later(self) -> np.ndarray:
        return self._array_or("residual/compliance_later", np.empty(0))

    @cached_property
    def _centrifugal(self) -> np.ndarray:
        return self._array("residual/centrifugal")

    # Its body

    @cached_property
    def mesh(self) -> Mesh:
        with opened(self.path) as file:
            return read_mesh(file)

    @cached_property
    def mass(self) -> np.ndarray:
        """(n_local,) with which the rows of a sector move: 0 at contact nodes, their neighbours have
        it [kg/m]."""
        return self._array("mesh/mass_dynamic")[self.node(slice(None), 0)]

    def _array(self, name: str) -> np.ndarray:
        with opened(self.path) as file:
            found: np.ndarray = file[name][:]
        return found

    def _array_or(self, name: str, otherwise: np.ndarray) -> np.ndarray:
        with opened(self.path) as file:
            found: np.ndarray = file[name][:] if name in file else otherwise
        return found

    def _complex(self, name: str) -> np.ndarray:
        parts = self._array(name)
        return np.asarray(parts[..., 0] + 1j * parts[..., 1])

    def _read_all(self) -> None:
        for name, member in vars(ReducedWheel).items():
            if isinstance(member, cached_property):
                getattr(self, name)


def _check(path: pathlib.Path, attributes: Mapping[str, Any]) -> None:
    form = str(attributes.get("format", ""))
    if form.startswith(OLD_MODEL):
        raise Error(f"{path}: is a model of an earlier version, whose contact was at points fixed in space: "
                    "rondo.reduce(case, file), or rondo reduce CASE.toml -o wheel.h5, makes a wheel of the "
                    "case, and rondo reduce RUN... --basis pod -o wheel.h5 one of runs")
    if not form.startswith(WHEEL):
        raise Error(f'{path}: is no reduced wheel (its format is "{form}"): rondo.reduce(case, file), or '
                    "rondo reduce CASE.toml -o wheel.h5, makes one")
    check_format(path, WHEEL.removeprefix("rondo "), form)

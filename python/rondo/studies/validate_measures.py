# SPDX-License-Identifier: BSD-3-Clause
"""What the validation of reduced runs measures with: fields in the fixed frame, errors of sums
of squares, mean tractions over the angle in space (docs/reduced.md)."""
from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..data.errors import Error
from ..data.run import Run

BLOCK = 32  # snapshots at once


def share_of(part: float, whole: float) -> float:
    """NaN where there is no whole: an error has nothing to be measured by."""
    return math.nan if whole == 0 else part / whole


@dataclass(frozen=True)
class Window:
    """Of the comparison [s]."""

    begin: float
    end: float

    def holds(self, times: np.ndarray) -> np.ndarray:
        return (times >= self.begin) & (times <= self.end)


class Field:
    """The displacement or the velocity of a run, moved to the fixed frame (docs/theory.md, 7.3)."""

    def __init__(self, run: Run, name: str) -> None:
        of_velocity = name == "velocity"
        self.time = run.times_velocity if of_velocity else run.times
        self._angle = run.angle_velocity if of_velocity else run.angle
        self._values = run.field(name)
        sector, within = run.mesh.sector, run.mesh.sector_node
        if sector is None or within is None:
            raise Error(f"{run.directory}: its mesh has no equal sectors, round which fields could turn")
        self._order = np.lexsort((sector, within))
        self._sectors = int(sector.max()) + 1

    def fixed(self, snapshots: slice) -> np.ndarray:
        """(t, n) x + iy, rectified: a picture that stands still in space stands still here."""
        n = self._sectors
        polar = np.exp(2j * np.pi * np.arange(n) / n)  # radial and tangential parts are what moves
        k = np.fft.fftfreq(n, 1 / n)
        turned = np.exp(-1j * k * self._angle[snapshots, None])
        turned[:, np.abs(k) == n / 2] = 1  # the highest stays where it is
        values: np.ndarray = self._values[snapshots] @ np.array([1, 1j])
        rings = values[:, self._order].reshape(len(values), -1, n) / polar
        moved = np.fft.ifft(np.fft.fft(rings, axis=2) * turned[:, None], axis=2) * polar
        values[:, self._order] = moved.reshape(values.shape)
        return values

    def at(self, time: np.ndarray) -> np.ndarray:
        """(t, n) in the fixed frame, between two snapshots on a line: there the field stands nearly
        still. @param time rising, within those of the field"""
        before = np.minimum(np.searchsorted(self.time, time, side="right") - 1, len(self.time) - 1)
        after = np.minimum(before + 1, len(self.time) - 1)
        fields = self.fixed(slice(int(before[0]), int(after[-1]) + 1))
        span = np.where(after > before, self.time[after] - self.time[before], 1.0)
        weight = ((time - self.time[before]) / span)[:, None]
        return (1 - weight) * fields[before - before[0]] + weight * fields[after - before[0]]


@dataclass(frozen=True)
class FieldErrors:
    error: float   # of the prediction
    mean: float    # of the means over the window
    compared: int  # snapshots


def field_errors(window: Window, full: Run, reduced: Run, name: str) -> FieldErrors:
    """What the prediction misses of the snapshots of the window that lie between two of its own.
    Norms are those of the mass. NaN on a mesh without equal sectors: there is nothing to turn by."""
    if full.mesh.sector is None:
        return FieldErrors(math.nan, math.nan, 0)
    mine, theirs, mass = Field(full, name), Field(reduced, name), full.mesh.mass
    energy = difference = 0.0
    sums = np.zeros((2, len(mass)), dtype=complex)
    known = window.holds(mine.time) & (mine.time >= theirs.time[0]) & (mine.time <= theirs.time[-1])
    for block in _blocks(known):
        field, predicted = mine.fixed(block), theirs.at(mine.time[block])
        energy += _energy(mass, field)
        difference += _energy(mass, predicted - field)
        sums += field.sum(axis=0), predicted.sum(axis=0)
    means = share_of(_energy(mass, sums[1] - sums[0]), _energy(mass, sums[0]))
    return FieldErrors(math.sqrt(share_of(difference, energy)), math.sqrt(means), int(known.sum()))


def _energy(mass: np.ndarray, fields: np.ndarray) -> float:
    """Of one field or of several together."""
    return float(((fields.real ** 2 + fields.imag ** 2) @ mass).sum())


def _blocks(wanted: np.ndarray) -> Iterator[slice]:
    """Of a mask that is one piece."""
    places = np.flatnonzero(wanted)
    for k in range(0, len(places), BLOCK):
        part = places[k:k + BLOCK]
        yield slice(int(part[0]), int(part[-1]) + 1)


def mean_profile(run: Run, window: Window) -> np.ndarray | None:
    """(3, m) angle (-π to π, counter-clockwise from straight down) [rad], pressure and shear [Pa],
    means over the snapshots of the window at places that stand still in space, evenly round the
    disk, as many as candidates. A nodal force is shared by the two places next to its node, the
    more the nearer, so that nothing jumps where a node passes from one to the next; the profile's
    integral is the mean force. None where there is no contact to be had."""
    inside = np.flatnonzero(window.holds(run.times))
    if run.contact is None or not len(inside):
        return None
    x = run.mesh.coordinates[run.mesh.boundary]
    n = len(x)
    force = run.contact.force[slice(int(inside[0]), int(inside[-1]) + 1)]
    turns = (np.arctan2(x[:, 0], -x[:, 1]) + run.angle[inside, None]) / (2 * np.pi)
    place = (turns - np.floor(turns)) * n
    whole = np.floor(place)
    first, part = whole.astype(int) % n, place - whole
    sums = np.zeros((2, n))
    for at, share in ((first, 1.0 - part), ((first + 1) % n, part)):
        for c in range(2):
            sums[c] += np.bincount(at.ravel(), (share * force[..., c]).ravel(), minlength=n)
    j = (np.arange(n) + (n + 1) // 2) % n  # from the one after straight up, or from it
    angle = np.where(2 * j >= n, j - n, j) * (2 * np.pi / n)
    scale = n / (run.mesh.tributary.sum() * len(inside))
    return np.stack([angle, *(scale * sums[:, j])])


def profile_error(full: np.ndarray, reduced: np.ndarray, by: np.ndarray) -> float:
    """‖reduced - full‖ / ‖by‖ over the places."""
    return math.sqrt(share_of(float(((reduced - full) ** 2).sum()), float((by ** 2).sum())))


class Means:
    """Of the rows of a history whose intervals lie in the window."""

    def __init__(self, run: Run, window: Window) -> None:
        self._history = run.history
        time = self._history["time_s"]
        start = np.append(0.0, time)[:-1]
        strictly = (start[1:] >= window.begin) & (time[1:] <= window.end)
        if not strictly.any():
            raise Error(f"{self._history.path}: no row lies in the window, {window.begin:.9g} to "
                        f"{window.end:.9g} s; a longer window (--from, --to), or a prediction with "
                        "a smaller --reduced-step")
        end = min(window.end, time[-1])
        self._rows = np.flatnonzero((start >= window.begin) & (time <= end * (1 + 1e-12)))
        self._length = (time - start)[self._rows]

    def mean(self, column: str) -> float:
        return float(np.average(self._history[column][self._rows], weights=self._length))

    def fluctuation(self, column: str) -> float:
        """Root mean square about the mean."""
        about = self._history[column][self._rows] - self.mean(column)
        return float(np.sqrt(np.average(about ** 2, weights=self._length)))

    def rate(self, column: str) -> float:
        """Increase of a cumulative column, by the time."""
        value = self._history[column]
        before = value[self._rows[0] - 1] if self._rows[0] > 0 else 0.0
        return float((value[self._rows[-1]] - before) / self._span)

    @cached_property
    def _span(self) -> float:
        time = self._history["time_s"]
        begin = time[self._rows[0] - 1] if self._rows[0] > 0 else 0.0
        return float(time[self._rows[-1]] - begin)

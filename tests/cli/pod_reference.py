# SPDX-License-Identifier: BSD-3-Clause
"""What rondo pod should find, put together from a run's results.h5 by numpy alone."""
import csv
import json

import h5py
import numpy as np


def rectified(values, h5, angles, rows):
    """Fields (t, n, 2 or 3) moved to the fixed frame: real transforms over the sectors, by numpy."""
    sector, ring = h5["/mesh/sector"][:][rows], h5["/mesh/sector_node"][:][rows]
    n = sector.max() + 1
    out = np.empty_like(values)
    scalars = len(rows) != len(h5["/mesh/sector"])
    for number in np.unique(ring):
        at = np.flatnonzero(ring == number)
        at = at[np.argsort(sector[at])]
        phi = 2 * np.pi * np.arange(n) / n
        c, s = (1.0, 0.0) if scalars else (np.cos(phi), np.sin(phi))
        polar = np.stack([c * values[:, at, 0] + s * values[:, at, 1],
                          -s * values[:, at, 0] + c * values[:, at, 1]])
        k = np.arange(n // 2 + 1)
        turn = np.exp(-1j * k[None, :] * angles[:, None])
        if n % 2 == 0:
            turn[:, -1] = 1.0
        moved = np.fft.irfft(np.fft.rfft(polar, axis=2) * turn, n=n, axis=2)
        out[:, at, 0] = c * moved[0] - s * moved[1]
        out[:, at, 1] = s * moved[0] + c * moved[1]
        if values.shape[2] == 3:  # along the axle
            out[:, at, 2] = np.fft.irfft(np.fft.rfft(values[:, at, 2], axis=1) * turn, n=n, axis=1)
    return out


def by_pitches(values, h5, angles, rows):
    """The same by the nearest whole number of sectors: places and components."""
    sector, ring = h5["/mesh/sector"][:][rows], h5["/mesh/sector_node"][:][rows]
    n = sector.max() + 1
    place = {(s, r): k for k, (s, r) in enumerate(zip(sector, ring))}
    out = np.empty_like(values)
    for j, angle in enumerate(angles):
        steps = round(angle / (2 * np.pi) * n)
        source = [place[(s - steps) % n, r] for s, r in zip(sector, ring)]
        c, s = np.cos(2 * np.pi * steps / n), np.sin(2 * np.pi * steps / n)
        turn = np.eye(2) if len(rows) != len(h5["/mesh/sector"]) else np.array([[c, -s], [s, c]])
        out[j] = values[j][source] @ turn.T
    return out


def reference(directory, field, frame="rotating", weight=None, weighted=True):
    """Weighted snapshots (rows, t) of a run, put together by numpy alone."""
    with h5py.File(directory / "results.h5") as h5:
        mass = h5["/mesh/mass"][:]
        rows = np.arange(len(mass))
        angle = h5["/frame/angle"][:]
        if field == "contact":
            rows = h5["/mesh/boundary"][:]
            values, w = h5["/contact/force"][:], 1.0 / mass[rows]
        else:
            values, w = h5["/snapshots/" + field][:], mass
            if field == "velocity":
                angle = h5["/frame/angle_velocity"][:]
        if frame == "rectified":
            values = rectified(values, h5, angle, rows)
        if frame == "pitch":
            values = by_pitches(values, h5, angle, rows)
    if not weighted:
        return values
    if weight == "none":
        w = np.ones_like(w)
    return (np.sqrt(w)[None, :, None] * values).reshape(len(values), -1).T


def spectrum(directory):
    with open(directory / "spectrum.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def summary(directory):
    return json.loads((directory / "pod.json").read_text())

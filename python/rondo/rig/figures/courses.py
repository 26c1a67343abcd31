# SPDX-License-Identifier: BSD-3-Clause
"""Forces in time of a rig, and their spectra: over a cleat, on a road."""
from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from ...data.errors import Error
from ...plots.curves import force_spectrum
from ...plots.psd import power_spectral_density
from ..points import Array, Columns, nominal
from .drawing import Drawn, Given, curve, few, legend, panels
from .runs import Missing, opened, with_runs

if TYPE_CHECKING:
    from ...data.run import Run

FORCES = (("force_x", "longitudinal force", "$F_x$"), ("force_y", "vertical force", "$F_z$"))  # of the ground on the wheel
HIGHEST = 250.0  # Hz: what reaches the axle of a car through its tyre, and is felt and heard, is below
BEFORE = 0.5     # radii ahead of the cleat or the road: where the courses begin, as the peaks of the tables do
TESTS = {"cleat": "Forces of the ground on the wheel over a cleat{size}, and the amplitudes of their spectra, by speed{state}",
         "road": "Forces of the ground on the wheel on a rough road{size}, and their power spectral densities, by speed{state}"}
BEGINS = {"cleat": "edge of the cleat", "road": "start of the road"}


def draw(given: Given) -> Iterator[Drawn]:
    for test, words in TESTS.items():
        yield from _courses(given, test, words)


def _courses(given: Given, test: str, words: str) -> Iterator[Drawn]:
    """Each force above over the way, below over the frequency."""
    found, folders = with_runs(given.rig, test, ("load", "pressure", "speed"))
    missing = Missing()
    drawn = [(found["speed"][k], run) for k in _shown(given, found) for run in opened(given.rig, folders[k], missing)]
    if not drawn:
        return
    figure, axes = panels(2, 2)
    width, unit = given.rig.width or 1.0, given.unit("N")
    density = "(N/m)²/Hz" if given.rig.per_metre else "N²/Hz"
    for ax, below, (column, label, symbol) in zip(axes, axes[2:], FORCES):
        for k, (speed, run) in enumerate(drawn):
            edge = edge_of(run)
            begin = max((edge - BEFORE * run.outer_radius) / speed, 0.0)
            time = run.history["time_s"]
            curve(ax, k, (speed * time - edge)[time >= begin], 1e-3 * width * run.history[column][time >= begin], marked=False)
            try:
                frequency, height = _spectrum(run, column, test, begin)
            except Error as reason:
                missing.note(reason)
                continue
            felt = (frequency > 0) & (frequency <= HIGHEST)
            curve(below, k, frequency[felt], (width ** 2 if test == "road" else width) * height[felt], marked=False)
        ax.set(xlabel=f"distance from the {BEGINS[test]} (m)", ylabel=f"{label} {symbol} (k{unit})")
        below.set(xlabel="frequency (Hz)",
                  ylabel=f"density of {symbol} ({density})" if test == "road" else f"amplitude of {symbol} ({unit})",
                  xlim=(0, None))
        if below.lines:
            below.set_yscale("log")
    legend(figure, [given.said("speed", speed) for speed, _ in drawn], marks=False)
    said = words.format(size=_size(given, test), state=_state(given, found))
    yield Drawn(test, test, f"{said}.{missing.words}", figure)


def _size(given: Given, test: str) -> str:
    """Of the cleat or the road, as the settings have it; "": they do not say it."""
    own = given.rig.settings.get(test, {})
    if test == "cleat" and {"height", "length"} <= own.keys():
        return f" that is {1e3 * own['height']:.3g} mm high and {1e3 * own['length']:.3g} mm long at its top"
    if test == "road" and "roughness" in own:
        return f" (ISO 8608, {1e6 * own['roughness']:.3g}·10⁻⁶ m³ at 0.1 cycles a metre)"
    return ""


def _state(given: Given, found: Columns) -> str:
    values = [(name, nominal(given.rig, name, found[name])) for name in ("load", "pressure")]
    told = [given.said(name, value) for name, value in values if np.isfinite(value) and not (given.rig.plane and name == "pressure")]
    return f", at {', '.join(told)}" if told else ""


def edge_of(run: Run) -> float:
    """m: where the ground begins to leave its height at the start; before it the wheel comes down and settles."""
    profile = run.case["ground"].get("profile", "flat")
    if isinstance(profile, str):
        return 0.0
    heights = [height for _, height in profile]
    return next((float(profile[k][0]) for k in range(len(profile) - 1) if heights[k + 1] != heights[0]), 0.0)


def _spectrum(run: Run, column: str, test: str, begin: float) -> tuple[Array, Array]:
    if test == "road":
        found = power_spectral_density(run, column, begin)
        return found.frequency, found.density
    return force_spectrum(run, column, begin)


def _shown(given: Given, found: Columns) -> list[int]:
    """Rows: one of each speed, at the nominal load and pressure."""
    rows = np.ones(len(found["speed"]), dtype=bool)
    for name in ("load", "pressure"):
        value = nominal(given.rig, name, found[name])
        rows &= ~(np.abs(found[name] - value) > 1e-6 * abs(value))
    _, first = np.unique(found["speed"][rows], return_index=True)
    return [int(np.flatnonzero(rows)[int(k)]) for k in few(first.astype(float))]

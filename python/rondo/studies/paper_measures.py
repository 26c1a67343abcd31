# SPDX-License-Identifier: BSD-3-Clause
"""What the table of a study takes from its results: each function is the measure of that name in
study.toml, and takes what stands there. A figure that is not there is NaN, which passes nothing."""
from __future__ import annotations

import math
import pathlib
from collections.abc import Iterable
from functools import cached_property
from typing import Any

import numpy as np

from ..data.errors import Error
from ..data.files import read_json, read_table
from ..data.history import History
from ..data.run import Run, open_run
from .annulus import spinning_annulus
from .paper_plan import Plan


class Measures:
    """Of the results in `directory`."""

    def __init__(self, directory: pathlib.Path, plan: Plan) -> None:
        self._runs = directory / "runs"
        self._plan = plan
        self._opened: dict[str, Run] = {}
        self._edges: dict[str, np.ndarray] = {}

    def of(self, measure: list[Any]) -> float:
        """["mean", "force_y", "turn-smooth", 0.1]: name and arguments."""
        name, *arguments = measure
        if name.startswith("_") or name == "of" or not hasattr(Measures, name):
            raise Error(f"{self._plan.path}: there is no measure {name!r}")
        return float(getattr(self, name)(*arguments))

    # The edge of a ring

    def edge_at_the_end(self, run: str) -> float:
        return self._edge(run)[-1, 0]

    def edge_at_the_start(self, run: str) -> float:
        return self._edge(run)[0, 0]

    def edge_mean(self, run: str) -> float:
        return self._edge(run)[:, 0].mean()

    def swing_kept(self, run: str, part: float) -> float:
        """Swing in the last part of the time over that in the first."""
        time, radial = self._run(run).times, self._edge(run)[:, 0]
        end = time[-1]
        return np.ptp(radial[time >= end - part * end]) / np.ptp(radial[time <= part * end])

    def largest_tangential(self, run: str, until: float) -> float:
        return np.abs(self._edge(run)[self._run(run).times <= until, 1]).max()

    def closed_form(self, run: str) -> float:
        """Radial displacement of the edge of the annulus in stationary spin."""
        case = self._run(run).case
        outer = case["disk"]["outer_radius"]
        return spinning_annulus(case["material"], case["disk"]["inner_radius"], outer,
                                case["motion"]["angular_velocity"], outer)

    # Summaries

    def largest(self, key: str, *begins: str) -> float:
        """Of a key of run.json over the runs whose names begin so."""
        return _largest(_number(self._run(run.name).info.get(key)) for run in self._plan.runs
                        if run.name.startswith(begins))

    def energy_created(self, run: str, other: str) -> float:
        """By the scheme at the end of a run, over the largest energy of another one."""
        history = self._history(other)
        energy = (history["kinetic"] + history["strain"]).max()
        return abs(self._history(run)["work_scheme"][-1]) / energy

    # Forces

    def mean(self, column: str, run: str, begin: float) -> float:
        return _Rows(self._history(run), column, begin).mean

    def drag(self, run: str, begin: float, load: float) -> float:
        return abs(self.mean("force_x", run, begin)) / load

    def least_growth_of_drag(self, begin: float, *runs: str) -> float:
        """Of -F_x / F_y from one run to the next."""
        drag = [-self.mean("force_x", run, begin) / self.mean("force_y", run, begin)
                for run in runs]
        return np.diff(drag).min()

    def relative_deviation(self, column: str, run: str, begin: float) -> float:
        rows = _Rows(self._history(run), column, begin)
        return rows.deviation / rows.mean

    def highest_line(self, column: str, run: str, begin: float) -> float:
        return _Rows(self._history(run), column, begin).highest_line()

    def pitch_frequency(self, run: str) -> float:
        """Pitches times turns a second."""
        case = self._run(run).case
        return case["disk"]["tread"]["pitches"] * case["motion"]["angular_velocity"] / (2 * math.pi)

    def line_ratio(self, column: str, run: str, other: str, begin: float) -> float:
        """At the pitch frequency of the first run."""
        at = np.array([self.pitch_frequency(run)])
        one, two = (_Rows(self._history(name), column, begin).line(at)[0] for name in (run, other))
        return one / two

    def outside_cone(self, *runs: str) -> float:
        """Largest shear beyond friction times pressure, over the largest pressure."""
        found = []
        for name in runs:
            run = self._run(name)
            if run.contact is None:
                raise Error(f"{run.directory}: holds no contact forces")
            force = run.contact.force[...]
            beyond = np.abs(force[..., 1]) - run.case["ground"]["friction"] * force[..., 0]
            found.append(beyond.max() / force[..., 0].max())
        return _largest(found)

    # Decompositions

    def modes_for(self, share: str, run: str, pod: str) -> float:
        return _number(self._pod(run, pod).get("modes_for", {}).get(share))

    def modes_ratio(self, share: str, run: str, pod: str, other: str) -> float:
        return self.modes_for(share, run, pod) / self.modes_for(share, run, other)

    def modes_of_pgd(self, share: str, run: str, of: str) -> float:
        """Of LATIN-PGD that leave this share of the energy of another run's displacements, in the
        norm of the mass."""
        left = self._run(run).pod("displacement", "pgd").projection_error(
            self._run(of).displacement[:]) ** 2
        enough = np.flatnonzero(left <= float(share))
        return float(enough[0]) if len(enough) else math.nan

    def least_pair(self, run: str, pod: str, modes: int) -> float:
        """A picture that stands still in the fixed frame is, in the co-rotating one, a Fourier
        series over one turn, cosine and sine of each harmonic of the same energy: the least ratio
        of the singular values of a pair."""
        spectrum = read_table(self._runs / run / "pod" / pod / "spectrum.csv")
        sigma = spectrum["singular_value"][:modes]
        if len(sigma) < modes:
            return math.nan
        return min(1.0, float((sigma[1::2] / sigma[::2]).min()))

    def largest_of_pods(self, *keys: str) -> float:
        found = []
        for pod in self._plan.pods:
            value: Any = self._pod(pod.run, pod.name)
            for key in keys:
                value = value.get(key) if isinstance(value, dict) else None
            found.append(_number(value))
        return _largest(found)

    # Files

    def _run(self, name: str) -> Run:
        if name not in self._opened:
            self._opened[name] = open_run(self._runs / name, unfinished=True)
        return self._opened[name]

    def _history(self, name: str) -> History:
        return self._run(name).history

    def _pod(self, run: str, pod: str) -> dict[str, Any]:
        return read_json(self._runs / run / "pod" / pod / "pod.json")

    def _edge(self, name: str) -> np.ndarray:
        """(t, 2) radial and tangential (counter-clockwise) displacement of the edge at each
        snapshot, mean over the candidates [m]."""
        if name not in self._edges:
            run = self._run(name)
            run.need_snapshots()
            nodes = run.mesh.boundary
            outward = run.mesh.coordinates[nodes]
            outward = outward / np.linalg.norm(outward, axis=1)[:, None]
            along = np.stack([-outward[:, 1], outward[:, 0]], axis=1)
            u = np.asarray(run.displacement[:, nodes])
            self._edges[name] = np.stack([np.einsum("tnc,nc->t", u, axis) for axis in
                                          (outward, along)], axis=1) / len(nodes)
        return self._edges[name]


def _number(value: object) -> float:
    return float(value) if isinstance(value, (int, float)) else math.nan


def _largest(values: Iterable[float]) -> float:
    """NaN where one is NaN, or there is none."""
    found = list(values)
    return float(np.max(found)) if found else math.nan


class _Rows:
    """A column of a history as a function of time, each row the mean over an interval; the rows
    whose interval begins at `begin` or later."""

    def __init__(self, history: History, column: str, begin: float) -> None:
        end = history["time_s"]
        start = np.append(0.0, end)[:-1]
        if not np.all(np.isfinite(end)) or np.any(end <= start):
            raise Error(f"{history.path}: damaged: its times do not rise")
        chosen = history.window(begin, None)
        self.middle = 0.5 * (start + end)[chosen]
        self.length = (end - start)[chosen]
        self.value = history[column][chosen]
        self._begin, self._span = start[chosen][0], self.length.sum()

    @cached_property
    def mean(self) -> float:
        return float(np.average(self.value, weights=self.length))

    @cached_property
    def deviation(self) -> float:
        """Root mean square about the mean."""
        return float(np.sqrt(np.average((self.value - self.mean) ** 2, weights=self.length)))

    def line(self, frequency: np.ndarray) -> np.ndarray:
        """Amplitude of harmonics of these frequencies [Hz], seen through a Hann window over the
        time, whose gain is undone."""
        hann = 1.0 - np.cos(2 * np.pi * (self.middle - self._begin) / self._span)
        weight = self.length * hann / (self.length * hann).sum()
        part = weight * (self.value - (weight * self.value).sum())
        blocks = np.array_split(frequency, max(1, len(frequency) // 256))  # some megabytes at once
        return np.concatenate([2 * np.abs(np.exp(-2j * np.pi * np.outer(block, self.middle)) @ part)
                               for block in blocks])

    def highest_line(self) -> float:
        """The frequency with the largest line, from four periods in the time up to the half of a
        row a period, to a tenth of a hertz, or to a thousandth of 1 / time where that is more."""
        resolution = 1.0 / self._span
        fine = max(0.1, 1e-3 * resolution)
        # A line is about 4 / time wide: steps of a quarter of 1 / time cannot miss it.
        coarse = np.arange(4.0, 0.5 * len(self.value), 0.25) * resolution
        if not len(coarse):
            return math.nan
        near = coarse[np.argmax(self.line(coarse))]
        around = np.arange(near - 0.25 * resolution, near + 0.25 * resolution, fine)
        return float(around[np.argmax(self.line(around))])

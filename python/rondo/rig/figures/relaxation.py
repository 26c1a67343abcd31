# SPDX-License-Identifier: BSD-3-Clause
"""Relaxation of a rig: forces over the distance rolled after a step of the slip, and relaxation lengths over the load."""
from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from matplotlib.axes import Axes

from ...data.errors import Error
from ...data.files import read_table
from ..points import Array, levels, nominal, points, texts
from ..plane.slip_step import slip_step_of
from .drawing import Drawn, Given, curve, few, legend, panels
from .runs import Missing, opened, with_runs

TEST = "relaxation"
# By what the table calls a step: column of the run, and words.
STEPS = {"slip-angle": ("force_lateral", "after a step of the slip angle", "lateral force $F_y$"),
         "slip-ratio": ("force_x", "after a step of the slip ratio", "longitudinal force $F_x$")}
REACHED = 1 - np.exp(-1.0)  # of the change of a force, after one relaxation length
LENGTHS = (("relaxation_length_63", "63.2 % reached"), ("relaxation_length_fit", "exponential fitted"))


def draw(given: Given) -> Iterator[Drawn]:
    yield from _courses(given)
    yield from _lengths(given)


def _courses(given: Given) -> Iterator[Drawn]:
    """The share of the change that is reached, by load."""
    found, folders = with_runs(given.rig, TEST, ("load", "pressure"))
    if not folders:
        return
    kinds, missing = np.array(texts(given.rig, TEST, "step"))[found["row"].astype(int)], Missing()
    pressure = nominal(given.rig, "pressure", found["pressure"])
    shown = [kind for kind in STEPS if (kinds == kind).any()]
    loads = few(levels(found["load"]))
    figure, axes = panels(len(shown), narrow=len(shown) == 1)
    for ax, kind in zip(axes, shown):
        for k, load in enumerate(loads):
            rows = np.flatnonzero((kinds == kind) & np.isclose(found["load"], load)
                                  & ~(np.abs(found["pressure"] - pressure) > 1e-6 * pressure))
            for row in rows[:1]:
                _draw_course(ax, k, given, folders[row], kind, missing)
        ax.axhline(100 * REACHED, color="0.6", linewidth=0.7, linestyle=":", zorder=0)
        ax.set(xlabel=f"distance rolled {STEPS[kind][1]} (m)", ylabel=f"change of the\n{STEPS[kind][2]} (%)", xlim=(0, None))
    if not any(len(ax.lines) > 1 for ax in axes):
        return
    legend(figure, [given.said("load", load) for load in loads], marks=False)
    yield Drawn(TEST, "relaxation", f"How a force follows a step of its slip, by load. Dotted: {100 * REACHED:.1f} % of the "
                f"change, which is reached after the relaxation length.{missing.words}", figure)


def _draw_course(ax: Axes, k: int, given: Given, folder: str, kind: str, missing: Missing) -> None:
    column = STEPS[kind][0]
    for run in opened(given.rig, folder, missing):
        try:
            if given.rig.plane:
                step = slip_step_of(run)
                curve(ax, k, step.distance, 100 * step.share, marked=False)
                return
            table, said_by_run = read_table(run.directory / "slip-step.csv"), run.info["slip_step"][column]
        except (Error, KeyError, OSError) as reason:
            missing.note(f"{folder}: no step of the slip: {reason}")
            return
        change = said_by_run["after"] - said_by_run["before"]
        share: Array = 100 * (table[column] - said_by_run["before"]) / change
        curve(ax, k, table["distance_m"], share, marked=False)


def _lengths(given: Given) -> Iterator[Drawn]:
    found = points(given.rig, TEST, ("load", *(name for name, _ in LENGTHS)))
    if len(levels(found["load"])) < 2:
        return
    kinds = np.array(texts(given.rig, TEST, "step"))
    shown = [kind for kind in STEPS if (kinds == kind).any()]
    figure, axes = panels(len(shown), narrow=len(shown) == 1)
    for ax, kind in zip(axes, shown):
        for k, (name, _) in enumerate(LENGTHS):
            curve(ax, k, 1e-3 * found["load"][kinds == kind], found[name][kinds == kind])
        ax.set(xlabel=given.load_label, ylabel=f"relaxation length\n{STEPS[kind][1]} (m)", xlim=(0, None), ylim=(0, None))
    legend(figure, [words for _, words in LENGTHS])
    yield Drawn(TEST, "relaxation-length", "Relaxation length over the load: the distance at which 63.2 % of the change of the "
                "force is reached, and that of the exponential which fits its course.", figure)

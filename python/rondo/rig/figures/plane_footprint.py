# SPDX-License-Identifier: BSD-3-Clause
"""The contact of a plane wheel on a rig: pressure and shear along it, by load."""
from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ... import style
from ...plots.footprint import footprint_of
from ..points import levels
from .drawing import MARKS, MOST, Drawn, Given, curve, few, legend, panels
from .runs import Missing, opened, with_runs


def draw(given: Given) -> Iterator[Drawn]:
    """The pairs of a node and a sample that touch, in their order along the ground; of a tread each as a mark, because
    neighbours may be of different edges of a land."""
    found, folders = with_runs(given.rig, "footprint", ("load",))
    missing = Missing()
    rows = [int(np.flatnonzero(found["load"] == load)[0]) for load in few(levels(found["load"]))]
    drawn = [(found["load"][k], footprint_of(run)) for k in rows for run in opened(given.rig, folders[k], missing)]
    if not drawn:
        return
    figure, (left, right) = panels(2)
    is_tread = any(len(np.unique(one.node)) > 1 for _, one in drawn)
    for k, (_, one) in enumerate(drawn):
        for ax, values in ((left, one.pressure), (right, one.shear)):
            if is_tread:
                ax.plot(1e3 * one.place, 1e-5 * values, MARKS[k % MOST], markersize=2.0, markerfacecolor="none",
                        markeredgewidth=0.5, color=style.CURVES[k % MOST]["color"])
            else:
                curve(ax, k, 1e3 * one.place, 1e-5 * values, marked=False)
    right.axhline(0.0, color="0.85", linewidth=0.6, zorder=0)
    left.set(xlabel="ahead of the center (mm)", ylabel="pressure (bar)", ylim=(0, None))
    right.set(xlabel="ahead of the center (mm)", ylabel="shear, > 0 pushes ahead (bar)")
    legend(figure, [given.said("load", load) for load, _ in drawn], marks=is_tread, lines=not is_tread)
    yield Drawn("footprint", "footprint", "Pressure along the contact, and shear by which the ground pushes the tread, by load; "
                f"the wheel rolls to the right. Both are the same all over the width.{missing.words}", figure)

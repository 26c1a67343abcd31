# SPDX-License-Identifier: BSD-3-Clause
"""Rolling resistance of a rig over speed, load and pressure."""
from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..points import ALIKE, chosen, levels, nominal, points
from .drawing import Drawn, Given, by_air, curve, few, legend, panels

STATE = ("load", "pressure", "speed")
# Over which setting, by which, factor and label of the axis; "": that of the load.
FIGURES = (("speed", "load", 3.6, "speed (km/h)"), ("load", "pressure", 1e-3, ""))
TEST = "rolling-resistance"


def draw(given: Given) -> Iterator[Drawn]:
    for along, by, factor, label in FIGURES:
        yield from _over(given, along, by, factor, label or given.load_label)


def _over(given: Given, along: str, by: str, factor: float, label: str) -> Iterator[Drawn]:
    """Force and coefficient along a setting, by another, the third at its nominal value."""
    found = points(given.rig, TEST, (*STATE, "resistance", "coefficient"))
    found = chosen(found, np.isfinite(found["coefficient"]))
    rest = next(name for name in STATE if name not in (along, by))
    value = nominal(given.rig, rest, found[rest])
    here = chosen(found, ~(np.abs(found[rest] - value) > ALIKE * value))
    if len(levels(here[along], ALIKE)) < 2:
        return
    values = few(levels(here[by], ALIKE))
    figure, axes = panels(2)
    for ax, name, text in zip(axes, ("resistance", "coefficient"), (f"rolling resistance ({given.unit('N')})", "coefficient (N/kN)")):
        for k, level in enumerate(values):
            one = chosen(here, np.isclose(here[by], level, rtol=ALIKE))
            curve(ax, k, factor * one[along], one[name])
        ax.set(xlabel=label, ylabel=text, xlim=(0, None), ylim=(0, None))
    legend(figure, given.airs(values) if by == "pressure" else [given.said(by, level) for level in values])
    at = f", at {given.said(rest, value)}" if np.isfinite(value) and not (given.rig.plane and rest == "pressure") else ""
    apart = by_air(values) if by == "pressure" else f", by {by}"
    yield Drawn(TEST, f"{TEST}-{along}", f"Rolling resistance and its coefficient, the resistance over the load, over the {along}{apart}{at}.",
                figure)

# SPDX-License-Identifier: BSD-3-Clause
"""Small vibrations of a rig: frequencies of the free wheel and of the one that stands on the ground, and their damping."""
from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from matplotlib.axes import Axes

from ... import style
from ..points import Columns, chosen, levels, points
from .drawing import MARKS, Drawn, Given, by_air, few, legend, panels

COLUMNS = ("pressure", "standing", "mode", "frequency", "damping_ratio", "nodal_diameter")


def draw(given: Given) -> Iterator[Drawn]:
    """Frequencies over the nodal diameter, of the standing wheel over the number of the mode, and damping ratios."""
    found = points(given.rig, "modes", COLUMNS)
    if not len(found["frequency"]):
        return
    free = chosen(found, ~(found["standing"] > 0))
    stands = chosen(found, found["standing"] > 0)
    parts = [(one, along, label) for one, along, label in (
        (free, "nodal_diameter", "waves around the free wheel"), (stands, "mode", "mode of the standing wheel"))
        if len(one["frequency"]) and np.isfinite(one[along]).any()]
    damped = np.isfinite(found["damping_ratio"]).any()
    figure, axes = panels(len(parts) + int(damped)) if parts or damped else (None, [])
    if figure is None:
        return
    pressures = few(levels(found["pressure"]))
    for ax, (one, along, label) in zip(axes, parts):
        _marks(ax, one, pressures, along, "frequency")
        ax.set(xlabel=label, ylabel="frequency (Hz)", ylim=(0, None))
        ax.xaxis.get_major_locator().set_params(integer=True)
    if damped:
        _marks(axes[-1], found, pressures, "frequency", "damping_ratio", 100.0)
        axes[-1].set(xlabel="frequency (Hz)", ylabel="damping ratio (%)", xlim=(0, None), ylim=(0, None))
    legend(figure, given.airs(pressures), lines=False)
    yield Drawn("modes", "modes", f"Natural frequencies of the {'' if given.rig.plane else 'inflated '}wheel on a fixed rim, "
                f"{'free' if given.rig.plane else 'free and standing on the ground'}{by_air(pressures)}.", figure)


def _marks(ax: Axes, found: Columns, pressures: list[float], x: str, y: str, factor: float = 1.0) -> None:
    for k, pressure in enumerate(pressures):
        one = chosen(found, np.isclose(found["pressure"], pressure, rtol=1e-6))
        ax.plot(one[x], factor * one[y], MARKS[k], markersize=3.2, markerfacecolor="none", markeredgewidth=0.8,
                color=style.CURVES[k]["color"])

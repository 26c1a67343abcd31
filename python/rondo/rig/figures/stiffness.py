# SPDX-License-Identifier: BSD-3-Clause
"""Stiffnesses of a rig over the load: radial, cornering and slip stiffness, pneumatic trail."""
from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..points import Columns, chosen, levels
from ..slopes import cornering, load_deflection, slip_stiffness
from .drawing import AXES, Drawn, Given, by_air, curve, few, legend, panels


def draw(given: Given) -> Iterator[Drawn]:
    yield from _vertical(given)
    yield from _cornering(given)
    yield from _slip(given)


def _vertical(given: Given) -> Iterator[Drawn]:
    """Load over deflection, and its slope over the load, by pressure."""
    curves = load_deflection(given.rig)
    if not curves:
        return
    figure, (left, right) = panels(2)
    for k, pressure in enumerate(few(list(curves))):
        one = curves[pressure]
        curve(left, k, 1e3 * one["deflection"], 1e-3 * one["load"])
        curve(right, k, 1e-3 * one["load"], 1e-3 * one["stiffness"])
    left.set(xlabel="deflection (mm)", ylabel=given.load_label, xlim=(0, None), ylim=(0, None))
    right.set(xlabel=given.load_label, ylabel=f"radial stiffness $dF_z/dz$ ({given.unit('N/mm')})", xlim=(0, None), ylim=(0, None))
    legend(figure, given.airs(few(list(curves))))
    yield Drawn("vertical", "vertical", "Load over the deflection, and radial stiffness, the slope of that curve, over "
                f"the load{by_air(list(curves))}.", figure)


def _cornering(given: Given) -> Iterator[Drawn]:
    found = cornering(given.rig)
    if not len(found["load"]):
        return
    figure, (left, right) = panels(2)
    pressures = few(levels(found["pressure"]))
    for k, pressure in enumerate(pressures):
        one = _sorted(chosen(found, np.isclose(found["pressure"], pressure, rtol=1e-6)))
        curve(left, k, 1e-3 * one["load"], 1e-3 * np.radians(one["stiffness"]))
        curve(right, k, 1e-3 * one["load"], 1e3 * one["trail"])
    left.set(xlabel=given.load_label, ylabel=r"cornering stiffness $-dF_y/d\alpha$ (kN/°)", xlim=(0, None), ylim=(0, None))
    right.set(xlabel=given.load_label, ylabel="pneumatic trail (mm)", xlim=(0, None), ylim=(0, None))
    legend(figure, given.airs(pressures))
    yield Drawn("lateral", "cornering-stiffness", "Cornering stiffness and pneumatic trail at small slip angles over the "
                f"load, by pressure of the air. {AXES}.", figure)


def _slip(given: Given) -> Iterator[Drawn]:
    found = slip_stiffness(given.rig)
    if not len(found["load"]):
        return
    figure, (ax,) = panels(1, narrow=True)
    pressures = few(levels(found["pressure"]))
    for k, pressure in enumerate(pressures):
        one = _sorted(chosen(found, np.isclose(found["pressure"], pressure, rtol=1e-6)))
        curve(ax, k, 1e-3 * one["load"], 1e-5 * one["stiffness"])
    ax.set(xlabel=given.load_label, ylabel=rf"slip stiffness $dF_x/d\kappa$ ({given.unit('kN/%')})", xlim=(0, None), ylim=(0, None))
    legend(figure, given.airs(pressures))
    yield Drawn("longitudinal", "slip-stiffness", "Slip stiffness at small slip ratios over the load"
                f"{by_air(pressures)}. {AXES}.", figure)


def _sorted(found: Columns) -> Columns:
    order = np.argsort(found["load"])
    return {name: values[order] for name, values in found.items()}

# SPDX-License-Identifier: BSD-3-Clause
"""Combined slip of a rig: forces along and across the wheel, and the ellipse that friction allows."""
from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from matplotlib.patches import Circle

from ..against import rows_near
from ..fit_rows import INPUTS
from ..points import chosen, levels, nominal, points
from .drawing import (AXES, FX, FY, SLIP_RATIO, Drawn, Given, cross, curve, few, legend, measured, panels)
from .slip import fitted_curve

TESTS = ("combined", "longitudinal")  # whose points are drawn: the second at no slip angle
HEIGHT = 3.6  # in


def draw(given: Given) -> Iterator[Drawn]:
    """F_y over F_x and both over the slip ratio, at each load that has combined slip, by slip angle."""
    parts = [points(given.rig, test, (*INPUTS, "Fx", "Fy")) for test in TESTS]
    if not len(parts[0]["load"]):
        return
    found = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    pressure = nominal(given.rig, "pressure", parts[0]["pressure"])
    found = chosen(found, ~(np.abs(found["camber"]) > 1e-9) & ~(np.abs(found["pressure"] - pressure) > 1e-6 * pressure))
    friction = given.rig.settings.get("friction")
    for load in levels(parts[0]["load"]):
        here = chosen(found, np.isclose(found["load"], load, rtol=1e-6))
        angles = few(levels(here["slip_angle"]))
        figure, (left, right) = panels(2, height=HEIGHT)
        factor, across = given.scaled(FY, here["Fy"])
        along = given.scaled(FX, here["Fx"])
        percent, ratio = given.scaled(SLIP_RATIO, here["slip_ratio"])
        for ax in (left, right):
            cross(ax)
        has_fit = False
        for k, angle in enumerate(angles):
            one = chosen(here, np.isclose(here["slip_angle"], angle, atol=1e-9))
            state = {"load": float(load), "pressure": pressure, "camber": 0.0, "slip_angle": angle}
            x, y = (fitted_curve(given, state, "slip_ratio", one["slip_ratio"], name) for name in ("Fx", "Fy"))
            has_fit |= x is not None
            curve(left, k, along[0] * one["Fx"], factor * one["Fy"],
                  None if x is None or y is None else (along[0] * x[1], factor * y[1]), order=one["slip_ratio"])
            curve(right, k, percent * one["slip_ratio"], along[0] * one["Fx"],
                  None if x is None else (percent * x[0], along[0] * x[1]))
        if friction:
            left.add_patch(Circle((0, 0), along[0] * friction * load, fill=False, color="0.6", linewidth=0.7))
        states = rows_near(given.against, "combined", {"load": float(load), "camber": 0.0, "pressure": pressure})
        if states is not None:
            measured(left, along[0] * states["Fx"], factor * states["Fy"])
        left.set(xlabel=along[1], ylabel=across, aspect="equal")
        right.set(xlabel=ratio, ylabel=along[1])
        legend(figure, [given.said("slip_angle", angle) for angle in angles], has_fit, states is not None)
        circle = f"; the circle is friction, {friction:g}, times the load" if friction else ""
        yield Drawn("combined", f"combined-{load / 1e3:g}kN", "Lateral over longitudinal force, and longitudinal force over "
                    f"the slip ratio, by slip angle, at {given.said('load', load)}, {given.said('pressure', pressure)}{circle}. {AXES}.",
                    figure)

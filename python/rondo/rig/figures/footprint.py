# SPDX-License-Identifier: BSD-3-Clause
"""The contact patch of a rig: pressure and shear in it, its size over the load."""
from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from matplotlib.axes import Axes

from ...plots.solid.footprint import can_fold, draw_pressure, folded, footprint_of, last_contact, window
from ..points import Array, Columns, chosen, levels, nominal, points
from . import plane_footprint
from .drawing import MOST, Drawn, Given, curve, few, legend, panels
from .runs import Missing, opened, with_runs

STATE = ("load", "camber", "pressure")
SIZES = (("contact_length", 1e3, "length (mm)"), ("contact_width", 1e3, "width (mm)"), ("contact_area", 1e4, "area (cm²)"),
         ("mean_pressure", 1e-5, "mean pressure (bar)"))
HEIGHT = 2.6  # in, of a row of maps
BESIDE = 2    # maps in a row


def draw(given: Given) -> Iterator[Drawn]:
    yield from (plane_footprint.draw(given) if given.rig.plane else _maps(given))
    yield from _sizes(given)


def _maps(given: Given) -> Iterator[Drawn]:
    """Pressures at the loads of the upright wheel, and with camber at the nominal load."""
    found, folders = with_runs(given.rig, "footprint", STATE)
    missing = Missing()
    drawn = [(k, run) for k in _shown(given, found) for run in opened(given.rig, folders[k], missing)]
    prints = [(k, folded(run) if can_fold(run) else footprint_of(run, last_contact(run))) for k, run in drawn]
    prints = [(k, one) for k, one in prints if len(one.node)]
    if not prints:
        return
    frames = [window(one) for _, one in prints]
    low, high = np.min([one[0] for one in frames], axis=0), np.max([one[1] for one in frames], axis=0)
    figure, axes = panels(min(BESIDE, len(prints)), -(-len(prints) // BESIDE), HEIGHT, narrow=len(prints) == 1)
    for ax, (k, one) in zip(axes, prints):
        draw_pressure(ax, one)
        _frame(ax, low, high)
        ax.set_title(f"{given.said('load', found['load'][k])}, {given.said('camber', found['camber'][k])}\n{ax.get_title()}")
    for ax in axes[len(prints):]:
        ax.set_visible(False)
    yield Drawn("footprint", "footprint", "Pressure in the contact patch, seen from above, the wheel rolls to the right; "
                f"arrows: shear by which the ground pushes the tread.{' Scales of colour differ.' if len(prints) > 1 else ''}{missing.words}", figure)


def _shown(given: Given, found: Columns) -> list[int]:
    """Rows: at most MOST, by load and then by camber."""
    if not len(found["load"]):
        return []
    load, pressure = (nominal(given.rig, name, found[name]) for name in ("load", "pressure"))
    here = ~(np.abs(found["pressure"] - pressure) > 1e-6 * pressure)
    upright = here & ~(np.abs(found["camber"]) > 1e-9)
    leaning = here & ~upright & np.isclose(found["load"], load)
    rows = [*np.flatnonzero(upright)[np.argsort(found["load"][upright])],
            *np.flatnonzero(leaning)[np.argsort(found["camber"][leaning])]]
    return [int(rows[int(k)]) for k in few(np.arange(len(rows), dtype=float))]


def _frame(ax: Axes, low: Array, high: Array) -> None:
    """One scale for all maps."""
    ax.set(xlim=(low[0], high[0]), ylim=(high[1], low[1]), aspect="equal", xlabel="ahead of the center (mm)",
           ylabel="to the right (mm)")


def _sizes(given: Given) -> Iterator[Drawn]:
    """Over the load, by camber at the nominal pressure."""
    found = points(given.rig, "footprint", (*STATE, *(name for name, _, _ in SIZES)))
    found = chosen(found, np.isfinite(found["contact_length"]))
    if len(levels(found["load"])) < 2:
        return
    pressure = nominal(given.rig, "pressure", found["pressure"])
    cambers = few(levels(found["camber"]))[:MOST]
    sizes = [one for one in SIZES if np.isfinite(found[one[0]]).any()]
    figure, axes = panels(2, -(-len(sizes) // 2))
    for ax, (name, factor, label) in zip(axes, sizes):
        for k, camber in enumerate(cambers):
            one = chosen(found, np.isclose(found["camber"], camber, atol=1e-9)
                         & ~(np.abs(found["pressure"] - pressure) > 1e-6 * pressure))
            curve(ax, k, 1e-3 * one["load"], factor * one[name])
        ax.set(xlabel=given.load_label, ylabel=label, xlim=(0, None), ylim=(0, None))
    if not given.rig.plane:
        legend(figure, [given.said("camber", camber) for camber in cambers])
    at = "" if given.rig.plane else f", at {given.said('pressure', pressure)}"
    yield Drawn("footprint", "footprint-size", "Size of the contact patch and mean pressure in it over the load"
                f"{'' if given.rig.plane else ', by camber'}{at}.", figure)

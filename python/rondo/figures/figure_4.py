# SPDX-License-Identifier: BSD-3-Clause
"""Figure 4: steady rolling with four coefficients of friction: displacement and contact."""
from __future__ import annotations

from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from .. import style
from ..plots.contact import TractionProfile, ground_of, mean_force, traction_profile
from ..plots.field import draw_body, draw_contact, draw_ground, nodal
from ..plots.marks import letter, minus

if TYPE_CHECKING:
    from ..data.paper import Paper
    from ..data.run import Run

FRICTION = ("0.0", "0.2", "0.4", "0.6")
WINDOW = (0.105, 0.018, 0.082)  # m: to both sides of the center, below and above the ledge
QUANTITIES = (("displacement", "|u| (mm)"),
              ("displacement_x", "u along x (mm)"))


def draw(paper: Paper) -> dict[str, Figure]:
    runs = [paper.run(f"friction-{name}") for name in FRICTION]
    return {"figure-4-displacement": _displacement(runs), "figure-4-contact": _contact(runs)}


def _displacement(runs: list[Run]) -> Figure:
    """One snapshot of each run, at the same time: the disks have then turned by the same angle, so
    their nodes stand at the same places before they are displaced."""
    time = min(float(run.times[-1]) for run in runs)
    with style.paper():
        figure = plt.figure(figsize=(style.PAGE, 2.5))
        grid = figure.add_gridspec(2, 4)
        for row, (quantity, label) in enumerate(QUANTITIES):
            fields = [nodal(run, run.index(time), quantity) for run in runs]
            top = max(np.abs(field.values).max() for field in fields)
            limits = (-top if fields[0].signed else 0.0, top)
            axes = [figure.add_subplot(grid[row, column]) for column in range(4)]
            for column, (ax, run) in enumerate(zip(axes, runs)):
                k = run.index(time)
                x = float(run.center[k][0])
                ledge = float(ground_of(run).corners[-1, 1])
                ax.set(xlim=(x - WINDOW[0], x + WINDOW[0]), aspect="equal",
                       ylim=(ledge - WINDOW[1], ledge + WINDOW[2]))
                draw_ground(ax, ground_of(run), ax.get_xlim(), ledge - 1)
                body = draw_body(ax, run, k, quantity, limits=limits, mesh_width=0.2)
                draw_contact(ax, run, k)
                ax.set_xticks(x + np.array([-0.1, 0.0, 0.1]), ["\N{MINUS SIGN}100", "0", "100"])
                ax.set_yticks([ledge, ledge + 0.05], ["0", "50"])
                ax.tick_params(labelleft=column == 0, labelbottom=row == 1)
                ax.set_ylabel("y (mm)" if column == 0 else "")
                ax.set_xlabel("x off the center (mm)" if row == 1 else "")
                name = f"μ = {run.friction:.1f}" if row == 0 else ""
                letter(ax, "abcdefgh"[4 * row + column], name)
            figure.colorbar(body.cells, ax=axes, label=label, pad=0.01, aspect=12)
        figure.suptitle(f"One snapshot of each run, t = {time * 1e3:.1f} ms; bar: nodes in contact",
                        fontsize=7)
    return figure


def _contact(runs: list[Run]) -> Figure:
    """Pressure and shear along the ground, means over all snapshots (see `traction_profile`)."""
    profiles = [traction_profile(run) for run in runs]
    with style.paper():
        figure = plt.figure(figsize=(style.PAGE, 3.4))
        axes = figure.subplots(2, 4, sharex=True, sharey="row")
        for column, (run, profile) in enumerate(zip(runs, profiles)):
            above, below = axes[0][column], axes[1][column]
            x, pressure, shear = (1e3 * profile.x, 1e-6 * profile.pressure, 1e-6 * profile.shear_x)
            force = mean_force(run)
            above.plot(x, pressure, **style.CURVES[0])
            above.fill_between(x, pressure, color=style.BLUE, alpha=0.15, lw=0)
            above.text(0.5, 0.06, f"in all {_kilo(force[1])}", transform=above.transAxes,
                       ha="center", fontsize=7)
            limit = (run.friction or 0.0) * pressure
            below.fill_between(x, -limit, limit, color="0.88", lw=0)
            below.plot(x, limit, color="0.45", lw=0.6)
            below.plot(x, -limit, color="0.45", lw=0.6)
            below.plot(x, shear, **style.CURVES[1])
            below.axhline(0, color="0.6", lw=0.5, zorder=0)
            below.text(0.5, 0.03, f"in all {_kilo(force[0])}", transform=below.transAxes,
                       ha="center", fontsize=7)
            below.set_xlabel("x off the center (mm)")
            letter(above, "abcd"[column], f"μ = {run.friction:.1f}")
            letter(below, "efgh"[column])
        axes[0][0].set(ylabel="mean pressure (MPa)", ylim=(0, None), xlim=_shown(profiles))
        low, high = axes[1][0].get_ylim()
        axes[1][0].set(ylabel="mean shear along x (MPa)", ylim=(low - 0.17 * (high - low), high))
        axes[1][1].text(0.5, 0.97, "grey: up to μ × pressure", transform=axes[1][1].transAxes,
                        ha="center", va="top", fontsize=7)
        axes[1][0].text(0.5, 0.97, f"means over windows\nof {1e3 * profiles[0].window:.1f} mm",
                        ha="center", va="top", transform=axes[1][0].transAxes, fontsize=7)
    return figure


def _kilo(force: float) -> str:
    """A force (N/m) in kN/m, without a minus before zero."""
    text = f"{1e-3 * force:.1f}"
    return minus(f"{'0.0' if float(text) == 0 else text} kN/m")


def _shown(profiles: list[TractionProfile]) -> tuple[float, float]:
    """mm: the part along x where there is any pressure, and a little more."""
    used = [1e3 * profile.x[profile.pressure > 0] for profile in profiles]
    return min(x.min() for x in used) - 6, max(x.max() for x in used) + 6

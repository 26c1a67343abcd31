# SPDX-License-Identifier: BSD-3-Clause
"""Figure 2: a disk spun up at once, with damping, without, and by both schemes."""
from __future__ import annotations

from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from .. import style
from ..plots.field import draw_body, frame_axes
from ..plots.marks import edge_displacement, energy, letter, relative_residual

if TYPE_CHECKING:
    from ..data.paper import Paper
    from ..data.run import Run

ZOOM = 0.012  # s, of the undamped oscillation: some four periods
SYMPLECTIC, PRINTED, CREATED = style.CURVES[:3]


def draw(paper: Paper) -> dict[str, Figure]:
    with style.paper():
        figure = plt.figure(figsize=(style.PAGE, 6.3))
        grid = figure.add_gridspec(3, 3)
        axes = [[figure.add_subplot(grid[row, column]) for column in range(3)] for row in range(3)]
        damped, undamped = paper.run("spin-up-damped"), paper.run("spin-up-undamped")
        closed_form = float(paper.row("damped-closed-form")["expected"])
        _damped_curve(axes[0][0], axes[0][1], damped, closed_form)
        _stationary_disk(axes[0][2], damped)
        _oscillation(axes[1][0], axes[1][1], undamped, closed_form)
        _ledger(axes[1][2], undamped)
        slow = (undamped, paper.run("spin-up-as-printed"))
        fast = (paper.run("spin-up-fast"), paper.run("spin-up-fast-as-printed"))
        _schemes(axes[2][0], *slow, logarithmic=False)
        _schemes(axes[2][1], *fast, logarithmic=True)
        _residuals(axes[2][2], slow, fast)
        for ax, name, (run, _) in ((axes[2][0], "g", slow), (axes[2][1], "h", fast)):
            letter(ax, name, f"both schemes, {_spin(run)}")
    return {"figure-2": figure}


def _spin(run: Run) -> str:
    return f"{run.spin:.0f} rad/s"


def _damped_curve(curve: Axes, error: Axes, run: Run, closed_form: float) -> None:
    time, radial = run.times * 1e3, edge_displacement(run)
    end = min(100.0, time[-1])  # ms; nothing is to be seen later
    curve.plot(time, radial * 1e3, **style.CURVES[0], label="computed")
    curve.axhline(closed_form * 1e3, color=style.BLACK, ls="--", lw=0.8, label="closed form")
    curve.set(xlim=(0, end), ylim=(0, None), xlabel="time (ms)",
              ylabel="radial displacement\nof the edge (mm)")
    curve.legend(loc="lower right")
    letter(curve, "a", f"damped, {_spin(run)}")
    difference = np.abs(radial / closed_form - 1)
    error.semilogy(time, difference, **style.CURVES[0])
    error.axhline(difference[-1], color=style.BLACK, ls="--", lw=0.8)
    error.annotate(f"that of the mesh:\n{100 * difference[-1]:.2g} %", (0.98, difference[-1]),
                   xycoords=("axes fraction", "data"), xytext=(0, 4), textcoords="offset points",
                   ha="right", va="bottom", fontsize=7)
    error.set(xlim=(0, time[-1]), ylim=(0.1 * difference[-1], 2), xlabel="time (ms)",
              ylabel="difference from the\nclosed form (–)")
    letter(error, "b", f"damped, {_spin(run)}")


def _stationary_disk(ax: Axes, run: Run) -> None:
    last = run.n_snapshots - 1
    body = draw_body(ax, run, last, frame="co-rotating", mesh_width=0)
    frame_axes(ax, run, last, "co-rotating")
    ax.set_adjustable("datalim")  # as high as the axes beside it
    ax.figure.colorbar(body.cells, ax=ax, label="displacement (mm)", shrink=0.9, pad=0.01,
                       aspect=15)
    letter(ax, "c", f"damped, {_spin(run)}, {run.times[last]:.1f} s")


def _oscillation(first: Axes, last: Axes, run: Run, closed_form: float) -> None:
    time, radial = run.times * 1e3, edge_displacement(run) * 1e3
    top = 1.15 * radial.max()
    span = ZOOM * 1e3
    for ax, start, name in ((first, time[0], "d"), (last, time[-1] - span, "e")):
        shown = (time >= start - 1e-9) & (time <= start + span + 1e-9)
        ax.plot(time[shown], radial[shown], color=style.BLUE, lw=0.8, marker="o", markersize=2)
        ax.axhline(closed_form * 1e3, color=style.BLACK, ls="--", lw=0.8)
        ax.set(xlim=(start, start + span), ylim=(min(-0.02, 1.15 * radial.min()), top),
               xlabel="time (ms)")
    first.set_ylabel("radial displacement\nof the edge (mm)")
    letter(first, "d", f"undamped, {_spin(run)}, start")
    last.tick_params(labelleft=False)
    letter(last, "e", f"undamped, {_spin(run)}, end")


def _ledger(ax: Axes, run: Run) -> None:
    h = run.history
    time = h["time_s"] * 1e3
    shown = time <= ZOOM * 1e3
    total = energy(run)
    for values, name, curve in ((h["kinetic"], "kinetic", style.CURVES[0]),
                                (h["strain"], "strain", style.CURVES[1]),
                                (total, "sum", {"color": "0.6", "linewidth": 2.5}),
                                (h["work_frame"], "frame's work", style.CURVES[2])):
        ax.plot(time[shown], values[shown], label=name, **curve)
    ax.set(xlim=(0, ZOOM * 1e3), ylim=(0, 1.45 * total[shown].max()), xlabel="time (ms)",
           ylabel="energy (J/m)")
    ax.legend(loc="upper right", ncol=2, columnspacing=0.6, handlelength=1.2, handletextpad=0.4,
              borderpad=0.0, borderaxespad=0.0)
    letter(ax, "f", f"undamped, {_spin(run)}")


def _schemes(ax: Axes, symplectic: Run, printed: Run, logarithmic: bool) -> None:
    """The largest energy so far, which only growth can raise: the energy itself swings from nearly
    nothing to that with each period."""
    for run, name, curve in ((symplectic, "symplectic", SYMPLECTIC),
                             (printed, "as printed", PRINTED)):
        ax.plot(run.history["time_s"], np.maximum.accumulate(energy(run)), label=name, **curve)
    created = np.maximum.accumulate(printed.history["work_scheme"])
    ax.plot(printed.history["time_s"], created, label="created by the scheme", **CREATED)
    if logarithmic:
        ax.set_yscale("log")
        ax.set_ylim(0.02 * energy(symplectic).max(), None)
    else:
        ax.set_ylim(0, None)
        ax.legend(loc="center left", bbox_to_anchor=(0.0, 0.45), handlelength=1.8,
                  borderaxespad=0.2)
    ax.set(xlim=(0, symplectic.history["time_s"][-1]), xlabel="time (s)",
           ylabel="energy, largest\nso far (J/m)")


def _residuals(ax: Axes, slow: tuple[Run, Run], fast: tuple[Run, Run]) -> None:
    for runs, width in ((slow, 0.8), (fast, 1.6)):
        for run, name, curve in zip(runs, ("symplectic", "as printed"), (SYMPLECTIC, PRINTED)):
            largest = np.maximum.accumulate(relative_residual(run))
            ax.semilogy(run.history["time_s"], np.maximum(largest, 1e-18), lw=width,
                        label=f"{name}, {run.spin:.0f} rad/s", **curve)
    ax.axhline(np.finfo(float).eps, color="0.6", lw=0.8, zorder=0)
    ax.annotate("round-off of one number", (0.98, np.finfo(float).eps),
                xycoords=("axes fraction", "data"), xytext=(0, -2), textcoords="offset points",
                ha="right", va="top", fontsize=7, color="0.35")
    ax.set(xlim=(0, slow[0].history["time_s"][-1]), ylim=(1e-17, 1e-12), xlabel="time (s)",
           ylabel="largest residual so far (–)")
    ax.legend(loc="upper left", handlelength=1.8, borderpad=0.0)
    letter(ax, "i", "residual of the ledger")

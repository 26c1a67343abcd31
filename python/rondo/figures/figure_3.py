# SPDX-License-Identifier: BSD-3-Clause
"""Figure 3: the disk climbing onto the ledge, a close view of the contact under each picture."""
from __future__ import annotations

from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from .. import style
from . import figure_3_forces
from ..plots.contact import contact_of, draw_tractions, ground_of
from ..plots.field import Body, draw_body, draw_contact, draw_ground, nodal
from ..plots.marks import letter, minus

if TYPE_CHECKING:
    from ..data.paper import Paper
    from ..data.run import Run

TIMES = (0.0125, 0.0625, 0.1)  # s, those of the paper's figure 3
WHOLE = (0.35, 0.42, 0.31)  # m from the center: to both sides, down, up
CLOSE = (0.11, 0.04, 0.055)  # m: to both sides of the center, below and above the ledge
ARROW = 0.022  # m, length of the arrow of the largest traction


def draw(paper: Paper) -> dict[str, Figure]:
    runs = {"smooth": paper.run("ledge-smooth"), "treaded": paper.run("ledge-treaded")}
    chosen = {name: [run.index(time) for time in TIMES] for name, run in runs.items()}
    top = max(nodal(runs[name], k, "displacement").values.max()  # one scale for both bodies
              for name, indices in chosen.items() for k in indices)
    figures = {f"figure-3-{name}": _disks(run, chosen[name], top) for name, run in runs.items()}
    return {**figures, **figure_3_forces.draw(paper)}


def _disks(run: Run, chosen: list[int], top: float) -> Figure:
    tractions = [float(np.linalg.norm(contact_of(run).traction[k], axis=1).max()) for k in chosen]
    with style.paper():
        figure = plt.figure(figsize=(style.PAGE, 4.0))
        heights = (WHOLE[1] + WHOLE[2], (CLOSE[1] + CLOSE[2]) * WHOLE[0] / CLOSE[0])
        grid = figure.add_gridspec(2, 3, height_ratios=heights)
        for column, k in enumerate(chosen):
            whole, close = (figure.add_subplot(grid[row, column]) for row in range(2))
            body = _whole(whole, run, k, top)
            _close(close, run, k, top, max(tractions) or 1.0)
            letter(whole, "abc"[column], f"t = {run.times[k] * 1e3:.1f} ms")
            said = f"traction up to {tractions[column] * 1e-6:.1f} MPa"
            letter(close, "def"[column], said if tractions[column] else "not yet in contact")
            for ax, name in ((whole, "y (m)"), (close, "y (mm)")):
                ax.set_ylabel(name if column == 0 else "")
                ax.tick_params(labelleft=column == 0)
        figure.colorbar(body.cells, ax=figure.axes, label="displacement (mm)", shrink=0.7,
                        aspect=28, pad=0.015)
    return figure


def _whole(ax: Axes, run: Run, k: int, top: float) -> Body:
    x, y = run.center[k]
    ax.set(xlim=(x - WHOLE[0], x + WHOLE[0]), ylim=(y - WHOLE[1], y + WHOLE[2]), aspect="equal",
           xlabel="x (m)")
    draw_ground(ax, ground_of(run), ax.get_xlim(), y - 1)
    body = draw_body(ax, run, k, limits=(0, top), mesh_width=0)
    draw_contact(ax, run, k, width=1.5)
    low, high = _close_window(run, k)
    ax.add_patch(Rectangle((low[0], low[1]), high[0] - low[0], high[1] - low[1], fill=False,
                           edgecolor=style.BLUE, lw=0.6, zorder=5))
    return body


def _close_window(run: Run, k: int) -> tuple[tuple[float, float], tuple[float, float]]:
    """Lower left and upper right corner (m) of the close view, about where the ledge is or will be
    touched."""
    x, ledge = float(run.center[k][0]), float(ground_of(run).corners[-1, 1])
    return (x - CLOSE[0], ledge - CLOSE[1]), (x + CLOSE[0], ledge + CLOSE[2])


def _close(ax: Axes, run: Run, k: int, top: float, traction: float) -> None:
    low, high = _close_window(run, k)
    ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal", xlabel="x (mm)")
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_formatter(lambda value, _: minus(f"{value * 1e3:.0f}"))
        axis.set_major_locator(plt.MultipleLocator(0.05))
    draw_ground(ax, ground_of(run), ax.get_xlim(), low[1] - 1)
    draw_body(ax, run, k, limits=(0, top), mesh_width=0.25)
    draw_contact(ax, run, k, width=2.5)
    draw_tractions(ax, run, k, ARROW / traction)

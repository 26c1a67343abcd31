# SPDX-License-Identifier: BSD-3-Clause
"""The rigid rim that holds a body: a grey disk, and a thick line along what it holds."""
from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Polygon
from numpy.typing import NDArray

from .. import style
from .cells import outline, turned

if TYPE_CHECKING:
    from ..data.run import Run

Array = NDArray[np.float64]
WIDTH = 1.4  # pt
ROUND = 1e-3  # spread of the radii of what is held, over the largest: on one circle, about
CIRCLE = np.linspace(0.0, 2 * np.pi, 181)


@dataclasses.dataclass
class Rim:
    """The rim drawn on an axes; `update` shows it at another snapshot. The mark is a radius,
    straight down at angle 0: a smooth disk would not be seen to turn."""

    run: Run
    frame: str
    radius: float  # m, of the grey disk; 0: none
    disk: Polygon
    line: Line2D
    mark: Line2D
    sides: Array  # (3 k, 2) m, turning frame: ends of k sides, each with nan behind it

    def update(self, index: int) -> None:
        fixed = self.frame == "fixed"
        center = np.asarray(self.run.center[index]) if fixed else np.zeros(2)
        angle = float(self.run.angle[index]) if fixed else 0.0
        circle = self.radius * np.stack([np.cos(CIRCLE), np.sin(CIRCLE)], axis=1)
        self.disk.set_xy(center + circle)
        self.line.set_data(*(center + turned(self.sides, angle)).T)
        spoke = self.radius * turned(np.array([[0.0, -0.6], [0.0, -1.0]]), angle)
        self.mark.set_data(*(center + spoke).T)


def draw_rim(ax: Axes, run: Run, index: int, frame: str = "fixed") -> Rim | None:
    """The rim of the snapshot `index`, its mark hidden; None where nothing is held."""
    held = run.held
    if not held.any():
        return None
    places = run.mesh.coordinates
    radii = np.linalg.norm(places[held], axis=1)
    is_round = np.ptp(radii) <= ROUND * radii.max()
    sides = outline(run.mesh.cells)
    disk = Polygon(np.zeros((1, 2)), color=style.RIM, linewidth=0, zorder=0.6, visible=is_round)
    line, = ax.plot([], [], color=style.OUTLINE, linewidth=WIDTH, solid_capstyle="round", zorder=1.1,
                    label="_rim")
    mark, = ax.plot([], [], color=style.OUTLINE, linewidth=1.2, visible=False)
    ax.add_patch(disk)
    ends = places[sides[held[sides].all(axis=1)]]
    gaps = np.full((len(ends), 1, 2), np.nan)
    rim = Rim(run, frame, float(radii.max()) if is_round else 0.0, disk, line, mark,
              np.concatenate([ends, gaps], axis=1).reshape(-1, 2))
    rim.update(index)
    return rim

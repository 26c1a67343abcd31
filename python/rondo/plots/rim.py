# SPDX-License-Identifier: BSD-3-Clause
"""The rigid rim that holds a body: a grey disk, and a thick line along what it holds."""
from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any

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
Cells = NDArray[np.integer[Any]]
WIDTH = 1.4  # pt
ROUND = 1e-3  # spread of the radii of what is held, over the largest: on one circle, about
AROUND = np.linspace(0.0, 2 * np.pi, 181)
UNIT = np.stack([np.cos(AROUND), np.sin(AROUND)], axis=1)  # a circle


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
    sides: Array  # (3 k, 2) m, co-rotating frame: ends of k sides, each with nan behind it

    def update(self, index: int) -> None:
        fixed = self.frame == "fixed"
        center = np.asarray(self.run.center[index]) if fixed else np.zeros(2)
        angle = float(self.run.angle[index]) if fixed else 0.0
        self.disk.set_xy(center + self.radius * UNIT)
        self.line.set_data(*(center + turned(self.sides, angle)).T)
        spoke = self.radius * turned(np.array([[0.0, -0.6], [0.0, -1.0]]), angle)
        self.mark.set_data(*(center + spoke).T)


def draw_rim(ax: Axes, run: Run, index: int, frame: str = "fixed") -> Rim | None:
    """The rim of the snapshot `index`, its mark hidden; None where nothing is constrained."""
    if not run.held.any():
        return None
    radius, sides = shape(run.mesh.coordinates, run.mesh.cells, run.held)
    rim = Rim(run, frame, radius, *_artists(ax, radius), sides)
    rim.update(index)
    return rim


def draw_still_rim(ax: Axes, coordinates: Array, cells: Cells, held: NDArray[np.bool_]) -> None:
    """The rim in the co-rotating frame, of the nodes that are held (n,)."""
    if held.any():
        radius, sides = shape(coordinates, cells, held)
        disk, line, _ = _artists(ax, radius)
        disk.set_xy(radius * UNIT)
        line.set_data(*sides.T)


def shape(coordinates: Array, cells: Cells, held: NDArray[np.bool_]) -> tuple[float, Array]:
    """m and (3 k, 2) m: the radius of the circle on which all that is held is, or 0, and the sides
    that are held, see Rim."""
    radii = np.linalg.norm(coordinates[held], axis=1)
    sides = outline(cells)
    ends = coordinates[sides[held[sides].all(axis=1)]]
    gaps = np.full((len(ends), 1, 2), np.nan)
    is_round = np.ptp(radii) <= ROUND * radii.max()
    return float(radii.max()) * is_round, np.concatenate([ends, gaps], axis=1).reshape(-1, 2)


def _artists(ax: Axes, radius: float) -> tuple[Polygon, Line2D, Line2D]:
    disk = Polygon(np.zeros((1, 2)), color=style.RIM, linewidth=0, zorder=0.6, visible=radius > 0)
    ax.add_patch(disk)
    line, = ax.plot([], [], color=style.OUTLINE, linewidth=WIDTH, solid_capstyle="round",
                    zorder=1.1, label="_rim")
    mark, = ax.plot([], [], color=style.OUTLINE, linewidth=1.2, visible=False, label="_mark")
    return disk, line, mark

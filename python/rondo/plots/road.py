# SPDX-License-Identifier: BSD-3-Clause
"""The heights of a road from above."""
from __future__ import annotations

from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes

from .. import style
from ..data.errors import InputError
from .labels import axes_of, readable

if TYPE_CHECKING:
    from ..data.run import Run
    from ..files import Road

HEIGHT = 2.2    # in
MOST = 1200     # heights along an axis: more are not seen


def _drawn(positions: np.ndarray, span: tuple[float, float] | None, name: str) -> np.ndarray:
    """Indices of positions within the span, not more than MOST."""
    first, last = (positions[0], positions[-1]) if span is None else span
    inside = np.flatnonzero((positions >= first) & (positions <= last))
    if len(inside) < 2:
        raise InputError(f"{name} = {span}: under two rows of the grid are in this span (allowed: a part "
                         f"of {positions[0]:g} to {positions[-1]:g} m)")
    return inside[::max(1, -(-len(inside) // MOST))]


@style.paper()
def plot_road(road: Road, ax: Axes | None = None, u: tuple[float, float] | None = None,
              v: tuple[float, float] | None = None) -> Axes:
    """Heights over u and v, of the whole grid or of spans (from, to) in m; white where they are missing.
    Both directions have one scale, unless the road is then too flat to be seen."""
    rows, columns = _drawn(road.u, u, "u"), _drawn(road.v, v, "v")
    at_u, at_v = road.u[rows], road.v[columns]
    z = np.where(np.isnan(road.heights[np.ix_(rows, columns)]), np.nan,
                 road.height(at_u[:, None], at_v[None, :]))
    factor, unit = readable(float(np.nanmax(np.abs(z))), "m")
    ax = axes_of(ax, HEIGHT)
    image = ax.pcolormesh(at_u, at_v, factor * z.T, cmap=style.SEQUENTIAL, shading="nearest",
                          rasterized=True)
    if (at_v[-1] - at_v[0]) > 0.1 * (at_u[-1] - at_u[0]):
        ax.set_aspect("equal")
    plt.colorbar(image, ax=ax, label=f"height ({unit})", shrink=0.9)
    ax.set_xlabel("u, along the reference line (m)")
    ax.set_ylabel("v, to the left (m)")
    ax.set_title(road.file.name)
    return ax


def plot_track(run: Run, ax: Axes | None = None) -> Axes:
    """The road of a run in three dimensions where the wheel comes: the way of its center, and of both sides
    of the undeformed tread."""
    from ..files import read_crg
    ground = run.case.get("ground", {})
    if "road" not in ground:
        raise InputError(f"{run.directory}: its case.toml has no ground.road (allowed: a wheel with a width on a "
                         "measured road)")
    road = read_crg(run.directory / ground["road"])
    u = run.center[:, 0] + float(ground["road_start"])
    v = float(ground.get("road_offset", 0.0)) - run.lateral
    half, reach = 0.5 * float(np.ptp(run.mesh.coordinates[:, 2])), run.outer_radius
    ax = plot_road(road, ax, (u.min() - reach, u.max() + reach),
                   (v.min() - 2 * half, v.max() + 2 * half))
    ax.plot(u, v, color=style.GREEN, linewidth=1.5)
    for side in (-half, half):
        ax.plot(u, v + side, color=style.GREEN, linewidth=1, linestyle="--")
    return ax

# SPDX-License-Identifier: BSD-3-Clause
"""The section of an inflated wheel, before and after, with its layers of cords."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import to_rgb
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy.typing import NDArray

from ... import style
from ...data.errors import Error
from ..cells import Cells, corners, loops, outline
from ..labels import readable, share_of_loads
from ..marks import minus

if TYPE_CHECKING:
    from ...data.run import Run
    from ...data.section import Section

Array = NDArray[np.float64]
# Of regions, pale, so that the lines of cords are seen on them; told apart by their greys too.
TINTS = tuple(tuple(1.0 - light * (1.0 - part) for part in to_rgb(colour)) for colour, light in (
    (style.BLUE, 0.45), (style.ORANGE, 0.35), (style.GREEN, 0.3), (style.BLACK, 0.18), (style.PURPLE, 0.45),
    (style.SKY, 0.35), (style.VERMILLION, 0.5), (style.BLACK, 0.4), (style.ORANGE, 0.7), (style.BLUE, 0.2)))
BEFORE = {"color": "0.45", "linewidth": 0.6}
CORD = 1.6  # pt
NAMES = 1.6  # in, of the names beside the picture
SLIM = 0.35  # least height of the picture over its width
TALLEST = 4.6  # in


def cord_style(number: int) -> dict[str, Any]:
    """How a layer of cords looks in all figures: more than there are curves have thicker lines."""
    turn, place = divmod(number, len(style.CURVES))
    return style.CURVES[place] | {"linewidth": CORD + 0.8 * turn}


@style.paper()
def plot_section(run: Run, time: float | None = None, ax: Axes | None = None,
                 deformation: float = 1.0) -> Axes:
    """The section of an inflated wheel: undeformed as a thin grey line, and in the colours of its
    regions at the snapshot nearest to `time` (share of the loads), by default the last, with its layers
    of cords. deformation: factor on the displacement. z is the place along the axle, r the distance from
    it, in equal scales."""
    section = run.section
    k = run.n_snapshots - 1 if time is None else run.index(time)
    before = 1e3 * _as_seen(section.coordinates)
    after = before + deformation * (1e3 * _as_seen(section.position[k]) - before)
    if ax is None:
        ax = plt.figure(figsize=_size(before, after)).add_subplot()
    cells = Cells(corners(after, section.cells), facecolors=_colours(section), edgecolors=style.MESH,
                  linewidths=0.1, zorder=1)
    ax.add_collection(cells)
    lines = loops(outline(section.cells))
    ax.add_collection(LineCollection([after[line] for line in lines], colors=style.OUTLINE, linewidths=0.6,
                                     joinstyle="round", zorder=2))
    ax.add_collection(LineCollection([before[line] for line in lines], label="undeformed", joinstyle="round",
                                     colors=BEFORE["color"], linewidths=BEFORE["linewidth"], zorder=4))
    drawn, missing = draw_cords(ax, run, after)
    ax.set_aspect("equal")
    ax.margins(0.03)
    ax.autoscale_view()
    ax.set_xlabel("z, along the axle (mm)")
    ax.set_ylabel("r, from the axle (mm)")
    ax.set_title(", ".join([heading(run, k), *([f"displacement × {deformation:g}"] if deformation != 1.0 else []),
                            *missing]))
    _name(ax, section, drawn)
    return ax


def heading(run: Run, k: int) -> str:
    """The loads of snapshot k."""
    share = float(run.times[k])
    given = run.case["inflation"]
    parts = [share_of_loads(share)]
    if given.get("pressure"):
        factor, unit = readable(share * float(given["pressure"]), "Pa")
        parts.append(f"pressure {factor * share * float(given['pressure']):.4g} {unit}")
    if run.spin:
        parts.append(f"spin {np.sqrt(share) * abs(run.spin):.4g} rad/s")
    return minus(", ".join(parts))


def draw_cords(ax: Axes, run: Run, places: Array) -> tuple[list[Line2D], list[str]]:
    """A line for each layer of cords along its nodes, at places (m, 2); and what is to be said where
    there are layers that cannot be drawn."""
    if not run.case.get("cords"):
        return [], []
    try:
        cords = run.cords
    except Error:  # no equilibrium was found
        return [], ["without its cords: there is no cords.csv"]
    lines: list[Line2D] = []
    for number, (name, layer) in enumerate(cords.items()):
        chains = run.section.nodes_along(layer, run.n_snapshots - 1)
        if chains is None:
            return lines, ["without its cords: cords.csv is of later loads than the last snapshot"]
        apart = [np.append(places[nodes], [[np.nan, np.nan]], axis=0) for nodes in chains]
        lines += ax.plot(*np.concatenate(apart)[:-1].T, label=name, zorder=3, **cord_style(number))
    return lines, []


def _as_seen(places: Array) -> Array:
    """(..., 2): z to the right, r upwards."""
    return places[..., ::-1]


def _colours(section: Section) -> list[tuple[float, ...]]:
    if section.region is None:
        return [TINTS[3]] * len(section.cells)
    return [TINTS[int(number) % len(TINTS)] for number in section.region]


def _name(ax: Axes, section: Section, cords: list[Line2D]) -> None:
    """Names of cords and regions, to the right."""
    beside: dict[str, Any] = {"borderaxespad": 0.0, "alignment": "left"}
    lines = [Line2D([], [], **BEFORE), *cords]
    above = ax.legend(lines, ["undeformed", *(f"cords: {line.get_label()}" for line in cords)],
                      loc="upper left", bbox_to_anchor=(1.01, 1.0), **beside)
    if section.region is None or not section.region_names:
        return
    ax.add_artist(above).set_clip_on(False)  # else the layout leaves no room for it
    used = np.unique(section.region)
    patches = [Patch(facecolor=TINTS[int(k) % len(TINTS)], edgecolor=style.MESH, linewidth=0.3,
                     label=section.region_names[int(k)] or "other") for k in used]
    ax.legend(handles=patches, loc="lower left", bbox_to_anchor=(1.01, 0.0), title="regions", **beside,
              handlelength=1.4)


def _size(*places: Array) -> tuple[float, float]:
    """Of a figure in which the section has equal scales (in)."""
    both = np.concatenate(places)
    width, height = np.ptp(both, axis=0)
    room = style.PAGE - NAMES - 0.6
    return style.PAGE, float(np.clip(room * height / width + 0.75, SLIM * room + 0.75, TALLEST))

# SPDX-License-Identifier: BSD-3-Clause
"""Shapes of the modes of `rondo modes`: which are drawn, what is said of them, and plane bodies."""
from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from .. import style
from ..data.errors import Error
from .amplitude import without_crossing
from .cells import component, loops, outline
from .field import SLIM, draw_cells
from .marks import letter, minus
from .modes import COLUMNS, HELD, LARGEST, tidy
from .rim import draw_still_rim

if TYPE_CHECKING:
    from ..data.modes import Modes

Array = NDArray[np.float64]
SAME = 1e-6  # of a radius, or rad: places that are one
ALIKE = 1e-6  # relative difference of the frequencies of a pair at rest
BEFORE = {"colors": "0.45", "linewidths": 0.6, "linestyles": (0, (4, 2))}  # the undeformed body
HEADING = 0.82  # in, of the titles and the numbers at the axes of a row
ACROSS = 2.1  # in, of a panel
TALLEST = 1.2  # height of a panel over that
SPOKES = 12


@dataclass(frozen=True)
class Shape:
    """A mode to be drawn: real part (n, d) of its shape, the longest vector of length 1."""

    title: str
    vectors: Array


def shapes_of(modes: Modes, count: int, spin: float | None) -> list[Shape]:
    """The first `count` that are no rigid-body motions, of a pair at rest the first."""
    if count < 1:
        raise Error(f"count = {count}: at least 1 mode")
    groups = _groups(modes, modes.rows_at(spin))[:count]
    if not groups:
        raise Error(f"{modes.directory}: all modes are rigid-body motions, which are not drawn")
    shapes = []
    for rows in groups:
        vectors = modes.shape(rows[0]).real
        shapes.append(Shape(title(modes, rows), vectors / np.linalg.norm(vectors, axis=1).max()))
    return shapes


def _groups(modes: Modes, rows: NDArray[np.int64]) -> list[list[int]]:
    """Rows of the table, without rigid-body motions; a pair at rest together."""
    groups: list[list[int]] = []
    for row in rows.tolist():
        if groups and len(groups[-1]) == 1 and _is_pair(modes, groups[-1][0], row):
            groups[-1].append(row)
        elif modes.table["wave"][row] != "rigid":
            groups.append([row])
    return groups


def _is_pair(modes: Modes, first: int, second: int) -> bool:
    """Whether two modes are one wave at rest, a quarter of its length apart."""
    table = modes.table
    n, frequency, wave = (table[k] for k in ("nodal_diameters", "frequency_hz", "wave"))
    return bool(n[first] == n[second] > 0 and wave[first] == wave[second] == "standing"
                and np.isclose(frequency[first], frequency[second], rtol=ALIKE, atol=0.0))


def title(modes: Modes, rows: list[int]) -> str:
    """Numbers and frequency of a mode; below them nodal diameters, sense and damping, where known."""
    values = {name: column[rows[0]] for name, column in modes.table.items()}
    numbers = ", ".join(str(modes.table["mode"][row]) for row in rows)
    below = []
    if values["nodal_diameters"] >= 0:
        below.append(f"n = {values['nodal_diameters']}")
    if values["wave"] in ("forward", "backward"):
        below.append(values["wave"])
    if values["damping_ratio"] > 0:
        below.append(f"damping {100 * values['damping_ratio']:.3g} %")
    heading = f"mode{'s' * (len(rows) > 1)} {numbers}: {values['frequency_hz']:.4g} Hz"
    return "\n".join([heading, ", ".join(below)]) if below else heading


def heading(modes: Modes, spin: float | None) -> str:
    """What holds for all modes: spin, and how the wheel stands."""
    value = float(modes.table["spin_rad_s"][modes.rows_at(spin)[0]])
    parts = [f"spin {value:g} rad/s" if value else "at rest"]
    if standing := modes.summary.get("standing"):
        parts = [f"standing under {standing['load']:.4g} N"]
    return minus(", ".join(parts))


def plot_shapes(modes: Modes, count: int = 6, spin: float | None = None) -> Figure:
    """The first modes of a plane body that are no rigid-body motions, at this spin (rad/s), by
    default the first there is: the reference position plus the real part of the shape, over the
    undeformed outline (dashed). It is magnified until the longest vector is 0.12 of the body's half
    width, or less where the outline would cross itself. Colours: of a disk the radial part, of other
    bodies the length of the vector, over the longest vector. The lines across a disk were radii.

    The two waves of a pair at rest have one picture, because the second is the first one turned by a
    quarter of a wave. A travelling wave is drawn at phase 0; it keeps its shape and travels in the
    sense that the title says. What is not quite a travelling wave takes the shape of minus the
    imaginary part (`modes.shape(row).imag`) a quarter of a period later."""
    shapes, is_disk = shapes_of(modes, count, spin), modes.mesh.sector is not None
    low, high = _window(modes.mesh.coordinates)
    rows = -(-len(shapes) // COLUMNS)
    columns = min(COLUMNS, len(shapes))
    height = ACROSS * min(float((high - low)[1] / (high - low)[0]), TALLEST)
    with style.paper():
        figure = plt.figure(figsize=(style.PAGE, 0.7 + rows * (height + HEADING)))
        axes = figure.subplots(rows, columns, squeeze=False).ravel()
        for number, (ax, shape) in enumerate(zip(axes, shapes)):
            draw_shape(ax, modes, shape.vectors)
            ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
            letter(ax, "abcdefghijklmnopqrstuvwxyz"[number % 26], shape.title)
            _few_numbers(ax, high - low)
        for ax in axes[len(shapes):]:
            ax.remove()
        tidy(axes[:len(shapes)])
        figure.suptitle(heading(modes, spin), fontsize=8.0, x=0.01, horizontalalignment="left")
        limits, colours = ((-1.0, 1.0), style.DIVERGING) if is_disk else ((0.0, 1.0), style.SEQUENTIAL)
        figure.colorbar(ScalarMappable(Normalize(*limits), colours), ax=figure.axes,
                        location="bottom", shrink=0.5, aspect=40, pad=0.02,
                        label=f"{'radial part' if is_disk else 'motion'} over the longest vector (–)")
    return figure


def draw_shape(ax: Axes, modes: Modes, vectors: Array) -> None:
    coordinates, cells = modes.mesh.coordinates, modes.mesh.cells
    sides, is_disk = outline(cells), modes.mesh.sector is not None
    length = without_crossing(coordinates, vectors, sides, LARGEST * _half(coordinates))
    sizes = np.linalg.norm(vectors, axis=1)
    values = component(vectors, coordinates, "radial") if is_disk else sizes
    after = coordinates + length * vectors
    draw_cells(ax, after, cells, values, (-1.0 if is_disk else 0.0, 1.0), signed=is_disk, mesh_width=0)
    if is_disk:
        ax.add_collection(LineCollection(list(after[radial_sides(coordinates, cells)]), label="_radii",
                                         colors=style.OUTLINE, linewidths=0.5, zorder=1.4))
    ax.add_collection(LineCollection([coordinates[line] for line in loops(sides)], **BEFORE,
                                     zorder=1.5, label="_undeformed"))
    draw_still_rim(ax, coordinates, cells, sizes <= HELD)
    ax.set(xlabel="X (m)", ylabel="Y (m)")


def radial_sides(coordinates: Array, cells: NDArray[np.integer[Any]]) -> NDArray[np.int64]:
    """(k, 2): the sides of cells on radii of a disk, from its inner edge outwards, evenly apart."""
    angle, radius = np.arctan2(coordinates[:, 1], coordinates[:, 0]), np.linalg.norm(coordinates, axis=1)
    inner = np.flatnonzero(radius < radius.min() * (1 + SAME))
    inner = inner[np.argsort(angle[inner])]
    chosen = angle[inner[np.linspace(0, len(inner), SPOKES, endpoint=False).astype(int)]]
    apart = np.abs(np.angle(np.exp(1j * (angle[:, None] - chosen))))
    spoke = np.where(apart.min(axis=1) < SAME, apart.argmin(axis=1), -1)
    sides = np.stack([cells, np.roll(cells, -1, axis=1)], axis=-1).reshape(-1, 2).astype(np.int64)
    sides = np.unique(np.sort(sides[(sides >= 0).all(axis=1)], axis=1), axis=0)
    found: NDArray[np.int64] = sides[(spoke[sides[:, 0]] >= 0) & (spoke[sides[:, 0]] == spoke[sides[:, 1]])]
    return found


def _few_numbers(ax: Axes, size: Array) -> None:
    """At the slim side of a panel."""
    for axis, length in zip((ax.xaxis, ax.yaxis), size):
        if length < 0.7 * size.max():
            axis.set_major_locator(MaxNLocator(2))


def _half(coordinates: Array) -> float:
    return 0.5 * float(np.ptp(coordinates, axis=0).max())


def _window(coordinates: Array) -> tuple[Array, Array]:
    """Lower left and upper right corner of what is drawn, which is not slim."""
    low, high = coordinates.min(axis=0), coordinates.max(axis=0)
    room = 1.2 * LARGEST * _half(coordinates)
    margin = np.maximum(room, 0.5 * SLIM * (high - low).max() - 0.5 * (high - low))
    return low - margin, high + margin

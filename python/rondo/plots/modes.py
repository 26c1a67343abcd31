# SPDX-License-Identifier: BSD-3-Clause
"""Modes of a POD, in space and in time, and how fast their energy falls."""
from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from .. import style
from ..data.errors import Error
from .amplitude import without_crossing
from .field import cell_means, component, draw_cells, outline, turned
from .marks import letter
from .rim import draw_still_rim

if TYPE_CHECKING:
    from ..data.pod import Pod

Array = NDArray[np.float64]
Window = tuple[tuple[float, float], tuple[float, float]]
COLUMNS = 3
LARGEST = 0.12  # length of the largest vector of a mode as drawn, over the radius of the body,
LARGEST_CLOSE = 0.025  # and where only a part of the body is shown; less where outlines would cross
SMALL_MEAN = 0.1  # mean over root mean square of a course that swings about zero
SHARES = (1e-2, 1e-4, 1e-6)  # of the energy left out, for which the numbers of modes are told
MANY, FEW = 24, 8  # swings in time: more are not drawn, but these
HELD = 1e-12  # size of a mode over its largest, up to which the rim holds a node
FLOOR = 1e-14  # shares below are not drawn: round-off


def plot_pod_spectrum(pods: Sequence[Pod], ax: Axes | None = None,
                      labels: Sequence[str] | None = None) -> Axes:
    """Share of the energy left out over the number of modes kept, one curve for each POD."""
    with style.paper():
        if ax is None:
            ax = plt.figure(figsize=(style.COLUMN, 0.75 * style.COLUMN)).add_subplot()
        for share in SHARES:
            ax.axhline(share, color="0.85", lw=0.6, zorder=0)
        names = labels or [f"{pod.field}, {pod.kind}" for pod in pods]
        for number, (pod, name) in enumerate(zip(pods, names)):
            draw_decay(ax, pod, name, style.CURVES[number % len(style.CURVES)])
        ax.set(xlabel="modes kept (–)", ylabel="share of the energy left out (–)")
        if len(pods) > 1:
            ax.legend(loc="lower left")
    return ax


def draw_decay(ax: Axes, pod: Pod, label: str, curve: Mapping[str, Any]) -> None:
    """The curve of one POD; axes are logarithmic, as both the first modes and the last matter."""
    left = np.asarray(pod.discarded_energy)
    shown = left > FLOOR
    ax.loglog(1 + np.flatnonzero(shown), left[shown], label=label, **curve)


def plot_modes(pod: Pod, count: int = 6, window: Window | None = None) -> Figure:
    """The first modes of a POD, each with its course in time below.

    Modes of displacement and velocity are drawn as shapes: the reference position plus the mode,
    magnified until its largest vector is 0.12 of the radius (0.025 in a window), or less where the
    outline would cross itself, and coloured by its radial part over the largest of all cells.
    Those of the rectified frame stand as in the fixed one, with the ground below. `window`:
    ((x from, to), (y from, to)) m, the part of the body shown; None: all of it. Modes of contact
    are curves of their normal and tangential part along the edge.

    The courses in time are the columns of V, times the root of the number of snapshots, so that
    their mean square is 1; they have no unit. Where they swing fast, only the first periods are
    shown. A mode and its course may be turned over together: they are drawn such that the course is
    positive in the mean, or where it has none to speak of, at its largest (see `sign`).
    """
    if count < 1:
        raise Error(f"count = {count}: at least 1 mode")
    count = min(count, pod.n_modes)
    if count < 1:
        raise Error(f"{pod.directory}: the POD has no modes: all its snapshots are zero")
    rows = -(-count // COLUMNS)
    contact = pod.field == "contact"
    tall = 1.0 if contact else 2.1 * (_height(window) if window else 1.0)
    with style.paper():
        figure = plt.figure(figsize=(style.PAGE, rows * (tall + 1.5)))
        ratios = (tall, 0.7)
        grid = figure.add_gridspec(2 * rows, COLUMNS, height_ratios=ratios * rows)
        shown = course_shown(pod, count)
        space: list[Axes] = []
        course: list[Axes] = []
        for mode in range(count):
            row, column = divmod(mode, COLUMNS)
            space.append(figure.add_subplot(grid[2 * row, column]))
            course.append(figure.add_subplot(grid[2 * row + 1, column]))
            if contact:
                draw_contact_mode(space[mode], pod, mode)
            else:
                draw_mode(space[mode], pod, mode, window)
            draw_course(course[mode], pod, mode, shown)
            letter(space[mode], "abcdefghijklmnopqrstuvwxyz"[mode % 26],
                   f"mode {mode + 1}: {percent(pod.energy[mode])} of energy")
        tidy(space)
        tidy(course)
        if contact:
            figure.legend(*space[0].get_legend_handles_labels(), loc="upper center", ncol=2)
            figure.get_layout_engine().set(rect=(0, 0, 1, 1 - 0.1 / rows))  # room for the legend
        else:
            figure.colorbar(space[0].collections[0], ax=figure.axes, shrink=0.5, aspect=30,
                            pad=0.01, label="radial part over its largest (–)")
    return figure


def tidy(axes: Sequence[Axes]) -> None:
    """Panels side by side share what their axes say: the same limits, numbers at the left only."""
    low = min(ax.get_ylim()[0] for ax in axes)
    high = max(ax.get_ylim()[1] for ax in axes)
    for number, ax in enumerate(axes):
        ax.set_ylim(low, high)
        if number % COLUMNS:
            ax.set_ylabel("")
            ax.tick_params(labelleft=False)


def percent(share: float) -> str:
    """A share of the energy as text."""
    if share >= 0.01:
        return f"{100 * share:.1f} %"
    return f"{100 * share:.2g} %" if share >= 1e-6 else f"{100 * share:.0e} %"


def sign(pod: Pod, mode: int) -> float:
    """1 or -1, by which a mode and its course are drawn: a POD leaves the sign of the two open."""
    course = np.asarray(pod.temporal[:, mode])
    mean, size = course.mean(), np.sqrt(np.mean(course**2))
    decisive = mean if abs(mean) > SMALL_MEAN * size else course[np.abs(course).argmax()]
    return -1.0 if decisive < 0 else 1.0


def shape(pod: Pod, mode: int, largest: float) -> tuple[Array, Array]:
    """(n, 2) m and (n,): the deformed shape of a mode as drawn, its largest vector `largest` radii
    long, or less where the outline would cross itself, and its radial part, scaled so that the
    largest mean of a cell is 1 or -1."""
    vectors = sign(pod, mode) * np.asarray(pod.spatial[mode])
    vectors = vectors / np.linalg.norm(vectors, axis=1).max()
    coordinates, cells = pod.mesh.coordinates, pod.mesh.cells
    radius = np.linalg.norm(coordinates, axis=1).max()
    radial = component(vectors, coordinates, "radial")
    means = np.abs(cell_means(radial, cells))
    length = without_crossing(coordinates, vectors, outline(cells), largest * radius)
    return coordinates + length * vectors, radial / (means.max() or 1.0)


def _height(window: Window) -> float:
    """Of a window, over its width."""
    (left, right), (low, high) = window
    return (high - low) / (right - left)


def draw_mode(ax: Axes, pod: Pod, mode: int, window: Window | None = None) -> None:
    points, radial = shape(pod, mode, LARGEST_CLOSE if window else LARGEST)
    draw_cells(ax, points, pod.mesh.cells, radial, (-1.0, 1.0), signed=True, mesh_width=0)
    coordinates = pod.mesh.coordinates
    size = np.linalg.norm(np.asarray(pod.spatial[mode]), axis=1)
    draw_still_rim(ax, coordinates, pod.mesh.cells, size <= HELD * size.max())
    middle = 0.5 * (coordinates.max(axis=0) + coordinates.min(axis=0))
    reach = 0.5 * np.ptp(coordinates, axis=0).max() + 1.2 * LARGEST * np.linalg.norm(
        coordinates, axis=1).max()
    across, up = window or ((middle[0] - reach, middle[0] + reach),
                            (middle[1] - reach, middle[1] + reach))
    ax.set(xlim=across, ylim=up, aspect="equal", xlabel="X (m)", ylabel="Y (m)")


def edge_angle(pod: Pod) -> Array:
    """(nb,) degrees, -180 to 180: contact nodes, counter-clockwise from straight down."""
    points = turned(pod.mesh.coordinates[pod.mesh.boundary], 0.5 * np.pi)
    return np.degrees(np.arctan2(points[:, 1], points[:, 0]))


def draw_contact_mode(ax: Axes, pod: Pod, mode: int) -> None:
    values = sign(pod, mode) * np.asarray(pod.spatial[mode])
    values = values / np.abs(values).max()
    angle = edge_angle(pod)
    order = np.argsort(angle)
    for part, name in enumerate(("normal", "tangential")):
        ax.plot(angle[order], values[order, part], label=name, **style.CURVES[part])
    ax.axhline(0, color="0.6", lw=0.5, zorder=0)
    used = np.abs(values).max(axis=1) > 1e-3
    reach = 1.15 * np.abs(angle[used]).max()
    ax.set(xlim=(-min(reach, 180.0), min(reach, 180.0)), ylim=(-1.1, 1.1),
           xlabel="angle from straight down (°)", ylabel="mode over its\nlargest (–)")


def course_shown(pod: Pod, count: int) -> int:
    """How many snapshots of the courses in time are drawn: all, or those of the first periods where
    most of the first modes swing too fast to be seen."""
    courses = np.asarray(pod.temporal[:, :count])
    amplitude = np.abs(np.fft.rfft(courses - courses.mean(axis=0), axis=0))
    swings = float(np.median(amplitude.argmax(axis=0)))
    return len(courses) if swings <= MANY else int(np.ceil(len(courses) * FEW / swings))


def draw_course(ax: Axes, pod: Pod, mode: int, shown: int) -> None:
    """The column of V over the turns of the body, or over time where it does not turn."""
    course = sign(pod, mode) * np.asarray(pod.temporal[:shown, mode]) * np.sqrt(len(pod.time))
    turns = np.abs(np.asarray(pod.angle) - pod.angle[0]) / (2 * np.pi)
    if turns[-1] > 0:
        abscissa, label = turns, "turns of the body (–)"
    elif pod.time_unit == "s":
        abscissa, label = np.asarray(pod.time) * 1e3, "time (ms)"
    else:
        abscissa, label = np.asarray(pod.time), "share of the depth (–)"
    few = shown < len(pod.time) or shown < 60
    ax.plot(abscissa[:shown], course, color=style.BLUE, lw=0.7, marker="o" if few else "",
            markersize=1.5)
    ax.axhline(0, color="0.6", lw=0.5, zorder=0)
    ax.set(xlim=(abscissa[0], abscissa[shown - 1]), xlabel=label, ylabel="in time (–)")

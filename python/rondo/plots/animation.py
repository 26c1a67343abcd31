# SPDX-License-Identifier: BSD-3-Clause
"""Films of a run: the bodies moving in the fixed frame."""
from __future__ import annotations

import os
import pathlib
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

import matplotlib
import numpy as np
from matplotlib.artist import Artist
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from .. import style
from ..data.errors import Error
from ..data.ground import Ground
from ..data.files import kept
from ..data.history import between
from .cells import Array, cell_means
from .encoding import SAMPLES, Picture, has_ffmpeg, write_film
from .field import (SLIM, draw_body, draw_contact, draw_ground, full_range, nodal, positions,
                    snapshot_title)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ..data.run import Run

SECONDS = 10.0  # of a film, about, where nothing else is asked for
FPS = 30
DPI = 128  # a power of two: sizes in inches are exact, and so are those in pixels
SIZES = {".mp4": (960, 540), ".gif": (640, 360)}  # px, largest by default
SMALLEST = 240  # px, width: labels and colour bar take 200 of them
FOLLOW_BEYOND = 6.0  # outer radii that the center moves: beyond, the picture moves with it
LEVEL = 0.5  # of its height that a picture that follows the body does not follow upwards; with a
             # rim FOLLOW_BEYOND instead
HUB = 3.0  # pt, dot at the hub of a rim that forces move
START: dict[str, Any] = {"color": style.VERMILLION, "linewidth": 0.6, "linestyle": (0, (6, 3))}
SIDE, TOP, BOTTOM = 1.15, 1.15, 1.45  # outer radii from the center to the edges of the picture
AHEAD = 1.8  # the same to both sides where the picture moves with the body
LEFT, RIGHT, BELOW, ABOVE = 0.62, 0.95, 0.45, 0.3  # in, about the picture: labels, bar, title
SMALL = 1.5  # in, outer radius in the picture: a mesh drawn on smaller ones hides the colours
NARROW = 2.0  # in, of axes with two or three numbers only
BAR = 0.12  # in, width of the colour bar and its distance


def animate(run: Run, path: str | os.PathLike[str], quantity: str = "displacement",
            from_time: float | None = None, to_time: float | None = None, frames: int | None = None,
            fps: int | None = None, limits: tuple[float, float] | None = None,
            follow: bool | None = None, width: int | None = None,
            deformation: float = 1.0) -> pathlib.Path:
    """Writes a film of the bodies in the fixed frame, with ground, contact, time and colour bar,
    and returns its path, in a folder that is there. The ending says how: .mp4 (H.264, by the
    program ffmpeg) or .gif.

    quantity: as of plot_field. from_time, to_time: window of the run [s]. frames: pictures, spread
    evenly over the snapshots of the window; at most one for each, by default at most 300. fps:
    pictures a second; by default such that a film of few pictures lasts about 10 s, at most 30.
    limits: of the colours, in the unit of the colour bar; by default those of the whole film.
    follow: the picture moves along with the body, or the center of mass of bodies that nothing
    holds; by default where a held body goes far. With a [rim] it moves up and down where the hub
    rises far only: else ground and the hub's first height stand still, and the title has the
    height. width: [px]. deformation: factor on it, as of plot_field."""
    path = pathlib.Path(path)
    ending = path.suffix.lower()
    chosen, fps = plan_of(run, path, (from_time, to_time), frames, fps)
    with kept(run.path), style.paper(), matplotlib.rc_context(
            {"figure.constrained_layout.use": False}):
        if limits is None:
            limits = _limits(run, chosen, quantity)
        if follow is None:
            way = np.ptp(run.center[chosen], axis=0).max()
            follow = not run.mesh.free.any() and bool(way > FOLLOW_BEYOND * run.outer_radius)
        film = _Film(run, chosen, quantity, limits, follow, width, SIZES[ending], deformation)
        _write(film, path, fps)
    return path


def _limits(run: Run, chosen: np.ndarray, quantity: str) -> tuple[float, float]:
    """Of the colours, over the whole film."""
    low, high, signed = 0.0, 0.0, False
    for k in chosen:
        field = nodal(run, int(k), quantity)
        means = cell_means(field.values, run.mesh.cells)
        low, high = min(low, float(means.min())), max(high, float(means.max()))
        signed = signed or field.signed
    return full_range(np.array([low, high]), signed)


def plan_of(run: Run, path: pathlib.Path, window: tuple[float | None, float | None], frames: int | None,
            fps: int | None) -> tuple[np.ndarray, int]:
    """Snapshots of a film, and its pictures a second.
    @raise Error: the path or the numbers do not do, or there is no snapshot in the window."""
    check_place(path, path.suffix.lower())
    chosen = snapshots_of(run, *window, frames)
    if fps is None:
        fps = min(FPS, max(1, round(len(chosen) / SECONDS)))
    if fps < 1:
        raise Error(f"fps = {fps}: at least 1 picture a second")
    return chosen, fps


def check_place(path: pathlib.Path, ending: str) -> None:
    if ending not in SIZES:
        raise Error(f"{path}: a film ends in .mp4 or .gif, not in {ending or 'nothing'!r}")
    if ending == ".mp4" and not has_ffmpeg():
        raise Error(f"{path}: the program ffmpeg writes .mp4, and is not there: install the Debian "
                    "package ffmpeg, or take a name that ends in .gif")
    if not path.parent.is_dir():
        raise Error(f"{path}: no directory {path.parent}: make it first, or choose another")


def snapshots_of(run: Run, from_time: float | None, to_time: float | None,
               frames: int | None) -> np.ndarray:
    """Numbers of the snapshots to show."""
    run.need_snapshots()
    low = -np.inf if from_time is None else from_time
    high = np.inf if to_time is None else to_time
    there = np.flatnonzero((run.times >= low) & (run.times <= high))
    if not len(there):
        raise Error(f"{run.directory}: no snapshot {between(from_time, to_time, run.time_unit)}; "
                    f"they are from {run.times[0]:g} to {run.times[-1]:g} {run.time_unit}")
    if frames is None:
        frames = min(len(there), round(SECONDS * FPS))
    if frames < 1:
        raise Error(f"frames = {frames}: at least 1 picture")
    if frames > len(there):
        raise Error(f"frames = {frames}: there are {len(there)} snapshots to show")
    return there[np.round(np.linspace(0, len(there) - 1, frames)).astype(int)]


def _boxes(run: Run, chosen: np.ndarray, deformation: float = 1.0) -> tuple[Array, Array]:
    """(frames, 2) m each: lowest and highest x and y of all nodes at each snapshot."""
    boxes = [(places.min(axis=0), places.max(axis=0)) for places in
             (positions(run, int(k), "fixed", deformation) for k in chosen)]
    return np.array([low for low, _ in boxes]), np.array([high for _, high in boxes])


def _views(run: Run, chosen: np.ndarray, follow: bool, deformation: float) -> tuple[Array, Array]:
    """(frames, 2) m each: lower left and upper right corner of each picture, all of one size."""
    centers = np.array([run.middle(int(k)) for k in chosen])
    if run.mesh.free.any():
        low, high = _boxes(run, chosen, deformation)
        if not follow:
            centers = np.zeros_like(centers)
        below, above = (centers - low).max(axis=0), (high - centers).max(axis=0)
        size = (np.ptp(centers, axis=0) * (not follow) + below + above)
        margin = np.maximum((SIDE - 1) * size.max(), 0.5 * (SLIM * size.max() - size))
        below, above = below + margin, above + margin
    else:
        side = AHEAD if follow else SIDE
        bottom = TOP if "ground" not in run.case else BOTTOM
        below, above = run.outer_radius * np.array([[side, bottom], [side, TOP]])
    low, high = centers - below, centers + above
    rise = FOLLOW_BEYOND * run.outer_radius if run.has_rim else LEVEL * (below + above)[1]
    for axis, moves in enumerate((follow, follow and np.ptp(centers[:, 1]) >= rise)):
        if not moves:
            low[:, axis], high[:, axis] = low[:, axis].min(), high[:, axis].max()
    width, height = high[0] - low[0]
    slim = max(0.0, 0.5 * (SLIM * height - width))
    low[:, 0] -= slim
    high[:, 0] += slim
    return low, high


def even(pixels: float) -> int:
    """The nearest even number."""
    return 2 * round(pixels / 2)


class _Film:
    """A figure that shows one snapshot after another."""

    def __init__(self, run: Run, chosen: np.ndarray, quantity: str, limits: tuple[float, float],
                 follow: bool, width: int | None, largest: tuple[int, int],
                 deformation: float = 1.0) -> None:
        self.run, self.chosen, self.follow, self.deformation = run, chosen, follow, deformation
        self.low, self.high = _views(run, chosen, follow, deformation)
        size = self.high[0] - self.low[0]
        self.ax, bar = _layout(size[1] / size[0], width, largest)
        box = self.ax.get_window_extent()  # whole pixels: the upper edge makes the scales equal
        self.high[:, 1] += size[0] * box.height / box.width - size[1]
        self.moves = np.ptp(self.low, axis=0) > 0
        self.ax.set(xlabel="x (m)", ylabel="y (m)")
        for axis, pixels in (self.ax.xaxis, box.width), (self.ax.yaxis, box.height):
            if pixels < NARROW * DPI:
                axis.set_major_locator(MaxNLocator(2))
        draw_ground(self.ax, Ground.from_case(run.case),
                    (self.low[:, 0].min(), self.high[:, 0].max()), self.low[:, 1].min())
        self.ground: list[Artist] = [*self.ax.patches, *self.ax.lines]
        inches = self.ax.figure.get_figheight() - BELOW - ABOVE  # of size[1]
        # Of what the rim holds its mark shows that it turns; the mesh takes half of the time.
        with_mesh = run.mesh.free.any() and inches * run.outer_radius / size[1] > SMALL
        self.height = self._draw_height() if run.has_rim else None
        self.body = draw_body(self.ax, run, int(chosen[0]), quantity, "fixed", deformation, limits,
                              0.1 if with_mesh else 0.0)
        self.contact = draw_contact(self.ax, run, int(chosen[0]), deformation=deformation)
        if self.body.rim is not None:
            self.body.rim.mark.set_visible(self.body.rim.radius > 0)
        field = nodal(run, int(chosen[0]), quantity)
        self.ax.figure.colorbar(self.body.cells, cax=bar, label=f"{field.label} ({field.unit})")
        self.show(0)

    def show(self, frame: int) -> None:
        index = int(self.chosen[frame])
        self.contact.update(index, self.body.update(index))
        title = snapshot_title(self.run, index, self.deformation)
        if self.height is not None:
            x, y = self.run.center[index]
            self.height.set_data([x], [y])
            title += f", hub at {1e3 * y:.1f} mm"
        self.ax.set_title(title)
        self.ax.set_xlim(self.low[frame, 0], self.high[frame, 0])
        self.ax.set_ylim(self.low[frame, 1], self.high[frame, 1])

    def _draw_height(self) -> Line2D:
        """A dot at the hub, and a line where it was at first: the height is then seen to change."""
        first = float(self.run.center[self.chosen[0], 1])
        self.ground.append(self.ax.axhline(first, zorder=1.2, **START))
        dot, = self.ax.plot([], [], "o", color=style.OUTLINE, markersize=HUB, zorder=1.3)
        return dot

    def _moving(self) -> list[Artist]:
        """What is not the same in all pictures, in the order of drawing."""
        found: list[Artist] = [self.body.cells, self.body.edge, *self.contact.lines,
                               *self.contact.dots, self.ax.title]
        if self.height is not None:
            found.append(self.height)
        if self.body.rim is not None:
            found += [self.body.rim.disk, self.body.rim.line, self.body.rim.mark]
        axes = [axis for axis, moves in zip((self.ax.xaxis, self.ax.yaxis), self.moves) if moves]
        if axes:
            found += [*self.ground, *axes, *self.ax.spines.values()]
        return sorted(found, key=lambda artist: artist.get_zorder())

    def pictures(self, frames: Iterable[int]) -> Iterator[Picture]:
        """What stays the same is drawn once, and what moves upon it in each picture."""
        canvas = FigureCanvasAgg(self.ax.figure)
        canvas.draw()  # which puts labels in their places
        for axis in (self.ax.xaxis, self.ax.yaxis):  # and there they stay
            at = axis.label.get_transform().transform(axis.label.get_position())
            axis.set_label_coords(*self.ax.transAxes.inverted().transform(at))
        moving = self._moving()
        for artist in moving:
            artist.set_animated(True)
        canvas.draw()
        background = canvas.copy_from_bbox(self.ax.figure.bbox)
        for frame in frames:
            self.show(frame)
            canvas.restore_region(background)
            for artist in moving:
                self.ax.draw_artist(artist)
            yield np.array(canvas.buffer_rgba())


def _layout(aspect: float, width: int | None, largest: tuple[int, int]) -> tuple[Axes, Axes]:
    """Axes of the given height over width, and those of the colour bar, in a figure of even
    numbers of pixels, as H.264 takes them; the height is rounded."""
    if width is None:
        height = (largest[0] / DPI - LEFT - RIGHT) * aspect + BELOW + ABOVE
        tall = (largest[1] / DPI - BELOW - ABOVE) / aspect + LEFT + RIGHT
        width = largest[0] if height * DPI <= largest[1] else round(tall * DPI)
    if width < SMALLEST:
        raise Error(f"width = {width}: at least {SMALLEST} px")
    across = even(width) / DPI
    up = even(((across - LEFT - RIGHT) * aspect + BELOW + ABOVE) * DPI) / DPI
    figure = Figure(figsize=(across, up), dpi=DPI)
    bottom, height = BELOW / up, 1 - (BELOW + ABOVE) / up
    ax = figure.add_axes((LEFT / across, bottom, 1 - (LEFT + RIGHT) / across, height))
    bar = figure.add_axes((1 - (RIGHT - BAR) / across, bottom, BAR / across, height))
    return ax, bar


def _write(film: _Film, path: pathlib.Path, fps: int) -> None:
    frames = len(film.chosen)
    some = np.unique(np.linspace(0, frames - 1, SAMPLES).round().astype(int)).tolist()
    write_film(film.pictures(range(frames)), film.pictures(some), path, fps)

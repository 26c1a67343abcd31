# SPDX-License-Identifier: BSD-3-Clause
"""Films of a run: the body rolling in the fixed frame."""
from __future__ import annotations

import os
import pathlib
import subprocess
from typing import TYPE_CHECKING

import matplotlib
import numpy as np
from matplotlib import animation
from matplotlib.figure import Figure

from .. import style
from ..data.errors import Error
from ..data.ground import Ground
from ..data.history import between
from .field import (cell_means, draw_body, draw_contact, draw_ground, full_range, nodal,
                               snapshot_title)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ..data.run import Run

SECONDS = 10.0  # of a film, about, where nothing else is asked for
FPS = 30
DPI = 128  # a power of two: sizes in inches are exact, and so are those in pixels
SIZES = {".mp4": (1280, 720), ".gif": (640, 360)}  # px, largest by default
SMALLEST = 240  # px, width: labels and colour bar take 200 of them
FOLLOW_BEYOND = 6.0  # outer radii that the centre moves: beyond, the picture moves with it
SIDE, TOP, BOTTOM = 1.15, 1.15, 1.45  # outer radii from the centre to the edges of the picture
AHEAD = 1.8  # the same to both sides where the picture moves with the body
LEFT, RIGHT, BELOW, ABOVE = 0.62, 0.95, 0.45, 0.3  # in, about the picture: labels, bar, title
SMALL = 1.5  # in, outer radius in the picture: a mesh drawn on smaller ones hides the colours
BAR = 0.12  # in, width of the colour bar and its distance


def animate(run: Run, path: str | os.PathLike[str], quantity: str = "displacement",
            from_time: float | None = None, to_time: float | None = None, frames: int | None = None,
            fps: int | None = None, limits: tuple[float, float] | None = None,
            follow: bool | None = None, width: int | None = None) -> pathlib.Path:
    """Writes a film of the body in the fixed frame, with ground, contact, time and colour bar, and
    returns its path, in a folder that is there. The ending says how: .mp4 (H.264, by the program
    ffmpeg) or .gif.

    quantity: as of plot_field. from_time, to_time: window of the run [s]. frames: pictures, spread
    evenly over the snapshots of the window; at most one for each, by default at most 300. fps:
    pictures a second; by default such that a film of few pictures lasts about 10 s, at most 30.
    limits: of the colours, in the unit of the colour bar; by default those of the whole film.
    follow: the picture moves along with the body; by default where it goes far, and never with
    bodies that nothing holds. width: [px]."""
    path = pathlib.Path(path)
    ending = path.suffix.lower()
    _check_place(path, ending)
    chosen = _snapshots(run, from_time, to_time, frames)
    if fps is None:
        fps = min(FPS, max(1, round(len(chosen) / SECONDS)))
    if fps < 1:
        raise Error(f"fps = {fps}: at least 1 picture a second")
    if limits is None:
        fields = [nodal(run, k, quantity) for k in chosen]
        limits = full_range(np.stack([cell_means(field.values, run.mesh.cells)
                                      for field in fields]),
                            any(field.signed for field in fields))
    centers = run.center[chosen]
    if follow is None:
        follow = bool(np.ptp(centers[:, 0]) > FOLLOW_BEYOND * run.outer_radius)
    follow = follow and not _is_free(run)
    with style.paper(), matplotlib.rc_context({"figure.constrained_layout.use": False}):
        film = _Film(run, chosen, quantity, limits, follow, width, SIZES[ending])
        _write(film, path, ending, fps)
    return path


def _check_place(path: pathlib.Path, ending: str) -> None:
    if ending not in SIZES:
        raise Error(f"{path}: a film ends in .mp4 or .gif, not in {ending or 'nothing'!r}")
    if ending == ".mp4" and not animation.writers.is_available("ffmpeg"):
        raise Error(f"{path}: the program ffmpeg writes .mp4, and is not there: install the Debian "
                    "package ffmpeg, or take a name that ends in .gif")
    if not path.parent.is_dir():
        raise Error(f"{path}: no directory {path.parent}: make it first, or choose another")


def _snapshots(run: Run, from_time: float | None, to_time: float | None,
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


def _is_free(run: Run) -> bool:
    """Some bodies move otherwise than the rim, if there is one."""
    return bool(run.mesh.free.any())


def _box(run: Run, chosen: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Lowest and highest x and y of all nodes of the snapshots [m]."""
    boxes = [(places.min(axis=0), places.max(axis=0)) for places in map(run.position, chosen)]
    return np.min([low for low, _ in boxes], axis=0), np.max([high for _, high in boxes], axis=0)


def _even(pixels: float) -> int:
    """The nearest even number."""
    return 2 * round(pixels / 2)


class _Film:
    """A figure that shows one snapshot after another."""

    def __init__(self, run: Run, chosen: np.ndarray, quantity: str, limits: tuple[float, float],
                 follow: bool, width: int | None, largest: tuple[int, int]) -> None:
        self.run, self.chosen, self.follow = run, chosen, follow
        centers, radius = run.center[chosen], run.outer_radius
        ground = Ground.from_case(run.case)
        side = AHEAD if follow else SIDE
        bottom = TOP if ground is None else BOTTOM
        low = centers.min(axis=0) - np.array([side, bottom]) * radius
        high = centers.max(axis=0) + np.array([side, TOP]) * radius
        if _is_free(run):
            low, high = _box(run, chosen)
            margin = (SIDE - 1) * (high - low).max()
            low, high = low - margin, high + margin
        self.window = np.array([-side, side, -bottom, TOP]) * radius  # about the centre
        size = np.array([2 * side, bottom + TOP]) * radius if follow else high - low
        self.ax, bar = _layout(size[1] / size[0], width, largest)
        box = self.ax.get_window_extent()  # whole pixels: the upper edge makes the scales equal
        high[1] += size[0] * box.height / box.width - size[1]
        self.window[3] += size[0] * box.height / box.width - size[1]
        self.ax.set(xlabel="x (m)", ylabel="y (m)", xlim=(low[0], high[0]), ylim=(low[1], high[1]))
        draw_ground(self.ax, ground, (low[0], high[0]), low[1])
        inches = self.ax.figure.get_figheight() - BELOW - ABOVE  # of size[1]
        mesh_width = 0.1 if inches * radius / size[1] > SMALL else 0.0
        self.body = draw_body(self.ax, run, int(chosen[0]), quantity, limits=limits,
                              mesh_width=mesh_width)
        self.contact = draw_contact(self.ax, run, int(chosen[0]))
        # A radius of the rim, straight down at angle 0: a smooth disk would not be seen to turn.
        self.mark, = self.ax.plot([], [], color=style.OUTLINE, linewidth=1.2)
        field = nodal(run, int(chosen[0]), quantity)
        self.ax.figure.colorbar(self.body.cells, cax=bar, label=f"{field.label} ({field.unit})")

    def show(self, frame: int) -> None:
        index = int(self.chosen[frame])
        self.body.update(index)
        self.contact.update(index)
        self.ax.set_title(snapshot_title(self.run, index))
        if _is_free(self.run):
            return
        center, angle = self.run.center[index], self.run.angle[index]
        spoke = self.run.inner_radius * np.array([np.sin(angle), -np.cos(angle)])
        self.mark.set_data(*np.stack([center + 0.6 * spoke, center + spoke], axis=1))
        if self.follow:
            self.ax.set_xlim(*(center[0] + self.window[:2]))
            self.ax.set_ylim(*(center[1] + self.window[2:]))


def _layout(aspect: float, width: int | None, largest: tuple[int, int]) -> tuple[Axes, Axes]:
    """Axes of the given height over width, and those of the colour bar, in a figure of even
    numbers of pixels, as H.264 takes them; the height is rounded."""
    if width is None:
        height = (largest[0] / DPI - LEFT - RIGHT) * aspect + BELOW + ABOVE
        tall = (largest[1] / DPI - BELOW - ABOVE) / aspect + LEFT + RIGHT
        width = largest[0] if height * DPI <= largest[1] else round(tall * DPI)
    if width < SMALLEST:
        raise Error(f"width = {width}: at least {SMALLEST} px")
    across = _even(width) / DPI
    up = _even(((across - LEFT - RIGHT) * aspect + BELOW + ABOVE) * DPI) / DPI
    figure = Figure(figsize=(across, up), dpi=DPI)
    bottom, height = BELOW / up, 1 - (BELOW + ABOVE) / up
    ax = figure.add_axes((LEFT / across, bottom, 1 - (LEFT + RIGHT) / across, height))
    bar = figure.add_axes((1 - (RIGHT - BAR) / across, bottom, BAR / across, height))
    return ax, bar


def _write(film: _Film, path: pathlib.Path, ending: str, fps: int) -> None:
    """Into a file beside it that takes its place when it is complete."""
    writer: animation.AbstractMovieWriter
    if ending == ".mp4":
        writer = animation.FFMpegWriter(fps=fps, codec="h264", extra_args=["-pix_fmt", "yuv420p"])
    else:
        writer = animation.PillowWriter(fps=fps)
    part = path.with_name(f".{path.stem}.{os.getpid()}.tmp{ending}")
    try:
        with writer.saving(film.ax.figure, str(part), DPI):
            for frame in range(len(film.chosen)):
                film.show(frame)
                writer.grab_frame()
        os.replace(part, path)
    except (OSError, subprocess.CalledProcessError) as reason:
        raise Error(f"{path}: the film cannot be written: {reason}") from None
    finally:
        part.unlink(missing_ok=True)

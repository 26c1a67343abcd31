# SPDX-License-Identifier: BSD-3-Clause
"""Films of a wheel in three dimensions: the surface, deformed and coloured, rolling over the ground."""
from __future__ import annotations

import os
import pathlib
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ... import style
from ...data.errors import Error
from ...data.files import kept
from ...data.solid import outer_faces
from ..animation import DPI, SIZES, SMALLEST, even, plan_of
from ..encoding import SAMPLES, write_film
from ..encoding import Picture as Image
from .footprint import heading
from .pyvista_film import PyVistaFilm, is_installed
from .surface import Picture, default_view, faces_of, frame_of, limits_of, values_of
from .view import View

if TYPE_CHECKING:
    from ...data.run import Run

PYVISTA, MATPLOTLIB = "pyvista", "matplotlib"  # renderers
BAR, RIGHT, TITLE = 0.12, 0.85, 0.3  # in: colour bar, room for it and its numbers, title
SMALL = 0.05  # in, about the picture


def animate(run: Run, path: str | os.PathLike[str], quantity: str = "displacement",
            from_time: float | None = None, to_time: float | None = None, frames: int | None = None,
            fps: int | None = None, limits: tuple[float, float] | None = None,
            follow: bool | None = None, width: int | None = None, deformation: float = 1.0,
            view: View | None = None, renderer: str | None = None) -> pathlib.Path:
    """Writes a film (.mp4 by the program ffmpeg, .gif) of the wheel's outer surface and returns its
    path. The picture goes along with the wheel; lines on the ground stand still.

    quantity: as of plot_field, "pressure" is that of the contact, seen from below through the
    ground. renderer: "pyvista" or "matplotlib"; by default PyVista where it is installed. The other
    options are those of films of plane bodies (rondo.plots.animation.animate)."""
    if follow is False:
        raise Error("follow = False: a film of a wheel in three dimensions goes along with it; lines on "
                    "the ground stand still")
    path = pathlib.Path(path)
    renderer = renderer or (PYVISTA if is_installed() else MATPLOTLIB)
    if renderer not in (PYVISTA, MATPLOTLIB):
        raise Error(f'renderer "{renderer}": allowed are "{PYVISTA}" and "{MATPLOTLIB}"')
    if renderer == PYVISTA and not is_installed():
        raise Error(f'renderer "{PYVISTA}": the Python package pyvista is not installed; install it, '
                    f'or take "{MATPLOTLIB}"')
    ending = path.suffix.lower()
    chosen, fps = plan_of(run, path, (from_time, to_time), frames, fps)
    with kept(run.path), style.paper(), matplotlib.rc_context(
            {"figure.constrained_layout.use": False}):
        film = film_of(run, chosen, quantity, limits, view or default_view(quantity),
                       (width or SIZES[ending][0], SIZES[ending][1]), deformation, renderer)
        some = np.unique(np.linspace(0, len(chosen) - 1, SAMPLES).round().astype(int)).tolist()
        write_film(film.pictures(range(len(chosen))), film.pictures(some), path, fps)
    return path


def film_of(run: Run, chosen: np.ndarray, quantity: str, limits: tuple[float, float] | None,
            view: View, largest: tuple[int, int], deformation: float, renderer: str
            ) -> Film | PyVistaFilm:
    """largest: width, and greatest height [px]."""
    drawn = [values_of(run, int(k), quantity) for k in chosen]
    faces = outer_faces(run.mesh.cells)
    limits = limits or limits_of(drawn, faces[faces_of(run, quantity, faces)])
    signed, label = any(v.signed for v in drawn), f"{drawn[0].label} ({drawn[0].unit})"
    size = size_of(run, view, *largest)
    if renderer == PYVISTA:
        return PyVistaFilm(run, chosen, quantity, label, signed, limits, view, size, deformation)
    return Film(run, chosen, quantity, label, signed, limits, view, size, deformation)


def size_of(run: Run, view: View, width: int, tallest: int) -> tuple[int, int]:
    """Width and height [px], even numbers."""
    if width < SMALLEST:
        raise Error(f"width = {width}: at least {SMALLEST} px")
    left, right, low, high = frame_of(run, view)
    up = (width / DPI - RIGHT - SMALL) * (high - low) / (right - left) + TITLE + SMALL
    return even(width), even(min(up * DPI, tallest))


class Film:
    """A figure that shows one snapshot after another."""

    def __init__(self, run: Run, chosen: np.ndarray, quantity: str, label: str, signed: bool,
                 limits: tuple[float, float], view: View, size: tuple[int, int],
                 deformation: float) -> None:
        self.run, self.chosen = run, chosen
        across, up = size[0] / DPI, size[1] / DPI
        figure = Figure(figsize=(across, up), dpi=DPI)
        ax = figure.add_axes((SMALL / across, SMALL / up, 1 - (RIGHT + SMALL) / across,
                              1 - (TITLE + SMALL) / up))
        bar = figure.add_axes((1 - (RIGHT - BAR) / across, 0.12, BAR / across, 0.7))
        self.picture = Picture(ax, run, quantity, limits, signed, view, deformation)
        figure.colorbar(self.picture.colours, cax=bar, label=label)
        self.canvas = FigureCanvasAgg(figure)
        self.ending = "" if deformation == 1.0 else f", deformation × {deformation:g}"

    def pictures(self, frames: Iterable[int]) -> Iterator[Image]:
        for frame in frames:
            k = int(self.chosen[frame])
            self.picture.show(k)
            self.picture.ax.set_title(heading(self.run, k) + self.ending)
            self.canvas.draw()
            yield np.array(self.canvas.buffer_rgba())

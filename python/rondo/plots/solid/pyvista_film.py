# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a film of a wheel in three dimensions by PyVista, where that is installed: as those of
film.py, drawn with lights by the graphics card or its software."""
from __future__ import annotations

import importlib
import importlib.util
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from ... import style
from ...data.solid import outer_faces, turned_about_axle
from ..encoding import Picture as Image
from .footprint import heading
from .surface import faces_of, frame_of, ground_strips, values_of
from .view import View

if TYPE_CHECKING:
    from ...data.run import Run

NAME = "pyvista"
WHITE, TEXT = "white", 10


def is_installed() -> bool:
    return importlib.util.find_spec(NAME) is not None


def _cells(faces: np.ndarray) -> np.ndarray:
    """(f, 4) as PyVista wants them: the number of corners before those of each."""
    return np.hstack([np.full((len(faces), 1), 4), faces]).ravel()


class PyVistaFilm:
    """Shows one snapshot after another, `size` px wide and high."""

    def __init__(self, run: Run, chosen: np.ndarray, quantity: str, label: str, signed: bool,
                 limits: tuple[float, float], view: View, size: tuple[int, int],
                 deformation: float) -> None:
        self.run, self.chosen, self.quantity = run, chosen, quantity
        self.deformation, self.view = deformation, view
        self.pv: Any = importlib.import_module(NAME)
        self.faces = outer_faces(run.mesh.cells)
        self.touches = faces_of(run, quantity, self.faces)
        self.body = self.pv.PolyData(np.asarray(run.mesh.coordinates), _cells(self.faces))
        self.body.cell_data["values"] = np.zeros(len(self.faces))
        self.plotter = self.pv.Plotter(off_screen=True, window_size=list(size))
        self.plotter.set_background(WHITE)
        self.plotter.add_mesh(self.body, scalars="values", clim=list(limits), show_edges=True,
                              cmap=style.DIVERGING if signed else style.SEQUENTIAL,
                              scalar_bar_args={"title": label, "color": "black"})
        self._look()

    def _look(self) -> None:
        """The same projection as of film.py."""
        left, right, low, high = frame_of(self.run, self.view)
        axes = self.view.axes
        middle = 0.5 * (left + right) * axes[0] + 0.5 * (low + high) * axes[1]
        self.plotter.camera_position = [tuple(middle + 10.0 * self.run.outer_radius * axes[2]),
                                        tuple(middle), tuple(axes[1])]
        self.plotter.enable_parallel_projection()
        self.plotter.camera.parallel_scale = 0.5 * (high - low)

    def show(self, k: int) -> None:
        run = self.run
        arms = run.mesh.coordinates + self.deformation * np.asarray(run.displacement[k])
        self.body.points = turned_about_axle(arms, float(run.angle[k]))
        values = values_of(run, k, self.quantity).values[self.faces].mean(axis=1)
        self.body.cell_data["values"] = np.where(self.touches, values, 0.0)
        strips = ground_strips(run, k)
        if len(strips):
            corners = np.arange(4 * len(strips)).reshape(-1, 4)
            ground = self.pv.PolyData(strips.reshape(-1, 3), _cells(corners))
            self.plotter.add_mesh(ground, name="ground", color=style.GROUND, lighting=False,
                                  opacity=0.15 if self.view.elevation < 0 else 1.0)
        factor = "" if self.deformation == 1.0 else f", deformation x {self.deformation:g}"
        self.plotter.add_text(heading(run, k) + factor, name="title", font_size=TEXT, color="black")

    def pictures(self, frames: Iterable[int]) -> Iterator[Image]:
        for frame in frames:
            self.show(int(self.chosen[frame]))
            picture = np.asarray(self.plotter.screenshot(None, return_img=True))[..., :3]
            opaque = np.full((*picture.shape[:2], 1), 255, dtype=np.uint8)
            yield np.concatenate([picture.astype(np.uint8), opaque], axis=2)

# SPDX-License-Identifier: BSD-3-Clause
"""Files that others write and read: roads of ASAM OpenCRG, read by the library (read_crg, docs/roads.md);
measurements of tyres in TYDEX and parameters of tyre models in .tir (docs/tyre-files.md)."""
from __future__ import annotations

import os
import pathlib
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .data.errors import InputError
from .data.tir import Tir, read_tir, tir, write_tir
from .data.tydex import Channel, Constant, Tydex, tydex, write_tydex
from .data.tydex_reading import read_tydex
from .native import core, place_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["BORDERS", "Channel", "Constant", "Road", "Slopes", "Tir", "Tydex", "read_crg", "read_tir", "read_tydex",
           "tir", "tydex", "write_tir", "write_tydex"]

Array = NDArray[np.float64]

BORDERS = ("none", "zero", "keep", "repeat", "reflect")  # numbered as in OpenCRG


@dataclass(frozen=True)
class Slopes:
    """The smooth surface at places, each of their shape."""

    height: Array   # m
    slope_u: Array  # along the reference line, m/m
    slope_v: Array  # to the left, m/m


@dataclass(frozen=True)
class Road:
    """Heights of a road over the length u along its reference line and the distance v from it, to the
    left. `heights` are those of the grid in the file, scaled by its modifiers and NaN where missing;
    height(u, v) fills them, and adds the height of the reference line and banking times v."""

    file: pathlib.Path  # that holds the heights
    format: str         # LRFI, LDFI, KRBI or KDBI
    u: Array            # (n_u,) m
    v: Array            # (n_v,) m, ascending
    heights: Array      # (n_u, n_v) m
    line_height: Array  # (n_u,) m, of the reference line by its slope
    slope: Array        # (n_u,) of the stretch before each row, or (1,)
    banking: Array      # (n_u,) or (1,)
    heading: Array      # (n_u,) or (1,) rad; not felt
    border_u: str       # one of BORDERS, what is beyond the ends of the grid
    border_v: str       # and beyond its edges
    _surfaces: Any = field(repr=False, compare=False)
    if TYPE_CHECKING:
        plot: Callable[..., Axes]

    def height(self, u: ArrayLike, v: ArrayLike) -> Array:
        """Heights [m] by bilinear interpolation, as OpenCRG defines them. u and v are numbers or arrays
        that numpy broadcasts. Beyond the grid the borders rule; NaN: there is no road."""
        places = _places(u, v)
        z: Array = self._surfaces.height(places[0].ravel(), places[1].ravel())
        return z.reshape(places[0].shape)

    def smooth(self, u: ArrayLike, v: ArrayLike) -> Slopes:
        """The surface with continuous slopes that contact uses, at the same places."""
        places = _places(u, v)
        points = self._surfaces.smooth(places[0].ravel(), places[1].ravel())
        return Slopes(*(points[:, k].reshape(places[0].shape) for k in range(3)))

    @property
    def lines(self) -> list[str]:
        """Extent, grid, missing heights, largest slope, difference of both surfaces, in sentences."""
        return list(self._surfaces.lines())


def _places(u: ArrayLike, v: ArrayLike) -> tuple[Array, Array]:
    try:
        both = np.broadcast_arrays(np.asarray(u, float), np.asarray(v, float))
    except (TypeError, ValueError) as reason:
        raise InputError(f"u and v are no places of a road: {reason} (allowed: numbers, or arrays whose "
                         "shapes go together)") from None
    return both[0], both[1]


def read_crg(path: str | os.PathLike[str], border: str | None = None) -> Road:
    """Reads an OpenCRG file, text or binary. `border` (none, zero, keep, repeat or reflect) is what lies
    beyond the grid, in both directions; by default what the options of the file say.
    @raise InputError: the header is wrong or asks for what is not done; FileError: the file cannot be
    read, or is damaged."""
    if border is not None and border not in BORDERS:
        raise InputError(f"border = {border!r} (allowed: {', '.join(BORDERS)})")
    surfaces = core().Road(place_of(path))
    if border is not None:
        mode = BORDERS.index(border)
        surfaces.set_borders(mode, mode, 0.0, 0.0)
    arrays = surfaces.arrays()
    along, across = surfaces.borders()[:2]
    return Road(pathlib.Path(arrays.pop("file")), **arrays, border_u=BORDERS[along],
                border_v=BORDERS[across], _surfaces=surfaces)

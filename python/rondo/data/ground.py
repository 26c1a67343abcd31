# SPDX-License-Identifier: BSD-3-Clause
"""The rigid ground of a case, as a line to draw."""
from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

FLAT = [[-1.0, 0.0], [1.0, 0.0]]  # what the case file calls "flat" (m)
ARC_STEP = np.radians(5.0)  # between two points of a rounded corner


@dataclasses.dataclass(frozen=True)
class Ground:
    """A polyline walked from left to right with the solid on its right-hand side, so below it.

    corners: (k, 2) m, fixed frame; the end segments go on for ever.
    fillet: radius by which convex corners are rounded (m).
    """

    corners: NDArray[np.float64]
    fillet: float

    @classmethod
    def from_case(cls, case: Mapping[str, Any]) -> Ground | None:
        """The ground of a case as case.toml holds it; None where there is none, and under a wheel with a
        width on a road, whose surface is no line."""
        if "ground" not in case or "road" in case["ground"]:
            return None
        profile = case["ground"].get("profile", "flat")
        corners = FLAT if profile == "flat" else profile
        return cls(np.array(corners, dtype=float), float(case["ground"].get("fillet", 0.0)))

    def points(self, window: tuple[float, float]) -> NDArray[np.float64]:
        """(m, 2) m: the ground with its corners rounded, reaching at least from window[0] to
        window[1] along x. Walls at the ends are as long as the window is wide."""
        corners = self.corners.copy()
        reach = max(abs(side - x) for side in window for x in corners[[0, -1], 0])
        reach += window[1] - window[0]
        corners[0] = _extended(corners[1], corners[0], reach, window[0])
        corners[-1] = _extended(corners[-2], corners[-1], reach, window[1])
        pieces = [corners[:1]]
        for before, corner, after in zip(corners, corners[1:], corners[2:]):
            pieces.append(_rounded(before, corner, after, self.fillet))
        return np.concatenate([*pieces, corners[-1:]])


def _extended(inner: NDArray[np.float64], end: NDArray[np.float64], reach: float,
              side: float) -> NDArray[np.float64]:
    """The end point of an end segment moved outwards until it is at `side`, but for walls, which
    grow by `reach`."""
    along = (end - inner) / np.linalg.norm(end - inner)
    if abs(along[0]) < 1e-3:
        return end + reach * along
    missing = (side - end[0]) / along[0]
    return end + max(missing, 0.0) * along


def _rounded(before: NDArray[np.float64], corner: NDArray[np.float64], after: NDArray[np.float64],
             radius: float) -> NDArray[np.float64]:
    """(m, 2) m: the corner, or the arc in its place where it is convex."""
    a, b = before - corner, after - corner
    a, b = a / np.linalg.norm(a), b / np.linalg.norm(b)
    concave = a[0] * b[1] - a[1] * b[0] < 0
    half = 0.5 * np.arccos(np.clip(a @ b, -1, 1))  # half the angle inside the corner
    if radius == 0 or concave or half > 0.5 * np.pi - 1e-9:
        return corner[None, :]
    middle = corner + (a + b) / np.linalg.norm(a + b) * radius / np.sin(half)
    first = corner + radius / np.tan(half) * a - middle
    turn = np.pi - 2 * half  # walked clockwise, as the solid is on the right
    angles = -np.linspace(0, turn, max(3, int(np.ceil(turn / ARC_STEP)) + 1))
    cos, sin = np.cos(angles), np.sin(angles)
    return middle + np.stack([cos * first[0] - sin * first[1],
                              sin * first[0] + cos * first[1]], axis=1)

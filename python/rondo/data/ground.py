# SPDX-License-Identifier: BSD-3-Clause
"""The rigid ground of a case, as a line to draw."""
from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

FLAT = [[-1.0, 0.0], [1.0, 0.0]]  # what the case file calls "flat" (m)
ONE_PLACE = 1e-9  # places nearer to each other than this are one (m)
ARC_STEP = np.radians(5.0)  # between two points of a rounded corner


@dataclasses.dataclass(frozen=True)
class Ground:
    """A polyline walked from left to right with the solid on its right-hand side, so below it.

    corners: (k, 2) m, fixed frame, with the obstacles; the end segments go on for ever.
    radii: (k,) by which convex corners are rounded (m).
    angle: of the edges to the axis across the track (rad), and then the corners are those of the
        section normal to them; a wheel with a width comes to them with its left side first if > 0.
    """

    corners: NDArray[np.float64]
    radii: NDArray[np.float64]
    angle: float = 0.0

    @classmethod
    def from_case(cls, case: Mapping[str, Any]) -> Ground | None:
        """The ground of a case as case.toml holds it; None where there is none, and under a wheel with a
        width where it is a surface and no line: on a road, with obstacles of several angles, and with
        obstacles at an angle on ground that is not level."""
        if "ground" not in case or "road" in case["ground"]:
            return None
        profile = case["ground"].get("profile", "flat")
        corners = np.array(FLAT if profile == "flat" else profile, dtype=float)
        radii = np.full(len(corners), float(case["ground"].get("fillet", 0.0)))
        obstacles = case["ground"].get("obstacle", [])
        angles = {float(one.get("angle", 0.0)) for one in obstacles} or {0.0}
        if len(angles) > 1 or (angles != {0.0} and np.ptp(corners[:, 1]) > 0.0):
            return None
        return cls(*with_obstacles(corners, radii, obstacles), angles.pop())

    def points(self, window: tuple[float, float]) -> NDArray[np.float64]:
        """(m, 2) m: the ground in the middle of the track with its corners rounded, reaching at
        least from window[0] to window[1] along x. Walls at the ends are as long as the window is
        wide."""
        corners = self.corners.copy()
        window = (window[0] * np.cos(self.angle), window[1] * np.cos(self.angle))
        reach = max(abs(side - x) for side in window for x in corners[[0, -1], 0])
        reach += window[1] - window[0]
        corners[0] = _extended(corners[1], corners[0], reach, window[0])
        corners[-1] = _extended(corners[-2], corners[-1], reach, window[1])
        pieces = [corners[:1]]
        for before, corner, after, radius in zip(corners, corners[1:], corners[2:], self.radii[1:]):
            pieces.append(_rounded(before, corner, after, radius))
        return np.concatenate([*pieces, corners[-1:]]) / [np.cos(self.angle), 1.0]


def with_obstacles(corners: NDArray[np.float64], radii: NDArray[np.float64],
                   obstacles: Sequence[Mapping[str, Any]]
                   ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The corners (k, 2) and their radii (k,) with the obstacles of a case on them, normal to the
    edges of these [m]."""
    rises: dict[float, list[float]] = {}  # place: height, fillet
    for one in obstacles:
        at, fillet = one["at"] * np.cos(one.get("angle", 0.0)), one.get("fillet", 0.0)
        height = -one["height"] if one["kind"] == "pothole" else one["height"]
        ends = [(at, height)] if one["kind"] == "step" else [(at, height), (at + one["length"], -height)]
        for place, rise in ends:
            key = next((k for k in rises if abs(k - place) < ONE_PLACE), place)
            before = rises.get(key, [0.0, fillet])
            rises[key] = [before[0] + rise, min(before[1], fillet)]
    for place, (rise, fillet) in rises.items():
        corners, radii = _risen(corners, radii, place, rise, fillet)
    return corners, radii


def _risen(corners: NDArray[np.float64], radii: NDArray[np.float64], place: float, rise: float,
           fillet: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """All that is behind a place risen, with a wall there."""
    before, behind = corners[:, 0] < place, corners[:, 0] > place
    there = corners[~before & ~behind]
    (first, last) = (there[0], there[-1]) if len(there) else [_on_line(corners, place)] * 2
    ends = [corners[0] - [1.0, _slope(corners[:2])]] if place <= corners[0, 0] else []
    tail = [last + [1.0, rise + _slope(corners[-2:])]] if place >= corners[-1, 0] else []
    return (np.array([*ends, *corners[before], first, last + [0.0, rise],
                      *(corners[behind] + [0.0, rise]), *tail]),
            np.array([*[0.0] * len(ends), *radii[before], fillet, fillet, *radii[behind],
                      *[0.0] * len(tail)]))


def _slope(two: NDArray[np.float64]) -> float:
    return float((two[1, 1] - two[0, 1]) / (two[1, 0] - two[0, 0]))


def _on_line(corners: NDArray[np.float64], place: float) -> NDArray[np.float64]:
    """The point of the ground at a place, on the end segments too."""
    k = int(np.clip(np.searchsorted(corners[:, 0], place), 1, len(corners) - 1))
    two = corners[k - 1:k + 1]
    return two[0] + (place - two[0, 0]) * np.array([1.0, _slope(two)])


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

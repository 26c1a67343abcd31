# SPDX-License-Identifier: BSD-3-Clause
"""How far a deformed shape may be magnified before its outline crosses itself."""
from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
STEPS = 24  # amplitudes tried, up to the largest
MARGIN = 0.7  # of the first amplitude at which the outline crosses itself: gaps stay open


def crossing(points: Array, sides: NDArray[np.int64], pairs: NDArray[np.int64]) -> bool:
    """Whether two sides cross: sides (k, 2) hold nodes at points (n, 2), and `pairs` (m, 2) the
    numbers of the sides that are looked at, without a node in common."""
    a, b = (points[sides[pairs[:, 0], end]] for end in (0, 1))
    c, d = (points[sides[pairs[:, 1], end]] for end in (0, 1))
    apart = _left(a, b, c) != _left(a, b, d)
    return bool(np.any(apart & (_left(c, d, a) != _left(c, d, b))))


def _left(start: Array, end: Array, point: Array) -> NDArray[np.bool_]:
    """Whether each point is to the left of its line."""
    along, to = end - start, point - start
    return along[:, 0] * to[:, 1] - along[:, 1] * to[:, 0] > 0


def near_pairs(points: Array, sides: NDArray[np.int64], reach: float) -> NDArray[np.int64]:
    """(m, 2): the pairs of sides without a node in common that can meet when each of their nodes
    moves by up to `reach` m."""
    start, end = points[sides[:, 0]], points[sides[:, 1]]
    middle = 0.5 * (start + end)
    half = 0.5 * np.linalg.norm(end - start, axis=1)
    found = []
    for k in range(len(sides) - 1):
        distance = np.linalg.norm(middle[k + 1:] - middle[k], axis=1)
        near = k + 1 + np.flatnonzero(distance <= half[k + 1:] + half[k] + 2 * reach)
        near = near[~np.isin(sides[near], sides[k]).any(axis=1)]
        found.append(np.stack([np.full(len(near), k), near], axis=1))
    return np.concatenate(found) if found else np.empty((0, 2), dtype=np.int64)


def without_crossing(points: Array, vectors: Array, sides: NDArray[np.int64],
                     largest: float) -> float:
    """m: the amplitude of the `vectors` (n, 2), the longest of length 1, at which the outline of
    the `sides` is drawn: `largest`, or less where it would cross itself or nearly so."""
    pairs = near_pairs(points, sides, largest / MARGIN)
    for amplitude in np.linspace(0, largest / MARGIN, STEPS + 1)[1:]:
        if crossing(points + amplitude * vectors, sides, pairs):
            return MARGIN * float(amplitude)
    return largest

# SPDX-License-Identifier: BSD-3-Clause
"""cords.csv: forces and stretches of the cords of an inflated wheel, along their curves."""
from __future__ import annotations

import pathlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .errors import Error, unknown
from .plain_files import text_of

Array = NDArray[np.float64]
NAME = "curve"
NEAR = 0.05  # of half an edge: how far the ends of two edges that meet may seem apart
COLUMNS = ("r_m", "z_m", "angle_rad", "angle_inflated_rad", "stretch", "force_n")


@dataclass(frozen=True)
class CordLayer:
    """A layer of cords: p points along its curve, two an edge, from the end of smaller z on.

    curve: its name in the case; r, z: (p,) of the deformed section [m]; angle, angle_inflated: (p,)
    of a cord from the direction around the wheel, before and after [rad]; stretch: (p,); force: (p,)
    of one cord [N], below 0: it is compressed."""

    curve: str
    r: Array
    z: Array
    angle: Array
    angle_inflated: Array
    stretch: Array
    force: Array

    @property
    def arc(self) -> Array:
        """(p,) length of the deformed curve from its first point on [m]."""
        return np.cumsum(np.append(0.0, np.hypot(np.diff(self.r), np.diff(self.z))))

    @property
    def starts(self) -> NDArray[np.intp]:
        """Points at which a further line of the curve begins, which does not meet the one before: both
        turn-ups are one layer of two lines."""
        points = np.stack([self.r, self.z], axis=1).reshape(-1, 2, 2)
        half = 0.5 * np.sqrt(3.0) * (points[:, 1] - points[:, 0])  # from the points to the ends of the edge
        middle = points.mean(axis=1)
        gap = np.linalg.norm((middle + half)[:-1] - (middle - half)[1:], axis=1)
        return 2 * (np.flatnonzero(gap > NEAR * np.linalg.norm(half, axis=1)[1:]) + 1)


class Cords(Mapping[str, CordLayer]):
    """cords["belt-1"]: the layer of this curve, under the loads that were reached last. Of several
    layers along one curve the second is "belt-1 (2)"; the order is that of the case."""

    def __init__(self, directory: pathlib.Path, case: Mapping[str, Any]) -> None:
        """directory: of a run; case: its case."""
        self.path = path = directory / "cords.csv"
        curves = [str(layer.get("curve")) for layer in case.get("cords", [])]
        kind = case.get("analysis", {}).get("kind", "dynamic")
        if not path.exists():
            if kind == "inflation" and not curves:
                raise Error(f"{directory}: no cords: the case has no [[cords]]")
            raise Error(f'{path}: no such file: analysis.kind = "inflation" writes it, of a case with '
                        f'[[cords]], with its first equilibrium; this run has analysis.kind = "{kind}"')
        names, values = _read(path)
        self._layers: dict[str, CordLayer] = {}
        for curve in dict.fromkeys(names):
            rows = np.flatnonzero(np.array(names) == curve)
            count = max(1, curves.count(curve))
            if len(rows) % count:
                raise Error(f"{path}: damaged: {len(rows)} rows of {curve}, along which the case has "
                            f"{count} layers")
            for k, part in enumerate(np.split(rows, count)):
                self._layers[_key(curve, k)] = CordLayer(curve, *values[part].T.copy())
        order = [_key(curve, curves[:k].count(curve)) for k, curve in enumerate(curves)]
        self._layers = {key: self._layers[key] for key in [*order, *self._layers] if key in self._layers}

    def __getitem__(self, name: str) -> CordLayer:
        if name not in self._layers:
            raise unknown(self.path, "layer of cords", name, self._layers)
        return self._layers[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._layers)

    def __len__(self) -> int:
        """Number of layers."""
        return len(self._layers)

    def __repr__(self) -> str:
        said = ", ".join(f"{name} {layer.force.min():.4g} to {layer.force.max():.4g} N"
                         for name, layer in self.items())
        return f"Cords({self.path}: {said})"


def _key(curve: str, number: int) -> str:
    return curve if number == 0 else f"{curve} ({number + 1})"


def _read(path: pathlib.Path) -> tuple[Sequence[str], Array]:
    """Names (rows,) and numbers (rows, 6) in the order of COLUMNS. Names come first, so that they may
    have commas."""
    try:
        header, *lines = text_of(path).splitlines() or [""]
    except ValueError as reason:
        raise Error(f"{path}: cannot be read: {reason}") from None
    columns = header.split(",")
    if columns[0] != NAME or any(name not in columns for name in COLUMNS) or not lines:
        raise Error(f"{path}: damaged: it is to begin with the columns {NAME},{','.join(COLUMNS)}")
    rows = [line.rsplit(",", len(columns) - 1) for line in lines]
    try:
        numbers = np.array([[float(row[columns.index(name)]) for name in COLUMNS] for row in rows])
    except (ValueError, IndexError) as reason:
        raise Error(f"{path}: damaged: {reason}") from None
    return [row[0] for row in rows], numbers

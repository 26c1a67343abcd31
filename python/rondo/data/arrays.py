# SPDX-License-Identifier: BSD-3-Clause
"""Arrays that stay in their file until a part of them is asked for."""
from __future__ import annotations

import math
import operator
import pathlib
from typing import Any

import h5py
import numpy as np

from .files import opened
from .plain_files import demand_memory


class LazyArray:
    """A dataset of an HDF5 file, indexed like a numpy array. Each indexing opens the file, reads
    what is asked for and closes it. The first axis is cut to `length`, the snapshots that are
    complete; with a `component` only that place of the last axis is seen.

    shape, dtype, ndim, size; units and description as the file has them."""

    def __init__(self, path: pathlib.Path, dataset: str, length: int,
                 component: int | None = None) -> None:
        self.path, self.dataset, self.component = path, dataset, component
        with opened(path) as file:
            data = file[dataset]
            shape = data.shape if component is None else data.shape[:-1]
            self.dtype: np.dtype = data.dtype
            self.units = str(data.attrs["units"])
            self.description = str(data.attrs["description"])
        self.shape: tuple[int, ...] = (min(length, shape[0]), *shape[1:])

    def __len__(self) -> int:
        return self.shape[0]

    @property
    def ndim(self) -> int:
        return len(self.shape)

    @property
    def size(self) -> int:
        return int(np.prod(self.shape))

    def __repr__(self) -> str:
        return (f"LazyArray({self.dataset}, shape {self.shape}, {self.dtype}, {self.units}: "
                f"{self.description})")

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> np.ndarray:
        return np.asarray(self[...], dtype=dtype)

    def __getitem__(self, key: Any) -> Any:
        """As numpy's indexing: integers, slices, lists of integers, masks; no new axes."""
        parts = [_part(index, size, axis) for axis, (index, size)
                 in enumerate(zip(_expanded(key, self.ndim), self.shape))]
        pieces, first = _pieces(parts[0])
        ranges = [_range(part) for part in parts[1:]]
        rest: list[Any] = [wanted for wanted, _ in ranges]
        if self.component is not None:
            rest.append(self.component)
        count = sum(_length(piece) for piece in pieces) * math.prod(_length(one) for one, _ in ranges)
        demand_memory(self.path, f"this part of {self.dataset}", count * self.dtype.itemsize)
        with opened(self.path) as file:
            data: h5py.Dataset = file[self.dataset]
            read = [data[(piece, *rest)] for piece in pieces]
        whole = read[0] if len(read) == 1 else np.concatenate(read)
        return whole[(first, *(after for _, after in ranges))]


def _length(part: slice) -> int:
    return len(range(part.start, part.stop, part.step or 1))


def _expanded(key: Any, ndim: int) -> list[Any]:
    """One index for each axis."""
    parts = list(key) if isinstance(key, tuple) else [key]
    dots = [place for place, part in enumerate(parts) if part is Ellipsis]
    if len(dots) > 1:
        raise IndexError("an index can have one ellipsis ('...')")
    missing = ndim - len(parts) + len(dots)
    if missing < 0:
        raise IndexError(f"{len(parts)} indices for an array of {ndim} axes")
    place = dots[0] if dots else len(parts)
    return parts[:place] + [slice(None)] * missing + parts[place + 1:]


def _part(index: Any, size: int, axis: int) -> Any:
    """An index as an int from 0, a slice, or an array of ints from 0."""
    if isinstance(index, slice):
        return slice(*index.indices(size)) if size else slice(0, 0, 1)
    if index is None:
        raise IndexError("no new axes in an index: read first, then add them")
    array = np.asarray(index)
    if array.dtype == bool:
        if array.shape != (size,):
            raise IndexError(f"a mask of shape {array.shape} for axis {axis} of length {size}")
        return np.flatnonzero(array)
    if array.ndim and not array.size:
        return np.empty(0, dtype=int)
    if array.ndim > 1 or not np.issubdtype(array.dtype, np.integer):
        raise IndexError(f"an index is an integer, a slice, a list of integers or a mask, "
                         f"not {index!r}")
    if np.any((array < -size) | (array >= size)):
        raise IndexError(f"index {index} for axis {axis} of length {size}")
    array = np.where(array < 0, array + size, array)
    return array if array.ndim else operator.index(array[()])


def _pieces(part: Any) -> tuple[list[slice], Any]:
    """What h5py is to read along the first axis, one after another, and the index of numpy within
    it. Lists are read by their runs without a gap: h5py itself reads them far more slowly."""
    if not isinstance(part, np.ndarray) or not part.size:
        wanted, after = _range(part)
        return [wanted], after
    values, places = np.unique(part, return_inverse=True)
    runs = np.split(values, np.flatnonzero(np.diff(values) > 1) + 1)
    return [slice(int(run[0]), int(run[-1]) + 1) for run in runs], places


def _range(part: Any) -> tuple[slice, Any]:
    """What h5py is to read for an index, and the index of numpy within it."""
    if isinstance(part, int):
        return slice(part, part + 1), 0
    if isinstance(part, np.ndarray):
        if not part.size:
            return slice(0, 0), part
        low = int(part.min())
        return slice(low, int(part.max()) + 1), part - low
    count = len(range(part.start, part.stop, part.step))
    if not count:
        return slice(0, 0), slice(None)
    if part.step > 0:
        return part, slice(None)
    lowest = part.start + (count - 1) * part.step  # h5py reads forwards only
    return slice(lowest, part.start + 1, -part.step), slice(None, None, -1)

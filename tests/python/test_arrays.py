# SPDX-License-Identifier: BSD-3-Clause
"""LazyArray: numpy's indexing, and nothing read that was not asked for."""
import h5py
import numpy as np
import pytest

import rondo
from rondo.data.arrays import LazyArray

SHAPE = (7, 5, 3)


def dataset(path, values, name="a/b"):
    with h5py.File(path, "w") as file:
        data = file.create_dataset(name, data=values)
        data.attrs["units"], data.attrs["description"] = "m", "of a test"
    return path


@pytest.fixture
def values():
    return np.random.default_rng(3).normal(size=SHAPE)


@pytest.fixture
def array(tmp_path, values):
    return LazyArray(dataset(tmp_path / "a.h5", values), "a/b", 6)  # one snapshot is not complete


MASK = np.array([True, False, True, True, False, False])
KEYS = [0, 5, -1, -6, np.int64(2), slice(None), slice(1, 4), slice(-2, None), slice(4, 100),
        slice(None, None, 2), slice(None, None, -1), slice(5, 0, -2), slice(3, 3), slice(4, 2),
        ..., (..., 0), (..., -1, 1), (2, ...), (2, 3, 1), (slice(1, 5), slice(None, None, -2)),
        (1, slice(None), 2), (slice(None), 4, slice(0, 2)), [0, 3], [3, 0], [2, 2, -1], MASK,
        (MASK, 1), (slice(None), [4, 0, 1]), (slice(None), [1, 2, 3], 0), (0, slice(None), [2, 0]),
        ([5, 1], slice(None), 0), ([0, 1], [4, 2]), (slice(1, 3), [4, 0], [0, 2]), [], (0, []),
        np.array([1, 3], dtype=np.int32), (np.array([], dtype=int), 2)]


@pytest.mark.parametrize("key", KEYS, ids=str)
def test_indices_are_numpys(array, values, key):
    expected, got = values[:6][key], array[key]
    assert np.shape(got) == np.shape(expected)
    np.testing.assert_array_equal(got, expected)


@pytest.mark.parametrize("key", [6, -7, (0, 5), (0, 0, 0, 0), None, 1.5, "x", [0, 6], [True],
                                 (..., 0, ...), [[0, 1], [2, 3]]], ids=str)
def test_wrong_indices_are_index_errors(array, key):
    with pytest.raises(IndexError):
        array[key]


def test_it_looks_like_an_array(array, values):
    assert (len(array), array.shape, array.ndim, array.size) == (6, (6, 5, 3), 3, 90)
    assert array.dtype == np.float64
    assert (array.units, array.description) == ("m", "of a test")
    np.testing.assert_array_equal(np.asarray(array), values[:6])
    assert np.asarray(array, dtype=np.float32).dtype == np.float32
    assert len(list(array)) == 6
    assert np.linalg.norm(array, axis=2).shape == (6, 5)
    assert "a/b" in repr(array) and "(6, 5, 3)" in repr(array)


def test_a_component(tmp_path, values):
    array = LazyArray(dataset(tmp_path / "a.h5", values), "a/b", 7, component=1)
    assert array.shape == (7, 5)
    np.testing.assert_array_equal(array[:], values[..., 1])
    np.testing.assert_array_equal(array[[4, 2], ::2], values[[4, 2], ::2, 1])


def test_only_what_is_asked_for_is_read(tmp_path):
    """32 TB, of which nothing but three numbers is there: reading all of it cannot pass."""
    path = tmp_path / "huge.h5"
    with h5py.File(path, "w") as file:
        data = file.create_dataset("snapshots/u", (2**40, 2, 2), chunks=(1, 2, 2), dtype=float)
        data.attrs["units"], data.attrs["description"] = "m", "huge"
        data[12345, 1, 0] = 7.0
        data[-1, 0, 1] = 8.0
    array = LazyArray(path, "snapshots/u", 2**40)
    assert array[12345, 1, 0] == 7.0
    np.testing.assert_array_equal(array[12344:12347, 1, 0], [0, 7, 0])
    np.testing.assert_array_equal(array[-1], [[0, 8], [0, 0]])
    np.testing.assert_array_equal(array[[2**40 - 1, 12345]], [[[0, 8], [0, 0]], [[0, 0], [7, 0]]])


def test_the_file_is_open_only_while_reading(array):
    array[0]
    with h5py.File(array.path, "r+") as file:  # refused while it is open for reading
        file["a/b"][0, 0, 0] = 42.0
    assert array[0, 0, 0] == 42.0


def test_a_file_that_has_gone(array):
    array.path.unlink()
    with pytest.raises(rondo.Error, match="a.h5: no such file"):
        array[0]

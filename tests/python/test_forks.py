# SPDX-License-Identifier: BSD-3-Clause
"""Processes forked from one that has used the library: Python's way to start them before 3.14."""
import multiprocessing
import os

import numpy as np
import pytest
from program import SMALL

import rondo
from rondo.native import core

CRUSH = {"analysis.kind": "crush", "analysis.depth": 0.01, "analysis.increments": 4}


def crush(file):
    return np.asarray(rondo.crush(file, CRUSH).history["force_y"])


def run(file):
    return np.asarray(rondo.solve(file, {"disk.mesh.circumferential": 120}, threads=2).history["force_y"])


@pytest.mark.parametrize("work", [crush, run])
def test_a_child_works_like_its_parent(work, tmp_path):
    file = tmp_path / "small.toml"
    file.write_text(SMALL)
    expected = work(file)
    with multiprocessing.get_context("fork").Pool(1) as pool:
        np.testing.assert_array_equal(pool.apply_async(work, (file,)).get(timeout=60), expected)


def test_processors_are_those_that_may_be_used():
    assert 1 <= core().allowed_processors() <= len(os.sched_getaffinity(0))

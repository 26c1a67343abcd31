# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of rondo.Simulation share."""
import os
import pathlib
import subprocess
import sys

import numpy as np
from program import run

import rondo

ROOT = pathlib.Path(__file__).resolve().parents[2]
SOLID = ROOT / "cases" / "wheel3d-load.toml"


def by_program(case, output, *arguments):
    done = run("run", case, "-o", output, "--quiet", *arguments)
    assert done.returncode == 0, done.stderr
    return rondo.open(output)


def rows_of(history):
    return np.column_stack([history[name] for name in history.names])


def same_rows(one, other):
    assert one.names == other.names and one.units == other.units
    np.testing.assert_array_equal(rows_of(one), rows_of(other))


def closed(simulation):
    simulation.close()
    return simulation


def python(text, **options):
    return subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, timeout=60,
                          env={**os.environ, "PYTHONPATH": str(ROOT / "python")}, **options)

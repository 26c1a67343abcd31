# SPDX-License-Identifier: BSD-3-Clause
"""What the command-line tests share: the program under test and small edits of a case file."""
import csv
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np

PROGRAM = os.environ["RONDO"]
ROOT = pathlib.Path(__file__).resolve().parents[2]
LEDGE = (ROOT / "cases" / "ledge-smooth.toml").read_text()

# A small fast case with everything in it: 3×40, 0.02 s, already on the ground.
SMALL = """schema = 1
title = "small"
[disk]
outer_radius = 0.30
inner_radius = 0.15
[disk.mesh]
radial = 3
circumferential = 40
[material]
youngs_modulus = 2.0e7
poissons_ratio = 0.3
density = 1100.0
[damping]
mass = 200.0
stiffness = 2.0e-5
[motion]
angular_velocity = 33.333333
speed = 10.0
height = [[0, 0.3], [0.004, 0.296]]
[ground]
profile = "flat"
friction = 0.3
[time]
end = 0.02
[output]
snapshots = 11
"""


def run(*arguments, timeout=float(os.environ.get("RONDO_TEST_TIMEOUT", "120")), **options):
    """Runs the program; returns its CompletedProcess with text output."""
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True,
                          errors="replace", timeout=timeout, **options)


def said(done):
    """What a run said on stderr, but for strains that are no longer small."""
    return "".join(line for line in done.stderr.splitlines(keepends=True)
                   if "warning: the largest strain is" not in line)


SANITIZED = "sanitizers" in run("--version").stdout  # the program, and what it takes is theirs too


def estimated_memory(case):
    """What `rondo check` says of memory [B]."""
    said = run("check", case).stdout
    line = [line for line in said.splitlines() if line.startswith("memory")][0].split()
    return float(line[2]) * {"kB": 1e3, "MB": 1e6, "GB": 1e9}[line[3]]


def line_of(text, beginning):
    """Number of the line that begins with `beginning`, from 1."""
    for number, line in enumerate(text.splitlines(), start=1):
        if line.startswith(beginning):
            return number
    raise AssertionError(f"no line begins with {beginning!r}")


def replaced(text, beginning, line):
    """`text` with the line that begins with `beginning` replaced (None: removed)."""
    lines = text.splitlines()
    place = line_of(text, beginning) - 1
    lines[place : place + 1] = [] if line is None else line.split("\n")
    return "\n".join(lines) + "\n"


def table(path):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def history(directory):
    return table(directory / "history.csv")


def contact(directory):
    return table(directory / "contact.csv")


def summary(directory):
    return json.loads((directory / "run.json").read_text())


def settings(*all_of_them):
    """--set of each: `key=value`."""
    return [word for setting in all_of_them for word in ("--set", setting)]


class ProgramTest(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def case(self, text=SMALL, name="case.toml"):
        path = self.folder / name
        path.write_text(text)
        return path


class RunTest(ProgramTest):
    """A test of runs into `self.out`; `text` is the case where none is given."""

    text = SMALL

    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"

    def run_ok(self, text=None, *extra):
        done = run("run", self.case(text or self.text), "-o", self.out, *extra)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout, "")
        return done

    def run_set(self, *given, text=None):
        """Runs it with these settings; what it says on stderr."""
        return self.run_ok(text, "--quiet", "--overwrite", *settings(*given)).stderr


def corner_areas(places, cells):
    """(corner, ..., cell) Cross products of the edges of quadrilaterals at their corners."""
    x = [places[..., cells[:, a], :] for a in range(4)]
    return np.array([np.cross(x[(a + 1) % 4] - x[a], x[a - 1] - x[a]) for a in range(4)])

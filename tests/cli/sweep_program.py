# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of sweeps share: a small study, ranks, the table."""
import csv
import os
import subprocess

import numpy as np

from program import PROGRAM, ProgramTest, SMALL, replaced, run

# Root may not start MPI without being told twice, and there may be fewer cores than ranks.
MPI = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
# What Open MPI takes at its start it keeps, which a sanitizer of leaks would tell of.
MPI["ASAN_OPTIONS"] = ":".join(filter(None, (os.environ.get("ASAN_OPTIONS"), "detect_leaks=0")))
STUDY = """schema = 1
title = "small study"
base = "case.toml"
[[vary]]
key = "ground.friction"
values = [0.0, 0.2, 0.4]
[[vary]]
key = "motion.speed"
linspace = [9, 11, 3]
"""
# A crush whose members LATIN-PGD hands its fields on in.
CRUSH = """schema = 1
title = "crush"
[disk]
outer_radius = 0.30
inner_radius = 0.15
[disk.mesh]
radial = 4
circumferential = 90
[material]
youngs_modulus = 2.0e7
poissons_ratio = 0.3
density = 1100.0
[ground]
profile = "flat"
[analysis]
kind = "crush"
increments = 16
depth = [[0, 0], [8, 0.02], [16, 0.02]]
slide = [[0, 0], [8, 0], [16, 0.01]]
[output]
stress = false
"""
LONG = replaced(SMALL, "end", "end = 1.0")


def mpirun(ranks, *arguments, **options):
    return subprocess.run(["mpirun", "--oversubscribe", "-n", str(ranks), PROGRAM, "sweep",
                           *map(str, arguments)], capture_output=True, text=True, env=MPI,
                          timeout=300, **options)


def table(directory):
    with open(directory / "results.csv", newline="") as file:
        return list(csv.DictReader(file))


def column(directory, name):
    return np.array([float(row[name]) for row in table(directory)])


class SweepTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.case()
        self.out = self.folder / "out"

    def study(self, text=STUDY):
        path = self.folder / "study.toml"
        path.write_text(text)
        return path

    def sweep(self, *extra, text=STUDY, code=0):
        done = run("sweep", self.study(text), "-o", self.out, *extra)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

# SPDX-License-Identifier: BSD-3-Clause
"""Wheels in three dimensions on ground that bends upwards, where a node in the corner touches two
facets at once, however little they bend; the slip ratio and the trail of one that goes askew."""
import csv
import unittest

import numpy as np

from program import RunTest, contact, history, run, summary

WHEEL = """schema = 1
[disk]
outer_radius = 0.30
inner_radius = 0.15
width = 0.1
[disk.mesh]
radial = 2
circumferential = 60
axial = 3
[material]
youngs_modulus = 2.0e7
poissons_ratio = 0.3
density = 1100.0
[damping]
mass = 200.0
stiffness = 2.0e-5
[motion]
angular_velocity = 33.8
speed = 10.0
height = [[0, 0.301], [0.005, 0.295]]
slip_angle = 0.3
camber = 0.1
[ground]
profile = [[-10, 0], [0.15, 0], [10.15, 0.2]]
friction = 1.0
[time]
end = 0.03
[output]
snapshots = 200
history_interval = 0.0
"""

STUDY = """schema = 1
base = "case.toml"
set = ["motion.camber=0.0", "ground.profile=flat"]
[[vary]]
key = "motion.slip_angle"
values = [0.0, 0.02]
"""
FIGURES = ("force_lateral_mean", "moment_aligning_mean", "trail_m")


class BentGround(RunTest):
    text = WHEEL

    def test_two_facets_that_hardly_bend_are_solved(self):
        for setting in ("ground.friction=1.0", "ground.friction=0.0", "ground.restitution=0.3"):
            with self.subTest(setting):
                self.run_ok(None, "--quiet", "--overwrite", "--set", setting)
                told = summary(self.out)
                self.assertEqual(told["contact"]["pairs_not_converged"], 0)
                self.assertLess(told["contact_residual_max"], 1e-12)
                self.assertLess(told["energy_residual_relative"], 1e-12)

    def test_a_node_in_the_corner_sticks_where_all_that_presses_it_does(self):
        self.run_ok(None, "--quiet")
        self.assertGreater(summary(self.out)["contact"]["pairs_solved"], 5)
        rows, nodes = history(self.out), contact(self.out)
        for time in np.unique(nodes["time_s"]):
            here, step = nodes["time_s"] == time, np.abs(rows["time_s"] - time).argmin()
            self.assertEqual(np.sum(here), rows["contact_nodes"][step], time)
            self.assertEqual(np.sum(nodes["sticks"][here]), rows["sticking_nodes"][step], time)

    def test_the_slip_ratio_is_that_of_the_speed_along_the_heading(self):
        ahead, rim = 10.0 * np.cos(0.3), 33.8 * 0.3
        for extra in ((), ("--set", "rim.free=[]")):
            self.run_ok(None, "--quiet", "--overwrite", *extra)
            np.testing.assert_allclose(history(self.out)["slip_ratio"], (rim - ahead) / rim,
                                       atol=1e-5)

    def test_straight_on_there_is_no_trail(self):
        self.case(self.text)
        (self.folder / "study.toml").write_text(STUDY)
        done = run("sweep", self.folder / "study.toml", "-o", self.out, "--quiet", "--jobs", "1")
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.out / "results.csv", newline="") as file:
            straight, askew = ({name: float(row[name]) for name in FIGURES}
                               for row in csv.DictReader(file))
        self.assertTrue(np.isnan(straight["trail_m"]), straight)
        self.assertLess(abs(straight["force_lateral_mean"]), 1e-6)
        trail = askew["moment_aligning_mean"] / askew["force_lateral_mean"]
        self.assertAlmostEqual(askew["trail_m"], trail, delta=1e-12)


if __name__ == "__main__":
    unittest.main()

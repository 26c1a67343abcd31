# SPDX-License-Identifier: BSD-3-Clause
"""rondo modes --standing: a tyre that the ground holds."""
import json
import unittest

from program import run
from test_tyre import ROLLING
from test_tyre_modes import ModesTest


class Standing(ModesTest):
    def test_a_tyre_that_stands(self):
        """Held by the ground, it is stiffer; free to slide there, less so; not in contact, refused."""
        ground = ("--set", 'ground={profile = "flat", friction = 0.9}', "--standing", "--count", 1)
        low = ("--set", "motion.height=0.299968")
        smooth = (*low, "--set", "ground.friction=0")
        held = self.modes(24, *ground, *low)
        free = self.modes(24, "--count", 1, "--spin", 0)
        lowest = [rows[0]["frequency_hz"] for rows in (free, self.modes(24, *ground, *smooth), held)]
        self.assertEqual(lowest, sorted(lowest))
        self.assertGreater(lowest[2], lowest[0] * 1.1)
        self.assertEqual(held[0]["nodal_diameters"], "")
        self.modes(60, *ground, *smooth)
        load = json.loads((self.results / "modes.json").read_text())["standing"]
        self.assertAlmostEqual(load["load"] / 3764.0, 1.0, delta=1e-3)
        self.assertGreater(load["nodes"], 20)
        said = self.modes(24, *ground, "--set", "motion.height=0.32", code=2)
        self.assertIn("motion.height", said)
        self.assertIn("the wheel does not touch the ground (allowed: the center less than 0.316", said)
        said = self.modes(24, *ground, "--spin", 10, "--set", "motion.height=0.299968", code=2)
        self.assertIn("a wheel that stands does not turn", said)
        self.assertIn("there is no ground to stand on", self.modes(24, "--standing", code=2))

    def test_a_tyre_stands_under_a_load(self):
        loaded = self.case(ROLLING.replace("height = 0.299968\n", "").replace(
            "torque = 0.0\n", "torque = 0.0\nload = 3000.0\n"))
        done = run("modes", loaded, "-o", self.results, "--standing", "--count", 2, "--set",
                   "section.sectors=24")
        self.assertEqual(done.returncode, 0, done.stderr)
        standing = json.loads((self.results / "modes.json").read_text())["standing"]
        self.assertAlmostEqual(standing["load"], 3000.0, delta=1e-6)
        self.assertAlmostEqual(standing["height"], 0.304, delta=0.004)
        done = run("modes", self.case(ROLLING), "-o", self.folder / "deep", "--standing", "--set",
                   "motion.height=0.1")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("the ground is within the rim", done.stderr)
        self.assertFalse((self.folder / "deep").exists())


if __name__ == "__main__":
    unittest.main()

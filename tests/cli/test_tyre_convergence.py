# SPDX-License-Identifier: BSD-3-Clause
"""A tyre over its sectors, 16 mm deep, against an independent calculation."""
import json
import unittest

from program import run
from test_tyre import GROUND, MOVING, TyreTest

STILL = MOVING.replace("angular_velocity = 33.0", "angular_velocity = 0.0") + GROUND.replace("0.9", "0.0")


class OverTheDepth(TyreTest):
    def solve(self, command, text, *words):
        done = run(command, self.case(text), "-o", self.results, "--overwrite", "--quiet", *words)
        self.assertEqual(done.returncode, 0, done.stderr)

    def height(self, *settings):
        """16 mm below the outer radius of the tyre inflated and at rest; its first frequency, Hz."""
        self.solve("modes", STILL, "--count", 1, "--diameters", 0, *settings)
        told = json.loads((self.results / "modes.json").read_text())
        with open(self.results / "modes.csv") as file:
            names, values = (line.split(",") for line in file.read().splitlines()[:2])
        return told["outer_radius"] - 0.016, float(values[names.index("frequency_hz")])

    def standing(self, height, *settings):
        """Without friction: load, N."""
        self.solve("modes", STILL, "--standing", "--count", 1, "--set", f"motion.height={height!r}", *settings)
        return json.loads((self.results / "modes.json").read_text())["standing"]["load"]


class Convergence(OverTheDepth):
    def test_load_and_lateral_mode_converge_with_the_sectors(self):
        loads, modes = [], []
        for sectors, load, mode in ((30, None, None), (60, 3764.1, 36.78), (120, 3646.3, 36.60)):
            words = ("--set", f"section.sectors={sectors}")
            height, frequency = self.height(*words)
            modes.append(frequency)
            loads.append(self.standing(height, *words))
            if load:
                self.assertAlmostEqual(loads[-1], load, delta=0.15, msg=sectors)
                self.assertAlmostEqual(frequency, mode, delta=6e-3, msg=sectors)
        for values in (loads, modes):
            first, second = values[0] - values[1], values[1] - values[2]
            self.assertGreater(second, 0.0)
            self.assertLess(second, 0.7 * first)


if __name__ == "__main__":
    unittest.main()

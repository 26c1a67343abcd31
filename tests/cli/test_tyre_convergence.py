# SPDX-License-Identifier: BSD-3-Clause
"""A tyre over its sectors and its pressure, 16 mm deep, against an independent calculation."""
import json
import math
import unittest

from program import history, run, summary
from test_tyre import GROUND, MOVING, ROLLING, TYRE, TyreTest

STILL = MOVING.replace("angular_velocity = 33.0", "angular_velocity = 0.0") + GROUND.replace("0.9", "0.0")
ASKEW = 0.78  # rad: the largest slip angle


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

    def test_load_and_cornering_stiffness_grow_with_the_pressure(self):
        cornering = []
        for pressure, load, steer, stiffness in ((1.5e5, 2732.4, -140.88, 1199.2), (2.6e5, 4158.6, -142.62, 1534.6)):
            words = ("--set", f"inflation.pressure={pressure}", "--set", "section.sectors=120")
            height, _ = self.height(*words)
            self.assertAlmostEqual(self.standing(height, *words), load, delta=0.06, msg=pressure)
            forces = []
            for angle in (0.0, math.pi / 180):
                self.solve("run", ROLLING, *words, "--set", f"motion.height={height!r}", "--set",
                           f"motion.slip_angle={angle!r}", "--set", "analysis.estimate_slip_error=false")
                forces.append(summary(self.results)["steady"]["force_lateral"])
            self.assertAlmostEqual(forces[0] / steer, 1.0, delta=4e-2, msg=pressure)
            cornering.append(forces[0] - forces[1])
            self.assertAlmostEqual(cornering[-1] / stiffness, 1.0, delta=7e-3, msg=pressure)
        self.assertGreater(cornering[1], 1.2 * cornering[0])

    def test_stiffness_along_the_ground_where_the_tyre_sticks(self):
        """At 260 kPa as many nodes touch with friction as without. The hub is moved by .1 mm at an angle and comes to
        rest: both stiffnesses, for one has next to no part in the other."""
        words = ("--set", "inflation.pressure=2.6e5")
        height, _ = self.height(*words)
        far, begin, end = 1e-4, 0.06, 0.105
        self.solve("run", TYRE + GROUND.replace("0.9", "5.0") + f"""[damping]
mass = 500.0
stiffness = 1.5e-6
[motion]
angular_velocity = 0.0
speed = [[0.0, 0.0], [{begin}, 0.0], [{begin + 0.01}, {100 * far}], [{begin + 0.02}, 0.0]]
slip_angle = {ASKEW}
height = [[0.0, {height + 0.01601!r}], [0.03, {height + 0.001!r}], [0.04, {height!r}]]
[time]
end = {end}
[output]
snapshots = 0
history_interval = 5e-4
""", *words)
        rows = history(self.results)
        before, after = ((rows["time_s"] > t - 5e-3) & (rows["time_s"] <= t) for t in (begin, end))
        for name, part, expected in (("force_x", math.cos(ASKEW), 277.3), ("force_lateral", math.sin(ASKEW), 165.2)):
            change = rows[name][after].mean() - rows[name][before].mean()
            self.assertAlmostEqual(-change / (1e3 * far * part) / expected, 1.0, delta=3e-3, msg=name)
        self.assertEqual(rows["sticking_nodes"][-1], rows["contact_nodes"][-1])


if __name__ == "__main__":
    unittest.main()

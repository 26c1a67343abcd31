# SPDX-License-Identifier: BSD-3-Clause
"""The explicit step of a tyre that corners against an independent calculation."""
import csv
import re
import unittest

import numpy as np

from program import run, summary
from test_tyre import GROUND, TYRE, TyreTest
from test_tyre import MESH as FULL
from test_tyre_rolling import DEGREE, MESH, RADIUS, SPIN

LOAD = 2167.4  # N


def cornering(sectors, end, degrees):
    """The case."""
    height = RADIUS[sectors]
    return TYRE.replace(str(FULL), str(MESH)).replace("sectors = 120", f"sectors = {sectors}") + GROUND + f"""
[damping]
mass = 150.0
stiffness = 1.5e-6
[motion]
angular_velocity = {SPIN}
speed = {0.3122 * SPIN!r}
slip_angle = {degrees * DEGREE!r}
height = [[0.0, {height + 1e-4!r}], [0.02, {height - 0.01!r}]]
[time]
end = {end}
[output]
snapshots = 0
history_interval = 1e-3
"""


# The load that holds the axle where cornering() holds it, on average.
LOADED = f"""
[rim]
free = ["height"]
mass = 10.0
inertia = 0.3
force_y = [[0.0, 0.0], [0.02, {-LOAD}]]
[rim.support.y]
damping = 3000.0
"""


class Cornering(TyreTest):
    def explicit(self, text, end):
        """Mean of each column in the last fifth."""
        done = run("run", self.case(text), "-o", self.results)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertLess(summary(self.results)["energy_residual_relative"], 1e-12)
        with open(self.results / "history.csv", newline="") as file:
            rows = [row for row in csv.DictReader(file) if float(row["time_s"]) > 0.8 * end]
        return {name: np.mean([float(row[name]) for row in rows]) for name in rows[0]}


class Explicit(Cornering):
    """With the axle at the height that this load gives: test_tyre_long.py."""

    def test_an_axle_that_a_load_presses_down(self):
        """It comes to the height at which the ground bears that load, in the fused step."""
        height = RADIUS[60]
        text = re.sub("height = .*", f"height = {height + 1e-4!r}", cornering(60, 0.15, 1.0)) + LOADED
        self.assertIn("fused 3-D cyclic", run("check", self.case(text)).stdout)
        mean = self.explicit(text, 0.15)
        self.assertAlmostEqual(mean["force_y"] / LOAD, 1.0, delta=2e-3)
        self.assertAlmostEqual(mean["center_y_m"], height - 0.01, delta=5e-5)
        self.assertAlmostEqual(mean["force_lateral"] / -716.7, 1.0, delta=1.5e-2)


if __name__ == "__main__":
    unittest.main()

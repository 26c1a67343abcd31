# SPDX-License-Identifier: BSD-3-Clause
"""The explicit step of a tyre that corners against an independent calculation."""
import csv
import unittest

import numpy as np

from program import run, summary
from test_tyre import GROUND, TYRE, TyreTest
from test_tyre import MESH as FULL
from test_tyre_rolling import DEGREE, MESH, RADIUS, SPIN


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


class Explicit(TyreTest):
    def explicit(self, sectors, end):
        """Mean force in the last fifth, at 1 degree."""
        done = run("run", self.case(cornering(sectors, end, 1.0)), "-o", self.results)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertLess(summary(self.results)["energy_residual_relative"], 1e-12)
        with open(self.results / "history.csv", newline="") as file:
            return np.mean([float(row["force_lateral"]) for row in csv.DictReader(file)
                            if float(row["time_s"]) > 0.8 * end])

    def test_the_explicit_step_of_an_independent_calculation(self):
        """-716.7 N; after 0.15 s it is within 1 % of that."""
        self.assertAlmostEqual(self.explicit(60, 0.15) / -716.7, 1.0, delta=1e-2)


if __name__ == "__main__":
    unittest.main()

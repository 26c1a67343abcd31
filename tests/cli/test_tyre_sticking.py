# SPDX-License-Identifier: BSD-3-Clause
"""The stiffness of a standing tyre along the ground, 16 mm deep, against an independent calculation."""
import math
import unittest

from program import history
from test_tyre import GROUND, TYRE
from test_tyre_convergence import OverTheDepth

ASKEW = 0.78  # rad: the largest slip angle


class Sticking(OverTheDepth):
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

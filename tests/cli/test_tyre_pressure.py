# SPDX-License-Identifier: BSD-3-Clause
"""A tyre over its pressure, 16 mm deep, against an independent calculation."""
import math
import unittest

from program import summary
from test_tyre import ROLLING
from test_tyre_convergence import OverTheDepth


class Pressure(OverTheDepth):
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


if __name__ == "__main__":
    unittest.main()

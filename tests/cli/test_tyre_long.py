# SPDX-License-Identifier: BSD-3-Clause
"""The explicit step of a tyre against an independent calculation, where test_tyre_nonlinear.py and
test_tyre_explicit.py have its other depth and its other way to hold the axle. Run by scripts/long.sh."""
import unittest

import numpy as np

import test_tyre_explicit
import test_tyre_nonlinear
from program import history, summary
from test_tyre_nonlinear import ALL, CORDS, WINDOW


class Nonlinear(test_tyre_nonlinear.Standing):
    def test_loads_at_half_the_depth(self):
        """821.28 N with the rubber linear, 811.29 N with all nonlinear, all of it or in a window."""
        for nonlinear, load, delta in ((CORDS, 821.28, 2e-3), (ALL, 811.29, 1e-3), (WINDOW, 811.29, 1e-3)):
            with self.subTest(nonlinear):
                self.assertAlmostEqual(self.stands(5e-3, *nonlinear) / load, 1.0, delta=delta)
        self.assertLess(summary(self.results)["integration_relative"], 1e-6)
        self.assertEqual(np.abs(history(self.results)["window_work"]).max(), 0.0)


class Explicit(test_tyre_explicit.Cornering):
    def test_an_axle_that_is_held(self):
        """-716.7 N; after 0.15 s it is within 1 % of that."""
        mean = self.explicit(test_tyre_explicit.cornering(60, 0.15, 1.0), 0.15)
        self.assertAlmostEqual(mean["force_lateral"] / -716.7, 1.0, delta=1e-2)


if __name__ == "__main__":
    unittest.main()

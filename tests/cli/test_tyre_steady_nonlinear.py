# SPDX-License-Identifier: BSD-3-Clause
"""Steady rolling of a tyre whose forces are nonlinear, against an independent calculation and the linear tyre."""
import unittest

from program import history, run, summary
from test_tyre import TyreTest
from test_tyre_nonlinear import ALL, COARSE, CORDS, RADIUS, WINDOW


def rolling(height, friction=0.0, samples=1, more=""):
    """Without inertia, so that it stands where there is no friction: at rest a column is under the axle."""
    return COARSE + f"""
[motion]
angular_velocity = 1e-3
height = {height!r}
{more}
[ground]
profile = "flat"
friction = {friction}
[analysis]
kind = "steady-rolling"
inertia = "none"
massless_contact = {"true" if samples > 1 else "false"}
samples_per_sector = {samples}
estimate_slip_error = false
accept_scheme_power = true
"""


class SteadyNonlinear(TyreTest):
    def state(self, text, *more):
        done = run("run", self.case(text), "-o", self.results, "--overwrite", "--quiet", *more)
        self.assertEqual(done.returncode, 0, done.stderr)
        told = summary(self.results)
        self.assertLess(told["energy_residual_relative"], 1e-9)
        return told["steady"]

    def load(self, depth, *more):
        return self.state(rolling(RADIUS - depth, more="speed = 3.1e-4"), *more)

    def test_loads_of_an_independent_calculation(self):
        for depth, nonlinear, expected in ((5e-3, ALL, 811.286), (10e-3, ALL, 1800.09), (10e-3, CORDS, 1860.33)):
            found = self.load(depth, *nonlinear)
            self.assertAlmostEqual(found["force_y"] / expected, 1.0, delta=1e-4, msg=(depth, nonlinear))
            self.assertLessEqual(found["balance_residual"], 1e-8)
            self.assertLessEqual(found["contact_problems"], 8)
        self.assertAlmostEqual(self.load(5e-3, *WINDOW)["force_y"] / 811.286, 1.0, delta=1e-3)

    def test_it_is_pressed_in_by_parts(self):
        """The linear state at 25 mm turns elements inside out: it is reached by smaller depths."""
        found = self.load(25e-3, *ALL, "--set", "section.sectors=36")
        self.assertGreater(found["force_y"], 4700.0)
        self.assertLess(found["force_y"], 5700.0)
        self.assertLessEqual(found["balance_residual"], 1e-8)

    def test_a_load_is_found_as_its_depth(self):
        text = rolling(RADIUS, more="speed = 3.1e-4").replace(f"height = {RADIUS!r}\n", "") + "load = 811.286\n"
        self.assertAlmostEqual(self.state(text, *ALL)["height"], RADIUS - 5e-3, delta=1e-6)

    def test_corners_as_the_linear_tyre_where_it_is_hardly_pressed(self):
        """At .5 mm; at 5 mm it carries less, by as much as without friction."""
        turned = "speed = 3.1e-4\nslip_angle = 0.0175"
        found = {}
        for depth in (0.5e-3, 5e-3):
            text = rolling(RADIUS - depth, friction=0.9, samples=2, more=turned)
            found[depth] = [self.state(text, *more) for more in ((), ALL)]
        self.assertEqual(self.state(text, *ALL, "--threads", "2"), found[5e-3][1])
        linear, nonlinear = found[0.5e-3]
        self.assertAlmostEqual(nonlinear["force_lateral"] / linear["force_lateral"], 1.0, delta=0.02)
        linear, nonlinear = found[5e-3]
        self.assertAlmostEqual(nonlinear["force_y"] / linear["force_y"], 811.286 / 891.01, delta=0.01)
        self.assertLessEqual(nonlinear["balance_residual"], 1e-8)
        self.assertLessEqual(nonlinear["contact_problems"], 10)
        self.assertTrue((history(self.results)["strain"] > 0.0).all())

    def test_slopes_are_differences_of_states(self):
        """They are as small as no node begins or ends to slip or touch."""
        angle, by = 0.0175, 2e-5
        text = rolling(RADIUS, friction=0.9, samples=2, more="speed = 3.1e-4").replace("sectors = 90", "sectors = 24")
        text = text.replace(f"height = {RADIUS!r}\n", "")

        def state(angle, load):
            return self.state(text + f"load = {load}\n", *ALL, "--set", f"motion.slip_angle={angle}")

        slopes = state(angle, 900.0)["slopes"]
        turned = [state(angle + sign * by, 900.0) for sign in (-1, 1)]
        pressed = [state(angle, 900.0 + sign * 0.05) for sign in (-1, 1)]
        for name in ("force_lateral", "moment_aligning", "height"):
            for slope, (low, high), step in (("by_slip_angle", turned, by), ("by_load", pressed, 0.05)):
                difference = (high[name] - low[name]) / (2 * step)
                self.assertAlmostEqual(slopes[slope][name] / difference, 1.0, delta=1e-3, msg=(slope, name))

    def test_round_off_of_powers_is_judged_by_load_and_speed(self):
        """A column under the axle has no arm: what its normal forces turn is no scale."""
        self.load(1e-3)
        self.assertLess(summary(self.results)["energy_residual_relative"], 1e-12)

    def test_what_is_not_balanced_is_told(self):
        text = rolling(RADIUS - 0.09, more="speed = 3.1e-4").replace("sectors = 90", "sectors = 12")
        done = run("run", self.case(text), "-o", self.results, "--quiet", *ALL)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("the nonlinear forces (inflation.nonlinear) were not balanced", done.stderr)
        self.assertIn("less deflection", done.stderr)


if __name__ == "__main__":
    unittest.main()

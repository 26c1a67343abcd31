# SPDX-License-Identifier: BSD-3-Clause
"""rondo run --reduced on rims that move: loads, torque, brake, supports."""
import unittest

import numpy as np

from program import ROOT, history, replaced, run, summary
from wheels import WheelTest


def shipped(name, **keys):
    text = (ROOT / "cases" / f"{name}.toml").read_text()
    for key, value in keys.items():
        text = replaced(text, key, f"{key} = {value}")
    return text


class Rim(WheelTest):
    """On a rim that moves; numbers of the full run are from the comments of the shipped cases."""

    def window(self, rows, name, begin, end):
        t = np.asarray(rows["time_s"])
        return float(np.mean(np.asarray(rows[name])[(t >= begin) & (t < end)]))

    def run_both(self, case):
        """The reduced and the full run of a case."""
        out, done = self.wheel(case=case)
        self.assertLess(summary(out)["energy_residual_relative"], 1e-13)
        self.assertEqual(summary(out)["wheel"]["steps_not_converged"], 0)
        self.assertEqual(run("run", self.case(case), "-o", self.folder / "full").returncode, 0)
        return history(out), history(self.folder / "full"), done

    def test_a_wheel_that_stands_bears_its_load(self):
        """The crush of this disk bears 100 kN/m at 0.293829 m."""
        out, _ = self.wheel(case=shipped("wheel-settle"))
        rows = history(out)
        self.assertAlmostEqual(self.window(rows, "force_y", 0.24, 1), 1e5, delta=0.1)
        self.assertAlmostEqual(self.window(rows, "center_y_m", 0.24, 1), 0.293829, delta=1e-6)
        self.assertAlmostEqual(min(rows["center_y_m"]), 0.3 - 0.0074, delta=2e-5)
        self.assertLess(summary(out)["energy_residual_relative"], 1e-13)

    def test_it_falls_as_all_bodies_do(self):
        """In flight the center follows a parabola but for what the spin does to the body; from then
        on force and momentum agree with the full run."""
        reduced, full, _ = self.run_both(shipped("wheel-drop"))
        t = np.asarray(reduced["time_s"])
        y = 0.35 - 0.5 * 9.81 * t**2
        flight = t < 0.05
        np.testing.assert_allclose(np.asarray(reduced["center_y_m"])[flight], y[flight], atol=1e-6)
        for name, share in (("speed_x", 0.005), ("spin_rad_s", 0.005)):
            late = self.window(full, name, 0.2, 1)
            self.assertAlmostEqual(self.window(reduced, name, 0.2, 1) / late, 1.0, delta=share)

    def test_a_torque_drives_it(self):
        """Force and spin, of a run to the middle of the ramp of the torque and well after it."""
        reduced, full, _ = self.run_both(shipped("wheel-driven", end=0.2))
        for begin, end in ((0.05, 0.08), (0.08, 0.11), (0.15, 0.2)):
            difference = (self.window(reduced, "force_x", begin, end) -
                          self.window(full, "force_x", begin, end))
            self.assertLess(abs(difference) / 1.5e5, 0.005)
            self.assertAlmostEqual(self.window(reduced, "spin_rad_s", begin, end),
                                   self.window(full, "spin_rad_s", begin, end), delta=0.01)

    def test_a_brake_locks_it_and_lets_it_go(self):
        """As by an anti-lock brake; the first pulse stops the wheel."""
        case = shipped("wheel-abs", end=0.26)
        reduced, full, _ = self.run_both(case)
        self.assertEqual(0.0, min(abs(s) for s in reduced["spin_rad_s"]))
        for begin, end in ((0.12, 0.15), (0.15, 0.18), (0.18, 0.2), (0.22, 0.26)):
            difference = (self.window(reduced, "force_x", begin, end) -
                          self.window(full, "force_x", begin, end))
            self.assertLess(abs(difference) / 1.5e5, 0.01)
            self.assertAlmostEqual(self.window(reduced, "spin_rad_s", begin, end),
                                   self.window(full, "spin_rad_s", begin, end), delta=0.15)
        out, _ = self.wheel("--set", "ground.friction=0.3", "--overwrite", case=case)
        slides = self.window(history(out), "force_x", 0.15, 0.18)
        self.assertAlmostEqual(slides / self.window(reduced, "force_x", 0.15, 0.18), 0.5, delta=0.01)

    def test_a_quarter_car_over_a_bump(self):
        reduced, full, _ = self.run_both(shipped("quarter-car-bump", end=0.25))
        for name, scale, share in (("force_y", 1.5e5, 0.005), ("center_y_m", 0.0083, 0.02)):
            for begin in np.arange(0.05, 0.25, 0.02):
                difference = (self.window(reduced, name, begin, begin + 0.02) -
                              self.window(full, name, begin, begin + 0.02))
                self.assertLess(abs(difference) / scale, share, (name, begin))

    def test_a_moving_rim_resumes_to_the_same_bits(self):
        case = shipped("wheel-abs", end=2.0)
        self.wheel("--quiet", case=case, out="whole")
        out, command = self.interrupted(case, (300, 1500))
        self.assertEqual(run(*command[1:]).returncode, 0)
        self.same_bits(out)

    def test_a_spin_beyond_what_is_known(self):
        """It outgrows the step, too; in the end it turns too far in a step. Long before that strains have
        turned an element inside out, which is seen where snapshots are looked at."""
        torque, few = ("--set", "rim.torque=[[0, 2e5]]"), ("--set", "output.snapshots=2")
        short = shipped("wheel-driven", end=0.05)
        _, done = self.wheel(*torque, case=short, code=3, out="looked-at")
        self.assertIn("is inverted", done.stderr)
        _, done = self.wheel(*torque, *few, case=short)
        self.assertIn("is extrapolated", done.stderr)
        self.assertIn("steps in the pass of a sector", done.stderr)
        _, done = self.wheel(*torque, *few, "--overwrite", code=3, case=shipped("wheel-driven", end=0.3))
        self.assertIn("more than 0.3: differences of positions", done.stderr)
        self.assertIn("--reduced-step of a reduced wheel", done.stderr)

    def test_a_steady_start_is_one(self):
        """On a rim that is held, and on one whose load is that of the steady state."""
        case = shipped("wheel-rolling", end=0.02)
        settings = ["initial.state=steady-rolling", "motion.height=0.291675",
                    "rim.force_y=[[0, -1.5e5]]"]
        for free in ('["height"]', "[]"):
            words = settings + [f"rim.free={free}"]
            if free == "[]":
                words = settings[:2] + ["rim.free=[]", "rim.force_y=0", "rim.support.y.damping=0"]
            out, _ = self.wheel(*(word for s in words for word in ("--set", s)), "--overwrite",
                                case=case)
            self.assertLess(abs(np.asarray(history(out)["force_y"])[:5] / 1.5e5 - 1.0).max(), 0.02)

    def test_check_tells_the_step(self):
        done = run("check", ROOT / "cases" / "wheel-rolling.toml", "--reduced")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"integrator +reduced wheel with exact contact")
        self.assertRegex(done.stdout, r"steps in a pass +2\.618")


if __name__ == "__main__":
    unittest.main()

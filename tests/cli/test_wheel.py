# SPDX-License-Identifier: BSD-3-Clause
"""rondo run --reduced without a file: a reduced wheel with exact contact, made of the case."""
import unittest

import h5py
import numpy as np

from program import ROOT, history, replaced, run, summary
from wheels import WheelTest

STEADY = (ROOT / "cases" / "steady-rolling.toml").read_text()
# The disk of that case, lowered in 0.02 s.
ROLLING = replaced(replaced(replaced(
    STEADY, "height", "height = [[0, 0.31], [0.02, 0.29]]"), "kind", 'kind = "dynamic"'),
    "angular_velocity", "angular_velocity = 33.333333333333333") + """
[time]
end = 0.2
[output]
snapshots = 11
"""


def mean(rows, name, since=0.15):
    late = np.asarray(rows["time_s"]) > since
    return float(np.mean(np.asarray(rows[name])[late]))


class Wheel(WheelTest):
    def wheel(self, *arguments, case=ROLLING, **more):
        return super().wheel(*arguments, case=case, **more)

    def test_forces_are_those_of_steady_rolling(self):
        """Means over the pass of a sector of the full disk, by the steady solver; see there."""
        for friction, x, y in ((0.2, -18294, 189915), (0.4, -22044, 190098), (0.6, -23293, 190234)):
            out, _ = self.wheel("--set", f"ground.friction={friction}", "--overwrite")
            rows = history(out)
            self.assertAlmostEqual(mean(rows, "force_x") / y, x / y, delta=0.002, msg=str(friction))
            self.assertAlmostEqual(mean(rows, "force_y") / y, 1.0, delta=0.001, msg=str(friction))
        s = summary(out)
        self.assertLess(s["energy_residual_relative"], 1e-11)
        self.assertGreaterEqual(s["wheel_modes"], 10)
        self.assertLess(s["wheel"]["contact_iterations_mean"], 3.0)
        self.assertEqual(s["wheel"]["steps_not_converged"], 0)

    def test_more_modes_change_little(self):
        few, _ = self.wheel("--modes", 11, "--reduced-step", "0.0004", out="few")
        many, _ = self.wheel("--modes", 91, "--reduced-step", "0.0002", out="many")
        self.assertEqual(summary(few)["wheel_modes"], 11)
        self.assertEqual(summary(many)["wheel_modes"], 91)
        y = mean(history(many), "force_y")
        self.assertAlmostEqual(mean(history(few), "force_y") / y, 1.0, delta=0.001)
        self.assertAlmostEqual(mean(history(few), "force_x") / y,
                               mean(history(many), "force_x") / y, delta=0.003)

    def test_fields_are_of_all_nodes(self):
        """Where they touch, nodes are on the ground; the field between is that of the full run."""
        out, _ = self.wheel("--modes", 91)
        with h5py.File(out / "results.h5") as f:
            u, angle = f["/snapshots/displacement"][-1], f["/frame/angle"][-1]
            x = f["/mesh/coordinates"][:]
            center = f["/frame/center"][-1]
        place = x + u
        height = center[1] + np.sin(angle) * place[:, 0] + np.cos(angle) * place[:, 1]
        self.assertGreater(height.min(), -1e-9)
        self.assertGreaterEqual(np.count_nonzero(height < 1e-9), 8)

    def test_it_resumes_to_the_same_bits(self):
        case = replaced(ROLLING, "end", "end = 4.0")
        self.wheel("--quiet", case=case, out="whole")
        out, command = self.interrupted(case, (300, 3000))
        done = run("run", self.case(case), "-o", out, "--resume")
        self.assertEqual(done.returncode, 2)
        self.assertIn("the run to resume is one of a reduced wheel of", done.stderr)
        done = run(*command[1:-1], "--modes", 12)
        self.assertEqual(done.returncode, 2)
        self.assertIn("its --modes and --reduced-step where it had them", done.stderr)
        self.assertEqual(run(*command[1:]).returncode, 0)
        self.same_bits(out)

    def test_a_spin_that_changes(self):
        """From braked to driven: the ledger closes, and the force turns round."""
        case = replaced(ROLLING, "angular_velocity",
                        "angular_velocity = [[0.1, 33.333333333333333], [0.15, 38.0]]")
        out, _ = self.wheel(case=case)
        rows = history(out)
        self.assertLess(summary(out)["energy_residual_relative"], 1e-11)
        early = (np.asarray(rows["time_s"]) > 0.05) & (np.asarray(rows["time_s"]) < 0.1)
        self.assertLess(np.asarray(rows["force_x"])[early].mean(), -15000)
        self.assertGreater(mean(rows, "force_x", 0.18), 15000)

    def test_any_start_and_a_wheel_that_is_locked(self):
        """The energy of the start is in the ledger; a steady start is near its end."""
        for settings in (["initial.velocity=[1,0]"], ["initial.state=stationary"],
                         ["initial.state=steady-rolling", "motion.height=0.29"],
                         ["motion.angular_velocity=[[0,0],[1,0]]"]):
            out, _ = self.wheel(*(word for s in settings for word in ("--set", s)), "--overwrite")
            self.assertLess(summary(out)["energy_residual_relative"], 1e-11, settings)
            if "steady" in settings[0]:  # from the first step on
                forces = np.asarray(history(out)["force_y"])
                self.assertLess(abs(forces[:5] / 190098 - 1.0).max(), 0.015)
                self.assertAlmostEqual(np.mean(forces) / 190098, 1.0, delta=0.002)
        self.assertAlmostEqual(mean(history(out), "force_x") / mean(history(out), "force_y"), -0.4,
                               delta=0.001)

    def test_what_it_refuses(self):
        def refused(text, *settings, case=ROLLING, options=()):
            arguments = [word for s in settings for word in ("--set", s)]
            _, done = self.wheel(*arguments, *options, case=case, code=2)
            self.assertIn(text, done.stderr)

        refused("no restitution", "ground.restitution=0.5")
        refused("is a law of velocities", 'ground.impact="energy-safe"')
        refused("there is no ground", case=ROLLING.replace(
            '[ground]\nprofile = "flat"\nfriction = 0.4\n', ""))
        refused("moves in time", case=STEADY)
        refused("is no step of a reduced wheel", options=("--reduced-step", "-1"))
        refused("up to time.end = 0.2", options=("--reduced-step", "0.3"))
        refused("a reduced wheel has one scheme", options=("--reduced-step", "explicit"))
        refused("is no number of modes", options=("--modes", "-3"))

    def test_the_estimate_is_what_other_runs_say(self):
        out, done = self.wheel("--estimate", "--modes", 20, "--reduced-step", "0.0004")
        told = summary(out)["wheel_estimate"]
        self.assertIn("error estimate: F_x", done.stderr)
        y = {}
        for name, modes, step in (("finer", 20, "0.0002"), ("richer", 40, "0.0004")):
            other, _ = self.wheel("--modes", modes, "--reduced-step", step, out=name)
            y[name] = [mean(history(folder), column) for folder in (out, other)
                       for column in ("force_x", "force_y")]
        for name, key in (("finer", "force_x_by_step"), ("richer", "force_x_by_modes")):
            x, _, other_x, other_y = y[name]
            self.assertAlmostEqual(told[key], (x - other_x) / other_y, delta=2e-4, msg=name)
        self.assertEqual(told["force_x"], max(abs(told["force_x_by_step"]),
                                              abs(told["force_x_by_modes"])))
        out, _ = self.wheel("--estimate", "--set", "motion.height=0.31", "--overwrite")
        self.assertIn("nothing presses", summary(out)["wheel_estimate_missing"])
        done = run("run", self.case(ROLLING), "--estimate")
        self.assertEqual(done.returncode, 2)

    def test_check_tells_modes_and_step(self):
        done = run("check", self.case(ROLLING), "--reduced", "--modes", 20)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"integrator +reduced wheel with exact contact")
        self.assertRegex(done.stdout, r"modes +20, up to 1937\.4 rad/s")
        self.assertRegex(done.stdout, r"steps in a pass +2\.618")
        done = run("check", self.case(ROLLING), "--reduced", "--reduced-step", "0.003")
        self.assertIn("a step moves by", done.stderr)
        done = run("check", self.case(ROLLING), "--modes", 20)
        self.assertEqual(done.returncode, 2)

    def test_what_it_warns_of(self):
        _, done = self.wheel("--reduced-step", "0.002", "--modes", 91)
        for text in ("turns by", "a step moves by", "steps in the pass of a sector"):
            self.assertIn(text, done.stderr)
        _, done = self.wheel("--set", "disk.mesh.circumferential=40", "--overwrite")
        self.assertIn("contact has", done.stderr)


if __name__ == "__main__":
    unittest.main()

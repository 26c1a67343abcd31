# SPDX-License-Identifier: BSD-3-Clause
"""A step of the slip of a wheel that rolls steadily: relaxation lengths, without steps in time and with them."""
import csv
import unittest

import numpy as np

from program import ROOT, RunTest, history, run, settings, summary
from test_tyre_steady_nonlinear import RADIUS, rolling

STEADY = (ROOT / "cases" / "wheel3d-steady.toml").read_text()
IN_TIME = (ROOT / "cases" / "wheel3d-cornering.toml").read_text()
STEPPED = ("motion.slip_angle=0", "analysis.slip=upwind", "analysis.accept_scheme_power=true",
           "analysis.step_distance=1.0")
TURNS, SLIPS = "analysis.slip_angle_step=0.01", "analysis.slip_ratio_step=0.01"
SHARE = 1.0 - np.exp(-1.0)
STUDY = """schema = 1
base = "case.toml"
[[vary]]
key = "analysis.slip_angle_step"
values = [0.001, 0.01]
"""


class SlipStep(RunTest):
    text = STEADY

    def of(self, *given, text=None):
        said = self.run_set(*given, text=text)
        return summary(self.out), said

    def table(self):
        with open(self.out / "slip-step.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}

    def test_rolls_from_one_steady_state_to_the_other(self):
        told, _ = self.of(*STEPPED, TURNS)
        step, rows = told["slip_step"], self.table()
        after, _ = self.of(*STEPPED[1:3], "motion.slip_angle=0.01")
        self.assertLess(step["residual"], 1e-10)
        self.assertEqual(len(rows["distance_m"]), step["steps"] + 1)
        self.assertAlmostEqual(np.diff(rows["distance_m"])[0] * 360 / (20 * np.pi / 33.76455), 1.0, delta=1e-9)
        for name in ("force_lateral", "moment_aligning"):
            one = step[name]
            self.assertAlmostEqual(one["before"], told["steady"][name], delta=1e-9)
            self.assertAlmostEqual(one["after"], after["steady"][name], delta=1e-6)
            self.assertAlmostEqual(rows[name][-1], one["after"], delta=1e-3 * abs(one["after"]))
            share = (rows[name] - one["before"]) / (one["after"] - one["before"])
            self.assertAlmostEqual(one["relaxation_length"], np.interp(SHARE, share[:100], rows["distance_m"][:100]),
                                   delta=1e-9)
            self.assertAlmostEqual(one["share"], share[-1], delta=1e-12)
            fit = np.sqrt(np.mean((share - 1 + np.exp(-rows["distance_m"] / one["fitted_length"])) ** 2))
            self.assertAlmostEqual(one["fit_error"], fit, delta=1e-9)
        self.assertAlmostEqual(step["force_lateral"]["relaxation_length"], 0.1429, delta=1e-4)

    def test_rolls_on_as_steps_in_time(self):
        """The same wheel comes down straight, and turns by .01 rad after 60 ms."""
        told, _ = self.of(*STEPPED, TURNS)
        step = told["slip_step"]["force_lateral"]
        turned = "motion.slip_angle=[[0.0, 0.0], [0.06, 0.0], [0.0601, 0.01]]"
        self.of(turned, "time.end=0.16", "output.snapshots=0", text=IN_TIME)
        rows = history(self.out)
        time, force = np.array(rows["time_s"]), np.array(rows["force_lateral"])
        late = force[time > 0.13].mean()
        pass_of_a_sector = round(2 * np.pi / 90 / 33.76455 / (time[1] - time[0]))
        share = np.convolve(force, np.ones(pass_of_a_sector) / pass_of_a_sector, "same") / late
        length = 10.0 * (time[np.argmax((share >= SHARE) & (time > 0.06))] - 0.06)
        self.assertAlmostEqual(late / step["after"], 1.0, delta=0.01)
        self.assertAlmostEqual(length / step["relaxation_length"], 1.0, delta=0.04)  # .1467 and .1429 m

    def test_of_the_slip_ratio_changes_the_speed(self):
        told, _ = self.of(*STEPPED, SLIPS)
        step, rows = told["slip_step"], self.table()
        self.assertNotIn("force_lateral", step)
        self.assertAlmostEqual(rows["slip_ratio"][1] - rows["slip_ratio"][0], 0.01, delta=1e-12)
        self.assertAlmostEqual(rows["speed"][1], (1 - rows["slip_ratio"][1]) * 33.76455 * 0.3, delta=1e-9)
        after, _ = self.of(*STEPPED[:3], f"motion.speed={float(rows['speed'][1])!r}")
        self.assertAlmostEqual(step["force_x"]["after"], after["steady"]["force_x"], delta=1e-6)
        self.assertAlmostEqual(step["force_x"]["relaxation_length"], 0.1622, delta=1e-4)
        braked, _ = self.of(*STEPPED, "analysis.slip_ratio_step=-0.05")
        self.assertLess(braked["slip_step"]["force_x"]["after"], -4000.0)
        self.assertAlmostEqual(self.table()["slip_ratio"][-1], rows["slip_ratio"][0] - 0.05, delta=1e-12)

    def test_of_the_slip_ratio_rolls_backwards(self):
        """As forwards, in a mirror: a ratio > 0 pushes along the heading, which brakes."""
        for step in (0.01, -0.01):
            forwards, _ = self.of(*STEPPED, f"analysis.slip_ratio_step={-step}")
            ahead = self.table()
            back, _ = self.of(*STEPPED, f"analysis.slip_ratio_step={step}", "motion.speed=-10",
                              "motion.angular_velocity=-33.76455")
            rows = self.table()
            self.assertAlmostEqual(rows["slip_ratio"][0], -0.01277, delta=1e-5)
            self.assertAlmostEqual(rows["slip_ratio"][-1], rows["slip_ratio"][0] + step, delta=1e-12)
            self.assertLess(abs(rows["speed"] + ahead["speed"]).max(), 1e-12)
            for name in ("before", "after", "relaxation_length"):
                sign = 1.0 if name == "relaxation_length" else -1.0
                self.assertAlmostEqual(back["slip_step"]["force_x"][name] / forwards["slip_step"]["force_x"][name], sign,
                                       delta=1e-6)

    def test_steps_that_do_not_roll_are_refused(self):
        for given, said in [
                (("motion.speed=4", "analysis.slip_ratio_step=0.5"), "a step > -1.605 and < 0.3949"),
                (("motion.speed=5.064683", "analysis.slip_ratio_step=0.5"), "at most 20000 steps"),
                (("motion.speed=0", TURNS), "its speed after the step is 0"),
                ((TURNS, "analysis.step_distance=104"), "2.012e+04 steps of a sample, 0.005169 m each at 10 m/s")]:
            for command in (("check",), ("run", "-o", self.out)):
                done = run(command[0], self.case(STEADY), *command[1:], *settings(*STEPPED, *given))
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn(said, done.stderr)
        done = run("check", self.case(STEADY), *settings(*STEPPED, TURNS))
        self.assertIn("1 m rolled after it, 194 steps, 360 a turn", done.stdout)

    def test_a_short_distance_is_warned_of(self):
        told, said = self.of(*STEPPED[:3], TURNS, "analysis.step_distance=0.1")
        self.assertIn("analysis.step_distance = 0.1 m: only 49.9 % of the change of the lateral force is reached after 0.1034 m",
                      said)
        self.assertIsNone(told["slip_step"]["force_lateral"]["relaxation_length"])
        told, said = self.of(*STEPPED[:3], TURNS, "analysis.step_distance=0.001")
        self.assertIn("is reached after 0.005169 m, and no exponential is fitted", said)
        self.assertIsNone(told["slip_step"]["force_lateral"]["fitted_length"])
        self.assertIsNone(told["slip_step"]["force_lateral"]["fit_error"])

    def test_a_slow_moment_and_a_sliding_wheel_are_warned_of(self):
        _, said = self.of(*STEPPED[:3], TURNS, "analysis.step_distance=0.41")
        self.assertNotIn("lateral force", said)
        self.assertIn("of the change of the aligning moment is reached", said)
        _, said = self.of(*STEPPED, TURNS)
        self.assertNotIn("warning", said)
        _, said = self.of(*STEPPED, "analysis.slip_angle_step=0.05")
        self.assertIn("of the load is where the wheel slides", said)

    def test_load_and_torque_are_held(self):
        text = STEADY.replace("height = 0.29 ", "#").replace("speed = 10.0 ", "#")
        self.of(*STEPPED, TURNS, "analysis.load=15000", "analysis.torque=0", text=text)
        rows = self.table()
        self.assertLess(abs(rows["force_y"] - 15000).max(), 1e-6)
        self.assertLess(abs(rows["torque"]).max(), 1e-6)
        self.assertGreater(rows["height_m"].std(), 1e-9)

    def test_the_table_goes_with_its_run(self):
        self.of(*STEPPED, TURNS)
        told, _ = self.of()
        self.assertNotIn("slip_step", told)
        self.assertFalse((self.out / "slip-step.csv").exists())

    def test_a_sweep_has_the_lengths(self):
        self.case(STEADY)
        (self.folder / "study.toml").write_text(STUDY)
        done = run("sweep", self.folder / "study.toml", "-o", self.out, "--quiet",
                   *settings(*STEPPED[:3], "analysis.step_distance=1.0"))
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.out / "results.csv", newline="") as file:
            lengths = [float(row["relaxation_length_m"]) for row in csv.DictReader(file)]
        self.assertAlmostEqual(lengths[1], 0.1429, delta=1e-4)
        self.assertGreater(lengths[0], lengths[1])  # all but nothing slides

    def test_nonlinear_tyres_are_refused(self):
        text = rolling(RADIUS - 1e-3, more="speed = 3.1e-4")
        done = run("check", self.case(text), *settings("analysis.slip=upwind", TURNS, "analysis.step_distance=1",
                                                       "inflation.nonlinear=cords"))
        self.assertEqual(done.returncode, 2)
        self.assertIn("inflation.nonlinear", done.stderr)
        self.assertIn("has linear forces", done.stderr)


if __name__ == "__main__":
    unittest.main()

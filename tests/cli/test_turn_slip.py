# SPDX-License-Identifier: BSD-3-Clause
"""Steady rolling along a path that turns, and the moments about the contact centre of ISO 8855."""
import csv
import json
import math
import unittest

import numpy as np

from program import ROOT, RunTest, history, run, settings, summary
from test_tyre import TyreTest
from test_tyre_nonlinear import ALL
from test_tyre_steady_nonlinear import RADIUS, rolling

STEADY = (ROOT / "cases" / "wheel3d-steady.toml").read_text()
CORNERING = (ROOT / "cases" / "wheel3d-cornering.toml").read_text()
STANDS = """
[ground]
profile = "flat"
friction = 0.3
[analysis]
kind = "crush"
depth = 5e-3
increments = 2
"""
STUDY = """schema = 1
base = "case.toml"
[[vary]]
key = "motion.turn_slip"
values = [-0.02, 0.0, 0.02]
"""
MIRRORED = ("force_lateral", "moment_aligning", "moment_overturning", "moment_aligning_iso",
            "moment_overturning_iso")
STRAIGHT = "motion.slip_angle=0"


class TurnSlip(RunTest):
    text = STEADY

    def of(self, *given, text=None):
        self.run_set(*given, text=text)
        return summary(self.out)

    def steady(self, *given):
        told = self.of(*given)
        self.assertLess(told["contact_residual_max"], 1e-10)
        self.assertLess(told["energy_residual_relative"], 1e-12)
        return told["steady"]

    def test_left_and_right_are_mirror_images(self):
        left, right = (self.steady(STRAIGHT, f"motion.turn_slip={sign}0.02") for sign in ("", "-"))
        self.assertEqual((left["turn_slip"], right["turn_slip"]), (0.02, -0.02))
        for name in ("force_x", "force_y", "torque", "rolling_resistance"):
            self.assertAlmostEqual(left[name], right[name], delta=1e-9 * left["force_y"], msg=name)
        for name in MIRRORED:
            self.assertAlmostEqual(left[name], -right[name], delta=1e-9 * left["force_y"], msg=name)
        self.assertAlmostEqual(left["force_lateral"], 105.4, delta=0.1)      # outwards
        self.assertAlmostEqual(left["moment_aligning"], -2.955, delta=0.002)  # against the turn

    def test_both_at_once_are_mirror_images(self):
        left, right = (self.steady(*(f"motion.{key}={sign}{value}" for key, value in
                                     (("turn_slip", 0.1), ("camber", 0.05), ("slip_angle", 0.02))))
                       for sign in ("", "-"))
        for name in MIRRORED:
            self.assertAlmostEqual(left[name], -right[name], delta=1e-9 * left["force_y"], msg=name)

    def test_none_is_a_straight_path(self):
        straight, none = self.steady(), self.steady("motion.turn_slip=0")
        self.assertEqual(straight, none)
        self.assertEqual(none["turn_slip"], 0.0)

    def test_the_yaw_takes_part_in_the_power(self):
        told = self.steady(STRAIGHT, "motion.turn_slip=0.5")
        power, yaw = told["power"], 0.5 * told["speed"] * told["moment_aligning"]
        spin = -33.76455
        # The torque of run.json is clockwise on the rim; that of the ground is as large, and opposite.
        drive = told["speed"] * told["force_x"] + spin * told["torque"] + yaw
        self.assertAlmostEqual(power["drive"], drive, delta=1e-9 * abs(drive))
        self.assertLess(yaw, -0.1 * power["friction"])
        self.assertAlmostEqual(told["rolling_resistance"], -drive / told["speed"], delta=1e-9 * abs(drive))

    def test_slopes_are_differences_of_states(self):
        load = ("motion.camber=0.05", "analysis.load=1.8e4", "analysis.torque=0")
        text = "\n".join(line for line in STEADY.splitlines() if not line.startswith(("speed =", "height =")))
        names = ("force_x", "force_lateral", "torque", *MIRRORED, "height", "speed")

        def state(turn, angle=0.01, load=load):
            told = self.of(f"motion.turn_slip={turn!r}", f"motion.slip_angle={angle!r}", *load, text=text)
            return told["steady"]

        slopes = state(0.05)["slopes"]
        low, high = (state(0.05 + by) for by in (-1e-5, 1e-5))
        inwards, outwards = (state(0.05, 0.01 + by) for by in (-1e-6, 1e-6))
        lighter, heavier = (state(0.05, load=(load[0], f"analysis.load={1.8e4 + by!r}", load[2])) for by in (-1.0, 1.0))
        for slope, less, more, step in (("by_turn_slip", low, high, 2e-5), ("by_slip_angle", inwards, outwards, 2e-6),
                                        ("by_load", lighter, heavier, 2.0)):
            for name in names:
                difference = (more[name] - less[name]) / step
                size = abs(more["force_lateral"] - less["force_lateral"]) / step
                self.assertAlmostEqual(slopes[slope][name], difference, delta=2e-4 * size, msg=(slope, name))

    def test_a_sweep_varies_it(self):
        self.case(STEADY)
        study = self.case(STUDY, "study.toml")
        done = run("sweep", study, "-o", self.folder / "sweep")
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.folder / "sweep" / "results.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        self.assertEqual([float(row["motion.turn_slip"]) for row in rows], [-0.02, 0.0, 0.02])
        alone = self.steady("motion.turn_slip=0.02")
        for name in ("force_lateral", "moment_aligning_iso", "moment_overturning_iso"):
            self.assertEqual(float(rows[2][name]), alone[name], name)

    def refuse(self, part, *given, text=STEADY, command=("run",)):
        done = run(*command, self.case(text), "-o", self.folder / "no", *settings("motion.turn_slip=0.02", *given))
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("motion.turn_slip", done.stderr)
        self.assertIn(part, done.stderr)

    def test_others_refuse_it(self):
        self.refuse("analysis.kind = \"steady-rolling\"", text=CORNERING)
        self.refuse("analysis.kind = \"steady-rolling\"", text=STEADY.split("[damping]")[0] + STANDS)
        self.refuse("the body is plane", text=(ROOT / "cases" / "steady-rolling.toml").read_text())
        self.refuse("modes are of a wheel", command=("modes",))
        self.refuse("number", "motion.turn_slip=[[0, 0], [1, 0.1]]")

    # The contact centre -----------------------------------------------------------------------

    def expect_iso(self, rows, camber):
        aside = np.asarray(rows["center_y_m"]) * math.tan(camber)
        for name, of_force in (("aligning", -aside * rows["force_x"]), ("overturning", aside * rows["force_y"])):
            below, iso = (np.asarray(rows[f"moment_{name}{end}"]) for end in ("", "_iso"))
            size = np.abs(of_force).max() if camber else 0.0
            np.testing.assert_allclose(iso - below, of_force, rtol=0.0, atol=1e-9 * size, err_msg=name)
        if camber:
            self.assertGreater(np.abs(rows["moment_overturning_iso"] - rows["moment_overturning"]).max(), 1.0)

    def test_moments_about_the_contact_centre(self):
        for camber in (0.05, 0.0):
            told = self.of(f"motion.camber={camber}")["steady"]
            self.expect_iso(history(self.out), camber)
            self.expect_iso({**told, "center_y_m": told["height"]}, camber)
            self.of(f"motion.camber={camber}", "time.end=0.006", "output.snapshots=2", text=CORNERING)
            self.expect_iso(history(self.out), camber)

    def test_of_a_wheel_that_stands(self):
        text = STEADY.split("[damping]")[0] + "[motion]\ncamber = 0.05\n" + STANDS
        self.of(text=text)
        self.expect_iso(history(self.out), 0.05)


class Nonlinear(TyreTest):
    def state(self, *more):
        text = rolling(RADIUS, friction=0.9, samples=2, more="speed = 3.1e-4").replace("sectors = 90", "sectors = 24")
        text = text.replace(f"height = {RADIUS!r}\n", "") + "load = 900.0\n"
        done = run("run", self.case(text), "-o", self.results, "--overwrite", "--quiet", *ALL, *settings(*more))
        self.assertEqual(done.returncode, 0, done.stderr)
        told = json.loads((self.results / "run.json").read_text())
        self.assertLess(told["energy_residual_relative"], 1e-9)
        return told["steady"]

    def test_a_nonlinear_tyre_turns_as_well(self):
        """Its slopes are differences of states."""
        at = self.state("motion.turn_slip=0.1")
        self.assertLessEqual(at["balance_residual"], 1e-8)
        low, high = (self.state(f"motion.turn_slip={0.1 + by!r}") for by in (-1e-4, 1e-4))
        for name in ("force_lateral", "moment_aligning", "height"):
            difference = (high[name] - low[name]) / 2e-4
            self.assertAlmostEqual(at["slopes"]["by_turn_slip"][name] / difference, 1.0, delta=1e-3, msg=name)


if __name__ == "__main__":
    unittest.main()

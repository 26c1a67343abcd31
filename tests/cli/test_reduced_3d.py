# SPDX-License-Identifier: BSD-3-Clause
"""Reduced wheels in three dimensions (`rondo run --reduced`) against full runs and steady rolling."""
import math
import os
import signal
import subprocess
import time
import unittest

import numpy as np

from program import PROGRAM, ROOT, SANITIZED, ProgramTest, history, run, said, settings, summary

CORNERING = ROOT / "cases" / "wheel3d-cornering.toml"
STEADY = ROOT / "cases" / "wheel3d-steady.toml"
LOAD = ROOT / "cases" / "wheel3d-load.toml"
SPLIT = ROOT / "cases" / "wheel3d-mu-split.toml"
TYRE = ROOT / "cases" / "tyre-rolling.toml"
FEW = "output.snapshots=2"
FORCES = "force_x", "force_y", "force_lateral"


class Reduced(ProgramTest):
    def results(self, name, case, *given, reduced=True, options=()):
        """Its history, summary, and what it said."""
        directory = self.folder / name
        done = run("run", case, "-o", directory, "--quiet", "--overwrite", *(["--reduced"] if reduced else []),
                   *options, *settings(*given))
        self.assertEqual(done.returncode, 0, done.stderr)
        told = summary(directory)
        self.assertLess(told["energy_residual_relative"], 1e-11)
        if reduced:
            self.assertEqual(told["wheel"]["steps_not_converged"], 0)
        return history(directory), told, said(done)

    def mean(self, h, name, begin, end=np.inf):
        there = (h["time_s"] > begin) & (h["time_s"] <= end)
        return h[name][there].mean()

    def close(self, a, b, begin, bound, names=FORCES, end=np.inf):
        """Means of two histories, in shares of the vertical force."""
        load = self.mean(b, "force_y", begin, end)
        for name in names:
            self.assertLess(abs(self.mean(a, name, begin, end) - self.mean(b, name, begin, end)), bound * load, name)

    def test_cornering_is_that_of_the_full_run(self):
        """The coarse mesh keeps 0.45 % of F_n, by which nodes enter the ground in full runs."""
        for angle in (1.0, 4.0):
            given = FEW, f"motion.slip_angle={math.radians(angle)}", "output.history_interval=0"
            reduced = self.results("reduced", CORNERING, *given)[0]
            whole = self.results("whole", CORNERING, *given, reduced=False)[0]
            self.close(reduced, whole, 0.09, 0.006)
            for name, bound in (("moment_aligning", 1.2), ("moment_overturning", 2.4)):
                self.assertLess(abs(self.mean(reduced, name, 0.09) - self.mean(whole, name, 0.09)), bound)

    def test_what_the_mesh_keeps_against_steady_rolling_is_the_inertia_of_passing_nodes(self):
        """Steady rolling that leaves that inertia out has 5 N less, and that with it 52 N more, of 1,550."""
        reduced = self.results("reduced", CORNERING, FEW, "output.history_interval=0")[0]
        lateral = {}
        for inertia in ("waves", "all"):
            steady = self.results("steady", STEADY, "analysis.samples_per_sector=8", f'analysis.inertia="{inertia}"',
                                  reduced=False)[1]["steady"]
            lateral[inertia] = steady["force_lateral"]
            self.assertLess(abs(self.mean(reduced, "force_y", 0.09) - steady["force_y"]), 5.0)
        found = self.mean(reduced, "force_lateral", 0.09)
        self.assertLess(abs(found - lateral["waves"]), 0.001 * 17900.0)
        self.assertGreater(abs(found - lateral["all"]), 0.002 * 17900.0)

    def test_at_speed_the_compliance_alone_has_the_inertia_of_the_pattern(self):
        """Without modes, at 0.85 of the critical spin."""
        fast = "motion.speed=25", "motion.angular_velocity=84.4"
        reduced = self.results("fast", CORNERING, FEW, *fast, "output.history_interval=0", "time.end=0.1",
                               options=("--modes", "0"))[0]
        steady = self.results("steady", STEADY, *fast, 'analysis.inertia="waves"', "analysis.samples_per_sector=8",
                              reduced=False)[1]["steady"]
        self.assertLess(abs(self.mean(reduced, "force_y", 0.06) / steady["force_y"] - 1.0), 1e-3)

    def test_more_modes_carry_that_inertia(self):
        few, many = (self.results("modes", CORNERING, FEW, "output.history_interval=0", "time.end=0.1",
                                  options=("--modes", modes))[0] for modes in (40, 300))
        self.assertLess(self.mean(many, "force_lateral", 0.08), self.mean(few, "force_lateral", 0.08) - 10.0)

    def test_a_loaded_rim_is_that_of_the_full_run(self):
        for given in ([], ["motion.camber=0.1"]):
            given = FEW, "time.end=0.3", *given
            reduced, whole = (self.results("load", LOAD, *given, reduced=is_reduced)[0] for is_reduced in (True, False))
            self.close(reduced, whole, 0.25, 0.004)
            for end in (0.06, 0.15, 0.3):
                heights = [self.mean(h, "center_y_m", end - 0.02, end) for h in (reduced, whole)]
                self.assertLess(abs(heights[0] - heights[1]), 1e-4)

    def test_braking_with_one_side_on_ice_is_that_of_the_full_run(self):
        reduced, whole = (self.results("split", SPLIT, FEW, reduced=is_reduced)[0] for is_reduced in (True, False))
        self.close(reduced, whole, 0.2, 0.003)
        turns = [self.mean(h, "moment_aligning", 0.2) for h in (reduced, whole)]
        self.assertLess(turns[0], -25.0)  # to the side that grips
        self.assertLess(abs(turns[0] - turns[1]), 1.0)

    def test_friction_of_rubber_is_that_of_the_step_itself(self):
        law = ("ground.friction={coefficient = 0.4, slip_speed = [[0, 0.8], [0.4, 1], [3, 1.2]], "
               "pressure_exponent = -0.15, pressure_reference = 2e5}")
        given = FEW, "motion.slip_angle=0.1", "output.history_interval=0"
        reduced, told, _ = self.results("rubber", CORNERING, *given, law)
        self.assertEqual(told["wheel"]["steps_late_friction"], 0)
        whole = self.results("whole", CORNERING, *given, law, reduced=False)[0]
        self.close(reduced, whole, 0.09, 0.008)
        number = self.results("number", CORNERING, *given, "ground.friction=0.4")[0]
        self.assertGreater(abs(self.mean(reduced, "force_lateral", 0.09) - self.mean(number, "force_lateral", 0.09)),
                           200.0)

    def test_a_spin_that_changes_is_that_of_the_full_run(self):
        given = FEW, "motion.angular_velocity=[[0, 33.7], [0.02, 33.7], [0.12, 36]]", "output.history_interval=0"
        reduced, whole = (self.results("spin", CORNERING, *given, reduced=is_reduced)[0]
                          for is_reduced in (True, False))
        for begin, end in ((0.04, 0.06), (0.08, 0.1), (0.12, 0.14)):
            self.close(reduced, whole, begin, 0.007, end=end)

    def test_a_cleat_and_a_road_are_those_of_the_full_run(self):
        """Means over two passes of a sector, in shares of the largest vertical force."""
        cleat = ("ground.profile=\"flat\"", "ground.obstacle=[{kind = \"cleat\", at = 0.3, height = 0.016, "
                 "length = 0.06, angle = 0.5235987755982988, fillet = 0.016}]", "time.end=0.08")
        road = ("ground.restitution=0", "time.end=0.15")
        for case, given, bound in ((ROOT / "cases" / "wheel3d-cleat.toml", cleat, 0.012),
                                   (ROOT / "cases" / "wheel3d-cobbles.toml", road, 0.02)):
            given = FEW, "output.history_interval=0", *given
            reduced, whole = (self.results("bumps", case, *given, reduced=is_reduced)[0]
                              for is_reduced in (True, False))
            ends = np.arange(0.02, reduced["time_s"][-1], 0.004)
            most = max(self.mean(whole, "force_y", end - 0.004, end) for end in ends)
            for name in FORCES:
                off = [self.mean(reduced, name, end - 0.004, end) - self.mean(whole, name, end - 0.004, end)
                       for end in ends]
                self.assertLess(np.abs(off).max(), 4 * bound * most, name)
                self.assertLess(np.sqrt(np.mean(np.square(off))), bound * most, name)

    def test_a_wheel_that_stands_or_slides(self):
        for given in (["motion.angular_velocity=0", "motion.speed=0"], ["motion.angular_velocity=0", "motion.speed=5"]):
            reduced, whole = (self.results("stands", CORNERING, FEW, *given, reduced=is_reduced)[0]
                              for is_reduced in (True, False))
            self.close(reduced, whole, 0.1, 0.006)

    def test_the_mirror_and_the_way_back(self):
        given = FEW, "output.history_interval=0", "time.end=0.05"
        tight = "--law-residual", "1e-11"
        right = self.results("right", CORNERING, *given, options=tight)[0]
        left = self.results("left", CORNERING, *given, "motion.slip_angle=-0.017453292519943295", options=tight)[0]
        for name, sign in (("force_x", 1), ("force_y", 1), ("force_lateral", -1), ("moment_aligning", -1),
                           ("moment_overturning", -1)):
            np.testing.assert_allclose(left[name], sign * right[name], rtol=0.0, atol=1e-5)

    def test_the_residual_of_the_law_decides_how_exact_forces_are(self):
        """1e-4 of it changes the force by 1e-6 of F_n, 1e-6 by 1e-8."""
        given = FEW, "output.history_interval=0", "time.end=0.05"
        exact = self.results("exact", CORNERING, *given, options=("--law-residual", "1e-10"))[0]
        for residual, bound in (("1e-4", 3e-5), ("1e-6", 3e-7)):
            found = self.results("found", CORNERING, *given, options=("--law-residual", residual))[0]
            self.assertLess(np.abs(found["force_y"] - exact["force_y"]).max(), bound * 18000.0)

    def test_threads_and_a_resumed_run_have_the_same_bits(self):
        given = FEW, "time.end=0.6", "output.checkpoint_interval=0.02"
        one, two = (self.folder / name for name in ("one", "two"))
        self.results("one", LOAD, *given, options=("--threads", "1"))
        arguments = ["run", LOAD, "-o", two, "--quiet", "--reduced", "--threads", "2", *settings(*given)]
        child = subprocess.Popen([PROGRAM, *map(str, arguments)], stderr=subprocess.PIPE, text=True)
        for _ in range(2000):
            if (two / "history.csv").exists() and (two / "history.csv").stat().st_size > 20000:
                break
            time.sleep(0.01)
        child.send_signal(signal.SIGINT)
        child.communicate(timeout=float(os.environ.get("RONDO_TEST_TIMEOUT", "120")))
        before = len((two / "history.csv").read_text().splitlines())
        self.assertLess(before, len((one / "history.csv").read_text().splitlines()))
        done = run(*arguments, "--resume")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((one / "history.csv").read_bytes(), (two / "history.csv").read_bytes())

    def test_the_estimate_has_what_is_aside(self):
        told = self.results("estimate", CORNERING, FEW, "time.end=0.06", options=("--estimate",))[1]["wheel_estimate"]
        for name in "force_lateral", "moment_aligning":
            self.assertNotEqual(told[name], 0.0)
            self.assertLess(abs(told[name]), 0.02)

    def test_what_a_run_is_warned_of(self):
        for given, words in (
                (['ground.friction={coefficient = 0.6, slip_speed = [[0, 1.3], [0.4, 1], [3, 0.5]]}'], "falls with the slip"),
                (["damping.mass=3000"], "larger than the lowest one"),
                (["motion.camber=0.1"], "out of it after the first step")):
            warned = self.results("warned", CORNERING, FEW, "time.end=0.005", *given)[2]
            self.assertIn(words, warned)
            self.assertEqual(warned.count("warning"), 1, warned)
        told = run("check", LOAD, "--reduced").stderr
        self.assertIn("the full run, without --reduced, is faster", told)
        self.assertIn("times that of the reduced wheel", run("check", TYRE, "--reduced").stdout)

    @unittest.skipIf(SANITIZED, "minutes")
    def test_a_tyre_corners_as_in_steady_rolling(self):
        """On an axle; both to 1 % of F_n, also where most of the contact slides."""
        like = "section.sectors=90", "damping.mass=100", "damping.stiffness=2e-6"
        for angle in (math.radians(2.0), math.radians(6.0)):
            reduced = self.results("tyre", TYRE.with_name("tyre-load.toml"), FEW, "time.end=0.3",
                                   f"motion.slip_angle=[[0, 0], [0.02, 0], [0.08, {angle}]]")[0]
            steady = self.results("steady", TYRE.with_name("tyre-cornering.toml"), f"motion.slip_angle={angle}", *like,
                                  reduced=False)[1]["steady"]
            for name in FORCES:
                self.assertLess(abs(self.mean(reduced, name, 0.25) - steady[name]), 0.01 * steady["force_y"], name)

    @unittest.skipIf(SANITIZED, "minutes")
    def test_a_tyre_rolls_as_in_steady_rolling(self):
        reduced = self.results("tyre", TYRE, FEW, "time.end=0.15", "output.history_interval=0")[0]
        steady = self.results("steady", TYRE, 'analysis.kind="steady-rolling"', "motion.height=0.29985",
                              reduced=False)[1]["steady"]
        for name in FORCES:
            self.assertLess(abs(self.mean(reduced, name, 0.13) - steady[name]), 0.01 * steady["force_y"], name)

    def test_what_it_cannot_do_is_refused(self):
        for case, given, options, words in (
                (TYRE, ['inflation.nonlinear="cords"'], (), "inflation.nonlinear"),
                (CORNERING, ["ground.restitution=0.5"], (), "restitution"),
                (ROOT / "cases" / "wheel3d-tyre.toml", [], (), "load.pressure[0].value"),
                (CORNERING, [], ("--law-residual", "1"), "1e-12 to 0.001"),
                (ROOT / "cases" / "rolling-flat.toml", [], ("--law-residual", "1e-6"), "three dimensions")):
            done = run("run", case, "-o", self.folder / "refused", "--reduced", *options, *settings(*given))
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(words, done.stderr)
        wheel = self.folder / "wheel.h5"
        done = run("reduce", CORNERING, "-o", wheel)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("three dimensions", done.stderr)


if __name__ == "__main__":
    unittest.main()

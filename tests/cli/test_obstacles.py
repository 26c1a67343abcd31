# SPDX-License-Identifier: BSD-3-Clause
"""Obstacles on the ground: those of a profile drawn by hand, at an angle, and what they refuse."""
import unittest

import numpy as np

from program import ROOT, SMALL, ProgramTest, history, run, summary
from test_resume import RESULTS, ResumeTest

CLEAT = "ground.obstacle=[{kind = 'cleat', at = 0.05, height = 0.01, length = 0.02}]"
DRAWN = "ground.profile=[[-1, 0], [0.05, 0], [0.05, 0.01], [0.07, 0.01], [0.07, 0], [1, 0]]"
WHEEL = (ROOT / "cases" / "wheel3d-cleat-sharp.toml").read_text()
FLAT = "ground.profile='flat'"


def settings(*values):
    return [x for value in values for x in ("--set", value)]


class OfAProfile(ProgramTest):
    def bits(self, text, *values):
        out = self.folder / "out"
        done = run("run", self.case(text), "-o", out, "--quiet", "--overwrite", *settings(*values))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertLess(summary(out)["energy_residual_relative"], 1e-12)
        return (out / "history.csv").read_bytes()

    def test_a_cleat_has_the_bits_of_the_profile_drawn_by_hand(self):
        drawn = self.bits(SMALL, DRAWN)
        self.assertEqual(self.bits(SMALL, CLEAT), drawn)
        self.assertNotEqual(self.bits(SMALL), drawn)
        fillet = CLEAT.replace("}", ", fillet = 0.004}")
        rounded = self.bits(SMALL, DRAWN, "ground.fillet=0.004")
        self.assertEqual(self.bits(SMALL, fillet), rounded)
        self.assertNotEqual(rounded, drawn)

    def test_so_has_one_of_a_wheel_with_a_width(self):
        cleat = CLEAT.replace("0.05", "0.3")
        self.assertEqual(self.bits(WHEEL, FLAT, cleat, "time.end=0.06"),
                         self.bits(WHEEL, "time.end=0.06"))

    def test_several_stand_on_a_profile(self):
        both = ("ground.obstacle=[{kind = 'step', at = 0.12, height = -0.005}, "
                "{kind = 'pothole', at = 0.05, height = 0.01, length = 0.03}]")
        drawn = ("ground.profile=[[-1, 0], [0, 0.0], [0.05, 0], [0.05, -0.01], [0.08, -0.01], [0.08, 0.0], "
                 "[0.1, 0.0], [0.12, 0.0], [0.12, -0.005], [1, -0.005]]")
        base = "ground.profile=[[-1, 0], [0, 0.0], [0.1, 0.0], [1, 0]]"
        self.assertEqual(self.bits(SMALL, base, both), self.bits(SMALL, drawn))


class AtAnAngle(ProgramTest):
    """A cleat with sharp edges at 30° under a wheel with a width."""
    text = (ROOT / "cases" / "wheel3d-cleat-30.toml").read_text()

    def rows(self, *values, threads=1):
        out = self.folder / "out"
        done = run("run", self.case(self.text), "-o", out, "--quiet", "--overwrite", "--threads",
                   threads, *settings(*values))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertLess(summary(out)["energy_residual_relative"], 1e-12)
        self.assertLess(summary(out)["contact_residual_max"], 1e-12)
        return history(out)

    @staticmethod
    def turned(angle):
        return CLEAT.replace("0.05", "0.3").replace("}", f", angle = {angle}}}")

    def test_seen_in_a_mirror_it_is_the_other_angle(self):
        left, right = self.rows(), self.rows(self.turned(-0.5236))
        self.assertGreater(summary(self.folder / "out")["contact"]["clusters_solved"], 500)
        for name, sign in (("force_x", 1), ("force_y", 1), ("torque", 1), ("force_lateral", -1),
                           ("moment_aligning", -1), ("moment_overturning", -1)):
            most = np.abs(left[name]).max()
            self.assertLess(np.abs(left[name] - sign * right[name]).max(), 1e-11 * most, name)
        aside = left["force_lateral"]
        self.assertGreater(np.abs(aside).max(), 0.04 * left["force_y"].max())
        slippery = self.rows("ground.friction=0.3")["force_lateral"]
        self.assertGreater(np.abs(slippery - aside).max(), 0.1 * np.abs(aside).max())

    def test_a_small_angle_is_nearly_straight(self):
        straight, turned = self.rows(self.turned(0.0)), self.rows(self.turned(1e-9))
        self.assertLess(np.abs(straight["force_lateral"]).max(), 1e-9)
        for name in ("force_x", "force_y", "torque"):
            most = np.abs(straight[name]).max()
            self.assertLess(np.abs(turned[name] - straight[name]).max(), 1e-5 * most, name)

    def test_it_stands_where_its_edge_crosses_the_middle(self):
        # The rim of a narrow wheel of 0.3 m, 0.294 m above the ground, is 0.01 m high at 0.097 m
        # before its center.
        rows = self.rows("disk.width=0.002", "disk.mesh.axial=1", "ground.friction=0",
                         "time.end=0.1", self.turned(0.7).replace("0.3,", "0.5,"))
        pushed = rows["center_x_m"][np.abs(rows["force_x"]) > 1e-6]
        self.assertLess(abs(pushed[0] - (0.5 - 0.0966)), 0.006)

    def test_its_left_side_meets_it_first(self):
        rows = self.rows("time.end=0.06")
        first = np.flatnonzero(np.abs(rows["moment_overturning"]) > 20.0)[0]
        self.assertGreater(rows["moment_overturning"][first], 0.0)  # a force up at t2 < 0
        self.assertGreater(rows["time_s"][first], 0.03)

    def test_it_goes_on_bit_for_bit_and_with_other_threads(self):
        whole = self.rows("time.end=0.065")
        for name, column in self.rows("time.end=0.065", threads=2).items():
            self.assertTrue(np.array_equal(column, whole[name]), name)
        out = self.folder / "parts"
        parts = [run("run", self.case(self.text), "-o", out, "--set", "time.end=0.0602"),
                 run("run", out, "--resume", "--set", "time.end=0.065")]
        self.assertEqual([p.returncode for p in parts], [0, 0], parts[1].stderr)
        for name, column in history(out).items():
            self.assertTrue(np.array_equal(column, whole[name]), name)


class Refused(ProgramTest):
    def refused(self, text, *values):
        done = run("check", self.case(text), *settings(*values))
        self.assertEqual(done.returncode, 2, done.stdout)
        return done.stderr

    def test_what_is_no_obstacle_says_so_at_its_key(self):
        for old, new, said in (
                ("height = 0.01", "height = -0.01", "ground.obstacle[0].height"),
                ("height = 0.01, ", "", "ground.obstacle[0].height"),
                (", length = 0.02", "", "ground.obstacle[0].length"),
                ("'cleat'", "'bump'", '"cleat", "step" or "pothole"'),
                ("'cleat'", "'step'", "a step has no length"),
                ("0.01, length = 0.02", "0.02, length = 0.02, fillet = 0.011", "it needs 0.022 m of the length of 0.02 m"),
                ("}", ", angle = 0.3}", "a plane body has no width"),
                ("}", ", width = 0.3}", "ground.obstacle[0].width")):
            with self.subTest(new):
                self.assertIn(said, self.refused(SMALL, CLEAT.replace(old, new)))

    def test_obstacles_that_overlap_say_where(self):
        two = CLEAT.replace("]", ", {kind = 'step', at = 0.06, height = 0.01}]")
        self.assertIn("begins within the obstacle from x = 0.05 to 0.07 m", self.refused(SMALL, two))

    def test_sharp_edges_at_an_angle_need_level_ground(self):
        turned = CLEAT.replace("0.05", "0.3").replace("}", ", angle = 0.3}")
        self.assertIn("ground.obstacle[0].fillet: an obstacle at an angle on ground that is not level",
                      self.refused(WHEEL, turned))

    def test_steady_rolling_and_a_start_in_it_need_flat_ground(self):
        steady = (ROOT / "cases" / "steady-rolling.toml").read_text()
        said = self.refused(steady, CLEAT)
        self.assertIn("ground.obstacle: steady rolling needs flat ground", said)
        self.assertIn("no [[ground.obstacle]]", said)

    def test_a_small_fillet_is_told_of_by_its_own_key(self):
        small = "ground.obstacle=[{kind = 'step', at = 0.25, height = 0.02, fillet = 0.004}]"
        done = run("check", self.case(SMALL), *settings(small))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("warning: ground.obstacle[0].fillet: the radius of 0.004 m", done.stderr)


class Swept(ProgramTest):
    def test_members_have_their_own_obstacles(self):
        (self.folder / "case.toml").write_text(SMALL + """
[[ground.obstacle]]
kind = "cleat"
at = 0.05
height = 0.01
length = 0.02
""")
        (self.folder / "study.toml").write_text("""schema = 1
title = "two cleats"
base = "case.toml"
[window]
from = 0.01
to = 0.02
[[vary]]
key = "ground.obstacle[0].height"
values = [0.01, 0.002]
""")
        out = self.folder / "swept"
        done = run("sweep", self.folder / "study.toml", "-o", out, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        swept = [history(one)["force_y"] for one in sorted(path.parent for path in out.glob("runs/*/history.csv"))]
        self.assertEqual(len(swept), 2)
        alone = []
        for height in (0.01, 0.002):
            done = run("run", self.folder / "case.toml", "-o", self.folder / "alone", "--quiet",
                       "--overwrite", *settings(f"ground.obstacle[0].height={height}"))
            self.assertEqual(done.returncode, 0, done.stderr)
            alone.append(history(self.folder / "alone")["force_y"])
        for one, other in zip(swept, alone):
            self.assertTrue(np.array_equal(one, other))
        self.assertFalse(np.array_equal(*alone))


class Told(ProgramTest):
    def test_check_lists_obstacles_and_warns_of_those_that_are_missed(self):
        done = run("check", self.case(SMALL), *settings(CLEAT))
        self.assertIn("a cleat of 0.01 m at x = 0.05 to 0.07 m", done.stdout)
        self.assertNotIn("does not come", done.stderr)
        far = run("check", self.case(SMALL), *settings(CLEAT.replace("0.05", "300")))
        self.assertIn("ground.obstacle[0]: the body does not come to the cleat: it comes to x = -0.3 "
                      "to 0.5 m", far.stderr)
        for at, warned in ((-1.0, False), (1.0, True)):  # the body rolls on the level behind a step
            step = f"ground.obstacle=[{{kind = 'step', at = {at}, height = -0.001}}]"
            self.assertEqual("does not come" in run("check", self.case(SMALL), *settings(step)).stderr, warned)

    def test_patches_that_are_missed_or_left_sideways_are_told(self):
        ice = "ground.patch=[{from = 30, to = 50, factor = 0.2}]"
        done = run("check", self.case(SMALL), *settings(ice))
        self.assertIn("ground.patch[0]: the body does not come to the patch", done.stderr)
        self.assertIn("times 0.2 from x = 30 to 50 m", done.stdout)
        left = "ground.patch=[{from = 0.1, to = 0.5, side = 'left', factor = 0.2}]"
        for angle, warned in ((0.0, False), (0.2, True)):
            done = run("check", self.case(WHEEL), *settings(left, f"motion.slip_angle={angle}"))
            self.assertEqual("the wheel drifts by" in done.stderr, warned, done.stderr)


class Resumed(ResumeTest):
    def test_the_case_of_the_results_has_the_obstacles(self):
        self.leave_alone(SMALL, *settings(CLEAT))
        written = (self.whole / "case.toml").read_text()
        self.assertIn("[[ground.obstacle]]", written)
        again = run("run", self.whole / "case.toml", "-o", self.out, "--quiet")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assert_same(self.out, RESULTS)
        other = run("run", self.case(SMALL), "-o", self.whole, "--resume",
                    *settings(CLEAT.replace("0.01", "0.011"), "time.end=0.03"))
        self.assert_refused(other, 2, "ground.obstacle", "the run to resume has another value")


if __name__ == "__main__":
    unittest.main()

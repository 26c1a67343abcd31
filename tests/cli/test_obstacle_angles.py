# SPDX-License-Identifier: BSD-3-Clause
"""Round obstacles of several angles, at an angle on slopes, and on roads under wheels with a width."""
import unittest

import numpy as np

from program import ROOT, ProgramTest, contact, history, run, settings, summary
from test_wheel_road import crg, heights

LATERAL = ("force_lateral", "moment_aligning", "moment_overturning")
PLANE = ("force_x", "force_y", "torque")
ON_ROAD = "ground.road=a.crg", "ground.road_start=0.5"


def obstacle(kind="cleat", at=0.3, height=0.015, length=0.04, angle=0.0, fillet=0.011):
    length = "" if kind == "step" else f", length = {length}"
    return f"{{kind = '{kind}', at = {at}, height = {height}{length}, angle = {angle}, fillet = {fillet}}}"


def obstacles(*all_of_them):
    return f"ground.obstacle=[{', '.join(all_of_them)}]"


class InAxesOfTheirOwn(ProgramTest):
    """Round obstacles of several angles, on level ground, on a slope and on roads."""
    text = (ROOT / "cases" / "wheel3d-cleat-30.toml").read_text().replace(
        "circumferential = 126", "circumferential = 180").replace("radial = 3", "radial = 2").replace(
            "axial = 3", "axial = 2").replace("end = 0.12", "end = 0.07")

    left, right = obstacle(at=0.28, angle=0.5), obstacle(at=0.42, angle=-0.3)

    def rows(self, *given, threads=1, road=None):
        if road is not None:
            (self.folder / "a.crg").write_text(crg(road))
            given = (*given, *ON_ROAD)
        out = self.folder / "out"
        done = run("run", self.case(self.text), "-o", out, "--quiet", "--overwrite", "--threads", threads,
                   *settings(*given))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertLess(summary(out)["energy_residual_relative"], 1e-12)
        self.assertLess(summary(out)["contact_residual_max"], 1e-12)
        return history(out)

    def assert_near(self, a, b, share, names=PLANE + LATERAL):
        for name in names:
            size = max(np.abs(a[name]).max(), 0.01 * np.abs(a["force_y"]).max())
            self.assertLess(np.abs(a[name] - b[name]).max(), share * size, name)

    def test_on_a_flat_road_they_are_those_on_level_ground(self):
        flat = heights(lambda u, v: 0 * u + 12.5)
        for angle in 0.0, 0.5:
            one = obstacles(obstacle(angle=angle))
            drawn = self.rows(one)
            self.assertGreater(np.abs(drawn["force_x"]).max(), 500.0)
            self.assert_near(drawn, self.rows(one, road=flat), 1e-9)
        both = obstacles(self.left, self.right)
        self.assert_near(self.rows(both), self.rows(both, road=flat), 1e-9)

    def test_angles_that_are_nearly_one_have_the_forces_of_one_angle(self):
        def two(other):
            return self.rows(obstacles(obstacle(angle=0.3), obstacle("step", 0.42, 0.012, angle=other)))
        self.assert_near(two(0.3), two(0.3 + 1e-13), 1e-8)
        self.assertGreater(np.abs(two(0.3)["force_x"] - two(-0.3)["force_x"]).max(), 30.0)

    def test_seen_in_a_mirror_they_are_the_other_angles(self):
        there, mirrored = (self.rows(obstacles(obstacle(at=0.28, angle=a), obstacle("pothole", 0.45, angle=-0.6 * a)))
                           for a in (0.5236, -0.5236))
        self.assert_near(there, mirrored, 1e-9, PLANE)
        self.assertGreater(np.abs(there["force_lateral"]).max(), 0.02 * there["force_y"].max())
        for name in LATERAL:
            self.assertLess(np.abs(there[name] + mirrored[name]).max(), 1e-9 * np.abs(there[name]).max(), name)

    def test_a_banked_road_is_camber(self):
        """Straight obstacles are as high and as wide along the surface, to the square of the bank."""
        bank = 0.02
        one = obstacles(obstacle())
        cambered = self.rows(one, f"motion.camber={bank}")
        height = f"motion.height=[[0.0, {0.30 / np.cos(bank)}], [0.02, {0.294 / np.cos(bank)}]]"
        banked = self.rows(one, height, road=heights(lambda u, v: np.tan(bank) * v))
        level = self.rows(one)
        self.assertGreater(np.abs(cambered["moment_overturning"] - level["moment_overturning"]).max(), 20.0)
        self.assertLess(np.abs(cambered["force_y"] - banked["force_y"]).max(), 0.01 * level["force_y"].max())
        self.assertLess(np.abs(cambered["force_x"] - banked["force_x"]).max(), 0.02 * np.abs(level["force_x"]).max())

    def test_a_slope_is_that_of_a_road(self):
        both = obstacles(self.left, self.right)
        slope = self.rows(both, "ground.profile=[[-1, -0.01], [1, 0.01]]")
        road = self.rows(both, road=heights(lambda u, v: 0.01 * (u - 0.5) + 0 * v))
        self.assert_near(slope, road, 1e-4)
        self.assertGreater(np.abs(slope["force_y"] - self.rows(both)["force_y"]).max(), 100.0)

    def test_on_waves_it_goes_on_bit_for_bit_and_with_other_threads(self):
        waves = heights(lambda u, v: 0.003 * np.sin(2 * np.pi * u / 0.4 + 5 * v))
        given = (obstacles(self.left, self.right), "ground.friction=0.9", "ground.restitution=0.3",
                 "motion.camber=0.02")
        whole = self.rows(*given, road=waves)
        for name, column in self.rows(*given, road=waves, threads=2).items():
            self.assertTrue(np.array_equal(column, whole[name]), name)
        out = self.folder / "parts"
        given = settings(*given, *ON_ROAD)
        parts = [run("run", self.case(self.text), "-o", out, *given, "--set", "time.end=0.055"),
                 run("run", out, "--resume", "--set", "time.end=0.07")]
        self.assertEqual([p.returncode for p in parts], [0, 0], parts[1].stderr)
        for name, column in history(out).items():
            self.assertTrue(np.array_equal(column, whole[name]), name)

    def test_obstacles_of_other_angles_far_away_change_nothing(self):
        """But the level, if one is a step that the wheel has behind it."""
        far, step = obstacle(at=5.0, angle=-0.3), obstacle("step", -0.7, 0.011, angle=-0.3)
        higher = "motion.height=[[0, 0.311], [0.02, 0.305]]"
        for fillet in 0.0, 0.011:
            one = obstacle(at=0.28, angle=0.4, fillet=fillet)
            alone, nodes = self.rows(obstacles(one)), contact(self.folder / "out")
            self.assertGreater(np.abs(alone["force_lateral"]).max(), 500.0)
            for both in (obstacles(far, one), obstacles(one, far)):
                self.assert_near(alone, self.rows(both), 1e-8)
                pressure = contact(self.folder / "out")["pressure_pa"]
                self.assertLess(np.abs(pressure - nodes["pressure_pa"]).max(), 1e-6 * pressure.max())
            self.assert_near(alone, self.rows(obstacles(step, one), higher), 1e-8, ("force_x", "force_y") + LATERAL[:2])

    def test_sharp_edges_touch_between_the_nodes_at_each_angle(self):
        def two(angle, other, **sizes):
            first, second = (obstacle(at=at, angle=by, height=0.01, length=0.02, fillet=0.0)
                             for at, by in ((0.28, angle), (0.42, other)))
            return self.rows(obstacles(first, second), *sizes.get("given", ()))
        one, nearly = two(0.4, 0.4), two(0.4, 0.4 + 1e-13)
        self.assertGreater(summary(self.folder / "out")["contact"]["clusters_solved"], 500)
        self.assertGreater(np.abs(one["force_x"]).max(), 500.0)
        self.assert_near(one, nearly, 1e-6)
        there, mirrored = two(0.5236, -0.3), two(-0.5236, 0.3)
        self.assert_near(there, mirrored, 1e-9, PLANE)
        for name in LATERAL:
            self.assertLess(np.abs(there[name] + mirrored[name]).max(), 1e-9 * np.abs(there[name]).max(), name)

    def test_what_they_do_not_do_is_refused(self):
        def refused(*given, code=2, command=("check",)):
            done = run(*command, self.case(self.text), *settings(*given))
            self.assertEqual(done.returncode, code, done.stdout)
            return " ".join(done.stderr.split())
        (self.folder / "a.crg").write_text(crg(heights(lambda u, v: 0 * u)))
        sharp = obstacles(self.left, obstacle(at=0.42, angle=-0.3, fillet=0.0))
        said = refused(sharp, "ground.profile=[[-1, -0.01], [1, 0.01]]")
        self.assertIn("ground.obstacle[1].fillet", said)
        self.assertIn("between which a sharp edge passes", said)
        self.assertIn("ground.obstacle[0].fillet",
                      refused(obstacles(obstacle(fillet=0.0)), *ON_ROAD))
        both = obstacles(self.left, self.right)
        crossed = obstacles(self.left, obstacle(at=0.35, angle=-0.3))
        self.assertIn("ground.obstacle[1].at = 0.35: meets ground.obstacle[0] where the wheel comes", refused(crossed))
        self.assertIn("is steeper than 45 degrees at x = 0.9 m",
                      refused(both, "ground.profile=[[-1, 0], [0.9, 0], [0.9, 0.1], [2, 0.1]]"))
        self.assertIn("has a sharp corner at x = 0.9 m",
                      refused(both, "ground.profile=[[-1, 0], [0.9, 0], [2, -0.1]]"))
        self.assertIn("it needs 0.05 m of the length of 0.04 m", refused(obstacles(
            self.left, obstacle(at=0.6, angle=-0.3, height=0.03, fillet=0.025))))
        self.assertIn("a start in steady rolling takes obstacles of one angle",
                      refused(both, "initial.state=steady-rolling", "motion.height=0.294"))
        for ground, said in (((), "m counts as sharp"),
                             (("ground.profile=[[-1, -0.01], [1, 0.01]]",), "an edge passes between them")):
            small = run("check", self.case(self.text), *settings(obstacles(self.left, obstacle(
                at=0.42, angle=-0.3, fillet=0.004)), *ground))
            self.assertEqual(small.returncode, 0, small.stderr)
            told = " ".join(small.stderr.split())
            self.assertIn("ground.obstacle[1].fillet: the radius of 0.004 m is below the 0.0105 m between two contact "
                          "nodes", told)
            self.assertIn(said, told)



if __name__ == "__main__":
    unittest.main()

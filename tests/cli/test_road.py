# SPDX-License-Identifier: BSD-3-Clause
"""Measured roads under plane bodies, `ground.road`: the same run as on the section given by its points;
what `rondo check` tells; runs that go on; what is refused with what to do instead."""
import csv
import unittest

import numpy as np

from program import ROOT, SMALL, ProgramTest, RunTest, history, replaced, run, summary
from test_resume import RESULTS, ResumeTest
from test_wheel_cases import FREE_RIM

FIRST, STEP, ROWS = 3.0, 1 / 64, 193  # u of the road [m]: numbers that binary holds exactly
V = (-0.25, 0.0, 0.25)
COBBLES = ROOT / "cases" / "rolling-cobbles.toml"


def heights():
    """(ROWS, 3) Waves and noise of some millimetres, 100 m above the sea [m]."""
    u = np.arange(ROWS) * STEP
    noise = np.random.default_rng(7).uniform(-2e-4, 2e-4, (ROWS, 3))
    waves = 0.002 * np.sin(2 * np.pi * u / 0.5)[:, None] * np.array([1.0, 0.5, -1.0])
    return 100.0 + np.round(waves + noise, 6)


def road_text(z):
    """An OpenCRG file of text in double precision, with sections at V."""
    sections = "".join(f"D:long section at v = {v},m\n" for v in V)
    rows = "".join("".join(f"{x:20.13e}" for x in row) + "\n" for row in z)
    return (f"$ROAD_CRG\nREFERENCE_LINE_START_U = {FIRST}\nREFERENCE_LINE_INCREMENT = {STEP}\n$\n"
            f"$KD_Definition\n#:LDFI\n{sections}$\n$$$$\n{rows}")


def section(z, v, start):
    """The points of the ground, as docs/roads.md defines them [m]."""
    j = min(int((v - V[0]) / 0.25), 1)
    t = (v - V[j]) / 0.25
    height = (1 - t) * z[:, j] + t * z[:, j + 1]
    u = FIRST + np.arange(ROWS) * STEP
    zero = np.interp(start, u, height)
    points = [(x - start, y - zero) for x, y in zip(u, height)]
    return [(points[0][0] - 1, points[0][1]), *points, (points[-1][0] + 1, points[-1][1])]


def on_road(text, lines):
    return replaced(text, "profile", lines)


class RoadTest:
    """Writes the road beside the case."""

    def setUp(self):
        super().setUp()
        self.heights = heights()
        (self.folder / "a.crg").write_text(road_text(self.heights))


class SameAsItsPoints(RoadTest, RunTest):
    def test_a_road_is_the_ground_that_its_section_gives_as_a_profile(self):
        for v, start in ((0.0, FIRST + 0.5), (-0.0625, FIRST + 0.75), (0.25, FIRST + 1.0)):
            with self.subTest(v=v, start=start):
                self.run_ok(on_road(SMALL, f'road = "a.crg"\nroad_offset = {v}\nroad_start = {start}'),
                            "--overwrite")
                self.assertEqual(summary(self.out)["warnings"], [])
                self.assertLess(summary(self.out)["energy_residual_relative"], 1e-12)
                by_road = (self.out / "history.csv").read_bytes()
                with open(self.folder / "section.csv", "w", newline="") as file:
                    csv.writer(file).writerows(section(self.heights, v, start))
                self.run_ok(on_road(SMALL, 'profile = "section.csv"'), "--overwrite")
                self.assertGreater(history(self.out)["force_y"].max(), 0.0)
                self.assertEqual((self.out / "history.csv").read_bytes(), by_road)

    def test_the_section_matters(self):
        forces = []
        for v in (0.0, 0.1):
            self.run_ok(on_road(SMALL, f'road = "a.crg"\nroad_offset = {v}'), "--overwrite")
            forces.append(history(self.out)["force_y"])
        self.assertGreater(np.abs(forces[1] - forces[0]).max(), 0.01 * forces[0].max())

    def test_a_sweep_over_the_offset_of_the_wheel(self):
        self.case(on_road(SMALL, 'road = "a.crg"'))
        study = self.case('schema = 1\nbase = "case.toml"\n[[vary]]\nkey = "ground.road_offset"\n'
                          "values = [0.0, 0.1]\n", "study.toml")
        done = run("sweep", study, "-o", self.folder / "sweep", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.run_ok(on_road(SMALL, 'road = "a.crg"\nroad_offset = 0.1'))
        self.assertEqual((self.folder / "sweep" / "runs" / "0002" / "history.csv").read_bytes(),
                         (self.out / "history.csv").read_bytes())


class Checked(RoadTest, ProgramTest):
    def check(self, text, *settings):
        done = run("check", self.case(text), *settings)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def test_lines_and_the_subtracted_height(self):
        done = self.check(on_road(SMALL, 'road = "a.crg"'))
        zero = np.interp(FIRST + 0.5, FIRST + np.arange(ROWS) * STEP, self.heights[:, 1])
        for said in (f"x is u - 3.5 m, at v = 0 m; y is the height less that at x = 0, {zero:.6g} m",
                     "The road goes from x = -0.5 to 2.5 m",
                     f"has {ROWS} rows of 3 heights: u from 3 to 6 m",
                     "for u from 3.2 to 4 m and v = 0 m",
                     "No height is missing."):
            self.assertIn(said, done.stdout)
        self.assertNotIn("warning", done.stderr)

    def test_a_body_that_leaves_the_road_is_warned_of(self):
        text = on_road(SMALL, 'road = "a.crg"\nroad_start = 3.2')
        self.assertIn("warning: ground.road: the body comes to x = -0.3 to 0.5 m, and the road goes "
                      "from -0.2 to 2.8 m", self.check(text).stderr)
        self.assertIn("comes to x = -0.3 to 3.3 m",
                      self.check(on_road(SMALL, 'road = "a.crg"'), "--set", "time.end=0.3").stderr)

    def test_elements_that_are_too_long_for_the_road_are_warned_of(self):
        bumpy = self.heights.copy()
        bumpy[50:60:2] += 0.004  # u = 3.78 to 3.91 m
        (self.folder / "a.crg").write_text(road_text(bumpy))
        text = on_road(SMALL, 'road = "a.crg"')
        self.assertRegex(self.check(text).stderr, "warning: ground.road: the slope changes by 0.[2-9]"
                                                  "[0-9]* near x = 0.[23][0-9]* m")
        fine = self.check(text, "--set", "disk.mesh.circumferential=130")  # 14.5 mm, below a row
        self.assertNotIn("the slope changes", fine.stderr)
        before = self.check(text, "--set", "motion.speed=0", "--set", "ground.road_start=5")
        self.assertNotIn("the slope changes", before.stderr)


class Resumed(RoadTest, ResumeTest):
    # It rolls slowly, and is on the road to the end.
    text = replaced(on_road(FREE_RIM, 'road = "a.crg"'), "end", "end = 17.0")
    text = replaced(replaced(text, "speed", "speed = 0.12"), "angular_velocity", "angular_velocity = 0.4")
    text = replaced(text, "fillet", None)

    def test_a_killed_run_goes_on_to_the_same_bits(self):
        self.leave_alone(self.text)
        self.assertEqual(summary(self.whole)["warnings"], [])
        written = (self.whole / "case.toml").read_text()
        self.assertNotIn("road", written)
        total = (self.whole / "history.csv").read_bytes().count(b"\n")
        process = self.start(self.text)
        self.assertTrue(self.wait_for_rows(process, 0.2 * total), "it ended before the kill")
        process.kill()
        process.wait()
        done = self.resume(self.text)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreater(len(summary(self.out)["resumed_at_steps"]), 0)
        self.assert_same(self.out, RESULTS)

    def test_it_does_not_go_on_with_another_road(self):
        short = replaced(self.text, "end", "end = 0.1")
        self.leave_alone(short)
        (self.folder / "a.crg").write_text(road_text(self.heights[:, ::-1]))
        same = run("run", self.case(replaced(short, "end", "end = 0.2")), "-o", self.whole, "--resume")
        self.assertEqual(same.returncode, 0, same.stderr)  # the section in the middle
        self.heights[100, 1] += 1e-9
        (self.folder / "a.crg").write_text(road_text(self.heights))
        other = run("run", self.case(replaced(short, "end", "end = 0.3")), "-o", self.whole, "--resume")
        self.assert_refused(other, 2, "ground.profile", "the run to resume has another value")


class Refused(RoadTest, ProgramTest):
    def refused(self, text, *parts):
        done = run("check", self.case(text))
        self.assertEqual(done.returncode, 2, done.stderr)
        for part in parts:
            self.assertIn(part, done.stderr)

    def test_a_damaged_file_by_its_name_and_line(self):
        text = road_text(self.heights)
        lines = text.splitlines(keepends=True)
        begin = lines.index("$$$$\n") + 1
        lines[begin + 40] = lines[begin + 40][:33] + "\n"
        (self.folder / "a.crg").write_text("".join(lines))
        self.refused(on_road(SMALL, 'road = "a.crg"'), f"a.crg: line {begin + 41}, in the data")
        (self.folder / "a.crg").write_text(text.replace("INCREMENT = ", "INCREMENT = x"))
        self.refused(on_road(SMALL, 'road = "a.crg"'), "a.crg:3:")

    def test_steady_rolling(self):
        text = on_road(replaced(SMALL, "height", "height = 0.296"), 'road = "a.crg"')
        self.refused(text + '[analysis]\nkind = "steady-rolling"\n',
                     "ground.road", "steady rolling needs flat ground")


class Cobbles(RunTest):
    def test_the_ready_case_closes_its_balance(self):
        done = run("check", COBBLES)
        self.assertNotIn("warning", done.stderr)
        done = run("run", COBBLES, "-o", self.out, "--quiet", "--set", "output.snapshots=3")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertLess(summary(self.out)["energy_residual_relative"], 1e-12)


if __name__ == "__main__":
    unittest.main()

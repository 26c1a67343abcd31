# SPDX-License-Identifier: BSD-3-Clause
"""Measured roads under wheels with a width: flat and extruded roads against profiles, mirrored roads,
the energy balance on cobbles, threads, runs that go on, what is told and what is refused."""
import unittest

import numpy as np

from program import ROOT, ProgramTest, RunTest, history, replaced, run, settings, summary
from test_resume import RESULTS, ResumeTest
from test_solid import WHEEL

COBBLES = ROOT / "cases" / "roads" / "cobbles.crg"
STEP = 1 / 64  # m between the rows: numbers that binary holds exactly
SHORT = replaced(WHEEL, "end", "end = 0.012")
ON_ROAD = replaced(SHORT, "profile", 'road = "a.crg"\nroad_start = 0.5')
ON_COBBLES = replaced(SHORT, "profile", f'road = "{COBBLES}"\nroad_start = 1.0\nroad_offset = 0.03')
# The rim rises and turns by the forces on it; nodes bounce.
FREE = (replaced(ON_COBBLES, "height", "height = 0.312") +
        '[rim]\nfree = ["height", "angular_velocity"]\nmass = 5.0\ninertia = 0.1\nforce_y = -8000.0\n')


def even_v(n=25, step=1 / 64):
    return step * (np.arange(n) - n // 2)


def heights(function, n_u=129, v=None, step=STEP):
    v = even_v() if v is None else v
    u = (np.arange(n_u) * step)[:, None]
    return function(u, v[None, :]) + 0.0 * u * v[None, :]


def crg(z, v=None, step=STEP, options=""):
    """An OpenCRG file of text in double precision, from u = 0 on."""
    v = even_v() if v is None else v
    sections = "".join(f"D:long section at v = {x!r},m\n" for x in map(float, v))
    lines = [["*missing*".rjust(20) if np.isnan(x) else f"{x:20.13e}" for x in row] for row in z]
    rows = "".join("".join(row[k:k + 4]) + "\n" for row in lines for k in range(0, len(row), 4))
    return (f"$ROAD_CRG\nREFERENCE_LINE_START_U = 0.0\nREFERENCE_LINE_INCREMENT = {step!r}\n$\n{options}"
            f"$KD_Definition\n#:LDFI\n{sections}$\n$$$$\n{rows}")


def waves(u, v):
    return 0.004 * np.sin(2 * np.pi * u / 0.3 + 6.0 * v) + 0.002 * np.cos(40.0 * v + 9.0 * u)


class RoadRun(RunTest):
    text = ON_ROAD

    def road(self, z, *arguments, **options):
        (self.folder / "a.crg").write_text(crg(z, *arguments, **options))

    def rows(self, text, *given):
        self.run_ok(text, "--quiet", "--overwrite", "--threads", "1", *settings(*given))
        return history(self.out)

    def assert_near(self, a, b, share, columns=("force_x", "force_y", "force_lateral", "moment_aligning",
                                                "moment_overturning", "torque")):
        scale = np.abs(a["force_y"]).max()
        self.assertGreater(scale, 1000.0)
        for name in columns:
            self.assertLess(np.abs(a[name] - b[name]).max(), share * scale, name)


class AgainstProfiles(RoadRun):
    def test_a_flat_road_is_flat_ground(self):
        self.road(heights(lambda u, v: 0 * u + 77.25))
        for given in ((), ("motion.camber=0.1",), ("rim.free=[]",)):
            with self.subTest(given):
                self.assert_near(self.rows(SHORT, *given), self.rows(ON_ROAD, *given), 1e-12)

    def test_a_road_that_is_the_same_across_has_the_forces_of_its_profile(self):
        self.road(heights(lambda u, v: 0.001 * np.sin(2 * np.pi * u / 0.5)))
        x = np.arange(-0.5, 1.5, 0.002)
        points = [[float(a), 0.001 * float(np.sin(2 * np.pi * (a + 0.5) / 0.5))] for a in x]
        by_profile = self.rows(SHORT, f"ground.profile={points}")
        by_road = self.rows(ON_ROAD)
        self.assert_near(by_profile, by_road, 2e-3)
        flat = self.rows(SHORT)
        self.assertGreater(np.abs(flat["force_y"] - by_road["force_y"]).max(),
                           0.03 * flat["force_y"].max())

    def test_a_banked_road_is_camber(self):
        angle = 0.1
        self.road(heights(lambda u, v: np.tan(angle) * v + 0 * u))
        upright = self.rows(ON_ROAD, "motion.height=0.301", "motion.slip_angle=0")
        leaning = self.rows(SHORT, f"motion.height={0.301 * np.cos(angle)}", "motion.slip_angle=0",
                            f"motion.camber={angle}")
        normal = np.cos(angle) * upright["force_y"] + np.sin(angle) * upright["force_lateral"]
        lateral = np.cos(angle) * upright["force_lateral"] - np.sin(angle) * upright["force_y"]
        scale = leaning["force_y"].max()
        self.assertGreater(scale, 1000.0)
        for name, along in (("force_y", normal), ("force_lateral", lateral), ("force_x", upright["force_x"])):
            self.assertLess(np.abs(along - leaning[name]).max(), 1e-5 * scale, name)  # slopes are floats

    def test_a_mirrored_road_has_mirrored_forces(self):
        z = heights(waves)
        given = ("motion.slip_angle=0.05", "motion.camber=0.04", "ground.road_offset=0.02")
        turned = ("motion.slip_angle=-0.05", "motion.camber=-0.04", "ground.road_offset=-0.02")
        self.road(z)
        a = self.rows(ON_ROAD, *given)
        self.road(z[:, ::-1])
        b = self.rows(ON_ROAD, *turned)
        b.update({name: -b[name] for name in ("force_lateral", "moment_aligning", "moment_overturning")})
        self.assert_near(a, b, 1e-10)
        self.assertGreater(np.abs(a["force_lateral"]).max(), 0.05 * np.abs(a["force_y"]).max())

    def test_a_road_that_repeats_is_the_longer_road(self):
        wave = lambda u, v: 0.003 * np.sin(2 * np.pi * u / 0.5) * (1 + 3 * v)
        text, given = ON_ROAD, ("ground.road_start=0.40625", "motion.height=[[0, 0.304], [0.004, 0.296]]")
        self.road(heights(wave, 33))  # one period, whose last row is the first one again
        a = self.rows(text, "ground.road_border=repeat", *given)
        self.assertEqual(summary(self.out)["warnings"], [])
        self.road(heights(wave, 129))
        b = self.rows(text, *given)
        self.assert_near(a, b, 1e-9)


class Balance(RoadRun):
    def test_friction_bounces_camber_and_a_free_rim_on_cobbles(self):
        for text, given in ((ON_COBBLES, ("time.end=0.05",)),
                            (ON_COBBLES, ("time.end=0.05", "motion.camber=0.1", "ground.restitution=0.6")),
                            (FREE, ("ground.friction=0.9", "ground.restitution=0.4", "time.end=0.05"))):
            with self.subTest(given):
                self.rows(text, *given)
                told = summary(self.out)
                self.assertLess(told["energy_residual_relative"], 1e-12)
                self.assertLess(told["contact_residual_max"], 1e-12)
                self.assertGreater(told["steps"], 300)

    def test_any_number_of_threads_gives_the_same_bits(self):
        z = []
        for threads in (1, 2, 4):
            self.run_ok(FREE, "--quiet", "--overwrite", "--threads", str(threads))
            z.append((self.out / "history.csv").read_bytes())
        self.assertEqual(z[0], z[1])
        self.assertEqual(z[0], z[2])

    def test_the_ready_case(self):
        done = run("check", ROOT / "cases" / "wheel3d-cobbles.toml")
        self.assertNotIn("warning", done.stderr)
        self.run_ok((ROOT / "cases" / "wheel3d-cobbles.toml").read_text(), "--quiet", "--threads", "1",
                    *settings(f"ground.road={COBBLES}", "time.end=0.025", "output.snapshots=3"))
        self.assertEqual(summary(self.out)["warnings"], [])
        self.assertLess(summary(self.out)["energy_residual_relative"], 1e-12)


class Kept(RoadRun):
    def test_the_case_of_the_results_is_run_again(self):
        self.road(heights(waves))
        given = settings("ground.road_border=keep", "ground.road_offset=0.01")
        self.case(ON_ROAD)  # found from elsewhere, though its path was none from the root
        done = run("run", "case.toml", "-o", "out", "--quiet", *given, cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        first = history(self.out)
        written = (self.out / "case.toml").read_text()
        self.assertIn(f'road = "{self.folder}/a.crg"', written)
        self.assertNotIn("profile", written)
        again = self.folder / "again"
        done = run("run", self.out / "case.toml", "-o", again, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        np.testing.assert_array_equal(first["force_y"], history(again)["force_y"])

    def test_a_sweep_knows_another_road_of_the_same_name(self):
        self.road(heights(waves))
        self.case(ON_ROAD)
        study = self.case('schema = 1\nbase = "case.toml"\n[[vary]]\nkey = "ground.road_offset"\n'
                          "values = [0.0, 0.02]\n", "study.toml")
        sweep = ("sweep", study, "-o", self.folder / "sweep", "--quiet")
        self.assertEqual(run(*sweep).returncode, 0)
        run_2 = self.folder / "sweep" / "runs" / "0002" / "history.csv"
        alone = self.rows(ON_ROAD, "ground.road_offset=0.02")
        np.testing.assert_array_equal(history(run_2.parent)["force_y"], alone["force_y"])
        self.road(heights(waves) + 1e-5 * even_v())
        done = run(*sweep, "--resume")
        self.assertNotEqual(done.returncode, 0)


class Resumed(ResumeTest):
    text = FREE

    def test_a_run_goes_on_to_the_same_bits_and_on_its_road_only(self):
        text = replaced(FREE, "road =", 'road = "a.crg"')
        data = COBBLES.read_bytes()
        (self.folder / "a.crg").write_bytes(data)
        text += "\n"
        longer = replaced(text, "end", "end = 0.024")
        self.leave_alone(longer)
        done = run("run", self.case(text), "-o", self.out, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        done = self.resume(longer, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreater(len(summary(self.out)["resumed_at_steps"]), 0)
        self.assert_same(self.out, ["history.csv"])
        moved = self.folder / "moved.crg"
        (self.folder / "a.crg").rename(moved)
        elsewhere = replaced(replaced(text, "road =", 'road = "moved.crg"'), "end", "end = 0.03")
        done = self.resume(elsewhere, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        moved.write_bytes(data[:-48] + b"\x3c\x23\xd7\x0a" + data[-44:])
        self.assert_refused(self.resume(replaced(elsewhere, "end", "end = 0.035")), 2, "ground.road",
                            "is not the road that the run began with")


class Told(ProgramTest):
    def check(self, z, *given, text=ON_ROAD, **options):
        (self.folder / "a.crg").write_text(crg(z, **options))
        done = run("check", self.case(text), *settings(*given))
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def test_lines_about_the_part_that_the_wheel_comes_to(self):
        done = self.check(0.1 * heights(waves), "disk.mesh.circumferential=130", "disk.mesh.axial=8",
                          "ground.road_offset=0.02", "motion.slip_angle=0",
                          "motion.height=0.301")
        for said in ("x is u - 0.5 m, t2 is 0.02 m - v; y is the height of the smooth surface less",
                     "The road goes from x = -0.5 to 1.5 m", "The wheel comes to v = -0.045 to 0.085 m.",
                     "The largest slope of its smooth surface, for u from 0.2 to 0.92 m and v from -0.045",
                     "(root mean square"):
            self.assertIn(said, done.stdout)
        self.assertNotIn("warning", done.stderr)

    def test_warnings(self):
        flat = heights(lambda u, v: 0 * u)
        self.assertIn("the body comes to x = -0.3 to 0.4199 m, and the road goes from -0.2 to 1.8 m",
                      self.check(flat, "ground.road_start=0.2").stderr)
        rough = heights(lambda u, v: 0.002 * np.sin(60.0 * u))
        self.assertRegex(self.check(rough).stderr, "the slope changes by 0.[0-9]* at u = .* within an "
                                                   "element, 0.0471 m along and 0.0333 m across")
        across = heights(lambda u, v: 0.004 * np.sin(80.0 * v))
        self.assertIn("the slope changes", self.check(across, "motion.height=0.31").stderr)
        ramp = heights(lambda u, v: 0.01 * u)
        told = self.check(ramp, "ground.road_start=1.8", "ground.road_border=repeat").stderr
        self.assertIn("there is a step of 0.02 m at the end of the road, at u = 2 m", told)
        self.assertNotIn("the body comes to", told)
        told = self.check(ramp, "ground.road_start=1.8", "ground.road_border=zero").stderr
        self.assertIn("there is a step of 0.02 m at the end of the road, at u = 2 m", told)


    def test_the_start_knows_the_road(self):
        banked = heights(lambda u, v: 0.1 * v + 0 * u)  # 5 mm at the side of the wheel
        told = self.check(banked, "motion.height=0.303", text=replaced(ON_ROAD, "height", "height = 1")).stderr
        depth = 0.002 / np.hypot(1.0, 0.1)
        self.assertIn(f"the body starts {depth:.4g} m inside the ground", told)
        self.assertNotIn("inside", self.check(banked, "motion.height=0.3051").stderr)
        done = run("check", self.case(ON_ROAD), *settings("motion.height=0.28"))
        self.assertEqual(done.returncode, 2)
        self.assertIn("m deep inside the ground, more than half an element", done.stderr)
        done = run("check", self.case(ON_ROAD), *settings("motion.height=0.1"))
        self.assertIn("nodes that are held would be up to", done.stderr)


class Refused(ProgramTest):
    def refused(self, z, *said, given=(), text=ON_ROAD, command=("check",), **options):
        (self.folder / "a.crg").write_text(crg(z, **options))
        done = run(command[0], self.case(text), *command[1:], *settings(*given))
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        for part in said:
            self.assertIn(part, done.stderr)

    def test_what_the_road_is_where_the_wheel_comes(self):
        flat = heights(lambda u, v: 0 * u)
        kerb = flat + 0.03 * (even_v() > 0.02)
        self.refused(kerb, "has a slope of", "where the wheel comes", "another ground.road_offset")
        self.refused(heights(lambda u, v: 0.03 * (u > 0.7)), "has a slope of", "at u = 0.69")
        holes = flat.copy()
        holes[40, 16:] = np.nan  # u = 0.625 m, v from 0.0625 m on
        keep = "$ROAD_CRG_MODS\nGRID_NAN_MODE = 0\n$\n$ROAD_CRG_OPTS\nBORDER_MODE_V = 0\n$\n"
        self.refused(holes, "has no height at u = 0.625 m, v = 0.0625 m, where the wheel comes",
                     "GRID_NAN_MODE = 2", options=keep)
        self.refused(flat, "beyond its side there is no ground (BORDER_MODE_V = 0)",
                     given=("ground.road_offset=0.15",), options="$ROAD_CRG_OPTS\nBORDER_MODE_V = 0\n$\n")
        self.refused(flat + 0.01, "beyond its side there is a step of 0.01 m", "BORDER_MODE_V = 2",
                     given=("ground.road_offset=0.15",), options="$ROAD_CRG_OPTS\nBORDER_MODE_V = 1\n$\n")
        # Beyond a side that repeats, it meets the other one.
        repeat = "$ROAD_CRG_OPTS\nBORDER_MODE_V = 3\n$\n"
        kerb = flat + 0.03 * (np.abs(even_v() + 0.14) < 0.02)
        self.refused(kerb, "has a slope of", "v = -0.1", given=("ground.road_offset=0.17",), options=repeat)
        # Slip takes it there.
        self.refused(flat, "the wheel comes to v = -0.", "less drift by motion.slip_angle",
                     given=("motion.slip_angle=0.7", "time.end=0.03"),
                     options="$ROAD_CRG_OPTS\nBORDER_MODE_V = 0\n$\n")

    def test_what_is_not_reached_is_no_fault(self):
        flat = heights(lambda u, v: 0 * u)
        far = flat + 0.05 * (even_v() > 0.1)
        far[100:102] += 0.05  # u = 1.56 m
        (self.folder / "a.crg").write_text(crg(far))
        done = run("check", self.case(ON_ROAD))
        self.assertEqual(done.returncode, 0, done.stderr)
        free = ON_ROAD + '[rim]\nfree = ["speed"]\nmass = 5.0\n'
        self.refused(far, "has a slope of", "at u = 1.5", text=free, given=("motion.slip_angle=0",))

    def test_borders_and_fillets(self):
        flat = heights(lambda u, v: 0 * u)
        self.refused(flat, "BORDER_MODE_U = 0", 'ground.road_border = "keep", "zero" or "repeat"',
                     options="$ROAD_CRG_OPTS\nBORDER_MODE_U = 0\n$\n")
        self.refused(flat, "ground.fillet", "under a wheel with a width has none",
                     given=("ground.fillet=0.01",))

    def test_what_needs_flat_ground_or_a_profile(self):
        flat = heights(lambda u, v: 0 * u)
        steady = replaced(ON_ROAD, "height", "height = 0.296")
        self.refused(flat, "ground.road", "needs flat ground, and a road is not",
                     text=steady + '[analysis]\nkind = "steady-rolling"\n')
        self.refused(flat, "ground.road", "needs flat ground, and a road is not",
                     text=steady + '[analysis]\nkind = "crush"\ndepth = 0.004\nincrements = 2\n')
        self.refused(flat, "ground.road", "is not flat below the wheel", text=steady,
                     command=("modes", "--standing", "-o", self.folder / "modes"))
        self.refused(flat, "ground.road", "the same all across a wheel", text=steady,
                     command=("matrices", "-o", self.folder / "matrices"))


if __name__ == "__main__":
    unittest.main()

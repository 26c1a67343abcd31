# SPDX-License-Identifier: BSD-3-Clause
"""rondo run on steady rolling: forces, what is given and given back, files, sweeps, wrong input."""
import json
import unittest

import h5py
import numpy as np

from program import ROOT, ProgramTest, RunTest, contact, history, replaced, run, said, summary

CASE = (ROOT / "cases" / "steady-rolling.toml").read_text()
WHEEL = (ROOT / "cases" / "wheel3d-steady.toml").read_text()
SMALL = replaced(replaced(CASE, "radial", "radial = 4"), "circumferential", "circumferential = 60")
TREAD = replaced(SMALL, "circumferential", None) + """
[disk.tread]
pitches = 30
depth = 0.02
land_columns = 2
groove_columns = 1
layers = 1
"""
FREE = replaced(replaced(SMALL, "speed", None), "height", None)  # neither speed nor height
STUDY = """schema = 1
base = "small.toml"
[[vary]]
key = "motion.speed"
values = [9.8, 10.0]
[[vary]]
key = "ground.friction"
values = [0.1, 0.5]
"""
LOAD = ["--set", "analysis.load=1e5"]
SPIN = 33.333333  # rad/s, clockwise


def polar_course(field, sector, local):
    """(L, nodes of a sector, 2): a field (places, n, 2) along the axes of each node's sector, over the angle
    counter-clockwise from straight down. A place further is a sample back, for the spin is clockwise."""
    places, sectors, size = len(field), sector.max() + 1, local.max() + 1
    course = np.full((places * sectors, size, 2), np.nan)
    cos, sin = np.cos(2 * np.pi * sector / sectors), np.sin(2 * np.pi * sector / sectors)
    for place, (x, y) in enumerate(np.moveaxis(field, 2, 1)):
        course[(sector * places - place) % len(course), local] = np.stack([cos * x + sin * y, cos * y - sin * x],
                                                                          axis=1)
    return course


def derivative(course):
    """By the angle, of what is periodic: exact for its harmonics, the highest one without."""
    harmonics = np.fft.rfft(course, axis=0)
    order = 1j * np.arange(len(harmonics))
    order[-1] = 0.0
    return np.fft.irfft(harmonics * order[:, None, None], len(course), axis=0)


class Steady(RunTest):
    text = SMALL

    def steady(self, *settings, text=None):
        arguments = [a for s in settings for a in ("--set", s)]
        done = run("run", self.case(text or SMALL), "-o", self.out, "--quiet", "--overwrite", *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        s = summary(self.out)
        self.assertEqual((s["status"], s["analysis"]), ("done", "steady-rolling"))
        self.assertLess(s["contact_residual_max"], 1e-10)
        self.assertLess(s["energy_residual_relative"], 1e-12)
        return s["steady"]

    def test_forces_of_the_shipped_case(self):
        s = self.steady(text=CASE)
        self.assertAlmostEqual(s["force_x"], -22074.5, delta=0.05)
        self.assertAlmostEqual(s["force_y"], 190099.7, delta=0.05)
        lost = s["power"]["mass"] + s["power"]["stiffness"] + s["power"]["friction"] - s["power"]["scheme"]
        self.assertAlmostEqual(s["rolling_resistance"], lost / 10.0, delta=1e-9 * lost)

    def test_files_say_the_same(self):
        s = self.steady()
        h, n = history(self.out), s["samples_per_sector"]
        for name, value in (("force_x", s["force_x"]), ("force_y", s["force_y"]), ("torque", s["torque"]),
                            ("stick_length_m", s["stick_length"]), ("slip_length_m", s["slip_length"]),
                            ("friction_power", s["power"]["friction"])):
            np.testing.assert_allclose(np.mean(h[name]), value, rtol=1e-11, err_msg=name)
        self.assertEqual(len(h["time_s"]), n)
        with h5py.File(self.out / "results.h5") as f:
            self.assertEqual(f["snapshots/displacement"].shape[0], n)
            self.assertEqual(f.attrs["analysis"], "steady-rolling")
            np.testing.assert_array_equal(f["frame/time"][:], f["frame/time_velocity"][:])
            force = f["contact/force"][:].sum(axis=1)
            np.testing.assert_allclose(force[:, 0], h["force_y"], rtol=1e-12)
            np.testing.assert_allclose(-force[:, 1], h["force_x"], rtol=1e-12)
            place = f["fields/position"][:, :, 1].min(axis=1)
            np.testing.assert_allclose(place, 0.0, atol=1e-7)
            u, v = f["snapshots/displacement"][:], f["snapshots/velocity"][:]
            sector, local = f["mesh/sector"][:], f["mesh/sector_node"][:]
        # All sectors at all places are the course of one round the wheel; velocity is its derivative.
        course = [polar_course(field, sector, local) for field in (u, v)]
        rate = -SPIN * derivative(course[0])
        np.testing.assert_allclose(course[1], rate, rtol=0, atol=1e-11 * np.abs(rate).max())

    def test_contact_of_each_pair(self):
        s = self.steady()
        rows, h, n = contact(self.out), history(self.out), s["samples_per_sector"]
        with h5py.File(self.out / "results.h5") as f:
            np.testing.assert_array_equal(np.unique(rows["time_s"]), f["frame/time"][:])
        force = -rows["length_m"] * rows["shear_pa"]  # in the files shear is counted to the left
        np.testing.assert_allclose(force.sum() / n, s["force_x"], rtol=1e-11)
        power = -(force * rows["slip_speed"]).sum() / n
        np.testing.assert_allclose(power, s["power"]["friction"], rtol=1e-11)
        sticks = rows["sticks"] == 1
        self.assertTrue(0 < sticks.sum() < len(sticks))
        np.testing.assert_allclose(rows["length_m"][sticks].sum() / n, s["stick_length"], rtol=1e-11)
        self.assertLess(np.abs(rows["slip_speed"][sticks]).max(), 1e-9)
        bound = 0.4 * rows["pressure_pa"]
        self.assertTrue((np.abs(rows["shear_pa"]) <= bound * (1 + 1e-9)).all())
        slides = ~sticks & (np.abs(rows["slip_speed"]) > 1e-6)
        np.testing.assert_allclose(rows["shear_pa"][slides], (np.sign(rows["slip_speed"]) * bound)[slides],
                                   rtol=1e-9)
        self.assertEqual(np.abs(rows["slip_speed"]).max(), h["slip_speed_max"].max())

    def test_what_is_given_is_given_back(self):
        s = self.steady("analysis.load=1e5", "analysis.traction=-4000", text=FREE)
        self.assertAlmostEqual(s["force_y"], 1e5, delta=1e-5)
        self.assertAlmostEqual(s["force_x"], -4000, delta=1e-5)
        again = self.steady(f"motion.height={s['height']!r}", f"motion.speed={s['speed']!r}")
        self.assertAlmostEqual(again["force_y"], 1e5, delta=0.1)
        self.assertAlmostEqual(again["force_x"], -4000, delta=0.1)
        slope = self.steady("analysis.load=1e5", "motion.speed=10", text=FREE)["slopes"]
        self.assertEqual(sorted(slope), ["by_friction", "by_load", "by_speed"])
        self.assertAlmostEqual(slope["by_load"]["force_y"], 1.0, delta=1e-9)

    def test_a_setting_takes_the_place_of_the_other(self):
        s = self.steady("analysis.load=1e5", "analysis.torque=0")
        self.assertEqual(s, self.steady("analysis.load=1e5", "analysis.torque=0", text=FREE))
        self.assertEqual(self.steady(), self.steady("motion.height=0.29", "motion.speed=10.0",
                                                    text=FREE + "load = 1e5\ntraction = 0.0\n"))

    def test_a_driving_torque_pulls_the_body_forward(self):
        for sense in (1, -1):  # turned the other way round, it goes to the other side
            spin = f"motion.angular_velocity={33.3 * sense}"
            rolling = self.steady("analysis.load=1e5", "analysis.torque=0", spin, text=FREE)
            self.assertAlmostEqual(rolling["torque"], 0.0, delta=1e-6)
            self.assertLess(sense * rolling["force_x"], 0.0)
            self.assertGreater(sense * rolling["speed"], 0.0)
            self.assertAlmostEqual(rolling["rolling_resistance"], -sense * rolling["force_x"], delta=1e-6)
            driven = self.steady("analysis.load=1e5", f"analysis.torque={2000 * sense}", spin, text=FREE)
            self.assertAlmostEqual(driven["torque"], 2000 * sense, delta=1e-6)
            self.assertGreater(sense * driven["force_x"], 5000.0)
            self.assertLess(sense * driven["speed"], sense * rolling["speed"])

    def test_weight_has_a_part_in_torque_and_power(self):
        s = self.steady("analysis.load=1e5", "analysis.torque=1000", "motion.gravity=981", text=FREE)
        self.assertAlmostEqual(s["torque"], 1000, delta=1e-6)
        self.assertGreater(abs(s["power"]["weight"]), 1.0)

    def test_pressure_stiffening_and_tread(self):
        plain = self.steady()
        pressed = self.steady("load.pressure=[{curve='tread', value=1e5}]")
        self.assertLess(pressed["force_y"], plain["force_y"])
        stiff = self.steady("material.stress_stiffening=centrifugal")
        self.assertNotEqual(stiff["force_y"], plain["force_y"])
        s = self.steady(text=TREAD)
        self.assertEqual(s["samples_per_sector"], 16)
        self.assertGreater(np.ptp(history(self.out)["force_y"]), 100.0)

    def test_warns_above_the_critical_spin(self):
        done = run("check", self.case(CASE), "--set", "motion.angular_velocity=181.7")
        self.assertNotIn("critical spin", said(done))
        done = run("check", self.case(CASE), "--set", "motion.angular_velocity=181.9")
        self.assertIn("above the critical spin of this mesh, 181.78 rad/s (90 nodal diameters)", said(done))

    def test_warns_above_the_critical_spin_in_three_dimensions(self):
        done = run("check", self.case(WHEEL))
        self.assertNotIn("critical spin", said(done))
        done = run("check", self.case(WHEEL), "--set", "motion.angular_velocity=400")
        self.assertIn("above the critical spin of this mesh", said(done))

    def test_power_of_the_discretisation(self):
        """With one place a sector the scheme has a third of the largest power."""
        s = self.steady()
        power = s["power"]
        largest = max(abs(power["drive"]), power["mass"] + power["stiffness"], abs(power["friction"]))
        self.assertAlmostEqual(s["scheme_share"], abs(power["scheme"]) / largest, delta=1e-15)
        rough = ["analysis.samples_per_sector=1"]
        done = run("run", self.case(WHEEL), "-o", self.out, "--quiet", "--overwrite", "--set", *rough)
        self.assertEqual(done.returncode, 3, done.stderr)
        for part in ("the discretisation takes", "analysis.samples_per_sector", "analysis.accept_scheme_power"):
            self.assertIn(part, done.stderr)
        self.assertNotIn("steady", summary(self.out))
        s = self.steady(*rough, "analysis.accept_scheme_power=true", text=WHEEL)
        self.assertGreater(s["scheme_share"], 0.25)
        self.assertIn("rolling resistance is wrong", " ".join(summary(self.out)["warnings"]))

    def test_power_of_the_discretisation_in_sweeps(self):
        self.case(WHEEL, "small.toml")
        study = STUDY.replace("ground.friction", "analysis.samples_per_sector").replace("0.1, 0.5", "1, 4")
        done = run("sweep", self.case(study, "study.toml"), "-o", self.out)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("the discretisation", done.stderr)
        table = np.genfromtxt(self.out / "results.csv", delimiter=",", names=True, dtype=None, encoding=None)
        self.assertEqual(list(table["status"]), ["failed", "done"] * 2)
        self.assertTrue((table["scheme_share"][1::2] < 0.25).all())

    def test_without_friction_and_damping_there_is_no_power(self):
        s = self.steady("ground.friction=0", "damping.mass=0", "damping.stiffness=0", text=CASE)
        self.assertAlmostEqual(s["force_y"], 189717, delta=1)

    def test_numbers_beyond_the_range_are_refused_with_their_key(self):
        for text, settings in (
                (SMALL, ("material.density=1e200", "material.density=1e-300", "material.youngs_modulus=1e300",
                         "damping.mass=1e305", "motion.angular_velocity=1e160")),
                (WHEEL, ("damping.mass=1e305", "damping.stiffness=1e300", "motion.angular_velocity=1e160",
                         "material.youngs_modulus=1e-320", "material.density=5e-324"))):
            for setting in settings:
                for command in ("check", "run"):
                    more = ["-o", self.out] if command == "run" else []
                    done = run(command, self.case(text), *more, "--set", setting)
                    self.assertEqual(done.returncode, 2, (setting, done.returncode, done.stderr))
                    self.assertIn(setting.split("=")[0], done.stderr)

    def test_check_tells_what_the_case_means(self):
        def lines(text, *settings):
            done = run("check", self.case(text), *settings)
            self.assertEqual(done.returncode, 0, done.stderr)
            return {line[:19].strip(): line[19:] for line in done.stdout.splitlines()}, said(done)

        told, _ = lines(CASE)
        self.assertEqual(told["deflection"], "0.01 m, 6.67 % of the 0.15 m of the wall")
        self.assertEqual(told["slip ratio"], "-1e-08")
        self.assertEqual(told["contact pressure"], "about 1.5e+06 Pa, 0.073 of E")
        self.assertIn("10 m/s", told["speed"])
        self.assertIn("as rubber", told["stiffness"])
        found, _ = lines(FREE, *LOAD, "--set", "analysis.torque=0")  # height and slip are not known yet
        self.assertFalse({"deflection", "slip ratio"} & found.keys())
        _, warned = lines(CASE, "--set", "motion.height=0.26", "--set", "motion.speed=2")
        self.assertIn("comes down by 0.04 m", warned)
        self.assertIn("the slip ratio is 0.8", warned)

    def test_a_sweep_has_the_bits_of_runs_alone(self):
        self.case(SMALL, "small.toml")
        study = self.case(STUDY, "study.toml")
        self.assert_done(run("sweep", study, "-o", self.out))
        table = np.genfromtxt(self.out / "results.csv", delimiter=",", names=True, dtype=None,
                              encoding=None)
        alone = self.folder / "alone"
        for row in table:
            self.assert_done(run("run", self.case(SMALL), "-o", alone, "--quiet", "--overwrite", "--set",
                                 f"motion.speed={row['motionspeed']!r}", "--set",
                                 f"ground.friction={row['groundfriction']!r}"))
            s = summary(alone)["steady"]
            self.assertEqual((row["force_x"], row["force_y"], row["torque"], row["rolling_resistance"]),
                             (s["force_x"], s["force_y"], s["torque"], s["rolling_resistance"]))

    def test_members_of_one_spin_share_harmonics_wherever_they_stand(self):
        self.case(SMALL, "small.toml")
        study = """schema = 1
base = "small.toml"
snapshots = true
[[vary]]
key = "ground.friction"
values = [0.1, 0.3, 0.5]
[[vary]]
key = "motion.angular_velocity"
values = [-33.0, -34.0]
"""
        self.assert_done(run("sweep", self.case(study, "study.toml"), "-o", self.out, "--jobs", 1))
        table = np.genfromtxt(self.out / "results.csv", delimiter=",", names=True, dtype=None, encoding=None)
        self.assertEqual(list(table["motionangular_velocity"]), 3 * [-33.0, -34.0])
        seconds = [summary(folder)["harmonics_wall_s"] for folder in sorted(self.out.glob("runs/*"))]
        self.assertEqual(len(seconds), 6)
        self.assertEqual([len(set(seconds[0::2])), len(set(seconds[1::2]))], [1, 1])  # each found once

    def test_threads_change_no_bit(self):
        results = []
        for threads in (1, 2, 3):
            self.assert_done(run("run", self.case(SMALL), "-o", self.out, "--overwrite", "--threads", threads))
            with h5py.File(self.out / "results.h5") as f:
                results.append((json.dumps(summary(self.out)["steady"]), f["snapshots/displacement"][()].tobytes()))
        self.assertEqual(results[1], results[0])
        self.assertEqual(results[2], results[0])

    def test_a_sweep_writes_runs_only_with_their_snapshots(self):
        self.case(SMALL, "small.toml")
        self.assert_done(run("sweep", self.case(STUDY, "study.toml"), "-o", self.out))
        self.assertFalse((self.out / "runs").exists())
        whole = self.folder / "whole"
        self.assert_done(run("sweep", self.case("snapshots = true\n" + STUDY, "study.toml"), "-o", whole))
        self.assertEqual(len(list((whole / "runs").glob("*/results.h5"))), 4)
        self.assertEqual((self.out / "results.csv").read_text(), (whole / "results.csv").read_text())
        self.assert_done(run("sweep", self.case(STUDY, "study.toml"), "-o", self.out, "--resume"))

    def test_a_member_that_is_not_solved_fails_alone(self):
        self.case(replaced(SMALL, "height", None), "small.toml")
        study = STUDY.replace("ground.friction", "analysis.load").replace("0.1, 0.5", "1e5, 7e6")
        done = run("sweep", self.case(study, "study.toml"), "-o", self.out)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("is inverted", done.stderr)
        table = np.genfromtxt(self.out / "results.csv", delimiter=",", names=True, dtype=None, encoding=None)
        self.assertEqual(list(table["status"]), ["done", "failed"] * 2)

    def assert_done(self, done):
        self.assertEqual(done.returncode, 0, done.stderr)


class Refused(ProgramTest):
    def refuse(self, part, *settings, text=SMALL, code=2):
        arguments = [a for s in settings for a in ("--set", s)]
        done = run("run", self.case(text), "-o", self.folder / "out", "--quiet", *arguments)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertIn(part, done.stderr)

    def test_wrong_use(self):
        self.refuse("nothing touches", "motion.height=0.31")
        self.refuse("is given together with motion.height", text=SMALL + "load = 1e5\n")
        self.refuse("is given together with motion.height", "analysis.load=1e5", "motion.height=0.29")
        self.refuse("so is analysis.load", text=replaced(SMALL, "height", None))
        self.refuse("is given together with motion.speed", text=SMALL + "torque = 0\n")
        self.refuse("would slide", "analysis.load=1e5", "analysis.traction=4e4", text=FREE)
        self.refuse("the whole contact slides", "analysis.load=1e5", "analysis.torque=4e4", text=FREE)
        treads = (ROOT / "cases" / "steady-treaded.toml").read_text()
        self.refuse("allowed: more analysis.samples_per_sector", "analysis.load=1e5", "analysis.torque=0",
                    "analysis.samples_per_sector=4", "motion.angular_velocity=66.666667",
                    text=replaced(replaced(treads, "speed", None), "height", None))
        self.refuse("ground.friction = 0.4 times the load times the height", "analysis.load=1e5", "analysis.torque=4e4",
                    text=FREE)
        self.refuse("without friction", "analysis.load=1e5", "analysis.traction=0", "ground.friction=0", text=FREE)
        self.refuse("without friction", "analysis.torque=100", "ground.friction=0")
        self.refuse("does not turn", "motion.angular_velocity=0")
        self.refuse("is a table", "motion.speed=[[0, 10], [1, 11]]")
        self.refuse("needs flat ground", "ground.profile=[[0, 0], [1, 0.1]]")
        self.refuse("every node of the curve \"rim\" is held", "load.pressure=[{curve='rim', value=1}]")
        self.refuse("with 8 samples", "analysis.massless_contact=false")
        self.refuse("held by the rim", "disk.mesh.radial=1")

    def test_what_is_not_solved_is_no_result(self):
        self.refuse("is inverted", "analysis.load=7e6", text=replaced(SMALL, "height", None), code=3)
        self.refuse("the ground is within the rim", "analysis.load=1e7", text=replaced(SMALL, "height", None))

    def test_too_much_work_says_how_much_and_what_makes_less(self):
        text = replaced(replaced(WHEEL, "height", None), "speed", None)
        settings = ("analysis.samples_per_sector=10", "analysis.load=32955", "analysis.torque=-29324",
                    "ground.friction=8", "motion.slip_angle=0.25077", "motion.camber=0.09014")
        done = run("run", self.case(text), "-o", self.folder / "out", "--quiet",
                   *[word for setting in settings for word in ("--set", setting)])
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertRegex(done.stderr, r"samples_per_sector = 10 makes \d{3} pairs of .* 4(\.\d)?e\+11 operations")
        self.assertIn("fewer samples, a coarser disk.mesh", done.stderr)
        self.assertIn("a smaller ground.friction or analysis.load", done.stderr)

    def test_no_checkpoints(self):
        done = run("run", self.case(SMALL), "-o", self.folder / "out", "--resume")
        self.assertEqual(done.returncode, 2)
        self.assertIn("no checkpoints", done.stderr)


if __name__ == "__main__":
    unittest.main()

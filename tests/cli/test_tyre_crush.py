# SPDX-License-Identifier: BSD-3-Clause
"""Static loading: the crush of a wheel in three dimensions, against the plane crush, against steady rolling without
friction, and of tyres."""
import unittest

import h5py
import numpy as np

from program import history, run, said, summary
from test_tyre import TYRE as FULL
from test_tyre import TyreTest
from test_tyre_nonlinear import ALL, COARSE, CORDS, WINDOW
from test_tyre_steady_nonlinear import rolling

DISK = """schema = 1
[disk]
outer_radius = 0.3
inner_radius = 0.2
width = 0.1
[disk.mesh]
radial = 4
circumferential = 90
axial = 3
[material]
youngs_modulus = 5.0e6
poissons_ratio = 0.45
density = 1100.0
[motion]
camber = 0.0
[ground]
profile = [[-1, 0.1], [1, 0.1]]
friction = 0.5
[analysis]
kind = "crush"
depth = 0.008
increments = 8
"""
STEADY = DISK[:DISK.index("[analysis]")].replace("camber", "angular_velocity = 1e-6\nspeed = 3e-7\ncamber") + """
[analysis]
kind = "steady-rolling"
inertia = "none"
massless_contact = false
samples_per_sector = 1
"""
SLIDE = ("--set", "analysis.slide=0.004", "--set", "analysis.slide_increments=4")
TYRE = COARSE.replace("sectors = 90", "sectors = 24") + """
[ground]
profile = "flat"
friction = 0.9
[analysis]
kind = "crush"
depth = 0.01
increments = 1
"""
SMOOTH = ("--set", "ground.friction=0")
FORCES = ("force_y", "force_x", "force_lateral", "moment_overturning", "moment_aligning", "torque")


class TyreCrush(TyreTest):
    def pressed(self, text, *more):
        """history.csv and run.json."""
        done = run("run", self.case(text), "-o", self.results, "--overwrite", "--quiet", *more)
        self.assertEqual(done.returncode, 0, done.stderr)
        told = summary(self.results)
        self.assertLess(told["energy_residual_relative"], 1e-11)
        self.assertLess(told["equilibrium_residual_max"], 1e-8 if "balance_residual" in told else 1e-11)
        self.assertLess(told["contact_residual_max"], 1e-9)
        self.assertLess(told["penetration_max_m"], 1e-12)
        return history(self.results), told

    def test_without_a_lateral_contraction_it_is_the_plane_crush(self):
        """Of Poisson's ratio 0, each slice of the wheel is a plane body, whose crush another solver finds."""
        tread = DISK.replace("circumferential = 90\n", "").replace("[material]", """[disk.tread]
pitches = 40
depth = 0.01
land_columns = 3
groove_columns = 1
layers = 1
[material]""")
        for text in (DISK, tread):
            with self.subTest(text=text):
                self.compare_with_the_plane_crush(text, "--set", "material.poissons_ratio=0", *SLIDE)

    def compare_with_the_plane_crush(self, text, *words):
        wide, told = self.pressed(text, *words)
        self.assertNotIn("load", told)
        plane, _ = self.pressed(text.replace("width = 0.1\n", "").replace("axial = 3\n", "").replace(
            "[motion]\ncamber = 0.0\n", "").replace("density", 'plane = "stress"\ndensity'), *words)
        self.assertEqual(len(wide["time_s"]), 13)
        for name in ("time_s", "depth_m", "center_x_m", "center_y_m", "pressure_max_pa", "shear_max_pa"):
            np.testing.assert_allclose(wide[name], plane[name], rtol=1e-9, atol=1e-6 if name.endswith("pa") else 1e-12, err_msg=name)
        for name in ("force_x", "force_y", "torque", "strain", "work_contact", "work_rim", "loss_impact",
                     "dissipation_friction"):
            size = np.abs(plane["force_y" if "force" in name else name]).max()
            np.testing.assert_allclose(wide[name] / 0.1, plane[name], rtol=0, atol=1e-10 * size, err_msg=name)
        np.testing.assert_array_equal(wide["sticking_nodes"], 4 * plane["sticking_nodes"])
        np.testing.assert_allclose(wide["contact_area_m2"] / 0.1, plane["contact_length_m"], rtol=1e-10)
        touches = wide["contact_nodes"] > 0
        np.testing.assert_allclose(wide["footprint_width_m"], np.where(touches, 0.1, 0.0), rtol=1e-10)
        np.testing.assert_allclose(wide["pressure_mean_pa"] * wide["contact_area_m2"], wide["force_y"], rtol=1e-12)

    def test_without_friction_it_is_steady_rolling_that_stands(self):
        """With camber, and by a load as well: the ground is at .1 m."""
        leans = (*SMOOTH, "--set", "motion.camber=0.05")
        down, _ = self.pressed(DISK, *leans)
        height = down["center_y_m"][-1]
        done = run("run", self.case(STEADY), "-o", self.results, "--overwrite", "--quiet", *leans, "--set",
                   f"motion.height={height!r}")
        self.assertEqual(done.returncode, 0, done.stderr)
        steady = history(self.results)
        loaded, told = self.pressed(DISK.replace("depth = 0.008", f"load = {down['force_y'][-1]!r}"), *leans)
        self.assertEqual(told["load"], down["force_y"][-1])
        self.assertAlmostEqual(told["height"], height, delta=1e-12)
        self.assertAlmostEqual(told["depth_reached"], 0.008, delta=1e-12)
        np.testing.assert_allclose(loaded["force_y"], np.arange(9) / 8 * told["load"], rtol=1e-12)
        self.assertGreater(abs(down["moment_overturning"][-1]), 1.0)
        for name in FORCES:
            self.assertAlmostEqual(down[name][-1], steady[name][-1], delta=1e-8 * told["load"], msg=name)
            self.assertAlmostEqual(loaded[name][-1], down[name][-1], delta=1e-8 * told["load"], msg=name)

    def test_friction_takes_energy_down_and_up_again(self):
        path = ("--set", "analysis.increments=20", "--set", "analysis.depth=[[0, 0], [10, 0.008], [20, 0]]")
        rows, _ = self.pressed(DISK, *path)
        smooth, _ = self.pressed(DISK, *path, *SMOOTH)
        self.assertGreater(rows["dissipation_friction"][-1], 5e-2)
        self.assertGreater(rows["force_y"][5], 1.005 * rows["force_y"][15])
        self.assertAlmostEqual(smooth["force_y"][5], smooth["force_y"][15], delta=1e-9 * smooth["force_y"][10])
        for found in (rows, smooth):
            self.assertEqual([found[name][-1] for name in ("force_y", "strain", "contact_nodes")], [0, 0, 0])
        self.assertTrue((smooth["dissipation_friction"] == 0).all())
        self.assertTrue((rows["force_y"][1:11] > smooth["force_y"][1:11]).all())

    def test_increments_converge_and_camber_pushes_sideways(self):
        found = {n: self.pressed(DISK, "--set", "motion.camber=0.05", "--set", f"analysis.increments={n}")[0]
                 for n in (4, 16, 64)}
        last = {n: np.array([rows[name][-1] for name in ("force_y", "force_lateral")]) for n, rows in found.items()}
        fine, coarse = (np.abs(last[n] - last[64]).max() for n in (16, 4))
        self.assertLess(fine, 0.5 * coarse)
        self.assertLess(coarse, 0.01 * last[64][0])
        self.assertGreater(last[64][1], 0.01 * last[64][0])

    def test_files_of_an_increment(self):
        rows, told = self.pressed(DISK, "--set", "motion.camber=0.05", "--set", "output.stress=true")
        with h5py.File(self.results / "results.h5") as file:
            depth, force, area = (file[f"crush/{name}"][:] for name in ("depth", "force", "contact_area"))
            contact = file["contact/force"][:]
        np.testing.assert_array_equal(depth, rows["depth_m"][1:])
        np.testing.assert_allclose(force, np.stack([rows[n][1:] for n in ("force_y", "force_x", "force_lateral")], 1))
        np.testing.assert_allclose(area, rows["contact_area_m2"][1:])
        np.testing.assert_allclose(contact[:, :, 0].sum(axis=1), rows["force_y"][1:], rtol=1e-12)
        self.assertEqual((told["snapshots"], told["increments_done"], told["dimensions"]), (8, 8, 3))

    def test_loads_of_a_tyre_are_those_of_steady_rolling(self):
        for words in ((), CORDS, WINDOW, ALL):
            rows, told = self.pressed(TYRE, *SMOOTH, *words)
            done = run("run", self.case(rolling(rows["center_y_m"][-1], more="speed = 3.1e-4")), "-o", self.folder / "steady",
                       "--overwrite", "--quiet", "--set", "section.sectors=24", *words)
            self.assertEqual(done.returncode, 0, done.stderr)
            load = summary(self.folder / "steady")["steady"]["force_y"]
            self.assertAlmostEqual(rows["force_y"][-1] / load, 1.0, delta=5e-9, msg=words)
            self.assertEqual("contact_problems" in told, words != ())

    def test_a_nonlinear_tyre_under_a_load(self):
        """It sticks almost everywhere; more increments change little."""
        by_load = TYRE.replace("depth = 0.01", "load = 1500.0")
        rows, told = self.pressed(by_load, *ALL)
        self.assertAlmostEqual(rows["force_y"][-1], 1500.0, delta=1e-6)
        self.assertLessEqual(told["balance_residual"], 1e-8)
        self.assertGreater(rows["sticking_nodes"][-1], 0.7 * rows["contact_nodes"][-1])
        fine, _ = self.pressed(by_load, *ALL, "--set", "analysis.increments=2")
        self.assertAlmostEqual(fine["depth_m"][-1], rows["depth_m"][-1], delta=1e-4)
        smooth, _ = self.pressed(by_load, *ALL, *SMOOTH)
        self.assertLess(rows["depth_m"][-1], smooth["depth_m"][-1])

    def test_a_nonlinear_tyre_is_let_up(self):
        path = ("--set", "analysis.increments=4", "--set", "analysis.depth=[[0, 0], [1, 0.004], [2, 0.012], [4, 0]]")
        rows, _ = self.pressed(TYRE, *ALL, *SMOOTH, *path)
        direct, _ = self.pressed(TYRE, *ALL, *SMOOTH, "--set", "analysis.depth=0.006")
        self.assertAlmostEqual(rows["force_y"][3] / direct["force_y"][-1], 1.0, delta=1e-7)
        self.assertEqual(rows["force_y"][4], 0.0)

    def test_stiffness_along_the_ground_of_an_independent_calculation(self):
        """At 260 kPa and 16 mm, where all that touches sticks: 277.3 N/mm; pressed without friction, 4,158.6 N."""
        text = FULL + TYRE[TYRE.index("[ground]"):].replace("0.9", "5.0").replace("0.01", "0.016")
        stiff = ("--set", "inflation.pressure=2.6e5", "--set", "analysis.increments=20")
        drawn, _ = self.pressed(text, *stiff, "--set", "analysis.slide=1e-4", "--set", "analysis.slide_increments=1")
        self.assertEqual(drawn["sticking_nodes"][-1], drawn["contact_nodes"][-1])
        stiffness = (drawn["force_x"][-2] - drawn["force_x"][-1]) / 0.1  # N/mm
        self.assertAlmostEqual(stiffness / 277.3, 1.0, delta=2e-4)
        smooth, _ = self.pressed(text, *stiff, *SMOOTH, "--set", "analysis.increments=1")
        self.assertAlmostEqual(smooth["force_y"][-1] / 4158.6, 1.0, delta=2e-5)

    def test_check(self):
        done = run("check", self.case(TYRE), *ALL)
        self.assertEqual(done.returncode, 0, done.stderr)
        for words in ("increments         1 to depth 0.01 m", "0.01 m, 10.1 % of", "memory", "sectors            24 of"):
            self.assertIn(words, done.stdout)
        done = run("check", self.case(TYRE.replace("depth = 0.01", "load = 3000.0")))
        self.assertIn("increments         1 to load 3000 N", done.stdout)

    def test_what_is_refused(self):
        for key, words, told in (
                ("analysis.load", "analysis.load=100", "one follows from the other"),
                ("analysis.solver", "analysis.solver=latin", "is for plane bodies"),
                ("analysis.depth", "analysis.depth=0.2", "the rim would reach the ground"),
                ("disk.rim", "disk.rim=free", "bonded to its rim"),
                ("ground.profile", "ground.profile=[[-1, 0], [1, 0.1]]", "needs flat ground"),
                ("analysis.depth", "analysis={kind = 'crush', depth = 0.08, increments = 2}", "nodes that are held would be up to")):
            done = run("check", self.case(DISK.replace("camber = 0.0", "camber = 0.75")), "--set", words)
            self.assertEqual(done.returncode, 2, (words, done.stderr))
            self.assertIn(key, done.stderr)
            self.assertIn(told, done.stderr)
        plane = DISK.replace("width = 0.1\n", "").replace("axial = 3\n", "").replace("[motion]\ncamber = 0.0\n", "")
        done = run("check", self.case(plane.replace("depth = 0.008", "load = 100.0")))
        self.assertIn("presses a wheel in three dimensions", done.stderr)
        done = run("check", self.case(DISK.replace("depth = 0.008\n", "")))
        self.assertIn("analysis.depth", done.stderr)
        done = run("check", self.case(TYRE), "--set", "inflation.spin=30")
        self.assertIn("a crush presses a wheel that stands", done.stderr)
        done = run("check", self.case(DISK), "--set", "motion.angular_velocity=3")
        self.assertIn("without effect: motion.angular_velocity", said(done))

    def test_a_load_that_is_too_large(self):
        done = run("run", self.case(DISK.replace("depth = 0.008", "load = 1e6")), "-o", self.results, "--quiet")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("increment 2 of 8, load 250000 N: the ground is within the rim", done.stderr)
        self.assertIn("a smaller analysis.load", done.stderr)


if __name__ == "__main__":
    unittest.main()

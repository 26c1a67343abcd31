# SPDX-License-Identifier: BSD-3-Clause
"""A crush with tables of depth and slide: lifting off, dragging to and fro; keys of its solvers."""
import unittest

import h5py
import numpy as np

from program import ProgramTest, ROOT, RunTest, history, replaced, run, said, summary

CRUSH = """schema = 1
title = "crush"
[disk]
outer_radius = 0.30
inner_radius = 0.15
[disk.mesh]
radial = 4
circumferential = 60
[material]
youngs_modulus = 2.0e7
poissons_ratio = 0.3
density = 1100.0
[ground]
profile = "flat"
friction = 0.3
[analysis]
kind = "crush"
increments = 16
depth = [[0, 0], [8, 0.02], [16, 0]]
"""

TO_AND_FRO = """slide = [[0, 0], [8, 0], [16, 0.02], [32, -0.02], [48, 0.02], [64, -0.02]]
"""


def dragged(text=CRUSH):
    text = replaced(replaced(text, "increments", "increments = 64"), "depth",
                    "depth = [[0, 0], [8, 0.02], [64, 0.02]]")
    return text + TO_AND_FRO


class Histories(RunTest):
    text = CRUSH

    def lifted(self, friction):
        self.run_ok(replaced(CRUSH, "friction", f"friction = {friction}"))
        return history(self.out)

    def test_lifted_off_nothing_is_left(self):
        h = self.lifted(0.0)
        np.testing.assert_allclose(h["force_y"][9:], h["force_y"][7::-1], rtol=1e-11, atol=1e-7)
        for name in ("force_x", "force_y", "torque", "strain", "contact_nodes",
                     "contact_length_m", "pressure_max_pa", "depth_m"):
            self.assertEqual(h[name][-1], 0.0, name)
        most = h["strain"].max()
        self.assertLess(np.abs(h["energy_residual"]).max(), 1e-12 * most)
        self.assertEqual(np.abs(h["dissipation_friction"]).max(), 0.0)
        np.testing.assert_allclose(h["work_rim"][-1], h["loss_impact"][-1], atol=1e-12 * most)
        with h5py.File(self.out / "results.h5") as f:
            self.assertEqual(np.abs(f["/snapshots/displacement"][-1]).max(), 0.0)
            self.assertEqual(np.abs(f["/contact/force"][-1]).max(), 0.0)
            self.assertIn("share of the increments", f["/frame/time"].attrs["description"])
            self.assertNotIn("depth", f["/frame/time"].attrs["description"])

    def test_friction_takes_a_loop(self):
        h = self.lifted(0.1)
        self.assertEqual(h["force_y"][-1], 0.0)
        most = h["strain"].max()
        loop = np.sum(0.5 * (h["force_y"][1:] + h["force_y"][:-1]) * np.diff(h["depth_m"]))
        self.assertGreater(loop, 1e-5 * most)
        self.assertAlmostEqual(h["work_rim"][-1] / loop, 1.0, places=9)
        self.assertGreater(h["dissipation_friction"][-1], 0.5 * loop)
        self.assertAlmostEqual((h["dissipation_friction"][-1] + h["loss_impact"][-1]) / loop, 1.0,
                               places=6)
        # Shear turns round on the way back.
        self.assertGreater(np.abs(h["force_y"][9:-1] - h["force_y"][7:0:-1]).max(),
                           1e-5 * h["force_y"].max())

    def test_what_a_run_says_of_itself(self):
        done = self.run_ok(dragged())
        self.assertIn("64 increments to a depth of 0.02 m and a slide of -0.02 m", done.stderr)
        s, h = summary(self.out), history(self.out)
        self.assertEqual((s["depth"], s["depth_max"], s["slide"], s["increments"],
                          s["slide_increments"], s["increments_done"], s["snapshots"]),
                         (0.02, 0.02, -0.02, 64, 0, 64, 64))
        np.testing.assert_array_equal(h["time_s"], np.arange(65) / 64)
        np.testing.assert_allclose(h["center_x_m"],
                                   np.interp(np.arange(65), [0, 8, 16, 32, 48, 64],
                                             [0, 0, 0.02, -0.02, 0.02, -0.02]), atol=1e-16)
        checked = run("check", self.case(CRUSH))
        self.assertIn("16 increments to a depth of 0 m", checked.stdout)
        self.assertIn("largest depth      0.02 m", checked.stdout)
        again = self.folder / "again"
        self.assertEqual(run("run", self.out / "case.toml", "-o", again, "--quiet").returncode, 0)
        self.assertEqual((self.out / "history.csv").read_bytes(),
                         (again / "history.csv").read_bytes())

    def test_a_number_and_its_table_are_the_same_crush(self):
        self.run_ok(replaced(replaced(CRUSH, "depth", "depth = 0.02"), "increments",
                             "increments = 8"))
        table = self.folder / "table"
        text = replaced(replaced(CRUSH, "depth", "depth = [[0, 0], [8, 0.02]]"), "increments",
                        "increments = 8")
        done = run("run", self.case(text), "-o", table, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        for name, column in history(self.out).items():
            size = np.abs(column).max()
            if size > 1e-6 and name not in ("sweeps", "penetration_max_m"):
                np.testing.assert_allclose(history(table)[name], column, atol=1e-9 * size,
                                           err_msg=name)

    def test_cycles_dissipate_the_same(self):
        self.run_ok(dragged())
        h = history(self.out)
        lost = h["dissipation_friction"]
        self.assertAlmostEqual((lost[48] - lost[32]) / (lost[64] - lost[48]), 1.0, places=9)
        self.assertLess(lost[16] - lost[8], 0.8 * (lost[64] - lost[48]))  # the first way is shorter
        np.testing.assert_allclose(h["force_x"][33:49], -h["force_x"][49:65],
                                   rtol=1e-9, atol=1e-9 * h["force_y"].max())
        self.assertAlmostEqual(h["force_x"][64] / h["force_y"][64], 0.3, places=12)

    def test_of_rubber(self):
        text = replaced(CRUSH, "youngs_modulus", 'model = "neo-hooke"\nshear_modulus = 7.0e6')
        self.run_ok(text)
        s, h = summary(self.out), history(self.out)
        for name in ("force_x", "force_y", "contact_nodes", "contact_length_m"):
            self.assertEqual(h[name][-1], 0.0, name)
        self.assertLess(abs(h["strain"][-1]), 1e-14 * h["strain"].max())
        self.assertLess(s["sweeps_max"], 500)
        self.assertLess(s["energy_residual_relative"], 1e-9)

    def test_cyclic_case(self):
        done = run("run", ROOT / "cases" / "crush-cyclic.toml", "-o", self.out, "--quiet")
        self.assertEqual((done.returncode, said(done)), (0, ""))
        h = history(self.out)
        self.assertAlmostEqual(h["force_x"][40] / h["force_y"][40], -0.3, places=12)
        lost = h["dissipation_friction"]
        self.assertAlmostEqual(lost[120] - lost[80], 1872.2, places=1)  # as the case says
        self.assertAlmostEqual(lost[160] - lost[120], 1872.2, places=1)
        self.assertEqual((h["force_y"][-1], h["strain"][-1]), (0.0, 0.0))


class Refused(ProgramTest):
    def refused(self, text, fragments, *extra):
        done = run("run", self.case(text), "-o", self.folder / "out", *extra)
        self.assertEqual(done.returncode, 2, done.stderr)
        for fragment in fragments:
            self.assertIn(fragment, done.stderr)
        self.assertFalse((self.folder / "out").exists())

    def test_tables(self):
        for depth, fragments in (
                ("[[0, 0], [8, 0.02]]", ["analysis.depth = [8, 0.02]", "at increment 16"]),
                ("[[0, 0.01], [16, 0.02]]", ["the first point must be [0, 0]"]),
                ("[[0, 0], [16, 0]]", ["would not be pressed"]),
                ("[[0, 0], [8, 0.16], [16, 0]]", ["rim would reach the ground"]),
                ("[[0, 0], [8, -0.01], [16, 0]]", ["out of bounds", "values >= 0"])):
            with self.subTest(depth=depth):
                self.refused(replaced(CRUSH, "depth", f"depth = {depth}"), fragments)

    def test_resume(self):
        self.refused(CRUSH, ["no checkpoints to resume from"], "--resume")

    def test_modes_of_another_solver(self):
        self.refused(CRUSH, ["analysis.solver", "--modes-from", '"latin-pgd"'], "--modes-from",
                     self.folder)

    def test_keys_of_latin_beside_direct(self):
        self.refused(CRUSH + "relaxation = 0.9\n",
                     ["analysis.relaxation = 0.9", 'analysis.solver = "direct"', '"latin-pgd"'])


if __name__ == "__main__":
    unittest.main()

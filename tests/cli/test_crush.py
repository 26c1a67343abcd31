# SPDX-License-Identifier: BSD-3-Clause
"""rondo run and rondo check on a crush: files, columns, figures, wrong input, interruption."""
import signal
import subprocess
import time
import unittest

import h5py
import numpy as np

from program import (LEDGE, PROGRAM, ProgramTest, ROOT, RunTest, SANITIZED, SMALL, corner_areas,
                     estimated_memory, history, line_of, replaced, run, said, summary)

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
profile = [[-1, -0.1], [1, -0.1]]
friction = 0.3
[analysis]
kind = "crush"
depth = 0.02
increments = 8
"""

FROM_DYNAMIC = ["--set", "analysis.kind=crush", "--set", "analysis.depth=0.02", "--set",
         "analysis.increments=4", "--set", "ground.profile=flat"]


class Crush(RunTest):
    text = CRUSH

    def test_results_directory(self):
        done = self.run_ok()
        self.assertNotIn("warning", said(done))
        self.assertIn("increment 8 of 8", done.stderr)
        self.assertIn("8 increments to a depth of 0.02 m", done.stderr)
        self.assertEqual(sorted(p.name for p in self.out.iterdir()),
                         ["case.toml", "contact.csv", "fields.vtkhdf", "fields.xdmf", "history.csv", "results.h5",
                          "run.json"])
        s = summary(self.out)
        self.assertEqual(
            sorted(s), sorted("status title version build build_id build_record dispatch host process analysis nodes dofs depth depth_max "
                              "increments slide slide_increments increments_done candidates_condensed contact_residual_max "
                              "equilibrium_residual_max energy_residual_relative energy_exchanged "
                              "penetration_max_m sweeps_max pivoted_increments factor_wall_s loop_wall_s "
                              "peak_memory_bytes snapshots columns resumable output steps_done last_time "
                              "loop_cpu_s total_wall_s strain_max strain_max_cell strain_max_place "
                              "warnings strain_max_time jacobian_min jacobian_min_cell jacobian_min_place "
                              "jacobian_min_time mass area regions files energy_residual_bound".split()))
        self.assertEqual((s["status"], s["analysis"], s["nodes"], s["dofs"], s["increments"],
                          s["increments_done"], s["depth"], s["snapshots"]),
                         ("done", "crush", 300, 480, 8, 8, 0.02, 8))
        self.assertLess(s["contact_residual_max"], 1e-12)
        self.assertLess(s["equilibrium_residual_max"], 1e-13)
        self.assertLess(s["energy_residual_relative"], 1e-12)
        self.assertLess(s["penetration_max_m"], 1e-15)

    def test_history(self):
        self.run_ok()
        h = history(self.out)
        dynamic = self.folder / "dynamic"
        run("run", self.case(SMALL, "small.toml"), "-o", dynamic, "--set", "time.end=0.001")
        self.assertEqual(list(h), list(history(dynamic))
                         + "depth_m pressure_max_pa shear_max_pa contact_residual sweeps".split())
        self.assertEqual(summary(dynamic)["analysis"], "dynamic")
        np.testing.assert_array_equal(h["time_s"], np.arange(9) / 8)
        np.testing.assert_allclose(h["depth_m"], 0.02 * np.arange(9) / 8, rtol=1e-14)
        np.testing.assert_allclose(h["center_y_m"], -0.1 + 0.3 - h["depth_m"], atol=1e-15)
        for name, column in h.items():  # at first touch there is nothing but a place
            if name != "center_y_m":
                self.assertEqual(column[0], 0.0, name)
        self.assertTrue(np.all(np.diff(h["force_y"]) > 0))
        self.assertGreater(h["force_y"][-1], 1e5)
        self.assertLess(np.abs(h["force_x"]).max(), 1e-12 * h["force_y"].max())  # round-off
        self.assertLess(np.abs(h["torque"]).max(), 1e-12 * h["force_y"].max())
        energy = h["strain"][-1]
        np.testing.assert_allclose(h["strain"] - h["work_contact"], h["energy_residual"],
                                   atol=1e-14 * energy)
        self.assertLess(np.abs(h["energy_residual"]).max(), 1e-12 * energy)
        split = h["work_rim"] - h["dissipation_friction"] - h["loss_impact"]
        np.testing.assert_allclose(split, h["work_contact"], atol=1e-12 * energy)
        # The rim's work is the area under the force over the depth, by trapezes.
        area = np.sum(0.5 * (h["force_y"][1:] + h["force_y"][:-1]) * np.diff(h["depth_m"]))
        self.assertAlmostEqual(h["work_rim"][-1] / area, 1.0, places=12)
        self.assertGreaterEqual(h["dissipation_friction"].min(), -1e-12 * energy)

    def test_snapshots_and_contact(self):
        self.run_ok()
        h = history(self.out)
        rows = np.genfromtxt(self.out / "contact.csv", delimiter=",", names=True)
        with h5py.File(self.out / "results.h5") as f:
            t = f["/frame/time"][:]
            np.testing.assert_array_equal(t, np.arange(1, 9) / 8)
            np.testing.assert_allclose(f["/frame/time_velocity"][:], t - 0.5 / 8, rtol=1e-15)
            np.testing.assert_array_equal(f["/frame/angle"][:], 0.0)
            np.testing.assert_array_equal(f["/frame/center"][:, 1], h["center_y_m"][1:])
            np.testing.assert_array_equal(f["/frame/center"][:, 0], 0.0)
            u, v = f["/snapshots/displacement"][:], f["/snapshots/velocity"][:]
            np.testing.assert_allclose(v[0], 8 * u[0], rtol=1e-15)
            np.testing.assert_allclose(v[1:], 8 * np.diff(u, axis=0), atol=1e-15)
            force = f["/contact/force"][:]
            np.testing.assert_allclose(force[..., 0].sum(axis=1), h["force_y"][1:], rtol=1e-13)
            self.assertGreaterEqual(force[..., 0].min(), 0.0)
            self.assertLessEqual(np.max(np.abs(force[..., 1]) - 0.3 * force[..., 0]), 1e-9)
            traction = f["/contact/traction"][:]
            np.testing.assert_allclose(traction[..., 0].max(axis=1), h["pressure_max_pa"][1:])
            np.testing.assert_allclose(np.abs(traction[..., 1]).max(axis=1), h["shear_max_pa"][1:])
            # Every candidate in contact is on the ground, every other above it.
            boundary = f["/mesh/boundary"][:]
            y = (f["/frame/center"][:][:, 1, None] + f["/mesh/coordinates"][:][boundary, 1]
                 + u[:, boundary, 1])
            self.assertGreater(y.min(), -0.1 - 1e-14)
            self.assertLess(np.abs(y[force[..., 0] > 0] + 0.1).max(), 1e-14)
            last = rows[rows["time_s"] == 1.0]
            self.assertEqual(len(last), h["contact_nodes"][-1])
            self.assertAlmostEqual(last["pressure_pa"].max(), h["pressure_max_pa"][-1])
            self.assertIn("von_mises", f["/fields"])

    def test_slide(self):
        self.text = CRUSH + "slide = 0.004\nslide_increments = 4\n"
        done = self.run_ok()
        self.assertIn("12 increments to a depth of 0.02 m and a slide of 0.004 m", done.stderr)
        s, h = summary(self.out), history(self.out)
        self.assertEqual((s["slide"], s["slide_increments"], s["increments_done"], s["snapshots"]),
                         (0.004, 4, 12, 12))
        np.testing.assert_array_equal(h["time_s"], np.arange(13) / 8)  # on beyond 1
        np.testing.assert_allclose(h["center_x_m"], 0.001 * np.maximum(np.arange(13) - 8, 0),
                                   rtol=1e-14)
        np.testing.assert_array_equal(h["depth_m"][8:], 0.02)
        self.assertTrue(np.all(np.diff(h["force_x"][8:]) < 0))  # against the way
        self.assertGreaterEqual(h["force_x"].min(), -0.3 * h["force_y"][-1])
        with h5py.File(self.out / "results.h5") as f:
            np.testing.assert_array_equal(f["/frame/center"][:, 0], h["center_x_m"][1:])
            np.testing.assert_allclose(-f["/crush/force"][:, 1], h["force_x"][1:], atol=1e-6)
        again = self.folder / "again"
        self.assertEqual(said(run("run", self.out / "case.toml", "-o", again, "--quiet")), "")
        self.assertEqual((self.out / "history.csv").read_bytes(),
                         (again / "history.csv").read_bytes())

    def test_case_toml_gives_the_same_bits_without_a_warning(self):
        self.run_ok()
        again = self.folder / "again"
        done = run("run", self.out / "case.toml", "-o", again, "--quiet")
        self.assertEqual((done.returncode, said(done)), (0, ""))
        for name in ("case.toml", "history.csv", "contact.csv"):
            self.assertEqual((self.out / name).read_bytes(), (again / name).read_bytes(), name)

    def test_a_dynamic_case_crushed_from_the_command_line(self):
        done = run("run", self.case(LEDGE), "-o", self.out, "--quiet", *FROM_DYNAMIC)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(said(done).count("warning"), 1)
        for name in ("[damping]", "motion.angular_velocity", "motion.speed", "motion.height", "[initial]", "[time]", "output.snapshots"):
            self.assertIn(name, done.stderr)

    def test_treaded_case(self):
        done = run("run", ROOT / "cases" / "crush-treaded.toml", "-o", self.out, "--quiet")
        self.assertEqual((done.returncode, said(done)), (0, ""))
        h = history(self.out)
        self.assertAlmostEqual(h["force_y"][-1] / 4.387e5, 1.0, places=3)  # as the case says
        self.assertLess(np.abs(h["force_x"]).max(), 5e-3 * h["force_y"][-1])
        self.assertGreater(np.abs(h["force_x"]).max(), 10.0)  # not even
        self.assertGreater(h["dissipation_friction"][-1], 1.0)
        self.assertLess(np.abs(h["energy_residual"]).max(), 1e-12 * h["strain"][-1])

    def test_smooth_case(self):
        done = run("run", ROOT / "cases" / "crush-smooth.toml", "-o", self.out, "--quiet")
        self.assertEqual((done.returncode, said(done)), (0, ""))
        h = history(self.out)
        self.assertAlmostEqual(h["force_y"][-1] / 4.743e5, 1.0, places=3)
        self.assertAlmostEqual(h["force_y"][20] / 1.882e5, 1.0, places=3)
        self.assertAlmostEqual(h["contact_length_m"][-1], 0.1763, places=3)
        self.assertLess(np.abs(h["force_x"]).max(), 1e-12 * h["force_y"][-1])

    def test_no_friction_no_shear(self):
        self.run_ok(replaced(CRUSH, "friction", "friction = 0.0"))
        h = history(self.out)
        self.assertEqual(h["shear_max_pa"].max(), 0.0)
        self.assertEqual(h["sticking_nodes"].max(), 0.0)
        self.assertEqual(np.abs(h["dissipation_friction"]).max(), 0.0)

    def test_check(self):
        done = run("check", self.case(CRUSH))
        self.assertEqual((done.returncode, said(done)), (0, ""))
        for word in ("nodes", "300", "condensed", "increments         8", "memory", "disk"):
            self.assertIn(word, done.stdout)
        self.assertNotIn("critical step", done.stdout)
        self.assertEqual([p.name for p in self.folder.iterdir()], ["case.toml"])

    @unittest.skipIf(SANITIZED, "the memory of the sanitizer counts")
    def test_memory_estimate_is_what_a_run_takes(self):
        # Smaller runs are below the memory of this script, which the system counts to them.
        for radial in (24, 36, 48):
            text = replaced(CRUSH, "radial", f"radial = {radial}")
            text = replaced(text, "circumferential", f"circumferential = {15 * radial}")
            text = replaced(text, "increments", "increments = 2")
            out = self.folder / f"out{radial}"
            self.assertEqual(run("run", self.case(text), "-o", out).returncode, 0)
            ratio = estimated_memory(self.folder / "case.toml") / summary(out)["peak_memory_bytes"]
            self.assertGreater(ratio, 0.8, radial)
            self.assertLess(ratio, 1.3, radial)

    def test_labels_of_a_crush(self):
        self.run_ok()
        h = history(self.out)
        with h5py.File(self.out / "results.h5") as f:
            self.assertEqual(f.attrs["analysis"], "crush")
            for name, units in (("frame/time", "1"), ("frame/time_velocity", "1"),
                                ("snapshots/velocity", "m"), ("fields/velocity", "m"),
                                ("crush/depth", "m"), ("crush/force", "N/m"),
                                ("crush/contact_length", "m"), ("crush/pressure_max", "Pa")):
                self.assertEqual(f[name].attrs["units"], units, name)
                self.assertTrue(f[name].attrs["description"], name)
            self.assertIn("equilibrium", f["contact/force"].attrs["description"])
            every = []
            f.visititems(lambda _, item: every.extend(map(str, item.attrs.values())))
            self.assertFalse([text for text in every if "step" in text or "du/dt" in text])
            np.testing.assert_array_equal(f["crush/depth"][:], h["depth_m"][1:])
            np.testing.assert_array_equal(f["crush/force"][:, 0], h["force_y"][1:])
            np.testing.assert_array_equal(f["crush/force"][:, 1], -h["force_x"][1:])
            np.testing.assert_array_equal(f["crush/contact_length"][:], h["contact_length_m"][1:])
            np.testing.assert_array_equal(f["crush/pressure_max"][:], h["pressure_max_pa"][1:])
        dynamic = self.folder / "dynamic"
        run("run", self.case(SMALL, "small.toml"), "-o", dynamic, "--set", "time.end=0.001")
        with h5py.File(dynamic / "results.h5") as f:
            self.assertEqual(f.attrs["analysis"], "dynamic")
            self.assertEqual(f["frame/time"].attrs["units"], "s")
            self.assertEqual(f["snapshots/velocity"].attrs["units"], "m/s")
            self.assertNotIn("crush", f)

    def test_interrupted(self):
        text = replaced(CRUSH, "increments", "increments = 20000")
        process = subprocess.Popen([PROGRAM, "run", self.case(text), "-o", self.out],
                                   stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.stderr.close)
        path = self.out / "history.csv"
        deadline = time.time() + 60
        while time.time() < deadline and not (path.exists() and path.stat().st_size > 5000):
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=60), 130)
        s = summary(self.out)
        self.assertEqual(s["status"], "interrupted")
        self.assertLess(s["increments_done"], 20000)
        self.assertEqual(s["snapshots"], s["increments_done"])
        self.assertEqual(len(history(self.out)["time_s"]), s["increments_done"] + 1)
        with h5py.File(self.out / "results.h5") as f:
            self.assertEqual(len(f["/frame/time"]), s["snapshots"])
            self.assertEqual(len(f["/crush/depth"]), s["snapshots"])

    def test_a_signal_while_it_is_set_up_is_an_interruption(self):
        big = replaced(replaced(CRUSH, "radial", "radial = 100"), "circumferential",
                       "circumferential = 2000")  # its factors take seconds
        for number in (signal.SIGTERM, signal.SIGINT):
            process = subprocess.Popen([PROGRAM, "run", str(self.case(big)), "-o", str(self.out)],
                                       stderr=subprocess.PIPE, text=True)
            time.sleep(0.5)
            process.send_signal(number)
            said_last = process.communicate(timeout=60)[1]
            self.assertEqual(process.returncode, 130)
            self.assertEqual("rondo: warning: interrupted", said_last.splitlines()[-1])
            self.assertFalse(self.out.exists())

    def test_strains_are_told(self):
        deep = replaced(CRUSH, "depth", "depth = 0.1")
        done = self.run_ok(deep)
        s = summary(self.out)
        self.assertIn("66.7 % of the 0.15 m", done.stderr)  # before it begins
        self.assertIn(f"the largest strain is {s['strain_max']:.3g}", done.stderr)
        self.assertIn("for small strains", done.stderr)
        self.assertIn("66.7 % of the 0.15 m", s["warnings"][0])
        self.assertIn("the largest strain is", s["warnings"][-1])
        with h5py.File(self.out / "results.h5") as f:
            cells, x = f["/mesh/cells"][:], f["/mesh/coordinates"][:]
            moved = x + f["/snapshots/displacement"][-1]
        ratio = (corner_areas(moved, cells) / corner_areas(x, cells)).min(axis=0)
        self.assertAlmostEqual(s["jacobian_min"], ratio.min(), delta=1e-12)
        at = s["jacobian_min_cell"]  # or its mirror image
        self.assertAlmostEqual(ratio[at], ratio.min(), delta=1e-9)
        self.assertEqual(s["jacobian_min_time"], 1.0)
        np.testing.assert_allclose(s["jacobian_min_place"], x[cells[at]].mean(axis=0))
        self.assertGreater(s["strain_max"], 0.4)

    def test_an_inverted_cell_ends_it(self):
        done = run("run", self.case(replaced(CRUSH, "depth", "depth = 0.148")), "-o", self.out)
        self.assertEqual(done.returncode, 3, done.stderr)
        s = summary(self.out)
        self.assertEqual(s["status"], "failed")
        self.assertLessEqual(s["jacobian_min"], 0.0)
        for part in (f"increment {s['increments_done'] + 1} of 8",
                     f"cell {s['jacobian_min_cell']} of /mesh/cells near", "is inverted"):
            self.assertIn(part, done.stderr)

    def test_much_friction_is_solved_by_pivoting(self):
        # On lands that lean the sweeps cycle; there is a solution at any friction.
        case = ROOT / "cases" / "crush-treaded.toml"
        coarse = ["--set", "disk.mesh.radial=4", "--set", "disk.tread.layers=1"]
        for friction, increments, extra, pivoted in (
                (1.5, 40, [], True), (1.5, 200, [], False), (2.0, 40, [], True),
                (2.0, 200, [], False), (3.0, 40, [], True), (3.0, 200, [], False),
                (5.0, 40, [], True), (5.0, 200, [], True), (1.5, 200, coarse, True)):
            with self.subTest(friction=friction, increments=increments, extra=extra):
                done = run("run", case, "-o", self.out, "--overwrite", "--quiet", *extra, "--set",
                           f"ground.friction={friction}", "--set",
                           f"analysis.increments={increments}")
                self.assertEqual((done.returncode, said(done)), (0, ""))
                s = summary(self.out)
                self.assertEqual(s["increments_done"], increments)
                self.assertEqual(s["pivoted_increments"] > 0, pivoted)
                self.assertLess(s["contact_residual_max"], 1e-10)
                self.assertLess(history(self.out)["contact_residual"].max(), 1e-10)
                with h5py.File(self.out / "results.h5") as f:
                    r = f["/contact/force"][:]
                    over = np.abs(r[..., 1]) - friction * r[..., 0]
                    self.assertLess(over.max(), 1e-10 * r.max())

    def test_little_friction_needs_no_pivoting(self):
        self.run_ok()
        self.assertEqual(summary(self.out)["pivoted_increments"], 0)

    def test_forces_out_of_range(self):
        done = run("run", self.case(CRUSH), "-o", self.out, "--set", "material.youngs_modulus=1e200")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("increment 1 of 8", done.stderr)
        self.assertIn("out of the range", done.stderr)
        self.assertNotIn("friction", done.stderr)
        s = summary(self.out)
        self.assertEqual((s["status"], s["increments_done"], s["snapshots"]), ("failed", 0, 0))
        self.assertIn("out of the range", s["message"])
        self.assertIsNone(s["equilibrium_residual_max"])
        self.assertEqual(len(history(self.out)["time_s"]), 1)  # what was not solved is left out

    def test_any_unit_of_the_modulus(self):
        # Nothing but the forces knows the unit; no square of them leaves the range of the numbers.
        self.run_ok()
        h = history(self.out)
        tiny = self.folder / "tiny"
        done = run("run", self.case(CRUSH), "-o", tiny, "--set", "material.youngs_modulus=2e-293")
        self.assertEqual(done.returncode, 0, done.stderr)
        np.testing.assert_allclose(history(tiny)["force_y"] * 1e300, h["force_y"], rtol=1e-12)

    def test_stiffness_out_of_range(self):
        done = run("run", self.case(CRUSH), "-o", self.out, "--set", "material.youngs_modulus=1e308")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("material.youngs_modulus", done.stderr)
        self.assertFalse(self.out.exists())


class WrongCrush(ProgramTest):
    def refused(self, text, fragments, line=None, extra=()):
        for command in ("run", "check"):
            done = run(command, self.case(text), *extra)
            self.assertEqual(done.returncode, 2, done.stderr)
            for fragment in fragments:
                self.assertIn(fragment, done.stderr)
            if line is not None:
                self.assertIn(f"case.toml:{line}:", done.stderr)
            self.assertEqual([p.name for p in self.folder.iterdir()], ["case.toml"])

    def test_depth_missing(self):
        self.refused(replaced(CRUSH, "depth", None), ["analysis.depth: is missing"],
                     line_of(CRUSH, "[analysis]"))

    def test_increments_missing(self):
        self.refused(replaced(CRUSH, "increments", None), ["analysis.increments: is missing"],
                     line_of(CRUSH, "[analysis]"))

    def test_increments_zero(self):
        self.refused(replaced(CRUSH, "increments", "increments = 0"),
                     ["analysis.increments = 0", "1 to 1000000"], line_of(CRUSH, "increments"))

    def test_depth_too_large(self):
        self.refused(replaced(CRUSH, "depth", "depth = 0.15"),
                     ["analysis.depth = 0.15", "rim would reach the ground", "0.15"],
                     line_of(CRUSH, "depth"))

    def test_depth_in_a_dynamic_case(self):
        self.refused(SMALL + "[analysis]\ndepth = 0.02\n",
                     ["analysis.depth = 0.02", "dynamic", 'analysis.kind = "crush"'])

    def test_ledge(self):
        text = replaced(CRUSH, "profile", "profile = [[-10, -0.1], [0, -0.1], [0, 0], [10, 0]]")
        self.refused(text, ["ground.profile", "flat ground", 'ground.profile = "flat"'],
                     line_of(text, "profile"))

    def test_no_ground(self):
        text = CRUSH.replace("[ground]\nprofile = [[-1, -0.1], [1, -0.1]]\nfriction = 0.3\n", "")
        self.refused(text, ["ground", "ground.profile"])


if __name__ == "__main__":
    unittest.main()

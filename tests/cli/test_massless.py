# SPDX-License-Identifier: BSD-3-Clause
"""solver.contact_mass = "singular": what a run leaves, that it goes on after a kill, what is refused
once the body is known, and what ends a run."""
import subprocess
import time
import unittest

import h5py
import numpy as np

from program import PROGRAM, ProgramTest, SMALL, history, replaced, run, summary

MASSLESS = SMALL + '[solver]\ncontact_mass = "singular"\n'


class MasslessTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"

    def finish(self, text, *extra, out=None):
        done = run("run", self.case(text), "-o", out or self.out, "--quiet", "--overwrite", *extra)
        self.assertEqual(done.returncode, 0, done.stderr)
        return summary(out or self.out)


class Results(MasslessTest):
    def test_tell_of_it(self):
        s = self.finish(MASSLESS)
        self.assertEqual(s["contact_mass"], "singular")
        self.assertGreaterEqual(s["critical_step"], s["critical_step_plain"])
        self.assertLess(s["energy_residual_relative"], 1e-12)
        self.assertLess(s["contact_residual_max"], 1e-11)
        self.assertLess(s["penetration_max_m"], 1e-14)
        self.assertEqual(s["contact"]["clusters_not_converged"], 0)
        rows = history(self.out)
        self.assertGreater(rows["contact_iterations"].max(), 0)
        self.assertEqual(rows["contact_extensions"].max(), s["contact"]["extensions_max"])
        self.assertGreater(rows["loss_impact"][-1], 0.0)
        with h5py.File(self.out / "results.h5") as f:
            mass, moving = f["/mesh/mass"][:], f["/mesh/mass_dynamic"][:]
            touching = f["/mesh/boundary"][:]
            force, dt = f["/contact/force"][-1], s["step"]
        self.assertTrue((mass > 0.0).all())
        self.assertTrue((moving[touching] == 0.0).all())
        self.assertAlmostEqual(moving.sum(), mass.sum(), delta=1e-12 * mass.sum())
        self.assertAlmostEqual(force[:, 0].sum(), rows["force_y"][-1], delta=0.05 * rows["force_y"][-1])
        self.assertGreater(dt, 0.0)

    def test_lumped_runs_have_none_of_it(self):
        s = self.finish(SMALL)
        self.assertEqual(s["contact_mass"], "lumped")
        self.assertNotIn("critical_step_plain", s)
        self.assertNotIn("contact_extensions", history(self.out))
        with h5py.File(self.out / "results.h5") as f:
            self.assertNotIn("mass_dynamic", f["/mesh"])

    def test_center_and_inertia_are_kept(self):
        self.finish(MASSLESS.replace('"singular"', '"singular-kept"'))
        with h5py.File(self.out / "results.h5") as f:
            mass, moving, x = f["/mesh/mass"][:], f["/mesh/mass_dynamic"][:], f["/mesh/coordinates"][:]
        inertia = (mass * (x**2).sum(axis=1)).sum()
        self.assertAlmostEqual((moving * (x**2).sum(axis=1)).sum() / inertia, 1.0, delta=1e-12)
        center = np.abs(((moving - mass)[:, None] * x).sum(axis=0)).max()
        self.assertLess(center, 1e-12 * mass.sum())

    def test_threads_change_no_bit(self):
        text = replaced(MASSLESS, "circumferential", "circumferential = 200")
        self.finish(text, "--threads", "1")
        self.finish(text, "--threads", "2", out=self.folder / "two")
        for name in ("history.csv", "results.h5"):
            self.assertEqual((self.out / name).read_bytes(),
                             (self.folder / "two" / name).read_bytes(), name)

    def test_a_start_in_steady_rolling_stays_there(self):
        text = replaced(MASSLESS, "height", "height = 0.29") + '[initial]\nstate = "steady-rolling"\n'
        text = replaced(text, "radial", "radial = 12")
        text = replaced(text, "circumferential", "circumferential = 180")
        self.finish(text)
        rows = history(self.out)
        mean = rows["force_y"].mean()
        self.assertAlmostEqual(mean, 1.90e5, delta=200.0)
        self.assertLess(np.abs(rows["force_y"] - mean).max(), 0.02 * mean)


class Killed(MasslessTest):
    def test_goes_on_to_the_same_bits(self):
        text = replaced(MASSLESS, "end", "end = 3.0")
        text = replaced(text, "snapshots",
                        "snapshots = 21\nhistory_interval = 1e-3\ncheckpoint_interval = 0.02")
        whole = self.folder / "whole"
        self.finish(text, out=whole)
        rows = (whole / "history.csv").read_bytes().count(b"\n")
        for share in (0.2, 0.5):
            process = subprocess.Popen([PROGRAM, "run", str(self.case(text)), "-o", str(self.out),
                                        "--resume", "--quiet"], stderr=subprocess.DEVNULL)
            end = time.time() + 100
            while time.time() < end and process.poll() is None:
                there = self.out / "history.csv"
                if there.exists() and there.read_bytes().count(b"\n") >= share * rows:
                    break
                time.sleep(0.002)
            self.assertIsNone(process.poll(), "came too late")
            process.kill()
            process.wait()
        done = run("run", self.case(text), "-o", self.out, "--resume", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreater(len(summary(self.out)["resumed_at_steps"]), 1)
        for name in ("history.csv", "contact.csv", "results.h5"):
            self.assertEqual((whole / name).read_bytes(), (self.out / name).read_bytes(), name)


class Refused(MasslessTest):
    def check(self, fragments, *settings, text=MASSLESS):
        extra = [word for setting in settings for word in ("--set", setting)]
        done = run("check", self.case(text), *extra)
        self.assertEqual(done.returncode, 2, done.stdout)
        for fragment in fragments:
            self.assertIn(fragment, done.stderr)

    def test_a_node_that_nothing_takes_the_mass_of(self):
        self.check(["solver.contact_mass", "contact node", "no free node beside it"],
                   "disk.mesh.radial=1")

    def test_pressures_on_contact_nodes(self):
        self.check(["solver.contact_mass", 'the pressure on "tread"'],
                   "load.pressure=[{curve='tread', value=1e4}]")

    def test_implicit_elements_with_contact_nodes(self):
        self.check(["solver.implicit[0]", "has contact node", "without mass"],
                   "solver.implicit=[{layers=[3]}]")
        done = run("check", self.case(MASSLESS), "--set", "solver.implicit=[{layers=[1]}]")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_free_disk(self):
        text = "\n".join(line for line in MASSLESS.splitlines()
                         if not line.startswith(("angular_velocity", "speed", "height")))
        text = text.replace("[motion]", "[motion]\ngravity = 9.81")
        text = text.replace("inner_radius = 0.15", 'inner_radius = 0.15\nrim = "free"')
        self.check(["solver.contact_mass", "a body is free"],
                   "initial.position=[0.0, 0.31]", text=text)

    def test_thin_outer_layers_are_warned_of(self):
        done = run("check", self.case(MASSLESS), "--set", "disk.mesh.grading=3")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("traps its own wave", done.stderr)
        done = run("check", self.case(MASSLESS))
        self.assertNotIn("traps its own wave", done.stderr)


class Ended(MasslessTest):
    def test_by_a_concave_corner(self):
        done = run("run", self.case(MASSLESS), "-o", self.out, "--quiet",
                   "--set", "ground.profile=[[-10, 1], [0, 0], [10, 1]]", "--set", "motion.speed=0.0",
                   "--set", "motion.height=[[0, 0.31], [0.01, 0.295]]")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("held by two facets of the ground", done.stderr)


if __name__ == "__main__":
    unittest.main()

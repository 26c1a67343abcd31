# SPDX-License-Identifier: BSD-3-Clause
"""Reduced wheels in three dimensions of viscous materials (`rondo run --reduced`) against steady rolling and full runs."""
import shutil
import unittest

import numpy as np

from program import ROOT, SANITIZED, ProgramTest, history, run, settings, summary

CORNERING = ROOT / "cases" / "wheel3d-cornering.toml"
LOAD = ROOT / "cases" / "wheel3d-load.toml"
LOSS = "material.loss_factor=0.15", "material.loss_band=[5.0, 500.0]"
NO_FRICTION = "damping.mass=0", "damping.stiffness=0", "ground.friction=0", "motion.slip_angle=0"
FEW = "output.snapshots=2"


class ReducedLoss(ProgramTest):
    def results(self, name, case, *given, options=("--reduced",)):
        """History and summary of a run, whose energies close and whose branches never give energy back."""
        directory = self.folder / name
        done = run("run", case, "-o", directory, "--quiet", "--overwrite", *options, *settings(*LOSS, *given))
        self.assertEqual(done.returncode, 0, done.stderr)
        told = summary(directory)
        self.assertLess(told["energy_residual_relative"], 1e-11)
        if "--reduced" not in options:
            return history(directory), told
        h = history(directory)
        self.assertGreaterEqual(np.diff(h["dissipation_viscous"]).min(), 0.0)
        self.assertLess(np.abs(h["integration"]).max(), 1e-11 * np.abs(h["internal_work"]).max())
        return h, told

    @staticmethod
    def late(h, begin):
        """Means from a time on, and the loss of the branches in W."""
        there = h["time_s"] > begin
        means = {name: h[name][there].mean() for name in ("force_x", "force_y", "force_lateral", "torque")}
        return means | {"viscosity": np.polyfit(h["time_s"][there], h["dissipation_viscous"][there], 1)[0]}

    def test_loses_what_it_does_in_steady_rolling(self):
        """So light that waves shorter than two sectors have no inertia, which the mesh does not resolve."""
        light = *NO_FRICTION, "material.density=1"
        told = self.results("steady", ROOT / "cases" / "wheel3d-steady.toml", *light, "analysis.samples_per_sector=32",
                            "analysis.massless_contact=true", options=())[1]
        steady = told["steady"] | {"viscosity": told["steady"]["power"]["viscosity"]}
        reduced = self.late(self.results("reduced", CORNERING, *light, FEW, "time.end=0.5",
                                         options=("--reduced", "--reduced-step", "2e-4"))[0], 0.4)
        for name, bound in (("force_y", 2e-4), ("torque", 2e-3), ("viscosity", 2e-3)):
            self.assertLess(abs(reduced[name] / steady[name] - 1.0), bound, name)
        self.assertLess(abs(reduced["viscosity"] / (33.76455 * reduced["torque"]) - 1.0), 5e-3)

    @unittest.skipIf(SANITIZED, "minutes")
    def test_corners_as_the_full_run(self):
        given = FEW, "output.history_interval=0"
        reduced = self.late(self.results("reduced", CORNERING, *given)[0], 0.1)
        whole = self.late(self.results("whole", CORNERING, *given, options=("--threads", "1"))[0], 0.1)
        for name in ("force_x", "force_y", "force_lateral"):
            self.assertLess(abs(reduced[name] - whole[name]), 0.01 * whole["force_y"], name)
        self.assertLess(abs(reduced["viscosity"] / whole["viscosity"] - 1.0), 0.02)

    def test_a_run_resumes_bit_for_bit(self):
        """On a rim with tables, and on one that moves and whose spin changes."""
        for case in (CORNERING, LOAD):
            given = FEW, "time.end=0.06"
            whole = self.results("whole", case, *given)[0]
            half = self.folder / "half"
            shutil.rmtree(half, ignore_errors=True)
            self.results("half", case, FEW, "time.end=0.03")
            done = run("run", case, "--reduced", "-o", half, "--resume", "--quiet", *settings(*LOSS, *given))
            self.assertEqual(done.returncode, 0, done.stderr)
            again = history(half)
            self.assertGreater(whole["dissipation_viscous"][-1], 0.0)
            for name in whole:
                self.assertEqual(whole[name][-1], again[name][-1], name)

    def test_a_spin_that_changes(self):
        """It brakes from 34 to 17 rad/s while it rolls, and loses less in a second at the end."""
        spin = "motion.angular_velocity=[[0, 33.76], [0.05, 33.76], [0.15, 16.88]]"
        h = self.results("spin", CORNERING, *NO_FRICTION, FEW, spin, "time.end=0.25")[0]
        fast, slow = (self.late({name: h[name][h["time_s"] < end] for name in h}, begin)["viscosity"]
                      for begin, end in ((0.03, 0.05), (0.2, 0.25)))
        self.assertLess(slow, 0.6 * fast)
        self.assertGreater(slow, 0.4 * fast)

    def test_check_tells_the_creep(self):
        """Of regions that are not as stiff, but creep alike, too."""
        for given in ((), ("material.region=[{layers = [3], youngs_modulus = 1e7}]",)):
            done = run("check", CORNERING, "--reduced", *settings(*LOSS, *given))
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertRegex(done.stdout, r"creep +0\.\d+ of the compliance in .* of the shortest branch")

    def test_what_does_not_creep_as_one_is_refused(self):
        for case, given, words in (
                (ROOT / "cases" / "tyre-rolling.toml", (), "the cords do not creep"),
                (CORNERING, ("material.region=[{layers = [3], loss_factor = 0.3}]",), "regions differ in their viscous branches")):
            done = run("check", case, "--reduced", *settings(*LOSS, *given))
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(words, done.stderr)
            self.assertIn("the full run, without --reduced", done.stderr)


if __name__ == "__main__":
    unittest.main()

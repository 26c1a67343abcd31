# SPDX-License-Identifier: BSD-3-Clause
"""Rubber at finite strain: runs, their columns and figures, resuming, a crush, a start in stationary spin."""
import unittest

import numpy as np

from program import ROOT, SMALL, RunTest, history, replaced, run, summary

RUBBER = replaced(replaced(replaced(SMALL, "youngs_modulus", 'model = "yeoh"\nc10 = 1.0e6\nc20 = -5.0e4\nc30 = 1.0e4'),
                           "poissons_ratio", "poissons_ratio = 0.49"),
                  "[damping]", '[[material.viscosity]]\nrelative_modulus = 0.3\ntime = 2.0e-3\n[damping]')
RUBBER = replaced(RUBBER, "stiffness", "stiffness = 0.0")
# What the fused step does not do: the general one does it.
GENERAL = RUBBER + '[contact]\nbetween = "all"\n'


class Rubber(RunTest):
    text = RUBBER

    def made(self, text, *more):
        done = run("run", self.case(text), "-o", self.out, "--quiet", *more)
        self.assertEqual(done.returncode, 0, done.stderr)
        return history(self.out), summary(self.out)

    def test_energies(self):
        for text in (RUBBER, GENERAL):
            h, j = self.made(text, "--overwrite")
            self.assertLess(j["energy_residual_relative"], 1e-12)
            self.assertLess(j["integration_relative"], 1e-2)
            self.assertGreater(h["stored_energy"][-1], 1.0)
            self.assertTrue(np.all(np.diff(h["dissipation_viscous"]) >= 0.0))
            self.assertGreater(h["dissipation_viscous"][-1], 0.1)
            rest = h["internal_work"] - h["stored_energy"] - h["dissipation_viscous"]
            np.testing.assert_allclose(rest[-1], h["integration"][-1] * j["energy_exchanged"], rtol=0.02)

    def test_goes_on_to_the_same_bytes(self):
        for text in (RUBBER, GENERAL):
            whole = self.made(text, "--overwrite") and (self.out / "history.csv").read_bytes()
            self.made(text, "--overwrite", "--set", "time.end=0.012", "--set", "output.snapshots=7")
            self.made(text, "--resume", "--set", "time.end=0.02")
            self.assertEqual((self.out / "history.csv").read_bytes(), whole)

    def test_an_inverted_element_ends_the_run(self):
        text = replaced(RUBBER, "height", "height = [[0, 0.3], [0.004, 0.18]]")
        done = run("run", self.case(text), "-o", self.out, "--quiet")
        self.assertEqual(done.returncode, 3, done.stderr)
        for word in ("cell", "inverted", "det F", "t = "):
            self.assertIn(word, done.stderr)

    def test_a_step_above_the_critical_one_of_the_deformed_body_ends_the_run(self):
        done = run("run", ROOT / "cases" / "rubber-roller.toml", "-o", self.out, "--quiet", "--set", "time.safety=0.8")
        self.assertEqual(done.returncode, 3, done.stderr)
        for word in ("above the critical step", "undeformed", "t = "):
            self.assertIn(word, done.stderr)

    def test_a_crush(self):
        text = RUBBER[:RUBBER.index("[motion]")].replace("[damping]\nmass = 200.0\nstiffness = 0.0\n", "")
        text = text[:text.index("[[material.viscosity]]")] + '''[ground]
profile = "flat"
friction = 0.3
[analysis]
kind = "crush"
depth = 0.03
increments = 6
slide = 0.01
slide_increments = 4
'''
        h, j = self.made(text)
        self.assertLess(j["energy_residual_relative"], 1e-9)
        self.assertLess(j["equilibrium_residual_max"], 1e-9)
        self.assertLess(j["integration_relative"], 1e-2)
        self.assertTrue(np.all(np.diff(h["force_y"][:7]) > 0.0))
        self.assertLess(h["force_x"][-1], -0.03 * h["force_y"][-1])

    def test_a_stationary_start_stays(self):
        text = replaced(replaced(RUBBER, "height", "height = 0.4"), "angular_velocity", "angular_velocity = 60.0")
        text = replaced(text, "speed", "speed = 0.0") + '[initial]\nstate = "stationary"\n'
        h, _ = self.made(text)
        self.assertGreater(h["stored_energy"][0], 1.0)
        np.testing.assert_allclose(h["stored_energy"], h["stored_energy"][0], rtol=1e-9)
        self.assertLess(h["kinetic"].max(), 1e-15 * h["stored_energy"][0])


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""time.scheme = "hati": a small run and what it writes, the shipped case, and what is refused once the
mesh is there."""
import unittest

import h5py
import numpy as np

from program import ROOT, SMALL, ProgramTest, RunTest, history, replaced, run, summary

PARTS = replaced(SMALL, "end", 'end = 0.02\nscheme = "hati"') + """history_interval = 0
[solver.hati]
ratio = 2
fine = {layers = [2, 3]}
"""
TWO_STEPS = (ROOT / "cases" / "two-steps.toml").read_text()


class Run(RunTest):
    text = PARTS

    def test_rows_facts_and_snapshots_are_of_coarse_steps(self):
        self.run_ok()
        facts, h = summary(self.out), history(self.out)
        parts = facts["hati"]
        self.assertEqual((parts["ratio"], parts["fine_dofs"], parts["interface_dofs"]), (2, 240, 80))
        self.assertEqual(facts["step"], 2 * parts["fine_step"])
        self.assertAlmostEqual(parts["fine_step"] / facts["critical_step"], 0.8, places=12)
        self.assertGreater(facts["critical_step_plain"], 0.9 * facts["critical_step"])
        self.assertEqual(len(h["time_s"]), facts["steps"])
        np.testing.assert_allclose(np.diff(h["time_s"]), facts["step"], rtol=1e-9)
        self.assertLess(facts["energy_residual_relative"], 1e-13)
        self.assertLess(np.abs(h["work_interface"]).max(), 1e-14 * facts["energy_exchanged"])
        self.assertIn("work_interface", [c["name"] for c in facts["columns"]])
        with h5py.File(self.out / "results.h5") as f:
            np.testing.assert_array_equal(f["/frame/time_velocity"][:], f["/frame/time"][:])

    def test_forces_are_those_of_one_step_for_all(self):
        self.run_ok()
        parts = history(self.out)
        done = run("run", self.case(SMALL + "history_interval = 0\n"), "-o", self.folder / "plain")
        self.assertEqual(done.returncode, 0, done.stderr)
        plain = history(self.folder / "plain")

        def impulse(h):
            return np.sum(h["force_y"] * np.diff(h["time_s"], prepend=0.0))
        self.assertAlmostEqual(impulse(parts) / impulse(plain), 1.0, delta=0.02)

    def test_the_energy_of_each_row_is_that_of_its_time(self):
        self.run_ok()
        h = history(self.out)
        energy = h["kinetic"] + h["strain"]
        works = (h["work_frame"] + h["work_contact"] - h["dissipation_mass"]
                 - h["dissipation_stiffness"])
        np.testing.assert_allclose(energy, works, atol=1e-12 * np.abs(works).max() + 1e-12)

    def test_check_tells_both_steps(self):
        done = run("check", self.case(PARTS))
        self.assertEqual(done.returncode, 0, done.stderr)
        for part in ("coarse step", "2 of these", "implicit elements"):
            self.assertIn(part, done.stdout)

    def test_velocities_of_probes_are_of_the_same_time(self):
        probe = '[[output.probe]]\nname = "top"\nposition = [0.0, 0.29]\n'
        self.run_ok(PARTS.replace("[solver.hati]", probe + "[solver.hati]"))
        h = history(self.out)
        steps = np.gradient(h["top_uy"], h["time_s"])
        self.assertGreater(np.corrcoef(steps[5:-5], h["top_vy"][5:-5])[0, 1], 0.99)


class ShippedCase(RunTest):
    def test_two_steps(self):
        self.run_ok(TWO_STEPS)
        facts, h = summary(self.out), history(self.out)
        self.assertEqual(facts["steps_done"], 803)
        late = h["time_s"] > 0.1005
        self.assertAlmostEqual(np.mean(h["force_y"][late]), 48086, delta=100)
        self.assertAlmostEqual(np.mean(h["force_x"][late]), -8467, delta=30)
        self.assertLess(facts["energy_residual_relative"], 1e-13)


class Refused(ProgramTest):
    def refuse(self, key, *said, text=PARTS, settings=()):
        arguments = [a for s in settings for a in ("--set", s)]
        done = run("check", self.case(text), *arguments)
        self.assertEqual(done.returncode, 2, done.stderr)
        for part in (key, "allowed", *said):
            self.assertIn(part, done.stderr)
        return done.stderr

    def test_contact_that_is_nearer_than_the_ratio(self):
        said = self.refuse("solver.hati.ratio", "is 2 elements away", "in the 3 fine steps",
                           "at most 2", text=PARTS.replace("ratio = 2", "ratio = 3"))
        line = 1 + PARTS[:PARTS.index("ratio = 2")].count("\n")
        self.assertIn(f"case.toml:{line}:", said)

    def test_contact_in_the_coarse_part(self):
        self.refuse("solver.hati.fine", "belongs to no fine element",
                    settings=["solver.hati.fine.layers=[1, 2]"])

    def test_nothing_that_is_coarse(self):
        self.refuse("solver.hati.fine", "chooses all elements",
                    settings=["solver.hati.fine.layers=[1, 2, 3]"])

    def test_a_layer_that_is_not_there(self):
        self.refuse("solver.hati.fine.layers", "no layer 4",
                    settings=["solver.hati.fine.layers=[3, 4]"])

    def test_a_fine_step_above_that_of_the_fine_part(self):
        self.refuse("time.step", "above the critical step", "of its fine part",
                    settings=["time.step=1e-3"])

    def test_a_table_of_the_spin_at_its_line(self):
        text = replaced(PARTS, "angular_velocity", "angular_velocity = [[0, 33], [1, 34]]")
        line = 1 + text[:text.index("angular_velocity")].count("\n")
        self.assertIn(f"case.toml:{line}:", self.refuse("motion.angular_velocity", "varies",
                                                        text=text))


if __name__ == "__main__":
    unittest.main()

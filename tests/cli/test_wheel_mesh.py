# SPDX-License-Identifier: BSD-3-Clause
"""rondo run --reduced of meshes without equal sectors: a wheel on spokes, pitches of three lengths."""
import unittest

import h5py
import numpy as np

from program import ROOT, history, replaced, run, summary
from wheels import WheelTest

CASES = ROOT / "cases"


def case_of(name, **keys):
    """A case of the project, for any folder; keys replace its lines."""
    text = (CASES / name).read_text().replace('"meshes/', f'"{CASES}/meshes/')
    for key, line in keys.items():
        text = replaced(text, key, line)
    return text


def mean(rows, name, since):
    late = np.asarray(rows["time_s"]) > since
    return float(np.mean(np.asarray(rows[name])[late]))


class WheelOfAMesh(WheelTest):
    def against_the_full_run(self, case, since, of_x, of_y):
        full = self.folder / "full"
        self.assertEqual(run("run", self.case(case), "-o", full).returncode, 0)
        out, done = self.wheel(case=case, out="reduced")
        self.assertEqual(summary(out)["wheel_modes"], 40)
        self.assertLess(summary(out)["energy_residual_relative"], 1e-11)
        self.assertEqual(summary(out)["wheel"]["steps_not_converged"], 0)
        self.assertAlmostEqual(summary(out)["strain_max"] / summary(full)["strain_max"], 1.0, delta=0.1)
        y = mean(history(full), "force_y", since)
        self.assertAlmostEqual(mean(history(out), "force_x", since) / y,
                               mean(history(full), "force_x", since) / y, delta=of_x)
        self.assertAlmostEqual(mean(history(out), "force_y", since) / y, 1.0, delta=of_y)
        return full, out, done

    def test_a_wheel_on_spokes(self):
        full, out, _ = self.against_the_full_run(case_of("rolling-spokes.toml", end="end = 0.2"),
                                                 0.1, 0.006, 0.008)
        with h5py.File(full / "results.h5") as a, h5py.File(out / "results.h5") as b:
            self.assertEqual(a["/mesh/coordinates"].shape, b["/mesh/coordinates"].shape)
            u, v = a["/snapshots/displacement"][-1], b["/snapshots/displacement"][-1]
        self.assertLess(np.linalg.norm(u - v), 0.05 * np.linalg.norm(u))

    def test_pitches_of_three_lengths(self):
        self.against_the_full_run(case_of("rolling-pitches.toml", end="end = 0.2"), 0.08, 0.006, 0.006)

    def test_a_spin_that_changes_and_friction(self):
        case = case_of("rolling-spokes.toml", end="end = 0.1",
                       angular_velocity="angular_velocity = [[0, 31.7], [0.1, 35]]")
        _, out, _ = self.against_the_full_run(case, 0.05, 0.01, 0.01)
        x = mean(history(out), "force_x", 0.05)
        smooth, _ = self.wheel("--set", "ground.friction=0.01", case=case, out="smooth")
        self.assertLess(abs(mean(history(smooth), "force_x", 0.05)), 0.2 * abs(x))

    def test_it_resumes_to_the_same_bits(self):
        case = replaced(case_of("rolling-spokes.toml", end="end = 0.6"), "snapshots",
                        "snapshots = 5\ncheckpoint_interval = 0.01")
        self.wheel(case=case, out="whole")
        out, command = self.interrupted(case, (500, 1100))
        self.assertEqual(run(*command[1:]).returncode, 0)
        self.same_bits(out)

    def test_few_modes_are_warned_of(self):
        case = case_of("rolling-spokes.toml", end="end = 0.001")
        self.assertIn("which fewer than 20 do not make up for",
                      self.wheel("--modes", 3, case=case, out="few")[1].stderr)
        self.assertNotIn("make up for", self.wheel(case=case, out="many")[1].stderr)

    def test_what_it_refuses(self):
        base = case_of("rolling-spokes.toml")
        for change, said in (
                (base + "\n[rim]\nmass = 5.0\ninertia = 0.1\nfree = [\"angular_velocity\"]\n",
                 "a rim that forces move needs equal sectors"),
                (replaced(base, "angular_velocity", "angular_velocity = 2000"),
                 "the softening by the spin exceeds the stiffness"),
                (replaced(base, "angular_velocity", "angular_velocity = [[0, 1], [0.1, 1236]]"),
                 "the softening by the spin exceeds the stiffness"),
                (base + "\n[[load.pressure]]\ncurve = \"liner\"\nvalue = 1e4\n", "pressure")):
            _, done = self.wheel(case=change, out="refused", code=2)
            self.assertIn(said, done.stderr)


if __name__ == "__main__":
    unittest.main()

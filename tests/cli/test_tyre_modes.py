# SPDX-License-Identifier: BSD-3-Clause
"""rondo modes of a tyre about its inflated state, free of the ground."""
import csv
import unittest

import h5py
import numpy as np

from program import run, summary
from test_tyre import MOVING, TyreTest


class ModesTest(TyreTest):
    """Frequencies about the inflated state, by an independent calculation."""

    def modes(self, sectors, *arguments, code=0):
        done = run("modes", self.case(MOVING), "-o", self.results, "--overwrite", "--diameters", 0, "--set",
                   f"section.sectors={sectors}", *arguments)
        self.assertEqual(done.returncode, code, done.stderr)
        if code:
            return done.stderr
        with open(self.results / "modes.csv", newline="") as file:
            return [{**row, "frequency_hz": float(row["frequency_hz"])} for row in csv.DictReader(file)]


class Modes(ModesTest):
    def test_at_rest(self):
        rows = self.modes(120, "--count", 14, "--spin", 0)
        for n, expected in ((0, (36.60, 43.26)), (1, (45.88, 64.13)), (2, (79.61, 87.93))):
            of_n = [row["frequency_hz"] for row in rows if row["nodal_diameters"] == str(n)]
            if n > 0:
                np.testing.assert_allclose(of_n[::2], of_n[1::2], rtol=1e-9)
                of_n = of_n[::2]
            np.testing.assert_allclose(of_n[:2], expected, atol=6e-3)
        # (alpha/omega + beta omega)/2
        omega = float(rows[0]["frequency_rad_s"])
        self.assertAlmostEqual(float(rows[0]["damping_ratio"]), (20.0 / omega + 1.5e-6 * omega) / 2, delta=1e-9)
        self.assertLess(max(float(row["residual"]) for row in rows), 1e-8)

    def test_spin_stiffens_through_its_own_equilibrium(self):
        """The lowest mode is lateral, which the spin neither softens nor turns."""
        rows = self.modes(60, "--count", 1, "--spin", 0, 50, 100, 150)
        np.testing.assert_allclose([row["frequency_hz"] for row in rows], [36.78, 37.46, 39.50, 42.78],
                                   atol=6e-3)

    def test_at_a_critical_speed_a_wave_stands_still(self):
        """Its frequency in the wheel is then n times the spin; more diameters change nothing."""
        case = self.case(MOVING.replace("[inflation]\n", "[inflation]\nspin = 33.0\n"))

        def critical(last):
            done = run("modes", case, "-o", self.results, "--overwrite", "--diameters", last, "--count", 1,
                       "--spin", 0)
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(self.results / "critical-speeds.csv", newline="") as file:
                return [float(row["critical_spin_rad_s"]) for row in csv.DictReader(file)]

        speeds = critical(3)
        np.testing.assert_allclose(critical(2), speeds[:2], rtol=1e-12)
        done = run("modes", case, "-o", self.results, "--overwrite", "--diameters", 0, "--count", 30, "--spin",
                   speeds[0], speeds[1])
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.results / "modes.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        for n in (1, 2):
            backward = [float(row["frequency_rad_s"]) for row in rows
                        if row["nodal_diameters"] == str(n) and row["wave"] == "backward"
                        and float(row["spin_rad_s"]) == speeds[n - 1]]
            self.assertAlmostEqual(min(backward) / (n * speeds[n - 1]), 1.0, delta=1e-8)

    def test_a_spin_without_a_state_leaves_the_modes_of_the_others(self):
        done = run("modes", self.case(MOVING), "-o", self.results, "--diameters", 0, "--count", 2, "--spin",
                   0, 220)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("at 220 rad/s: ", done.stderr)
        self.assertIn("is not stable", done.stderr)
        self.assertEqual(summary(self.results)["status"], "failed")
        with open(self.results / "modes.csv", newline="") as file:
            spins = [row["spin_rad_s"] for row in csv.DictReader(file)]
        self.assertEqual(set(spins), {"0"})
        with h5py.File(self.results / "modes.h5") as file:
            self.assertEqual(file["modes/real"].shape[0], len(spins))



if __name__ == "__main__":
    unittest.main()

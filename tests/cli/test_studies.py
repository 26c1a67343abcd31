# SPDX-License-Identifier: BSD-3-Clause
"""The studies of docs/studies.md, run whole; the first prints its table."""
import csv
import json
import unittest

import numpy as np

from program import ProgramTest, ROOT, history, run

RADIUS = 0.3  # m


def swept(folder, name, *extra):
    done = run("sweep", ROOT / "cases" / "studies" / f"{name}.toml", "-o", folder, *extra,
               timeout=600)
    assert done.returncode == 0, done.stderr
    with open(folder / "results.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert all(row["status"] == "done" for row in rows)
    return {key: np.array([float(row[key]) for row in rows]) for key in rows[0] if key != "status"}


def carter(x):
    """Traction over full friction, over creep over that of full sliding."""
    return np.where(np.abs(x) < 1, np.sign(x) * (1 - (1 - np.abs(x)) ** 2), np.sign(x))


class Traction(ProgramTest):
    def test_against_carter(self):
        t = swept(self.folder / "out", "traction")
        self.assertLess(t["energy_residual_relative"].max(), 1e-12)
        np.testing.assert_allclose(t["force_y_mean"], 1.9e5, rtol=1.5e-4)  # the load
        print("\n| μ | slip of free rolling | slope | 2R/a | traction at −6 %, +6 % | largest distance "
              "from Carter |\n|---|---|---|---|---|---|")
        # The length is that of the deformed boundary, 1.6 % less than at first: the slopes, which did not change, are
        # 26.2, 6.4, 1.0 and 0.1 % off Carter's by it (25.0, 5.0, 0.5 and 1.4 % by the undeformed one).
        for friction, slope_within, curve_within in ((0.1, 0.27, 0.26), (0.2, 0.07, 0.12),
                                                     (0.4, 0.02, 0.09), (0.6, 0.01, 0.06)):
            of = t["ground.friction"] == friction
            slip = t["slip_ratio_mean"][of]
            share = t["force_x_mean"][of] / t["force_y_mean"][of]  # F/N
            self.assertLess(np.abs(share).max(), friction * (1 + 1e-12))
            self.assertTrue((np.diff(share) > -1e-9).all(), friction)  # more slip, more force
            free = np.interp(0.0, share, slip)
            near = np.argmin(np.abs(slip - free))
            slope = (share[near + 1] - share[near - 1]) / (slip[near + 1] - slip[near - 1])
            half_length = 0.5 * t["contact_length_mean_m"][of].mean()
            distance = share / friction - carter((slip - free) * RADIUS / (friction * half_length))
            print(f"| {friction} | {100 * free:.2f} % | {slope:.2f} | {2 * RADIUS / half_length:.2f} | "
                  f"{share[0] / friction:.3f} μ, {share[-1] / friction:.3f} μ | "
                  f"{np.abs(distance).max():.3f} μ |")
            self.assertAlmostEqual(slope * half_length / (2 * RADIUS), 1, delta=slope_within)
            self.assertLess(np.abs(distance).max(), curve_within)
            self.assertTrue(0.010 < free < 0.016, free)
            if friction <= 0.2:  # it slides as a whole at both ends
                self.assertAlmostEqual(share[0] / friction, -1, delta=1e-9)
                self.assertAlmostEqual(share[-1] / friction, 1, delta=1e-9)


class LoadDeflection(ProgramTest):
    def test_against_the_crush(self):
        """Nodes come to rest up to a step's travel inside the ground: some 0.01 mm."""
        t = swept(self.folder / "out", "load-deflection")
        np.testing.assert_allclose(t["force_y_mean"], -t["rim.force_y"], rtol=1e-8)
        done = run("run", ROOT / "cases" / "crush-smooth.toml", "-o", self.folder / "crush", "--quiet",
                   "--set", "ground.friction=0")
        self.assertEqual(done.returncode, 0, done.stderr)
        crush = history(self.folder / "crush")
        for k, force in enumerate(t["force_y_mean"], start=1):
            height = history(self.folder / "out" / "runs" / f"{k:04d}")["center_y_m"][-1]
            deeper = RADIUS - height - np.interp(force, crush["force_y"], crush["depth_m"])
            self.assertTrue(0 <= deeper < 2e-5, (force, deeper))


class Cleat(ProgramTest):
    def test_over_speed(self):
        t = swept(self.folder / "out", "cleat")
        self.assertLess(t["energy_residual_relative"].max(), 1e-12)
        np.testing.assert_allclose(t["force_y_mean"], 1.5e5, rtol=2e-3)  # the load, in the mean
        peak, speed = t["force_y_peak"], t["motion.speed"]
        self.assertEqual(speed[np.argmax(peak)], 10.0)
        self.assertAlmostEqual(peak.max() / 1.5e5, 2.46, delta=0.02)
        self.assertTrue((np.diff(peak[speed <= 10]) > 0).all() and (np.diff(peak[speed >= 10]) < 0).all())


class Tread(ProgramTest):
    def test_trends(self):
        t = swept(self.folder / "out", "tread")
        pitches, depth = (np.unique(t[f"disk.tread.{key}"]) for key in ("pitches", "depth"))
        shape = (len(pitches), len(depth))
        mean, power = (t[key].reshape(shape) for key in ("force_y_mean", "friction_power"))
        self.assertTrue((np.diff(mean, axis=1) < 0).all())  # deeper grooves: softer
        self.assertTrue((np.diff(power, axis=1) > 0).all())  # and more sliding
        lost = 1 - mean[:, -1] / mean[:, 0]
        self.assertTrue(((0.05 < lost) & (lost < 0.07)).all(), lost)
        noise = t["force_y_fluctuation"].reshape(shape)
        self.assertTrue((noise[0] > noise[1:].mean(axis=0)).all())
        self.assertEqual(json.loads((self.folder / "out" / "sweep.json").read_text())["done"], 24)


class SteadyTraction(ProgramTest):
    def test_carpet(self):
        t = swept(self.folder / "out", "steady-traction")
        self.assertLess(t["contact_residual_max"].max(), 1e-10)
        self.assertLess(t["energy_residual_relative"].max(), 1e-12)
        np.testing.assert_allclose(t["force_y"], t["analysis.load"], rtol=1e-10)
        used = t["force_x"] / (t["ground.friction"] * t["analysis.load"])
        self.assertLess(np.abs(used).max(), 1 + 1e-9)
        for friction in (0.2, 0.4, 0.8):
            for load in np.unique(t["analysis.load"]):
                of = (t["ground.friction"] == friction) & (t["analysis.load"] == load)
                share, slip = used[of], t["slip_ratio"][of]
                self.assertTrue((np.diff(share) < 2e-3).all(), (friction, load))  # faster: more braked
                self.assertTrue(0.009 < np.interp(0.0, share[::-1], slip[::-1]) < 0.0135, (friction, load))
                if friction == 0.2:
                    np.testing.assert_allclose(share[[0, -1]], (1, -1), rtol=1e-9)
        self.assertAlmostEqual(used.max(), 1.0, delta=1e-9)
        most = used[(t["ground.friction"] == 0.8) & (t["analysis.load"] == 2.5e5)]
        self.assertTrue(0.65 < most.max() < 0.7 and -0.75 < most.min() < -0.7)


class SteadyResistance(ProgramTest):
    def test_over_speed_and_damping(self):
        t = swept(self.folder / "out", "steady-resistance")
        np.testing.assert_allclose(t["rolling_resistance"], -t["force_x"], rtol=1e-6)
        drag = t["rolling_resistance"].reshape(4, 12)  # damping, spin
        self.assertTrue((np.diff(drag, axis=0) > 0).all() and (np.diff(drag, axis=1) > 0).all())
        np.testing.assert_allclose(drag[3] / drag[2], 1.94, atol=0.07)  # twice the damping
        self.assertAlmostEqual(drag[3, 0], 42.52, delta=0.05)


class SteadyTread(ProgramTest):
    def test_depth(self):
        t = swept(self.folder / "out", "steady-tread")
        drag, height = (t[key].reshape(4, 4) for key in ("rolling_resistance", "height_m"))
        self.assertTrue((np.diff(drag, axis=0) > 0).all())  # deeper: more to pull
        self.assertTrue((np.diff(height, axis=0) < 0).all())  # and softer
        self.assertAlmostEqual(drag[0, 1], 139.6, delta=0.2)
        self.assertAlmostEqual(drag[3, 1], 157.6, delta=0.2)


if __name__ == "__main__":
    unittest.main()

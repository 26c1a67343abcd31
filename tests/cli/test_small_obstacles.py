# SPDX-License-Identifier: BSD-3-Clause
"""Obstacles that are smaller than the contact nodes are apart: felt, and told of; what lies between nodes counts as penetration; rounding makes no corners."""
import csv
import unittest

import numpy as np

from program import ROOT, SMALL, ProgramTest, RunTest, history, run, summary

# 20 mm high, in front of the disk, which comes down beside it; nodes are 47 mm apart.
POST = "ground.profile=[[-9, 0], [0.1, 0], [0.1, 0.02], [0.102, 0.02], [0.102, 0], [9, 0]]"
CLEAT = (ROOT / "cases" / "wheel3d-cleat-sharp.toml").read_text()
SPACING = 2 * 0.3 * np.sin(np.pi / 40)


class InThePlane(RunTest):
    text = SMALL

    def rows(self, *settings):
        self.run_ok(None, "--quiet", "--overwrite", *(x for s in settings for x in ("--set", s)))
        return history(self.out)

    def test_a_thin_post_with_small_fillets_is_felt_as_a_sharp_one(self):
        flat = self.rows()["force_x"]
        sharp = self.rows(POST)["force_x"]
        rounded = self.rows(POST, "ground.fillet=0.0005")["force_x"]
        self.assertLess(summary(self.out)["energy_residual_relative"], 1e-10)
        self.assertLess(summary(self.out)["contact_residual_max"], 1e-10)
        change = np.abs(sharp - flat).max()
        self.assertGreater(change, 0.1 * np.abs(history(self.out)["force_y"]).max())
        self.assertGreater(np.abs(rounded - flat).max(), 0.5 * change)
        self.assertLess(np.abs(rounded - sharp).mean(), 0.2 * np.abs(sharp - flat).mean())

    def test_what_lies_between_nodes_is_penetration(self):
        # An arc of twice the spacing under the middle between two nodes: they keep out of it, the
        # line between them does not.
        radius = 2 * SPACING
        self.rows("ground.profile=[[-1, -0.5], [0, 0], [1, -0.5]]", f"ground.fillet={radius}",
                  "motion.height=[[0, 0.29], [0.004, 0.28]]", "motion.angular_velocity=0",
                  "motion.speed=0", f"motion.start_x={0.5 * SPACING}")
        arc = radius - np.sqrt(radius**2 - 0.25 * SPACING**2)
        self.assertGreater(summary(self.out)["penetration_max_m"], 0.8 * arc)
        self.assertLess(summary(self.out)["penetration_max_m"], 2.0 * arc)
        self.assertGreater(history(self.out)["penetration_max_m"][-1], 0.8 * arc)

    def test_rounding_of_a_flat_profile_changes_nothing_that_counts(self):
        flat = self.rows()
        x = np.linspace(-1, 1, 401)
        noise = np.random.default_rng(1).uniform(-1e-12, 1e-12, len(x))
        with open(self.folder / "road.csv", "w", newline="") as file:
            csv.writer(file).writerows(zip(x, noise))
        noisy = self.rows("ground.profile=road.csv")
        self.assertEqual(summary(self.out)["contact"]["clusters_solved"], 0)
        self.assertEqual(summary(self.out)["contact"]["pairs_solved"], 0)
        for name in ("force_x", "force_y"):
            error = np.abs(noisy[name] - flat[name]).max()
            self.assertLess(error, 1e-6 * np.abs(flat["force_y"]).max())

    def test_steps_that_know_nodes_alone_refuse_small_fillets(self):
        small = [POST, "ground.fillet=0.0005"]
        for settings in (['solver.contact_mass="singular"'],
                         ["solver.implicit=[{layers = [3]}]"]):
            more = [x for s in small + settings for x in ("--set", s)]
            done = run("check", self.case(), *more)
            self.assertEqual(done.returncode, 2, settings)
            self.assertIn("ground.fillet = 0.0005 m is below the 0.0471 m", done.stderr)
            self.assertIn("ground.fillet of at least 0.0471 m", done.stderr)


class InThreeDimensions(ProgramTest):
    def rows(self, *settings, text):
        out = self.folder / "out"
        more = [x for s in settings for x in ("--set", s)]
        done = run("run", self.case(text), "-o", out, "--quiet", "--overwrite", *more)
        self.assertEqual(done.returncode, 0, done.stderr)
        return history(out)

    def test_without_poissons_ratio_a_wheel_over_a_cleat_is_the_plane_disk(self):
        settings = ["material.poissons_ratio=0", "disk.mesh.circumferential=90", "time.end=0.08",
                    "motion.start_x=0.0105", "time.step=3e-5", "disk.width=0.1"]
        plane = CLEAT.replace("width = 0.10\n", "").replace("axial = 3\n", "")
        flat = self.rows(*settings[:-1], text=plane)
        solid = self.rows(*settings, text=CLEAT)
        self.assertGreater(summary(self.folder / "out")["contact"]["clusters_solved"], 100)
        for name in ("force_x", "force_y", "torque", "strain", "dissipation_friction"):
            error = np.abs(solid[name] - 0.1 * flat[name]).max()
            self.assertLess(error, 1e-9 * np.abs(solid[name]).max(), name)
        other = self.rows(*settings, "ground.friction=0.55", text=CLEAT)["force_x"]
        self.assertGreater(np.abs(other - solid["force_x"]).max(), 1.0)

    def test_the_peak_hardly_depends_on_where_the_nodes_are(self):
        peaks = []
        for place in (0.0, 0.003, 0.006, 0.009, 0.012):
            rows = self.rows(f"motion.start_x={place}", text=CLEAT)
            peaks.append(rows["force_y"][rows["time_s"] > 0.035].max())
        self.assertLess(max(peaks) - min(peaks), 0.05 * np.mean(peaks))
        self.assertGreater(max(peaks) - min(peaks), 1.0)

    def test_an_obstacle_between_nodes_is_told_with_its_size(self):
        done = run("check", self.case(CLEAT), "--set", "disk.mesh.circumferential=60")
        self.assertEqual(done.returncode, 0, done.stderr)
        for words in ("ground.profile", "0.01 m high", "(0.3, 0.01) m", "0.0314 m between"):
            self.assertIn(words, done.stderr)

    def test_a_start_with_an_obstacle_in_the_wheel_is_refused(self):
        post = POST.replace("0.1,", "0.001,").replace("0.102,", "0.003,")
        done = run("check", self.case(CLEAT), "--set", post, "--set", "disk.mesh.circumferential=60")
        self.assertEqual(done.returncode, 2, done.stderr)
        for words in ("motion.height", "0.02002 m deep inside the body", "between the nodes"):
            self.assertIn(words, done.stderr)

    def test_a_run_goes_on_bit_for_bit_over_a_corner(self):
        whole = self.rows("time.end=0.065", text=CLEAT)
        out = self.folder / "parts"
        parts = [run("run", self.case(CLEAT), "-o", out, "--set", "time.end=0.0602"),
                 run("run", out, "--resume", "--set", "time.end=0.065")]
        self.assertEqual([p.returncode for p in parts], [0, 0], parts[1].stderr)
        self.assertGreater(summary(out)["contact"]["clusters_solved"], 100)
        for name, column in history(out).items():
            self.assertTrue(np.array_equal(column, whole[name]), name)


if __name__ == "__main__":
    unittest.main()

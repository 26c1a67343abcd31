# SPDX-License-Identifier: BSD-3-Clause
"""Obstacles that are smaller than the contact nodes are apart: felt in the plane, refused or told of
in three dimensions; what lies between nodes counts as penetration; rounding makes no corners."""
import csv
import unittest

import numpy as np

from program import SMALL, ProgramTest, RunTest, history, run, summary
from test_solid import SECTION, TYRE, WHEEL

# 20 mm high, in front of the disk, which comes down beside it; nodes are 47 mm apart.
POST = "ground.profile=[[-9, 0], [0.1, 0], [0.1, 0.02], [0.102, 0.02], [0.102, 0], [9, 0]]"
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
    """Nodes 47 mm apart, of a section in 36 sectors 52 mm."""

    def said(self, *settings, text=WHEEL, code=2):
        (self.folder / "tyre.msh").write_text(SECTION)
        more = [x for s in settings for x in ("--set", s)]
        done = run("check", self.case(text), *more)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr

    def test_a_post_is_refused_with_its_sizes(self):
        said = self.said(POST, "ground.fillet=0.0005")
        for words in ("ground.profile", "0.02 m high", "0.0471 m", "(0.1005, 0.02) m",
                      "three dimensions"):
            self.assertIn(words, said)

    def test_a_fillet_below_the_spacing_is_refused_with_the_one_it_takes(self):
        step = "ground.profile=[[-9, -0.2], [0, -0.2], [0, 0], [9, 0]]"
        said = self.said(step, "ground.fillet=0.045", "motion.start_x=-0.6")
        for words in ("ground.fillet", "0.0471 m apart", "at least 0.0471 m",
                      "disk.mesh.circumferential of at least 42"):
            self.assertIn(words, said)
        told = self.said(step, "ground.fillet=0.0472", "motion.start_x=-0.6", code=0)
        self.assertIn("may stand 0.0063 m deep", told)
        told = self.said(step, "ground.fillet=0.0472", "motion.start_x=-0.6",
                         "disk.mesh.circumferential=320", code=0)
        self.assertNotIn("may stand", told)

    def test_the_spacing_of_a_section_is_that_of_its_sectors(self):
        cleat = "[ground]\nprofile = [[-9, -0.2], [0, -0.2], [0, 0], [9, 0]]\nfillet = {}\n"
        motion = TYRE.replace("speed = 0.0", "speed = 0.0\nstart_x = -0.6")
        said = self.said(text=motion + cleat.format(0.05))
        self.assertIn("0.0523 m apart", said)
        self.assertIn("section.sectors of at least 38", said)
        self.said(text=motion + cleat.format(0.053), code=0)


if __name__ == "__main__":
    unittest.main()

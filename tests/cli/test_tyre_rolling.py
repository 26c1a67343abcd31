# SPDX-License-Identifier: BSD-3-Clause
"""Lateral forces of a rolling tyre: samples of a sector and inertia against an independent calculation."""
import unittest

import numpy as np

from program import ROOT, run, summary
from test_tyre import MESH as FULL
from test_tyre import ROLLING, TyreTest

MESH = ROOT / "tests" / "meshes" / "tyre-205-55-r16-coarse.msh"
SPIN = 33.0  # rad/s
STEADY = ROLLING.replace(str(FULL), str(MESH)).replace("torque = 0.0\n", "").replace(
    "massless_contact = false\n", "").replace("angular_velocity = 0.01", f"angular_velocity = {SPIN}") + f"""
[damping]
mass = 150.0
stiffness = 1.5e-6
"""
DEGREE = np.pi / 180
RADIUS = {60: 0.3160220882654649, 120: 0.3160058174535423}  # inflated at SPIN, by sectors


class Samples(TyreTest):
    """1 degree of slip angle, 10 mm deep, as the design's prototype rolled: V = .3122 omega."""

    def steady(self, sectors, slip, samples, *settings):
        radius = RADIUS[sectors]
        done = run("run", self.case(STEADY), "-o", self.results, "--overwrite",
                   *(word for setting in (
                       f"section.sectors={sectors}",
                       f"motion.height={radius - 0.01!r}", f"motion.speed={0.3122 * SPIN!r}",
                       f"motion.slip_angle={DEGREE!r}", f"analysis.slip={slip}",
                       f"analysis.samples_per_sector={samples}", *settings)
                     for word in ("--set", setting)))
        self.assertEqual(done.returncode, 0, done.stderr)
        return summary(self.results)["steady"], done.stderr

    def test_quasi_static_as_an_independent_calculation(self):
        for slip, samples, force in (("upwind", 4, -811.7), ("upwind", 8, -795.0), ("bdf2", 4, -749.5),
                                     ("bdf2", 8, -772.5)):
            steady, _ = self.steady(60, slip, samples, "analysis.inertia=none",
                                    "analysis.estimate_slip_error=false")
            self.assertAlmostEqual(steady["force_lateral"] / force, 1.0, delta=5e-3, msg=(slip, samples))
            self.assertAlmostEqual(steady["force_y"] / 2189.0, 1.0, delta=2e-3)
            self.assertNotIn("slip_error", steady)

    def test_with_inertia_of_the_waves_as_an_independent_calculation(self):
        """Samples meet no resonance, however many there are."""
        for samples, force in ((1, -1062.9), (2, -812.4), (4, -788.5), (8, -774.2)):
            steady, _ = self.steady(60, "upwind", samples, "analysis.estimate_slip_error=false")
            self.assertAlmostEqual(steady["force_lateral"] / force, 1.0, delta=5.5e-3, msg=samples)
            self.assertAlmostEqual(steady["force_y"] / 2171.1, 1.0, delta=1e-2)

    def test_many_samples_at_a_load(self):
        """Of 90 sectors with 10 samples, where Newton's method cycled until it was given up."""
        done = run("run", self.case(STEADY.replace("height = 0.299968\n", "")), "-o", self.results,
                   *(word for setting in (
                       "section.sectors=90", f"motion.slip_angle={DEGREE!r}", "analysis.load=4000.0",
                       "analysis.torque=0.0", "analysis.slip=bdf2", "analysis.samples_per_sector=10",
                       "analysis.estimate_slip_error=false")
                     for word in ("--set", setting)))
        self.assertEqual(done.returncode, 0, done.stderr)
        steady = summary(self.results)["steady"]
        self.assertAlmostEqual(steady["force_y"], 4000.0, delta=1e-4)
        self.assertAlmostEqual(steady["force_lateral"], -1450.8, delta=0.5)  # of 12 samples -1452.4

    def test_the_error_of_the_slip_is_kept_and_warned_of(self):
        few, said = self.steady(60, "bdf2", 4)
        self.assertRegex(said, r"samples_per_sector = 4: the force along the ground differs by 8\.\d+ %")
        upwind, _ = self.steady(60, "upwind", 4, "analysis.estimate_slip_error=false")
        self.assertAlmostEqual(few["slip_error"]["force_lateral"],
                               upwind["force_lateral"] - few["force_lateral"], delta=1e-6)
        many, said = self.steady(60, "upwind", 16)
        self.assertNotIn("force along the ground differs", said)
        self.assertLess(many["slip_error"]["share"], 0.025)
        # The other formula gives the same difference.
        again, _ = self.steady(60, "upwind", 4)
        self.assertAlmostEqual(again["slip_error"]["share"], few["slip_error"]["share"], delta=1e-9)


if __name__ == "__main__":
    unittest.main()

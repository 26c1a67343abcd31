# SPDX-License-Identifier: BSD-3-Clause
"""Lateral forces of a rolling tyre: belts beside the middle, samples of a sector and inertia against an
independent calculation, steady rolling against the explicit step."""
import csv
import unittest

import numpy as np

from program import ROOT, run, summary
from test_tyre import GROUND, ROLLING, TYRE, TyreTest
from test_tyre import MESH as FULL

MESH = ROOT / "tests" / "meshes" / "tyre-205-55-r16-coarse.msh"
BELTS = ("belt-1", "belt-2")


def beside_the_middle(mesh, columns):
    """The text of a .msh file with its belts `columns` columns of elements farther towards +z."""
    lines = mesh.splitlines()
    words = [line.split() for line in lines]
    tags = {w[1] for w in words if len(w) == 3 and w[0] == "1" and w[2].strip('"') in BELTS}
    assert len(tags) == len(BELTS)
    for k, w in enumerate(words):
        if len(w) == 7 and w[1:3] == ["1", "2"] and w[3] in tags:  # an edge of a belt
            stride = int(w[6]) - int(w[5])  # from a column of nodes to the next
            lines[k] = " ".join(w[:5] + [str(int(n) + columns * stride) for n in w[5:]])
    return "\n".join(lines) + "\n"


class Conicity(TyreTest):
    def forces(self, columns):
        """Conicity and ply steer: the parts of the lateral force that keep and change their sign with
        the sense of rolling; and the same of the aligning moment."""
        mesh = self.folder / f"tyre{columns:+d}.msh"
        mesh.write_text(beside_the_middle(MESH.read_text(), columns))
        found = []
        for spin in (0.01, -0.01):
            out = self.folder / f"{columns:+d}{spin:+}"
            done = run("run", self.case(ROLLING.replace(str(FULL), str(mesh))), "-o", out, "--set",
                       f"motion.angular_velocity={spin}")
            self.assertEqual(done.returncode, 0, done.stderr)
            steady = summary(out)["steady"]
            found.append([steady["force_lateral"], steady["moment_aligning"]])
        there, back = np.array(found)
        return (there + back) / 2, (there - back) / 2

    def test_belts_in_the_middle_have_none(self):
        even, odd = self.forces(0)
        self.assertLess(odd[0], -50.0)
        self.assertLess(abs(even[0]), 1e-6 * abs(odd[0]))
        self.assertLess(abs(odd[1]), 1e-6 * abs(even[1]))

    def test_belts_beside_the_middle(self):
        """Belts towards +z leave the other shoulder to grow: the tyre is a cone that rolls towards +z. By
        the symmetry of the section, half a turn about the normal of the ground makes the tyre with its
        belts on the other side, rolled backwards."""
        even, odd = self.forces(1)
        even_left, odd_left = self.forces(-1)
        self.assertGreater(even[0], 100.0)
        self.assertLess(odd[0], -50.0)
        self.assertAlmostEqual(even_left[0] / even[0], -1.0, delta=1e-6)
        self.assertAlmostEqual(odd_left[0] / odd[0], 1.0, delta=1e-6)
        self.assertAlmostEqual(even_left[1] / even[1], 1.0, delta=1e-6)
        self.assertAlmostEqual(odd_left[1] / odd[1], -1.0, delta=1e-6)


SPIN = 33.0  # rad/s
STEADY = ROLLING.replace(str(FULL), str(MESH)).replace("torque = 0.0\n", "").replace(
    "massless_contact = false\n", "").replace("angular_velocity = 0.01", f"angular_velocity = {SPIN}") + f"""
[damping]
mass = 150.0
stiffness = 1.5e-6
"""
DEGREE = np.pi / 180


class Samples(TyreTest):
    """1 degree of slip angle, 10 mm deep, as the design's prototype rolled: V = .3122 omega."""

    def steady(self, sectors, slip, samples, *settings, degrees=1.0):
        radius = {60: 0.3160220882654649, 120: 0.3160058174535423}[sectors]
        done = run("run", self.case(STEADY), "-o", self.results, "--overwrite",
                   *(word for setting in (
                       f"section.sectors={sectors}", 
                       f"motion.height={radius - 0.01!r}", f"motion.speed={0.3122 * SPIN!r}",
                       f"motion.slip_angle={degrees * DEGREE!r}", f"analysis.slip={slip}",
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

    def test_the_error_of_the_slip_is_kept_and_warned_of(self):
        few, said = self.steady(60, "bdf2", 4)
        self.assertIn("samples_per_sector = 4: the force along the ground differs by 8.8 %", said)
        upwind, _ = self.steady(60, "upwind", 4, "analysis.estimate_slip_error=false")
        self.assertAlmostEqual(few["slip_error"]["force_lateral"],
                               upwind["force_lateral"] - few["force_lateral"], delta=1e-6)
        many, said = self.steady(60, "upwind", 16)
        self.assertNotIn("force along the ground differs", said)
        self.assertLess(many["slip_error"]["share"], 0.01)
        # The other formula gives the same difference.
        again, _ = self.steady(60, "upwind", 4)
        self.assertAlmostEqual(again["slip_error"]["share"], few["slip_error"]["share"], delta=1e-9)

    def explicit(self, sectors, end, degrees=1.0):
        """Mean force in the last fifth."""
        height = {60: 0.3160220882654649, 120: 0.3160058174535423}[sectors]
        case = TYRE.replace(str(FULL), str(MESH)).replace("sectors = 120", f"sectors = {sectors}") + GROUND + f"""
[damping]
mass = 150.0
stiffness = 1.5e-6
[motion]
angular_velocity = {SPIN}
speed = {0.3122 * SPIN!r}
slip_angle = {degrees * DEGREE!r}
height = [[0.0, {height + 1e-4!r}], [0.02, {height - 0.01!r}]]
[time]
end = {end}
[output]
snapshots = 0
history_interval = 1e-3
"""
        done = run("run", self.case(case), "-o", self.results, "--overwrite")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertLess(summary(self.results)["energy_residual_relative"], 1e-12)
        with open(self.results / "history.csv", newline="") as file:
            return np.mean([float(row["force_lateral"]) for row in csv.DictReader(file)
                            if float(row["time_s"]) > 0.8 * end])

    def test_the_explicit_step_of_an_independent_calculation(self):
        """-716.7 N; after 0.15 s it is within 1 % of that."""
        self.assertAlmostEqual(self.explicit(60, 0.15) / -716.7, 1.0, delta=1e-2)


if __name__ == "__main__":
    unittest.main()

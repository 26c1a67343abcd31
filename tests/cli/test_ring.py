# SPDX-License-Identifier: BSD-3-Clause
"""The undamped spin-up of cases/spin-up-undamped.toml against an axisymmetric solution that shares
nothing with the program (V10): both displacements of the edge over time. The tangential one is there
by the gyroscopic term alone."""
import unittest

import h5py
import numpy as np

from program import ROOT, ProgramTest, run
from ring_reference import Ring


def edge(directory):
    """(t,) s and (t, 2) m: mean radial and tangential displacement of the outer edge."""
    with h5py.File(directory / "results.h5") as file:
        nodes = file["mesh/boundary"][:]
        outward = file["mesh/coordinates"][:][nodes]
        outward = outward / np.linalg.norm(outward, axis=1)[:, None]
        ahead = np.stack([-outward[:, 1], outward[:, 0]], axis=1)
        u = file["snapshots/displacement"][:, nodes]
        return file["frame/time"][:], np.stack([np.einsum("tni,ni->t", u, outward),
                                                np.einsum("tni,ni->t", u, ahead)],
                                               axis=1) / len(nodes)


class SpinUp(ProgramTest):
    def test_the_reference_has_the_known_figures(self):
        ring = Ring(0.2, 0.3, 5e6, 0.45, 1100.0, -50.0, elements=120)
        self.assertAlmostEqual(ring.stationary[-2], 1.591599e-4, delta=2e-8)  # closed form, V9
        lowest = np.abs(ring._rates.imag).min()
        self.assertAlmostEqual(lowest, 475.447, delta=0.01)  # rotating frequency n = 0, V11

    def course(self, spin, layers):
        """Largest difference of either displacement from the reference over four periods, over its
        largest value."""
        out = self.folder / f"{spin}-{layers}"
        done = run("run", ROOT / "cases" / "spin-up-undamped.toml", "-o", out, "--quiet", "--set",
                   f"motion.angular_velocity={spin}", "--set", "time.end=0.012", "--set",
                   f"disk.mesh.radial={layers}", "--set",
                   f"disk.mesh.circumferential={15 * layers // 2}", "--set",
                   "output.snapshots=121", "--set", "output.stress=false")
        self.assertEqual(done.returncode, 0, done.stderr)
        times, ours = edge(out)
        expected = Ring(0.2, 0.3, 5e6, 0.45, 1100.0, -spin).edge(times)
        return np.abs(ours - expected).max(axis=0) / np.abs(expected).max(axis=0)

    def test_radial_and_tangential_course(self):
        for spin in (50.0, 100.0):
            coarse, fine = self.course(spin, 12), self.course(spin, 24)
            # Phases drift with the error of the mesh: 0.9 % after four periods, a third of it on
            # elements of half the size (but for the error of the reference, a tenth of a per cent).
            self.assertLess(coarse.max(), 0.012, spin)
            self.assertLess(fine.max(), 0.5 * coarse.max(), spin)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""Conicity: what a tyre with its belts beside the middle does, rolled forwards and backwards."""
import unittest

import numpy as np

from program import run, summary
from test_tyre import MESH as FULL
from test_tyre import ROLLING, TyreTest
from test_tyre_rolling import MESH

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
        self.assertAlmostEqual(even[0], 533.3, delta=0.5)
        self.assertAlmostEqual(odd[0], -140.1, delta=0.5)
        self.assertAlmostEqual(even_left[0] / even[0], -1.0, delta=1e-6)
        self.assertAlmostEqual(odd_left[0] / odd[0], 1.0, delta=1e-6)
        self.assertAlmostEqual(even_left[1] / even[1], 1.0, delta=1e-6)
        self.assertAlmostEqual(odd_left[1] / odd[1], -1.0, delta=1e-6)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""What the ledger closes to, by kind of body, scheme and analysis, and the bound that run.json names: round-off
and 1e-9 but for linear elastic bodies that nothing holds (docs/results.md, "What ends a run")."""
import re
import shutil
import unittest

from program import ROOT, SMALL, ProgramTest, replaced, run, summary
from test_hati import PARTS
from test_implicit import BELT, layers
from test_latin import CRUSH
from test_massless import MASSLESS
from test_mesh import TWO
from test_rubber import GENERAL, RUBBER
from test_solid import WHEEL
from test_steady import SMALL as STEADY

RIM = replaced(SMALL, "height", """height = 0.3
gravity = 9.81
[rim]
free = ["height", "angular_velocity"]
mass = 100.0
inertia = 1.0
force_y = [[0.0, 0.0], [0.005, -5.0e4]]""")
FREE_RUBBER = replaced(replaced(TWO, "youngs_modulus", 'model = "neo-hooke"\nshear_modulus = 1.7e6'),
                       "density = 2200", 'model = "neo-hooke"\nshear_modulus = 1.7e6\npoissons_ratio = 0.45\n'
                       "density = 2200")
HELD = {"symplectic": SMALL, "as-printed": replaced(SMALL, "end", 'end = 0.02\nscheme = "as-printed"'),
        "hati": PARTS, "implicit": BELT + layers(2), "contact nodes without mass": MASSLESS, "rim": RIM,
        "rubber": RUBBER, "rubber, general step": GENERAL, "three dimensions": WHEEL}
STATIC = {"crush, LATIN-PGD": CRUSH, "crush, LATIN": replaced(CRUSH, "solver", 'solver = "latin"'),
          "crush": replaced(CRUSH, "solver", None), "steady rolling": STEADY}


class Bounds(ProgramTest):
    def setUp(self):
        super().setUp()
        shutil.copy(ROOT / "cases" / "meshes" / "two-disks.msh", self.folder)

    def left(self, text, bound, *more):
        """What the ledger leaves of a run with that bound, which the program says as well."""
        done = run("run", self.case(text), "-o", self.folder / "out", "--overwrite", *more)
        self.assertEqual(done.returncode, 0, done.stderr)
        found = summary(self.folder / "out")
        self.assertEqual(found["energy_residual_bound"], bound)
        told = re.search(r"energy balance closes to (\S+) \(bound (\S+)\)", done.stderr)
        self.assertEqual((float(told[2]), told[1]), (bound, f"{found['energy_residual_relative']:.1e}"))
        return found["energy_residual_relative"]

    def test_round_off(self):
        for name, text in {**HELD, **STATIC, "free rubber": FREE_RUBBER}.items():
            with self.subTest(name):
                self.assertLess(self.left(text, 1e-9), 1e-11)

    def test_a_reduced_run(self):
        self.assertLess(self.left(SMALL, 1e-9, "--reduced"), 1e-11)

    def test_second_order_in_the_step_of_linear_bodies_that_nothing_holds(self):
        coarse, fine = (self.left(TWO, 1e-2, "--set", f"time.safety={safety}") for safety in (0.8, 0.4))
        self.assertGreater(coarse, 1e-9)  # no round-off: with the bound of held bodies it would fail
        self.assertAlmostEqual(coarse / fine, 4.0, delta=0.8)


if __name__ == "__main__":
    unittest.main()

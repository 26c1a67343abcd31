# SPDX-License-Identifier: BSD-3-Clause
"""What `rondo check` tells of a tyre: load, deflection, and numbers in other units."""
import re
import unittest

from program import replaced, run, said
from test_tyre import GROUND, MOVING, ROLLING, TyreTest

LOWERED = replaced(MOVING, "height", "height = [[0.0, 0.32], [0.002, 0.3]]") + GROUND
LOADED = replaced(replaced(ROLLING, "height", None), "massless_contact", "load = 4000.0").replace(
    "samples_per_sector = 1", "samples_per_sector = 2")


class Checked(TyreTest):
    """What `rondo check` tells of load and height before anything is solved."""

    def told(self, text, *settings):
        """The lines of the check by their labels, and what it warns of."""
        arguments = [word for setting in settings for word in ("--set", setting)]
        done = run("check", self.case(text), "--set", "section.sectors=12", "--set",
                   "inflation.steps=2", *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = dict(re.split(r" {2,}", line, maxsplit=1) for line in done.stdout.splitlines()
                     if not line.startswith(" ") and "  " in line)
        return lines, said(done)

    def test_a_tyre_that_is_lowered(self):
        lines, warned = self.told(LOWERED)
        self.assertRegex(lines["deflection"], r"^0\.01[56]\d* m, 1\d\.\d % of the 0\.1\d+ m of the wall$")
        self.assertRegex(lines["load"], r"^about (39|4\d)00 N, 0\.2\d of pressure times width times radius")
        self.assertNotIn("contact pressure", lines)  # that of a layer of rubber
        self.assertEqual(warned, "")

    def test_a_load_that_is_given(self):
        lines, warned = self.told(LOADED)
        self.assertRegex(lines["load"], r"^4000 N, 0\.28\d* of pressure .* bears it on 0\.0182 m2$")
        self.assertRegex(lines["deflection"],
                         r"^about 0\.016\d+ m, 1\d\.\d % of .* estimate by the air alone$")
        self.assertEqual(warned, "")

    def test_a_load_on_the_rim(self):
        weighing = [LOWERED, "motion.height=0.317", "motion.gravity=9.81"]
        lines, _ = self.told(*weighing, "rim={free=['height'], mass=400}")
        self.assertRegex(lines["load"], r"^40\d\d(\.\d+)? N, 0\.2[89]")  # with that of the tyre
        lines, _ = self.told(*weighing, "rim={free=['height'], mass=400, support={y={stiffness=1e4}}}")
        self.assertNotIn("load", lines)  # the spring bears a part

    def one_warning(self, text, fragment, *settings):
        _, warned = self.told(text, *settings)
        self.assertIn(fragment, warned)
        self.assertEqual(warned.count("warning"), 1, warned)

    def test_loads_and_pressures_in_other_units(self):
        self.one_warning(LOADED, "is the load in N, not in kN", "analysis.load=4")
        for pressure, fragment in ((2200, "the air cannot bear it; is the load in N"),
                                   (800, "inflation.pressure reaches 800 Pa at most")):
            self.one_warning(LOADED, fragment, f"inflation.pressure={pressure}")

    def test_heights_in_other_units(self):
        self.one_warning(LOWERED, "is the height in m, not in mm", "motion.height=276")
        self.one_warning(LOWERED, "starts 275.7 m above the ground", "motion.height=276",
                         "rim={free=['height'], mass=100, force_y=-4000}")

    def test_pressed_too_little(self):
        self.one_warning(LOWERED, "nothing presses it; give a smaller height", "motion.height=0.32")

    def test_pressed_too_deep(self):
        self.one_warning(LOWERED, "and tyres bear their load at 10 to 35 %",
                         "motion.height=[[0.0, 0.32], [0.002, 0.27]]")
        self.one_warning(LOADED, "the rim comes down by about 0.03", "analysis.load=9000")

    def test_beads_that_move_to_the_same_side(self):
        self.one_warning(LOWERED, "does inflation.mounting move its beads to opposite sides",
                         "inflation.mounting=[{curve='rim-left', axial=0.012}, "
                         "{curve='rim-right', axial=0.012}]")


if __name__ == "__main__":
    unittest.main()

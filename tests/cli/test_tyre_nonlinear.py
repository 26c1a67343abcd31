# SPDX-License-Identifier: BSD-3-Clause
"""Steps in time of a tyre whose cords and air are nonlinear, against an independent calculation."""
import re
import unittest

import h5py
import numpy as np

from program import history, run, summary
from test_tyre import MESH as FULL
from test_tyre import TYRE, TyreTest
from test_tyre_rolling import MESH

RADIUS = 0.31598535755  # m, inflated at rest: 90 sectors
COARSE = TYRE.replace(str(FULL), str(MESH)).replace("sectors = 120", "sectors = 90")
CORDS = ("--set", "inflation.nonlinear=cords")
WINDOW = ("--set", "inflation.nonlinear=window", "--set", f"inflation.window={35 * np.pi / 180!r}")
ALL = ("--set", "inflation.nonlinear=all")
# The law of the base in the words of Ogden's, which the readable step takes.
OGDEN = COARSE.replace("""surface = "base"
shear_modulus = 1500000.0
""", """surface = "base"
model = "ogden"
terms = [[1.5e6, 2.0]]
poissons_ratio = 0.48
""")


def standing(depth, end):
    """Comes down within half of the time, without friction."""
    return COARSE + f"""
[damping]
mass = 500.0
stiffness = 1.5e-6
[motion]
angular_velocity = 0.0
speed = 0.0
height = [[0.0, {RADIUS + 1e-4!r}], [{0.5 * end!r}, {RADIUS - depth!r}]]
[ground]
profile = "flat"
friction = 0.0
[time]
end = {end}
[output]
snapshots = 0
history_interval = 1e-3
"""


class Standing(TyreTest):
    def stands(self, depth, *more):
        """The load in the last fifth."""
        end = 0.045
        done = run("run", self.case(standing(depth, end)), "-o", self.results, "--overwrite", "--quiet", *more)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertLess(summary(self.results)["energy_residual_relative"], 1e-12)
        h = history(self.results)
        return np.mean(h["force_y"][h["time_s"] > 0.8 * end])


class Nonlinear(Standing):
    """At 5 mm: test_tyre_long.py."""

    def test_load_of_an_independent_calculation(self):
        """1860.33 N at 10 mm, with the rubber linear."""
        self.assertAlmostEqual(self.stands(10e-3, *CORDS) / 1860.33, 1.0, delta=1e-3)
        self.assertLess(summary(self.results)["integration_relative"], 1e-8)

    def test_load_with_all_nonlinear(self):
        """1800.09 N at 10 mm."""
        self.assertAlmostEqual(self.stands(10e-3, *ALL) / 1800.09, 1.0, delta=1e-3)
        self.assertNotIn("window_work", history(self.results))

    def test_load_with_rubber_in_a_window(self):
        """As with all of the rubber: away from the ground it strains little."""
        self.assertAlmostEqual(self.stands(10e-3, *WINDOW) / 1800.09, 1.0, delta=1e-3)
        self.assertLess(summary(self.results)["integration_relative"], 1e-6)
        self.assertEqual(np.abs(history(self.results)["window_work"]).max(), 0.0)

    def rolls(self, *more, text=COARSE):
        """Comes down while it turns by a tenth."""
        text = text + standing(10e-3, 0.02)[len(COARSE):].replace("[0.01, ", "[0.004, ").replace("friction = 0.0", "friction = 0.5")
        text = text.replace("angular_velocity = 0.0", "angular_velocity = 33.0").replace("speed = 0.0", "speed = 10.3")
        how = () if "--resume" in more else ("--overwrite",)
        done = run("run", self.case(text), "-o", self.results, "--quiet", *how, *more)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertLess(summary(self.results)["energy_residual_relative"], 1e-12)
        return history(self.results)

    def test_rubber_enters_and_leaves_a_window(self):
        """Its work is what the energy lacks, but for the error of the steps, of second order. A narrow window, whose
        edges are in rubber that is strained."""
        found = []
        for step in (4e-6, 2e-6):
            h = self.rolls(*WINDOW[:2], "--set", "inflation.window=0.2", "--set", f"time.step={step}")
            missing = h["internal_work"] + h["window_work"] - h["stored_energy"]
            found.append(abs(missing).max())
            self.assertGreater(abs(h["window_work"]).max(), 100.0 * found[-1])
            exchanged = missing[-1] / h["integration"][-1]
            self.assertGreater(exchanged, h["stored_energy"][-1])
        self.assertAlmostEqual(found[0] / found[1], 4.0, delta=0.4)

    def test_it_goes_on_to_the_same_bytes(self):
        """By the fused step, and by the one of Ogden's law."""
        for text, step in ((COARSE, "fused 3-D cyclic"), (OGDEN, "general 3-D")):
            window = (*WINDOW[:2], "--set", "inflation.window=0.05")
            whole = self.rolls(*window, "--set", "time.end=3e-3", text=text)["window_work"]
            self.assertNotEqual(whole[-1], 0.0)
            told = run("check", self.case(text + standing(10e-3, 0.02)[len(COARSE):]), *window).stdout
            self.assertRegex(told, f"integrator +{step}")
            whole = (self.results / "history.csv").read_bytes()
            self.rolls(*window, "--set", "time.end=2e-3", text=text)
            self.rolls(*window, "--set", "time.end=3e-3", "--resume", text=text)
            self.assertEqual((self.results / "history.csv").read_bytes(), whole)

    def test_it_stands_still_without_ground(self):
        text = COARSE + """
[motion]
angular_velocity = 33.0
speed = 10.3
height = 0.5
[time]
end = 2e-3
[output]
snapshots = 2
"""
        for nonlinear in (CORDS, WINDOW, ALL):
            done = run("run", self.case(text), "-o", self.results, "--overwrite", "--quiet", *nonlinear)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertNotIn("warning", done.stderr)
            self.assertEqual(summary(self.results)["integration_relative"], 0.0)
            self.assertLess(summary(self.results)["energy_residual_relative"], 1e-12)
            with h5py.File(self.results / "results.h5") as file:
                self.assertLess(np.abs(file["snapshots/displacement"][:]).max(), 1e-15)

    def test_the_error_of_integration_is_of_second_order(self):
        """As the tyre strikes the ground at 2 m/s, with half the step."""
        text = standing(4e-3, 4e-3)
        found = []
        for step in (4e-6, 2e-6):
            done = run("run", self.case(text), "-o", self.results, "--overwrite", "--quiet", "--set",
                       f"time.step={step}", *CORDS)
            self.assertEqual(done.returncode, 0, done.stderr)
            h = history(self.results)
            found.append(abs(h["integration"]).max())
        self.assertGreater(found[0], 1e-10)
        self.assertAlmostEqual(found[0] / found[1], 4.0, delta=0.8)

    def test_what_stays_linear_is_refused(self):
        text = standing(5e-3, 0.1)
        done = run("modes", self.case(text), "-o", self.results, "--standing", *CORDS)
        self.assertEqual(done.returncode, 2)
        self.assertIn("rondo run with nonlinear cords gives the load", done.stderr)
        done = run("check", self.case(text), *CORDS, "--set", "initial.state=stationary", "--set", "inflation.spin=20")
        self.assertEqual(done.returncode, 2)
        self.assertIn("initial.state", done.stderr)

    def test_the_step_is_that_of_taut_cords(self):
        """A cap that is slack in the inflated state, at a thousandth of its stiffness, is still one that may be
        stretched: without nonlinear cords it sets no step."""
        slack = ("--set", "cords[3].stiffness=2e5", "--set", "cords[3].compression=1e-3", "--set",
                 "cords[3].prestrain=-0.01")

        def critical(*words):
            done = run("check", self.case(standing(5e-3, 0.1)), *words)
            self.assertEqual(done.returncode, 0, done.stderr)
            return float(re.search(r"critical step +(\S+) s", done.stdout)[1])
        taut = critical("--set", "cords[3].stiffness=2e5")
        self.assertAlmostEqual(critical(*slack, *CORDS) / taut, 1.0, delta=0.02)
        self.assertGreater(critical(*slack), 1.5 * taut)


if __name__ == "__main__":
    unittest.main()

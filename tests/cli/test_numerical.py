# SPDX-License-Identifier: BSD-3-Clause
"""Runs that leave stability or the range of the numbers: warned of, refused (2) or ended (3) with
the reason. None is called done with NaN or infinities in its results."""
import math
import os
import unittest

import h5py
import numpy as np

from program import ProgramTest, ROOT, SMALL, corner_areas, history, replaced, run, summary

SPIN = (ROOT / "cases" / "spin-up-undamped.toml").read_text()
SPIN = replaced(replaced(SPIN, "radial", "radial = 4"), "circumferential", "circumferential = 60")
THROWN = (ROOT / "cases" / "thrown-disk.toml").read_text()
THROWN = replaced(replaced(THROWN, "radial", "radial = 2"), "circumferential",
                  "circumferential = 60")
CRUSH = (ROOT / "cases" / "crush-smooth.toml").read_text()
CRUSH = replaced(replaced(CRUSH, "radial", "radial = 3"), "circumferential", "circumferential = 60")

# V4's rod, held at its top and thrown against the ground.
ROD = '''schema = 1
title = "Rod"
[mesh]
file = "meshes/bar.msh"
clamped = "top"
contact = "foot"
[material]
youngs_modulus = 900.0
poissons_ratio = 0.0
density = 1.0
plane = "stress"
[motion]
angular_velocity = 0.0
speed = 0.0
height = 0.0
[ground]
profile = "flat"
[initial]
velocity = [0.0, -3.0]
[time]
end = 120.0
[output]
history_interval = 0.01
snapshots = 0
'''

# What (name, case, settings), exit code, fragments of the message.
EXTREMES = [
    ("velocity beyond doubles", SMALL, ["initial.velocity=[1e200,0]"], 3, ["velocity of node"]),
    ("velocity beyond floats", SMALL, ["initial.velocity=[1e40,0]"], 3, ["velocity of node", "step 0"]),
    ("a wild velocity", SMALL, ["initial.velocity=[1e20,0]"], 3, ["strain energy", "step "]),
    ("a wild gradient", SMALL, ["initial.displacement_gradient=[[1e200,0],[0,0]]",
                                "motion.height=10"], 3, ["displacement of node"]),
    ("spin", SMALL, ["motion.angular_velocity=1e200"], 2, ["the rim turns by"]),
    ("pressure beyond doubles", SMALL, ["load.pressure[0].curve=tread",
                                        "load.pressure[0].value=1e300"], 3, ["energy"]),
    ("pressure", SMALL, ["load.pressure[0].curve=tread", "load.pressure[0].value=1e30"], 3,
     ["strain energy"]),
    ("far away", SMALL, ["motion.start_x=1e300"], 2, ["motion.start_x", "resolve"]),
    ("fast", SMALL, ["motion.speed=1e308"], 2, ["motion.speed", "resolve"]),
    ("high", SMALL, ["motion.height=[[0,0.31],[0.02,1e300]]"], 2, ["motion.height", "resolve"]),
    ("a soft material", SMALL, ["material.youngs_modulus=1e-300"], 2, ["the rim turns by"]),
    ("a huge disk", SMALL, ["disk.outer_radius=3e200", "disk.inner_radius=1e200",
                            "motion.height=4e200"], 2, ["disk.outer_radius", "range"]),
    ("a tiny disk", SMALL, ["disk.outer_radius=3e-200", "disk.inner_radius=1e-200"], 2,
     ["disk.outer_radius", "range"]),
    ("thrown", THROWN, ["initial.velocity=[1e300,0]"], 2, ["initial.velocity", "resolve"]),
    ("placed", THROWN, ["initial.position=[1e40,0.3]"], 2, ["initial.position", "resolve"]),
    ("whirled", THROWN, ["initial.angular_velocity=1e6"], 2,
     ["initial.angular_velocity", "rad in a step"]),
    ("gravity", THROWN, ["motion.gravity=1e300"], 3, ["is not finite"]),
    ("crush of a stiff disk", CRUSH, ["material.youngs_modulus=1e45"], 3, ["stress", "increment 1"]),
    ("crush beyond doubles", CRUSH, ["material.youngs_modulus=1e300"], 3, ["range", "increment 1"]),
    ("slide", CRUSH, ["analysis.slide=1e300", "analysis.slide_increments=3"], 3, ["increment"]),
]


def not_finite(folder):
    """Names of what is NaN or infinite in the results of a run."""
    found = []
    with h5py.File(folder / "results.h5") as f:
        f.visititems(lambda name, o: found.append(name) if isinstance(o, h5py.Dataset)
                     and o.dtype.kind == "f" and not np.isfinite(o[...]).all() else None)
    found += [name for name, column in history(folder).items() if not np.isfinite(column).all()]
    return found


# A spike that the disk comes onto by more in a step than a corner of the ground may be deep: the
# contact is lost, and found from inside where the spike leaves the disk.
SPIKE = ["disk.mesh.radial=4", "disk.mesh.circumferential=60", "motion.height=0.305",
         "motion.angular_velocity=0", "motion.speed=400", "time.end=0.003", "output.snapshots=0",
         "ground.profile=[[-10,0],[0.5,0],[0.502,0.08],[0.504,0],[10,0]]"]


class LateContact(ProgramTest):
    def test_a_contact_found_late_ends_the_run(self):
        sets = [word for setting in SPIKE for word in ("--set", setting)]
        out = self.folder / "out"
        done = run("run", ROOT / "cases" / "rolling-flat.toml", "-o", out, "--quiet", *sets)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("step 17 of 30, t = 0.0017", done.stderr)
        self.assertIn("a contact begins 0.00841 m deep at (0.502, 0.08) m: it was inside",
                      done.stderr)
        self.assertEqual(history(out)["time_s"][-1], summary(out)["end_time"])


class Extremes(ProgramTest):
    def test_extremes(self):
        for number, (what, text, settings, code, fragments) in enumerate(EXTREMES):
            with self.subTest(what):
                out = self.folder / f"out-{number}"
                given = [word for s in settings for word in ("--set", s)]
                done = run("run", self.case(text), "-o", out, "--quiet", *given,
                           env={**os.environ, "RONDO_TRAPS": "off"})  # it is to say so itself
                self.assertEqual(done.returncode, code, done.stderr)
                for fragment in fragments:
                    self.assertIn(fragment, done.stderr)
                self.assertEqual(out.exists(), code == 3)
                if code == 3:
                    s = summary(out)
                    self.assertEqual(s["status"], "failed")
                    self.assertIn(s["message"], done.stderr)
                    with h5py.File(out / "results.h5") as f:  # it opens, and times are numbers
                        self.assertTrue(np.isfinite(f["/frame/time"][...]).all())

    def test_a_run_that_is_done_has_numbers_only(self):
        for text in (SMALL, replaced(THROWN, "end", "end = 0.02"), CRUSH):
            out = self.folder / "out"
            done = run("run", self.case(text), "-o", out, "--quiet", "--overwrite")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(not_finite(out), [])


class Stability(ProgramTest):
    def said(self, text, *settings):
        """What `rondo check` warns of."""
        done = run("check", self.case(text), *[w for s in settings for w in ("--set", s)])
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stderr

    def ends(self, text, name, *settings):
        """How `rondo run` ends, and its run.json."""
        text = text.replace('"meshes/', f'"{ROOT / "cases" / "meshes"}/')
        out = self.folder / name
        done = run("run", self.case(text), "-o", out, *[w for s in settings for w in ("--set", s)])
        return done, summary(out)

    def test_beyond_the_softening_limit(self):
        """The lowest frequency of the mesh is 476.1 rad/s (docs/reliability.md)."""
        self.assertEqual(self.said(SPIN, "motion.angular_velocity=237"), "")
        soft = self.said(SPIN, "motion.angular_velocity=300")
        self.assertIn("more than a quarter", soft)
        self.assertNotIn("beyond", soft)
        beyond = self.said(SPIN, "motion.angular_velocity=500")
        for fragment in ("500 rad/s", "beyond the softening limit", "exit code 3", "stress_stiffening"):
            self.assertIn(fragment, beyond)
        low, high = (float(word) for word in
                     beyond.split("at rest is ")[1].split(" rad/s")[0].split(" to "))
        self.assertLessEqual(low, 476.2)
        self.assertGreaterEqual(high, 476.0)
        self.assertLess(high - low, 5.0)
        # A table that comes there later; one that would after the end of the run.
        table = "motion.angular_velocity=[[0,0],[1,600]]"
        self.assertIn("600 rad/s", self.said(SPIN, table, "time.end=1"))
        self.assertNotIn("beyond", self.said(SPIN, table, "time.end=0.7"))
        self.assertEqual(self.said(SPIN, "motion.angular_velocity=500",
                                   "material.stress_stiffening=centrifugal"), "")

    def test_the_run_beyond_it_ends_by_itself(self):
        out = self.folder / "out"
        text = replaced(replaced(SPIN, "angular_velocity", "angular_velocity = 500.0"), "end",
                        "end = 2.0")
        done = run("run", self.case(text), "-o", out, "--quiet")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertRegex(done.stderr, "strain energy|is inverted")
        self.assertEqual(not_finite(out), [])
        self.assertLess(summary(out)["end_time"], 0.5)

    def test_strains_of_a_run_are_told(self):
        """The rim comes down by 2/3 of the rubber; on to where cells turn inside out."""
        deep = replaced(SMALL, "height", "height = [[0, 0.3], [0.015, 0.2]]")
        self.assertIn("66.7 % of the 0.15 m", self.said(deep))
        out = self.folder / "out"
        done = run("run", self.case(deep), "-o", out, "--quiet")
        s = summary(out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"the largest strain is {s['strain_max']:.3g}", done.stderr)
        self.assertIn("66.7 % of the 0.15 m", s["warnings"][0])  # of before the first step
        self.assertIn("above 10 % results are rough", s["warnings"][-1])
        self.assertGreater(s["strain_max"], 0.4)
        self.assertLess(s["jacobian_min"], 0.6)
        with h5py.File(out / "results.h5") as f:
            cells, x = f["/mesh/cells"][:], f["/mesh/coordinates"][:]
            u, t = f["/snapshots/displacement"][:], f["/frame/time"][:]
        corner = corner_areas(x + u, cells) / corner_areas(x, cells)[:, np.newaxis]
        looked = np.abs(t - s["jacobian_min_time"]).argmin()  # at a snapshot
        self.assertAlmostEqual(s["jacobian_min"], corner[:, looked].min(), delta=1e-12)
        self.assertAlmostEqual(s["jacobian_min_time"], t[looked], delta=1e-12)
        self.assertLess(s["jacobian_min"], corner.min() + 0.05)
        shallow = run("run", self.case(SMALL), "-o", out, "--quiet", "--overwrite")
        self.assertEqual(shallow.stderr, "")
        self.assertTrue(0.01 < summary(out)["strain_max"] < 0.1)

    def test_an_inverted_cell_ends_the_run(self):
        out = self.folder / "out"
        through = replaced(SMALL, "height", "height = [[0, 0.3], [0.015, 0.152]]")
        done = run("run", self.case(through), "-o", out, "--quiet")
        self.assertEqual(done.returncode, 3, done.stderr)
        s = summary(out)
        self.assertIn(f"cell {s['jacobian_min_cell']} of /mesh/cells near", done.stderr)
        self.assertIn("is inverted", done.stderr)
        self.assertIn(f"t = {s['jacobian_min_time']:.9g} s", done.stderr)
        self.assertLessEqual(s["jacobian_min"], 0.0)

    def test_an_inverted_corner_ends_the_run(self):
        """Of a cell whose area is positive: J = 0.15 at its center."""
        ledge = (ROOT / "cases" / "ledge-smooth.toml").read_text()
        done, s = self.ends(ledge, "ledge", "motion.height=0.22", "output.snapshots=60")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("is inverted", done.stderr)
        self.assertLessEqual(s["jacobian_min"], 0.0)

    def test_steps_near_the_critical_one_with_contact(self):
        undamped = replaced(SMALL, "stiffness", "stiffness = 0.0")
        self.assertIn("of the critical one", self.said(undamped, "time.safety=0.99"))
        self.assertEqual(self.said(undamped, "time.safety=0.98"), "")
        self.assertEqual(self.said(SMALL, "time.safety=0.99"), "")  # damped
        self.assertEqual(self.said(SPIN, "time.safety=0.99"), "")  # no contact
        self.assertIn("ground.impact = \"energy-safe\"", self.said(undamped, "time.safety=0.99"))
        self.assertEqual(self.said(undamped, "time.safety=0.99", "ground.impact=energy-safe"), "")

    def test_energy_from_impacts(self):
        created, s = self.ends(ROD, "moreau", "time.safety=0.999")
        self.assertEqual(created.returncode, 3, created.stderr)
        self.assertIn("impacts have created energy", s["message"])
        for cure in ("ground.impact = \"energy-safe\"", "a smaller time.safety"):
            self.assertIn(cure, s["message"])
        for restitution in ("0.0", "0.8"):
            safe, s = self.ends(ROD, restitution, "time.safety=0.999", "ground.impact=energy-safe",
                                f"ground.restitution={restitution}")
            self.assertEqual(safe.returncode, 0, safe.stderr)
            self.assertNotIn("impacts", " ".join(s["warnings"]))  # strains are large
            energy = history(self.folder / restitution)
            energy = energy["kinetic"] + energy["strain"]
            self.assertLess(energy.max(), energy[0] * (1.0 + 1e-12))

    def test_boundary_that_may_not_touch(self):
        text = (ROOT / "cases" / "bouncing-bar.toml").read_text()
        topples = ["time.end=13", "output.snapshots=0", "output.history_interval=0.01"]
        done, s = self.ends(text, "foot", *topples, "mesh.contact=foot")
        self.assertEqual(done.stderr.count("in the ground and nothing stops it"), 1, done.stderr)
        [warning] = [w for w in s["warnings"] if "in the ground" in w]
        for part in ("t = ", "node ", "mesh.contact = \"foot\"", "\"sides\""):
            self.assertIn(part, warning)
        # At 12 s it lies on its side and the corner of a cell is inverted.
        done, s = self.ends(text, "boundary", *topples[1:], "time.end=11")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("in the ground", " ".join(s["warnings"]))

    def test_growth_of_the_scheme_as_printed(self):
        said = self.said(SPIN, "time.scheme=as-printed", "time.end=20")
        self.assertIn("creates energy", said)
        rate = float(said.split("grow at up to ")[1].split()[0])
        critical = 2.0 / float(said.split("waves of ")[1].split()[0])
        self.assertTrue(math.isclose(rate, 50.0 * 0.8, rel_tol=1e-2), rate)  # s ω Δt/2 at 0.8
        self.assertGreater(critical, 0.0)
        self.assertEqual(self.said(SPIN, "time.scheme=as-printed"), "")
        self.assertEqual(self.said(SPIN, "time.scheme=as-printed", "time.end=20",
                                   "damping.mass=100"), "")

    def test_contact_at_the_speed_of_waves(self):
        fast = self.said(SMALL, "motion.speed=500", "motion.angular_velocity=1666")
        self.assertIn("half the shortest edge", fast)
        self.assertNotIn("half the shortest edge", self.said(SMALL, "motion.speed=50"))


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""rondo reduce from steady states, alone and beside a run in time; what does not fit is refused."""
import re
import unittest

import h5py
import numpy as np

from program import ROOT, ProgramTest, history, replaced, run

STATE = (ROOT / "cases" / "steady-rolling.toml").read_text()
FLAT = (ROOT / "cases" / "rolling-flat.toml").read_text()
START = replaced(replaced(FLAT, "height", "height = 0.29"), "state", 'state = "steady-rolling"')
STUDY = """schema = 1
base = "state.toml"
set = ["output.stress=false", "analysis.samples_per_sector={}"]
snapshots = {}
[[vary]]
key = "ground.friction"
values = [0.2, 0.5]
[[vary]]
key = "motion.height"
values = [0.286, 0.294]
[[vary]]
key = "motion.angular_velocity"
values = [32.5, 33.3, 34.2]
"""


class Reduce(ProgramTest):
    def setUp(self):
        super().setUp()
        self.case(STATE, "state.toml")

    def done(self, *arguments):
        done = run(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def states(self, samples=4, snapshots="true"):
        out = self.folder / f"states{samples}{snapshots}"
        self.done("sweep", self.case(STUDY.format(samples, snapshots), "study.toml"), "-o", out)
        return out

    def transient(self):
        out = self.folder / "transient"
        self.done("run", self.case(START, "start.toml"), "-o", out, "--quiet", "--set", "time.end=0.02",
                  "--set", "output.snapshots=60", "--set", "output.stress=false")
        return out

    def reduce(self, *arguments):
        return self.done("reduce", *arguments, "--quiet", "-o", self.folder / "model.h5").stdout

    def forces(self, *arguments):
        """Means over the last quarter."""
        self.done("run", self.folder / "case.toml", "-o", self.folder / "out", "--quiet", "--overwrite",
                  "--set", "output.snapshots=0", *arguments)
        h = history(self.folder / "out")
        late = h["time_s"] > 0.75 * h["time_s"][-1]
        return np.array([h["force_x"][late].mean(), h["force_y"][late].mean()])

    def test_states_predict_runs_that_are_none_of_them(self):
        said = self.reduce(self.states())
        self.assertIn("30 modes of 48 snapshots", said)
        estimate = [float(x) for x in re.search(r"F_x (\S+) %, F_y (\S+) % of F_y \(twice the largest of 12 ",
                                                said).groups()]
        self.case(FLAT)
        for friction, most_x in ((0.3, 1.5), (0.15, 2.0)):
            setting = ["--set", f"ground.friction={friction}"]
            full = self.forces(*setting)
            x, y = 100 * (self.forces(*setting, "--reduced", self.folder / "model.h5") - full) / full[1]
            self.assertLess(abs(x), most_x)
            self.assertLess(abs(y), 0.6)
            self.assertLess(abs(x), estimate[0])
        with h5py.File(self.folder / "model.h5") as f:
            self.assertEqual(f["errors/force"].shape, (12, 2))
            np.testing.assert_allclose(f["ranges/height"][:], [0.286, 0.294], rtol=1e-12)
            np.testing.assert_allclose(f["ranges/speed"][:], [10, 10], rtol=1e-12)
            np.testing.assert_allclose(f["ranges/friction"][:], [0.2, 0.5], rtol=1e-12)
            np.testing.assert_allclose(f["ranges/slip_ratio"][:], [9.75 / 10 - 1, 1 - 10 / 10.26], rtol=1e-9)

    def test_a_reduced_run_starts_in_steady_rolling(self):
        self.reduce(self.states(), "--no-error-estimate")
        self.case(START)
        # Of 2 ms; a run in time has -21,997 and 189,838 N/m once it has settled (friction 0.4).
        x, y = self.forces("--reduced", self.folder / "model.h5", "--set", "time.end=2e-3", "--set",
                           "output.history_interval=0", "--set", "ground.friction=0.4")
        self.assertAlmostEqual(x, -21997, delta=0.01 * y)
        self.assertAlmostEqual(y, 189838, delta=0.005 * y)

    def test_height_and_speed_that_are_results_are_the_range(self):
        out = self.folder / "run"
        text = replaced(replaced(STATE, "speed", None), "height", None)
        self.done("run", self.case(text), "-o", out, "--quiet", "--set", "analysis.load=1.5e5", "--set",
                  "analysis.traction=-1e4")
        self.reduce(out)
        with h5py.File(self.folder / "model.h5") as f:
            self.assertTrue(np.all(f["ranges/height"][:] > 0.29))
            self.assertTrue(np.all(f["ranges/height"][:] < 0.3))
            self.assertTrue(np.all(np.abs(f["ranges/speed"][:] - 10) < 0.3))

    def test_beside_a_run_in_time_states_count_as_much_in_all(self):
        """However many samples they have: what few modes leave out is the same share."""
        transient = self.transient()
        left = []
        for samples in (4, 16):
            said = self.reduce(self.states(samples), transient, "--displacement-modes", 4,
                               "--no-error-estimate", "--from", 0.001)  # no window for states
            n = int(re.search(r"displacement +4 modes of (\d+) snapshots", said).group(1))
            self.assertGreater(n - 12 * samples, 40)
            left.append(float(re.search(r"leave (\S+) of the energy", said).group(1)))
        self.assertAlmostEqual(left[1] / left[0], 1.0, delta=0.03, msg=str(left))

    def test_the_estimate_leaves_both_kinds_out(self):
        other = self.folder / "run"
        self.done("run", self.case(STATE), "-o", other, "--quiet")
        said = self.reduce(self.states(2), other, self.transient())
        self.assertIn("twice the largest of 13 runs", said)

    def refuse(self, part, *arguments):
        done = run("reduce", *arguments, "-o", self.folder / "no.h5")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn(part, done.stderr)
        self.assertFalse((self.folder / "no.h5").exists())

    def test_wrong_use(self):
        out = self.folder / "run"
        one = ["run", self.case(STATE), "-o", out, "--quiet", "--overwrite", "--set"]
        self.refuse("is a sweep without snapshots", self.states(2, "false"))
        self.done(*one, "load.pressure=[{curve='tread', value=1e5}]")
        self.refuse("does not support pressures", out)
        self.done(*one, "analysis.samples_per_sector=1")
        self.refuse("1 snapshots of the runs", out)
        self.done(*one, "output.stress=false")
        self.refuse("one angle of the turn", out, "--frame", "co-rotating")
        self.done("run", self.case(replaced(STATE, "radial", "radial = 6")), "-o", self.folder / "other", "--quiet")
        self.refuse("not the body of", out, self.folder / "other")


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""Reduced runs on a rim that moves by itself: built from loads, another load predicted."""
import pathlib
import tempfile
import unittest

import h5py
import numpy as np

from program import ProgramTest, SMALL, history, replaced, run, summary

PARTS = ["--displacement-modes", 20, "--velocity-modes", 20]
RIM = """[rim]
free = ["height", "angular_velocity"]
mass = 100.0
inertia = 1.0
force_y = [[0, 0], [0.01, -1.5e5]]
[rim.support.y]
damping = 6.0e4
"""
RIM_COLUMNS = ["spin_rad_s", "speed_x", "speed_y", "hub_force_x", "hub_torque", "kinetic_rim",
               "support_energy", "work_gravity", "work_rim_load", "work_torque", "work_held",
               "dissipation_brake", "dissipation_support"]


def case():
    """6×90, at its load from 0.01 s on, to 0.1 s."""
    text = replaced(replaced(SMALL, "radial", "radial = 6"), "circumferential",
                    "circumferential = 90")
    text = replaced(replaced(text, "height", "height = 0.3"), "angular_velocity",
                    "angular_velocity = 33.7")
    text = replaced(replaced(text, "snapshots", "snapshots = 201"), "end", "end = 0.1")
    return replaced(text, "friction", "friction = 0.6") + RIM


def load(force):
    return f"rim.force_y=[[0,0],[0.01,-{force}]]"


class ReducedRim(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.shared = pathlib.Path(folder.name)
        cls.case_file = cls.shared / "case.toml"
        cls.case_file.write_text(case())
        for force in ("1.2e5", "1.5e5", "1.8e5"):
            cls.made("run", cls.case_file, "-o", cls.shared / force, "--set", load(force))
        cls.model = cls.shared / "model.h5"
        cls.made("reduce", cls.shared / "1.2e5", cls.shared / "1.8e5", "-o", cls.model, *PARTS)

    @classmethod
    def made(cls, *arguments):
        done = run(*arguments)
        assert done.returncode == 0, done.stderr
        return done

    def reduced(self, *arguments, code=0, model=None):
        out = self.folder / "out"
        done = run("run", self.case_file, "--reduced", model or self.model, "-o", out,
                   "--overwrite", *arguments)
        self.assertEqual(done.returncode, code, done.stderr)
        return out, done

    def means(self, directory):
        h = history(directory)
        late = h["time_s"] > 0.07
        return {name: column[late].mean() for name, column in h.items()}

    def test_a_load_between_those_it_was_built_from(self):
        out, done = self.reduced()
        self.assertNotIn("the model was built from", done.stderr)
        a, b = self.means(self.shared / "1.5e5"), self.means(out)
        self.assertEqual(list(history(out)), list(history(self.shared / "1.5e5")))
        scale = a["force_y"]
        self.assertLess(abs(b["force_y"] - a["force_y"]), 0.005 * scale)
        self.assertLess(abs(b["force_x"] - a["force_x"]), 0.01 * scale)
        self.assertLess(abs(b["center_y_m"] - a["center_y_m"]), 0.001 * 0.3)
        self.assertLess(abs(b["spin_rad_s"] - a["spin_rad_s"]), 0.01 * 33.7)
        j = summary(out)
        self.assertLess(j["energy_residual_relative"], 1e-12)
        self.assertEqual(j["status"], "done")
        h = history(out)
        for name in RIM_COLUMNS:
            self.assertIn(name, h)
        self.assertEqual(h["speed_x"].max(), 10.0)
        for name in ("work_frame", "work_rim", "hub_torque"):
            self.assertEqual(abs(h[name]).max(), 0.0)
        self.assertGreater(h["dissipation_support"][-1], 0.0)

    def test_ranges_are_what_the_runs_did(self):
        with h5py.File(self.model) as f:
            spin, height = f["/ranges/angular_velocity"][:], f["/ranges/height"][:]
        low = [history(self.shared / run)["center_y_m"].min() for run in ("1.2e5", "1.8e5")]
        self.assertAlmostEqual(height[0], min(low), places=12)
        self.assertLess(spin[0], spin[1])
        _, done = self.reduced("--set", load("2.2e5"))
        self.assertIn("the height of the rim is", done.stderr)
        self.assertEqual(done.stderr.count("the height of the rim is"), 1)

    def test_velocities_of_snapshots_turn_with_the_half_step(self):
        out, _ = self.reduced()
        with h5py.File(out / "results.h5") as f:
            angle, before = f["/frame/angle"][:], f["/frame/angle_velocity"][:]
            time, half = f["/frame/time"][:], f["/frame/time_velocity"][:]
        spin = np.interp(time, *[history(out)[c] for c in ("time_s", "spin_rad_s")])
        np.testing.assert_allclose((angle - before)[1:], -(spin * (time - half))[1:], rtol=0.01)

    def test_brake_to_a_stop(self):
        out, _ = self.reduced("--set", "rim.brake=[[0,0],[0.02,0],[0.04,1e5]]")
        h = history(out)
        locked = h["spin_rad_s"] == 0.0
        self.assertTrue(locked[-1])
        self.assertEqual(len(set(h["angle_rad"][locked])), 1)
        self.assertGreaterEqual(h["spin_rad_s"].min(), 0.0)
        self.assertAlmostEqual(-h["force_x"][-1] / h["force_y"][-1], 0.6, places=6)
        self.assertLess(summary(out)["energy_residual_relative"], 1e-12)

    def test_models_of_driven_and_of_free_runs_serve_both(self):
        text = self.case_file.read_text()
        driven = self.folder / "driven.toml"
        driven.write_text(replaced(text[:text.index("[rim]")], "height",
                                   "height = [[0, 0.3], [0.01, 0.2917]]"))
        self.made("run", driven, "-o", self.folder / "driven")
        # The free model on a driven case.
        self.made("run", driven, "--reduced", self.model, "-o", self.folder / "reduced")
        a, b = self.means(self.folder / "driven"), self.means(self.folder / "reduced")
        self.assertLess(abs(b["force_y"] - a["force_y"]), 0.02 * a["force_y"])
        # And the other way round.
        model = self.folder / "driven.h5"
        self.made("reduce", self.folder / "driven", "-o", model, *PARTS)
        out, _ = self.reduced(model=model)
        a, b = self.means(self.shared / "1.5e5"), self.means(out)
        self.assertLess(abs(b["force_y"] - a["force_y"]), 0.02 * a["force_y"])
        self.assertLess(abs(b["center_y_m"] - a["center_y_m"]), 0.002 * 0.3)

    def test_refused_with_what_to_do(self):
        for arguments, words in (
                (["--reduced-step", "explicit"], ["--reduced-step", "[rim]", "midpoint"]),
                (["--resume"], ["--resume", "no checkpoints"])):
            done = run("run", self.case_file, "--reduced", self.model, "-o", self.folder / "no",
                       *arguments)
            self.assertEqual(done.returncode, 2)
            for word in words:
                self.assertIn(word, done.stderr)
        turning = self.folder / "turning.h5"
        self.made("reduce", self.shared / "1.5e5", "-o", turning, *PARTS, "--frame", "co-rotating")
        _, done = self.reduced(model=turning, code=2)
        for word in ("--reduced", "co-rotating", "[rim]", "rectified"):
            self.assertIn(word, done.stderr)


if __name__ == "__main__":
    unittest.main()

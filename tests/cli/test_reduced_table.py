# SPDX-License-Identifier: BSD-3-Clause
"""The table of docs/reduced.md: a rolling disk, 12×180, predicted from runs with other frictions,
heights, speeds and spins, at twenty times the step, against the full model."""
import unittest

import numpy as np

from program import ProgramTest, ROOT, history, run, summary

CASE = ROOT / "cases" / "rolling-flat.toml"
ROLLING = 10.0 / 0.3


def height(h):
    return f"motion.height=[[0.0, 0.31], [0.02, {h}]]"


def spin(share):
    return f"motion.angular_velocity={ROLLING * share!r}"


def speed(v):
    return [f"motion.speed={v}", f"motion.angular_velocity={v / 0.3!r}"]


# Runs that a model is built from, and what it predicts.
ROWS = {
    "friction": ([["ground.friction=0"], ["ground.friction=0.6"]],
                 [["ground.friction=0.3"], ["ground.friction=0.15"]]),
    "height": ([[height(0.285)], [height(0.295)]], [[height(0.29)]]),
    "speed": ([speed(8), speed(12)], [speed(10)]),
    "spin": ([[spin(0.95)], [spin(1.05)]], [[spin(1.0)], [spin(1.02)]]),
}

# What the design of the method was measured to reach; ours is about half of it.
NORMAL, TANGENTIAL = 0.006, 0.025  # both of the mean vertical force


class Table(ProgramTest):
    def made(self, command, *arguments, settings=()):
        done = run(command, *arguments, *(x for s in settings for x in ("--set", s)))
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def forces(self, directory):
        """Means over the last quarter, and fluctuations."""
        h = history(directory)
        late = h["time_s"] > 0.75 * h["time_s"][-1]
        return [np.array([h[k][late].mean(), h[k][late].std()]) for k in ("force_x", "force_y")]

    def row(self, name):
        built, predicted = ROWS[name]
        runs = [self.folder / f"run{k}" for k in range(len(built))]
        for directory, settings in zip(runs, built):
            self.made("run", CASE, "-o", directory, "--quiet",
                      settings=settings + ["output.stress=false"])
        model = self.folder / "model.h5"
        self.made("reduce", *runs, "-o", model, "--quiet")
        for k, settings in enumerate(predicted):
            settings = settings + ["output.snapshots=0"]
            full, reduced = self.folder / f"full{k}", self.folder / f"reduced{k}"
            self.made("run", CASE, "-o", full, "--quiet", settings=settings)
            said = self.made("run", CASE, "-o", reduced, "--reduced", model, "--quiet",
                             settings=settings)
            self.assertEqual(said.stderr, "")  # within the range of the model
            self.assertEqual(summary(reduced)["step_factor"], 20)
            self.assertLess(summary(reduced)["energy_residual_relative"], 1e-11)
            self.assertLess(summary(reduced)["contact_residual_max"], 1e-11)
            (fx, fy), (x, y) = self.forces(full), self.forces(reduced)
            print(f"{name} {settings[0]}: F_y {100 * (y[0] / fy[0] - 1):.2f} %, F_x "
                  f"{100 * (x[0] - fx[0]) / fy[0]:.2f} % of F_y; fluctuation of F_y {y[1]:.0f} "
                  f"({fy[1]:.0f}), of F_x {x[1]:.0f} ({fx[1]:.0f}) N/m")
            self.assertLess(abs(y[0] / fy[0] - 1), NORMAL)
            self.assertLess(abs(x[0] - fx[0]) / fy[0], TANGENTIAL)
            # Points that stand still in space are not passed one by one: it is quieter.
            self.assertLess(y[1], 0.005 * fy[0])
            self.assertLess(x[1], 0.005 * fy[0])

    def test_friction(self):
        self.row("friction")

    def test_height(self):
        self.row("height")

    def test_speed(self):
        self.row("speed")

    def test_spin(self):
        self.row("spin")

    def test_result_does_not_depend_on_the_step(self):
        runs = [self.folder / name for name in ("a", "b")]
        for directory, friction in zip(runs, (0, 0.6)):
            self.made("run", CASE, "-o", directory, "--quiet",
                      settings=[f"ground.friction={friction}", "output.stress=false"])
        model = self.folder / "model.h5"
        self.made("reduce", *runs, "-o", model, "--quiet")
        found = []
        for factor in (5, 20, 40):  # 40: nearly one contact point in a step
            out = self.folder / str(factor)
            self.made("run", CASE, "-o", out, "--reduced", model, "--step-factor", factor,
                      "--quiet", settings=["output.snapshots=0"])
            found.append([mean for mean, _ in self.forces(out)])
        x, y = np.array(found).T
        # A tenth of what the modes themselves are off by.
        self.assertLess(np.ptp(y), 0.0006 * y.mean())
        self.assertLess(np.ptp(x), 0.0025 * y.mean())


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""The table of docs/reduced.md: a rolling disk, 12×180, predicted from runs with other frictions,
heights, speeds and spins, at twenty times the step, against the full model; and other forms."""
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

# (rondo reduce, rondo run, bounds of the errors of F_y and F_x, both of the mean vertical force).
TURNING = ["--frame", "co-rotating", "--displacement-modes", 100, "--velocity-modes", 100]
EXPLICIT = ["--reduced-step", "explicit", "--step-factor"]
FORMS = {
    "places": ([], [], (0.006, 0.025)),
    # Each node that comes by shakes the few modes: F_x fluctuates by 1 % of F_y, and its mean hangs on
    # the least change of the modes (1.1 to 3.0 % off in three bases). Not the default.
    "nodes": (["--contact", "nodes"], [], (0.006, 0.04)),
    "places, explicit": ([], EXPLICIT + [2.5], (0.006, 0.025)),
    "nodes, explicit": (["--contact", "nodes"], EXPLICIT + [1], (0.006, 0.025)),
    # What would be done without the rectified frame: with 200 modes twice as far off.
    "turning, explicit": (TURNING, EXPLICIT + [2], (0.012, 0.05)),
}


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
        cases = [settings + ["output.snapshots=0"] for settings in predicted]
        for k, settings in enumerate(cases):
            self.made("run", CASE, "-o", self.folder / f"full{k}", "--quiet", settings=settings)
        for form, (of_reduce, of_run, bounds) in FORMS.items():
            model = self.folder / "model.h5"
            self.made("reduce", *runs, "-o", model, "--quiet", *of_reduce)
            for k, settings in enumerate(cases):
                with self.subTest(form=form, predicted=settings):
                    self.compare(form, model, of_run, self.folder / f"full{k}", settings, bounds)

    def compare(self, form, model, of_run, full, settings, bounds):
        reduced = self.folder / "reduced"
        said = self.made("run", CASE, "-o", reduced, "--overwrite", "--reduced", model, "--quiet",
                         *of_run, settings=settings)
        self.assertEqual(said.stderr, "")  # within the range of the model
        j = summary(reduced)
        self.assertLess(j["energy_residual_relative"], 1e-11)
        self.assertLess(j["contact_residual_max"], 1e-11)
        (fx, fy), (x, y) = self.forces(full), self.forces(reduced)
        print(f"{settings[0]}; {form}, {j['reduced_modes']} modes, factor {j['step_factor']:.3g}: "
              f"F_y {100 * (y[0] / fy[0] - 1):.2f} %, F_x {100 * (x[0] - fx[0]) / fy[0]:.2f} % of "
              f"F_y; fluctuation of F_y {y[1]:.0f} ({fy[1]:.0f}), of F_x {x[1]:.0f} ({fx[1]:.0f}) "
              f"N/m; {j['reduced']['step_wall_s']:.3f} s", flush=True)
        self.assertLess(abs(y[0] / fy[0] - 1), bounds[0])
        self.assertLess(abs(x[0] - fx[0]) / fy[0], bounds[1])
        if "nodes" in form or "turning" in form:  # they fluctuate as the full model's nodes do
            self.assertLess(y[1], 3 * fy[1])
        # Points that stand still in space are not passed one by one: it is quieter.
        if form == "places":
            self.assertEqual(j["step_factor"], 20)
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

    def test_treaded_disk(self):
        """Means, and what the pitches do to the force."""
        case = ROOT / "cases" / "rolling-treaded.toml"
        runs = [self.folder / name for name in ("a", "b", "full")]
        for directory, friction in zip(runs, (0, 0.6, 0.3)):
            self.made("run", case, "-o", directory, "--quiet",
                      settings=[f"ground.friction={friction}", "output.stress=false"])
        model, out = self.folder / "model.h5", self.folder / "reduced"
        self.made("reduce", *runs[:2], "-o", model, "--quiet")
        self.made("run", case, "-o", out, "--reduced", model, "--quiet",
                  settings=["output.snapshots=0"])
        (fx, fy), (x, y) = self.forces(runs[2]), self.forces(out)
        pitches = 60 * 33.333333 / (2 * np.pi)

        def amplitude(directory):
            h = history(directory)
            late = h["time_s"] > h["time_s"][-1] - 20 / pitches
            f, t = h["force_y"][late], h["time_s"][late]
            return 2 * abs(np.mean((f - f.mean()) * np.exp(-2j * np.pi * pitches * t)))

        full, found = amplitude(runs[2]), amplitude(out)
        print(f"treaded: F_y {100 * (y[0] / fy[0] - 1):.2f} %, F_x "
              f"{100 * (x[0] - fx[0]) / fy[0]:.2f} % of F_y; at {pitches:.0f} Hz {found:.0f} "
              f"({full:.0f}) N/m; fluctuation of F_y {y[1]:.0f} ({fy[1]:.0f}), of F_x {x[1]:.0f} "
              f"({fx[1]:.0f}) N/m", flush=True)
        self.assertLess(abs(y[0] / fy[0] - 1), 0.006)
        self.assertLess(abs(x[0] - fx[0]) / fy[0], 0.025)
        self.assertLess(abs(found - full), 0.2 * full)
        self.assertLess(abs(y[1] - fy[1]), 0.3 * fy[1])

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

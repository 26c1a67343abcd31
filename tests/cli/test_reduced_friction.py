# SPDX-License-Identifier: BSD-3-Clause
"""Reduced wheels, in runs and as FMUs, whose friction depends on slip, pressure and place: against full runs and
steady rolling with the same table."""
import ctypes
import sys
import unittest

import numpy as np

from program import ROOT, SANITIZED, ProgramTest, history, run, said, settings, summary

sys.path.insert(0, str(ROOT / "examples" / "fmu"))
from quarter_car import Fmu, QuarterCar, unpack  # noqa: E402

FLAT = ROOT / "cases" / "rolling-flat.toml"
STEADY = ROOT / "cases" / "steady-rolling.toml"
JUMP = ROOT / "cases" / "wheel-mu-jump.toml"
CAR = ROOT / "cases" / "quarter-car-bump.toml"
RISING = ("ground.friction={coefficient = 0.4, slip_speed = [[0, 0.8], [0.4, 1], [3, 1.2]], "
          "pressure_exponent = -0.15, pressure_reference = 1e6}")
FALLING = ("ground.friction={coefficient = 0.4, slip_speed = [[0, 1], [0.3, 1.2], [4, 0.7]], "
           "pressure_exponent = -0.15, pressure_reference = 1e6}")
STEEP = "ground.friction={coefficient = 0.4, slip_speed = [[0, 1], [0.2, 0.5]]}"
PATCH = "ground.patch=[{from = 0.5, to = 0.8, factor = 0.2}]"


class Reduced(ProgramTest):
    def results(self, name, case, *given, reduced=True):
        """Its history, summary, and what it said."""
        directory = self.folder / name
        done = run("run", case, "-o", directory, "--quiet", "--overwrite", *(["--reduced"] if reduced else []),
                   *settings(*given))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertLess(summary(directory)["energy_residual_relative"], 1e-12)
        return history(directory), summary(directory), said(done)

    def mean(self, h, name, begin, end=np.inf):
        there = (h["time_s"] > begin) & (h["time_s"] <= end)
        return h[name][there].mean()

    def test_forces_are_those_of_the_full_run_and_of_steady_rolling(self):
        """A number has 0.03 and 0.07 % of F_y; the table of the other has 0.36 %, and none 0.15 or 0.31 %."""
        steady = "analysis.samples_per_sector=8", "analysis.massless_contact=true"
        for table, late in ((RISING, 0), (FALLING, 5)):
            reduced, told, _ = self.results("reduced", FLAT, table)
            self.assertLessEqual(told["wheel"]["steps_late_friction"], late)
            whole = self.results("whole", FLAT, table, reduced=False)[0]
            rolls = self.results("steady", STEADY, table, *steady, reduced=False)[0]
            x, y = self.mean(reduced, "force_x", 0.15), self.mean(reduced, "force_y", 0.15)
            for other, begin, bound in ((whole, 0.15, 1.2e-3), (rolls, -1.0, 1.5e-3)):
                self.assertLess(abs(x - self.mean(other, "force_x", begin)), bound * y)
                self.assertLess(abs(y - self.mean(other, "force_y", begin)), 2e-3 * y)

    def test_braking_over_ice_is_that_of_the_full_run(self):
        load = 1.2e5
        whole = self.results("whole", JUMP, reduced=False)[0]
        reduced, _, said_by_it = self.results("reduced", JUMP, "output.history_interval=0")
        self.assertEqual(said_by_it, "")
        for begin, end in ((0.1, 0.14), (0.18, 0.2), (0.22, 0.24), (0.36, 0.4)):
            x = [self.mean(h, "force_x", begin, end) for h in (reduced, whole)]
            self.assertLess(abs(x[0] - x[1]), 1e-3 * load, begin)
        for moment in (np.min, np.max):
            locked = [moment(h["time_s"][abs(h["spin_rad_s"]) < 1e-6]) for h in (reduced, whole)]
            self.assertLess(abs(locked[0] - locked[1]), 1e-3)
        work = [h["dissipation_friction"][-1] for h in (reduced, whole)]
        self.assertLess(abs(work[0] / work[1] - 1.0), 2e-3)

    def test_it_resumes_to_the_same_bits(self):
        bits, given = [], (FALLING, PATCH, "time.end=0.1", "output.history_interval=0")
        self.results("whole", FLAT, *given)
        self.results("parts", FLAT, *given, "time.end=0.06", "output.snapshots=30")
        done = run("run", FLAT, "-o", self.folder / "parts", "--reduced", "--resume", "--quiet",
                   *settings(*given, "output.snapshots=30"))
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("whole", "parts"):
            bits.append((self.folder / name / "history.csv").read_bytes())
        self.assertEqual(*bits)

    def test_a_start_in_steady_rolling_knows_its_pressures_and_slips(self):
        start = "motion.height=0.29", "initial.state=steady-rolling", "time.end=0.1", "output.history_interval=0"
        h, _, told = self.results("started", FLAT, RISING, *start)
        self.assertNotIn("initial.state", told)
        end = self.mean(h, "force_x", 0.08)
        self.assertLess(abs(h["force_x"][:3] - end).max(), 0.03 * abs(end))
        self.assertIn("initial.state: the first step does not know the pressures",
                      self.results("full", FLAT, RISING, *start, "time.end=0.001", reduced=False)[2])

    def test_friction_that_falls_steeply_is_told(self):
        _, told, said_by_it = self.results("steep", FLAT, STEEP)
        self.assertGreater(told["wheel"]["steps_late_friction"], 0)
        self.assertIn("the coefficients are those by slip and pressure of the step before", said_by_it)
        self.assertNotIn("step before", self.results("rising", FLAT, RISING)[2])

    def test_check_tells_the_table(self):
        done = run("check", FLAT, "--reduced", *settings(RISING, PATCH))
        self.assertEqual(done.returncode, 0, done.stderr)
        for line in ("times 0.8 to 1.2 by the slip speed", "times 0.2 from x = 0.5 to 0.8 m"):
            self.assertIn(line, done.stdout)


@unittest.skipIf(SANITIZED, "sanitizers want to be loaded before the program that loads the FMU")
class OfAnFmu(ProgramTest):
    GIVEN = RISING.replace("0.4,", "0.6,", 1), PATCH

    def packed(self, name, *given):
        done = run("fmu", CAR, "-o", self.folder / f"{name}.fmu", *settings(*given))
        self.assertEqual(done.returncode, 0, done.stderr)
        unpack(self.folder / f"{name}.fmu", self.folder / name)

    def instance(self, name, **start):
        fmu = Fmu(self.folder / name)
        self.addCleanup(fmu.free)
        fmu.begin(**start)
        return fmu

    def driven(self, fmu, first=0, until=150):
        """Braked from rolling, over the patch."""
        out = []
        for k in range(first, until):
            fmu.set(hub_velocity_y=-0.25 if k < 80 else 0.0, hub_angular_velocity=16.87 - 0.05 * k)
            fmu.step(k * 1e-3, 1e-3)
            out.append(fmu.get("force_x", "force_y", "torque"))
        return np.array(out)

    def test_its_parameter_is_the_coefficient_of_the_table(self):
        self.packed("six", *self.GIVEN)
        self.packed("three", *self.GIVEN, "ground.friction.coefficient=0.3")
        six, three = self.instance("six", friction=0.3), self.instance("three")
        self.assertEqual([self.instance("six").get("friction"), three.get("friction")], [[0.6], [0.3]])
        self.assertEqual(six.messages + three.messages, [])
        forces = self.driven(three)
        np.testing.assert_array_equal(self.driven(six), forces)
        self.assertGreater(abs(self.driven(self.instance("six")) - forces).max(), 0.1 * forces[:, 1].max())
        # The state keeps what the friction depends on, in another instance too.
        begun, other = self.instance("six", friction=0.3), self.instance("six")
        self.driven(begun, 0, 90)
        saved, size, state = begun.save(), ctypes.c_size_t(), ctypes.c_void_p()
        begun.call("SerializedFMUstateSize", saved, ctypes.byref(size))
        data = ctypes.create_string_buffer(size.value)
        begun.call("SerializeFMUstate", saved, data, size)
        begun.free_state(saved)
        other.call("DeSerializeFMUstate", data, size, ctypes.byref(state))
        other.restore(state)
        other.free_state(state)
        np.testing.assert_array_equal(self.driven(other, 90), forces[90:])

    def test_it_is_the_reduced_run_with_the_same_table(self):
        self.packed("wheel", *self.GIVEN)
        done = run("run", CAR, "-o", self.folder / "run", "--reduced", "--quiet",
                   *settings(*self.GIVEN, "time.end=0.2"))
        self.assertEqual(done.returncode, 0, done.stderr)
        h = history(self.folder / "run")
        rows = QuarterCar(self.instance("wheel"), summary(self.folder / "run")["step"]).drive(0.2)
        n = min(len(rows), len(h["time_s"]))
        self.assertLess(abs(rows[:n, 2] - h["force_y"][:n]).max(), 0.01 * h["force_y"].max())


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""Steady rolling with friction over slip speed and pressure: by the law itself, in time, and what is refused."""
import csv
import unittest

import numpy as np

from program import ROOT, RunTest, contact, history, run, settings, summary
from test_tyre import TyreTest
from test_tyre_nonlinear import ALL
from test_tyre_steady_nonlinear import RADIUS, rolling

PLANE = (ROOT / "cases" / "steady-rolling.toml").read_text().replace("radial = 12", "radial = 6").replace(
    "circumferential = 180", "circumferential = 90")
FINE = (ROOT / "cases" / "steady-rolling.toml").read_text()
IN_TIME = (ROOT / "cases" / "rolling-flat.toml").read_text()
WHEEL = (ROOT / "cases" / "wheel3d-rubber-friction.toml").read_text()
SLIP, EXPONENT, REFERENCE = [[0.0, 1.0], [0.1, 1.1], [1.0, 0.8], [10.0, 0.5]], -0.15, 2e6
TABLE = f"ground.friction={{coefficient=0.6, slip_speed={SLIP}, pressure_exponent={EXPONENT}, " \
        f"pressure_reference={REFERENCE}}}"

GENTLE = "ground.friction={coefficient=0.6, slip_speed=[[0, 1], [1, 0.9], [10, 0.5]], pressure_exponent=-0.3, " \
         "pressure_reference=1e6}"

BELOW = "ground.friction={coefficient=0.5, pressure_exponent=-0.2, pressure_reference=1e9}"
UNIFORM = 0.5 * 10**0.2


def coefficient(slip, pressure):
    """Of the table."""
    factor = np.interp(slip, [s for s, _ in SLIP], [f for _, f in SLIP])
    return 0.6 * factor * np.clip(pressure / REFERENCE, 0.1, 10.0) ** EXPONENT


class SteadyFriction(RunTest):
    text = PLANE

    def of(self, *given, text=None):
        said = self.run_set(*given, text=text)
        return summary(self.out)["steady"], said

    def refused(self, code, *given, text=None):
        done = run("run", self.case(text or self.text), "-o", self.out, "--quiet", "--overwrite", *settings(*given))
        self.assertEqual(done.returncode, code, done.stderr)
        return " ".join(done.stderr.split())

    def test_each_contact_has_the_coefficient_of_its_own_slip_speed_and_pressure(self):
        steady, _ = self.of(TABLE)
        rows = contact(self.out)
        length = 2 * 0.3 * np.sin(np.pi / 90)  # of a column
        force, shear = rows["pressure_pa"] * rows["length_m"], np.abs(rows["shear_pa"]) * rows["length_m"]
        slides = rows["sticks"] == 0
        expected = coefficient(np.abs(rows["slip_speed"][slides]), force[slides] / length)
        np.testing.assert_allclose(shear[slides], expected * force[slides], rtol=1e-8, atol=1e-4)
        self.assertGreater(np.ptp(expected), 0.1)
        self.assertAlmostEqual(steady["friction_min"], min(expected), delta=0.05)
        self.assertLess(steady["friction_change"], 1e-10)
        self.assertEqual(steady["friction_branch"], "continued")
        self.assertGreaterEqual(steady["friction_steps"], 8)
        bound = coefficient(0.0, force / length) * force
        self.assertTrue(np.all(shear[~slides] <= bound[~slides] * (1 + 1e-9)))

    def test_a_table_of_equal_factors_is_the_constant(self):
        constant, _ = self.of("ground.friction=0.6")
        table, _ = self.of("ground.friction={coefficient=0.5, slip_speed=[[0, 1.2], [1, 1.2]]}")
        self.assertEqual(constant, table)
        self.assertNotIn("friction_branch", table)

    def test_pressures_that_are_all_below_the_range_have_one_coefficient(self):
        """A tenth of the reference is the least that counts."""
        constant, _ = self.of(f"ground.friction={UNIFORM!r}")
        table, _ = self.of(BELOW)
        for name in ("force_x", "force_y", "torque", "stick_length"):
            self.assertAlmostEqual(table[name], constant[name], delta=1e-9 * constant["force_y"])
        self.assertAlmostEqual(table["friction_min"], UNIFORM, delta=1e-12)
        self.assertAlmostEqual(table["friction_max"], UNIFORM, delta=1e-12)

    def test_tables_that_do_not_fall_take_one_step(self):
        steady, _ = self.of("ground.friction={coefficient=0.5, slip_speed=[[0, 1], [1, 1.2]]}")
        self.assertEqual((steady["friction_branch"], steady["friction_steps"], steady["friction_restarts"]),
                         ("direct", 1, 0))

    def test_is_what_a_run_in_time_settles_in(self):
        """Within half a percent of the load; constant friction would be three percent off."""
        for speed in ("motion.speed=9.4", "motion.speed=10.4"):
            steady, _ = self.of(GENTLE, speed, text=FINE)
            constant, _ = self.of("ground.friction=0.6", speed, text=FINE)
            self.assertGreater(abs(constant["force_x"] - steady["force_x"]), 0.03 * steady["force_y"])
            self.run_set(GENTLE, "time.end=0.3", "output.snapshots=0", speed, text=IN_TIME)
            rows = history(self.out)
            late = rows["time_s"] > 0.2
            for name in ("force_x", "force_y"):
                self.assertAlmostEqual(np.mean(rows[name][late]), steady[name], delta=0.005 * steady["force_y"])

    def test_is_what_a_wheel_with_a_width_settles_in(self):
        """Within half a percent of the load, on 180 sectors; constant friction is 1.5 and 13 percent off."""
        cornering, steady_wheel = ((ROOT / "cases" / f"wheel3d-{name}.toml").read_text() for name in
                                   ("cornering", "steady"))
        friction = GENTLE.replace("0.6", "0.3").replace("1e6", "2e5")
        for slip, constant_off in ((("motion.slip_angle=0.017453292519943295",), 0.015),
                                   (("motion.slip_angle=0.0349", "motion.speed=9.7"), 0.05)):
            given = "disk.mesh.circumferential=180", *slip
            steady, _ = self.of(friction, *given, text=steady_wheel)
            constant, _ = self.of(*given, text=steady_wheel)
            self.run_set(friction, *given, "output.snapshots=0", text=cornering)
            rows = history(self.out)
            late = rows["time_s"] > 0.06
            for name in ("force_x", "force_y", "force_lateral"):
                self.assertAlmostEqual(np.mean(rows[name][late]), steady[name], delta=0.005 * steady["force_y"])
            off = np.abs([constant[name] - steady[name] for name in ("force_x", "force_lateral")])
            self.assertGreater(off.max(), constant_off * steady["force_y"])

    def test_is_what_a_run_in_time_may_start_in(self):
        steady, _ = self.of(GENTLE, "analysis.samples_per_sector=4", text=FINE)
        told = run("check", self.case(IN_TIME), *settings(GENTLE, "motion.height=0.29",
                                                           "initial.state=steady-rolling")).stdout
        self.assertIn(f"steady rolling: F_x {steady['force_x']:.6g}, F_y {steady['force_y']:.6g} N/m", told)
        constant, _ = self.of("ground.friction=0.6", "analysis.samples_per_sector=4", text=FINE)
        self.assertNotIn(f"F_x {constant['force_x']:.6g}", told)

    def test_slopes_are_those_of_differences(self):
        steady, _ = self.of(TABLE)
        for key, slope, step in (("motion.speed=", "by_speed", 1e-4), ("ground.friction.coefficient=", "by_friction",
                                                                       1e-5)):
            at = 10.0 if slope == "by_speed" else 0.6
            more, _ = self.of(TABLE, f"{key}{at + step!r}")
            less, _ = self.of(TABLE, f"{key}{at - step!r}")
            for name in ("force_x", "force_y", "torque"):
                self.assertAlmostEqual(steady["slopes"][slope][name], (more[name] - less[name]) / (2 * step),
                                       delta=1e-4 * steady["force_y"])

    def test_rubber_corners_with_less_of_a_larger_load(self):
        shares = []
        for load in (3e3, 6e3, 9e3):
            steady, said = self.of(f"analysis.load={load}", text=WHEEL)
            self.assertTrue(said == "" or load == 9e3, said)  # whose strain is large
            self.assertAlmostEqual(steady["force_y"], load, delta=1e-6 * load)
            shares.append(abs(steady["force_lateral"]) / load)
        np.testing.assert_allclose(shares, [0.769, 0.727, 0.702], atol=6e-4)  # .896 to .861 of a constant .9

    def test_case_file_that_a_run_wrote_is_the_same_case(self):
        first, _ = self.of(text=WHEEL)
        again, _ = self.of(text=(self.out / "case.toml").read_text())
        self.assertEqual(first, again)

    def test_rolls_on_after_a_step_of_the_slip(self):
        given = ("motion.slip_angle=0", "analysis.slip=upwind", "analysis.accept_scheme_power=true")
        self.run_set(*given, "analysis.step_distance=0.5", "analysis.slip_angle_step=0.0698", text=WHEEL)
        step = summary(self.out)["slip_step"]["force_lateral"]
        with open(self.out / "slip-step.csv", newline="") as file:
            last = float(list(csv.DictReader(file))[-1]["force_lateral"])
        after, _ = self.of(*given[1:], "motion.slip_angle=0.0698", text=WHEEL)
        self.assertAlmostEqual(step["after"], after["force_lateral"], delta=1e-3 * abs(step["after"]))
        self.assertAlmostEqual(last, step["after"], delta=0.02 * abs(step["after"]))

    def test_what_has_no_steady_state_is_refused(self):
        self.assertIn("ground.patch[0]: a wheel that passes from one stretch",
                      self.refused(2, "ground.patch=[{from=1.0, to=2.0, factor=0.5}]"))
        largest = 0.6 * 1.1 * 10**0.15
        self.assertIn(f"{largest * 1e5:.6g}, the largest coefficient of ground.friction times analysis.load",
                      self.refused(2, TABLE, "analysis.load=1e5", "analysis.traction=1e5",
                                   text=self.text.replace("speed = 10.0\nheight = 0.29\n", "")))

    def test_friction_that_does_not_settle_is_no_result(self):
        """Friction that falls to a third carries no nine tenths of the constant one."""
        said = self.refused(3, "ground.friction={coefficient=0.4, slip_speed=[[0, 1], [0.1, 0.3]]}",
                            "analysis.load=1e5", "analysis.traction=-3.6e4",
                            text=self.text.replace("speed = 10.0\nheight = 0.29\n", ""))
        self.assertIn("ground.friction: no state was found whose coefficients are those of its slip speeds", said)
        self.assertIn("friction that falls may not carry the force", said)


class Nonlinear(TyreTest):
    def state(self, *more):
        text = rolling(RADIUS, friction=0.9, samples=1, more="speed = 3.1e-4").replace("sectors = 90", "sectors = 24")
        text = text.replace(f"height = {RADIUS!r}\n", "") + "load = 900.0\n"
        done = run("run", self.case(text), "-o", self.results, "--overwrite", "--quiet", *ALL, *settings(*more))
        self.assertEqual(done.returncode, 0, done.stderr)
        return summary(self.results)["steady"]

    def test_a_nonlinear_tyre_has_the_coefficients_of_its_own_state(self):
        """Its slopes are differences of states."""
        table = "ground.friction={coefficient=0.9, slip_speed=[[0, 1], [1e-5, 0.9], [1e-4, 0.6]], " \
                "pressure_exponent=-0.2}"
        at = self.state(table, "motion.slip_angle=0.1")
        self.assertEqual(at["friction_branch"], "near")
        self.assertLess(at["friction_change"], 1e-10)
        self.assertLess(at["friction_min"], at["friction_max"] - 0.1)
        low, high = (self.state(table, f"motion.slip_angle={0.1 + by!r}") for by in (-1e-4, 1e-4))
        for name in ("force_lateral", "moment_aligning", "height"):
            difference = (high[name] - low[name]) / 2e-4
            self.assertAlmostEqual(at["slopes"]["by_slip_angle"][name] / difference, 1.0, delta=1e-3, msg=name)


if __name__ == "__main__":
    unittest.main()

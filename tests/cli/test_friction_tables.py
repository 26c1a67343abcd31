# SPDX-License-Identifier: BSD-3-Clause
"""Friction over slip speed, pressure and place ([ground.friction], [[ground.patch]]) in runs of the program: a block
that slides to rest against quadrature, wheels on patches, resuming, threads, and what is refused."""
import re
import shutil
import unittest

import numpy as np

from program import ROOT, SMALL, ProgramTest, RunTest, history, run, settings, summary

GRAVITY, LENGTH, MASS = 9.81, 0.1, 10.0  # of the block: m/s2, m, kg/m
TABLE = [[0.0, 1.0], [0.5, 1.2], [3.0, 0.8]]
# Stiff, so that it slides as a rigid body to 1e-6 of its way, which decreases with 1/E.
BLOCK = """schema = 1
[mesh]
file = "block.msh"
contact = "foot"
[material]
youngs_modulus = 1.0e8
poissons_ratio = 0.3
density = 1000.0
[damping]
stiffness = 2.0e-5
[motion]
gravity = 9.81
[ground]
profile = "flat"
friction = 0.4
[initial]
velocity = [2.0, 0.0]
[time]
end = 0.8
step = 1e-5
[output]
history_interval = 1e-3
snapshots = 2
"""
FALLING = f"ground.friction={{coefficient = 0.4, slip_speed = {TABLE}}}"
RUBBER = ("ground.friction={coefficient = 0.6, slip_speed = [[0, 1], [0.3, 1.2], [4, 0.7]], "
          "pressure_exponent = -0.15, pressure_reference = 2e5}")
PATCH = "ground.patch=[{from = 0.05, to = 0.12, factor = 0.3}]"
WHEEL3D = SMALL.replace("inner_radius = 0.15\n", "inner_radius = 0.15\nwidth = 0.1\n").replace(
    "circumferential = 40\n", "circumferential = 40\naxial = 4\n")


def to_rest(speed, weight, factor=lambda v: np.interp(v, *zip(*TABLE)), coefficient=0.4):
    """∫ weight(v) dv / (g μ(v)) from 0 to a speed, by Gauss's rule over each stretch of the table."""
    x, w = np.polynomial.legendre.leggauss(30)
    knots = sorted({0.0, speed, *(v for v, _ in TABLE if 0.0 < v < speed)})
    total = 0.0
    for a, b in zip(knots, knots[1:]):
        v = 0.5 * (a + b) + 0.5 * (b - a) * x
        total += 0.5 * (b - a) * np.sum(w * weight(v) / (GRAVITY * coefficient * factor(v)))
    return total


def way_to_rest(speed, **law):
    return to_rest(speed, lambda v: v, **law)  # m


def time_to_rest(speed):
    return to_rest(speed, np.ones_like)  # s


def speed_before(way):
    """The speed that leaves this way, by bisection [m/s]."""
    low, high = 0.0, 3.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if way_to_rest(middle) < way else (low, middle)
    return 0.5 * (low + high)


class Block(RunTest):
    text = BLOCK

    def setUp(self):
        super().setUp()
        shutil.copy(ROOT / "cases" / "meshes" / "block.msh", self.folder)

    def way(self, *given):
        """Of the center, until it rests."""
        self.run_set(*given)
        self.assertLess(summary(self.out)["energy_residual_relative"], 1e-11)  # of a stiff body at rest
        h = history(self.out)
        self.assertEqual(h["sticking_nodes"][-1], h["contact_nodes"][-1])
        return h["center_x_m"][-1]

    def test_it_slides_to_rest_by_the_quadrature_of_its_table(self):
        """The coefficient is that of the slip a step before, so that the error is of first order in the step; what is
        left without it, 4e-7, is of the elasticity of the block and decreases with 1/E."""
        stiff = "material.youngs_modulus=4e8", "damping.stiffness=1e-5"
        coarse, fine = (self.way(FALLING, *stiff, f"time.step={step}") for step in ("5e-6", "2.5e-6"))
        exact = way_to_rest(2.0)
        self.assertLess(abs(coarse / exact - 1.0), 1e-6)
        self.assertLess(abs((2.0 * fine - coarse) / exact - 1.0), 1e-6)
        self.assertGreater(abs(coarse - fine), 1e-7)  # it is there
        # When it rests: a row on the way, and the time that the table gives for the way left.
        h = history(self.out)
        row = np.searchsorted(h["time_s"], 0.3)
        rests = h["time_s"][row] + time_to_rest(speed_before(fine - h["center_x_m"][row]))
        self.assertLess(abs(rests / time_to_rest(2.0) - 1.0), 1e-6)
        moving = h["sticking_nodes"] < h["contact_nodes"]
        self.assertLess(abs(h["time_s"][moving][-1] - time_to_rest(2.0)), 2e-3)  # the rows are 1 ms apart
        self.assertGreater(abs(way_to_rest(2.0, factor=np.ones_like) / exact - 1.0), 0.02)

    def test_it_slides_over_a_patch(self):
        """Node by node: each does the work of its share of the weight, and goes all the length of the ice. The shares
        change while the foot, 0.1 m long, comes on it and leaves it: little where the friction is little, as here."""
        begin, end, ice = 0.1, 0.25, 0.25
        slides = "ground.friction=0.04", "initial.velocity=[0.45, 0.0]", "time.end=1.8"
        way = self.way(*slides, f"ground.patch=[{{from = {begin}, to = {end}, factor = {ice}}}]")
        alone = self.way(*slides)
        self.assertAlmostEqual(alone, 0.45**2 / (2.0 * 0.04 * GRAVITY), delta=1e-5)
        self.assertAlmostEqual(way - alone, (1.0 - ice) * (end - begin), delta=1e-4)

    def test_a_power_of_the_pressure_is_another_constant_where_the_pressure_is_uniform(self):
        """That of the weight on the foot, with so little friction that it does not press the block on one side."""
        pressure, exponent, coefficient = MASS * GRAVITY / LENGTH, -0.2, 0.02
        slides = "initial.velocity=[0.15, 0.0]", "time.end=1.2"
        power = self.way(f"ground.friction={{coefficient = {coefficient}, pressure_exponent = {exponent}, "
                         f"pressure_reference = {5.0 * pressure}}}", *slides)
        constant = self.way(f"ground.friction={coefficient * 0.2**exponent}", *slides)
        plain = self.way(f"ground.friction={coefficient}", *slides)
        self.assertLess(abs(power - constant), 0.01 * abs(constant - plain))

    def test_a_table_that_is_a_constant_has_the_bits_of_the_number(self):
        self.run_set("ground.friction=0.4", "time.end=0.1")
        number = (self.out / "history.csv").read_bytes()
        for table in ("{coefficient = 0.4, slip_speed = [[0, 1], [2, 1]]}", "{coefficient = 0.4}",
                      "{coefficient = 0.2, slip_speed = [[0, 2]]}"):
            self.run_set(f"ground.friction={table}", "time.end=0.1")
            self.assertEqual((self.out / "history.csv").read_bytes(), number)
        self.run_set("ground.friction={coefficient = 0.4, slip_speed = [[0, 1], [2, 1.01]]}", "time.end=0.1")
        self.assertNotEqual((self.out / "history.csv").read_bytes(), number)


class OnTwoFeet(RunTest):
    """One stiff element, whose two feet carry what the moment of friction leaves them. The jumps of friction set it
    vibrating, which takes a share of its energy that decreases with 1/E."""
    height, speed = 0.06, 2.0  # m, m/s
    text = BLOCK.replace("block.msh", "two-feet.msh").replace("1.0e8", "4.0e9").replace("2.0e-5", "1.0e-6").replace(
        "1e-5", "2e-6").replace("end = 0.8", "end = 0.65")

    def setUp(self):
        super().setUp()
        x, y = 0.5 * LENGTH, self.height
        (self.folder / "two-feet.msh").write_text(
            '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 1 "foot"\n2 2 "block"\n$EndPhysicalNames\n'
            f"$Nodes\n4\n1 {-x} 0 0\n2 {x} 0 0\n3 {x} {y} 0\n4 {-x} {y} 0\n$EndNodes\n"
            "$Elements\n2\n1 1 2 1 1 1 2\n2 3 2 2 1 1 2 3 4\n$EndElements\n")

    def deceleration(self, front, rear, height):
        """Of a rigid block whose feet have these coefficients: N_f + N_r = m g, and about its center
        (N_f - N_r) L/2 = (μ_f N_f + μ_r N_r) h/2."""
        arms = [LENGTH - front * height, -LENGTH - rear * height]
        loads = np.linalg.solve([[1.0, 1.0], arms], [GRAVITY, 0.0])
        self.assertGreater(min(loads), 0.0)
        return np.dot([front, rear], loads)

    def way(self, begin, end, factor, height):
        """v dv = -a dx over the stretches on which the feet stay on one friction each [m]."""
        def friction(foot):
            return 0.4 * (factor if begin < foot < end else 1.0)
        x, energy = 0.0, 0.5 * self.speed**2
        for edge in (begin - 0.5 * LENGTH, begin + 0.5 * LENGTH, end - 0.5 * LENGTH, end + 0.5 * LENGTH):
            middle = 0.5 * (x + edge)
            slows = self.deceleration(friction(middle + 0.5 * LENGTH), friction(middle - 0.5 * LENGTH), height)
            energy -= slows * (edge - x)
            self.assertGreater(energy, 0.0)
            x = edge
        return x + energy / self.deceleration(0.4, 0.4, height)

    def test_it_stops_behind_a_patch_where_quadrature_says(self):
        for begin, end, factor in (0.15, 0.3, 0.5), (0.15, 0.32, 1.5):
            with self.subTest(factor):
                exact = self.way(begin, end, factor, self.height)
                self.run_set(f"ground.patch=[{{from = {begin}, to = {end}, factor = {factor}}}]")
                self.assertLess(summary(self.out)["energy_residual_relative"], 1e-11)
                h = history(self.out)
                self.assertEqual(h["sticking_nodes"][-1], 2)
                self.assertLess(abs(h["center_x_m"][-1] / exact - 1.0), 1e-6)
                # What this would see: a ten-thousandth of the patch, and loads without the moment of friction.
                self.assertGreater(abs(self.way(begin, end, 1.0001 * factor, self.height) / exact - 1.0), 1e-5)
                self.assertGreater(abs(self.way(begin, end, factor, 0.0) / exact - 1.0), 5e-4)


class Wheels(RunTest):
    def history_of(self, text, *given):
        self.run_set(*given, text=text)
        self.assertLess(summary(self.out)["energy_residual_relative"], 1e-12)
        return history(self.out)

    def test_balances_close_with_tables_and_forces_follow_them(self):
        for text in (SMALL, WHEEL3D):
            rubs = self.history_of(text, RUBBER, PATCH)
            plain = self.history_of(text, "ground.friction=0.6")
            self.assertGreater(np.abs(rubs["force_x"] - plain["force_x"]).max(), 0.02 * plain["force_y"].max())
            self.assertGreater(rubs["dissipation_friction"][-1], 0.0)

    def test_the_readable_step_has_the_same_forces(self):
        """A [contact] of bodies, of which there is one, takes the general step. Little friction in the slip range, so
        that round-off does not grow."""
        given = ("ground.friction={coefficient = 0.4, slip_speed = [[0, 0.8], [0.4, 1], [3, 1.2]], "
                 "pressure_exponent = -0.15}", PATCH, "output.history_interval=0", "time.end=0.01")
        fused = self.history_of(SMALL, *given)
        readable = self.history_of(SMALL, *given, "contact.between=all")
        for name in ("force_x", "force_y", "torque"):
            self.assertLess(np.abs(fused[name] - readable[name]).max(), 1e-9 * np.abs(fused["force_y"]).max())
        self.assertIn("fused cyclic", run("check", self.folder / "case.toml", *settings(*given)).stdout)

    def test_threads_do_not_change_a_bit(self):
        for text in (SMALL, WHEEL3D):
            bits = []
            for threads in (1, 2, 3):
                self.run_ok(text, "--quiet", "--overwrite", "--threads", threads, *settings(RUBBER, PATCH))
                bits.append((self.out / "history.csv").read_bytes())
            self.assertEqual(bits[0], bits[1])
            self.assertEqual(bits[0], bits[2])

    def test_ice_on_the_other_side_mirrors_side_force_and_yaw_moment(self):
        def braked(side):
            return self.history_of(WHEEL3D, "ground.friction=0.8", "motion.angular_velocity=30",
                                   f"ground.patch=[{{from = 0.02, to = 9, side = '{side}', factor = 0.1}}]")
        left, right = braked("left"), braked("right")
        for name in ("force_lateral", "moment_aligning"):
            size = np.abs(left[name]).max()
            self.assertGreater(size, 1.0)
            self.assertLess(np.abs(left[name] + right[name]).max(), 1e-9 * size)
        self.assertLess(np.abs(left["force_x"] - right["force_x"]).max(), 1e-9 * np.abs(left["force_x"]).max())
        self.assertLess(left["moment_aligning"][-1], 0.0)  # the right half brakes and turns it to the right

    def test_it_resumes_to_the_same_bits(self):
        for text in (SMALL, WHEEL3D):
            self.run_ok(text, "--quiet", "--overwrite", *settings(RUBBER, PATCH))
            whole = (self.out / "history.csv").read_bytes()
            self.run_ok(text, "--quiet", "--overwrite", *settings(RUBBER, PATCH, "time.end=0.012",
                                                                  "output.snapshots=7"))
            done = run("run", self.folder / "case.toml", "-o", self.out, "--resume", "--quiet",
                       *settings(RUBBER, PATCH))
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual((self.out / "history.csv").read_bytes(), whole)

    def test_another_table_does_not_resume(self):
        self.run_set(RUBBER, "time.end=0.012", "output.snapshots=7")
        done = run("run", self.folder / "case.toml", "-o", self.out, "--resume", "--quiet",
                   *settings(RUBBER, "ground.friction.coefficient=0.5"))
        self.assertEqual(done.returncode, 2)
        self.assertIn("ground.friction.coefficient", done.stderr)


STEEP = "ground.friction={coefficient = 0.4, slip_speed = [[0, 0], [0.5, 1]]}"


class Steep(RunTest):
    """Friction that rises so steeply that slips and coefficients alternate from step to step (theory.md, 4.3e)."""
    LONG = "time.end=0.06"  # the small wheel rolls for 50 ms on it

    def warned(self, *given, text=SMALL):
        told = self.run_set(STEEP, self.LONG, *given, text=text)
        return [line for line in told.splitlines() if "alternates from step to step" in line]

    def force(self):
        h = history(self.out)
        return h["force_x"][h["time_s"] > 0.03].mean()

    def of_contact(self):
        return summary(self.out)["contact"]

    def test_a_step_that_is_too_long_is_told_with_one_that_is_not(self):
        for text in (SMALL, WHEEL3D):
            warning, = self.warned(text=text)
            self.assertGreater(self.of_contact()["friction_alternating"], 0.5)
            self.assertGreater(self.of_contact()["friction_steepness_max"],
                               self.of_contact()["friction_steepness_limit"])
            self.assertIn(warning.removeprefix("rondo: warning: "), summary(self.out)["warnings"])
            wrong = self.force()
            bearable = float(re.search(r"time.step of (\S+) s", warning)[1])
            self.assertEqual(self.warned(f"time.step={bearable}", text=text), [])
            self.assertLess(self.of_contact()["friction_alternating"], 1e-3)
            right = self.force()
            self.assertEqual(self.warned(f"time.step={0.5 * bearable}", text=text), [])
            # The lag is of first order in the step: it leaves 1.4 and 0.6 %. What alternates is 55 and 27 % off.
            self.assertLess(abs(right / self.force() - 1.0), 0.02)
            self.assertGreater(abs(wrong / right - 1.0), 0.2)
            # Twice that step is too long, so the one that is told is not just a short one.
            self.assertEqual(len(self.warned(f"time.step={2.0 * bearable}", text=text)), 1)

    def test_readable_and_sparse_steps_tell_the_same(self):
        figures = []
        for step in ("solver.operator=cyclic", "solver.operator=sparse", "contact.between=all"):
            self.assertEqual(len(self.warned(step)), 1)
            figures.append(self.of_contact())
        for other in figures[1:]:
            for name in ("friction_alternating", "friction_steepness_max", "friction_steepness_limit"):
                self.assertLess(abs(other[name] / figures[0][name] - 1.0), 1e-6, name)

    def test_contact_nodes_without_mass_do_so_at_any_step(self):
        for step in "2e-5", "1e-5":
            warning, = self.warned("solver.contact_mass=singular", f"time.step={step}")
            self.assertIn('solver.contact_mass = "lumped"', warning)
            self.assertGreater(self.of_contact()["friction_alternating"], 0.9)
            self.assertNotIn("friction_steepness_limit", self.of_contact())

    def test_the_check_knows_what_is_certain(self):
        def checked(table, *given):
            done = run("check", self.case(SMALL), *settings(f"ground.friction={{coefficient = 0.4, slip_speed = {table}}}",
                                                            *given))
            self.assertEqual(done.returncode, 0, done.stderr)
            return "rises with the slip by up to" in done.stdout, "a tenth of its largest value at rest" in done.stderr
        self.assertEqual(checked([[0, 0], [0.1, 1]]), (True, True))
        self.assertEqual(checked([[0, 0], [5, 1]]), (True, False))
        self.assertEqual(checked([[0, 0.5], [0.1, 1]]), (True, False))  # what sticks may do so for good
        self.assertEqual(checked([[0, 1], [0.5, 0.7]]), (False, False))
        self.assertEqual(checked([[0, 0], [0.1, 1]], "time.step=1e-6"), (True, False))
        self.assertEqual(checked([[0, 0.9], [0.02, 1]], "ground.patch=[{from = -1, to = 0.5, factor = 0.05}]"), (True, False))
        self.assertEqual(checked([[0, 0], [0.1, 1]], "solver.contact_mass=singular"), (False, True))

    def test_without_rows_in_contact_nothing_is_said(self):
        self.assertEqual(self.warned("output.history_interval=1"), [])
        self.assertNotIn("friction_alternating", self.of_contact())
        self.assertNotIn("friction_steepness_max", self.of_contact())

    def test_it_resumes_to_the_same_figures(self):
        self.warned()
        whole = self.of_contact()
        self.run_set(STEEP, "time.end=0.03", "output.snapshots=6")
        done = run("run", self.folder / "case.toml", "-o", self.out, "--resume", "--quiet", *settings(STEEP, self.LONG))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.of_contact(), whole)

    def test_tables_that_rise_little_and_constants_are_not_told_of(self):
        for table in ([[0, 1], [0.1, 1.1], [1, 1], [10, 0.7]], [[0, 0.9], [2, 1]]):
            told = self.run_set(f"ground.friction={{coefficient = 1.0, slip_speed = {table}}}", self.LONG)
            self.assertNotIn("alternates", told)
            self.assertLess(self.of_contact()["friction_alternating"], 0.01)
        self.run_set("ground.friction=0.4")
        self.assertNotIn("friction_alternating", self.of_contact())


class Swept(ProgramTest):
    def forces(self, *vary):
        base = self.case(SMALL.replace("friction = 0.3\n", "").replace(
            "[time]", "[ground.friction]\ncoefficient = 0.3\nslip_speed = [[0, 1], [0.5, 1.2]]\n[time]"))
        study = self.case(f'schema = 1\nbase = "{base.name}"\n[[vary]]\n' + "\n".join(vary) + "\n", "study.toml")
        done = run("sweep", study, "-o", self.folder / "sweep", "--quiet", "--overwrite")
        self.assertEqual(done.returncode, 0, done.stderr)
        return [history(self.folder / "sweep" / "runs" / f"000{k}")["force_x"] for k in (1, 2)]

    def test_the_coefficient_of_a_table_and_a_number_in_its_place(self):
        given = self.forces('key = "ground.friction.coefficient"', "values = [0.3, 0.4]")
        self.assertIn("slip_speed", (self.folder / "sweep" / "runs" / "0002" / "case.toml").read_text())
        plain = self.forces('key = "ground.friction"', "values = [0.3, 0.4]")
        self.assertNotIn("slip_speed", (self.folder / "sweep" / "runs" / "0002" / "case.toml").read_text())
        for a in (*given, *plain):
            self.assertEqual(sum(np.array_equal(a, b) for b in (*given, *plain)), 1)


CRUSH = ("analysis.kind=crush", "analysis.depth=0.005", "analysis.slide=0.004", "analysis.increments=3",
         "analysis.slide_increments=3", "ground.profile=flat")
ICE = "ground.patch=[{from = %s, to = %s, factor = 0.1}]"


class Crushed(RunTest):
    """Crushes by increments: pressure and place in the increment before."""
    text = SMALL

    def crushed(self, *given, text=SMALL):
        self.run_ok(text, "--quiet", "--overwrite", *settings(*CRUSH, *given))
        s = summary(self.out)
        self.assertLess(s["energy_residual_relative"], 1e-11)
        self.assertLess(s["contact_residual_max"], 1e-10)
        return history(self.out)

    def test_pressures_below_a_tenth_of_the_reference_count_as_that(self):
        exponent = "ground.friction={coefficient = 0.1, pressure_exponent = -0.2, pressure_reference = 1e12}"
        for text in (SMALL, WHEEL3D):
            tabled = self.crushed(exponent, text=text)
            number = self.crushed(f"ground.friction={0.1 * 0.1 ** -0.2!r}", text=text)
            for name in ("force_x", "force_y", "torque", "dissipation_friction"):
                size = np.abs(number["force_y"]).max()
                np.testing.assert_allclose(tabled[name], number[name], rtol=0, atol=1e-9 * size, err_msg=name)
            other = self.crushed("ground.friction=0.1", text=text)
            self.assertGreater(abs(tabled["force_x"][-1] - other["force_x"][-1]), 0.1 * abs(other["force_x"][-1]))

    def test_it_slides_onto_ice(self):
        for text in (SMALL, WHEEL3D):
            dry, icy = self.crushed("ground.friction=0.1", text=text), self.crushed("ground.friction=0.01", text=text)
            onto = self.crushed("ground.friction=0.1", ICE % (-1, 1), text=text)
            for name in ("force_x", "force_y"):
                np.testing.assert_allclose(onto[name], icy[name], rtol=0, atol=1e-9 * icy["force_y"].max())
            half = self.crushed("ground.friction=0.1", ICE % (0, 1), text=text)
            self.assertLess(half["force_x"][-1], 0.9 * icy["force_x"][-1])
            self.assertGreater(half["force_x"][-1], 0.9 * dry["force_x"][-1])

    def test_ice_on_the_left_turns_it_to_the_right(self):
        def drawn(side):
            return self.crushed("ground.friction=0.1", f"ground.patch=[{{from = -1, to = 1, side = '{side}', "
                                                       "factor = 0.1}]", text=WHEEL3D)
        left, right = drawn("left"), drawn("right")
        for name in ("force_lateral", "moment_aligning"):
            size = np.abs(left[name]).max()
            self.assertGreater(size, 1e-3)
            self.assertLess(np.abs(left[name] + right[name]).max(), 1e-8 * np.abs(left["force_y"]).max())
        self.assertLess(left["moment_aligning"][-1], 0.0)

    def test_the_case_that_it_wrote_gives_the_same(self):
        exponent = "ground.friction={coefficient = 0.3, pressure_exponent = -0.2, pressure_reference = 2e5}"
        first = self.crushed(exponent, ICE % (0, 1))
        again = self.folder / "again"
        done = run("run", self.out / "case.toml", "-o", again, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        for name, column in history(again).items():
            np.testing.assert_array_equal(column, first[name], err_msg=name)


class Refused(ProgramTest):
    def refused(self, command, *given, text=SMALL):
        done = run(*command, self.case(text), *settings(*given))
        self.assertEqual(done.returncode, 2, done.stderr + done.stdout)
        return done.stderr

    def test_steps_and_analyses_that_take_one_coefficient_say_so(self):
        for given, said in ((CRUSH, "so slow that it has no slip speed"),
                            ((*CRUSH, "analysis.solver=latin"), "LATIN solves all increments at once with one"),
                            (("time.scheme=hati", "solver.hati.ratio=2", "solver.hati.fine.layers=[3]"),
                             "one coefficient of friction for all contacts")):
            with self.subTest(said):
                told = self.refused(["check"], RUBBER, *given)
                self.assertIn("ground.friction", told)
                self.assertIn(said, told)
        self.assertIn("ground.friction.slip_speed", self.refused(["check"], RUBBER, PATCH, *CRUSH))
        self.assertIn("ground.patch", self.refused(["check"], PATCH, *CRUSH, "analysis.solver=latin-pgd"))
        for given in (("analysis.kind=steady-rolling", "motion.height=0.296"),
                      ("initial.state=steady-rolling", "motion.height=0.296")):
            self.assertIn("ground.patch", self.refused(["check"], PATCH, *given))

    def test_standing_wheels_say_so(self):
        text = WHEEL3D.replace("height = [[0, 0.3], [0.004, 0.296]]", "height = 0.296")
        done = run("modes", self.case(text), "-o", self.folder / "modes", "--standing", *settings(RUBBER))
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("--standing takes one coefficient of friction", done.stderr)


if __name__ == "__main__":
    unittest.main()

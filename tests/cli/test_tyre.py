# SPDX-License-Identifier: BSD-3-Clause
"""Wheels with cords and air, from outside: the equilibrium and its files, what moves about it, and
what is refused."""
import csv
import unittest

import h5py
import numpy as np

from program import ROOT, ProgramTest, history, replaced, run, summary

MESH = ROOT / "tests" / "meshes" / "tyre-205-55-r16.msh"
BELT = 22.0 * np.pi / 180.0
TYRE = f"""schema = 1
title = "tyre"
[section]
file = "{MESH}"
sectors = 120
clamped = ["rim-left", "rim-right"]
contact = "tread"
[material]
model = "neo-hooke"
shear_modulus = 1.5e6
poissons_ratio = 0.48
density = 1150.0
""" + "".join(f"""[[material.region]]
surface = "{surface}"
shear_modulus = {shear}
density = {density}
""" for surface, shear, density in (
    ("liner", 0.9e6, 1150.0), ("skim", 3e6, 1180.0), ("base", 1.5e6, 1120.0),
    ("sidewall", 0.9e6, 1120.0), ("apex", 8e6, 1180.0))) + f"""[[cords]]
curve = "carcass"
angle = {np.pi / 2}
stiffness = 1900.0
spacing = 1.0e-3
spacing_radius = 0.303
excess_mass = 8.74e-5
[[cords]]
curve = "belt-1"
angle = {BELT}
youngs_modulus = 2.0014144271570012e11
area = 1.414e-7
spacing = 1.2e-3
density = 7496.0
[[cords]]
curve = "belt-2"
angle = {-BELT}
stiffness = 28300.0
spacing = 1.2e-3
excess_mass = 8.930824e-4
[[cords]]
curve = "cap"
angle = 0.0
stiffness = 900.0
spacing = 1.0e-3
[inflation]
curve = "liner"
pressure = 2.2e5
[[inflation.mounting]]
curve = "rim-left"
axial = 0.004
[[inflation.mounting]]
curve = "rim-right"
axial = -0.004
"""
INFLATED = TYRE + """[analysis]
kind = "inflation"
"""
MOVING = TYRE.replace("sectors = 120", "sectors = 24") + """[damping]
mass = 20.0
stiffness = 1.5e-6
[motion]
angular_velocity = 33.0
speed = 10.3
height = 0.308
[time]
end = 0.004
[output]
snapshots = 3
"""
GROUND = """[ground]
profile = "flat"
friction = 0.9
"""
# As slow as if there were no inertia, one place a sector: what a prototype did.
ROLLING = TYRE.replace("sectors = 120", "sectors = 60") + GROUND + """[motion]
angular_velocity = 0.01
height = 0.299968
[analysis]
kind = "steady-rolling"
torque = 0.0
samples_per_sector = 1
slip = "upwind"
massless_contact = false
accept_scheme_power = true
"""


def cords_of(directory):
    """The rows of cords.csv by curve, each a dictionary of numbers."""
    layers = {}
    with open(directory / "cords.csv", newline="") as file:
        for row in csv.DictReader(file):
            curve = row.pop("curve")
            layers.setdefault(curve, []).append({k: float(v) for k, v in row.items()})
    return layers


class TyreTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.results = self.folder / "results"


class Inflation(TyreTest):
    def test_the_equilibrium_of_a_tyre(self):
        done = run("run", self.case(INFLATED), "-o", self.results)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("all loads in 5 equilibria", done.stderr)
        self.assertNotIn("energy balance", done.stderr)
        state = summary(self.results)["inflation"]
        # belt-1 lies between rubbers of 1150 and 1180 kg/m3: 249 m of its cords weigh .53 g more
        # than by the excess mass of belt-2.
        for name, value, digit in (("mass_kg", 8.192423 + 0.000528, 2e-6), ("outer_radius_m", 0.315968, 5e-7),
                                   ("growth_m", 6.684e-4, 1e-7), ("width_m", 0.20186, 5e-6),
                                   ("twist_m", 2.855e-4, 5e-8), ("det_f_min", 0.9676, 5e-5)):
            self.assertAlmostEqual(state[name], value, delta=digit, msg=name)
        self.assertAlmostEqual(state["cavity_volume_m3"], 0.02590495, delta=5e-8)
        self.assertLessEqual(state["newton_iterations"], 25)
        self.assertLess(state["residual"], 1e-10)
        forces = {c["curve"]: c["force_max_n"] for c in state["cords"]}
        for curve, force in (("carcass", 14.87), ("belt-1", 46.52), ("belt-2", 46.12)):
            self.assertAlmostEqual(forces[curve], force, delta=0.01, msg=curve)
        rows = history(self.results)
        np.testing.assert_allclose(rows["load_share"], np.linspace(0, 1, 6), atol=1e-12)
        np.testing.assert_allclose(rows["pressure_pa"], 2.2e5 * rows["load_share"], rtol=1e-12)
        self.assertEqual(rows["outer_radius_m"][-1], state["outer_radius_m"])

    def test_the_cords_along_their_curves(self):
        run("run", self.case(INFLATED), "-o", self.results, "--set", "section.sectors=60")
        layers = cords_of(self.results)
        self.assertEqual(list(layers), ["carcass", "belt-1", "belt-2", "cap"])
        for curve, angle in (("carcass", np.pi / 2), ("belt-1", BELT), ("belt-2", -BELT),
                             ("cap", 0.0)):
            for row in layers[curve]:
                self.assertAlmostEqual(row["angle_rad"], angle, places=12)
                self.assertLess(abs(row["angle_inflated_rad"] - angle), 0.01)
        for row in layers["belt-1"]:
            self.assertAlmostEqual(row["force_n"], 28300.0 * (row["stretch"] - 1), delta=0.02)
        z = [row["z_m"] for row in layers["belt-1"]]
        self.assertEqual(z, sorted(z))

    def test_the_snapshots_are_the_steps(self):
        run("run", self.case(INFLATED), "-o", self.results, "--set", "section.sectors=12",
            "--set", "inflation.steps=2")
        with h5py.File(self.results / "results.h5") as file:
            u = file["snapshots/displacement"][:]
            np.testing.assert_allclose(file["frame/time"][:], [0.0, 0.5, 1.0])
        self.assertEqual(np.abs(u[0]).max(), 0.0)
        per_sector = u.shape[1] // 12  # alike in all sectors, in their own axes
        first, fifth = (u[-1].reshape(12, per_sector, 3)[j] for j in (0, 5))
        turn = np.exp(2j * np.pi * 5 / 12) * (first[:, 0] + 1j * first[:, 1])
        np.testing.assert_allclose(fifth[:, 0] + 1j * fifth[:, 1], turn, atol=1e-15)
        np.testing.assert_array_equal(fifth[:, 2], first[:, 2])
        self.assertGreater(np.abs(first[:, 0]).max(), 1e-4)  # around: it twists

    def test_what_is_kept_where_there_is_no_equilibrium(self):
        done = run("run", self.case(INFLATED), "-o", self.results, "--set", "section.sectors=24",
                   "--set", "inflation.mounting=[{curve = 'rim-left', radial = 0.2}]")
        self.assertEqual(done.returncode, 3)
        self.assertIn("there is no equilibrium beyond 0.4 of the loads, 88000 Pa", done.stderr)
        self.assertIn("turns inside out", done.stderr)
        self.assertGreater(len(history(self.results)["load_share"]), 1)
        self.assertEqual(summary(self.results)["status"], "failed")
        done = run("check", self.folder / "case.toml", "--set", "section.sectors=24", "--set",
                   "inflation.spin=1500")  # jumps to another branch on the way
        self.assertEqual(done.returncode, 2)
        self.assertIn("rad/s is not stable: the wheel buckles in all sectors alike", done.stderr)

    def test_a_sweep_over_the_pressure(self):
        study = self.folder / "study.toml"
        self.case(INFLATED.replace("sectors = 120", "sectors = 24"))
        study.write_text('schema = 1\nbase = "case.toml"\n[[vary]]\n'
                         'key = "inflation.pressure"\nvalues = [1.5e5, 2.6e5]\n')
        done = run("sweep", study, "-o", self.results)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.results / "results.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        radius = [float(row["outer_radius_m"]) for row in rows]
        force = [float(row["cord_force_max_n"]) for row in rows]
        self.assertGreater(radius[1], radius[0])
        self.assertAlmostEqual(force[1] / force[0], 2.6 / 1.5, delta=0.1)


class AboutTheState(TyreTest):
    def test_the_wheel_stands_still(self):
        """Turned at the spin of its equilibrium, without ground, nothing moves."""
        done = run("run", self.case(MOVING), "-o", self.results)
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.results / "results.h5") as file:
            self.assertLess(np.abs(file["snapshots/displacement"][:]).max(), 1e-15)
        self.assertLess(summary(self.results)["energy_residual_relative"], 1e-12)

    def test_at_another_spin_it_grows_as_its_equilibrium_there(self):
        """Linear about one state, the wheel comes near the equilibrium at another spin."""
        still = ["--set", "inflation.spin=20", "--set", "initial.state=stationary"]
        done = run("run", self.case(MOVING), "-o", self.results, *still)
        self.assertIn("is far from the 20 rad/s", done.stderr)
        with h5py.File(self.results / "results.h5") as file:
            x = file["mesh/coordinates"][:, :2]
            u = file["snapshots/displacement"][0, :, :2]
        outer = np.argmax(np.linalg.norm(x, axis=1))
        growth = np.dot(u[outer], x[outer]) / np.linalg.norm(x[outer])
        radius = []
        for spin in (20, 33):
            out = self.folder / f"at-{spin}"
            run("run", self.case(INFLATED), "-o", out, "--set", "section.sectors=24", "--set",
                f"inflation.spin={spin}")
            radius.append(summary(out)["inflation"]["outer_radius_m"])
        self.assertAlmostEqual(growth / (radius[1] - radius[0]), 1.0, delta=0.02)

    def test_a_wheel_that_does_not_turn_shrinks(self):
        """From its equilibrium at 100 rad/s to rest, nearly to the equilibrium there."""
        done = run("run", self.case(MOVING), "-o", self.results, "--set", "inflation.spin=100",
                   "--set", "initial.state=stationary", "--set", "motion.angular_velocity=0", "--set",
                   "motion.speed=0", "--set", "time.end=1e-4")
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.results / "results.h5") as file:
            x = file["mesh/coordinates"][:, :2]
            u = file["snapshots/displacement"][0, :, :2]
        still = self.folder / "still"
        run("run", self.case(INFLATED), "-o", still, "--set", "section.sectors=24", "--set",
            "inflation.spin=0")
        radius = np.linalg.norm(x + u, axis=1).max()
        grown = np.linalg.norm(x, axis=1).max()
        expected = summary(still)["inflation"]["outer_radius_m"]
        self.assertGreater(grown - expected, 2e-4)
        self.assertAlmostEqual(radius, expected, delta=0.1 * (grown - expected))

    def rolling(self, *changes):
        out = self.folder / f"rolling-{len(list(self.folder.iterdir()))}"
        settings = [word for change in changes for word in ("--set", change)]
        done = run("run", self.case(ROLLING), "-o", out, *settings)
        self.assertEqual(done.returncode, 0, done.stderr)
        steady = summary(out)["steady"]
        return [steady[name] for name in ("force_y", "force_lateral", "moment_aligning")]

    def test_ply_steer_and_the_way_it_turns(self):
        load, force, moment = self.rolling()
        self.assertAlmostEqual(load, 3764.0, delta=25.0)  # of a prototype, at this depth
        self.assertAlmostEqual(force, -135.0, delta=6.0)
        self.assertAlmostEqual(moment, -3.37, delta=0.2)
        back = self.rolling("motion.angular_velocity=-0.01")
        np.testing.assert_allclose(back, [load, -force, moment], rtol=1e-6)
        swapped = self.rolling(f"cords[1].angle={-BELT}", f"cords[2].angle={BELT}")
        np.testing.assert_allclose(swapped, [load, -force, -moment], rtol=1e-6)

    def test_stiffness_grows_with_pressure_and_friction_counts(self):
        load = [self.rolling(f"inflation.pressure={p}")[0] for p in (1.5e5, 2.6e5)]
        self.assertGreater(load[1], 1.4 * load[0])
        corner = [self.rolling("motion.slip_angle=0.035", f"ground.friction={mu}")[1]
                  for mu in (0.9, 0.5)]
        self.assertLess(corner[0], 1.2 * corner[1])
        self.assertLess(corner[1], 0.0)

    def test_check_tells_the_state(self):
        done = run("check", self.case(MOVING))
        self.assertEqual(done.returncode, 0, done.stderr)
        for words in ("inflated           radius 0.3", "mass 8.107", 'cords "belt-1"',
                      "largest stretch"):
            self.assertIn(words, done.stdout)


class Refused(TyreTest):
    def refused(self, text, fragment, *settings):
        arguments = [word for setting in settings for word in ("--set", setting)]
        done = run("check", self.case(text), *arguments)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertIn(fragment, done.stderr)

    def test_what_is_refused_before_anything_is_built(self):
        without = TYRE[:TYRE.index("[inflation]")]
        for text, fragment, settings in (
                (without + INFLATED[len(TYRE):], '"inflation" needs the table [inflation]',
                 ["cords=[]"]),
                (without + MOVING[MOVING.index("[damping]"):], "[inflation] beside them", []),
                (INFLATED, "0.384", ["cords=[{curve='cap', angle=22, stiffness=1, spacing=1}]"]),
                (INFLATED, "is missing, and so is youngs_modulus",
                 ["cords=[{curve='cap', angle=0, spacing=1}]"]),
                (INFLATED, "one of both",
                 ["cords=[{curve='cap', angle=0, spacing=1, stiffness=1, youngs_modulus=1}]"]),
                (INFLATED, "cords[0].spacing = 0",
                 ["cords=[{curve='cap', angle=0, spacing=0, stiffness=1}]"]),
                (INFLATED, "would overlap",
                 ["cords=[{curve='cap', angle=0, spacing=1e-3, stiffness=1, area=1e-6}]"]),
                (INFLATED, "needs the area of a cord",
                 ["cords=[{curve='cap', angle=0, spacing=1e-3, stiffness=1, density=1e3}]"]),
                (INFLATED, "has no effect without green_radius",
                 ["cords=[{curve='cap', angle=1, spacing=1, stiffness=1, green_extension=0.1}]"]),
                (INFLATED, "they cannot turn",
                 ["cords=[{curve='cap', angle=0, spacing=1, stiffness=1, green_radius=0.3}]"]),
                (replaced(INFLATED, "curve = \"liner\"", None), "there is no wall", []),
                (INFLATED, "shear_modulus = E / (2 (1 + ν)) = 1.01351e+06",
                 ["material.model=linear", "material.youngs_modulus=3e6"]),
                (INFLATED, "is the name of another one",
                 ["inflation.mounting=[{curve='rim-left'}, {curve='rim-left'}]"]),
                (MOVING, "linear about one pressure",
                 ["load.pressure=[{curve='liner', value=1e5}]"]),
                (MOVING, "the stress of an inflated wheel is not computed", ["output.stress=true"])):
            with self.subTest(fragment):
                self.refused(text, fragment, *settings)

    def test_what_the_section_cannot_carry(self):
        belt = "cords=[{curve='belt-1', angle=1.2, stiffness=1, spacing=1e-4, "
        for fragment, settings in (
                ("which is not held: the air would leak", ["inflation.curve=tread"]),
                ("cords[0].curve", ["cords=[{curve='belt', angle=0, stiffness=1, spacing=1}]"]),
                ("is not held: the rim moves", ["inflation.mounting=[{curve='tread'}]"]),
                ("has a mass of -", ["cords=[{curve='carcass', angle=1.57, stiffness=1900.0, "
                                     "spacing=1e-3, excess_mass=-1.0}]"]),
                ("its cords do nothing", ["cords=[{curve='rim-left', angle=0, stiffness=1.0, "
                                          "spacing=1e-3}]"]),
                ("high together", [belt.replace("1e-4", "5e-2") + "area=1.9e-3}]"]),
                ("lie around the wheel before they reach",
                 [belt + "green_radius=0.1}]"]),
                ("buckles in all sectors alike", ["cords=[" + ", ".join(
                    f"{{curve='{curve}', angle={angle}, stiffness=28300.0, spacing=1.2e-3, "
                    "prestrain=-0.02}" for curve, angle in (("belt-1", BELT), ("belt-2", -BELT)))
                    + "]"])):
            with self.subTest(fragment):
                self.refused(INFLATED, fragment, "section.sectors=40", *settings)

    def test_a_pressure_in_bar(self):
        done = run("check", self.case(INFLATED), "--set", "inflation.pressure=2.2")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("inflation.pressure reaches 2.2 Pa at most", done.stderr)
        self.assertIn("not in bar", done.stderr)

    def test_a_plane_body(self):
        plane = (ROOT / "cases" / "rubber-rolling.toml").read_text()
        self.refused(plane + "\n[inflation]\npressure = 1e5\n", "the body is plane")


if __name__ == "__main__":
    unittest.main()

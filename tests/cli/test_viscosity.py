# SPDX-License-Identifier: BSD-3-Clause
"""Viscous materials at small strain: the viscoelastic cylinders of Wang and Knothe, steps in time beside steady
rolling, wheels and tyres, and what is refused."""
import re
import shutil
import unittest

import h5py
import numpy as np

from program import ROOT, SMALL, RunTest, contact, history, replaced, run, summary
from test_tyre_nonlinear import COARSE

# Two equal cylinders of radius .1 m, of G = 571.5 MPa at slow strains and as much again in one branch, are one on
# rigid ground of the same radius: this disk has half of the load's curvature and half of the stiffness (CONTACT,
# visc_cylindr; Wang and Knothe, J. Appl. Mech. 60 (1993) 310).
CYLINDER = """schema = 1
[disk]
outer_radius = 0.1
inner_radius = 0.01
[disk.mesh]
radial = 36
circumferential = 3600
grading = 4.0
[material]
youngs_modulus = 1600.2e6
poissons_ratio = 0.4
density = 1000.0
[motion]
angular_velocity = 10.0
speed = 1.0
[ground]
profile = "flat"
friction = 0.0
[analysis]
kind = "steady-rolling"
load = 6e5
inertia = "none"
samples_per_sector = 1
massless_contact = false
"""
WHEEL = (ROOT / "cases" / "wheel3d-steady.toml").read_text()
LOSS = ("--set", "material.loss_factor=0.15", "--set", "material.loss_band=[5.0, 500.0]")


def branch(time, modulus=1.0):
    return ("--set", f"material.viscosity=[{{relative_modulus = {modulus}, time = {time!r}}}]")


def heavy_cylinder():
    """So heavy that steps are long; waves are still 80 times as fast as the ground."""
    text = CYLINDER
    for leaf, value in (("radial", "8"), ("circumferential", "480"), ("grading", "2.0"), ("density", "5e4")):
        text = replaced(text, leaf, f"{leaf} = {value}")
    return text


def lowered(text, height, end):
    """The same in time, lowered to a height in 8 ms."""
    in_time = text[:text.index("[analysis]")] + f"""[time]
end = {end}
[output]
snapshots = 0
history_interval = 1e-4
"""
    return replaced(in_time, "speed", f"speed = 1.0\nheight = [[0.0, 0.1], [0.008, {height!r}]]")


def tyre(load, pressure=2.2e5):
    return COARSE.replace("sectors = 90", "sectors = 60").replace("pressure = 2.2e5", f"pressure = {pressure!r}") + f"""
[motion]
angular_velocity = 40.0
[ground]
profile = "flat"
friction = 0.9
[analysis]
kind = "steady-rolling"
load = {load}
torque = 0.0
samples_per_sector = 2
inertia = "none"
"""


class Viscosity(RunTest):
    def state(self, text, *words):
        done = run("run", self.case(text), "-o", self.out, "--overwrite", "--quiet", *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        told = summary(self.out)
        self.assertLess(told["energy_residual_relative"], 1e-9)
        return told["steady"]

    def test_cylinders_of_wang_and_knothe(self):
        """Pressure [MPa], edges of contact [mm] and moment about the axle over the radius [N/m] for each time of
        relaxation [s]; in brackets in docs/rolling-resistance.md the values of CONTACT, within 1 %."""
        for time, pressure, edges, resistance in ((0.0, 61.00, (-6.25, 6.25), 0.0), (0.0045, 79.54, (-3.88, 5.84), 7293.9),
                                                  (0.0225, 85.51, (-3.89, 4.96), 3582.8), (1.0, 86.06, (-4.33, 4.35), 119.6)):
            with self.subTest(time=time):
                s = self.state(CYLINDER, *(branch(time) if time else ()))
                rows = contact(self.out)
                x = 1e3 * rows["x_m"][rows["pressure_pa"] > 0.0]
                self.assertAlmostEqual(s["pressure_max"] / 1e6, pressure, delta=2e-3 * pressure)
                self.assertAlmostEqual(s["torque"] / 0.1, resistance, delta=max(2e-3 * resistance, 1e-6))
                np.testing.assert_allclose((x.min(), x.max()), edges, atol=0.01)
                self.assertAlmostEqual(s["power"]["viscosity"], s["rolling_resistance"], delta=5.0)  # 1 m/s

    def test_steps_in_time_lose_what_the_steady_state_does(self):
        steady = self.state(heavy_cylinder(), *branch(0.0045))
        done = run("run", self.case(lowered(heavy_cylinder(), steady["height"], 0.03)), "-o", self.out, "--overwrite", "--quiet", *branch(0.0045))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertLess(summary(self.out)["energy_residual_relative"], 1e-12)
        h = history(self.out)
        self.assertLess(np.abs(h["integration"]).max(), 1e-12)
        self.assertGreaterEqual(np.diff(h["dissipation_viscous"]).min(), 0.0)
        late = h["time_s"] > 0.018
        for name, bound in (("force_y", 0.01), ("torque", 0.02)):
            self.assertAlmostEqual(np.mean(h[name][late]) / steady[name], 1.0, delta=bound, msg=name)
        loss = np.polyfit(h["time_s"][late], h["dissipation_viscous"][late], 1)[0]
        self.assertAlmostEqual(loss / steady["power"]["viscosity"], 1.0, delta=0.01)

    def test_a_reduced_wheel_loses_what_the_steady_state_does(self):
        """Its load, its torque and the loss of its material, at a step of which the shortest branch has 1.6 and at a
        small one; without modes all of them are of the residual."""
        steady = self.state(heavy_cylinder(), *branch(0.0045), "--set", "analysis.samples_per_sector=16", "--set",
                            "analysis.massless_contact=true")
        case = self.case(lowered(heavy_cylinder(), steady["height"], 0.06))
        for words, bound in (((), 5e-3), (("--modes", 0), 5e-3), (("--reduced-step", 1e-4), 1.5e-3)):
            with self.subTest(words=words):
                done = run("run", case, "--reduced", "-o", self.out, "--overwrite", "--quiet", *branch(0.0045), *words)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertLess(summary(self.out)["energy_residual_relative"], 1e-12)
                h = history(self.out)
                self.assertLess(np.abs(h["integration"]).max(), 1e-12)
                self.assertGreaterEqual(np.diff(h["dissipation_viscous"]).min(), 0.0)
                late = h["time_s"] > 0.036
                for name in ("force_y", "torque"):
                    self.assertAlmostEqual(np.mean(h[name][late]) / steady[name], 1.0, delta=bound, msg=name)
                loss = np.polyfit(h["time_s"][late], h["dissipation_viscous"][late], 1)[0]
                self.assertAlmostEqual(loss / steady["power"]["viscosity"], 1.0, delta=bound)

    def test_a_fast_reduced_wheel_has_the_inertia_of_what_no_mode_has(self):
        """At 30 m/s without modes, where a residual without inertia has 1.3 % too much load."""
        text = (ROOT / "cases" / "steady-rolling.toml").read_text()
        for leaf, value in (("angular_velocity", "100.0"), ("speed", "30.0"), ("friction", "0.0"), ("mass", "0.0"),
                            ("stiffness", "0.0")):
            text = replaced(text, leaf, f"{leaf} = {value}")
        words = (*LOSS, "--set", "analysis.samples_per_sector=16", "--set", "analysis.massless_contact=true")
        steady = self.state(text, *words)
        in_time = replaced(text[:text.index("[analysis]")], "height", "height = [[0.0, 0.31], [0.02, 0.29]]")
        done = run("run", self.case(in_time + "[time]\nend = 0.4\n"), "--reduced", "-o", self.out, "--overwrite", "--quiet",
                   "--modes", 0, "--set", "output.snapshots=0", *LOSS)
        self.assertEqual(done.returncode, 0, done.stderr)
        h = history(self.out)
        late = h["time_s"] > 0.3
        self.assertAlmostEqual(np.mean(h["force_y"][late]) / steady["force_y"], 1.0, delta=1e-3)
        loss = np.polyfit(h["time_s"][late], h["dissipation_viscous"][late], 1)[0]
        self.assertAlmostEqual(loss / steady["power"]["viscosity"], 1.0, delta=0.02)

    def test_a_reduced_wheel_resumes_and_keeps_its_file(self):
        """Of a rim with tables and of one that moves; modes of a file are those of the same branches."""
        free = replaced(SMALL, "height", "height = 0.3") + """[rim]
free = ["height", "angular_velocity"]
mass = 100.0
inertia = 1.0
force_y = -1.5e5
"""
        for text in (SMALL, free):
            case = self.case(text)
            words = (*LOSS, "--quiet", "--overwrite")
            file = self.folder / "wheel.h5"
            done = run("reduce", case, "-o", file, *LOSS)
            self.assertEqual(done.returncode, 0, done.stderr)
            out, half = self.folder / "whole", self.folder / "half"
            for directory, more in ((out, ("--reduced",)), (self.out, ("--reduced", file)),
                                    (half, ("--reduced", "--set", "time.end=0.01"))):
                done = run("run", case, "-o", directory, *words, *more)
                self.assertEqual(done.returncode, 0, done.stderr)
            done = run("run", case, "--reduced", "-o", half, "--resume", *LOSS, "--quiet")
            self.assertEqual(done.returncode, 0, done.stderr)
            whole, again = history(out), history(half)
            self.assertGreater(whole["dissipation_viscous"][-1], 0.0)
            self.assertEqual((out / "history.csv").read_bytes(), (self.out / "history.csv").read_bytes())
            for name in whole:
                self.assertEqual(whole[name][-1], again[name][-1], name)
            with h5py.File(file) as f:
                terms, branches = f["/residual/creep"][:], f["/material/branches"][:]
                self.assertEqual(f["/residual/compliance_later"].shape, f["/residual/compliance"].shape)
            self.assertEqual((len(terms), len(branches)), (5, 4))
            self.assertAlmostEqual(terms[:, 0].sum(), 1.0, delta=1e-12)
            done = run("run", case, "--reduced", file, "-o", self.out, "--overwrite")
            self.assertEqual(done.returncode, 2)
            self.assertIn("loss_factor", done.stderr)

    def test_a_run_resumes_bit_for_bit(self):
        wheel = replaced(WHEEL[:WHEEL.index("[analysis]")], "circumferential", "circumferential = 40") + """[time]
end = 0.004
[output]
history_interval = 1e-4
"""
        plane = wheel
        for leaf in ("width", "axial", "slip_angle"):
            plane = replaced(plane, leaf, None)
        for text in (wheel, plane):
            case = self.case(text)
            words = (*LOSS, "--quiet", "--overwrite", "--set", "output.snapshots=2")
            done = run("run", case, "-o", self.out, *words)
            self.assertEqual(done.returncode, 0, done.stderr)
            half = self.folder / "half"
            shutil.rmtree(half, ignore_errors=True)
            done = run("run", case, "-o", half, *words, "--set", "time.end=0.002")
            self.assertEqual(done.returncode, 0, done.stderr)
            done = run("run", case, "-o", half, "--resume", *LOSS, "--quiet", "--set", "output.snapshots=2")
            self.assertEqual(done.returncode, 0, done.stderr)
            whole, again = history(self.out), history(half)
            self.assertGreater(whole["dissipation_viscous"][-1], 0.0)
            for name in whole:
                self.assertEqual(whole[name][-1], again[name][-1], name)

    def test_what_a_run_wrote_is_read_again(self):
        """Of linear materials and rubber, whose regions differ by a factor or by branches."""
        small = replaced(replaced(CYLINDER, "radial", "radial = 4"), "circumferential", "circumferential = 60")
        rubber = tyre(3000.0).replace("sectors = 60", "sectors = 12")
        for text, own in ((small, "layers = [3, 4]"), (rubber, "surface = 'carcass'")):
            for words in (LOSS, branch(0.01)):
                for region in ("loss_factor = 0.3", "loss_factor = 0", "viscosity = [[0.2, 0.01]]", "viscosity = []"):
                    band = LOSS[2:] if region == "loss_factor = 0.3" and words != LOSS else ()
                    case = self.case(text if text == small else text.replace("[[cords]]", f"""[[material.region]]
{own.replace("'", '"')}
{region}
[[cords]]""", 1))
                    more = ("--set", f"material.region=[{{{own}, {region}}}]") if text == small else ()
                    done = run("run", case, "-o", self.out, "--overwrite", "--quiet", *words, *band, *more, "--set", "analysis.accept_scheme_power=true")
                    self.assertEqual(done.returncode, 0, (done.stderr, words, region))
                    once = (self.out / "case.toml").read_text()
                    again = run("run", self.out / "case.toml", "-o", self.folder / "again", "--overwrite", "--quiet")
                    self.assertEqual(again.returncode, 0, (again.stderr, words, region))
                    self.assertEqual(once, (self.folder / "again" / "case.toml").read_text())
                    self.assertEqual(summary(self.out)["steady"]["power"], summary(self.folder / "again")["steady"]["power"])

    def test_without_a_lateral_contraction_a_wheel_is_the_plane_disk(self):
        """And the shares of its regions add up."""
        plane = replaced(replaced(CYLINDER, "radial", "radial = 8"), "circumferential", "circumferential = 240")
        plane = replaced(replaced(plane, "poissons_ratio", 'poissons_ratio = 0.0\nplane = "stress"'), "grading", "grading = 1.5")
        regions = ("--set", "material.region=[{layers = [7, 8], youngs_modulus = 8e8, loss_factor = 0.3}]")
        flat = self.state(plane, *LOSS, *regions)
        wide = replaced(plane, "plane", None).replace("inner_radius = 0.01", "inner_radius = 0.01\nwidth = 0.02")
        wide = replaced(wide, "grading", "grading = 1.5\naxial = 2").replace("load = 6e5", "load = 1.2e4")
        wheel = self.state(wide, *LOSS, *regions)
        self.assertGreater(flat["power"]["viscosity"], 100.0)
        for found, scale in ((flat, 1.0), (wheel, 0.02)):
            parts = {part["region"]: part["power"] / scale for part in found["viscous_power"]}
            self.assertEqual(list(parts), ["material", "layers 7, 8"])
            self.assertAlmostEqual(sum(parts.values()), found["power"]["viscosity"] / scale, delta=1e-9)
            for name, power in parts.items():
                expected = next(p["power"] for p in flat["viscous_power"] if p["region"] == name)
                self.assertAlmostEqual(power / expected, 1.0, delta=1e-8, msg=name)

    def test_rolling_resistance_of_a_tyre(self):
        """It falls with the pressure, and grows faster than the load."""
        base = self.state(tyre(3000.0), *LOSS)
        per_load = base["rolling_resistance"] / 3000.0
        self.assertTrue(0.002 < per_load < 0.012, per_load)
        self.assertAlmostEqual(base["power"]["viscosity"] / base["speed"] / base["rolling_resistance"], 1.0, delta=0.05)
        self.assertLess(base["scheme_share"], 0.05)
        self.assertIn("tread", [part["region"] for part in base["viscous_power"]])
        self.assertLess(self.state(tyre(3000.0, 2.8e5), *LOSS)["rolling_resistance"], 0.95 * base["rolling_resistance"])
        self.assertLess(self.state(tyre(1500.0), *LOSS)["rolling_resistance"], 0.45 * base["rolling_resistance"])
        less = self.state(tyre(3000.0), "--set", "material.loss_factor=0.075", *LOSS[2:])
        self.assertAlmostEqual(less["rolling_resistance"] / base["rolling_resistance"], 0.5, delta=0.1)

    def test_modes_are_damped_by_half_of_the_loss_factor(self):
        """The loss factor is .15 to 2.4 % within the band, and the frequency is as the stiffness there."""
        ring = replaced(replaced(CYLINDER[:CYLINDER.index("[analysis]")], "radial", "radial = 6"), "circumferential",
                        "circumferential = 48")
        ring = replaced(replaced(ring, "grading", None), "youngs_modulus", "youngs_modulus = 1e6")
        ring = replaced(ring, "speed", "speed = 1.0\nheight = 0.1") + "[time]\nend = 1.0\n"
        wide = ring.replace("inner_radius = 0.01", "inner_radius = 0.01\nwidth = 0.02").replace("radial = 6", "radial = 6\naxial = 2")
        for text in (ring, wide):
            case, slow = self.case(text), []
            for words in ((), LOSS):
                done = run("modes", case, "-o", self.out, "--overwrite", "--quiet", *words)
                self.assertEqual(done.returncode, 0, done.stderr)
                table = np.genfromtxt(self.out / "modes.csv", delimiter=",", names=True, dtype=None, encoding=None)
                if not words:
                    slow = table["frequency_hz"]
            found = table["frequency_hz"]
            self.assertTrue((found > 5.0).all() and (found < 500.0).all(), found)
            np.testing.assert_allclose(table["damping_ratio"], 0.075, rtol=0.1)
            self.assertTrue(((found / slow) ** 2 > 1.15).all() and ((found / slow) ** 2 < 1.9).all())

    def test_check_tells_the_loss_factor(self):
        case = self.case(replaced(CYLINDER, "circumferential", "circumferential = 60"))
        told = run("check", case, *LOSS).stdout
        self.assertIn("4 branches, tan δ within 2.4 % of 0.15 from 5 to 500 Hz", told)
        self.assertIn("0.166 and 1.89 at 100 Hz", run("check", case, *branch(0.0045)).stdout)

    def test_what_a_reduced_wheel_refuses(self):
        case = self.case(SMALL)
        regions = ("--set", "material.region=[{layers = [3], loss_factor = 0.3}]")
        none = ("--set", "material.region=[{layers = [3], loss_factor = 0}]")
        second = ("--set", "material.region=[{layers = [1], youngs_modulus = 1e7}, {layers = [3], loss_factor = 0.3}]")
        stiffened = ("--set", "material.stress_stiffening=centrifugal")
        for words, key, what in (((*LOSS, *regions), "material.region[0]", "creep as a whole"),
                                 ((*LOSS, *none), "material.region[0]", "regions differ"),
                                 ((*LOSS, *second), "material.region[1]", "regions differ"),
                                 ((*LOSS, *stiffened), "material.stress_stiffening", "of the stress does not")):
            done = run("check", case, "--reduced", *words)
            self.assertEqual(done.returncode, 2, (words, done.stdout))
            self.assertIn(key, done.stderr)
            self.assertIn(what, done.stderr)
            self.assertIn("--reduced", done.stderr)
            self.assertEqual(run("check", case, *words).returncode, 0)
        # Regions of other moduli with the same branches creep alike.
        done = run("check", case, "--reduced", *LOSS, "--set", "material.region=[{layers = [3], youngs_modulus = 1e7}]")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"creep +0\.4\d+ of the compliance in .* of the shortest branch")

    def test_a_reduced_wheel_takes_branches_that_its_mesh_does_not_resolve(self):
        """They are relaxed in it: without them the forces are the same."""
        case = self.case(SMALL)
        self.assertEqual(run("check", case, *branch(1e-7, 0.3)).returncode, 2)
        done = run("check", case, "--reduced", *branch(1e-7, 0.3))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("material.viscosity", done.stderr)
        found = []
        for words in ((), branch(1e-7, 0.3)):
            done = run("run", case, "--reduced", "-o", self.out, "--overwrite", "--quiet", *words)
            self.assertEqual(done.returncode, 0, done.stderr)
            found.append(history(self.out))
            self.assertLess(summary(self.out)["energy_residual_relative"], 1e-12)
        without, fast = found
        load = np.abs(without["force_y"]).max()
        for name in ("force_x", "force_y"):
            self.assertLess(np.abs(fast[name] - without[name]).max() / load, 1e-3, name)
        self.assertGreaterEqual(np.diff(fast["dissipation_viscous"]).min(), 0.0)
        self.assertLess(fast["dissipation_viscous"][-1], 1e-3 * abs(fast["work_rim"][-1]))
        file = self.folder / "wheel.h5"
        self.assertEqual(run("reduce", case, "-o", file, *branch(1e-7, 0.3)).returncode, 0)

    def test_the_frequency_that_a_refusal_allows_is_accepted(self):
        """Though the step grows as the band becomes narrower. With damping and without, refused and warned of."""
        case = self.case(SMALL)
        for damping in ("1e-5", "0"):
            def told(highest):
                return run("check", case, *LOSS[:2], "--set", f"material.loss_band=[5, {highest}]", "--set",
                           f"damping.stiffness={damping}")  # noqa: B023
            refused = told(50000)
            self.assertEqual(refused.returncode, 2, refused.stdout)
            most, resolved = re.search(r"at most about (\S+) Hz, below (\S+) Hz", refused.stderr).groups()
            warned = told(most)
            self.assertEqual(warned.returncode, 0, warned.stderr)
            self.assertEqual(warned.stderr.count("its losses are rough"), 1, warned.stderr)
            self.assertEqual(told(1.3 * float(most)).returncode, 2)
            quiet = told(resolved)
            self.assertEqual((quiet.returncode, "material.loss_band" in quiet.stderr), (0, False), quiet.stderr)

    def test_what_is_refused(self):
        small = replaced(CYLINDER, "circumferential", "circumferential = 60")
        in_time = replaced(small[:small.index("[analysis]")], "speed", "speed = 1.0\nheight = 0.1") + "[time]\nend = 0.01\n"
        for text, words, key, what in (
                (small, LOSS[:2], "material.loss_band", "is missing"),
                (small, LOSS[2:], "material.loss_band", "there is none"),
                (small, (*LOSS[:2], "--set", "material.loss_band=[500.0, 5.0]"), "material.loss_band", "no band"),
                (small, (*LOSS, *branch(1.0)), "material.loss_factor", "together with viscosity"),
                (small, branch(1.0, -1.0), "relative_modulus", "out of bounds"),
                (in_time, (*LOSS, "--set", "initial.state=steady-rolling"), "initial.state", "have relaxed"),
                (in_time, (*LOSS, "--set", "time.scheme=as-printed"), "material.loss_factor", "symplectic"),
                (in_time, (*LOSS, "--set", "solver.contact_mass=singular"), "material.loss_factor", "slow strains"),
                (in_time, branch(1e-12), "material.viscosity[0].time", "the step passes over it"),
                (tyre(3000.0), (*LOSS, "--set", "inflation.nonlinear=all"), "material.loss_factor", "nonlinear")):
            done = run("check", self.case(text), *words)
            self.assertEqual(done.returncode, 2, (words, done.stdout))
            self.assertIn(key, done.stderr)
            self.assertIn(what, done.stderr)


if __name__ == "__main__":
    unittest.main()

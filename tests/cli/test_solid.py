# SPDX-License-Identifier: BSD-3-Clause
"""Wheels in three dimensions from outside: what their runs write, that left and right are mirrored,
that they resume to the same bits, and what they do not go with."""
import json
import re
import signal
import subprocess
import time
import unittest

import h5py
import numpy as np

from program import PROGRAM, ROOT, ProgramTest, contact, history, replaced, run, said, summary

# A box wheel that corners, already on the ground: 2×3×40 hexahedra.
WHEEL = """schema = 1
title = "cornering"
[disk]
outer_radius = 0.30
inner_radius = 0.15
width = 0.1
[disk.mesh]
radial = 2
circumferential = 40
axial = 3
[material]
youngs_modulus = 2.0e7
poissons_ratio = 0.3
density = 1100.0
[damping]
mass = 200.0
stiffness = 2.0e-5
[motion]
angular_velocity = 33.8
speed = 10.0
height = [[0, 0.3], [0.004, 0.294]]
slip_angle = 0.03
camber = 0.0
[ground]
profile = "flat"
friction = 0.3
[time]
end = 0.02
[output]
snapshots = 5
"""
TYRE_CASE = ROOT / "cases" / "wheel3d-tyre.toml"
LATERAL = ("force_lateral", "moment_aligning", "moment_overturning")

# Five quadrilaterals of a section round the cavity of a tyre, in mm: r from 150 to 300, z from -50
# to 50; physical curves "rim" (the feet), "inside", "tread", physical surfaces "side" and "top".
SECTION = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
5
1 1 "rim"
1 2 "inside"
1 3 "tread"
2 4 "side"
2 5 "top"
$EndPhysicalNames
$Nodes
12
1 150 -50 0
2 150 -30 0
3 270 -50 0
4 270 -30 0
5 300 -50 0
6 300 50 0
7 270 30 0
8 270 50 0
9 150 30 0
10 150 50 0
11 300 -30 0
12 300 30 0
$EndNodes
$Elements
13
1 1 2 1 1 1 2
2 1 2 1 2 9 10
3 1 2 2 3 2 4
4 1 2 2 4 4 7
5 1 2 2 5 7 9
6 1 2 3 6 5 11
7 1 2 3 7 11 12
8 1 2 3 8 12 6
9 3 2 4 9 1 3 4 2
10 3 2 4 10 9 7 8 10
11 3 2 5 11 3 5 11 4
12 3 2 5 12 4 11 12 7
13 3 2 5 13 7 12 6 8
$EndElements
"""
TYRE = """schema = 1
title = "a tyre"
[section]
file = "tyre.msh"
scale = 1e-3
clamped = "rim"
contact = "tread"
sectors = 36
[material]
youngs_modulus = 2.0e7
poissons_ratio = 0.3
density = 1100.0
[[material.region]]
surface = "top"
youngs_modulus = 5.0e7
[damping]
mass = 200.0
stiffness = 2.0e-5
[motion]
angular_velocity = 0.0
speed = 0.0
height = 0.5
[[load.pressure]]
curve = "inside"
value = 2.0e5
[time]
end = 0.02
[output]
snapshots = 3
"""


class SolidTest(ProgramTest):
    def of(self, *settings, text=WHEEL, name="out", code=0):
        """Runs a case with settings; its directory."""
        out = self.folder / name
        more = [word for setting in settings for word in ("--set", setting)]
        done = run("run", self.case(text), "-o", out, "--quiet", "--overwrite", *more)
        self.assertEqual(done.returncode, code, done.stderr)
        return out

    def refused(self, *settings, text=WHEEL, command="check"):
        more = [word for setting in settings for word in ("--set", setting)]
        done = run(command, self.case(text), *more)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        return done.stderr


class Results(SolidTest):
    def test_history_has_the_lateral_force_in_newton(self):
        out = self.of()
        units = {column["name"]: column["unit"] for column in summary(out)["columns"]}
        for name, unit in {"force_y": "N", "force_lateral": "N", "torque": "N·m", "kinetic": "J",
                           "moment_aligning": "N·m", "moment_overturning": "N·m",
                           "contact_area_m2": "m2", "slip_angle": "rad"}.items():
            self.assertEqual(units[name], unit, name)
        self.assertNotIn("contact_length_m", units)
        self.assertFalse([name for name, unit in units.items() if unit.endswith("/m")])
        rows = history(out)
        self.assertEqual(list(rows), list(units))
        self.assertEqual(rows["slip_angle"][-1], 0.03)
        # The wheel travels to the right, its ground pulls to the left and turns it back.
        self.assertGreater(rows["force_y"][-1], 1000.0)
        self.assertLess(rows["force_lateral"][-1], -0.02 * rows["force_y"][-1])
        self.assertLess(rows["moment_aligning"][-1], 0.0)
        way = 10.0 * rows["time_s"]
        np.testing.assert_allclose(rows["center_x_m"], way * np.cos(0.03), rtol=1e-12)
        np.testing.assert_allclose(rows["center_lateral"], way * np.sin(0.03), rtol=1e-12)

    def test_run_json_tells_the_wheel(self):
        told = summary(self.of())
        self.assertEqual(told["dimensions"], 3)
        self.assertEqual(told["sectors"], 40)
        self.assertAlmostEqual(told["width"], 0.1)
        self.assertEqual(told["nodes"], 3 * 4 * 40)
        self.assertEqual(told["dofs"], 3 * 2 * 4 * 40)
        self.assertLess(told["energy_residual_relative"], 1e-12)
        self.assertLess(told["contact_residual_max"], 1e-12)
        self.assertGreater(told["strain_max"], 0.001)
        self.assertEqual(len(told["strain_max_place"]), 3)
        self.assertLess(told["jacobian_min"], 1.0)

    def test_results_have_three_components(self):
        out = self.of("motion.camber=0.05")
        with h5py.File(out / "results.h5") as file:
            n, nb = 480, len(file["mesh/boundary"])
            shapes = {"mesh/coordinates": (n, 3), "mesh/hexahedra": (240, 8),
                      "snapshots/displacement": (5, n, 3), "snapshots/velocity": (5, n, 3),
                      "contact/force": (5, nb, 3), "contact/traction": (5, nb, 3),
                      "fields/cauchy_stress": (5, n, 6), "frame/lateral": (5,)}
            for name, shape in shapes.items():
                self.assertEqual(file[name].shape, shape, name)
            self.assertEqual(file["mesh/mass"].attrs["units"], "kg")
            self.assertEqual(file["mesh/tributary"].attrs["units"], "m2")
            self.assertEqual(file["contact/force"].attrs["units"], "N")
            # Faces of the undeformed wheel, to the second order of 40 sectors.
            self.assertAlmostEqual(np.sum(file["mesh/tributary"]), 0.2 * np.pi * 0.3, delta=3e-4)
            self.check_places(file)
            force, fixed = file["contact/force"][-1], file["fields/contact_force"][-1]
            boundary = file["mesh/boundary"][:]
            # Flat ground that leans by the camber: n = (0, cos, sin), J n = -t1, t2 = (0, -sin, cos).
            cos, sin = np.cos(0.05), np.sin(0.05)
            axes = np.array([[0, cos, sin], [-1, 0, 0], [0, -sin, cos]])
            np.testing.assert_allclose(fixed[boundary], force @ axes, rtol=1e-5, atol=1e-3)
            self.assertGreater(np.abs(file["fields/cauchy_stress"][-1]).max(axis=0).min(), 1e3)
            self.assert_rows_of(out, file)
        self.assertIn('TopologyType="Hexahedron"', (out / "fields.xdmf").read_text())

    def check_places(self, file):
        """/fields/position from /snapshots and /frame."""
        angle, center = file["frame/angle"][-1], file["frame/center"][-1]
        lateral = file["frame/lateral"][-1]
        arm = file["mesh/coordinates"][:] + file["snapshots/displacement"][-1]
        cos, sin = np.cos(angle), np.sin(angle)
        turned = arm @ np.array([[cos, sin, 0], [-sin, cos, 0], [0, 0, 1]])
        c, s = np.cos(0.05), np.sin(0.05)
        middle = [center[0], c * center[1] - s * lateral, s * center[1] + c * lateral]
        np.testing.assert_allclose(file["fields/position"][-1], turned + middle, atol=1e-6)

    def assert_rows_of(self, out, file):
        """contact.csv: the tractions of results.h5, at places on the ground."""
        rows = contact(out)
        last = rows["time_s"] == file["frame/time"][-1]
        self.assertGreater(last.sum(), 3)
        place = {node: k for k, node in enumerate(file["mesh/boundary"][:])}
        candidates = [place[int(node)] for node in rows["node"][last]]
        traction = file["contact/traction"][-1][candidates]
        np.testing.assert_array_equal(rows["pressure_pa"][last], traction[:, 0])
        np.testing.assert_array_equal(rows["shear_x_pa"][last], -traction[:, 1])
        np.testing.assert_array_equal(rows["shear_lateral_pa"][last], traction[:, 2])
        np.testing.assert_allclose(rows["y_m"][last], 0.0, atol=1e-3)
        self.assertLess(np.ptp(rows["x_m"][last]), 0.2)
        self.assertLess(np.ptp(rows["z_m"][last]), 0.11)
        self.assertLessEqual(set(rows["sticks"]), {0.0, 1.0})
        shear = np.hypot(rows["shear_x_pa"], rows["shear_lateral_pa"])
        slips = rows["sticks"] == 0.0
        np.testing.assert_allclose(shear[slips], 0.3 * rows["pressure_pa"][slips], rtol=1e-9)

    def test_left_and_right_are_mirrored(self):
        for key in ("motion.slip_angle", "motion.camber"):
            zero = "motion.slip_angle=0" if key != "motion.slip_angle" else "motion.camber=0"
            one = history(self.of(zero, f"{key}=0.04", name="one"))
            other = history(self.of(zero, f"{key}=-0.04", name="other"))
            scale = one["force_y"].max()
            self.assertGreater(np.abs(one["force_lateral"]).max(), 0.01 * scale)
            for name in LATERAL:
                np.testing.assert_allclose(one[name], -other[name], atol=1e-9 * scale, err_msg=name)
            for name in ("force_x", "force_y", "torque", "contact_area_m2"):
                np.testing.assert_allclose(one[name], other[name], atol=1e-9 * scale, err_msg=name)

    def test_without_slip_and_camber_nothing_pulls_aside(self):
        rows = history(self.of("motion.slip_angle=0"))
        for name in LATERAL:
            self.assertLess(np.abs(rows[name]).max(), 1e-9 * rows["force_y"].max(), name)

    def test_stationary_start_is_at_rest(self):
        rows = history(self.of("initial.state=stationary", "motion.height=0.5"))
        self.assertGreater(rows["strain"][0], 0.0)
        self.assertLess(np.abs(rows["strain"] / rows["strain"][0] - 1).max(), 1e-9)

    def test_sweep_has_the_bits_of_runs_alone(self):
        self.case()
        study = self.case('schema = 1\nbase = "case.toml"\n[[vary]]\nkey = "motion.slip_angle"\n'
                          "values = [0.0, 0.05]\n[[vary]]\nkey = \"motion.camber\"\n"
                          "values = [0.0, 0.02]\n", "study.toml")
        (self.folder / "case.toml").write_text(WHEEL)
        done = run("sweep", study, "-o", self.folder / "map", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        runs = sorted((self.folder / "map").glob("runs/*/history.csv"))
        self.assertEqual(len(runs), 4)
        alone = self.of("motion.slip_angle=0.05", "motion.camber=0.02")
        self.assertIn((alone / "history.csv").read_bytes(), [path.read_bytes() for path in runs])

    def test_resumes_to_the_same_bits(self):
        text = replaced(replaced(WHEEL, "end", "end = 3.0"), "snapshots",
                        "snapshots = 9\nhistory_interval = 1e-2\ncheckpoint_interval = 0.02")
        whole, out = self.folder / "whole", self.folder / "out"
        done = run("run", self.case(text), "-o", whole, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        process = subprocess.Popen([PROGRAM, "run", str(self.case(text)), "-o", str(out), "--quiet"],
                                   stderr=subprocess.DEVNULL)
        deadline = time.monotonic() + 60
        while not (out / "checkpoint.h5").exists() and time.monotonic() < deadline:
            time.sleep(0.01)
        process.send_signal(signal.SIGKILL)
        process.wait()
        self.assertEqual(summary(out)["status"], "running")
        with h5py.File(out / "checkpoint.h5") as f:
            units = {name: f[name].attrs["units"] for name in ("state/ledger", "history/impulse_z", "history/aligning")}
        self.assertEqual(units, {"state/ledger": "J", "history/impulse_z": "N*s", "history/aligning": "N*m*s"})
        done = run("run", self.folder / "case.toml", "-o", out, "--resume", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreater(summary(out)["resumed_at_steps"][0], 0)
        for name in ("history.csv", "contact.csv", "results.h5", "fields.xdmf", "fields.vtkhdf",
                     "case.toml"):
            self.assertEqual((out / name).read_bytes(), (whole / name).read_bytes(), name)

    def test_kept_case_is_the_case(self):
        out = self.of()
        again = self.folder / "again"
        done = run("run", out / "case.toml", "-o", again, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((again / "history.csv").read_bytes(), (out / "history.csv").read_bytes())


class Bodies(SolidTest):
    def test_check_tells_sectors_and_slip(self):
        told = run("check", self.case(WHEEL)).stdout
        self.assertIn("40 sectors of 24 dofs, 0.1 m wide", told)
        self.assertIn("0.03 rad (1.719°)", told)
        for line in ("critical step", "memory", "largest frequency"):
            self.assertIn(line, told)

    def test_a_tread_with_grooves_around_and_across(self):
        text = replaced(WHEEL, "circumferential", "grading = 1.0") + (
            "[disk.tread]\npitches = 40\ndepth = 0.02\nland_columns = 1\ngroove_columns = 1\n"
            "layers = 1\ncircumferential_grooves = [[0.0, 0.02]]\n")
        out = self.of("time.end=0.004", text=text)
        with h5py.File(out / "results.h5") as file:
            places = file["mesh/coordinates"][:]
            radius = np.hypot(places[:, 0], places[:, 1])
            self.assertEqual(len(file["mesh/hexahedra"]), 40 * (2 * 3 * 2 + 2))
            touch = places[file["mesh/boundary"][:]]
            self.assertTrue(np.allclose(np.hypot(touch[:, 0], touch[:, 1]), 0.3))
            self.assertGreater(np.abs(touch[:, 2]).min(), 0.0099)
            self.assertAlmostEqual(radius.max(), 0.3)

    def test_crowned(self):
        out = self.of("disk.crown_radius=0.2", "time.end=0.001")
        with h5py.File(out / "results.h5") as file:
            x, y, z = file["mesh/coordinates"][:][file["mesh/boundary"][:]].T
        np.testing.assert_allclose(np.hypot(x, y), 0.3 - 0.2 + np.sqrt(0.2**2 - z**2), rtol=1e-12)

    def test_a_section_is_inflated(self):
        (self.folder / "tyre.msh").write_text(SECTION)
        out = self.of(text=TYRE)
        with h5py.File(out / "results.h5") as file:
            places, u = file["mesh/coordinates"][:], file["snapshots/displacement"][-1]
            regions = [file["mesh/region"].attrs[f"name_{k}"] for k in range(2)]
            self.assertEqual(len(file["mesh/hexahedra"]), 5 * 36)
        self.assertEqual(set(regions), {"side", "top"})
        radius = np.hypot(places[:, 0], places[:, 1])
        outwards = (u[:, :2] * places[:, :2]).sum(axis=1) / radius
        self.assertGreater(outwards[radius > 0.26].min(), 1e-5)
        np.testing.assert_array_equal(u[radius < 0.151], 0.0)
        self.assertEqual(summary(out)["sectors"], 36)
        self.assertTrue((out / "mesh.msh").exists())
        again = self.folder / "again"
        done = run("run", out / "case.toml", "-o", again, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((again / "history.csv").read_bytes(), (out / "history.csv").read_bytes())

    def test_faults_of_a_section(self):
        (self.folder / "tyre.msh").write_text(SECTION.replace("1 150 -50 0", "1 -150 -50 0"))
        self.assertIn("x is the distance from the axle", self.refused(text=TYRE))
        (self.folder / "tyre.msh").write_text(SECTION)
        self.assertIn('section.clamped', self.refused("section.clamped=feet", text=TYRE))
        told = self.refused("load.pressure=[{curve = 'rim', value = 1.0}]", text=TYRE)
        self.assertIn("a pressure there has no effect", told)
        self.assertIn("inside", self.refused("load.pressure=[{curve = 'in', value = 1.0}]", text=TYRE))

    def test_a_section_that_is_not_about_its_middle(self):
        def warned(off):
            nodes = re.sub(r"(?m)^(\d+) (\d+) (-?\d+) 0$", lambda m: f"{m[1]} {m[2]} {int(m[3]) + off} 0", SECTION)
            (self.folder / "tyre.msh").write_text(nodes)
            return said(run("check", self.case(TYRE)))

        self.assertNotIn("section.file", warned(4))  # of 100 mm
        self.assertIn("its middle 0.006 m beside z = 0", warned(6))
        told = warned(80)
        self.assertIn('the curve "tread" lies from z = 0.03 to 0.13 m, its middle 0.08 m beside z = 0', told)

    def test_a_wheel_with_a_loaded_rim(self):
        text = replaced(WHEEL, "height", "height = 0.3") + (
            "[rim]\nfree = [\"height\"]\nmass = 20.0\nforce_y = [[0, 0], [0.01, -2000.0]]\n")
        out = self.of(text=text)
        told = {column["name"]: column["unit"] for column in summary(out)["columns"]}
        self.assertEqual((told["hub_torque"], told["work_rim_load"]), ("N·m", "J"))
        self.assertGreater(history(out)["force_y"][-1], 100.0)
        self.assertIn("kg, of which", run("check", self.case(text)).stdout)

    def test_what_a_loaded_rim_does_not_go_with(self):
        rim = "rim={free = [%s], mass = 5.0}"
        self.assertIn("lateral speed of the wheel is undetermined",
                      self.refused(rim % "'speed'", "motion.speed=10.0"))
        settings = ("motion.slip_angle=0.0", "motion.camber=0.1", "motion.height=0.3",
                    "load.pressure=[{curve = 'left', value = 1.0}]")
        self.assertIn("that lifts or presses the wheel", self.refused(rim % "'height'", *settings))


class Refusals(SolidTest):
    """Each: settings, the key that is told, what is told to do instead."""

    PLANE_ONLY = [
        (["disk.rim=free"], "disk.rim", '"bonded"'),
        (["solver.operator=sparse"], "solver.operator", '"cyclic"'),
        (["solver.implicit=[{layers = [1]}]"], "solver.implicit[0]", "smaller step"),
        (["solver.contact_mass=singular"], "solver.contact_mass", '"lumped"'),
        (["time.scheme=as-printed"], "time.scheme", '"symplectic"'),
        (["time.scheme=hati", "solver.hati.ratio=1", "solver.hati.fine.layers=[2]"], "time.scheme",
         '"symplectic"'),
        (["material.model=neo-hooke", "material.shear_modulus=1e6"], "material.model", "b-bar"),
        (["material.plane=stress"], "material.plane", "sides are free"),
        (["material.stress_stiffening=centrifugal"], "material.stress_stiffening", '"none"'),
        (["contact.between=all"], "contact.between", '"none"'),
        (["output.probe=[{name = 'p', position = [0.2, 0.0]}]"], "output.probe[0]", "snapshots"),
        (["initial.state=steady-rolling"], "initial.state", '"stationary"'),
        (["initial.displacement_gradient=[[0.01, 0], [0, 0]]"], "initial.displacement_gradient",
         "initial.velocity"),
    ]

    def test_what_is_plane_alone_is_refused(self):
        for settings, key, instead in self.PLANE_ONLY:
            told = self.refused(*settings)
            self.assertIn(key, told, settings)
            self.assertIn(instead, told, settings)
            self.assertIn("three dimensions", told, settings)

    def test_other_bodies_and_commands_are_refused(self):
        told = self.refused(text=WHEEL + '[mesh]\nfile = "bar.msh"\n')
        self.assertIn("[disk] or [mesh]", told)
        told = self.refused(text=WHEEL + '[section]\nfile = "bar.msh"\nclamped = "rim"\n')
        self.assertIn("[disk] or [section]", told)
        out = self.of()
        done = run("reduce", out, "-o", self.folder / "model.h5")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("reduced wheels are plane", done.stderr)

    def test_a_standing_wheel_bears_its_pressure(self):
        """Modes with --standing press as slow rolling without friction does."""
        common = ["section.sectors=24", "motion.height=0.276", "ground.friction=0", "motion.slip_angle=0"]
        rolling = ["analysis.kind=steady-rolling", "analysis.inertia=none", "analysis.samples_per_sector=1",
                   "motion.angular_velocity=1", "motion.speed=0.3"]
        steady, modes = self.folder / "steady", self.folder / "modes"
        loads = []
        for pressure in (0, 50e3):
            settings = [*common, f"load.pressure[0].value={pressure}"]
            done = run("run", TYRE_CASE, "-o", steady, "--overwrite",
                       *(word for setting in settings + rolling for word in ("--set", setting)))
            self.assertEqual(done.returncode, 0, done.stderr)
            done = run("modes", TYRE_CASE, "-o", modes, "--overwrite", "--standing", "--count", 1,
                       *(word for setting in settings for word in ("--set", setting)))
            self.assertEqual(done.returncode, 0, done.stderr)
            standing = json.loads((modes / "modes.json").read_text())["standing"]
            self.assertAlmostEqual(standing["load"] / summary(steady)["steady"]["force_y"], 1.0, delta=1e-4)
            loads.append(standing["load"])
        self.assertGreater(loads[1], 1.05 * loads[0])

    def test_plane_bodies_have_no_lateral_direction(self):
        plane = replaced(replaced(replaced(replaced(WHEEL, "width", None), "axial", None),
                                  "slip_angle", None), "camber", None)
        self.assertEqual(run("check", self.case(plane)).returncode, 0)
        for setting in ("motion.slip_angle=0.1", "motion.camber=0.1", "disk.mesh.axial=3",
                        "disk.crown_radius=0.3"):
            told = self.refused(setting, text=plane)
            self.assertIn("disk.width beside it", told, setting)

    def test_typical_mistakes(self):
        degrees = self.refused("motion.slip_angle=4.0")
        self.assertIn("motion.slip_angle", degrees)
        self.assertIn("-0.78 to 0.78", degrees)
        self.assertIn("rad", degrees)
        self.assertIn("motion.slip_angle may be a table", self.refused("motion.yaw_rate=0.1"))
        self.assertIn("motion.slip_angle", self.refused("motion.steering_angle=0.1"))
        tread = "[disk.tread]\npitches = 20\ndepth = 0.02\nland_columns = 1\n"
        text = replaced(WHEEL, "circumferential", "grading = 1.0") + tread + "layers = 1\n"
        self.assertIn("leaves the tread without grooves",
                      self.refused("disk.tread.groove_columns=0", text=text))
        told = self.refused("disk.tread.groove_columns=0", "disk.mesh.axial=2", text=text +
                            "circumferential_grooves = [[0.0, 0.02]]\n")
        self.assertIn("disk.mesh.axial", told)
        self.assertIn(">= 3", told)
        self.assertIn("beside the wheel", self.refused("disk.tread.groove_columns=0", text=text +
                                                       "circumferential_grooves = [[0.2, 0.02]]\n"))
        self.assertIn("leave nothing", self.refused("disk.tread.groove_columns=0", text=text +
                                                    "circumferential_grooves = [[0.0, 0.2]]\n"))
        self.assertIn(">= disk.width / 2", self.refused("disk.crown_radius=0.04"))
        self.assertIn("wall is", self.refused("disk.crown_radius=0.05", "disk.inner_radius=0.27"))
        self.assertIn("inside the ground", self.refused("motion.height=0.2"))
        self.assertIn("disk.width", self.refused("disk.width=1e-11"))


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""Runs of meshes from files: free bodies, bodies on each other, probes, what the results hold."""
import csv
import json
import shutil
import unittest

import h5py
import numpy as np
from program import ROOT, SMALL, ProgramTest, history, run, summary

MESHES = ROOT / "cases" / "meshes"

TWO = """schema = 1
title = "Two disks"
[mesh]
file = "two-disks.msh"
contact = "tread"
[material]
youngs_modulus = 5e6
poissons_ratio = 0.45
density = 1100
[[material.region]]
surface = "right"
density = 2200
[contact]
between = "bodies"
friction = 0.3
[initial]
angular_velocity = 20.0
[[initial.region]]
surface = "left"
velocity = [1.0, 0.0]
[time]
end = 0.02
[output]
snapshots = 11
[[output.probe]]
name = "left"
position = [-0.1005, 0.0]
[[output.probe]]
name = "right"
position = [0.15, 0.02]
"""

BLOCK = """schema = 1
[mesh]
file = "block.msh"
clamped = "top"
contact = "foot"
[material]
youngs_modulus = 5e6
poissons_ratio = 0.3
density = 1100
[damping]
stiffness = 1e-4
[motion]
angular_velocity = 0.0
speed = 0.0
height = [[0, 0.0], [0.02, -0.001]]
[ground]
profile = "flat"
friction = 0.3
[time]
end = 0.02
[output]
snapshots = 3
[[output.probe]]
name = "foot"
position = [0.0, 0.0]
"""


class Meshes(ProgramTest):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"
        for name in ("two-disks", "block"):
            shutil.copy(MESHES / f"{name}.msh", self.folder)

    def run_ok(self, text, *settings):
        (self.folder / "case.toml").write_text(text)
        done = run("run", self.folder / "case.toml", "-o", self.out, "--quiet", *settings)
        self.assertEqual(done.returncode, 0, done.stderr)
        return summary(self.out)

    def test_two_disks_keep_their_momentum(self):
        s = self.run_ok(TWO)
        self.assertEqual((s["bodies"], s["free_bodies"]), (2, 2))
        self.assertGreater(s["contact"]["between_bodies_max"], 0)
        self.assertGreater(s["contact"]["clusters_solved"], 0)
        self.assertEqual(s["contact"]["clusters_not_converged"], 0)
        self.assertLess(s["energy_residual_relative"], 1e-2)
        self.assertLess(s["contact_residual_max"], 1e-9)
        with h5py.File(self.out / "results.h5") as file:
            mass, free = file["mesh/mass"][:], file["mesh/free_body"][:]
            reference, u = file["mesh/coordinates"][:], file["snapshots/displacement"][:]
            velocity = file["snapshots/velocity"][:]
            position, region = file["fields/position"][:, :, :2], file["mesh/region"]
            names = [region.attrs[f"name_{k}"] for k in range(len(region.attrs) - 2)]
        self.assertEqual(names, ["left", "right"])
        self.assertEqual(set(free), {0, 1})
        momentum = np.einsum("n,tnc->tc", mass, velocity)
        np.testing.assert_allclose(momentum, np.broadcast_to(momentum[0], momentum.shape),
                                   atol=1e-12 * np.abs(momentum).max())  # round-off of 300 steps
        ratio = mass[free == 1].sum() / mass[free == 0].sum()
        self.assertAlmostEqual(ratio, 2.0, delta=1e-3)  # the polygons differ a little
        # Both fields of places, and the fixed frame of those who have no other.
        np.testing.assert_allclose(position, reference + u, atol=1e-7)  # single precision
        moved = u[-1, free == 1].mean(axis=0)
        self.assertGreater(moved[0], 1e-3)  # the left one has pushed it

    def test_spins_have_the_sign_of_the_rims(self):
        """> 0: clockwise, in the case and in history.csv."""
        (self.folder / "case.toml").write_text(TWO.replace("end = 0.02", "end = 0.001"))
        done = run("run", self.folder / "case.toml", "-o", self.out)
        self.assertIn("initial.angular_velocity: > 0 turns clockwise", done.stderr)
        h = history(self.out)
        self.assertAlmostEqual(h["angle_rad"][-1] / h["time_s"][-1], 20.0, delta=0.1)
        with h5py.File(self.out / "results.h5") as file:
            mass, x, v = (file[name][:] for name in ("mesh/mass", "mesh/coordinates",
                                                     "snapshots/velocity"))
            left = file["mesh/free_body"][:] == 0
        arm = x[left] - np.average(x[left], axis=0, weights=mass[left])
        self.assertLess((mass[left] * np.cross(arm, v[0][left])).sum(), 0.0)
        quiet = run("check", self.folder / "case.toml", "--set", "initial.angular_velocity=0")
        self.assertNotIn("clockwise", quiet.stderr)

    def test_a_probe_at_a_node_is_the_node(self):
        self.run_ok(TWO, "--set", "output.snapshots=1")
        with h5py.File(self.out / "results.h5") as file:
            x = file["mesh/coordinates"][100]
        self.run_ok(TWO, "--overwrite", "--set", "output.history_interval=0", "--set",
                    "output.snapshots=1000000", "--set",
                    f"output.probe[0].position=[{x[0]!r}, {x[1]!r}]")
        h = history(self.out)
        self.assertEqual(list(h)[-16:-8],
                         [f"left_{name}" for name in "ux uy vx vy sxx syy szz sxy".split()])
        with h5py.File(self.out / "results.h5") as file:
            u = file["snapshots/displacement"][1:, 100]
            v = file["snapshots/velocity"][1:, 100]
        self.assertEqual(len(u), len(h["time_s"]))
        self.assertGreater(np.ptp(u[:, 0]), 0.0)
        for k, axis in enumerate("xy"):  # shape functions of 1 and 0, but for round-off
            np.testing.assert_allclose(h[f"left_u{axis}"], u[:, k], atol=1e-14)
            np.testing.assert_allclose(h[f"left_v{axis}"], v[:, k], atol=1e-12)

    def test_rows_between_snapshots_have_probes_too(self):
        self.run_ok(TWO, "--set", "output.history_interval=1e-3", "--set", "output.snapshots=2")
        coarse = history(self.out)
        self.run_ok(TWO, "--overwrite", "--set", "output.history_interval=0")
        fine = history(self.out)
        self.assertGreater(len(fine["time_s"]), 10 * len(coarse["time_s"]))
        at = np.searchsorted(fine["time_s"], coarse["time_s"])
        np.testing.assert_array_equal(fine["time_s"][at], coarse["time_s"])
        for name in list(coarse)[-16:]:
            np.testing.assert_array_equal(coarse[name], fine[name][at], err_msg=name)

    def test_rows_with_probes_are_those_without(self):
        self.run_ok(TWO)
        with_probes = history(self.out)
        self.run_ok(TWO, "--set", "output.probe=[]", "--overwrite")
        without = history(self.out)
        self.assertEqual(list(with_probes)[:len(list(without))], list(without))
        for name in without:
            np.testing.assert_array_equal(with_probes[name], without[name], err_msg=name)

    def test_the_kept_case_runs_again_from_its_own_copy_of_the_mesh(self):
        self.run_ok(TWO)
        (self.folder / "two-disks.msh").unlink()
        again = self.folder / "again"
        done = run("run", self.out / "case.toml", "-o", again, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("history.csv", "results.h5", "case.toml", "mesh.msh"):
            self.assertEqual((self.out / name).read_bytes(), (again / name).read_bytes(), name)
        done = run("run", self.out / "case.toml", "-o", self.out, "--overwrite")
        self.assertEqual(done.returncode, 2)
        self.assertTrue((self.out / "mesh.msh").exists())

    def test_a_mesh_of_the_user_is_never_replaced(self):
        (self.folder / "out").mkdir()
        shutil.copy(MESHES / "two-disks.msh", self.out / "mesh.msh")
        (self.folder / "case.toml").write_text(TWO.replace("two-disks.msh", "out/mesh.msh"))
        done = run("run", self.folder / "case.toml", "-o", self.out)
        self.assertEqual(done.returncode, 2)
        self.assertIn("mesh.msh", done.stderr)

    def test_a_block_that_is_held_is_pressed_on_the_ground(self):
        s = self.run_ok(BLOCK)
        self.assertEqual((s["bodies"], s["free_bodies"]), (1, 0))
        self.assertLess(s["energy_residual_relative"], 1e-12)  # nothing turns: as ever
        h = history(self.out)
        self.assertGreater(h["force_y"][-1], 1e3)
        self.assertAlmostEqual(h["foot_uy"][-1], 0.001, delta=2e-5)  # the foot stays, the rim comes
        self.assertLess(h["foot_syy"][-1], -2e4)
        self.assertEqual(np.abs(h["slip_ratio"]).max(), 0.0)

    def test_pressure_does_work(self):
        pressure = "--set", "load.pressure=[{curve = 'sides', value = [[0, 0], [0.01, 1e4]]}]"
        s = self.run_ok(BLOCK.replace("[ground]\nprofile = \"flat\"\nfriction = 0.3\n", ""),
                        *pressure)
        self.assertLess(s["energy_residual_relative"], 1e-12)
        self.assertGreater(history(self.out)["work_load"][-1], 0.0)

    def test_difficult_contacts_are_kept(self):
        s = self.run_ok(TWO, "--set", "solver.dump_contacts=1")
        kept = sorted((self.out / "contact-problems").glob("*.json"))
        self.assertEqual(len(kept), s["contact"]["problems_kept"])
        self.assertGreater(len(kept), 0)
        self.assertIn("Two disks, after step", kept[0].read_text())
        self.run_ok(TWO, "--overwrite")
        self.assertFalse((self.out / "contact-problems").exists())

    def test_contact_rows_have_no_abscissa_without_ground(self):
        self.run_ok(TWO, "--set", "output.snapshots=400")
        with open(self.out / "contact.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertGreater(len(rows), 0)
        self.assertEqual({row["abscissa_m"] for row in rows}, {"nan"})
        self.assertGreater(min(float(row["pressure_pa"]) for row in rows), 0.0)

    def test_check_counts_bodies(self):
        (self.folder / "case.toml").write_text(TWO)
        done = run("check", self.folder / "case.toml")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("bodies             2 (2 free)", done.stdout)

    def test_a_name_that_is_not_there_is_told_at_its_line(self):
        (self.folder / "case.toml").write_text(TWO.replace('"tread"', '"tred"'))
        done = run("check", self.folder / "case.toml")
        self.assertEqual(done.returncode, 2)
        self.assertIn('case.toml:5:11: mesh.contact = "tred"', done.stderr)
        self.assertIn('did you mean "tread"?', done.stderr)

    def test_who_is_asked_for_a_physical_group_is_told_how_to_define_one(self):
        for text, settings, line in (
                (BLOCK, ["mesh.contact="], 'Physical Curve("tread") = {1, 2};'),
                (TWO, ["mesh.contact="], 'Physical Curve("tread") = {1, 2};'),
                (TWO, ["mesh.contact=tred"], 'Physical Curve("tred") = {1, 2};'),
                (TWO, ["initial.region[0].surface=lefd"], 'Physical Surface("lefd") = {1, 2};'),
                (BLOCK, ["mesh.clamped=", "analysis.kind=crush", "analysis.depth=0.001",
                         "analysis.increments=2"], 'Physical Curve("rim") = {1, 2};')):
            done = run("check", self.case(text), *[f"--set={setting}" for setting in settings])
            self.assertEqual(done.returncode, 2, settings)
            self.assertIn(f"in the .geo: {line}", done.stderr)

    def test_masses_and_areas_are_told(self):
        (self.folder / "case.toml").write_text(TWO)
        told = run("check", self.folder / "case.toml", "--json")
        lines = {line["name"]: line["text"] for line in json.loads(told.stdout)["result"]["lines"]}
        s = self.run_ok(TWO, "--set", "time.end=1e-4", "--set", "output.snapshots=2")
        with h5py.File(self.out / "results.h5") as file:
            mass = file["mesh/mass"][:].sum()
        self.assertAlmostEqual(s["mass"] / mass, 1.0, delta=1e-12)
        self.assertEqual([region["name"] for region in s["regions"]], ["left", "right"])
        self.assertAlmostEqual(sum(region["area"] for region in s["regions"]), s["area"], delta=1e-15)
        for region, density in zip(s["regions"], (1100.0, 2200.0)):
            self.assertAlmostEqual(region["mass"] / region["area"] / density, 1.0, delta=1e-12)
            self.assertIn(f"{region['mass']:.6g} kg/m, area {region['area']:.6g} m2, "
                          f"{region['elements']} elements", lines[f"  of \"{region['name']}\""])
        self.assertIn(f"{mass:.6g} kg/m", lines["mass"])

    def test_half_a_body_is_none(self):
        """Half of the cells, by a count that is too small, are not taken for the whole."""
        text = (self.folder / "block.msh").read_text()
        self.assertIn("\n2 1 3 100\n", text)  # the last block
        (self.folder / "block.msh").write_text(text.replace("\n2 1 3 100\n", "\n2 1 3 50\n"))
        done = run("check", self.case(BLOCK))
        self.assertEqual(done.returncode, 2)
        self.assertIn("$Elements says 5 blocks, and goes on after them", done.stderr)

    def test_held_and_touching_curves_that_are_swapped(self):
        swapped = ("--set", "mesh.clamped=foot", "--set", "mesh.contact=top")
        done = run("check", self.case(BLOCK), *swapped)
        self.assertEqual(done.returncode, 2)
        self.assertIn("mesh.clamped = foot: at t = 0.02 s nodes that are held would be up to "
                      "0.001 m deep in the ground", done.stderr)
        self.assertEqual(run("check", self.case(BLOCK), *swapped, "--set",
                             "motion.height=[[0, 0.001], [0.02, 0.0]]").returncode, 0)
        shutil.copy(MESHES / "tyre-section.msh", self.folder)
        wheel = (ROOT / "cases" / "tyre-section.toml").read_text().replace("meshes/", "")
        self.assertEqual(run("check", self.case(wheel)).returncode, 0)
        done = run("check", self.case(wheel), "--set", "mesh.clamped=tread", "--set",
                   "mesh.contact=rim", "--set", "load.pressure=[]")
        self.assertEqual(done.returncode, 2)
        self.assertIn("should \"tread\" be mesh.contact and \"rim\" mesh.clamped?", done.stderr)

    def test_held_and_touching_curves_of_a_section_that_are_swapped(self):
        done = run("check", ROOT / "cases" / "wheel3d-tyre.toml", "--set", "section.clamped=tread",
                   "--set", "section.contact=rim", "--set", "load.pressure=[]")
        self.assertEqual(done.returncode, 2)
        self.assertIn("nodes that are held would be up to 0.008 m deep in the ground", done.stderr)
        self.assertIn("should \"tread\" be section.contact and \"rim\" section.clamped?", done.stderr)

    def test_a_rim_in_the_ground(self):
        """A disk, a crush of a mesh and steady rolling refuse it, too."""
        crush = BLOCK[:BLOCK.index("[motion]")] + BLOCK[BLOCK.index("[ground]"):BLOCK.index("[time]")]
        for text, *settings in (
                (SMALL, "motion.height=[[0, 0.3], [0.004, 0.1]]"),
                (crush + '[analysis]\nkind = "crush"\ndepth = 0.11\nincrements = 2\n',
                 "damping.stiffness=0.0"),
                ((ROOT / "cases" / "steady-rolling.toml").read_text(), "motion.height=0.02")):
            done = run("check", self.case(text), *[f"--set={setting}" for setting in settings])
            self.assertEqual(done.returncode, 2, settings)
            self.assertIn("nodes that are held would be up to", done.stderr)

    def test_a_mesh_without_a_free_node(self):
        nodes = "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0"
        lines = "\n".join(f"{k} 1 2 1 1 {k} {k % 4 + 1}" for k in (1, 2, 3, 4))
        (self.folder / "one.msh").write_text(
            f'$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 1 "edge"\n2 2 "body"\n$EndPhysicalNames\n'
            f"$Nodes\n4\n{nodes}\n$EndNodes\n$Elements\n5\n{lines}\n5 3 2 2 1 1 2 3 4\n$EndElements\n")
        text = BLOCK[:BLOCK.index("[ground]")] + "[time]\nend = 0.02\n"
        text = text.replace("block.msh", "one.msh").replace('"top"', '"edge"').replace('contact = "foot"\n', "")
        for spin in 0, 10:  # with a spin the check of softening ended the program
            done = run("check", self.case(text), "--set", f"motion.angular_velocity={spin}")
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn('mesh.clamped = "edge": holds all nodes of the mesh', done.stderr)

    def test_what_the_mesh_says_is_said_with_its_file(self):
        done = run("check", self.case(BLOCK), "--set", "mesh.contact=sides")
        self.assertIn(f"{self.folder / 'block.msh'}: 2 nodes of the contact curve \"sides\" are clamped",
                      done.stderr)


if __name__ == "__main__":
    unittest.main()

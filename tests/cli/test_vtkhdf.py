# SPDX-License-Identifier: BSD-3-Clause
"""fields.vtkhdf by its published layout: of plane and three-dimensional runs, of triangles and mixed
meshes, of runs that ended, were interrupted, killed, resumed, prolonged."""
import os
import shutil
import signal
import subprocess
import time
import unittest

import h5py
import numpy as np

from program import PROGRAM, ROOT, ProgramTest, SMALL, replaced, run, summary
from test_solid import WHEEL
from vtkhdf_layout import Layout, compare

LONG = replaced(replaced(SMALL, "end", "end = 100.0"), "snapshots",
                "snapshots = 4001\ncheckpoint_interval = 0.05")


class VtkhdfTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"

    def read(self):
        """Steps are the snapshots that are complete, arrays hold what /fields does."""
        layout = Layout(self.out / "fields.vtkhdf")
        compare(layout, self.out / "results.h5")
        return layout

    def made(self, text, *extra):
        done = run("run", self.case(text), "-o", self.out, "--quiet", *extra)
        self.assertEqual(done.returncode, 0, done.stderr)


class Bodies(VtkhdfTest):
    def test_a_disk(self):
        self.made(SMALL)
        layout = self.read()
        self.assertEqual(layout.t, 11)
        self.assertEqual(set(layout.types), {9})
        self.assertEqual(layout.names, ["cauchy_stress", "contact_force", "displacement",
                                        "stress_xx", "stress_xy", "stress_yy", "stress_zz",
                                        "velocity", "von_mises"])
        self.assertGreater(abs(layout.array("cauchy_stress", 10)[:, 3]).max(), 0)
        self.look_at_labels()
        self.assertLess((self.out / "fields.vtkhdf").stat().st_size, 40000)  # nothing is copied

    def look_at_labels(self):
        """Units and descriptions are those of the datasets, of the numbers that are shown."""
        with h5py.File(self.out / "fields.vtkhdf") as shown, h5py.File(self.out / "results.h5") as file:
            group = shown["VTKHDF"]
            arrays = {name: array.attrs for name, array in group["PointData"].items()}
            arrays["position"] = group["Points"].attrs
            for name, said in arrays.items():
                of = file["fields"]["cauchy_stress" if name.startswith("stress_") else name].attrs
                self.assertEqual(said["units"].decode(), of["units"], name)
                if "stress" not in name:
                    self.assertEqual(said["description"].decode(), of["description"], name)
            self.assertTrue(arrays["cauchy_stress"]["description"].endswith(b": xx, yy, zz, xy, yz, xz"))
            self.assertTrue(arrays["stress_xy"]["description"].endswith(b": xy"))
            self.assertEqual(group["Steps/Values"].attrs["units"], b"s")

    def test_a_wheel_in_three_dimensions(self):
        self.made(WHEEL)
        layout = self.read()
        self.look_at_labels()
        self.assertEqual(set(layout.types), {12})
        self.assertIn("stress_yz", layout.names)
        self.assertGreater(np.ptp(layout.points(4)[:, 2]), 0.099)

    def test_without_stress_or_ground(self):
        text = "\n".join(line for line in SMALL.splitlines() if not line.startswith(
            ("[ground]", "profile", "friction")))
        self.made(text + "\nstress = false\n")
        self.assertEqual(self.read().names, ["displacement", "velocity"])

    def of_mesh(self, mesh):
        shutil.copy(mesh, self.folder / "body.msh")
        case = "\n".join(["schema = 1", "[mesh]", 'file = "body.msh"', "[material]",
                          "youngs_modulus = 5e6", "poissons_ratio = 0.3", "density = 1100",
                          "[initial]", "angular_velocity = 5.0", "[time]", "end = 0.002",
                          "[output]", "snapshots = 4", ""])
        self.made(case)
        return self.read()

    def test_triangles_and_mixed_cells(self):
        mixed = self.of_mesh(ROOT / "tests" / "meshes" / "mixed-41.msh")
        self.assertEqual(set(mixed.types), {5, 9})
        self.out = self.folder / "triangles"
        (self.folder / "three.msh").write_text(
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n"
            "$EndNodes\n$Elements\n2\n1 2 2 0 1 1 2 3\n2 2 2 0 1 1 3 4\n$EndElements\n")
        triangles = self.of_mesh(self.folder / "three.msh")
        self.assertEqual(list(triangles.types), [5, 5])

    def test_a_crush_has_a_step_for_each_increment(self):
        self.made(SMALL, "--set", "analysis.kind=crush", "--set", "analysis.depth=0.01", "--set",
                  "analysis.increments=4")
        self.assertEqual(list(self.read().times), [0.25, 0.5, 0.75, 1.0])


class States(VtkhdfTest):
    def start(self):
        process = subprocess.Popen([PROGRAM, "run", str(self.case(LONG)), "-o", str(self.out),
                                    "--resume", "--quiet"], stderr=subprocess.DEVNULL)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def steps(self):
        try:
            with h5py.File(self.out / "fields.vtkhdf", "r") as file:
                return int(file["VTKHDF/Steps"].attrs["NSteps"])
        except FileNotFoundError:
            return 0

    def wait_for(self, steps):
        """At each look the file is whole: it opens and has the number of steps."""
        deadline = time.time() + 100
        while self.steps() < steps:
            self.assertLess(time.time(), deadline, "the run does not go on")
            time.sleep(0.001)

    def test_killed_then_resumed(self):
        process = self.start()
        self.wait_for(60)
        process.kill()
        process.wait()
        layout = Layout(self.out / "fields.vtkhdf")
        with h5py.File(self.out / "results.h5") as file:
            time_of = file["frame/time"][:]
            there = np.count_nonzero(~np.isnan(time_of))
            self.assertEqual(len(time_of), 4001)
            # The snapshots of the last 0.1 s may be without their steps.
            self.assertLessEqual(layout.t, there)
            self.assertTrue(np.array_equal(layout.times, time_of[:layout.t]))
            for k in (0, layout.t // 2, layout.t - 1):
                self.assertTrue(np.array_equal(layout.points(k), file["fields/position"][k]))
        before = layout.t
        process = self.start()
        self.wait_for(before + 20)
        process.send_signal(signal.SIGINT)
        process.wait()
        self.assertEqual(summary(self.out)["status"], "interrupted")
        self.assertGreaterEqual(self.read().t, before + 20)

    def test_prolonged(self):
        self.made(SMALL)
        done = run("run", self.out, "--resume", "--quiet", "--set", "time.end=0.04")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.read().t, 21)

    def test_no_snapshots_no_file(self):
        self.made(SMALL.replace("snapshots = 11", "snapshots = 0"))
        self.assertFalse((self.out / "fields.vtkhdf").exists())
        with h5py.File(self.out / "results.h5") as file:
            self.assertNotIn("vtk", file["mesh"])

    def test_overwritten(self):
        self.made(SMALL)
        self.made(SMALL.replace("snapshots = 11", "snapshots = 0"), "--overwrite")
        self.assertFalse((self.out / "fields.vtkhdf").exists())

    def test_without_results_there_are_no_zeros(self):
        self.made(SMALL)
        (self.out / "results.h5").rename(self.out / "other.h5")
        with self.assertRaises(KeyError):  # the cells are not there
            Layout(self.out / "fields.vtkhdf")
        with h5py.File(self.out / "fields.vtkhdf") as file:
            self.assertTrue(np.isnan(file["VTKHDF/Points"][:]).all())
            self.assertTrue(np.isnan(file["VTKHDF/PointData/von_mises"][:]).all())

    def test_the_directory_may_move_and_be_read_from_anywhere(self):
        self.made(SMALL)
        self.out = self.out.rename(self.folder / "moved")
        os.chdir("/")
        self.assertEqual(self.read().t, 11)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""A crush by LATIN and LATIN-PGD: the direct crush is its limit; what it writes, what it refuses."""
import itertools
import json
import os
import signal
import subprocess
import time
import unittest

import h5py
import numpy as np

from program import (PROGRAM, ROOT, ProgramTest, RunTest, contact, history, replaced, run, said,
                     summary, table)

CRUSH = """schema = 1
title = "crush"
[disk]
outer_radius = 0.30
inner_radius = 0.15
[disk.mesh]
radial = 4
circumferential = 90
[material]
youngs_modulus = 2.0e7
poissons_ratio = 0.3
density = 1100.0
[ground]
profile = "flat"
friction = 0.3
[analysis]
kind = "crush"
solver = "latin-pgd"
increments = 16
depth = [[0, 0], [8, 0.02], [16, 0.02]]
slide = [[0, 0], [8, 0], [16, 0.01]]
"""
TREAD = "[disk.tread]\npitches = 30\ndepth = 0.012\nland_columns = 2\ngroove_columns = 1\nlayers = 1\n"
NO_SLIDE = "analysis.slide=[[0, 0], [16, 0]]"
HISTORIES = {
    "pressing": ["analysis.depth=[[0, 0], [16, 0.02]]", NO_SLIDE],
    "unloading": ["analysis.depth=[[0, 0], [8, 0.02], [16, 0]]", NO_SLIDE],
    "sliding": [],
    "cyclic": ["analysis.depth=[[0, 0], [4, 0.02], [16, 0.02]]",
               "analysis.slide=[[0, 0], [4, 0], [7, 0.01], [13, -0.01], [16, 0]]"],
}
PGD = "pod/displacement-pgd"


def options(settings):
    return list(itertools.chain.from_iterable(("--set", s) for s in settings))


class Solved(RunTest):
    text = CRUSH

    def solve(self, name, *settings, text=CRUSH, extra=()):
        out = self.folder / name
        done = run("run", self.case(text), "-o", out, "--quiet", *options(settings), *extra)
        self.assertEqual(done.returncode, 0, done.stderr)
        return out

    def test_the_case_of_the_project(self):
        out = self.solve("case", text=(ROOT / "cases" / "crush-latin.toml").read_text())
        info, h = summary(out), history(out)
        self.assertAlmostEqual(info["iterations"], 30, delta=2)  # as the case says
        self.assertAlmostEqual(info["solves"], 88, delta=6)
        self.assertAlmostEqual(info["modes"], 20, delta=1)
        self.assertLess(abs(info["modes_max"] - 29), 3)
        self.assertAlmostEqual(h["force_y"][100] / 4.743e5, 1.0, places=3)
        self.assertAlmostEqual(h["force_y"][-1] / 4.787e5, 1.0, places=3)
        self.assertAlmostEqual(-h["force_x"][-1] / h["force_y"][-1], 0.3, places=3)
        self.assertAlmostEqual(h["dissipation_friction"][-1] / 927, 1.0, places=2)
        self.assertLess(np.abs(h["energy_residual"]).max(), 1e-11 * h["strain"][-1])

    def test_the_limit_is_the_direct_crush(self):
        treaded = replaced(CRUSH, "circumferential", None).replace("[material]", TREAD + "[material]")
        for text, (name, settings) in itertools.product((CRUSH, treaded), HISTORIES.items()):
            with self.subTest(name=name, tread=text is treaded):
                label = f"{name}{len(text)}"
                direct = self.solve(f"direct{label}", *settings, 'analysis.solver="direct"', text=text)
                by = {solver: self.solve(f"{solver}{label}", *settings, f'analysis.solver="{solver}"',
                                         "analysis.tolerance=1e-7", text=text)
                      for solver in ("latin", "latin-pgd")}
                expected = history(direct)
                for solver, out in by.items():
                    h = history(out)
                    for column in ("force_x", "force_y", "strain", "dissipation_friction", "work_rim"):
                        size = max(np.abs(expected["strain" if column[0] != "f" else "force_y"]))
                        np.testing.assert_allclose(h[column], expected[column], atol=1e-6 * size,
                                                   err_msg=f"{solver}: {column}")
                    np.testing.assert_allclose(self.displacement(out), self.displacement(direct),
                                               atol=1e-6 * 0.02)

    @staticmethod
    def displacement(out):
        with h5py.File(out / "results.h5") as file:
            return file["/snapshots/displacement"][:]

    def test_the_balance_closes_and_the_laws_hold_to_the_tolerance(self):
        for solver in ("latin", "latin-pgd"):
            out = self.solve(solver, f'analysis.solver="{solver}"')
            s, h = summary(out), history(out)
            self.assertLess(s["residual"], 1e-3)
            self.assertLess(s["energy_residual_relative"], 1e-12)
            self.assertLess(s["equilibrium_residual_max"], 1e-11)
            # The largest of a node at an increment; the tolerance is of the mean over all.
            self.assertLess(s["contact_residual_max"], 0.02)
            self.assertEqual(h["contact_residual"].max(), s["contact_residual_max"])
            self.assertGreater(h["contact_nodes"][8], 5)
            self.assertEqual((s["solver"], s["increments_done"], s["snapshots"]), (solver, 16, 16))

    def test_iterations_are_told_one_by_one(self):
        out = self.solve("pgd")
        s, c = summary(out), table(out / "convergence.csv")
        self.assertEqual(list(c), ["iteration", "indicator", "residual", "modes", "solves"])
        np.testing.assert_array_equal(c["iteration"], np.arange(1, s["iterations"] + 1))
        self.assertEqual((c["indicator"][-1], c["residual"][-1], c["solves"][-1]),
                         (s["indicator"], s["residual"], s["solves"]))
        self.assertTrue((c["residual"][:-1] > 1e-3).all())
        self.assertLessEqual(c["modes"].max(), s["modes_max"])
        self.assertGreater(c["modes"][-1], s["modes"])  # the last cut
        plain = self.solve("latin", 'analysis.solver="latin"')
        self.assertEqual(table(plain / "convergence.csv")["modes"].max(), 0.0)
        self.assertFalse((plain / "pod").exists())

    def test_direction_and_relaxation_change_the_way_alone(self):
        chosen = self.solve("chosen", "analysis.tolerance=1e-6")
        k = summary(chosen)["search_direction"]
        given = self.solve("given", "analysis.tolerance=1e-6", f"analysis.search_direction={1.5 * k!r}",
                           "analysis.relaxation=0.7")
        self.assertEqual(summary(given)["search_direction"], 1.5 * k)
        self.assertNotEqual(summary(given)["iterations"], summary(chosen)["iterations"])
        np.testing.assert_allclose(history(given)["force_y"], history(chosen)["force_y"], rtol=1e-5)

    def test_fields_used_again(self):
        first = self.solve("first")
        fresh = self.solve("fresh", "ground.friction=0.5")
        again = self.solve("again", "ground.friction=0.5", extra=("--modes-from", first))
        self.assertGreaterEqual(summary(fresh)["solves"], 5 * summary(again)["solves"])
        np.testing.assert_allclose(history(again)["force_y"], history(fresh)["force_y"], rtol=3e-3)
        deeper = self.solve("deeper", "analysis.depth=[[0, 0], [8, 0.024], [16, 0.024]]",
                            extra=("--modes-from", first))
        self.assertLess(summary(deeper)["solves"], 12)
        shallow = self.solve("shallow", "analysis.depth=[[0, 0], [8, 0.012], [16, 0.012]]",
                             extra=("--modes-from", first))
        self.assertLess(summary(shallow)["solves"], 12)
        direct = self.solve("direct", 'analysis.solver="direct"',
                            "analysis.depth=[[0, 0], [8, 0.012], [16, 0.012]]")
        np.testing.assert_allclose(history(shallow)["force_y"], history(direct)["force_y"],
                                   atol=3e-3 * history(direct)["force_y"].max())

    def test_modes_of_a_run_are_a_pod(self):
        out = self.solve("pgd")
        s = summary(out)
        with h5py.File(out / PGD / "pod.h5") as file:
            self.assertEqual(len(file["/modes/spatial"]), s["modes"])
        self.assertEqual(json.loads((out / PGD / "pod.json").read_text())["modes_kept"], s["modes"])
        done = run("run", self.case(CRUSH), "-o", out, "--overwrite", "--quiet", "--set",
                   'analysis.solver="direct"')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertFalse((out / "pod").exists())  # nor are old modes beside new results
        self.assertFalse((out / "convergence.csv").exists())

    def test_contact_is_what_obeys_the_laws(self):
        out = self.solve("pgd", 'analysis.depth=[[0, 0], [8, 0.02], [16, 0]]', NO_SLIDE)
        h, listed = history(out), contact(out)
        self.assertEqual((h["contact_nodes"][-1], h["force_y"][-1]), (0.0, 0.0))
        self.assertGreater(h["contact_nodes"].max(), 5)
        with h5py.File(out / "results.h5") as file:
            forces = file["/contact/force"][:]
        for k in range(1, 17):
            rows = np.isclose(listed["time_s"], h["time_s"][k])
            self.assertEqual(rows.sum(), h["contact_nodes"][k])
            self.assertEqual((forces[k - 1, :, 0] != 0.0).sum(), h["contact_nodes"][k])
            self.assertAlmostEqual(forces[k - 1, :, 0].sum(), h["force_y"][k],
                                   delta=1e-12 * h["force_y"].max())

    def test_interrupted_while_it_iterates(self):
        text = replaced(CRUSH, "circumferential", "circumferential = 720")
        text = replaced(replaced(text, "radial", "radial = 12"), "increments", "increments = 2000")
        text = text.replace("[8, ", "[1000, ").replace("[16, ", "[2000, ")
        out = self.folder / "out"
        process = subprocess.Popen([PROGRAM, "run", str(self.case(text)), "-o", str(out), "--quiet",
                                    "--set", "analysis.tolerance=1e-9"], stderr=subprocess.DEVNULL)
        deadline = time.monotonic() + 100
        while not (out / "convergence.csv").exists() and time.monotonic() < deadline:
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(), 130)
        self.assertEqual(summary(out)["status"], "interrupted")
        self.assertGreater(len(table(out / "convergence.csv")["residual"]), 0)
        self.assertFalse((out / PGD / "pod.json").exists())


class Threads(ProgramTest):
    def test_those_of_the_library_of_dense_algebra_do_not_change_a_bit(self):
        """With 800 increments it would share the singular values out; with 400 it would not."""
        found = []
        for threads in ("1", "2"):
            done = run("run", ROOT / "cases" / "crush-latin.toml", "-o", self.folder / threads, "--quiet",
                       *options(("disk.mesh.circumferential=60", "disk.mesh.radial=3", "analysis.increments=400",
                                 "analysis.slide_increments=400")), env=os.environ | {"OPENBLAS_NUM_THREADS": threads})
            self.assertEqual(done.returncode, 0, done.stderr)
            found.append((self.folder / threads / "history.csv").read_bytes())
        self.assertEqual(*found)


class Refused(ProgramTest):
    def refuse(self, parts, *settings, text=CRUSH, extra=(), code=2):
        done = run("run", self.case(text), "-o", self.folder / "refused", "--quiet", *options(settings),
                   *extra)
        self.assertEqual(done.returncode, code, done.stderr)
        for part in parts:
            self.assertIn(part, done.stderr)

    def test_keys(self):
        self.refuse(["analysis.search_direction", "-1"], "analysis.search_direction=-1.0")
        self.refuse(["analysis.relaxation"], "analysis.relaxation=0.0")
        self.refuse(["analysis.relaxation"], "analysis.relaxation=1.1")
        self.refuse(["analysis.tolerance"], "analysis.tolerance=0.0")
        self.refuse(["analysis.solver", '"direct"', '"latin"', '"latin-pgd"'], 'analysis.solver="lattin"')
        self.refuse(["analysis.downsizing", "latin-pgd"], 'analysis.solver="latin"',
                    "analysis.downsizing=0.5")

    def test_a_dynamic_case(self):
        self.refuse(["analysis.solver"], text=replaced(CRUSH, "kind", 'kind = "dynamic"'))

    def test_rubber(self):
        text = replaced(CRUSH, "youngs_modulus", 'model = "neo-hooke"\nshear_modulus = 7.0e6')
        self.refuse(["linear", 'analysis.solver = "direct"'], text=text)

    def test_modes_that_do_not_fit(self):
        first, other = self.folder / "first", self.folder / "other"
        for out, settings in ((first, []), (other, ["--set", 'analysis.solver="direct"'])):
            done = run("run", self.case(CRUSH), "-o", out, "--quiet", *settings)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.refuse(["--modes-from", "nowhere"], extra=("--modes-from", self.folder / "nowhere"))
        self.refuse(["--modes-from", "latin-pgd"], extra=("--modes-from", other))
        self.refuse(["--modes-from", "mesh"], "disk.mesh.radial=5", extra=("--modes-from", first))
        self.refuse(["--modes-from", "another body", "[material]"], "material.poissons_ratio=0.4",
                    extra=("--modes-from", first))
        self.refuse(["--modes-from", "analysis.solver"], 'analysis.solver="latin"',
                    extra=("--modes-from", first))

    def test_what_does_not_converge_ends_the_run(self):
        self.refuse(["did not converge", "2000 iterations", "analysis.search_direction", "direct"],
                    "analysis.search_direction=1e12", "analysis.tolerance=1e-9", code=3)
        self.refuse(["out of the range of floating-point numbers"], "analysis.search_direction=1e100", code=3,
                    extra=("--overwrite",))


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""rondo run on real cases: files, their contents, exit codes, the same bits."""
import functools
import json
import os
import unittest

import h5py
import numpy as np

from program import (ProgramTest, ROOT, RunTest, SMALL, history, replaced, run, summary)


class Run(RunTest):
    text = SMALL

    def test_results_directory(self):
        self.run_ok()
        self.assertEqual(sorted(p.name for p in self.out.iterdir()),
                         ["case.toml", "checkpoint.h5", "contact.csv", "fields.vtkhdf", "fields.xdmf", "history.csv",
                          "results.h5", "run.json"])
        s = summary(self.out)
        for key in ("status title version build host process nodes dofs operator threads critical_step step "
                    "steps loop_wall_s loop_cpu_s ns_per_dof_step energy_residual_relative "
                    "contact_residual_max penetration_max_m peak_memory_bytes dispatch output "
                    "total_wall_s").split():
            self.assertIn(key, s)
        self.assertEqual((s["status"], s["title"], s["nodes"], s["dofs"]), ("done", "small", 160, 240))
        self.assertLess(s["energy_residual_relative"], 1e-13)
        self.assertLess(s["contact_residual_max"], 1e-13)
        self.assertAlmostEqual(s["step"], 0.8 * s["critical_step"], delta=1e-15)

    def test_cost_of_output(self):
        self.run_ok()
        s = summary(self.out)
        cost = s["output"]
        self.assertEqual(set(cost), {"wait_wall_s", "drain_wall_s", "write_wall_s", "queue_full"})
        self.assertGreater(cost["wait_wall_s"], 0)
        self.assertGreater(cost["write_wall_s"], 0)
        self.assertLess(cost["wait_wall_s"], s["loop_wall_s"])
        self.assertLess(s["loop_wall_s"] + cost["drain_wall_s"], s["total_wall_s"])
        self.assertLess(cost["write_wall_s"], s["total_wall_s"])
        self.assertIsInstance(cost["queue_full"], int)

    def test_history_closes_row_by_row(self):
        self.run_ok()
        h = history(self.out)
        columns = summary(self.out)["columns"]
        self.assertEqual(list(h), [column["name"] for column in columns])
        names = (  # of the first version; later ones follow
            "time_s angle_rad center_x_m center_y_m force_x force_y torque contact_nodes "
            "sticking_nodes contact_length_m penetration_max_m slip_ratio kinetic strain work_frame "
            "work_contact dissipation_friction loss_impact work_rim dissipation_mass "
            "dissipation_stiffness work_scheme energy_residual work_load").split()
        self.assertEqual(list(h)[:len(names)], names)
        energy = h["kinetic"] + h["strain"]
        works = (h["work_frame"] + h["work_contact"] - h["dissipation_mass"]
                 - h["dissipation_stiffness"] + h["work_scheme"])
        start = energy - works - h["energy_residual"]
        self.assertLess(np.ptp(start), 1e-12 * energy.max())  # E at the first half step, in every row
        split = h["work_rim"] - h["dissipation_friction"] - h["loss_impact"]
        np.testing.assert_allclose(split, h["work_contact"], atol=1e-12 * energy.max())
        self.assertGreater(h["force_y"].max(), 1e4)
        self.assertGreater(h["dissipation_friction"][-1], 0)
        np.testing.assert_allclose(h["angle_rad"], 33.333333 * h["time_s"], rtol=1e-12)
        np.testing.assert_allclose(h["center_x_m"], 10.0 * h["time_s"], rtol=1e-12)
        np.testing.assert_allclose(h["slip_ratio"], -1e-8, atol=1e-12)

    def test_history_is_the_mean_of_every_step(self):
        self.run_ok(SMALL.replace("[output]", "[output]\nhistory_interval = 1e-3"))
        coarse = history(self.out)
        run("run", self.folder / "case.toml", "-o", self.folder / "fine",
            "--set", "output.history_interval=0")
        fine = history(self.folder / "fine")
        self.assertEqual(len(fine["time_s"]), summary(self.out)["steps"])
        self.assertLess(4 * len(coarse["time_s"]), len(fine["time_s"]))  # a row is many steps
        inside = fine["time_s"] <= coarse["time_s"][9]
        first = coarse["time_s"][:10]
        spans = np.diff(np.concatenate([[0.0], first]))
        self.assertAlmostEqual(np.sum(coarse["force_y"][:10] * spans),
                               np.sum(fine["force_y"][inside]) * summary(self.out)["step"], places=7)
        self.assertEqual(fine["penetration_max_m"].max(), coarse["penetration_max_m"].max())

    def test_snapshots(self):
        self.run_ok()
        h = history(self.out)
        s = summary(self.out)
        with h5py.File(self.out / "results.h5") as f:
            t = f["/frame/time"][:]
            self.assertEqual(len(t), 11)
            self.assertEqual(t[0], 0.0)
            self.assertEqual(t[-1], h["time_s"][-1])
            self.assertLess(np.ptp(np.diff(t)), 2.1 * s["step"])
            u, v = f["/snapshots/displacement"][:], f["/snapshots/velocity"][:]
            self.assertEqual(u.shape, (11, 160, 2))
            mass, force = f["/mesh/mass"][:], f["/contact/force"][:]
            kinetic = 0.5 * np.einsum("n,nc,nc->", mass, v[-1], v[-1])
            self.assertAlmostEqual(kinetic / h["kinetic"][-1], 1.0, places=12)
            np.testing.assert_allclose(f["/frame/time_velocity"][1:], t[1:] - 0.5 * s["step"])
            # The spin is constant; the first velocity is at t = 0 itself.
            np.testing.assert_allclose(f["/frame/angle_velocity"][:],
                                       -33.333333 * f["/frame/time_velocity"][:], rtol=1e-14)
            boundary = f["/mesh/boundary"][:]
            self.assertEqual(force.shape, (11, len(boundary), 2))
            self.assertGreaterEqual(force[..., 0].min(), 0.0)
            self.assertLessEqual(np.max(np.abs(force[..., 1]) - 0.3 * force[..., 0]), 1e-9)
            traction = f["/contact/traction"][:]
            width = np.broadcast_to(f["/mesh/tributary"][:], traction.shape[:2]).copy()
            pressed = force[..., 0] > 0  # over the deformed boundary: test_contact_lengths.py
            width[pressed] = force[pressed, 0] / traction[pressed, 0]
            np.testing.assert_allclose(width, np.broadcast_to(f["/mesh/tributary"][:], width.shape), rtol=0.2)
            np.testing.assert_allclose(traction * width[..., None], force, rtol=1e-14)
            # Positions in the fixed frame: c + R(θ)(X + u).
            theta, c = f["/frame/angle"][-1], f["/frame/center"][-1]
            arm = f["/mesh/coordinates"][:] + u[-1]
            x = c[0] + np.cos(theta) * arm[:, 0] - np.sin(theta) * arm[:, 1]
            np.testing.assert_allclose(f["/fields/position"][-1, :, 0], x, atol=1e-7)
            for name in ("/frame/time", "/snapshots/displacement", "/contact/force", "/mesh/mass"):
                self.assertIn("units", f[name].attrs)
                self.assertIn("description", f[name].attrs)

    def test_contact_csv_agrees_with_results(self):
        self.run_ok()
        rows = np.genfromtxt(self.out / "contact.csv", delimiter=",", names=True)
        with h5py.File(self.out / "results.h5") as f:
            last = rows[rows["time_s"] == f["/frame/time"][-1]]
            traction = f["/contact/traction"][-1]
            self.assertEqual(len(last), np.count_nonzero(traction[:, 0] > 0))
            self.assertGreater(len(last), 0)
            place = {node: k for k, node in enumerate(f["/mesh/boundary"][:])}
            for row in last:
                k = place[int(row["node"])]
                self.assertEqual(row["pressure_pa"], traction[k, 0])
                self.assertEqual(row["shear_pa"], traction[k, 1])
                self.assertAlmostEqual(row["abscissa_m"], row["x_m"] + 1.0, places=12)

    def test_same_bits_from_run_to_run_and_from_case_toml(self):
        self.run_ok()
        again = self.folder / "again"
        done = run("run", self.out / "case.toml", "-o", again, "--threads", 2)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.out / "case.toml").read_text(), (again / "case.toml").read_text())
        for name in ("history.csv", "contact.csv"):
            self.assertEqual((self.out / name).read_bytes(), (again / name).read_bytes(), name)
        with h5py.File(self.out / "results.h5") as a, h5py.File(again / "results.h5") as b:
            for name in ("/snapshots/displacement", "/snapshots/velocity", "/contact/force"):
                self.assertEqual(a[name][:].tobytes(), b[name][:].tobytes(), name)

    def elsewhere(self):
        """A folder to work in that is not the case's."""
        folder = self.folder / "work"
        folder.mkdir()
        return folder

    def test_set_and_default_directory(self):
        work = self.elsewhere()
        done = run("run", self.case(), "--set", "ground.friction=0.0", "--set", "time.end=0.005",
                   "--quiet", cwd=work)
        self.assertEqual((done.returncode, done.stderr, done.stdout), (0, "", ""))
        h = history(work / "case")
        self.assertEqual(np.abs(h["force_x"]).max(), 0.0)
        self.assertIn("friction = 0.0", (work / "case" / "case.toml").read_text())
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["case.toml", "work"])

    def test_results_beside_the_case_are_gone_on_with(self):
        """Where earlier versions put them."""
        work = self.elsewhere()
        before = self.folder / "case"
        self.assertEqual(run("run", self.case(), "-o", before, "--quiet").returncode, 0)
        later = ("run", self.case(), "--resume", "--quiet", "--set", "time.end=0.025")
        done = run(*later, cwd=work)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"-o {before} to resume them", done.stderr)
        self.assertGreater(history(before)["time_s"][-1], 0.0249)
        self.assertEqual(list(work.iterdir()), [])
        self.assertEqual(run(*later, "-o", "case", cwd=work).returncode, 0)
        done = run(*later, cwd=work)  # there are results in the working folder now
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_another_run_is_not_overwritten(self):
        self.run_ok()
        before = (self.out / "history.csv").read_bytes()
        (self.out / "notes.txt").write_text("mine")
        done = run("run", self.case(), "-o", self.out, "--set", "time.end=0.001")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--overwrite", done.stderr)
        self.assertEqual((self.out / "history.csv").read_bytes(), before)
        done = run("run", self.case(), "-o", self.out, "--set", "time.end=0.001", "--overwrite")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertLess(len((self.out / "history.csv").read_bytes()), len(before))
        self.assertEqual((self.out / "notes.txt").read_text(), "mine")

    def test_the_users_case_file_is_not_replaced(self):
        case = self.case()
        text = case.read_text()
        for extra in ([], ["--overwrite"]):
            done = run("run", "case.toml", "-o", ".", *extra, cwd=self.folder)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("-o", done.stderr)
            self.assertEqual(case.read_text(), text)

    def test_case_without_an_extension(self):
        self.case(name="plain")
        self.assertEqual(run("run", "plain", "--quiet", cwd=self.folder).returncode, 0)
        self.assertTrue((self.folder / "plain.results" / "run.json").exists())

    def test_warnings(self):
        text = replaced(SMALL, "height", "height = 0.296")
        done = self.run_ok(replaced(text, "snapshots", "snapshots = 5000"))
        self.assertIn("starts 0.004 m inside the ground", done.stderr)
        self.assertRegex(done.stderr, r"\d+ snapshots instead of 5000")

    def test_what_is_not_finite_is_named_with_its_step(self):
        done = run("run", self.case(), "-o", self.out, "--set", "initial.velocity=[1e160, 0]",
                   "--set", "output.snapshots=0",  # which could not hold the start
                   env={**os.environ, "RONDO_TRAPS": "off"})
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertRegex(done.stderr, r"step \d+ of \d+, t = \S+ s: ")
        self.assertRegex(done.stderr, r"energy is out of range|is not finite")
        self.assertEqual(summary(self.out)["status"], "failed")

    def test_every_field_off(self):
        text = replaced(SMALL, "snapshots", "snapshots = 0\nstress = false")
        text = text.replace('[ground]\nprofile = "flat"\nfriction = 0.3\n', "")
        self.run_ok(text)
        with h5py.File(self.out / "results.h5") as f:
            self.assertNotIn("contact", f)
        self.assertEqual(summary(self.out)["contact_residual_max"], 0.0)

    def test_cannot_write(self):
        (self.folder / "file").write_text("in the way")
        done = run("run", self.case(), "-o", self.folder / "file" / "out")
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("file", done.stderr)

    def test_blow_up_of_the_scheme_as_printed_is_exit_3(self):
        text = SMALL.replace("mass = 200.0", "mass = 0.0").replace("stiffness = 2.0e-5",
                                                                   "stiffness = 0.0")
        text = text.replace("angular_velocity = 33.333333", "angular_velocity = 200.0")
        text = replaced(text, "end", 'end = 2.0\nscheme = "as-printed"')
        text = text.replace('[ground]\nprofile = "flat"\nfriction = 0.3\n', "")
        done = run("run", self.case(text), "-o", self.out)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("work_scheme", done.stderr)
        self.assertRegex(done.stderr, r"step \d+ of \d+, t = ")
        s = summary(self.out)
        self.assertEqual(s["status"], "failed")
        self.assertLess(s["steps_done"], s["steps"])
        self.assertLess(s["energy_residual_relative"], 1e-12)  # the ledger closes all the same
        h = history(self.out)
        self.assertGreater(h["work_scheme"][-1], 0)
        with h5py.File(self.out / "results.h5") as f:
            self.assertEqual(len(f["/frame/time"]), s["snapshots"])

    def test_concave_corner_pairs(self):
        # A locked wheel slides through a shallow valley: nodes held by two facets at once.
        text = SMALL.replace('"flat"', "[[-1, 0], [0.05, 0], [1, 0.1]]")
        text = text.replace("angular_velocity = 33.333333", "angular_velocity = 0.0")
        self.run_ok(text.replace("circumferential = 40", "circumferential = 120"))
        self.assertGreater(summary(self.out)["contact"]["pairs_solved"], 0)
        self.assertEqual(summary(self.out)["contact"]["pairs_not_converged"], 0)


class Processors(ProgramTest):
    def test_threads_are_those_that_may_be_used(self):
        """Not those of the machine: 17.7 s instead of 0.31 s under taskset -c 0, with six threads."""
        allowed = sorted(os.sched_getaffinity(0))
        for cpus in (allowed[:1], allowed):
            done = run("check", ROOT / "cases" / "ledge-smooth.toml", "--json", "--set",
                       "disk.mesh.radial=20", "--set", "disk.mesh.circumferential=720",
                       preexec_fn=functools.partial(os.sched_setaffinity, 0, cpus))
            self.assertEqual(done.returncode, 0, done.stderr)
            threads = json.loads(done.stdout)["result"]["threads"]
            self.assertLessEqual(threads, len(cpus))
            self.assertGreaterEqual(threads, 1)


class BlasThreads(ProgramTest):
    """Sparse factorisations call a BLAS that would divide its sums by threads: large ones show it."""

    def bits(self, threads, *settings):
        out = self.folder / f"threads{threads}"
        fine = ("disk.mesh.radial=48", "disk.mesh.circumferential=720", *settings)
        done = run("run", ROOT / "cases" / "ledge-smooth.toml", "-o", out, "--quiet", "--threads", 1,
                   *(word for setting in fine for word in ("--set", setting)),
                   env={**os.environ, "OPENBLAS_NUM_THREADS": str(threads)})
        self.assertEqual(done.returncode, 0, done.stderr)
        return (out / "history.csv").read_bytes()

    def test_crush(self):
        settings = ("analysis.kind=crush", "analysis.depth=0.03", "analysis.increments=2",
                    "ground.profile=flat", "ground.friction=0.1")
        self.assertEqual(self.bits(1, *settings), self.bits(2, *settings))

    def test_stationary_start(self):
        settings = ("initial.state=stationary", "time.end=2e-5", "output.history_interval=0")
        self.assertEqual(self.bits(1, *settings), self.bits(2, *settings))


if __name__ == "__main__":
    unittest.main()

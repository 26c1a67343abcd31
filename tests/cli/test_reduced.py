# SPDX-License-Identifier: BSD-3-Clause
"""rondo reduce and rondo run --reduced from outside: files, figures, wrong input."""
import json
import signal
import subprocess
import time
import unittest

import h5py
import numpy as np

from program import PROGRAM, ProgramTest, SMALL, history, replaced, run, summary

PARTS = ["--displacement-modes", 20, "--velocity-modes", 20]
FILES = ["case.toml", "contact.csv", "fields.vtkhdf", "fields.xdmf", "history.csv", "results.h5",
         "run.json"]


class Reduced(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        import pathlib
        import tempfile
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.shared = pathlib.Path(folder.name)
        cls.case_file = cls.shared / "case.toml"
        cls.case_file.write_text(replaced(replaced(
            SMALL, "snapshots", "snapshots = 81"), "circumferential", "circumferential = 120"))
        for friction in ("0.2", "0.4"):
            cls.made("run", cls.case_file, "-o", cls.shared / friction, "--set",
                     f"ground.friction={friction}")
        cls.model = cls.shared / "model.h5"
        cls.said = cls.made("reduce", cls.shared / "0.2", cls.shared / "0.4", "-o", cls.model,
                            *PARTS)
        cls.made("run", cls.case_file, "-o", cls.shared / "full")

    @classmethod
    def made(cls, *arguments):
        done = run(*arguments)
        assert done.returncode == 0, done.stderr
        return done

    def reduced(self, *arguments, code=0, case=None, model=None):
        out = self.folder / "out"
        done = run("run", case or self.case_file, "--reduced", model or self.model, "-o", out,
                   *arguments)
        self.assertEqual(done.returncode, code, done.stderr)
        return out, done

    def fails(self, *arguments, code=2):
        """Of rondo reduce."""
        done = run("reduce", *arguments, "-o", self.folder / "none.h5")
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertFalse((self.folder / "none.h5").exists())
        return done.stderr

    def test_model_file(self):
        self.assertIn("modes", self.said.stdout)
        with h5py.File(self.model) as f:
            self.assertEqual(f.attrs["format"], "rondo reduced model 2")
            basis, mass = f["/model/basis"][:], f["/mesh/mass"][:]
            r = len(basis)
            self.assertLessEqual(r, 20 + 20 + 20)
            self.assertGreater(r, 50)
            gram = np.einsum("inx,n,jnx->ij", basis, mass, basis)
            self.assertLess(abs(gram - np.eye(r)).max(), 1e-13)
            for name in ("generator", "turn"):
                matrix = f["/model/" + name][:]
                self.assertEqual(abs(matrix + matrix.T).max(), 0.0)
            # Row i, column j: mode i · M · J mode j.
            turned = np.stack([-basis[..., 1], basis[..., 0]], axis=-1)
            product = np.einsum("inx,n,jnx->ij", basis, mass, turned)
            self.assertLess(abs(product - f["/model/turn"][:]).max(), 1e-13)
            self.assertEqual(list(f["/ranges/friction"]), [0.2, 0.4])
            for dataset in (f["/model/basis"], f["/ranges/height"]):
                self.assertTrue(dataset.attrs["units"] and dataset.attrs["description"])

    def test_error_estimate(self):
        """The model of three runs says how far off each is when predicted from the others."""
        runs = [self.shared / "0.2", self.shared / "0.4", self.shared / "full"]
        model = self.folder / "three.h5"
        said = self.made("reduce", *runs, "-o", model, *PARTS).stdout
        self.assertIn("twice the largest of 3 runs", said)
        with h5py.File(model) as f:
            errors, of_themselves = f["/errors/force"][:], f["/errors/of_themselves"][:]
            self.assertEqual(f.attrs["estimate_runs"].split(), [str(r) for r in runs])
        out, done = self.reduced(model=model)
        self.assertIn("error estimate of the model: F_x", done.stderr + done.stdout)
        estimate = summary(out)["reduced_error_estimate"]
        np.testing.assert_array_equal([estimate["force_x"], estimate["force_y"]],
                                      2 * abs(errors).max(axis=0))
        # Over themselves: F_x is a small part of F_y, and friction is neither.
        self.assertIn("over themselves F_x", done.stderr + done.stdout)
        np.testing.assert_array_equal([estimate["force_x_of_itself"], estimate["friction_power"]],
                                      2 * abs(of_themselves).max(axis=0))
        for k, full in enumerate(runs):
            h = history(full)
            late = h["time_s"] > 0.75 * h["time_s"][-1]
            share = abs(h["force_x"][late].mean()) / h["force_y"][late].mean()
            self.assertAlmostEqual(of_themselves[k, 0] * share / errors[k, 0], 1.0, places=9)
        # The last of them by hand: from a model of the other two.
        out, _ = self.reduced("--overwrite")
        a, b = history(self.shared / "full"), history(out)
        late = [h["time_s"] > 0.75 * h["time_s"][-1] for h in (a, b)]
        scale = a["force_y"][late[0]].mean()
        for k, name in enumerate(("force_x", "force_y")):
            by_hand = (b[name][late[1]].mean() - a[name][late[0]].mean()) / scale
            self.assertAlmostEqual(errors[2, k], by_hand, delta=0.0015)
        # The friction of the first likewise, which depends more on the modes.
        model = self.folder / "others.h5"
        self.made("reduce", runs[1], runs[2], "-o", model, *PARTS)
        out, _ = self.reduced("--overwrite", "--set", "ground.friction=0.2", model=model)
        late = [h["time_s"] > 0.75 * h["time_s"][-1] for h in (history(runs[0]), history(out))]
        a, b = (np.ptp(h["dissipation_friction"][part]) / np.ptp(h["time_s"][part])
                for h, part in zip((history(runs[0]), history(out)), late))
        self.assertAlmostEqual(of_themselves[0, 1], b / a - 1.0, delta=0.1)

    def test_no_error_estimate_says_why(self):
        out, done = self.reduced()
        j = summary(out)
        self.assertIsNone(j["reduced_error_estimate"])
        self.assertIn("2 runs, and 3 are needed", j["reduced_error_estimate_missing"])
        self.assertIn("error estimate of the model: none: 2 runs", done.stderr + done.stdout)
        model = self.folder / "three.h5"
        runs = [self.shared / "0.2", self.shared / "0.4", self.shared / "full"]
        said = self.made("reduce", *runs, "-o", model, *PARTS, "--no-error-estimate").stdout
        self.assertIn("--no-error-estimate", said)
        with h5py.File(model) as f:
            self.assertEqual(list(f["/errors/runs"]), [0])

    def test_contact_phases(self):
        """One point to a node, or as many as are asked for; never with a stride."""
        with h5py.File(self.model) as f:
            self.assertEqual(f["/model/contact_weights"].shape, (120, 120))
        three = self.folder / "three.h5"
        self.made("reduce", self.shared / "0.2", "-o", three, *PARTS, "--contact-phases", 3)
        with h5py.File(three) as f:
            self.assertEqual(f["/model/contact_weights"].shape, (360, 120))
        self.assertIn("fewer points than nodes", self.fails(
            self.shared / "0.2", "--contact-phases", 2, "--contact-stride", 2))

    def test_results_are_those_of_a_run(self):
        out, done = self.reduced("--step-factor", 8)
        self.assertEqual(sorted(p.name for p in out.iterdir()), FILES)
        j, full = summary(out), summary(self.shared / "full")
        self.assertEqual((j["status"], j["lifted"], j["step_factor"]), ("done", True, 8))
        self.assertEqual(j["step"], 8 * full["step"])
        self.assertEqual(set(full) - set(j), set())
        self.assertLess(j["energy_residual_relative"], 1e-11)
        self.assertLess(j["contact_residual_max"], 1e-9)
        self.assertEqual(j["reduced"]["matrices_factored"], 1)
        a, b = history(self.shared / "full"), history(out)
        self.assertEqual(list(a), list(b))
        late = a["time_s"] > 0.015
        mean = a["force_y"][late].mean()
        # Few columns are in contact, and few snapshots made the modes; test_reduced_table.py is
        # stricter.
        self.assertLess(abs(b["force_y"][b["time_s"] > 0.015].mean() - mean), 0.02 * mean)
        with h5py.File(out / "results.h5") as f, h5py.File(self.shared / "full/results.h5") as g:
            t, u = f["/frame/time"][:], f["/snapshots/displacement"][:]
            self.assertEqual(u.shape[1:], g["/snapshots/displacement"].shape[1:])
            half = 0.5 * j["step"]
            self.assertLess(abs(t[1:] - f["/frame/time_velocity"][1:] - half).max(), 1e-12)
            # The same field as the full run's at the same angle.
            theirs = g["/snapshots/displacement"][:]
            near = [int(abs(g["/frame/time"][:] - at).argmin()) for at in t]
            late = t > 0.015
            error = np.linalg.norm(u[late] - theirs[near][late]) / np.linalg.norm(u[late])
            self.assertLess(error, 0.15)  # times differ by up to half an interval of 0.25 ms
            force = f["/contact/force"][:]
            self.assertGreaterEqual(force[..., 0].min(), 0.0)
            # The nodes get what the ground gives: the row of the history at a snapshot's time.
            k = int(abs(b["time_s"] - t[-1]).argmin())
            self.assertAlmostEqual(force[-1, :, 0].sum() / b["force_y"][k], 1.0, places=9)

    def test_lifted_velocity_is_the_rate_of_the_displacement(self):
        out, _ = self.reduced("--step-factor", 4, "--set", "output.snapshots=100000")
        with h5py.File(out / "results.h5") as f:
            u, v = f["/snapshots/displacement"][:], f["/snapshots/velocity"][:]
            t = f["/frame/time"][:]
        rate = (u[1:] - u[:-1]) / (t[1:] - t[:-1])[:, None, None]
        late = slice(len(rate) // 2, None)
        # (u⁺ - u)/Δt is P̄ but for what the modes miss of s D u, and for Δt².
        error = np.linalg.norm(rate[late] - v[1:][late]) / np.linalg.norm(v[1:][late])
        self.assertLess(error, 0.2)

    def test_spin_that_changes(self):
        out, _ = self.reduced("--step-factor", 4, "--set",
                              "motion.angular_velocity=[[0, 33.3], [0.01, 33.4]]")
        j = summary(out)
        half = j["steps_done"] / 2
        self.assertAlmostEqual(j["reduced"]["matrices_factored"], half, delta=3)
        self.assertLess(j["energy_residual_relative"], 1e-11)

    def test_hard_contacts(self):
        few = self.folder / "few.h5"
        self.made("reduce", self.shared / "0.2", self.shared / "0.4", "-o", few,
                  "--displacement-modes", 3, "--velocity-modes", 3)
        rolling = {}
        lifted = {"motion.height": "[[0, 0.3], [0.004, 0.296], [0.008, 0.296], [0.01, 0.304], "
                                   "[0.012, 0.304], [0.016, 0.296]]"}
        bouncing = {"ground.restitution": 1, "damping.mass": 0, "damping.stiffness": 0}
        standing = {"motion.speed": 0, "motion.angular_velocity": 0}
        locked = {"motion.angular_velocity": 0, "motion.gravity": 9.81}
        for model in (few, self.model):
            for changes in (rolling, lifted, bouncing, standing, locked):
                settings = [x for k, v in changes.items() for x in ("--set", f"{k}={v}")]
                out, _ = self.reduced("--overwrite", "--step-factor", 8, *settings, model=model)
                j = summary(out)
                self.assertLess(j["contact_residual_max"], 1e-11, changes)
                self.assertLess(j["energy_residual_relative"], 1e-11, changes)
                self.assertEqual(j["reduced"]["steps_not_converged"], 0, changes)
                crowded = j["reduced"]["steps_with_more_rows_than_modes"]
                self.assertEqual(crowded > 0, model == few, changes)
                h = history(out)
                if changes is lifted:
                    self.assertEqual(h["contact_nodes"][abs(h["time_s"] - 0.0115) < 4e-4].max(), 0)
                    self.assertGreater(h["contact_nodes"][-1], 3)
                if changes is locked:  # every point slips forwards: μ everywhere
                    late = h["time_s"] > 0.012
                    np.testing.assert_allclose(h["force_x"][late], -0.3 * h["force_y"][late],
                                               rtol=1e-9)

    def test_warns_outside_of_its_range(self):
        _, done = self.reduced("--set", "ground.friction=0.9")
        self.assertIn("ground.friction is 0.9", done.stderr)
        self.assertIn("0.2 to 0.4", done.stderr)
        _, done = self.reduced("--overwrite", "--set", "ground.friction=0.3")
        self.assertNotIn("not known to be right", done.stderr)
        _, done = self.reduced("--overwrite", "--set", "motion.speed=12")
        self.assertIn("motion.speed", done.stderr)
        self.assertIn("slip ratio", done.stderr)
        _, done = self.reduced("--overwrite", "--step-factor", 200)
        self.assertIn("contact points in a step", done.stderr)

    def test_refuses_another_body(self):
        for key, value, said in (("disk.mesh.radial", 4, "radial = 4"),
                                 ("material.youngs_modulus", 3e7, "youngs_modulus = 30000000"),
                                 ("disk.outer_radius", 0.299, "outer_radius = 0.299")):
            out, done = self.reduced("--set", f"{key}={value}", code=2)
            self.assertIn(said, done.stderr)
            self.assertIn("rondo reduce", done.stderr)
            self.assertFalse(out.exists())

    def test_refuses_what_it_cannot_do(self):
        parts = ["time.scheme=hati", "solver.hati.ratio=1", "solver.hati.fine.layers=[3]"]
        for settings, said in ((["time.scheme=as-printed"], "scheme of its own"),
                               (parts, "scheme of its own"),
                               (["ground.profile=[[-9, -0.01], [0, -0.01], [0.1, 0], [9, 0]]"],
                                "fillet")):
            _, done = self.reduced(*(x for s in settings for x in ("--set", s)), code=2)
            self.assertIn(said, done.stderr)
        _, done = self.reduced("--resume", code=2)
        self.assertIn("keeps no checkpoints", done.stderr)
        for factor in ("0", "-3", "nan", "inf"):
            _, done = self.reduced("--step-factor", factor, code=2)
            self.assertIn("--step-factor", done.stderr)
        done = run("run", self.case_file, "--step-factor", 3)
        self.assertEqual(done.returncode, 2)
        _, done = self.reduced(model=self.folder / "nothing.h5", code=2)
        self.assertIn("no such file", done.stderr)

    def test_damaged_model(self):
        bytes_ = bytearray(self.model.read_bytes())
        bytes_[len(bytes_) // 2] ^= 1
        damaged = self.folder / "damaged.h5"
        damaged.write_bytes(bytes_)
        _, done = self.reduced(model=damaged, code=4)
        self.assertIn("damaged.h5", done.stderr)
        _, done = self.reduced(model=self.shared / "full" / "results.h5", code=4)

    def test_resuming_results_of_a_reduced_run_is_refused(self):
        out, _ = self.reduced()
        before = (out / "history.csv").read_bytes()
        done = run("run", out, "--resume")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("of a run that keeps no checkpoints", done.stderr)
        # Neither does a full run take the place of one that was killed.
        (out / "run.json").write_text(json.dumps({**summary(out), "status": "running"}))
        done = run("run", self.case_file, "-o", out, "--resume")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("of a run that keeps no checkpoints", done.stderr)
        self.assertEqual((out / "history.csv").read_bytes(), before)

    def test_interrupt(self):
        out = self.folder / "out"
        text = ["--set", "time.end=20", "--set", "output.snapshots=0", "--step-factor", "1"]
        process = subprocess.Popen([PROGRAM, "run", self.case_file, "--reduced", self.model, "-o",
                                    out, *text], stderr=subprocess.PIPE, text=True)
        until = time.monotonic() + 60
        while not (out / "history.csv").exists() and time.monotonic() < until:
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, said)
        self.assertNotIn("continue with --resume", said)
        self.assertEqual(summary(out)["status"], "interrupted")
        self.assertFalse((out / "checkpoint.h5").exists())

    def test_reduce_refuses(self):
        full = self.shared / "full"
        other = self.folder / "other"
        self.made("run", self.case_file, "-o", other, "--set", "disk.mesh.radial=4")
        self.assertIn("radial = 4 against radial = 3", self.fails(full, other))
        soft = self.folder / "soft"
        self.made("run", self.case_file, "-o", soft, "--set", "material.poissons_ratio=0.31")
        self.assertIn("not the body of", self.fails(full, soft))
        one = self.folder / "one"
        self.made("run", self.case_file, "-o", one, "--set", "output.snapshots=1")
        self.assertIn("1 snapshots make no model", self.fails(one))
        crush = self.folder / "crush"
        self.made("run", self.case_file, "-o", crush, "--set", "analysis.kind=crush", "--set",
                  "analysis.depth=0.004", "--set", "analysis.increments=4")
        self.assertIn("crush", self.fails(crush))
        free = self.folder / "free"
        text = replaced(SMALL, "inner_radius", 'inner_radius = 0.15\nrim = "free"')
        kept = "\n".join(line for line in text.splitlines() if not line.startswith(
            ("[motion]", "angular_velocity", "speed", "height"))) + "\n"
        self.made("run", self.case(kept + "[initial]\nposition = [0, 0.4]\n", "free.toml"), "-o",
                  free)
        self.assertIn("no equal sectors", self.fails(free))
        self.assertIn("named twice", self.fails(full, full))
        self.assertIn("--tolerance", self.fails(full, "--tolerance", 2))
        self.assertIn("--velocity-modes", self.fails(full, "--velocity-modes", 0))
        self.assertIn("a divisor of 120", self.fails(full, "--contact-stride", 7))
        self.assertIn("no snapshot", self.fails(full, "--from", 1))
        self.assertIn("nowhere", self.fails(self.folder / "nowhere"))

    def test_reduce_refuses_unfinished_runs(self):
        cut = self.folder / "cut"
        self.made("run", self.case_file, "-o", cut)
        record = json.loads((cut / "run.json").read_text())
        for status in ("running", "interrupted", "failed"):
            (cut / "run.json").write_text(json.dumps({**record, "status": status}))
            self.assertIn(f"not finished (status {status})", self.fails(cut))

    def test_reduce_refuses_runs_without_velocities(self):
        bare = self.folder / "bare"
        self.made("run", self.case_file, "-o", bare)
        with h5py.File(bare / "results.h5", "r+") as f:
            del f["/snapshots/velocity"]
        self.assertIn("displacements alone cannot roll", self.fails(bare))

    def test_tolerances_choose_the_modes(self):
        counts = []
        for tolerance in (1e-3, 1e-5):
            done = self.made("reduce", self.shared / "0.2", "-o", self.folder / "m.h5",
                             "--tolerance", tolerance, "--velocity-tolerance", 100 * tolerance)
            lines = {x.split()[0]: x.split() for x in done.stdout.splitlines()}
            self.assertLessEqual(float(lines["displacement"][8]), tolerance)
            self.assertLessEqual(float(lines["velocity"][8]), 100 * tolerance)
            counts.append(int(lines["displacement"][1]))
        self.assertLess(counts[0], counts[1])


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""rondo reduce: the modes of a reduced wheel in a file, of a case or of the snapshots of runs."""
import json
import unittest

import h5py
import numpy as np

from program import ROOT, SMALL, history, replaced, run, summary
from test_wheel import ROLLING, mean
from wheels import WheelTest

COARSE = ["--set", "disk.mesh.radial=6", "--set", "disk.mesh.circumferential=90"]


class Reduce(WheelTest):
    def reduce(self, *arguments, code=0, file="wheel.h5"):
        file = self.folder / file
        done = run("reduce", *arguments, "-o", file)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertEqual(file.exists(), code == 0)
        return (file, done) if code == 0 else done.stderr

    def reduces_to(self, file, source):
        before = file.read_bytes()
        done = run("reduce", source, "-o", file)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(file.read_bytes(), before)
        return done.stderr

    def full(self, *arguments, case=SMALL, out="full", code=0):
        out = self.folder / out
        done = run("run", self.case(case), "-o", out, *arguments)
        self.assertEqual(done.returncode, code, done.stderr)
        return out

    def test_the_file_of_a_case_runs_to_the_same_bits(self):
        self.wheel("--modes", 20, case=ROLLING, out="whole")
        file, done = self.reduce(self.case(ROLLING), "--modes", 20)
        self.assertRegex(done.stdout, r"modes +20 eigenmodes for 4320 dofs, up to 1937\.4 rad/s")
        out, _ = self.wheel(case=ROLLING, file=file)
        self.same_bits(out)
        found = summary(out)
        self.assertEqual((found["wheel_modes"], found["wheel_basis"], found["wheel_file"]),
                         (20, "eigenmodes", str(file)))
        # Friction, spin, step and motion are those of the run.
        self.wheel("--modes", 20, "--set", "motion.angular_velocity=[[0, 30], [0.2, 35]]", "--set",
                   "ground.friction=0.1", "--reduced-step", 3e-4, "--overwrite", case=ROLLING, out="whole")
        out, _ = self.wheel("--set", "motion.angular_velocity=[[0, 30], [0.2, 35]]", "--set",
                            "ground.friction=0.1", "--reduced-step", 3e-4, "--overwrite", case=ROLLING, file=file)
        self.same_bits(out)

    def test_what_is_in_the_file(self):
        file, _ = self.reduce(self.case(SMALL), "--modes", 9, "--set", "motion.angular_velocity=[[0, 0], [1, 40]]")
        with h5py.File(file) as f:
            self.assertEqual((f.attrs["format"], f.attrs["basis"]), ("rondo reduced wheel 1", "eigenmodes"))
            harmonic, square, shape = (f["/modes/" + name][:] for name in ("harmonic", "square", "shape"))
            mass, node, counts = f["/mesh/mass_dynamic"][:], f["/sector/node"][:], f["/sector/counts"][:]
            coriolis = f["/modes/coriolis"][:] @ [1, 1j]
            spins, table = np.sqrt(f["/residual/spin_squared"][:]), f["/residual/compliance"][:]
            for item in (f["/modes/shape"], f["/residual/compliance"]):
                self.assertTrue(item.attrs["units"] and item.attrs["description"])
        self.assertEqual(list(counts), [40, 4])
        self.assertEqual(sum(1 if k == 0 else 2 for k in harmonic), 9)
        self.assertTrue(np.all(square > 0))
        self.assertEqual(len(spins), 3)
        self.assertLess(spins[-1], 40)
        self.assertGreater(spins[-1], 38)
        shape = shape @ [1, 1j]
        gram = np.einsum("iax,a,jax->ij", shape.conj(), mass[node], shape)
        turned = np.stack([-shape[..., 1], shape[..., 0]], axis=-1)
        product = np.einsum("iax,a,jax->ij", shape.conj(), mass[node], turned)
        for k in set(harmonic):
            own = np.ix_(harmonic == k, harmonic == k)
            self.assertLess(abs(gram[own] - np.eye(sum(harmonic == k))).max(), 1e-12)
            self.assertLess(abs(product[own] - coriolis[own]).max(), 1e-12)
        self.assertEqual(table.shape, (3, 40, 2, 2))
        # Node i by a force on j is node j by one on i.
        np.testing.assert_allclose(table[:, 1:], np.swapaxes(table[:, :0:-1], 2, 3), rtol=0, atol=1e-12 * table.max())

    def test_the_pod_of_runs_rolls_as_the_mesh_does(self):
        """Modes of two runs and of steady states, at a friction that neither has."""
        runs = [self.full("--set", f"ground.friction={mu}", "--set", "output.snapshots=81", *COARSE, case=ROLLING,
                          out=f"mu{mu}") for mu in (0.0, 0.6)]
        runs.append(self.full("--set", "ground.friction=0.3", *COARSE,
                              case=(ROOT / "cases" / "steady-rolling.toml").read_text(), out="steady"))
        file, done = self.reduce(*runs, "--basis", "pod", "--modes", 20)
        self.assertRegex(done.stdout, r"modes +20 of a POD for 1080 dofs")
        self.assertIn("snapshots", done.stdout)
        full = history(self.full("--set", "ground.friction=0.2", *COARSE, case=ROLLING))
        out, _ = self.wheel("--set", "ground.friction=0.2", *COARSE, case=ROLLING, file=file)
        found = summary(out)
        self.assertEqual((found["wheel_modes"], found["wheel_basis"]), (20, "pod"))
        self.assertLess(found["energy_residual_relative"], 1e-11)
        y = mean(full, "force_y")
        self.assertAlmostEqual(mean(history(out), "force_y") / y, 1.0, delta=0.01)
        self.assertAlmostEqual(mean(history(out), "force_x") / y, mean(full, "force_x") / y, delta=0.01)
        # While it lands: modes that are none of the wheel's are worse than none.
        def landing(rows):
            edges = np.arange(0.006, 0.06, 0.0021)
            impulse = np.cumsum(rows["force_y"] * np.diff(rows["time_s"], prepend=0.0))
            return np.diff(np.interp(edges, rows["time_s"], impulse)) / 0.0021

        file, _ = self.reduce(*runs, "--basis", "pod", "--modes", 41)
        errors = []
        fine = ["--set", "ground.friction=0.2", "--set", "output.history_interval=0", *COARSE]
        landed = landing(history(self.full(*fine, case=ROLLING, out="landing")))
        for options, of in (([], file), (["--modes", 0], None)):
            out, _ = self.wheel(*fine, *options, "--overwrite", case=ROLLING, file=of, out="lands")
            errors.append(np.sqrt(np.mean((landing(history(out)) - landed) ** 2)) / y)
        # Measured: 0.0053 with the POD, 0.0101 without modes.
        self.assertLess(errors[0], 0.008)
        self.assertGreater(errors[1], 0.0095)
        slippery, _ = self.wheel("--set", "ground.friction=0.05", *COARSE, case=ROLLING, file=file, out="slippery")
        self.assertGreater(abs(mean(history(slippery), "force_x") / y - mean(full, "force_x") / y), 0.01)
        # The first modes hold more of the energy than any other number of them.
        shares = [json.loads(self.reduce(*runs, "--modes", n, "--json", file=f"{n}.h5")[1].stdout)["result"]
                  ["energy_left"] for n in (3, 11, 41)]
        self.assertTrue(0.9 > shares[0] > shares[1] > shares[2] > 0.0, shares)

    def test_a_window_and_a_crush(self):
        out = self.full("--set", "output.snapshots=21", "--set", "time.end=0.02")
        found = json.loads(self.reduce(out, "--from", 0.0095, "--to", 0.021, "--json")[1].stdout)["result"]
        self.assertEqual(found["snapshots"], 11)
        crush = self.full("--set", 'analysis.kind="crush"', "--set", "analysis.depth=0.004", "--set",
                          "analysis.increments=10", out="crush",
                          case=replaced(SMALL, "height", "height = 0.3"))
        file, _ = self.reduce(crush, "--modes", 5, file="crush.h5")
        out, _ = self.wheel(case=SMALL, file=file)
        self.assertIn(summary(out)["wheel_modes"], (5, 6))

    def test_a_file_of_pod_modes_resumes_with_it_alone(self):
        case = replaced(SMALL, "end", "end = 0.02")
        full = self.full()
        file, _ = self.reduce(full, "--modes", 8)
        other, _ = self.reduce(full, "--modes", 8, "--from", 0.01, file="other.h5")
        self.wheel("--set", "time.end=0.03", case=case, file=file, out="whole")
        out, _ = self.wheel(case=case, file=file)
        done = run("run", out, "--resume", "--reduced", other, "--set", "time.end=0.03")
        self.assertEqual(done.returncode, 2)
        self.assertIn("8 modes of a POD up to", done.stderr)
        done = run("run", out, "--resume", "--reduced", file, "--set", "time.end=0.03")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.folder / "whole" / "history.csv").read_bytes(), (out / "history.csv").read_bytes())

    def test_the_estimate_of_a_file(self):
        """Half the step with the modes of the file; twice as many eigenmodes."""
        file, _ = self.reduce(self.full(), "--modes", 8)
        every = ["--set", "output.history_interval=0"]
        out, done = self.wheel("--estimate", *every, case=SMALL, file=file)
        self.assertIn("error estimate", done.stdout + done.stderr)
        told, step = summary(out)["wheel_estimate"], summary(out)["step"]
        halved, _ = self.wheel("--reduced-step", repr(step / 2), *every, case=SMALL, file=file, out="halved")
        n = summary(out)["wheel_modes"]
        richer, _ = self.wheel("--reduced-step", repr(step), "--modes", 2 * n, *every, case=SMALL,
                               out="richer")
        for other, name in ((halved, "force_x_by_step"), (richer, "force_x_by_modes")):
            a, b = (history(one) for one in (out, other))
            x, y = ([np.mean(h[c][1:][np.arange(1, len(h[c])) > 0.75 * (len(h[c]) - 1)]) for h in (a, b)]
                    for c in ("force_x", "force_y"))
            self.assertAlmostEqual(told[name], (x[0] - x[1]) / y[1], delta=1e-6, msg=name)

    def test_a_mesh_from_a_file(self):
        text = (ROOT / "cases" / "rolling-spokes.toml").read_text().replace('"meshes/', f'"{ROOT}/cases/meshes/')
        case = self.case(replaced(text, "end", "end = 0.02"))
        file, _ = self.reduce(case, "--modes", 20)
        whole, same = self.folder / "whole", self.folder / "same"
        for out, reduced in ((whole, ["--reduced", "--modes", 20]), (same, ["--reduced", file])):
            done = run("run", case, "-o", out, *reduced)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((whole / "history.csv").read_bytes(), (same / "history.csv").read_bytes())
        told = run("reduce", same, "-o", self.folder / "none.h5")
        self.assertEqual(told.returncode, 2)
        self.assertIn("no equal sectors", told.stderr)

    def test_what_it_refuses(self):
        case, full = self.case(SMALL), self.full()
        none = "none.h5"
        self.assertIn("is of one case", self.reduce(full, "--basis", "eigenmodes", code=2, file=none))
        self.assertIn("eigenmodes | pod", self.reduce(case, "--basis", "svd", code=2, file=none))
        self.assertIn("no modes to keep", self.reduce(full, "--modes", 0, code=2, file=none))
        self.assertIn("no number of modes", self.reduce(case, "--modes", -1, code=2, file=none))
        self.assertIn("eigenmodes need none", self.reduce(case, "--from", 0.01, code=2, file=none))
        self.assertIn("a POD is of runs", self.reduce(full, "--set", "ground.friction=0", code=2, file=none))
        self.assertIn("no snapshot", self.reduce(full, "--from", 5, code=2, file=none))
        self.assertIn("no such", self.reduce(self.folder / "missing.toml", code=2, file=none))
        self.assertIn("no file of rondo reduce", self.reduces_to(full / "results.h5", full))
        self.assertIn("no file of rondo reduce", self.reduces_to(case, case))
        self.assertIn("is of results, and", self.reduce(case, "--basis", "pod", code=2, file=none))
        self.assertIn("RESULTS --basis pod", self.reduce(ROOT / "cases/crush-smooth.toml", code=2, file=none))
        fine = self.full("--set", "disk.mesh.radial=4", out="fine")
        self.assertIn("not the mesh of", self.reduce(full, fine, code=2, file=none))
        stiff = self.full("--set", "material.youngs_modulus=3e7", out="stiff")
        self.assertIn("not the body of", self.reduce(full, stiff, code=2, file=none))
        air = self.full(out="air", case=SMALL.split("[ground]")[0] + "[time]\nend = 0.01\n[output]\nsnapshots = 3\n")
        self.assertIn("has no ground", self.reduce(air, code=2, file=none))
        still = self.full("--set", "motion.angular_velocity=0", "--set", "motion.height=0.4", "--set",
                          "motion.speed=0", out="still")
        self.assertIn("nothing moves", self.reduce(still, code=2, file=none))

    def test_runs_of_other_spins_and_kinds_of_contact(self):
        """What a basis does not depend on may differ; a body that the spin stiffens is that of its spin."""
        runs = [self.full("--set", "motion.angular_velocity=-30", "--set", "motion.speed=-9", out="back"),
                self.full("--set", "ground.restitution=0.5", out="bounces")]
        for order in (runs, runs[::-1]):
            found = json.loads(self.reduce(*order, "--json")[1].stdout)["result"]
            self.assertEqual((found["snapshots"], len(found["spins"])), (22, 3))
        stiff = ["--set", 'material.stress_stiffening="centrifugal"', "--set",
                 "motion.angular_velocity=[[0, 30], [0.02, 35]]"]
        file, _ = self.reduce(self.full(*stiff, out="stiff"), file="stiff.h5")
        self.wheel(*stiff, case=SMALL, file=file)
        _, done = self.wheel(*stiff, "--set", "motion.angular_velocity=35", "--overwrite", case=SMALL, file=file, code=2)
        self.assertIn("another mesh or material", done.stderr)

    def test_a_window_in_seconds_is_not_of_a_crush(self):
        crush = self.full("--set", 'analysis.kind="crush"', "--set", "analysis.depth=0.004", "--set",
                          "analysis.increments=10", out="crush", case=replaced(SMALL, "height", "height = 0.3"))
        own = json.loads(self.reduce(crush, "--json")[1].stdout)["result"]["snapshots"]
        full = self.full()
        both = json.loads(self.reduce(crush, full, "--from", 0.0095, "--json")[1].stdout)["result"]["snapshots"]
        alone = json.loads(self.reduce(full, "--from", 0.0095, "--json")[1].stdout)["result"]["snapshots"]
        self.assertEqual(both, own + alone)

    def test_what_a_run_refuses(self):
        def refused(text, *arguments, file, code=2):
            _, done = self.wheel(*arguments, case=SMALL, file=file, code=code)
            self.assertIn(text, done.stderr)

        file, _ = self.reduce(self.case(SMALL), "--modes", 9)
        refused("is of another mesh or material: the case has radial = 4 against radial = 3", "--set",
                "disk.mesh.radial=4", file=file)
        refused("another mesh or material: the case has youngs_modulus", "--set", "material.youngs_modulus=3e7",
                file=file)
        refused("rondo reduce CASE.toml --modes N", "--modes", 3, file=file)
        refused("no such file", file=self.folder / "missing.h5")
        damaged = self.folder / "damaged.h5"
        data = bytearray(file.read_bytes())
        data[len(data) // 2] ^= 1
        damaged.write_bytes(data)
        refused("damaged.h5", file=damaged, code=4)
        refused("rondo reduce CASE.toml -o wheel.h5 makes a file", file=self.case(SMALL, "wheel.toml"), code=4)
        refused("rondo reduce RESULTS --basis pod", file=self.folder)

    def test_options_that_are_gone_are_told(self):
        full = self.full()
        _, done = self.reduce(full, "--displacement-modes", 10, "--contact", "nodes", "--no-error-estimate")
        for option in ("--displacement-modes", "--contact", "--no-error-estimate"):
            self.assertIn(f"{option} has gone and is ignored", done.stderr)
        _, done = self.wheel("--step-factor", 20, "--snapshots", "modes", case=SMALL)
        self.assertIn("--step-factor has gone and is ignored: --reduced-step", done.stderr)
        self.assertIn("--snapshots has gone", done.stderr)


if __name__ == "__main__":
    unittest.main()

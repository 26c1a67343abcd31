# SPDX-License-Identifier: BSD-3-Clause
"""rondo pod on real runs: the figures against numpy's own, the files, and wrong input."""
import shutil
import signal
import subprocess
import time
import unittest

import h5py
import numpy as np

from pod_reference import reference, spectrum, summary
from program import PROGRAM, SMALL, ProgramTest, replaced, run

TREADED = replaced(SMALL, "circumferential", "[disk.tread]\npitches = 12\ndepth = 0.02\n"
                   "land_columns = 2\ngroove_columns = 1\nlayers = 1")
# With a spin that changes, the angles half a step before are not those of the displacements, turned.
SPUN_UP = replaced(SMALL, "angular_velocity", "angular_velocity = [[0, 0], [0.02, 60]]")
STILL = "\n".join(line for line in replaced(replaced(SMALL, "angular_velocity",
                  "angular_velocity = 0.0"), "height", "height = 0.5").splitlines()
                  if not line.startswith(("friction", "profile", "[ground]")))


class PodTest(ProgramTest):
    def make(self, text=SMALL, name="out", *extra):
        out = self.folder / name
        done = run("run", self.case(text, name + ".toml"), "-o", out, "--quiet", *extra)
        self.assertEqual(done.returncode, 0, done.stderr)
        return out

    def pod(self, *arguments):
        done = run("pod", *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def fails(self, code, *arguments):
        done = run("pod", *arguments)
        self.assertEqual(done.returncode, code, done.stderr + done.stdout)
        self.assertEqual(done.stdout, "")
        return done.stderr

    def check_against_numpy(self, out, a, folder, tolerance=1e-12):
        u, s, vt = np.linalg.svd(a, full_matrices=False)
        got = spectrum(out / "pod" / folder)
        self.assertEqual(len(got["singular_value"]), len(s))
        # Both are right to some eps of the first value.
        np.testing.assert_allclose(got["singular_value"], s, rtol=0, atol=tolerance * s[0])
        np.testing.assert_allclose(got["energy"], s**2 / (s**2).sum(), rtol=0, atol=tolerance)
        tail = np.append(np.cumsum((s**2)[::-1])[::-1][1:], 0.0) / (s**2).sum()
        np.testing.assert_allclose(got["discarded_energy"], tail, rtol=0, atol=tolerance)
        np.testing.assert_array_equal(got["mode"], np.arange(1, len(s) + 1))
        return u, s, vt


class Pod(PodTest):
    def test_spectra_are_numpys(self):
        for text, name in (SPUN_UP, "smooth"), (TREADED, "treaded"):
            out = self.make(text, name)
            for field in "displacement", "velocity", "contact":
                for frame in "rotating", "rectified":  # the first is asked for as co-rotating
                    with self.subTest(body=name, field=field, frame=frame):
                        said = self.pod(out, "--field", field, "--frame",
                                        frame.replace("rotating", "co-rotating"))
                        self.assertNotIn("is now called", said.stderr)
                        self.check_against_numpy(out, reference(out, field, frame),
                                                 f"{field}-{frame}")

    def test_the_frame_was_called_rotating(self):
        out = self.make()
        self.pod(out, "--frame", "co-rotating")
        new = (out / "pod" / "displacement-rotating" / "spectrum.csv").read_bytes()
        for old in "rotating", "turning":
            said = self.pod(out, "--frame", old)
            self.assertIn(f"--frame {old} is now called --frame co-rotating", said.stderr)
            self.assertEqual(
                (out / "pod" / "displacement-rotating" / "spectrum.csv").read_bytes(), new)

    def test_files(self):
        out = self.make()
        done = self.pod(out, "--modes", 3)
        self.assertIn("modes kept         3", done.stdout)
        folder = out / "pod" / "displacement-rotating"
        self.assertEqual(sorted(p.name for p in folder.iterdir()),
                         ["modes.xdmf", "pod.h5", "pod.json", "reconstruction.xdmf", "spectrum.csv"])
        a = reference(out, "displacement")
        u, s, vt = np.linalg.svd(a, full_matrices=False)
        with h5py.File(folder / "pod.h5") as h5:
            for name in ("/modes/spatial", "/modes/temporal", "/modes/coefficients",
                         "/spectrum/singular_value"):
                self.assertTrue(h5[name].attrs["units"], name)
                self.assertTrue(h5[name].attrs["description"], name)
            phi = h5["/modes/spatial"][:].reshape(3, -1)
            v = h5["/modes/temporal"][:]
            mass = np.repeat(h5["/mesh/mass"][:], 2)
            np.testing.assert_allclose(phi * mass @ phi.T, np.eye(3), atol=1e-13)
            np.testing.assert_allclose(h5["/modes/coefficients"][:], v[:, :3] * s[:3],
                                       atol=1e-13 * s[0])
        for mode in range(3):
            ours = np.sqrt(mass) * phi[mode]
            self.assertAlmostEqual(abs(ours @ u[:, mode]), 1.0, delta=1e-9)  # eps over the gap
        j = summary(folder)
        self.assertEqual((j["status"], j["modes_kept"], j["snapshots"]), ("done", 3, 11))
        self.assertLess(j["error_identity"]["difference"], 1e-14)
        self.assertAlmostEqual(j["error_identity"]["tail"], (s[3:]**2).sum() / (s**2).sum(),
                               delta=1e-14)
        rest = np.linalg.norm(a - u[:, :3] @ (u[:, :3].T @ a), axis=0)
        size = np.linalg.norm(a, axis=0)
        worst = max(r / n for r, n in zip(rest, size) if n > 0)
        self.assertAlmostEqual(j["worst_snapshot"]["error"], worst, delta=1e-9)

    def test_weight_none_and_whole_pitches(self):
        out = self.make(TREADED)
        for field in "displacement", "contact":
            self.pod(out, "--field", field, "--weight", "none")
            self.check_against_numpy(out, reference(out, field, weight="none"), f"{field}-rotating")
            self.pod(out, "--field", field, "--frame", "rectified", "--shift", "pitch")
            self.check_against_numpy(out, reference(out, field, "pitch"), f"{field}-rectified")

    def test_modes_rebuild_the_fields(self):
        """All modes give every snapshot back, in the order of the mesh; the copies for ParaView too."""
        out = self.make(replaced(TREADED, "angular_velocity",
                                 "angular_velocity = [[0, 0], [0.02, 60]]"))
        for field in "velocity", "contact":
            self.pod(out, "--field", field, "--frame", "rectified", "--modes", 1000,
                     "--reconstruct", 4)
            values = reference(out, field, "rectified", weighted=False)
            scale = np.abs(values).max()
            with h5py.File(out / "pod" / f"{field}-rectified" / "pod.h5") as h5:
                modes, coefficients = h5["/modes/spatial"][:], h5["/modes/coefficients"][:]
                np.testing.assert_allclose(np.tensordot(coefficients, modes, axes=1), values,
                                           rtol=0, atol=1e-12 * scale)
                nodes = h5["/mesh/boundary"][:] if field == "contact" else np.arange(values.shape[1])
                for name in "original", "reconstructed":
                    shown = h5["/fields/" + name][:][:, nodes, :2]
                    np.testing.assert_allclose(shown, values[[0, 3, 6, 10]], rtol=0,
                                               atol=1e-6 * scale)  # single precision
                with h5py.File(out / "results.h5") as run:
                    end = "_velocity" if field == "velocity" else ""
                    for name in "time", "angle":
                        np.testing.assert_array_equal(h5["/snapshots/" + name][:],
                                                      run["/frame/" + name + end][:])

    def test_angles_of_the_rotating_frame_too(self):
        out = self.make()
        self.pod(out, "--field", "velocity")
        with h5py.File(out / "pod/velocity-rotating/pod.h5") as h5, \
                h5py.File(out / "results.h5") as run:
            np.testing.assert_array_equal(h5["/snapshots/angle"][:], run["/frame/angle_velocity"][:])

    def test_more_snapshots_than_numbers(self):
        """By blocks of snapshots; contact nodes that never touch make rows of zeros."""
        out = self.make(SMALL, "out", "--set", "output.snapshots=300", "--set",
                        "time.end=0.06", "--set", "output.stress=false")
        a = reference(out, "contact")
        self.assertLess(*a.shape)
        rank = np.linalg.matrix_rank(a)
        self.assertLess(rank, len(a))
        for option in (("--method", "tsqr"), ("--method", "tsqr", "--modes", "5"),
                       ("--memory", "450kB")):
            done = self.pod(out, "--field", "contact", *option)
            self.assertIn("tsqr", done.stdout)
            self.check_against_numpy(out, a, "contact-rotating")
            self.assertEqual(summary(out / "pod/contact-rotating")["rank"], rank)

    def test_what_was_cut_is_in_the_errors(self):
        """Of a basis that memory truncated: true errors by run, and none where modes are missing."""
        runs = [self.make(SMALL, f"mu{k}", "--set", f"ground.friction=0.{k}", "--set",
                          "output.snapshots=80", "--set", "output.stress=false") for k in (0, 6)]
        done = self.pod(*runs, "-o", self.folder / "c", "--field", "velocity", "--memory", "150kB")
        folder = self.folder / "c" / "velocity-rotating"
        j = summary(folder)
        self.assertEqual(j["method"], "incremental")
        self.assertNotIn("rank", j)
        self.assertEqual(j["rank_at_least"], j["modes_kept"])
        self.assertIsNone(j["modes_for"]["1e-06"])
        self.assertIn("at least", done.stdout)
        with h5py.File(folder / "pod.h5") as h5:
            mass = np.repeat(h5["/mesh/mass"][:], 2)
            phi = h5["/modes/spatial"][:].reshape(j["modes_kept"], -1) * np.sqrt(mass)
            np.testing.assert_array_equal(h5["/snapshots/run"][:], [0] * 80 + [1] * 80)
            error = h5["/snapshots/error"][:]
        worst = (0.0, None, None)
        for k, entry in enumerate(j["runs"]):
            a = reference(runs[k], "velocity")
            rest = np.linalg.norm(a - phi.T @ (phi @ a), axis=0)
            size = np.linalg.norm(a, axis=0)
            self.assertAlmostEqual(entry["error"], np.linalg.norm(rest) / np.linalg.norm(a),
                                   delta=1e-12)
            self.assertIsNone(entry["error_with_modes_for"]["1e-06"])
            relative = np.divide(rest, size, out=np.zeros_like(rest), where=size > 0)
            np.testing.assert_allclose(error[80 * k : 80 * k + 80], relative, atol=1e-12)
            with h5py.File(runs[k] / "results.h5") as h5:
                times = h5["/frame/time_velocity"][:]
            worst = max(worst, (relative.max(), times[relative.argmax()], str(runs[k])))
        self.assertEqual((j["worst_snapshot"]["time"], j["worst_snapshot"]["run"]), worst[1:])

    def test_window_and_counts(self):
        out = self.make()
        a = reference(out, "displacement")
        with h5py.File(out / "results.h5") as h5:
            t = h5["/frame/time"][:]
        self.pod(out, "--from", repr(float(t[4])), "--to", repr(float(t[8])))  # both included
        inside = np.arange(11) // 4 == 1
        inside[8] = True
        folder = out / "pod" / "displacement-rotating"
        s = np.linalg.svd(a[:, inside], compute_uv=False)
        np.testing.assert_allclose(spectrum(folder)["singular_value"], s, rtol=0, atol=1e-12 * s[0])
        tail = np.append(np.cumsum((s**2)[::-1])[::-1], 0.0) / (s**2).sum()
        self.assertEqual(list(summary(folder)["modes_for"]), ["1e-02", "1e-04", "1e-06"])
        for share, modes in summary(folder)["modes_for"].items():
            self.assertEqual(modes, int(np.argmax(tail <= float(share))))

    def test_streamed_is_the_same(self):
        out = self.make()
        a = reference(out, "velocity", "rectified")
        for method in "direct", "tsqr", "incremental":
            with self.subTest(method=method):
                self.pod(out, "--field", "velocity", "--frame", "rectified", "--method", method)
                self.assertEqual(summary(out / "pod/velocity-rectified")["method"], method)
                if method != "incremental":
                    self.check_against_numpy(out, a, "velocity-rectified")
                    continue
                # What is nothing against the rest (here a snapshot at rest) is cut off.
                s = np.linalg.svd(a, compute_uv=False)
                got = spectrum(out / "pod/velocity-rectified")["singular_value"]
                np.testing.assert_allclose(got, s[:len(got)], rtol=0, atol=1e-12 * s[0])
                self.assertLess(s[len(got):].max(), 1e-8 * s[0])

    def test_streams_by_itself_when_memory_is_short(self):
        out = self.make(SMALL, "out", "--set", "output.snapshots=30")  # 77 kB
        done = self.pod(out, "--memory", "100kB")
        self.assertIn("tsqr", done.stdout)
        self.check_against_numpy(out, reference(out, "displacement"), "displacement-rotating")
        # Too little even for that: truncated, within the bound that is told.
        done = self.pod(out, "--memory", "20kB")
        self.assertIn("incremental", done.stdout)
        self.assertIn("--memory", done.stderr)
        s = np.linalg.svd(reference(out, "displacement"), compute_uv=False)
        folder = out / "pod/displacement-rotating"
        got, bound = spectrum(folder)["singular_value"], summary(folder)["sigma_bound_relative"] * s[0]
        self.assertGreater(bound, 0.0)
        self.assertLess(len(got), len(s))
        error = s[:len(got)] - got
        self.assertGreater(error.min(), -1e-12 * s[0])
        self.assertLess(error.max(), bound)

    def test_several_runs_have_one_basis(self):
        runs = [self.make(SMALL, f"mu{k}", "--set", f"ground.friction=0.{k}") for k in (0, 3, 6)]
        target = self.folder / "common"
        done = self.pod(*runs, "-o", target, "--modes", 2)
        blocks = [reference(r, "displacement") for r in runs]
        a = np.hstack(blocks)
        u, s, _ = np.linalg.svd(a, full_matrices=False)
        folder = target / "displacement-rotating"
        np.testing.assert_allclose(spectrum(folder)["singular_value"], s, rtol=0, atol=1e-12 * s[0])
        entries = summary(folder)["runs"]
        self.assertEqual(len(entries), 3)
        whole = (a**2).sum()
        for entry, block in zip(entries, blocks):
            self.assertAlmostEqual(entry["energy_share"], (block**2).sum() / whole, delta=1e-12)
            rest = block - u[:, :2] @ (u[:, :2].T @ block)
            self.assertAlmostEqual(entry["error"], np.linalg.norm(rest) / np.linalg.norm(block),
                                   delta=1e-10)
            self.assertIn(entry["directory"], done.stdout)
        self.pod(*runs, "-o", target)
        j = summary(folder)
        for entry, block in zip(j["runs"], blocks):
            for share, modes in j["modes_for"].items():
                left = block - u[:, :modes] @ (u[:, :modes].T @ block)
                self.assertAlmostEqual(entry["error_with_modes_for"][share],
                                       np.linalg.norm(left) / np.linalg.norm(block), delta=1e-10)
        self.assertIn("-o", self.fails(2, *runs))

    def test_crush(self):
        """The load is no time: what is per second elsewhere is per load here, and not mixed."""
        crush = ("--set", "analysis.kind=crush", "--set", "analysis.depth=0.01", "--set",
                 "analysis.increments=8")
        pressed, rolling = self.make(SMALL, "pressed", *crush), self.make(SMALL, "rolling")
        done = self.pod(pressed, "--field", "velocity", "--from", 0.2)
        for line in done.stdout.splitlines():
            if line.startswith(("snapshots", "worst snapshot")):
                self.assertIn("of the load", line)
        folder = pressed / "pod" / "velocity-rotating"
        self.assertEqual((summary(folder)["unit"], summary(folder)["time_unit"]), ("m", "1"))
        with h5py.File(folder / "pod.h5") as h5:
            self.assertEqual(h5["/snapshots/time"].attrs["units"], "1")
            self.assertEqual(h5["/spectrum/singular_value"].attrs["units"], "m (kg/m)^(1/2)")
            np.testing.assert_allclose(h5["/snapshots/time"][:], (np.arange(2, 8) + 0.5) / 8)
        self.assertIn("crush", self.fails(2, pressed, rolling, "--field", "velocity", "-o",
                                          self.folder / "c"))
        self.pod(pressed, rolling, "-o", self.folder / "c")  # both are displacements

    def test_more_modes_than_rank(self):
        out = self.make()
        done = self.pod(out, "--modes", 1000)
        j = summary(out / "pod/displacement-rotating")
        self.assertEqual(j["modes_kept"], j["rank"])
        self.assertLess(j["rank"], 1000)
        self.assertIn(f"rank {j['rank']}", done.stderr)

    def test_all_zero_and_single_snapshots(self):
        out = self.make(STILL)
        done = self.pod(out)
        self.assertIn("zero", done.stderr)
        j = summary(out / "pod/displacement-rotating")
        self.assertEqual((j["rank"], j["modes_kept"], j["energy"]), (0, 0, 0.0))
        self.assertTrue((spectrum(out / "pod/displacement-rotating")["singular_value"] == 0).all())
        one = self.make(SMALL, "one", "--set", "output.snapshots=1")
        self.pod(one)
        self.assertEqual(summary(one / "pod/displacement-rotating")["rank"], 1)

    def test_unfinished_runs(self):
        """A killed run: what is there is used, and said."""
        out = self.folder / "killed"
        # Room for 1.7 GB is asked for, of which little is taken.
        text = replaced(replaced(SMALL, "end", "end = 500.0"), "snapshots", "snapshots = 100000")
        program = subprocess.Popen([PROGRAM, "run", str(self.case(text)), "-o", str(out), "--quiet",
                                    "--set", "output.stress=false"], stderr=subprocess.PIPE, text=True)
        try:
            for _ in range(600):
                time.sleep(0.1)
                if program.poll() is not None or (
                        (out / "history.csv").exists() and len((out / "history.csv").read_text()) > 5000):
                    break
        finally:
            program.send_signal(signal.SIGKILL)
            _, said = program.communicate()
        self.assertEqual(program.returncode, -signal.SIGKILL, said)
        done = self.pod(out)
        self.assertIn("not finished", done.stderr)
        self.assertIn("running", done.stderr)
        with h5py.File(out / "results.h5") as h5:
            written = int(np.isfinite(h5["/frame/time"][:]).sum())
        self.assertGreater(written, 0)
        self.assertEqual(summary(out / "pod/displacement-rotating")["snapshots"], written)

    def test_wrong_input(self):
        out = self.make()
        self.assertIn("displacement | velocity | contact", self.fails(2, out, "--field", "velocty"))
        self.assertIn("mass | none", self.fails(2, out, "--weight", "delassus"))
        said = self.fails(2, out, "--from", 5.0)
        self.assertIn("no snapshot", said)
        self.assertIn("0.02", said)  # where they are
        self.fails(2, out, "--modes", 0)
        self.fails(2, self.folder / "nowhere")
        self.fails(2, self.folder)  # a directory without a run
        self.fails(2)
        for option, value in (("--shift", "banana"), ("--memory", "-5"), ("--memory", "much"),
                              ("--reconstruct", -1), ("--from", "nan"), ("--method", "svd")):
            self.assertIn(option, self.fails(2, out, option, value))
        self.assertIn("twice", self.fails(2, out, out, "-o", self.folder / "c"))
        self.assertIn("--shift", self.pod(out, "--shift", "pitch").stderr)  # no effect: said
        (self.folder / "file").write_text("")
        self.assertIn("-o", self.fails(4, out, "-o", self.folder / "file"))
        still = self.make(STILL, "still")
        self.assertIn("[ground]", self.fails(2, still, "--field", "contact"))
        empty = self.make(SMALL, "empty", "--set", "output.snapshots=0")
        self.assertIn("no complete snapshot", self.fails(2, empty))

    def test_different_meshes(self):
        fine = self.make(SMALL, "fine", "--set", "disk.mesh.circumferential=44")
        coarse = self.make(SMALL, "coarse")
        said = self.fails(2, coarse, fine, "-o", self.folder / "common")
        self.assertIn("176", said)
        heavy = self.make(SMALL, "heavy", "--set", "material.density=1200")
        self.assertIn("mass", self.fails(2, coarse, heavy, "-o", self.folder / "common"))

    def test_damaged_files(self):
        out = self.make()
        whole = (out / "results.h5").read_bytes()
        for name, content in (("text", b"not HDF5"), ("half", whole[:len(whole) // 2])):
            damaged = self.folder / name
            shutil.copytree(out, damaged)
            (damaged / "results.h5").write_bytes(content)
            self.assertIn("results.h5", self.fails(4, damaged))
        no_sectors = self.folder / "plain"
        shutil.copytree(out, no_sectors)
        with h5py.File(no_sectors / "results.h5", "r+") as h5:
            del h5["/mesh/sector"], h5["/mesh/sector_node"]
        self.assertIn("sectors", self.fails(2, no_sectors, "--frame", "rectified"))
        self.pod(no_sectors)
        for value in np.nan, 1e160:
            with h5py.File(no_sectors / "results.h5", "r+") as h5:
                h5["/snapshots/displacement"][3, 5, 0] = value
            self.assertIn("not finite", self.fails(2, no_sectors))
        with h5py.File(out / "results.h5", "r+") as h5:
            h5["/mesh/boundary"][0] = h5["/mesh/boundary"][1]
            del h5["/frame/angle_velocity"]
        self.fails(2, out, "--field", "contact", "--frame", "rectified")
        said = self.fails(2, out, "--field", "velocity", "--frame", "rectified")
        self.assertIn("run the case again", said)
        self.pod(out, "--field", "velocity")


class Ended(PodTest):
    """What is not yet whole does not outlive the program."""

    def end(self, out, number):
        """While files are written; how it ended, and what it left: none where it had ended before."""
        program = subprocess.Popen([PROGRAM, "pod", str(out), "--reconstruct", "2000", "--quiet"],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        written = out / "pod" / "displacement-rotating"
        while program.poll() is None and not any(written.glob(".pod.*.tmp/pod.h5")):
            time.sleep(0.0005)
        program.send_signal(number)
        code = program.wait()
        return (code, sorted(p.name for p in written.glob(".*"))) if code != 0 else None

    def test_by_signals_and_killed(self):
        text = replaced(SMALL, "snapshots", "snapshots = 2001")
        out = self.make(text)
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            ended = [self.end(out, number) for _ in range(4)]
            self.assertIn((130, []), ended)
            self.assertLessEqual(set(filter(None, ((e or (130, []))[0] for e in ended))), {130})
            self.assertTrue(all(e is None or e[1] == [] for e in ended), ended)
        code, left = self.end(out, signal.SIGKILL)
        self.assertEqual((code, len(left)), (-signal.SIGKILL, 1), left)
        written = out / "pod" / "displacement-rotating"
        other = written / ".pod.another-machine.1.tmp"
        other.mkdir()
        self.pod(out)
        self.assertEqual([p.name for p in written.glob(".*")], [other.name])


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""rondo reduce --validate from outside: its figures against those computed here from the two
results directories, wrong input."""
import csv
import json
import pathlib
import signal
import subprocess
import tempfile
import time
import unittest

import h5py
import numpy as np

from program import PROGRAM, ProgramTest, SMALL, history, replaced, run, summary

TEXT = SMALL
for key, line in (("radial", "radial = 8"), ("circumferential", "circumferential = 120"),
                  ("end", "end = 0.04"), ("snapshots", "snapshots = 161")):
    TEXT = replaced(TEXT, key, line)


def rectified(directory, field):
    """(times (t,), fields (t, n) x + iy in the fixed frame, masses (n,), order of the nodes)."""
    with h5py.File(directory / "results.h5") as f:
        sector, within = f["mesh/sector"][:], f["mesh/sector_node"][:]
        order, n = np.lexsort((sector, within)), sector.max() + 1
        end = "" if field == "displacement" else "_velocity"
        time, angle = f["frame/time" + end][:], f["frame/angle" + end][:]
        values = f["snapshots/" + field][:][:, order] @ np.array([1, 1j])
        mass = f["mesh/mass"][:][order]
    polar = np.exp(2j * np.pi * np.arange(n) / n)  # radial and tangential parts are what moves
    k = np.fft.fftfreq(n, 1 / n)
    turned = np.exp(-1j * k * angle[:, None])
    turned[:, abs(k) == n / 2] = 1  # the highest stays where it is (docs/theory.md, 7.3)
    rings = np.fft.fft(values.reshape(len(time), -1, n) / polar, axis=2) * turned[:, None]
    moved = (np.fft.ifft(rings, axis=2) * polar).reshape(len(time), -1)
    return time, moved, mass, order


def field_errors(model, full, reduced, field, window):
    """(left by the modes, error, error of the means, snapshots compared)."""
    time, values, mass, order = rectified(full, field)
    known, theirs, _, _ = rectified(reduced, field)
    inside = (time >= window[0]) & (time <= window[1])
    with h5py.File(model) as f:
        basis = f["model/basis"][:][:, order] @ np.array([1, 1j])

    def norm(fields):
        return np.sqrt(np.sum(mass * abs(fields) ** 2))

    kept = (values[inside] * mass @ basis.conj().T).real  # (t, r)
    left = norm(values[inside] - kept @ basis) / norm(values[inside])
    both = inside & (time >= known[0]) & (time <= known[-1])
    a = values[both]
    b = np.stack([np.interp(time[both], known, part) for part in theirs.real.T], axis=1) + 1j * \
        np.stack([np.interp(time[both], known, part) for part in theirs.imag.T], axis=1)
    means = norm(b.mean(axis=0) - a.mean(axis=0)) / norm(a.mean(axis=0))
    return left, norm(b - a) / norm(a), means, len(a)


def profile(directory, window):
    """(angles (m,), pressure, shear): each force shared by the two places next to its node."""
    with h5py.File(directory / "results.h5") as f:
        x = f["mesh/coordinates"][:][f["mesh/boundary"][:]]
        length = f["mesh/tributary"][:].sum()
        time, theta = f["frame/time"][:], f["frame/angle"][:]
        inside = (time >= window[0]) & (time <= window[1])
        force, theta = f["contact/force"][:][inside], theta[inside]
    n = len(x)
    pitch = 2 * np.pi / n
    place = (np.arange(n) - n // 2) * pitch
    stands = np.arctan2(x[:, 0], -x[:, 1]) + theta[:, None]  # (t, nb)
    away = stands[:, :, None] - place
    away = (away + np.pi) % (2 * np.pi) - np.pi
    share = np.maximum(0, 1 - abs(away) / pitch)
    mean = np.einsum("tip,tix->px", share, force) / len(theta) / (length / n)
    return place, mean[:, 0], mean[:, 1]


def means(directory, window):
    """Of the history: means and fluctuations of the forces, power of friction."""
    h = history(directory)
    begin = np.concatenate([[0], h["time_s"][:-1]])
    rows = np.flatnonzero((begin >= window[0]) & (h["time_s"] <= window[1] * (1 + 1e-12)))
    span = (h["time_s"] - begin)[rows]
    found = {}
    for name in ("force_x", "force_y"):
        found[name] = np.average(h[name][rows], weights=span)
        found[name + "_fluctuation"] = np.sqrt(
            np.average((h[name][rows] - found[name]) ** 2, weights=span))
    lost = h["dissipation_friction"]
    found["friction_power"] = (lost[rows[-1]] - lost[rows[0] - 1]) / span.sum()
    return found


def table(folder):
    with open(folder / "validation.csv", newline="") as file:
        return {row["run"]: {name: float(text) for name, text in row.items() if name != "run"}
                for row in csv.DictReader(file)}


class Validate(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.shared = pathlib.Path(folder.name)
        cls.case_file = cls.shared / "case.toml"
        cls.case_file.write_text(TEXT)
        for friction in ("0.2", "0.3", "0.4"):
            cls.full_run(cls.shared / friction, f"ground.friction={friction}")
        cls.model = cls.shared / "model.h5"
        cls.made("reduce", cls.shared / "0.2", cls.shared / "0.4", "-o", cls.model)

    @classmethod
    def made(cls, *arguments):
        done = run(*arguments)
        assert done.returncode == 0, done.stderr
        return done

    @classmethod
    def full_run(cls, directory, *settings):
        cls.made("run", cls.case_file, "-o", directory,
                 *(x for s in settings for x in ("--set", s)))
        return directory

    def validated(self, *arguments, code=0):
        """Of the model, copied to a folder of its own."""
        model = self.folder / "model.h5"
        model.write_bytes(self.model.read_bytes())
        done = run("reduce", "-o", model, *(x for a in arguments for x in
                                            (["--validate", a] if isinstance(a, pathlib.Path)
                                             else [a])))
        self.assertEqual(done.returncode, code, done.stderr)
        if code:
            self.assertEqual(done.stdout, "")
            self.assertFalse((self.folder / "model-validation" / "validation.json").exists())
        return self.folder / "model-validation", done

    def test_figures_are_those_of_the_two_runs(self):
        full = self.shared / "0.3"
        for options in ([], ["--validate-from", "0.012", "--validate-to", "0.026"]):
            out, done = self.validated(full, "--step-factor", 2, *options)
            reduced, row = out / "0.3", table(out)["0.3"]
            end = 0.026 if options else h5py.File(full / "results.h5")["frame/time"][-1]
            window = (0.012 if options else 0.75 * end, end)
            self.assertEqual((row["from_s"], row["to_s"]), window)
            expected = {}
            for field in ("displacement", "velocity"):
                left, error, mean_error, count = field_errors(self.model, full, reduced, field,
                                                              window)
                expected |= {f"{field}_left": left, f"{field}_error": error,
                             f"{field}_mean_error": mean_error}
                self.assertGreaterEqual(count, row["snapshots"])
            place, *theirs = profile(full, window)
            _, *ours = profile(reduced, window)
            size = np.linalg.norm(theirs[0])
            expected |= {f"{name}_error": np.linalg.norm(b - a) / size
                         for name, a, b in zip(("pressure", "shear"), theirs, ours)}
            sides = {"full": means(full, window), "reduced": means(reduced, window)}
            units = {"friction_power": "w_m"}
            for side, found in sides.items():
                expected |= {f"{name}_{side}_{units.get(name, 'n_m')}": value
                             for name, value in found.items()}
            load = sides["full"]["force_y"]
            expected |= {f"{name}_error": (sides["reduced"][name] - sides["full"][name]) / load
                         for name in ("force_x", "force_y")}
            a, b = (sides[side]["friction_power"] for side in ("full", "reduced"))
            expected["friction_error"] = (b - a) / a
            for name, value in expected.items():
                # Sums of some 10^5 terms in another order; the modes leave small differences of
                # large numbers: 1e-3 of a field, whose square is 1e-6 of a square known to 1e-16.
                self.assertAlmostEqual(row[name] / value, 1.0, delta=1e-8, msg=f"{name}: {row[name]} {value}")
            with open(reduced / "profiles.csv", newline="") as file:
                rows = np.array(list(csv.reader(file))[1:], dtype=float).T
            for found, wanted in zip(rows, (place, theirs[0], ours[0], theirs[1], ours[1])):
                np.testing.assert_allclose(found, wanted, atol=1e-10 * abs(wanted).max())
            # All of the force is in the profile.
            with h5py.File(full / "results.h5") as f:
                t = f["frame/time"][:]
                inside = (t >= window[0]) & (t <= window[1])
                force = f["contact/force"][:][inside, :, 0].sum(axis=1).mean()
                pitch = f["mesh/tributary"][:].sum() / len(place)
            self.assertAlmostEqual(rows[1].sum() * pitch / force, 1.0, delta=1e-10)
            j, k = summary(full), summary(reduced)
            self.assertEqual(k["step_factor"], 2)
            for name, key in (("steps", "steps_done"), ("threads", "threads")):
                self.assertEqual((row[name + "_full"], row[name + "_reduced"]), (j[key], k[key]))
            self.assertEqual(row["speed_up"], j["loop_wall_s"] / k["loop_wall_s"])
            self.assertEqual(row["same_host"], 1)
            self.assertIn(f"{100 * row['velocity_error']:.2f} %", done.stdout)
            record = json.loads((out / "validation.json").read_text())
            self.assertEqual(record["format"], "rondo validation 1")
            self.assertEqual(set(record["units"]), set(row))
            self.assertEqual([r["name"] for r in record["runs"]], ["0.3"])

    def test_predicts(self):
        out, done = self.validated(self.shared / "0.3", "--step-factor", 2)
        self.assertNotIn("warning", done.stderr)
        self.assertLess(abs(table(out)["0.3"]["force_y_error"]), 0.02)  # few columns in contact

    def test_a_run_behind_the_model(self):
        out, done = self.validated(self.shared / "0.2", self.shared / "0.3", "--step-factor", 2)
        self.assertIn("is one of the runs that the model was built from", done.stderr)
        self.assertEqual(done.stderr.count("built from: what it shows"), 1)
        rows = table(out)
        self.assertEqual(list(rows), ["0.2", "0.3"])
        self.assertLess(rows["0.2"]["displacement_left"], 2e-3)
        self.assertLess(rows["0.2"]["displacement_left"], rows["0.3"]["displacement_left"])
        # The modes hold the run; 2.7 and 1.0 % are what contact points, which stand still where
        # nodes pass, make of the contact of twelve columns.
        self.assertLess(rows["0.2"]["displacement_error"], 0.05)
        self.assertLess(abs(rows["0.2"]["force_y_error"]), 0.02)

    def test_built_and_validated_at_once(self):
        twin = self.folder / "twin" / "0.3"
        self.full_run(twin, "ground.friction=0.25")
        model = self.folder / "new.h5"
        command = ["reduce", self.shared / "0.2", self.shared / "0.4", "-o", model, "--validate",
                   self.shared / "0.3", "--validate", twin]
        for _ in range(2):  # the second replaces what the first made
            done = self.made(*command)
            self.assertIn("modes", done.stdout)
            rows = table(self.folder / "new-validation")
            self.assertEqual(list(rows), ["0.3", "0.3-2"])
            self.assertNotEqual(rows["0.3"]["force_x_full_n_m"], rows["0.3-2"]["force_x_full_n_m"])

    def test_without_ground(self):
        text = TEXT[:TEXT.index("[ground]")] + TEXT[TEXT.index("[time]"):]
        case = self.case(text)
        for name, spin in (("a", 30), ("b", 32)):
            self.made("run", case, "-o", self.folder / name, "--set",
                      f"motion.angular_velocity={spin}")
        done = self.made("reduce", self.folder / "a", "-o", self.folder / "air.h5", "--validate",
                         self.folder / "b")
        row = table(self.folder / "air-validation")["b"]
        for name in ("pressure_error", "shear_error", "force_y_error", "friction_error"):
            self.assertTrue(np.isnan(row[name]), name)
        self.assertGreater(row["displacement_error"], 0)
        self.assertFalse((self.folder / "air-validation" / "b" / "profiles.csv").exists())
        self.assertIn("-", done.stdout)

    def test_refuses(self):
        held = self.shared / "0.3"
        model = self.folder / "none.h5"

        def fails(said, *runs, options=()):
            """Validating a model that is there, and before one is built."""
            _, done = self.validated(*runs, *options, code=2)
            self.assertIn(said, done.stderr)
            done = run("reduce", self.shared / "0.2", "-o", model, *options,
                       *(x for r in runs for x in ("--validate", r)))
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(said, done.stderr)
            self.assertFalse(model.exists())

        fails("radial = 3", self.full_run(self.folder / "mesh", "disk.mesh.radial=3"))
        fails("density", self.full_run(self.folder / "soft", "material.density=1000"))
        fails("0 snapshots", self.full_run(self.folder / "blind", "output.snapshots=0"))
        fails("a crush does not roll",
              self.full_run(self.folder / "crush", "analysis.kind=crush", "analysis.depth=0.004",
                            "analysis.increments=4"))
        cut = self.full_run(self.folder / "cut")
        record = summary(cut)
        (cut / "run.json").write_text(json.dumps({**record, "status": "interrupted"}))
        fails("not finished (status interrupted)", cut)
        self.made("run", self.case_file, "--reduced", self.model, "-o", self.folder / "reduced")
        fails("is a reduced run itself", self.folder / "reduced")
        fails("named twice", held, held)
        fails("nowhere", self.folder / "nowhere")
        fails("no snapshot", held, options=["--validate-from", "1"])
        _, done = self.validated(held, "--step-factor", "400", code=2)
        self.assertIn("history.csv lies in this window", done.stderr)
        fails("not a factor", held, options=["--step-factor", "0"])
        done = run("reduce", "-o", model)
        self.assertEqual(done.returncode, 2)
        self.assertIn("--validate RUN alone", done.stderr)
        self.assertEqual(run("reduce", held, "-o", model, "--step-factor", 3).returncode, 2)
        done = run("reduce", "-o", model, "--validate", held)
        self.assertEqual(done.returncode, 2)
        self.assertIn("no such file", done.stderr)

    def test_interrupt(self):
        out, _ = self.validated(self.shared / "0.3")
        said = [PROGRAM, "reduce", "-o", self.folder / "model.h5", "--validate",
                self.shared / "0.3", "--validate", self.shared / "0.2", "--step-factor", "0.001"]
        rows = out / "0.3" / "history.csv"
        rows.unlink()
        process = subprocess.Popen(said, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        until = time.monotonic() + 60
        while time.monotonic() < until and not rows.exists():
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        table_said, warned = process.communicate(timeout=60)
        self.assertEqual((process.returncode, table_said), (130, ""), warned)
        self.assertIn("without RUN validates it", warned)
        self.assertEqual(summary(out / "0.3")["status"], "interrupted")
        self.assertFalse((out / "0.2").exists())
        for name in ("validation.json", "validation.csv"):  # of the validation before
            self.assertFalse((out / name).exists())

    def test_replaces_predictions_only(self):
        there = self.folder / "model-validation" / "0.3"
        self.full_run(there)
        before = (there / "history.csv").read_bytes()
        _, done = self.validated(self.shared / "0.3", code=2)
        self.assertIn("holds something else than a reduced run", done.stderr)
        self.assertEqual((there / "history.csv").read_bytes(), before)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""output.friction_work: what friction takes by contact node and place, and the powers of contact.csv."""
import filecmp
import unittest

import h5py
import numpy as np
from program import SMALL, ProgramTest, contact, history, replaced, run, settings

ON = ("output.friction_work=true",)
EVERY_STEP = ("output.history_interval=0",)
SHARP = ('ground.profile=[[-9, 0], [0.05, 0], [0.05, 0.005], [9, 0.005]]',)
WIDE = ("disk.width=0.1", "motion.slip_angle=0.05", "motion.camber=0.05")
BOUNCY = ("ground.restitution=0.5",)
GLUED = replaced(SMALL, "inner_radius", "inner_radius = 0.15\n[solver]\ncontact_mass = \"singular\"")


class FrictionWork(ProgramTest):
    def ran(self, name, *of, text=SMALL, threads=1):
        out = self.folder / name
        case = self.folder / f"{name}.toml"
        case.write_text(text)
        done = run("run", case, "-o", out, "--quiet", "--threads", threads, *settings(*of))
        self.assertEqual(done.returncode, 0, done.stderr)
        return out

    def work(self, out):
        """Of each snapshot: time, sums over nodes and over places [J/m], [J]."""
        with h5py.File(out / "results.h5") as file:
            nodes = file["contact/friction_work"][:]
            places = file["contact/friction_places"][:]
            size = np.full(places.shape[1:], np.diff(file["contact/friction_along"][:2])[0])
            if "friction_across" in file["contact"]:
                size *= np.diff(file["contact/friction_across"][:2])[0]
                size[:, [0, -1]] *= 0.5
            in_all = (places * size).reshape(len(places), -1).sum(axis=1)
            return file["frame/time"][:], nodes @ file["mesh/tributary"][:], in_all

    def test_sums_are_those_of_the_energy_balance(self):
        """A row has the works of the steps before its own."""
        for name, text, of in (("smooth", SMALL, ()), ("sharp", SMALL, SHARP), ("wide", SMALL, WIDE),
                               ("wide-sharp", SMALL, WIDE + SHARP), ("bouncy", SMALL, BOUNCY),
                               ("massless", GLUED, ())):
            with self.subTest(name):
                out = self.ran(name, *ON, *EVERY_STEP, *of, text=text)
                time, nodes, places = self.work(out)
                rows = history(out)
                friction = rows["dissipation_friction"]
                for t, node, place in zip(time[1:-1], nodes[1:-1], places[1:-1]):
                    after = friction[np.argmin(np.abs(rows["time_s"] - t)) + 1]
                    scale = 1e-12 * np.abs(friction).max()
                    self.assertAlmostEqual(node, after, delta=scale)
                    self.assertAlmostEqual(place, after, delta=scale)
                self.assertGreater(nodes[-1], 0.0)
                self.assertEqual(nodes[0], 0.0)

    def test_any_threads_give_the_same_bits(self):
        for name, of in (("plane", SHARP), ("wide", WIDE)):
            one, two = (self.ran(f"{name}-{n}", *ON, *of, threads=n) for n in (1, 2))
            with h5py.File(one / "results.h5") as a, h5py.File(two / "results.h5") as b:
                for what in ("friction_work", "friction_places"):
                    self.assertTrue((a[f"contact/{what}"][:] == b[f"contact/{what}"][:]).all())

    def test_a_run_that_is_prolonged_has_the_bits_of_a_long_one(self):
        long = self.ran("long", *ON)
        out = self.ran("short", *ON, "time.end=0.01")
        done = run("run", out, "--resume", "--quiet", *settings("time.end=0.02"))
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(long / "results.h5") as a, h5py.File(out / "results.h5") as b:
            self.assertEqual(a["frame/time"][-1], b["frame/time"][-1])
            for what in ("friction_work", "friction_places"):
                self.assertTrue((a[f"contact/{what}"][-1] == b[f"contact/{what}"][-1]).all(), what)
            self.assertGreater(np.abs(a["contact/friction_work"][-1]).max(), 0.0)

    def test_it_changes_nothing_else(self):
        on, off = self.ran("on", *ON), self.ran("off")
        for name in ("history.csv", "contact.csv"):
            self.assertTrue(filecmp.cmp(on / name, off / name, shallow=False), name)
        with h5py.File(off / "results.h5") as file:
            self.assertEqual(set(file["contact"]), {"force", "traction"})

    def test_the_case_that_a_run_wrote_is_one(self):
        out = self.ran("first", *ON, "time.end=0.001")
        self.assertIn("friction_work = true", (out / "case.toml").read_text())
        done = run("check", out / "case.toml")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_powers_of_a_snapshot_are_those_of_its_step(self):
        """The energy of the last step before a snapshot."""
        out = self.ran("powers", *ON, *EVERY_STEP)
        rows, row = history(out), contact(out)
        friction, step = rows["dissipation_friction"], np.diff(rows["time_s"][:2])[0]
        for t in np.unique(row["time_s"])[:-1]:
            k = int(np.argmin(np.abs(rows["time_s"] - t)))
            at = row["time_s"] == t
            power = (row["friction_power"] * row["length_m"])[at].sum()
            energy = friction[k + 1] - friction[k]
            self.assertAlmostEqual(power * step, energy, delta=1e-9 * np.abs(friction).max())

    def test_powers_of_steady_rolling_are_shear_times_slip(self):
        rolls = ("analysis.kind=steady-rolling", "motion.height=0.29", "analysis.accept_scheme_power=true")
        row = contact(self.ran("steady", *rolls))
        expected = -row["shear_pa"] * -row["slip_speed"]  # shear is along J n, to the left
        np.testing.assert_allclose(row["friction_power"], expected, atol=1e-9 * np.abs(expected).max())
        self.assertGreater(row["friction_power"].max(), 0.0)

    def refused(self, *of, text=SMALL, more=()):
        case = self.folder / "refused.toml"
        case.write_text(text)
        done = run("run", case, "-o", self.folder / "out", *settings(*ON, *of), *more)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("output.friction_work", done.stderr)
        return done.stderr

    def test_what_cannot_have_it_is_refused(self):
        parts = ("time.scheme=hati", "solver.hati.ratio=2", "solver.hati.fine.layers=[2, 3]",
                 "motion.height=0.296")
        self.assertIn("repeats its fine steps", self.refused(*parts))
        self.assertIn("output.snapshots = 2", self.refused("output.snapshots=0"))
        air = "\n".join(line for line in SMALL.splitlines()
                        if not line.startswith(("[ground]", "profile", "friction")))
        self.assertIn("nothing can be touched", self.refused(text=air))

    def test_a_reduced_run_is_refused(self):
        case = self.folder / "case.toml"
        case.write_text(SMALL)
        done = run("run", case, "-o", self.folder / "out", "--reduced", *settings(*ON))
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("no slip of their own", done.stderr)


if __name__ == "__main__":
    unittest.main()

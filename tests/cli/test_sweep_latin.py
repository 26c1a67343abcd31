# SPDX-License-Identifier: BSD-3-Clause
"""rondo sweep of crushes by LATIN-PGD: modes go from the first member of a body to the others."""
import json
import signal
import subprocess
import time
import unittest

import h5py
import numpy as np

from program import PROGRAM, ROOT, run, summary
from sweep_program import CRUSH, SweepTest, column, mpirun, table

BASE = "schema = 1\nbase = \"case.toml\"\nset = [\"analysis.solver=latin-pgd\"]\n"
FRICTION = "[[vary]]\nkey = \"ground.friction\"\nvalues = [0.3, 0.1, 0.5, 0.7]\n"
BODIES = "[[vary]]\nkey = \"disk.mesh.radial\"\nvalues = [4, 3]\n"
STUDY = BASE + BODIES + FRICTION
SOLVER = "[[vary]]\nkey = \"analysis.solver\"\nvalues = [\"direct\", \"latin\", \"latin-pgd\"]\n"
PGD = "pod/displacement-pgd"


class LatinSweep(SweepTest):
    def setUp(self):
        super().setUp()
        self.case(CRUSH)

    def member(self, number):
        return self.out / "runs" / f"{number:04d}"

    def began_with(self):
        """What each member says that it begins with; None: nothing."""
        return [summary(path.parent).get("modes_from")
                for path in sorted(self.out.glob("runs/*/run.json"))]

    def alone(self, name, *extra):
        out = self.folder / name
        done = run("run", self.folder / "case.toml", "-o", out, "--quiet", "--set",
                   "analysis.solver=latin-pgd", *extra)
        self.assertEqual(done.returncode, 0, done.stderr)
        return out


class HandsOn(LatinSweep):
    def test_first_of_each_body_to_all_others(self):
        self.sweep(text=STUDY)
        self.assertEqual(self.began_with(), [None] + 3 * ["../0001"] + [None] + 3 * ["../0005"])
        solves = column(self.out, "solves")
        for radial, friction, row in ((4, 0.1, 1), (4, 0.5, 2), (4, 0.7, 3), (3, 0.1, 5), (3, 0.7, 7)):
            settings = ("--set", f"disk.mesh.radial={radial}", "--set", f"ground.friction={friction}")
            fresh = self.alone("fresh", *settings, "--overwrite")
            self.assertGreaterEqual(summary(fresh)["solves"], 5 * solves[row], (radial, friction))
            self.assertGreater(summary(fresh)["solves"], 20)
            again = self.alone("again", *settings, "--overwrite", "--modes-from",
                               self.member(1 if radial == 4 else 5))
            self.assertEqual((again / "history.csv").read_bytes(),
                             (self.member(row + 1) / "history.csv").read_bytes())
        first = self.alone("first", "--set", "ground.friction=0.3")
        self.assertEqual((first / "history.csv").read_bytes(),
                         (self.member(1) / "history.csv").read_bytes())
        self.assertEqual(summary(first)["solves"], solves[0])

    def test_depths_too(self):
        self.sweep(text=BASE + "[[vary]]\nkey = \"analysis.depth\"\nvalues = ["
                   + ", ".join(f"[[0, 0], [8, {d}], [16, {d}]]" for d in (0.016, 0.02, 0.012)) + "]\n")
        self.assertEqual(self.began_with(), [None, "../0001", "../0001"])
        solves = column(self.out, "solves")
        self.assertTrue((solves[1:] * 5 < solves[0]).all(), solves)

    def test_what_the_table_says(self):
        self.sweep(text=STUDY)
        for name in ("iterations", "residual", "modes", "solves"):
            said = [summary(self.member(k + 1))[name] for k in range(8)]
            np.testing.assert_array_equal(column(self.out, name), said)
            with h5py.File(self.out / "sweep.h5") as f:
                np.testing.assert_array_equal(f["figures"][name][:], said)
        self.assertLess(column(self.out, "residual").max(), 1e-3)

    def test_solvers_side_by_side(self):
        """Each has the columns of all; those that it knows nothing of are empty."""
        self.sweep(text=BASE.replace("set", "# ") + SOLVER + FRICTION)
        self.assertEqual(self.began_with(), 9 * [None] + 3 * ["../0009"])
        for name, known in (("iterations", [0, 1, 1]), ("residual", [0, 1, 1]), ("modes", [0, 0, 1]),
                            ("solves", [0, 0, 1]), ("force_y", [1, 1, 1])):
            np.testing.assert_array_equal(np.isfinite(column(self.out, name)), np.repeat(known, 4), name)
        force = column(self.out, "force_y").reshape(3, 4)
        np.testing.assert_allclose(force[1:], force[[0, 0]], rtol=3e-3)

    def test_columns_are_those_of_the_solver(self):
        for solver, new in (("direct", []), ("latin", ["iterations", "residual"])):
            self.sweep("--overwrite", text=BASE.replace("latin-pgd", solver) + FRICTION)
            columns = list(table(self.out)[0])
            self.assertEqual(columns[columns.index("jacobian_min") + 1:], new)
            self.assertEqual(self.began_with(), 4 * [None])

    def test_the_study_of_the_manual(self):
        done = run("sweep", ROOT / "cases" / "studies" / "crush-friction.toml", "-o", self.out)
        self.assertEqual(done.returncode, 0, done.stderr)
        solves = column(self.out, "solves")
        self.assertEqual((solves[0], solves[1:].max()), (70, 0))
        friction, share = column(self.out, "ground.friction"), -column(self.out, "force_x")
        share /= column(self.out, "force_y")
        np.testing.assert_allclose(share[:4], friction[:4], rtol=0.012)  # slides, all of it
        self.assertTrue((np.diff(share) > 0).all() and share[-1] < 0.46)


class SameBits(LatinSweep):
    """Whoever made the members, in what order, after how many kills."""

    def expect(self, text=STUDY):
        other = self.folder / "expected"
        done = run("sweep", self.study(text), "-o", other, "--jobs", "1", "--quiet")
        self.assertIn(done.returncode, (0, 3), done.stderr)
        return (other / "results.csv").read_bytes()

    def same(self, expected):
        self.assertEqual((self.out / "results.csv").read_bytes(), expected)

    def test_of_one_worker_and_several(self):
        expected = self.expect()
        for extra in (("--jobs", "2"), ("--jobs", "5", "--overwrite")):
            self.sweep(*extra, text=STUDY)
            self.same(expected)

    def test_of_ranks(self):
        expected = self.expect()
        done = mpirun(3, self.study(STUDY), "-o", self.out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.same(expected)

    def test_killed_and_resumed(self):
        """While the first members are made, and while the others are."""
        self.case(CRUSH.replace("radial = 4", "radial = 12").replace("= 90", "= 270"))
        text = BASE + "[[vary]]\nkey = \"disk.mesh.radial\"\nvalues = [12, 13]\n" + FRICTION
        expected = self.expect(text)
        for runs in (1, 4):
            self.out = self.folder / f"out{runs}"
            process = subprocess.Popen([PROGRAM, "sweep", str(self.study(text)), "-o", str(self.out),
                                        "--quiet"], stderr=subprocess.DEVNULL)
            self.wait_for(runs, process)
            process.kill()
            process.wait()
            self.assertEqual(json.loads((self.out / "sweep.json").read_text())["status"], "running")
            self.sweep("--resume", text=text)
            self.same(expected)

    def test_interrupted(self):
        """Before the first has ended no other begins."""
        self.case(CRUSH.replace("radial = 4", "radial = 12").replace("= 90", "= 540"))
        text = BASE.replace("]\n", ", \"analysis.tolerance=1e-7\"]\n") + FRICTION
        process = subprocess.Popen([PROGRAM, "sweep", str(self.study(text)), "-o", str(self.out),
                                    "--quiet"], stderr=subprocess.DEVNULL)
        self.wait_for(1, process)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=60), 130)
        self.assertEqual([path.name for path in self.out.glob("runs/*")], ["0001"])
        self.assertEqual([row["status"] for row in table(self.out)], ["interrupted"] + 3 * ["waiting"])

    def wait_for(self, runs, process):
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline and process.poll() is None:
            if len(list(self.out.glob("runs/*/run.json"))) >= runs:
                return
            time.sleep(0.001)
        self.fail("the runs did not start")

    def test_what_is_not_as_it_would_be_made_is_made_again(self):
        """Modes that are gone, a member that began with others."""
        self.sweep(text=STUDY)
        expected = (self.out / "results.csv").read_bytes()
        (self.member(1) / PGD / "basis.h5").unlink()
        for number, change in ((3, lambda j: j.pop("modes_from")),
                               (5, lambda j: j.update(modes_from="../0001"))):
            j = summary(self.member(number))
            change(j)
            (self.member(number) / "run.json").write_text(json.dumps(j))
        done = self.sweep("--resume", text=STUDY)
        self.assertIn("5 were there already", done.stderr)
        self.same(expected)
        self.assertEqual(self.began_with(), [None] + 3 * ["../0001"] + [None] + 3 * ["../0005"])
        self.assertTrue((self.member(1) / PGD / "basis.h5").exists())

    def test_where_the_first_fails_all_begin_from_nothing(self):
        text = (BASE.replace("]\n", ", \"analysis.tolerance=1e-8\"]\n")
                + "[[vary]]\nkey = \"analysis.search_direction\"\nvalues = [1e12, 0]\n"
                + FRICTION.replace(", 0.5, 0.7", ""))
        expected = self.expect(text)
        self.sweep("--jobs", "3", text=text, code=3)
        self.same(expected)
        rows = table(self.out)
        self.assertEqual([row["status"] for row in rows], 2 * ["failed"] + 2 * ["done"])
        self.assertEqual(self.began_with(), 4 * [None])
        self.assertIn("did not converge", summary(self.member(1))["message"])
        self.assertIn("4 were there already", self.sweep("--resume", text=text, code=3).stderr)
        self.same(expected)


class Refused(LatinSweep):
    def refused(self, text, *fragments, extra=()):
        done = self.sweep(*extra, text=text, code=2)
        for fragment in fragments:
            self.assertIn(fragment, done.stderr)
        self.assertFalse(self.out.exists())

    def test_keys_that_some_solvers_have_not(self):
        self.refused(BASE.replace("set", "# ") + SOLVER,
                     "run 1 (analysis.solver = \"direct\")", "analysis.downsizing",
                     "run 2 (analysis.solver = \"latin\")", "\"latin-pgd\"",
                     extra=("--set", "analysis.downsizing=0.5"))

    def test_a_solver_that_is_none(self):
        self.refused(BASE.replace("set", "# ") + SOLVER.replace("\"latin\"", "\"lattin\""),
                     "run 2 (analysis.solver = \"lattin\")", "is not one of the choices")
        self.refused(BASE.replace("-pgd", "-pod") + FRICTION, "and 3 of 3 others",
                     "\"direct\", \"latin\" or \"latin-pgd\"")

    def test_rubber(self):
        self.refused(BASE + FRICTION, "analysis.solver = latin-pgd", "a part of the body is rubber",
                     extra=("--set", "material.model=neo-hooke"))


if __name__ == "__main__":
    unittest.main()

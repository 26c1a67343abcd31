# SPDX-License-Identifier: BSD-3-Clause
"""rondo sweep: runs that fail, kills and signals, resumption, MPI ranks."""
import collections
import json
import os
import shutil
import signal
import subprocess
import time
import unittest

import numpy as np

from program import PROGRAM, replaced, run
from sweep_program import LONG, MPI, STUDY, SweepTest, mpirun, table


class Failures(SweepTest):
    FAILING = """schema = 1
base = "case.toml"
set = ["ground.profile=flat", "time.end=0.3"]
[[vary]]
key = "motion.angular_velocity"
values = [33, 2000, 34]
"""

    def test_one_that_fails_is_recorded_and_the_others_go_on(self):
        done = self.sweep(text=self.FAILING, code=3)
        self.assertIn(f"run 2 (motion.angular_velocity = 2000) in {self.out / 'runs' / '0002'}: ",
                      done.stderr)
        rows = table(self.out)
        self.assertEqual([row["status"] for row in rows], ["done", "failed", "done"])
        self.assertTrue(np.isnan(float(rows[1]["force_y_mean"])))
        self.assertTrue(np.isfinite(float(rows[2]["force_y_mean"])))
        said = json.loads((self.out / "sweep.json").read_text())
        self.assertEqual((said["status"], said["done"], said["failed"]), ("failed", 2, 1))
        self.assertEqual(said["failures"][0]["run"], 2)
        before = (self.out / "results.csv").read_bytes()
        done = self.sweep("--resume", text=self.FAILING, code=3)  # the same would come of it
        self.assertIn("3 were there already", done.stderr)
        self.assertEqual((self.out / "results.csv").read_bytes(), before)

    def test_runs_that_are_not_what_they_should_be_are_made_again(self):
        """Of another case, damaged, of another program, failed by the machine; and what a killed
        write left is removed."""
        values = [10.0, 2000.0, 11.0, 12.0, 13.0]  # the second blows up by itself
        text = self.FAILING.replace(self.FAILING[self.FAILING.index("values"):].splitlines()[0],
                                    f"values = {values}")
        self.sweep(text=text, code=3)
        runs = sorted(self.out.glob("runs/*"))
        self.assertEqual(len(runs), 5)

        def edit(file, old, new):
            whole = file.read_text()
            self.assertIn(old, whole)
            file.write_text(whole.replace(old, new, 1))

        edit(runs[0] / "case.toml", "restitution = 0.0", "restitution = 0.1")
        edit(runs[1] / "run.json", '"steps_done"', '"steps_lost"')  # as where the disk was full
        edit(runs[2] / "run.json", '"build_id": "', '"build_id": "0')
        history = runs[3] / "history.csv"
        history.write_text("".join(history.read_text().splitlines(True)[:-2]))
        left = runs[0] / "results.h5.123.tmp" / "half"
        left.parent.mkdir()
        left.write_text("half")
        done = self.sweep("--resume", text=text, code=3)
        self.assertIn("1 were there already", done.stderr)
        self.assertFalse(left.parent.exists())

    def test_an_interrupted_sweep_goes_on(self):
        self.case(replaced(LONG, "end", "end = 4.0"))
        process = subprocess.Popen([PROGRAM, "sweep", str(self.study()), "-o", str(self.out)],
                                   stderr=subprocess.DEVNULL)
        self.wait_for_runs(3)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=60), 130)
        said = json.loads((self.out / "sweep.json").read_text())
        self.assertEqual(said["status"], "interrupted")
        status = collections.Counter(row["status"] for row in table(self.out))
        self.assertGreaterEqual(status["done"], 1)
        self.assertGreaterEqual(status["waiting"] + status["interrupted"], 1)
        cut = [path for path in self.out.glob("runs/*/run.json")
               if json.loads(path.read_text())["status"] == "interrupted"]
        self.assertTrue(cut)
        steps = [json.loads(path.read_text())["steps_done"] for path in cut]
        self.goes_on_to_the_same(said["done"])
        self.assertEqual([json.loads(path.read_text())["resumed_at_steps"] for path in cut],
                         [[n] for n in steps])  # from where they were, not from the start

    def test_killed_with_all_its_workers(self):
        self.case(LONG)
        process = subprocess.Popen([PROGRAM, "sweep", str(self.study()), "-o", str(self.out)],
                                   stderr=subprocess.DEVNULL)
        self.wait_for_runs(3)
        process.kill()
        process.wait()
        self.assertEqual(json.loads((self.out / "sweep.json").read_text())["status"], "running")
        self.goes_on_to_the_same(1)  # two are in hand

    def test_a_rank_that_is_killed_ends_the_job_and_nothing_is_lost(self):
        self.case(LONG)
        process = subprocess.Popen(["mpirun", "--oversubscribe", "-n", "3", PROGRAM, "sweep",
                                    str(self.study()), "-o", str(self.out)],
                                   stderr=subprocess.DEVNULL, env=MPI)
        self.wait_for_runs(4)
        ranks = subprocess.run(["pgrep", "-P", str(process.pid)], capture_output=True, text=True)
        os.kill(int(ranks.stdout.split()[1]), signal.SIGKILL)
        self.assertNotEqual(process.wait(timeout=120), 0)
        self.goes_on_to_the_same(1, ranks=3)

    def test_stopped_while_it_checks(self):
        """What is there stays, whatever was asked for."""
        many = STUDY.split("[[vary]]")[0] + ('[[vary]]\nkey = "material.density"\n'  # a body each
                                             'linspace = [1000.0, 1200.0, 600]\n')
        small = ("--set", "time.end=0.001", "--set", "output.history_interval=1e-4")
        self.sweep(*small, text=many)
        kept = (self.out / "results.csv").read_bytes()
        for extra in ("--overwrite", "--resume", "--dry-run"):
            process = subprocess.Popen([PROGRAM, "sweep", str(self.study(many)), "-o", str(self.out),
                                        *small, extra], stdout=subprocess.PIPE,
                                       stderr=subprocess.PIPE, text=True)
            for line in process.stderr:
                if "check" in line:  # a tenth of them is checked
                    process.send_signal(signal.SIGTERM)
                    break
            process.communicate()
            self.assertEqual(process.returncode, 130)
            self.assertEqual((self.out / "results.csv").read_bytes(), kept)
            self.assertEqual(json.loads((self.out / "sweep.json").read_text())["status"], "done")

    def test_stopped_while_it_reads_many_members(self):
        """It says how far it is, and ends at a signal."""
        many = STUDY.replace("linspace = [9, 11, 3]", "linspace = [9.0, 11.0, 5000]")
        for way, code in ((("--dry-run",), signal.SIGINT), ((), signal.SIGTERM)):
            process = subprocess.Popen([PROGRAM, "sweep", str(self.study(many)), "-o", str(self.out), *way],
                                       stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            said = process.stderr.readline()
            process.send_signal(code)
            rest = process.communicate(timeout=60)[1]
            self.assertRegex(said, r"^ 10 %  read \d+ of 15000, ")
            self.assertEqual(process.returncode, 130, rest)
            self.assertNotIn("check", rest)
            self.assertFalse(self.out.exists())

    def wait_for_runs(self, n):
        deadline = time.time() + 60
        while len(list(self.out.glob("runs/*/run.json"))) < n:
            self.assertLess(time.time(), deadline, "the runs did not start")
            time.sleep(0.01)

    def goes_on_to_the_same(self, least_kept, ranks=0):
        """Runs that were done are left as they are; the table is that of an undisturbed sweep."""
        whole = {path.parent: path.read_bytes() for path in self.out.glob("runs/*/run.json")
                 if json.loads(path.read_text())["status"] == "done"}
        self.assertGreaterEqual(len(whole), least_kept)
        study = self.study()
        if ranks:
            done = mpirun(ranks, study, "-o", self.out, "--resume")
        else:
            done = run("sweep", study, "-o", self.out, "--resume")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"{len(whole)} were there already", done.stderr)
        for path, text in whole.items():
            self.assertEqual((path / "run.json").read_bytes(), text, path)
        other = self.folder / "other"
        self.assertEqual(run("sweep", study, "-o", other).returncode, 0)
        self.assertEqual((self.out / "results.csv").read_bytes(),
                         (other / "results.csv").read_bytes())


class Ranks(SweepTest):
    def test_results_do_not_depend_on_their_number(self):
        self.sweep("--jobs", "1")
        expected = {name: (self.out / name).read_bytes() for name in ("results.csv", "sweep.h5")}
        self.sweep("--jobs", "3", "--overwrite")
        for ranks in (0, 1, 2, 4):
            if ranks:
                shutil.rmtree(self.out)
                done = mpirun(ranks, self.study(), "-o", self.out)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(done.stderr.count("9 of 9 runs done"), 1)
                workers = {row.split(",")[1] for row in
                           (self.out / "timings.csv").read_text().splitlines()[1:]}
                self.assertLessEqual(workers, {str(k + 1) for k in range(ranks)})
            for name, text in expected.items():
                self.assertEqual((self.out / name).read_bytes(), text, (ranks, name))

    def test_all_ranks_end_where_the_study_is_wrong(self):
        done = mpirun(3, self.study(STUDY.replace("friction\"", "frction\"")), "-o", self.out)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr.count("did you mean ground.friction?"), 1)

    def test_a_rank_that_fails_alone_ends_all(self):
        """It reads another study, of another place, which is none."""
        script = self.folder / "rank.sh"
        script.write_text(f"[ $OMPI_COMM_WORLD_RANK = 1 ] && cd /\nexec {PROGRAM} sweep \"$@\"\n")
        self.study()
        done = subprocess.run(["mpirun", "--oversubscribe", "-n", "3", "bash", script, "study.toml",
                               "-o", "out"], capture_output=True, text=True, env=MPI, timeout=60,
                              cwd=self.folder)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("rank 1: study.toml: there is no such file", done.stderr)

    def test_all_ranks_end_where_the_leader_cannot_write(self):
        (self.out / "sweep.json").mkdir(parents=True)
        done = mpirun(2, self.study(), "-o", self.out)
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("sweep.json", done.stderr)

    def test_all_ranks_end_where_the_directory_holds_something_else(self):
        self.out.mkdir()
        (self.out / "run.json").write_text("{}")
        done = mpirun(2, self.study(), "-o", self.out)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stderr.count("no sweep"), 1)


if __name__ == "__main__":
    unittest.main()

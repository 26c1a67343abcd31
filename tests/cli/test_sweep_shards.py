# SPDX-License-Identifier: BSD-3-Clause
"""rondo sweep --shard and --collect: the same tables as of the undivided sweep."""
import json
import os
import shutil
import signal
import subprocess
import time
import unittest

from program import ROOT, replaced, run
from shard_program import LATIN, ShardTest
from sweep_program import CRUSH, LONG, STUDY, mpirun, table

import rondo

SAMPLE = """schema = 1
base = "case.toml"
[sample]
kind = "latin-hypercube"
count = 7
seed = 3
[[vary]]
key = "material.youngs_modulus"
uniform = [1e7, 3e7]
[[vary]]
key = "disk.mesh.radial"
values = [2, 3]
"""
FAILING = """schema = 1
base = "case.toml"
set = ["ground.profile=flat", "time.end=0.3"]
[[vary]]
key = "motion.angular_velocity"
values = [33, 2000, 34]
"""
STEADY = replaced(replaced((ROOT / "cases" / "steady-rolling.toml").read_text(), "radial", "radial = 4"),
                  "circumferential", "circumferential = 60")
STEADY_STUDY = """schema = 1
base = "case.toml"
[[vary]]
key = "motion.speed"
values = [9.8, 10.0, 10.1]
[[vary]]
key = "ground.friction"
values = [0.1, 0.5]
"""
class SameBytes(ShardTest):
    def test_of_a_grid_in_any_order(self):
        self.expect()
        self.all_shards(4, order=(3, 1, 4, 2))
        self.assertFalse((self.out / "sweep.json").exists())
        self.assertIn("9 of 9 runs done, in 4 shards", self.collect().stderr)
        self.same()
        self.assertEqual(sorted(sum((self.runs_of(k, 4) for k in range(1, 5)), [])), list(range(1, 10)))
        self.assertEqual([len(self.runs_of(k, 4)) for k in range(1, 5)], [3, 2, 2, 2])
        timings = (self.out / "timings.csv").read_text().splitlines()
        self.assertEqual([line.split(",")[0] for line in timings[1:]], [str(k) for k in range(1, 10)])

    def test_of_a_latin_hypercube(self):
        self.expect(SAMPLE)
        self.all_shards(3, SAMPLE)
        self.collect(SAMPLE)
        self.same()
        self.assertEqual([self.runs_of(k, 3) for k in (1, 2, 3)],  # a body each, dealt out
                         [list(range(k, 15, 3)) for k in (1, 2, 3)])

    def test_of_solvers_with_columns_that_others_have_not(self):
        self.case(CRUSH)
        text = LATIN.replace("set", "# ").replace("disk.mesh.radial\"\nvalues = [4, 3]",
                                                  "analysis.solver\"\nvalues = [\"direct\", \"latin\"]")
        self.expect(text)
        self.assertIn(",nan", (self.whole / "results.csv").read_text())
        self.all_shards(2, text)
        self.collect(text)
        self.same()

    def test_at_the_same_time(self):
        self.expect()
        commands = [self.command("--shard", f"{k}/5", "--quiet") for k in range(1, 6)]  # and the study
        jobs = [subprocess.Popen(command, stderr=subprocess.PIPE) for command in commands]
        for job in jobs:
            said = job.communicate(timeout=60)[1]
            self.assertEqual((job.returncode, said), (0, b""))
        self.collect()
        self.same()

    def test_of_steady_rolling_without_folders_of_runs(self):
        self.case(STEADY)
        self.expect(STEADY_STUDY)
        self.all_shards(4, STEADY_STUDY)
        self.collect(STEADY_STUDY)
        self.same()
        self.assertFalse((self.out / "runs").exists())
        before = (self.out / "results.csv").read_bytes()
        self.sweep("--resume", text=STEADY_STUDY)
        self.assertEqual((self.out / "results.csv").read_bytes(), before)

    def test_of_crushes_by_products_of_fields(self):
        """Of one body in two shards; a shard that has not the first member makes its fields itself."""
        self.case(CRUSH)
        self.expect(LATIN)
        done = [self.shard(k, 4, text=LATIN).stderr for k in (4, 2, 1, 3)]
        self.assertEqual([self.runs_of(k, 4) for k in range(1, 5)], [[1, 3], [2, 4], [5, 7], [6, 8]])
        self.assertEqual(["1 of other shards made here as well, for its fields" in text for text in done],
                         [True, True, False, False])
        self.assertEqual(sorted(path.name for path in self.out.glob("shards/0002-of-0004/runs/*")), ["0001"])
        self.collect(LATIN)
        self.same()
        began = [json.loads((self.out / "runs" / f"{k:04d}" / "run.json").read_text()).get("modes_from")
                 for k in range(1, 9)]
        self.assertEqual(began, [None] + 3 * ["../0001"] + [None] + 3 * ["../0005"])
        self.assertIn("8 were there already", self.sweep("--resume", text=LATIN).stderr)
        self.same()

    def test_where_the_first_member_fails_all_shards_begin_from_nothing(self):
        self.case(CRUSH)
        text = LATIN.replace("pgd\"]", "pgd\", \"analysis.tolerance=1e-8\"]").replace(
            "disk.mesh.radial\"\nvalues = [4, 3]", "analysis.search_direction\"\nvalues = [1e12, 0]"
        ).replace(", 0.5, 0.7", "")
        self.expect(text, code=3)
        self.all_shards(2, text, codes={1: 3, 2: 3})
        self.collect(text, code=3)
        self.same()

    def test_of_members_that_fail(self):
        self.expect(FAILING, code=3)
        self.all_shards(2, FAILING, codes={2: 3})
        done = self.collect(FAILING, code=3)
        self.assertIn("run 2 (motion.angular_velocity = 2000) in ", done.stderr)
        self.same()
        self.assertEqual([row["status"] for row in table(self.out)], ["done", "failed", "done"])

    def test_more_shards_than_members(self):
        self.expect()
        self.all_shards(11)
        self.assertEqual(self.runs_of(10, 11), [])
        self.collect()
        self.same()

    def test_of_ranks(self):
        self.expect()
        self.shard(1, 2)
        done = mpirun(2, self.study(), "-o", self.out, "--shard", "2/2")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.collect()
        self.same()
        done = mpirun(2, self.study(), "-o", self.out, "--collect")
        self.assertEqual(done.returncode, 2)
        self.assertIn("without mpirun", done.stderr)

    def test_collected_again_and_gone_on_with(self):
        """As after an undivided sweep."""
        text = STUDY.replace("base", "snapshots = true\nbase")
        self.expect(text)
        self.all_shards(2, text)
        self.collect(text)
        before = {path.name: path.read_bytes() for path in self.out.iterdir() if path.is_file()}
        self.collect(text)
        for name, whole in before.items():
            self.assertTrue(name == "sweep.h5" or (self.out / name).read_bytes() == whole, name)
        self.same()
        self.assertIn("9 were there already", self.sweep("--resume", text=text).stderr)
        self.same()
        done = run("pod", self.out, "--field", "velocity", "-o", self.folder / "pod")
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads((self.folder / "pod" / "velocity-rotating" / "pod.json").read_text())
        self.assertEqual(found["snapshots"], 9 * 11)
        self.sweep("--overwrite", text=text)
        self.assertFalse((self.out / "shards").exists())

    def test_from_another_folder(self):
        """The study of a mesh file, called by other paths: it is the same sweep."""
        shutil.copy(ROOT / "cases" / "meshes" / "two-disks.msh", self.folder)
        self.case(replaced(replaced((ROOT / "cases" / "two-disks.toml").read_text(), "file",
                                    'file = "two-disks.msh"'), "end", "end = 2e-4"))
        study = ("schema = 1\nbase = \"case.toml\"\nset = [\"output.history_interval=1e-5\"]\n"
                 "[[vary]]\nkey = \"contact.friction\"\nvalues = [0.1, 0.2]\n")
        self.expect(study)
        self.shard(1, 2, text=study)
        for what in (("--shard", "2/2"), ("--collect",)):
            done = run("sweep", "study.toml", "-o", "out", *what, cwd=self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.same()


class Unfinished(ShardTest):
    def test_shards_that_are_missing_are_told_with_what_to_do(self):
        self.expect()
        self.shard(2, 4)
        done = self.collect(code=130)
        self.assertIn("2 of 9 runs done; 3 of 4 shards not finished: 1,3-4", done.stderr)
        self.assertIn(f"shard 3/4 has not begun: rondo sweep {self.folder / 'study.toml'} -o {self.out} "
                      "--shard 3/4 --resume", done.stderr)
        status = [row["status"] for row in table(self.out)]
        self.assertEqual((status.count("done"), status.count("waiting")), (2, 7))
        self.assertEqual(json.loads((self.out / "sweep.json").read_text())["status"], "interrupted")
        with self.assertRaisesRegex(rondo.UnfinishedRunError, "9 members: 7 waiting, 2 done"):
            rondo.open_sweep(self.out)
        for number in (1, 3, 4):
            self.shard(number, 4, "--resume")
        self.collect()
        self.same()

    def test_one_that_is_killed_goes_on(self):
        self.case(LONG)
        self.expect()
        self.shard(1, 2)
        process = subprocess.Popen(self.command("--shard", "2/2", "--jobs", "1", "--quiet"),
                                   start_new_session=True)
        self.wait_for_runs(7)
        os.killpg(process.pid, signal.SIGSTOP)  # workers, too
        self.assertIn("shard 2/2 is at work (process ", self.collect(code=130).stderr)
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        self.assertIn("shard 2/2 was killed (process ", self.collect(code=130).stderr)
        self.assertIn("were there already", self.shard(2, 2, "--resume").stderr)
        self.collect()
        self.same()

    def test_one_that_is_interrupted_goes_on(self):
        self.case(LONG)
        self.expect()
        self.shard(2, 2)
        process = subprocess.Popen(self.command("--shard", "1/2", "--jobs", "1", "--quiet"))
        self.wait_for_runs(6)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(timeout=60), 130)
        self.assertEqual(self.rows(1, 2)["status"], "interrupted")
        self.assertIn("shard 1/2 was interrupted", self.collect(code=130).stderr)
        self.shard(1, 2, "--resume")
        self.collect()
        self.same()

    def test_first_fields_of_a_shard_that_is_missing(self):
        """What others made with fields of their own counts."""
        self.case(CRUSH)
        self.expect(LATIN)
        self.shard(2, 4, text=LATIN)
        self.assertIn("2 of 8 runs done", self.collect(LATIN, code=130).stderr)
        self.sweep("--resume", text=LATIN)  # the rest without shards
        self.same()

    def test_runs_that_are_lost_or_changed(self):
        self.expect()
        self.all_shards(2)
        run_of_2 = self.runs_of(2, 2)[0]
        shutil.rmtree(self.out / "runs" / f"{run_of_2:04d}")
        history = self.out / "runs" / f"{self.runs_of(1, 2)[1]:04d}" / "history.csv"
        lines = history.read_text().splitlines(True)
        history.write_text("".join(lines[:-5] + lines[-4:]))
        done = self.collect(code=130)
        for number, lost in ((2, run_of_2), (1, self.runs_of(1, 2)[1])):
            self.assertIn(f"shard {number}/2 has lost run {lost}", done.stderr)
        self.assertEqual([row["status"] for row in table(self.out)].count("waiting"), 2)

    def test_rows_that_are_damaged(self):
        self.all_shards(2)
        path = self.out / "shards" / "0002-of-0002" / "rows.json"
        whole = path.read_text()
        less = json.loads(whole)
        del less["rows"][1]
        for text in (whole[:200], json.dumps(less), whole.replace('"run": ', '"run": 1')):
            path.write_text(text)
            self.assertIn("0002-of-0002", self.collect(code=4).stderr)

    def wait_for_runs(self, number):
        deadline = time.monotonic() + 60
        while len(list(self.out.glob("runs/*/run.json"))) < number:
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.002)


if __name__ == "__main__":
    unittest.main()

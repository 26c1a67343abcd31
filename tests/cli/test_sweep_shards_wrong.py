# SPDX-License-Identifier: BSD-3-Clause
"""rondo sweep --shard and --collect: what is refused."""
import shutil
import subprocess
import time
import unittest

from program import replaced, run
from shard_program import LATIN, ShardTest
from sweep_program import CRUSH, LONG, STUDY

import rondo


class Refused(ShardTest):
    def test_parts_that_are_none(self):
        for wrong in ("0/4", "5/4", "a/b", "3", "1/", "-1/4", "1/4/2", "1.5/4", " 1/4", "1/0", "1/9999999"):
            done = self.sweep(f"--shard={wrong}", code=2)
            self.assertIn(f"--shard = {wrong}: is no part of a sweep", done.stderr)
            self.assertIn("1 <= i <= n", done.stderr)
        self.assertFalse(self.out.exists())

    def test_options_that_make_no_sense_together(self):
        self.assertIn("other shards write into the same directory",
                      self.shard(1, 2, "--overwrite", code=2).stderr)
        self.assertIn("takes all shards together", self.shard(1, 2, "--collect", code=2).stderr)
        for option in ("--resume", "--overwrite", "--dry-run"):
            self.assertIn("makes no runs", self.sweep("--collect", option, code=2).stderr)
        self.assertFalse(self.out.exists())

    def test_nothing_to_collect(self):
        self.assertIn("holds no shards", self.collect(code=2).stderr)
        self.sweep()
        self.assertIn("holds no shards", self.collect(code=2).stderr)
        self.assertIn("not made in shards", self.shard(1, 2, "--resume", code=2).stderr)

    def test_other_divisions(self):
        self.shard(1, 4)
        done = self.shard(2, 3, code=2)
        self.assertIn("holds shard 1/4 of a sweep in 4 parts", done.stderr)
        self.assertEqual([path.name for path in self.out.glob("shards/*")], ["0001-of-0004"])
        shutil.copytree(self.out / "shards" / "0001-of-0004", self.out / "shards" / "0001-of-0003")
        self.assertIn("holds shards of sweeps in 3 and in 4 parts", self.collect(code=2).stderr)

    def test_other_studies_and_programs(self):
        self.shard(1, 2)
        other = STUDY.replace("0.4]", "0.5]")
        self.assertIn("holds shard 1/2 of another sweep: the study file differs",
                      self.shard(2, 2, text=other, code=2).stderr)
        self.assertIn("--set differs", self.shard(2, 2, "--set", "time.end=0.01", code=2).stderr)
        self.shard(2, 2)
        self.assertIn("shard 1/2 is of another sweep: the study file differs",
                      self.collect(other, code=2).stderr)
        case = (self.folder / "case.toml").read_text()
        self.case(replaced(case, "end", "end = 0.03"))
        self.assertIn("shard 2/2 is of another sweep: the base case differs", self.collect(code=2).stderr)
        self.assertIn("the base case differs", self.shard(1, 2, "--resume", code=2).stderr)
        self.case(case)
        path = self.out / "shards" / "0002-of-0002" / "rows.json"
        path.write_text(path.read_text().replace('"build_id": "', '"build_id": "0'))
        done = self.collect(code=2)
        self.assertIn("shard 2/2 is of another sweep: the program differs", done.stderr)
        self.assertNotIn("shard 1/2", done.stderr)
        self.assertFalse((self.out / "results.csv").exists())

    def test_a_shard_that_is_there(self):
        self.shard(1, 2)
        kept = self.rows(1, 2)
        self.assertIn("holds shard 1/2", self.shard(1, 2, code=2).stderr)
        self.assertEqual(self.rows(1, 2), kept)
        self.assertIn("5 were there already", self.shard(1, 2, "--resume").stderr)

    def test_the_same_shard_twice_at_once(self):
        self.case(replaced(LONG, "end", "end = 100.0"))
        process = subprocess.Popen(self.command("--shard", "1/2", "--quiet"))
        deadline = time.monotonic() + 60
        while not list(self.out.glob("runs/*/run.json")) and time.monotonic() < deadline:
            time.sleep(0.01)
        done = [self.shard(1, 2, "--resume", code=4), self.sweep("--resume", code=4)]
        process.kill()
        process.wait()
        for said in done:
            self.assertIn("0001-of-0002: another rondo is at work here", said.stderr)

    def test_files_that_are_not_a_sweeps(self):
        for name in ("run.json", "results.csv", "runs"):
            self.out.mkdir()
            (self.out / name).write_text("precious")
            self.assertIn("and no sweep", self.shard(1, 2, code=2).stderr)
            self.assertEqual([path.name for path in self.out.iterdir()], [name])
            shutil.rmtree(self.out)

    def test_what_is_not_collected(self):
        self.shard(1, 2)
        self.assertIn("--collect", self.sweep(code=2).stderr)
        self.assertIn("--collect", self.sweep("--overwrite", code=2).stderr)
        self.assertIn("--collect", run("pod", self.out).stderr)
        with self.assertRaisesRegex(rondo.UnfinishedRunError, "--collect"):
            rondo.open_sweep(self.out)

    def test_dry_run_lists_a_part_and_writes_nothing(self):
        self.case(CRUSH)
        done = self.shard(2, 4, "--dry-run", text=LATIN)
        self.assertEqual([line.split(" (")[0] for line in done.stdout.splitlines()[:3]],
                         ["run 1", "run 2", "run 4"])
        self.assertIn("of another shard, made here for its fields", done.stdout.splitlines()[0])
        self.assertIn("3 runs, ", done.stdout.splitlines()[3])
        self.assertFalse(self.out.exists())


if __name__ == "__main__":
    unittest.main()

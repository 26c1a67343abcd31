# SPDX-License-Identifier: BSD-3-Clause
"""rondo sweep: what is at work in its directory beside it, with and without locks of the file
system; folders that are removed while it goes on."""
import json
import os
import shutil
import subprocess
import time
import unittest

from program import PROGRAM, SMALL, replaced, run
from sweep_program import LONG, SweepTest

NO_LOCKS = os.environ.get("RONDO_NO_LOCKS", "")
ENDLESS = replaced(SMALL, "end", "end = 500.0")


def rewritten(path, **keys):
    path.write_text(json.dumps({**json.loads(path.read_text()), **keys}))


def status(run):
    """In run.json; empty: there is none."""
    try:
        return json.loads((run / "run.json").read_text())["status"]
    except FileNotFoundError:
        return ""


class BesideTest(SweepTest):
    environment = dict(os.environ)

    def start(self, *arguments):
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], stderr=subprocess.DEVNULL,
                                   env=self.environment)

        def end():
            process.kill()
            process.wait()
        self.addCleanup(end)
        return process

    def wait_until(self, what, seconds=60):
        deadline = time.monotonic() + seconds
        while not what():
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)

    def refused(self, process, *arguments):
        done = run(*arguments, env=self.environment)
        self.assertEqual(done.returncode, 4, (arguments, done.stderr))
        self.assertIn("another rondo is at work here (process", done.stderr)
        self.assertIsNone(process.poll())


@unittest.skipUnless(NO_LOCKS, "RONDO_NO_LOCKS is not set, or sanitizers are in")
class WithoutLocks(BesideTest):
    environment = {**os.environ, "LD_PRELOAD": NO_LOCKS}

    def test_two_sweeps(self):
        self.case(ENDLESS)
        study = self.study()
        first = self.start("sweep", study, "-o", self.out)
        self.wait_until(lambda: len(list(self.out.glob("runs/*/history.csv"))) >= 2)
        for extra in (("--resume",), ("--overwrite",), ("--shard", "1/2")):
            command = ("sweep", study, "-o", self.out, *extra)
            if extra[0] == "--shard":  # of a directory whose sweep was not made in shards
                self.assertEqual(run(*command, env=self.environment).returncode, 2)
            else:
                self.refused(first, *command)
        self.refused(first, "run", self.folder / "case.toml", "-o", self.out)
        self.assertTrue(list(self.out.glob("runs/*/history.csv")))
        first.kill()
        first.wait()
        self.case(SMALL)
        done = run("sweep", study, "-o", self.out, "--overwrite", env=self.environment)
        self.assertEqual(done.returncode, 0, done.stderr)
        said = json.loads((self.out / "sweep.json").read_text())
        self.assertEqual((said["done"], "process" in said), (9, False))

    def test_shards(self):
        self.case(ENDLESS)
        study = self.study()
        first = self.start("sweep", study, "-o", self.out, "--shard", "1/2")
        self.wait_until(lambda: list(self.out.glob("runs/*/history.csv")))
        self.refused(first, "sweep", study, "-o", self.out, "--shard", "1/2", "--resume")
        done = run("sweep", study, "-o", self.out, "--collect", env=self.environment)
        self.assertIn(f"shard 1/2 is at work (process {first.pid} on", done.stderr)
        self.refused(first, "sweep", study, "-o", self.out, "--overwrite")
        self.assertTrue(list(self.out.glob("runs/*/history.csv")))


class AtWork(BesideTest):
    def test_a_run_in_a_folder_of_the_sweep_is_not_removed(self):
        self.sweep()
        member = self.out / "runs" / "0003"
        process = self.start("run", self.folder / "case.toml", "-o", member, "--overwrite", "--set",
                             "time.end=500")
        self.wait_until(lambda: status(member) == "running")
        self.refused(process, "sweep", self.study(), "-o", self.out, "--overwrite")
        self.assertEqual(len(list(self.out.glob("runs/*/history.csv"))), 9)

    def test_what_another_machine_has_begun(self):
        self.sweep()
        for path in (self.out / "sweep.json", self.out / "runs" / "0002" / "run.json"):
            kept = path.read_bytes()
            rewritten(path, status="running", host="far", process=1)
            done = self.sweep("--overwrite", code=4)
            self.assertIn(f"{path.parent}: was begun on far", done.stderr)
            self.assertEqual(len(list(self.out.glob("runs/*/history.csv"))), 9)
            path.write_bytes(kept)
        rewritten(self.out / "sweep.json", status="running", host="far", process=1)
        self.assertIn(f"{self.out} was begun on far", self.sweep("--resume").stderr)


class Removed(BesideTest):
    def test_a_finished_run_that_is_removed_is_noticed(self):
        self.case(LONG)
        study, other = self.study(), self.folder / "other"
        process = subprocess.Popen([PROGRAM, "sweep", str(study), "-o", str(self.out), "--jobs",
                                    "1"], stderr=subprocess.PIPE, text=True)

        def done():
            return [path for path in self.out.glob("runs/*") if status(path) == "done"]
        self.wait_until(lambda: done() and len(list(self.out.glob("runs/*/run.json"))) > 1)
        lost = done()[0]
        shutil.rmtree(lost)
        told = process.communicate(timeout=120)[1]
        self.assertEqual(process.returncode, 4, told)
        self.assertIn(f"run {int(lost.name)} (", told)
        self.assertIn(f"it was done, and {lost} was removed while the sweep went on", told)
        said = json.loads((self.out / "sweep.json").read_text())
        self.assertEqual((said["status"], said["done"], said["failures"][0]["run"]),
                         ("failed", 8, int(lost.name)))
        self.sweep("--resume")
        self.assertEqual(run("sweep", study, "-o", other, "--quiet").returncode, 0)
        self.assertEqual((self.out / "results.csv").read_bytes(),
                         (other / "results.csv").read_bytes())

    def test_a_file_of_a_finished_run_of_a_shard(self):
        self.case(LONG)
        process = subprocess.Popen([PROGRAM, "sweep", str(self.study()), "-o", str(self.out), "--jobs",
                                    "1", "--shard", "1/2"], stderr=subprocess.PIPE, text=True)

        def done():
            return [path for path in self.out.glob("runs/*") if status(path) == "done"]
        self.wait_until(lambda: done() and len(list(self.out.glob("runs/*/run.json"))) > 1)
        lost = done()[0] / "history.csv"
        lost.unlink()
        told = process.communicate(timeout=120)[1]
        self.assertEqual(process.returncode, 4, told)
        self.assertIn(f"{lost} was removed", told)


if __name__ == "__main__":
    unittest.main()

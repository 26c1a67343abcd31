# SPDX-License-Identifier: BSD-3-Clause
"""rondo paper: signals, and what it refuses."""
import json
import signal
import subprocess
import time
import unittest

from program import PROGRAM, ProgramTest, finished, run, summary


class Interrupt(ProgramTest):
    def test_the_runs_in_hand_end_cleanly(self):
        def in_hand():
            """run.json of the runs at work; those of the full study take about a second."""
            found = []
            for file in self.folder.glob("runs/*/run.json"):
                try:
                    found.append(json.loads(file.read_text()))
                except FileNotFoundError:  # replaced just now
                    pass
            return [one for one in found if one["status"] == "running"]

        with subprocess.Popen([PROGRAM, "paper", "-o", self.folder], stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL) as study:
            deadline = time.monotonic() + 60
            while not in_hand():
                self.assertIsNone(study.poll())
                self.assertLess(time.monotonic(), deadline)
                time.sleep(0.01)
            study.send_signal(signal.SIGTERM)
        self.assertEqual(study.returncode, 130)
        self.assertEqual(in_hand(), [])
        ended = [summary(file.parent) for file in self.folder.glob("runs/*/run.json")]
        cut = [one for one in ended if one["status"] == "interrupted"]
        self.assertTrue(cut, ended)
        for one in cut:
            self.assertLess(one["steps_done"], one["steps"])


class HangUp(ProgramTest):
    def test_a_study_under_nohup_goes_on(self):
        command = ["nohup", PROGRAM, "paper", "--quick", "--quiet", "-o", self.folder]
        with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL) as study:
            deadline = time.monotonic() + 60
            while finished(self.folder) < 1:
                self.assertLess(time.monotonic(), deadline)
                time.sleep(0.01)
            study.send_signal(signal.SIGHUP)
        self.assertEqual(study.returncode, 0)


class Refusals(ProgramTest):
    def refused(self, *arguments, code=2):
        done = run("paper", *arguments)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertEqual(done.stdout, "")
        return done.stderr

    def test_a_directory_of_something_else(self):
        (self.folder / "run.json").write_text("{}")
        self.assertIn("choose another -o", self.refused("--quick", "-o", self.folder))
        self.assertIn("choose another -o", self.refused("--quick", "--overwrite", "-o", self.folder))
        self.assertEqual([file.name for file in self.folder.iterdir()], ["run.json"])

    def test_runs_of_something_else(self):
        (self.folder / "runs" / "mine").mkdir(parents=True)
        self.assertIn("runs/mine", self.refused("--quick", "-o", self.folder))

    def test_the_other_kind_of_study(self):
        (self.folder / "paper.json").write_text('{"format": "rondo paper 1", "quick": false}')
        said = self.refused("--quick", "-o", self.folder)
        self.assertIn("holds the study in full", said)
        self.assertIn("--overwrite", said)

    def test_a_newer_or_damaged_record(self):
        (self.folder / "paper.json").write_text('{"format": "rondo paper 2", "quick": true}')
        self.assertIn('"rondo paper 2"', self.refused("--quick", "-o", self.folder))
        (self.folder / "paper.json").write_text("{")
        self.assertIn("--overwrite", self.refused("--quick", "-o", self.folder, code=4))
        (self.folder / "paper.json").write_text('{"format": 1, "quick": "yes"}')
        self.assertIn("choose another", self.refused("--quick", "-o", self.folder))

    def test_a_file_in_the_way(self):
        (self.folder / "study").write_text("")
        self.assertIn("not a directory", self.refused("--quick", "-o", self.folder / "study"))

    def test_two_studies_at_once(self):
        first = subprocess.Popen([PROGRAM, "paper", "--quick", "-o", self.folder],
                                 stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            deadline = time.monotonic() + 60
            while not (self.folder / "paper.json").exists():
                self.assertIsNone(first.poll())
                self.assertLess(time.monotonic(), deadline)
                time.sleep(0.01)
            self.assertIn("another rondo is at work here",
                          self.refused("--quick", "-o", self.folder, code=4))
        finally:
            first.send_signal(signal.SIGINT)
            first.wait()

    def test_a_wrong_option(self):
        self.assertIn("--jobs", self.refused("--jobs", 0))


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""Runs of reduced wheels made of their cases, for the tests of the command line."""
import signal
import subprocess
import time

import h5py
import numpy as np

from program import PROGRAM, ProgramTest, run, summary


class WheelTest(ProgramTest):
    def wheel(self, *arguments, case, code=0, out="out", file=None):
        out = self.folder / out
        reduced = ["--reduced"] if file is None else ["--reduced", file]
        done = run("run", self.case(case), *reduced, "-o", out, *arguments)
        self.assertEqual(done.returncode, code, done.stderr)
        return out, done

    def interrupted(self, case, rows):
        """A run that is stopped after so many rows, each time that it goes on."""
        out = self.folder / "out"
        command = [PROGRAM, "run", str(self.case(case)), "--reduced", "-o", str(out), "--resume",
                   "--quiet"]
        for row in rows:
            process = subprocess.Popen(command, stderr=subprocess.DEVNULL)
            while process.poll() is None:
                done = out / "history.csv"
                if done.exists() and done.read_bytes().count(b"\n") > row:
                    break
                time.sleep(0.002)
            self.assertIsNone(process.poll(), "the run was over too soon")
            process.send_signal(signal.SIGTERM)
            process.wait()
            self.assertEqual(summary(out)["status"], "interrupted")
        return out, command

    def same_bits(self, out):
        for name in ("history.csv", "contact.csv"):
            self.assertEqual((self.folder / "whole" / name).read_bytes(),
                             (out / name).read_bytes(), name)
        with h5py.File(self.folder / "whole" / "results.h5") as a, h5py.File(
                out / "results.h5") as b:
            for name in ("/snapshots/displacement", "/snapshots/velocity"):
                np.testing.assert_array_equal(a[name][:], b[name][:])

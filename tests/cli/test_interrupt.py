# SPDX-License-Identifier: BSD-3-Clause
"""Runs that a signal ends: exit codes, and files that can be read."""
import signal
import subprocess
import time
import unittest

import h5py
import numpy as np

from program import PROGRAM, ProgramTest, SMALL, history, replaced, summary


class Interrupt(ProgramTest):
    LONG = replaced(SMALL, "end", "end = 500.0").replace("snapshots = 11", "snapshots = 100000")

    def started(self):
        out = self.folder / "out"
        process = subprocess.Popen([PROGRAM, "run", str(self.case(self.LONG)), "-o", str(out)],
                                   stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.stderr.close)
        deadline = time.time() + 60
        while time.time() < deadline:  # until rows come
            path = out / "history.csv"
            if path.exists() and path.stat().st_size > 20000:
                return process, out
            time.sleep(0.05)
        process.kill()
        self.fail("the run did not start")

    def test_sigint_and_sigterm_end_cleanly(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number):
                process, out = self.started()
                process.send_signal(number)
                self.assertEqual(process.wait(timeout=60), 130)
                s = summary(out)
                self.assertEqual(s["status"], "interrupted")
                with h5py.File(out / "results.h5") as f:
                    self.assertEqual(len(f["/frame/time"]), s["snapshots"])
                    self.assertFalse(np.isnan(f["/frame/time"][:]).any())
                self.assertGreater(len(history(out)["time_s"]), 10)
                self.assertAlmostEqual(history(out)["time_s"][-1], s["end_time"], places=12)
                for path in out.iterdir():
                    path.unlink()

    def test_sigkill_leaves_readable_files(self):
        process, out = self.started()
        process.kill()
        process.wait()
        self.assertEqual(summary(out)["status"], "running")
        with h5py.File(out / "results.h5") as f:
            t = f["/frame/time"][:]
            written = np.count_nonzero(~np.isnan(t))
            self.assertGreater(written, 1)
            self.assertTrue(np.all(np.diff(t[:written]) > 0))
            u = f["/snapshots/displacement"][written - 1]
            self.assertTrue(np.isfinite(u).all())
            self.assertGreater(np.abs(u).max(), 0)
        lines = (out / "history.csv").read_text().splitlines()
        self.assertGreater(len(lines), 10)

    def test_a_signal_before_the_loop_ends_at_once_and_leaves_nothing(self):
        big = replaced(replaced(SMALL, "radial", "radial = 150"), "circumferential",
                       "circumferential = 3000")
        out = self.folder / "out"
        process = subprocess.Popen([PROGRAM, "run", str(self.case(big)), "-o", str(out),
                                    "--set", "solver.operator=sparse"],  # its K takes seconds
                                   stderr=subprocess.DEVNULL)
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=20), 130)
        self.assertFalse(out.exists())


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""rondo run on a disk that fills up while it goes on, here by a limit of the size of its files that
comes once it runs (test_limits.py has a small file system): exit code 4, the file named, run.json says
so. What is written is written off the loop: the error comes back to it in time, or when it has ended."""
import resource
import subprocess
import time
import unittest

import h5py

from program import PROGRAM, ProgramTest, SMALL, replaced, run, summary


class FullDisk(ProgramTest):
    def assert_full(self, text, most, name):
        """A run whose files cannot grow beyond `most` bytes ends with exit 4, one line that names
        the file, and says the same in run.json."""
        out = self.folder / "full"
        process = subprocess.Popen([PROGRAM, "run", str(self.case(text)), "-o", str(out),
                                    "--quiet", "--overwrite"], stderr=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 60
        while not (out / "fields.xdmf").exists() and time.monotonic() < deadline:
            time.sleep(0.001)
        resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (most, most))
        said = process.communicate(timeout=120)[1]
        self.assertEqual(process.returncode, 4, said)
        self.assertEqual(len(said.splitlines()), 1, said)
        self.assertIn(name, said)
        self.assertEqual(summary(out)["status"], "failed")
        self.assertIn(name, summary(out)["message"])
        return out

    def test_rows_end_the_run_soon(self):
        # The whole run would take longer than the test may.
        text = SMALL.replace("snapshots = 11", "snapshots = 2\nhistory_interval = 0\nstress = false")
        self.assert_full(replaced(text, "end", "end = 5000.0"), 200000, "history.csv")

    def test_in_a_snapshot(self):
        # fields.xdmf takes more than results.h5 on a mesh of 8 nodes: its writing fails midway.
        text = replaced(replaced(SMALL, "radial", "radial = 1"), "circumferential",
                        "circumferential = 4")
        text = replaced(text, "snapshots", "snapshots = 400\nhistory_interval = 1.0")
        text = replaced(text, "end", "end = 1000.0")  # some seconds
        whole = self.folder / "out"
        self.assertEqual(run("run", self.case(text), "-o", whole).returncode, 0)
        size = {p.name: p.stat().st_size for p in whole.iterdir()}
        most = (size["results.h5"] + size["fields.xdmf"]) // 2
        self.assertEqual([name for name in size if size[name] > most], ["fields.xdmf"])
        out = self.assert_full(text, most, "fields.xdmf")
        with h5py.File(out / "results.h5") as f:
            self.assertGreater(len(f["/frame/time"]), 200)
            self.assertLess(len(f["/frame/time"]), 400)

    def test_with_the_last_rows(self):
        # The loop has ended when the error comes.
        text = SMALL.replace("snapshots = 11", "snapshots = 0\nhistory_interval = 0.05\nstress = false")
        text = replaced(text, "end", "end = 100.0")  # some seconds
        whole = self.folder / "out"
        self.assertEqual(run("run", self.case(text), "-o", whole).returncode, 0)
        size = (whole / "history.csv").stat().st_size
        self.assertGreater(size, (whole / "results.h5").stat().st_size)
        self.assert_full(text, size - 10, "history.csv")


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""rondo run on a disk that fills up: exit code 4, the file named, run.json says so. What is written
is written off the loop: the error comes back to it in time, or when it has ended."""
import resource
import signal
import unittest

import h5py

from program import ProgramTest, SMALL, replaced, run, summary


class FullDisk(ProgramTest):
    def assert_full(self, text, most, name):
        """A run whose files cannot grow beyond `most` bytes ends with exit 4, one line that names
        the file, and says the same in run.json."""
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)

        out = self.folder / "full"
        done = run("run", self.case(text), "-o", out, "--quiet", "--overwrite", preexec_fn=limit)
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertIn(name, done.stderr)
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
        text = replaced(replaced(text, "snapshots", "snapshots = 400"), "end", "end = 1.0")
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
        text = SMALL.replace("snapshots = 11", "snapshots = 0\nhistory_interval = 0\nstress = false")
        text = replaced(text, "end", "end = 0.1")
        whole = self.folder / "out"
        self.assertEqual(run("run", self.case(text), "-o", whole).returncode, 0)
        size = (whole / "history.csv").stat().st_size
        self.assertGreater(size, (whole / "results.h5").stat().st_size)
        self.assert_full(text, size - 10, "history.csv")


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""Whatever is read: a FIFO, a device, a socket or a folder in its place is refused at once, and none
is waited for."""
import os
import shutil
import socket
import unittest

from program import ProgramTest, SMALL, replaced, run, summary
from sweep_program import STUDY

TEXT = replaced(replaced(SMALL, "end", "step = 5.0e-5\nend = 0.002"), "snapshots", "snapshots = 3")
SOON = 20.0  # s: what waits for a writer waits for ever


class Fifos(ProgramTest):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"

    def fifo(self, path):
        path.unlink(missing_ok=True)
        os.mkfifo(path)
        return path

    def refuses(self, code, path, kind, *arguments):
        done = run(*arguments, timeout=SOON)
        self.assertEqual(done.returncode, code, done.stderr + done.stdout)
        self.assertIn(str(path), done.stderr)
        self.assertIn(f"is a {kind}", done.stderr)

    def make(self, name="out"):
        done = run("run", self.case(TEXT), "-o", self.folder / name, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.folder / name

    def test_cases_and_what_they_name(self):
        case = self.fifo(self.folder / "pipe.toml")
        for command in ("run", "check", "modes"):
            self.refuses(2, case, "FIFO, not a case file", command, case)
        self.refuses(2, case, "FIFO, not a study file", "sweep", case)
        self.refuses(2, case, "FIFO, not a case file", "sweep", self.study(case.name))
        profile = self.fifo(self.folder / "road.csv")
        text = replaced(TEXT, "profile", 'profile = "road.csv"')
        self.refuses(2, profile, "FIFO, not a profile", "check", self.case(text))
        mesh = self.fifo(self.folder / "body.msh")
        text = TEXT[: TEXT.index("[disk]")] + '[mesh]\nfile = "body.msh"\nclamped = "rim"\n' + (
            'contact = "tread"\n') + TEXT[TEXT.index("[material]") :]
        self.refuses(4, mesh, "FIFO, not a regular file", "check", self.case(text))

    def study(self, base):
        path = self.folder / "study.toml"
        path.write_text(STUDY.replace("case.toml", base))
        return path

    def test_other_things_than_files(self):
        self.refuses(2, "/dev/zero", "device, not a case file", "run", "/dev/zero")
        path = self.folder / "socket"
        with socket.socket(socket.AF_UNIX) as server:
            server.bind(str(path))
            self.refuses(2, path, "socket, not a case file", "run", path)
        pipe, end = os.pipe()
        self.addCleanup(os.close, pipe)
        self.addCleanup(os.close, end)
        done = run("check", f"/dev/fd/{pipe}", timeout=SOON, pass_fds=(pipe,))
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("is a FIFO, not a case file (allowed: a regular file: what a pipe gives is to "
                      "be written into one)", done.stderr)

    def test_files_of_a_run(self):
        whole = self.make("whole")
        for name in ("checkpoint.h5", "history.csv", "contact.csv", "results.h5"):
            shutil.copytree(whole, self.out)
            path = self.fifo(self.out / name)
            self.refuses(4, path, "FIFO, not a regular file", "run", self.case(TEXT), "-o", self.out,
                         "--resume", "--set", "time.end=0.004")
            shutil.rmtree(self.out)
        for name in ("run.json", "results.h5"):
            shutil.copytree(whole, self.out)
            path = self.fifo(self.out / name)
            self.refuses(4, path, "FIFO, not a regular file", "pod", self.out)
            shutil.rmtree(self.out)
        shutil.copytree(whole, self.out)
        self.fifo(self.out / "run.json")
        done = run("run", self.case(TEXT), "-o", self.out, "--overwrite", timeout=SOON)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(summary(self.out)["status"], "done")

    def test_a_table_that_is_to_be_written(self):
        self.out.mkdir()
        path = self.fifo(self.out / "contact.csv")
        self.refuses(4, path, "FIFO, not a regular file", "run", self.case(TEXT), "-o", self.out)

    def test_a_reduced_wheel(self):
        path = self.fifo(self.folder / "wheel.h5")
        self.refuses(4, path, "FIFO, not a regular file", "run", self.case(TEXT), "-o", self.out,
                     "--reduced", path)

    def test_sweeps_and_shards(self):
        self.case(TEXT)
        study = self.study("case.toml")
        done = run("sweep", study, "-o", self.out, "--shard", "1/2", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = self.fifo(next(self.out.rglob("rows.json")))
        self.refuses(4, rows, "FIFO, not a regular file", "sweep", study, "-o", self.out,
                     "--collect")
        self.refuses(4, rows, "FIFO, not a regular file", "sweep", study, "-o", self.out, "--shard",
                     "1/2", "--resume")
        other = self.folder / "other"
        other.mkdir()
        record = self.fifo(other / "sweep.json")
        self.refuses(4, record, "FIFO, not a regular file", "sweep", study, "-o", other, "--resume")


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""Room for a run: memory and disk are asked for before anything is made or written, and a disk or
folder that is lost in mid-run ends it with exit code 4 and files that can be read.

A full disk is a small file system of its own (tmpfs) where this user may mount one, itself or in a
name space of its own; else the limit of a file's size stands in for it. Which of them is said."""
import os
import re
import resource
import shutil
import subprocess
import sys
import time
import unittest

import h5py
import numpy as np

from program import LEDGE, PROGRAM, ProgramTest, SANITIZED, SMALL, replaced, run, summary

LONG = replaced(SMALL, "end", "end = 500.0").replace("snapshots = 11", "snapshots = 200")
MEGA = 1_000_000


def started(case, out, **options):
    """A run that writes rows."""
    process = subprocess.Popen([PROGRAM, "run", str(case), "-o", str(out), "--quiet"],
                               stderr=subprocess.PIPE, text=True, **options)
    path = out / "history.csv"
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline:
        if path.exists() and path.stat().st_size > 5000:
            return process
        time.sleep(0.01)
    process.kill()
    raise AssertionError("the run did not start: " + process.communicate()[1])


def fill(file):
    """Writes until there is no room."""
    descriptor = os.open(file, os.O_WRONLY | os.O_CREAT, 0o600)
    try:
        while True:
            os.write(descriptor, bytes(4096))
    except OSError:
        os.close(descriptor)


class DiskTest(ProgramTest):
    def assert_ended(self, process, name):
        """Exit 4, one line that names the file or folder."""
        said = process.communicate(timeout=120)[1]
        self.assertEqual(process.returncode, 4, said)
        self.assertEqual(len(said.splitlines()), 1, said)
        self.assertIn(str(name), said)

    def assert_readable(self, out):
        s = summary(out)
        self.assertEqual(s["status"], "failed")
        with h5py.File(out / "results.h5") as f:
            times = f["/frame/time"][...]
            n = np.count_nonzero(~np.isnan(times))
            self.assertGreater(n, 0)
            self.assertTrue(np.isfinite(f["/snapshots/displacement"][:n]).all())
        lines = (out / "history.csv").read_text().splitlines()
        self.assertGreater(len(lines), 10)
        self.assertEqual(len(lines[-2].split(",")), len(lines[0].split(",")))
        # What the message says is kept.
        until, snapshots = re.search(r"history\.csv to t = (\S+) s and (\d+) snapshots",
                                     s["message"]).groups()
        self.assertEqual(int(snapshots), n)
        times = [line.split(",")[0] for line in lines[1:]]
        self.assertTrue(any(abs(float(t) / float(until) - 1) < 1e-8 for t in times), until)


@unittest.skipIf(SANITIZED, "a sanitizer maps terabytes, which no such limit allows")
class Memory(ProgramTest):
    LARGE = replaced(replaced(LEDGE, "radial", "radial = 100"), "circumferential",
                     "circumferential = 20000")  # 0.8 GB, or 11 GB with a factor

    def limited(self, what, most, *arguments):
        def limit():
            resource.setrlimit(what, (most, most))

        return run(*arguments, preexec_fn=limit)

    def test_refused_before_it_is_taken(self):
        """By the limit of the address space: what would be taken is far above it."""
        out = self.folder / "out"
        crush = ["--set", "analysis.kind=crush", "--set", "analysis.depth=0.02", "--set",
                 "analysis.increments=4", "--set", "ground.profile=flat"]
        case = self.case(self.LARGE)
        for command in (["run", case, "-o", out], ["check", case], ["modes", case, "-o", out],
                        ["run", case, "-o", out, *crush]):
            with self.subTest(command):
                done = self.limited(resource.RLIMIT_AS, 1100 * MEGA, *command)
                self.assertEqual(done.returncode, 2, done.stderr)
                for fragment in ("memory", "ulimit -v", "MB", "disk.mesh.circumferential"):
                    self.assertIn(fragment, done.stderr)
                self.assertFalse(out.exists())

    def test_limit_of_data(self):
        done = self.limited(resource.RLIMIT_DATA, 400 * MEGA, "check", self.case(self.LARGE))
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("ulimit -d", done.stderr)

    def test_what_is_left_is_enough_or_said_to_be_too_little(self):
        """No limit brings a crash or a run that hangs."""
        for most in range(150, 1000, 100):
            out = self.folder / f"out-{most}"
            done = self.limited(resource.RLIMIT_AS, most * MEGA, "run", self.case(), "-o", out,
                                "--quiet")
            if done.returncode == 127:  # not even its libraries
                continue
            self.assertIn(done.returncode, (0, 2), done.stderr)
            self.assertEqual(out.exists(), done.returncode == 0)
        self.assertEqual(done.returncode, 0)


class Disk(DiskTest):
    def test_check_tells_what_a_run_writes(self):
        for text in (SMALL, replaced(SMALL, "end", "end = 2.0"),
                     SMALL.replace("snapshots = 11", "snapshots = 0\nhistory_interval = 0")):
            case, out = self.case(text), self.folder / "out"
            said = [line for line in run("check", case).stdout.splitlines()
                    if line.startswith("disk")][0].split()
            estimate = float(said[2]) * {"kB": 1e3, "MB": 1e6}[said[3]]
            self.assertEqual(run("run", case, "-o", out, "--overwrite").returncode, 0)
            written = sum(p.stat().st_size for p in out.iterdir())
            # A checkpoint is counted twice, and small files by what they take at the most.
            self.assertGreater(estimate, written)
            self.assertLess(estimate, 1.5 * written + 0.2e6)

    def test_too_little_is_refused(self):
        out = self.folder / "out"
        text = LEDGE.replace("snapshots = 400", "snapshots = 1000000")
        text = replaced(text, "end", "end = 1000.0")  # 250 GB and more
        free = shutil.disk_usage(self.folder).free
        if free > 200e9:
            text = replaced(text, "radial", "radial = 1200")
        done = run("run", self.case(text), "-o", out, "--quiet")
        self.assertEqual(done.returncode, 4, done.stderr)
        for fragment in ("disk full", "needs about", "free", "nothing was written"):
            self.assertIn(fragment, done.stderr)
        self.assertFalse(out.exists())

    def test_limit_of_a_file(self):
        out = self.folder / "out"

        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (MEGA, MEGA))

        done = run("run", self.case(LEDGE), "-o", out, "--quiet", preexec_fn=limit)
        self.assertEqual(done.returncode, 4, done.stderr)
        for fragment in ("ulimit -f", "1 MB", "nothing was written"):
            self.assertIn(fragment, done.stderr)
        self.assertFalse(out.exists())

    def test_a_folder_that_is_removed(self):
        """Files of the run live on without a name; the end finds no folder for run.json."""
        out = self.folder / "out"
        process = started(self.case(replaced(LONG, "end", "end = 20.0")), out)
        while out.exists():  # the run may make a file between the listing and the removal
            shutil.rmtree(out, ignore_errors=True)
        self.assert_ended(process, out)
        self.assertFalse(out.exists())

    def test_a_folder_that_may_not_be_written(self):
        if os.geteuid() == 0:
            self.skipTest("root may write everywhere")
        locked = self.folder / "locked"
        locked.mkdir(mode=0o555)
        done = run("run", self.case(), "-o", locked / "out", "--quiet")
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn(str(locked / "out"), done.stderr)

    def test_no_folder_for_results(self):
        for place in ("/proc/rondo-results", "/dev/null/results"):
            done = run("run", self.case(), "-o", place, "--quiet")
            self.assertEqual(done.returncode, 4, done.stderr)
            self.assertIn(place, done.stderr)


class FullDisk(DiskTest):
    """On a file system of 4 MB, most of which something else takes while the run goes on."""
    SIZE = 4 * 1024 * 1024

    def mounted(self):
        """A small file system, and how it was had; None: by no way."""
        place = self.folder / "small"
        place.mkdir()
        words = ["mount", "-t", "tmpfs", "-o", f"size={self.SIZE}", "tmpfs", str(place)]
        if subprocess.run(words, capture_output=True).returncode != 0:
            return None
        self.addCleanup(subprocess.run, ["umount", "-l", str(place)], capture_output=True)
        return place

    def test_a_file_system_that_fills_up(self):
        place = self.mounted()
        if place is None and not inside():
            again = subprocess.run(["unshare", "-rm", sys.executable, __file__, "--inside",
                                    self.id().split(".", 1)[1]], capture_output=True, text=True)
            if "INSIDE" in again.stderr:
                print("full disk: a tmpfs in a name space of its own", file=sys.stderr)
                self.assertEqual(again.returncode, 0, again.stderr)
                return
        if place is None:
            print("full disk: NO FILE SYSTEM MAY BE MOUNTED HERE, so a limit of file sizes stands "
                  "in for it", file=sys.stderr)
            return self.by_a_limit()
        print("full disk: a tmpfs of 4 MB", file=sys.stderr)
        self.on_a_small_file_system(place)

    def on_a_small_file_system(self, place):
        out = place / "out"
        text = LONG.replace("snapshots = 200", "snapshots = 5\nhistory_interval = 0.25\nstress = false")
        process = started(self.case(text), out)
        fill(place / "other")
        self.assert_ended(process, out)
        self.assert_readable(out)
        self.assertIn("space", summary(out)["message"])
        # The same case does not begin where there is no room for it.
        (place / "other").unlink()
        done = run("run", self.case(LEDGE), "-o", place / "again", "--quiet")
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("disk full", done.stderr)
        self.assertFalse((place / "again").exists())

    def test_overwrite_counts_what_it_will_remove(self):
        """More than half of the file system: it has room once."""
        place = self.mounted()
        if place is None:
            self.skipTest("no file system may be mounted here")
        text = replaced(SMALL, "radial", "radial = 6").replace("snapshots = 11", "snapshots = 75")
        for _ in range(2):
            done = run("run", self.case(text), "-o", place / "out", "--quiet", "--overwrite")
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreater((place / "out" / "results.h5").stat().st_size, 0.5 * self.SIZE)
        done = run("run", self.case(text), "-o", place / "second", "--quiet")
        self.assertEqual(done.returncode, 4, done.stderr)

    def by_a_limit(self):
        out = self.folder / "out"
        process = started(self.case(LONG), out)
        most = (out / "history.csv").stat().st_size + 20000
        resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (most, most))
        self.assert_ended(process, "history.csv")
        self.assert_readable(out)


def inside():
    return "--inside" in sys.argv


if __name__ == "__main__":
    if inside():
        print("INSIDE", file=sys.stderr)
        sys.argv.remove("--inside")
    unittest.main()

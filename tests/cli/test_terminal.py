# SPDX-License-Identifier: BSD-3-Clause
"""What may happen around a run: a terminal that closes, outputs that are closed or that nobody
reads any more, a clock that jumps."""
import os
import pty
import select
import signal
import subprocess
import time
import unittest

import h5py
import numpy as np

from program import PROGRAM, ProgramTest, SMALL, history, replaced, summary

CLOCK = os.environ.get("RONDO_JUMPING_CLOCK", "")
LONG = replaced(SMALL, "end", "end = 500.0").replace("snapshots = 11", "snapshots = 100000")


def same_results(test, a, b):
    """history.csv, contact.csv and all of results.h5, bit by bit."""
    for name in ("history.csv", "contact.csv", "fields.xdmf"):
        test.assertEqual((a / name).read_bytes(), (b / name).read_bytes(), name)
    with h5py.File(a / "results.h5") as f, h5py.File(b / "results.h5") as g:
        names = []
        f.visititems(lambda name, o: names.append(name) if isinstance(o, h5py.Dataset) else None)
        test.assertGreater(len(names), 10)
        for name in names:
            test.assertEqual(f[name][...].tobytes(), g[name][...].tobytes(), name)


class Terminal(ProgramTest):
    def test_a_terminal_that_closes_interrupts_the_run(self):
        out = self.folder / "out"
        case = self.case(LONG)
        child, master = pty.fork()
        if child == 0:  # with the terminal as its own: closing it sends SIGHUP
            os.execv(PROGRAM, [PROGRAM, "run", str(case), "-o", str(out)])
        drawn = b""
        deadline = time.monotonic() + 60
        while b"\r[" not in drawn and time.monotonic() < deadline:  # its bar
            if select.select([master], [], [], 1)[0]:
                drawn += os.read(master, 4096)
        self.assertIn(b"\r[", drawn)
        while history_size(out) < 20000 and time.monotonic() < deadline:
            if select.select([master], [], [], 0.05)[0]:
                drawn = os.read(master, 4096)
        os.close(master)
        status = waited(child)
        self.assertTrue(os.WIFEXITED(status), status)
        self.assertEqual(os.WEXITSTATUS(status), 130)
        s = summary(out)
        self.assertEqual(s["status"], "interrupted")
        with h5py.File(out / "results.h5") as f:
            self.assertEqual(len(f["/frame/time"]), s["snapshots"])
            self.assertFalse(np.isnan(f["/frame/time"][:]).any())
        self.assertAlmostEqual(history(out)["time_s"][-1], s["end_time"], places=12)

    def test_nohup_runs_on(self):
        """A SIGHUP that was ignored before the start stays ignored."""
        out = self.folder / "out"
        text = replaced(SMALL, "end", "end = 5.0")
        process = subprocess.Popen(
            [PROGRAM, "run", str(self.case(text)), "-o", str(out), "--quiet"],
            preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        deadline = time.monotonic() + 60
        while history_size(out) == 0 and time.monotonic() < deadline:
            time.sleep(0.01)
        process.send_signal(signal.SIGHUP)
        self.assertEqual(process.wait(timeout=60), 0)
        self.assertEqual(summary(out)["status"], "done")

    def test_closed_from_the_start(self):
        """Without stdout, stderr or both: their descriptors must not become those of the files."""
        whole = self.folder / "whole"
        self.run_in_shell(whole, "")
        for number, closed in enumerate((">&-", "2>&-", ">&- 2>&-", "<&- >&- 2>&-")):
            with self.subTest(closed):
                out = self.folder / f"out-{number}"
                self.run_in_shell(out, closed)
                same_results(self, whole, out)

    def run_in_shell(self, out, redirections):
        done = subprocess.run(
            ["sh", "-c", f'"$0" run "$1" -o "$2" {redirections}', PROGRAM,
             str(self.case()), str(out)], capture_output=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(summary(out)["status"], "done")

    def test_a_reader_that_goes_away(self):
        """The bar and the log of a run are not its results: it goes on. A table that was asked for
        on stdout and cannot be written is exit 4."""
        out = self.folder / "out"
        reader, writer = os.pipe()
        process = subprocess.Popen([PROGRAM, "run", str(self.case()), "-o", str(out)],
                                   stdout=writer, stderr=writer)
        os.close(writer)
        os.close(reader)
        self.assertEqual(process.wait(timeout=60), 0)
        self.assertEqual(summary(out)["status"], "done")
        reader, writer = os.pipe()
        os.close(reader)
        done = subprocess.run([PROGRAM, "check", str(self.case())], stdout=writer,
                              stderr=subprocess.PIPE, text=True, timeout=60)
        os.close(writer)
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("standard output", done.stderr)

    @unittest.skipUnless(CLOCK, "no clock that jumps: RONDO_JUMPING_CLOCK is not set, or sanitizers are in")
    def test_a_clock_that_jumps(self):
        """Days to and fro at each look: the same results, and times that are none of the clock's."""
        plain, jumping = self.folder / "plain", self.folder / "jumping"
        for out, preload in ((plain, None), (jumping, CLOCK)):
            environment = dict(os.environ)
            if preload:
                environment["LD_PRELOAD"] = preload
            done = subprocess.run([PROGRAM, "run", str(self.case()), "-o", str(out)],
                                  env=environment, capture_output=True, text=True, timeout=120)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertNotIn("jumping", done.stderr.replace(str(out), ""))  # it could be loaded
        same_results(self, plain, jumping)
        s = summary(jumping)
        for key in ("loop_wall_s", "loop_cpu_s", "total_wall_s"):
            self.assertGreaterEqual(s[key], 0.0)
            self.assertLess(s[key], 120.0)

    @unittest.skipUnless(CLOCK, "no clock that jumps: RONDO_JUMPING_CLOCK is not set, or sanitizers are in")
    def test_the_clock_does_jump(self):
        look = "import time; print(abs(time.time() - time.time()))"
        done = subprocess.run(["/usr/bin/python3", "-c", look], capture_output=True, text=True,
                              env=dict(os.environ, LD_PRELOAD=CLOCK), timeout=60)
        self.assertGreater(float(done.stdout), 86400.0)


def history_size(out):
    path = out / "history.csv"
    return path.stat().st_size if path.exists() else 0


def waited(child, seconds=60):
    """Status of a child; killed where it does not end."""
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        ended, status = os.waitpid(child, os.WNOHANG)
        if ended:
            return status
        time.sleep(0.05)
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    raise AssertionError("the run did not end")


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""rondo run --resume: runs that were killed, interrupted or finished go on to the same bits as runs
that were left alone; what is not the same run is refused; one program at a time in a directory."""
import os
import random
import shutil
import signal
import subprocess
import time
import unittest

import h5py
import numpy as np

from program import PROGRAM, ROOT, ProgramTest, SMALL, replaced, run, summary
from test_solid import WHEEL
from vtkhdf_layout import Layout

RESULTS = ("history.csv", "contact.csv", "results.h5", "fields.xdmf", "fields.vtkhdf",
           "case.toml")
# Some seconds of steps, a checkpoint every few hundred of them.
LONG = replaced(replaced(SMALL, "end", "end = 12.0"), "snapshots",
                "snapshots = 101\nhistory_interval = 1e-3\ncheckpoint_interval = 0.02\n"
                '[[output.probe]]\nname = "top"\nposition = [0.0, 0.29]')
# Nothing holds the ring: the general integrator, contacts that share nodes.
RING = """schema = 1
title = "a free ring over a sharp corner"
[disk]
outer_radius = 0.3
inner_radius = 0.15
rim = "free"
[disk.mesh]
radial = 3
circumferential = 60
[material]
youngs_modulus = 2.0e6
poissons_ratio = 0.3
density = 1100.0
[damping]
stiffness = 1.0e-5
[motion]
gravity = 9.81
[ground]
profile = [[-10, 0.0], [0.05, 0.0], [0.1, -0.02], [10, -0.02]]
friction = 0.5
[initial]
position = [0.0, 0.31]
velocity = [2.0, -1.0]
[time]
end = 0.6
[output]
snapshots = 21
checkpoint_interval = 0.02
"""


class ResumeTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.whole = self.folder / "whole"
        self.out = self.folder / "out"

    def start(self, text, *extra):
        """The run into self.out, with --resume."""
        return subprocess.Popen([PROGRAM, "run", str(self.case(text)), "-o", str(self.out),
                                 "--resume", "--quiet", *extra], stderr=subprocess.DEVNULL)

    def rows(self):
        try:
            return (self.out / "history.csv").read_bytes().count(b"\n")
        except FileNotFoundError:
            return 0

    def wait_for_rows(self, process, rows):
        """Until history.csv has so many; false where the run ends before."""
        deadline = time.time() + 100
        while self.rows() < rows:
            if process.poll() is not None:
                return False
            self.assertLess(time.time(), deadline, "the run does not go on")
            time.sleep(0.002)
        return True

    def assert_same(self, other, names=RESULTS):
        for name in names:
            self.assertEqual((self.whole / name).read_bytes(), (other / name).read_bytes(), name)

    def change_status(self, old, new):
        text = (self.out / "run.json").read_text()
        self.assertIn(f'"{old}"', text)
        (self.out / "run.json").write_text(text.replace(f'"{old}"', f'"{new}"', 1))

    def leave_alone(self, text, *extra):
        done = run("run", self.case(text), "-o", self.whole, "--quiet", *extra)
        self.assertEqual(done.returncode, 0, done.stderr)

    def resume(self, text, *extra):
        return run("run", self.case(text), "-o", self.out, "--resume", *extra)

    def assert_refused(self, done, code, *texts):
        self.assertEqual(done.returncode, code, done.stderr)
        for text in texts:
            self.assertIn(text, done.stderr)


class Killed(ResumeTest):
    def kill_at_random_moments(self, text, kills, seed):
        """Kills soon after the start (setting up, copying what is kept) and far into the steps."""
        chance = random.Random(seed)
        total = (self.whole / "history.csv").read_bytes().count(b"\n")
        for k in range(kills):
            process = self.start(text)
            if k % 4 == 0:
                time.sleep(chance.uniform(0.0, 0.2))
            else:
                more = chance.uniform(0.0, 2.0) * total / kills
                self.assertTrue(self.wait_for_rows(process, min(self.rows() + more, total - 2)),
                                f"kill {k} came too late")
                time.sleep(chance.uniform(0.0, 0.01))
            process.kill()
            process.wait()
            self.assert_readable()

    def assert_readable(self):
        """Every file that is there, up to what was last written."""
        if (self.out / "run.json").exists():
            self.assertIn(summary(self.out)["status"], ("running", "done"))
        if (self.out / "results.h5").exists():
            with h5py.File(self.out / "results.h5") as f:
                t = f["/frame/time"][:]
                written = np.count_nonzero(~np.isnan(t))
                self.assertTrue(np.isfinite(f["/snapshots/displacement"][:written]).all())
        if (self.out / "checkpoint.h5").exists():
            with h5py.File(self.out / "checkpoint.h5") as f:
                self.assertGreater(f["/run/steps_done"][0], 0)
        if (self.out / "history.csv").exists():
            lines = (self.out / "history.csv").read_text().splitlines(keepends=True)
            for line in lines[1:]:  # the last one may be in the middle of being written
                if line.endswith("\n"):
                    self.assertEqual(line.count(","), lines[0].count(","))
                    float(line.split(",")[0])
        if (self.out / "fields.xdmf").exists():
            self.assertTrue((self.out / "fields.xdmf").read_text().rstrip().endswith("</Xdmf>"))
        if (self.out / "fields.vtkhdf").exists():
            Layout(self.out / "fields.vtkhdf")

    def test_at_20_random_moments_it_goes_on_to_the_same_bits(self):
        self.leave_alone(LONG)
        self.kill_at_random_moments(LONG, 20, seed=7)
        done = self.resume(LONG)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_same(self.out)
        s, alone = summary(self.out), summary(self.whole)
        self.assertGreater(len(s["resumed_at_steps"]), 3)
        self.assertEqual(s["resumed_at_steps"], sorted(s["resumed_at_steps"]))
        for key in ("status", "steps_done", "energy_residual_relative", "energy_exchanged",
                    "contact_residual_max", "penetration_max_m", "contact", "snapshots"):
            self.assertEqual(s[key], alone[key], key)

    def test_a_free_body_goes_on_to_the_same_bits(self):
        self.leave_alone(RING)
        self.kill_at_random_moments(RING, 5, seed=11)
        self.assertEqual(self.resume(RING).returncode, 0)
        self.assert_same(self.out)
        self.assertGreater(summary(self.out)["contact"]["clusters_solved"], 0)

    def test_two_parts_go_on_to_the_same_bits(self):
        text = replaced(LONG, "end", 'end = 3.0\nscheme = "hati"') + (
            "\n[solver.hati]\nratio = 2\nfine = {layers = [4, 5, 6]}\n")
        text = replaced(replaced(text, "radial", "radial = 6"), "circumferential",
                        "circumferential = 60")
        self.leave_alone(text)
        self.kill_at_random_moments(text, 5, seed=13)
        self.assertEqual(self.resume(text).returncode, 0)
        self.assert_same(self.out)
        self.assertGreater(len(summary(self.out)["resumed_at_steps"]), 0)

    def test_before_the_first_checkpoint_it_begins_anew(self):
        text = LONG.replace("checkpoint_interval = 0.02", "checkpoint_interval = 1000")
        process = self.start(text)
        self.assertTrue(self.wait_for_rows(process, 100))
        process.kill()
        process.wait()
        self.assertEqual(summary(self.out)["status"], "running")
        other = self.resume(replaced(text, "friction", "friction = 0.4"))
        self.assertEqual(other.returncode, 2, other.stderr)
        self.assertIn("another case, cut off before its first checkpoint", other.stderr)
        self.leave_alone(text)
        self.assertEqual(self.resume(text).returncode, 0)
        self.assert_same(self.out)
        self.assertNotIn("resumed_at_steps", summary(self.out))


    def test_while_it_is_prolonged_it_goes_on_by_its_directory(self):
        short = replaced(LONG, "end", "step = 5.0e-5\nend = 1.0").replace("snapshots = 101",
                                                                         "snapshots = 11")
        short = short.replace("checkpoint_interval = 0.02", "checkpoint_interval = 1000")
        later = "time.end=6.0"
        self.leave_alone(short, "--set", later, "--set", "output.snapshots=61")
        self.assertEqual(self.resume(short).returncode, 0)
        rows = self.rows()
        process = subprocess.Popen([PROGRAM, "run", str(self.out), "--resume", "--quiet", "--set",
                                    later], stderr=subprocess.DEVNULL)
        self.assertTrue(self.wait_for_rows(process, rows + 100))
        process.kill()
        process.wait()
        self.assertIn("snapshots = 61", (self.out / "case.toml").read_text())
        done = run("run", self.out, "--resume")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_same(self.out)

    def test_while_its_files_are_made_they_can_be_read(self):
        """Or are not there yet."""
        text = replaced(LONG, "snapshots", "snapshots = 20000")
        seen = 0
        for wait in (0.0, 0.001, 0.003, 0.01, 0.02, 0.03):
            shutil.rmtree(self.out, ignore_errors=True)
            process = self.start(text)
            deadline = time.time() + 60
            while not any(self.out.glob("results.h5*")):
                self.assertIsNone(process.poll(), "the run has ended")
                self.assertLess(time.time(), deadline)
                time.sleep(0.0002)
            time.sleep(wait)
            process.kill()
            process.wait()
            seen += (self.out / "results.h5.new").exists() or (self.out / "results.h5").exists()
            self.assert_readable()
        self.assertGreater(seen, 0)

    def test_a_mesh_in_the_directory_stays(self):
        """Begun anew by the directory alone, before there is a checkpoint."""
        case = ROOT / "cases" / "tyre-section.toml"
        short = ("--set", "time.end=1e-4", "--set", "output.snapshots=2")
        done = run("run", case, "-o", self.out, *short)
        self.assertEqual(done.returncode, 0, done.stderr)
        mesh = (self.out / "mesh.msh").read_bytes()
        (self.out / "checkpoint.h5").unlink()
        for status in ("running", "failed"):
            self.change_status("done", status)
            done = run("run", self.out, "--resume")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual((self.out / "mesh.msh").read_bytes(), mesh)
            self.assertIn('file = "mesh.msh"', (self.out / "case.toml").read_text())
            (self.out / "checkpoint.h5").unlink()

    def test_what_a_killed_program_left_beside_is_cleared(self):
        self.assertEqual(self.resume(Finished.TEXT).returncode, 0)
        (self.out / "run.json.4711.tmp").write_text("{")
        (self.out / "mine.tmp").write_text("mine")
        self.change_status("done", "running")
        self.assertEqual(self.resume(Finished.TEXT).returncode, 0)
        self.assertFalse((self.out / "run.json.4711.tmp").exists())
        self.assertTrue((self.out / "mine.tmp").exists())


class Interrupted(ResumeTest):
    def test_with_other_threads_and_operator_the_same_bits(self):
        for operator in ("cyclic", "sparse"):
            text = LONG + f'[solver]\noperator = "{operator}"\n'
            text = replaced(text, "end", "end = 6.0")
            for folder in (self.out, self.whole):
                shutil.rmtree(folder, ignore_errors=True)
            self.leave_alone(text)
            for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
                process = self.start(text, "--threads", "2")
                self.assertTrue(self.wait_for_rows(process, self.rows() + 200))
                process.send_signal(number)
                self.assertEqual(process.wait(timeout=60), 130)
                self.assertEqual(summary(self.out)["status"], "interrupted")
            self.assertEqual(self.resume(text, "--threads", "1").returncode, 0)
            self.assert_same(self.out)

    def test_the_checkpoint_holds_the_last_step(self):
        process = self.start(LONG.replace("checkpoint_interval = 0.02",
                                          "checkpoint_interval = 1000"))
        self.assertTrue(self.wait_for_rows(process, 100))
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(timeout=60), 130)
        with h5py.File(self.out / "checkpoint.h5") as f:
            self.assertEqual(f["/run/steps_done"][0], summary(self.out)["steps_done"])
            self.assertEqual(f["/run/step"].attrs["units"], "s")


class Finished(ResumeTest):
    # A step that is told: the ends are whole numbers of steps, and of snapshot intervals.
    TEXT = replaced(SMALL, "end", "step = 5.0e-5\nend = 0.01")

    def test_goes_on_to_a_later_end(self):
        text = replaced(self.TEXT, "snapshots", "snapshots = 6\nhistory_interval = 3.3e-4")
        later = ("--set", "time.end=0.02")
        self.leave_alone(text, *later, "--set", "output.snapshots=11")
        self.assertEqual(self.resume(text).returncode, 0)
        done = self.resume(text, *later)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("resumed from step 200", done.stderr)
        self.assert_same(self.out)

    def test_a_directory_without_resume_says_what_to_give(self):
        self.assertEqual(self.resume(self.TEXT).returncode, 0)
        done = run("run", self.out)
        self.assertEqual(done.returncode, 2)
        self.assertIn("--resume", done.stderr)

    def test_the_directory_alone_is_enough(self):
        self.assertEqual(self.resume(self.TEXT).returncode, 0)
        done = run("run", self.out, "--resume", "--set", "time.end=0.02")
        self.assertEqual(done.returncode, 0, done.stderr)
        again = run("run", self.out, "--resume", "--set", "time.end=0.03")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(summary(self.out)["resumed_at_steps"], [200, 400])
        with h5py.File(self.out / "results.h5") as f:
            np.testing.assert_allclose(f["/frame/time"][:], np.arange(31) * 1e-3, atol=1e-12)

    def test_with_nothing_left_to_do_nothing_is_touched(self):
        self.assertEqual(self.resume(self.TEXT).returncode, 0)
        before = {p.name: (p.stat().st_mtime_ns, p.stat().st_ino) for p in self.out.iterdir()}
        done = self.resume(self.TEXT)
        self.assertEqual(done.returncode, 0)
        self.assertIn("nothing to do", done.stderr)
        after = {p.name: (p.stat().st_mtime_ns, p.stat().st_ino) for p in self.out.iterdir()}
        self.assertEqual(before, after)

    def test_with_nothing_left_to_do_no_room_is_needed(self):
        self.assertEqual(self.resume(self.TEXT).returncode, 0)
        done = subprocess.run(["bash", "-c", 'ulimit -f 1; exec "$@"', "-", PROGRAM, "run",
                               str(self.out), "--resume"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_prolonged_run_is_estimated_as_it_will_be(self):
        text = replaced(self.TEXT, "snapshots", "snapshots = 6")
        self.assertEqual(self.resume(text).returncode, 0)
        before = {p.name: p.read_bytes() for p in self.out.iterdir()}
        done = subprocess.run(["bash", "-c", 'ulimit -f 2000; exec "$@"', "-", PROGRAM, "run",
                               str(self.out), "--resume", "--set", "time.end=10"],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("nothing was written", done.stderr)
        self.assertEqual({p.name: p.read_bytes() for p in self.out.iterdir()}, before)

    def test_killed_between_the_last_checkpoint_and_the_end_it_is_finished(self):
        text = replaced(self.TEXT, "snapshots", "snapshots = 6\nhistory_interval = 3.3e-4")
        self.leave_alone(text)
        self.assertEqual(self.resume(text).returncode, 0)
        self.change_status("done", "running")
        rows = (self.out / "history.csv").read_text().splitlines(keepends=True)
        (self.out / "history.csv").write_text("".join(rows[:-1]))  # the row of the end is not due
        self.assertEqual(self.resume(text).returncode, 0)
        self.assert_same(self.out)
        self.assertEqual(summary(self.out)["status"], "done")
        self.assertEqual(summary(self.out)["energy_residual_relative"],
                         summary(self.whole)["energy_residual_relative"])


class Refused(ResumeTest):
    TEXT = Finished.TEXT

    def test_another_case_with_all_that_differs(self):
        self.assertEqual(self.resume(self.TEXT).returncode, 0)
        other = replaced(self.TEXT, "friction", "friction = 0.4\nrestitution = 0.1\n"
                         "impact = \"energy-safe\"")
        self.assert_refused(self.resume(other, "--set", "disk.mesh.radial=4"), 2,
                            f"{self.out / 'checkpoint.h5'}: ground.friction = 0.4",
                            "(allowed: 0.3; or --overwrite",
                            "ground.restitution = 0.1", "ground.impact = \"energy-safe\"",
                            "disk.mesh.radial = 4", "4 errors")
        no_ground = self.TEXT[: self.TEXT.index("[ground]")] + self.TEXT[self.TEXT.index("[time]"):]
        self.assert_refused(self.resume(no_ground), 2, "ground.friction = nothing",
                            "the run to resume has a value")

    def test_an_end_that_lies_behind(self):
        self.assertEqual(self.resume(self.TEXT).returncode, 0)
        self.assert_refused(self.resume(self.TEXT, "--set", "time.end=0.005"), 2,
                            "time.end = 0.005", "the run has come to t = 0.01 s")

    def test_other_kernels(self):
        self.assertEqual(self.resume(self.TEXT).returncode, 0)
        level = summary(self.out)["dispatch"]
        if level == "baseline":
            self.skipTest("this machine has but one instruction set")
        done = run("run", self.case(self.TEXT), "-o", self.out, "--resume", "--set",
                   "time.end=0.02", env={**os.environ, "RONDO_DISPATCH": "baseline"})
        self.assert_refused(done, 2, "kernels baseline", f"RONDO_DISPATCH={level}")

    def test_a_damaged_checkpoint(self):
        self.assertEqual(self.resume(self.TEXT).returncode, 0)
        path = self.out / "checkpoint.h5"
        content = bytearray(path.read_bytes())
        content[len(content) // 2] ^= 1
        path.write_bytes(content)
        self.assert_refused(self.resume(self.TEXT), 4, "checkpoint.h5: is damaged")

    def test_results_that_hold_less_than_the_checkpoint_says(self):
        self.assertEqual(self.resume(self.TEXT).returncode, 0)
        kept = self.folder / "kept"
        shutil.copytree(self.out, kept)
        for name in ("history.csv", "contact.csv", "results.h5"):
            (self.out / name).write_bytes((kept / name).read_bytes()[:-50])
            self.assert_refused(self.resume(self.TEXT, "--set", "time.end=0.02"), 4, name)
            shutil.copyfile(kept / name, self.out / name)
        self.assertEqual(self.resume(self.TEXT, "--set", "time.end=0.02").returncode, 0)

    def test_another_mesh_of_the_same_name(self):
        text = (ROOT / "cases" / "tyre-section.toml").read_text()
        for path in (ROOT / "cases" / "meshes").glob("*.msh"):
            (self.folder / "meshes").mkdir(exist_ok=True)
            shutil.copy(path, self.folder / "meshes")
        short = ("--set", "time.end=1e-4", "--set", "output.snapshots=2")
        done = self.resume(text, *short)
        self.assertEqual(done.returncode, 0, done.stderr)
        name = [line.split('"')[1] for line in text.splitlines() if line.startswith("file")][0]
        mesh = self.folder / name
        entities, nodes = mesh.read_text().split("$Nodes", 1)
        number = next(w for w in nodes.split() if len(w) > 12 and w[6].isdigit())
        moved = number[:6] + str((int(number[6]) + 1) % 10) + number[7:]
        mesh.write_text(entities + "$Nodes" + nodes.replace(number, moved, 1))
        self.assert_refused(self.resume(text, *short, "--set", "time.end=2e-4"), 2, "mesh.file",
                            "is not the mesh that the run began with")

    def test_a_crush_and_contradictions(self):
        self.assert_refused(run("run", ROOT / "cases" / "crush-smooth.toml", "-o", self.out,
                                "--resume"), 2, "a crush has no checkpoints")
        self.assert_refused(self.resume(self.TEXT, "--overwrite"), 2, "--resume")
        self.assertFalse(self.out.exists())
        self.assertEqual(run("run", ROOT / "cases" / "crush-smooth.toml", "-o", self.out, "--set",
                             "analysis.increments=2").returncode, 0)
        self.assert_refused(self.resume(self.TEXT), 2, "a run that keeps no checkpoints")

    def test_the_users_case_file_is_never_replaced(self):
        self.out.mkdir()
        (self.out / "case.toml").write_text("# mine\n" + self.TEXT)
        self.assert_refused(run("run", self.out, "--resume"), 2, "this directory's own case.toml")
        self.assertTrue((self.out / "case.toml").read_text().startswith("# mine"))

    def test_a_mesh_that_lies_there_is_not_taken_for_the_runs(self):
        self.out.mkdir()
        (self.out / "mesh.msh").write_text("half a mesh")
        done = run("run", ROOT / "cases" / "tyre-section.toml", "-o", self.out, "--set",
                   "time.end=1e-4", "--set", "output.snapshots=2")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("$MeshFormat", (self.out / "mesh.msh").read_text())

    def test_an_end_where_it_was_interrupted(self):
        process = self.start(LONG)
        self.assertTrue(self.wait_for_rows(process, 300))
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(timeout=60), 130)
        end = summary(self.out)["end_time"]
        self.assert_refused(self.resume(LONG, "--set", f"time.end={end!r}"), 2, "time.end",
                            "a later end")

    def test_a_file_of_another_format(self):
        self.assertEqual(self.resume(self.TEXT).returncode, 0)
        path = self.out / "checkpoint.h5"
        path.write_bytes(path.read_bytes().replace(b"rondo checkpoint 1", b"rondo checkpoint 9", 1))
        self.assert_refused(self.resume(self.TEXT), 4, "is of another version of rondo",
                            "rondo checkpoint 9")

    def test_a_record_of_another_kind_is_no_failure(self):
        self.assertEqual(self.resume(self.TEXT).returncode, 0)
        text = (self.out / "run.json").read_text()
        (self.out / "run.json").write_text(text.replace("{", '{"resumed_at_steps": 5,', 1))
        done = self.resume(self.TEXT, "--set", "time.end=0.02")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(summary(self.out)["resumed_at_steps"], [200])

    def test_what_has_no_checkpoint(self):
        self.assertEqual(self.resume(self.TEXT).returncode, 0)
        (self.out / "checkpoint.h5").unlink()
        self.assert_refused(self.resume(self.TEXT), 2, "holds a run without a checkpoint")


class Damaged(ResumeTest):
    """What is kept of a run is what was written, to the bit, whether steps are left to do or not."""

    TEXT = Finished.TEXT

    def setUp(self):
        super().setUp()
        self.assertEqual(self.resume(self.TEXT).returncode, 0)
        self.kept = self.folder / "kept"
        shutil.copytree(self.out, self.kept)

    def assert_found(self, *texts):
        before = {path.name: path.read_bytes() for path in self.out.iterdir()}
        for later in ((), ("--set", "time.end=0.02")):
            done = self.resume(self.TEXT, *later)
            self.assert_refused(done, 4, *texts, f"rondo run CASE -o {self.out} --overwrite")
            self.assertNotIn("--resume", done.stderr)
        self.assertEqual({path.name: path.read_bytes() for path in self.out.iterdir()}, before)

    def restore(self, name):
        shutil.copyfile(self.kept / name, self.out / name)

    def test_zeros_in_the_middle_of_tables(self):
        for name in ("history.csv", "contact.csv"):
            content = bytearray((self.kept / name).read_bytes())
            middle = len(content) // 2
            content[middle : middle + 849] = bytes(len(content[middle : middle + 849]))
            line = content[:middle].count(b"\n") + 1
            (self.out / name).write_bytes(content)
            self.assert_found(f"{self.out / name}: line {line}: ")
            self.restore(name)

    def test_another_number_in_a_table(self):
        rows = (self.kept / "history.csv").read_text().splitlines(keepends=True)
        time = rows[7][: rows[7].index(",")]
        rows[7] = "nan," + (len(time) - 3) * "0" + rows[7][len(time) + 1 :]  # of the same length
        (self.out / "history.csv").write_text("".join(rows))
        self.assert_found("history.csv: line 8 holds a number that is not finite",
                          "are not those that were written: damaged")
        rows[7] = "0.1" + rows[7][3:]
        (self.out / "history.csv").write_text("".join(rows))
        self.assert_found("history.csv: its first", "are not those that were written: damaged")

    def test_every_dataset_of_the_snapshots(self):
        with h5py.File(self.out / "results.h5") as f:
            names = [f"{group}/{name}" for group in ("frame", "snapshots", "contact", "fields")
                     for name in f[group]]
        self.assertIn("fields/von_mises", names)
        values = ((np.nan, "not finite in snapshot 3"), (np.inf, "not finite in snapshot 3"),
                  (0.123, "are not what was written"))
        for k, name in enumerate(names):
            value, text = values[k % 3]
            with h5py.File(self.out / "results.h5", "r+") as f:
                f[name][3, ...] = value
            self.assert_found(f"{self.out / 'results.h5'}: ", f"/{name}", text)
            self.restore("results.h5")
        done = self.resume(self.TEXT, "--set", "time.end=0.02")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_wheel_in_three_dimensions(self):
        shutil.rmtree(self.out)
        done = self.resume(WHEEL)
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.out / "results.h5", "r+") as f:
            f["/frame/lateral"][1] = np.nan
        self.assert_refused(self.resume(WHEEL), 4, "/frame/lateral", "not finite in snapshot 1")


class TwoPrograms(ResumeTest):
    def test_the_second_is_refused_while_the_first_lives_and_takes_over_when_it_is_dead(self):
        text = LONG.replace("end = 12.0", "end = 500.0")
        process = self.start(text)
        self.addCleanup(process.kill)
        self.assertTrue(self.wait_for_rows(process, 200))
        self.assertEqual(summary(self.out)["process"], process.pid)
        case = self.case(text)
        for way in ((), ("--resume",), ("--overwrite",)):
            done = run("run", case, "-o", self.out, *way)
            self.assertEqual(done.returncode, 4, done.stderr)
            self.assertIn(f"another rondo is at work here (process {process.pid} on", done.stderr)
        self.assertIsNone(process.poll())
        rows = self.rows()
        self.assertTrue(self.wait_for_rows(process, rows + 100), "the first one goes on")
        process.kill()
        process.wait()
        self.assertEqual(summary(self.out)["status"], "running")
        refused = run("run", case, "-o", self.out)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("--resume to continue it", refused.stderr)
        with h5py.File(self.out / "checkpoint.h5") as f:
            reached = f["/run/steps_done"][0] * f["/run/step"][0]
        done = run("run", case, "-o", self.out, "--resume", "--set", f"time.end={reached + 0.01}")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(summary(self.out)["status"], "done")
        self.assertNotEqual(summary(self.out)["process"], process.pid)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""rondo paper: the quick study from the command line, killed and interrupted on the way, and its table
against numbers computed here from its files."""
import json
import os
import pathlib
import re
import signal
import subprocess
import tempfile
import time
import unittest

import h5py
import numpy as np

from program import PROGRAM, finished, history, paper, run, summary

N_RUNS, N_PODS = 15, 18


def table(folder):
    return {row["name"]: row for row in paper(folder)["table"]}


def stop_midway(folder, number, least):
    """Starts the study, sends it a signal once `least` parts are done; its exit code and stderr."""
    with subprocess.Popen([PROGRAM, "paper", "--quick", "-o", folder], text=True,
                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as study:
        deadline = time.monotonic() + 60
        while finished(folder) < least and study.poll() is None:
            if time.monotonic() > deadline:
                study.kill()
                raise AssertionError(f"only {finished(folder)} parts were done after a minute")
            time.sleep(0.01)
        study.send_signal(number)
        said = study.stderr.read()
    return study.returncode, said


def processes_left(folder):
    """Command lines that name the folder, once none is left or after some seconds."""
    deadline = time.monotonic() + 10
    while True:
        lines = []
        for file in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
            try:
                lines.append(file.read_bytes())
            except OSError:  # it has just ended
                pass
        left = [line for line in lines if str(folder).encode() in line]
        if not left or time.monotonic() > deadline:
            return left
        time.sleep(0.05)


def snapshot_of(folder):
    """Time of the last change of every file of the results."""
    return {file: file.stat().st_mtime_ns for file in (folder / "runs").rglob("*")
            if file.is_file()}


class Study(unittest.TestCase):
    """One study for all tests: killed, interrupted, finished."""

    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.folder = pathlib.Path(holder.name) / "study"
        cls.killed = stop_midway(cls.folder, signal.SIGKILL, 4)
        cls.left_then = processes_left(cls.folder)
        cls.after_kill = paper(cls.folder)
        cls.done_then = finished(cls.folder)
        cls.interrupted = stop_midway(cls.folder, signal.SIGTERM, cls.done_then + 3)
        cls.after_interrupt = paper(cls.folder)
        cls.files_then = snapshot_of(cls.folder)
        cls.last = run("paper", "--quick", "-o", cls.folder)
        cls.once = pathlib.Path(holder.name) / "once"
        cls.whole = run("paper", "--quick", "-o", cls.once, "--jobs", 1)

    def test_1_a_killed_study_leaves_its_record_and_no_child(self):
        self.assertEqual(self.killed[0], -signal.SIGKILL)
        self.assertEqual(self.after_kill["status"], "running")
        self.assertLess(self.done_then, N_RUNS + N_PODS, "it had ended before it was killed")
        self.assertEqual(self.left_then, [])

    def test_2_an_interrupted_study_says_how_to_go_on(self):
        code, said = self.interrupted
        self.assertEqual(code, 130, said)
        self.assertIn("the same command goes on", said)
        # At least those on record: one more may have ended just before the kill, unrecorded.
        there = re.search(rf"(\d+) of {N_RUNS + N_PODS} jobs are there already", said)
        self.assertIsNotNone(there, said)
        self.assertGreaterEqual(int(there[1]), self.done_then)
        self.assertEqual(self.after_interrupt["status"], "interrupted")
        self.assertEqual(self.after_interrupt["table"], [])

    def test_3_it_goes_on_where_it_was(self):
        self.assertEqual(self.last.returncode, 0, self.last.stderr)
        found = paper(self.folder)
        self.assertEqual(found["status"], "done")
        kept = [part["directory"] for part in found["runs"] + found["pods"] if part["kept"]]
        self.assertGreaterEqual(len(kept), self.done_then + 3)
        self.assertLess(len(kept), N_RUNS + N_PODS)
        now = snapshot_of(self.folder)
        for directory in kept:
            for file in (self.folder / directory).iterdir():
                if file.is_file():
                    self.assertEqual(now[file], self.files_then[file], file)

    def test_4_the_same_table_as_at_one_go_one_at_a_time(self):
        self.assertEqual(self.whole.returncode, 0, self.whole.stderr)
        ours, once = table(self.folder), table(self.once)
        self.assertEqual(ours.keys(), once.keys())
        for name, row in ours.items():
            self.assertEqual(row["ours"], once[name]["ours"], name)

    def test_5_every_row_is_as_expected_and_printed(self):
        found = paper(self.once)
        self.assertEqual(found["format"], "rondo paper 1")
        self.assertTrue(found["quick"])
        self.assertEqual((found["passed"], found["failed"]), (len(found["table"]), 0))
        self.assertEqual({row["figure"] for row in found["table"]}, {2, 3, 4, 5, 6})
        for row in found["table"]:
            self.assertTrue(row["pass"], row)
            self.assertTrue(row["source"], row)
            self.assertIn(row["quantity"], self.whole.stdout)
        self.assertIn(f"{len(found['table'])} of {len(found['table'])} as expected",
                      self.whole.stdout)

    def test_6_runs_and_pods_are_all_there_with_their_commands(self):
        found = paper(self.once)
        self.assertEqual((len(found["runs"]), len(found["pods"])), (N_RUNS, N_PODS))
        for entry in found["runs"]:
            self.assertTrue(entry["command"].startswith("rondo run cases/"), entry)
            blows_up = entry["name"] == "spin-up-fast-as-printed"
            self.assertEqual(entry["status"], "failed" if blows_up else "done", entry)
            self.assertEqual(entry["status"], summary(self.once / entry["directory"])["status"])
            self.assertEqual("blown up" in entry.get("message", ""), blows_up)
        for entry in found["pods"]:
            self.assertTrue((self.once / entry["directory"] / "pod.h5").is_file(), entry)
            self.assertTrue(entry["command"].startswith(f"rondo pod {self.once}/runs/"), entry)

    def test_7_a_command_of_the_record_gives_the_same_bits(self):
        entry = [e for e in paper(self.once)["runs"] if e["name"] == "friction-0.2"][0]
        words = entry["command"].split()
        words[words.index("-o") + 1] = str(self.once / "by-hand")
        root = pathlib.Path(__file__).resolve().parents[2]
        self.assertEqual(run(*words[1:], cwd=root).returncode, 0)
        self.assertEqual((self.once / "by-hand" / "history.csv").read_bytes(),
                         (self.once / "runs" / "friction-0.2" / "history.csv").read_bytes())

    def test_8_the_table_is_what_the_files_say(self):
        rows, runs = table(self.once), self.once / "runs"
        # Rows of the history are means over their intervals.
        h = history(runs / "friction-0.2")
        spans = np.diff(h["time_s"], prepend=0)
        late = h["time_s"] - spans >= 0.095
        self.assertAlmostEqual(rows["friction-0.2-force-y"]["ours"],
                               np.average(h["force_y"][late], weights=spans[late]), delta=1e-6)
        # The pitch frequency by an FFT of the rows: within its resolution.
        h = history(runs / "turn-treaded")
        late = h["time_s"] > 0.1
        force = h["force_y"][late] - h["force_y"][late].mean()
        step = (h["time_s"][late][-1] - h["time_s"][late][0]) / (late.sum() - 1)
        lines = np.abs(np.fft.rfft(force * np.hanning(late.sum())))
        frequency = np.fft.rfftfreq(late.sum(), step)
        low = frequency < 500
        self.assertAlmostEqual(rows["treaded-frequency"]["ours"],
                               frequency[low][np.argmax(lines[low])], delta=frequency[1])
        # The edge of the spun-up ring.
        with h5py.File(runs / "spin-up-damped" / "results.h5") as file:
            edge = file["mesh/boundary"][:]
            x = file["mesh/coordinates"][:][edge]
            u = file["snapshots/displacement"][-1][edge]
        radial = np.einsum("ij,ij->i", u, x / np.linalg.norm(x, axis=1)[:, None]).mean()
        self.assertAlmostEqual(rows["damped-closed-form"]["ours"], radial, delta=1e-16)
        self.assertAlmostEqual(rows["damped-closed-form"]["expected"], 1.591599e-4, delta=1e-10)
        # Numbers of modes, from the spectra.
        def modes(name):
            spectrum = np.genfromtxt(runs / name / "spectrum.csv", delimiter=",", names=True)
            return 1 + np.argmax(spectrum["discarded_energy"] <= 1e-4)
        gain = modes("turn-smooth/pod/velocity-rotating") / modes(
            "turn-smooth/pod/velocity-rectified")
        self.assertEqual(rows["smooth-velocity-gain"]["ours"], gain)
        as_crush = rows["treaded-displacement-as-crush"]
        self.assertEqual(as_crush["ours"], modes("turn-treaded/pod/displacement-rectified"))
        self.assertEqual(as_crush["expected"], modes("crush-treaded/pod/displacement-rotating"))
        # Coulomb's law, node by node.
        worst = -1.0
        for friction in ("0.0", "0.2", "0.4", "0.6"):
            with h5py.File(runs / f"friction-{friction}" / "results.h5") as file:
                force = file["contact/force"][:]
            outside = np.abs(force[..., 1]) - float(friction) * force[..., 0]
            worst = max(worst, outside.max() / force[..., 0].max())
        self.assertAlmostEqual(rows["shear-in-cone"]["ours"], worst, delta=1e-20)

    def made_again(self):
        """Directories of what the next call does anew; it ends well."""
        again = run("paper", "--quick", "-o", self.folder)
        self.assertEqual(again.returncode, 0, again.stderr)
        found = paper(self.folder)
        return {part["directory"] for part in found["runs"] + found["pods"] if not part["kept"]}

    def with_pods(self, name):
        runs = pathlib.Path("runs")
        pods = self.folder / runs / name / "pod"
        return {str(runs / name)} | {str(runs / name / "pod" / one.name) for one in pods.glob("*")}

    def test_9_what_is_damaged_or_of_another_case_is_made_again(self):
        runs = self.folder / "runs"
        (runs / "crush-smooth" / "results.h5").unlink()
        case = runs / "friction-0.4" / "case.toml"
        case.write_text(case.read_text().replace("friction = 0.4", "friction = 0.5"))
        (runs / "turn-smooth" / "pod" / "velocity-rectified" / "pod.json").write_text("{")
        self.assertEqual(self.made_again(), self.with_pods("crush-smooth") | {
            "runs/friction-0.4", "runs/turn-smooth/pod/velocity-rectified"})
        self.assertIn("friction = 0.4", case.read_text())
        found = paper(self.folder)
        fast = [e for e in found["runs"] if e["name"] == "spin-up-fast-as-printed"][0]
        self.assertEqual((fast["kept"], fast["status"]), (True, "failed"))

    def test_9_what_is_truncated_is_made_again(self):
        runs = self.folder / "runs"
        os.truncate(runs / "friction-0.6" / "results.h5", 1_000_000)
        os.truncate(runs / "friction-0.2" / "history.csv", 100_000)
        os.truncate(runs / "spin-up-as-printed" / "history.csv", 0)
        os.truncate(runs / "turn-treaded" / "pod" / "contact-rotating" / "pod.h5", 10)
        os.truncate(runs / "turn-treaded" / "pod" / "contact-rectified" / "spectrum.csv", 0)
        self.assertEqual(self.made_again(), {
            "runs/friction-0.6", "runs/friction-0.2", "runs/spin-up-as-printed",
            "runs/turn-treaded/pod/contact-rotating", "runs/turn-treaded/pod/contact-rectified"})

    def test_9_results_of_another_program_are_made_again(self):
        runs = self.folder / "runs"
        for file in (runs / "friction-0.6" / "run.json",
                     runs / "turn-smooth" / "pod" / "contact-rotating" / "pod.json"):
            found = json.loads(file.read_text())
            self.assertRegex(found["build_id"], "^[0-9a-f]{16,}$")
            found["build_id"] = "0" * 40
            file.write_text(json.dumps(found))
        self.assertEqual(self.made_again(), {"runs/friction-0.6",
                                             "runs/turn-smooth/pod/contact-rotating"})

    def test_9_a_pod_with_other_settings_is_made_again(self):
        name = self.folder / "runs" / "turn-smooth"
        for what, extra in (("velocity-rotating", ["--from", "0.2", "--modes", 12]),
                            ("velocity-rotating", ["--modes", 2]),
                            ("velocity-rotating", ["--weight", "none", "--modes", 12]),
                            ("contact-rotating", ["--weight", "none", "--modes", 12]),
                            ("velocity-rectified", ["--shift", "pitch", "--modes", 12])):
            field, frame = what.split("-")
            done = run("pod", name, "--field", field, "--frame", frame, "--quiet", *extra)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(self.made_again(), {f"runs/turn-smooth/pod/{what}"}, extra)

    def test_9_a_failure_of_the_machine_is_not_the_one_that_is_wanted(self):
        file = self.folder / "runs" / "spin-up-fast-as-printed" / "run.json"
        found = json.loads(file.read_text())
        del found["steps_done"]  # as where the disk was full
        file.write_text(json.dumps(found))
        self.assertEqual(self.made_again(), {"runs/spin-up-fast-as-printed"})

    def test_9_leftovers_of_killed_writes_are_removed(self):
        runs = self.folder / "runs"
        left = [runs / "friction-0.0" / "case.toml.123.tmp",
                runs / "crush-smooth" / "pod" / "contact-rotating" / ".pod.123.tmp" / "pod.h5"]
        for file in left:
            file.parent.mkdir(exist_ok=True)
            file.write_text("half")
        (runs / "friction-0.0" / "run.json").unlink()
        (runs / "crush-smooth" / "pod" / "contact-rotating" / "pod.json").unlink()
        self.assertEqual(self.made_again(), {"runs/friction-0.0",
                                             "runs/crush-smooth/pod/contact-rotating"})
        for file in left:
            self.assertFalse(file.exists(), file)

    def test_9_a_record_that_is_gone_is_written_again(self):
        (self.folder / "paper.json").unlink()
        self.assertEqual(self.made_again(), set())

    def test_9_wrong_figures_are_told(self):
        path = self.once / "runs" / "friction-0.2" / "history.csv"
        text = path.read_text()
        self.addCleanup(path.write_text, text)
        lines = text.splitlines()
        place = lines[0].split(",").index("force_y")
        rows = [line.split(",") for line in lines[1:]]
        for row in rows:
            row[place] = repr(1.1 * float(row[place]))
        path.write_text("\n".join([lines[0]] + [",".join(row) for row in rows]) + "\n")
        again = run("paper", "--quick", "-o", self.once)
        self.assertEqual(again.returncode, 3, again.stderr)
        self.assertIn("NOT  mean vertical force, friction 0.2", again.stdout)
        self.assertIn("1 of 32 rows of the table are not as expected", again.stderr)
        found = paper(self.once)
        self.assertEqual((found["status"], found["failed"]), ("failed", 1))
        self.assertFalse(table(self.once)["friction-0.2-force-y"]["pass"])

    def test_9_results_that_cannot_be_read_are_told_and_recorded(self):
        path = self.folder / "runs" / "friction-0.2" / "history.csv"
        text = path.read_text()
        self.addCleanup(path.write_text, text)
        path.write_text(text.replace("force_y", "force_z", 1))
        again = run("paper", "--quick", "-o", self.folder)
        self.assertEqual(again.returncode, 4, again.stderr)
        self.assertIn("has no column force_y", again.stderr)
        found = paper(self.folder)
        self.assertEqual((found["status"], found["table"]), ("failed", []))
        self.assertIn("has no column force_y", found["message"])

    def test_9_a_part_that_fails_is_named_and_the_others_are_done(self):
        results = self.folder / "runs" / "crush-treaded" / "results.h5"
        results.unlink(missing_ok=True)
        (results / "in-the-way").mkdir(parents=True)
        (self.folder / "runs" / "crush-smooth" / "run.json").unlink()
        again = run("paper", "--quick", "-o", self.folder)
        self.assertEqual(again.returncode, 4, again.stderr)
        self.assertIn("crush-treaded", again.stderr.splitlines()[-1])
        self.assertIn("the same command goes on", again.stderr)
        found = paper(self.folder)
        self.assertEqual((found["status"], found["table"]), ("failed", []))
        status = {part["directory"]: part["status"] for part in found["runs"] + found["pods"]}
        self.assertEqual(status["runs/crush-treaded"], "failed")
        self.assertEqual(status["runs/crush-treaded/pod/velocity-rotating"], "failed")
        self.assertEqual(status["runs/crush-smooth/pod/velocity-rotating"], "done")
        (results / "in-the-way").rmdir()
        results.rmdir()
        self.assertEqual(run("paper", "--quick", "-o", self.folder).returncode, 0)


if __name__ == "__main__":
    unittest.main()

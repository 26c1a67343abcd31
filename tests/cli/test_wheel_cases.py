# SPDX-License-Identifier: BSD-3-Clause
"""The ready cases of a rim that forces move, shortened; the settings that their comments name; and
that such a run, killed, goes on to the same bits."""
import re
import shlex
import signal
import unittest

from program import ROOT, ProgramTest, history, run, summary
from test_resume import RESULTS, ResumeTest

CASES = sorted(path for path in (ROOT / "cases").glob("*.toml") if "\n[rim]\n" in path.read_text())
EXPECTED = {"wheel-settle", "wheel-rolling", "wheel-driven", "wheel-braked", "wheel-lock", "wheel-abs",
            "wheel-incline", "wheel-drop", "wheel-landing", "cleat-load", "cleat-height",
            "cleat-load-treaded", "cleat-height-treaded", "pothole-load", "rolling-cobbles", "sine-road-load",
            "quarter-car", "quarter-car-bump", "rubber-tyre", "tyre-lane-change", "tyre-load", "wheel-mu-jump",
            "wheel3d-cobbles", "wheel3d-load", "wheel3d-mu-split"}
SHORT = "0.02"  # s: the load is on, all but the dropped wheel touch the ground
LEDGER = 1e-12
# Free to rise and to turn, braked; some seconds of steps, a checkpoint every few hundred of them.
FREE_RIM = """schema = 1
title = "a wheel at a load"
[disk]
outer_radius = 0.3
inner_radius = 0.15
[disk.mesh]
radial = 3
circumferential = 40
[material]
youngs_modulus = 2.0e7
poissons_ratio = 0.3
density = 1100.0
[damping]
mass = 200.0
stiffness = 2.0e-5
[motion]
angular_velocity = 33.3
speed = 10.0
height = 0.3
gravity = 9.81
[rim]
free = ["height", "angular_velocity"]
mass = 100.0
inertia = 1.0
force_y = [[0.0, 0.0], [0.01, -8.0e4]]
brake = [[0.0, 0.0], [18.0, 2.0e4]]     # it locks at some 14 s
[rim.support.y]
stiffness = 1.0e5
damping = 2.0e4
[ground]
profile = [[-10, 0], [5, 0], [5.02, 0.01], [5.1, 0.01], [5.12, 0], [10, 0]]
fillet = 0.02
friction = 0.6
[time]
end = 20.0
[output]
snapshots = 101
history_interval = 4e-3
checkpoint_interval = 0.02
"""
# Bodies may touch each other, which the fused steps do not know: the general step.
GENERAL = ["--set", "contact.between=all", "--set", "disk.mesh.circumferential=60", "--set", "time.end=8.0"]
SPARSE = ["--set", "solver.operator=sparse", "--set", "disk.mesh.circumferential=160", "--set", "time.end=8.0"]


class Cases(ProgramTest):
    def test_there_are_all(self):
        self.assertEqual({path.stem for path in CASES}, EXPECTED)

    def run_short(self, case, *settings):
        out = self.folder / "out"
        if "\n[section]\n" in case.read_text():  # a tyre, coarser than it is shipped
            checked = run("check", case, *settings)
            self.assertEqual(checked.returncode, 0, checked.stderr)
            settings = ("--set", "section.sectors=36", *settings)
        done = run("run", case, "-o", out, "--overwrite", "--quiet", "--set", f"time.end={SHORT}",
                   "--set", "output.snapshots=3", *settings)
        self.assertEqual(done.returncode, 0, done.stderr)
        figures = summary(out)
        self.assertEqual(figures["status"], "done")
        self.assertLess(figures["energy_residual_relative"], LEDGER)
        return history(out)

    def test_each_runs_and_closes_its_balance(self):
        for case in CASES:
            with self.subTest(case.stem):
                h = self.run_short(case)
                if case.stem != "wheel-drop":
                    self.assertGreater(h["force_y"].max(), 0.0)
                for work in ("work_frame", "work_rim"):
                    self.assertEqual(abs(h[work]).max(), 0.0)

    def test_the_commands_in_their_comments_run(self):
        found = 0
        for case in CASES:
            text = re.sub(r" \\\n# *", " ", case.read_text())
            for command in re.findall(r"^#   (rondo run .*)$", text, re.MULTILINE):
                found += 1
                _, _, named, *settings = shlex.split(command)
                self.assertEqual(named, f"cases/{case.name}")
                held = self.run_short(ROOT / named, *settings)
                of_height = any(setting.startswith("rim.free") for setting in settings)
                self.assertEqual(abs(held["hub_force_y"]).max() > 0.0, of_height)
        self.assertEqual(found, 4)


class Resumed(ResumeTest):
    def test_killed_again_and_again_it_goes_on_to_the_same_bits(self):
        self.leave_alone(FREE_RIM)
        total = (self.whole / "history.csv").read_bytes().count(b"\n")
        for share in (0.1, 0.35, 0.6, 0.9):  # 0.9: the wheel has locked
            process = self.start(FREE_RIM)
            self.assertTrue(self.wait_for_rows(process, share * total), "it ended before the kill")
            process.kill()
            process.wait()
        self.gone_on()

    def test_interrupted_it_goes_on_to_the_same_bits_with_other_steps(self):
        for name, settings in (("general", GENERAL), ("sparse", SPARSE)):
            with self.subTest(settings):
                self.whole, self.out = self.folder / f"{name}-whole", self.folder / f"{name}-out"
                self.leave_alone(FREE_RIM, *settings)
                total = (self.whole / "history.csv").read_bytes().count(b"\n")
                process = self.start(FREE_RIM, *settings)
                self.assertTrue(self.wait_for_rows(process, 0.2 * total), "it ended before the signal")
                process.send_signal(signal.SIGINT)
                self.assertEqual(process.wait(), 130)
                self.gone_on(*settings)

    def gone_on(self, *settings):
        done = self.resume(FREE_RIM, *settings)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreater(len(summary(self.out)["resumed_at_steps"]), 0)
        self.assert_same(self.out, RESULTS)


if __name__ == "__main__":
    unittest.main()

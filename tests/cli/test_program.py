# SPDX-License-Identifier: BSD-3-Clause
"""rondo check; instruction sets, operators, help, the progress of a run."""
import json
import os
import subprocess
import unittest

import h5py
import numpy as np

from program import (PROGRAM, ProgramTest, ROOT, SANITIZED, SMALL, estimated_memory, history, replaced,
                     run, summary)


class Check(ProgramTest):
    def test_check_says_what_a_run_would_cost_and_writes_nothing(self):
        done = run("check", self.case())
        self.assertEqual(done.returncode, 0, done.stderr)
        for word in ("nodes", "160", "critical step", "steps", "wave speeds", "156.447", "memory",
                     "disk", "time"):
            self.assertIn(word, done.stdout)
        self.assertEqual([p.name for p in self.folder.iterdir()], ["case.toml"])

    def test_disk_estimate_is_what_a_run_takes(self):
        run("run", self.case(), "-o", self.folder / "out")
        size = sum(p.stat().st_size for p in (self.folder / "out").iterdir())
        said = run("check", self.folder / "case.toml").stdout
        number, unit = [line.split()[2:4] for line in said.splitlines() if line.startswith("disk")][0]
        estimate = float(number) * {"kB": 1e3, "MB": 1e6, "GB": 1e9}[unit]
        self.assertGreater(estimate, size)
        checkpoints = 2 * (160 * 80 + 50e3)  # so short a run needs no room for two of them
        self.assertLess(estimate, 1.35 * size + checkpoints)

    @unittest.skipIf(SANITIZED, "the memory of the sanitizer counts")
    def test_memory_estimate_is_what_a_run_takes(self):
        # A smaller run is below the memory of this script, which the system counts to it.
        # The largest is above the size from which no stiffness is assembled.
        for radial, spin in ((60, 0.0), (60, 30.0), (120, 30.0)):
            text = replaced(SMALL, "radial", f"radial = {radial}")
            text = replaced(text, "circumferential", f"circumferential = {20 * radial}")
            text = replaced(text, "angular_velocity", f"angular_velocity = {spin}")
            text = replaced(replaced(text, "end", "end = 1e-6"), "snapshots", "snapshots = 0")
            out = self.folder / f"out{radial}-{spin}"
            self.assertEqual(run("run", self.case(text), "-o", out).returncode, 0)
            ratio = estimated_memory(self.folder / "case.toml") / summary(out)["peak_memory_bytes"]
            self.assertGreater(ratio, 0.7, (radial, spin))
            self.assertLess(ratio, 1.4, (radial, spin))

    def test_every_case_of_the_project_is_right(self):
        cases = sorted((ROOT / "cases").glob("*.toml"))
        self.assertGreaterEqual(len(cases), 5)
        for path in cases:
            with self.subTest(path.name):
                self.assertTrue(path.read_text().startswith("#"))  # says what it shows
                done = run("check", path)
                self.assertEqual((done.returncode, done.stderr), (0, ""))


class Program(ProgramTest):
    def test_the_instruction_set_is_told_and_can_be_asked_for(self):
        best = run("--version").stdout.split("kernels ")[1].split(")")[0]
        forces = {}
        for level in dict.fromkeys((best, "baseline")):
            environment = os.environ | {"RONDO_DISPATCH": level}
            out = self.folder / level
            self.assertEqual(run("run", self.case(), "-o", out, env=environment).returncode, 0)
            self.assertEqual(summary(out)["dispatch"], level)
            self.assertIn(f"kernels {level})", run("--version", env=environment).stdout)
            forces[level] = history(out)["force_y"]
        scale = np.abs(forces[best]).max()
        self.assertGreater(scale, 0.0)
        self.assertLess(np.abs(forces[best] - forces["baseline"]).max(), 1e-8 * scale)

    def test_an_unknown_instruction_set_is_refused_before_anything_is_built(self):
        for command in (("run", self.case(), "-o", self.folder / "out"), ("check", self.case()),
                        ("--version",)):
            done = run(*command, env=os.environ | {"RONDO_DISPATCH": "sse9"})
            self.assertEqual(done.returncode, 2, command)
            for said in ("RONDO_DISPATCH = sse9", "baseline"):
                self.assertIn(said, done.stderr, command)
        self.assertFalse((self.folder / "out").exists())

    def test_operators_give_the_same_to_round_off(self):
        both = []
        for operator in ("cyclic", "sparse"):
            out = self.folder / operator
            run("run", self.case(), "-o", out, "--set", f"solver.operator={operator}")
            self.assertEqual(summary(out)["operator"], operator)
            self.assertLess(summary(out)["energy_residual_relative"], 1e-13)
            both.append(history(out))
        for column in ("force_x", "force_y", "strain", "work_frame", "dissipation_friction"):
            scale = np.abs(both[0][column]).max()
            self.assertGreater(scale, 0.0, column)
            self.assertLess(np.abs(both[0][column] - both[1][column]).max(), 1e-8 * scale, column)

    def test_what_it_was_built_from(self):
        """One record, in all documents and in --version."""
        said = run("--version").stdout
        document = run("check", self.case(), "--json").stdout
        record = json.loads(document)["build_record"]
        self.assertRegex(record["commit"], "^(unknown|[0-9a-f]{40})$")
        self.assertEqual(record["modified"] is None, record["commit"] == "unknown")
        self.assertIn("-ffp-contract=off", record["flags"])
        self.assertIn(record["compiler"], said.splitlines()[0])
        for name in ("Eigen", "CHOLMOD", "Spectra", "OpenBLAS", "FFTW", "HDF5", "Gmsh"):
            self.assertRegex(record["libraries"][name], r"^\d+\.\d+", name)
            self.assertIn(f"{name} {record['libraries'][name]}", said)
        for text in (f"commit     {record['commit']}", f"flags      {record['flags']}"):
            self.assertIn(text, said)
        out = self.folder / "out"
        crush = self.case((ROOT / "cases" / "crush-smooth.toml").read_text(), "crush.toml")
        study = self.case('schema = 1\nbase = "case.toml"\nset = ["time.end=4e-3"]\nsnapshots = true\n'
                          '[[vary]]\nkey = "ground.friction"\nvalues = [0.0, 0.3]\n', "study.toml")
        model = self.folder / "model.h5"
        for command in (["run", self.case(), "-o", out / "run"],
                        ["run", crush, "-o", out / "crush", "--set", "analysis.increments=2"],
                        ["run", ROOT / "cases" / "steady-rolling.toml", "-o", out / "steady"],
                        ["modes", ROOT / "cases" / "modes-annulus.toml", "-o", out / "modes", "--diameters", "2"],
                        ["pod", out / "run", "-o", out / "pod"], ["sweep", study, "-o", out / "sweep"],
                        ["reduce", self.case(), "-o", model]):
            done = run(*command)
            self.assertEqual(done.returncode, 0, done.stderr)
        files = sorted(out.rglob("*.json"))
        self.assertEqual({file.name for file in files}, {"run.json", "modes.json", "pod.json", "sweep.json"})
        level = said.split("kernels ")[1].split(")")[0]
        for file in files:
            found = json.loads(file.read_text())
            self.assertEqual((found["build_record"], found["dispatch"]), (record, level), file)
        with h5py.File(model) as file:
            self.assertEqual(json.loads(file.attrs["build_record"]), record)

    def test_a_copy_without_git_is_of_no_known_commit(self):
        made = self.folder / "commit.cpp"
        def look(folder):
            subprocess.run(["cmake", f"-DOUTPUT={made}", "-DGIT=git", f"-DSOURCE={folder}", "-P",
                            ROOT / "cmake" / "commit.cmake"], check=True)

        look(self.folder)
        self.assertIn('built_commit = "unknown"', made.read_text())
        self.assertIn("built_modified = -1", made.read_text())
        git = ["git", "-C", self.folder, "-c", "user.name=a", "-c", "user.email=a"]
        (self.folder / "file").write_text("a")
        for command in (["init", "-q"], ["add", "file"], ["commit", "-qm", "a"]):
            subprocess.run([*git, *command], check=True)
        look(self.folder)
        self.assertRegex(made.read_text(), r'built_commit = "[0-9a-f]{40}";\n.*built_modified = 0;')
        before = made.stat().st_mtime_ns
        look(self.folder)
        self.assertEqual(made.stat().st_mtime_ns, before)  # nothing is compiled anew
        (self.folder / "file").write_text("b")
        look(self.folder)
        self.assertIn("built_modified = 1", made.read_text())
        (self.folder / "part").mkdir()
        look(self.folder / "part")
        self.assertIn('"unknown"', made.read_text())  # a copy within another repository

    def test_version_and_help(self):
        self.assertRegex(run("--version").stdout, r"^rondo \d+\.\d+\.\d+ ")
        for arguments in (["--help"], ["run", "--help"], ["check", "--help"]):
            done = run(*arguments)
            self.assertEqual(done.returncode, 0)
            self.assertIn("Example:", done.stdout)

    def test_an_unknown_command(self):
        for arguments, meant in ((["bogus", "--help"], None), (["runn"], "run"), (["swep"], "sweep"),
                                 (["runn", "--help"], "run"), (["RUN", "case.toml"], "run")):
            done = run(*arguments)
            self.assertEqual((done.returncode, done.stdout), (2, ""), arguments)
            self.assertIn(f"rondo {arguments[0]}: there is no such command", done.stderr)
            self.assertIn("run, check, pod, reduce, fmu, modes, matrices", done.stderr)
            self.assertEqual(f"did you mean rondo {meant}?" in done.stderr, meant is not None)

    def test_no_progress_bar_where_there_is_no_terminal(self):
        done = run("run", self.case(), "-o", self.folder / "out")
        self.assertNotIn("\r", done.stderr)
        self.assertIn("100 %", done.stderr)

    def test_progress_bar_on_a_terminal(self):
        import pty
        try:
            main, other = pty.openpty()
        except OSError as error:
            self.skipTest(f"no pseudo-terminal here: {error}")
        process = subprocess.Popen([PROGRAM, "run", str(self.case()), "-o", str(self.folder / "out")],
                                   stderr=other)
        os.close(other)
        said = b""
        try:
            while chunk := os.read(main, 4096):
                said += chunk
        except OSError:
            pass  # the terminal closes with the program
        os.close(main)
        self.assertEqual(process.wait(), 0)
        self.assertIn(b"steps/s", said)
        self.assertIn(b"100 %", said)


if __name__ == "__main__":
    unittest.main()

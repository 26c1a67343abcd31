# SPDX-License-Identifier: BSD-3-Clause
"""--json: exactly one document on stdout, by its schema, of each command and each way to end."""
import fcntl
import json
import os
import signal
import subprocess
import time

from program import PROGRAM, ROOT, SMALL, ProgramTest, replaced, run, summary
from schemas import errors, main, needs_jsonschema

STATUS = {0: "done", 2: "wrong-input", 3: "numerical-failure", 4: "file-failure", 130: "interrupted"}
GOOD, BAD = "[0, 0]", "[1e20, 0]"  # with which the run ends in numbers that are out of range
FAILING = ["--set", f"initial.velocity={BAD}"]


@needs_jsonschema
class JsonTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"

    def document(self, done):
        """The one document on stdout, which keeps to its schema and to the exit code."""
        document = json.loads(done.stdout, parse_constant=self.fail)  # NaN is no JSON
        self.assertTrue(done.stdout.startswith("{") and done.stdout.endswith("}\n"))
        self.assertEqual(errors(document["command"], document), [])
        self.assertEqual(document["exit_code"], done.returncode)
        self.assertEqual(document["status"], STATUS[done.returncode])
        self.assertEqual(document["message"] is None, done.returncode == 0)
        return document

    def answer(self, code, *arguments, **options):
        done = run(*arguments, "--json", **options)
        self.assertEqual(done.returncode, code, done.stderr)
        return self.document(done)

    def result(self, *arguments):
        return self.answer(0, *arguments)["result"]

    def interrupted(self, *arguments, until):
        """The document of a command that is sent SIGINT once `until` is true."""
        with subprocess.Popen([PROGRAM, *map(str, arguments), "--json"], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True) as process:
            for _ in range(600):
                if until() or process.poll() is not None:
                    break
                time.sleep(0.02)
            process.send_signal(signal.SIGINT)
            said, complaint = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 130, complaint)
        return self.document(subprocess.CompletedProcess([], 130, said, complaint))


class Check(JsonTest):
    def test_a_good_case(self):
        found = self.result("check", self.case())
        self.assertEqual((found["nodes"], found["dofs"], found["contact_nodes"]), (160, 240, 40))
        self.assertEqual(found["analysis"], "dynamic")
        self.assertGreater(found["memory_bytes"], 0)
        people = run("check", self.case()).stdout
        for line in found["lines"]:
            self.assertIn(line["name"], people)

    def test_faults_with_their_places(self):
        path = self.case(replaced(replaced(SMALL, "density", "density = -1"), "friction", "mu = 1"))
        told = self.answer(2, "check", path, "--set", "time.end=0")
        self.assertIsNone(told["result"])
        density, unknown, end = told["faults"]
        self.assertEqual(density, {"file": str(path), "line": 12, "column": 11, "found": "-1",
                                   "key": "material.density", "message": "is out of bounds",
                                   "allowed": "> 0"})
        self.assertIn("did you mean ground.friction?", unknown["message"])
        self.assertEqual((end["file"], end["line"]), ("--set time.end=0", None))
        self.assertIn("3 errors", told["message"])

    def test_what_is_no_case(self):
        told = self.answer(2, "check", self.folder / "none.toml")
        self.assertEqual(told["faults"][0]["message"], "there is no such file")
        told = self.answer(2, "check", self.case("schema = \n"))
        self.assertEqual(told["faults"][0]["line"], 1)
        told = self.answer(2, "check")
        self.assertIn("required", told["faults"][0]["message"])
        told = self.answer(2, "check", self.case(), "--thread", "2")
        self.assertIn("--thread", told["faults"][0]["message"])

    def test_names_that_are_no_text(self):
        name = os.fsencode(self.folder) + b"/\xff.toml"
        done = subprocess.run([PROGRAM, "check", name, "--json"], capture_output=True, timeout=60)
        told = json.loads(done.stdout)
        self.assertEqual((done.returncode, told["status"]), (2, "wrong-input"))
        self.assertIn("\ufffd", told["faults"][0]["file"])

    def test_warnings_stand_in_it_and_on_stderr(self):
        case = self.case(replaced(SMALL, "speed", "speed = 10.0\nslope = 0.1"))
        done = run("check", case, "--json")
        warnings = self.document(done)["warnings"]
        self.assertTrue(any("motion.slope has no effect" in text for text in warnings), warnings)
        self.assertIn("warning: motion.slope has no effect", done.stderr)

    def test_interrupted(self):
        begun = time.monotonic()
        told = self.interrupted("check", self.case(), "--set", "disk.mesh.radial=400", "--set",
                                "disk.mesh.circumferential=4000",
                                until=lambda: time.monotonic() > begun + 0.3)
        self.assertIsNone(told["result"])

    def test_a_command_that_is_none(self):
        done = run("chekc", "--json")
        told = json.loads(done.stdout)
        self.assertEqual((done.returncode, told["status"], told["exit_code"]), (2, "wrong-input", 2))

    def test_help_is_for_people(self):
        done = run("check", "--help", "--json")
        self.assertEqual(done.returncode, 0)
        self.assertIn("--json", done.stdout)
        self.assertFalse(done.stdout.startswith("{"))


class Run(JsonTest):
    def test_a_run(self):
        told = self.answer(0, "run", self.case(), "-o", self.out, "--realtime-factor")
        found = told["result"]
        self.assertEqual(found["directory"], str(self.out))
        self.assertEqual(found["run"], summary(self.out))
        self.assertEqual((found["run"]["status"], found["resumed_at"]), ("done", 0))
        self.assertEqual(found["steps"], found["run"]["steps_done"])
        again = self.result("run", self.case(), "-o", self.out, "--resume")
        self.assertTrue(again["was_complete"])

    def test_each_analysis(self):
        for k, settings in enumerate((
                ["analysis.kind=crush", "analysis.depth=0.002", "analysis.increments=2"],
                ["analysis.kind=steady-rolling", "motion.height=0.296"],
                ["disk.rim=free", "time.end=0.001", "initial.position=[0, 1]"])):
            sets = [part for text in settings for part in ("--set", text)]
            text = SMALL if k < 2 else SMALL[:SMALL.index("[motion]")] + SMALL[SMALL.index("[ground]"):]
            found = self.result("run", self.case(text), "-o", f"{self.out}{k}", *sets)
            self.assertEqual(found["run"]["status"], "done")

    def test_into_a_folder_whose_name_is_no_utf8(self):
        out = os.fsdecode(os.fsencode(self.folder) + b"/fo\xffder")
        document = self.answer(0, "run", self.case(), "-o", out)
        self.assertEqual(document["result"]["directory"], f"{self.folder}/fo\ufffdder")
        self.assertIn("a name in this document is not UTF-8", document["warnings"][-1])

    def test_wrong_input(self):
        self.assertEqual(self.answer(2, "run", self.case(), "-o", self.out, "--set",
                                     "ground.friction=-1")["faults"][0]["key"], "ground.friction")
        self.result("run", self.case(), "-o", self.out)
        told = self.answer(2, "run", self.case(), "-o", self.out)
        self.assertIn("--overwrite", told["message"])
        self.assertIsNone(told["result"])

    def test_a_numerical_failure(self):
        told = self.answer(3, "run", self.case(), "-o", self.out, *FAILING)
        self.assertEqual(told["result"]["run"]["status"], "failed")
        self.assertIn(told["result"]["run"]["message"], told["message"])

    def test_files_that_cannot_be_written(self):
        blocked = self.case("text", "a-file")
        told = self.answer(4, "run", self.case(), "-o", blocked / "out")
        self.assertEqual((told["result"], told["faults"]), (None, []))
        self.assertIn("a-file", told["message"])

    def test_interrupted(self):
        case = self.case(replaced(SMALL, "end", "end = 100"))
        told = self.interrupted("run", case, "-o", self.out, until=(self.out / "run.json").exists)
        self.assertEqual(told["result"]["run"]["status"], "interrupted")
        self.assertGreater(told["result"]["steps"], 0)
        self.assertIn("continue with --resume", told["message"])

    def test_quiet(self):
        done = run("run", self.case(), "-o", self.out, "--json", "--quiet")
        self.document(done)
        self.assertNotIn("info", done.stderr)

    def test_a_stdout_that_is_full(self):
        with open("/dev/full", "w") as full:
            done = subprocess.run([PROGRAM, "check", self.case(), "--json"], stdout=full,
                                  stderr=subprocess.PIPE, text=True, timeout=60)
        self.assertEqual(done.returncode, 4)
        self.assertIn("standard output", done.stderr)


class Many(JsonTest):
    STUDY = 'schema = 1\nbase = "case.toml"\n[[vary]]\nkey = "ground.friction"\nvalues = [0.1, 0.2]\n'

    def study(self, text=STUDY):
        self.case()
        return self.case(text, "study.toml")

    def test_a_sweep(self):
        plan = self.result("sweep", self.study(), "--dry-run", "--jobs", "1")
        self.assertEqual([run["settings"][-1] for run in plan["planned"]],
                         ["ground.friction=0.1", "ground.friction=0.2"])
        found = self.result("sweep", self.study(), "-o", self.out, "--jobs", "1")
        self.assertEqual((found["runs"], found["done"], found["failed"]), (2, 2, 0))
        self.assertTrue((self.out / "results.csv").exists())
        again = self.result("sweep", self.study(), "-o", self.out, "--jobs", "1", "--resume")
        self.assertEqual(again["kept"], 2)

    def test_shards(self):
        first = self.result("sweep", self.study(), "--dry-run", "--jobs", "1", "--shard", "1/2")
        self.assertEqual([(run["run"], run["lent"]) for run in first["planned"]], [(1, False)])
        for k in 1, 2:
            made = self.result("sweep", self.study(), "-o", self.out, "--jobs", "1", "--shard", f"{k}/2")
            self.assertEqual((made["runs"], made["done"]), (1, 1))
            if k == 1:
                told = self.answer(130, "sweep", self.study(), "-o", self.out, "--collect")
                self.assertEqual((told["result"]["done"], told["result"]["unfinished"]), (1, [2]))
                self.assertEqual(told["message"], "1 of 2 runs done; 1 of 2 shards not finished: 2")
        found = self.result("sweep", self.study(), "-o", self.out, "--collect")
        self.assertEqual((found["done"], found["unfinished"]), (2, []))

    def test_a_sweep_that_is_wrong(self):
        told = self.answer(2, "sweep", self.study(self.STUDY.replace("0.1", "-0.1")), "-o", self.out)
        self.assertIn("run 1 (ground.friction = -0.1)", told["faults"][0]["message"])

    def test_a_sweep_of_which_runs_fail(self):
        text = self.STUDY.replace("ground.friction", "initial.velocity")
        text = text.replace("[0.1, 0.2]", f"[{GOOD}, {BAD}]")
        told = self.answer(3, "sweep", self.study(text), "-o", self.out, "--jobs", "1")
        self.assertEqual((told["result"]["done"], told["result"]["failed"]), (1, 1))
        self.assertEqual(len(told["result"]["failures"]), 1)

    def test_a_sweep_that_is_interrupted(self):
        study = self.study()
        self.case(replaced(SMALL, "end", "end = 100"))
        told = self.interrupted("sweep", study, "-o", self.out, "--jobs", "1",
                                until=(self.out / "runs" / "0001" / "run.json").exists)
        self.assertEqual(told["result"]["interrupted"], 2)

    def test_a_sweep_that_cannot_write(self):
        blocked = self.case("text", "a-file")
        self.assertIsNone(self.answer(4, "sweep", self.study(), "-o", blocked / "out")["result"])


class Modes(JsonTest):
    def test_modes(self):
        told = self.answer(0, "modes", self.case(), "-o", self.out, "--count", "6", "--spins", "0:10:2",
                           "--diameters", "4")
        found = told["result"]
        self.assertEqual({mode["spin"] for mode in found["modes"]}, {0.0, 33.333333})
        self.assertEqual(len(found["sweep"]), 2)
        self.assertGreater(found["critical_speeds"][0]["rim_speed"], 0.0)
        self.assertLess(found["residual_max"], 1e-6)

    def test_wrong_input(self):
        told = self.answer(2, "modes", self.case(), "-o", self.out, "--spins", "a")
        self.assertIn("--spins", told["faults"][0]["key"])

    def test_a_spin_that_softens_the_body_to_nothing(self):
        told = self.answer(3, "modes", self.case(), "-o", self.out, "--count", "4", "--spin", "5000")
        self.assertIn("5000", told["message"])

    def test_files_that_cannot_be_written(self):
        blocked = self.case("text", "a-file")
        self.assertIsNone(self.answer(4, "modes", self.case(), "-o", blocked / "out")["result"])

    def test_interrupted(self):
        told = self.interrupted("modes", ROOT / "cases" / "modes-annulus.toml", "-o", self.out, "--spins",
                                "0:400:4000", "--count", "40", until=self.out.exists)
        self.assertEqual(told["status"], "interrupted")


class OfRuns(JsonTest):
    """pod and reduce of one run, made once."""

    def setUp(self):
        super().setUp()
        self.runs = []
        for k, friction in enumerate((0.1, 0.3)):
            self.runs.append(self.folder / f"run{k}")
            done = run("run", self.case(), "-o", self.runs[-1], "--set", f"ground.friction={friction}",
                       "--set", "output.snapshots=20")
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_pod(self):
        found = self.result("pod", *self.runs, "-o", self.out, "--modes", "5")
        self.assertEqual((found["modes_kept"], len(found["runs"])), (5, 2))
        kept = json.loads(next(self.out.rglob("pod.json")).read_text())
        for mine, its in ("sigma_1", "sigma_1"), ("rows", "rows"), ("modes_kept", "modes_kept"):
            self.assertEqual(found[mine], kept[its])
        self.assertIsNone(found["runs"][0]["error_with_modes_for"][-1])

    def test_pod_of_what_is_no_run(self):
        self.answer(2, "pod", self.folder / "none")
        self.answer(2, "pod", self.runs[0], "--field", "colour")
        (self.runs[0] / "results.h5").write_bytes(b"damaged")
        told = self.answer(4, "pod", self.runs[0], "-o", self.out)
        self.assertIn("results.h5", told["message"])

    def test_reduce(self):
        wheel = self.folder / "wheel.h5"
        found = self.result("reduce", *self.runs, "-o", wheel, "--modes", "5")
        self.assertEqual((found["wheel"], found["basis"]), (str(wheel), "pod"))
        self.assertIn(found["modes"], (5, 6))
        self.assertEqual((found["snapshots"], found["spins"]), (40, [33.333333]))
        self.assertEqual(found["wheel_bytes"], wheel.stat().st_size)
        found = self.result("reduce", self.case(), "-o", wheel, "--modes", "5")
        self.assertEqual((found["basis"], found["snapshots"], found["energy_left"]), ("eigenmodes", 0, 0.0))

    def test_reduce_of_what_is_wrong(self):
        self.answer(2, "reduce", self.folder / "none", "-o", self.folder / "model.h5")
        blocked = self.case("text", "a-file")
        told = self.answer(4, "reduce", *self.runs, "-o", blocked / "model.h5")
        self.assertIn("a-file", told["message"])

    def test_interrupted_before_there_is_anything(self):
        """These end at once at a signal: their document was ready before."""
        # Who opens a file with a lease waits until its holder gives it back.
        self.addCleanup(signal.signal, signal.SIGIO, signal.signal(signal.SIGIO, signal.SIG_IGN))
        held = os.open(self.runs[0] / "run.json", os.O_RDWR)
        self.addCleanup(os.close, held)
        fcntl.fcntl(held, fcntl.F_SETLEASE, fcntl.F_WRLCK)
        model = self.folder / "model.h5"
        for command in (["pod", *self.runs, "-o", self.out], ["reduce", *self.runs, "-o", model]):
            with self.subTest(command[0]):
                begun = time.monotonic()
                told = self.interrupted(*command, until=lambda: time.monotonic() > begun + 0.5)
                self.assertEqual((told["result"], told["message"]), (None, "interrupted"))


if __name__ == "__main__":
    main()

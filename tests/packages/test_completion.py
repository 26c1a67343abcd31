# SPDX-License-Identifier: BSD-3-Clause
"""The completion of bash, asked as bash asks it: the words of the line, `=` being one, and the answers."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ["RONDO"]
ASK = r"""
source "$1"
shift
COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
function=$(complete -p rondo | sed 's/.*-F \([^ ]*\) .*/\1/')
$function rondo "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD-1]}"
printf '%s\n' "${COMPREPLY[@]}"
"""


class Completion(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.script = cls.folder / "rondo.bash"
        given = os.environ.get("RONDO_COMPLETION")
        if given:
            cls.script = pathlib.Path(given)
        else:
            subprocess.run([sys.executable, "-B", ROOT / "scripts/pages/write.py", PROGRAM, "--bash", cls.script],
                           check=True, stdout=subprocess.DEVNULL)
        cls.here = cls.folder / "here"
        (cls.here / "a folder").mkdir(parents=True)
        for name in ("case.toml", "other case.toml", "model.h5", "notes.md"):
            (cls.here / name).write_text("")

    def ask(self, *words):
        done = subprocess.run(["bash", "--norc", "-c", ASK, "bash", self.script, "rondo", *words],
                              capture_output=True, text=True, cwd=self.here)
        self.assertEqual(done.stderr, "", words)
        return set(done.stdout.split("\n")) - {""}

    def test_commands(self):
        self.assertLessEqual({"run", "reduce"}, self.ask("r"))
        self.assertTrue(all(name.startswith("r") for name in self.ask("r")))
        self.assertLessEqual({"check", "sweep", "schema", "modes", "pod"}, self.ask(""))
        self.assertEqual(self.ask("--v"), {"--version"})

    def test_options(self):
        found = self.ask("run", "--")
        self.assertLessEqual({"--set", "--resume", "--output", "--json", "--help"}, found)
        self.assertNotIn("--field", found)
        self.assertEqual(self.ask("pod", "--fi"), {"--field"})
        self.assertEqual(self.ask("means", "--f"), {"--from"})  # done in Python

    def test_values(self):
        self.assertEqual(self.ask("pod", "--field", ""), {"displacement", "velocity", "contact"})
        self.assertEqual(self.ask("pod", "--frame", "r"), {"rectified"})
        self.assertEqual(self.ask("campbell", "--frame", "f"), {"fixed"})
        self.assertEqual(self.ask("figures", ""), {"a folder"})
        self.assertEqual(self.ask("figures", "x", "--output", ""), {"a folder"})
        self.assertEqual(self.ask("pod", "--method", "=", "ts"), {"tsqr"})
        self.assertEqual(self.ask("pod", "--method", "="), {"auto", "direct", "tsqr", "incremental"})
        self.assertLessEqual({"case", "study"}, self.ask("schema", ""))
        self.assertEqual(self.ask("reduce", "--basis", ""), {"eigenmodes", "pod"})
        self.assertEqual(self.ask("run", "--threads", ""), set())

    def test_files(self):
        self.assertEqual(self.ask("run", ""), {"case.toml", "other case.toml", "a folder"})
        self.assertEqual(self.ask("check", "c"), {"case.toml"})
        self.assertEqual(self.ask("pod", ""), {"a folder"})
        self.assertEqual(self.ask("run", "case.toml", "-o", ""), {"a folder"})
        self.assertEqual(self.ask("run", "case.toml", "--reduced", "m"), {"model.h5"})

    def test_keys_of_a_case(self):
        self.assertEqual(self.ask("run", "case.toml", "--set", "ground.fr"),
                         {"ground.friction=", "ground.friction.coefficient=", "ground.friction.slip_speed=",
                          "ground.friction.pressure_exponent=", "ground.friction.pressure_reference="})
        self.assertIn("output.probe[0].position=", self.ask("run", "case.toml", "--set", "output."))
        self.assertEqual(self.ask("run", "case.toml", "--set", "analysis.solver", "=", "la"),
                         {"latin", "latin-pgd"})
        self.assertEqual(self.ask("run", "case.toml", "--set", "output.stress", "="), {"true", "false"})
        self.assertEqual(self.ask("run", "case.toml", "--set", "ground.friction", "="), set())

    @unittest.skipIf("RONDO_COMPLETION" in os.environ, "of the sources")
    def test_env_of_the_sources(self):
        """A bash that is typed in has it after scripts/env.sh, a script has not."""
        for kind, wanted in (("-i", "complete -F _rondo rondo"), ("+i", "")):
            done = subprocess.run(["bash", "--norc", kind, "-c", f"source {ROOT}/scripts/env.sh; complete -p rondo"],
                                  capture_output=True, text=True, stdin=subprocess.DEVNULL)
            self.assertEqual(done.stdout.strip(), wanted, done.stderr)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""What editors of TOML make of the schemas: Taplo's command line and its language server, the one
of "Even Better TOML". `bash scripts/setup.sh --dev` installs both where there is npm."""
import json
import pathlib
import shutil
import subprocess
import unittest

from program import LEDGE, ROOT, ProgramTest, replaced
from schemas import main

TAPLO = shutil.which("taplo")
SERVER = pathlib.Path(__file__).with_name("taplo.mjs")


def modules():
    """The folder of npm's modules for all users, if it holds the language server."""
    if not (shutil.which("npm") and shutil.which("node")):
        return None
    folder = subprocess.run(["npm", "root", "-g"], capture_output=True, text=True).stdout.strip()
    return folder if (pathlib.Path(folder) / "@taplo" / "lsp").is_dir() else None


MODULES = modules()


def lint(*files, folder=ROOT):
    return subprocess.run([TAPLO, "--colors", "never", "lint", *map(str, files)], cwd=folder,
                          capture_output=True, text=True, timeout=120)


@unittest.skipIf(TAPLO is None, "taplo is not installed (npm: @taplo/cli)")
class CommandLine(ProgramTest):
    def test_shipped_files_pass(self):
        for pattern in "cases/*.toml", "cases/studies/*.toml":
            files = sorted(ROOT.glob(pattern))
            done = lint(*files)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(f"found files total={len(files)} excluded=0", done.stderr)

    def tree(self, text, name="cases/new.toml", settings=True):
        """A folder as the project's, with one file."""
        (self.folder / "cases").mkdir()
        shutil.copytree(ROOT / "cases" / "schema", self.folder / "cases" / "schema")
        if settings:
            shutil.copy(ROOT / ".taplo.toml", self.folder)
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)
        return path.relative_to(self.folder)

    def wrong(self, said, file):
        done = lint(file, folder=self.folder)
        self.assertEqual(done.returncode, 1, done.stderr)
        for fragment in said:
            self.assertIn(fragment, done.stderr)

    def test_faults_of_a_case_by_its_first_line(self):
        text = replaced(replaced(LEDGE, "friction", "friction = 300"), "plane", 'plane = "shell"')
        text = replaced(text, "radial", "radail = 12")
        self.assertTrue(text.startswith("#:schema schema/case.json\n"))
        self.wrong(["300 is greater than the maximum of 100", '"shell" is not one of ["strain","stress"]',
                    "an unknown key", '"radial" is a required property'],
                   self.tree(text, settings=False))

    def test_faults_of_a_case_by_the_settings_of_the_folder(self):
        text = replaced(LEDGE, "#:schema", None)
        self.wrong(["300 is greater than the maximum of 100"],
                   self.tree(replaced(text, "friction", "friction = 300")))

    def test_faults_of_a_study(self):
        text = 'schema = 1\nbase = "a.toml"\n[[vary]]\nkey = "ground.frictoin"\nvalues = [1]\n'
        self.wrong(["ground.frictoin"], self.tree(text, "cases/studies/new.toml"))


@unittest.skipIf(MODULES is None, "Taplo's language server is not installed (npm: @taplo/lsp)")
class LanguageServer(unittest.TestCase):
    TEXT = """#:schema schema/case.json
schema = 1

[ground]
friction = 300

[time]
scheme = ""
[motion]

[[output.probe]]

"""

    def ask(self, file, text, *places):
        done = subprocess.run(["node", SERVER, MODULES, ROOT, file, *places], input=text, text=True,
                              capture_output=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def test_completions_faults_and_meanings(self):
        told = self.ask("cases/new.toml", self.TEXT, "5:0", "7:10", "4:2", "9:0", "11:0")
        faults = {(d["range"]["start"]["line"], d["message"]) for d in told["diagnostics"]}
        self.assertIn((4, "300 is greater than the maximum of 100.0"), faults)
        self.assertIn((6, '"material" is a required property'), faults)
        self.assertTrue(any(line == 3 and "ground.profile is missing, or ground.road" in message
                            for line, message in faults))

        def labels(k):
            return [item["label"].strip('"') for item in told["found"][k]["completions"]]

        self.assertEqual(set(labels(0)), {"profile", "road", "road_start", "road_offset", "road_border",
                                          "fillet", "restitution", "impact", "obstacle", "patch", "friction.coefficient",
                                          "friction.slip_speed", "friction.pressure_exponent",
                                          "friction.pressure_reference"})
        self.assertEqual(labels(1)[:3], ["symplectic", "as-printed", "hati"])
        self.assertIn("Coulomb's coefficient of friction μ", told["found"][2]["hover"])
        self.assertIn("Allowed: 0 to 100; or a table [ground.friction]. Default: 0.0.", told["found"][2]["hover"])
        self.assertLess({"angular_velocity", "speed", "height", "camber"}, set(labels(3)))
        speed = next(i for i in told["found"][3]["completions"] if i["label"] == "speed")
        self.assertIn("Unit: m/s", speed["documentation"]["value"])
        self.assertEqual(set(labels(4)), {"name", "position"})

    def test_a_study_names_the_keys_of_cases(self):
        text = '#:schema ../schema/study.json\nschema = 1\n\n[[vary]]\nkey = ""\n'
        told = self.ask("cases/studies/new.toml", text, "4:7")
        labels = {item["label"].strip('"') for item in told["found"][0]["completions"]}
        self.assertLess({"ground.friction", "disk.mesh.radial", "rim.force_y"}, labels)


if __name__ == "__main__":
    main(TAPLO is not None and MODULES is not None)

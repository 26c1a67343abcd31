# SPDX-License-Identifier: BSD-3-Clause
"""scripts/env.sh: absolute paths, from any folder, once, in strict shells; it says what is missing. scripts/demo.sh
builds what README's examples take."""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "scripts" / "env.sh"
SHOW = '; printf "%s\\n%s\\n" "$PATH" "${PYTHONPATH:-}"'


def shell(command, program="bash", folder="/", **changes):
    kept = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    return subprocess.run([program, "-c", command], cwd=folder, capture_output=True, text=True,
                          env=kept | {"PATH": "/usr/bin:/bin"} | changes)


class Environment(unittest.TestCase):
    def paths(self, done):
        """(what was added to PATH, PYTHONPATH)"""
        self.assertEqual(done.returncode, 0, done.stderr)
        path, python = done.stdout.splitlines()
        self.assertTrue(path.endswith(":/usr/bin:/bin"), path)
        return path.removesuffix(":/usr/bin:/bin"), python

    def test_from_any_folder(self):
        expected = (str(ROOT / "build" / "release"), str(ROOT / "python"))
        self.assertEqual(self.paths(shell(f"source {SCRIPT}{SHOW}")), expected)
        self.assertEqual(self.paths(shell(f"source ../scripts/env.sh{SHOW}", folder=ROOT / "docs")),
                         expected)

    def test_twice_in_a_strict_shell(self):
        done = shell(f"set -euo pipefail; source {SCRIPT}; source {SCRIPT}{SHOW}", PYTHONPATH="/mine")
        self.assertEqual(self.paths(done), (str(ROOT / "build" / "release"), f"{ROOT}/python:/mine"))

    @unittest.skipUnless(shutil.which("zsh"), "there is no zsh")
    def test_in_zsh(self):
        done = shell(f"source scripts/env.sh; cd /; source {SCRIPT}{SHOW}", "zsh", ROOT)
        self.assertEqual(self.paths(done), (str(ROOT / "build" / "release"), str(ROOT / "python")))

    def test_what_is_missing_is_said(self):
        with tempfile.TemporaryDirectory() as folder:
            scripts = pathlib.Path(folder) / "a b" / "scripts"  # a path with a space
            scripts.mkdir(parents=True)
            shutil.copy(SCRIPT, scripts)
            done = shell(f"source '{scripts}/env.sh'{SHOW}")
            self.assertEqual(self.paths(done)[1], f"{scripts.parent}/python")
            self.assertIn("build/release/rondo is not built yet: bash scripts/demo.sh", done.stderr)
            python = pathlib.Path(folder) / "python3"
            python.write_text("#!/bin/sh\necho h5py\n")  # as one without the packages answers
            python.chmod(0o755)
            done = shell(f"PATH={folder}:$PATH; source '{scripts}/env.sh'")
            self.assertIn(f"{python} lacks: h5py.", done.stderr)
            self.assertIn("with /usr/bin/python3", done.stderr)
        self.assertIn("source scripts/env.sh", shell(f"bash {SCRIPT}").stderr)

    def test_the_demo_builds_the_library_for_python(self):
        demo = (ROOT / "scripts" / "demo.sh").read_text()
        targets = re.search(r"--target (.*)", demo)[1].split()
        bindings = (ROOT / "python" / "bindings" / "CMakeLists.txt").read_text()
        self.assertEqual(set(targets), {"rondo", re.search(r"set_target_properties\((\w+) PROPERTIES OUTPUT_NAME _core", bindings)[1]})


if __name__ == "__main__":
    unittest.main()

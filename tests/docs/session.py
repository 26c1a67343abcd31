# SPDX-License-Identifier: BSD-3-Clause
"""Runs the blocks of one page as a reader would: one shell, one Python, a copy of the project."""
import os
import pathlib
import shutil
import subprocess
import tempfile

from pages import ROOT, Block

# Blocks of Python, one after another in one namespace; each is named by a line on stdin.
PYTHON = """
import sys, traceback
names = {"__name__": "__main__"}
for path in map(str.strip, sys.stdin):
    try:
        exec(compile(open(path).read(), path, "exec"), names)
        if "plt" in names:
            names["plt"].close("all")
        said = "ok"
    except BaseException:
        traceback.print_exc()
        said = "failed"
    sys.stderr.flush()
    print("\\n" + said, file=sys.__stdout__, flush=True)
"""


class Session:
    """A folder with a copy of the project, in which blocks run; nothing leads back to the tree."""

    def __init__(self, program: pathlib.Path):
        self._folder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self._folder.name) / "rondo"
        self._state = pathlib.Path(self._folder.name) / "state"
        self._python: subprocess.Popen | None = None
        shutil.copytree(ROOT, self.root, ignore=shutil.ignore_patterns(
            ".git", "build", "results", "__pycache__", ".cache"))
        release = self.root / "build" / "release"
        release.mkdir(parents=True)
        for name in ("rondo", "rondo-mesh-reader"):
            if (program.parent / name).exists():
                (release / name).symlink_to(program.parent / name)
        environment = {key: value for key, value in os.environ.items()
                       if key not in ("RONDO", "RONDO_MESH_READER", "PYTHONPATH")}
        environment["PATH"] = "/usr/bin:" + environment["PATH"]  # Python with the packages
        self._environment = environment | {"MPLBACKEND": "Agg", "PYTHONDONTWRITEBYTECODE": "1"}
        self._state.write_text("")

    def close(self) -> None:
        if self._python:
            self._python.stdin.close()
            self._python.wait()
        self._folder.cleanup()

    def run(self, block: Block, seconds: float) -> str:
        """"" or what went wrong."""
        if block.mark == "file":
            path = self.root / block.reason
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(block.text)
            return ""
        return self._shell(block, seconds) if block.language == "sh" else self._exec(block)

    def _shell(self, block: Block, seconds: float) -> str:
        """What a block exports, the next one has."""
        text = (f"set -euo pipefail\nsource {self._state}\n{block.text}\nexport -p >{self._state}\n")
        try:
            done = subprocess.run(["bash", "-c", text], cwd=self.root, env=self._environment,
                                  text=True, errors="replace", stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, timeout=seconds)
        except subprocess.TimeoutExpired:
            return f"takes longer than {seconds:.0f} s"
        return "" if done.returncode == 0 else f"exit code {done.returncode}\n{done.stdout[-3000:]}"

    def _exec(self, block: Block) -> str:
        if self._python is None:
            self._python = subprocess.Popen(
                ["bash", "-c", f'source {self._state}; exec python3 -c "$0"', PYTHON], text=True,
                cwd=self.root, env=self._environment, stdin=subprocess.PIPE,
                stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        path = pathlib.Path(self._folder.name) / "block.py"
        path.write_text("\n" * (block.line - 1) + block.text)  # lines as in the page
        self._python.stdin.write(f"{path}\n")
        self._python.stdin.flush()
        said = []
        for line in self._python.stdout:
            if line in ("ok\n", "failed\n"):
                return "" if line == "ok\n" else "".join(said)[-3000:]
            said.append(line)
        return "Python ended\n" + "".join(said)[-3000:]

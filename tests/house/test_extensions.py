# SPDX-License-Identifier: BSD-3-Clause
"""What it takes to add a thing (docs/architecture.md): one of each is added to a copy of the
sources, its files are counted, and what it touches is compiled as far as its syntax goes.

A patch that no longer fits is made again by adding the thing to a branch: git diff > NAME.patch.
"""
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PATCHES = pathlib.Path(__file__).resolve().parent / "extensions"
# Files that are there already, at the most: those of the program, and all with the manual, whose
# tables a test writes.
MOST = {"key": (2, 3), "column": (1, 2), "scheme": (2, 3), "material": (3, 4), "analysis": (2, 3),
        "friction": (1, 1), "field": (8, 8)}


def files_of(patch):
    """(those that are there already, new ones)"""
    there, new = [], []
    for name, rest in re.findall(r"^diff --git a/(\S+) b/\S+\n(.*)$", patch, re.MULTILINE):
        (new if rest.startswith("new file") else there).append(name)
    return there, new


def syntax_faults(tree, names):
    """Of sources of one module, taken as one text, since most of the time goes to headers."""
    text = "".join(f'#include "{tree / name}"\n' for name in names)
    done = subprocess.run(
        [os.environ.get("CXX", "g++"), "-std=c++20", "-fsyntax-only", "-fopenmp", "-Wall", "-Wextra",
         "-Werror", "-DFMT_SHARED", "-DEIGEN_DONT_PARALLELIZE", f"-I{tree / 'src'}",
         f"-I{os.environ['RONDO_BUILD']}/generated", "-isystem", "/usr/include/eigen3",
         "-x", "c++", "-"], input=text, capture_output=True, text=True, check=False)
    return done.stderr if done.returncode else ""


class Extensions(unittest.TestCase):
    def test_files_to_touch(self):
        with tempfile.TemporaryDirectory() as folder:
            tree = pathlib.Path(folder)
            for part in "src", "docs":
                shutil.copytree(ROOT / part, tree / part)
            sources = set()
            for name, (program, everything) in MOST.items():
                patch = (PATCHES / f"{name}.patch").read_text()
                done = subprocess.run(["patch", "-p1", "--quiet", "-d", folder], input=patch, text=True,
                                      capture_output=True, check=False)
                self.assertEqual(done.returncode, 0, f"{name}: {done.stdout}")
                there, new = files_of(patch)
                self.assertLessEqual(len(there), everything, (name, there))
                self.assertLessEqual(sum(f.startswith("src/") for f in there), program, (name, there))
                sources |= {f for f in there + new if f.endswith(".cpp")}
            # A header that a thing touches is seen by one that includes it.
            sources.add("src/rondo/integrators/general/body_frames.cpp")
            modules = {}
            for name in sorted(sources):
                modules.setdefault(pathlib.Path(name).parts[:3], []).append(name)
            with concurrent.futures.ThreadPoolExecutor(2) as pool:
                for fault in pool.map(lambda names: syntax_faults(tree, names), modules.values()):
                    self.assertEqual(fault, "")

    def test_all_are_counted(self):
        self.assertEqual({p.stem for p in PATCHES.glob("*.patch")}, set(MOST))


if __name__ == "__main__":
    unittest.main()

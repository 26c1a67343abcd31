# SPDX-License-Identifier: BSD-3-Clause
"""Every source file says its licence in its first lines; that of data (cases, meshes, figures, what the
fuzzers keep) stands in .reuse/dep5, with the copyright of all. `reuse lint` (scripts/lint.sh) asks the
same of whatever is in the repository."""
import pathlib
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
LINE = "SPDX-License-Identifier" + ": BSD-3-Clause"  # in two: no line of this file's own
FOLDERS = (".ci", "apps", "bench", "cmake", "examples", "python", "scripts", "src", "studies", "tests")
SUFFIXES = {".c", ".cmake", ".cpp", ".css", ".geo", ".h", ".hpp", ".html", ".in", ".js", ".mjs", ".py",
            ".pyi", ".sh"}
FIRST = 3  # lines: a script begins with its interpreter
MADE = {"__pycache__", ".mypy_cache", "node_modules"}


def is_source(path):
    """Whatever has comments: by its name, or run by an interpreter that it names itself."""
    if path.suffix in SUFFIXES or path.name == "CMakeLists.txt":
        return True
    with path.open("rb") as file:
        return file.read(2) == b"#!"


def sources(root):
    found = [root / "CMakeLists.txt", root / "CITATION.cff"]
    for folder in FOLDERS:
        found += [path for path in sorted((root / folder).rglob("*"))
                  if path.is_file() and not MADE.intersection(path.parts) and is_source(path)]
    return [path for path in found if path.is_file()]


def without_line(root):
    for path in sources(root):
        head = path.read_text(errors="replace").splitlines()[:FIRST]
        if not any(LINE in line for line in head):
            yield f"{path.relative_to(root)}: no line `{LINE}` among its first {FIRST}"


class Licences(unittest.TestCase):
    def test_project(self):
        self.assertGreater(len(sources(ROOT)), 1000)
        self.assertEqual(list(without_line(ROOT)), [])

    def test_a_file_without_it_is_seen(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "scripts").mkdir()
            for name, text in (("a.py", f"# {LINE}\n"), ("b", f"#!/bin/sh\n# {LINE}\n"),
                               ("c", "#!/bin/sh\n"), ("d.hpp", f"\n\n\n// {LINE}\n"), ("data", "1\n")):
                (root / "scripts" / name).write_text(text)
            self.assertEqual([fault.split(":")[0] for fault in without_line(root)],
                             ["scripts/c", "scripts/d.hpp"])

    def test_one_text(self):
        """The copies for the package of Python and for REUSE are links."""
        text = (ROOT / "LICENSE").read_text()
        for name in ("python/LICENSE", "LICENSES/BSD-3-Clause.txt"):
            self.assertEqual((ROOT / name).read_text(), text, name)
        holder = text.splitlines()[2].removeprefix("Copyright (c) ").replace(",", "")
        self.assertIn(f"Copyright: {holder}\n", (ROOT / ".reuse" / "dep5").read_text())


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""One version: that of the CMake project. The package of Python, the citation, the changelog and the
pages that name it say the same, and the citation is what CFF 1.2.0 asks for."""
import os
import pathlib
import re
import subprocess
import unittest

import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("RONDO")


def text(name):
    return (ROOT / name).read_text()


def version():
    return re.search(r"^project\(rondo VERSION (\d+\.\d+\.\d+)", text("CMakeLists.txt"), re.M)[1]


class Version(unittest.TestCase):
    def named(self, file, pattern):
        found = re.findall(pattern, text(file), re.M)
        self.assertTrue(found, f"{file}: nothing like {pattern}")
        return set(found)

    def test_everywhere_the_same(self):
        minor = version().rsplit(".", 1)[0]
        for file, pattern, wanted in (
                ("python/rondo/__init__.py", r'^__version__ = "(.+)"$', version()),
                ("CITATION.cff", r"^version: (.+)$", version()),
                ("docs/python.md", r"rondo-(\d[\d.]*)-py3", version()),
                ("docs/install.md", r"rondo(?:-dev)?_(\d[\d.]*)_", version()),
                ("docs/library.md", r"find_package\(rondo ([\d.]+)\)", minor)):
            self.assertEqual(self.named(file, pattern), {wanted}, file)

    def test_changelog_and_citation_are_of_one_day(self):
        top = re.search(r"^## \[(.+)\] - (.+)$", text("CHANGELOG.md"), re.M)
        self.assertEqual(top[1], version())
        self.assertIn(f"date-released: {top[2]}\n", text("CITATION.cff"))

    @unittest.skipUnless(PROGRAM, "RONDO names no program")
    def test_program(self):
        said = subprocess.run([PROGRAM, "--version"], capture_output=True, text=True, check=True)
        self.assertEqual(said.stdout.split()[1], version())


class Citation(unittest.TestCase):
    """What the schema of CFF 1.2.0 asks of the keys that we use."""

    @classmethod
    def setUpClass(cls):
        cls.citation = yaml.safe_load(text("CITATION.cff"))

    def check_work(self, work, kinds):
        self.assertIn(work["type"], kinds)
        self.assertIsInstance(work["title"], str)
        for author in work["authors"]:
            person = {"family-names", "given-names"}
            self.assertTrue(set(author) == {"name"} or set(author) == person, author)
            self.assertTrue(all(isinstance(part, str) for part in author.values()), author)

    def test_software(self):
        self.assertEqual(self.citation["cff-version"], "1.2.0")
        self.assertIsInstance(self.citation["message"], str)
        self.check_work(self.citation, {"software"})
        self.assertEqual(self.citation["license"], "BSD-3-Clause")
        holder = text("LICENSE").splitlines()[2].split(", ", 1)[1]
        self.assertEqual(self.citation["authors"], [{"name": holder}])
        self.assertRegex(str(self.citation["date-released"]), r"^\d{4}-\d\d-\d\d$")
        allowed = {"cff-version", "message", "type", "title", "abstract", "authors", "version",
                   "date-released", "license", "keywords", "references", "repository-code", "url"}
        self.assertEqual(set(self.citation) - allowed, set())

    def test_references(self):
        allowed = {"type", "title", "authors", "collection-title", "journal", "volume", "start", "end",
                   "year", "url", "doi", "notes"}
        for work in self.citation["references"]:
            self.check_work(work, {"article", "conference-paper"})
            self.assertIsInstance(work["year"], int)
            self.assertEqual(set(work) - allowed, set())
            if "doi" in work:
                self.assertRegex(work["doi"], r"^10\.\d{4,9}(\.\d+)?/[A-Za-z0-9:/_;\-.()\[\]]+$")
        dois = " ".join(work.get("doi", work.get("url", "")) for work in self.citation["references"])
        for named in ("hal-01899327", "10.1007/s00466-017-1397-0"):  # in docs/theory.md too
            self.assertIn(named, dois)
            self.assertIn(named, text("docs/theory.md"))


if __name__ == "__main__":
    unittest.main()

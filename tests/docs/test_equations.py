# SPDX-License-Identifier: BSD-3-Clause
"""Numbers of equations in docs/theory.md: each is there once, in its own section, and whatever the page or a
comment of the code cites is an equation or a section of it."""
import pathlib
import re
import unittest

from pages import ROOT

THEORY = (ROOT / "docs" / "theory.md").read_text(encoding="utf-8")
TAG = re.compile(r"\\tag\{([^}]*)\}")
CITED = re.compile(r"\((\d{1,2}\.\d{1,2}[a-z]?)\)")
TABLE = "5.3"  # a table, which holds no \tag


def sections(page: str) -> list[tuple[set[str], str]]:
    """The numbers in each heading, and the text below it."""
    parts = re.split(r"^#{2,3} (.+)$", page, flags=re.MULTILINE)
    return [(set(re.findall(r"(?<![\w.])(?:A|\d{1,2})(?:\.\d{1,2})?(?![\w.])", heading)), text)
            for heading, text in zip(parts[1::2], parts[2::2])]


def comment_of(line: str) -> str:
    return line.partition("//")[2]


class Equations(unittest.TestCase):
    def setUp(self) -> None:
        self.tags = TAG.findall(THEORY)
        self.known = {*self.tags, TABLE, *(number for numbers, _ in sections(THEORY) for number in numbers)}

    def test_each_number_is_there_once(self) -> None:
        self.assertGreater(len(self.tags), 100)
        self.assertEqual([tag for tag in self.tags if self.tags.count(tag) > 1], [])

    def test_each_equation_is_in_its_section(self) -> None:
        wrong = []
        for numbers, text in sections(THEORY):
            for tag in TAG.findall(text):
                own = re.sub("[a-z]$", "", tag)
                if not numbers & {own, own.partition(".")[0]} and not own.startswith("A."):
                    wrong.append((tag, numbers))
        self.assertEqual(wrong, [])

    def test_what_the_page_cites_is_there(self) -> None:
        self.assertEqual(sorted(set(CITED.findall(THEORY)) - self.known), [])

    def test_what_the_code_cites_is_there(self) -> None:
        unknown = []
        files = [f for folder in ("src", "apps") for f in sorted((ROOT / folder).rglob("*.[ch]pp"))]
        self.assertGreater(len(files), 300)
        for file in files:
            for at, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
                for number in CITED.findall(comment_of(line)):
                    if number not in self.known and not number.startswith("0."):
                        unknown.append(f"{pathlib.Path(file).relative_to(ROOT)}:{at}: ({number})")
        self.assertEqual(unknown, [])


if __name__ == "__main__":
    unittest.main()

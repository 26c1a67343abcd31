# SPDX-License-Identifier: BSD-3-Clause
"""Relative links and anchors of all pages lead somewhere, files that they name are there; the parser of blocks finds
what it should."""
import functools
import pathlib
import re
import sys
import unittest

from pages import ROOT, PageError, all_pages, blocks_of, page_name

sys.path.insert(0, str(ROOT / "scripts" / "site"))
from github import anchor  # noqa: E402


def outside_of_code(text: str) -> str:
    text = re.sub(r"^( *)```.*?^\1```$", "", text, flags=re.MULTILINE | re.DOTALL)
    return re.sub(r"`[^`\n]*`", lambda code: code[0] if "](" not in code[0] else "", text)


@functools.cache
def anchors(page: pathlib.Path) -> set[str]:
    found: dict[str, int] = {}
    for heading in re.findall(r"^#{1,6} +(.*)$", outside_of_code(page.read_text()), re.MULTILINE):
        name = anchor(heading)
        found[name] = found.get(name, 0) + 1
    return {name if k == 0 else f"{name}-{k}" for name, n in found.items() for k in range(n)}


def broken(page: pathlib.Path, text: str) -> list[str]:
    """The links of the page that lead nowhere."""
    wrong = []
    for target in re.findall(r"\]\(([^)\s]+)\)", outside_of_code(text)):
        if re.match(r"[a-z]+:", target):
            continue
        path, _, name = target.partition("#")
        goal = (page.parent / path).resolve() if path else page
        if not goal.exists():
            wrong.append(f"{target}: no such file")
        elif name and (goal.suffix != ".md" or name not in anchors(goal)):
            wrong.append(f"{target}: no such heading")
    return wrong


@functools.cache
def files() -> list[str]:
    return ["/" + str(path.relative_to(ROOT)) for folder in ("apps", "bench", "cases", "cmake", "docs", "examples",
            "python", "scripts", "src", "studies", "tests") for path in (ROOT / folder).rglob("*") if path.is_file()]


def gone(text: str) -> list[str]:
    """Files of the project, `folder/name.cpp`, of which there is none; what is built, and names in capitals that
    stand for others, apart."""
    named = re.findall(r"`((?:[\w.-]+/)+[\w.-]+\.(?:cpp|hpp|py|sh|cmake|txt|patch|msh|geo|mjs))`", text)
    return [name for name in named if not re.match(r"build/|rondo/core/version.hpp", name)
            and not re.search(r"[A-Z]{3}", name) and not any(file.endswith("/" + name) for file in files())]


class Links(unittest.TestCase):
    def test_all_of_them(self):
        pages = all_pages()
        self.assertGreater(len(pages), 40)
        wrong = [f"{page_name(page)}: {text}" for page in pages
                 for text in broken(page, page.read_text())]
        self.assertEqual(wrong, [])

    def test_files_that_are_named_are_there(self):
        self.assertEqual([f"{page_name(page)}: {name}" for page in all_pages() for name in gone(page.read_text())], [])
        self.assertEqual(gone("`contact/ground.cpp` `contact/gone.cpp` `build/a/b.txt` `fuzz/NAME_fuzz.cpp`"),
                         ["contact/gone.cpp"])

    def test_a_broken_one_is_found(self):
        page = next(page for page in all_pages() if page.name == "architecture.md")
        text = "[a](theory.md) [b](theory.md#nowhere) [c](gone.md) [d](#modules) `[e](gone.md)`"
        self.assertEqual(broken(page, text), ["theory.md#nowhere: no such heading",
                                              "gone.md: no such file"])


class Blocks(unittest.TestCase):
    def test_marks(self):
        text = ("```sh\na\n```\n<!-- long: minutes -->\n```sh\nb\n```\n"
                "<!-- file: c.toml -->\n```toml\nc = 1\n```\n")
        self.assertEqual([(b.line, b.mark, b.reason, b.text, b.runs) for b in blocks_of("p", text)],
                         [(2, "", "", "a\n", True), (6, "long", "minutes", "b\n", True),
                          (10, "file", "c.toml", "c = 1\n", False)])

    def test_commands_that_nobody_would_run(self):
        for text, said in (("    rondo run x\n", "p:1: a command in an indented block"),
                           ("```\nrondo run x\n```\n", "p:1: commands in a block without language"),
                           ("```bash\nls\n```\n", "p:1: a block of bash")):
            with self.assertRaisesRegex(PageError, said):
                blocks_of("p", text)


if __name__ == "__main__":
    unittest.main()

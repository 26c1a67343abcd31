# SPDX-License-Identifier: BSD-3-Clause
"""The pages of the documentation and the blocks of code in them.

A comment on the line before a block says what is to be done with it:
    <!-- file: NAME -->              the block is the text of that file, which the reader makes
    <!-- long: REASON -->            run by docs_commands_long alone
    <!-- not run here: REASON -->    run by no test of the pages
"""
import dataclasses
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
RUN = ("sh", "python")
SHOWN = ("", "toml", "geo", "cmake", "cpp", "csv")  # outputs and files
MARK = re.compile(r"^<!-- (file|long|not run here): (.+) -->$")
COMMAND = re.compile(r"^\s*(PYTHONPATH=|\S*rondo |\S*python3 |bash |cmake |ctest |mpirun |source |build/)")


class PageError(Exception):
    """A page that does not keep the rules above: page, line, what is wrong."""


@dataclasses.dataclass(frozen=True)
class Block:
    page: str      # path in the project
    line: int      # of its first line, from 1
    language: str
    text: str
    mark: str      # "", or what stands in its comment: "file", "long", "not run here"
    reason: str    # or the file's name

    @property
    def place(self) -> str:
        return f"{self.page}:{self.line}"

    @property
    def runs(self) -> bool:
        return self.language in RUN and self.mark != "file"

    @property
    def head(self) -> str:
        """Its first command."""
        return next((line.strip() for line in self.text.splitlines()
                     if line and line[0] != "#" and not line.startswith("source scripts/env.sh")),
                    self.text.strip())


def pages_with_commands() -> list[pathlib.Path]:
    """All of them, so that no block is left out; the first page and those of docs/ before the others."""
    first = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]
    return first + sorted(set(all_pages()) - set(first))


def all_pages() -> list[pathlib.Path]:
    return [page for page in ROOT.rglob("*.md")
            if not {"build", "results", ".git"} & set(page.relative_to(ROOT).parts)]


def blocks_of(name: str, text: str) -> list[Block]:
    """The fenced blocks of a page, in order; a PageError for one that nobody would run."""
    found, lines, at = [], text.splitlines(), 0
    while at < len(lines):
        fence = re.match(r"^( *)```(\w*)$", lines[at])
        if not fence:
            if re.match(r" {4}", lines[at]) and COMMAND.match(lines[at]):
                raise PageError(f"{name}:{at + 1}: a command in an indented block: fence it by ```sh")
            at += 1
            continue
        indent, language = fence.groups()
        mark = MARK.match(lines[at - 1].strip()) if at else None
        first = at + 1
        at = first
        while lines[at] != f"{indent}```":
            at += 1
        inside = [line[len(indent):] for line in lines[first:at]]
        at += 1
        if language not in RUN + SHOWN:
            raise PageError(f"{name}:{first}: a block of {language}; known: {', '.join(RUN + SHOWN)}")
        if language == "" and inside and re.match(r"\S*rondo (run|pod|sweep)", inside[0]):
            raise PageError(f"{name}:{first}: commands in a block without language: write ```sh")
        found.append(Block(name, first + 1, language, "\n".join(inside) + "\n",
                           mark[1] if mark else "", mark[2] if mark else ""))
    return found


def page_name(page: pathlib.Path) -> str:
    return page.relative_to(ROOT).as_posix()

# SPDX-License-Identifier: BSD-3-Clause
"""What the program says of itself by --help, as data: commands, arguments, options, and what it adds
below them. What cannot be read is an error, so that no page leaves out an option in silence."""
from __future__ import annotations

import concurrent.futures
import dataclasses
import re
import subprocess

COLUMN = 30  # of the descriptions
TYPES = {"TEXT": "text", "INT": "integer", "UINT": "integer", "FLOAT": "number"}
CHOICE = re.compile(r": ([A-Za-z0-9_.-]+(?: \| [A-Za-z0-9_.-]+)+)$")
NAMES = re.compile(r"(-[A-Za-z]|--[a-z][a-z0-9-]*)(,--[a-z][a-z0-9-]*)*|[a-z][a-z0-9_-]*")


@dataclasses.dataclass
class Entry:
    """A command, an argument or an option."""
    names: list[str]
    value: str = ""  # what it takes: text, integer, number, a name of its own, or nothing
    meaning: str = ""
    default: str = ""
    allowed: str = ""  # what CLI11 checks, in its words
    needs: str = ""
    excludes: str = ""
    required: bool = False
    many: bool = False

    @property
    def choices(self) -> list[str]:
        found = CHOICE.search(self.meaning) if self.value else None
        return found[1].split(" | ") if found else []


@dataclasses.dataclass
class Help:
    meaning: str
    commands: list[Entry]
    arguments: list[Entry]
    options: list[Entry]
    examples: list[str]
    notes: list[str]


def entry(head: str, meaning: str) -> Entry:
    """head: "--threads INT:INT in [1 - 1024]=2 Needs: --reduced"."""
    names, _, rest = head.partition(" ")
    if not NAMES.fullmatch(names):
        raise ValueError(f"help: no name of a command, argument or option: {head!r}")
    made = Entry(names.split(","), meaning=meaning)
    for word in ("Excludes", "Needs"):
        rest, _, others = rest.partition(f"{word}:")
        setattr(made, word.lower(), " ".join(others.split()))
        rest = rest.strip()
    made.required = "REQUIRED" in rest.split()
    rest, twice = re.subn(r" x \d+$", "", rest)  # values of an option that takes so many
    made.many = "..." in rest.split() or bool(twice)
    rest = " ".join(word for word in rest.split() if word not in ("REQUIRED", "..."))
    found = re.fullmatch(r"([A-Z]+)?(?::([^=]*))?(?:=(.*))?", rest)
    if found is None:
        raise ValueError(f"help: not understood: {head!r}")
    kind, allowed, default = (part or "" for part in found.groups())
    made.value, made.default = TYPES.get(kind, kind.lower()), default
    made.allowed = re.sub(r"in \[(\S+) - (\S+)\]", r"\1 to \2", allowed.removeprefix(kind).strip())
    return made


def _split(line: str, after: str) -> int:
    """Where the description begins; in the next line, where a long name has its own, though a blank of it
    may stand just before the column."""
    if line[COLUMN - 1:COLUMN] != " " or line[COLUMN:COLUMN + 1] in ("", " "):
        return len(line)
    goes_on = after.startswith(" " * COLUMN)
    return COLUMN if line[COLUMN - 2] == " " or not goes_on else len(line)


def _entries(lines: list[str]) -> list[Entry]:
    found: list[list[str]] = []
    for line, after in zip(lines, [*lines[1:], ""]):
        if re.match(r"  \S", line):
            split = _split(line, after)
            found.append([line[:split].strip(), line[split:].strip()])
        else:
            found[-1][1] = f"{found[-1][1]} {line.strip()}".strip()
    return [entry(head, meaning) for head, meaning in found]


def read(text: str) -> Help:
    blocks = [block.splitlines() for block in re.split(r"\n\s*\n", text.strip())]
    top, below = blocks[0], blocks[1:]
    made = Help(" ".join(line for line in top if not line.startswith("Usage:")), [], [], [], [], [])
    for lines in below:
        heading = lines[0]
        if heading.startswith("Example"):
            shown = [line for line in lines[1:] if line.startswith("  ")]
            made.examples += [line.strip() for line in shown]
            made.notes += [line for line in lines[1:] if line not in shown]
        elif len(lines) > 1 and heading.endswith(":") and re.match(r"  \S", lines[1]):
            kept = {"Subcommands": made.commands, "Positionals": made.arguments}
            kept.get(heading[:-1], made.options).extend(_entries(lines[1:]))
        else:
            made.notes += lines
    if not made.options:
        raise ValueError(f"help: no options in {text[:200]!r}")
    return made


def run(program: str, *arguments: str) -> str:
    return subprocess.run([program, *arguments], capture_output=True, text=True, check=True).stdout


def of_program(program: str) -> tuple[Help, dict[str, Help]]:
    """Its own, and those of its commands."""
    top = read(run(program, "--help"))
    names = [command.names[0] for command in top.commands]
    with concurrent.futures.ThreadPoolExecutor() as together:  # those in Python take a third of a second each
        texts = together.map(lambda name: run(program, name, "--help"), names)
    return top, {name: read(text) for name, text in zip(names, texts)}

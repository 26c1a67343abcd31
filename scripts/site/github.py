# SPDX-License-Identifier: BSD-3-Clause
"""From Markdown as GitHub reads it to Markdown as mkdocs reads it: blank lines where the latter needs
them, the anchors of the former, no comments, links to what the site has."""
import re
from collections.abc import Callable

FENCE = re.compile(r"^ *```")
LIST_ITEM = re.compile(r"^( *)([-*+]|\d+\.) +")
HEADING = re.compile(r"^(#{1,6}) +(.*?) *$")
LINK = re.compile(r"(\]\()([^)\s]+)(\))")
CODE_OR_LINK = re.compile(r"(`+)(?!`).*?(?<!`)\1(?!`)|" + LINK.pattern, re.DOTALL)


def anchor(heading: str) -> str:
    """The anchor that GitHub makes of a heading: lower case, words joined by dashes, no other signs."""
    heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
    return re.sub(r"[^\w\- ]", "", heading).replace(" ", "-")


def split_fences(text: str) -> list[tuple[bool, str]]:
    """Pieces of the text, in order: (is a fenced block, its lines)."""
    pieces: list[tuple[bool, list[str]]] = [(False, [])]
    inside = False
    for line in text.splitlines():
        if FENCE.match(line) and not inside:
            pieces.append((True, [line]))
            inside = True
            continue
        pieces[-1][1].append(line)
        if inside and FENCE.match(line):
            pieces.append((False, []))
            inside = False
    return [(fenced, "\n".join(lines)) for fenced, lines in pieces if lines]


def mapped_links(text: str, goal: Callable[[str], str | None]) -> str:
    """Links outside of code, their targets by `goal`; None: what is linked stays, the link goes."""

    def one(found: re.Match[str]) -> str:
        if found[1]:
            return found[0]
        to = goal(found[3])
        return f"{found[2]}{to}{found[4]}" if to is not None else f"{found[2]}\0)"

    text = CODE_OR_LINK.sub(one, text)
    return re.sub(r"(?<!!)\[((?:`[^`]*`|[^\]`])*)\]\(\0\)", r"\1", text)


class _Prose:
    """The lines outside of fences, one after another."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self._in_maths = False
        self._seen: dict[str, int] = {}

    def _blank(self) -> None:
        if self.lines and self.lines[-1].strip():
            self.lines.append("")

    def _heading(self, line: str, found: re.Match[str]) -> str:
        name = anchor(found[2])
        again = self._seen.get(name, 0)
        self._seen[name] = again + 1
        return f"{line} {{: #{name}{f'-{again}' if again else ''} }}"

    def _starts_block(self, line: str) -> bool:
        """A list or a table right after a paragraph, which GitHub sees and Python-Markdown does not."""
        before = self.lines[-1] if self.lines else ""
        if not before.strip() or LIST_ITEM.match(before) or before.startswith((" ", "|")):
            return False
        item = LIST_ITEM.match(line)
        return line.startswith("|") or bool(item and not item[1] and item[2] in "-*+1.")

    def add(self, line: str) -> None:
        if self._in_maths or line.lstrip().startswith("$$"):
            if not self._in_maths:
                self._blank()
            rest = line.strip() if self._in_maths else line.strip()[2:]
            self.lines.append(line)
            self._in_maths = not rest.endswith("$$")
            if not self._in_maths:
                self.lines.append("")
            return
        if heading := HEADING.match(line):
            self._blank()
            line = self._heading(line, heading)
        elif self._starts_block(line):
            self._blank()
        self.lines.append(line)


def converted(text: str, goal: Callable[[str], str | None]) -> str:
    prose = _Prose()
    for fenced, piece in split_fences(re.sub(r"^ *<!--.*?-->\n", "", text,
                                             flags=re.MULTILINE | re.DOTALL)):
        if fenced:
            prose.lines.extend(indented(piece).splitlines())
            continue
        for line in mapped_links(piece, goal).splitlines():
            prose.add(line)
    return "\n".join(prose.lines) + "\n"


def indented(fence: str) -> str:
    """A block in a list item stands four columns in, for Python-Markdown, not two, and after a blank."""
    lines = fence.splitlines()
    margin = len(lines[0]) - len(lines[0].lstrip())
    if margin == 0:
        return "\n" + fence + "\n"
    return "\n" + "\n".join(" " * 4 + line[margin:] for line in lines) + "\n"

# SPDX-License-Identifier: BSD-3-Clause
"""Text as man(7) takes it."""
from __future__ import annotations

import re


def escape(text: str) -> str:
    for plain, meant in (("\\", r"\e"), ("-", r"\-"), ("'", r"\(aq"), ("`", r"\(ga"), ("^", r"\(ha"),
                         ("~", r"\(ti")):
        text = text.replace(plain, meant)
    return text


def prose(text: str) -> str:
    """Words; no line of it is taken for a request."""
    text = re.sub(r"\s+", " ", text).strip()
    return r"\&" + escape(text) if text.startswith(("." , "'")) else escape(text)


def bold(text: str) -> str:
    return rf"\fB{escape(text)}\fR"


def italic(text: str) -> str:
    return rf"\fI{escape(text)}\fR"


class Page:
    def __init__(self, name: str, section: int, date: str, version: str, manual: str):
        """date: of the version, so that the same sources give the same page."""
        self.lines = [f'.TH "{escape(name.upper())}" "{section}" "{date}" "rondo {version}" "{manual}"',
                      ".nh", ".ad l"]

    def heading(self, text: str) -> Page:
        self.lines.append(f'.SH "{text}"')
        return self

    def subheading(self, text: str) -> Page:
        self.lines.append(f'.SS "{escape(text)}"')
        return self

    def paragraph(self, *lines: str) -> Page:
        """lines: troff already."""
        if self.lines[-1].split()[0] not in (".SH", ".SS"):
            self.lines.append(".PP")
        self.lines += lines
        return self

    def item(self, term: str, *lines: str) -> Page:
        self.lines += [".TP", term, *lines]
        return self

    def commands(self, lines: list[str]) -> Page:
        """As typed, each in a line."""
        self.paragraph(".RS 4", ".nf")
        self.lines += [(r"\&" if line.startswith((".", "'")) else "") + escape(line) for line in lines]
        self.lines += [".fi", ".RE"]
        return self

    def text(self) -> str:
        return "\n".join(self.lines) + "\n"

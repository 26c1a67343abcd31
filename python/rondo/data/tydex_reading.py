# SPDX-License-Identifier: BSD-3-Clause
"""Reading of TYDEX files; the format is described in tydex.py."""
from __future__ import annotations

import difflib
import math
import os
import pathlib
import re
from typing import NoReturn

import numpy as np
from numpy.typing import NDArray

from .errors import FileError
from .plain_files import NUMBER, foreign_lines
from .si import near, unit_named
from .tydex import LONGEST_LINE, MISSING, NAME, TEXT, UNIT, WIDTH, Channel, Constant, Tydex

Array = NDArray[np.float64]

BLOCKS = ("HEADER", "COMMENTS", "CONSTANTS", "MEASURCHANNELS", "MEASURDATA", "MODELDEFINITION", "MODELPARAMETERS",
          "MODELCOEFFICIENTS", "MODELCHANNELS", "MODELOUTPUTS", "MODELEND", "END")
KEPT = ("MODELDEFINITION", "MODELCOEFFICIENTS", "MODELCHANNELS", "MODELOUTPUTS")  # as lines, not interpreted


def read_tydex(path: str | os.PathLike[str]) -> Tydex:
    """Reads a TYDEX file; blocks in any order, those without which the numbers mean something may be missing.
    @raise FileError: it is damaged or says what is not done, with its line and what to do."""
    file = pathlib.Path(path)
    return _Reader(file).read()


class _Reader:
    """Lines of a file, and complaints that name them."""

    def __init__(self, file: pathlib.Path) -> None:
        self.file = file
        self.lines = foreign_lines(file, "a TYDEX file")
        self.blocks: dict[str, tuple[int, list[tuple[int, str]]]] = {}  # keyword: its line, the lines below it
        self.said: dict[str, str] = {}  # what stands behind a keyword

    def refuse(self, number: int, text: str) -> NoReturn:
        raise FileError(f"{self.file}, line {number}: {text}")

    def read(self) -> Tydex:
        self._split()
        channels = self._channels()
        header = {name: value for _, name, _, value in self._table("HEADER", TEXT)}
        comments = tuple(line.rstrip() for _, line in self.blocks.get("COMMENTS", (0, []))[1])
        other = {name: tuple(line.rstrip() for _, line in self.blocks[name][1]) for name in KEPT if name in self.blocks}
        return Tydex(channels, self._data(channels), header, comments, self._constants("CONSTANTS"),
                     self._constants("MODELPARAMETERS"), other, self.file)

    def _split(self) -> None:
        keyword = ""
        for number, line in enumerate(self.lines, start=1):
            if line.startswith("**"):
                keyword = self._keyword(number, line)
            elif keyword == "END" and line.strip():
                self.refuse(number, f"{line.strip()[:30]!r} stands behind **END (allowed: nothing): move **END to the "
                                    "end")
            elif keyword:
                if keyword == "COMMENTS" or (line.strip() and not line.startswith("!")):
                    self.blocks[keyword][1].append((number, line))
            elif line.strip() and not line.startswith("!"):
                self.refuse(number, f"{line.strip()[:30]!r} stands before the first keyword (allowed: a keyword as "
                                    "**HEADER): it is no TYDEX file, or its beginning is missing")
        if "COMMENTS" in self.blocks:
            lines = self.blocks["COMMENTS"][1]
            while lines and not lines[-1][1].strip():
                lines.pop()
        if "END" not in self.blocks:
            self.refuse(len(self.lines), "the file ends without **END (allowed: **END as the last line): its end may "
                                         "be missing; add **END if it is whole")

    def _keyword(self, number: int, line: str) -> str:
        words = line[2:].split()
        name = words[0].upper() if words else ""
        if name not in BLOCKS:
            close = difflib.get_close_matches(name, BLOCKS, 1, 0.6)
            self.refuse(number, f"keyword **{name} is not known (allowed: {', '.join(BLOCKS)})"
                        + (f"; **{close[0]}?" if close else ""))
        if name in self.blocks:
            self.refuse(number, f"**{name} stands here and in line {self.blocks[name][0]} (allowed: once in a file): "
                                "write each measurement into a file of its own")
        self.blocks[name] = (number, [])
        self.said[name] = " ".join(words[1:])
        return name

    def _table(self, block: str, end: int) -> list[tuple[int, str, str, str]]:
        """Line, name, text and what is behind column `end` of each line."""
        rows: list[tuple[int, str, str, str]] = []
        seen: dict[str, int] = {}
        for number, line in self.blocks.get(block, (0, []))[1]:
            if "\t" in line:
                self.refuse(number, f"a tabulator in **{block}, whose fields are columns (allowed: blanks): replace "
                                    "it by blanks")
            name, text = line[:NAME].strip(), line[NAME:TEXT].strip()
            if not name or " " in name:
                self.refuse(number, f"{line[:NAME]!r} in columns 1 to {NAME} is no name (allowed: a name without "
                                    "blanks that begins in column 1)")
            if name in seen:
                self.refuse(number, f"{name} stands here and in line {seen[name]} of **{block} (allowed: once): "
                                    "rename one")
            seen[name] = number
            rows.append((number, name, text, line[end:].strip()))
        return rows

    def _channels(self) -> dict[str, Channel]:
        channels = {}
        for number, name, text, rest in self._table("MEASURCHANNELS", UNIT):
            unit = self.lines[number - 1][TEXT:UNIT].strip()
            words = rest.split()
            if len(words) > 3:
                self.refuse(number, f"{len(words)} numbers behind the unit of {name} (allowed: a conversion factor "
                                    "and two offsets, from column 51)")
            factor = self._number(number, words[0], f"conversion factor of {name}") if words else 1.0
            if factor == 0 or math.isnan(factor):
                self.refuse(number, f"conversion factor {words[0]} of {name} (allowed: any number but 0): put 1 if "
                                    "the numbers are in the unit of the channel")
            for word in words[1:]:
                if self._number(number, word, f"offset of {name}") != 0:
                    self.refuse(number, f"offset {word} of {name} (allowed: 0): which sign and unit an offset has is "
                                        "not agreed upon; add it to the data, and put 0")
            known = unit_named(unit)
            if known is None:
                self.refuse(number, f"unit {unit!r} of {name} in columns 41 to 50 is not known (allowed: among others "
                                    f"{near(unit)})")
            channels[name] = Channel(name, text, unit, known.si, factor * known.factor, factor)
        return channels

    def _constants(self, block: str) -> dict[str, Constant]:
        constants = {}
        for number, name, text, value in self._table(block, UNIT):
            unit = self.lines[number - 1][TEXT:UNIT].strip()
            if not value:
                self.refuse(number, f"{name} of **{block} has no value (allowed: a number or a text from column 51): "
                                    "is the line shifted?")
            if not NUMBER.fullmatch(value):
                if re.fullmatch(r"[+-]?\d+,\d+", value):
                    self._number(number, value, name)
                constants[name] = Constant(name, text, unit, value)
                continue
            known = unit_named(unit)
            if known is None:
                self.refuse(number, f"unit {unit!r} of {name} in columns 41 to 50 is not known (allowed: among others "
                                    f"{near(unit)})")
            constants[name] = Constant(name, text, unit, self._number(number, value, name) * known.factor, known.si)
        return constants

    def _data(self, channels: dict[str, Channel]) -> Array:
        if "MEASURDATA" not in self.blocks:
            if channels:
                self.refuse(self.blocks["MEASURCHANNELS"][0], f"**MEASURCHANNELS names {len(channels)} channels, and "
                                                              "there is no **MEASURDATA (allowed: both or neither): "
                                                              "the numbers are missing")
            return np.empty((0, 0))
        begin, lines = self.blocks["MEASURDATA"]
        if not channels:
            self.refuse(begin, "**MEASURDATA without a line in **MEASURCHANNELS (allowed: one for each number of a "
                               "row): nothing says what the numbers are; add them")
        rows: list[list[float]] = []
        part: list[float] = []
        for number, line in lines:
            part += self._fields(number, line, len(channels), len(part))
            if len(part) == len(channels):
                rows.append(part)
                part = []
        if part:
            self.refuse(lines[-1][0], f"the last row has {len(part)} of {len(channels)} numbers (allowed: all of "
                                      "them): its end is missing; complete or remove it")
        self._check_count(begin, len(rows))
        return np.array(rows).reshape(len(rows), len(channels)) * np.array([one.to_si for one in channels.values()])

    def _check_count(self, begin: int, rows: int) -> None:
        said = self.said["MEASURDATA"]
        if said.isdigit() and int(said) != rows:
            self.refuse(begin, f"**MEASURDATA {said}, and there are {rows} rows (allowed: their number, or none): "
                               "rows are missing or too many")

    def _fields(self, number: int, line: str, n: int, before: int) -> list[float]:
        """The numbers of a line: a whole row, or a part of eight fields of a row that goes on."""
        words = line.split()
        wanted: tuple[int, ...] = (n - before,)
        per_line = LONGEST_LINE // WIDTH
        if n - before > per_line:
            wanted += (per_line,)
        if not (len(words) in wanted and all(_is_number(word) for word in words)):
            fixed = [line[k:k + WIDTH].strip() for k in range(0, len(line.rstrip()), WIDTH)]
            if len(fixed) in wanted and all(_is_number(word) for word in fixed):
                words = fixed
        if len(words) not in wanted:
            self.refuse(number, f"{len(words)} numbers in a row of {n} channels"
                        + (f", {before} of which stand in the lines before" if before else "")
                        + " (allowed: as many as channels): a number is missing or too many")
        return [self._number(number, word, f"field {before + k} of {n}") for k, word in enumerate(words, start=1)]

    def _number(self, number: int, word: str, what: str) -> float:
        if word.upper() == MISSING:
            return math.nan
        if not NUMBER.fullmatch(word):
            hint = ": write a decimal point" if re.fullmatch(r"[+-]?\d+,\d+", word) else ""
            self.refuse(number, f"{word!r} as {what} is no number (allowed: a number, or {MISSING}){hint}")
        value = float(word.upper().replace("D", "E"))
        if not math.isfinite(value):
            self.refuse(number, f"{word!r} as {what} is too large (allowed: a finite number)")
        return value


def _is_number(word: str) -> bool:
    return word.upper() == MISSING or NUMBER.fullmatch(word) is not None

# SPDX-License-Identifier: BSD-3-Clause
"""Files of tyre measurements in the TYDEX format, release 1.3 (Unrau, Zamow 1997): rondo.files.read_tydex,
write_tydex, tydex (docs/tyre-files.md).

A file is blocks, each after a line with its keyword. A line of HEADER is a name in columns 1 to 10, a text in
11 to 40, a value in 41 to 80; of CONSTANTS and MODELPARAMETERS name, text, unit in 41 to 50, value; of
MEASURCHANNELS name, text, unit, conversion factor in 51 to 60 and two offsets. MEASURDATA has a row of numbers
for each instant, a field of ten columns for each channel. A number times the factor of its channel is in the
unit of the channel."""
from __future__ import annotations

import math
import os
import pathlib
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import FileError, InputError, unknown
from .si import near, unit_named

Array = NDArray[np.float64]

NAME, TEXT, UNIT, WIDTH = 10, 40, 50, 10  # ends of columns; width of a number
MISSING = "NOTAVAIL"  # in the place of a number
LONGEST_NAME, LONGEST_LINE = 8, 80

CHANNELS = {  # those that a tyre test writes: text and unit; forces and angles in the axes W
    "RUNTIME": ("Time", "s"), "LONGVEL": ("Speed along the heading", "m/s"),
    "WHROTSPD": ("Spin of the wheel", "rad/s"), "SLIPANGL": ("Slip angle", "deg"),
    "LONGSLIP": ("Longitudinal slip", "-"), "INCLANGL": ("Inclination angle", "deg"),
    "INFLPRES": ("Inflation pressure", "kPa"), "FX": ("Longitudinal force", "N"), "FYW": ("Lateral force", "N"),
    "FZW": ("Vertical force", "N"), "MXW": ("Overturning moment", "Nm"), "MYW": ("Rolling resistance moment", "Nm"),
    "MZW": ("Aligning moment", "Nm"), "DSTGRWHC": ("Height of the wheel center", "m"),
    "MU": ("Coefficient of friction", "-")}


@dataclass(frozen=True)
class Constant:
    """A line of CONSTANTS or MODELPARAMETERS."""

    name: str
    text: str
    unit: str           # as in the file
    value: float | str  # in SI (si.Unit); str where it is no number
    si: str = ""        # unit of the number; "": a text


@dataclass(frozen=True)
class Channel:
    """A column of the data."""

    name: str            # at most 8 characters, as "FYW"
    text: str            # at most 30
    unit: str            # of the numbers in the file times `factor`
    si: str              # of the column in `Tydex.data`
    to_si: float         # a number in the file times this is in `si`: factor and unit in one
    factor: float = 1.0  # conversion factor in the file


@dataclass(frozen=True)
class Tydex:
    """What a file says. tydex["FYW"] is a column in SI; len() the number of rows."""

    channels: dict[str, Channel]
    data: Array                              # (rows, channels) SI, NaN where NOTAVAIL
    header: dict[str, str] = field(default_factory=dict)
    comments: tuple[str, ...] = ()
    constants: dict[str, Constant] = field(default_factory=dict)
    parameters: dict[str, Constant] = field(default_factory=dict)  # MODELPARAMETERS
    other: dict[str, tuple[str, ...]] = field(default_factory=dict)  # lines of the blocks that are not interpreted
    path: pathlib.Path | None = None

    def __getitem__(self, name: str) -> Array:
        """(rows,) SI."""
        if name not in self.channels:
            raise unknown(self.path or "TYDEX", "channel", name, self.channels)
        column: Array = self.data[:, list(self.channels).index(name)]
        return column

    def __contains__(self, name: str) -> bool:
        return name in self.channels

    def __len__(self) -> int:
        return len(self.data)


def tydex(columns: Mapping[str, ArrayLike], *, header: Mapping[str, str] | None = None,
          comments: Sequence[str] = (), constants: Iterable[Constant] = (),
          units: Mapping[str, str] | None = None, texts: Mapping[str, str] | None = None) -> Tydex:
    """A Tydex to be written, of columns in SI by the names of their channels; numbers stand for all rows.
    Text and unit of each channel are those of CHANNELS, or those that are given.
    @raise InputError: the columns have different lengths, or a unit is not known."""
    given = {name: np.atleast_1d(np.asarray(values, dtype=float)) for name, values in columns.items()}
    rows = max((len(values) for values in given.values()), default=0)
    for name, values in given.items():
        if values.ndim != 1 or len(values) not in (1, rows):
            raise InputError(f"channel {name}: shape {values.shape} beside columns of {rows} rows (allowed: "
                             f"({rows},), or one number for all rows)")
    channels = {}
    for name in given:
        text, usual = CHANNELS.get(name, (name, "-"))
        written = (units or {}).get(name, usual)
        known = unit_named(written)
        if known is None:
            raise InputError(f"channel {name}: unit {written!r} is not known (allowed: among others {near(written)})")
        channels[name] = Channel(name, (texts or {}).get(name, text), written, known.si, known.factor)
    data = np.stack([np.broadcast_to(values, rows) for values in given.values()], axis=1) if given else np.empty((0, 0))
    return Tydex(channels, data, dict(header or {}), tuple(comments), {one.name: one for one in constants})


def write_tydex(path: str | os.PathLike[str], tydex: Tydex) -> pathlib.Path:
    """Writes a TYDEX file, with LF, in UTF-8, and returns its path. Numbers have as many digits as their nine
    columns hold; those of a file that was read are written as they were read, to these digits. Each row of the
    data is one line, also if that is longer than 80 columns (docs/decisions/070).
    @raise InputError: a name, text, unit or value does not fit into its columns."""
    file = pathlib.Path(path)
    lines = ["**HEADER", *(_line(name, "", value, "**HEADER") for name, value in tydex.header.items())]
    lines += ["**COMMENTS", *map(_comment, tydex.comments)]
    if tydex.constants:
        lines += ["**CONSTANTS", *(_constant(one) for one in tydex.constants.values())]
    if tydex.channels:
        lines += ["**MEASURCHANNELS", *(_channel(one) for one in tydex.channels.values()), "**MEASURDATA"]
        scale = np.array([one.to_si for one in tydex.channels.values()])
        lines += ["".join(map(_field, row)) for row in (np.asarray(tydex.data, float) / scale).tolist()]
    for name, kept in tydex.other.items():
        lines += [f"**{name}", *kept]
    if tydex.parameters:
        lines += ["**MODELPARAMETERS", *(_constant(one) for one in tydex.parameters.values())]
    text = "\n".join([*lines, "**END", ""])
    try:
        file.write_text(text, encoding="utf-8", newline="\n")
    except OSError as reason:
        raise FileError(f"{file}: cannot be written: {reason.strerror or reason}") from None
    return file


def _line(name: str, text: str, rest: str, where: str) -> str:
    if not name or len(name) > LONGEST_NAME or not name.isascii() or re.search(r"\s", name) or name[0] in "*!":
        raise InputError(f"{where}: name {name!r} (allowed: 1 to {LONGEST_NAME} characters without blanks, none of * "
                         "and ! first)")
    if len(text) > TEXT - NAME or re.search(r"[\t\r\n]", text + rest):
        raise InputError(f"{where}: text {text!r} of {name} (allowed: a line of at most {TEXT - NAME} characters)")
    line = f"{name:<{NAME}}{text:<{TEXT - NAME}}{rest}".rstrip()
    if len(line) > LONGEST_LINE:
        raise InputError(f"{where}: {rest!r} of {name} (allowed: at most {LONGEST_LINE - TEXT} characters)")
    return line


def _comment(line: str) -> str:
    if line.startswith("**") or len(line) > LONGEST_LINE or re.search(r"[\r\n]", line):
        raise InputError(f"**COMMENTS: {line[:40]!r} (allowed: lines of at most {LONGEST_LINE} characters that do not "
                         "begin with **)")
    return line


def _unit(name: str, unit: str, where: str) -> str:
    if len(unit) > UNIT - TEXT or unit_named(unit) is None:
        raise InputError(f"{where}: unit {unit!r} of {name} (allowed: known ones of at most {UNIT - TEXT} characters, "
                         f"as {near(unit)})")
    return f"{unit:<{UNIT - TEXT}}"


def _constant(one: Constant) -> str:
    if isinstance(one.value, str):
        if len(one.unit) > UNIT - TEXT or not one.value.strip():
            raise InputError(f"constant {one.name}: unit {one.unit!r}, value {one.value!r} (allowed: a unit of at "
                             f"most {UNIT - TEXT} characters and a text)")
        return _line(one.name, one.text, f"{one.unit:<{UNIT - TEXT}}{one.value}", "**CONSTANTS")
    unit = _unit(one.name, one.unit, "**CONSTANTS")
    known = unit_named(one.unit)
    assert known is not None
    return _line(one.name, one.text, f"{unit}{_digits(one.value / known.factor)}", "**CONSTANTS")


def _channel(one: Channel) -> str:
    rest = f"{_unit(one.name, one.unit, '**MEASURCHANNELS')}{_digits(one.factor):<{WIDTH}}{'0':<{WIDTH}}0"
    return _line(one.name, one.text, rest, "**MEASURCHANNELS")


def _field(value: float) -> str:
    return f" {MISSING if math.isnan(value) else _digits(value):>{WIDTH - 1}}"


def _digits(value: float, width: int = WIDTH - 1) -> str:
    """A number in at most nine columns, with as many digits as these hold."""
    if not math.isfinite(value):
        raise InputError(f"{value!r} in a TYDEX file (allowed: finite numbers; NaN in the data for what is missing)")
    value += 0.0  # no minus before 0
    for digits in range(width, 0, -1):
        for text in (f"{value:.{digits}g}", f"{value:.{digits - 1}e}"):
            text = text.replace("e+0", "e+").replace("e-0", "e-").replace("e+", "e")
            if len(text) <= width:
                return text
    return "0"  # pragma: no cover - one digit with sign and exponent always fits

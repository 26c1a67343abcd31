# SPDX-License-Identifier: BSD-3-Clause
"""Files of tyre parameters (.tir) of the Magic Formula: PAC2002, MF-Tyre 5.2 (FITTYP 6), 6.1 (61) and 6.2 (62):
rondo.files.read_tir, write_tir (docs/tyre-files.md)."""
from __future__ import annotations

import math
import os
import pathlib
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import NoReturn

from .errors import FileError, InputError, unknown
from .plain_files import NUMBER, foreign_lines
from .si import INCH, POUND_FORCE
from .tir_keys import COEFFICIENTS, DEFAULTS, DIMENSIONS, SECTION_OF, SECTIONS, TEXTS, Dimension

Value = float | str

_UNITS: dict[str, dict[str, float]] = {  # what [UNITS] may say, in SI
    "LENGTH": {"meter": 1.0, "metre": 1.0, "m": 1.0, "mm": 1e-3, "millimeter": 1e-3, "cm": 1e-2, "centimeter": 1e-2,
               "inch": INCH, "in": INCH, "foot": 12 * INCH, "ft": 12 * INCH},
    "FORCE": {"newton": 1.0, "n": 1.0, "knewton": 1e3, "kilo_newton": 1e3, "kn": 1e3, "pound_force": POUND_FORCE,
              "lbf": POUND_FORCE},
    "MASS": {"kg": 1.0, "kilogram": 1.0, "gram": 1e-3, "g": 1e-3, "pound_mass": 0.45359237, "lbm": 0.45359237},
    "TIME": {"second": 1.0, "sec": 1.0, "s": 1.0, "millisecond": 1e-3, "ms": 1e-3}}
_RADIANS = ("radian", "radians", "rad")
_SI = {"LENGTH": "meter", "FORCE": "newton", "ANGLE": "radians", "MASS": "kg", "TIME": "second"}
_OLD = 6  # FITTYP of MF-Tyre 5.2, which PAC2002 equals
_FITTYPS = {6: "MF 5.2", 61: "MF 6.1", 62: "MF 6.2"}


@dataclass(frozen=True)
class Tir(Mapping[str, Value]):
    """The parameters of a file in SI. tir["PKY1"]: the value in the file, of any section but UNITS; an iteration
    goes over the keys in the order of the file; tir.number("PKY1"): the value in the file or what counts without."""

    fittyp: int                                # 6, 61 or 62; PAC2002: 6
    sections: dict[str, dict[str, Value]]      # all keys by section, without UNITS
    tables: dict[str, tuple[str, ...]] = field(default_factory=dict)  # lines of tables of numbers, by section
    comments: tuple[str, ...] = ()             # lines before the first section
    unknown: tuple[str, ...] = ()              # "SECTION/KEY" that the format does not have, unchanged
    path: pathlib.Path | None = None

    def __getitem__(self, key: str) -> Value:
        for keys in self.sections.values():
            if key in keys:
                return keys[key]
        raise unknown(self.path or "tir", "key", key, list(self))

    def __iter__(self) -> Iterator[str]:
        return iter(dict.fromkeys(key for keys in self.sections.values() for key in keys))

    def __len__(self) -> int:
        return sum(1 for _ in self)

    @property
    def version(self) -> str:
        """ "MF 5.2" (PAC2002 too), "MF 6.1" or "MF 6.2"."""
        return _FITTYPS[self.fittyp]

    def number(self, key: str) -> float:
        """The value of a key, or 0 (1 of a scale factor) where the file does not have it."""
        value = self.get(key, DEFAULTS.get(key, 0.0))
        if isinstance(value, str):
            raise InputError(f"{self.path or 'tir'}: {key} = {value!r} is no number")
        return value

    def with_values(self, values: Mapping[str, Value]) -> Tir:
        """The same with other values, each in the section where the format has its key.
        @raise InputError: a key is none of the format."""
        sections = {name: dict(keys) for name, keys in self.sections.items()}
        for key, value in values.items():
            home = next((name for name, keys in sections.items() if key in keys), SECTION_OF.get(key))
            if home is None:
                raise InputError(f"{key}: no key of a .tir file of the Magic Formula (allowed: PCX1, FNOMIN, ...: "
                                 "docs/tyre-files.md)")
            sections.setdefault(home, {})[key] = value
        return replace(self, sections=sections)


def tir(values: Mapping[str, Value], fittyp: int = 61) -> Tir:
    """Parameters in SI by their keys, as tir({"FNOMIN": 4000.0, "UNLOADED_RADIUS": 0.313, "PCX1": 1.6}).
    @raise InputError: a key is none of the format, or FITTYP none of 6, 61 and 62."""
    if fittyp not in _FITTYPS:
        raise InputError(f"FITTYP {fittyp} (allowed: 6, 61 and 62)")
    header: dict[str, dict[str, Value]] = {
        "MDI_HEADER": {"FILE_TYPE": "tir", "FILE_VERSION": 3.0, "FILE_FORMAT": "ASCII"},
        "MODEL": {"PROPERTY_FILE_FORMAT": "MF-TYRE", "FITTYP": float(fittyp)}}
    return Tir(fittyp, header).with_values(values)


# Reading

def read_tir(path: str | os.PathLike[str]) -> Tir:
    """Reads a .tir file; its numbers become SI by its [UNITS].
    @raise FileError: it is damaged, or of another model or version, with its line and what to do."""
    return _Reader(pathlib.Path(path)).read()


class _Reader:
    """Sections of a file, and complaints that name lines."""

    def __init__(self, file: pathlib.Path) -> None:
        self.file = file
        self.lines = foreign_lines(file, "a .tir file")
        self.where: dict[str, dict[str, int]] = {}
        self.found: dict[str, dict[str, Value]] = {}
        self.tables: dict[str, list[str]] = {}

    def refuse(self, number: int, text: str) -> NoReturn:
        raise FileError(f"{self.file}, line {number}: {text}" if number else f"{self.file}: {text}")

    def read(self) -> Tir:
        comments = self._split()
        fittyp = self._fittyp()
        units = self._units()
        sections = {name: self._in_si(name, keys, units) for name, keys in self.found.items() if name != "UNITS"}
        self._once(sections)
        others = tuple(f"{name}/{key}" for name, keys in sections.items() for key in keys
                       if SECTION_OF.get(key) is None)
        made = Tir(fittyp, sections, {name: tuple(lines) for name, lines in self.tables.items()}, comments, others,
                   self.file)
        for key, what in (("FNOMIN", "the nominal load"), ("UNLOADED_RADIUS", "the free radius")):
            if key not in made:
                self.refuse(0, f"no {key}, {what} (allowed: a number above 0): the file is not complete")
            if made.number(key) <= 0:
                self.refuse(self._line_of(key), f"{key} = {made.number(key):g} (allowed: above 0)")
        return made

    def _split(self) -> tuple[str, ...]:
        comments: list[str] = []
        section = ""
        for number, line in enumerate(self.lines, start=1):
            bare = line.strip()
            if bare.startswith("["):
                section = self._section(number, bare)
            elif bare[:1] in ("$", "!", ""):
                if not section and bare:
                    comments.append(bare)
            elif not section:
                self.refuse(number, f"{bare[:30]!r} stands before the first section (allowed: a section as [MODEL]): "
                                    "it is no .tir file, or its beginning is missing")
            elif bare.startswith("{") or all(map(NUMBER.fullmatch, bare.split())):
                self.tables.setdefault(section, []).append(line.rstrip())
            else:
                self._key(number, section, bare)
        return tuple(comments)

    def _section(self, number: int, bare: str) -> str:
        match = re.match(r"\[([^\]]*)\]", bare)
        name = match[1].strip().upper() if match else ""
        if not name:
            self.refuse(number, f"{bare[:30]!r} is no section (allowed: a name in brackets, as [MODEL])")
        if name in self.found:
            self.refuse(number, f"section [{name}] stands here and in line {self.where[name]['']} (allowed: once): "
                                "put both together")
        self.found[name] = {}
        self.where[name] = {"": number}
        return name

    def _key(self, number: int, section: str, bare: str) -> None:
        key, equals, rest = bare.partition("=")
        key = key.strip().upper()
        if not equals or not re.fullmatch(r"\w+", key):
            self.refuse(number, f"{bare[:30]!r} is neither a section nor KEY = value (allowed: these, and comments "
                                "behind $ or !)")
        if key in self.where[section]:
            self.refuse(number, f"{key} stands here and in line {self.where[section][key]} of [{section}] (allowed: "
                                "once): remove one")
        value = self._value(number, section, key, rest)
        self.where[section][key] = number
        if value is not None:
            self.found[section][key] = value

    def _value(self, number: int, section: str, key: str, rest: str) -> Value | None:
        """None: nothing is given for a key that may be missing."""
        quoted = re.match(r"\s*'([^']*)'|\s*\"([^\"]*)\"", rest)
        text = (quoted[1] if quoted[1] is not None else quoted[2]) if quoted else re.split(r"[$!]", rest)[0]
        text = text.strip()
        if not text and key in COEFFICIENTS:
            self.refuse(number, f"{key} has no value (allowed: a number): complete or remove the line")
        if not text:
            return "" if quoted else None
        words_only = section == "UNITS" or (key in TEXTS and section != "INERTIA")
        if NUMBER.fullmatch(text) and not words_only:
            value = float(text.upper().replace("D", "E"))
            if not math.isfinite(value):
                self.refuse(number, f"{key} = {text} is too large (allowed: a finite number)")
            return value
        if key in COEFFICIENTS or (key in DIMENSIONS and section != "UNITS"):
            self.refuse(number, f"{key} = {text!r} is no number (allowed: a number)"
                        + (": write a decimal point" if re.fullmatch(r"[+-]?\d+,\d+", text) else ""))
        return text

    def _line_of(self, key: str) -> int:
        return next((keys[key] for name, keys in self.where.items() if name != "UNITS" and key in keys), 0)

    def _fittyp(self) -> int:
        model = self.found.get("MODEL", {})
        form, fittyp = str(model.get("PROPERTY_FILE_FORMAT", "")).upper(), model.get("FITTYP")
        if form == "PAC2002" and fittyp in (None, 6.0):
            return _OLD
        if form in ("", "MF-TYRE", "MF_TYRE", "MF-TIRE", "USER", "MF_05", "MF-SWIFT") and fittyp in (6.0, 61.0, 62.0):
            return int(fittyp)
        number = self._line_of("FITTYP") or self._line_of("PROPERTY_FILE_FORMAT")
        said = ", ".join(f"{key} {model[key]!r}" for key in ("PROPERTY_FILE_FORMAT", "FITTYP") if key in model)
        self.refuse(number, f"{said or 'neither PROPERTY_FILE_FORMAT nor FITTYP in [MODEL]'} (allowed: PAC2002, or "
                            "MF-TYRE with FITTYP 6, 61 or 62): another tyre model, whose coefficients mean other "
                            "things")

    def _units(self) -> Dimensioned:
        given = self.found.get("UNITS")
        if given is None:
            self.refuse(0, "no section [UNITS], without which its numbers mean nothing (allowed: LENGTH, FORCE, "
                           "ANGLE, MASS and TIME): add it")
        factors = []
        for key in ("LENGTH", "FORCE", "MASS", "TIME"):
            name = str(given.get(key, "")).lower()
            if name not in _UNITS[key]:
                self.refuse(self.where["UNITS"].get(key, self.where["UNITS"][""]),
                            f"{key} = {given.get(key, 'missing')!r} in [UNITS] (allowed: {', '.join(_UNITS[key])})")
            factors.append(_UNITS[key][name])
        angle = str(given.get("ANGLE", ""))
        if angle.lower() not in _RADIANS:
            self.refuse(self.where["UNITS"].get("ANGLE", self.where["UNITS"][""]),
                        f"ANGLE = {angle or 'missing'!r} in [UNITS] (allowed: {', '.join(_RADIANS)}): what "
                        "coefficients per degree are is not agreed upon; convert the file to radians")
        return Dimensioned(*factors)

    def _in_si(self, section: str, keys: Mapping[str, Value], units: Dimensioned) -> dict[str, Value]:
        return {key: value * units.of(DIMENSIONS[key]) if isinstance(value, float) and key in DIMENSIONS else value
                for key, value in keys.items()}

    def _once(self, sections: Mapping[str, Mapping[str, Value]]) -> None:
        seen: dict[str, tuple[str, Value]] = {}
        for name, keys in sections.items():
            for key, value in keys.items():
                if key in seen and seen[key][1] != value and SECTION_OF.get(key):
                    self.refuse(self.where[name][key], f"{key} = {value!r} in [{name}], and {seen[key][1]!r} in "
                                                       f"[{seen[key][0]}] (allowed: one value): remove one")
                seen.setdefault(key, (name, value))


@dataclass(frozen=True)
class Dimensioned:
    """The units of a file in SI."""

    length: float
    force: float
    mass: float
    time: float

    def of(self, powers: Dimension) -> float:
        return self.length ** powers[0] * self.force ** powers[1] * self.mass ** powers[2] * self.time ** powers[3]


# Writing

def write_tir(path: str | os.PathLike[str], tir: Tir) -> pathlib.Path:
    """Writes a .tir file in SI, sections and keys in the order of the format, each number with all its digits,
    and returns its path. Keys that the format does not have stand at the end of their section.
    @raise InputError: FITTYP is none of 6, 61 and 62."""
    if tir.fittyp not in _FITTYPS:
        raise InputError(f"FITTYP {tir.fittyp} (allowed: 6, 61 and 62)")
    file = pathlib.Path(path)
    sections: dict[str, dict[str, Value]] = {**tir.sections, "UNITS": dict(_SI)}
    names = [name for name in SECTIONS if name in sections] + [name for name in sections if name not in SECTIONS]
    lines = [line if line[:1] in "$!" else f"! {line}" for line in tir.comments]
    for name in names:
        keys = sections[name]
        lines += ["", f"[{name}]"]
        order = [key for key in SECTIONS.get(name, ()) if key in keys]
        lines += [f"{key:<24} = {_written(keys[key])}" for key in [*order, *(key for key in keys if key not in order)]]
        lines += tir.tables.get(name, ())
    lines += [line for name, table in tir.tables.items() if name not in sections for line in ["", f"[{name}]", *table]]
    try:
        file.write_text("\n".join(lines).lstrip("\n") + "\n", encoding="utf-8", newline="\n")
    except OSError as reason:
        raise FileError(f"{file}: cannot be written: {reason.strerror or reason}") from None
    return file


def _written(value: Value) -> str:
    if isinstance(value, str):
        if "'" in value or "\n" in value:
            raise InputError(f"{value!r} in a .tir file (allowed: a text without quotes, in one line)")
        return f"'{value}'"
    if not math.isfinite(value):
        raise InputError(f"{value!r} in a .tir file (allowed: a finite number)")
    return repr(int(value)) if value == int(value) and abs(value) < 1e15 else repr(float(value))

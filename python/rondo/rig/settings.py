# SPDX-License-Identifier: BSD-3-Clause
"""A rig file: what the tests of the rig vary. What it leaves out has defaults that fit the tyre (defaults.py)."""
from __future__ import annotations

import difflib
import pathlib
import tomllib
from collections.abc import Mapping
from typing import Any

from ..data.errors import InputError
from ..data.plain_files import text_of
from .keys import ALL, COUNT, NUMBER, NUMBERS, PLANE, SPACE, TABLES, TEXT, TOP, Key, tables_of
from .toml_text import value_text
from .units import of_width

Values = dict[str, Any]
_INSTEAD = {SPACE: "; this wheel has its own width, disk.width or that of its section"}

Settings = dict[str, Values]  # by table and key, in the units of keys.py; TOP has those of all tests


def read_settings(path: pathlib.Path | None, wheels: str = SPACE) -> Settings:
    """What a rig file says for a wheel of this kind; without a file, nothing.
    @raise InputError: with all that is wrong in it."""
    if path is None:
        return {TOP: {}}
    try:
        found = tomllib.loads(text_of(path))
    except ValueError as reason:
        raise InputError(f"{path}: cannot be read: {reason}") from None
    wrong: list[str] = [] if "schema" in found else ["schema: is missing (allowed: schema = 1)"]
    given: Settings = {}
    single = {name: value for name, value in found.items() if not isinstance(value, Mapping)}
    per_metre = is_per_metre(wheels, single)
    tests = tables_of(wheels)
    given[TOP] = _table("", TABLES[TOP], single, wrong, wheels, per_metre)
    for name, value in found.items():
        if not isinstance(value, Mapping):
            continue
        if name in tests and name != TOP:
            given[name] = _table(f"{name}.", TABLES[name], value, wrong, wheels, per_metre)
        else:
            why = f"is of {SPACE}, and this one is plane" if name in TABLES else "no such table"
            wrong.append(f"[{name}]: {why} (allowed: {_near(name, [n for n in tests if n != TOP])})")
    if wrong:
        raise InputError("\n".join(f"{path}: {text}" for text in wrong))
    return given


def is_per_metre(wheels: str, top: Mapping[str, Any]) -> bool:
    """Forces of this wheel are per metre of width. `top`: the values at the top of its rig file."""
    return wheels == PLANE and top.get("width") is None


def settings_text(settings: Settings, title: str, wheels: str = SPACE) -> str:
    """A rig file with all values, and what each key means."""
    per_metre = is_per_metre(wheels, settings[TOP])
    lines = [f"# What the rig does with: {title}. These are the defaults; leave out what you do not change.",
             "# Angles, slip ratios and forces are those of ISO 8855 (docs/conventions.md).", ""]
    for table, keys in tables_of(wheels).items():
        if table != TOP:
            lines += ["", f"[{table}]"]
        for key in keys:
            value = settings.get(table, {}).get(key.name)
            if value is not None:
                unit = "" if key.unit == "1" else f", {of_width(key.unit, per_metre)}"
                lines.append(f"{key.name} = {value_text(value)}  # {key.meaning}{unit}")
    return "\n".join(lines) + "\n"


def _table(prefix: str, keys: tuple[Key, ...], found: Mapping[str, Any], wrong: list[str], wheels: str,
           per_metre: bool) -> Values:
    known = {key.name: key for key in keys}
    values: Values = {}
    for name, value in found.items():
        if name in tables_of(wheels) and not prefix:
            wrong.append(f"{name}: is no table (allowed: [{name}], once)")
        elif name not in known:
            there = [key.name for key in keys if key.wheels in (ALL, wheels)]
            wrong.append(f"{prefix}{name}: no such key (allowed: {_near(name, there)})")
        elif known[name].wheels not in (ALL, wheels):
            wrong.append(f"{prefix}{name}: is of {known[name].wheels} (allowed: leave it out{_INSTEAD.get(wheels, '')})")
        elif not _is_right(known[name], value):
            once = ", each once" if known[name].kind == NUMBERS else ""
            wrong.append(f"{prefix}{name} = {_short(value)} (allowed: {known[name].allowed(per_metre)}{once})")
        else:
            values[name] = _plain(known[name], value)
    return values


def _short(value: object) -> str:
    try:
        text = value_text(value)
    except TypeError:  # a date
        text = str(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


def _near(name: str, there: list[str]) -> str:
    close = difflib.get_close_matches(name, there, 1)
    return f"{close[0]}?  All: {', '.join(there)}" if close else ", ".join(there)


def _is_right(key: Key, value: object) -> bool:
    if key.kind == TEXT:
        return isinstance(value, str)
    if key.kind == NUMBERS:
        return (isinstance(value, list) and bool(value) and all(_is_number(key, part) for part in value)
                and len(set(value)) == len(value))
    return _is_number(key, value) and (key.kind != COUNT or isinstance(value, int))


def _is_number(key: Key, value: object) -> bool:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return False
    return key.contains(value)


def _plain(key: Key, value: Any) -> Any:
    """Numbers as floats, but counts; lists in their order of size."""
    if key.kind == NUMBER:
        return float(value)
    return sorted(float(part) for part in value) if key.kind == NUMBERS else value

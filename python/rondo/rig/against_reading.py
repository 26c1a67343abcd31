# SPDX-License-Identifier: BSD-3-Clause
"""Measurements of a tyre that a rig is compared with: TYDEX, or CSV with the same channels."""
from __future__ import annotations

import csv
import os
import pathlib
import re
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..data.errors import FileError, InputError
from ..data.plain_files import text_of
from ..data.si import near, unit_named
from ..data.tydex_reading import read_tydex

Array = NDArray[np.float64]

# Channels of TYDEX by what they are here, and their SI units. The forces of the axes H are those of W; its moments are
# about the wheel center, and are not taken.
NAMES = {"SLIPANGL": "slip_angle", "LONGSLIP": "slip_ratio", "INCLANGL": "camber", "INFLPRES": "pressure",
         "LONGVEL": "speed", "FX": "Fx", "FXW": "Fx", "FXH": "Fx", "FYW": "Fy", "FYH": "Fy", "FZW": "Fz", "FZH": "Fz",
         "MXW": "Mx", "MYW": "My", "MZW": "Mz", "DSTGRWHC": "height"}
UNITS = {"slip_angle": "rad", "slip_ratio": "1", "camber": "rad", "pressure": "Pa", "speed": "m/s", "Fx": "N", "Fy": "N",
         "Fz": "N", "Mx": "N m", "My": "N m", "Mz": "N m", "height": "m"}
CHANNEL_OF = {name: channel for channel, name in reversed(NAMES.items()) if channel not in ("FXW", "FXH", "FYH", "FZH")}
RESULTS = ("Fx", "Fy", "Fz", "Mx", "My", "Mz")
MOST_ANGLE, LEAST_PRESSURE = np.pi / 2, 1e4  # rad, Pa: beyond them a number is in another unit
SMALL_ANGLE = np.radians(4.0)                # up to which the lateral force grows with the slip angle
ALIKE = 0.5                                  # a correlation that tells a sign


@dataclass(frozen=True)
class Measured:
    """Columns in SI and in the axes ISO-W, by the names of a rig's tables; NaN where the file has no number."""

    path: pathlib.Path
    columns: dict[str, Array]   # (rows,) each
    channels: tuple[str, ...]   # names of all channels in the file

    def __len__(self) -> int:
        return len(next(iter(self.columns.values()))) if self.columns else 0

    def get(self, name: str, otherwise: float = np.nan) -> Array:
        return self.columns.get(name, np.full(len(self), otherwise))


def read_measured(path: str | os.PathLike[str]) -> Measured:
    """@raise FileError: the file cannot be read or is damaged; InputError: no channel of use, or numbers that are not
    in SI or in the axes ISO-W."""
    file = pathlib.Path(path)
    if file.suffix.lower() == ".csv":
        found = _of_csv(file)
    elif file.suffix.lower() in (".tdx", ".tydex", ".txt", ".asc"):
        found = _of_tydex(file)
    else:
        raise InputError(f"{file}: measurements as {file.suffix or 'a file without an ending'} (allowed: TYDEX, .tdx, or "
                         ".csv)")
    _demand_channels(found)
    _demand_signs(found)
    return found


def _of_tydex(file: pathlib.Path) -> Measured:
    """A channel of constants stands for all rows."""
    tydex = read_tydex(file)
    constants = {name: one.value for name, one in tydex.constants.items()
                 if name in NAMES and not isinstance(one.value, str)}
    columns: dict[str, Array] = {}
    for channel, name in NAMES.items():
        if channel in tydex and name not in columns:
            columns[name] = tydex[channel]
    for channel, value in constants.items():
        columns.setdefault(NAMES[channel], np.full(len(tydex), float(value)))
    return Measured(file, columns, (*tydex.channels, *constants))


def _of_csv(file: pathlib.Path) -> Measured:
    """The first row has names, of TYDEX or of a rig's tables, with units in brackets where they are not SI."""
    try:
        head, *rows = [row for row in csv.reader(text_of(file).splitlines(), strict=True) if row]
    except (ValueError, csv.Error) as reason:
        raise FileError(f"{file}: cannot be read as CSV: {reason} (allowed: a row of names, then rows of numbers, apart "
                        "by commas)") from None
    columns: dict[str, Array] = {}
    for place, title in enumerate(head):
        match = re.fullmatch(r"\s*(\w+)\s*(?:[\[(]([^\])]*)[\])])?\s*", title)
        name = NAMES.get(match[1].upper(), match[1]) if match else ""
        if name in UNITS and name not in columns:
            columns[name] = _factor(file, title, name, match[2] if match else None) * _numbers(file, rows, place, title)
    return Measured(file, columns, tuple(head))


def _factor(file: pathlib.Path, title: str, name: str, unit: str | None) -> float:
    """To SI."""
    if unit is None:
        return 1.0
    found = unit_named(unit)
    if found is None or found.si != UNITS[name]:
        raise InputError(f"{file}: column {title!r}: unit {unit!r} (allowed: one of {UNITS[name]}, as {near(UNITS[name])})")
    return found.factor


def _numbers(file: pathlib.Path, rows: list[list[str]], place: int, title: str) -> Array:
    found = np.empty(len(rows))
    for number, row in enumerate(rows):
        text = row[place].strip() if place < len(row) else ""
        try:
            found[number] = float(text) if text else np.nan
        except ValueError:
            raise FileError(f"{file}, row {number + 2}: column {title!r}: {text!r} is no number (allowed: numbers, or "
                            "nothing)") from None
    return found


def _demand_channels(found: Measured) -> None:
    """That there is a motion or a height, and a force or a moment."""
    moved = [name for name in ("slip_angle", "slip_ratio", "height", "speed") if name in found.columns]
    forces = [name for name in RESULTS if name in found.columns]
    if len(found) and moved and forces and (len(forces) > 1 or forces != ["Fz"] or "height" in moved):
        return
    raise InputError(f"{found.path}: its channels are {', '.join(found.channels) or 'none'}, with {len(found)} rows "
                     "(needed: one or more of SLIPANGL, LONGSLIP, LONGVEL, or DSTGRWHC with FZW; and one or more of FX, "
                     "FYW, MXW, MYW, MZW): rename its columns")


def _demand_signs(found: Measured) -> None:
    for name in ("slip_angle", "camber"):
        if (np.abs(found.get(name)) >= MOST_ANGLE).any():
            raise InputError(f"{found.path}: {CHANNEL_OF[name]} reaches {np.nanmax(np.abs(found.get(name))):.4g} rad "
                             "(allowed: less than pi/2): give its unit, in CSV as SLIPANGL [deg]")
    if (found.get("pressure") < LEAST_PRESSURE).any():
        raise InputError(f"{found.path}: INFLPRES = {np.nanmin(found.get('pressure')):.4g} Pa (allowed: {LEAST_PRESSURE:g} "
                         "Pa or more): give its unit, in CSV as INFLPRES [kPa]")
    if np.nanmedian(found.get("Fz", 1.0)) < 0:
        raise InputError(f"{found.path}: FZW is below 0 (allowed: the axes W of TYDEX, ISO 8855, where it is above 0): "
                         "convert the file with rondo.axes.convert (docs/conventions.md)")
    small = np.abs(found.get("slip_angle")) <= SMALL_ANGLE
    pair = np.stack([found.get("slip_angle"), found.get("Fy")])[:, small]
    pair = pair[:, np.isfinite(pair).all(axis=0)]
    if pair.shape[1] > 2 and pair.std(axis=1).min() > 0 and np.corrcoef(pair)[0, 1] > ALIKE:
        raise InputError(f"{found.path}: FYW grows with SLIPANGL (allowed: the axes W of TYDEX, ISO 8855, where a wheel "
                         "that moves to its left is pushed to the right, FYW < 0): convert the file with "
                         "rondo.axes.convert (docs/conventions.md)")


def told(columns: Mapping[str, Array], name: str) -> str:
    """The extent of a column, for a message."""
    values = columns[name][np.isfinite(columns[name])]
    return f"{name} {values.min():.4g} to {values.max():.4g} {UNITS[name]}" if len(values) else f"{name}: no numbers"

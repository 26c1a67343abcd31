# SPDX-License-Identifier: BSD-3-Clause
"""What a rig writes: rig.json, and a table of each test as CSV and TYDEX, anew as its blocks end."""
from __future__ import annotations

import csv
import io
import json
import math
import os
import pathlib
import textwrap
from collections.abc import Mapping, Sequence
from typing import Any

from ..data.errors import Error, FileError
from ..data.files import read_json
from ..data.tydex import write_tydex
from ..files import tydex
from .blocks import Bench
from .plane import sentence
from .rows import DONE
from .states import Row
from .tests_table import SIDEWAYS, TESTS
from .units import column_name

FORMAT = "rondo rig 1"
CHANNELS = {"SLIPANGL": "slip_angle", "LONGSLIP": "slip_ratio", "INCLANGL": "camber", "INFLPRES": "pressure",
            "LONGVEL": "speed", "FX": "Fx", "FYW": "Fy", "FZW": "Fz", "MXW": "Mx", "MYW": "My", "MZW": "Mz",
            "DSTGRWHC": "height"}


def replace_text(path: pathlib.Path, text: str) -> None:
    """As a whole: one who reads finds the old or the new file."""
    beside = path.with_name(f".{path.name}.new")
    try:
        beside.write_text(text, encoding="utf-8")
        os.replace(beside, path)
    except OSError as reason:
        raise FileError(f"{path}: cannot be written: {reason.strerror or reason}") from None


def write_json(path: pathlib.Path, document: Mapping[str, Any]) -> None:
    replace_text(path, json.dumps(_plain(document), indent=2, ensure_ascii=False) + "\n")


def read_record(path: pathlib.Path) -> dict[str, Any]:
    """rig.json of another time. @raise Error: it is damaged."""
    known = read_json(path)
    for name in ("sources", "tests", "fmu"):
        if not isinstance(known.get(name, {}), dict):
            raise Error(f'{path}: damaged: "{name}" has to be an object (allowed: --overwrite, which writes it anew)')
    if not all(isinstance(one, dict) for one in known.get("tests", {}).values()):
        raise Error(f'{path}: damaged: "tests" has to be an object of objects (allowed: --overwrite, which writes it anew)')
    return known


def write_table(directory: pathlib.Path, test: str, rows: Sequence[Row], bench: Bench) -> str:
    """Its CSV file; the name."""
    columns = TESTS[test].columns_of(bench.tyre.is_plane)
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(column_name(name, bench.per_metre) for name in columns)
    writer.writerows([_cell(row.get(name)) for name in columns] for row in rows)
    replace_text(directory / f"{test}.csv", out.getvalue())
    return f"{test}.csv"


def write_channels(directory: pathlib.Path, test: str, rows: Sequence[Row], bench: Bench) -> str | None:
    """Its TYDEX file, of the points that are done, with the number of the others; None: of a test without forces, or without
    points, and of forces per metre of width, which the format does not have."""
    found = [row for row in rows if row["status"] == DONE and not row.get("mirrored")]
    file = directory / f"{test}.tdx"
    if not TESTS[test].has_forces or not found or bench.per_metre:
        file.unlink(missing_ok=True)
        return None
    plane = bench.tyre.is_plane
    columns = {name: [math.nan if row[column] is None else row[column] for row in found] for name, column in CHANNELS.items()
               if any(row[column] is not None for row in found) and not (plane and column in SIDEWAYS)}
    columns["LONGVEL"] = [row["speed"] * math.cos(row["slip_angle"]) for row in found]
    comments = ["Computed states of steady rolling, not measured", bench.tyre.title[:70]]
    if failed := sum(row["status"] != DONE and not row.get("mirrored") for row in rows):
        comments.append(f"{failed} of {len(found) + failed} points failed and are left out: {test}.csv says why")
    if plane:
        comments += textwrap.wrap(sentence(bench.tyre.plane_kind, bench.top.get("width")), 70)
    write_tydex(file, tydex(columns, header={"RELEASE": "1.3", "MEASID": test}, comments=comments))
    return file.name


def _cell(value: Any) -> str:
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return ""
    return repr(float(value)) if isinstance(value, float) else str(value)


def _plain(value: Any) -> Any:
    """Without NaN, which is no JSON."""
    if isinstance(value, Mapping):
        return {str(key): _plain(part) for key, part in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(part) for part in value]
    if isinstance(value, float):
        return float(value) if math.isfinite(value) else None
    return value

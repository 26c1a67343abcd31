# SPDX-License-Identifier: BSD-3-Clause
"""The page of a tyre test rig: figures of merit, tests, fit, measurements, in one file (docs/rig.md)."""
from __future__ import annotations

import os
import pathlib
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import style
from ..data.errors import Error
from ..reports.document import Document, folded, note, paragraph, table, tiles
from ..reports.encoding import escaped, number
from ..reports.pictures import drawn_picture
from .figures import Picture, pictures_of, tir_of
from .figures.drawing import said
from .fit import residuals_of, why_none
from .fit_rows import rows_of
from .keys import TABLES, TOP
from .merits import merits_of
from .plane import NO_FILES, sentence
from .points import DONE
from .trends import trends
from .units import column_name, of_width

if TYPE_CHECKING:
    from ..data.rig import Rig, RigTest
    from .against import Comparison

FIT_IT = "rondo.rig.fit.write_tir(rig, rig.directory / \"tyre.tir\") fits it, or tells what is missing."
HOW = ("case", "version", "build_id", "quick", "radius")  # of rig.json, besides the settings
STATE, SLIPS = ("load", "pressure", "camber", "slip_angle", "slip_ratio", "speed"), ("camber", "slip_angle", "slip_ratio")
FINISHED, FAILED, LEFT_OUT = "finished", "failed", "left out"  # statuses of a test; a wheel may have no such test
MEANINGS = {
    "vertical": "The wheel rolls freely straight ahead: its deflection, loaded radius and effective radius over the load.",
    "footprint": "Size of the contact patch of the wheel that rolls freely, and the pressure and shear in it.",
    "longitudinal": "The wheel brakes and drives without slip angle. The slope of the force at no slip is the slip stiffness; at large slip "
                    "the force is what friction carries.",
    "lateral": "The wheel rolls freely at slip angles. The slope of the lateral force at no slip angle is the cornering stiffness; the "
               "aligning moment over the lateral force is the pneumatic trail.",
    "combined": "The wheel brakes and drives at slip angles: both forces share the friction.",
    "rolling-resistance": "The force that moves a wheel which rolls freely, and this force over the load, the coefficient.",
    "relaxation": "The distance that the wheel rolls after a small step of its slip, until the force has followed.",
    "cleat": "The wheel rolls over a cleat with its center at a constant height: forces of the ground in time.",
    "modes": "Natural frequencies and damping ratios of the wheel that does not turn, free and on the ground.",
    "road": "The wheel rolls on a rough road with its center at a constant height: forces of the ground in time."}


def write(rig: Rig, path: str | os.PathLike[str], against: Comparison | None = None, pictures: Sequence[Picture] | None = None
          ) -> pathlib.Path:
    """Writes the page; of a rig that has not ended what is there. `pictures`: its figures; None: they are drawn here."""
    return page(rig, against, pictures).write(pathlib.Path(path))


def page(rig: Rig, against: Comparison | None = None, pictures: Sequence[Picture] | None = None) -> Document:
    document = Document(rig.title, "a tyre test rig")
    document.section("summary", "Summary", _summary(rig))
    drawn: dict[str, str] = {}
    for one in pictures_of(rig, against) if pictures is None else pictures:
        shown = drawn_picture(one.png, one.size_in, one.words, is_wide=one.size_in[0] >= style.PAGE)
        drawn[one.test] = drawn.get(one.test, "") + shown
    for name, test in rig.tests.items():
        document.section(f"test-{name}", escaped(name.replace("-", " ").capitalize()), _test(rig, test, drawn.get(name, "")))
    if not rig.plane:  # all of them are of the slip angle or of air
        document.section("trends", "Trends of tyres", _trends(rig))
    document.section("fit", "The fitted tyre.tir", _fit(rig))
    if told := rig.info.get("fmu"):
        document.section("fmu", "The reduced wheel tyre.fmu", _fmu(told))
    if against is not None:
        document.section("against", "Against measurements", _against(against))
    document.section("how", "How it was run", _how(rig))
    return document


def _summary(rig: Rig) -> str:
    statuses = {name: status for name, test in rig.tests.items() if (status := str(test.info.get("status", ""))) != LEFT_OUT}
    done, failed = list(statuses.values()).count(FINISHED), sum(test.failed for test in rig.tests.values())
    cards = [("tests finished", f"{done} of {len(statuses)}", "good" if done == len(statuses) else "warn", ""),
             ("points", number(sum(_points(test) for test in rig.tests.values())), "", "rows of all tables"),
             ("failed points", number(failed), "warn" if failed else "good", "each with its reason below" if failed else "")]
    forces = paragraph(escaped(sentence(rig.plane, rig.width))) if rig.plane else ""
    forces += note(NO_FILES) if rig.per_metre else ""
    doubts = [note(f"{name.replace('-', ' ').capitalize()}: {test.info['doubt']}.") for name, test in rig.tests.items()
              if test.info.get("doubt")]
    return _unfinished(statuses) + "".join(doubts) + forces + tiles(cards) + merits_of(rig)


def _unfinished(statuses: Mapping[str, str]) -> str:
    """What is missing: tests without any result, and tests that have not come to their end."""
    without = [name for name, status in statuses.items() if status == FAILED]
    said = note(f"All points of these tests failed: {', '.join(without)}. Their sections say why.") if without else ""
    rest = [name for name, status in statuses.items() if status not in (FAILED, FINISHED)]
    return said + (note(f"These tests are not finished: {', '.join(rest)}. The page shows what is there. The command that began "
                        "the rig goes on with it.") if rest else "")


def _points(test: RigTest) -> int:
    return len(test.table.get("status", ()))


def _value(value: Any) -> str:
    """Numbers and lists of them as text."""
    if isinstance(value, (list, tuple)):
        return ", ".join(map(_value, value))
    if isinstance(value, bool):
        return "yes" if value else "no"
    return number(value) if isinstance(value, (int, float)) or value is None else str(value)


def _fmu(told: Mapping[str, Any]) -> str:
    return note(f"Status: {told['status']}: {told['reason']}") if told.get("reason") else \
        paragraph(escaped(f"tyre.fmu has the reduced wheel for co-simulation (docs/fmu.md). {told.get('note', '')}"))


def _test(rig: Rig, test: RigTest, drawn: str) -> str:
    status = str(test.info.get("status", "not begun"))
    reason = test.info.get("reason")
    told = paragraph(escaped(MEANINGS.get(test.name, "")))
    if status != FINISHED:
        told += note(f"Status: {status}{f': {reason}' if reason else ''}")
    told += note(f"Note: {test.info['doubt']}.") if test.info.get("doubt") else ""
    told += paragraph(escaped(test.info["note"])) if test.info.get("note") else ""
    told += _failures(test, rig.per_metre) + drawn
    if not test.table:
        return told
    shown = [name for name, column in test.table.items() if name not in ("status", "reason") and _says_something(column)]
    rows = [[cell if isinstance(cell, str) else number(float(cell)) for cell in row]
            for row in zip(*(test.table[name].tolist() for name in shown))]
    units = {name: unit for name in shown if (unit := rig.info.get("units", {}).get("columns", {}).get(name, "1")) != "1"}
    head = [f"{name} ({units[name]})" if name in units else name for name in shown]
    return told + folded(f"Table of {_points(test)} point{'s' if _points(test) != 1 else ''}",
                         table(head, rows, f"Points of the test {test.name}", ["number"] * len(head)))


def _says_something(column: np.ndarray) -> bool:
    return bool(np.isfinite(column).any() if column.dtype.kind == "f" else (column != "").any())


def _state_of(test: RigTest, k: int, per_metre: bool) -> str:
    """The number of a point of the table, and the state that was asked for."""
    told = []
    for name in STATE:
        column = test.table.get(column_name(name, per_metre))
        if column is not None and np.isfinite(column[k]) and (column[k] or name not in SLIPS):
            told.append(said(name, float(column[k]), per_metre))
    told += [f"step of the {test.table['step'][k].replace('-', ' ')}"] if "step" in test.table else []
    told += ["standing" if test.table["standing"][k] else "free"] if "standing" in test.table else []
    return f"point {k + 1} ({', '.join(told)})"


def _failures(test: RigTest, per_metre: bool) -> str:
    if "status" not in test.table:
        return ""
    reasons = test.table.get("reason", np.full(_points(test), "no reason was kept"))
    items: dict[str, list[str]] = {}  # points by their reason, which many may share
    for k in np.flatnonzero(test.table["status"] != DONE):
        items.setdefault(str(reasons[k]), []).append(_state_of(test, int(k), per_metre))
    found = "".join(f"<li>{escaped('; '.join(states))}: {escaped(reason)}</li>" for reason, states in items.items())
    return f'<div class="note"><p>Points without results:</p><ul>{found}</ul></div>' if found else ""


def _trends(rig: Rig) -> str:
    words = {True: "yes", False: "no", None: "not told by these points"}
    return paragraph("What pneumatic tyres do, with the numbers of a measured racing tyre (Hoosier 43075 16×7.5-10, data "
                     "of the FSAE Tire Test Consortium). Trends are compared, not values.") + \
        table(("trend", "measured tyre", "this rig", "holds for this rig"),
              [(one.name, one.measured, one.found, words[one.holds]) for one in trends(rig)], "Trends")


def _fit(rig: Rig) -> str:
    try:
        tir = tir_of(rig)
    except Error as reason:
        return note(reason)
    if tir is None:
        return note("There is no tyre.tir: " + (why_none(rig, rows_of(rig)) or FIT_IT))
    rows = [(name, one.rows, f"{number(one.rms)} {one.unit}", f"{number(100 * one.of_largest, 3)} %",
             f"{number(one.largest)} {one.unit}") for name, one in residuals_of(tir, rows_of(rig)).items()]
    shown = table(("channel", "points", "rms of the difference", "over the largest size", "largest difference"), rows,
                  "tyre.tir evaluated at the points of the rig")
    said = "<br>".join(escaped(line.lstrip("$! ")) for line in tir.comments)
    return shown + folded("What the file says of itself", paragraph(said))


def _against(against: Comparison) -> str:
    rows = [(one.test, one.channel, f"{number(one.rms)} {one.unit}", f"{number(100 * one.of_largest, 3)} %",
             f"{number(one.mean)} {one.unit}", one.rows, one.beyond) for one in against.differences]
    return "".join(map(note, against.warnings)) + paragraph(f"The rig less the measurements of {escaped(against.path.name)}, over the states that both have.") + \
        table(("test", "channel", "rms", "over the largest measured", "mean", "rows", "beyond the points of the rig"), rows,
              "Differences between the rig and the measurements")


def _how(rig: Rig) -> str:
    rows = [(key.replace("_", " "), f"{_value(value)}{' m' if key == 'radius' else ''}") for key, value in rig.info.items() if key in HOW]
    for key, value in rig.settings.items():
        if isinstance(value, Mapping):
            rows.append((f"settings: {key}", "; ".join(_setting(rig, key, name, one) for name, one in value.items())))
        else:
            rows.append((f"settings: {key}", _value(value) + _unit(rig, TOP, key)))
    tests = [(name, str(test.info.get("status", "")), number(_points(test)), number(test.failed)) for name, test in rig.tests.items()]
    return table(("", ""), rows, "Case, version and settings") + table(("test", "status", "points", "failed"), tests, "Tests")


def _setting(rig: Rig, table_name: str, name: str, value: Any) -> str:
    return f"{name}: {_value(value)}{_unit(rig, table_name, name)}"


def _unit(rig: Rig, table_name: str, name: str) -> str:
    """Of a key of the rig file, after a blank; "": it has none."""
    unit = next((key.unit for key in TABLES.get(table_name, ()) if key.name == name), "1")
    return "" if unit == "1" else f" {of_width(unit, rig.per_metre)}"

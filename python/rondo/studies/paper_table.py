# SPDX-License-Identifier: BSD-3-Clause
"""The table of a study: ours against closed forms, an independent code and what the theory demands
(docs/paper.md)."""
from __future__ import annotations

import pathlib
from typing import Any

from .paper_measures import Measures
from .paper_plan import Plan

COMPARISONS = {"within": "within", "at_most": "at most", "at_least": "at least"}

Row = dict[str, Any]


def passes(row: Row) -> bool:
    """False for a value that is not a number."""
    ours, expected = row["ours"], row["expected"]
    if row["comparison"] == "within":
        return bool(abs(ours - expected) <= row["tolerance"])
    return bool(ours <= expected if row["comparison"] == "at most" else ours >= expected)


def make_table(directory: pathlib.Path, plan: Plan) -> list[Row]:
    """From the results of all runs and PODs of the plan."""
    measures = Measures(directory, plan)
    return [_row(planned, measures) for planned in plan.rows]


def _row(planned: Row, measures: Measures) -> Row:
    kind = next(kind for kind in COMPARISONS if kind in planned)
    bound = planned[kind]
    expected = measures.of(bound) if isinstance(bound, list) else float(bound)
    share = planned.get("share")
    tolerance = planned.get("tolerance", 0.0) if share is None else share * abs(expected)
    row = {key: planned[key] for key in ("figure", "name", "quantity", "unit")}
    row |= {"ours": measures.of(planned["ours"]), "expected": expected,
            "comparison": COMPARISONS[kind], "tolerance": float(tolerance),
            "source": planned["source"]}
    return {**row, "pass": passes(row)}


def table_text(table: list[Row]) -> str:
    lines: list[str] = []
    figure = 0
    for row in table:
        if row["figure"] != figure:
            lines += [""] if lines else []
            lines.append(f"figure {row['figure']}{'':66}{'ours':>14}   expected")
        figure = row["figure"]
        unit = "" if row["unit"] == "1" else f" [{row['unit']}]"
        lines.append(f"{'    ' if row['pass'] else 'NOT '} {row['quantity'] + unit:<69}"
                     f"{row['ours']:>14.6g}   {_bound(row)}")
    return "\n".join(lines)


def _bound(row: Row) -> str:
    if row["comparison"] == "within":
        return f"{row['expected']:.6g} ± {row['tolerance']:.2g}"
    return f"{row['comparison']} {row['expected']:.6g}"

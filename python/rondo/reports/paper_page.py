# SPDX-License-Identifier: BSD-3-Clause
"""The page of the paper's study: its figures, ours against expected, modes, the disk on the ledge."""
from __future__ import annotations

from importlib import import_module
from typing import Any

from ..data.errors import Error
from ..data.paper import Paper
from .document import Document, note, paragraph, table, tiles, told
from .encoding import escaped, number
from .equations import equations, glossary
from .health import status_tile
from .pictures import picture
from .pod_page import decay_of, ranks
from .run_page import body_html

FIGURES = {
    "figure_2": "A ring that is spun up: displacement of its edge against closed forms, and what the scheme as "
                "printed in the paper creates in energy",
    "figure_3": "The disk, smooth and with tread, climbs the ledge: displacement, contact, forces",
    "figure_4": "Steady rolling at four coefficients of friction: displacement and contact",
    "figure_5": "How reducible rolling is: energy left out over the number of modes kept, against a crush",
    "figure_6": "The first modes of rolling and of a crush",
}
RUNS = ("ledge-smooth", "turn-smooth", "crush-smooth")
BUDGET = 1_000_000  # characters of each body


def paper_page(paper: Paper) -> Document:
    document = Document("The study of the paper", "a disk rolling over a ledge and its reduction"
                        + (", on coarse meshes" if paper.quick else ""))
    document.section("summary", "Summary", _summary(paper))
    document.section("table", "Ours against expected", _table(paper))
    document.section("figures", "Figures", _figures(paper))
    document.section("bodies", "The bodies", _bodies(document, paper))
    document.section("modes", "Modes: POD and PGD", _modes(document, paper))
    document.section("runs", "Runs", _runs(paper))
    document.section("equations", "Equations and words",
                     equations("motion", "signorini", "coulomb", "energy", "balance", "static", "pod", "left")
                     + glossary())
    return document


def _summary(paper: Paper) -> str:
    passed = sum(bool(row.get("pass")) for row in paper.table)
    found = [status_tile(paper.status, paper.info.get("message")),
             ("as expected", f"{passed} of {len(paper.table)}", "good" if passed == len(paper.table) and passed
              else "bad", "figures of the table below"),
             ("runs", number(len(paper.run_names)), "", "each can be made again by its command"),
             ("machine", str(paper.info.get("host", "not said")), "",
              f"rondo {paper.info.get('version', '?')}, {paper.info.get('build', '?')}")]
    unfinished = "" if paper.table else note(
        f'This study is of status "{paper.status}" and has no table yet: rondo paper -o '
        f"{paper.directory.name}{' --quick' if paper.quick else ''} goes on with it; then make the report again.")
    return unfinished + paragraph(
        "A deformable disk rolls, climbs a ledge, is spun up and crushed, as in the paper that rondo is built on "
        "(its source is at the end of this page). The study computes all of it anew and holds each figure against "
        "what is expected: closed forms, laws of conservation, the paper's own statements.") + tiles(found)


def _table(paper: Paper) -> str:
    if not paper.table:
        return note("The table is made when all runs are done.")
    rows = [("✓" if row.get("pass") else "✗ not as expected", number(row.get("figure")), row.get("quantity", ""),
             number(row.get("ours"), 6), f"{row.get('comparison', '')} {_allowed(row)}",
             "" if row.get("unit") in ("1", None) else row["unit"], row.get("source", ""))
            for row in sorted(paper.table, key=lambda row: bool(row.get("pass")))]
    return table(("", "figure", "quantity", "ours", "expected", "unit", "where that is from"), rows,
                 "Our figures against those expected; what is not as expected stands first",
                 ("", "number", "", "number", "", "", ""))


def _allowed(row: dict[str, Any]) -> str:
    if row.get("comparison") == "within":
        return f"{number(row.get('tolerance'), 3)} of {number(row.get('expected'), 6)}"
    return number(row.get("expected"), 6)


def _figures(paper: Paper) -> str:
    shown = []
    for module, words in FIGURES.items():
        try:
            drawn = import_module(f"..figures.{module}", __package__).draw(paper)
        except Error as reason:
            shown.append(note(f"{module.replace('_', ' ')}: {told(reason, paper.directory)}"))
            continue
        for name, figure in drawn.items():
            shown.append(picture(figure, f"{name.replace('-', ' ').capitalize()}. {words}"))
    return "".join(shown)


def _bodies(document: Document, paper: Paper) -> str:
    html = ""
    for name in RUNS:
        if name not in paper.run_names:
            continue
        try:
            run = paper.run(name)
        except Error as reason:
            html += note(f"{name}: {told(reason, paper.directory)}")
            continue
        html += f"<h3>{escaped(run.title)} <small>({escaped(name)})</small></h3>" + body_html(document, run, f"body-{name}", BUDGET)
    return html or note("No run of a moving body is there yet.")


def _modes(document: Document, paper: Paper) -> str:
    pods = []
    for name in paper.run_names:
        try:
            run = paper.run(name)
            pods += [(f"{name}: {pod.field}, {pod.kind}", pod) for pod in run.pods.values()
                     if len(pod.singular_value)]
        except Error:
            continue  # said in the table of runs
    if not pods:
        return note("No modes are there yet.")
    drawn = [(name, pod) for name, pod in pods if pod.field == "displacement"]
    html = document.chart("decay", decay_of(drawn), "Energy of the displacement left out over the modes "
                          "kept") if drawn else ""
    return html + ranks(pods)


def _runs(paper: Paper) -> str:
    rows = [(run.get("name", ""), run.get("status", ""), number(run.get("wall_s"), 3), run.get("command", ""))
            for run in paper.info["runs"]]
    return paragraph("A run that ends “failed” may be the point: the scheme as printed creates energy.") + table(
        ("run", "status", "seconds", "command"), rows, "Runs of the study", ("", "", "number", "code"))

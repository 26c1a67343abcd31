# SPDX-License-Identifier: BSD-3-Clause
"""The page of a sweep: members, failures, curves and maps whose axes are chosen, effects; of a sweep of
rolling over slip, traction curves and carpets."""
from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from ..data.errors import Error
from ..data.names import find_figure
from ..data.sweep import Sweep, counts, goes_on
from ..figures.sweep_figures import usual
from ..figures.traction_figures import LOADS
from ..plots.labels import column_label, parameter_label, readable
from ..plots.traction import others_of
from .document import Document, note, paragraph, tiles, told
from .encoding import escaped, gaps, number, packed
from .equations import equations, glossary
from .health import BOUND, BOUND_FREE, Tile, status_tile
from .pictures import picture

MOST_CELLS = 30_000  # of the table of members
MOST_POINTS = 600_000  # members times columns, of the curves: about 2 MB
MOST_EFFECTS = 4  # pictures
ENDINGS = ("mean", "peak", "fluctuation")  # of figures, behind the column that they are of
EQUATIONS = {"crush": ("static", "coulomb"), "inflation": ("inflation",)}
ABOUT = ("One case was computed many times, with other values of some keys each time (the parameters). "
         "A row of the table is one of these runs (a member), with figures that sum it up.")


def sweep_page(sweep: Sweep) -> Document:
    rolls = _rolls(sweep)
    document = Document(sweep.title, "a map of steady rolling" if sweep.analysis == "steady-rolling"
                        else "a parametric study")
    document.section("summary", "Summary", _summary(sweep))
    if sweep.failures or (sweep["status"] == "failed").any():
        document.section("failures", "Failures", _failures(sweep))
    document.section("curves", "Curves and maps", _chooser(document, sweep, rolls))
    document.section("pictures", "Traction" if rolls else "Effects", _pictures(sweep, rolls))
    document.section("members", "Members", _members(sweep))
    document.section("equations", "Equations and words",
                     equations(*EQUATIONS.get(sweep.analysis, ("motion", "signorini", "coulomb"))) + glossary())
    return document


def _rolls(sweep: Sweep) -> bool:
    """Whether curves go over slip."""
    try:
        others_of(sweep)
    except Error:
        return False
    return True


def _summary(sweep: Sweep) -> str:
    found: list[Tile] = [status_tile(sweep.status),
                         ("members", number(len(sweep)), "", counts(sweep).partition(": ")[2])]
    for key, parameter in sweep.parameters.items():
        values = np.unique(sweep[key])
        if values.dtype.kind == "f":
            values = values[np.isfinite(values)]
        if not len(values):
            continue
        ends = f"{_cell(values[0])} to {_cell(values[-1])}" if len(values) > 1 else _cell(values[0])
        unit = "" if parameter.unit == "1" else f" {parameter.unit}"
        found.append((key, ends + unit, "", f"{len(values)} values" if len(values) > 1 else "the same for all"))
    for name, words in (("energy_residual_relative", "energy balance closes to"),
                        ("contact_residual_max", "law of contact met to")):
        if name in sweep and sweep.done.any():
            values = sweep[name][sweep.done]
            if not np.isfinite(values).any():
                found.append((words, "not known", "warn", "no member has this figure"))
                continue
            worst = float(np.nanmax(values))  # infinite as well: that is what is to be seen
            free = name.startswith("energy") and worst <= BOUND_FREE  # of elastic bodies that nothing holds
            found.append((words, number(worst), "good" if worst <= BOUND else "" if free else "warn",
                          "worst of all members"))
    unfinished = "" if sweep.status in ("done", "failed") else note(
        f'This sweep is of status "{sweep.status}": the page shows what is there. {told(goes_on(sweep), sweep.directory)}, then make '
        "the report again.")
    return unfinished + paragraph(ABOUT) + tiles(found)


def _failures(sweep: Sweep) -> str:
    messages = sweep.failures
    items = "".join(f"<li>run {int(run)}: {escaped(told(messages.get(int(run), 'no message was kept'), sweep.directory))}</li>"
                    for run, status in zip(sweep["run"], sweep["status"])
                    if int(run) in messages or status == "failed")
    return (f'<div class="note"><ul>{items}</ul></div><p>They have no figures and are in no curve; the others '
            "are as they are.</p>")


def _chooser(document: Document, sweep: Sweep, rolls: bool) -> str:
    if not sweep.done.any():
        return note("No member is done yet: there is nothing to draw.")
    done = sweep.where(sweep.done)
    left = ""
    if len(done) * len(done.names) > MOST_POINTS:
        chosen = np.linspace(0, len(done) - 1, max(2, MOST_POINTS // len(done.names))).round().astype(int)
        left = note(f"Of {len(done)} members {len(np.unique(chosen))}, evenly spread, are in these curves, so that "
                    "the page stays small; results.csv has all.")
        done = done.where(np.isin(np.arange(len(done)), chosen))
    columns = _columns(done)
    first = _first(done, rolls, columns)
    if not first:
        return note("No member has a figure that is a number: there is nothing to draw.")
    assert all(name in columns for name in first.values() if name), first
    data: dict[str, Any] = {"runs": done["run"].astype(int).tolist(), "columns": columns, "middle": rolls,
                            "varied": [name for name in done.varied if name in columns], **first}
    document.data("sweep", data)
    return (left + '<p class="hint">Choose what goes along the axes. Drag over the picture to zoom, double-click to see '
            'all again.</p><div class="sweep" data-source="sweep" role="group" aria-label="Curves and maps of '
            'the sweep"><noscript><p>Curves need JavaScript, which is switched off here.</p></noscript></div>')


def _columns(done: Sweep) -> dict[str, Any]:
    """What axes may be of, by name: parameters and figures that some member has; what is not finite is
    a gap."""
    columns: dict[str, Any] = {}
    for name in done.names:
        if name in ("status", "run"):
            continue
        values, kind = done[name], "parameter" if name in done.parameters else "figure"
        if values.dtype.kind not in "fiu":
            columns[name] = {"kind": kind, "texts": [str(value) for value in values], **_named(done, name)}
        elif (there := np.isfinite(values)).any():
            named = _named(done, name)
            factor, named["unit"] = readable(float(np.abs(values[there]).max()), named["unit"] or "1")
            columns[name] = {"kind": kind, "values": packed(gaps(values) * factor, "float32"), **named}
    return columns


def _named(sweep: Sweep, name: str) -> dict[str, str]:
    unit = sweep.unit_of(name)
    words = parameter_label(name) if name in sweep.parameters else _figure_words(name)
    return {"label": words if words != name or "." in name else name.replace("_", " "),
            "unit": "" if unit in ("1", "unknown") else unit}


def _figure_words(name: str) -> str:
    """Figures are of columns, as force_x_mean of force_x."""
    for ending in ENDINGS:
        if name.endswith(f"_{ending}"):
            return f"{column_label(name.removesuffix(f'_{ending}'))}, {ending}"
    return column_label(name)


def _first(sweep: Sweep, rolls: bool, columns: dict[str, Any]) -> dict[str, str]:
    """The axes that are shown at first, among the columns; empty where no figure is there."""
    figures = [name for name in sweep.figures if "values" in columns.get(name, {})]
    if not figures:
        return {}
    slip, force = find_figure("slip_ratio", sweep), find_figure("force_x", sweep)
    if rolls and slip in figures and force in figures:
        others = [key for key in others_of(sweep) if key in columns]
        by = next((key for key in LOADS if key in others), others[0] if others else "")
        return {"x": str(slip), "y": str(force), "by": by}
    return _usual(sweep, figures, columns)


def _usual(sweep: Sweep, figures: Sequence[str], columns: dict[str, Any]) -> dict[str, str]:
    """A figure over the parameter of most values, a curve for each value of the next one."""
    try:
        first = next((name for name in usual(sweep) if name in figures), figures[0])
    except Error:
        first = figures[0]
    varied = sorted((key for key in sweep.varied if key in columns), key=lambda key: -len(np.unique(sweep[key])))
    return {"x": varied[0] if varied else figures[0], "y": first, "by": varied[1] if len(varied) > 1 else ""}


def _pictures(sweep: Sweep, rolls: bool) -> str:
    shown = []
    for words, draw in _wanted(sweep, rolls):
        try:
            shown.append(picture(draw(), words))
        except (Error, ValueError, ArithmeticError) as reason:  # matplotlib, of numbers that are not finite
            shown.append(note(f"{words}: {told(reason, sweep.directory)}"))
    return "".join(shown) or note("There are no pictures: no two members differ in a parameter and are done.")


def _wanted(sweep: Sweep, rolls: bool) -> Iterator[tuple[str, Callable[[], Figure]]]:
    if not sweep.varied or not sweep.done.any():
        return
    if rolls:
        yield from _traction(sweep)
    try:
        names = usual(sweep)[:2 if rolls else MOST_EFFECTS]
    except Error:
        return
    for name in names:
        yield (f"Effect of each parameter on the {column_label(name)} ({name}): mean over all others, with "
               "bars from the least to the greatest", partial(sweep.plot_main_effects, name))


def _traction(sweep: Sweep) -> Iterator[tuple[str, Callable[[], Figure]]]:
    others = others_of(sweep)
    middle = {key: np.unique(sweep[key])[len(np.unique(sweep[key])) // 2].item() for key in others}
    for key in others:
        rest = {name: value for name, value in middle.items() if name != key}
        yield (f"Longitudinal force over slip, a curve for each {parameter_label(key)}{_said(rest)}",
               partial(_curves_of, sweep, rest, key))
    if not others:
        yield "Longitudinal force over slip", lambda: sweep.plot_traction().figure
    for load in (key for key in LOADS if key in others):
        rest = {name: value for name, value in middle.items() if name != load}
        yield (f"Carpet: longitudinal force over slip and load{_said(rest)}",
               partial(_carpet_of, sweep, rest, load))


def _curves_of(sweep: Sweep, rest: dict[str, Any], key: str) -> Figure:
    return (sweep.select(rest) if rest else sweep).plot_traction(key).figure


def _carpet_of(sweep: Sweep, rest: dict[str, Any], load: str) -> Figure:
    return (sweep.select(rest) if rest else sweep).plot_carpet(load).figure


def _said(rest: dict[str, Any]) -> str:
    words = ", ".join(f"{parameter_label(key)} {_cell(value)}" for key, value in rest.items())
    return f" ({words})" if words else ""


def _cell(value: Any) -> str:
    return number(float(value), 5) if isinstance(value, (float, np.floating)) else str(value)


def _members(sweep: Sweep) -> str:
    """Failures first, then as they are numbered; assets/table.js sorts them."""
    order = np.lexsort((sweep["run"], sweep["status"] == "done"))
    names = ["run", "status", *[name for name in sweep.names if name not in ("run", "status")]]
    most = max(1, MOST_CELLS // len(names))
    left = note(f"Of {len(sweep)} members the first {most} are in this table; results.csv has all.") \
        if len(sweep) > most else ""
    head = "".join(f'<th scope="col"><button type="button">{escaped(name)}<small>{escaped(_unit(sweep, name))}'
                   "</small></button></th>" for name in names)
    rows = []
    for k in order[:most]:
        status = str(sweep["status"][k])
        cells = "".join(_member_cell(sweep[name][k]) for name in names)
        kind = "" if status == "done" else ' class="bad"'
        rows.append(f"<tr{kind}>{cells}</tr>")
    return (left + '<p class="hint">A click on a name sorts by it, a second one the other way round.</p>'
            '<div class="wide tall" tabindex="0" role="group" aria-label="Members">'
            f'<table class="sortable"><caption>Members</caption><thead><tr>{head}</tr></thead><tbody>'
            f'{"".join(rows)}</tbody></table></div>')


def _unit(sweep: Sweep, name: str) -> str:
    unit = "" if name == "status" else sweep.units.get(name, "")
    return f" {unit}" if unit not in ("", "1", "unknown") else ""


def _member_cell(value: Any) -> str:
    if isinstance(value, (np.floating, float)):
        shown = "–" if not np.isfinite(value) else number(float(value), 5)
        return f'<td class="number" data-value="{float(value)!r}">{escaped(shown)}</td>'
    if isinstance(value, (np.integer, int)):
        return f'<td class="number" data-value="{int(value)}">{int(value)}</td>'
    return f"<td>{escaped(value)}</td>"

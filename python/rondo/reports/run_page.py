# SPDX-License-Identifier: BSD-3-Clause
"""The page of a run: motion, crush, steady rolling, inflation, in the plane or in three dimensions."""
from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
from matplotlib.figure import Figure

from ..data.errors import Error
from ..data.members import MEMBERS
from ..data.run import Run
from ..figures import run_figures
from ..plots import field, patch
from ..plots.convergence import plot_convergence
from ..plots.footprint import plot_footprint
from ..plots.marks import minus
from ..plots.modes import plot_pod_spectrum
from .body import body_of
from .case_text import case_html
from .document import Document, note, paragraph, table, told
from .encoding import escaped, number
from .equations import equations, glossary
from .health import health_tiles, ledger
from .histories import histories
from .pictures import picture

KINDS = {"dynamic": "a motion in time", "crush": "a crush without inertia",
         "steady-rolling": "a state of steady rolling", "inflation": "an inflation"}
ABOUT = {
    "dynamic": "A deformable body moves in time, in contact with rigid ground or with other bodies. Each "
               "small step of time is computed from the one before, contact and friction exactly, and all "
               "energy is accounted for.",
    "crush": "A deformable body is pressed onto rigid ground, so slowly that inertia does not matter: at "
             "each increment of the depth it is in balance with the forces of contact.",
    "steady-rolling": "A wheel rolls on and on at one speed. What its contact, its shape and its forces then "
                      "are is found directly, without steps in time; what is shown is the pass of one sector "
                      "of the wheel, after which all repeats.",
    "inflation": "A wheel of rubber and cords is brought into equilibrium under the pressure of its air, its "
                 "spin and the places of its beads on the rim. These loads grow together in steps; each step is "
                 "an equilibrium, all around the wheel alike. There is no ground, and nothing moves in time.",
}
EQUATIONS = {"dynamic": ("motion", "signorini", "coulomb", "energy", "balance", "split"),
             "crush": ("static", "coulomb"), "steady-rolling": ("motion", "signorini", "coulomb"),
             "inflation": ("inflation",)}


def run_page(run: Run) -> Document:
    document = Document(run.title, f"{KINDS.get(run.analysis, run.analysis)}"
                                   f"{', in three dimensions' if run.is_solid else ''}")
    document.section("summary", "Summary", _summary(run))
    document.section("body", "The body", body_html(document, run))
    document.section("histories", "Curves" if run.is_crush or run.is_inflation else "Histories",
                     histories(document, run))
    document.section("pictures", "Pictures", _pictures(run))
    document.section("ledger", "Energy balance", ledger(run))
    document.section("case", "The case", case_html(run.directory / "case.toml"))
    document.section("equations", "Equations and words",
                     equations(*EQUATIONS.get(run.analysis, EQUATIONS["dynamic"])) + glossary())
    return document


def _summary(run: Run) -> str:
    unfinished = "" if run.status == "done" else note(
        f'This run is of status "{run.status}": the page shows what is there. '
        + ("It can go on: rondo run " + run.directory.name + " --resume, then make the report again."
           if run.info.get("resumable") else "Run the case again for the whole of it."))
    return (unfinished + paragraph(escaped(ABOUT.get(run.analysis, ABOUT["dynamic"]))) + health_tiles(run)
            + _figures_of(run, "inflation") + _cord_figures(run) + _figures_of(run, "steady"))


def _figures_of(run: Run, name: str) -> str:
    """What run.json says of the inflation, or of steady rolling, as a table."""
    found = run.info.get(name, {})
    words = {key: MEMBERS[f"{name}.{key}"] for key in found if f"{name}.{key}" in MEMBERS}
    rows = [(meaning, number(found[key], 6), (solid if run.is_solid else plane) or "–", key)
            for key, (plane, solid, meaning) in words.items() if isinstance(found[key], (int, float))]
    return table(("quantity", "value", "unit", "key in run.json"), rows, MEMBERS[name][2],
                 ("", "number", "", "code")) if rows else ""


def _cord_figures(run: Run) -> str:
    """Of each layer of cords of an inflated wheel."""
    layers, given = run.info.get("inflation", {}).get("cords", []), run.case.get("cords", [])
    if not layers or len(layers) != len(given):
        return ""
    rows = [(layer["curve"], minus(f"{np.degrees(case['angle']):.4g}"), number(layer["force_min_n"], 4),
             number(layer["force_max_n"], 4), number(layer["stretch_min"], 6), number(layer["stretch_max"], 6))
            for layer, case in zip(layers, given)]
    return table(("curve", "angle in the case (°)", "smallest force of a cord (N)", "largest force (N)",
                  "smallest stretch (–)", "largest stretch (–)"), rows,
                 "The layers of cords, each at its worst point; below 0 N a cord is compressed", ("", *["number"] * 5))


def body_html(document: Document, run: Run, name: str = "body", budget: int | None = None) -> str:
    """The moving body; where there are no snapshots what to do for some."""
    if not run.n_snapshots:
        return note("There is no moving picture: " + _why_none(run))
    try:
        found, left_out = body_of(run, *([] if budget is None else [budget]))
    except Error as reason:
        return note(f"There is no moving picture: {told(reason, run.directory)}")
    html = document.viewer(name, found, f"{run.title}: the deformed body in time")
    if left_out:
        html += note(left_out)
    if "von_mises" not in run.field_names and "inflation" not in run.case:  # which has none
        html += note("Not in these results: stress (the case with output.stress = true).")
    return html


def _why_none(run: Run) -> str:
    if run.case.get("output", {}).get("snapshots") == 0:
        return ("output.snapshots was 0. Run the case again with snapshots: "
                "rondo run case.toml --set output.snapshots=200 -o DIRECTORY")
    return f"the run ({run.status}) has written no snapshot yet; make the report again later."


def _pictures(run: Run) -> str:
    shown = "".join(_safe(run, name, words, draw) for name, words, draw in _wanted(run))
    return shown or note("There are no pictures: they need snapshots, and contact.")


def _safe(run: Run, name: str, words: str, draw: Callable[[], Figure]) -> str:
    """A figure that cannot be drawn of what is there says why."""
    try:
        return picture(draw(), words)
    except (Error, ValueError, ArithmeticError) as reason:  # matplotlib, of numbers that are not finite
        return note(f"{name}: {told(reason, run.directory)}")


Wanted = tuple[str, str, Callable[[], Figure]]


def _wanted(run: Run) -> list[Wanted]:
    """Figures that the run has data for: a name, what is seen, how to draw it."""
    found: list[Wanted] = []
    if run.is_solid:
        return _of_solid(run)
    if run.n_snapshots:
        quantity = "deformation" if run.mesh.free.any() else "displacement"
        for which in [quantity, *(["von_mises"] if "von_mises" in run.field_names else [])]:
            found.append((which, f"{field.NAMES.get(which, which).capitalize()} in colours"
                          + ("" if run.is_steady else ", at three moments"),
                          partial(run_figures.fields, run, which)))
        if run.is_steady:
            found.append(("footprint", "The contact patch: pressure, shear, slip, and what sticks",
                          lambda: plot_footprint(run)))
        elif run.contact is not None and len(run.contact.rows["time_s"]):
            last = float(run.contact.rows["time_s"][-1])
            found.append(("contact", "Pressure and shear over the contact patch, at the last contact; "
                          "full dots stick, open ones slip",
                          lambda: patch.plot_contact(run, last).figure))
            found.append(("contact map", "Pressure over place and time",
                          lambda: patch.plot_contact_map(run).figure))
    if (run.directory / "convergence.csv").exists():
        found.append(("convergence", "Convergence of the solver (LATIN)",
                      lambda: plot_convergence(run).figure))
    if run.has_rim and len(run.history["time_s"]):
        found.append(("wheel", "The wheel: height, speeds, slip, forces, torques, energies",
                      lambda: run.plot_wheel()))
    return found + _of_pods(run)


def _of_solid(run: Run) -> list[Wanted]:
    found: list[Wanted] = []
    if not run.n_snapshots:
        return found
    if run.is_inflation:
        found.append(("section", "The section, undeformed in grey, and under the loads that were reached",
                      lambda: run.plot_section().figure))
        if run.case.get("cords"):
            found.append(("cords", "Force of a cord along each layer, as the mean of two points around the wheel; "
                          "below zero a cord is compressed",
                          lambda: run.plot_cords().figure))
    for which in ("displacement", "von_mises"):
        if which in run.field_names:
            found.append((which, f"{field.NAMES.get(which, which).capitalize()} at the end",
                          partial(_surface, run, which)))
    if run.contact is not None and len(run.contact.rows["time_s"]):
        found.append(("footprint", "The contact patch: pressure, shear, and what sticks",
                      lambda: run.plot_footprint()))
    return found + _of_pods(run)


def _surface(run: Run, quantity: str) -> Figure:
    from ..plots.solid.surface import plot_surface
    return plot_surface(run, float(run.times[-1]), quantity).figure


def _of_pods(run: Run) -> list[Wanted]:
    pods = [pod for pod in run.pods.values() if pod.n_modes and not (run.is_solid and pod.field == "contact")]
    found: list[Wanted] = [(pod.name, f"Modes of the {pod.field} ({pod.kind}), and their course in time",
                            pod.plot_modes) for pod in pods]
    if pods:
        names = [pod.name for pod in pods]
        found.append(("spectrum", "Energy left out over the number of modes kept",
                      lambda: plot_pod_spectrum(pods, labels=names).figure))
    return found



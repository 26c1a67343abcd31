# SPDX-License-Identifier: BSD-3-Clause
"""The page of a POD: spectrum, what is left out, ranks, modes that swing."""
from __future__ import annotations

import numpy as np

from ..data.pod import Pod
from .body import modes_of
from .document import Document, note, paragraph, table, tiles
from .encoding import escaped, number
from .equations import equations, glossary
from .health import status_tile
from .histories import chart_of
from .pictures import picture

FLOOR = 1e-16
MOST_SHOWN = 24  # modes on the canvas
FRAMES = {"rotating": "in the frame that turns with the body", "rectified": "as seen from the ground: the "
          "snapshots are moved back by the angle of the body, so that the contact stands still"}


def pod_page(pod: Pod) -> Document:
    title = " and ".join(str(run.get("title", "")) for run in pod.info.get("runs", [])[:2])
    document = Document(f"Modes of the {pod.field}: {title or pod.directory.name}",
                        "proper orthogonal decomposition (POD)" if not pod.is_pgd else "modes of LATIN-PGD")
    document.section("summary", "Summary", _summary(pod))
    document.section("spectrum", "Spectrum", _spectrum(document, pod))
    document.section("modes", "Modes", _modes(document, pod))
    document.section("ranks", "How many modes for what", ranks([(pod.name, pod)]) + _runs(pod))
    document.section("equations", "Equations and words", equations("pod", "left") + glossary())
    return document


def _summary(pod: Pod) -> str:
    info = pod.info
    where = "found by the solver of a crush itself" if pod.is_pgd else FRAMES.get(pod.frame, pod.frame)
    found = [status_tile(str(info.get("status", "done")), info.get("message")),
             ("modes kept", number(pod.n_modes), "", f"of {number(len(pod.singular_value))} singular values"),
             ("snapshots", number(len(pod.time)), "", f"of {len(info.get('runs', []))} run(s)"),
             ("orthonormal to", number(info.get("orthonormality")),
              "good" if (info.get("orthonormality") or 0.0) < 1e-10 else "warn", "largest |ΦᵀWΦ − 1|"),
             ("weights", pod.weight, "", "the norm in which modes are best")]
    worst = info.get("worst_snapshot") or {}
    if worst.get("error") is not None:
        found.append(("worst snapshot", number(worst["error"]), "",
                      "what the modes kept leave of it, over its own size"))
    if info.get("host"):
        found.append(("machine", str(info["host"]), "", f"rondo {info.get('version', '?')}"))
    return paragraph(f"The field <b>{escaped(pod.field)}</b> of all snapshots, {escaped(where)}, is written as "
                     "a sum of fixed shapes (modes), each with its course in time. The first modes are those "
                     "that leave least of it out: if a few suffice, the motion is simple.") + tiles(found)


def _spectrum(document: Document, pod: Pod) -> str:
    if not len(pod.singular_value):
        return note("All snapshots are zero: there is no spectrum.")
    decay = document.chart("decay", decay_of([(pod.name, pod)]), "Energy left out over the modes kept")
    values = np.maximum(pod.singular_value, FLOOR * pod.singular_value[0])
    each = document.chart("values", chart_of("mode", "over the first", [
        ("singular value", np.arange(1, len(values) + 1), values / values[0])], y_log=True),
        "Singular values, over the first")
    return '<p class="hint">Drag over a curve to zoom, double-click to see all again.</p>' + decay + each


def decay_of(pods: list[tuple[str, Pod]]) -> dict[str, object]:
    """Curves of the energy left out."""
    curves = []
    for name, pod in pods:
        left = np.asarray(pod.discarded_energy)
        shown = left > FLOOR
        curves.append((name, 1 + np.flatnonzero(shown), left[shown]))
    return chart_of("modes kept", "share of the energy left out", curves, x_log=True, y_log=True)


def _modes(document: Document, pod: Pod) -> str:
    if not pod.n_modes:
        return note("No modes are kept.")
    html = ""
    if pod.field == "contact":
        html += _along_contact(document, pod)
    else:
        found = modes_of(pod, MOST_SHOWN)
        html += document.viewer("modes-body", found, "Modes of the POD, swinging")
        if pod.n_modes > MOST_SHOWN:
            html += note(f"Of {pod.n_modes} modes the first {MOST_SHOWN} are in this page.")
    count = min(6, pod.n_modes)
    order = np.argsort(pod.time, kind="stable") if len(set(pod.run.tolist())) < 2 else np.arange(len(pod.time))
    if len(set(pod.run.tolist())) < 2:
        factor, label = (1e3, "time (ms)") if pod.time_unit == "s" else (1.0, "share of the load (–)")
        x = pod.time[order] * factor
    else:
        x, label = order.astype(float), "snapshot, run after run"
    curves = [(f"mode {k + 1}", x, pod.temporal[order, k]) for k in range(count)]
    html += document.chart("courses", chart_of(label, "course (–)", curves), "Courses of the first modes")
    if not (pod.mesh.is_solid and pod.field == "contact"):
        html += picture(pod.plot_modes(), "The first modes in space and time")
    return html


def _along_contact(document: Document, pod: Pod) -> str:
    """Modes of contact forces over the place of the nodes that may touch."""
    nodes = pod.mesh.coordinates[pod.points]
    angle = np.degrees(np.arctan2(nodes[:, 0], -nodes[:, 1]))  # from straight down, to the front
    order = np.argsort(angle, kind="stable")
    curves = []
    for k in range(min(3, pod.n_modes)):
        for part, name in enumerate(("normal", "tangential")):
            curves.append((f"mode {k + 1}, {name}", angle[order], pod.spatial[k, order, part]))
    return document.chart("contact-modes", chart_of("angle from straight down, to the front (°)", "mode", curves),
                          "Modes of the contact force round the body")


def ranks(pods: list[tuple[str, Pod]]) -> str:
    """Numbers of modes for shares of the energy left out."""
    shares = sorted({share for _, pod in pods for share in pod.modes_for}, reverse=True)
    rows = [(name, *("more than were found" if pod.modes_for.get(share) is None else
                     number(pod.modes_for[share]) for share in shares), number(len(pod.time)))
            for name, pod in pods]
    head = ("field and frame", *(f"to leave {number(share)}" for share in shares), "snapshots")
    return table(head, rows, "Modes that are needed to leave out no more than a share of the energy",
                 ("", *["number"] * len(shares), "number"))


def _runs(pod: Pod) -> str:
    rows = [(run.get("title", ""), run.get("status", "–"), number(run.get("snapshots")),
             number(run.get("energy_share"), 3), number(run.get("error"), 3))
            for run in pod.info.get("runs", [])]
    return table(("run", "status", "snapshots", "share of the energy", "left by the modes kept"), rows,
                 "The runs it is made of", ("", "", "number", "number", "number")) if rows else ""

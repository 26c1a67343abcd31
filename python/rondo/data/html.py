# SPDX-License-Identifier: BSD-3-Clause
"""Results as small tables of HTML, which notebooks show. The classes import this module, so that it
knows them by their members alone."""
from __future__ import annotations

import html
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from .members import MEMBERS

MOST = 20  # rows that are shown: the first ten and the last ten of more


def _cell(value: Any, tag: str = "td") -> str:
    if isinstance(value, (float, np.floating)):
        text = f"{value:.6g}"
    else:
        text = str(value)
    return f"<{tag}>{html.escape(text)}</{tag}>"


def _row(values: Iterable[Any], tag: str = "td") -> str:
    return "<tr>" + "".join(_cell(value, tag) for value in values) + "</tr>"


def table(title: str, head: Sequence[str], rows: Sequence[Sequence[Any]]) -> str:
    """A table of all rows; everything in it is text."""
    body = "".join(_row(values) for values in rows)
    return (f"<table><caption>{html.escape(title)}</caption><thead>{_row(head, 'th')}</thead>"
            f"<tbody>{body}</tbody></table>")


def shown(n: int) -> list[int]:
    """Of n rows those that are shown; -1 stands for what is left out."""
    if n <= MOST:
        return list(range(n))
    return [*range(MOST // 2), -1, *range(n - MOST // 2, n)]


def run_html(run: Any) -> str:
    """What it is and how far it came."""
    rows = [("analysis", run.analysis), ("status", run.status), ("nodes", run.mesh.n_nodes),
            ("cells", run.mesh.n_cells), ("snapshots", run.n_snapshots)]
    if run.n_snapshots:
        rows.append((f"times ({run.time_unit})", f"{run.times[0]:g} to {run.times[-1]:g}"))
    for key in ("total_wall_s", "energy_residual_relative", "contact_residual_max", "message"):
        if run.info.get(key) is not None:
            rows.append((f"{key} ({MEMBERS[key][0]})" if MEMBERS[key][0] else key, run.info[key]))
    rows.append(("directory", run.directory))
    return table(run.title, ("", ""), rows)


def history_html(history: Any) -> str:
    """A line for each column."""
    rows = []
    for name in history:
        values = history[name]
        ends = [float(f(values)) if len(values) else "" for f in (np.min, np.max)]
        rows.append((name, history.units.get(name, ""), *ends, values[-1] if len(values) else ""))
    return table(f"{history.path}: {history.n_rows} rows",
                 ("column", "unit", "least", "largest", "last"), rows)


def sweep_html(sweep: Any) -> str:
    """The first and the last members."""
    columns = [sweep[name] for name in sweep.names]
    rows: list[Sequence[Any]] = []
    for k in shown(len(sweep)):
        rows.append(["…"] * len(columns) if k < 0 else [column[k] for column in columns])
    head = [f"{name} ({unit})" if (unit := sweep.units.get(name, "1")) not in ("1", "unknown")
            else name for name in sweep.names]
    return table(repr(sweep), head, rows)


def pod_html(pod: Any) -> str:
    """The first modes and what they hold."""
    rows: list[Sequence[Any]] = []
    for k in shown(pod.n_modes):
        rows.append(["…"] * 4 if k < 0 else [k + 1, float(pod.singular_value[k]),
                                             float(pod.energy[k]), float(pod.discarded_energy[k])])
    return table(repr(pod), ("mode", "singular value", "energy", "discarded"), rows)


def modes_html(modes: Any) -> str:
    """A line for each wave, without a table over the spins for each mode."""
    rows: list[Sequence[Any]] = []
    if not modes.has_branches:
        names = ("mode", "frequency_rad_s", "nodal_diameters", "wave", "spin_rad_s")
        for k in shown(len(modes.table["mode"])):
            rows.append(["…"] * 5 if k < 0 else [modes.table[name][k] for name in names])
        return table(str(modes.directory),
                     ("mode", "frequency (rad/s)", "n", "wave", "spin (rad/s)"), rows)
    for k in shown(len(modes.branches)):
        if k < 0:
            rows.append(["…"] * 5)
            continue
        b = modes.branches[k]
        rows.append([b.diameters if b.diameters >= 0 else "", b.wave, b.order,
                     float(b.frequency.min()), float(b.frequency.max())])
    spins = modes.spins
    return table(f"{modes.directory}: {len(spins)} spins, {spins[0]:g} to {spins[-1]:g} rad/s",
                 ("n", "wave", "order", "least frequency (rad/s)", "largest frequency (rad/s)"), rows)

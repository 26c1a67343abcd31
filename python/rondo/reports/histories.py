# SPDX-License-Identifier: BSD-3-Clause
"""The columns of history.csv as curves that zoom, those of one kind and unit together."""
from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..data.run import Run
from ..plots.labels import column_label, readable
from .document import Document, note
from .encoding import escaped, gaps, packed

MOST_ROWS = 6000  # of a curve; of more the least and the largest of several rows
GROUPS: tuple[tuple[str, str, tuple[str, ...]], ...] = (
    ("forces", "Forces of the ground on the body", ("force_y", "force_x", "force_lateral")),
    ("moments", "Moments of the ground on the body", ("torque", "moment_aligning", "moment_overturning")),
    ("hub", "Forces at the hub", ("hub_force_x", "hub_force_y")),
    ("hub-torque", "Torque at the hub", ("hub_torque",)),
    ("contact", "Nodes in contact", ("contact_nodes", "sticking_nodes")),
    ("extent", "Length of the contact", ("contact_length_m", "stick_length_m", "slip_length_m")),
    ("area", "Area of the contact", ("contact_area_m2",)),
    ("footprint", "Length and width of the footprint", ("footprint_length_m", "footprint_width_m")),
    ("pressure", "Largest pressure and shear", ("pressure_max_pa", "shear_max_pa")),
    ("slip", "Slip ratio", ("slip_ratio",)),
    ("height", "Height of the center", ("center_y_m",)),
    ("speed", "Speed of the center", ("speed_x", "speed_y")),
    ("spin", "Spin", ("spin_rad_s",)),
    ("cords", "Force of a cord, of all layers", ("cord_force_max_n", "cord_force_min_n")),
    ("det-f", "Smallest det F", ("det_f_min",)),
    ("energy", "Energies", ("kinetic", "strain", "kinetic_rim", "support_energy", "stored_energy")),
    ("works", "Work done and energy taken, from the start on",
     ("work_frame", "work_contact", "work_rim", "work_load", "work_gravity", "work_rim_load", "work_torque",
      "work_held", "dissipation_friction", "loss_impact", "dissipation_mass", "dissipation_stiffness",
      "dissipation_brake", "dissipation_support", "dissipation_viscous", "work_scheme")),
    ("residual", "What the energy balance leaves open", ("energy_residual",)),
    ("iterations", "Iterations of the contact law in a step", ("contact_iterations", "contact_extensions")),
)
FLAT = 1e-12  # size of a column over that of the largest of its group, below which it is not drawn


def histories(document: Document, run: Run) -> str:
    """All charts; a sentence where there are none."""
    if not run.history.n_rows:
        return note(f"history.csv has no rows: the run ({run.status}) has not come to its first one.")
    groups = [*GROUPS, *_probes(run)]
    groups += _others(run, {column for _, _, columns in groups for column in columns})
    charts = "".join(_chart(document, run, *group) for group in groups)
    charts += _not_drawn(document, run)
    rows = run.history.n_rows
    if rows > 2 * MOST_ROWS:
        charts = note(f"Of {rows} rows the curves have the least and the largest of each "
                      f"{_stride(rows)}; history.csv has all.") + charts
    return ('<p class="hint">Drag over a curve to zoom, double-click to see all again; a click on a name '
            f"hides its curve.</p>{charts}")


def _others(run: Run, grouped: set[str]) -> list[tuple[str, str, tuple[str, ...]]]:
    """Columns of no group, each by itself."""
    abscissas = {run.history.abscissa} | ({"depth_m"} if run.is_crush else set())
    return [(f"other-{name}", column_label(name).capitalize(), (name,)) for name in run.history
            if name not in grouped | abscissas]


def _not_drawn(document: Document, run: Run) -> str:
    """What has no curve, by name: a reader is not to look for it."""
    drawn = {trace["column"] for name, chart in document.charts.items() if name.startswith("history-")
             for trace in chart["traces"]}
    left = [name for name in run.history if name not in drawn | {run.history.abscissa, "depth_m"}]
    if not left:
        return ""
    return (f'<p class="hint">Not drawn, as they are zero, not finite or without meaning here throughout: '
            f"<code>{escaped(', '.join(left))}</code>.</p>")


def _probes(run: Run) -> list[tuple[str, str, tuple[str, ...]]]:
    """Of each [[output.probe]]: displacement, stress."""
    found: list[tuple[str, str, tuple[str, ...]]] = []
    for k, probe in enumerate(run.case.get("output", {}).get("probe", [])):
        name = str(probe.get("name", ""))
        for kind, endings in (("displacement", ("ux", "uy")),
                              ("stress", ("sxx", "syy", "szz", "sxy"))):
            found.append((f"probe-{k}-{kind}", f"Probe {name}: {kind}",
                          tuple(f"{name}_{ending}" for ending in endings)))
    return found


def _chart(document: Document, run: Run, name: str, words: str, columns: Sequence[str]) -> str:
    history = run.history
    there = [column for column in columns if column in history]
    if columns[0] in ("force_y", "torque", "contact_nodes", "contact_length_m", "slip_ratio") \
            and not history.ground:
        return ""
    there = [column for column, size in _sizes(run, there).items() if size > 0]
    if not there:
        return ""
    factor, unit = readable(max(_sizes(run, there).values()), history.unit_of(there[0]))
    x, label = abscissa(run)
    traces = [{"name": column_label(column), "column": column, **_curve(x, history[column] * factor)}
              for column in there]
    chart = document.chart(f"history-{name}", {"x": label, "y": unit, "traces": traces}, words)
    lost = {column_label(column): int(np.isinf(history[column]).sum()) for column in there}
    told = ", ".join(f"{words} in {count} rows" for words, count in lost.items() if count)
    return chart + (note(f"Infinite, and a gap in the curves: {told}.") if told else "")


def _sizes(run: Run, columns: Sequence[str]) -> dict[str, float]:
    """Largest finite number of each column; 0 where it is nothing beside the others."""
    sizes = {column: float(np.abs(gaps(run.history[column])[np.isfinite(run.history[column])]).max(initial=0.0))
             for column in columns}
    top = max(sizes.values(), default=0.0)
    return {column: size if size > FLAT * top else 0.0 for column, size in sizes.items()}


def abscissa(run: Run) -> tuple[np.ndarray, str]:
    """What histories go over, and its name."""
    if run.is_crush and "depth_m" in run.history:
        depth = run.history["depth_m"]
        if len(depth) < 2 or (np.diff(depth) >= 0).all() and np.ptp(depth) > 0:
            return depth * 1e3, "depth (mm)"
        return run.history["time_s"], "share of the load (–)"
    if run.is_inflation:
        return run.history["load_share"], "share of the loads (–)"
    if run.is_steady:
        return run.history["time_s"] * 1e3, "time in the pass of a sector (ms)"
    return run.history["time_s"] * 1e3, "time (ms)"


def _stride(rows: int) -> int:
    return -(-rows // MOST_ROWS)


def _curve(x: np.ndarray, y: np.ndarray) -> dict[str, Any]:
    stride, y = _stride(len(x)), gaps(y)
    if stride > 2:
        whole = len(x) // stride * stride
        blocks = y[:whole].reshape(-1, stride)
        lacks = np.isnan(blocks)
        ends = np.stack([np.where(lacks, np.inf, blocks).argmin(axis=1),
                         np.where(lacks, -np.inf, blocks).argmax(axis=1),
                         lacks.argmax(axis=1)], axis=1)  # a gap stays one; without any the first row
        rows = (ends + stride * np.arange(len(blocks))[:, None]).ravel()
        rows = np.unique(np.concatenate([rows, np.arange(whole, len(x)), [len(x) - 1]]))
        x, y = x[rows], y[rows]
    return {"x": packed(x, "float32"), "y": packed(y, "float32")}


def chart_of(x_label: str, y_label: str, curves: Sequence[tuple[str, Any, Any]], **options: Any
             ) -> dict[str, Any]:
    """For Document.chart: curves (name, x, y); options: x_log, y_log, marks."""
    return {"x": x_label, "y": y_label, **options,
            "traces": [{"name": name, "x": packed(x, "float32"), "y": packed(y, "float32")}
                       for name, x, y in curves]}

# SPDX-License-Identifier: BSD-3-Clause
"""The figures of any run: fields at three times, contact, forces, the wheel, energies, spectra,
modes of its PODs; of steady rolling fields and footprint; of an inflation section and cords."""
from __future__ import annotations

import os
import pathlib
from collections.abc import Iterator
from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from .. import style
from ..plots import curves, field, patch
from ..plots.convergence import plot_convergence
from ..plots.footprint import plot_footprint
from ..plots.modes import plot_pod_spectrum
from ..plots.wheel import plot_wheel

if TYPE_CHECKING:
    from ..data.run import Run

PANELS = 3


def draw_run(run: Run, folder: str | os.PathLike[str]) -> list[pathlib.Path]:
    """Writes the figures that the run has data for, each as PNG and SVG; returns their files."""
    written: list[pathlib.Path] = []

    def keep(name: str, figure: Figure) -> None:
        written.extend(style.save(figure, pathlib.Path(folder) / name))
        plt.close(figure)

    if run.is_solid:
        for name, figure in solid_figures(run):
            keep(name, figure)
    elif run.n_snapshots:
        for quantity in ("displacement", "deformation", "von_mises"):
            if quantity in run.field_names or quantity == "deformation" and run.mesh.free.any():
                keep(f"field-{quantity}", fields(run, quantity))
        if run.is_steady:
            keep("footprint", plot_footprint(run))
        elif run.contact is not None and len(run.contact.rows["time_s"]):
            last = run.contact.rows["time_s"][-1]
            keep("contact", patch.plot_contact(run, last).figure)
            keep("contact-map", patch.plot_contact_map(run).figure)
    history = run.history
    if run.is_steady and run.pitches and not run.is_solid:
        keep("forces", pass_forces(run))
    if history.n_rows and not (run.is_steady or run.is_inflation):  # without a course in time
        keep("energy", curves.plot_energy(run).figure)
        if run.has_rim:
            keep("wheel", plot_wheel(run))
        if "ground" in run.case:
            if not run.is_solid:
                keep("forces", curves.plot_history(run).figure)
            half = 0.5 * history["time_s"][-1]  # what came before is the start, not the course
            if not run.is_crush and history.window(from_time=half).sum() >= curves.MIN_ROWS:
                keep("force-spectrum", curves.plot_force_spectrum(run, from_time=half).figure)
    if (run.directory / "convergence.csv").exists():
        keep("convergence", plot_convergence(run).figure)
    pods = [pod for pod in run.pods.values() if pod.n_modes]
    for pod in (one for one in pods if not (run.is_solid and one.field == "contact")):
        keep(f"modes-{pod.name}", pod.plot_modes())
    if pods:
        keep("pod-spectrum", plot_pod_spectrum(pods, labels=[pod.name for pod in pods]).figure)
    return written


def solid_figures(run: Run) -> Iterator[tuple[str, Figure]]:
    """Of a wheel in three dimensions: section and cords of an inflation, surface, contact, forces with
    the lateral one, moments."""
    from ..plots.solid.footprint import last_contact
    from ..plots.solid.footprint import plot_footprint as plot_solid
    from ..plots.solid.surface import plot_surface

    touches = run.contact is not None and len(run.contact.rows["time_s"]) > 0
    if run.is_inflation:
        if run.n_snapshots:
            yield "section", run.plot_section().figure
        if run.case.get("cords"):
            yield "history", curves.plot_history(run).figure
            if (run.directory / "cords.csv").exists():  # not there before the first equilibrium
                yield "cords", run.plot_cords().figure
    if run.n_snapshots:
        last = float(run.times[-1])
        for quantity in ("displacement", "von_mises"):
            if quantity in run.field_names:
                yield f"field-{quantity}", plot_surface(run, last, quantity).figure
        if touches:
            time = float(run.times[last_contact(run)])
            yield "field-pressure", plot_surface(run, time, "pressure").figure
            yield "footprint", plot_solid(run)
    if "ground" in run.case and len(run.history["time_s"]) and not run.is_steady:
        yield "forces", solid_forces(run)


@style.paper()
def solid_forces(run: Run) -> Figure:
    """Forces of the ground along its three axes, and the moments about it."""
    figure = plt.figure(figsize=(style.PAGE, 3.6))
    above, below = figure.subplots(2, 1, sharex=True)
    curves.plot_history(run, "force_y", "force_x", "force_lateral", ax=above)
    curves.plot_history(run, "moment_aligning", "moment_overturning", ax=below)
    above.set_xlabel("")
    figure.align_ylabels()
    return figure


@style.paper()
def pass_forces(run: Run) -> Figure:
    """The forces over the pass of a pitch in steady rolling, each on an axis round its values: what
    they go up and down by is a small part of them."""
    figure = plt.figure(figsize=(style.PAGE, 3.2))
    above, below = figure.subplots(2, 1, sharex=True)
    for ax, name in ((above, "force_y"), (below, "force_x")):
        curves.plot_history(run, name, ax=ax)
    above.set_xlabel("")
    figure.align_ylabels()
    return figure


@style.paper()
def fields(run: Run, quantity: str) -> Figure:
    """A quantity at three snapshots, spread evenly up to the last, in the same colours; of steady
    rolling at one."""
    shown = np.zeros(1, dtype=int) if run.is_steady else np.unique(np.linspace(0, run.n_snapshots - 1, PANELS + 1).round().astype(int)[1:])
    nodal = [field.nodal(run, int(k), quantity) for k in shown]
    limits = field.full_range(np.stack([field.cell_means(n.values, run.mesh.cells) for n in nodal]),
                              any(n.signed for n in nodal))
    figure = plt.figure(figsize=(style.PAGE if len(shown) > 1 else style.COLUMN, 2.5))
    axes = figure.subplots(1, len(shown), squeeze=False)[0]
    for ax, index in zip(axes, shown):
        k = int(index)
        body = field.draw_body(ax, run, k, quantity, limits=limits, mesh_width=0.0)
        field.frame_axes(ax, run, k, "fixed")
        field.draw_contact(ax, run, k)
        ax.set_title(field.snapshot_title(run, k))
        if ax is not axes[0]:
            ax.set_ylabel("")
    figure.colorbar(body.cells, ax=axes, label=f"{nodal[0].label} ({nodal[0].unit})", shrink=0.8)
    return figure

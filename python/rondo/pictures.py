# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of runs, PODs, modes, sweeps and validations as their methods. rondo/data knows no
plots and rondo/plots takes data; here the two meet. matplotlib is loaded by the first picture."""
from __future__ import annotations

import os
import pathlib
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from .data.errors import Error
from .data.heat import Heat
from .data.modes import Modes
from .data.paper import Paper
from .data.pod import Pod
from .data.run import Run
from .data.sweep import Sweep
from .data.validation import Validation
from .files import Road

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def _field(run: Run, time: float, quantity: str = "displacement", **options: Any) -> Axes:
    """The body at the snapshot nearest to `time`; options: see rondo.plots.field.plot_field, of a
    wheel in three dimensions rondo.plots.solid.surface.plot_surface."""
    if run.is_solid:
        from .plots.solid.surface import plot_surface
        return plot_surface(run, time, quantity, **options)
    from .plots.field import plot_field
    return plot_field(run, time, quantity, **options)


def _history(run: Run, *columns: str, ax: Axes | None = None) -> Axes:
    """Columns of the history over time; without any, the ground's forces, or the energies."""
    from .plots.curves import plot_history
    return plot_history(run, *columns, ax=ax)


def _energy(run: Run, ax: Axes | None = None) -> Axes:
    """The energy balance."""
    from .plots.curves import plot_energy
    return plot_energy(run, ax=ax)


def _spectrum(run: Run, column: str = "force_y", from_time: float | None = None,
              to_time: float | None = None, ax: Axes | None = None) -> Axes:
    """Amplitude spectrum of a column of the history, by default of the vertical force."""
    from .plots.curves import plot_force_spectrum
    return plot_force_spectrum(run, column, from_time, to_time, ax)


def _psd(run: Run, column: str = "force_y", from_time: float | None = None,
         to_time: float | None = None, segment: float | None = None, ax: Axes | None = None) -> Axes:
    """Power spectral density of a column of the history; see rondo.plots.psd."""
    from .plots.psd import plot_psd
    return plot_psd(run, column, from_time, to_time, segment, ax)


def _contact(run: Run, time: float, ax: Axes | None = None) -> Axes:
    """Pressure and shear over the contact patch at the snapshot nearest to `time`."""
    run.need_plane("plot_contact", "plot_footprint(time) draws its contact")
    from .plots.patch import plot_contact
    return plot_contact(run, time, ax)


def _contact_map(run: Run, quantity: str = "pressure", ax: Axes | None = None,
                 moving: bool = True) -> Axes:
    """Pressure or shear over place and time; see rondo.plots.patch.plot_contact_map."""
    run.need_plane("plot_contact_map", "plot_footprint(time) draws its contact at a time")
    from .plots.patch import plot_contact_map
    return plot_contact_map(run, quantity, ax, moving)


def _wheel(run: Run) -> Figure:
    """A wheel on a [rim]: height, speeds, slip, forces, torques, energies over time."""
    from .plots.wheel import plot_wheel
    return plot_wheel(run)


def _footprint(run: Run, time: float | None = None) -> Figure:
    """Pressure, shear and what sticks over the contact: of steady rolling in the plane, and of a
    wheel in three dimensions at the snapshot nearest to `time`, by default the last with contact."""
    if run.is_solid:
        from .plots.solid.footprint import plot_footprint as plot_solid
        return plot_solid(run, time)
    if time is not None:
        raise Error(f"{run.directory}: time={time:g}: the footprint of a plane body is that of all "
                    "places of steady rolling together; leave time out")
    from .plots.footprint import plot_footprint
    return plot_footprint(run)


def _wear(run: Run, from_time: float | None = None, to_time: float | None = None) -> Figure:
    """What friction takes in the footprint and around the tread; see rondo.plots.friction.plot_wear."""
    from .plots.friction import plot_wear
    return plot_wear(run, from_time, to_time)


def _flash(run: Run, heat: Heat, time: float | None = None) -> Figure:
    """Friction power and flash temperature in the footprint; see
    rondo.plots.friction.plot_flash_temperature."""
    from .plots.friction import plot_flash_temperature
    return plot_flash_temperature(run, heat, time)


def _convergence(run: Run, ax: Axes | None = None) -> Axes:
    """Indicator, residual and modes of a crush by LATIN over its iterations."""
    from .plots.convergence import plot_convergence
    return plot_convergence(run, ax)


def _section(run: Run, time: float | None = None, ax: Axes | None = None,
             deformation: float = 1.0) -> Axes:
    """The section of an inflated wheel before and after; see rondo.plots.solid.section.plot_section."""
    from .plots.solid.section import plot_section
    return plot_section(run, time, ax, deformation)


def _cords(run: Run, ax: Axes | None = None, over: str = "arc") -> Axes:
    """Force of a cord along each layer of an inflated wheel; see rondo.plots.solid.cords.plot_cords."""
    from .plots.solid.cords import plot_cords
    return plot_cords(run, ax, over)


def _modes_of_run(run: Run, field: str, frame: str = "co-rotating", count: int = 6) -> Figure:
    """The first modes of a POD of this run."""
    return _modes(run.pod(field, frame), count)


def _animate(run: Run, path: str | os.PathLike[str], **options: Any) -> pathlib.Path:
    """A film (.mp4, .gif) of the body; options: see rondo.plots.animation.animate, of a wheel in
    three dimensions rondo.plots.solid.film.animate."""
    if run.is_solid:
        from .plots.solid.film import animate as animate_solid
        return animate_solid(run, path, **options)
    from .plots.animation import animate
    return animate(run, path, **options)


def _decay(pod: Pod, ax: Axes | None = None) -> Axes:
    """Energy left out over modes kept."""
    from .plots.modes import plot_pod_spectrum
    return plot_pod_spectrum([pod], ax=ax)


def _modes(pod: Pod, count: int = 6) -> Figure:
    """The first modes with their course in time."""
    if pod.mesh.is_solid:
        from .plots.solid.modes import plot_modes as plot_solid
        return plot_solid(pod, count)
    from .plots.modes import plot_modes
    return plot_modes(pod, count)


def _campbell(modes: Modes, frame: str = "co-rotating", ax: Axes | None = None) -> Figure:
    """Frequencies over the spin; see rondo.plots.campbell.plot_campbell."""
    from .plots.campbell import plot_campbell
    return plot_campbell(modes, frame, ax)


def _shapes(modes: Modes, count: int = 6, spin: float | None = None) -> Figure:
    """The first shapes; see rondo.plots.shapes.plot_shapes, of a wheel in three dimensions
    rondo.plots.solid.shapes.plot_shapes."""
    if modes.mesh.is_solid:
        from .plots.solid.shapes import plot_shapes as plot_solid
        return plot_solid(modes, count, spin)
    from .plots.shapes import plot_shapes
    return plot_shapes(modes, count, spin)


def _main_effects(sweep: Sweep, figure: str) -> Figure:
    """A figure over each parameter; see rondo.plots.sweep_effects.plot_main_effects."""
    from .plots.sweep_effects import plot_main_effects
    return plot_main_effects(sweep, figure)


def _map(sweep: Sweep, figure: str, x: str, y: str, ax: Axes | None = None) -> Axes:
    """A figure over two parameters; see rondo.plots.sweep_map.plot_map."""
    from .plots.sweep_map import plot_map
    return plot_map(sweep, figure, x, y, ax)


def _curves(sweep: Sweep, figure: str, x: str, by: str | None = None,
            ax: Axes | None = None) -> Axes:
    """A figure over a column, a curve for each value of another; see
    rondo.plots.sweep_curves.plot_curves."""
    from .plots.sweep_curves import plot_curves
    return plot_curves(sweep, figure, x, by, ax)


def _spread(sweep: Sweep, figures: Sequence[str] | None = None, ax: Axes | None = None) -> Axes:
    """How far figures differ among the members; see rondo.plots.sweep_spread.plot_spread."""
    from .plots.sweep_spread import plot_spread
    return plot_spread(sweep, figures, ax)


def _traction(sweep: Sweep, by: str | None = None, ax: Axes | None = None,
              share: bool = False) -> Axes:
    """Longitudinal force over slip; see rondo.plots.traction.plot_traction."""
    from .plots.traction import plot_traction
    return plot_traction(sweep, by, ax, share)


def _carpet(sweep: Sweep, by: str = "analysis.load", ax: Axes | None = None) -> Axes:
    """Longitudinal force over slip and load; see rondo.plots.traction.plot_carpet."""
    from .plots.traction import plot_carpet
    return plot_carpet(sweep, by, ax)


def _tyre_curves(sweep: Sweep, *more: Sweep, by: str | None = None, names: Sequence[str] = (),
                 axes: str | None = None) -> Figure:
    """Lateral force and aligning moment over the slip angle; see
    rondo.plots.solid.tyre.plot_tyre_curves."""
    from .plots.solid.tyre import plot_tyre_curves
    return plot_tyre_curves(sweep, *more, by=by, names=names, axes=axes)


def _friction_ellipse(sweep: Sweep, ax: Axes | None = None) -> Axes:
    """Force along over lateral force at combined slip; see
    rondo.plots.solid.tyre.plot_friction_ellipse."""
    from .plots.solid.tyre import plot_friction_ellipse
    return plot_friction_ellipse(sweep, ax)


def _validation(validation: Validation, names: Sequence[str] = ()) -> Figure:
    """Profiles and errors; see rondo.plots.validation.plot_validation."""
    from .plots.validation import plot_validation
    return plot_validation(validation, names)


def _road(road: Road, ax: Axes | None = None, u: tuple[float, float] | None = None,
          v: tuple[float, float] | None = None) -> Axes:
    """Heights from above; see rondo.plots.road.plot_road."""
    from .plots.road import plot_road
    return plot_road(road, ax, u, v)


def report(results: str | os.PathLike[str], file: str | os.PathLike[str] | None = None) -> pathlib.Path:
    """One HTML file of a run, a sweep, a POD or the paper's study, in `file`, by default report.html
    in their directory; see rondo.reports.report."""
    from .reports import report as write
    return write(results, file)


def _report(results: Run | Sweep | Pod | Paper, file: str | os.PathLike[str] | None = None) -> pathlib.Path:
    """One HTML file of these results, as they are in their directory."""
    return report(results.directory, file)


def attach() -> None:
    """Gives the classes of rondo/data their pictures."""
    Run.plot_field, Run.plot_history, Run.plot_energy = _field, _history, _energy
    Run.plot_spectrum, Run.plot_modes, Run.animate = _spectrum, _modes_of_run, _animate
    Run.plot_contact, Run.plot_contact_map, Run.plot_psd = _contact, _contact_map, _psd
    Run.plot_wheel, Run.plot_footprint, Run.plot_convergence = _wheel, _footprint, _convergence
    Run.plot_wear, Run.plot_flash_temperature = _wear, _flash
    Run.plot_section, Run.plot_cords = _section, _cords
    Pod.plot_spectrum, Pod.plot_modes = _decay, _modes
    Modes.plot_campbell, Modes.plot_shapes = _campbell, _shapes
    Sweep.plot_main_effects, Sweep.plot_map = _main_effects, _map
    Sweep.plot_curves, Sweep.plot_spread = _curves, _spread
    Sweep.plot_traction, Sweep.plot_carpet = _traction, _carpet
    Sweep.plot_tyre_curves, Sweep.plot_friction_ellipse = _tyre_curves, _friction_ellipse
    Validation.plot, Road.plot = _validation, _road
    Run.report = Sweep.report = Pod.report = Paper.report = _report

# SPDX-License-Identifier: BSD-3-Clause
"""Forces and moments on a wheel in three dimensions over time, in other axes and signs."""
from __future__ import annotations

import pathlib
from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from .. import style
from ..data.axes import QUANTITIES, system
from ..data.errors import Error
from ..plots.labels import readable, steady_scale

if TYPE_CHECKING:
    from ..data.run import Run


def draw_in_axes(run: Run, folder: pathlib.Path, axes: str) -> list[pathlib.Path]:
    """Writes forces-AXES as PNG and SVG."""
    if run.is_steady:
        raise Error(f"{run.directory}: steady rolling has no forces over time to draw in other axes: rondo axes "
                    "gives them as numbers")
    figure = forces_in_axes(run, axes)
    written = style.save(figure, folder / f"forces-{axes}")
    plt.close(figure)
    return written


@style.paper()
def forces_in_axes(run: Run, axes: str) -> Figure:
    """Fx, Fy, Fz above, Mx, My, Mz below, of the ground on the wheel, over time."""
    found = run.history.in_axes(axes)
    figure = plt.figure(figsize=(style.PAGE, 3.8))
    panels = figure.subplots(2, 1, sharex=True)
    for ax, letter, word in zip(panels, "FM", ("force", "moment")):
        names = [f"{letter}{one}" for one in "xyz"]
        values = np.stack([getattr(found, name) for name in names])
        factor, unit = readable(float(np.abs(values).max(initial=0.0)), QUANTITIES[names[0]][0])
        for name, value, line in zip(names, values, style.CURVES):
            ax.plot(run.history["time_s"], factor * value, label=rf"${name[0]}_{name[1]}$", **line)
        ax.set_ylabel(f"{word} of the ground\non the wheel ({unit})")
        ax.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3)
        steady_scale(ax, factor * values.ravel(), unit)
    panels[1].set_xlabel("time (s)")
    figure.suptitle(f"axes {found.system}: {system(axes).title}", fontsize=style.RC["axes.titlesize"])
    figure.align_ylabels()
    return figure

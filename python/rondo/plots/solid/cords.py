# SPDX-License-Identifier: BSD-3-Clause
"""Forces of the cords of an inflated wheel along their layers."""
from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from ... import style
from ...data.errors import Error
from ..labels import axes_of, readable, share_of_loads
from .section import cord_style

if TYPE_CHECKING:
    from ...data.run import Run

OVER = {"arc": "length along the layer from its middle (mm)", "z": "z, along the axle (mm)"}


@style.paper()
def plot_cords(run: Run, ax: Axes | None = None, over: str = "arc") -> Axes:
    """Force of a cord along each layer of an inflated wheel, under the loads reached last; below zero
    a cord is compressed. over: "arc", the length along the deformed layer, from its middle; or "z", the
    place along the axle, over which a layer that goes back has two forces."""
    if over not in OVER:
        raise Error(f'over = "{over}": allowed are {", ".join(OVER)}')
    cords = run.cords
    factor, unit = readable(max(abs(layer.force).max() for layer in cords.values()), "N")
    ax = axes_of(ax, 2.6)
    ax.axhline(0.0, color="0.8", linewidth=0.6, zorder=0)
    for number, (name, layer) in enumerate(cords.items()):
        x = layer.z if over == "z" else layer.arc - 0.5 * layer.arc[-1]
        x, force = (np.insert(values, layer.starts, np.nan) for values in (1e3 * x, factor * layer.force))
        ax.plot(x, force, label=name, **(cord_style(number) | {"linewidth": 1.0}))
    ax.set_xlabel(OVER[over])
    ax.set_ylabel(f"force of a cord ({unit})")
    ax.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=min(len(cords), 6))
    share = run.info.get("inflation", {}).get("share", 1.0)
    if share != 1.0:
        ax.set_title(share_of_loads(share), loc="left")
    return ax

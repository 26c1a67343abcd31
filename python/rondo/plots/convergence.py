# SPDX-License-Identifier: BSD-3-Clause
"""How LATIN converged: indicator and residual, and the modes it took, over the iterations."""
from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from .. import style
from ..data.errors import Error
from .labels import axes_of

if TYPE_CHECKING:
    from ..data.run import Run

ERRORS = {"indicator": "indicator", "residual": "residual of the contact law"}
COUNTS = {"modes": "modes", "solves": "solves so far"}


@style.paper()
def plot_convergence(run: Run, ax: Axes | None = None) -> Axes:
    """Indicator and residual over the iterations, on a logarithmic axis; of LATIN-PGD below them
    modes and solves. Given axes are then divided in two. Returns the upper ones."""
    table = run.convergence
    counted = [name for name in COUNTS if name in table and table[name].any()]
    ax = axes_of(ax, 3.4 if counted else 2.2)
    last = ax
    if counted:
        spec = getattr(ax, "get_subplotspec", lambda: None)()  # not there before matplotlib 3.7
        if spec is None:
            raise Error("plot_convergence divides its axes: give it some of a grid, as from "
                        "plt.subplots()")
        grid = spec.subgridspec(2, 1, height_ratios=(1.6, 1), hspace=0.08)
        ax.set_subplotspec(grid[0])
        last = ax.figure.add_subplot(grid[1], sharex=ax)
        for name, line in zip(counted, style.CURVES[2:]):
            last.plot(table["iteration"], table[name], drawstyle="steps-mid", label=COUNTS[name],
                      **line)
        last.set_ylim(bottom=0)
        last.set_ylabel("number (–)")
        last.yaxis.set_major_locator(MaxNLocator(5, integer=True))
        last.legend(loc="best")
        ax.tick_params(labelbottom=False)
    for name, line in zip(ERRORS, style.CURVES):
        values = table[name]
        ax.semilogy(table["iteration"], np.where(values > 0, values, np.nan), label=ERRORS[name],
                    **line)
    ax.set_ylabel("over the forces (–)")
    ax.legend(loc="best")
    last.set_xlabel("iteration (–)")
    last.xaxis.set_major_locator(MaxNLocator(integer=True))
    return ax

# SPDX-License-Identifier: BSD-3-Clause
"""Figure 5: how reducible the solutions are: energy left out over the number of modes kept."""
from __future__ import annotations

from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator

from .. import style
from ..plots.marks import letter
from ..plots.modes import SHARES, draw_decay

if TYPE_CHECKING:
    from ..paper import Paper

BODIES = ("smooth", "treaded")
FIELDS = (("displacement", "displacement"), ("velocity", "velocity"), ("contact", "contact force"))
CURVES = (  # what is compared: label, run, frame, look
    ("rolling, turning frame", "turn", "rotating", style.CURVES[1]),
    ("rolling, rectified", "turn", "rectified", style.CURVES[0]),
    ("crush", "crush", "rotating", style.CURVES[2]),
)
LEAST = 1e-12  # of the shares shown


def draw(paper: Paper) -> dict[str, Figure]:
    return {"figure-5": _own(paper), "figure-5-frames": _frames(paper)}


def _axes(ax: Axes) -> None:
    for share in SHARES:
        ax.axhline(share, color="0.85", lw=0.6, zorder=0)
    ax.set(ylim=(LEAST, 2), xlim=(1, 1000))
    ax.yaxis.set_major_locator(LogLocator(numticks=8))


def _own(paper: Paper) -> Figure:
    """The paper's own: the velocity of rolling in the turning frame, against a crush."""
    with style.paper():
        figure = plt.figure(figsize=(style.COLUMN, 2.8))
        ax = figure.add_subplot()
        _axes(ax)
        rolling = style.CURVES[:2]
        crush = ({"color": style.SKY, "linestyle": ":"}, {"color": style.BLACK, "linestyle": "-."})
        for run, name, curves in (("turn", "rolling", rolling), ("crush", "crush", crush)):
            for body, curve in zip(BODIES, curves):
                pod = paper.pod(f"{run}-{body}", "velocity", "rotating")
                draw_decay(ax, pod, f"{name}, {body}", curve)
        ax.set(xlabel="modes kept (–)", ylabel="share of the energy\nof the velocity left out (–)")
        ax.legend(loc="lower right", borderaxespad=0.0, handlelength=2.2)
    return figure


def _frames(paper: Paper) -> Figure:
    """Rolling in both frames and the crush, of each field and body."""
    with style.paper():
        figure = plt.figure(figsize=(style.PAGE, 4.3))
        axes = figure.subplots(2, 3, sharex=True, sharey=True)
        for row, body in enumerate(BODIES):
            for column, (field, name) in enumerate(FIELDS):
                ax = axes[row][column]
                _axes(ax)
                for label, run, frame, curve in CURVES:
                    draw_decay(ax, paper.pod(f"{run}-{body}", field, frame), label, curve)
                ax.set_xlabel("modes kept (–)" if row == 1 else "")
                letter(ax, "abcdef"[3 * row + column], f"{name}, {body}")
            axes[row][0].set_ylabel("share of the\nenergy left out (–)")
        handles, labels = axes[0][0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="upper center", ncol=3)
        figure.get_layout_engine().set(rect=(0, 0, 1, 0.94))  # room for the legend
    return figure

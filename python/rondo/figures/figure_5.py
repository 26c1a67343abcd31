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
    from ..data.paper import Paper

BODIES = ("smooth", "treaded")
FIELDS = (("displacement", "displacement"), ("velocity", "velocity"), ("contact", "contact force"))
ROLLING, RECTIFIED, CRUSH = style.CURVES[1], style.CURVES[0], style.CURVES[2]
CURVES = (  # what is compared: label, run, frame, look
    ("rolling, co-rotating frame", "turn", "co-rotating", ROLLING),
    ("rolling, rectified", "turn", "rectified", RECTIFIED),
    ("crush", "crush", "co-rotating", CRUSH),
)
OWN = (  # the same colours, with lines of their own for the two bodies
    ("rolling", "turn", [{**ROLLING, "linestyle": line} for line in ("-", "--")]),
    ("crush", "crush", [{**CRUSH, "linestyle": line} for line in (":", "-.")]),
)
BY_PGD = {"marker": "o", "ms": 3.5, "mfc": "white", "color": CRUSH["color"], "linestyle": "none"}
LEAST_OWN, LEAST = 1e-10, 1e-12  # of the shares shown


def draw(paper: Paper) -> dict[str, Figure]:
    return {"figure-5": _own(paper), "figure-5-frames": _frames(paper)}


def _axes(ax: Axes, least: float) -> None:
    for share in SHARES:
        ax.axhline(share, color="0.85", lw=0.6, zorder=0)
    ax.set(ylim=(least, 2), xlim=(1, 1000))
    ax.yaxis.set_major_locator(LogLocator(numticks=8))


def _snapshots(paper: Paper) -> str:
    """Of rolling: no POD has more modes, so counts near these say how many were taken."""
    counts = [len(paper.pod(f"turn-{body}", "velocity", "co-rotating").time) for body in BODIES]
    return f"{counts[0]} (smooth) and {counts[1]} (treaded) snapshots"


def _own(paper: Paper) -> Figure:
    """The paper's own: the velocity of rolling in the co-rotating frame, against a crush."""
    with style.paper():
        figure = plt.figure(figsize=(style.COLUMN, 3.0))
        ax = figure.add_subplot()
        _axes(ax, LEAST_OWN)
        for name, run, curves in OWN:
            for body, curve in zip(BODIES, curves):
                pod = paper.pod(f"{run}-{body}", "velocity", "co-rotating")
                draw_decay(ax, pod, f"{name}, {body}", curve)
        ax.set(xlabel="modes kept (–)", ylabel="share of the energy\nof the velocity left out (–)")
        figure.supxlabel(f"Rolling: of {_snapshots(paper)};\ncounts near these are set by them.",
                         fontsize=7)
        ax.legend(loc="lower right", bbox_to_anchor=(0.91, 0.12), borderaxespad=0.0,
                  handlelength=2.0)
    return figure


def _by_pgd(ax: Axes, paper: Paper, body: str) -> None:
    """What modes that were found without snapshots leave of the crush."""
    modes = paper.run(f"latin-{body}").pod("displacement", "pgd")
    left = modes.projection_error(paper.run(f"crush-{body}").displacement[:]) ** 2
    ax.plot(range(1, len(left)), left[1:], label="crush, modes of LATIN-PGD", **BY_PGD)


def _frames(paper: Paper) -> Figure:
    """Rolling in both frames and the crush, of each field and body."""
    with style.paper():
        figure = plt.figure(figsize=(style.PAGE, 4.3))
        axes = figure.subplots(2, 3, sharex=True, sharey=True)
        for row, body in enumerate(BODIES):
            for column, (field, name) in enumerate(FIELDS):
                ax = axes[row][column]
                _axes(ax, LEAST)
                for label, run, frame, curve in CURVES:
                    draw_decay(ax, paper.pod(f"{run}-{body}", field, frame), label, curve)
                if field == "displacement":
                    _by_pgd(ax, paper, body)
                ax.set_xlabel("modes kept (–)" if row == 1 else "")
                letter(ax, "abcdef"[3 * row + column], f"{name}, {body}")
            axes[row][0].set_ylabel("share of the\nenergy left out (–)")
        handles, labels = axes[0][0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="upper center", ncol=4)
        figure.supxlabel(f"Rolling: of {_snapshots(paper)}; counts near these are set by them.",
                         fontsize=7)
        figure.get_layout_engine().set(rect=(0, 0, 1, 0.94))  # room for the legend
    return figure

# SPDX-License-Identifier: BSD-3-Clause
"""The figure of docs/conventions.md, drawn from the table of rondo.axes:
    python3 scripts/figure_conventions.py docs/figures"""
from __future__ import annotations

import pathlib
import sys

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.axes import Axes  # noqa: E402
from matplotlib.patches import Polygon  # noqa: E402

from rondo import axes, style  # noqa: E402

DRAWN = ("rondo", "iso-w", "tydex-c", "sae", "adapted-sae")
TITLES = {"rondo": "rondo", "iso-w": "ISO 8855, TYDEX W", "tydex-c": "TYDEX C", "sae": "SAE J670",
          "adapted-sae": "adapted SAE"}
COLORS = {"x": style.VERMILLION, "y": style.GREEN, "z": style.BLUE}
LEAN, SLIP = 0.28, 0.5  # rad
LENGTH = 0.62           # of an axis
ABOVE, BEHIND = ((2, 0), (2, 1))  # components along t1, n, t2 to the right and up: from above, from behind


def arrow(ax: Axes, start: np.ndarray, way: np.ndarray, color: str, name: str = "", dashed: bool = False) -> None:
    ax.annotate("", xy=tuple(start + way), xytext=tuple(start),
                arrowprops={"arrowstyle": "-|>", "color": color, "lw": 1.1, "linestyle": "--" if dashed else "-",
                            "shrinkA": 0, "shrinkB": 0, "mutation_scale": 7})
    if name:
        ax.text(*(start + way * (1 + 0.16 / np.linalg.norm(way))), name, color=color, ha="center", va="center")


def three_axes(ax: Axes, system: str, camber: float, plane: tuple[int, int], start: np.ndarray) -> None:
    """Axes in the plane as arrows, the third as a dot (towards the reader) or a cross."""
    towards = 1 if plane == ABOVE else 0
    for name, row in zip("xyz", axes.directions(system, camber)):
        way = LENGTH * row[list(plane)]
        if np.linalg.norm(way) > 0.1 * LENGTH:
            arrow(ax, start, way, COLORS[name], name)
        else:
            out = (row[towards] > 0) == (plane == ABOVE)  # from behind, x points away from the reader
            ax.plot(*start, "o", ms=6, mfc="white", mec=COLORS[name], zorder=5)
            ax.plot(*start, "." if out else "x", ms=3.5, color=COLORS[name], zorder=6)
            ax.text(*(start - [0.18, 0.16]), name, color=COLORS[name], ha="center", va="center")


def from_above(ax: Axes, system: str) -> None:
    """The wheel heads upwards; its velocity at a positive slip angle."""
    outline = [(-0.12, -0.55), (0.12, -0.55), (0.12, 0.55), (-0.12, 0.55)]
    ax.add_patch(Polygon(outline, fc=style.RIM, ec=style.OUTLINE, lw=0.7))
    side = axes.system(system).slip_angle  # 1: to the right
    arrow(ax, np.zeros(2), 1.05 * np.array([side * np.sin(SLIP), np.cos(SLIP)]), style.BLACK, "V", dashed=True)
    angles = np.linspace(0, side * SLIP, 20)
    ax.plot(0.8 * np.sin(angles), 0.8 * np.cos(angles), color=style.BLACK, lw=0.6)
    ax.text(0.95 * np.sin(side * SLIP / 2), 0.95 * np.cos(SLIP / 2), r"$\alpha$", ha="center", va="center")
    three_axes(ax, system, 0.0, ABOVE, np.zeros(2))


def from_behind(ax: Axes, system: str) -> None:
    """The wheel at a positive camber, on the ground."""
    row = axes.system(system)
    own = LEAN * row.camber  # > 0 leans to the left
    up = np.array([-np.sin(own), np.cos(own)])
    right = np.array([np.cos(own), np.sin(own)])
    contact = np.array([0.0, -0.75])
    center = contact + 0.75 * up
    corners = [contact - 0.14 * right, contact + 0.14 * right, contact + 1.45 * up + 0.14 * right,
               contact + 1.45 * up - 0.14 * right]
    ax.add_patch(Polygon(corners, fc=style.RIM, ec=style.OUTLINE, lw=0.7))
    ax.axhline(-0.75, color=style.GROUND, lw=2)
    ax.plot([0, 0], [-0.75, 0.9], color="0.5", lw=0.5, ls=":")
    below = np.array([center[0], -0.75])
    start = {axes.GROUND: below, axes.CONTACT: contact, axes.CENTER: center}[row.origin]
    ax.text(1.62 * up[0] * 0.5, 0.98, r"$\gamma$", ha="center", va="center")
    three_axes(ax, system, own, BEHIND, start)


def main(folder: pathlib.Path) -> None:
    with style.paper():
        figure, panels = plt.subplots(2, len(DRAWN), figsize=(style.PAGE, 3.0))
        for system, (top, bottom) in zip(DRAWN, panels.T):
            from_above(top, system)
            from_behind(bottom, system)
            top.set_title(TITLES[system])
            for ax in (top, bottom):
                ax.set(xlim=(-1.05, 1.05), ylim=(-1.65 if ax is bottom else -0.9, 1.2), aspect="equal")
                ax.axis("off")
        for ax, text in zip(panels[:, 0], ("from above", "from behind")):
            ax.text(-1.05, 0.1, text, rotation=90, ha="center", va="center", color="0.3")
        png, svg = style.save(figure, folder / "conventions")
        svg.unlink()  # pages have the PNG


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]))

# SPDX-License-Identifier: BSD-3-Clause
"""The Campbell diagram of `rondo modes`: frequencies over the spin."""
from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from .. import style
from ..data.errors import Error
from ..data.names import FRAME, frame_named

if TYPE_CHECKING:
    from ..data.modes import Branch, Modes

LINES = {"backward": "-", "forward": "--", "standing": ":"}  # of the waves
SHADES = (style.BLACK, style.BLUE, style.VERMILLION, style.GREEN, style.PURPLE, style.ORANGE,
          style.SKY)
MOST = len(SHADES) - 1  # nodal diameters drawn


def plot_campbell(modes: Modes, frame: str = FRAME, ax: Axes | None = None) -> Figure:
    """The lowest frequency of each wave over the spin, one colour for each number of nodal
    diameters n, up to 6; all orders where n is not known.

    frame "co-rotating": with thin lines n s, on which a wave stands still in the fixed frame: where
    one meets its backward wave is the critical speed of n. frame "fixed": the same waves as seen
    from outside, where a critical speed is a zero.
    """
    import matplotlib.pyplot as plt

    frame = frame_named(frame)
    if frame not in (FRAME, "fixed"):
        raise Error(f'frame "{frame}": "{FRAME}" or "fixed"')
    branches = [b for b in modes.branches if b.wave != "rigid" and b.diameters <= MOST
                and (b.order == 1 or b.diameters < 0)]
    if frame == "fixed" and any(b.diameters < 0 for b in branches):
        raise Error(f"{modes.directory}: waves are known on disks only; frame=\"{FRAME}\" "
                    "draws the frequencies of this mesh")
    with style.paper():
        if ax is None:
            ax = plt.figure(figsize=(style.PAGE, 0.55 * style.PAGE)).add_subplot()
        for branch in branches:
            _draw(ax, branch, frame)
        if frame == FRAME:
            _draw_standing(ax, modes, branches)
        ax.set(xlabel="spin (rad/s)", ylabel=f"frequency in the {frame} frame (rad/s)")
        ax.set_xlim(modes.spins.min(), modes.spins.max())
        ax.set_ylim(bottom=0.0)
        _legend(ax, branches, frame)
    figure = ax.figure
    assert isinstance(figure, Figure)
    return figure


def _color(diameters: int) -> str:
    return SHADES[max(diameters, 0)]


def _draw(ax: Axes, branch: Branch, frame: str) -> None:
    spin, values = branch.spin, branch.frequency
    if frame == "fixed":  # finer, so that a zero between two spins is seen as one
        spin = np.unique(np.concatenate([spin, np.linspace(spin[0], spin[-1], 2001)]))
        turn = branch.diameters * np.abs(spin)
        sense = {"backward": -1, "forward": 1}.get(branch.wave, 0)
        values = np.abs(np.interp(spin, branch.spin, branch.frequency) + sense * turn)
    ax.plot(spin, values, color=_color(branch.diameters), linestyle=LINES.get(branch.wave, "-"),
            marker="." if len(branch.spin) < 2 else "")


def _draw_standing(ax: Axes, modes: Modes, branches: list[Branch]) -> None:
    """n |s|, as far as the frequencies go."""
    top = 1.05 * max((float(np.max(b.frequency)) for b in branches), default=1.0)
    spin = np.linspace(modes.spins.min(), modes.spins.max(), 401)
    for n in sorted({b.diameters for b in branches if b.diameters > 0}):
        line = n * np.abs(spin)
        ax.plot(spin, np.where(line <= top, line, np.nan), color=_color(n), lw=0.5, zorder=0)
    ax.set_ylim(top=top)


def _legend(ax: Axes, branches: list[Branch], frame: str) -> None:
    from matplotlib.lines import Line2D

    handles = [Line2D([], [], color=_color(n), label=f"n = {n}")
               for n in sorted({b.diameters for b in branches if b.diameters >= 0})]
    waves = {b.wave for b in branches}
    handles += [Line2D([], [], color="0.3", linestyle=line, label=wave)
                for wave, line in LINES.items() if wave in waves]
    if frame == FRAME and any(b.diameters > 0 for b in branches):
        handles.append(Line2D([], [], color="0.3", lw=0.5, label="n × spin"))
    if handles:
        ax.legend(handles=handles, loc="center left", bbox_to_anchor=(1.0, 0.5))

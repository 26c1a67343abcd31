# SPDX-License-Identifier: BSD-3-Clause
"""The figures of docs/studies.md, from the two sweeps of cases/studies:
    python3 scripts/figure_sweeps.py results/traction results/tread docs/figures"""
from __future__ import annotations

import pathlib
import sys

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

import rondo  # noqa: E402
from rondo import style  # noqa: E402

RADIUS = 0.3  # m
FRICTION = "ground.friction"


def carter(x: np.ndarray) -> np.ndarray:
    """Traction over full friction, over creep over that of full sliding."""
    return np.where(np.abs(x) < 1, np.sign(x) * (1 - (1 - np.abs(x)) ** 2), np.sign(x))


def traction(directory: pathlib.Path, path: pathlib.Path) -> None:
    sweep = rondo.open_sweep(directory)
    sweep = sweep.with_figure("traction", sweep["force_x_mean"] / sweep["force_y_mean"], "1")
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
    for k, friction in enumerate(np.unique(sweep[FRICTION])):
        of = sweep.select({FRICTION: friction})
        slip, share = of["slip_ratio_mean"], of["traction"]
        free = np.interp(0.0, share, slip)
        scale = friction * 0.5 * np.mean(of["contact_length_mean_m"]) / RADIUS
        label = f"friction {friction:g}"
        left.plot(100 * slip, share, ".-", color=f"C{k}", label=label, ms=4)
        right.plot((slip - free) / scale, share / friction, ".", color=f"C{k}", label=label, ms=5)
    x = np.linspace(-2.5, 2.5, 501)
    right.plot(x, carter(x), "k-", lw=1, label="Carter")
    right.set(xlim=(-2.5, 2.5), xlabel=r"creep over that of full sliding, $(\xi-\xi_f)R/(\mu a)$",
              ylabel=r"traction over full friction, $F_x/(\mu F_y)$")
    left.set(xlabel="slip ratio (%)", ylabel=r"$F_x/F_y$")
    for ax in (left, right):
        ax.axhline(0, color="0.8", lw=0.8, zorder=0)
        ax.legend(frameon=False)
    style.save(figure, path)


def tread(directory: pathlib.Path, path: pathlib.Path) -> None:
    sweep = rondo.open_sweep(directory)
    figure, axes = plt.subplots(1, 3, figsize=(12, 3.8), layout="constrained")
    for ax, name in zip(axes, ("force_y_mean", "force_y_fluctuation", "friction_power")):
        sweep.plot_map(name, "disk.tread.pitches", "disk.tread.depth", ax=ax)
    style.save(figure, path)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[3])
    traction(pathlib.Path(sys.argv[1]), folder / "sweep-traction")
    tread(pathlib.Path(sys.argv[2]), folder / "sweep-tread")

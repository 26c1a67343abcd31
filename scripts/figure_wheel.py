# SPDX-License-Identifier: BSD-3-Clause
"""The figures of docs/wheel.md, from the runs and studies that its commands make in a folder:
    python3 scripts/figure_wheel.py results/wheel docs/figures"""
from __future__ import annotations

import pathlib
import sys

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

import rondo  # noqa: E402
from rondo import style  # noqa: E402

RADIUS, COLUMNS = 0.3, 180  # m; of the mesh's edge
SPEED = 10.0  # m/s, of the ramps
SWUNG = 0.25  # s: the ramps begin at 0.2 s with a kink, at which the spin swings for 0.05 s
CLEAT = 3.0  # m, where that of cases/studies/cleat.toml begins
BEFORE, AFTER = 0.15, 1.5  # m, of the cleat that count as crossing it


def settle(folder: pathlib.Path, path: pathlib.Path) -> None:
    figure, (left, right) = plt.subplots(1, 2, figsize=(style.PAGE, 2.3))
    rondo.open(folder / "settle").plot_history("center_y_m", ax=left)
    sweep = rondo.open_sweep(folder / "load-deflection")
    crush = rondo.open(folder / "crush").history
    down = [RADIUS - sweep.run(k).history["center_y_m"][-1] for k in sweep["run"]]
    right.plot(1e3 * crush["depth_m"], 1e-3 * crush["force_y"], label="crush", **style.CURVES[0])
    right.plot(1e3 * np.array(down), 1e-3 * sweep["force_y_mean"], "o", ms=4, color=style.VERMILLION,
               label="wheel at rest under its load")
    right.set(xlabel="deflection (mm)", ylabel="load (kN/m)", xlim=(0, 12), ylim=(0, 240))
    right.legend()
    style.save(figure, path)


def smooth(values: np.ndarray, rows: int) -> np.ndarray:
    """Means over so many rows, of those that have them all."""
    return np.convolve(values, np.ones(rows) / rows, "valid")


def ramp(directory: pathlib.Path) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Slip ratio, F_x/F_y and its rate [1/s] of a run whose torque or brake grows from 0.2 s on:
    means over 8 nodes that come to the ground, in the order of time, of slips up to 8 %."""
    h = rondo.open(directory).history
    spacing = float(np.diff(h["time_s"]).mean())
    rows = max(1, round(8 * 2 * np.pi / COLUMNS / 33.7 / spacing))
    late = h["time_s"] > SWUNG
    x, y, slip = (smooth(h[name][late], rows) for name in ("force_x", "force_y", "slip_ratio"))
    rate = np.gradient(x / y, spacing)
    seen = np.abs(slip) < 0.08
    return slip[seen], (x / y)[seen], rate[seen]


def compare(held: tuple[np.ndarray, np.ndarray], of_ramp: tuple[np.ndarray, ...], name: str) -> None:
    """Prints how far held slips are from a ramp, and by what way of rolling it is behind them."""
    slip, share = held
    order = np.argsort(of_ramp[0])  # of time but for ripples of 1e-5
    at, rate = (np.interp(slip, of_ramp[0][order], part[order], left=np.nan, right=np.nan)
                for part in of_ramp[1:])
    growing = (np.abs(slip) > 0.02) & (np.abs(rate) > 1e-2)  # not where it slides as a whole
    behind = SPEED * np.median((share - at)[growing] / rate[growing])
    print(f"{name}: at most {np.nanmax(np.abs(at - share)):.4f} in Fx/Fy from held slips, "
          f"{behind:.3f} m behind")


def traction(folder: pathlib.Path, path: pathlib.Path) -> None:
    sweep = rondo.open_sweep(folder / "traction")
    figure, ax = plt.subplots(figsize=(style.PAGE * 0.75, 3.0))
    for friction, line in zip(np.unique(sweep["ground.friction"]), style.CURVES):
        of = sweep.select({"ground.friction": friction})
        held = of["slip_ratio_mean"], of["force_x_mean"] / of["force_y_mean"]
        ax.plot(100 * held[0], held[1], ".", ms=3.5, color=line["color"],
                label=f"held slips, friction {friction:g}")
        for kind, look in ("brake", "-"), ("torque", "-"), ("quick-brake", ":"):
            directory = folder / f"{kind}-{friction:g}"
            if not directory.exists():
                continue
            by_ramp = ramp(directory)
            compare(held, by_ramp, directory.name)
            label = {"brake": "the same by a ramp of 2 s", "quick-brake": "by one of 0.4 s"}.get(kind)
            ax.plot(100 * by_ramp[0], by_ramp[1], look, color=line["color"], lw=0.9, label=label)
    ax.axhline(0, color="0.8", lw=0.6, zorder=0)
    ax.set(xlim=(-8, 8), xlabel="slip ratio (%)", ylabel=r"$F_x/F_y$")
    ax.legend(fontsize=6)
    style.save(figure, path)


def cleat_course(folder: pathlib.Path, path: pathlib.Path) -> None:
    """The cleat at a load and at a height, smooth and treaded, over the place of the hub."""
    figure, axes = plt.subplots(2, 2, figsize=(style.PAGE, 3.8), sharex=True)
    names = {"cleat-load": "at a load", "cleat-height": "at a height",
             "cleat-load-treaded": "at a load, treaded",
             "cleat-height-treaded": "at a height, treaded"}
    columns = (("force_y", 1e-3, "vertical force (kN/m)"), ("force_x", 1e-3, "force along x (kN/m)"),
               ("spin_rad_s", 1.0, "spin (rad/s)"), ("center_y_m", 1e3, "height of the hub (mm)"))
    for (name, label), line in zip(names.items(), style.CURVES):
        h = rondo.open(folder / name).history
        for ax, (column, factor, title) in zip(axes.ravel(), columns):
            ax.plot(h["center_x_m"], h[column] * factor, label=label, **line | {"lw": 0.9})
            ax.set_ylabel(title)
    for ax in axes.ravel():
        ax.axvspan(0.5, 0.58, color="0.93", zorder=0)
        ax.set_xlim(0.3, 1.0)
    axes[1, 1].set_ylim(285, 302)
    for ax in axes[1]:
        ax.set_xlabel("place of the hub, x (m)")
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="upper center", ncols=4)
    figure.get_layout_engine().set(rect=(0, 0, 1, 0.93))
    style.save(figure, path)


def crossing(history: rondo.History) -> tuple[dict[str, np.ndarray], float]:
    """What happens at the cleat, and the mean spin before it."""
    x = history["center_x_m"]
    at = (x > CLEAT - BEFORE) & (x < CLEAT + AFTER)
    before = (x > CLEAT - 0.8) & (x < CLEAT - BEFORE)
    return ({name: history[name][at] for name in ("force_x", "force_y", "spin_rad_s")},
            float(history["spin_rad_s"][before].mean()))


def cleat_speeds(folder: pathlib.Path, path: pathlib.Path) -> None:
    sweep = rondo.open_sweep(folder / "cleat")
    speed = sweep["motion.speed"]
    ranges = []
    for k in sweep["run"]:
        seen, spin = crossing(sweep.run(k).history)
        ends = [f(seen[name]) for name in ("force_y", "force_x") for f in (np.min, np.max)]
        ranges.append([*(1e-3 * np.array(ends)), *(100 * (f(seen["spin_rad_s"]) / spin - 1)
                                                   for f in (np.min, np.max))])
    table = np.array(ranges)
    print("speed (m/s): Fy (kN/m), Fx (kN/m), spin (%), least and most")
    for v, row in zip(speed, table):
        print(f"{v:5.1f}: " + " ".join(f"{number:8.2f}" for number in row))
    figure, axes = plt.subplots(1, 3, figsize=(style.PAGE, 2.1))
    labels = ("vertical force (kN/m)", "force along x (kN/m)", "spin, change (%)")
    for k, (ax, label) in enumerate(zip(axes, labels)):
        ax.fill_between(speed, table[:, 2 * k], table[:, 2 * k + 1], color="0.93", zorder=0)
        ax.plot(speed, table[:, 2 * k + 1], "o-", ms=3, color=style.BLUE, label="most")
        ax.plot(speed, table[:, 2 * k], "s--", ms=3, color=style.VERMILLION, label="least")
        ax.set(xlabel="speed (m/s)", ylabel=label)
    axes[0].axhline(150, color="0.4", lw=0.6, ls=":")
    axes[0].legend()
    style.save(figure, path)


def main(folder: pathlib.Path, out: pathlib.Path) -> None:
    with style.paper():
        settle(folder, out / "wheel-settle")
        traction(folder, out / "wheel-traction")
        cleat_course(folder, out / "wheel-cleat")
        cleat_speeds(folder, out / "wheel-cleat-speed")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))

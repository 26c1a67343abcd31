# SPDX-License-Identifier: BSD-3-Clause
"""The figures of docs/steady.md, and the numbers of its tables, from the runs and studies that its
commands make in a folder:
    python3 scripts/figure_steady.py results/steady docs/figures"""
from __future__ import annotations

import pathlib
import sys

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

import rondo  # noqa: E402
from rondo import style  # noqa: E402

FRICTION, LOAD, BETA = "ground.friction", "analysis.load", "damping.stiffness"
SETTLED = 0.2  # s, from which the transients are settled
FRICTIONS, SPEEDS, TREADS = ("0", "0.2", "0.4", "0.6"), ("10", "20", "30", "40", "50"), ("0", "0.3", "0.6")


def forces(directory: pathlib.Path) -> tuple[float, float, float]:
    """Means of F_x and F_y, and the standard deviation of F_y, settled."""
    run = rondo.open(directory)
    start = None if run.is_steady else SETTLED
    h, rows = run.history, run.history.window(start)
    return h.mean("force_x", start), h.mean("force_y", start), float(np.std(h["force_y"][rows]))


def compare(folder: pathlib.Path, what: str, names: tuple[str, ...]) -> None:
    print(f"\n{what}: transient F_x, F_y, deviation of F_y; steady; difference of F_x and F_y over F_y")
    for name in names:
        moved, still = forces(folder / f"t-{what}-{name}"), forces(folder / f"{what}-{name}")
        print(f"{name:>4}: " + " ".join(f"{x:10,.0f}" for x in (*moved, *still))
              + " ".join(f"{100 * (a - b) / moved[1]:8.3f} %" for a, b in zip(still[:2], moved[:2])))


def traction(folder: pathlib.Path, path: pathlib.Path) -> None:
    """Curves without time against transients, each of which is a point."""
    curve, still, moved = (rondo.open_sweep(folder / name)
                           for name in ("slip-curve", "slip-steady", "slip-transient"))
    apart = (still["force_x"] - moved["force_x_mean"]) / moved["force_y_mean"]
    print(f"\nslip: largest difference of F_x {100 * np.abs(apart).max():.3f} % of F_y, of F_y "
          f"{100 * np.abs(still['force_y'] / moved['force_y_mean'] - 1).max():.3f} %")
    figure, ax = plt.subplots(figsize=(style.PAGE * 0.75, 2.8))
    for friction, line in zip(np.unique(curve[FRICTION]), style.CURVES):
        of = curve.select({FRICTION: friction})
        ax.plot(100 * of["slip_ratio"], 1e-3 * of["force_x"], label=f"steady, friction {friction:g}",
                **line)
        of = moved.select({FRICTION: friction})
        ax.plot(100 * of["slip_ratio_mean"], 1e-3 * of["force_x_mean"], "o", ms=4,
                color=line["color"], mfc="white", label="transients")
    ax.axhline(0, color="0.8", lw=0.6, zorder=0)
    ax.set(xlabel="slip ratio (%)", ylabel="horizontal force (kN/m)")
    ax.legend()
    style.save(figure, path)


def carpet(folder: pathlib.Path, path: pathlib.Path) -> None:
    sweep = rondo.open_sweep(folder / "carpet")
    print(f"\ncarpet: {sweep!r}, largest residual {np.nanmax(sweep['contact_residual_max']):.1e}, "
          f"largest strain {np.nanmax(sweep['strain_max']):.3f}")
    for friction in np.unique(sweep[FRICTION]):
        for load in np.unique(sweep[LOAD]):
            of = sweep.select({FRICTION: friction, LOAD: load})
            share = of["force_x"] / (friction * load)
            free = np.interp(0.0, share[::-1], of["slip_ratio"][::-1])
            print(f"friction {friction:g}, {load / 1e3:g} kN/m: free at {100 * free:.2f} %, most "
                  f"{share.min():.3f} and {share.max():.3f} of friction")
    ax = sweep.select({FRICTION: 0.4}).plot_carpet()
    style.save(ax.figure, path)


def resistance(folder: pathlib.Path, path: pathlib.Path) -> None:
    sweep = rondo.open_sweep(folder / "resistance")
    figure, ax = plt.subplots(figsize=(style.PAGE * 0.75, 2.6))
    print("\nresistance (N/m) over speed (m/s)")
    for beta, line in zip(np.unique(sweep[BETA]), style.CURVES):
        of = sweep.select({BETA: beta})
        ax.plot(of["speed"], of["rolling_resistance"], marker=".", **line,
                label=f"{1e6 * beta:g} µs")
        print(f"{beta:g} s: " + ", ".join(f"{r:.1f} at {v:.1f}" for v, r in
                                          zip(of["speed"], of["rolling_resistance"])))
    ax.set(xlabel="speed (m/s)", ylabel="rolling resistance (N/m)", ylim=(0, None))
    ax.legend(title="stiffness damping", ncols=2)
    style.save(figure, path)


def carter(folder: pathlib.Path, path: pathlib.Path) -> None:
    """Traction and stick zone over creep, against Carter (docs/validation.md, V16)."""
    sweep, free = rondo.open_sweep(folder / "carter"), rondo.open(folder / "carter-free")
    case = free.case
    radius, friction = case["disk"]["outer_radius"], case["ground"]["friction"]
    stiffness = case["material"]["youngs_modulus"] / (1 - case["material"]["poissons_ratio"] ** 2)
    rim = case["motion"]["angular_velocity"] * radius
    none = rim / free.steady["speed"] - 1
    pressing = sweep["force_y"]
    width = np.sqrt(4 * pressing * radius / (np.pi * stiffness))  # a
    creep = (rim / sweep["speed"] - 1 - none) * radius / (friction * width)
    share = sweep["force_x"] / (friction * pressing)
    stick = sweep["stick_share"] * sweep["contact_length_m"] / (2 * width)
    expected = np.sign(creep) * (1 - (1 - np.minimum(1, np.abs(creep))) ** 2)
    print(f"\nCarter: free rolling {none:.5f}, largest difference of Q/(mu P) "
          f"{np.abs(share - expected).max():.3f}")
    for row in sorted(zip(creep, share, expected, stick, np.maximum(0, 1 - np.abs(creep)))):
        print(" ".join(f"{x:8.3f}" for x in row))
    figure, (left, right) = plt.subplots(1, 2, figsize=(style.PAGE, 2.5))
    x = np.linspace(-1.3, 1.3, 261)
    inside = np.minimum(1, np.abs(x))
    left.plot(x, np.sign(x) * (1 - (1 - inside) ** 2), label="Carter", **style.CURVES[0])
    right.plot(x, 1 - inside, label="Carter", **style.CURVES[0])
    for ax, values in ((left, share), (right, stick)):
        ax.plot(creep, values, "o", ms=3.5, mfc="white", color=style.VERMILLION, label="rondo")
        ax.set_xlabel("creep over that of full sliding (–)")
        ax.legend()
    left.set_ylabel("traction over full friction (–)")
    right.set_ylabel("c/a (–)")
    style.save(figure, path)


def main(folder: pathlib.Path, out: pathlib.Path) -> None:
    compare(folder, "friction", FRICTIONS)
    compare(folder, "speed", SPEEDS)
    compare(folder, "tread", TREADS)
    with style.paper():
        traction(folder, out / "steady-traction")
        carpet(folder, out / "steady-carpet")
        resistance(folder, out / "steady-resistance")
        carter(folder, out / "steady-carter")
        style.save(rondo.open(folder / "braked").plot_footprint(), out / "steady-footprint")
        style.save(rondo.open(folder / "treaded").plot_footprint(), out / "steady-footprint-treaded")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))

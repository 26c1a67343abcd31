# SPDX-License-Identifier: BSD-3-Clause
"""Steady rolling against Carter (docs/validation.md, V16), from runs of cases/carter.toml:
    python3 scripts/figure_carter.py docs/figures/carter.png results/v16/*
The run with the least traction gives the creep of free rolling. Prints a table."""
from __future__ import annotations

import pathlib
import sys

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

import rondo  # noqa: E402
from rondo import style  # noqa: E402


class Rolling:
    """Means over the last seventh of a run, the rolling alone in steady state by then."""

    def __init__(self, directory: pathlib.Path) -> None:
        run = rondo.open(directory)
        case, history = run.case, run.history
        self.radius = float(case["disk"]["outer_radius"])
        self.friction = float(case["ground"]["friction"])
        material = case["material"]
        modulus = material["youngs_modulus"] / (1.0 - material["poissons_ratio"] ** 2)
        time = np.asarray(history["time_s"])
        self.start = 6 / 7 * time[-1]
        late = time > self.start
        self.pressing = float(np.mean(history["force_y"][late]))
        self.share = float(np.mean(history["force_x"][late])) / (self.friction * self.pressing)
        self.creep = case["motion"]["angular_velocity"] * self.radius / case["motion"]["speed"] - 1
        self.half_width = np.sqrt(4 * self.pressing * self.radius / (np.pi * modulus))
        self.peak = 2 * self.pressing / (np.pi * self.half_width)
        self.scale = self.friction * self.half_width / self.radius
        rows = np.genfromtxt(directory / "contact.csv", delimiter=",", names=True)
        rows = rows[rows["time_s"] > self.start]
        center = np.interp(rows["time_s"], time, history["center_x_m"])
        self.x = rows["x_m"] - center
        self.pressure, self.shear = rows["pressure_pa"], -rows["shear_pa"]  # towards +x


def stick(share: float) -> float:
    """c/a"""
    return float(np.sqrt(max(0.0, 1 - abs(share))))


def carter(x: np.ndarray, share: float) -> np.ndarray:
    """q/(μ p0) over x/a; the leading edge is at 1."""
    c = stick(share)
    whole = np.sqrt(np.maximum(0, 1 - x**2))
    spared = c * np.sqrt(np.maximum(0, 1 - ((x - 1 + c) / c) ** 2))
    return np.sign(share) * (whole - spared)


def draw_curve(ax: plt.Axes, runs: list[Rolling], none: float) -> None:
    share = np.linspace(-1, 1, 401)
    creep = np.sign(share) * (1 - np.sqrt(1 - np.abs(share)))
    ax.plot(np.r_[-1.4, creep, 1.4], np.r_[-1, share, 1], color="0.3", lw=0.8, label="Carter")
    ax.plot([(r.creep - none) / r.scale for r in runs], [r.share for r in runs], "o", ms=3,
            color="C0", label="rondo")
    ax.set(xlabel=r"creep / ($\mu a/R$)", ylabel=r"$Q/(\mu P)$", xlim=(-1.3, 1.3))
    ax.legend(frameon=False, loc="upper left")


def draw_tractions(ax: plt.Axes, run: Rolling) -> None:
    x = np.linspace(-1, 1, 801)
    limit = run.friction * run.peak
    sense = np.sign(run.share)
    ax.plot(run.x / run.half_width, run.friction * run.pressure / limit, ".", ms=1.5,
            color="0.6", label=r"$\mu p$")
    ax.plot(run.x / run.half_width, sense * run.shear / limit, ".", ms=1.5, color="C0",
            label=r"$|q|$")
    ax.plot(x, np.sqrt(1 - x**2), color="0.3", lw=0.6)
    ax.plot(x, sense * carter(x, run.share), color="0.3", lw=0.8)
    ax.axvline(1 - 2 * stick(run.share), color="0.3", lw=0.6, ls=":")
    name = "driving" if run.share > 0 else "braking"
    ax.set(xlabel=r"$x/a$, rolling to the right", title=f"{name}, Q = {abs(run.share):.2f} μP",
           xlim=(-1.2, 1.2), ylim=(-0.1, 1.15))
    ax.legend(frameon=False, loc="upper left", markerscale=4)


def main() -> None:
    out, *directories = map(pathlib.Path, sys.argv[1:])
    runs = sorted((Rolling(d) for d in directories), key=lambda r: r.creep)
    free = min(runs, key=lambda r: abs(r.share))
    none = free.creep - free.scale * np.sign(free.share) * (1 - stick(free.share))
    print(f"P {free.pressing:.1f} N/m, a {free.half_width * 1e3:.3f} mm, free rolling {none:.6f}")
    for r in runs:
        expected = np.sign(r.share) * (1 - stick(r.share))
        print(f"{r.creep:9.4f}  Q/(muP) {r.share:7.4f}  creep {(r.creep - none) / r.scale:7.4f}"
              f"  Carter {expected:7.4f}")
    shown = [min(runs, key=lambda r: abs(r.share - target)) for target in (-0.6, 0.6)]
    with style.paper():
        figure, axes = plt.subplots(1, 3, figsize=(7.2, 2.5), layout="constrained")
        draw_curve(axes[0], runs, none)
        for ax, run in zip(axes[1:], shown):
            draw_tractions(ax, run)
        figure.savefig(out, dpi=200)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Figure of docs/fmu.md: a car on four FMUs changes lanes and crosses a cleat at 30°.

    python3 examples/fmu/four_wheels.py wheel.fmu results
    python3 scripts/figure_four_wheels.py results docs/figures/fmu-four-wheels.png
"""
import pathlib
import sys

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

WHEELS = ("front_left", "front_right", "rear_left", "rear_right")
COLORS = ("#1b6ca8", "#c8553d", "#7fb2d9", "#e8a598")


def draw(axes, table, name, label, scale, begin):
    late = table["time_s"] > begin
    for wheel, color in zip(WHEELS, COLORS):
        axes.plot(table["time_s"][late], table[f"{name}_{wheel}"][late] / scale, color=color, linewidth=1.0,
                  label=wheel.replace("_", " "))
    axes.set_ylabel(label)
    axes.grid(alpha=0.3)


def main():
    lane, cleat = (np.genfromtxt(pathlib.Path(sys.argv[1]) / f"{name}.csv", delimiter=",", names=True)
                   for name in ("lane", "cleat"))
    figure, axes = plt.subplots(3, 2, figsize=(10, 7.5), sharex="col", layout="constrained")
    for column, (table, begin) in enumerate(((lane, 0.4), (cleat, 0.5))):
        draw(axes[0, column], table, "contact_force_z", "force z in kN", 1e3, begin)
        draw(axes[1, column], table, "contact_force_y", "force y in kN", 1e3, begin)
        axes[2, column].set_xlabel("time in s")
    draw(axes[2, 1], cleat, "contact_moment_z", "moment z in N m", 1.0, 0.5)
    late = lane["time_s"] > 0.4
    axes[2, 0].plot(lane["time_s"][late], lane["y_m"][late], color="black", label="y in m")
    axes[2, 0].plot(lane["time_s"][late], np.degrees(lane["roll_rad"][late]), color="#c8553d", label="roll in °")
    axes[2, 0].plot(lane["time_s"][late], np.degrees(lane["steer_rad"][late]) / 10, color="#1b6ca8",
                    label="steering in 10°")
    axes[2, 0].set_ylabel("car")
    axes[2, 0].grid(alpha=0.3)
    axes[2, 0].legend(fontsize=8)
    axes[0, 1].legend(fontsize=8)
    axes[0, 0].set_title("Lane change at 10 m/s")
    axes[0, 1].set_title("Cleat at 30°, 15 mm high, at 10 m/s")
    figure.savefig(sys.argv[2], dpi=110)


if __name__ == "__main__":
    main()

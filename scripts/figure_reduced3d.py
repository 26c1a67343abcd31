#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Figure of docs/reduced3d.md: a tyre changes the lane and crosses a cleat, reduced and in full. Prints how far the
forces differ, as means over the pass of a sector, in % of 4 kN: largest and rms.

    python3 scripts/figure_reduced3d.py LANE-REDUCED LANE-FULL CLEAT-REDUCED CLEAT-FULL FIGURE.png
"""
import csv
import pathlib
import sys

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

SPIN = 43.4  # rad/s of both cases


def history(directory):
    with open(pathlib.Path(directory) / "history.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def in_passes(h, name, width):
    """Means over the pass of a sector, every half of it."""
    time = np.concatenate([[0.0], h["time_s"]])
    integral = np.concatenate([[0.0], np.cumsum(h[name] * np.diff(time))])
    ends = np.arange(width, time[-1], width / 2)
    return ends - width / 2, (np.interp(ends, time, integral) - np.interp(ends - width, time, integral)) / width


def main():
    runs = [history(directory) for directory in sys.argv[1:5]]
    figure, axes = plt.subplots(3, 2, figsize=(10, 7.5), sharex="col", layout="constrained")
    for column, (reduced, full, sectors, begin, title) in enumerate((
            (*runs[:2], 90, 0.03, "Lane change: 3° to either side"), (*runs[2:], 120, 0.016, "Cleat at 30°, 17 mm high"))):
        width = 2 * np.pi / SPIN / sectors
        for row, (name, label, scale) in enumerate((("force_y", "vertical force in kN", 1e3),
                                                    ("force_lateral", "lateral force in kN", 1e3),
                                                    ("moment_aligning", "aligning moment in N m", 1.0))):
            for run, color, line, text in ((full, "black", 1.0, "full run"), (reduced, "#c8553d", 1.0, "reduced")):
                time, mean = in_passes(run, name, width)
                late = time > begin
                axes[row, column].plot(time[late], mean[late] / scale, color=color, linewidth=line, label=text)
            axes[row, column].set_ylabel(label)
            axes[row, column].grid(alpha=0.3)
        for name in ("force_x", "force_y", "force_lateral"):
            (time, a), (_, b) = (in_passes(run, name, width) for run in (reduced, full))
            n = min(len(a), len(b))
            off = (a[:n] - b[:n])[time[:n] > begin] / 40.0
            print(f"{title}: {name} {np.abs(off).max():.1f}; {np.sqrt(np.mean(off**2)):.1f} %")
        axes[2, column].set_xlabel("time in s")
        axes[0, column].set_title(title)
    axes[0, 0].legend(fontsize=8)
    figure.savefig(sys.argv[5], dpi=110)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""Decay of the energy that r modes leave out, for some PODs in one picture.

    python3 draw_decay.py OUT.png TITLE LABEL=POD_DIR [LABEL=POD_DIR ...]

POD_DIR holds a spectrum.csv. A label that begins with "velocity" is drawn dashed.
"""
import csv
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7"]  # told apart by colour-blind readers


def discarded(directory):
    with open(pathlib.Path(directory) / "spectrum.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    return ([int(row["mode"]) for row in rows], [float(row["discarded_energy"]) for row in rows])


def main():
    out, title, *curves = sys.argv[1:]
    figure, axes = plt.subplots(figsize=(6.4, 4.4), layout="constrained")
    colours = {}
    for curve in curves:
        label, directory = curve.rsplit("=", 1)
        dashed = label.startswith("velocity")
        kind = label.split(",", 1)[-1]
        colour = colours.setdefault(kind, COLOURS[len(colours) % len(COLOURS)])
        modes, rest = discarded(directory)
        kept = [(m, e) for m, e in zip(modes, rest) if e > 1e-17]
        axes.loglog(*zip(*kept), color=colour, linestyle="--" if dashed else "-", label=label,
                    marker="o" if len(kept) < 60 else "", markersize=3)
    for share in (1e-2, 1e-4, 1e-6):
        axes.axhline(share, color="0.8", linewidth=0.8, zorder=0)
    axes.set(xlabel="modes kept", ylabel="share of the energy left out", title=title,
             ylim=(1e-16, 1.5))
    axes.legend(fontsize=8, loc="lower left")
    figure.savefig(out, dpi=160)


if __name__ == "__main__":
    main()

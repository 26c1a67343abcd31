# SPDX-License-Identifier: BSD-3-Clause
"""What the problems of bench/schemes.py share: reading results, drawing them side by side."""
import csv
import json
import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "python"))
SECONDS = "time (s)"  # of stepping: measured by the driver
MASSLESS = 'contact_mass = "singular"\n'


def history(out):
    with open(out / "history.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def summary(out):
    return json.loads((out / "run.json").read_text())


def ledger(out):
    return f"{summary(out)['energy_residual_relative']:.0e}"


def steps(out):
    return f"{summary(out)['steps']:,}"


def integral(y, x):
    return float(np.sum(0.5 * (y[1:] + y[:-1]) * np.diff(x)))


def panels(path, rows, curve, labels, limits, exact=None):
    """A panel a row: curve(results), over exact(results) in grey. @param limits of x and y"""
    import matplotlib.pyplot as plt
    from rondo import style

    n = (len(rows) + 1) // 2
    with style.paper():
        figure, axes = plt.subplots(n, 2, sharex=True, sharey=True, squeeze=False,
                                    figsize=(style.PAGE, 1.25 * n + 0.4))
        for axis in axes.flat[len(rows):]:
            axis.set_axis_off()
        for axis, (title, out) in zip(axes.flat, rows):
            if exact:
                axis.plot(*exact(out), color="0.7", linewidth=3.0)
            axis.plot(*curve(out), color=style.BLUE, linewidth=0.7)
            axis.set_title(title)
            axis.set_xlim(limits[0])
            axis.set_ylim(limits[1])
            axis.locator_params(axis="x", nbins=5)
        for axis in axes[-1]:
            axis.set_xlabel(labels[0])
        figure.supylabel(labels[1], fontsize=8)
        figure.tight_layout()
        for written in style.save(figure, path):
            if written.suffix == ".svg":
                written.unlink()
        plt.close(figure)

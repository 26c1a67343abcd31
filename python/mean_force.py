# SPDX-License-Identifier: BSD-3-Clause
"""Time means of the ground's forces on the body, from a time on.

    /usr/bin/python3 python/mean_force.py FROM_SECONDS RESULTS...
"""
import csv
import pathlib
import sys


def means(directory, start):
    """(mean force_x, mean force_y) in N/m over the rows after `start`, weighted by their intervals."""
    with open(pathlib.Path(directory) / "history.csv", newline="") as file:
        rows = [{name: float(row[name]) for name in ("time_s", "force_x", "force_y")}
                for row in csv.DictReader(file)]
    chosen = [(b["time_s"] - a["time_s"], b) for a, b in zip(rows, rows[1:])
              if a["time_s"] >= start]
    if not chosen:
        sys.exit(f"{directory}: no rows after {start} s")
    time = sum(span for span, _ in chosen)
    return [sum(span * row[name] for span, row in chosen) / time for name in ("force_x", "force_y")]


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    for results in sys.argv[2:]:
        force_x, force_y = means(results, float(sys.argv[1]))
        print(f"{results}: force_x {force_x:.5g} N/m, force_y {force_y:.6g} N/m")

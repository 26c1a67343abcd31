# SPDX-License-Identifier: BSD-3-Clause
"""Time means of the ground's forces on the body, from a time on.

    /usr/bin/python3 python/mean_force.py FROM_SECONDS RESULTS...
"""
import sys

import numpy as np

from history import read_history


def means(directory, start):
    """(mean force_x, mean force_y) in N/m over the rows after `start`, weighted by their intervals."""
    history = read_history(directory)
    spans = np.diff(history["time_s"], prepend=0.0)
    chosen = history["time_s"] - spans >= start
    if not chosen.any():
        sys.exit(f"{directory}: no rows after {start} s")
    return [np.average(history[name][chosen], weights=spans[chosen])
            for name in ("force_x", "force_y")]


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    for results in sys.argv[2:]:
        force_x, force_y = means(results, float(sys.argv[1]))
        print(f"{results}: force_x {force_x:.5g} N/m, force_y {force_y:.6g} N/m")

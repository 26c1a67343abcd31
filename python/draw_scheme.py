# SPDX-License-Identifier: BSD-3-Clause
"""The energy of the same spin-up by both schemes: what is there, and what the ledger leaves open.

    /usr/bin/python3 python/draw_scheme.py SYMPLECTIC AS_PRINTED PICTURE.png
"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from history import read_history


def draw(symplectic, printed, picture):
    figure, (energy, residual) = plt.subplots(2, 1, figsize=(7.2, 5.0), sharex=True,
                                              layout="constrained", height_ratios=(2, 1))
    for directory, name, style in ((printed, "as printed", {"color": "#d55e00", "ls": "--"}),
                                   (symplectic, "symplectic", {"color": "#0072b2"})):
        h = read_history(directory)
        total = h["kinetic"] + h["strain"]
        energy.semilogy(h["time_s"], total, lw=0.8, label=f"energy, {name}", **style)
        exchanged = np.maximum.accumulate(total + np.abs(h["work_frame"])
                                          + np.abs(h["work_scheme"]))
        residual.semilogy(h["time_s"], np.maximum(np.abs(h["energy_residual"]) / exchanged, 1e-18),
                          lw=0.8, **style)
        if np.any(h["work_scheme"]):
            energy.semilogy(h["time_s"], np.abs(h["work_scheme"]), lw=1, color="0.5", ls=":",
                            label="created by the scheme")
    energy.set_ylabel("energy (J/m)")
    energy.set_ylim(10, None)
    energy.legend(frameon=False, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=3)
    residual.set_ylabel("ledger residual (–)")
    residual.set_ylim(1e-18, 1e-12)
    residual.set_xlabel("time (s)")
    residual.set_xlim(0, None)
    figure.savefig(picture, dpi=150)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    draw(*sys.argv[1:])

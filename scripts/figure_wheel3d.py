# SPDX-License-Identifier: BSD-3-Clause
"""The figures of docs/wheel3d.md from the runs and sweeps that its commands make in a folder:
    python3 scripts/figure_wheel3d.py results docs/figures"""
from __future__ import annotations

import pathlib
import sys

import matplotlib

matplotlib.use("Agg")

import rondo  # noqa: E402


def main(results: pathlib.Path, figures: pathlib.Path) -> None:
    tyre = rondo.open(results / "tyre")
    tyre.plot_footprint().savefig(figures / "wheel3d-footprint.png", dpi=110)
    tyre.plot_field(0.12, "pressure").figure.savefig(figures / "wheel3d-pressure.png", dpi=90)
    sweeps = [rondo.open_sweep(results / name) for name in ("tyre-map", "tyre-map-steady")]
    upright = [sweep.select({"motion.camber": 0.0}) for sweep in sweeps]
    upright[0].plot_tyre_curves(upright[1], by="analysis.load").savefig(figures / "wheel3d-tyre.png", dpi=110)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))

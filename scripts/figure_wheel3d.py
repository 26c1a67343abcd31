# SPDX-License-Identifier: BSD-3-Clause
"""The figures of docs/wheel3d.md from the runs and sweeps that its commands make in a folder:
    python3 scripts/figure_wheel3d.py results docs/figures"""
from __future__ import annotations

import io
import pathlib
import sys

import matplotlib
from PIL import Image

matplotlib.use("Agg")

import rondo  # noqa: E402


def side_by_side(figures: list[matplotlib.figure.Figure], height: int, path: pathlib.Path) -> None:
    """One picture of several, of one height in pixels, on white."""
    images = []
    for figure in figures:
        file = io.BytesIO()
        figure.savefig(file, dpi=1.6 * height / figure.get_figheight(), bbox_inches="tight")
        image = Image.open(file).convert("RGB")
        images.append(image.resize((round(image.width * height / image.height), height), Image.LANCZOS))
    row = Image.new("RGB", (sum(image.width for image in images), height), "white")
    left = 0
    for image in images:
        row.paste(image, (left, 0))
        left += image.width
    row.quantize(128).save(path, optimize=True)


def main(results: pathlib.Path, figures: pathlib.Path) -> None:
    tyre = rondo.open(results / "tyre")
    side_by_side([tyre.plot_field(0.12, "pressure").figure, tyre.plot_footprint()], 620,
                 figures / "wheel3d.png")
    sweeps = [rondo.open_sweep(results / name) for name in ("tyre-map", "tyre-map-steady")]
    upright = [sweep.select({"motion.camber": 0.0}) for sweep in sweeps]
    upright[0].plot_tyre_curves(upright[1], by="analysis.load").savefig(figures / "wheel3d-tyre.png", dpi=110)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))

# SPDX-License-Identifier: BSD-3-Clause
"""A traction curve in five lines: longitudinal force over slip, of steady states in memory.

    python3 examples/traction_curve.py results/traction-curve

The disk of cases/steady-rolling.toml under 150 kN/m, friction 0.4, from 8 % driving to 7.4 % braking: the row of that
load and friction in the study cases/studies/steady-traction.toml. Writes traction.csv, traction.png and traction.svg."""
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import rondo  # noqa: E402
from rondo import style  # noqa: E402

CASE = pathlib.Path(__file__).resolve().parents[1] / "cases" / "steady-rolling.toml"


def curve(speeds: np.ndarray, load: float, friction: float) -> tuple[np.ndarray, np.ndarray]:
    """Slip ratio and longitudinal force [N/m] at these speeds of the center [m/s]."""
    states = [rondo.steady_rolling(CASE, {"motion.speed": speed, "analysis.load": load, "ground.friction": friction})
              for speed in speeds]
    slip, force = ([state.steady[name] for state in states] for name in ("slip_ratio", "force_x"))
    return np.array(slip), np.array(force)


def main(folder: pathlib.Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    slip, force = curve(np.linspace(9.2, 10.8, 25), 1.5e5, 0.4)
    (folder / "traction.csv").write_text("slip_ratio,force_x\n" + "".join(
        f"{float(s)!r},{float(f)!r}\n" for s, f in zip(slip, force)))
    with style.paper():
        figure, ax = plt.subplots(figsize=(style.COLUMN, 2.2))
        ax.plot(100 * slip, 1e-3 * force, marker=".", **style.CURVES[0])
        ax.set(xlabel="slip ratio (%)", ylabel="horizontal force (kN/m)")
        style.save(figure, folder / "traction")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))

# SPDX-License-Identifier: BSD-3-Clause
"""What an anti-lock brake is there for: a wheel that locks in a corner has no side force left.

    python3 examples/abs_corner.py results/abs-corner

The wheel in three dimensions of cases/wheel3d-load.toml runs at 10 m/s with a slip angle of 2 degrees and is
braked, by a brake that locks it and by the controller of abs_controller.py. Friction acts against the slip: all of
it is along the way once the wheel stands. Writes abs-corner.csv, abs-corner.png and abs-corner.svg."""
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from abs_controller import CASES, anti_lock, braked, locking  # noqa: E402

import rondo  # noqa: E402
from rondo import style  # noqa: E402

BRAKED = 0.45  # s, from which means are taken
CORNER = {"motion.slip_angle": [[0.0, 0.0], [0.05, 0.0], [0.1, 0.0349]]}  # rad


def main(folder: pathlib.Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    table = ["brake,force_x_n,force_lateral_n,force_y_n,slip"]
    with style.paper():
        figure, axes = plt.subplots(1, 3, figsize=(style.PAGE, 2.2))
        for name, controller, line in (("locked", locking, style.CURVES[1]), ("anti-lock", anti_lock, style.CURVES[0])):
            with rondo.Simulation(CASES / "wheel3d-load.toml", CORNER) as simulation:
                h = braked(simulation, controller, most=3200.0, settled=0.2)  # N m
            late = h["time_s"] > BRAKED
            means = {column: values[late].mean() for column, values in h.items()}
            table.append(f"{name},{means['force_x']:.1f},{means['force_lateral']:.1f},{means['force_y']:.1f},"
                         f"{means['slip']:.4f}")
            for ax, values in zip(axes, (100.0 * h["slip"], 1e-3 * h["force_x"], 1e-3 * h["force_lateral"])):
                ax.plot(h["time_s"], values, label=name, **line)
        for ax, label in zip(axes, ("slip (%)", "force along the wheel (kN)", "side force (kN)")):
            ax.set(xlabel="time (s)", ylabel=label)
        axes[0].legend()
        style.save(figure, folder / "abs-corner")
    (folder / "abs-corner.csv").write_text("\n".join(table) + "\n")
    print("\n".join(table))


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))

# SPDX-License-Identifier: BSD-3-Clause
"""The tread with the least ripple, among all that let as much water through.

    python3 examples/tread_ripple.py results/tread

A treaded wheel rolls freely at 150 kN/m. Over the pass of a pitch the vertical force goes up and down: its
standard deviation over its mean is the ripple. The tread has 180 columns of elements, at most half of them grooves,
which are 4.5 mm deep or more as a mean around the wheel. All choices of pitches, grooves and depth that keep this are
solved, two at a time. Writes tread.csv, tread.png and tread.svg."""
import itertools
import pathlib
import sys
from concurrent.futures import ThreadPoolExecutor

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import rondo  # noqa: E402
from rondo import style  # noqa: E402

CASE = pathlib.Path(__file__).resolve().parents[1] / "cases" / "steady-treaded.toml"
COLUMNS, WATER = 180, 4.5e-3  # of the tread; m, mean depth of its grooves
START = (36, 2, 0.015)  # pitches, columns of a groove, depth [m]
CHOICES = itertools.product((30, 36, 45, 60), (1, 2, 3), (0.010, 0.015, 0.020))


def is_allowed(design: tuple[int, int, float]) -> bool:
    share = design[0] * design[1] / COLUMNS  # of the grooves
    return share <= 0.5 and share * design[2] >= WATER


def vertical_force(design: tuple[int, int, float]) -> np.ndarray:
    """At places of a pitch's pass, four for each column [N/m]."""
    pitches, grooves, depth = design
    columns = COLUMNS // pitches
    return rondo.steady_rolling(CASE, {
        "disk.tread.pitches": pitches, "disk.tread.groove_columns": grooves,
        "disk.tread.land_columns": columns - grooves, "disk.tread.depth": depth, "disk.mesh.radial": 8,
        "analysis.load": 1.5e5, "analysis.torque": 0.0, "analysis.samples_per_sector": 4 * columns,
    }).history["force_y"]


def ripple(force: np.ndarray) -> float:
    return float(force.std() / force.mean())


def main(folder: pathlib.Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    designs = [design for design in CHOICES if is_allowed(design)]
    with ThreadPoolExecutor(2) as two:  # the interpreter's lock is free while a state is solved
        forces = dict(zip(designs, two.map(vertical_force, designs)))
    best = min(designs, key=lambda design: ripple(forces[design]))
    rows = "".join(f"{p},{g},{d},{ripple(force)!r}\n" for (p, g, d), force in forces.items())
    (folder / "tread.csv").write_text("pitches,groove_columns,depth_m,ripple\n" + rows)
    for name, design in (("start", START), ("least", best)):
        print(f"{name}: {design[0]} pitches, grooves of {design[1]} columns, {1e3 * design[2]:g} mm deep: ripple "
              f"{100 * ripple(forces[design]):.2f} %")
    with style.paper():
        figure, (left, right) = plt.subplots(1, 2, figsize=(style.PAGE, 2.3))
        for name, design, line in (("start", START, style.CURVES[1]), ("least", best, style.CURVES[0])):
            left.plot(np.arange(81) / 4 * 360 / COLUMNS, 1e-3 * np.resize(forces[design], 81), label=name, **line)
        for depth, line in zip((0.010, 0.015, 0.020), style.CURVES):
            of = [(design[0], 100 * ripple(force)) for design, force in forces.items() if design[2] == depth]
            right.plot(*zip(*of), "o", ms=4, mfc="white", color=line["color"], label=f"{1e3 * depth:g} mm deep")
        left.set(xlabel="angle of the wheel (°)", ylabel="vertical force (kN/m)")
        right.set(xlabel="pitches", ylabel="ripple (%)", ylim=(0, None))
        left.legend()
        right.legend()
        style.save(figure, folder / "tread")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))

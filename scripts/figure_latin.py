# SPDX-License-Identifier: BSD-3-Clause
"""The figures of docs/latin.md, and the numbers of its tables, from the runs that its commands make
in a folder:
    python3 scripts/figure_latin.py results/latin docs/figures"""
from __future__ import annotations

import json
import pathlib
import sys
from typing import Any

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.axes import Axes  # noqa: E402

import rondo  # noqa: E402
from rondo import style  # noqa: E402

HISTORIES = {"press": "pressing", "drag": "pressing, then sliding"}
TOLERANCES = ("1e-1", "3e-2", "1e-2", "3e-3", "latin-pgd", "3e-4", "1e-4", "1e-5")  # names of runs
SHARES = (1e-2, 1e-3, 1e-4)
INCREMENTS = (20, 50, 100, 200, 500)  # of each of the two parts
SOLVERS = ("direct", "latin", "latin-pgd")
BY_LATIN = {"latin": "LATIN", "latin-pgd": "LATIN-PGD", "all": "LATIN-PGD, nothing dropped"}
FACTORS = ("0.1", "0.2", "0.5", "0.8", "1", "1.25", "2", "5", "10")
MESHES = ("6x90", "12x180", "24x360", "48x720")
FRICTIONS, DEPTHS = ("0.1", "0.2", "0.4", "0.6", "0.8"), ("0.01", "0.015", "0.025")


def on_candidates(run: rondo.Run) -> tuple[np.ndarray, np.ndarray]:
    """(N, 2m) forces of the ground, and displacements where they act."""
    force = run.contact.force[:]  # normal, tangential: y and -x of flat ground
    u = run.displacement[:][:, run.mesh.boundary][..., ::-1] * (1, -1)
    return force.reshape(len(force), -1), u.reshape(len(u), -1)


def error_in_energy(run: rondo.Run, direct: rondo.Run) -> float:
    """Relative, over all increments: of two fields that balance their forces, uᵀKu is r·Hu."""
    (force, u), (r, v) = on_candidates(run), on_candidates(direct)
    return float(np.sqrt(((force - r) * (u - v)).sum() / (r * v).sum()))


def pod_in_energy(run: rondo.Run) -> np.ndarray:
    """What the first 0, 1, 2, ... modes of its POD in the norm uᵀKu leave, relative."""
    force, u = on_candidates(run)
    products = force @ u.T
    values = np.linalg.eigvalsh(0.5 * (products + products.T))[::-1].clip(0.0)
    left = np.append(values[::-1].cumsum()[::-1], 0.0)
    return np.sqrt(left / left[0])


def needed(left: np.ndarray, share: float) -> int:
    """Modes after which no more than the share is left."""
    return int(np.argmax(left <= share))


def told(directory: pathlib.Path) -> dict[str, Any]:
    """What run.json says of a run that is done, whose fields may be gone."""
    info: dict[str, Any] = json.loads((directory / "run.json").read_text())
    if info["status"] != "done":
        sys.exit(f'{directory}: status "{info["status"]}": {info.get("message")}')
    return info


def count(run: rondo.Run) -> str:
    info: dict[str, Any] = run.info
    return (f"iterations {info['iterations']:4d}, solves {info['solves']:4d}, modes at most "
            f"{info['modes_max']:3d}, at the end {run.convergence['modes'][-1]:3.0f}, after the cut "
            f"{info['modes']:3d}")


def modes_of(folder: pathlib.Path, history: str, ax: Axes) -> None:
    direct = rondo.open(folder / f"{history}-direct")
    left = pod_in_energy(direct)
    mass = direct.pod("displacement").projection_error(direct.displacement[:])
    runs = [rondo.open(folder / f"{history}-{name}") for name in TOLERANCES]
    errors = [error_in_energy(run, direct) for run in runs]
    print(f"\n{history}: modes of the POD in energy " + ", ".join(
        f"{needed(left, share)} to {share:g}" for share in (1e-1, *SHARES, 1e-5)))
    for name, run, error in zip(TOLERANCES, runs, errors):
        print(f"{name:>10}: error {error:.2e}, {count(run)}, POD to the same error "
              f"{needed(left, error)}")
    for name in ("all", "1.7"):
        if (folder / f"{history}-{name}").exists():
            run = rondo.open(folder / f"{history}-{name}")
            print(f"{name:>10}: error {error_in_energy(run, direct):.2e}, {count(run)}")
    latin = rondo.open(folder / f"{history}-latin")
    print(f"     latin: error {error_in_energy(latin, direct):.2e}, iterations "
          f"{latin.info['iterations']}")
    pgd = runs[-1].pod("displacement", "pgd").projection_error(direct.displacement[:])
    print("in the norm of the mass, of POD and PGD: " + ", ".join(
        f"{needed(mass, share)} and {needed(pgd, share)} to {share:g}" for share in SHARES))
    ax.semilogy(np.arange(len(left)), left, label="POD of the direct solution", **style.CURVES[0])
    for counts, mark, label in (([run.convergence["modes"][-1] for run in runs], "^", "on the way"),
                                ([run.info["modes"] for run in runs], "o", "after the last cut")):
        ax.plot(counts, errors, mark, ms=4.5, mfc="white", label=f"LATIN-PGD, {label}",
                color=style.VERMILLION if mark == "o" else style.CURVES[2]["color"])
    ax.set(xlim=(0, 38), ylim=(3e-6, 1.5), xlabel="modes (–)", title=HISTORIES[history])


def modes(folder: pathlib.Path, path: pathlib.Path) -> None:
    figure, axes = plt.subplots(1, 2, figsize=(style.PAGE, 2.6), sharey=True)
    for history, ax in zip(HISTORIES, axes):
        modes_of(folder, history, ax)
    axes[0].set_ylabel("relative error in energy (–)")
    axes[0].legend()
    style.save(figure, path)


def cost(folder: pathlib.Path, path: pathlib.Path) -> None:
    """The least of all repeats: other programs only make them longer."""
    print("\nincrements: loop_wall_s, loop_cpu_s, total_wall_s of each solver; solves of latin-pgd")
    figure, (left, right) = plt.subplots(1, 2, figsize=(style.PAGE, 2.6))
    used: dict[str, list[float]] = {solver: [] for solver in SOLVERS}
    for n in INCREMENTS:
        line = f"{2 * n:5d}:"
        for solver in SOLVERS:
            runs = [told(at) for at in folder.glob(f"cost-{n}-{solver}-?")]
            times = [min(run[key] for run in runs)
                     for key in ("loop_wall_s", "loop_cpu_s", "total_wall_s")]
            used[solver].append(times[1])
            line += f"  {solver} " + " ".join(f"{1e3 * time:6.0f}" for time in times) + " ms"
        print(f"{line}  {runs[0]['solves']}")
    for solver, look in zip(SOLVERS, style.CURVES):
        left.loglog(2 * np.array(INCREMENTS), used[solver], marker="o", ms=3.5, label=solver, **look)
    left.set(xlabel="increments (–)", ylabel="processor time of the increments (s)",
             xticks=[40, 100, 200, 400, 1000], xticklabels=["40", "100", "200", "400", "1000"],
             yticks=[0.05, 0.1, 0.2, 0.5, 1], yticklabels=["0.05", "0.1", "0.2", "0.5", "1"])
    left.minorticks_off()
    left.legend()
    reuse(folder, right)
    style.save(figure, path)


def reuse(folder: pathlib.Path, ax: Axes) -> None:
    print("\nfrom nothing; from the basis of friction 0.3, depth 0.02 m")
    solves = []
    for kind, values in ("friction", FRICTIONS), ("depth", DEPTHS):
        for value in values:
            pair = [rondo.open(folder / f"{kind}-{value}{end}") for end in ("", "-again")]
            print(f"{kind} {value:>5}: {count(pair[0])}, {1e3 * pair[0].info['loop_wall_s']:.0f} ms; "
                  f"{count(pair[1])}, {1e3 * pair[1].info['loop_wall_s']:.0f} ms")
            if kind == "friction":
                solves.append([run.info["solves"] for run in pair])
    for column, look, label in zip(np.array(solves).T, style.CURVES,
                                   ("from nothing", "from the basis of friction 0.3")):
        ax.plot([float(value) for value in FRICTIONS], column, marker="o", ms=3.5, label=label, **look)
    ax.set(xlabel="friction (–)", ylabel="solves of the body (–)", ylim=(-5, 130))
    ax.legend(loc="center right")


def iterations(folder: pathlib.Path, names: list[str]) -> list[float]:
    """NaN where there is no such run."""
    found = [told(folder / name)["iterations"] if (folder / name).exists() else np.nan
             for name in names]
    print(f"{names[0]} ...: {found}")
    return found


def directions(folder: pathlib.Path, path: pathlib.Path) -> None:
    print("\niterations over the search direction, and over the mesh")
    figure, (left, right) = plt.subplots(1, 2, figsize=(style.PAGE, 2.9), sharey=True)
    for (history, title), color in zip(HISTORIES.items(), (style.BLUE, style.VERMILLION)):
        for (solver, name), line in zip(BY_LATIN.items(), ("-", "--", ":")):
            look = {"color": color, "linestyle": line, "marker": "o", "ms": 3.0}
            left.loglog([float(factor) for factor in FACTORS],
                        iterations(folder, [f"{history}-{solver}-k{f}" for f in FACTORS]),
                        label=f"{name}, {title}", **look)
            right.loglog([float(mesh.split("x")[1]) for mesh in MESHES],
                         iterations(folder, [f"mesh-{history}-{solver}-{mesh}" for mesh in MESHES]),
                         **look)
    left.set(xlabel="search direction over the chosen one (–)", ylabel="iterations (–)",
             yticks=[10, 20, 50, 100, 200], yticklabels=["10", "20", "50", "100", "200"])
    right.set(xlabel="columns of the mesh (–)", xticks=[90, 180, 360, 720],
              xticklabels=["90", "180", "360", "720"])
    for ax in left, right:
        ax.minorticks_off()
    figure.legend(*left.get_legend_handles_labels(), loc="upper center", ncols=2)
    figure.get_layout_engine().set(rect=(0, 0, 1, 0.8))
    style.save(figure, path)


def main(folder: pathlib.Path, out: pathlib.Path) -> None:
    with style.paper():
        modes(folder, out / "latin-modes")
        cost(folder, out / "latin-cost")
        directions(folder, out / "latin-directions")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))

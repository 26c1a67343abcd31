#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""How many modes rolling needs: eigenmodes against the POD of runs, of steady states and of a crush, at random
points against steady rolling and against full runs.

    bench/reduced_modes.py [--mesh 12x180] [--points 24] [--numbers 3,20] [--run "--reduced-step 1e-4"]
        [--figure FILE.png] [--folder DIR] [--program FILE]

The points are those of reduced_random.py. The POD of runs has its corners: friction 0.1 and 0.6, heights 0.285
and 0.295 m, rim speeds 0.97 and 1.03 of 10 m/s. Steady states are those of cases/studies/reduced-steady.toml, the
crush is one of rolling-flat to 0.28 m. Prints a table in Markdown, in % of F_y: largest and median error of the
mean F_x and F_y against the steady state of the same mesh (32 places of a sector, contact nodes without mass); and
while rolling-flat lands, 6 to 60 ms, rms errors of F_x and F_y as means over 2.1 ms, against the full run."""
import argparse
import itertools
import json
import pathlib
import tempfile

import numpy as np

import reduced_windows
from reduced_random import CASE, ROOT, inside, means, rondo, settings

BASES = {"eigenmodes": "no runs", "POD of runs": "8 runs in time", "POD of states": "80 steady states",
         "POD of a crush": "a quasi-static crush"}
STEADY = ROOT / "cases" / "steady-rolling.toml"


def with_mesh(mesh):
    radial, columns = mesh.split("x")
    return ["--set", f"disk.mesh.radial={radial}", "--set", f"disk.mesh.circumferential={columns}"]


def teach(options, folder):
    """The results from which each POD is made."""
    runs = []
    for point in itertools.product((0.1, 0.6), (0.285, 0.295), (10.0,), (0.97, 1.03)):
        runs.append(folder / "-".join(f"{x:g}" for x in point))
        rondo(options.program, "run", CASE, "-o", runs[-1], "--overwrite", *settings(point, options.mesh), "--set",
              "output.snapshots=200")
    states, crush = folder / "states", folder / "crush"
    rondo(options.program, "sweep", ROOT / "cases/studies/reduced-steady.toml", "-o", states, "--overwrite",
          *with_mesh(options.mesh))
    rondo(options.program, "run", CASE, "-o", crush, "--overwrite", *with_mesh(options.mesh), "--set",
          'analysis.kind="crush"', "--set", "analysis.depth=0.02", "--set", "analysis.increments=40", "--set", "motion.height=0.3", "--set",
          "output.stress=false")
    return {"POD of runs": runs, "POD of states": [states], "POD of a crush": [crush]}


def steady_forces(options, folder, point):
    friction, height, speed, spin = point
    out = folder / "steady"
    rondo(options.program, "run", STEADY, "-o", out, "--overwrite", *with_mesh(options.mesh), "--set",
          f"ground.friction={friction!r}", "--set", f"motion.height={height!r}", "--set", f"motion.speed={speed!r}",
          "--set", f"motion.angular_velocity={speed / 0.3 * spin!r}", "--set", "analysis.samples_per_sector=32",
          "--set", "analysis.massless_contact=true")
    found = json.loads((out / "run.json").read_text())["steady"]
    return found["force_x"], found["force_y"]


def landing(options, folder, *more):
    """(n, 2) means of F_x and F_y over windows of 2.1 ms while the wheel of rolling-flat is pressed down."""
    words = with_mesh(options.mesh)[1::2]
    run = reduced_windows.forces(folder / "landing", "rolling-flat", words, *more)
    return reduced_windows.windows(run, np.arange(0.006, 0.06, reduced_windows.WINDOW))


def errors_of(options, folder, basis, runs, wanted, points, references, landed):
    wheel = folder / "wheel.h5"
    pod = ["--basis", "pod", *runs] if runs else [CASE, *with_mesh(options.mesh)]
    told = json.loads(rondo(options.program, "reduce", *pod, "--modes", wanted, "-o", wheel, "--json").stdout)
    errors = []
    for point, (fx, fy) in zip(points, references):
        out = folder / "reduced"
        rondo(options.program, "run", CASE, "-o", out, "--overwrite", "--reduced", wheel,
              *settings(point, options.mesh), "--set", "output.snapshots=0", *options.run.split())
        x, y, _ = means(out)
        errors.append((100 * abs(x - fx) / fy, 100 * abs(y - fy) / fy))
    result = told["result"]
    found = {"basis": basis, "modes": result["modes"], "energy_left": result["energy_left"]}
    for k, name in enumerate(("x", "y")):
        ordered = sorted(error[k] for error in errors)
        found[name] = ordered[-1], ordered[len(ordered) // 2]
    lands = landing(options, folder, "--reduced", wheel, *options.run.split())
    found["landing"] = 100 * np.sqrt(((lands - landed) ** 2).mean(axis=0)) / landed[-1, 1]
    left = f"{found['energy_left']:.1e}" if runs else ""
    print(f"| {basis} | {found['modes']} | {left} | {found['x'][0]:.2f}, {found['x'][1]:.2f} | "
          f"{found['y'][0]:.3f}, {found['y'][1]:.3f} | "
          f"{found['landing'][0]:.2f}, {found['landing'][1]:.2f} |", flush=True)
    return found


def draw(rows, file):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, (force, time, energy) = pyplot.subplots(1, 3, figsize=(12.0, 3.8), layout="constrained")
    for basis, marker in zip(BASES, "osD^"):
        own = [row for row in rows if row["basis"] == basis]
        modes = [max(row["modes"], 0.5) for row in own]  # 0 modes on an axis of logarithms
        style = {"marker": marker, "markersize": 4}
        line, = force.loglog(modes, [row["x"][0] for row in own], label=f"{basis} ({BASES[basis]})", **style)
        style["color"] = line.get_color()
        force.loglog(modes, [row["y"][0] for row in own], linestyle=":", **style)
        time.loglog(modes, [row["landing"][0] for row in own], **style)
        time.loglog(modes, [row["landing"][1] for row in own], linestyle=":", **style)
        if basis != "eigenmodes":
            energy.loglog(modes, [row["energy_left"] for row in own], label=basis, **style)
    force.set(xlabel="modes (0 at 0.5)", ylabel="largest error of the means, % of $F_y$",
              title="steady rolling: $F_x$ solid, $F_y$ dotted")
    time.set(xlabel="modes (0 at 0.5)", ylabel="rms over windows of 2.1 ms, % of $F_y$", title="landing")
    energy.set(xlabel="modes", ylabel="share outside the modes", title="energy of the snapshots")
    for axes in (force, time, energy):
        axes.grid(True, which="both", alpha=0.3)
    energy.legend(*force.get_legend_handles_labels(), loc="lower left", fontsize=8)
    figure.savefig(file, dpi=130)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--mesh", default="12x180")
    parser.add_argument("--points", type=int, default=24)
    parser.add_argument("--numbers", default="0,1,3,5,7,11,20,41,90", help="of modes")
    parser.add_argument("--run", default="", help="options of the reduced runs")
    parser.add_argument("--figure", type=pathlib.Path)
    parser.add_argument("--folder", type=pathlib.Path, help="keeps all runs there")
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/release/rondo")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.folder or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        runs = {"eigenmodes": [], **teach(options, folder)}
        points = inside(options.points, 1)
        references = [steady_forces(options, folder, point) for point in points]
        reduced_windows.PROGRAM = options.program
        landed = landing(options, folder)
        print("| basis | modes | energy left out | F_x: largest, median | F_y | landing: F_x, F_y |\n|---|---|---|---|---|---|")
        rows = [errors_of(options, folder, basis, of, wanted, points, references, landed)
                for basis, of in runs.items() for wanted in options.numbers.split(",") if not of or wanted != "0"]
    if options.figure:
        draw(rows, options.figure)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""Reduced runs of the rolling disk against the full ones on several meshes: errors on runs held out, and
where the speed-up comes from.

    /usr/bin/python3 bench/reduced.py [--meshes 12x180,24x360,48x720] [--modes 30] [--contact nodes]
        [--contact-weight 10] [--frame rectified] [--factor F] [--folder DIR] [--program build/release/rondo]

Prints tables in Markdown. Six runs teach: friction 0 and 0.6, heights 0.285 and 0.295 m, speeds 8 and
12 m/s. Errors of both forces are means over the last quarter, over the mean vertical force. Times are
the loops' on one thread without snapshots, the least of three. The speed-up is a product: fewer steps,
steps of fewer unknowns (both off the ground), and what contact makes of it."""
import argparse
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
CASE = ROOT / "cases" / "rolling-flat.toml"


def friction(value):
    return [f"ground.friction={value}"]


def height(value):
    return [f"motion.height=[[0.0, 0.31], [0.02, {value}]]"]


def speed(value):
    return [f"motion.speed={value}", f"motion.angular_velocity={value / 0.3!r}"]


TEACH = {"friction": [friction(0), friction(0.6)], "height": [height(0.285), height(0.295)],
         "speed": [speed(8), speed(12)]}
HELD_OUT = {"μ = 0.3, 0.29 m, 10 m/s": friction(0.3), "μ = 0.15": friction(0.15),
            "0.2875 m": height(0.2875), "9 m/s": speed(9)}
PREDICTED = {"friction": ["μ = 0.3, 0.29 m, 10 m/s", "μ = 0.15"],
             "height": ["μ = 0.3, 0.29 m, 10 m/s", "0.2875 m"],
             "speed": ["μ = 0.3, 0.29 m, 10 m/s", "9 m/s"], "all six": list(HELD_OUT)}
OFF_GROUND = ["motion.height=0.4"]


class Bench:
    def __init__(self, options, mesh, folder):
        self.options, self.folder = options, folder
        self.radial, self.columns = (int(n) for n in mesh.split("x"))
        self.mesh = [f"disk.mesh.radial={self.radial}",
                     f"disk.mesh.circumferential={self.columns}", "output.stress=false"]
        # A place in 2.5 steps.
        self.factor = options.factor or round(20 * self.columns / 180)

    def rondo(self, *words):
        done = subprocess.run([str(self.options.program), *map(str, words), "--quiet"],
                              capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(done.stderr)
        return done.stdout

    def run(self, name, settings, *words):
        out = self.folder / name
        given = [x for s in [*self.mesh, *settings] for x in ("--set", s)]
        self.rondo("run", CASE, "-o", out, "--overwrite", "--threads", 1, *words, *given)
        return out

    def model(self, name, runs):
        file = self.folder / f"{name}.h5".replace(" ", "-")
        self.rondo("reduce", *runs, "-o", file, "--displacement-modes", self.options.modes,
                   "--velocity-modes", self.options.modes, "--frame", self.options.frame,
                   "--contact-weight", self.options.contact_weight,
                   *(["--contact", self.options.contact] if self.options.contact else []))
        return file

    def reduced(self, name, settings, model):
        return self.run(name, [*settings, "output.snapshots=0"], "--reduced", model,
                        "--step-factor", self.factor, "--reduced-step", self.options.reduced_step)

    def least(self, name, settings, model=None, times=3):
        """Steps, and the least seconds of the loop."""
        best = None
        for _ in range(times):
            out = self.reduced(name, settings, model) if model else \
                self.run(name, [*settings, "output.snapshots=0"])
            j = json.loads((out / "run.json").read_text())
            seconds = j["reduced"]["step_wall_s"] if model else j["loop_wall_s"]
            best = min(best or seconds, seconds)
        return j["steps"], best


def forces(directory):
    """Means over the last quarter: F_x, F_y."""
    with open(directory / "history.csv") as file:
        rows = csv.reader(line for line in file if not line.startswith("#"))
        names = [name.split(" ")[0] for name in next(rows)]
        table = [[float(x) for x in row] for row in rows]
    x, y, t = (names.index(n) for n in ("force_x", "force_y", "time_s"))
    late = [row for row in table if row[t] > 0.75 * table[-1][t]]
    return [sum(row[k] for row in late) / len(late) for k in (x, y)]


def errors(bench):
    teach = {name: [bench.run(f"{name}{k}", settings) for k, settings in enumerate(both)]
             for name, both in TEACH.items()}
    teach["all six"] = [run for both in teach.values() for run in both]
    held_out = {name: forces(bench.run("full", [*settings, "output.snapshots=0"]))
                for name, settings in HELD_OUT.items()}
    for name, runs in teach.items():
        model = bench.model(name, runs)
        for run in PREDICTED[name]:
            (fx, fy), (x, y) = held_out[run], forces(bench.reduced("reduced", HELD_OUT[run], model))
            print(f"| {bench.radial}×{bench.columns} | {name} | {run} | {100 * (y / fy - 1):.2f} % | "
                  f"{100 * (x - fx) / fy:.2f} % |", flush=True)
    return model


def times(bench, model):
    n_full, full = bench.least("full", friction(0.3), times=1 if bench.columns > 400 else 3)
    _, full_free = bench.least("full", OFF_GROUND, times=1 if bench.columns > 400 else 3)
    n, reduced = bench.least("reduced", friction(0.3), model)
    _, free = bench.least("reduced", OFF_GROUND, model)
    step, size = n_full / n, full_free / n_full / (free / n)
    return (f"| {bench.radial}×{bench.columns} | {2 * bench.radial * bench.columns:,} | {full:.3g} s "
            f"| {bench.factor} | {reduced:.3g} s | {0.2 / reduced:.3g} | {full / reduced:.3g} | "
            f"{step:.3g} | {size:.2g} | {full / reduced / step / size:.2g} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--meshes", default="12x180,24x360,48x720")
    parser.add_argument("--modes", type=int, default=30)
    parser.add_argument("--contact", help="what suits the frame if left out")
    parser.add_argument("--contact-weight", type=float, default=10.0)
    parser.add_argument("--frame", default="rectified")
    parser.add_argument("--reduced-step", default="midpoint")
    parser.add_argument("--factor", type=float)
    parser.add_argument("--folder", type=pathlib.Path, help="keeps all runs there")
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/release/rondo")
    options = parser.parse_args()
    print("| mesh | built from | predicted | F_y error | F_x error, of F_y |\n|---|---|---|---|---|")
    lines = []
    for mesh in options.meshes.split(","):
        with tempfile.TemporaryDirectory() as temporary:
            folder = options.folder / mesh if options.folder else pathlib.Path(temporary)
            bench = Bench(options, mesh, folder)
            lines.append(times(bench, errors(bench)))
    print("\n| mesh | dofs | full | factor | reduced | real time | speed-up | = steps × | size × | "
          "contact |\n|---|---|---|---|---|---|---|---|---|---|")
    print("\n".join(lines))


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""Reduced wheels at random points against full runs: errors, nodes in contact, and what --estimate says.

    /usr/bin/python3 bench/reduced_random.py [--meshes 12x180,6x90] [--points 12] [--seed 1]
        [--run "--modes 20"] [--folder DIR] [--program FILE]

The points are drawn evenly from friction 0.1 to 0.6, height 0.285 to 0.295 m, speed 8 to 12 m/s and rim
speed 0.97 to 1.03 of it. Errors are those of the means over the last quarter, over the mean vertical
force. With --folder the full runs are kept and used again. Prints a row for each point, and a summary."""
import argparse
import concurrent.futures
import csv
import json
import pathlib
import random
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
CASE = ROOT / "cases" / "rolling-flat.toml"
RANGES = {"friction": (0.1, 0.6), "height": (0.285, 0.295), "speed": (8.0, 12.0), "spin": (0.97, 1.03)}


def settings(point, mesh):
    friction, height, speed, spin = point
    radial, columns = mesh.split("x")
    given = [f"ground.friction={friction!r}", f"motion.height=[[0.0, 0.31], [0.02, {height!r}]]",
             f"motion.speed={speed!r}", f"motion.angular_velocity={speed / 0.3 * spin!r}",
             f"disk.mesh.radial={radial}", f"disk.mesh.circumferential={columns}", "output.stress=false"]
    return [word for one in given for word in ("--set", one)]


def inside(count, seed):
    chance = random.Random(seed)
    return [tuple(round(chance.uniform(*ends), 6) for ends in RANGES.values()) for _ in range(count)]


def rondo(program, *words):
    done = subprocess.run([str(program), *map(str, words), "--quiet"], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return done


def means(directory):
    """Over the last quarter: F_x, F_y, nodes in contact."""
    with open(directory / "history.csv") as file:
        rows = csv.reader(line for line in file if not line.startswith("#"))
        names = [name.split(" ")[0] for name in next(rows)]
        table = [[float(x) for x in row] for row in rows]
    t = names.index("time_s")
    late = [row for row in table if row[t] > 0.75 * table[-1][t]]
    return [sum(row[names.index(n)] for row in late) / len(late)
            for n in ("force_x", "force_y", "contact_nodes")]


def full_runs(options, mesh, folder, points, words):
    def run(point):
        out = folder / "-".join(f"{x:g}" for x in point)
        told = out / "run.json"
        if not told.exists() or json.loads(told.read_text())["status"] != "done":
            rondo(options.program, "run", CASE, "-o", out, "--overwrite", "--threads", 1,
                  *settings(point, mesh), *words)
        return out
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        return list(pool.map(run, points))


def predict(options, mesh, folder):
    points = inside(options.points, options.seed)
    held = full_runs(options, mesh, folder, points, ["--set", "output.snapshots=0"])
    found = []
    for point, full in zip(points, held):
        out = folder / "reduced"
        rondo(options.program, "run", CASE, "-o", out, "--overwrite", "--reduced", "case", "--estimate",
              *settings(point, mesh), "--set", "output.snapshots=0", *options.run.split())
        (fx, fy, nodes), (x, y, _) = means(full), means(out)
        estimate = json.loads((out / "run.json").read_text())["wheel_estimate"]
        found.append((100 * (x - fx) / fy, 100 * (y - fy) / fy, estimate))
        print(f"| {mesh} | {point[0]:.3f} | {point[1]:.4f} | {point[2]:.2f} | {point[3]:.3f} | {nodes:.1f} | "
              f"{fx / fy:.3f} | {found[-1][0]:.2f} % | {found[-1][1]:.2f} % |", flush=True)
    return found


def summary(mesh, found):
    def of(name, index):
        errors = sorted(abs(one[index]) for one in found)
        own = [100 * one[2]["force_" + name[-1]] for one in found]
        covered = [sum(abs(one[index]) <= times * bound for one, bound in zip(found, own)) for times in (1, 2)]
        print(f"{mesh}: {name} largest {errors[-1]:.2f} %, median {errors[len(errors) // 2]:.2f} %; "
              f"estimated {min(own):.2f} to {max(own):.2f} %, which covers {covered[0]} of {len(own)}, "
              f"twice it {covered[1]}", flush=True)
    of("F_x", 0)
    of("F_y", 1)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--meshes", default="12x180,6x90")
    parser.add_argument("--points", type=int, default=12)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--run", default="", help="options of the reduced runs")
    parser.add_argument("--folder", type=pathlib.Path, help="keeps all runs there")
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/release/rondo")
    options = parser.parse_args()
    print("| mesh | friction | height, m | speed, m/s | rim speed | nodes in contact | F_x / F_y | F_x error, of F_y "
          "| F_y error |\n|---|---|---|---|---|---|---|---|---|")
    summaries = []
    for mesh in options.meshes.split(","):
        with tempfile.TemporaryDirectory() as temporary:
            folder = options.folder / mesh if options.folder else pathlib.Path(temporary)
            folder.mkdir(parents=True, exist_ok=True)
            summaries.append((mesh, predict(options, mesh, folder)))
    for one in summaries:
        summary(*one)


if __name__ == "__main__":
    main()

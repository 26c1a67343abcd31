# SPDX-License-Identifier: BSD-3-Clause
"""Steady rolling: time of a point, of a carpet, of a fine mesh from nothing, and of a traction curve
against transients of the same slips.

    /usr/bin/python3 bench/steady.py [--points 1000] [--program build/release/rondo]

Prints tables in Markdown. One core but for the harmonics of the fine meshes, which take all."""
import argparse
import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
CASE = ROOT / "cases" / "steady-rolling.toml"
SLIPS = 21
SPEEDS = f"""[[vary]]
key = "motion.speed"
linspace = [9.4, 10.6, {SLIPS}]
"""


def timed(command):
    begin = time.perf_counter()
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return time.perf_counter() - begin


def sweep(program, folder, study, name):
    """Seconds of the whole command, and of its members."""
    path = folder / f"{name}.toml"
    path.write_text("schema = 1\n" + study)
    seconds = timed([program, "sweep", path, "--quiet", "--jobs", 1, "-o", folder / name])
    with open(folder / name / "timings.csv", newline="") as file:
        return seconds, [float(row["wall_s"]) for row in csv.DictReader(file)]


def carpet(program, folder, points):
    study = f"""base = "{CASE}"
[[vary]]
key = "motion.speed"
linspace = [9.4, 10.6, {points // 20}]
[[vary]]
key = "motion.height"
linspace = [0.289, 0.297, 20]
"""
    seconds, members = sweep(program, folder, study, "carpet")
    print(f"12×180, 8 places, {len(members)} points: {seconds:.2f} s; a point {1e3 * sorted(members)[len(members) // 2]:.2f} ms "
          "(median)\n")


def curve(program, folder):
    transient = folder / "transient.toml"
    text = CASE.read_text().replace('kind = "steady-rolling"', 'kind = "dynamic"')
    text = text.replace("height = 0.29\n", "height = [[0.0, 0.3], [0.02, 0.29]]\n")
    transient.write_text(text + '\n[time]\nend = 0.12\n\n[initial]\nstate = "stationary"\n')
    steady, _ = sweep(program, folder, f'base = "{CASE}"\n' + SPEEDS, "steady")
    window = "[window]\nfrom = 0.095\nto = 0.12\n"
    moving, _ = sweep(program, folder, f'base = "{transient}"\n' + window + SPEEDS, "moving")
    print(f"traction curve of {SLIPS} slips, 12×180: steady {steady:.3f} s, transients of 0.12 s {moving:.2f} s: "
          f"{moving / steady:.0f} times\n")


def fine(program, folder):
    print("| mesh | places | harmonics (ms) | contact (ms) | whole command (s) |\n|---|---|---|---|---|")
    for radial, columns, places in ((12, 180, 1), (12, 180, 8), (24, 720, 1), (24, 720, 8),
                                    (48, 3600, 1), (48, 3600, 2), (48, 3600, 4)):
        out = folder / f"fine-{radial}-{places}"
        settings = (f"disk.mesh.radial={radial}", f"disk.mesh.circumferential={columns}",
                    f"analysis.samples_per_sector={places}", "output.snapshots=0")
        seconds = timed([program, "run", CASE, "--quiet", "-o", out,
                         *(word for setting in settings for word in ("--set", setting))])
        run = json.loads((out / "run.json").read_text())
        print(f"| {radial}×{columns} | {places} | {1e3 * run['harmonics_wall_s']:.2f} | "
              f"{1e3 * run['solve_wall_s']:.1f} | {seconds:.2f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--points", type=int, default=1000)
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/release/rondo")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        carpet(options.program, folder, options.points)
        curve(options.program, folder)
        fine(options.program, folder)


if __name__ == "__main__":
    main()

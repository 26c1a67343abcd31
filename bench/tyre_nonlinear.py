#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What nonlinear forces change in states of a tyre.

    bench/tyre_nonlinear.py [--program FILE] [--only depth|explicit|static|cornering] [--results FOLDER]

Prints the tables of docs/tyre.md, sections 5 and 6. Of the coarse tyre of tests/meshes: load over depth without friction,
in brackets the values of an independent calculation; and steady rolling at 1 degree beside steps in time. Of the tyre of the
cases, by cases/studies/tyre-deflection.toml and tyre-cornering-stiffness.toml: load over depth at three pressures, the
footprint over the load, and the cornering stiffness over the load. Half an hour; studies that are in FOLDER are read."""
import argparse
import csv
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

from tyre_rolling import ROOT, run

LOAD = {("all", 2): 259.847, ("all", 5): 811.286, ("all", 10): 1800.09, ("all", 15): 2860.90, ("all", 20): 3952.08,
        ("cords", 5): 821.28, ("cords", 10): 1860.33, ("cords", 15): 3041.32, ("cords", 20): 4294.33,
        ("none", 2): 270.85, ("none", 5): 891.01, ("none", 10): 2108.44, ("none", 15): 3598.24, ("none", 20): 5372.35}
SPIN, RADIUS, SECTORS = 33.0, 0.316022, 60  # rad/s; m, of the contact nodes of the tyre inflated at this spin
COLUMNS = ("force_y", "force_lateral", "moment_aligning")


def solved(program, folder, text, nonlinear):
    """run.json, or None where there is no state."""
    words = ["--set", f"inflation.nonlinear={nonlinear}"]
    return json.loads((folder / "run" / "run.json").read_text()) if run(program, text, folder, words, "run") else None


def over_depth(program, folder):
    from test_tyre_steady_nonlinear import RADIUS as at_rest
    from test_tyre_steady_nonlinear import rolling
    print("| depth mm | linear N | cords and air nonlinear N | all nonlinear N | problems of contact |\n" + 5 * "|---" + "|")
    for depth in (2, 5, 10, 15, 20, 25, 30, 35):
        cells = []
        for nonlinear in ("none", "cords", "all"):
            found = solved(program, folder, rolling(at_rest - 1e-3 * depth, more="speed = 3.1e-4"), nonlinear)
            other = LOAD.get((nonlinear, depth))
            cells.append(("–" if found is None else f"{found['steady']['force_y']:,.1f}")
                         + (f" ({other:,.1f})" if other else ""))
        print(f"| {depth} | " + " | ".join(cells)
              + f" | {found['steady']['contact_problems'] if found else '–'} |", flush=True)


def beside_steps(program, folder):
    from test_tyre_nonlinear import COARSE
    base = COARSE.replace("sectors = 90", f"sectors = {SECTORS}") + f"""
[damping]
mass = 150.0
stiffness = 1.5e-6
[ground]
profile = "flat"
friction = 0.9
[motion]
angular_velocity = {SPIN}
speed = {SPIN * 0.3122}
slip_angle = {3.141592653589793 / 180}
"""
    steady = base + f"""height = {RADIUS - 0.01}
[analysis]
kind = "steady-rolling"
samples_per_sector = 8
accept_scheme_power = true
"""
    steps = base + f"""height = [[0.0, {RADIUS + 1e-4}], [0.02, {RADIUS - 0.01}]]
[time]
end = 0.16
[output]
snapshots = 0
history_interval = 1e-4
"""
    print("| nonlinear | | load N | lateral N | aligning N m |\n" + 5 * "|---" + "|")
    for nonlinear in ("none", "all"):
        state = solved(program, folder, steady, nonlinear)["steady"]
        print(f"| {nonlinear} | steady | " + " | ".join(f"{state[name]:,.1f}" for name in COLUMNS) + " |")
        solved(program, folder, steps, nonlinear)
        with open(folder / "run" / "history.csv", newline="") as file:
            rows = [row for row in csv.DictReader(file) if float(row["time_s"]) > 0.13]
        means = [sum(float(row[name]) for row in rows) / len(rows) for name in COLUMNS]
        print(f"| {nonlinear} | steps in time | " + " | ".join(f"{mean:,.1f}" for mean in means) + " |", flush=True)


def study(program, name, folder):
    """Directories of the members and what varies in each."""
    results = folder / name
    subprocess.run([program, "sweep", ROOT / "cases" / "studies" / f"{name}.toml", "-o", results, "--quiet",
                    *(["--resume"] if results.exists() else [])], check=True)
    with open(results / "results.csv", newline="") as file:
        return [(results / "runs" / f"{int(row['run']):04}", row) for row in csv.DictReader(file)]


def columns_of(path):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: [float(row[name]) for row in rows] for name in rows[0]}


def depth_at(history, load):
    """mm, None: the load was not reached."""
    return next((f"{1e3 * depth:.2f}" for depth, force in zip(history["depth_m"], history["force_y"], strict=True)
                 if abs(force - load) < 1e-6 * load), "–")


def length_beside(nodes, low, high):
    """Of the contact between two distances from the middle plane: mean of both sides, mm."""
    sides = [[x for x, z in nodes if low <= side * z <= high] for side in (-1, 1)]
    return 500.0 * sum(max(side) - min(side) for side in sides if side)


def static(program, folder):
    members = study(program, "tyre-deflection", folder)
    histories = {(row["inflation.nonlinear"], round(float(row["inflation.pressure"]) / 1e3)): columns_of(path / "history.csv")
                 for path, row in members}
    pressures = sorted({pressure for _, pressure in histories})
    print("| load N | " + " | ".join(f"{pressure} kPa, linear and nonlinear mm" for pressure in pressures) + " |\n"
          + (1 + len(pressures)) * "|---" + "|")
    for load in range(1000, 8001, 1000):
        print(f"| {load:,} | " + " | ".join(
            f"{depth_at(histories['none', pressure], load)}, {depth_at(histories['all', pressure], load)}"
            for pressure in pressures) + " |")
    print("\n| load N | length in the middle mm | near the shoulders mm | width mm | area cm² | largest pressure kPa |\n"
          + 6 * "|---" + "|")
    path = next(path for path, row in members
                if row["inflation.nonlinear"] == "all" and round(float(row["inflation.pressure"]) / 1e3) == 220)
    history, contact = histories["all", 220], columns_of(path / "contact.csv")
    for load in range(1000, 8001, 1000):
        row = min(range(len(history["time_s"])), key=lambda k, load=load: abs(history["force_y"][k] - load))
        now = [(x, z) for x, z, time in zip(contact["x_m"], contact["z_m"], contact["time_s"], strict=True)
               if time == history["time_s"][row]]
        half = max(abs(z) for _, z in now)
        print(f"| {load:,} | {length_beside(now, 0.0, 0.01):.0f} | {length_beside(now, 0.8 * half, half):.0f}"
              f" | {2e3 * half:.0f} | {1e4 * history['contact_area_m2'][row]:.0f}"
              f" | {1e-3 * history['pressure_max_pa'][row]:.0f} |")


def cornering(program, folder):
    found = {}
    for _, row in study(program, "tyre-cornering-stiffness", folder):
        found[row["inflation.nonlinear"], round(float(row["analysis.load"]))] = float(row["cornering_stiffness"] or "nan")
    print("| load N | linear N/° | nonlinear N/° |\n" + 3 * "|---" + "|")
    for load in sorted({load for _, load in found}):
        print(f"| {load:,} | " + " | ".join(f"{math.radians(found[kind, load]):.0f}" for kind in ("none", "all")) + " |")


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--program", type=pathlib.Path, default=ROOT / "build" / "release" / "rondo")
    arguments.add_argument("--only", choices=("depth", "explicit", "static", "cornering"))
    arguments.add_argument("--results", type=pathlib.Path)
    arguments = arguments.parse_args()
    program = arguments.program.resolve()
    os.environ["RONDO"] = str(program)
    sys.path.insert(0, str(ROOT / "tests" / "cli"))
    with tempfile.TemporaryDirectory() as name:
        folder = arguments.results.resolve() if arguments.results else pathlib.Path(name)
        tables = {"depth": over_depth, "explicit": beside_steps, "static": static, "cornering": cornering}
        for only in [arguments.only] if arguments.only else tables:
            tables[only](program, folder)


if __name__ == "__main__":
    main()

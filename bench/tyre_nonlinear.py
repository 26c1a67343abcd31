#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What nonlinear forces change in steady states of a tyre.

    bench/tyre_nonlinear.py [--program FILE] [--only depth|explicit]

The tyre is the coarse one of tests/meshes. Prints the tables of docs/tyre.md, Steady rolling with nonlinear forces:
load over depth without friction, in brackets the values of an independent calculation; and steady rolling at 1 degree
beside steps in time. Some minutes."""
import argparse
import csv
import json
import os
import pathlib
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


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--program", type=pathlib.Path, default=ROOT / "build" / "release" / "rondo")
    arguments.add_argument("--only", choices=("depth", "explicit"))
    arguments = arguments.parse_args()
    program = arguments.program.resolve()
    os.environ["RONDO"] = str(program)
    sys.path.insert(0, str(ROOT / "tests" / "cli"))
    with tempfile.TemporaryDirectory() as name:
        if arguments.only != "explicit":
            over_depth(program, pathlib.Path(name))
        if arguments.only != "depth":
            beside_steps(program, pathlib.Path(name))


if __name__ == "__main__":
    main()

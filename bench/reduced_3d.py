#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Times of a step of reduced wheels in three dimensions, by the nodes that the ground presses.

    bench/reduced_3d.py [RUNS] [--program RONDO ...]

Of each case the least of several runs: ms a step, and times real time (its length over the time that
it takes; writing of results is left out). Several programs take turns, so that they meet the machine
in the same state.
"""
import argparse
import json
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
BOX = ("wheel3d-cornering",)


def box(radial, axial, around, *settings):
    return ("wheel3d-cornering", f"disk.mesh.radial={radial}", f"disk.mesh.axial={axial}",
            f"disk.mesh.circumferential={around}", *settings)


CASES = {
    "box 3x4x90": box(3, 4, 90),
    "box 6x8x180": box(6, 8, 180),
    "box 6x8x180, 4 degrees": box(6, 8, 180, "motion.slip_angle=0.06981317"),
    "box 4x11x180": box(4, 11, 180),
    "box 3x13x180": box(3, 13, 180),
    "box 3x15x180": box(3, 15, 180),
    "box 3x15x180, frictionless": box(3, 15, 180, "ground.friction=0.0"),
    "tyre 205/55 R16": ("tyre-rolling", "time.end=0.15"),
}


def step_of(program, name, settings, out):
    """Seconds a step, length of a step, most contacts and sweeps of one run."""
    command = [program, "run", ROOT / "cases" / f"{name}.toml", "--reduced", "-o", out, "--overwrite",
               "--quiet", "--threads", "1"]
    for setting in (*settings, "output.history_interval=0.05", "output.snapshots=2"):
        command += ["--set", setting]
    subprocess.run([str(x) for x in command], check=True, stderr=subprocess.DEVNULL)
    run = json.loads((pathlib.Path(out) / "run.json").read_text())
    wheel = run["wheel"]
    seconds = wheel["step_wall_s"] / run["steps"]
    return (seconds, seconds * wheel["realtime_factor"], wheel["contacts_max"],
            wheel["contact_iterations_mean"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("runs", nargs="?", type=int, default=5)
    parser.add_argument("--program", nargs="+", default=[ROOT / "build" / "release" / "rondo"])
    args = parser.parse_args()
    print("| wheel | nodes in contact | sweeps | step | ms a step | times real time |\n|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for title, (name, *settings) in CASES.items():
            runs = [[step_of(p, name, settings, folder) for p in args.program] for _ in range(args.runs)]
            for taken in zip(*runs):
                seconds, length, contacts, sweeps = min(taken)
                print(f"| {title} | {contacts} | {sweeps:.0f} | {1e3 * length:.2f} ms | {1e3 * seconds:.3f} "
                      f"| {length / seconds:.1f} |", flush=True)


if __name__ == "__main__":
    main()

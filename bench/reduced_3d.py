#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Times of a step of reduced wheels in three dimensions, by the nodes that the ground presses.

    bench/reduced_3d.py [RUNS] [--program RONDO ...] [--figure docs/figures/reduced3d-times.png]

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
LOADS = (1000, 2000, 3000, 4000, 5000, 6000)  # N on the axle of the tyre, at steps of 0.6 ms


def step_of(program, name, settings, out, *options):
    """Seconds a step, length of a step, most contacts and sweeps of one run."""
    command = [program, "run", ROOT / "cases" / f"{name}.toml", "--reduced", "-o", out, "--overwrite",
               "--quiet", "--threads", "1", *options]
    for setting in (*settings, "output.history_interval=0.05", "output.snapshots=2"):
        command += ["--set", setting]
    subprocess.run([str(x) for x in command], check=True, stderr=subprocess.DEVNULL)
    run = json.loads((pathlib.Path(out) / "run.json").read_text())
    wheel = run["wheel"]
    seconds = wheel["step_wall_s"] / run["steps"]
    return (seconds, seconds * wheel["realtime_factor"], wheel["contacts_max"],
            wheel["contact_iterations_mean"])


def of_loads(program, runs, folder):
    """Most contacts, and times real time, of the tyre on its axle."""
    settings = "time.end=0.3", "section.sectors=90"
    taken = [min(step_of(program, "tyre-load", (*settings, f"rim.force_y=[[0, 0], [0.02, {-load}]]"), folder,
                         "--reduced-step", "6e-4") for _ in range(runs)) for load in LOADS]
    return [(contacts, length / seconds) for seconds, length, contacts, _ in taken]


def draw(boxes, tyre, figure):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    plot, axes = plt.subplots(figsize=(7, 4), layout="constrained")
    axes.plot(*zip(*sorted(boxes)), "o", color="black", label="box wheels, steps of 0.4 ms")
    axes.plot(*zip(*tyre), "s-", color="#c8553d", label="tyre 205/55 R16 under 1 to 6 kN, steps of 0.6 ms")
    axes.axhline(1.0, color="grey", linewidth=0.8)
    axes.set_yscale("log")
    axes.set_yticks([0.5, 1, 2, 5, 10], ["0.5", "1", "2", "5", "10"])
    axes.minorticks_off()
    axes.set_xlabel("nodes in contact")
    axes.set_ylabel("times real time, one thread")
    axes.grid(alpha=0.3)
    axes.legend()
    plot.savefig(figure, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("runs", nargs="?", type=int, default=5)
    parser.add_argument("--program", nargs="+", default=[ROOT / "build" / "release" / "rondo"])
    parser.add_argument("--figure", help="picture of the first program, with the tyre under several loads")
    args = parser.parse_args()
    boxes = []
    print("| wheel | nodes in contact | sweeps | step | ms a step | times real time |\n|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for title, (name, *settings) in CASES.items():
            runs = [[step_of(p, name, settings, folder) for p in args.program] for _ in range(args.runs)]
            for taken in zip(*runs):
                seconds, length, contacts, sweeps = min(taken)
                if title.startswith("box") and "frictionless" not in title:
                    boxes.append((contacts, length / seconds))
                print(f"| {title} | {contacts} | {sweeps:.0f} | {1e3 * length:.2f} ms | {1e3 * seconds:.3f} "
                      f"| {length / seconds:.1f} |", flush=True)
        if args.figure:
            draw(boxes, of_loads(args.program[0], args.runs, folder), args.figure)


if __name__ == "__main__":
    main()

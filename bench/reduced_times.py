#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Times of a step of reduced wheels: the least of several runs of each case, µs and times real time.

    bench/reduced_times.py [RUNS]
"""
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
PROGRAM = ROOT / "build" / "release" / "rondo"
CASES = {
    "12x180": ("rolling-flat", "time.end=3"),
    "6x90": ("rolling-flat", "time.end=3", "disk.mesh.radial=6", "disk.mesh.circumferential=90"),
    "24x360": ("rolling-flat", "time.end=3", "disk.mesh.radial=24", "disk.mesh.circumferential=360"),
    "12x180, 31.7 to 35 rad/s": ("rolling-flat", "motion.angular_velocity=[[0,31.7],[0.2,35]]"),
    "tread": ("rolling-treaded",),
    "rim driven by a torque": ("wheel-driven",),
    "rim braked in pulses": ("wheel-abs",),
    "spokes": ("rolling-spokes",),
    "spokes, 31.7 to 35 rad/s": ("rolling-spokes", "time.end=0.05",
                                 "motion.angular_velocity=[[0,31.7],[0.05,35]]"),
    "pitches of three lengths": ("rolling-pitches",),
}


def step_of(name, settings, out):
    """Seconds a step, and times real time, of one run."""
    command = [PROGRAM, "run", ROOT / "cases" / f"{name}.toml", "--reduced", "-o", out, "--overwrite", "--quiet"]
    for setting in (*settings, "output.history_interval=0.01", "output.snapshots=2"):
        command += ["--set", setting]
    subprocess.run([str(x) for x in command], check=True, stderr=subprocess.DEVNULL)
    run = json.loads((pathlib.Path(out) / "run.json").read_text())
    return run["wheel"]["step_wall_s"] / run["steps"], run["wheel"]["realtime_factor"]


def main():
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 8
    with tempfile.TemporaryDirectory() as folder:
        for title, (name, *settings) in CASES.items():
            seconds, factor = min(step_of(name, settings, folder) for _ in range(runs))
            print(f"{title:28s}{1e6 * seconds:7.1f} µs{factor:7.1f} times real time", flush=True)


if __name__ == "__main__":
    main()

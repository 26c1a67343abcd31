#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reduced wheels made of the case against full runs in time: largest and rms differences of the forces,
as means over windows of 2.1 ms (two passes of a sector at 33.3 rad/s), in % of the mean F_y.

    bench/reduced_windows.py [OPTION of rondo run --reduced...]
"""
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[1]
PROGRAM = ROOT / "build" / "release" / "rondo"
WINDOW, LANDED = 0.0021, 0.03  # s
CASES = {
    "spin 31.7 to 35 rad/s": ("rolling-flat", "motion.angular_velocity=[[0,31.7],[0.2,35]]", "time.end=0.2"),
    "braked to 10 rad/s": ("rolling-flat", "motion.angular_velocity=[[0.05,33.3],[0.15,10]]", "time.end=0.2"),
    "driven by a torque": ("wheel-driven",),
    "braked in pulses": ("wheel-abs",),
    "braked over ice": ("wheel-mu-jump",),
    "on spokes": ("rolling-spokes",),
    "pitches of three lengths": ("rolling-pitches",),
}


def forces(folder, name, settings, *more):
    """Integrals of F_x and F_y over time at the ends of the steps."""
    command = [PROGRAM, "run", ROOT / "cases" / f"{name}.toml", "-o", folder, "--overwrite", "--quiet", *more]
    for setting in (*settings, "output.history_interval=0", "output.snapshots=2"):
        command += ["--set", setting]
    subprocess.run([str(x) for x in command], check=True, stderr=subprocess.DEVNULL)
    with open(folder / "history.csv") as file:
        names = file.readline().strip().split(",")
    columns = [names.index(name) for name in ("time_s", "force_x", "force_y")]
    rows = np.loadtxt(folder / "history.csv", delimiter=",", skiprows=1, usecols=columns)
    steps = np.diff(rows[:, 0], prepend=0.0)[:, None]
    return rows[:, 0], np.cumsum(rows[:, 1:] * steps, axis=0)


def windows(run, edges):
    time, integral = run
    at = np.stack([np.interp(edges, time, integral[:, k]) for k in (0, 1)], axis=1)
    return np.diff(at, axis=0) / WINDOW


def main():
    print("                            F_x: largest   rms    F_y: largest   rms   [% of the mean F_y]")
    with tempfile.TemporaryDirectory() as folder:
        for title, (name, *settings) in CASES.items():
            full = forces(pathlib.Path(folder) / "full", name, settings)
            reduced = forces(pathlib.Path(folder) / "reduced", name, settings, "--reduced", *sys.argv[1:])
            edges = np.arange(LANDED, min(full[0][-1], reduced[0][-1]), WINDOW)
            a, b = windows(full, edges), windows(reduced, edges)
            scale = 100.0 / a[:, 1].mean()
            most, rms = scale * abs(b - a).max(axis=0), scale * np.sqrt(((b - a) ** 2).mean(axis=0))
            print(f"{title:28s}{most[0]:8.2f}{rms[0]:10.2f}{most[1]:11.2f}{rms[1]:9.2f}", flush=True)


if __name__ == "__main__":
    main()

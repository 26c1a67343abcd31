#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reduced wheels of a viscous material, of a loss factor of .15 from 5 to 500 Hz, against steady rolling without
friction and against full runs in time: mean vertical force, torque and loss of the material, and how they differ.
`space` does so for box wheels in three dimensions.

    bench/reduced_loss.py [space] [OPTION of rondo run --reduced...]
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[1]
PROGRAM = ROOT / "build" / "release" / "rondo"
LOSS = ("material.loss_factor=0.15", "material.loss_band=[5,500]")
FREE = ("damping.mass=0", "damping.stiffness=0", "ground.friction=0")
SETTLED = 0.42  # s, of runs to 0.6 s: 7 times of the slowest branch
IN_TIME = {  # case, first time of the means [s], settings
    "rolling-flat": ("rolling-flat", 0.15),
    "its spin from 33.3 to 20 rad/s": ("rolling-flat", 0.05,
                                       "motion.angular_velocity=[[0,33.333],[0.05,33.333],[0.15,20]]"),
    "wheel-driven": ("wheel-driven", 0.2),
    "rolling-treaded": ("rolling-treaded", 0.1, "time.end=0.2"),
    "rolling-spokes": ("rolling-spokes", 0.1, "time.end=0.2"),
}
BOXES = {"3×4×90": (), "6×8×180": ("disk.mesh.radial=6", "disk.mesh.axial=8", "disk.mesh.circumferential=180")}
ROLLS_IN_SPACE = {  # of wheel3d-cornering: first time of the means [s], settings
    "1°": (0.4, "time.end=0.5"),
    "4°": (0.4, "time.end=0.5", "motion.slip_angle=0.0698"),
    "its spin from 33.8 to 20 rad/s": (0.2, "time.end=0.3",
                                       "motion.angular_velocity=[[0,33.76455],[0.1,33.76455],[0.2,20]]"),
}


def run(folder, name, settings, *more):
    command = [PROGRAM, "run", ROOT / "cases" / f"{name}.toml", "-o", folder, "--overwrite", "--quiet", *more]
    for setting in (*LOSS, *settings, "output.snapshots=0"):
        command += ["--set", setting]
    subprocess.run([str(x) for x in command], check=True, stderr=subprocess.DEVNULL)
    return json.loads((folder / "run.json").read_text())


def figures(folder, begin):
    """Means of F_x, F_y and torque, and loss of the material in a second, from a time on."""
    h = np.genfromtxt(folder / "history.csv", delimiter=",", names=True)
    late = h["time_s"] > begin
    return [np.mean(h[name][late]) for name in ("force_x", "force_y", "torque")] + [
        np.polyfit(h["time_s"][late], h["dissipation_viscous"][late], 1)[0]]


def table(rows):
    print(f"{'':32} {'F_x':>9} {'F_y':>8} {'torque':>8} {'loss':>8}   F_x of F_y, F_y, torque, loss off by %")
    for name, (x, y, torque, loss), other in rows:
        print(f"{name:32} {x:9.0f} {y:8.0f} {torque:8.1f} {loss:8.0f}   {100 * (x - other[0]) / other[1]:+.2f} "
              + " ".join(f"{100 * (a / b - 1):+.3f}" for a, b in zip((y, torque, loss), other[1:])), flush=True)


def against_steady(folder, options):
    for speed in (10.0, 20.0, 30.0):
        rolls = (*FREE, f"motion.speed={speed}", f"motion.angular_velocity={speed / 0.3!r}")
        told = run(folder, "steady-rolling", (*rolls, "analysis.samples_per_sector=32",
                                              "analysis.massless_contact=true"))["steady"]
        run(folder, "rolling-flat", (*rolls, "time.end=0.6"), "--reduced", *options)
        yield f"steady at {speed:.0f} m/s", figures(folder, SETTLED), [
            told["force_x"], told["force_y"], told["torque"], told["power"]["viscosity"]]


def against_full(folder, options):
    for name, (case, begin, *settings) in IN_TIME.items():
        run(folder, case, settings)
        full = figures(folder, begin)
        run(folder, case, settings, "--reduced", *options)
        yield name, figures(folder, begin), full


def box_against_steady(folder, options):
    for name, mesh in BOXES.items():
        rolls = (*FREE, *mesh, "motion.slip_angle=0")
        run(folder, "wheel3d-cornering", (*rolls, "time.end=0.6"), "--reduced", *options)
        reduced = figures(folder, 0.45)
        for inertia in ("waves", "all"):
            told = run(folder, "wheel3d-steady", (*rolls, "analysis.samples_per_sector=16",
                                                  "analysis.massless_contact=true",
                                                  f"analysis.inertia=\"{inertia}\""))["steady"]
            yield f"{name}, steady, {inertia}", reduced, [
                told["force_x"], told["force_y"], told["torque"], told["power"]["viscosity"]]


def box_against_full(folder, options):
    for name, (begin, *settings) in ROLLS_IN_SPACE.items():
        settings.append("output.history_interval=0")
        run(folder, "wheel3d-cornering", settings)
        full = figures(folder, begin)
        run(folder, "wheel3d-cornering", settings, "--reduced", *options)
        yield name, figures(folder, begin), full


def main():
    options, tables = sys.argv[1:], (against_steady, against_full)
    if options[:1] == ["space"]:
        options, tables = options[1:], (box_against_steady, box_against_full)
    with tempfile.TemporaryDirectory() as folder:
        for rows in tables:
            table(rows(pathlib.Path(folder) / "run", options))


if __name__ == "__main__":
    main()

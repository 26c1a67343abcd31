#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The lateral force of a rolling tyre: steady rolling over its samples and kinds of inertia, and against the explicit
step.

    bench/tyre_rolling.py [--program FILE]

The tyre is that of tests/meshes/tyre-205-55-r16-coarse.msh, 10 mm deep at 33 rad/s. Prints the tables of docs/steady.md
(The two formulas of the slip) and docs/tyre.md (Steady rolling against the explicit step), in N, in some minutes."""
import argparse
import csv
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
ROWS = ((1.0, 60, 1.5e-6, 0.25), (1.0, 120, 1.5e-6, 0.25), (4.0, 60, 1.5e-6, 0.25), (4.0, 60, 1e-5, 0.12))


def settings(**keys):
    return [word for key, value in keys.items() for word in ("--set", f"{key.replace('__', '.')}={value}")]


def steady(program, rolling, folder, sectors, degrees, samples, slip, **more):
    """None: not solved."""
    height = rolling.RADIUS[sectors] - 0.01
    done = run(program, rolling.STEADY, folder, settings(
        section__sectors=sectors, motion__height=height, motion__speed=0.3122 * rolling.SPIN,
        motion__slip_angle=degrees * rolling.DEGREE, analysis__slip=slip, analysis__samples_per_sector=samples,
        analysis__estimate_slip_error="false", **more))
    return rolling.summary(folder / "run")["steady"]["force_lateral"] if done else None


def explicit(program, moving, folder, sectors, degrees, damping, end):
    """Mean of the last fifth."""
    done = run(program, moving.cornering(sectors, end, degrees), folder, settings(damping__stiffness=damping))
    if not done:
        return None
    with open(folder / "run" / "history.csv", newline="") as file:
        last = [float(row["force_lateral"]) for row in csv.DictReader(file) if float(row["time_s"]) > 0.8 * end]
    return sum(last) / len(last)


def run(program, text, folder, words, command="run"):
    path = folder / "case.toml"
    path.write_text(text)
    done = subprocess.run([program, command, path, "-o", folder / "run", "--overwrite", *words], capture_output=True,
                          text=True)
    return done.returncode == 0


def shown(force):
    return "not solved" if force is None else f"{force:.0f}"


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--program", type=pathlib.Path, default=ROOT / "build" / "release" / "rondo")
    program = arguments.parse_args().program.resolve()
    os.environ["RONDO"] = str(program)
    sys.path.insert(0, str(ROOT / "tests" / "cli"))
    import test_tyre_explicit as moving
    import test_tyre_rolling as rolling
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        print("| inertia, slip | " + " | ".join(map(str, (1, 2, 4, 8, 16))) + " |\n" + 6 * "|---" + "|")
        for inertia, slip in (("none", "upwind"), ("waves", "upwind"), ("waves", "bdf2"), ("all", "upwind")):
            forces = [steady(program, rolling, folder, 60, 1.0, samples, slip, analysis__inertia=inertia)
                      for samples in (1, 2, 4, 8, 16)]
            print(f"| {inertia}, {slip} | " + " | ".join(map(shown, forces)) + " |", flush=True)
        print("\n| slip angle, sectors, damping.stiffness | explicit | bdf2, upwind |\n" + 3 * "|---" + "|")
        for degrees, sectors, damping, end in ROWS:
            forces = [explicit(program, moving, folder, sectors, degrees, damping, end)]
            forces += [steady(program, rolling, folder, sectors, degrees, 8, slip, damping__stiffness=damping)
                       for slip in ("bdf2", "upwind")]
            print(f"| {degrees:.0f}, {sectors}, {damping:g} | {shown(forces[0])} | {shown(forces[1])}, "
                  f"{shown(forces[2])} |", flush=True)


if __name__ == "__main__":
    main()

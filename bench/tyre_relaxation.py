#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Relaxation lengths of a tyre: how the lateral force follows a step of the slip angle over the rolled distance.

    bench/tyre_relaxation.py [--program FILE] [--sectors 60 90] [--loads 2000 3000 4000] [--without explicit]

The tyre of cases/tyre-cornering.toml at 220 kPa, linear about its inflated state. Straight steady rolling under a load, without torque, gives height and speed, which are then held. Each
load takes a step of .25 degrees without steps in time (analysis.slip_angle_step), the same by the explicit step with a table of
motion.slip_angle, and the lateral stiffness of the standing tyre on ground to which it sticks, by the explicit step. Prints
the table of docs/tyre.md, section 8; some ten minutes."""
import argparse
import csv
import json
import math
import pathlib
import subprocess
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
STEP, SPIN = math.radians(0.25), 43.4  # rad, rad/s
BEGIN, END = 0.2, 0.42  # s, of the step and of the run
WHEEL = """[damping]
mass = 100.0
stiffness = 2.0e-6
[ground]
profile = "flat"
friction = {friction}
[motion]
angular_velocity = {spin}
"""
STEADY = """slip_angle = 0.0
{given}
[analysis]
kind = "steady-rolling"
samples_per_sector = {samples}
slip = "upwind"
estimate_slip_error = false
accept_scheme_power = true
"""
IN_TIME = """speed = {speed}
slip_angle = {angle}
height = {height}
[time]
end = {end}
[output]
snapshots = 0
history_interval = 2e-4
"""
COLUMNS = ("kN", "C_Fα N/°", "63 %, 1 and 2 samples m", "without inertia and damping m", "fitted, 2 samples m", "M_z, 63 % m",
           "steps in time: C_Fα N/°", "63 %, fitted m", "standing tyre N/mm", "C_Fα over it m")


class Tyre:
    def __init__(self, program, folder, sectors):
        self.program, self.folder = program, folder
        text = (ROOT / "cases" / "tyre-cornering.toml").read_text()
        self.tyre = text[:text.index("[damping]")].replace("sectors = 120", f"sectors = {sectors}").replace(
            "meshes/", f"{ROOT / 'cases' / 'meshes'}/")

    def solve(self, text, *settings):
        path, run = self.folder / "case.toml", self.folder / "run"
        path.write_text(self.tyre + text)
        words = [word for setting in settings for word in ("--set", setting)]
        done = subprocess.run([self.program, "run", path, "-o", run, "--overwrite", "--quiet", *words],
                              capture_output=True, text=True)
        if done.returncode:
            raise SystemExit(done.stderr)
        return json.loads((run / "run.json").read_text())

    def steady(self, given, samples, *settings):
        text = WHEEL.format(friction=0.9, spin=SPIN) + STEADY.format(given="", samples=samples)
        return self.solve(text, *given, *settings)

    def stepped(self, height, speed, samples, *more):
        return self.steady((f"motion.height={height!r}", f"motion.speed={speed!r}"), samples,
                           f"analysis.slip_angle_step={STEP!r}", "analysis.step_distance=3.0", *more)["slip_step"]

    def in_time(self, spin, friction, **motion):
        """time, lateral force."""
        self.solve(WHEEL.format(friction=friction, spin=spin) + IN_TIME.format(**motion))
        with open(self.folder / "run" / "history.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        return (np.array([float(row[name]) for row in rows]) for name in ("time_s", "force_lateral"))

    def rolled(self, height, speed):
        """Cornering stiffness, N/°; relaxation lengths at 63 % and of an exponential, whose end is fitted as well. Comes down
        within 20 ms."""
        angle = [[0.0, 0.0], [BEGIN, 0.0], [BEGIN + 1e-4, STEP]]
        time, force = self.in_time(SPIN, 0.9, speed=speed, angle=angle, end=END,
                                   height=[[0.0, height + 0.02], [0.02, height]])
        before, late = force[(time > BEGIN - 0.02) & (time <= BEGIN)].mean(), force[time > END - 0.02].mean()
        distance, change = speed * (time - BEGIN), force - before
        rolls = distance > 0.0
        distance, change = distance[rolls], change[rolls]
        share = np.convolve(change, np.ones(9) / 9.0, "same") / (late - before)
        reached = distance[np.argmax(share >= 1.0 - math.exp(-1.0))]
        lengths = np.geomspace(0.05, 3.0, 4000)
        curves = 1.0 - np.exp(-distance / lengths[:, None])
        ends = curves @ change / (curves ** 2).sum(axis=1)
        errors = ((curves * ends[:, None] - change) ** 2).sum(axis=1)
        return abs(late - before) / math.degrees(STEP), reached, lengths[errors.argmin()]

    def standing(self, height):
        """Lateral stiffness, N/mm: the hub is moved by .1 mm at .75 rad to the heading, and then backwards at -.75 rad, so
        that it ends to the side."""
        far, angle, ends = 1e-4, 0.75, (0.1, 0.16, 0.22)
        speed = [[0.0, 0.0]]
        for begin, sign in zip(ends[:2], (1.0, -1.0), strict=True):
            speed += [[begin, 0.0], [begin + 0.01, sign * far / 0.01], [begin + 0.02, 0.0]]
        time, force = self.in_time(0.0, 5.0, speed=speed, end=ends[-1],
                                   angle=[[0.0, angle], [ends[0] + 0.03, angle], [ends[1] - 0.01, -angle]],
                                   height=[[0.0, height + 0.02], [0.03, height + 1e-3], [0.06, height]])
        first, last = (force[(time > at - 5e-3) & (time <= at)].mean() for at in (ends[0], ends[-1]))
        return 1e-3 * abs(last - first) / (2.0 * far * math.sin(angle))


def row(tyre, load, explicit):
    state = tyre.steady((f"analysis.load={load}", "analysis.torque=0.0"), 2)["steady"]
    at = state["height"], state["speed"]
    found = [tyre.stepped(*at, samples) for samples in (1, 2)]
    slow = tyre.stepped(*at, 2, "analysis.inertia=none", "damping.mass=0", "damping.stiffness=0")
    force, moment = found[1]["force_lateral"], found[1]["moment_aligning"]
    cornering = abs(force["after"] - force["before"]) / STEP
    cells = [f"{load / 1000:g}", f"{math.radians(cornering):.0f}",
             ", ".join(f"{one['force_lateral']['relaxation_length']:.3f}" for one in found),
             f"{slow['force_lateral']['relaxation_length']:.3f}", f"{force['fitted_length']:.3f}",
             f"{moment['relaxation_length']:.3f}"]
    if explicit:
        stiffness = tyre.standing(at[0])
        in_time, *lengths = tyre.rolled(*at)
        cells += [f"{in_time:.0f}", ", ".join(f"{length:.3f}" for length in lengths), f"{stiffness:.1f}",
                  f"{1e-3 * cornering / stiffness:.3f}"]
    print("| " + " | ".join(cells) + " |", flush=True)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--program", type=pathlib.Path, default=ROOT / "build" / "release" / "rondo")
    arguments.add_argument("--sectors", nargs="*", type=int, default=[60, 90])
    arguments.add_argument("--loads", nargs="*", type=int, default=[2000, 3000, 4000])
    arguments.add_argument("--without", choices=["explicit"])
    given = arguments.parse_args()
    with tempfile.TemporaryDirectory() as name:
        for sectors in given.sectors:
            columns = COLUMNS[:6] if given.without else COLUMNS
            print(f"\n{sectors} sectors\n\n| " + " | ".join(columns) + " |\n" + len(columns) * "|---" + "|")
            for load in given.loads:
                row(Tyre(given.program.resolve(), pathlib.Path(name), sectors), load, not given.without)


if __name__ == "__main__":
    main()

#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What a tyre's results are over its sectors, its section and its pressure.

    bench/tyre_tables.py [--program FILE] [--only convergence|pressure]

The tyre is that of tests/meshes/tyre-205-55-r16.msh, 16 mm deep. Prints the tables of docs/tyre.md, Mesh and
pressure, in some minutes each, in brackets the values of an independent calculation."""
import argparse
import csv
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

from tyre_rolling import ROOT, run, settings

DEPTH = 0.016  # m
SECTORS = (60, 120, 180, 240)
LOAD = {("test", 60): 3764.1, ("test", 120): 3646.3, ("test", 180): 3628.1, ("test", 240): 3618.4,
        ("coarse", 120): 3882.1}  # N, by the independent calculation
PRESSURE = {  # Pa: load N, lateral and longitudinal stiffness N/mm, ply steer N, cornering stiffness N/°
    1.5e5: (2732.4, 110.6, 204.0, -140.88, 1199.2), 1.8e5: (3128.2, 125.4, 224.3, -149.80, 1308.8),
    2.2e5: (3646.3, 146.5, 251.8, -148.58, 1445.8), 2.6e5: (4158.6, 165.2, 277.3, -142.62, 1534.6)}
ASKEW = 0.78  # rad: the largest slip angle


class Tyre:
    """One tyre, solved in turn."""

    def __init__(self, program, folder, words, sectors):
        import test_tyre
        self.cases, self.program, self.folder = test_tyre, program, folder
        self.words = settings(section__sectors=sectors) + words
        self.solve(test_tyre.INFLATED)
        self.height = self.summary()["inflation"]["outer_radius_m"] - DEPTH

    def solve(self, text, command="run", *more, may_fail=False, **keys):
        """Whether it is solved."""
        done = run(self.program, text, self.folder, [*self.words, *more, *settings(**keys)], command)
        if not done and not may_fail:
            sys.exit(f"tyre_tables: rondo {command} failed: {' '.join(map(str, self.words))}")
        return done

    def summary(self, name="run.json"):
        return json.loads((self.folder / "run" / name).read_text())

    def rows(self, name):
        with open(self.folder / "run" / name, newline="") as file:
            return list(csv.DictReader(file))

    def load(self):
        """Standing without friction, N, and how many nodes touch."""
        self.solve(self.cases.MOVING + self.cases.GROUND, "modes", "--standing", "--count", "1",
                   motion__height=self.height, motion__angular_velocity=0, ground__friction=0)
        standing = self.summary("modes.json")["standing"]
        return standing["load"], standing["nodes"]

    def modes(self):
        """At rest: the first two frequencies without nodal diameters, and with one, Hz."""
        self.solve(self.cases.MOVING, "modes", "--diameters", "0", "--count", "6", "--spin", "0")
        found = {"0": [], "1": []}
        for row in self.rows("modes.csv"):
            found[row["nodal_diameters"]].append(float(row["frequency_hz"]))
        return found["0"][:2] + found["1"][:4:2]

    def steers(self, **keys):
        """Lateral force N without slip angle, and by how much it falls at 1°. None: not solved."""
        forces = []
        for angle in (0.0, math.pi / 180):
            if not self.solve(self.cases.ROLLING, may_fail=True, motion__height=self.height,
                              motion__slip_angle=angle, analysis__estimate_slip_error="false", **keys):
                return None, None
            forces.append(self.summary()["steady"]["force_lateral"])
        return forces[0], forces[0] - forces[1]

    def stiffness(self):
        """Lateral and longitudinal, N/mm, and how many nodes touch: the hub of the standing tyre is moved by .1 mm
        along t1 and then by as much at an angle; each time the explicit step comes to rest."""
        far, moving = 1e-4, 0.02
        ends = (0.1, 0.16, 0.22)  # s: set down, moved along, moved at an angle
        speed = [[0.0, 0.0]]
        for begin in ends[:2]:
            speed += [[begin, 0.0], [begin + moving / 2, 2 * far / moving], [begin + moving, 0.0]]
        self.solve(self.cases.TYRE + self.cases.GROUND + f"""[damping]
mass = 300.0
stiffness = 1.5e-6
[motion]
angular_velocity = 0.0
speed = {speed}
slip_angle = [[0.0, 0.0], [{ends[0] + 1.5 * moving}, 0.0], [{ends[1] - moving / 2}, {ASKEW}]]
height = [[0.0, {self.height + DEPTH + 1e-5}], [0.03, {self.height + 1e-3}], [0.06, {self.height}]]
[time]
end = {ends[-1]}
[output]
snapshots = 0
history_interval = 5e-4
""", ground__friction=5.0)
        rows = self.rows("history.csv")
        forces, nodes = [], 0
        for end in ends:  # means of 5 ms
            last = [row for row in rows if end - 5e-3 < float(row["time_s"]) <= end]
            forces.append([sum(float(row[name]) for row in last) / len(last) for name in ("force_x", "force_lateral")])
            nodes = nodes or int(last[-1]["contact_nodes"])
        along, askew = ([(b - a) / (-1e3 * far) for a, b in zip(*forces[k:k + 2])] for k in (0, 1))
        return (askew[1] - math.cos(ASKEW) * along[1]) / math.sin(ASKEW), along[0], nodes


def shown(value, digits):
    return "–" if value is None else f"{value:,.{digits}f}".replace("-", "−")


def nodes_of(mesh):
    lines = mesh.read_text().splitlines()
    return int(lines[lines.index("$Nodes") + 1])


def convergence(program, folder, meshes):
    print("| section, nodes, sectors | lateral Hz | torsion Hz | load N | ply steer N: upwind, bdf2 | "
          "cornering stiffness N/°: upwind, bdf2 |\n" + 6 * "|---" + "|")
    for name, sectors in [("test", n) for n in SECTORS] + [("coarse", 120), ("fine", 120)]:
        tyre = Tyre(program, folder, settings(section__file=meshes[name]), sectors)
        lateral, torsion = tyre.modes()[:2]
        load, _ = tyre.load()
        steers = [tyre.steers(analysis__samples_per_sector=4, analysis__massless_contact="true", analysis__slip=slip)
                  for slip in ("upwind", "bdf2")]
        ply, cornering = (", ".join(shown(value, 0) for value in values)
                          for values in zip(*steers))
        other = LOAD.get((name, sectors))
        print(f"| {name}, {nodes_of(meshes[name])}, {sectors} | {lateral:.2f} | {torsion:.2f} | {shown(load, 1)}"
              + (f" ({shown(other, 1)})" if other else "") + f" | {ply} | {cornering} |", flush=True)


def pressures(program, folder):
    print("| kPa | load N | lateral N/mm | longitudinal N/mm | lateral, torsion Hz | yaw, radial Hz | ply steer N | "
          "cornering stiffness N/° |\n" + 8 * "|---" + "|")
    touching = []
    for pressure, others in PRESSURE.items():
        tyre = Tyre(program, folder, settings(inflation__pressure=pressure), 120)
        modes = tyre.modes()
        load, free = tyre.load()
        lateral, longitudinal, held = tyre.stiffness()
        touching.append(f"{held} of {free}")
        found = (load, lateral, longitudinal, *tyre.steers())
        cells = [f"{shown(value, 1)} ({shown(other, 1)})" for value, other in zip(found, others)]
        cells[3:3] = [f"{first:.2f}, {second:.2f}" for first, second in (modes[:2], modes[2:])]
        print(f"| {pressure / 1e3:.0f} | " + " | ".join(cells) + " |", flush=True)
    print("Nodes that touch with friction, of those without: " + ", ".join(touching))


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--program", type=pathlib.Path, default=ROOT / "build" / "release" / "rondo")
    arguments.add_argument("--only", choices=("convergence", "pressure"))
    arguments = arguments.parse_args()
    program = arguments.program.resolve()
    os.environ["RONDO"] = str(program)
    sys.path.insert(0, str(ROOT / "tests" / "cli"))
    import test_tyre
    import test_tyre_rolling
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        meshes = {"test": test_tyre.MESH, "coarse": test_tyre_rolling.MESH, "fine": folder / "fine.msh"}
        subprocess.run(["gmsh", test_tyre.MESH, "-refine", "-v", "2", "-format", "msh22", "-o", meshes["fine"]],
                       check=True)
        if arguments.only != "pressure":
            convergence(program, folder, meshes)
        if arguments.only != "convergence":
            pressures(program, folder)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""A small wheel for the tyre test rig: a cylinder of rubber, a state of which is some milliseconds."""
import os
import subprocess
import sys

from program import PROGRAM

WHEEL = """schema = 1
title = "Small wheel"
[disk]
outer_radius = 0.30
inner_radius = 0.20
width = 0.10
[disk.mesh]
radial = 2
circumferential = 60
axial = 4
[material]
youngs_modulus = 5.0e6
poissons_ratio = 0.3
density = 1100.0
[damping]
stiffness = 2.0e-5
[motion]
angular_velocity = 40.0
[ground]
profile = "flat"
friction = 0.8
[analysis]
kind = "steady-rolling"
load = 4000.0
torque = 0.0
samples_per_sector = 2
"""
RIG = """schema = 1
loads = [2000.0, 4000.0, 6000.0]
cambers_deg = [0.0, 3.0]
[lateral]
slip_angles_deg = [-6.0, -2.0, -0.5, 0.0, 0.5, 2.0, 6.0]
few_slip_angles_deg = [-2.0, 0.0, 2.0]
[footprint]
loads = [2000.0, 4000.0]
[road]
length = 2.0
modes = 20
[cleat]
speeds = [12.0, 20.0]
modes = 20
height = 0.006
length = 0.06
"""


def rig(*arguments, code=0):
    done = subprocess.run([sys.executable, "-m", "rondo", "rig", *map(str, arguments)], capture_output=True, text=True,
                          env=os.environ)
    assert done.returncode == code, done.stderr
    return done


def failing(folder, pattern, instead='echo "rondo: error: made to fail" >&2; exit 3'):
    """A program of which those commands fail that have the pattern, a regular expression, among their arguments.
    instead: what they do, as a shell has it"""
    program = folder / "failing-rondo"
    program.write_text(f"""#!/bin/bash
if [[ "$*" =~ {pattern} ]]; then
  {instead}
fi
exec {PROGRAM} "$@"
""")
    program.chmod(0o755)
    return str(program)


def files(folder, case=WHEEL, settings=RIG):
    """(case file, rig file)"""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "wheel.toml").write_text(case)
    (folder / "rig.toml").write_text(settings)
    return folder / "wheel.toml", folder / "rig.toml"

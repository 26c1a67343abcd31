# SPDX-License-Identifier: BSD-3-Clause
"""Runs cases in this process, reads and draws what the program rondo writes:
rondo.run("case.toml").plot_field(0.1), rondo.Simulation("case.toml"), rondo.open("results")."""
from .interrupts import while_loading
from .needs import demand

while_loading()  # of python3 -m rondo
demand("numpy", "h5py")  # before anything imports them

# ruff: noqa: E402
from . import axes, files, magic_formula
from .about import about
from .calls import fmu, modes, pod, reduce, run, sweep
from .data.errors import (
    Error,
    FileError,
    InputError,
    NewerSchemaError,
    NotARunError,
    NumericalError,
    UnfinishedRunError,
    UnknownNameError,
)
from .data.heat import Heat
from .data.history import History
from .data.mesh import Mesh
from .data.modes import Modes, open_modes
from .data.paper import Paper, open_paper
from .data.pod import Pod, open_pod
from .data.rig import Rig, open_rig
from .data.run import Run
from .data.run import open_run as open
from .data.sweep import Sweep, open_sweep
from .data.validation import Validation, open_validation
from .pictures import attach, report
from .reduced_wheel import ReducedWheel
from .simulation import Simulation
from .solution import Solution, crush, solve, steady_rolling

__version__ = "0.2.0"

attach()
del attach, demand, while_loading

__all__ = ["Error", "FileError", "Heat", "History", "InputError", "Mesh", "Modes", "NewerSchemaError", "NotARunError",
           "NumericalError", "Paper", "Pod", "ReducedWheel", "Rig", "Run", "Simulation", "Solution", "Sweep",
           "UnfinishedRunError", "UnknownNameError", "Validation", "about", "axes", "crush", "files", "fmu",
           "magic_formula", "modes", "open", "open_modes", "open_paper", "open_pod", "open_rig", "open_sweep", "open_validation",
           "pod", "reduce", "report", "run", "solve", "steady_rolling", "sweep"]

# SPDX-License-Identifier: BSD-3-Clause
"""Runs cases, reads and draws what the program rondo writes:
rondo.run("case.toml").plot_field(0.1), rondo.open("results")."""
from .calls import run
from .data.errors import Error, NewerSchemaError, NotARunError, UnfinishedRunError, UnknownNameError
from .data.history import History
from .data.mesh import Mesh
from .data.modes import Modes, open_modes
from .data.paper import Paper, open_paper
from .data.pod import Pod, open_pod
from .data.run import Run
from .data.run import open_run as open
from .data.sweep import Sweep, open_sweep
from .data.validation import Validation, open_validation
from .pictures import attach

__version__ = "0.1.0"

attach()
del attach

__all__ = ["Error", "History", "Mesh", "Modes", "NewerSchemaError", "NotARunError", "Paper", "Pod",
           "Run", "Sweep", "UnfinishedRunError", "UnknownNameError", "Validation", "open",
           "open_modes", "open_paper", "open_pod", "open_sweep", "open_validation", "run"]

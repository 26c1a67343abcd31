# SPDX-License-Identifier: BSD-3-Clause
"""Reads and draws what the program rondo writes: rondo.open("results").plot_field(0.1)."""
from .errors import Error, NewerSchemaError, NotARunError, UnfinishedRunError, UnknownNameError
from .history import History
from .mesh import Mesh
from .modes import Modes, open_modes
from .paper import Paper, open_paper
from .pod import Pod, open_pod
from .run import Run
from .run import open_run as open
from .sweep import Sweep, open_sweep
from .validation import Validation, open_validation

__version__ = "0.1.0"

__all__ = ["Error", "History", "Mesh", "Modes", "NewerSchemaError", "NotARunError", "Paper", "Pod",
           "Run", "Sweep", "UnfinishedRunError", "UnknownNameError", "Validation", "open",
           "open_modes", "open_paper", "open_pod", "open_sweep", "open_validation"]

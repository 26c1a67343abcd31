# SPDX-License-Identifier: BSD-3-Clause
"""Which library and which program this package works with: for reports of faults, and before two
results are compared."""
from __future__ import annotations

import os
import pathlib
import platform
import sys

import h5py
import numpy as np

from .data.errors import Error
from .native import core
from .studies.program import find_program


def about() -> str:
    """A line each of the package, the module, the program, the reader of Gmsh files and Python,
    with versions and places; what is missing is said, not raised."""
    lines = [f"rondo {sys.modules['rondo'].__version__}", f"package  {pathlib.Path(__file__).resolve().parent}"]
    ids = []
    try:
        module = core()
        lines.append(f"module   {module.__file__}: {module.version} ({module.build_options}; build "
                     f"id {module.build_id()}; kernels {module.dispatch_level()})")
        ids.append(module.build_id())
    except (Error, ImportError) as reason:
        lines.append(f"module   none: {reason}")
    try:
        program = find_program()
        lines.append(f"program  {program.path}: {program.version} ({program.build}; build id "
                     f"{program.build_id})")
        ids.append(program.build_id)
    except Error as reason:
        lines.append(f"program  none: {reason}")
    lines.append(f"meshes   {os.environ.get('RONDO_MESH_READER', 'read by the program only')}")
    lines.append(f"python   {sys.executable}: {platform.python_version()}, numpy {np.__version__}, "
                 f"h5py {h5py.__version__} (HDF5 {h5py.version.hdf5_version})")
    if len(set(ids)) > 1:
        lines.append("module and program are of different builds: their numbers may differ, and one "
                     "cannot resume a run of the other")
    return "\n".join(lines)

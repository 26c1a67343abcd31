# SPDX-License-Identifier: BSD-3-Clause
"""The program rondo: where it is, which one it is, and one of its commands as a process."""
from __future__ import annotations

import ctypes
import os
import pathlib
import re
import shutil
import signal
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from typing import IO

from ..data.errors import Error

CHECKOUT = pathlib.Path(__file__).resolve().parents[3]  # of the sources; elsewhere if installed
INSTALLED = pathlib.Path(__file__).resolve().parents[1] / "bin" / "rondo"  # or a link to it
_LIBC = ctypes.CDLL(None)
_DIE_WITH_PARENT = 1  # PR_SET_PDEATHSIG of prctl(2)


@dataclass(frozen=True)
class Program:
    path: str
    version: str
    build: str     # compiler and its kind
    build_id: str  # hash of the program: one built anew may give other numbers


def find_program() -> Program:
    """$RONDO, else the one installed with this package, else the one on PATH, else
    build/release/rondo of the checkout."""
    built = CHECKOUT / "build" / "release" / "rondo"
    path = (os.environ.get("RONDO") or (os.access(INSTALLED, os.X_OK) and str(INSTALLED))
            or shutil.which("rondo") or (built.is_file() and str(built)))
    if not path:
        raise Error(f"rondo: there is no such program, neither as {INSTALLED} nor on PATH nor as "
                    f"{built}: build it, or give its path as RONDO=...")
    try:
        done = subprocess.run([path, "--version"], capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError) as reason:
        raise Error(f"{path}: cannot be run: {reason}; give another program as RONDO=...") from None
    found = re.fullmatch(r"rondo (\S+) \((.*); build id ([0-9a-f]*); kernels \w+\)\n.*", done.stdout,
                         re.DOTALL)
    if found is None:
        raise Error(f"{path}: is no rondo of this version: --version says {done.stdout!r}; give "
                    "another program as RONDO=...")
    return Program(path, found[1], found[2], found[3])


def start(program: Program, arguments: Sequence[str], errors: IO[str]) -> subprocess.Popen[str]:
    """A command of the program. It dies with this process, and signals of the terminal are left to
    this process to pass on."""
    parent = os.getpid()

    def in_the_child() -> None:
        os.setpgrp()
        _LIBC.prctl(_DIE_WITH_PARENT, signal.SIGKILL)
        if os.getppid() != parent:  # it died before the line above
            os._exit(1)

    return subprocess.Popen([program.path, *arguments], stdin=subprocess.DEVNULL,
                            stdout=subprocess.DEVNULL, stderr=errors, text=True,
                            preexec_fn=in_the_child)

# SPDX-License-Identifier: BSD-3-Clause
"""The program's commands as functions: rondo.run("case.toml")."""
from __future__ import annotations

import json
import os
import pathlib
import signal
import subprocess
import warnings
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .data.errors import Error
from .data.run import Run, open_run
from .studies.program import find_program

_SAID = "rondo: "


def _toml(value: Any) -> str:
    """A value of a case as --set takes it."""
    if isinstance(value, (np.ndarray, np.generic)):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(_toml(item) for item in value)}]"
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value), ensure_ascii=False)
    if isinstance(value, (int, float)):
        return repr(value)
    raise Error(f"a setting is a number, a text, a boolean or a list of them, not {value!r}")


def _default_directory(case: pathlib.Path) -> pathlib.Path:
    """As the program's: the case's name in the working folder."""
    return pathlib.Path(case.stem if case.suffix else f"{case.name}.results")


def _finished(command: list[str]) -> tuple[int, list[str]]:
    """Exit code and what was said. An interrupt goes to the program, which ends cleanly."""
    with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, text=True, errors="replace",
                          start_new_session=True) as process:
        try:
            said = process.communicate()[1]
        except BaseException:
            process.send_signal(signal.SIGINT)
            process.communicate()
            raise
    return process.returncode, said.splitlines()


def run(case: str | os.PathLike[str], output: str | os.PathLike[str] | None = None,
        settings: Mapping[str, Any] | None = None, *, overwrite: bool = False,
        resume: bool = False, threads: int | None = None,
        arguments: Sequence[str | os.PathLike[str]] = ()) -> Run:
    """Runs a case (`rondo run`) and opens its results. `output`: results directory; by default the
    case's name in the working folder. `settings`: keys of the case, as {"ground.friction": 0.6}.
    `arguments`: further ones of the command. What the program warns of is warned of here; a case
    that is refused or a run that fails raises an Error with what it says."""
    case = pathlib.Path(case)
    directory = pathlib.Path(output) if output is not None else _default_directory(case)
    command = [find_program().path, "run", os.fspath(case), "-o", os.fspath(directory), "--quiet"]
    for key, value in (settings or {}).items():
        command += ["--set", f"{key}={_toml(value)}"]
    command += ["--overwrite"] * overwrite + ["--resume"] * resume
    if threads is not None:
        command += ["--threads", str(threads)]
    code, said = _finished(command + [os.fspath(argument) for argument in arguments])
    for line in said:
        if line.startswith(f"{_SAID}warning: "):
            warnings.warn(line.removeprefix(f"{_SAID}warning: "), stacklevel=2)
    if code != 0:
        errors = [line.removeprefix(f"{_SAID}error: ") for line in said
                  if not line.startswith(f"{_SAID}warning: ")]
        raise Error("\n".join(errors) or f"{directory}: the program ended with {code}")
    return open_run(directory)

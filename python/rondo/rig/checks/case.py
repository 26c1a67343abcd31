# SPDX-License-Identifier: BSD-3-Clause
"""Mistakes in the case of a wheel, as `rondo check` tells them: with line, column, what was found and what is allowed."""
from __future__ import annotations

import json
import pathlib
import subprocess
from collections.abc import Mapping
from typing import Any

from ...data.errors import Error, InputError
from ...studies.program import Program

UNUSED = ("time", "ground.profile", "ground.road", "ground.obstacle", "ground.fillet")  # the rig has its own
RIGS_OWN = ("motion", "rim", "analysis")  # the rig has values of its own where these are missing
GROUND = "ground"  # a rig file may give all that the rig takes from it
WRONG = 2  # exit code of the program: wrong input


def demand_right(program: Program, path: pathlib.Path) -> None:
    """Mistakes in what the rig does not use, and missing keys for which it has values of its own, do not count: the case need not be
    one that runs by itself.
    @raise InputError: with all mistakes."""
    found = _checked(program, path)
    if found.get("exit_code") == 0:
        return
    faults, lines = found.get("faults", []), str(found.get("message")).splitlines()  # a line for each fault, and their number
    counted = [k for k, one in enumerate(faults) if not _is_of_the_rig(one)]
    if faults and not counted:
        return
    text = "\n".join(lines[k] for k in counted) if counted else f"{path}: {'; '.join(lines)}"
    raise (InputError if found.get("exit_code") == WRONG else Error)(text)


def _checked(program: Program, path: pathlib.Path) -> dict[str, Any]:
    """What the program writes of its check."""
    try:
        done = subprocess.run([program.path, "check", str(path), "--json"], stdin=subprocess.DEVNULL, capture_output=True, text=True)
        found = json.loads(done.stdout)
    except (OSError, ValueError) as reason:
        raise Error(f"{program.path}: cannot check {path}: {reason}") from None
    if not isinstance(found, dict):
        raise Error(f"{program.path}: cannot check {path}: it wrote {done.stdout[:60]!r}")
    return found


def _is_of_the_rig(fault: Mapping[str, Any]) -> bool:
    key, message = str(fault.get("key", "")), str(fault.get("message", ""))
    if key.startswith(UNUSED) and not message.startswith("unknown"):
        return True
    whole = message.startswith("the table is missing")
    return (whole and key == GROUND) or ((whole or message.startswith("is missing")) and key.startswith(RIGS_OWN))

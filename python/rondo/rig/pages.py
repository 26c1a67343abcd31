# SPDX-License-Identifier: BSD-3-Clause
"""What is made of the tables of a rig: tyre.tir, figures, report.html, and a comparison with measurements."""
from __future__ import annotations

import pathlib
import sys

from ..data.errors import Error
from ..data.rig import Rig, open_rig
from .against import compare
from .figures import draw
from .fit import write_tir
from .report import write


def write_pages(directory: pathlib.Path, measured: pathlib.Path | None = None) -> list[pathlib.Path]:
    """The files that were written. Where the points do not suffice for tyre.tir, the report says so."""
    rig = open_rig(directory)
    files = [] if (tir := _tir(rig)) is None else [tir]
    against = compare(rig, measured) if measured is not None else None
    draw(rig, directory / "figures", against)
    return [*files, directory / "figures", write(rig, directory / "report.html", against)]


def _tir(rig: Rig) -> pathlib.Path | None:
    path = rig.directory / "tyre.tir"
    try:
        write_tir(rig, path)
    except Error as reason:
        path.unlink(missing_ok=True)
        print(f"rondo: warning: no tyre.tir: {reason}", file=sys.stderr)
        return None
    return path

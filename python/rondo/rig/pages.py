# SPDX-License-Identifier: BSD-3-Clause
"""What is made of the tables of a rig: tyre.tir, figures, report.html, and a comparison with measurements."""
from __future__ import annotations

import hashlib
import pathlib
import sys

from ..data.errors import Error
from ..data.files import read_json
from ..data.rig import Rig, open_rig
from .against import Comparison, compare
from .blocks import MADE_OF
from .figures import pictures_of
from .fit import write_tir
from .record import replace_text, write_json
from .report import write


ROUGH = 0.1  # of the largest force or moment


def write_pages(directory: pathlib.Path, measured: pathlib.Path | None = None) -> list[pathlib.Path]:
    """The files that were written. Where the points do not suffice for tyre.tir, a warning and the report say so.
    @raise Error: of the measurements, when all else is written."""
    rig = open_rig(directory)
    files = [] if (tir := _tir(rig)) is None else [tir]
    against: Comparison | None = None
    trouble: Error | None = None
    if measured is not None:
        try:
            against = compare(rig, measured)
            files.append(_write_comparison(rig, against))
            for text in against.warnings:
                print(f"rondo: warning: --against: {text}", file=sys.stderr)
        except Error as reason:
            trouble = reason
    pictures = pictures_of(rig, against, directory / "figures")
    files += [directory / "figures", write(rig, directory / "report.html", against, pictures)]
    replace_text(directory / "figures" / MADE_OF, _identity(directory))
    if trouble is not None:
        raise trouble
    return files


def pages_are_there(directory: pathlib.Path, measured: pathlib.Path | None) -> bool:
    """They were made of these very tables, and without measurements, as they are to be."""
    if measured is not None or (directory / "against.csv").exists() or not (directory / "report.html").exists():
        return False
    try:
        return (directory / "figures" / MADE_OF).read_text(encoding="utf-8") == _identity(directory)
    except (OSError, ValueError):
        return False


def _identity(directory: pathlib.Path) -> str:
    """Of the tables, and of what rig.json says of them."""
    tables = [directory / "rig.json", *sorted(directory.glob("*.csv"))]
    return hashlib.sha256(b"\0".join(path.read_bytes() for path in tables)).hexdigest()


def _tir(rig: Rig) -> pathlib.Path | None:
    path = rig.directory / "tyre.tir"
    try:
        residuals = write_tir(rig, path)
    except Error as reason:
        path.unlink(missing_ok=True)
        print(f"rondo: warning: no tyre.tir: {reason}", file=sys.stderr)
        return None
    for channel in ("Fx", "Fy", "Mz"):
        if channel in residuals and residuals[channel]["of_largest"] > ROUGH:
            print(f"rondo: warning: tyre.tir: {channel} differs from the points by {100.0 * residuals[channel]['of_largest']:.0f} % "
                  "(rms) of its largest; the first lines of the file say why (try more slips, slip angles and loads)", file=sys.stderr)
    return path


def _write_comparison(rig: Rig, against: Comparison) -> pathlib.Path:
    """against.csv, and the same in rig.json."""
    write_json(rig.directory / "rig.json", {**read_json(rig.directory / "rig.json"), "against": against.summary})
    return against.write(rig.directory / "against.csv")

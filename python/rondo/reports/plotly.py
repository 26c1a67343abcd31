# SPDX-License-Identifier: BSD-3-Clause
"""plotly.js, which draws the curves: where it is, and its text."""
from __future__ import annotations

import os
import pathlib
from functools import cache

from ..data.errors import Error
from ..data.plain_files import text_of

PACKAGE = "plotly.js-basic-dist-min"
VERSION = "4.1.1"
NAME = "plotly-basic.min.js"
HERE = pathlib.Path(__file__).resolve().parent
CHECKOUT = HERE.parents[2]  # of the sources; elsewhere if installed
FOLDERS = (HERE / "assets",  # an installed package
           CHECKOUT / "build" / "release" / "python",  # where CMake has put what it found
           pathlib.Path("/usr/local/lib/node_modules") / PACKAGE,
           pathlib.Path("/usr/lib/node_modules") / PACKAGE)  # npm install -g


def find_plotly() -> pathlib.Path:
    """$RONDO_PLOTLY, else the one in the package, beside the build, or npm's."""
    given = os.environ.get("RONDO_PLOTLY")
    found = [pathlib.Path(given)] if given else [folder / NAME for folder in FOLDERS]
    for path in found:
        if path.is_file():
            return path
    raise Error(f"{', '.join(map(str, found))}: there is no plotly.js, which draws the curves of a "
                f'report: "bash scripts/setup.sh" installs it, or "npm install -g {PACKAGE}@{VERSION}"; '
                "or give the file as RONDO_PLOTLY=...")


@cache
def plotly() -> str:
    """Its text with its licence, to stand in a page."""
    path = find_plotly()
    try:
        text = text_of(path)
    except ValueError as reason:
        raise Error(f"{path}: cannot be read: {reason}") from None
    if "plotly.js (basic" not in text[:400]:
        raise Error(f"{path}: is not {NAME} of npm's {PACKAGE}: give another file as RONDO_PLOTLY=...")
    licence = next((one for one in (path.with_name("LICENSE"), path.with_name("plotly-LICENSE"))
                    if one.is_file()), None)
    words = licence.read_text(encoding="utf-8").replace("*/", "* /") if licence else ""
    return f"/*\n{words}*/\n{text}" if words else text

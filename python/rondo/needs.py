# SPDX-License-Identifier: BSD-3-Clause
"""What the package needs of the Python that imports it. Read by any Python 3, of whatever version and without any
package: it has to say what is missing."""
from __future__ import annotations

import importlib.util
import sys

FILES = 4  # exit code, as the program's where no Python has what it needs
SYSTEM = "/usr/bin/python3"  # that of the Debian packages


def missing(*modules: str) -> str:
    """Empty: nothing is."""
    absent = [name for name in modules if importlib.util.find_spec(name) is None]
    if sys.version_info >= (3, 11) and not absent:
        return ""
    version = ".".join(map(str, sys.version_info[:3]))
    return (f"{sys.executable} is Python {version}{' without ' if absent else ''}{', '.join(absent)}: rondo needs Python "
            "3.11 or later with numpy, h5py and matplotlib. The program's commands, as `rondo figures`, find one by "
            f"themselves; run scripts with {SYSTEM}, whose packages scripts/setup.sh installs, or install what is "
            "missing for this one")


def started_as_program() -> bool:
    """By python3 -m rondo, and not by another program that imports the package. Known as long as Python looks for the
    module: until then sys.argv begins with -m."""
    words = getattr(sys, "orig_argv", ["-m", "rondo"])  # Python before 3.10 has none
    return sys.argv[:1] == ["-m"] and words[words.index("-m") + 1].split(".")[0] == "rondo"


def demand(*modules: str) -> None:
    """Ends `python3 -m rondo` with one line; elsewhere: @raise ImportError."""
    text = missing(*modules)
    if not text:
        return
    if started_as_program():
        sys.stderr.write(f"rondo: {text}\n")
        sys.exit(FILES)
    raise ImportError(text)

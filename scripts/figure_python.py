# SPDX-License-Identifier: BSD-3-Clause
"""The figures of docs/python.md, made by the examples that it shows:
    python3 scripts/figure_python.py docs/figures"""
from __future__ import annotations

import pathlib
import runpy
import shutil
import sys
import tempfile

EXAMPLES = pathlib.Path(__file__).resolve().parents[1] / "examples"
FIGURES = {"abs_controller": "abs", "abs_corner": "abs-corner", "tread_ripple": "tread"}


def main(out: pathlib.Path) -> None:
    sys.path.insert(0, str(EXAMPLES))  # one takes the controller of another
    with tempfile.TemporaryDirectory() as folder:
        for name, figure in FIGURES.items():
            runpy.run_path(str(EXAMPLES / f"{name}.py"))["main"](pathlib.Path(folder))
            shutil.copy(pathlib.Path(folder) / f"{figure}.png", out / f"python-{figure}.png")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]))

# SPDX-License-Identifier: BSD-3-Clause
"""One HTML file for a run, a sweep, a rig, a POD or the paper's study, which needs no network (docs/report.md)."""
from __future__ import annotations

import os
import pathlib
from typing import TYPE_CHECKING

from ..data.errors import Error, FileError, NotARunError
from ..data.files import KINDS

if TYPE_CHECKING:
    from .document import Document

INSIDE = {  # what has no page of its own, and which has
    "modes.json": "draw it with rondo campbell",
    "validation.json": "draw it with rondo validation",
}


def report(results: str | os.PathLike[str], file: str | os.PathLike[str] | None = None) -> pathlib.Path:
    """Writes the page of the results in a directory into `file`, by default report.html in that directory;
    returns its path. Of what has not ended, was interrupted or has failed it shows what is there. The same
    results give the same bytes."""
    directory = pathlib.Path(results)
    target = pathlib.Path(file) if file is not None else directory / "report.html"
    if target.suffix.lower() not in (".html", ".htm"):
        raise Error(f"{target}: a report is HTML: give a name that ends in .html")
    if target.is_dir():
        raise FileError(f"{target}: is a folder: give the name of a file that ends in .html")
    if file is not None and not target.parent.is_dir():
        raise FileError(f"{target}: cannot be written: there is no folder {target.parent}; choose another -o")
    return page(directory).write(target)


def page(directory: pathlib.Path) -> Document:
    """By what is in the directory."""
    from ..data.paper import open_paper
    from ..data.pod import open_pod
    from ..data.run import open_run
    from ..data.sweep import open_sweep
    from .plotly import plotly

    if (directory / "rig.json").is_file():
        from ..data.rig import open_rig
        from ..rig.report import page as rig_page
        return rig_page(open_rig(directory))
    plotly()  # without it nothing of the work below would be of use
    if (directory / "paper.json").is_file():
        from .paper_page import paper_page
        return paper_page(open_paper(directory, unfinished=True))
    if (directory / "sweep.json").is_file() or any(directory.glob("shards/*/rows.json")):
        from .sweep_page import sweep_page
        return sweep_page(open_sweep(directory, unfinished=True))
    if (directory / "pod.json").is_file():
        from .pod_page import pod_page
        return pod_page(open_pod(directory))
    if not (directory / "run.json").is_file():
        for name, advice in INSIDE.items():
            if (directory / name).is_file():
                raise NotARunError(f"{directory}: is {KINDS[name][0]}, which has no report: {advice}")
    from .run_page import run_page
    return run_page(open_run(directory, unfinished=True))

# SPDX-License-Identifier: BSD-3-Clause
import os
import pathlib
import subprocess

import matplotlib
import pytest

import rondo

matplotlib.use("Agg")


@pytest.fixture(scope="session")
def paper(tmp_path_factory: pytest.TempPathFactory) -> rondo.Paper:
    """The study of the paper on coarse meshes, a few seconds."""
    folder = tmp_path_factory.mktemp("paper") / "study"
    done = subprocess.run([os.environ["RONDO"], "paper", "--quick", "-o", folder],
                          capture_output=True, text=True, timeout=300)
    assert (pathlib.Path(folder) / "paper.json").exists(), done.stderr
    return rondo.open_paper(folder)

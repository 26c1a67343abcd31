# SPDX-License-Identifier: BSD-3-Clause
"""rondo.run: the program's command as a function."""
import os
import pathlib
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from program import PROGRAM, SMALL

import rondo


@pytest.fixture
def case(tmp_path, monkeypatch):
    """A case in a folder that is not the working one."""
    monkeypatch.setenv("RONDO", PROGRAM)
    (tmp_path / "cases").mkdir()
    (tmp_path / "work").mkdir()
    monkeypatch.chdir(tmp_path / "work")
    path = tmp_path / "cases" / "small.toml"
    path.write_text(SMALL)
    return path


def test_a_run_comes_back_opened(case):
    run = rondo.run(case, settings={"ground.friction": np.float64(0.0), "time.end": 0.005,
                                    "motion.height": [[0, 0.3], (0.004, 0.296)],
                                    "title": 'a "new" one', "output.stress": False})
    assert isinstance(run, rondo.Run) and run.status == "done"
    assert run.directory == pathlib.Path("small") and pathlib.Path("small/run.json").is_file()
    assert (run.friction, run.title, run.case["output"]["stress"]) == (0.0, 'a "new" one', False)
    assert rondo.run(case, "small", {"time.end": 0.01, "ground.friction": 0.0, "title": run.title,
                                     "output.stress": False}, resume=True).times[-1] == pytest.approx(0.01, rel=0.01)
    assert sorted(path.name for path in case.parent.iterdir()) == ["small.toml"]


def test_what_the_program_says_is_raised(case):
    with pytest.raises(rondo.Error, match=r"(?s)--set ground\.friction=-1: .*--set material\.young=1: .*did you mean"):
        rondo.run(case, "out", {"ground.friction": -1, "material.young": 1})
    rondo.run(case, "out", {"time.end": 0.001})
    with pytest.raises(rondo.Error, match="out.*holds another run"):
        rondo.run(case, "out", {"time.end": 0.002})
    assert rondo.run(case, "out", {"time.end": 0.002}, overwrite=True).n_snapshots == 11
    with pytest.raises(rondo.Error, match="a setting is a number"):
        rondo.run(case, "out", {"time.end": None})
    with pytest.raises(rondo.Error, match="--no-such"):
        rondo.run(case, "out", arguments=["--no-such"])


def test_warnings_are_pythons(case):
    with pytest.warns(UserWarning, match="inside the ground"):
        rondo.run(case, "out", {"motion.height": 0.296, "time.end": 0.001}, threads=1)


def test_an_interrupt_ends_the_run_cleanly(case):
    text = f"import rondo; rondo.run({str(case)!r}, 'out', {{'time.end': 1000.0}})"
    process = subprocess.Popen([sys.executable, "-c", text], stderr=subprocess.PIPE, text=True,
                               env={**os.environ, "RONDO": PROGRAM})
    for _ in range(600):
        if pathlib.Path("out/history.csv").is_file():
            break
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    assert "KeyboardInterrupt" in process.communicate()[1]
    assert rondo.open("out", unfinished=True).status == "interrupted"

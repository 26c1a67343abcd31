# SPDX-License-Identifier: BSD-3-Clause
"""The figures of a sweep as files: which, and from outside."""
import pathlib
import subprocess
import sys

import matplotlib.pyplot as plt
import pytest
import sweeps
from drawn import check_files
from sweeps import FRICTION, HEIGHT, LOAD, SPIN
from test_errors import edit, says

import rondo
from rondo import style
from rondo.figures import sweep_figures


def test_draw_sweep(grid, tmp_path):
    before = plt.get_fignums()
    written = sweep_figures.draw_sweep(grid, tmp_path, ["force_x_mean"], [(SPIN, FRICTION)],
                                       [("slip_ratio_mean", FRICTION)])
    stems = ["main-effects-force_x_mean", f"map-force_x_mean-{SPIN}-{FRICTION}",
             f"curves-force_x_mean-slip_ratio_mean-{FRICTION}"]  # it has both signs: no spread
    assert written == [tmp_path / (stem + end) for stem in stems for end in (".png", ".svg")]
    check_files(*written[:2], style.PAGE, style.DPI)
    assert plt.get_fignums() == before


def test_the_usual_figures(grid, loaded, tmp_path, monkeypatch):
    names: list = []
    monkeypatch.setattr(style, "save", lambda figure, path: names.append(path.name) or [])
    sweep_figures.draw_sweep(loaded, tmp_path)
    assert names == ["main-effects-force_y", "main-effects-contact_length_m",
                     "main-effects-pressure_max_pa", "spread"]  # no horizontal force: zero
    names.clear()
    sweep_figures.draw_sweep(grid.where(grid["run"] == 1), tmp_path)
    assert names == ["spread"]
    names.clear()
    air = sweeps.grid(tmp_path / "air", change=lambda row: row.update(
        {name: 0.0 for name in sweeps.FIGURES}))
    says(rondo.Error, sweep_figures.draw_sweep, rondo.open_sweep(air), tmp_path,
         words=["the ground does nothing", "there are: steps"])


def rondo_module(*arguments):
    return subprocess.run([sys.executable, "-m", "rondo", *map(str, arguments)], text=True,
                          capture_output=True, timeout=120)


def test_command(studies, tmp_path):
    done = rondo_module("sweep", studies / "grid", "--figure", "force_x_mean", "--map", SPIN,
                        FRICTION, "--curves", SPIN, FRICTION, "-o", tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    stems = {"main-effects-force_x_mean", f"map-force_x_mean-{SPIN}-{FRICTION}",
             f"curves-force_x_mean-{SPIN}-{FRICTION}"}
    names = {path.name for path in tmp_path.iterdir()}
    assert names == {stem + ending for stem in stems for ending in (".png", ".svg")}
    assert {pathlib.Path(line).name for line in done.stdout.splitlines()} == names


def test_figures_command(tmp_path):
    directory = sweeps.loaded(tmp_path / "loaded")
    done = rondo_module("figures", directory)
    assert (done.returncode, done.stderr) == (0, "")
    assert sorted(path.stem for path in (directory / "figures").glob("*.png")) == [
        "main-effects-contact_length_m", "main-effects-force_y", "main-effects-pressure_max_pa",
        "spread"]
    edit(directory / "sweep.json", status="running")
    for command in "figures", "sweep":
        done = rondo_module(command, directory)
        assert done.returncode == 2 and done.stderr.endswith("(here: --unfinished)\n")
    for command in "figures", "sweep":
        assert rondo_module(command, directory, "--unfinished", "--figure", "force_y").returncode == 0


@pytest.mark.parametrize("arguments, words", [
    (["nowhere"], "nowhere: no such directory"),
    (["LOADED", "--figure", "force_y", "x"], "no figure 'x'"),
    (["LOADED", "--map", "x", LOAD], "no column 'x'"),
    (["LOADED", "--curves", LOAD, HEIGHT], "has another value in each member"),
    (["LOADED", "-o", "LOADED/sweep.json"], "File exists; choose another -o"),
    (["LOADED", "--map", LOAD], "usage: python3 -m rondo sweep")])
def test_wrong_use(studies, arguments, words):
    done = rondo_module("sweep", *(text.replace("LOADED", str(studies / "loaded"))
                                   for text in arguments))
    assert done.returncode == 2 and words in done.stderr
    assert not (studies / "loaded" / "figures").exists()  # names are looked at first

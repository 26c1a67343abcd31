# SPDX-License-Identifier: BSD-3-Clause
"""The figures of the bars, of runs of the shipped cases, and the exact solutions in them."""
import pathlib

import numpy as np
import pytest
from program import ROOT, run

import rondo
from rondo.figures import bars

MASS = bars.DENSITY * bars.LENGTH  # per unit area


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> pathlib.Path:
    folder = tmp_path_factory.mktemp("bars")
    for name, case, settings in (("bar-on-wall", "bar-on-wall", []),
                                 ("bar-on-wall-critical", "bar-on-wall", ["--set", "time.safety=1"]),
                                 ("bouncing-bar", "bouncing-bar", [])):
        done = run("run", ROOT / "cases" / f"{case}.toml", "-o", folder / name, "--quiet", *settings)
        assert done.returncode == 0, done.stderr
    return folder


def test_exact_pressures_give_the_momentum() -> None:
    time = np.linspace(0, bars.PERIOD, 1000001)
    step = time[1]
    assert np.isclose(bars.wall_pressure(time).sum() * step, 2 * MASS * bars.SPEED, rtol=1e-5)
    weight = MASS * bars.GRAVITY * bars.PERIOD
    assert np.isclose(bars.bounce_pressure(time).sum() * step, weight, rtol=1e-5)
    # The height is what weight and pressure make of it.
    velocity = np.cumsum(bars.bounce_pressure(time) / MASS - bars.GRAVITY) * step
    height = bars.GAP + np.cumsum(velocity) * step
    assert np.abs(height - bars.bounce_height(time)).max() < 1e-3


def test_runs_follow_them(results: pathlib.Path) -> None:
    history = rondo.open(results / "bouncing-bar").history
    off = history["center_y_m"] - bars.LENGTH / 2 - bars.bounce_height(history["time_s"])
    assert np.abs(off).max() < 0.15  # of 5 m: what impacts and dispersion take
    history = rondo.open(results / "bar-on-wall-critical").history
    time = history["time_s"]
    inside = (time > bars.TOUCH + 0.01) & (time < bars.TOUCH + 2 * bars.TRANSIT - 0.01)
    assert np.allclose(history["force_y"][inside] / bars.WIDTH, 300, rtol=1e-8)


def test_figures_are_drawn(results: pathlib.Path, tmp_path: pathlib.Path) -> None:
    written = bars.draw(results, tmp_path)
    assert sorted(path.name for path in written) == ["bar-on-wall.png", "bar-on-wall.svg",
                                                     "bouncing-bar.png", "bouncing-bar.svg"]
    svg = (tmp_path / "bar-on-wall.svg").read_text()
    assert "Courant number 0.9" in svg
    assert bars.main([str(tmp_path), "-o", str(tmp_path)]) == 2  # no runs there

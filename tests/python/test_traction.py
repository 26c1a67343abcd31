# SPDX-License-Identifier: BSD-3-Clause
"""Traction curves and carpets of sweeps whose figures are known."""
import matplotlib.pyplot as plt
import numpy as np
import pytest
import sweeps
from drawn import curves, named, said
from matplotlib.colors import to_rgb
from sweeps import FRICTION, SPIN
from test_cli import rondo_module
from test_errors import says

import rondo
from rondo import style
from rondo.plots.traction import round_slips

SPEED, LOAD = "motion.speed", "analysis.load"
SPEEDS, LOADS, FRICTIONS = (9.2, 9.6, 10.0, 10.4, 10.8), (5e4, 1e5, 2e5), (0.3, 0.6)
FIGURES = ["force_x", "force_y", "slip_ratio"]
KEYS = [(FRICTION, "-", "values"), (LOAD, "N/m", "values"), (SPEED, "m/s", "values")]


@pytest.fixture(autouse=True)
def closed_figures():
    yield
    plt.close("all")


def slip_of(speed):
    return (10.0 - speed) / max(10.0, speed)


def pull(friction, load, speed):
    return friction * load * np.tanh(20 * slip_of(speed) / friction)


def member(friction, load, speed):
    return {FRICTION: friction, LOAD: load, SPEED: speed, "force_x": pull(friction, load, speed),
            "force_y": load, "slip_ratio": slip_of(speed)}


@pytest.fixture(scope="module")
def rolling(tmp_path_factory):
    """Friction by load by speed, 30 members, the 14th failed."""
    rows = [member(f, load, v) for f in FRICTIONS for load in LOADS for v in SPEEDS]
    rows[13] = {key: rows[13][key] for key in (FRICTION, LOAD, SPEED)} | {"status": "failed"}
    return rondo.open_sweep(sweeps.write(tmp_path_factory.mktemp("traction") / "sweep", KEYS, rows,
                                         FIGURES, analysis="steady-rolling"))


def test_curves(rolling):
    ax = rolling.select({LOAD: 5e4}).plot_traction()
    assert ax.get_legend().get_title().get_text() == "friction μ"
    assert ax.get_xlabel() == "slip ratio (%)" and said(ax).endswith("; load = 50 kN/m")
    drawn = named(ax, "0.6")
    expected = sorted((100 * slip_of(v), 1e-3 * pull(0.6, 5e4, v)) for v in SPEEDS)
    np.testing.assert_allclose(drawn, expected, rtol=1e-12, atol=1e-12)


def test_share_of_the_load(rolling):
    ax = rolling.select({FRICTION: 0.6}).plot_traction(share=True)
    shares = [named(ax, f"{load / 1e3:g} kN/m")[:, 1] for load in LOADS]
    np.testing.assert_allclose(shares[0], shares[2], rtol=1e-12, atol=1e-12)
    assert ax.get_ylabel() == "Fx/Fy (–)" and ax.get_legend().get_title().get_text() == "load"


def test_curves_of_a_motion(grid):
    """The same of means over time, by the names that they have there."""
    ax = grid.select({"solver.scheme": "symplectic"}).plot_traction()
    assert ax.get_xlabel() == "slip ratio, mean (%)" and len(curves(ax)) == 3


def of(ax, colour):
    return [line for line in ax.lines if to_rgb(line.get_color()) == to_rgb(colour)]


def test_carpet(rolling):
    ax = rolling.select({FRICTION: 0.6}).plot_carpet()
    over_slip, equal_slip = of(ax, style.BLUE), of(ax, style.VERMILLION)
    slips = 100 * np.array(sorted(slip_of(v) for v in SPEEDS))
    levels = np.arange(-6, 9, 2)  # round ones, between members
    assert len(over_slip) == len(LOADS) and len(equal_slip) == len(levels)
    first = over_slip[0].get_xdata()[0]
    for line, load in zip(over_slip, LOADS):
        x, y = line.get_data()
        beside = np.ptp(slips) * (load - LOADS[0]) / np.ptp(LOADS)
        np.testing.assert_allclose(x - first, slips - slips[0] + beside, atol=1e-10)
        np.testing.assert_allclose(y, [1e-3 * pull(0.6, load, v) for v in SPEEDS[::-1]], atol=1e-12)
    for line, level in zip(equal_slip, levels):
        expected = [np.interp(level, slips, [1e-3 * pull(0.6, load, v) for v in SPEEDS[::-1]])
                    for load in LOADS]
        np.testing.assert_allclose(line.get_ydata(), expected, atol=1e-10)
    names = {text.get_text() for text in ax.texts}
    assert names == {"50 kN/m", "100 kN/m", "200 kN/m", "8 %", "6 %", "4 %", "2 %", "0 %", "−2 %", "−4 %",
                     "−6 %"}
    assert said(ax) == ("horizontal force over slip ratio (%) and load (kN/m): 15 members; μ = 0.6")


@pytest.mark.parametrize("low, high, expected", [
    (-7.4, 8.0, [-6, -4, -2, 0, 2, 4, 6, 8]), (-0.3, 0.31, [-0.3, -0.2, -0.1, 0, 0.1, 0.2, 0.3]),
    (1.2, 1.21, [1.2, 1.202, 1.204, 1.206, 1.208, 1.21]), (-100.0, 100.0, [-100, -50, 0, 50, 100])])
def test_round_slips(low, high, expected):
    np.testing.assert_allclose(round_slips(low, high), expected, atol=1e-12)


def test_a_slip_that_is_found_is_no_abscissa(tmp_path):
    """Rolling without torque at many spins: refused, with what to do."""
    rows = [{SPIN: spin, "force_x": -20.0 - spin, "force_y": 6e4, "speed": 0.33 * spin + 0.1 * k,
             "slip_ratio": 0.001 * (-1) ** k} for k, spin in enumerate((10.0, 30.0, 50.0, 70.0))]
    sweep = rondo.open_sweep(sweeps.write(tmp_path / "sweep", [(SPIN, "rad/s", "values")], rows,
                                          [*FIGURES, "speed"], analysis="steady-rolling"))
    says(rondo.Error, sweep.plot_traction, words=("traction or torque", "Vary motion.speed",
                                                  "rondo figures"))
    given = [{**row, "speed": 10.0} for row in rows]  # the slip is made by the spin
    sweep = rondo.open_sweep(sweeps.write(tmp_path / "given", [(SPIN, "rad/s", "values")], given,
                                          [*FIGURES, "speed"], analysis="steady-rolling"))
    assert len(curves(sweep.plot_traction())) == 1


def test_a_member_that_failed_leaves_a_gap(rolling):
    ax = rolling.select({FRICTION: 0.3}).plot_carpet()
    gaps = [int(np.isnan(line.get_ydata()).sum()) for line in of(ax, style.BLUE)]
    assert gaps == [0, 0, 1] and "14 of 15 members (1 failed)" in said(ax)


def test_what_cannot_be_drawn(rolling, grid, loaded):
    says(rondo.Error, rolling.plot_carpet, words=(FRICTION, "select()"))
    says(rondo.Error, rolling.plot_traction, FRICTION, words=(LOAD, "select()"))
    says(rondo.Error, rolling.select({SPEED: 10.0}).plot_traction, words=("one slip", SPEED))
    says(rondo.Error, loaded.plot_traction, words=("no slip_ratio",))
    says(rondo.Error, rolling.select({FRICTION: 0.3, LOAD: 5e4}).plot_carpet,
         words=("two slips and two values",))


def test_no_grid(tmp_path):
    """Slips that differ from load to load are no net."""
    rows = [member(0.3, load, 9.0 + 0.01 * k + load / 1e7) for load in LOADS for k in range(4)]
    keys = [(LOAD, "N/m", "values"), (SPEED, "m/s", "values")]
    sweep = rondo.open_sweep(sweeps.write(tmp_path / "sweep", keys, rows, FIGURES))
    says(rondo.Error, sweep.plot_carpet, words=("no grid",))


def test_command(rolling, tmp_path, smooth):
    done = rondo_module("traction", rolling.directory, "-o", tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert {path.stem for path in tmp_path.iterdir()} == {
        f"traction-{FRICTION}", f"traction-{LOAD}", "carpet-0.3", "carpet-0.6"}
    done = rondo_module("traction", smooth)
    assert done.returncode == 2 and "not a sweep" in done.stderr

# SPDX-License-Identifier: BSD-3-Clause
"""Curves and spread of sweeps whose figures are known; members without a value."""
import matplotlib.pyplot as plt
import numpy as np
import pytest
import sweeps
from drawn import crosses, curves, named, said, without_unit
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_rgb
from sweeps import DEPTH, FRICTION, FRICTIONS, HEIGHT, LOAD, MODULUS, SCHEME, SPIN, SPINS
from test_errors import says

import rondo
from rondo import style

TWO = ("symplectic", "as-printed")


@pytest.fixture(autouse=True)
def closed_figures():
    yield
    plt.close("all")


def kilo(sweep, name="force_x_mean"):
    return sweep[name] / 1e3


def test_curves_of_a_grid(grid):
    ax = grid.plot_curves("force_x_mean", SPIN, FRICTION)
    for friction in FRICTIONS:
        drawn = named(ax, f"{friction:g}")
        expected = [kilo(grid)[grid.done & (grid[FRICTION] == friction) & (grid[SPIN] == spin)]
                    for spin in SPINS]
        np.testing.assert_allclose(drawn, [[s, e.mean()] for s, e in zip(SPINS, expected)],
                                   rtol=1e-12, atol=1e-12)
    assert len(curves(ax)) == 3 and ax.get_legend().get_title().get_text() == FRICTION
    band = [c for c in ax.collections if isinstance(c, PolyCollection)][2]  # friction 0.5
    at_40 = band.get_paths()[0].vertices
    assert at_40[at_40[:, 0] == 40, 1].max() == pytest.approx(
        1.01 * sweeps.forces(0.5, 40)["force_x_mean"] / 1e3)
    assert said(ax) == ("horizontal force, mean: 22 of 24 members (2 failed ×); means over "
                        "solver.scheme, bands from least to greatest")
    assert crosses(ax) == [30, 36] and without_unit(ax.figure) == []


def test_a_traction_curve(grid):
    """Over a figure: each member a point, joined where the spin alone leads along the curve."""
    ax = grid.select({SCHEME: TWO[0]}).plot_curves("force_x_mean", "slip_ratio_mean", FRICTION)
    drawn = named(ax, "0.3")
    rows = [sweeps.forces(0.3, spin) for spin in SPINS]
    np.testing.assert_allclose(drawn, [[row["slip_ratio_mean"], row["force_x_mean"] / 1e3]
                                       for row in rows], rtol=1e-12, atol=1e-12)
    assert ax.get_xlabel() == "slip ratio, mean (–)"
    lost = grid.select({SCHEME: TWO[0]}).where(~grid.select({SCHEME: TWO[0]}).done)
    friction, spin = lost[FRICTION].item(), lost[SPIN].item()
    known = [s for s in SPINS if s != spin]  # it has no slip: read off its curve, over the spin
    place = np.interp(spin, known, [sweeps.forces(friction, s)["slip_ratio_mean"] for s in known])
    assert crosses(ax) == [pytest.approx(place)] and "(1 failed ×)" in said(ax)
    broken = named(ax, f"{friction:g}")
    assert np.isnan(broken[:, 1]).tolist() == [s == spin for s in SPINS]  # no line across the gap
    both = grid.plot_curves("force_x_mean", "slip_ratio_mean", FRICTION)
    assert not curves(both)  # of two schemes: points
    assert len({line.get_marker() for line in both.lines if line.get_label() != "_lost"}) == 3


def test_many_curves_are_shades(tmp_path):
    frictions = [0.05 * k for k in range(1, 10)]
    sweep = rondo.open_sweep(sweeps.grid(tmp_path / "x", frictions=frictions))
    ax = sweep.plot_curves("force_x_mean", SPIN, FRICTION)
    assert len(curves(ax)) == 9 and ax.get_legend() is None
    assert ax.figure.axes[1].get_ylabel() == "ground.friction (–)"
    assert len({line.get_color() for line in curves(ax)}) == 9
    for line, friction in zip(curves(ax), frictions):
        assert line.get_ydata()[-1] == pytest.approx(sweeps.forces(friction, 40)["force_x_mean"]
                                                     / 1e3)


def test_curves_over_the_height_of_a_load(loaded):
    ax = loaded.plot_curves("force_y", HEIGHT, FRICTION)
    np.testing.assert_allclose(named(ax, "0.4"), [[0.2854, 300], [0.2904, 200], [0.2954, 100]],
                               rtol=1e-9)
    ax = loaded.plot_curves("depth_m", LOAD)
    line, = curves(ax)
    np.testing.assert_allclose(line.get_xydata(), [[100, 4.8], [200, 9.8], [300, 14.8]])
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("target.force_y (kN/m)", "depth (mm)")


def test_curves_over_texts(grid):
    ax = grid.plot_curves("force_x_mean", SCHEME, FRICTION)
    assert not curves(ax)
    places = sorted({round(x, 6) for line in ax.lines if line.get_label() != "_lost"
                     for x in line.get_xdata()})
    assert places == [-0.08, 0, 0.08, 0.92, 1, 1.08]
    assert "bars from least to greatest" in said(ax)


def test_sampled_curves_are_points(sampled, plane, tmp_path):
    alone = rondo.open_sweep(sweeps.write(tmp_path / "x", [(SPIN, "rad/s", "uniform")], [
        {SPIN: spin, **sweeps.forces(0.3, spin)} for spin in (33.0, 31.0, 38.0)]))
    for sweep, x, members, look in ((sampled, MODULUS, 119, "None"), (plane, SPIN, 60, "None"),
                                    (alone, SPIN, 3, "-")):
        ax = sweep.plot_curves("force_y_mean", x)
        points, = (line for line in ax.lines if line.get_label() != "_lost")
        assert (points.get_linestyle(), len(points.get_xdata())) == (look, members)


def test_curves_that_cannot_be(grid, sampled, tmp_path):
    says(rondo.Error, grid.plot_curves, "force_x_mean", SPIN, SPIN, words=["choose another"])
    says(rondo.Error, sampled.plot_curves, "force_y_mean", MODULUS, DEPTH,
         words=[f"{DEPTH} has another value in each member", "plot_map"])
    says(rondo.Error, grid.plot_curves, "force_y_mean", SPIN, "slip_ratio_mean",
         words=["slip_ratio_mean has another value"])
    seven = rondo.open_sweep(sweeps.grid(tmp_path / "x", schemes="abcdefg"))
    says(rondo.Error, seven.plot_curves, "force_y_mean", SPIN, SCHEME,
         words=["7 values; at most 6 curves", "select()"])
    says(rondo.UnknownNameError, grid.plot_curves, "force_x_mean", SPIN, "friction")


def test_spread(grid):
    ax = grid.plot_spread(["force_y_mean", "friction_power"])
    values = grid["friction_power"][grid.done]
    dots = [line for line in ax.lines if line.get_marker() == "."]
    np.testing.assert_allclose(dots[1].get_xdata(), values / np.median(values), rtol=1e-12)
    assert np.abs(dots[1].get_ydata() - 1).max() <= 0.25  # in its row
    labels = [text.get_text() for text in ax.get_yticklabels()]
    median = np.median(values) / 1e3
    assert labels[1] == f"power of friction\nmedian {median:.4g} kW/m, n = 22"
    assert said(ax) == "22 of 24 members (2 failed)"
    assert ax.get_ylim() == (1.5, -0.5)
    medians = [line for line in ax.lines if to_rgb(line.get_color()) == to_rgb(style.VERMILLION)]
    for line in medians:
        np.testing.assert_allclose(line.get_xdata(), 1.0)
    box = max((line.get_xydata() for line in ax.lines if len(line.get_xdata()) == 5), key=np.ptp)
    np.testing.assert_allclose([box[:, 0].min(), box[:, 0].max()],
                               np.quantile(values, [0.25, 0.75]) / np.median(values))


def test_what_has_no_spread_relative_to_its_median(grid, loaded):
    ax = grid.plot_spread()
    assert "left out, with both signs or a median near zero: force_x_mean," in said(ax)
    assert "force_y_fluctuation" not in said(ax)
    assert len(ax.get_yticks()) == 10
    assert "left out" in said(loaded.plot_spread())
    says(rondo.Error, loaded.plot_spread, ["torque"],
         words=["torque: with both signs", "no spread"])
    says(rondo.Error, loaded.plot_spread, [], words=["no figures to draw"])
    says(rondo.UnknownNameError, loaded.plot_spread, ["force"], words=["no figure 'force'"])
    assert loaded.plot_spread("force_y").get_yticks().tolist() == [0]


def test_scales_of_spread(grid):
    values = np.logspace(0, 3, 24)
    far = grid.with_figure("far", values, "1").plot_spread(["far"])
    assert far.get_xscale() == "log"
    ends = [x for line in far.lines if len(line.get_xdata()) == 2 for x in line.get_xdata()]
    assert max(ends) == pytest.approx(1000 / np.median(values[grid.done]))  # not outliers left out
    label, = far.get_yticklabels()
    assert label.get_text().endswith("n = 22")  # a value of a member that failed is none
    same = grid.with_figure("same", np.full(24, 7.0), "1").plot_spread(["same"])
    assert same.get_xlim() == (0.999, 1.001)


def test_members_without_a_value(grid, tmp_path):
    """Done, but for one figure: counted and marked, not drawn."""
    values = grid["force_y_mean"].copy()
    values[0] = np.nan
    sweep = grid.with_figure("own", values, "N/m")
    figure = sweep.plot_main_effects("own")
    assert said(figure).startswith("own: 21 of 24 members (2 failed ×, 1 without a value ×)")
    assert crosses(figure.axes[0]) == [0.1, 0.1, 0.5]
    none = grid.with_figure("none", np.full(24, np.nan), "1")
    for draw in (none.plot_main_effects, lambda name: none.plot_map(name, SPIN, FRICTION),
                 lambda name: none.plot_curves(name, SPIN)):
        says(rondo.Error, draw, "none", words=["none of 24 members is done with a value of none"])
    directory = sweeps.grid(tmp_path / "x", failed=range(1, 13))
    says(rondo.Error, rondo.open_sweep(directory).plot_spread, words=["none of 12 members is done"])
    alone = grid.where(grid["run"] == 1)
    says(rondo.Error, alone.plot_main_effects, "force_y_mean", words=["no parameter differs"])


def test_members_that_wait(tmp_path):
    def waiting(row):
        if row[FRICTION] > 0.4:
            row["status"] = "waiting"

    directory = sweeps.grid(tmp_path / "x", change=waiting, status="running")
    figure = rondo.open_sweep(directory, unfinished=True).plot_main_effects("force_y_mean")
    assert "8 of 12 members (4 waiting);" in said(figure)
    assert crosses(figure.axes[0]) == []


def test_given_axes(grid):
    figure, axes = plt.subplots(1, 3)
    assert grid.plot_map("force_x_mean", SPIN, FRICTION, ax=axes[0]) is axes[0]
    assert grid.plot_curves("force_x_mean", SPIN, FRICTION, ax=axes[1]) is axes[1]
    assert grid.plot_spread(["force_y_mean"], ax=axes[2]) is axes[2]
    assert len(plt.get_fignums()) == 1

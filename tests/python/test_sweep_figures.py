# SPDX-License-Identifier: BSD-3-Clause
"""What the figures of a sweep show, of tables whose figures are known."""
import matplotlib.pyplot as plt
import numpy as np
import pytest
import sweeps
from drawn import curves, named, without_unit
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PathCollection, PolyCollection, QuadMesh
from matplotlib.colors import to_rgb
from sweeps import DEPTH, FRICTION, FRICTIONS, HEIGHT, LOAD, MODULUS, SCHEME, SPIN, SPINS
from test_errors import says

import rondo
from rondo import style
from rondo.plots.sweep_effects import by_bin

TWO = ("symplectic", "as-printed")


@pytest.fixture(autouse=True)
def closed_figures():
    yield
    plt.close("all")


@pytest.fixture
def grid(studies):
    """Friction by spin by scheme, 24 members, the 5th and the 18th failed."""
    return rondo.open_sweep(studies / "grid")


@pytest.fixture
def sampled(studies):
    """A Latin hypercube of 120 members, the 7th failed."""
    return rondo.open_sweep(studies / "sampled")


@pytest.fixture
def loaded(studies):
    """Crushes to three loads with two frictions."""
    return rondo.open_sweep(studies / "loaded")


def kilo(sweep, name="force_x_mean"):
    return sweep[name] / 1e3


def said(figure_or_axes):
    """The title, in one line."""
    title = (figure_or_axes.get_title() if isinstance(figure_or_axes, Axes)
             else figure_or_axes._suptitle.get_text())
    return title.replace("\n", " ")


def crosses(ax):
    """x of the crosses of members without a value."""
    marks, = (line for line in ax.lines if line.get_label() == "_lost")
    assert marks.get_marker() == "x" or not len(marks.get_xdata())
    return sorted(marks.get_xdata())


def means_and_bars(ax):
    line, = (line for line in ax.lines if line.get_label() == "mean")
    bars, = (c for c in ax.collections if isinstance(c, LineCollection))
    ends = np.array([segment[:, 1] for segment in bars.get_segments()]).reshape(-1, 2)
    return line.get_xydata(), ends


def test_main_effects_of_a_grid(grid):
    figure = grid.plot_main_effects("force_x_mean")
    assert without_unit(figure) == ["axes 2, x: 'solver.scheme'"]  # names, not numbers
    by_friction, by_spin, by_scheme = figure.axes
    for ax, name in (by_friction, FRICTION), (by_spin, SPIN):
        points, bars = means_and_bars(ax)
        values = np.unique(grid[name])
        for value, point, bar in zip(values, points, bars, strict=True):
            members = kilo(grid)[grid.done & (grid[name] == value)]
            np.testing.assert_allclose(point, [value, members.mean()], rtol=1e-12)
            np.testing.assert_allclose(bar, [members.min(), members.max()], rtol=1e-12)
    points, _ = means_and_bars(by_scheme)
    for place, scheme in enumerate(TWO):
        mean = kilo(grid)[grid.done & (grid[SCHEME] == scheme)].mean()
        np.testing.assert_allclose(points[place], [place, mean], rtol=1e-12)
    assert [text.get_text() for text in by_scheme.get_xticklabels()] == list(TWO)
    assert not curves(by_scheme) or all(len(c.get_xdata()) == 2 for c in curves(by_scheme))
    assert crosses(by_friction) == [0.1, 0.5] and crosses(by_spin) == [30, 36]
    assert said(figure) == ("horizontal force, mean: 22 of 24 members (2 failed ×); means over the "
                            "other parameters, bars from least to greatest")
    assert by_friction.get_xlabel() == "ground.friction (–)"
    assert by_friction.get_ylabel().replace("\n", " ") == "horizontal force, mean (kN/m)"
    assert by_spin.get_shared_y_axes().joined(by_spin, by_friction)
    level = next(line for line in by_spin.lines if len(set(line.get_ydata())) == 1
                 and line.get_label() != "_lost")
    assert level.get_ydata()[0] == pytest.approx(kilo(grid)[grid.done].mean())


def test_main_effects_of_one_parameter(grid):
    figure = grid.select({FRICTION: 0.3, SCHEME: "symplectic"}).plot_main_effects("force_y_mean")
    ax, = figure.axes
    points, bars = means_and_bars(ax)
    np.testing.assert_allclose(points[:, 1], [sweeps.forces(0.3, spin)["force_y_mean"] / 1e3
                                              for spin in SPINS], rtol=1e-12)
    assert said(figure) == "vertical force, mean: 4 members" and ax.get_title(loc="left") == ""
    assert [tick.get_text() for tick in ax.get_xticklabels()] == ["30", "33", "36", "40"]


def test_main_effects_of_sampled_parameters(sampled):
    figure = sampled.plot_main_effects("force_y_mean")
    assert without_unit(figure) == []
    for ax, name, factor in zip(figure.axes, (FRICTION, MODULUS, DEPTH), (1, 1e-6, 1e3),
                                strict=True):
        members, = (line for line in ax.lines if line.get_label() == "members")
        np.testing.assert_allclose(members.get_xydata(), np.column_stack(
            [sampled[name] * factor, kilo(sampled, "force_y_mean")])[sampled.done], rtol=1e-12)
        np.testing.assert_allclose(crosses(ax), [sampled[name][6] * factor])
    points, bars = means_and_bars(figure.axes[1])
    order = np.argsort(sampled[MODULUS][sampled.done])
    first = kilo(sampled, "force_y_mean")[sampled.done][order[:12]]  # 119 members in 10 groups
    assert len(points) == 10
    assert points[0, 1] == pytest.approx(first.mean())
    assert np.ptp(bars[0]) == pytest.approx(4 * first.std(ddof=1) / np.sqrt(12))
    assert said(figure).endswith("bars twice the standard error")
    assert figure.axes[1].get_xlabel().replace("\n", " ") == "material.youngs_modulus (MPa)"


def test_means_of_neighbours():
    x = np.random.default_rng(3).permutation(40) * 0.1
    level = by_bin(x, 5 * x + 1)
    np.testing.assert_allclose(level.mean, 5 * level.at + 1)
    np.testing.assert_allclose(level.at, [0.45, 1.45, 2.45, 3.45])
    assert all(len(numbers) == 0 for numbers in vars(by_bin(x[:19], x[:19])).values())


def test_a_scale_of_powers(tmp_path):
    sweep = rondo.open_sweep(sweeps.grid(tmp_path / "x", frictions=(0.01, 0.03, 0.1, 0.3, 1.0)))
    figure = sweep.plot_main_effects("force_x_mean")
    assert [ax.get_xscale() for ax in figure.axes] == ["log", "linear"]
    ax = sweep.plot_map("force_x_mean", SPIN, FRICTION)
    edges = ax.collections[0].get_coordinates()[:, 0, 1]
    np.testing.assert_allclose(edges[1:-1], np.sqrt([3e-4, 3e-3, 3e-2, 0.3]), rtol=1e-12)
    np.testing.assert_allclose(edges[1:3] ** 2, edges[:2] * edges[2:4], rtol=0.2)


def test_many_panels(tmp_path):
    keys = ["a", "b", "c", "d"]
    rows = [{key: float(k >> bit & 1) for bit, key in enumerate(keys)} | sweeps.forces(0.3, 30 + k)
            for k in range(16)]
    sweep = rondo.open_sweep(sweeps.write(tmp_path / "x", [(k, "kg/m3", "values") for k in keys],
                                          rows))
    figure = sweep.plot_main_effects("force_y_mean")
    assert [ax.get_title(loc="left") for ax in figure.axes] == ["(a)", "(b)", "(c)", "(d)"]
    assert figure.axes[3].get_xlabel() == "d (kg/m³)"
    assert figure.axes[0].get_subplotspec().get_gridspec().get_geometry() == (2, 2)


def test_a_map_of_a_grid(grid):
    ax = grid.plot_map("force_x_mean", SPIN, FRICTION)
    cells, = (c for c in ax.collections if isinstance(c, QuadMesh))
    colours = np.ma.reshape(cells.get_array(), (3, 4))
    for i, friction in enumerate(FRICTIONS):
        for j, spin in enumerate(SPINS):
            members = grid.done & (grid[FRICTION] == friction) & (grid[SPIN] == spin)
            assert colours[i, j] == pytest.approx(kilo(grid)[members].mean(), rel=1e-12)
    corners = cells.get_coordinates()
    np.testing.assert_allclose(corners[0, :, 0], [28.5, 31.5, 34.5, 38, 42])
    np.testing.assert_allclose(corners[:, 0, 1], [0, 0.2, 0.4, 0.6], atol=1e-12)
    low, high = cells.get_clim()
    assert cells.get_cmap().name == style.DIVERGING.name and low == -high
    assert said(ax) == ("horizontal force, mean: 22 of 24 members (2 failed ×); mean over "
                        "solver.scheme")
    assert without_unit(ax.figure) == []
    assert ax.figure.axes[1].get_ylabel() == "horizontal force, mean (kN/m)"
    assert crosses(ax) == [30, 36]


def test_cells_without_a_value(grid):
    ax = grid.select({SCHEME: TWO[0]}).plot_map("force_y_mean", SPIN, FRICTION)
    cells, = (c for c in ax.collections if isinstance(c, QuadMesh))
    empty = np.ma.getmaskarray(np.ma.reshape(cells.get_array(), (3, 4)))
    assert np.argwhere(empty).tolist() == [[0, 2]]  # the 5th: friction 0.1, spin 36
    assert cells.get_cmap().name == style.SEQUENTIAL.name
    assert crosses(ax) == [36] and "mean over" not in said(ax)
    assert len(set(to_rgb(ax.get_facecolor()))) == 1  # grey


def test_a_map_with_texts(grid):
    ax = grid.plot_map("force_y_mean", SCHEME, FRICTION)
    assert [text.get_text() for text in ax.get_xticklabels()] == list(TWO)
    assert ax.get_xlim() == (-0.5, 1.5)
    assert said(ax).endswith("; mean over motion.angular_velocity")


def test_a_map_of_sampled_parameters(sampled):
    ax = sampled.plot_map("force_y_mean", MODULUS, DEPTH)
    dots, = (c for c in ax.collections if isinstance(c, PathCollection))
    expected = np.column_stack([sampled[MODULUS] / 1e6, sampled[DEPTH] * 1e3])[sampled.done]
    np.testing.assert_allclose(dots.get_offsets(), expected)
    np.testing.assert_allclose(dots.get_array(), kilo(sampled, "force_y_mean")[sampled.done])
    cells, = (c for c in ax.collections if isinstance(c, QuadMesh))
    corners, colours = cells.get_coordinates(), cells.get_array()
    means = np.ma.reshape(colours, tuple(n - 1 for n in corners.shape[:2]))
    assert means.shape == (5, 5)  # 119 members, four or more in each in the mean
    x, y = corners[0, :, 0], corners[:, 0, 1]
    inside = ((expected[:, 0] >= x[1]) & (expected[:, 0] < x[2])
              & (expected[:, 1] >= y[3]) & (expected[:, 1] < y[4]))
    assert means[3, 1] == pytest.approx(dots.get_array()[inside].mean())
    assert said(ax).endswith("(1 failed ×); cells: means of the members in them")
    assert without_unit(ax.figure) == []


def test_contours(tmp_path):
    places = [(0.1 + 0.8 * np.mod(0.618 * k, 1.0), 30 + 10 * (k + 0.5) / 60) for k in range(60)]
    rows = [{FRICTION: a, SPIN: b, **sweeps.forces(a, b)} for a, b in places]
    for row in rows:
        row["force_y_mean"] = 1e6 * row[FRICTION] + 1e4 * row[SPIN]  # a plane: exact contours
    sweep = rondo.open_sweep(sweeps.write(
        tmp_path / "x", [(FRICTION, "-", "uniform"), (SPIN, "rad/s", "uniform")], rows))
    ax = sweep.plot_map("force_y_mean", SPIN, FRICTION)
    paths = [path.vertices for c in ax.collections for path in c.get_paths()
             if (c.get_array() is None or len(c.get_array()) < 60) and len(path.vertices)]
    assert len(paths) > 5 and "linear between members" in said(ax)
    assert without_unit(ax.figure) == []
    step = 0.08  # MN/m, of the round levels
    for path in paths:
        values = (path[:, 1] + 1e-2 * path[:, 0]) / step
        assert values.max() <= np.floor(values.min() + 1e-9) + 1 + 1e-9  # of one band
    line = sweep.where(np.arange(60) < 9).plot_map("force_y_mean", SPIN, FRICTION)
    assert "cells" in said(line)  # too few


def test_a_map_that_cannot_be(grid, loaded):
    says(rondo.Error, grid.plot_map, "force_x_mean", SPIN, SPIN, words=["was given twice"])
    says(rondo.Error, grid.select({FRICTION: 0.3}).plot_map, "force_x_mean", SPIN, FRICTION,
         words=["ground.friction is 0.3 in all members", "choose another"])
    says(rondo.UnknownNameError, grid.plot_map, "force", SPIN, FRICTION,
         words=["no figure 'force'", "force_x_mean, "])
    says(rondo.UnknownNameError, grid.plot_map, "force_x_mean", "x", FRICTION,
         words=["no column 'x'"])
    says(rondo.Error, grid.plot_map, SCHEME, SPIN, FRICTION, words=["is no figure, but a text"])


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
    assert crosses(ax) == [] and "(1 failed)" in said(ax)  # it has no slip at which to mark it
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


def test_sampled_curves_are_points(sampled):
    ax = sampled.plot_curves("force_y_mean", MODULUS)
    points, = (line for line in ax.lines if line.get_label() != "_lost")
    assert points.get_linestyle() == "None" and len(points.get_xdata()) == 119


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
    far = grid.with_figure("far", np.logspace(0, 3, 24), "1").plot_spread(["far"])
    assert far.get_xscale() == "log"
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

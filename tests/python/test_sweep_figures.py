# SPDX-License-Identifier: BSD-3-Clause
"""Main effects and maps of sweeps whose figures are known."""
import matplotlib.pyplot as plt
import numpy as np
import pytest
import sweeps
from drawn import crosses, said, without_unit
from matplotlib.collections import LineCollection, PathCollection, QuadMesh
from matplotlib.colors import to_rgb
from sweeps import DEPTH, FRICTION, FRICTIONS, MODULUS, SCHEME, SPIN, SPINS
from test_errors import says

import rondo
from rondo import style
from rondo.plots.sweep_effects import by_bin

TWO = ("symplectic", "as-printed")


@pytest.fixture(autouse=True)
def closed_figures():
    yield
    plt.close("all")


def kilo(sweep, name="force_x_mean"):
    return sweep[name] / 1e3


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
    joined = [line.get_linestyle() for ax in figure.axes for line in ax.lines
              if line.get_label() == "mean"]
    assert joined == ["-", "-", "None"]
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


def test_contours(plane):
    """Of a plane they are exact."""
    ax = plane.plot_map("force_y_mean", SPIN, FRICTION)
    paths = [path.vertices for c in ax.collections for path in c.get_paths()
             if (c.get_array() is None or len(c.get_array()) < 60) and len(path.vertices)]
    assert len(paths) > 5 and "linear between members" in said(ax)
    assert without_unit(ax.figure) == []
    step = 0.08  # MN/m, of the round levels
    for path in paths:
        values = (path[:, 1] + 1e-2 * path[:, 0]) / step
        assert values.max() <= np.floor(values.min() + 1e-9) + 1 + 1e-9  # of one band
    few = plane.where(np.arange(60) < 9).plot_map("force_y_mean", SPIN, FRICTION)
    assert "cells" in said(few)


def test_a_map_that_cannot_be(grid, loaded):
    says(rondo.Error, grid.plot_map, "force_x_mean", SPIN, SPIN, words=["was given twice"])
    says(rondo.Error, grid.select({FRICTION: 0.3}).plot_map, "force_x_mean", SPIN, FRICTION,
         words=["ground.friction is 0.3 in all members", "choose another"])
    says(rondo.UnknownNameError, grid.plot_map, "force", SPIN, FRICTION,
         words=["no figure 'force'", "force_x_mean, "])
    says(rondo.UnknownNameError, grid.plot_map, "force_x_mean", "x", FRICTION,
         words=["no column 'x'"])
    says(rondo.Error, grid.plot_map, SCHEME, SPIN, FRICTION, words=["is no figure, but a text"])

# SPDX-License-Identifier: BSD-3-Clause
"""The footprint of steady rolling, and what other figures its runs have."""
import matplotlib.pyplot as plt
import numpy as np
import pytest
from conftest import SMALL, TREADED, ok
from drawn import curves, said
from matplotlib.colors import to_rgb
from test_cli import rondo_module
from test_errors import says

import rondo
from rondo import style
from rondo.figures.run_figures import draw_run, fields, pass_forces
from rondo.plots.footprint import footprint_of

STEADY = ["analysis.kind=steady-rolling", "motion.height=0.29", "ground.profile=flat",
          "analysis.accept_scheme_power=true"]  # the meshes are coarse, and powers do not matter here


@pytest.fixture(autouse=True)
def closed_figures():
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def steady(tmp_path_factory):
    """The runs `smooth`, `treaded`, `back`, which rolls to the left, and `slides`, which slips as a
    whole."""
    folder = tmp_path_factory.mktemp("steady")
    (folder / "case.toml").write_text(SMALL)
    (folder / "treaded.toml").write_text(TREADED)
    for name, case, more in (("smooth", "case", []), ("treaded", "treaded", []),
                             ("back", "treaded", ["motion.speed=-10", "motion.angular_velocity=-33.3"]),
                             ("slides", "case", ["motion.speed=20"])):
        ok("run", folder / f"{case}.toml", "-o", folder / name,
           *(part for setting in STEADY + more for part in ("--set", setting)))
    return {name: rondo.open(folder / name) for name in ("smooth", "treaded", "back", "slides")}


def line(ax, colour):
    found = [c for c in curves(ax) if to_rgb(c.get_color()) == to_rgb(colour)]
    return np.concatenate([c.get_xydata() for c in found]), len(found)


def test_folds_the_places_of_a_sector(steady):
    run = steady["smooth"]
    found, rows = footprint_of(run), run.contact.rows
    assert len(found.place) == len(rows["node"]) and (np.diff(found.place) > 0).all()
    spacing = np.diff(found.place)
    assert found.spacing == pytest.approx(np.median(spacing), rel=0.2)
    widths = {pair[:2]: pair[2] for pair in zip(rows["pressure_pa"], rows["shear_pa"], rows["length_m"])}
    width = np.array([widths[pair] for pair in zip(found.pressure, -found.shear)])
    places = run.n_snapshots
    assert (found.pressure * width).sum() / places == pytest.approx(run.steady["force_y"], rel=1e-10)
    assert (found.shear * width).sum() / places == pytest.approx(run.steady["force_x"], rel=1e-10)
    slides = ~found.sticks
    assert (found.shear[slides] * found.slip[slides] <= 1e-12).all()  # friction is against the slip
    assert np.abs(found.slip[found.sticks]).max() < 1e-9


@pytest.mark.parametrize("name, lines", [("smooth", 1), ("treaded", 3)])
def test_the_picture(steady, name, lines):
    run = steady[name]
    figure = run.plot_footprint()
    axes = figure.axes
    above, below = axes[:lines], axes[lines:]  # a column for each contact node of a sector
    assert len(axes) == 2 * lines
    found, factor = footprint_of(run), 1e-6 if "MPa" in above[0].get_ylabel() else 1e-3
    for row, colour, values in ((above, style.BLUE, factor * found.pressure),
                                (above, style.VERMILLION, factor * found.shear),
                                (below, style.VERMILLION, found.slip)):
        assert [line(ax, colour)[1] for ax in row] == [1] * lines
        drawn = np.concatenate([line(ax, colour)[0] for ax in row])
        order = np.lexsort((drawn[:, 1], drawn[:, 0]))
        expected = np.stack([1e3 * found.place, values], axis=1)
        expected = expected[np.lexsort((expected[:, 1], expected[:, 0]))]
        np.testing.assert_allclose(drawn[order], expected, rtol=1e-9, atol=1e-12)
    assert said_below(figure) == [f"within ± μp, μ = {run.friction:g}", "pressure p",
                                  "shear, > 0 pushes along +x", "sticks"]
    assert figure._supxlabel.get_text().endswith("(mm), rolls to the right")
    assert above[0].get_ylabel().endswith("Pa)") and below[0].get_ylabel() == "slip velocity (m/s)"
    assert f"{run.steady['force_y'] / 1e3:.4g} kN/m" in said(figure).replace("−", "-")


def said_below(figure):
    """Of the legend, below the title."""
    legend, = figure.legends
    return [text.get_text() for text in legend.get_texts()]


@pytest.mark.parametrize("name", ["treaded", "back"])
def test_nodes_of_a_pitch_from_leading_to_trailing(steady, name):
    """As they come to the ground: the leading one touches furthest ahead."""
    run = steady[name]
    figure = run.plot_footprint()
    titles = [ax.get_title() for ax in figure.axes[:3]]
    assert titles == ["node 1 of 3, leading", "node 2 of 3", "node 3 of 3, trailing"]
    ahead = [np.sign(run.spin) * line(ax, style.BLUE)[0][:, 0] for ax in figure.axes[:3]]
    assert max(ahead[0]) > max(ahead[2])
    assert ("rolls to the right" if run.spin > 0 else "rolls to the left") in (
        figure._supxlabel.get_text())


def test_what_slides_has_no_stick(steady):
    figure = steady["slides"].plot_footprint()
    assert "sticks" not in said_below(figure) and not footprint_of(steady["slides"]).sticks.any()


def test_means_are_over_places(steady):
    """Not over intervals: the first place is at the time 0, and counts as the others."""
    run = steady["treaded"]
    for name in ("force_x", "force_y"):
        assert run.history.mean(name) == pytest.approx(run.steady[name], rel=1e-12)


def test_other_runs(smooth, steady):
    run = rondo.open(smooth)
    says(rondo.Error, run.plot_footprint, words=("plot_contact(time)", "steady-rolling"))
    says(rondo.Error, lambda: run.steady, words=("no steady rolling", "dynamic"))
    says(rondo.Error, steady["smooth"].plot_energy, words=("powers",))
    says(rondo.Error, steady["smooth"].plot_spectrum, words=("no course in time",))


def test_figures(steady, tmp_path, monkeypatch):
    drawn = []
    monkeypatch.setattr(style, "save", lambda figure, path: drawn.append(path.name) or [path])
    draw_run(steady["smooth"], tmp_path)
    assert drawn == ["field-displacement", "field-von_mises", "footprint"]
    drawn.clear()
    run = steady["treaded"]
    for ax, column in zip(pass_forces(run).axes, ("force_y", "force_x")):
        low, high = 1e3 * np.array(ax.get_ylim())
        ripple = np.ptp(run.history[column])
        assert high - low < 1.2 * ripple  # not from 0
    assert fields(run, "displacement").axes[0].get_title() == "place 1 of 16"
    draw_run(run, tmp_path)
    assert drawn == ["field-displacement", "field-von_mises", "footprint", "forces"]


def test_command(steady, smooth, tmp_path):
    done = rondo_module("footprint", steady["smooth"].directory, "-o", tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert {path.name for path in tmp_path.iterdir()} == {
        "footprint.png", "footprint.svg", "wear.csv", "wear.png", "wear.svg"}
    done = rondo_module("footprint", smooth, "-o", tmp_path)
    assert done.returncode == 2 and "steady-rolling" in done.stderr

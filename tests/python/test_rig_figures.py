# SPDX-License-Identifier: BSD-3-Clause
"""Figures of a rig: one for each test that has data, with the numbers of its tables and runs, and words for what cannot
be drawn."""
import shutil

import matplotlib.pyplot as plt
import numpy as np
import pytest
import rigs

import rondo
from rondo.data.tir import write_tir
from rondo.rig import against, figures
from rondo.rig.trends import trends

SETTINGS = {"friction": 1.0, "load": rigs.LOAD, "pressure": rigs.PRESSURE}


@pytest.fixture(scope="module", autouse=True)
def many_at_once():
    """Tests keep all figures of a rig."""
    with plt.rc_context({"figure.max_open_warning": 0}):
        yield


@pytest.fixture(scope="module")
def rig(tmp_path_factory):
    folder = tmp_path_factory.mktemp("figures") / "rig"
    rigs.write(folder, rigs.all_tests() | rigs.tests_with_runs(folder), settings=SETTINGS)
    write_tir(folder / "tyre.tir", rigs.truth())
    return rondo.open_rig(folder)


@pytest.fixture(scope="module")
def drawn(rig):
    """By name."""
    found = {one.name: one for one in figures.figures_of(rig)}
    yield found
    for one in found.values():
        plt.close(one.figure)


def curves(figure, panel):
    """Lines of a panel with more than two points, as (x, y)."""
    return [(line.get_xdata(), line.get_ydata()) for line in figure.axes[panel].lines if len(line.get_xdata()) > 2]


def test_each_test_has_its_figures(drawn):
    assert {one.test for one in drawn.values()} == {
        "vertical", "footprint", "lateral", "longitudinal", "combined", "rolling-resistance", "relaxation", "cleat", "road", "modes"}
    assert {"vertical", "footprint", "footprint-size", "cornering-stiffness", "slip-stiffness", "lateral-load", "lateral-camber",
            "lateral-pressure", "longitudinal-load", "combined-4kN", "rolling-resistance-speed", "rolling-resistance-load",
            "relaxation", "relaxation-length", "cleat", "road", "modes"} <= set(drawn)
    assert not any("not drawn" in one.words or "$" in one.words for one in drawn.values())


def test_stiffnesses_that_the_rig_does_not_know_are_not_drawn_by_larger_slips(tmp_path):
    tests = {name: rigs.all_tests()[name] for name in ("vertical", "lateral", "longitudinal")}
    folder = rigs.write(tmp_path / "rig", tests, more={
        "longitudinal": {"figures": {"slip_stiffness": []}},
        "lateral": {"figures": {"cornering_stiffness": [], "pneumatic_trail": []}}}, settings=SETTINGS)
    found = rondo.open_rig(folder)
    names = {one.name for one in figures.figures_of(found)}
    plt.close("all")
    assert next(one for one in trends(found) if "Cornering" in one.name).holds is None
    assert "longitudinal-load" in names and not {"slip-stiffness", "cornering-stiffness"} & names


def test_axes_have_units_and_forces_name_their_axes(drawn):
    for one in drawn.values():
        for ax in one.figure.axes:
            labels = [text for text in (ax.get_xlabel(), ax.get_ylabel()) if text]
            for text in labels:
                assert "(" in text or "mode" in text or "waves" in text, (one.name, text)
    for name in ("lateral-load", "longitudinal-load", "combined-4kN", "cornering-stiffness"):
        assert "ISO 8855" in drawn[name].words


def test_points_and_the_fitted_curve_agree(drawn):
    """Of the 4 kN curve: the points lie on it."""
    lines = curves(drawn["lateral-load"].figure, 0)
    for points, fitted in zip(lines[::2], lines[1::2]):
        assert len(points[0]) == 13 and len(fitted[0]) > 100
        assert np.abs(np.interp(points[0], *fitted) - points[1]).max() < 0.01 * np.abs(points[1]).max()


def test_radial_and_cornering_stiffness(drawn):
    """By the formulas that the points are of."""
    loads, slopes = curves(drawn["vertical"].figure, 1)[1]
    wanted = 1e-3 * np.sqrt(rigs.SOFT ** 2 + 4 * rigs.STIFF * 1e3 * loads)
    assert slopes[1:-1] == pytest.approx(wanted[1:-1], rel=1e-3)
    loads, stiffness = curves(drawn["cornering-stiffness"].figure, 0)[1]
    exact = -1e-3 * np.radians(rondo.magic_formula.evaluate(rigs.truth(), load=1e3 * loads, pressure=rigs.PRESSURE).cornering_stiffness)
    assert stiffness == pytest.approx(exact, rel=0.05)


def test_relaxation_passes_its_length(drawn):
    """63.2 % of the change at .4 m for the slip angle, .2 m for the slip ratio, both at 4 kN."""
    for panel, length in ((0, 0.4), (1, 0.2)):
        x, y = curves(drawn["relaxation"].figure, panel)[1]
        assert np.interp(length, x, y) == pytest.approx(63.2, abs=0.1)
    x, y = curves(drawn["relaxation-length"].figure, 0)[0]
    assert np.interp(4.0, x, y) == pytest.approx(0.4)


def test_forces_over_a_cleat_and_their_spectra(drawn):
    """The cleat is 1 m ahead, at any speed; forces swing at 35 and 80 Hz."""
    figure = drawn["cleat"].figure
    for panel, frequency in ((0, 35.0), (1, 80.0)):
        for x, y in curves(figure, panel):
            assert np.ptp(y[x < 1.0]) < 1e-9 and x[np.argmax(np.abs(y - y[0]))] < 1.4
        for x, y in curves(figure, panel + 2):
            assert x[np.argmax(y)] == pytest.approx(frequency, abs=3.0) and x.max() <= 250.0
    assert figure.axes[1].lines[0].get_ydata().max() == pytest.approx(4.9, abs=0.1)  # kN


def test_courses_begin_at_the_cleat(tmp_path):
    """Half a radius before its edge, which is at 2 m: what the wheel does before is left out."""
    row = rigs.tests_with_runs(tmp_path / "rig")["cleat"][0]
    case = tmp_path / "rig" / row["run"] / "case.toml"
    case.write_text(case.read_text().replace('"flat"', "[[-10.0, 0.0], [2.0, 0.0], [2.01, 0.01], [2.1, 0.01], [2.11, 0.0], [9.0, 0.0]]"))
    rigs.write(tmp_path / "rig", {"cleat": [row]}, settings=SETTINGS)
    one, = figures.figures_of(rondo.open_rig(tmp_path / "rig"))
    plt.close(one.figure)
    x, _ = curves(one.figure, 0)[0]
    assert x[0] == pytest.approx(-0.15, abs=0.01) and x[-1] == pytest.approx(8.0 * 0.4 - 2.0)


def test_road_has_densities(drawn, rig):
    """Their integral is the mean square, but for the windows, which see a short swing unevenly."""
    x, y = curves(drawn["road"].figure, 3)[0]
    square = np.var(rondo.open(rig.directory / "runs/course-8").history["force_y"])
    assert 0.4 < np.sum(y) * (x[1] - x[0]) / square < 2.5
    assert x[np.argmax(y)] == pytest.approx(80.0, abs=8.0) and "N²/Hz" in drawn["road"].figure.axes[3].get_ylabel()


def test_modes_free_and_standing(drawn):
    figure = drawn["modes"].figure
    assert [ax.get_xlabel() for ax in figure.axes] == ["waves around the free wheel", "mode of the standing wheel", "frequency (Hz)"]
    x, y = curves(figure, 0)[1]
    assert list(x) == list(range(1, 9)) and y[0] == pytest.approx(77.0)
    assert curves(figure, 2)[0][1].max() == pytest.approx(3.6)  # %


def test_rolling_resistance(drawn):
    loads, force = curves(drawn["rolling-resistance-load"].figure, 0)[1]
    my = rondo.magic_formula.evaluate(rigs.truth(), load=1e3 * loads, pressure=rigs.PRESSURE, speed=16.7).My
    assert force == pytest.approx(-my / rigs.RADIUS)


def test_the_friction_circle_and_footprints(drawn):
    assert drawn["combined-4kN"].figure.axes[0].patches[0].get_radius() == pytest.approx(4.0)
    maps = [ax for ax in drawn["footprint"].figure.axes if ax.get_xlabel()]
    assert [ax.get_title().split("\n")[0] for ax in maps] == [
        "2 kN, γ = 0°", "4 kN, γ = 0°", "6 kN, γ = 0°", "4 kN, γ = 3.44°"]


def test_combined_points_are_joined_along_the_slip(tmp_path):
    """Without tyre.tir. At no slip angle F_x falls behind its peak, and the curve goes back."""
    tests = {name: rows for name, rows in rigs.all_tests().items() if name in ("combined", "longitudinal")}
    one = next(one for one in figures.figures_of(rondo.open_rig(rigs.write(tmp_path / "rig", tests)))
               if one.name == "combined-4kN")
    plt.close("all")
    x, _ = curves(one.figure, 0)[2]
    slip, along = curves(one.figure, 1)[2]
    assert (np.diff(slip) > 0).all() and (np.diff(x) < 0).any() and x == pytest.approx(along)


def test_missing_runs_are_told(rig, tmp_path):
    """The rest is drawn."""
    folder = shutil.copytree(rig.directory, tmp_path / "rig")
    for name in ("upright", "slip-angle-4000", "course-8"):
        shutil.rmtree(folder / "runs" / name)
    (folder / "runs/slip-ratio-2000/slip-step.csv").unlink()
    found = {one.name: one for one in figures.figures_of(rondo.open_rig(folder)) if one.test in ("footprint", "relaxation", "cleat")}
    plt.close("all")
    assert "3 runs are not drawn: runs/upright: no such directory" in found["footprint"].words
    assert "2 runs are not drawn: runs/slip-angle-4000: no such" in found["relaxation"].words
    assert "One run is not drawn: runs/course-8" in found["cleat"].words
    assert len([ax for ax in found["footprint"].figure.axes if ax.get_xlabel()]) == 1
    assert len(curves(found["cleat"].figure, 0)) == 1


def test_only_tests_with_data(tmp_path):
    folder = rigs.write(tmp_path / "rig", {"vertical": rigs.vertical(), "modes": [
        {"pressure": 2e5, "standing": 0, "status": "failed", "reason": "no"}]}, {"cleat": {"status": "not begun"}})
    assert [one.name for one in figures.figures_of(rondo.open_rig(folder))] == ["vertical"]
    plt.close("all")


def test_measurements_are_drawn_beside(rig, tmp_path):
    rows = [row for row in rigs.all_tests()["lateral"] if row["pressure"] == rigs.PRESSURE and not row["camber"]]
    (tmp_path / "m.csv").write_text("\n".join(["SLIPANGL,FZW,FYW", *(f"{row['slip_angle']},{row['load']},{1.2 * row['Fy']}"
                                                                     for row in rows)]))
    compared = against.compare(rig, tmp_path / "m.csv")
    found = {one.name: one for one in figures.figures_of(rig, compared) if one.test == "lateral"}
    plt.close("all")
    dots = [line for line in found["lateral-load"].figure.axes[0].lines if line.get_marker() == "."]
    assert len(dots) == 1 and np.abs(dots[0].get_ydata()).max() == pytest.approx(1.2e-3 * max(abs(row["Fy"]) for row in rows))


def test_files_are_written_twice_alike(tmp_path):
    folder = rigs.write(tmp_path / "rig", {"vertical": rigs.vertical()})
    first = figures.draw(rondo.open_rig(folder), tmp_path / "one")
    second = figures.draw(rondo.open_rig(folder), tmp_path / "two")
    assert [path.name for path in first] == ["vertical.png", "vertical.svg"]
    assert [path.read_bytes() for path in first] == [path.read_bytes() for path in second]

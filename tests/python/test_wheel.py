# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a wheel on a rim that forces move: what the panels show, the film, wrong input."""
import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from test_cli import rondo_module

import rondo
from rondo.figures.run_figures import draw_run
from rondo.plots import animation, curves, marks
from rondo.plots import wheel as wheels


@pytest.fixture(autouse=True)
def closed_figures():
    yield
    plt.close("all")


@pytest.fixture
def held(wheel):
    """The run as if nothing of its rim were free."""
    run = rondo.open(wheel)
    run.case["rim"] = {"free": []}
    return run


def panels(figure):
    """Axes by the first word of what they show."""
    return {ax.get_ylabel().split()[0]: ax for ax in figure.axes}


def named(ax):
    return {line.get_label(): line for line in ax.lines if not line.get_label().startswith("_")}


def test_the_panels_are_the_columns(wheel):
    run = rondo.open(wheel)
    shown = panels(run.plot_wheel())
    assert list(shown) == ["height", "speed", "slip", "force", "torque", "energy"]
    height, = shown["height"].lines
    np.testing.assert_allclose(height.get_ydata(), 1e3 * run.history["center_y_m"])
    np.testing.assert_allclose(height.get_xdata(), 1e3 * run.history["time_s"])
    speed = named(shown["speed"])
    np.testing.assert_allclose(speed["of the tread, ωR"].get_ydata(), 0.3 * run.history["spin_rad_s"])
    np.testing.assert_allclose(speed["of the hub, V"].get_ydata(), 10.0)
    torque = named(shown["torque"])
    assert list(torque) == ["of the ground", "brake, at most"]
    t = run.history["time_s"]
    np.testing.assert_allclose(torque["brake, at most"].get_ydata(), -2.0 * np.minimum(t / 0.01, 1))  # kN·m/m
    assert "kN·m/m" in shown["torque"].get_ylabel()
    assert list(named(shown["energy"])) == ["kinetic, of the rim", "springs", "work of what holds",
                                            "into the brake", "into dashpots"]


@pytest.mark.parametrize("count, above", [(7, 4), (6, 4), (5, 2), (3, 0), (2, 0), (1, 0)])
def test_the_lowest_panels_of_each_width_name_the_time(wheel, monkeypatch, count, above):
    """The last of an odd number is as wide as the page, with another scale than those above it."""
    run = rondo.open(wheel)
    some = wheels._panels(run)[:count]
    monkeypatch.setattr(wheels, "_panels", lambda run: some)
    axes = run.plot_wheel().axes
    assert [ax.get_xlabel() for ax in axes] == above * [""] + (count - above) * ["time (ms)"]
    labelled = [ax.xaxis.get_major_ticks()[0].label1.get_visible() for ax in axes]
    assert labelled == above * [False] + (count - above) * [True]


def test_the_ground_bears_load_and_weight(wheel):
    run = rondo.open(wheel)
    ax = next(ax for ax in run.plot_wheel().axes if "the ground" in ax.get_ylabel())
    borne = named(ax)["load and weight"].get_ydata()  # kN/m
    mass = np.pi * (0.3**2 - 0.15**2) * 1100 + 100
    # The mesh is a polygon of 40 sides: its area is smaller by sin(x)/x.
    polygon = np.sin(np.pi / 20) / (np.pi / 20)
    weight = 9.81e-3 * (100 + (mass - 100) * polygon)
    assert borne[-1] == pytest.approx(50 + weight, rel=1e-6)
    assert borne[0] == pytest.approx(weight + 50 * run.history["time_s"][0] / 0.005, rel=1e-6)


def test_reactions_are_of_what_is_held(wheel, held):
    def hub(figure):
        ax = next(ax for ax in figure.axes if "the hub (" in ax.get_ylabel() and "force"
                  in ax.get_ylabel())
        return list(named(ax))
    assert hub(rondo.open(wheel).plot_wheel()) == ["that holds, along x"]
    assert hub(held.plot_wheel()) == ["that holds, along x", "that holds, along y"]
    assert "that holds" in named(panels(held.plot_wheel())["torque"])


def test_torques_are_signed_as_the_spin(wheel):
    """What brakes is below zero, and the ground, which drags a braked wheel on, above it; of a wheel
    that turns backwards the other way round."""
    run = rondo.open(wheel)
    of = wheels._torques(run)
    late = run.history["time_s"] > 0.015
    assert of["brake, at most"][late].max() < 0 < of["of the ground"][late].mean()
    run.history["spin_rad_s"][:] *= -1
    assert wheels._torques(run)["brake, at most"][late].min() > 0
    run.history["spin_rad_s"][-5:] = 0.0  # locked: it still holds
    assert wheels._torques(run)["brake, at most"][late].min() > 0
    assert wheels._sense(np.array([0.0, 3.0, 0.0, -2.0, 0.0])).tolist() == [1, 1, 1, -1, -1]


def test_other_runs_are_refused(smooth, crush, tmp_path):
    for run in smooth, crush:
        with pytest.raises(rondo.Error, match="no \\[rim\\] in the case, so that its history has no "
                                              "spin_rad_s.*free = \\[\\] for the reactions"):
            rondo.open(run).plot_wheel()
    done = rondo_module("wheel", smooth, "-o", tmp_path)
    assert done.returncode == 2 and "no [rim] in the case" in done.stderr
    assert list(tmp_path.iterdir()) == []


def test_command(wheel, tmp_path):
    done = rondo_module("wheel", wheel, "-o", tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.split() == [str(tmp_path / "wheel.png"), str(tmp_path / "wheel.svg")]


def test_figures_have_the_wheel(wheel, tmp_path, monkeypatch):
    drawn = []
    monkeypatch.setattr("rondo.style.save", lambda figure, path: drawn.append(path.name) or [path])
    draw_run(rondo.open(wheel), tmp_path)
    assert "wheel" in drawn


def test_the_energy_with_the_rim_is_that_of_the_ledger(wheel):
    """Energy less its terms, as drawn, stays what it was at the start."""
    run = rondo.open(wheel)
    assert marks.relative_residual(run).max() < 1e-12
    terms = sum(sign * run.history[name] for name, (sign, _, _) in curves.TERMS.items())
    start = marks.energy(run) - terms - run.history["energy_residual"]
    np.testing.assert_allclose(start, start[0], rtol=1e-12)
    labels = named(run.plot_energy())
    assert "energy: kinetic and strain, with the rim" in labels
    assert {"work of the load", "work of gravity", "brake", "dashpots of the rim"} <= set(labels)
    looks = [(str(look["color"]), str(look["linestyle"])) for _, _, look in curves.TERMS.values()]
    of_rim = looks[2:8] + looks[8:]  # those that may be drawn together
    assert len(set(of_rim)) == len(of_rim)


def test_the_film_shows_the_height(wheel):
    """Ground and the line of the first height stand still, though the picture follows along x."""
    run = rondo.open(wheel)
    run.center[:, 1] += np.linspace(0.0, 1.5, len(run.center))  # far up: others would follow
    with matplotlib.rc_context({"figure.constrained_layout.use": False}):
        film = animation._Film(run, np.array([0, 5, 10]), "displacement", (0.0, 1.0), True, 333,
                               (640, 360))
    seen = []
    for frame, k in enumerate((0, 5, 10)):
        film.show(frame)
        seen.append(film.ax.get_ylim())
        dot, = film.height.get_xydata()
        np.testing.assert_allclose(dot, run.center[k])
        assert film.ax.get_title().endswith(f"hub at {1e3 * run.center[k, 1]:.1f} mm")
        points = run.position(k)
        assert seen[-1][0] < points[:, 1].min() and points[:, 1].max() < seen[-1][1]
    assert seen[0] == seen[1] == seen[2]
    assert film.height in film._moving()


@pytest.mark.parametrize("follow", [None, False, True])
def test_a_film_of_a_wheel_that_flies_off(wheel, tmp_path, monkeypatch, follow):
    """It follows upwards; and where it must not, the picture is as wide as its labels need."""
    run, shown = rondo.open(wheel), []
    run.center[:, 1] += np.linspace(0.0, 30.0, len(run.center))
    monkeypatch.setattr(animation, "_write", lambda film, *_: shown.append(film))
    run.animate(tmp_path / "a.gif", frames=3, follow=follow)
    film, = shown
    width, height = film.ax.figure.get_size_inches() * animation.DPI
    assert width >= animation.SMALLEST and height <= 365  # 360 but for rounding of the width
    assert film.follow is (follow is not False) and film.moves[1] == film.follow
    pictures = list(film.pictures(range(3)))
    for artist in film.ax.figure.findobj(lambda artist: artist.get_animated()):
        artist.set_animated(False)
    for frame, (k, picture) in enumerate(zip((0, 5, 10), pictures)):
        film.show(frame)
        points, (bottom, top) = run.position(k), film.ax.get_ylim()
        assert bottom < points[:, 1].min() and points[:, 1].max() < top
        canvas = FigureCanvasAgg(film.ax.figure)
        canvas.draw()
        if film.follow:  # ground and the line of the first height are left behind below
            assert np.abs(picture.astype(int) - np.asarray(canvas.buffer_rgba())).max() <= 1


def test_a_film_without_rim_is_as_it_was(smooth):
    with matplotlib.rc_context({"figure.constrained_layout.use": False}):
        film = animation._Film(rondo.open(smooth), np.array([0]), "displacement", (0.0, 1.0), False,
                               333, (640, 360))
    assert film.height is None and "hub" not in film.ax.get_title()

# SPDX-License-Identifier: BSD-3-Clause
"""What the figures of the paper study draw, panel by panel, against the files it must be from: they
are read here by h5py and numpy alone, and nothing is computed by the functions that draw."""
import pathlib
import re
import tomllib
from typing import Any

import h5py
import matplotlib.pyplot as plt
import numpy as np
import pytest
from drawn import (arrows, beneath, bodies, body_axes, check_body, check_ground, contact, curves,
                   named, outline, panel)
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

import rondo
from rondo.figures import figure_2, figure_3, figure_4, figure_5, figure_6

Array = np.ndarray
TIMES = (0.0125, 0.0625, 0.1)  # s, of figure 3
FRICTION = (0.0, 0.2, 0.4, 0.6)  # of figure 4
BODIES = ("smooth", "treaded")
FRAMES = ("rotating", "rectified")


class Stored:
    """The files of a run or of a POD: results.h5 or pod.h5, case.toml, history.csv."""

    def __init__(self, folder: pathlib.Path) -> None:
        self.folder = folder
        self.path = next(p for p in (folder / "results.h5", folder / "pod.h5") if p.exists())

    def __getitem__(self, dataset: str) -> Array:
        with h5py.File(self.path) as file:
            return file[dataset][:]

    @property
    def case(self) -> dict[str, Any]:
        return tomllib.loads((self.folder / "case.toml").read_text())

    @property
    def history(self) -> Array:
        return np.genfromtxt(self.folder / "history.csv", delimiter=",", names=True)

    def nearest(self, time: float) -> int:
        return int(np.abs(self["frame/time"] - time).argmin())

    def fixed(self, k: int, vectors: Array) -> Array:
        """Vectors of the co-rotating frame along the fixed axes."""
        cos, sin = np.cos(self["frame/angle"][k]), np.sin(self["frame/angle"][k])
        return vectors @ np.array([[cos, sin], [-sin, cos]])

    def position(self, k: int) -> Array:
        """(n, 2) m in the fixed frame."""
        arms = self["mesh/coordinates"] + self["snapshots/displacement"][k]
        return self["frame/center"][k] + self.fixed(k, arms)

    def touching(self, k: int) -> Array:
        """Nodes in contact."""
        return self["mesh/boundary"][self["contact/force"][k, :, 0] > 0]

    def radial(self) -> Array:
        """(t,) m: radial displacement, mean over the outer edge."""
        coordinates = self["mesh/coordinates"]
        radius = np.linalg.norm(coordinates, axis=1)
        edge = radius > radius.max() * (1 - 1e-9)
        normal = coordinates[edge] / radius[edge, None]
        return np.einsum("tni,ni->t", self["snapshots/displacement"][:, edge], normal) / edge.sum()


@pytest.fixture(scope="module")
def study(paper: rondo.Paper) -> pathlib.Path:
    return pathlib.Path(paper.directory) / "runs"


@pytest.fixture(scope="module")
def figures(paper: rondo.Paper) -> dict[str, Figure]:
    """Drawn, not written to files, which would take most of the time."""
    drawn: dict[str, Figure] = {}
    for module in (figure_2, figure_3, figure_4, figure_5, figure_6):
        drawn.update(module.draw(paper))
    for figure in drawn.values():
        figure.canvas.draw()  # arrows have their shape, and panels their places, from here on
        plt.close(figure)
    return drawn


def check_contact(ax: Axes, run: Stored, k: int) -> None:
    """Marked are the sides whose nodes both touch the ground, and no others, and as dots the nodes
    that touch it alone; the ground is there."""
    sides, dots = contact(ax, run.position(k))
    touching = set(run.touching(k).tolist())
    assert sides == {side for side in outline(run["mesh/cells"]) if set(side) <= touching}
    assert dots | {node for side in sides for node in side} == touching
    ground = run.case["ground"]
    check_ground(ax, np.array(ground["profile"]), ground["fillet"])


# Figure 2


def test_figure_2_damped(paper: rondo.Paper, study: pathlib.Path,
                         figures: dict[str, Figure]) -> None:
    run, figure = Stored(study / "spin-up-damped"), figures["figure-2"]
    time, radial = run["frame/time"] * 1e3, run.radial()
    assert np.allclose(named(panel(figure, "a"), "computed"), np.c_[time, radial * 1e3], rtol=1e-9)
    apart, = curves(panel(figure, "b"))
    closed = paper.row("damped-closed-form")["expected"]
    assert np.allclose(apart.get_xydata(), np.c_[time, np.abs(radial / closed - 1)], atol=1e-9)
    u = run["snapshots/displacement"][-1]
    check_body(panel(figure, "c"), run["mesh/coordinates"] + u, run["mesh/cells"],
               1e3 * np.linalg.norm(u, axis=1))


def test_figure_2_undamped(study: pathlib.Path, figures: dict[str, Figure]) -> None:
    run, figure = Stored(study / "spin-up-undamped"), figures["figure-2"]
    whole = 1e3 * np.c_[run["frame/time"], run.radial()]
    first, last = (curves(panel(figure, letter))[0].get_xydata() for letter in "de")
    assert 20 < len(first) < len(whole) / 4 and 20 < len(last) < len(whole) / 4
    assert np.allclose(first, whole[:len(first)]) and np.allclose(last, whole[-len(last):])
    rows = run.history
    energies = panel(figure, "f")
    for word, values in (("kinetic", rows["kinetic"]), ("strain", rows["strain"]),
                         ("sum", rows["kinetic"] + rows["strain"]), ("work", rows["work_frame"])):
        drawn = named(energies, word)
        assert len(drawn) > 50
        assert np.allclose(drawn, np.c_[rows["time_s"] * 1e3, values][:len(drawn)], rtol=1e-9)


@pytest.mark.parametrize("letter, symplectic, printed", [
    ("g", "spin-up-undamped", "spin-up-as-printed"),
    ("h", "spin-up-fast", "spin-up-fast-as-printed")])
def test_figure_2_schemes(study: pathlib.Path, figures: dict[str, Figure], letter: str,
                          symplectic: str, printed: str) -> None:
    ax, residuals = panel(figures["figure-2"], letter), panel(figures["figure-2"], "i")
    for word, name in (("symplectic", symplectic), ("printed", printed)):
        run = Stored(study / name)
        rows = run.history
        energy = rows["kinetic"] + rows["strain"]
        top = np.maximum.accumulate(energy)
        assert np.allclose(named(ax, word), np.c_[rows["time_s"], top], rtol=1e-9)
        exchanged = np.abs(energy) + sum(np.abs(rows[column]) for column in (
            "work_frame", "work_contact", "dissipation_mass", "dissipation_stiffness",
            "work_scheme"))
        left = np.abs(rows["energy_residual"]) / np.maximum.accumulate(exchanged)
        left = np.maximum.accumulate(left)
        drawn = named(residuals, word, f"{run.case['motion']['angular_velocity']:.0f} rad/s")
        assert np.allclose(drawn[:, 0], rows["time_s"])
        assert np.allclose(drawn[left > 1e-17, 1], left[left > 1e-17], rtol=1e-6, atol=0)
    created = named(ax, "created")  # itself, or the largest so far
    assert np.allclose(created[:, 0], rows["time_s"])
    assert np.allclose(*(np.maximum.accumulate(c) for c in (created[:, 1], rows["work_scheme"])))


# Figure 3


@pytest.mark.parametrize("name", BODIES)
@pytest.mark.parametrize("letters", ["abc", "def"])
def test_figure_3_disks(study: pathlib.Path, figures: dict[str, Figure], name: str,
                        letters: str) -> None:
    run, figure = Stored(study / f"ledge-{name}"), figures[f"figure-3-{name}"]
    for letter, time in zip(letters, TIMES):
        ax, k = panel(figure, letter), run.nearest(time)
        size = np.linalg.norm(run["snapshots/displacement"][k], axis=1)
        check_body(ax, run.position(k), run["mesh/cells"], size * 1e3)
        check_contact(ax, run, k)
        (left, right), (low, high) = ax.get_xlim(), ax.get_ylim()
        x, y = run.position(k)[run.touching(k)].T
        assert np.all((left < x) & (x < right) & (low < y) & (y < high))
    assert len(run.touching(k)) > 2  # at last there is contact to be drawn


@pytest.mark.parametrize("name", BODIES)
def test_figure_3_marks_its_close_views(figures: dict[str, Figure], name: str) -> None:
    figure = figures[f"figure-3-{name}"]
    for whole, close in zip("abc", "def"):
        mark, = (p for p in panel(figure, whole).patches if isinstance(p, Rectangle))
        ax = panel(figure, close)
        assert np.allclose(mark.get_bbox().intervalx, ax.get_xlim())
        assert np.allclose(mark.get_bbox().intervaly, ax.get_ylim())


@pytest.mark.parametrize("name", BODIES)
def test_figure_3_arrows_push_the_nodes_in_contact(study: pathlib.Path, figures: dict[str, Figure],
                                                   name: str) -> None:
    run, lengths = Stored(study / f"ledge-{name}"), []
    for letter, time in zip("def", TIMES):
        k = run.nearest(time)
        touching = run["contact/force"][k, :, 0] > 0
        nodes = run.touching(k)
        traction = np.linalg.norm(run["contact/traction"][k, touching], axis=1)
        force = run["fields/contact_force"][k, nodes, :2]
        tips, tails = arrows(panel(figures[f"figure-3-{name}"], letter))
        assert len(tips) == len(nodes)
        large = traction > 0.2 * traction.max()  # smaller ones are dots, or all head
        apart = np.linalg.norm(tips - run.position(k)[nodes], axis=1)
        assert apart.max() < 1e-3 and apart[large].max() < 1e-4
        arrow = tips[large] - tails[large]
        length = np.linalg.norm(arrow, axis=1)
        along = force[large] / np.linalg.norm(force[large], axis=1)[:, None]
        assert np.all(np.sum(arrow * along, axis=1) > 0.999 * length)
        lengths += (length / traction[large]).tolist()
    assert len(lengths) > 5 and np.ptp(lengths) < 0.1 * np.mean(lengths)  # one scale in the figure


@pytest.mark.parametrize("number, name", enumerate(BODIES))
def test_figure_3_forces(study: pathlib.Path, figures: dict[str, Figure], number: int,
                         name: str) -> None:
    run, figure = Stored(study / f"turn-{name}"), figures["figure-3-forces"]
    rows, case = run.history, run.case
    time, force = rows["time_s"], rows["force_y"]
    whole = panel(figure, "ab"[number])
    for word, column in (("vertical", "force_y"), ("horizontal", "force_x")):
        assert np.allclose(named(whole, word), np.c_[time, rows[column]] * 1e-3 * [1e6, 1])
    steady = float(run["frame/time"][0])
    moments = [line.get_xdata()[0] for line in whole.lines if len(line.get_xdata()) == 2
               and line.get_xdata()[0] == line.get_xdata()[1]]
    for moment in (time[force > 0][0], steady, time[-1]):
        assert np.isclose(moments, 1e3 * moment).any()

    disk = case["disk"]
    passing = disk["tread"]["pitches"] if name == "treaded" else disk["mesh"]["circumferential"]
    rate = passing * case["motion"]["angular_velocity"] / (2 * np.pi)
    spans = np.diff(time, prepend=0.0)
    later = time >= steady
    mean = np.sum(force[later] * spans[later]) / spans[later].sum()
    expected = np.c_[(time - 0.5 * spans - steady) * rate, 100 * (force / mean - 1)][later]
    line, = curves(panel(figure, "cd"[number]))
    drawn = line.get_xydata()
    assert drawn[-1, 0] > 5 and np.allclose(drawn, expected[:len(drawn)], rtol=1e-7, atol=1e-9)


@pytest.mark.parametrize("letter, name", [("e", "smooth"), ("f", "treaded")])
def test_figure_3_spectra(study: pathlib.Path, figures: dict[str, Figure], letter: str,
                          name: str) -> None:
    """A sum over the rows for each frequency, in the place of the fast transform."""
    run = Stored(study / f"turn-{name}")
    rows = run.history
    spans = np.diff(rows["time_s"], prepend=0.0)
    later = rows["time_s"] - spans >= run["frame/time"][0]  # rows that are steady as a whole
    middle = (rows["time_s"] - 0.5 * spans)[later]
    time = np.linspace(middle[0], middle[-1], len(middle))
    force = np.interp(time, middle, rows["force_y"][later])
    count = len(time)
    window = np.sin(np.pi * np.arange(count) / count) ** 2
    line, = curves(panel(figures["figure-3-forces"], letter))
    frequency, amplitude = line.get_xydata().T
    shown = slice(1, int(np.searchsorted(frequency, line.axes.get_xlim()[1])))
    assert frequency[1] == pytest.approx(1 / (count * (time[1] - time[0])))
    waves = np.exp(-2j * np.pi * frequency[shown, None] * (time - time[0]))
    expected = 2 * np.abs(waves @ ((force - force.mean()) * window)) / window.sum()
    assert np.allclose(amplitude[shown], expected, rtol=1e-3, atol=1e-3)
    assert expected.max() > 10  # N/m: there is something to be seen


# Figure 4


@pytest.mark.parametrize("column, friction", enumerate(FRICTION))
def test_figure_4_displacement(study: pathlib.Path, figures: dict[str, Figure], column: int,
                               friction: float) -> None:
    time = min(Stored(study / f"friction-{mu}")["frame/time"][-1] for mu in FRICTION)
    run, figure = Stored(study / f"friction-{friction}"), figures["figure-4-displacement"]
    k = run.nearest(time)
    u = run["snapshots/displacement"][k]
    for letter, values in (("abcd"[column], np.linalg.norm(u, axis=1)),
                           ("efgh"[column], run.fixed(k, u)[:, 0])):
        ax = panel(figure, letter)
        check_body(ax, run.position(k), run["mesh/cells"], 1e3 * values)
        check_contact(ax, run, k)
    at, = (tick for tick, text in zip(ax.get_xticks(), ax.get_xticklabels())
           if text.get_text() == "0")  # x is counted from the center
    assert at == pytest.approx(run["frame/center"][k, 0])


def forces_by_place(run: Stored) -> tuple[Array, Array, Array]:
    """Of all nodes in contact in all snapshots: m from the center along x; N/m upwards and along
    +x, as they enter the mean over the snapshots. The ground is level."""
    force, boundary = run["contact/force"], run["mesh/boundary"]
    x = np.array([(run.position(k)[boundary, 0] - run["frame/center"][k, 0])
                  for k in range(len(force))])
    touching = force[:, :, 0] > 0
    normal, left = force[touching].T / len(force)
    return x[touching], normal, -left


def check_profile(drawn: Array, x: Array, force: Array, window: float) -> None:
    """A mean over places (mm, MPa) against forces at their places: integral, center, and the part
    left of each place, however the profile was smoothed within `window` (m)."""
    place, value = drawn[:, 0] * 1e-3, drawn[:, 1] * 1e6
    parts = value * np.diff(place).mean()  # N/m
    size = np.abs(force).sum()
    assert parts.sum() == pytest.approx(force.sum(), abs=1e-6 * size + 1e-9)
    assert abs(parts @ place - force @ x) <= 0.05 * window * size
    for edge in np.linspace(place[0], place[-1], 25):
        near = np.abs(x - edge) <= 1.5 * window
        left = force[x < edge].sum()
        assert abs(parts[place < edge].sum() - left) <= np.abs(force[near]).sum() + 1e-9


@pytest.mark.parametrize("column, friction", enumerate(FRICTION))
def test_figure_4_contact(study: pathlib.Path, figures: dict[str, Figure], column: int,
                          friction: float) -> None:
    run, figure = Stored(study / f"friction-{friction}"), figures["figure-4-contact"]
    assert run.case["ground"]["friction"] == friction
    above, below = panel(figure, "abcd"[column]), panel(figure, "efgh"[column])
    x, upwards, along = forces_by_place(run)
    window = float(np.median(run["mesh/tributary"]))
    pressure, = (line.get_xydata() for line in curves(above))
    check_profile(pressure, x, upwards, window)
    limit = friction * pressure[:, 1]
    others = [line.get_xydata() for line in curves(below)]
    shear = [c for c in others if not np.allclose(np.abs(c[:, 1]), limit, rtol=1e-9)]
    if friction == 0:
        assert all(not c[:, 1].any() for c in others) and not along.any()
    else:
        assert len(shear) == 1 and np.array_equal(shear[0][:, 0], pressure[:, 0])
        check_profile(shear[0], x, along, window)
    for ax, force in ((above, upwards.sum()), (below, along.sum())):
        said, = (float(found[1].replace("\N{MINUS SIGN}", "-")) for text in ax.texts
                 if (found := re.search(r"([-\N{MINUS SIGN}]?[\d.]+) kN/m", text.get_text())))
        assert said == pytest.approx(1e-3 * force, abs=0.051)


# Figures 5 and 6


def check_decay(drawn: Array, pod: Stored) -> None:
    """Shares of the energy left out over the modes kept, all that are not small."""
    left = pod["spectrum/discarded_energy"]
    modes = drawn[:, 0].astype(int)
    assert np.array_equal(drawn[:, 0], modes) and np.array_equal(drawn[:, 1], left[modes - 1])
    assert set(1 + np.flatnonzero(left > 1e-9)) <= set(modes.tolist())


def test_figure_5(study: pathlib.Path, figures: dict[str, Figure]) -> None:
    ax, = figures["figure-5"].axes
    assert len(curves(ax)) == 4
    for kind, run in (("rolling", "turn"), ("crush", "crush")):
        for body in BODIES:
            check_decay(named(ax, kind, body),
                        Stored(study / f"{run}-{body}" / "pod" / "velocity-rotating"))


@pytest.mark.parametrize("letter, body, field", [
    ("a", "smooth", "displacement"), ("b", "smooth", "velocity"), ("c", "smooth", "contact"),
    ("d", "treaded", "displacement"), ("e", "treaded", "velocity"), ("f", "treaded", "contact")])
def test_figure_5_frames(study: pathlib.Path, figures: dict[str, Figure], letter: str, body: str,
                         field: str) -> None:
    ax = panel(figures["figure-5-frames"], letter)
    title = ax.get_title(loc="left").lower()  # names nothing else
    assert not any(other in title for other in {"displacement", "velocity", "contact"} - {field})
    assert not any(other in title for other in set(BODIES) - {body})
    turn, crush = (study / f"{run}-{body}" / "pod" for run in ("turn", "crush"))
    assert len(curves(ax)) == 3
    check_decay(named(ax, "rolling", without="rectified"), Stored(turn / f"{field}-rotating"))
    check_decay(named(ax, "rolling", "rectified"), Stored(turn / f"{field}-rectified"))
    check_decay(named(ax, "crush"), Stored(crush / f"{field}-rotating"))


def along(drawn: Array, expected: Array) -> float:
    """The factor of `drawn` = factor × `expected`."""
    factor = float(np.vdot(expected, drawn) / np.vdot(expected, expected))
    assert np.allclose(drawn, factor * expected, rtol=0, atol=1e-9 * np.abs(drawn).max())
    assert factor != 0
    return factor


@pytest.mark.parametrize("body", BODIES)
@pytest.mark.parametrize("frame", FRAMES)
def test_figure_6(study: pathlib.Path, figures: dict[str, Figure], body: str, frame: str) -> None:
    """Modes up to their sign and size, which shape, colour and course in time have in common."""
    pod = Stored(study / f"turn-{body}" / "pod" / f"velocity-{frame}")
    figure = figures[f"figure-6-{frame}-{body}"]
    cells, coordinates = pod["mesh/cells"], pod["mesh/coordinates"]
    radius = np.linalg.norm(coordinates, axis=1)
    turns = np.abs(pod["snapshots/angle"] - pod["snapshots/angle"][0]) / (2 * np.pi)
    spatial, temporal = pod["modes/spatial"], pod["modes/temporal"]
    share = pod["spectrum/energy"]
    assert len(body_axes(figure)) == 6
    for mode, letter in enumerate("abcdef"):
        ax = panel(figure, letter)
        drawn, = bodies(ax)
        shape = np.array([path.vertices[:4] for path in drawn.get_paths()]) - coordinates[cells]
        size = along(shape, spatial[mode][cells])
        assert np.linalg.norm(shape, axis=2).max() > 5e-3 * radius.max()  # it is seen
        radial = np.sum(spatial[mode] * coordinates, axis=1) / radius
        assert size * along(np.asarray(drawn.get_array()), radial[cells].mean(axis=1)) > 0
        below = beneath(ax)
        course = curves(below)[0].get_xydata()
        assert len(course) > 20 and np.allclose(course[:, 0], turns[:len(course)])
        assert size * along(course[:, 1], temporal[:len(course), mode]) > 0
        said = re.search(r"([\d.e-]+) %", ax.get_title(loc="left"))
        assert said and float(said[1]) == pytest.approx(100 * share[mode], rel=0.06)

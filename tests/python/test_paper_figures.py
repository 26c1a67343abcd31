# SPDX-License-Identifier: BSD-3-Clause
"""The figures of the paper study, drawn from its quick form: all there, right, and honest."""
import pathlib
import types
from collections.abc import Iterator

import matplotlib.pyplot as plt
import numpy as np
import pytest
from drawn import bodies, body_axes, check_files, without_unit
from matplotlib.colors import to_hex
from matplotlib.figure import Figure

import rondo
from rondo import style
from rondo.figures import (draw_paper, figure_2, figure_3, figure_3_forces, figure_4, figure_5,
                           figure_6)
from rondo.plots.curves import force_spectrum
from rondo.plots.marks import edge_displacement, energy

pytestmark = pytest.mark.long
WIDTHS = {  # in
    "figure-2": style.PAGE, "figure-3-smooth": style.PAGE, "figure-3-treaded": style.PAGE,
    "figure-3-forces": style.PAGE, "figure-4-displacement": style.PAGE,
    "figure-4-contact": style.PAGE, "figure-5": style.COLUMN, "figure-5-frames": style.PAGE,
    "figure-6-rotating-smooth": style.PAGE, "figure-6-rectified-smooth": style.PAGE,
    "figure-6-rotating-treaded": style.PAGE, "figure-6-rectified-treaded": style.PAGE,
}


@pytest.fixture(scope="module")
def figures(paper: rondo.Paper) -> Iterator[dict[str, Figure]]:
    drawn: dict[str, Figure] = {}
    for module in (figure_2, figure_3, figure_4, figure_5, figure_6):
        drawn.update(module.draw(paper))
    yield drawn
    for figure in drawn.values():
        plt.close(figure)


def titled(figure: Figure, letter: str) -> plt.Axes:
    """The panel of a letter."""
    found, = (ax for ax in figure.axes if ax.get_title(loc="left").startswith(f"({letter})"))
    return found


def curve(ax: plt.Axes, label: str) -> np.ndarray:
    """(points, 2): the curve of a label."""
    found, = (line for line in ax.lines if line.get_label() == label)
    return found.get_xydata()


@pytest.fixture(scope="module")
def written(paper: rondo.Paper,
            tmp_path_factory: pytest.TempPathFactory) -> dict[str, pathlib.Path]:
    """The files of all figures, by name."""
    paths = draw_paper(paper, tmp_path_factory.mktemp("paper") / "figures")
    assert not plt.get_fignums()  # nothing is left open
    assert len(paths) == len({path.name for path in paths})
    return {path.name: path for path in paths}


def test_every_figure_is_written(written: dict[str, pathlib.Path]) -> None:
    assert set(written) == {name + ending for name in WIDTHS for ending in (".png", ".svg")}
    for name, width in WIDTHS.items():
        check_files(written[f"{name}.png"], written[f"{name}.svg"], width, style.DPI)


@pytest.mark.parametrize("module", [figure_4, figure_5])
def test_the_same_study_gives_the_same_bits(
        paper: rondo.Paper, written: dict[str, pathlib.Path], tmp_path: pathlib.Path,
        module: types.ModuleType) -> None:
    name, figure = next(iter(module.draw(paper).items()))
    for path in style.save(figure, tmp_path / name):
        assert path.read_bytes() == written[path.name].read_bytes()


@pytest.mark.parametrize("name", WIDTHS)
def test_axes_have_units_and_bodies_equal_scales(figures: dict[str, Figure], name: str) -> None:
    figure = figures[name]
    assert without_unit(figure) == []
    assert figure.get_figwidth() == WIDTHS[name] and figure.get_figheight() <= 8
    assert all(ax.get_aspect() == 1.0 for ax in body_axes(figure))


@pytest.mark.parametrize("name, count", [
    ("figure-2", 1), ("figure-3-smooth", 6), ("figure-3-treaded", 6), ("figure-4-displacement", 8),
    ("figure-6-rotating-treaded", 6), ("figure-6-rectified-smooth", 6)])
def test_bodies_of_a_figure_have_the_same_colours(figures: dict[str, Figure], name: str,
                                                  count: int) -> None:
    drawn = [bodies(ax)[0] for ax in body_axes(figures[name])]
    assert len(drawn) == count
    scales: dict[str, set[tuple[float, float]]] = {}
    for body in drawn:
        scales.setdefault(body.get_cmap().name, set()).add(body.get_clim())
    assert all(len(limits) == 1 for limits in scales.values())
    for body in drawn:  # nothing is beyond the ends of the scale
        low, high = body.get_clim()
        assert low <= body.get_array().min() * (1 - 1e-12)
        assert body.get_array().max() * (1 - 1e-12) <= high


def test_both_disks_of_figure_3_have_one_scale(figures: dict[str, Figure]) -> None:
    limits = {bodies(ax)[0].get_clim() for name in ("smooth", "treaded")
              for ax in body_axes(figures[f"figure-3-{name}"])}
    assert len(limits) == 1


def test_damped_spin_settles_on_the_closed_form(paper: rondo.Paper,
                                                figures: dict[str, Figure]) -> None:
    expected = paper.row("damped-closed-form")["expected"] * 1e3
    panel = titled(figures["figure-2"], "a")
    assert np.all(curve(panel, "closed form")[:, 1] == expected)
    run = paper.run("spin-up-damped")
    computed = curve(panel, "computed")
    assert np.allclose(computed[:, 0], run.times * 1e3)
    assert np.allclose(computed[:, 1], edge_displacement(run) * 1e3)
    assert computed[-1, 1] == pytest.approx(expected, rel=0.01)


def test_edge_displacement_is_the_mean_over_the_edge(paper: rondo.Paper) -> None:
    run = paper.run("spin-up-damped")
    last = run.n_snapshots - 1
    radius = np.linalg.norm(run.mesh.coordinates, axis=1)
    arm = np.linalg.norm(run.mesh.coordinates + np.asarray(run.displacement[last]), axis=1)
    outer = radius > run.outer_radius * (1 - 1e-9)
    # Arms differ from their radial part by the square of the rotation, some 1e-7 of it here.
    assert edge_displacement(run)[last] == pytest.approx((arm - radius)[outer].mean(), rel=1e-3)


def test_the_printed_scheme_gains_energy_and_the_other_does_not(figures: dict[str, Figure]) -> None:
    for letter in "gh":
        panel = titled(figures["figure-2"], letter)
        symplectic, printed = (curve(panel, name) for name in ("symplectic", "as printed"))
        early = symplectic[np.searchsorted(symplectic[:, 0], 0.05), 1]
        assert symplectic[-1, 1] == pytest.approx(early, rel=0.01)
        assert printed[-1, 1] > 1.05 * symplectic[-1, 1]
        assert curve(panel, "created by the scheme")[-1, 1] > 0
    assert titled(figures["figure-2"], "h").get_yscale() == "log"
    for line in titled(figures["figure-2"], "i").lines:
        if "rad/s" in str(line.get_label()):
            assert line.get_ydata().max() < 1e-12


def test_figure_2_tells_the_spin_and_its_titles_stand_in_line(figures: dict[str, Figure]) -> None:
    figure = figures["figure-2"]
    figure.canvas.draw()
    for row in ("abc", "def", "ghi"):
        panels = [titled(figure, letter) for letter in row]
        heights = [ax._left_title.get_window_extent().y0 for ax in panels]
        assert np.ptp(heights) < 1.0  # px
        for letter, ax in zip(row, panels):
            spin = "200 rad/s" if letter == "h" else "50 rad/s"
            assert letter == "i" or spin in ax.get_title(loc="left")


def test_the_energy_of_the_undamped_disk_is_the_work_of_its_frame(
        figures: dict[str, Figure]) -> None:
    panel = titled(figures["figure-2"], "f")
    total, work = curve(panel, "sum")[:, 1], curve(panel, "frame's work")[:, 1]
    parts = curve(panel, "kinetic")[:, 1] + curve(panel, "strain")[:, 1]
    assert np.allclose(total, parts)
    assert np.ptp(total - work) < 1e-9 * total.max()  # but for what the first half step brings


def test_figure_3_shows_the_times_of_the_paper(paper: rondo.Paper,
                                               figures: dict[str, Figure]) -> None:
    for name in ("smooth", "treaded"):
        run = paper.run(f"ledge-{name}")
        for letter, time in zip("abc", (0.0125, 0.0625, 0.1)):
            k = int(np.argmin(np.abs(run.times - time)))
            panel = titled(figures[f"figure-3-{name}"], letter)
            assert panel.get_title(loc="left") == f"({letter}) t = {run.times[k] * 1e3:.1f} ms"
            drawn = np.array([path.vertices[:4] for path in bodies(panel)[0].get_paths()])
            assert np.array_equal(drawn, run.position(k)[run.mesh.cells])
        for letter, time in zip("def", (0.0125, 0.0625, 0.1)):
            traction = np.linalg.norm(run.contact.traction[run.index(time)], axis=1)
            panel = titled(figures[f"figure-3-{name}"], letter)
            assert panel.get_title(loc="left") == (
                f"({letter}) traction up to {traction.max() * 1e-6:.1f} MPa")


def test_the_phases_of_the_climb_follow_each_other(paper: rondo.Paper) -> None:
    for name in ("turn-smooth", "turn-treaded"):
        run = paper.run(name)
        touch, flat = figure_3_forces.climbing(run)
        steady = figure_3_forces.steady_from(run)
        assert 0 < touch < flat < steady < run.history["time_s"][-1]
        before = run.history["time_s"] < touch
        assert before.any() and not run.history["force_y"][before].any()
        at = np.searchsorted(run.history["time_s"], flat)
        mean = run.history["force_y"][run.history["time_s"] > steady].mean()
        assert run.history["force_y"][at] == pytest.approx(mean, rel=0.15)  # it carries its load


def test_marks_stand_at_the_lines_of_the_spectrum(paper: rondo.Paper,
                                                  figures: dict[str, Figure]) -> None:
    run = paper.run("turn-treaded")
    marks = [line.get_xdata()[0] for line in titled(figures["figure-3-forces"], "f").lines
             if line.get_marker() == "v"]
    pitch = run.pitches * run.spin / (2 * np.pi)
    assert np.allclose(marks, pitch * np.arange(1, len(marks) + 1)) and len(marks) > 4
    frequency, amplitude = force_spectrum(run, from_time=run.times[0])
    near = np.abs(frequency - pitch) < 2.5 * frequency[1]
    apart = np.abs(frequency - np.round(frequency / pitch) * pitch) > 5 * frequency[1]
    assert amplitude[near].max() > 5 * amplitude[apart].max()


def test_smooth_disks_are_marked_at_the_passing_of_nodes(paper: rondo.Paper) -> None:
    run = paper.run("turn-smooth")
    columns = run.case["disk"]["mesh"]["circumferential"]
    rate, name = figure_3_forces.frequency(run)
    assert name == "nodes" and rate == pytest.approx(columns * run.spin / (2 * np.pi))


def test_figure_4_tells_the_time_of_its_snapshots(paper: rondo.Paper,
                                                  figures: dict[str, Figure]) -> None:
    figure = figures["figure-4-displacement"]
    times = {float(run.times[-1]) for run in map(paper.run, (f"friction-{name}" for name in
                                                             figure_4.FRICTION))}
    assert len(times) == 1
    assert f"t = {times.pop() * 1e3:.1f} ms" in figure._suptitle.get_text()
    colours = {to_hex(line.get_color()[0]) for ax in body_axes(figure) for line in ax.collections
               if line.get_zorder() > 4}
    assert colours == {style.CONTACT}


def test_figure_4_contact_is_within_friction(figures: dict[str, Figure]) -> None:
    figure = figures["figure-4-contact"]
    for number, friction in enumerate((0.0, 0.2, 0.4, 0.6)):
        above, below = titled(figure, "abcd"[number]), titled(figure, "efgh"[number])
        pressure = above.lines[0].get_xydata()
        upper, lower, shear = (line.get_ydata() for line in below.lines[:3])
        assert np.allclose(upper, friction * pressure[:, 1]) and np.array_equal(lower, -upper)
        assert np.all(np.abs(shear) <= upper * (1 + 1e-9) + 1e-12)
        said, = (text.get_text() for text in above.texts)
        width = 1e-3 * np.diff(pressure[:, 0]).mean()  # m
        assert said == f"in all {1e3 * width * pressure[:, 1].sum():.1f} kN/m"


def test_figure_5_is_of_the_velocity_in_the_turning_frame(paper: rondo.Paper,
                                                          figures: dict[str, Figure]) -> None:
    ax = figures["figure-5"].axes[0]
    for body in ("smooth", "treaded"):
        for kind, run in (("rolling", "turn"), ("crush", "crush")):
            left = paper.pod(f"{run}-{body}", "velocity", "co-rotating").discarded_energy
            drawn = curve(ax, f"{kind}, {body}")
            assert np.array_equal(drawn[:, 1], left[drawn[:, 0].astype(int) - 1])


def test_figure_5_has_the_colours_of_its_frames(figures: dict[str, Figure]) -> None:
    own = {line.get_label(): line for line in figures["figure-5"].axes[0].lines}
    frames = {line.get_label(): line for line in figures["figure-5-frames"].axes[0].lines}
    for name, other in (("rolling", "rolling, co-rotating frame"), ("crush", "crush")):
        for body in ("smooth", "treaded"):
            assert own[f"{name}, {body}"].get_color() == frames[other].get_color()
    lines = [own[f"{name}, {body}"].get_linestyle() for name in ("rolling", "crush")
             for body in ("smooth", "treaded")]
    assert lines == ["-", "--", ":", "-."]


def test_figure_5_tells_the_numbers_of_snapshots(paper: rondo.Paper,
                                                 figures: dict[str, Figure]) -> None:
    smooth, treaded = (len(paper.run(f"turn-{body}").times) for body in ("smooth", "treaded"))
    for name in ("figure-5", "figure-5-frames"):
        said = figures[name]._supxlabel.get_text()
        assert f"of {smooth} (smooth) and {treaded} (treaded) snapshots" in said


def test_figure_5_has_no_empty_decades(paper: rondo.Paper, figures: dict[str, Figure]) -> None:
    low, _ = figures["figure-5"].axes[0].get_ylim()
    drawn = [line.get_ydata() for line in figures["figure-5"].axes[0].lines
             if "," in str(line.get_label())]
    assert low >= 1e-10 and min(data.min() for data in drawn) < 100 * low


def test_rectified_rolling_falls_faster(figures: dict[str, Figure]) -> None:
    for ax in figures["figure-5-frames"].axes:
        turning, rectified = (curve(ax, f"rolling, {name}") for name in ("co-rotating frame",
                                                                         "rectified"))
        assert rectified[0, 1] < 0.5 * turning[0, 1]


def test_modes_of_latin_pgd_are_beside_those_of_the_crush(paper: rondo.Paper,
                                                          figures: dict[str, Figure]) -> None:
    axes = figures["figure-5-frames"].axes
    for ax, body in ((axes[0], "smooth"), (axes[3], "treaded")):
        drawn = curve(ax, "crush, modes of LATIN-PGD")
        assert len(drawn) == paper.run(f"latin-{body}").pod("displacement", "pgd").n_modes
        best = curve(ax, "crush")
        assert np.all(drawn[:8, 1] >= 0.99 * best[:8, 1])
        assert np.all(drawn[:8, 1] <= 3 * best[:8, 1])
        assert not any("LATIN" in str(line.get_label()) for line in axes[1].lines)


def test_energy_is_kinetic_and_strain(paper: rondo.Paper) -> None:
    run = paper.run("spin-up-fast")
    assert np.array_equal(energy(run), run.history["kinetic"] + run.history["strain"])

# SPDX-License-Identifier: BSD-3-Clause
"""Modes of PODs as drawn: shapes, courses in time, and how fast the energy falls."""
import types

import matplotlib.pyplot as plt
import numpy as np
import pytest
from drawn import bodies, body_axes, without_unit

import rondo
from rondo.plots import amplitude, modes
from rondo.plots.field import outline

PODS = [("turn-smooth", "velocity", "co-rotating"), ("turn-treaded", "displacement", "rectified"),
        ("crush-treaded", "displacement", "co-rotating")]
CONTACTS = [("turn-treaded", "contact", "rectified"), ("crush-smooth", "contact", "co-rotating")]


@pytest.fixture(autouse=True)
def closed() -> None:
    plt.close("all")


def test_the_spectrum_is_that_of_the_pods(paper: rondo.Paper) -> None:
    pods = [paper.pod(*name) for name in PODS]
    ax = modes.plot_pod_spectrum(pods, labels=["a", "b", "c"])
    assert (ax.get_xscale(), ax.get_yscale()) == ("log", "log")
    assert without_unit(ax.figure) == []
    curves = {line.get_label(): line for line in ax.lines}
    for pod, name in zip(pods, "abc"):
        count, left = curves[name].get_data()
        assert np.array_equal(left, pod.discarded_energy[count.astype(int) - 1])
        assert count[0] == 1 and left.min() > modes.FLOOR
        assert len(count) == np.sum(pod.discarded_energy > modes.FLOOR)
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["a", "b", "c"]


def test_labels_of_their_own(paper: rondo.Paper) -> None:
    pods = [paper.pod(*name) for name in PODS]
    legend = modes.plot_pod_spectrum(pods).get_legend()
    assert [text.get_text() for text in legend.get_texts()] == [
        "velocity, rotating", "displacement, rectified", "displacement, rotating"]
    assert modes.plot_pod_spectrum(pods[:1]).get_legend() is None


@pytest.mark.parametrize("name", PODS)
def test_shapes_are_the_modes(paper: rondo.Paper, name: tuple[str, str, str]) -> None:
    pod = paper.pod(*name)
    figure = modes.plot_modes(pod, 4)
    drawn = body_axes(figure)
    assert len(drawn) == 4 and all(ax.get_aspect() == 1.0 for ax in drawn)
    radius = np.linalg.norm(pod.mesh.coordinates, axis=1).max()
    for mode, ax in enumerate(drawn):
        body, = bodies(ax)
        corners = np.array([path.vertices[:4] for path in body.get_paths()])
        move = corners - pod.mesh.coordinates[pod.mesh.cells]
        vectors = pod.spatial[mode][pod.mesh.cells]
        longest = np.linalg.norm(move, axis=2).max()
        size = modes.sign(pod, mode) * np.linalg.norm(pod.spatial[mode], axis=1).max()
        assert np.allclose(move, longest * vectors / size, atol=1e-12)
        assert 0.1 * modes.LARGEST * radius < longest <= modes.LARGEST * radius * (1 + 1e-12)
        outward = pod.mesh.coordinates / np.linalg.norm(pod.mesh.coordinates, axis=1)[:, None]
        radial = np.sum(pod.spatial[mode] * outward, axis=1)[pod.mesh.cells].mean(axis=1)
        radial *= modes.sign(pod, mode)
        assert np.allclose(body.get_array(), radial / np.abs(radial).max())
        assert body.get_clim() == (-1.0, 1.0)
        assert f"mode {mode + 1}: {modes.percent(pod.energy[mode])}" in ax.get_title(loc="left")


@pytest.mark.parametrize("name", PODS + CONTACTS)
def test_axes_have_units_and_courses_are_those_of_the_pod(
        paper: rondo.Paper, name: tuple[str, str, str]) -> None:
    pod = paper.pod(*name)
    figure = pod.plot_modes(3)
    assert without_unit(figure) == []
    courses = [ax for ax in figure.axes if ax.get_xlabel().startswith(("turns", "share"))]
    assert len(courses) == 3
    for mode, ax in enumerate(courses):
        abscissa, course = ax.lines[0].get_data()
        expected = modes.sign(pod, mode) * pod.temporal[: len(course), mode]
        assert np.allclose(course * len(pod.time) ** -0.5, expected)
        if name[0].startswith("crush"):
            assert np.array_equal(abscissa, pod.time)
            assert ax.get_xlabel() == "share of the depth (–)"
        else:
            turned = (pod.angle[0] - pod.angle[: len(course)]) / (2 * np.pi)
            assert np.allclose(abscissa, turned, atol=1e-12)


@pytest.mark.parametrize("name", CONTACTS)
def test_contact_is_drawn_along_the_edge(paper: rondo.Paper, name: tuple[str, str, str]) -> None:
    pod = paper.pod(*name)
    figure = modes.plot_modes(pod, 2)
    assert not body_axes(figure)
    ax = figure.axes[0]
    normal, tangential = ax.lines[:2]
    angle = normal.get_xdata()
    assert np.all(np.diff(angle) > 0)
    points = pod.mesh.coordinates[pod.points]
    order = [int(np.argmin(np.linalg.norm(points / np.linalg.norm(points, axis=1)[:, None]
                                          - [np.sin(a), -np.cos(a)], axis=1)))
             for a in np.radians(angle)]
    largest = modes.sign(pod, 0) * np.abs(pod.spatial[0]).max()
    assert np.allclose(normal.get_ydata(), pod.spatial[0][order, 0] / largest)
    assert np.allclose(tangential.get_ydata(), pod.spatial[0][order, 1] / largest)


def test_signs_make_the_mean_positive_or_else_the_largest() -> None:
    wave = np.sin(2 * np.pi * np.arange(50) / 50)
    courses = np.stack([-1 + 0.1 * wave, 1 + 0.1 * wave, wave + 0.05 - 0.6 * (wave < -0.99),
                        wave - 0.05 + 0.6 * (wave > 0.99)], axis=1)
    pod = types.SimpleNamespace(temporal=courses)
    assert courses[:, 2].mean() > 0 > courses[:, 3].mean()
    assert [modes.sign(pod, mode) for mode in range(4)] == [-1.0, 1.0, -1.0, 1.0]


def test_the_first_rectified_mode_is_the_motion(paper: rondo.Paper) -> None:
    """What goes into contact moves inwards, what leaves it outwards; not the other way round."""
    for name in ("turn-smooth", "turn-treaded"):
        pod = paper.pod(name, "velocity", "rectified")
        figure = modes.plot_modes(pod, 1)
        body, = bodies(body_axes(figure)[0])
        middle = pod.mesh.coordinates[pod.mesh.cells].mean(axis=1)
        strong = np.abs(body.get_array()) > 0.5
        before = middle[:, 0] > 0  # rolling towards +x
        assert np.all(body.get_array()[strong & before] < 0) and np.any(strong & before)
        assert np.all(body.get_array()[strong & ~before] > 0) and np.any(strong & ~before)
        assert figure.axes[1].lines[0].get_ydata().mean() > 0.9


@pytest.mark.parametrize("frame, largest", [("co-rotating", modes.LARGEST),
                                            ("rectified", modes.LARGEST_CLOSE)])
def test_outlines_do_not_cross_themselves(paper: rondo.Paper, frame: str, largest: float) -> None:
    pod = paper.pod("turn-treaded", "velocity", frame)
    sides = outline(pod.mesh.cells)
    pairs = amplitude.near_pairs(pod.mesh.coordinates, sides, np.inf)
    for mode in range(6):
        points, _ = modes.shape(pod, mode, largest)
        assert not amplitude.crossing(points, sides, pairs)


def test_two_lands_are_magnified_until_they_nearly_meet() -> None:
    """Two squares of 1 m, a gap of 0.2 m between them; the left one moves to the right."""
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=float)
    points = np.concatenate([square, square + [1.2, 0.5]])
    sides = np.array([[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]])
    vectors = np.zeros((8, 2))
    vectors[:4, 0] = 1.0
    found = amplitude.without_crossing(points, vectors, sides, 0.9)
    step = 0.9 / amplitude.STEPS
    assert 0.2 * amplitude.MARGIN < found <= 0.2 * amplitude.MARGIN + step
    assert amplitude.without_crossing(points, -vectors, sides, 0.9) == 0.9
    assert amplitude.without_crossing(points, vectors, sides, 0.1) == 0.1
    pairs = amplitude.near_pairs(points, sides, 0.0)
    assert not amplitude.crossing(points, sides, pairs)


def test_a_window_shows_a_part(paper: rondo.Paper) -> None:
    pod = paper.pod("turn-smooth", "velocity", "rectified")
    ax = body_axes(modes.plot_modes(pod, 1, ((-0.2, 0.2), (-0.35, -0.1))))[0]
    assert ax.get_xlim() == (-0.2, 0.2) and ax.get_ylim() == (-0.35, -0.1)


def test_no_more_modes_than_are_kept(paper: rondo.Paper) -> None:
    pod = paper.pod(*PODS[2])
    assert len(body_axes(modes.plot_modes(pod, 1000))) == pod.n_modes


def test_no_modes_at_all() -> None:
    empty = types.SimpleNamespace(directory="nothing", n_modes=0, field="velocity")
    with pytest.raises(rondo.Error, match="nothing: the POD has no modes"):
        modes.plot_modes(empty)
    with pytest.raises(rondo.Error, match="count = 0: at least 1 mode"):
        modes.plot_modes(empty, 0)


def test_fast_courses_are_cut_after_some_periods() -> None:
    time = np.arange(600) / 600
    for swings, shown in ((4, 600), (60, 600 * modes.FEW // 60)):
        courses = np.stack([np.sin(2 * np.pi * swings * time)] * 3, axis=1)
        assert modes.course_shown(types.SimpleNamespace(temporal=courses), 3) == shown


@pytest.mark.parametrize("share, text", [(0.98765, "98.8 %"), (1.0, "100.0 %"),
                                         (0.00045, "0.045 %"), (3e-9, "3e-07 %")])
def test_shares_as_text(share: float, text: str) -> None:
    assert modes.percent(share) == text

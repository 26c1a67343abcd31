# SPDX-License-Identifier: BSD-3-Clause
"""The rigid rim in pictures: which nodes it holds, where it is drawn, and where there is none."""
import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.patches import Polygon

import rondo
from conftest import ROOT, ok
from rondo import style
from rondo.plots import field


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def tyre(tmp_path_factory):
    """A mesh from a file, held along a curve of many pieces."""
    out = tmp_path_factory.mktemp("tyre") / "out"
    ok("run", ROOT / "cases" / "tyre-section.toml", "-o", out, "--set", "time.end=0.003", "--set",
       "output.snapshots=3")
    return rondo.open(out)


def drawn(ax):
    """The grey disk and the line along what is held."""
    disks = [patch for patch in ax.patches if isinstance(patch, Polygon)
             and patch.get_facecolor()[0] == pytest.approx(float(style.RIM))]
    return disks, [line for line in ax.lines if line.get_label() == "_rim"]


def ends(line):
    places = line.get_xydata()
    return {tuple(place) for place in places[np.isfinite(places).all(axis=1)].round(12)}


@pytest.mark.parametrize("frame", field.FRAMES)
def test_the_rim_of_a_disk(smooth, frame):
    run = rondo.open(smooth)
    assert np.array_equal(run.held, np.linalg.norm(run.mesh.coordinates, axis=1) < 0.1501)
    ax = run.plot_field(run.times[-1], frame=frame)
    (disk,), (line,) = drawn(ax)
    k = run.n_snapshots - 1
    middle = run.center[k] if frame == "fixed" else np.zeros(2)
    assert np.allclose(np.linalg.norm(disk.get_xy() - middle, axis=1), run.inner_radius)
    held = field.positions(run, k, frame)[run.held]
    assert ends(line) == {tuple(place) for place in held.round(12)}
    assert disk.get_zorder() < ax.collections[0].get_zorder() < line.get_zorder()


def test_the_rim_of_a_mesh(tyre):
    radii = np.linalg.norm(tyre.mesh.coordinates, axis=1)
    assert 0 < tyre.held.sum() < 100 and np.ptp(radii[tyre.held]) < 1e-9
    (disk,), (line,) = drawn(tyre.plot_field(tyre.times[-1]))
    middle = tyre.center[-1]
    assert np.allclose(np.linalg.norm(disk.get_xy() - middle, axis=1), radii[tyre.held].max())
    assert len(ends(line)) == tyre.held.sum()


def test_the_rim_moves_with_the_film(smooth):
    run = rondo.open(smooth)
    _, ax = plt.subplots()
    body = field.draw_body(ax, run, 0)
    body.update(7)
    assert ends(body.rim.line) == {tuple(p) for p in run.position(7)[run.held].round(12)}
    assert np.allclose(body.rim.disk.get_xy().mean(axis=0), run.center[7], atol=2e-3)


def test_modes_show_the_rim(smooth):
    run = rondo.open(smooth)
    figure = run.pod("displacement").plot_modes(1)
    (disk,), (line,) = drawn(figure.axes[0])
    assert np.allclose(np.linalg.norm(disk.get_xy(), axis=1), run.inner_radius)
    assert len(ends(line)) == run.held.sum()


def test_no_rim(tmp_path):
    case = (ROOT / "cases" / "thrown-disk.toml").read_text()
    (tmp_path / "case.toml").write_text(case)
    ok("run", tmp_path / "case.toml", "-o", tmp_path / "out", "--set", "time.end=0.001", "--set",
       "output.snapshots=2", "--set", "disk.mesh.circumferential=60")
    run = rondo.open(tmp_path / "out")
    assert not run.held.any()
    assert drawn(run.plot_field(run.times[-1])) == ([], [])

# SPDX-License-Identifier: BSD-3-Clause
"""Pressure and shear over the contact patch, at one time and over all of them."""
import matplotlib.pyplot as plt
import numpy as np
import pytest
from drawn import without_unit

import rondo
from conftest import ROOT, ok
from rondo.data.ground import Ground
from rondo.plots import patch
from rondo.plots.field import outline


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def disks(tmp_path_factory):
    """Two bodies that touch each other, without ground."""
    out = tmp_path_factory.mktemp("disks") / "out"
    ok("run", ROOT / "cases" / "two-disks.toml", "-o", out, "--set", "time.end=0.01", "--set",
       "output.snapshots=6")
    return rondo.open(out)


def line(ax, label):
    found, = (curve for curve in ax.lines if curve.get_label() == label)
    return found.get_xydata()[np.isfinite(found.get_ydata())]


@pytest.mark.parametrize("name", ["smooth", "treaded", "crush"])
def test_the_tractions_are_those_of_the_run(runs, name):
    run = rondo.open(runs / name)
    k = run.n_snapshots - 1
    ax = run.plot_contact(run.times[k])
    unit = {"traction (MPa)": 1e-6, "traction (kPa)": 1e-3}[ax.get_ylabel()]
    traction = np.asarray(run.contact.traction[k])
    touching = np.flatnonzero(traction[:, 0] > 0)
    place = run.position(k)[run.contact.nodes[touching], 0] - run.center[k, 0]
    order = np.argsort(place)
    pressure = line(ax, "pressure p")
    assert without_unit(ax.figure) == []
    assert np.allclose(pressure[:, 0], 1e3 * place[order], atol=1e-6)
    assert np.allclose(pressure[:, 1], unit * traction[touching[order], 0])
    shear = line(ax, "_shear")  # > 0 pushes to the right; in the file to the left of the normal
    assert np.allclose(shear[:, 1], -unit * traction[touching[order], 1], atol=1e-12)
    bound = line(ax, f"± μp, μ = {run.friction:g}")
    assert np.allclose(bound[:, 1], run.friction * pressure[:, 1])
    assert np.all(np.abs(shear[:, 1]) <= bound[:, 1] * (1 + 1e-9) + 1e-12)
    assert f"{len(touching)} node" in ax.get_title(loc="left")


def test_sticking_and_slipping_nodes(treaded):
    run = rondo.open(treaded)
    ax = run.plot_contact(run.times[-1])
    dots = {name: line(ax, f"shear, {name}") for name in ("sticks", "slips")
            if f"shear, {name}" in [curve.get_label() for curve in ax.lines]}
    shear, bound = line(ax, "_shear"), line(ax, f"± μp, μ = {run.friction:g}")[:, 1]
    slips = np.abs(np.abs(shear[:, 1]) - bound) <= 1e-9 * bound
    assert sum(map(len, dots.values())) == len(shear)
    assert np.array_equal(dots.get("slips", np.empty((0, 2))), shear[slips])


def test_lines_join_neighbours_only(treaded):
    run = rondo.open(treaded)
    rows = patch.rows_of(run)
    sides = {frozenset(side) for side in outline(run.mesh.cells).tolist()}
    apart = 0
    for k in range(run.n_snapshots):
        found = patch.patch_of(run, rows, k)
        assert np.all(np.diff(found.place) > 0)
        for a, b, joined in zip(found.nodes, found.nodes[1:], found.joined):
            assert joined == (frozenset((int(a), int(b))) in sides)
            apart += not joined
        assert np.all(found.ends[1:, 0] >= found.ends[:-1, 1] - 1e-12) or not len(found.nodes)
    assert apart > 1  # grooves


def test_no_contact_and_no_ground(smooth, air, copy):
    run = rondo.open(smooth)
    ax = run.plot_contact(0.0)
    assert ax.get_title(loc="left") == "t = 0.0 ms, no contact"
    for picture in (lambda: rondo.open(air).plot_contact(0.01), rondo.open(air).plot_contact_map):
        with pytest.raises(rondo.Error, match=r"no contact: the case has neither \[ground\] nor"):
            picture()
    with pytest.raises(rondo.Error, match='quantity "heat": allowed are "pressure" and "shear"'):
        run.plot_contact_map("heat")
    (copy / "contact.csv").write_text((copy / "contact.csv").read_text().split("\n")[0] + "\n")
    with pytest.raises(rondo.Error, match="nothing touches at any of the 11 snapshots"):
        rondo.open(copy).plot_contact_map()


def test_bodies_that_touch_each_other(disks):
    k = int(np.argmax(np.asarray(disks.contact.force[:])[:, :, 0].sum(axis=1)))
    ax = disks.plot_contact(disks.times[k])
    traction = np.asarray(disks.contact.traction[k])[:, 0]
    assert len(line(ax, "pressure p")) == np.sum(traction > 0) > 1
    assert line(ax, "pressure p")[:, 1].max() == pytest.approx(1e-3 * traction.max())
    assert "along the contact" in ax.get_xlabel()
    assert len(line(ax, "± μp, μ = 0.5"))
    assert disks.plot_contact_map("shear").collections


@pytest.mark.parametrize("quantity", patch.QUANTITIES)
@pytest.mark.parametrize("name", ["smooth", "crush"])
def test_the_map_has_each_node_in_its_place(runs, name, quantity):
    run = rondo.open(runs / name)
    ax = run.plot_contact_map(quantity)
    drawn = ax.collections[0]
    edges = drawn.get_coordinates()
    values = drawn.get_array().reshape(np.array(edges.shape[:2]) - 1)
    assert ax.get_xlabel().endswith("(mm)")
    assert ax.get_ylabel() == ("depth (mm)" if run.is_crush else "time (ms)")
    assert len(values) == run.n_snapshots
    factor = {"MPa": 1e-6, "kPa": 1e-3}[ax.figure.axes[1].get_ylabel().split()[1][1:4]]
    part, sense = {"pressure": (0, 1.0), "shear": (1, -1.0)}[quantity]
    for k, row in enumerate(values):
        traction = np.asarray(run.contact.traction[k])
        touching = np.flatnonzero(traction[:, 0] > 0)
        place = run.position(k)[run.contact.nodes[touching], 0] - run.center[k, 0]
        found = row[np.searchsorted(edges[0, :, 0], 1e3 * place) - 1]
        assert not np.ma.is_masked(found)
        assert np.allclose(found, sense * factor * traction[touching, part], atol=1e-12)
        assert len(touching) or row.mask.all()  # white where nothing touches


def test_a_map_on_the_ground(smooth):
    """The patch goes along with the body."""
    run = rondo.open(smooth)
    rows = patch.rows_of(run)
    for k in range(run.n_snapshots):
        moving, still = (patch.patch_of(run, rows, k, moving) for moving in (True, False))
        assert np.allclose(still.place - moving.place, run.center[k, 0], atol=1e-12)
    low, high = run.plot_contact_map(moving=False).get_xlim()
    assert high - low > 1e3 * 0.5 * (run.center[-1, 0] - run.center[0, 0])


def test_lengths_along_a_ledge():
    ledge = Ground(np.array([[-10, -0.1], [0, -0.1], [0, 0], [10, 0]], dtype=float), np.full(4, 0.02))
    assert patch._abscissa(ledge, -3.0) == pytest.approx(7.0)
    around = 0.08 + 0.02 * np.pi / 2  # up to the corner and round it
    assert patch._abscissa(ledge, 0.02) == pytest.approx(10 + around, abs=1e-4)
    assert patch._abscissa(ledge, 4.02) == pytest.approx(14 + around, abs=1e-4)

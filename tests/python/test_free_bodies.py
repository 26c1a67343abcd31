# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of unconstrained bodies: deformation without the motion, energies, films."""
import shutil
import types

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import pytest

import rondo
from conftest import ROOT, ok
from rondo.data.rigid import rigid_motion
from rondo.figures.run_figures import draw_run
from rondo.plots import animation, field

SETTINGS = {  # of cases/, made short
    "two-disks": ["time.end=0.03", "output.snapshots=7"],
    "block-on-incline": ["time.end=0.3", "output.snapshots=4"],
}


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def free(tmp_path_factory):
    """The runs by the names of their cases."""
    folder = tmp_path_factory.mktemp("free")
    for name, settings in SETTINGS.items():
        sets = [word for setting in settings for word in ("--set", setting)]
        ok("run", ROOT / "cases" / f"{name}.toml", "-o", folder / name, *sets)
    return {name: rondo.open(folder / name) for name in SETTINGS}


def turn(angle):
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


def test_a_rigid_motion_leaves_no_deformation():
    """And of what is left, the part along the axes of the body is found again."""
    rng = np.random.default_rng(3)
    mesh = types.SimpleNamespace(n_nodes=9, coordinates=rng.normal(size=(9, 2)),
                                 mass=rng.uniform(1, 2, 9),
                                 free_body=np.array([0, 0, 0, 0, 1, 1, 1, -1, -1]))
    x, motions = mesh.coordinates, ((slice(0, 4), 2.5, [3.0, -1.0]), (slice(4, 7), -3.0, [0, 7.0]))
    u = np.full((9, 2), 0.25)
    for body, angle, shift in motions:
        u[body] = x[body] @ turn(angle).T + shift - x[body]
    rigid = rigid_motion(mesh, u)
    assert np.abs(rigid.deformation[:7]).max() < 1e-14
    assert np.allclose(rigid.places[:7], (x + u)[:7], atol=1e-14)
    assert np.allclose(rigid.angle, [2.5] * 4 + [-3.0] * 3 + [0, 0])
    assert np.array_equal(rigid.deformation[7:], u[7:])  # nodes of the co-rotating frame
    for body, angle, shift in motions:  # a stretch about the center of mass
        middle = np.average(x[body], axis=0, weights=mesh.mass[body])
        u[body] += 0.1 * (x[body] - middle) @ turn(angle).T
        found = rigid_motion(mesh, u).deformation[body]
        assert np.allclose(found, 0.1 * (x[body] - middle), atol=1e-14)


def test_the_deformation_of_a_run(free):
    run = free["two-disks"]
    k = 3
    deformation, mass = run.deformation(k), run.mesh.mass[:, None]
    assert np.abs(run.displacement[k]).max() > 2 * np.abs(deformation).max() > 0
    for body in (0, 1):
        nodes = run.mesh.free_body == body
        assert np.abs((mass * deformation)[nodes].sum(axis=0)).max() < 1e-12
    shown = field.nodal(run, k, "deformation")
    assert np.allclose(shown.values, 1e3 * np.linalg.norm(deformation, axis=1))
    assert (shown.label, shown.unit) == ("deformation", "mm")
    parts = [field.nodal(run, k, f"deformation_{part}").values for part in "xy"]
    assert np.allclose(np.hypot(*parts), shown.values)


def test_of_a_held_body_it_is_the_displacement(smooth):
    run = rondo.open(smooth)
    assert np.array_equal(run.deformation(5), run.displacement[5])
    for ending in ("", "_x", "_radial"):
        assert np.allclose(field.nodal(run, 5, f"deformation{ending}").values,
                           field.nodal(run, 5, f"displacement{ending}").values, atol=1e-12)


def test_magnified(free):
    run = free["two-disks"]
    k, factor = 3, 4.0
    once, still, more = (field.positions(run, k, deformation=f) for f in (1.0, 0.0, factor))
    assert np.allclose(once, run.position(k))
    assert np.allclose(field.positions(run, k, "co-rotating"), once, atol=1e-14)
    assert np.allclose(more - still, factor * (once - still), atol=1e-12)
    sides = run.mesh.cells[:, :2]  # a body that is not deformed is as long as at the start
    lengths = [np.linalg.norm(p[sides[:, 0]] - p[sides[:, 1]], axis=1)
               for p in (still, run.mesh.coordinates)]
    assert np.allclose(*lengths)
    ax = run.plot_field(run.times[k], "deformation", deformation=factor)
    assert ax.get_title().endswith("ms, deformation × 4")


def test_the_work_of_gravity_is_named(free, smooth, air):
    def names(run):
        return [text.get_text() for text in run.plot_energy().get_legend().get_texts()]

    assert "work of gravity" in names(free["block-on-incline"])
    assert not any("frame" in name for name in names(free["block-on-incline"]))
    for run in (rondo.open(smooth), rondo.open(air)):
        assert not any("gravity" in name for name in names(run))
        assert any("frame" in name for name in names(run))


def test_a_history_without_ground(free):
    ax = free["two-disks"].plot_history()
    assert [line.get_label() for line in ax.lines] == ["kinetic energy", "strain energy"]
    assert ax.get_ylabel() == "energy (J/m)"
    assert free["block-on-incline"].plot_history().get_ylabel().startswith(
        "force of the ground\non the body")


def films(run, follow, deformation=1.0):
    chosen = np.arange(run.n_snapshots)
    with matplotlib.rc_context({"figure.constrained_layout.use": False}):
        return animation._Film(run, chosen, "deformation", (0.0, 1.0), follow, 333, (640, 360),
                               deformation)


@pytest.mark.parametrize("follow", [False, True])
@pytest.mark.parametrize("name", SETTINGS)
def test_all_of_the_motion_is_in_the_picture(free, name, follow):
    run = free[name]
    shown = films(run, follow, 3.0)
    sizes = []
    for k in range(run.n_snapshots):
        shown.show(k)
        (left, right), (low, high) = shown.ax.get_xlim(), shown.ax.get_ylim()
        points = field.positions(run, k, deformation=3.0)
        assert np.all((points > (left, low)) & (points < (right, high)))
        sizes.append((right - left, high - low))
        if follow and shown.moves[0]:
            other = run.middle(k)[0] - run.middle(0)[0]
            assert left - shown.low[0, 0] == pytest.approx(other, abs=1e-12)
    assert np.allclose(sizes, sizes[0])
    assert (follow and name == "block-on-incline") <= bool(shown.moves[0])


def test_a_film_follows_and_magnifies(free, tmp_path):
    path = free["block-on-incline"].animate(tmp_path / "film.gif", quantity="deformation",
                                            follow=True, deformation=50.0, width=300)
    assert path.stat().st_size > 1000


def test_a_slender_body_has_room_for_its_numbers(tmp_path):
    shutil.copytree(ROOT / "cases" / "meshes", tmp_path / "meshes")
    shutil.copy(ROOT / "cases" / "bouncing-bar.toml", tmp_path)
    ok("run", tmp_path / "bouncing-bar.toml", "-o", tmp_path / "out", "--set", "time.end=0.1",
       "--set", "output.snapshots=2")
    run = rondo.open(tmp_path / "out")
    ax = run.plot_field(run.times[-1])
    ax.figure.canvas.draw()
    boxes = [label.get_window_extent() for label in ax.get_xticklabels() if label.get_text()]
    assert all(a.x1 < b.x0 for a, b in zip(boxes, boxes[1:]))
    assert {p.stem for p in draw_run(run, tmp_path / "figures")} >= {"field-deformation"}

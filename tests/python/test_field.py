# SPDX-License-Identifier: BSD-3-Clause
"""Fields on the deformed body: nodes where the run has them, colours as the numbers, honest axes;
the ground; and the contact as means by place."""
import matplotlib.pyplot as plt
import numpy as np
import pytest
from drawn import bodies, without_unit
from matplotlib.collections import LineCollection
from matplotlib.colors import to_hex

import rondo
from rondo import style
from rondo.data.ground import Ground
from rondo.plots import contact, field

QUADRILATERALS = np.array([[0, 1, 4, 3], [1, 2, 5, 4]])  # 3 4 5 over 0 1 2
MIXED = np.array([[0, 1, 4, 3], [1, 2, 4, -1]])


@pytest.fixture(params=["ledge-smooth", "ledge-treaded", "crush-smooth"])
def run(paper: rondo.Paper, request: pytest.FixtureRequest) -> rondo.Run:
    return paper.run(request.param)


@pytest.fixture(autouse=True)
def closed() -> None:
    plt.close("all")


def closed_loop(line: np.ndarray) -> set[frozenset[int]]:
    return {frozenset(side) for side in zip(line[:-1].tolist(), line[1:].tolist())}


# The mesh

def test_the_outline_is_the_sides_of_one_cell() -> None:
    sides = {frozenset(side) for side in field.outline(QUADRILATERALS).tolist()}
    assert sides == {frozenset(s) for s in ((0, 1), (1, 2), (2, 5), (5, 4), (4, 3), (3, 0))}
    sides = {frozenset(side) for side in field.outline(MIXED).tolist()}
    assert sides == {frozenset(s) for s in ((0, 1), (1, 2), (2, 4), (4, 3), (3, 0))}


def test_loops_are_the_outline_end_to_end(run: rondo.Run) -> None:
    sides = field.outline(run.mesh.cells)
    lines = field.loops(sides)
    assert len(lines) == 2  # the rim and the edge
    assert all(line[0] == line[-1] for line in lines)
    assert set.union(*map(closed_loop, lines)) == {frozenset(side) for side in sides.tolist()}


def test_a_triangle_among_quadrilaterals() -> None:
    points = np.array([[0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [2, 1]], dtype=float)
    assert field.corners(points, MIXED)[1].tolist() == [[1, 0], [2, 0], [1, 1], [1, 1]]
    assert field.cell_means(np.arange(6.0), MIXED).tolist() == [2.0, pytest.approx(7 / 3)]


# Quantities

def test_components_are_those_of_the_vectors(run: rondo.Run) -> None:
    k = run.n_snapshots - 1
    u = np.asarray(run.displacement[k]) * 1e3  # mm
    cos, sin = np.cos(run.angle[k]), np.sin(run.angle[k])
    values = {name: field.nodal(run, k, f"displacement_{name}") for name in field.COMPONENTS}
    assert np.allclose(values["x"].values, cos * u[:, 0] - sin * u[:, 1], atol=1e-12)
    assert np.allclose(values["y"].values, sin * u[:, 0] + cos * u[:, 1], atol=1e-12)
    assert np.allclose(field.nodal(run, k, "displacement_y", "co-rotating").values, u[:, 1])
    size = field.nodal(run, k, "displacement")
    assert size.unit == "mm" and not size.signed and values["x"].signed
    assert np.allclose(size.values, np.linalg.norm(u, axis=1))
    assert np.allclose(values["radial"].values**2 + values["tangential"].values**2,
                       size.values**2, atol=1e-12)
    outward = np.sum(u * run.mesh.coordinates, axis=1)
    assert np.array_equal(np.sign(values["radial"].values), np.sign(outward))


def test_stress_is_in_megapascal(paper: rondo.Paper) -> None:
    run = paper.run("ledge-smooth")
    stress = field.nodal(run, 5, "von_mises")
    assert (stress.unit, stress.label) == ("MPa", "von Mises stress")
    assert np.allclose(stress.values, 1e-6 * np.asarray(run.field("von_mises")[5]))


def test_what_cannot_be_drawn_is_refused(paper: rondo.Paper) -> None:
    run = paper.run("ledge-smooth")
    with pytest.raises(rondo.Error, match="cauchy_stress: 6 numbers at each node"):
        field.nodal(run, 0, "cauchy_stress")
    with pytest.raises(rondo.Error, match="temperature"):
        field.nodal(run, 0, "temperature")
    with pytest.raises(rondo.Error, match='"standing": allowed are "fixed" and "co-rotating"'):
        run.plot_field(0.1, frame="standing")


def test_the_older_word_for_the_frame_is_warned_of(smooth):
    run = rondo.open(smooth)
    for older in "turning", "rotating":
        with pytest.warns(DeprecationWarning, match=f'"{older}" is called "co-rotating"') as said:
            ax = run.plot_field(run.times[-1], frame=older)
        assert [warning.filename for warning in said] == [__file__]
        assert ax.get_xlabel() == "X (m)"


# Pictures

def test_the_body_is_where_the_run_has_it(run: rondo.Run) -> None:
    ax = run.plot_field(run.times[-1])
    k = run.n_snapshots - 1
    body, = bodies(ax)
    drawn = np.array([path.vertices[:4] for path in body.get_paths()])
    assert np.array_equal(drawn, run.position(k)[run.mesh.cells])
    size = 1e3 * np.linalg.norm(np.asarray(run.displacement[k]), axis=1)
    assert np.allclose(body.get_array(), size[run.mesh.cells].mean(axis=1))
    assert body.get_clim() == (0.0, pytest.approx(body.get_array().max()))  # of what is drawn


def test_update_shows_another_snapshot(run: rondo.Run) -> None:
    _, ax = plt.subplots()
    body = field.draw_body(ax, run, 0, limits=(0, 1))
    k = run.n_snapshots // 2
    body.update(k)
    drawn = np.array([path.vertices[:4] for path in body.cells.get_paths()])
    assert np.array_equal(drawn, run.position(k)[run.mesh.cells])
    size = 1e3 * np.linalg.norm(np.asarray(run.displacement[k]), axis=1)
    assert np.allclose(body.cells.get_array(), size[run.mesh.cells].mean(axis=1))
    edge = np.concatenate([path.vertices for path in body.edge.get_paths()])
    assert {tuple(p) for p in edge} <= {tuple(p) for p in run.position(k)}


def test_frames_and_magnified_displacement(paper: rondo.Paper) -> None:
    run = paper.run("ledge-smooth")
    k = run.n_snapshots - 1
    u, x = np.asarray(run.displacement[k]), run.mesh.coordinates
    assert np.array_equal(field.positions(run, k, "co-rotating", 3.0), x + 3.0 * u)
    assert np.array_equal(field.positions(run, k), run.position(k))
    still = field.positions(run, k, "fixed", 0.0) - run.center[k]
    assert np.allclose(np.linalg.norm(still, axis=1), np.linalg.norm(x, axis=1))
    moved = field.positions(run, k, "fixed", 2.0) - run.position(k)
    assert np.allclose(moved, field.turned(u, run.angle[k]), atol=1e-15)


@pytest.mark.parametrize("frame", field.FRAMES)
def test_axes_are_equal_and_have_units(run: rondo.Run, frame: str) -> None:
    ax = run.plot_field(run.times[-1], "velocity_radial", frame=frame, limits=(-2, 2))
    assert ax.get_aspect() == 1.0
    assert without_unit(ax.figure) == []
    assert bodies(ax)[0].get_clim() == (-2, 2)
    assert bodies(ax)[0].get_cmap().name == style.DIVERGING.name
    points = field.positions(run, run.n_snapshots - 1, frame)
    for low, high, (first, last) in zip(points.min(axis=0), points.max(axis=0),
                                        (ax.get_xlim(), ax.get_ylim())):
        assert first < low and high < last  # nothing is cut off


def test_axes_given_are_drawn_in(run: rondo.Run) -> None:
    figure, (left, right) = plt.subplots(1, 2)
    assert run.plot_field(run.times[-1], ax=right, colorbar=False) is right
    assert len(figure.axes) == 2 and not bodies(left)


def test_a_crush_is_told_by_its_depth(paper: rondo.Paper) -> None:
    crush = paper.run("crush-smooth")
    depth = crush.crush.depth[-1] * 1e3
    assert crush.plot_field(1.0).get_title() == f"depth {depth:.3g} mm"


def marked(ax: plt.Axes) -> set[tuple[float, float]]:
    """The places marked as in contact."""
    lines = [line for line in ax.collections if isinstance(line, LineCollection)
             and to_hex(line.get_color()[0]) == style.CONTACT]
    dots = [line for line in ax.lines if line.get_color() == style.CONTACT]
    shown = {tuple(p) for line in lines for path in line.get_paths() for p in path.vertices}
    return shown | {tuple(p) for line in dots for p in line.get_xydata()}


@pytest.mark.parametrize("frame, deformation", [("fixed", 1.0), ("co-rotating", 1.0),
                                                ("fixed", 2.0)])
def test_the_contact_is_the_nodes_with_a_force(run: rondo.Run, frame: str,
                                               deformation: float) -> None:
    k = run.n_snapshots - 1
    ax = run.plot_field(run.times[k], frame=frame, deformation=deformation)
    force = np.asarray(run.contact.force[k])
    touching = run.mesh.boundary[force[:, 0] > 0]
    points = field.positions(run, k, frame, deformation)
    assert len(touching) and marked(ax) == {tuple(p) for p in points[touching]}


def test_the_contact_follows_the_snapshots(paper: rondo.Paper) -> None:
    run = paper.run("ledge-smooth")
    _, ax = plt.subplots()
    zone = field.draw_contact(ax, run, run.n_snapshots - 1)
    zone.update(0)
    assert not run.contact.force[0].any() and not marked(ax)
    k = run.n_snapshots // 2
    zone.update(k)
    touching = run.mesh.boundary[run.contact.force[k][:, 0] > 0]
    assert marked(ax) == {tuple(p) for p in run.position(k)[touching]}


def test_no_contact_no_arrows(paper: rondo.Paper) -> None:
    run = paper.run("ledge-smooth")
    _, ax = plt.subplots()
    contact.draw_tractions(ax, run, 0, 1e-8)
    assert not ax.collections
    contact.draw_tractions(ax, run, run.n_snapshots - 1, 1e-8)
    arrows, = ax.collections
    assert np.all(arrows.V > 0)  # the level ground pushes upwards
    force = np.asarray(run.contact.traction[run.n_snapshots - 1])
    longest = np.hypot(arrows.U, arrows.V).max()
    assert longest == pytest.approx(1e-8 * np.linalg.norm(force, axis=1).max(), rel=1e-6)


# The ground

def test_no_ground() -> None:
    assert Ground.from_case({"disk": {}}) is None
    assert Ground.from_case({"ground": {"road": "a.crg"}}) is None  # a surface, not a line
    cleat = {"kind": "cleat", "at": 0.3, "height": 0.01, "length": 0.02, "angle": 0.3}
    slope = [[-1.0, 0.0], [1.0, 0.1]]
    assert Ground.from_case({"ground": {"obstacle": [cleat, {**cleat, "at": 0.5}]}}).angle == 0.3
    assert Ground.from_case({"ground": {"obstacle": [cleat, {**cleat, "at": 0.5, "angle": -0.3}]}}) is None
    assert Ground.from_case({"ground": {"obstacle": [cleat], "profile": slope}}) is None
    assert Ground.from_case({"ground": {"obstacle": [{**cleat, "angle": 0.0}], "profile": slope}}).angle == 0.0


def test_flat_ground_reaches_the_window() -> None:
    points = Ground.from_case({"ground": {"profile": "flat", "fillet": 0.0}}).points((-3.0, 4.0))
    assert points[0, 0] <= -3.0 and points[-1, 0] >= 4.0 and not points[:, 1].any()


def test_a_convex_corner_is_an_arc_and_a_concave_one_is_sharp() -> None:
    ledge = Ground(np.array([[-1, -0.1], [0, -0.1], [0, 0], [1, 0]], dtype=float), np.full(4, 0.02))
    points = ledge.points((-0.5, 0.5))
    assert [0.0, -0.1] in points.tolist()  # concave
    assert [0.0, 0.0] not in points.tolist()  # convex
    arc = points[(points[:, 0] > -1e-12) & (points[:, 0] < 0.02 - 1e-12) & (points[:, 1] > -0.02)]
    assert len(arc) > 5
    assert np.allclose(np.linalg.norm(arc - [0.02, -0.02], axis=1), 0.02)
    assert np.all(arc[:, 0] < 0.02) and np.all(np.diff(points[:, 0]) > -1e-12)


def test_end_segments_go_on_as_they_are() -> None:
    slope = Ground(np.array([[0, 0], [1, 1], [2, 1]], dtype=float), np.zeros(3))
    points = slope.points((-2.0, 5.0))
    assert points[0] == pytest.approx([-2.0, -2.0])
    assert points[-1] == pytest.approx([5.0, 1.0])


# Means by place

@pytest.mark.parametrize("friction", ["0.0", "0.2", "0.6"])
def test_the_traction_integrates_to_the_mean_force(paper: rondo.Paper, friction: str) -> None:
    run = paper.run(f"friction-{friction}")
    profile = contact.traction_profile(run)
    assert profile.window == pytest.approx(np.median(run.contact.tributary))
    assert np.allclose(np.diff(profile.x), 0.5 * profile.window)
    force = np.asarray(run.contact.force[:]).sum(axis=1).mean(axis=0)
    assert profile.force() == pytest.approx([-force[1], force[0]], rel=1e-12, abs=1e-9)
    assert contact.mean_force(run) == pytest.approx(profile.force(), rel=1e-12, abs=1e-9)
    # The history has the forces along x and y, means over its intervals: the sign and the size.
    since = run.history["time_s"] >= run.times[0]
    for found, name in zip(profile.force(), ("force_x", "force_y")):
        assert found == pytest.approx(run.history[name][since].mean(), rel=0.01, abs=1e-6)
    assert np.all(np.abs(profile.shear_x) <= run.friction * profile.pressure * (1 + 1e-12) + 1e-6)
    inside = np.abs(profile.x) < 0.25 * run.outer_radius
    assert not profile.pressure[~inside].any() and profile.pressure[inside].max() > 1e6


def test_the_traction_is_the_mean_over_windows(paper: rondo.Paper) -> None:
    """Summed anew, window by window."""
    run = paper.run("friction-0.2")
    profile = contact.traction_profile(run)
    x = np.concatenate([run.position(k)[run.contact.nodes, 0] - run.center[k, 0]
                        for k in range(run.n_snapshots)])
    force = run.contact.force[:].reshape(-1, 2)
    for k in np.flatnonzero(profile.pressure > 0):
        inside = np.abs(x - profile.x[k]) < 0.5 * profile.window
        mean = force[inside].sum(axis=0) / (run.n_snapshots * profile.window)
        assert profile.pressure[k] == pytest.approx(mean[0], rel=1e-9)
        assert profile.shear_x[k] == pytest.approx(-mean[1], rel=1e-9, abs=1e-6)


def test_no_contact_no_profile(paper: rondo.Paper) -> None:
    with pytest.raises(rondo.Error, match="no ground: the case has no"):
        contact.traction_profile(paper.run("spin-up-damped"))
    with pytest.raises(rondo.Error, match="no ground: the case has no"):
        contact.ground_of(paper.run("spin-up-damped"))

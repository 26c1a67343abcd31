# SPDX-License-Identifier: BSD-3-Clause
"""Runs and sweeps of a wheel in three dimensions: what is read, and what pictures show. The runs are
written by hand, with fields in closed form (solids.py, tyres.py)."""
import dataclasses

import matplotlib.pyplot as plt
import numpy as np
import pytest
import solids
import sweeps
import tyres
from drawn import check_files, said, without_unit
from matplotlib.collections import PolyCollection
from matplotlib.quiver import Quiver
from PIL import Image
from test_cli import rondo_module
from test_errors import says

import rondo
from rondo import style
from rondo.data import solid, sweep_table, tyre
from rondo.plots.solid import footprint, surface, view
from rondo.plots.solid.tyre import plot_friction_ellipse, plot_tyre_curves


@pytest.fixture(autouse=True)
def closed_figures():
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("solid")


@pytest.fixture(scope="module")
def run(folder):
    return rondo.open(solids.write_run(folder / "run"))


@pytest.fixture(scope="module")
def maps(folder):
    """Sweeps over slip angle, camber and height, in time and steady, and one of combined slip."""
    return {"time": rondo.open_sweep(tyres.angles(folder / "time", failed=(3,))),
            "steady": rondo.open_sweep(tyres.angles(folder / "steady", steady=True)),
            "combined": rondo.open_sweep(tyres.combined(folder / "combined"))}


# The surface

def test_outer_faces_are_those_of_one_hexahedron_and_look_outward():
    body = solids.box(layers=2, axial=4, sectors=12)
    faces = solid.outer_faces(body.hexahedra)
    assert len(faces) == 12 * (2 * 4 + 2 * 2)  # tread and rim, both sides
    middle, normal = body.points[faces].mean(axis=1), view.normals(body.points, faces)
    radius = np.linalg.norm(middle[:, :2], axis=1)
    side = np.abs(np.abs(middle[:, 2]) - 0.5 * solids.WIDTH) < 1e-12
    assert side.sum() == 12 * 4 and (normal[side, 2] * middle[side, 2] > 0).all()
    outward = np.sum(normal[:, :2] * middle[:, :2], axis=1)[~side]
    assert ((outward > 0) == (radius[~side] > 0.2)).all()
    # Closed: the area vectors add up to nothing.
    a, b, c, d = (body.points[faces[:, k]] for k in range(4))
    assert np.abs(0.5 * np.cross(c - a, d - b).sum(axis=0)).max() < 1e-15


def test_contact_faces_are_the_tread(run):
    faces = solid.contact_faces(run.mesh)
    assert len(faces) == 60 * 4
    assert np.allclose(np.linalg.norm(run.mesh.coordinates[faces][..., :2], axis=-1), solids.OUTER)


def test_axes_of_the_ground_lean_with_the_wheel():
    t1, n, t2 = solid.ground_axes(0.1)
    assert np.allclose(np.cross(t1, n), t2) and n[2] > 0  # γ > 0: the top to -t2
    assert np.allclose(solid.ground_axes(0.1) @ solid.ground_axes(0.1).T, np.eye(3))


# What is read

def test_places_of_the_nodes(run):
    assert run.is_solid and run.mesh.cells.shape == (60 * 2 * 4, 8)
    k = 3
    arms = run.mesh.coordinates + run.displacement[k]
    expected = arms @ solids.turn(run.angle[k]).T
    middle = (run.center[k][0] * np.array([1, 0, 0]) + run.center[k][1] * solid.ground_axes(run.camber)[1]
              + run.lateral[k] * solid.ground_axes(run.camber)[2])
    assert np.allclose(run.position(k), middle + expected, atol=1e-15)
    height = run.on_ground(k)[:, 1]
    assert abs(height.min()) < 1e-15 and (height < 1e-12).sum() >= 10
    assert run.outer_radius == solids.OUTER and run.held.sum() == 60 * 5
    assert run.camber == solids.CAMBER


def test_the_footprint_holds_what_touches(run):
    found = footprint.footprint_of(run, 4)
    rows = run.contact.rows
    chosen = rows["time_s"] == run.times[4]
    assert np.array_equal(found.node, rows["node"][chosen].astype(int))
    # Places from the shape are those of contact.csv.
    assert np.allclose(found.place[:, 0], rows["x_m"][chosen] - run.center[4][0], atol=1e-12)
    assert np.allclose(found.place[:, 1], rows["z_m"][chosen] - run.lateral[4], atol=1e-12)
    assert (found.sticks == (found.place[:, 0] > 0)).all()
    # The pieces tile the surface: their areas are those of the nodes, on the ground.
    x, z = found.pieces[..., 0], found.pieces[..., 1]
    areas = 0.5 * np.abs(np.sum(x * np.roll(z, -1, 1) - z * np.roll(x, -1, 1), axis=1))
    inner = np.isin(np.arange(len(found.node)), np.flatnonzero(np.abs(found.place[:, 0]) < 0.035))
    share = np.bincount(found.owner, areas, len(found.node))
    place = np.flatnonzero(np.isin(run.mesh.boundary, found.node))
    assert np.allclose(share[inner], run.mesh.tributary[place][inner], rtol=0.03)


def test_arrows_do_not_hide_each_other(run):
    found = footprint.footprint_of(run, 4)
    close = dataclasses.replace(found, place=found.place * [0.02, 1.0])
    shown = footprint.apart(close)
    assert len(shown) == 5  # of each four in a row the one with the most shear
    assert set(shown) == {np.flatnonzero(np.isclose(found.place[:, 1], z))[
        np.linalg.norm(found.shear[np.isclose(found.place[:, 1], z)], axis=1).argmax()]
        for z in found.place[shown, 1]}


def test_pieces_of_a_square():
    points = np.array([[0, 0], [2, 0], [2, 2], [0, 2]], dtype=float)
    pieces, owner = footprint.pieces_of(points, np.array([[0, 1, 2, 3]]), np.array([2]))
    assert owner.tolist() == [0]
    assert pieces.tolist() == [[[2, 2], [1, 2], [1, 1], [2, 1]]]


def test_components_about_the_axle():
    u, x = np.array([[3.0, 4.0, 5.0]]), np.array([[0.0, -2.0, 0.1]])
    found = {name: surface.component(u, x, name, 0.5 * np.pi)[0] for name in
             ("", "x", "y", "z", "radial", "tangential", "axial")}
    assert found == pytest.approx({"": 50**0.5, "x": -4, "y": 3, "z": 5, "radial": -4,
                                   "tangential": 3, "axial": 5})


# Pictures of a run

def test_the_picture_of_a_footprint(run):
    figure = run.plot_footprint(0.02)
    left, right = figure.axes[:2]
    assert without_unit(figure) == []
    found = footprint.footprint_of(run, 4)
    cells, = (c for c in left.collections if isinstance(c, PolyCollection) and c.get_array() is not None
              and not isinstance(c, Quiver))
    assert np.allclose(cells.get_array(), 1e-3 * found.pressure[found.owner])  # kPa
    arrows, = (c for c in left.collections if isinstance(c, Quiver))
    shown = footprint.apart(found)
    assert np.allclose(arrows.get_offsets(), 1e3 * found.place[shown]) and len(shown) == 20
    # As long as the shear, to the left of travel, which is up.
    length = 1e3 * footprint.ARROW * footprint.extent(found)
    size = np.linalg.norm(found.shear, axis=1).max()
    assert np.allclose(np.stack([arrows.U, arrows.V], axis=1), found.shear[shown] * length / size)
    assert (arrows.V < 0).all() and left.get_ylim()[0] > left.get_ylim()[1]
    sticks, slips = right.collections
    assert len(sticks.get_paths()) == found.sticks[found.owner].sum()
    assert len(slips.get_paths()) == (~found.sticks)[found.owner].sum()
    assert {text.get_text() for text in right.get_legend().get_texts()} == {"sticks (10)", "slips (10)"}
    for part in ("t = 20.0 ms", "slip angle 2.86°", "camber 1.15°", "= 17.8 kN", "= −1.5 kN"):
        assert part in said(figure)


def test_the_places_of_steady_rolling_are_folded(folder):
    steady = rondo.open(solids.write_run(folder / "steady-run", steady=True))
    found = footprint.folded(steady)
    assert len(found.node) == len(steady.contact.rows["node"]) and footprint.can_fold(steady)
    one = footprint.footprint_of(steady, 0)
    # Within the contact the strips cover it once.
    for line in (-0.02, 0.013):
        def covering(some):
            x, z = some.pieces[..., 0], some.pieces[..., 1]
            return ((x.min(axis=1) <= line) & (line < x.max(axis=1)) & (z.min(axis=1) <= 1e-3)
                    & (1e-3 < z.max(axis=1))).sum()
        assert covering(one) == 1 and covering(found) == 1
    # The pressure is the parabola at each place.
    expected = solids.PRESSURE * (1 - (found.place[:, 0] / solids.HALF) ** 2)
    assert np.allclose(found.pressure, expected, rtol=1e-9, atol=1.0)
    figure = steady.plot_footprint()
    assert "steady rolling" in said(figure) and "= −1.5 kN" in said(figure)
    assert "place 2 of 5" in said(steady.plot_footprint(steady.times[1]))


def test_a_footprint_without_contact_is_refused(run, monkeypatch):
    monkeypatch.setitem(run.contact.rows, "time_s", np.full_like(run.contact.rows["time_s"], 0.02))
    says(rondo.Error, run.plot_footprint, 0.0, words=("nothing touches the ground", "another time"))
    monkeypatch.delitem(run.contact.rows, "shear_lateral_pa")
    says(rondo.Error, run.plot_footprint, 0.0, words=("no column shear_lateral_pa",))


@pytest.mark.parametrize("quantity, unit", [("displacement", "mm"), ("displacement_axial", "mm"),
                                            ("pressure", "MPa")])
def test_the_picture_of_the_surface(run, quantity, unit):
    ax = run.plot_field(0.02, quantity)
    body = ax.collections[2]
    assert unit in ax.figure.axes[-1].get_ylabel()
    seen = view.View(elevation=surface.BELOW if quantity == "pressure" else surface.ABOVE)
    faces = solid.outer_faces(run.mesh.cells)
    points = run.position(4) - run.middle(4)
    order = view.visible(seen, points, faces)
    assert 0 < len(order) < len(faces)
    drawn = np.array([path.vertices[:4] for path in body.get_paths()])
    assert np.allclose(drawn, seen.seen(points[faces[order]])[..., :2], atol=1e-12)
    depth = (points[faces[order]].mean(axis=1)) @ seen.axes[2]
    assert (np.diff(depth) >= 0).all()  # the nearest is drawn last
    if quantity == "pressure":
        colours = body.get_facecolor()
        coloured = np.ptp(colours[:, :3], axis=1) > 0.02
        assert 4 <= coloured.sum() <= 30  # the contact alone; the rest is grey


def test_what_stands_on_the_ground_stands_still_in_pictures(run):
    lines = []
    for k in (1, 2):
        picture = surface.Picture(plt.figure().add_subplot(), run, "displacement", (0.0, 1.0), False,
                                  view.View())
        picture.show_ground(k)
        moved = view.View().seen(run.middle(k))[:2]
        lines.append([segment + moved for segment in picture.lines.get_segments()])
    first, second = (np.array([segment.mean(axis=0) for segment in some if len(segment) == 2])
                     for some in lines)
    apart = np.linalg.norm(first[:, None] - second[None], axis=2).min(axis=1)
    assert (apart < 0.2).sum() >= 3  # of the same lines, seen after 50 mm of travel


def test_a_film(run, tmp_path):
    path = run.animate(tmp_path / "film.gif", quantity="pressure", frames=3, width=320)
    with Image.open(path) as film:
        assert film.n_frames == 3 and film.width == 320
        pictures = []
        for frame in range(3):
            film.seek(frame)
            pictures.append(np.asarray(film.convert("RGB")).astype(int))
    assert np.abs(pictures[0] - pictures[2]).max() > 60


class Recorded:
    """Stands in for pyvista, which is not installed where the tests run: what it is asked for."""

    def __init__(self):
        self.meshes, self.texts, self.shots = [], [], 0

    def PolyData(self, points, faces):
        self.points, self.faces, self.cell_data = np.asarray(points), np.asarray(faces), {}
        made = type("PolyData", (), {"points": points, "faces": faces, "cell_data": {}})()
        self.meshes.append(made)
        return made

    def Plotter(self, off_screen, window_size):
        assert off_screen
        self.size, self.camera = window_size, type("Camera", (), {})()
        return self

    def set_background(self, colour):
        pass

    def add_mesh(self, mesh, **options):
        assert len(mesh.faces) % 5 == 0 and (mesh.faces[::5] == 4).all()
        if "scalars" in options:
            self.limits = options["clim"]

    def add_text(self, text, **options):
        self.texts.append(text)

    def enable_parallel_projection(self):
        self.parallel = True

    def screenshot(self, filename, return_img):
        self.shots += 1
        picture = np.full((self.size[1], self.size[0], 3), 255, dtype=np.uint8)
        picture[:, 20 * self.shots:20 * self.shots + 20] = 0
        return picture


def test_a_film_by_pyvista_is_asked_for_the_same(run, tmp_path, monkeypatch):
    recorded = Recorded()
    monkeypatch.setattr("importlib.util.find_spec", lambda name: object())
    monkeypatch.setitem(__import__("sys").modules, "pyvista", recorded)
    path = run.animate(tmp_path / "film.gif", frames=3, width=320)
    with Image.open(path) as film:
        assert film.n_frames == 3 and film.width == 320
    body = recorded.meshes[0]
    assert np.allclose(body.points, run.position(4) - run.middle(4))
    faces = solid.outer_faces(run.mesh.cells)
    expected = surface.values_of(run, 4, "displacement").values[faces].mean(axis=1)
    assert np.allclose(body.cell_data["values"], expected) and recorded.limits[0] == 0.0
    assert recorded.texts[-1].startswith("t = 20.0 ms") and recorded.parallel


def test_a_film_by_command(run, tmp_path):
    done = rondo_module("animate", run.directory, tmp_path / "film.gif", "--frames", 2)
    assert (done.returncode, done.stderr) == (0, "") and (tmp_path / "film.gif").exists()
    says(rondo.Error, lambda: run.animate(tmp_path / "a.gif", follow=False), words=("goes along",))


def test_renderers(run, tmp_path):
    says(rondo.Error, lambda: run.animate(tmp_path / "a.gif", renderer="povray"),
         words=("povray", "matplotlib"))


def test_what_is_plane_only_is_refused(run):
    for draw, words in ((lambda: run.plot_contact(0.01), ("plot_contact", "plot_footprint")),
                        (run.plot_contact_map, ("plot_contact_map", "plot_footprint")),
                        (lambda: run.rigid(0), ("rigid()",))):
        says(rondo.Error, draw, words=("three dimensions", *words))


def test_a_plane_run_has_no_place_on_the_ground(smooth):
    plane = rondo.open(smooth)
    assert not plane.is_solid
    says(rondo.Error, plane.on_ground, 0, words=("plane body",))
    says(rondo.Error, plane.plot_footprint, 0.01, words=("leave time out",))


def test_figures_by_command(run, tmp_path):
    done = rondo_module("figures", run.directory, "-o", tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    names = {path.name for path in tmp_path.iterdir() if path.suffix == ".png"}
    assert names == {"field-displacement.png", "field-pressure.png", "footprint.png", "forces.png",
                     "energy.png"}
    check_files(tmp_path / "footprint.png", tmp_path / "footprint.svg", style.PAGE, style.DPI)
    done = rondo_module("footprint", run.directory, "--time", 0.01, "-o", tmp_path / "one")
    assert (done.returncode, done.stderr) == (0, "") and (tmp_path / "one" / "footprint.png").exists()
    done = rondo_module("means", run.directory)
    assert "force_lateral -1500 N, moment_aligning -29 N·m" in done.stdout
    done = rondo_module("wheel", run.directory)
    assert done.returncode == 2 and "no [rim]" in done.stderr


# Sweeps

def test_tyre_curves(maps):
    chosen = [maps[name].select({tyres.CAMBER: 0.0}) for name in ("time", "steady")]
    figure = plot_tyre_curves(*chosen)
    assert without_unit(figure) == []
    lateral, aligning = figure.axes
    drawn = [line for line in lateral.lines if len(line.get_xdata()) > 2]
    assert [len(line.get_xdata()) for line in drawn] == [6, 6, 6, 6]  # heights, in time and steady
    for line, height in zip(drawn[:2], (0.29, 0.293)):
        assert np.allclose(line.get_xdata(), tyres.DEGREES)
        expected = [1e-3 * tyres.figures(np.radians(a), 0.0, height)[2] for a in tyres.DEGREES]
        assert np.allclose(line.get_ydata(), expected)
    assert drawn[2].get_linestyle() == "None" and drawn[2].get_color() == drawn[0].get_color()
    texts = [text.get_text() for text in figure.legends[0].get_texts()]
    assert texts == ["height 290 mm", "height 293 mm", "transient", "steady"]
    assert (lateral.get_ylabel(), aligning.get_ylabel()) == ("lateral force (kN)",
                                                             "aligning moment (N·m)")
    assert "camber 0°" in said(figure)


def test_a_failed_member_leaves_a_gap(maps):
    figure = maps["time"].select({tyres.CAMBER: 0.06}).plot_tyre_curves()
    drawn = [line for line in figure.axes[0].lines if len(line.get_xdata()) > 2]
    assert sorted(len(line.get_xdata()) for line in drawn) == [5, 6]


def test_curves_need_a_slip_angle_and_one_more(maps):
    says(rondo.Error, maps["time"].plot_tyre_curves, words=("motion.camber, motion.height", "by="))
    one = maps["time"].select({tyres.ANGLE: 0.0})
    says(rondo.Error, one.plot_tyre_curves, words=("motion.slip_angle does not vary",))
    says(rondo.Error, maps["time"].plot_friction_ellipse, words=("combined slip",))


def test_a_plane_sweep_is_no_tyre(grid):
    says(rondo.Error, grid.plot_tyre_curves, words=("motion.slip_angle does not vary",))
    says(rondo.Error, sweep_table.column_of, grid, "force_lateral", words=("no force_lateral",))


def test_the_friction_ellipse(maps):
    ax = plot_friction_ellipse(maps["combined"])
    sweep = maps["combined"]
    across = sweep["force_lateral_mean"] / sweep["force_y_mean"]
    along = sweep["force_x_mean"] / sweep["force_y_mean"]
    drawn = np.concatenate([line.get_xydata() for line in ax.lines if line.get_marker() == "."])
    assert {tuple(np.round(p, 12)) for p in drawn} == {tuple(np.round(p, 12))
                                                       for p in zip(across, along)}
    assert (np.hypot(across, along) <= tyres.MU + 1e-12).all()
    assert {"3°", "8°", "3 %", "−10 %"} <= {text.get_text() for text in ax.texts}
    assert ax.get_xlabel() == "lateral force over vertical force (–)"


def test_two_sweeps_beside_each_other(maps):
    found = tyre.pairs(maps["time"], maps["steady"])
    assert len(found) == len(maps["time"]) - 1  # one failed
    first = found[0]
    assert first.parameters[tyres.ANGLE] == pytest.approx(np.radians(-4.0))
    expected = [tyres.figures(np.radians(-4.0), 0.0, 0.29, more=more)[2] for more in (1.0, 1.05)]
    assert first.lateral == pytest.approx(expected)
    assert first.difference == pytest.approx((expected[1] - expected[0]) / tyres.load_at(0.29))
    text = tyre.table_of(found, ["transient", "steady"]).splitlines()
    assert len(text) == 1 + len(found) and "slip_angle (deg)" in text[0]
    assert len({len(line) for line in text}) == 1  # columns stand below one another
    says(rondo.Error, tyre.pairs, maps["time"], maps["combined"],
         words=("motion.camber, motion.height varies",))


def test_loads_of_a_rim_and_of_steady_states_are_the_same(folder):
    """In time the load is a table of what pushes the rim down, of steady states a number."""
    loads = (8e3, 13e3)
    members = {"rim.force_y": [(a, f"[[0.0, 0.0], [0.01, -{load}]]") for load in loads for a in (0.0, 0.02)],
               "analysis.load": [(a, load) for load in loads for a in (0.0, 0.02)]}
    sweeps_ = []
    for number, (key, values) in enumerate(members.items()):
        directory = folder / f"loads-{number}"
        rows = [{tyres.ANGLE: a, key: load} | dict(zip(
            tyres.STEADY, tyres.figures(a, more=1.0 + 0.1 * number))) for a, load in values]
        sweeps.write(directory, [(tyres.ANGLE, "rad", "values"), (key, "N/m", "values")], rows,
                     tyres.STEADY)
        sweeps_.append(rondo.open_sweep(directory))
    assert tyre.numbers_of(sweeps_[0], "analysis.load").tolist() == [8e3, 8e3, 13e3, 13e3]
    found = tyre.pairs(*sweeps_)
    assert [pair.parameters["analysis.load"] for pair in found] == [8e3, 8e3, 13e3, 13e3]
    figure = plot_tyre_curves(*sweeps_)
    texts = [text.get_text() for text in figure.legends[0].get_texts()]
    assert texts[:2] == ["load 8 kN", "load 13 kN"]
    drawn = [line for line in figure.axes[0].lines if len(line.get_xdata()) == 2 and line.get_marker() == "s"]
    assert len(drawn) == 2
    assert len(tyre.with_values(sweeps_[0], {"analysis.load": 13e3})) == 2


@pytest.mark.long
def test_tyre_by_command(maps, tmp_path):
    done = rondo_module("tyre", maps["time"].directory, maps["steady"].directory, "-o", tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    names = {path.name for path in tmp_path.iterdir()}
    assert {"tyre-motion.camber.png", "tyre-motion.height.png", "tyre.txt"} <= names
    check_files(tmp_path / "tyre-motion.height.png", tmp_path / "tyre-motion.height.svg", style.PAGE,
                style.DPI)
    done = rondo_module("tyre", maps["combined"].directory, "-o", tmp_path / "combined")
    assert "friction-ellipse.png" in done.stdout and done.returncode == 0
    done = rondo_module("sweep", maps["time"].directory, "-o", tmp_path / "sweep")
    assert (done.returncode, done.stderr) == (0, "")
    assert "main-effects-force_lateral_mean.png" in done.stdout

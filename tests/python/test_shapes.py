# SPDX-License-Identifier: BSD-3-Clause
"""Shapes of modes as drawn, of bodies in the plane and of wheels in three dimensions, computed by the
built program."""
import pathlib
import shutil
import subprocess
import sys

import h5py
import matplotlib.pyplot as plt
import numpy as np
import pytest
from drawn import bodies, body_axes, check_files, panel, without_unit
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure
from program import SMALL, replaced, run

import rondo
from rondo import style
from rondo.data.names import FRAME
from rondo.plots import shapes
from rondo.plots.solid import shapes as solid

HEIGHT = 0.292
SOLID = replaced(replaced(SMALL, "circumferential", "circumferential = 30\naxial = 4"),
                 "outer_radius", "outer_radius = 0.30\nwidth = 0.12")
SOLID = replaced(SOLID, "height", f"height = {HEIGHT}")
RIBBED = replaced(SOLID, "circumferential", "[disk.tread]\npitches = 12\ndepth = 0.03\n"
                  "land_columns = 2\ngroove_columns = 2\nlayers = 1").replace("axial = 4\n", "")
RIBBED = RIBBED.replace("radial = 3", "radial = 3\naxial = 4")


def made(folder: pathlib.Path, name: str, text: str, *more: object) -> rondo.Modes:
    case = folder / f"{name}.toml"
    case.write_text(text)
    done = run("modes", case, "-o", folder / name, "--quiet", "--diameters", 0, *more)
    assert done.returncode == 0, done.stderr
    return rondo.open_modes(folder / name)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> pathlib.Path:
    return tmp_path_factory.mktemp("shapes")


@pytest.fixture(scope="module")
def disk(folder: pathlib.Path) -> rondo.Modes:
    return made(folder, "disk", SMALL, "--count", 8, "--spin", 0, 50)


@pytest.fixture(scope="module")
def wheel(folder: pathlib.Path) -> rondo.Modes:
    return made(folder, "wheel", SOLID, "--count", 9, "--spin", 0, 50)


@pytest.fixture(scope="module")
def standing(folder: pathlib.Path) -> rondo.Modes:
    return made(folder, "standing", SOLID, "--count", 3, "--standing")


@pytest.fixture(autouse=True)
def closed() -> None:
    plt.close("all")


def raw(modes: rondo.Modes, row: int) -> np.ndarray:
    """The real part of a shape, over its longest vector."""
    with h5py.File(modes.directory / "modes.h5") as file:
        real: np.ndarray = file["modes/real"][row]
    return real / np.linalg.norm(real, axis=1).max()


def titles(figure: Figure) -> list[str]:
    return [title for ax in figure.axes if (title := ax.get_title(loc="left"))]


def picked(modes: rondo.Modes, spin: float) -> list[list[int]]:
    """Rows of each picture: pairs at rest, else one."""
    table, groups = modes.table, []
    for row in np.flatnonzero(table["spin_rad_s"] == spin):
        pair = (groups and len(groups[-1]) == 1 and spin == 0 and table["nodal_diameters"][row] > 0
                and abs(table["frequency_hz"][row] / table["frequency_hz"][groups[-1][0]] - 1) < 1e-6)
        if pair:
            groups[-1].append(row)
        else:
            groups.append([row])
    return groups


@pytest.mark.parametrize("spin", [0.0, 50.0])
def test_a_plane_body_moves_by_its_modes(disk: rondo.Modes, spin: float) -> None:
    figure = disk.plot_shapes(4, spin)
    drawn, groups = body_axes(figure), picked(disk, spin)[:4]
    assert len(drawn) == 4 and without_unit(figure) == []
    places, cells = disk.mesh.coordinates, disk.mesh.cells
    outward = places / np.linalg.norm(places, axis=1)[:, None]
    for ax, rows in zip(drawn, groups):
        vectors, (body,) = raw(disk, rows[0]), bodies(ax)
        corners = np.array([path.vertices[:4] for path in body.get_paths()])
        length = np.linalg.norm(corners - places[cells], axis=2).max()
        assert 0.02 < length <= 0.12 * 0.3 * (1 + 1e-12)
        assert np.allclose(corners, places[cells] + length * vectors[cells], atol=1e-12)
        radial = np.sum(vectors * outward, axis=1)[cells].mean(axis=1)
        assert np.allclose(body.get_array(), radial) and body.get_clim() == (-1.0, 1.0)
        still, = (c for c in ax.collections if c.get_label() == "_undeformed")
        assert all(np.isclose(np.linalg.norm(line, axis=1), r).all()
                   for line, r in zip(still.get_segments(), (0.15, 0.30)))


def test_radii_are_sides_of_cells_at_some_angles(disk: rondo.Modes) -> None:
    sides = shapes.radial_sides(disk.mesh.coordinates, disk.mesh.cells)
    ends = disk.mesh.coordinates[sides]
    angle, radius = np.arctan2(ends[..., 1], ends[..., 0]), np.linalg.norm(ends, axis=2)
    assert len(sides) == 3 * shapes.SPOKES  # of three layers
    assert np.allclose(np.exp(1j * angle[:, 0]), np.exp(1j * angle[:, 1]))
    assert np.allclose(np.ptp(radius, axis=1), 0.05)


@pytest.mark.parametrize("spin", [0.0, 50.0])
@pytest.mark.parametrize("kind", ["disk", "wheel"])
def test_titles(request: pytest.FixtureRequest, kind: str, spin: float) -> None:
    modes = request.getfixturevalue(kind)
    figure, table = modes.plot_shapes(5, spin), modes.table
    said = titles(figure)
    groups = picked(modes, spin)[:5]
    assert len(said) == len(groups) == 5 and any(len(rows) == 2 for rows in groups) == (spin == 0)
    for letter, title, rows in zip("abcde", said, groups):
        row = rows[0]
        numbers = ", ".join(str(table["mode"][r]) for r in rows)
        assert title.startswith(f"({letter}) mode{'s' if len(rows) > 1 else ''} {numbers}: "
                                f"{table['frequency_hz'][row]:.4g} Hz\nn = {table['nodal_diameters'][row]},")
        assert title.endswith(f"damping {100 * table['damping_ratio'][row]:.3g} %")
        wave = table["wave"][row]
        assert (f", {wave}," in title) == (wave in ("forward", "backward"))
    words = [text.get_text() for text in figure.texts] + [getattr(figure._suptitle, "_text", "")]
    assert ("spin 50 rad/s" if spin else "at rest") in words


def test_the_first_spin_by_default(disk: rondo.Modes) -> None:
    assert titles(disk.plot_shapes()) == titles(disk.plot_shapes(6, 0.0))
    with pytest.raises(rondo.Error, match="spin=20: there are modes at 0, 50 rad/s"):
        disk.plot_shapes(spin=20.0)
    with pytest.raises(rondo.Error, match="count = 0: at least 1"):
        disk.plot_shapes(0)


@pytest.mark.parametrize("spin", [0.0, 50.0])
def test_curves_are_the_motion_of_the_tread(wheel: rondo.Modes, spin: float) -> None:
    figure = wheel.plot_shapes(5, spin)
    assert without_unit(figure) == []
    places = wheel.mesh.coordinates
    radius, angle = np.linalg.norm(places[:, :2], axis=1), np.arctan2(places[:, 0], -places[:, 1])
    ring = np.flatnonzero((radius > 0.3 - 1e-9) & (np.abs(places[:, 2]) < 1e-9))
    ring = ring[np.argsort(angle[ring])]
    assert len(ring) == 30
    outward = places[ring] * [1, 1, 0] / 0.3
    forward = np.stack([-outward[:, 1], outward[:, 0], 0 * radius[ring]], axis=1)
    panels = [ax for ax in figure.axes if ax.get_xlabel().startswith("angle")]
    for ax, rows in zip(panels, picked(wheel, spin)[:5]):
        vectors = raw(wheel, rows[0])[ring]
        found = {line.get_label(): line.get_xydata() for line in ax.lines}
        for name, along in (("radial", outward), ("tangential", forward), ("lateral", np.array([0, 0, 1]))):
            assert np.allclose(found[name][1:-1], np.stack(
                [np.degrees(angle[ring]), np.sum(vectors * along, axis=1)], axis=1), atol=1e-9)
            assert np.allclose(np.diff(found[name][:, 0]), 12.0)  # closed, at both ends


def test_a_wheel_from_the_side_and_in_its_section(wheel: rondo.Modes) -> None:
    places, rows = wheel.mesh.coordinates, picked(wheel, 0.0)
    row = next(r[0] for r in rows if wheel.table["nodal_diameters"][r[0]] > 0)
    figure = wheel.plot_shapes(5)
    number = [r[0] for r in rows].index(row)
    side, section = figure.axes[3 * number:3 * number + 2]
    vectors = raw(wheel, row)
    moved = places + 0.15 * 0.3 * vectors
    tread, = (line for line in side.lines if line.get_label() == "_tread")
    ring = solid.tread_ring(wheel.mesh)
    assert np.allclose(tread.get_xydata(), moved[np.append(ring, ring[0]), :2])
    faces, = (c for c in side.collections if isinstance(c, PolyCollection))
    near = np.abs(places[:, 2] - 0.06) < 1e-9  # of the side towards the eye
    corners = np.concatenate([path.vertices[:4] for path in faces.get_paths()])
    apart = np.linalg.norm(corners[:, None] - moved[None, near, :2], axis=2).min(axis=0)
    assert apart.max() < 1e-12
    assert faces.get_array().max() <= vectors[:, 2].max() and faces.get_clim() == (-1.0, 1.0)
    # The section: where z and r move most, all of its 3 by 4 quadrilaterals.
    radius = np.linalg.norm(places[:, :2], axis=1)
    radial = np.sum(vectors[:, :2] * places[:, :2], axis=1) / radius
    most = np.hypot(radial, vectors[:, 2]).argmax()
    angle = np.degrees(np.arctan2(places[most, 0], -places[most, 1]))
    said = float(section.get_xlabel().removeprefix("section at ").removesuffix("°").replace("−", "-"))
    there = np.abs((np.degrees(np.arctan2(places[:, 0], -places[:, 1])) - said + 180) % 360 - 180) < 0.6
    assert there.sum() == 20
    assert np.isclose(np.hypot(radial, vectors[:, 2])[there].max(), np.hypot(radial, vectors[:, 2])[most],
                      atol=1e-3), angle
    cells, = (c for c in section.collections if isinstance(c, PolyCollection))
    assert len(cells.get_paths()) == 12
    corners = np.concatenate([path.vertices[:4] for path in cells.get_paths()])
    wanted = np.stack([places[:, 2], radius], axis=1) + 0.045 * np.stack([vectors[:, 2], radial], axis=1)
    assert np.linalg.norm(corners[:, None] - wanted[None, there], axis=2).min(axis=0).max() < 1e-12


def test_the_ring_of_a_tread_goes_all_around(folder: pathlib.Path) -> None:
    modes = made(folder, "ribbed", RIBBED, "--count", 2, "--spin", 0)
    places = modes.mesh.coordinates
    ring = solid.tread_ring(modes.mesh)
    assert len(ring) == 12 * 4
    assert np.allclose(np.linalg.norm(places[ring, :2], axis=1), 0.27)  # at the bottom of the grooves
    assert np.allclose(places[ring, 2], 0.0)
    assert len(modes.plot_shapes().axes) > 3


def test_a_wheel_that_stands(standing: rondo.Modes) -> None:
    figure = standing.plot_shapes()
    load = standing.summary["standing"]["load"]
    assert f"standing under {load:.4g} N" in [text.get_text() for text in figure.texts]
    assert all("n =" not in title and "damping" in title for title in titles(figure))
    ground = [c for c in figure.axes[0].collections if not isinstance(c, LineCollection)][-1]
    assert np.isclose(ground.get_paths()[0].vertices[:, 1].max(), -HEIGHT)
    faces = [c for c in figure.axes[0].collections if isinstance(c, PolyCollection)][0]
    assert ground.get_zorder() > faces.get_zorder()


def test_rigid_motions_are_not_drawn(folder: pathlib.Path) -> None:
    text = replaced(SMALL, "inner_radius", 'inner_radius = 0.15\nrim = "free"')
    for key in "[motion]", "angular_velocity", "speed", "height":
        text = replaced(text, key, None)
    free = made(folder, "free", f"{text}[initial]\nposition = [0.0, 0.3]\n", "--count", 3, "--spin", 0)
    assert list(free.table["wave"][:3]) == ["rigid"] * 3
    assert titles(free.plot_shapes())[0].startswith("(a) modes 4, 5: ")
    only = folder / "only"
    shutil.copytree(free.directory, only)
    lines = (only / "modes.csv").read_text().replace("standing", "rigid")
    (only / "modes.csv").write_text(lines)
    with pytest.raises(rondo.Error, match="only: all modes are rigid-body motions"):
        rondo.open_modes(only).plot_shapes()


def test_a_table_of_an_earlier_version(disk: rondo.Modes, tmp_path: pathlib.Path) -> None:
    shutil.copytree(disk.directory, tmp_path / "older")
    rows = (tmp_path / "older" / "modes.csv").read_text().splitlines()
    (tmp_path / "older" / "modes.csv").write_text("".join(f"{row.rpartition(',')[0]}\n" for row in rows))
    older = rondo.open_modes(tmp_path / "older")
    assert np.isnan(older.table["damping_ratio"]).all()
    assert titles(older.plot_shapes(1))[0].endswith("\nn = 0")


def test_damaged(disk: rondo.Modes, tmp_path: pathlib.Path) -> None:
    shutil.copytree(disk.directory, tmp_path / "cut")
    rows = (tmp_path / "cut" / "modes.csv").read_text().splitlines(keepends=True)
    (tmp_path / "cut" / "modes.csv").write_text("".join(rows[:-1]))
    with pytest.raises(rondo.Error, match="modes.h5 has not the modes of modes.csv"):
        rondo.open_modes(tmp_path / "cut").plot_shapes()
    with h5py.File(tmp_path / "cut" / "modes.h5", "r+") as file:
        file.attrs["format"] = "rondo modes 2"
    with pytest.raises(rondo.Error, match="rondo modes 1"):
        rondo.open_modes(tmp_path / "cut").plot_shapes()


def figures(*arguments: object) -> "subprocess.CompletedProcess[str]":
    return subprocess.run([sys.executable, "-m", "rondo", "figures", *map(str, arguments)],
                          text=True, capture_output=True, timeout=120)


@pytest.mark.parametrize("kind", ["disk", "wheel", "standing"])
def test_command(request: pytest.FixtureRequest, kind: str, tmp_path: pathlib.Path) -> None:
    modes = request.getfixturevalue(kind)
    done = figures(modes.directory, "-o", tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    names = ["shapes"] if kind == "standing" else ["shapes", f"campbell-{FRAME}"]
    wanted = [tmp_path / f"{name}{ending}" for name in names for ending in (".png", ".svg")]
    assert done.stdout.splitlines() == [str(path) for path in wanted]
    check_files(*wanted[:2], style.PAGE, style.DPI)


def test_without_shapes(folder: pathlib.Path, tmp_path: pathlib.Path) -> None:
    """As of a command that was interrupted."""
    modes = made(folder, "spins", SMALL, "--count", 3, "--spins", "0:20:3")
    (modes.directory / "modes.h5").unlink()
    with pytest.raises(rondo.Error, match="spins: has no modes.h5, and so no shapes.*--spin"):
        modes.plot_shapes()
    done = figures(modes.directory, "-o", tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert sorted(p.name for p in tmp_path.iterdir()) == [f"campbell-{FRAME}.png", f"campbell-{FRAME}.svg"]
    (tmp_path / "modes.json").write_text("{}")
    (tmp_path / "modes.csv").write_text("mode\n")
    done = figures(tmp_path)
    assert done.returncode == 2 and "has no modes.h5" in done.stderr


def test_panels_do_not_overlap(wheel: rondo.Modes) -> None:
    """Titles, names and numbers, of all modes."""
    figure = wheel.plot_shapes(6, 50.0)
    figure.canvas.draw()
    texts = [text for ax in figure.axes for text in (
        ax.xaxis.label, ax.yaxis.label, ax._left_title, *ax.get_xticklabels(), *ax.get_yticklabels())
        if text.get_visible() and text.get_text()]
    texts += [*figure.texts, *figure.legends[0].get_texts()]
    boxes = [text.get_window_extent() for text in texts]
    for k, box in enumerate(boxes):
        for other, text in zip(boxes[k + 1:], texts[k + 1:]):
            assert not box.overlaps(other), (texts[k].get_text(), text.get_text())
    assert panel(figure, "f") is not None

# SPDX-License-Identifier: BSD-3-Clause
"""An inflated tyre as the program finds it, read and drawn: section, cords, figures, report."""
import csv
import shutil

import matplotlib.pyplot as plt
import numpy as np
import pytest
from conftest import ROOT, ok
from drawn import bodies, check_files, outline, without_unit
from html_pages import Page, unpacked
from program import run as program
from test_cli import rondo_module
from test_report import stand_in

import rondo
from rondo import style
from rondo.data import solid
from rondo.figures.run_figures import draw_run
from rondo.figures.sweep_figures import usual
from rondo.studies.validate import _full

MESH = ROOT / "tests" / "meshes" / "tyre-205-55-r16.msh"
SECTORS = 24
CASE = f"""schema = 1
title = "a tyre"
[section]
file = "{MESH.name}"
sectors = {SECTORS}
clamped = ["rim-left", "rim-right"]
contact = "tread"
[material]
model = "neo-hooke"
shear_modulus = 1.5e6
poissons_ratio = 0.48
density = 1150.0
[[material.region]]
surface = "sidewall"
shear_modulus = 0.9e6
density = 1120.0
[[material.region]]
surface = "apex"
shear_modulus = 8e6
density = 1180.0
[[cords]]
curve = "carcass"
angle = 1.5707963267948966
stiffness = 1900.0
spacing = 1e-3
spacing_radius = 0.303
[[cords]]
curve = "belt-1"
angle = 0.384
stiffness = 28300.0
spacing = 1.2e-3
[[cords]]
curve = "belt-2"
angle = -0.384
stiffness = 28300.0
spacing = 1.2e-3
[[cords]]
curve = "cap"
angle = 0.0
stiffness = 900.0
spacing = 1e-3
[inflation]
curve = "liner"
pressure = 2.2e5
spin = 50.0
[[inflation.mounting]]
curve = "rim-left"
axial = 0.004
[[inflation.mounting]]
curve = "rim-right"
axial = -0.004
[analysis]
kind = "inflation"
"""
LAYERS = ["carcass", "belt-1", "belt-2", "cap"]
DISK = """schema = 1
title = "a disk with two plies"
[disk]
outer_radius = 0.30
inner_radius = 0.20
width = 0.10
[disk.mesh]
radial = 3
circumferential = 40
axial = 4
[material]
model = "neo-hooke"
shear_modulus = 1.5e6
poissons_ratio = 0.48
density = 1150.0
[[cords]]
curve = "layer-2"
angle = 0.3
stiffness = 2000.0
spacing = 1e-3
[[cords]]
curve = "layer-2"
angle = -0.3
stiffness = 3000.0
spacing = 1e-3
[inflation]
spin = 100.0
[analysis]
kind = "inflation"
"""
STUDY = """schema = 1
title = "pressures"
base = "tyre.toml"
[[vary]]
key = "inflation.pressure"
values = [1.0e5, 1.6e5, 2.2e5]
"""


@pytest.fixture(autouse=True)
def closed_figures():
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Two inflations, `tyre` and `disk`, with their cases beside them."""
    path = tmp_path_factory.mktemp("inflations")
    shutil.copy(MESH, path)
    for name, text in (("tyre", CASE), ("disk", DISK)):
        (path / f"{name}.toml").write_text(text)
        ok("run", path / f"{name}.toml", "-o", path / name)
    return path


@pytest.fixture(scope="module")
def tyre(folder):
    return rondo.open(folder / "tyre")


@pytest.fixture(scope="module")
def disk(folder):
    return rondo.open(folder / "disk")


@pytest.fixture
def copied(folder, tmp_path):
    """A copy of the inflation of the tyre that a test may change."""
    return shutil.copytree(folder / "tyre", tmp_path / "copy")


def rows_of(run):
    """cords.csv, by curve: (rows, 6) in the order of its columns."""
    found = {}
    with open(run.directory / "cords.csv", newline="") as file:
        for curve, *numbers in list(csv.reader(file))[1:]:
            found.setdefault(curve, []).append([float(number) for number in numbers])
    return {curve: np.array(rows) for curve, rows in found.items()}


# Data


def test_times_are_shares_of_the_loads(tyre):
    assert tyre.is_inflation and tyre.is_solid and tyre.time_unit == "1" and tyre.spin == 50.0
    assert np.allclose(tyre.times, np.linspace(0.0, 1.0, 6), rtol=0, atol=1e-12)
    assert tyre.index(0.55) == 3
    with pytest.raises(rondo.Error, match="no snapshot near 1.5 1;"):
        tyre.index(1.5)
    assert tyre.contact is None and tyre.crush is None


def test_the_history_goes_over_the_loads(tyre):
    history = tyre.history
    assert history.abscissa == "load_share" and history.n_rows == 6 and len(history) == 13
    assert "6 rows" in repr(history) and "6 rows" in history._repr_html_()
    assert np.allclose(history["pressure"], 2.2e5 * history["load_share"])
    assert history.units["cord_force_max_n"] == "N" and history.unit_of("outer_radius") == "m"
    told = tyre.info["inflation"]
    for column, member in (("outer_radius_m", "outer_radius_m"), ("det_f_min", "det_f_min"),
                           ("twist_m", "twist_m"), ("width_m", "width_m")):
        assert history[column][-1] == pytest.approx(told[member], rel=1e-12), column
    for call in (lambda: history.mean("outer_radius"), lambda: history.window(0.1)):
        with pytest.raises(rondo.Error, match="an inflation has no .*: its rows are equilibria, over"):
            call()


def test_the_history_as_a_table_of_pandas(tyre):
    pytest.importorskip("pandas")
    table = tyre.history.to_pandas()
    assert table.index.name == "load_share" and table["outer_radius_m"].iloc[-1] > 0.315


def test_a_history_that_lost_a_row_is_damaged(copied):
    path = copied / "history.csv"
    path.write_text("".join(path.read_text().splitlines(keepends=True)[:-1]))
    with pytest.raises(rondo.Error, match="damaged: 5 rows, .* with 6"):
        rondo.open(copied).history


def test_the_section_is_that_of_the_mesh(tyre):
    section, mesh = tyre.section, tyre.mesh
    assert section.cells.shape == (mesh.n_cells // SECTORS, 4)
    assert section.coordinates.shape == (mesh.n_nodes // SECTORS, 2) and section.sectors == SECTORS
    assert (mesh.sector[section.nodes] == 0).all()
    assert np.allclose(section.coordinates[:, 0], -mesh.coordinates[section.nodes, 1], atol=1e-12)
    assert (section.coordinates[:, 1] == mesh.coordinates[section.nodes, 2]).all()
    z, r = section.coordinates[section.cells].transpose(2, 0, 1)[::-1]
    area = 0.5 * ((z * np.roll(r, -1, axis=1)).sum(axis=1) - (r * np.roll(z, -1, axis=1)).sum(axis=1))
    assert (area > 0).all()  # counter-clockwise, z to the right
    volume = 2 * np.pi * np.sum(area * r.mean(axis=1))
    assert volume == pytest.approx(tyre.info["volume"], rel=0.02)  # of the facets: less
    names = [section.region_names[k] for k in section.region]
    assert {"tread", "sidewall", "apex"} <= set(names)
    assert r.mean(axis=1)[np.array(names) == "tread"].min() > 0.29


def test_the_section_is_where_the_snapshots_have_it(tyre):
    section = tyre.section
    assert section.position.shape == (6, len(section.nodes), 2)
    assert np.allclose(section.position[0], section.coordinates, rtol=0, atol=1e-15)
    places = tyre.mesh.coordinates + tyre.displacement[3]
    for sector in (0, 7):  # all columns deform alike
        nodes = section.nodes + sector * len(section.nodes)
        assert (tyre.mesh.sector_node[nodes] == tyre.mesh.sector_node[section.nodes]).all()
        radius = np.hypot(*places[nodes, :2].T)
        assert np.allclose(section.position[3], np.stack([radius, places[nodes, 2]], axis=1), atol=1e-12)
    # r is the distance from the axle, not what is down: the belts turn the tread a little.
    aside = np.abs(places[section.nodes, 0])
    worst = aside.argmax()
    beyond = section.position[3, worst, 0] + places[section.nodes[worst], 1]
    assert aside[worst] > 1e-5 and beyond == pytest.approx(aside[worst] ** 2 / 0.6, rel=0.2)
    tread = np.unique(section.cells[section.region == section.region_names.index("tread")])
    assert section.position[-1, tread, 0].max() == pytest.approx(tyre.history["outer_radius"][-1], rel=1e-12)
    assert np.ptp(section.position[-1, :, 1]) == pytest.approx(tyre.history["width"][-1], rel=1e-9)


@pytest.mark.parametrize("name, number", [(name, number) for number, name in enumerate(
    ("r", "z", "angle", "angle_inflated", "stretch", "force"))])
def test_cords_are_the_columns_of_their_file(tyre, name, number):
    rows = rows_of(tyre)
    assert list(tyre.cords) == list(rows) == LAYERS
    for curve, layer in tyre.cords.items():
        assert layer.curve == curve and (getattr(layer, name) == rows[curve][:, number]).all()


def test_the_length_along_cords(tyre):
    belt = tyre.cords["belt-1"]
    assert belt.arc[0] == 0 and (np.diff(belt.arc) > 0).all()
    assert np.ptp(belt.z) < belt.arc[-1] < 1.1 * np.ptp(belt.z)
    assert "belt-1" in repr(tyre.cords) and len(tyre.cords) == 4
    with pytest.raises(rondo.UnknownNameError, match="no layer of cords 'bead'; there are: carcass, belt-1"):
        tyre.cords["bead"]


def test_layers_along_one_curve_are_told_apart(disk):
    rows = rows_of(disk)["layer-2"]
    first, second = disk.cords["layer-2"], disk.cords["layer-2 (2)"]
    assert len(rows) == 16 and (np.append(first.force, second.force) == rows[:, 5]).all()
    assert np.allclose(first.angle, 0.3) and np.allclose(second.angle, -0.3)
    assert (second.force > first.force).all()


def test_nodes_along_cords(tyre, disk):
    section = tyre.section
    for name, layer in tyre.cords.items():
        (nodes,) = section.nodes_along(layer, 5)
        assert len(layer.starts) == 0 and len(nodes) == len(layer.force) // 2 + 1, name
        z = section.position[5, nodes, 1]
        assert (z[0] < layer.z[0] < z[1]) == (name != "carcass") and z[0] < 0 < z[-1]
        sides = {frozenset(side) for cell in section.cells.tolist() for side in zip(cell, cell[1:] + cell[:1])}
        assert {frozenset(side) for side in zip(nodes.tolist(), nodes.tolist()[1:])} <= sides
        assert section.nodes_along(layer, 0) is None  # undeformed it was elsewhere
    layer = disk.cords["layer-2"]
    along = disk.section.coordinates[disk.section.nodes_along(layer, 5)[0]]
    assert np.ptp(along[:, 0]) < 1e-12 and np.allclose(along[:, 1], np.linspace(-0.05, 0.05, 5))


def test_a_layer_of_several_lines(tmp_path):
    """Turn-ups and bead wires on both sides: their lines are drawn apart."""
    out = tmp_path / "out"
    ok("run", ROOT / "cases" / "tyre-inflation.toml", "-o", out, "--set", f"section.sectors={SECTORS}")
    run = rondo.open(out)
    section, places = run.section, plt.figure().subplots(1, 2)
    for name, count in (("carcass", 1), ("turn-up", 2), ("bead-wire", 6)):
        lines = section.nodes_along(run.cords[name], 5)
        assert len(lines) == count == len(run.cords[name].starts) + 1, name
        assert sum(len(nodes) - 1 for nodes in lines) == len(run.cords[name].force) // 2
    drawn = {line.get_label(): line.get_xydata() for line in run.plot_section(ax=places[0]).lines}
    forces = {line.get_label(): line.get_xydata() for line in run.plot_cords(ax=places[1]).lines}
    for name, gaps in (("carcass", 0), ("turn-up", 1), ("bead-wire", 5)):
        assert np.isnan(drawn[name]).any(axis=1).sum() == gaps == np.isnan(forces[name]).any(axis=1).sum()
    assert not places[0].get_title().count("without")


def test_what_other_runs_do_not_have(smooth):
    run = rondo.open(smooth)
    assert not run.is_inflation
    with pytest.raises(rondo.Error, match='no section of an inflated wheel.*this run has "dynamic"'):
        run.section
    with pytest.raises(rondo.Error, match='"inflation" writes it.*this run has analysis.kind = "dynamic"'):
        run.cords


@pytest.mark.parametrize("text, message", [
    ("", "damaged: it is to begin with the columns curve,r_m"),
    ("curve,r_m,z_m\nbelt,1,2\n", "damaged: it is to begin"),
    ("curve,r_m,z_m,angle_rad,angle_inflated_rad,stretch,force_n\ncap,1,2,3,4,5\n", "damaged: "),
    ("curve,r_m,z_m,angle_rad,angle_inflated_rad,stretch,force_n\ncap,1,2,3,4,5,much\n", "damaged: .*much")])
def test_a_damaged_table_of_cords(copied, text, message):
    (copied / "cords.csv").write_text(text)
    with pytest.raises(rondo.Error, match=message):
        rondo.open(copied).cords


def test_without_cords(copied):
    (copied / "cords.csv").unlink()
    text = (copied / "case.toml").read_text()
    head, tail = text.split("[[cords]]", 1)
    (copied / "case.toml").write_text(head + tail[tail.index("[inflation]"):])
    run = rondo.open(copied)
    with pytest.raises(rondo.Error, match=r"no cords: the case has no \[\[cords\]\]"):
        run.plot_cords()
    ax = run.plot_section()
    assert not list(ax.lines)
    assert [line.get_label() for line in run.plot_history().lines] == ["outer radius"]


# Pictures


def test_the_section_before_and_after(tyre):
    ax = tyre.plot_section()
    section = tyre.section
    assert without_unit(ax.figure) == []
    assert ax.get_aspect() == 1.0
    cells, after, before = ax.collections
    corners = 1e3 * section.position[-1][section.cells][..., ::-1]
    drawn = np.array([path.vertices[:4] for path in cells.get_paths()])
    assert np.allclose(drawn, corners, rtol=0, atol=1e-9)
    colours = [tuple(colour) for colour in cells.get_facecolor()]
    assert len(set(zip(colours, section.region.tolist()))) == len(set(colours)) == 7
    shown = np.concatenate(before.get_segments())
    edge = np.unique(list(outline(section.cells)))
    assert np.allclose(np.unique(shown[:, 1]), np.unique(1e3 * section.coordinates[edge, 0]))
    assert max(before.get_linewidths()) <= 0.6 and before.get_zorder() > after.get_zorder()
    assert [line.get_label() for line in ax.lines] == LAYERS
    for line, name in zip(ax.lines, LAYERS):
        (nodes,) = section.nodes_along(tyre.cords[name], 5)
        assert np.allclose(line.get_xydata(), 1e3 * section.position[-1, nodes][:, ::-1])
    assert ax.get_title() == "100 % of the loads, pressure 220 kPa, spin 50 rad/s"
    assert bodies(ax) == []  # no colours by numbers


def test_names_of_the_section_are_inside_the_figure(tyre):
    ax = tyre.plot_section()
    ax.figure.canvas.draw()
    legends = [artist for artist in ax.get_children() if type(artist).__name__ == "Legend"]
    texts = [[text.get_text() for text in legend.get_texts()] for legend in legends]
    assert sorted(texts, key=len) == [["undeformed", *(f"cords: {name}" for name in LAYERS)],
                                      list(tyre.section.region_names)]
    boxes = [legend.get_window_extent() for legend in legends]
    whole, axes = ax.figure.bbox, ax.get_window_extent()
    assert not boxes[0].overlaps(boxes[1])
    for box in boxes:
        assert box.x0 >= axes.x1 and box.x1 <= whole.x1 and box.y0 >= whole.y0 and box.y1 <= whole.y1


def test_a_magnified_section_at_a_share_of_the_loads(tyre):
    ax = tyre.plot_section(0.4, deformation=3.0)
    section = tyre.section
    wanted = section.coordinates + 3.0 * (section.position[2] - section.coordinates)
    drawn = np.array([path.vertices[:4] for path in ax.collections[0].get_paths()])
    assert np.allclose(drawn, 1e3 * wanted[section.cells][..., ::-1], rtol=0, atol=1e-9)
    (nodes,) = section.nodes_along(tyre.cords["cap"], 5)
    assert np.allclose(ax.lines[3].get_xydata(), 1e3 * wanted[nodes][:, ::-1])
    assert ax.get_title() == "40 % of the loads, pressure 88 kPa, spin 31.62 rad/s, displacement × 3"


def test_the_section_in_given_axes(tyre, disk):
    figure, axes = plt.subplots(1, 2)
    assert tyre.plot_section(ax=axes[0]) is axes[0] and disk.plot_section(ax=axes[1]) is axes[1]
    assert len(figure.axes) == 2 and [len(ax.lines) for ax in axes] == [4, 2]
    assert axes[1].get_title() == "100 % of the loads, spin 100 rad/s"


def test_a_section_whose_cords_are_of_other_loads(copied):
    """A run that fails between two snapshots leaves the cords of its last equilibrium."""
    path = copied / "cords.csv"
    head, *rows = path.read_text().splitlines()
    moved = [[name, str(float(r) + 1e-3), *rest] for name, r, *rest in (row.split(",") for row in rows)]
    path.write_text("\n".join([head, *map(",".join, moved)]) + "\n")
    ax = rondo.open(copied).plot_section()
    assert "without its cords: cords.csv is of later loads" in ax.get_title() and not list(ax.lines)
    path.unlink()
    assert "there is no cords.csv" in rondo.open(copied).plot_section().get_title()


@pytest.mark.parametrize("over", ["arc", "z"])
def test_forces_of_cords(tyre, over):
    ax = tyre.plot_cords(over=over)
    assert without_unit(ax.figure) == []
    zero, *lines = ax.lines
    assert set(zero.get_ydata()) == {0.0} and [line.get_label() for line in lines] == LAYERS
    rows = rows_of(tyre)
    for line, name in zip(lines, LAYERS):
        assert (line.get_ydata() == rows[name][:, 5]).all()
        x = line.get_xdata()
        if over == "z":
            assert np.allclose(x, 1e3 * rows[name][:, 1])
        else:
            assert x[0] == -x[-1] and np.ptp(x) == pytest.approx(1e3 * tyre.cords[name].arc[-1])
    assert max(line.get_ydata().max() for line in lines) == max(table[:, 5].max() for table in rows.values())
    assert ax.get_ylabel() == "force of a cord (N)" and ax.get_title(loc="left") == ""
    styles = {(line.get_color(), line.get_linestyle()) for line in lines}
    assert len(styles) == 4


def test_forces_of_cords_over_something_else(tyre):
    with pytest.raises(rondo.Error, match='over = "r": allowed are arc, z'):
        tyre.plot_cords(over="r")


def test_more_layers_than_styles_differ_by_width(monkeypatch, disk):
    monkeypatch.setattr(style, "CURVES", style.CURVES[:1])
    one, two = disk.plot_section().lines
    assert one.get_color() == two.get_color() and one.get_linewidth() < two.get_linewidth()


def test_the_history_is_drawn_over_the_loads(tyre):
    ax = tyre.plot_history()
    assert [line.get_label() for line in ax.lines] == ["largest force of a cord", "smallest force of a cord"]
    assert (ax.lines[0].get_xdata() == tyre.history["load_share"]).all()
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("share of the loads (–)", "force of a cord (N)")
    assert tyre.plot_history("twist_m").get_ylabel() == "largest displacement around the axle (mm)"


@pytest.mark.parametrize("name, message", [
    ("plot_energy", "an inflation has no energies"), ("plot_spectrum", "an inflation has no course in time"),
    ("plot_psd", "an inflation has no course in time"), ("plot_wheel", "no rim moves"),
    ("plot_footprint", "off the ground"), ("plot_convergence", "LATIN|latin")])
def test_what_an_inflation_does_not_have(tyre, name, message):
    with pytest.raises(rondo.Error, match=message):
        getattr(tyre, name)()
    assert plt.get_fignums() == []


def test_the_surface_says_which_loads(tyre):
    ax = tyre.plot_field(0.6)
    assert ax.get_title() == "60 % of the loads"


# Commands


def test_the_figures_command(folder, tmp_path):
    done = rondo_module("figures", folder / "tyre", "-o", tmp_path)
    assert done.returncode == 0, done.stderr
    names = ("section", "cords", "history")
    assert {path.name for path in tmp_path.iterdir()} == {
        f"{name}{ending}" for name in (*names, "field-displacement") for ending in (".png", ".svg")}
    for name in names:
        check_files(tmp_path / f"{name}.png", tmp_path / f"{name}.svg", style.PAGE, style.DPI)


@pytest.mark.parametrize("command", ["means", "psd", "wheel", "footprint"])
def test_commands_that_have_nothing_to_draw(folder, command):
    done = rondo_module(command, folder / "tyre")
    assert (done.returncode, done.stdout) == (2, "")
    assert "an inflation" in done.stderr and done.stderr.count("\n") == 1


def test_a_film_of_the_loads(folder, tmp_path):
    done = rondo_module("animate", folder / "tyre", tmp_path / "film.gif", "--frames", "2")
    assert done.returncode == 0 and (tmp_path / "film.gif").stat().st_size > 1000, done.stderr


def test_an_inflation_is_no_motion_to_predict(folder):
    with pytest.raises(rondo.Error, match="an inflation is an equilibrium"):
        _full(folder / "tyre")


def test_the_report(tyre, stand_in, tmp_path):
    page = Page(tyre.report(tmp_path / "tyre.html").read_text())
    assert page.faults == [] and page.fetched() == []
    for words in ("an inflation, in three dimensions", "loads reached", "100 %", "smallest det F", "Curves",
                  "Equilibrium under air and spin", "The layers of cords", "belt-2", "Pressure of the air"):
        assert words in page.text, words
    for words in ("Energy balance", "energy balance", "law of contact met", "not known", "output.stress"):
        assert words not in page.text, words
    pictures = [attributes["alt"] for tag, attributes in page.elements if tag == "img"]
    assert [words.split(",")[0] for words in pictures] == [
        "The section", "Force of a cord along each layer", "Displacement at the end"]
    chart = page.data["history-cords"]
    assert chart["x"] == "share of the loads (–)" and chart["y"] == "N"
    assert np.allclose(unpacked(chart["traces"][0]["y"]), tyre.history["cord_force_max_n"], rtol=1e-6)
    assert np.allclose(unpacked(chart["traces"][0]["x"]), tyre.history["load_share"], rtol=1e-6)
    body = page.data["body"]
    assert body["wait"]["kind"] == "inflation" and body["labels"][2] == "40 % of the loads"
    assert [field["name"] for field in body["fields"]] == []
    assert len(body["labels"]) == 6 and len(solid.outer_faces(tyre.mesh.cells)) > 0


def test_the_report_of_one_that_found_no_equilibrium(folder, tmp_path):
    done = program("run", folder / "disk.toml", "-o", tmp_path / "out", "--set", "inflation.spin=1e5", "--quiet")
    assert done.returncode == 3, done.stderr
    run = rondo.open(tmp_path / "out", unfinished=True)
    assert run.status == "failed" and run.history.n_rows >= 1
    page = Page(run.report(tmp_path / "out.html").read_text())
    assert page.faults == [] and run.info["message"] in page.text
    assert 'status "failed"' in page.text and "loads reached" in page.text
    assert len(draw_run(run, tmp_path / "figures")) >= 6


def test_a_sweep_over_the_pressure(folder, tmp_path):
    for name in (MESH.name, "tyre.toml"):
        shutil.copy(folder / name, tmp_path)
    (tmp_path / "study.toml").write_text(STUDY)
    ok("sweep", tmp_path / "study.toml", "-o", tmp_path / "out")
    sweep = rondo.open_sweep(tmp_path / "out")
    assert sweep.analysis == "inflation" and (np.diff(sweep["outer_radius"]) > 0).all()
    assert sweep.run(3).cords["belt-1"].force.max() > sweep.run(1).cords["belt-1"].force.max()
    assert usual(sweep) == ["outer_radius_m", "width_m", "cord_force_max_n", "cord_force_min_n"]
    assert "outer radius" in sweep.plot_spread().get_yticklabels()[0].get_text()
    page = Page(sweep.report(tmp_path / "out.html").read_text())
    assert page.faults == [] and "Equilibrium under air and spin" in page.text

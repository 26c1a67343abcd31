# SPDX-License-Identifier: BSD-3-Clause
"""Reports of all kinds of results: what is in them, as numbers; that they are sound HTML, of one file,
the same bytes each time; that texts of the user do nothing."""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import warnings

import h5py
import numpy as np
import pytest
import solids
import sweeps
from conftest import of_modes
from html_pages import Page, unpacked
from program import PROGRAM, ROOT, SMALL, replaced, run

import rondo
from rondo.data.errors import Error
from rondo.reports import body, encoding, health, histories, paper_page, run_page, sweep_page
from rondo.reports.document import told
from rondo.reports.plotly import find_plotly, plotly

try:
    find_plotly()
    WITHOUT = ""
except Error as missing:
    WITHOUT = str(missing)
    warnings.warn(f"pages are tested with a stand-in for plotly.js: {WITHOUT}", stacklevel=1)

EVIL = '</script><b>&"\'</b><!--'


@pytest.fixture(scope="module", autouse=True)
def stand_in(tmp_path_factory):
    """Nothing here draws curves: where plotly.js is missing a text of its kind stands in the pages."""
    with pytest.MonkeyPatch.context() as given:
        if WITHOUT:
            file = tmp_path_factory.mktemp("plotly") / "plotly-basic.min.js"
            file.write_text("/* plotly.js (basic) is not installed */")
            given.setenv("RONDO_PLOTLY", str(file))
        yield
    plotly.cache_clear()


@pytest.fixture
def plain(monkeypatch):
    """Without figures of matplotlib, which take seconds."""
    monkeypatch.setattr(run_page, "_pictures", lambda run: "<p>pictures</p>")


def page_of(results, folder, name="page.html"):
    page = Page(rondo.report(results, folder / name).read_text())
    assert page.faults == []
    assert page.fetched() == []
    assert any(tag == "html" and attributes.get("lang") == "en" for tag, attributes in page.elements)
    assert "default-src 'none'" in page.source
    return page


@pytest.fixture(scope="module")
def smooth_page(smooth, stand_in, tmp_path_factory):
    return page_of(smooth, tmp_path_factory.mktemp("smooth"))


def test_a_run_has_all_its_parts(smooth_page, smooth):
    for words in ("Summary", "The body", "Histories", "Pictures", "Energy balance", "The case",
                  "energy balance closes to", "critical step", "friction = 0.3", "work_rim", "(3.1)"):
        assert words in smooth_page.text, words
    info = rondo.open(smooth).info
    assert info["host"] in smooth_page.text and str(info["steps"]) in smooth_page.text
    assert sum(tag == "math" for tag, _ in smooth_page.elements) == 6
    assert sum(tag == "img" for tag, _ in smooth_page.elements) >= 4
    assert all(attributes["alt"] for tag, attributes in smooth_page.elements if tag == "img")


def test_the_body_is_where_the_run_has_it(smooth_page, smooth):
    opened, data = rondo.open(smooth), smooth_page.data["body"]
    shown = unpacked(data["displacement"])
    assert np.abs(shown - opened.displacement[:]).max() < 1e-4 * np.abs(shown).max()
    motion = unpacked(data["motion"])[:, 0]
    for k in (0, 5, opened.n_snapshots - 1):
        x, y, _, angle = motion[k]
        arms = unpacked(data["mesh"]["coordinates"]) + shown[k]
        cos, sin = np.cos(angle), np.sin(angle)
        places = [x, y] + arms @ np.array([[cos, sin], [-sin, cos]])
        assert np.abs(places - opened.position(k)).max() < 1e-6
    names = [field["name"] for field in data["fields"]]
    stress = unpacked(data["fields"][names.index("von Mises stress")])
    wanted = 1e-6 * opened.field("von_mises")[:]
    assert np.abs(stress - wanted).max() <= 0.51 / 255 * wanted.max()


def test_forces_on_the_body_are_those_of_the_run(smooth_page, smooth):
    opened, forces = rondo.open(smooth), smooth_page.data["body"]["forces"]
    counts, nodes, vectors = (unpacked(forces[name]) for name in ("counts", "nodes", "vectors"))
    k = opened.n_snapshots - 1
    last = slice(int(counts[:k].sum()), int(counts.sum()))
    whole = np.zeros((opened.mesh.n_nodes, 3))
    whole[nodes[last]] = vectors[last]
    assert counts[k] > 0
    assert np.allclose(whole, opened.field("contact_force")[k], rtol=1e-6)


def test_histories_are_the_columns(smooth_page, smooth):
    traces = smooth_page.data["history-forces"]["traces"]
    history = rondo.open(smooth).history
    assert [trace["name"] for trace in traces] == ["vertical force", "horizontal force"]
    assert smooth_page.data["history-forces"]["y"] == "kN/m"
    assert np.allclose(unpacked(traces[0]["y"]), history["force_y"] / 1e3, rtol=1e-6, atol=1e-6)
    assert np.allclose(unpacked(traces[0]["x"]), history["time"] * 1e3, rtol=1e-6)


RAISED = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹−", "-0123456789-")


def ledger_rows(html):
    """(words, number, column) of the table."""
    rows = re.findall(r'<tr><td>(.*?)</td><td class="number">(.*?)</td><td class="code">(.*?)</td>', html)
    return [(words, float(value.translate(RAISED).replace("·10", "e")), name) for words, value, name in rows]


def test_the_ledger_adds_up(smooth_page, smooth):
    """The energy at the start is that of the first row, and with the changes, by their signs, it makes
    that of the last one."""
    history = rondo.open(smooth).history
    rows = ledger_rows(smooth_page.source.partition("<caption>The ledger at the end")[2].partition("</table>")[0])
    start = [number for words, number, _ in rows if "start" in words]
    assert start == [pytest.approx((history["kinetic"] + history["strain"])[0], rel=1e-3)]
    energies = [number for _, number, name in rows if name in ("kinetic", "strain")]
    changes = [number for _, number, name in rows[3:-1]]
    assert len(energies) == 2 and len(changes) >= 4 and rows[-1][2] == "energy_residual"
    assert sum(energies) == pytest.approx(start[0] + sum(changes), rel=2e-3)
    friction = next(number for words, number, _ in rows if words == "friction")
    assert friction == pytest.approx(-history["dissipation_friction"][-1], rel=1e-3)


def test_a_term_that_the_ledger_lacks_is_told(smooth, monkeypatch):
    assert "not among them" not in health.ledger(rondo.open(smooth))
    monkeypatch.delitem(health.TERMS, "dissipation_friction")
    assert "something is not among them" in health.ledger(rondo.open(smooth))


def test_the_ledger_is_judged_by_the_bound_that_the_run_names(smooth):
    def tile(bound, left):
        opened = rondo.open(smooth)
        opened.info |= {"energy_residual_relative": left, "energy_residual_bound": bound}
        html = health.health_tiles(opened)
        return re.search(r'class="tile (\w*)"><dt>energy balance closes to', html)[1]

    assert [tile(1e-2, 1e-5), tile(1e-9, 1e-5), tile(1e-9, 1e-10)] == ["good", "bad", "good"]


def test_each_column_has_a_curve_or_is_named(smooth_page, smooth):
    shown = {trace["column"] for name, chart in smooth_page.data.items() if name.startswith("history-")
             for trace in chart["traces"]}
    assert {"center_x_m", "angle_rad", "penetration_max_m"} <= shown
    history = rondo.open(smooth).history
    named = set(re.search("Not drawn, as .*?<code>(.*?)</code>", smooth_page.source)[1].split(", "))
    assert shown | named == set(history) - {"time_s"} and not shown & named
    assert not any(np.any(history[name]) for name in named)


def changed_history(folder, column, change):
    """`change` of the numbers of a column."""
    lines = [line.split(",") for line in (folder / "history.csv").read_text().splitlines()]
    at = lines[0].index(column)
    for row, value in enumerate(change(np.array([float(line[at]) for line in lines[1:]])), 1):
        lines[row][at] = repr(float(value))
    (folder / "history.csv").write_text("".join(",".join(line) + "\n" for line in lines))


def test_an_infinite_force_is_a_gap_and_is_told(copy, plain, tmp_path):
    def spoil(values):
        values[3] = np.inf
        return values
    changed_history(copy, "force_y", spoil)
    page = page_of(copy, tmp_path)
    force = unpacked(page.data["history-forces"]["traces"][0]["y"])
    assert np.flatnonzero(~np.isfinite(force)).tolist() == [3] and np.isnan(force[3])
    assert "vertical force in 1 rows" in page.text


def test_curves_of_many_rows_keep_gaps_ends_and_extremes():
    count = 5 * histories.MOST_ROWS + 3
    y = np.sin(np.arange(count)) + 5.0
    y[100], y[200], y[-2] = np.nan, 9.0, -7.0
    curve = histories._curve(np.arange(count, dtype=float), y)
    shown = unpacked(curve["y"])
    assert len(shown) < 0.7 * count and np.isnan(shown).sum() == 1
    assert np.nanmax(shown) == 9.0 and np.nanmin(shown) == -7.0
    assert (shown == 0.0).sum() == 0 and unpacked(curve["x"])[-1] == count - 1


def test_snapshots_that_are_not_finite_are_left_out_and_told(copy, plain, tmp_path):
    with h5py.File(copy / "results.h5", "r+") as file:
        names = []
        file.visititems(lambda name, thing: names.append(name) if name.endswith("/displacement")
                        and isinstance(thing, h5py.Dataset) else None)
        count = len(file[names[0]])
        for name in names:
            file[name][-2:] = np.nan
    page = page_of(copy, tmp_path)
    assert len(page.data["body"]["labels"]) == count - 2
    assert f"2 of {count} snapshots are not shown" in page.text


def test_zero_is_zero_in_colours():
    values = np.array([[0.0, 0.0], [-3.1, 10.7]])
    shown = unpacked(encoding.shades(values))
    assert (shown[0] == 0).all() and np.abs(shown - values).max() <= 0.51 * 13.8 / 254
    assert not unpacked(encoding.shades(np.zeros((2, 3)))).any()


def test_texts_of_the_user_do_nothing(copy, plain, tmp_path):
    case = (copy / "case.toml").read_text().replace('title = "small"', "title = " + json.dumps(EVIL))
    (copy / "case.toml").write_text(case)
    info = json.loads((copy / "run.json").read_text())
    (copy / "run.json").write_text(json.dumps({**info, "warnings": [EVIL], "host": EVIL, "status": "failed",
                                               "message": EVIL}))
    shutil.rmtree(copy / "pod")
    page = page_of(copy, tmp_path)
    assert page.text.count(EVIL) >= 4
    assert EVIL not in page.source and "<b>&\"" not in page.source
    assert "<!--" not in page.source.partition("<body>")[2].partition("<script")[0]


@pytest.mark.parametrize("which", ["crush", "air", "wheel"])
def test_other_runs(which, runs, tmp_path):
    page = page_of(runs / which, tmp_path)
    shown = {"crush": "depth (mm)", "air": "history-energy", "wheel": "history-spin"}[which]
    assert shown in page.data or any(data.get("x") == shown for data in page.data.values())
    assert page.data["body"]["forces"] is None or which != "air"
    assert (page.data["body"]["ground"] is None) == (which == "air")


def test_an_unfinished_run_says_so(killed, plain, tmp_path):
    page = page_of(killed, tmp_path)
    assert "it is still running, or was killed" in page.text and "--resume" in page.text


def test_without_snapshots_the_page_says_what_to_do(plain, tmp_path):
    (tmp_path / "case.toml").write_text(replaced(SMALL, "snapshots", "snapshots = 0"))
    assert run("run", tmp_path / "case.toml", "-o", tmp_path / "none", "--quiet").returncode == 0
    page = page_of(tmp_path / "none", tmp_path)
    assert "output.snapshots=200" in page.text and "body" not in page.data


def test_a_run_without_rows_or_snapshots(copy, plain, tmp_path):
    header = (copy / "history.csv").read_text().splitlines()[0]
    (copy / "history.csv").write_text(header + "\n")
    info = json.loads((copy / "run.json").read_text())
    kept = {key: info[key] for key in ("title", "columns", "analysis", "version")}
    (copy / "run.json").write_text(json.dumps({**kept, "status": "running"}))
    shutil.rmtree(copy / "pod")
    assert "has no rows" in page_of(copy, tmp_path).text


def test_snapshots_of_an_earlier_version(copy, plain, tmp_path):
    of_modes(copy)
    assert "was written with --snapshots modes of an earlier version: run the case again" in page_of(copy, tmp_path).text


def test_a_wheel_in_three_dimensions(plain, tmp_path):
    folder = solids.write_run(tmp_path / "solid")
    page = page_of(folder, tmp_path)
    opened, data = rondo.open(folder), page.data["body"]
    assert data["dimensions"] == 3 and len(data["ground"]["axes"]) == 3
    coordinates, cells = unpacked(data["mesh"]["coordinates"]), unpacked(data["mesh"]["cells"])
    assert len(coordinates) < opened.mesh.n_nodes  # those within are left out
    assert cells.max() == len(coordinates) - 1
    assert "contact pressure" in [field["name"] for field in data["fields"]]


def test_free_bodies_are_where_they_are(plain, tmp_path):
    case = ROOT / "cases" / "two-disks.toml"
    assert run("run", case, "-o", tmp_path / "two", "--quiet", "--set", "output.snapshots=6").returncode == 0
    data, opened = page_of(tmp_path / "two", tmp_path).data["body"], rondo.open(tmp_path / "two")
    frame, middle = unpacked(data["frame"]), np.array(data["middle"])[:, :2]
    arms = unpacked(data["mesh"]["coordinates"]) - middle[frame] + unpacked(data["displacement"])[-1]
    x, y, _, angle = unpacked(data["motion"])[-1][frame].T
    cos, sin = np.cos(angle), np.sin(angle)
    places = np.stack([x + cos * arms[:, 0] - sin * arms[:, 1], y + sin * arms[:, 0] + cos * arms[:, 1]], axis=1)
    assert np.abs(places - opened.position(opened.n_snapshots - 1)).max() < 1e-5


def test_many_snapshots_are_thinned_and_that_is_said(smooth):
    found, words = body.body_of(rondo.open(smooth), 15_000)
    assert len(found["labels"]) < 11 and f"{len(found['labels'])}, evenly spread" in words


@pytest.mark.skipif(bool(WITHOUT), reason=WITHOUT)
@pytest.mark.long
def test_the_ledge_is_below_5_mb(tmp_path):
    done = run("run", ROOT / "cases" / "ledge-treaded.toml", "-o", tmp_path / "ledge", "--quiet")
    assert done.returncode == 0
    path = rondo.open(tmp_path / "ledge").report(tmp_path / "ledge.html")
    assert 1e6 < path.stat().st_size < 5e6


def test_a_sweep(studies, tmp_path):
    page, sweep = page_of(studies / "grid", tmp_path), rondo.open_sweep(studies / "grid")
    assert page.source.index("it blew up") < page.source.index('id="curves"')  # failures first
    rows = page.source.partition('class="sortable"')[2].partition("<tbody>")[2]
    assert [row.split(">")[2].split("<")[0] for row in rows.split("<tr")[1:4]] == ["5", "18", "1"]
    column = page.data["sweep"]["columns"]["force_y_mean"]
    assert unpacked(column["values"]).shape == (int(sweep.done.sum()),)
    assert set(page.data["sweep"]["varied"]) == set(sweep.varied)


def test_a_sweep_without_any_member_done(tmp_path):
    sweeps.write(tmp_path / "none", [("ground.friction", "1", "values")],
                 [{"ground.friction": 0.1 * k, "status": "failed"} for k in (1, 2)])
    assert "No member is done yet" in page_of(tmp_path / "none", tmp_path).text


def test_axes_of_a_sweep_are_columns_that_have_numbers(tmp_path, monkeypatch):
    """Slip and forces of no member are known: others are shown at first."""
    monkeypatch.setattr(sweep_page, "_pictures", lambda *_: "<p>pictures</p>")
    rows = [{"ground.friction": 0.1 * k, "motion.speed": 1.0 * k, "steps": 10.0, "strain_max": 0.01 * k}
            for k in range(1, 5)]
    sweeps.write(tmp_path / "none", [("ground.friction", "1", "values"), ("motion.speed", "m/s", "values")], rows)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        data = page_of(tmp_path / "none", tmp_path).data["sweep"]
    assert "slip_ratio_mean" not in data["columns"]
    assert {data["x"], data["y"]} <= set(data["columns"]) and {data["by"], *data["varied"]} - {""} <= set(data["columns"])
    monkeypatch.setattr(sweep_page, "MOST_POINTS", 60)
    page = page_of(tmp_path / "none", tmp_path)
    assert len(page.data["sweep"]["runs"]) == 2 and "Of 4 members 2, evenly spread" in page.text


def test_a_page_is_the_same_from_anywhere(tmp_path, monkeypatch):
    """Without the path of the results, also where it is of a sweep that goes on, and by a relative path."""
    monkeypatch.setattr(sweep_page, "_pictures", lambda *_: "<p>pictures</p>")
    rows = [{"ground.friction": 0.1 * k, **sweeps.forces(0.1 * k, 30.0)} for k in (1, 2)]
    folder = sweeps.write(tmp_path / "part", [("ground.friction", "1", "values")], rows, status="interrupted")
    monkeypatch.chdir(tmp_path)
    far, near = page_of(folder, tmp_path), page_of(pathlib.Path("part"), tmp_path)
    assert far.source == near.source and str(tmp_path) not in far.source and "-o part --resume" in far.text
    assert told(Error(f"{folder}/results.h5: damaged"), folder) == "part/results.h5: damaged"


@pytest.mark.parametrize("name", ["velocity-rectified", "contact-rotating"])
def test_a_pod(smooth, tmp_path, name):
    page, pod = page_of(smooth / "pod" / name, tmp_path), rondo.open_pod(smooth / "pod" / name)
    decay = unpacked(page.data["decay"]["traces"][0]["y"])
    assert np.allclose(decay, pod.discarded_energy[:len(decay)], rtol=1e-5)
    if pod.field == "velocity":
        shapes = unpacked(page.data["modes-body"]["displacement"])
        assert shapes.shape == pod.spatial.shape
        assert np.allclose(np.linalg.norm(shapes, axis=2).max(axis=1), 1, atol=1e-3)
    else:
        assert "contact-modes" in page.data


def test_the_study_of_the_paper(paper, tmp_path, monkeypatch):
    monkeypatch.setattr(paper_page, "FIGURES", {"figure_5": "few of all, which take long"})
    page = page_of(paper.directory, tmp_path)
    for row in paper.table:
        assert row["quantity"] in page.text
    assert {"body-ledge-smooth", "body-turn-smooth", "body-crush-smooth", "decay"} <= set(page.data)
    assert sum(tag == "img" for tag, _ in page.elements) == 2
    assert len(page.source) < 6e6


def command(*arguments, **options):
    return subprocess.run([sys.executable, "-m", "rondo", "report", *map(str, arguments)], text=True,
                          capture_output=True, timeout=120, **options)


def test_what_cannot_be_is_refused(smooth, tmp_path, monkeypatch):
    assert command(tmp_path / "nothing").returncode == 2
    refused = command(smooth, "-o", tmp_path / "page.txt")
    assert refused.returncode == 2 and "ends in .html" in refused.stderr
    refused = command(smooth, "-o", tmp_path / "no" / "page.html")
    assert refused.returncode == 4 and "choose another -o" in refused.stderr
    monkeypatch.setenv("RONDO_PLOTLY", str(tmp_path / "none.js"))
    refused = command(smooth, "-o", tmp_path / "page.html")
    assert refused.returncode == 2 and "npm install" in refused.stderr and not (tmp_path / "page.html").exists()
    (tmp_path / "none.js").write_text("alert(1)")
    assert "is not plotly-basic" in command(smooth, "-o", tmp_path / "page.html").stderr


def test_the_program_passes_it_on_and_the_same_results_give_the_same_bytes(smooth, smooth_page, tmp_path):
    done = run("report", smooth, "-o", tmp_path / "page.html")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "page.html").read_text() == smooth_page.source
    assert run("report", tmp_path).returncode == 2
    refused = subprocess.run([PROGRAM, "report", str(smooth)], env={"RONDO_PYTHON": "/bin/false"},
                             capture_output=True, text=True)
    assert refused.returncode == 4 and "setup.sh" in refused.stderr
    assert not pathlib.Path(smooth / "report.html").exists()

# SPDX-License-Identifier: BSD-3-Clause
"""The page of a rig that is finished and of one that is not: sound HTML of one file, figures of merit, failed points with
their reasons, trends, the residuals of tyre.tir."""
import pytest
import rigs
from html_pages import Page

import rondo
from rondo.data.tir import write_tir
from rondo.rig import against, report
from rondo.rig.trends import trends

EVIL = '</script><b>&"\'</b><!--'
MERITS = {"lateral": {"figures": {
    "cornering_stiffness": [{"load": load, "pressure": pressure, "value": value} for load, pressure, value in
                            ((2000.0, 1.9e5, 4.0e4), (2000.0, 2.2e5, 3.9e4), (2000.0, 2.5e5, 3.8e4),
                             (4000.0, 2.2e5, 7.0e4), (6000.0, 2.2e5, 8.0e4))],
    "pneumatic_trail": [{"load": load, "pressure": 2.2e5, "value": value} for load, value in
                        ((2000.0, .015), (4000.0, .024), (6000.0, .033))],
    "ply_steer_force": [{"load": 4000.0, "value": 123.0}]}},
    "rolling-resistance": {"figures": {"coefficient": [{"load": 4000.0, "pressure": 2.2e5, "speed": 22.22, "value": 8.25}]}}}


def page_of(folder, name="page.html", compared=None):
    page = Page(report.write(rondo.open_rig(folder), folder / name, compared).read_text())
    assert page.faults == []
    assert page.fetched() == []
    assert "default-src 'none'" in page.source
    return page


def headings(page):
    return [text for tag, attributes in page.elements if tag == "section" for text in [attributes["id"]]]


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """With the coefficients that its points are of, so that the fit is exact."""
    folder = rigs.write(tmp_path_factory.mktemp("report") / "rig", rigs.all_tests(), MERITS,
                        {"friction": 0.9, "loads": [2000.0, 4000.0, 6000.0]})
    write_tir(folder / "tyre.tir", rigs.truth())
    return folder


@pytest.fixture(scope="module")
def whole(finished):
    return page_of(finished)


def test_all_sections_of_a_finished_rig(whole):
    assert headings(whole) == ["summary", "test-vertical", "test-lateral", "test-longitudinal", "test-combined",
                               "test-rolling-resistance", "trends", "fit", "how"]
    assert "5 of 5" in whole.text and "not finished" not in whole.text and "Points without results" not in whole.text
    assert "583" in whole.text  # points: 18 + 195 + 195 + 144 + 27, and 4 more would be failed ones


def test_figures_have_words(whole):
    images = [attributes["alt"] for tag, attributes in whole.elements if tag == "img"]
    assert len(images) >= 9 and len(set(images)) == len(images)
    assert sum("ISO 8855" in words for words in images) >= 6


def test_figures_of_merit_at_the_nominal_state(whole):
    """In the units of tyre engineers: 7e4 N/rad are 1.222 kN per degree."""
    shown = whole.text.split("Figures of merit at the nominal")[1].split("All ")[0]
    for text in ("Cornering stiffness4 kN, 2.2 bar1.222 kN/°", "Pneumatic trail4 kN, 2.2 bar24 mm", "Ply steer force4 kN123 N",
                 "Rolling resistance coefficient4 kN, 2.2 bar, 80 km/h8.25 N/kN"):
        assert text in shown, text
    assert "1.396 kN/°" not in shown and "1.396 kN/°" in whole.text


def test_the_nominal_state_is_that_of_the_settings(tmp_path):
    """The speed of a wheel is near to that of the settings; numbers of round-off are zero."""
    merits = {"rolling-resistance": {"figures": {"coefficient": [
        {"load": load, "pressure": pressure, "speed": speed * pressure / 2.2e5, "value": 1e-3 * load + 1e-5 * pressure + speed}
        for load in (2e3, 4e3, 6e3) for pressure in (2.2e5, 2.21e5) for speed in (10.0, 20.0)]}},
        "lateral": {"figures": {"conicity_force": [{"load": 6e3, "value": -1.3e-9}]}}}
    rows = {"lateral": rigs.all_tests()["lateral"][:1]}
    folder = rigs.write(tmp_path / "rig", rows, merits, {"load": 6e3, "pressure": 2.21e5, "speed": 20.0})
    shown = page_of(folder).text.split("Figures of merit at the nominal")[1].split("All ")[0]
    assert "6 kN, 2.21 bar, 72.3 km/h28.21 N/kN" in shown and "10.0" not in shown
    assert "Conicity force6 kN0 N" in shown


def test_residuals_of_the_fit(whole):
    """The file is exact: rms differences are round-off."""
    shown = whole.text.split("tyre.tir evaluated at the points of the rig")[1]
    for name in ("Fx", "Fy", "Mx", "My", "Mz"):
        assert name in shown
    assert "Fy534" in shown.split("How it was run")[0]


def test_trends_with_both_numbers(finished, whole):
    found = {one.name: one for one in trends(rondo.open_rig(finished))}
    assert {name: one.holds for name, one in found.items()} == {
        "Cornering stiffness grows ever less with the load": True,
        "Cornering stiffness at a low load falls with the pressure": True,
        "Pneumatic trail grows with the load": True, "Radial stiffness grows with the pressure": True}
    assert found["Pneumatic trail grows with the load"].found == "15, 24, 33 mm at 2, 4, 6 kN and 220 kPa"
    for one in found.values():
        assert one.found in whole.text and one.measured in whole.text


def test_trends_that_do_not_hold_are_told(tmp_path):
    merits = {"lateral": {"figures": {"cornering_stiffness": [{"load": load, "pressure": 2e5, "value": load ** 1.5}
                                                              for load in (1e3, 2e3, 3e3)]}}}
    folder = rigs.write(tmp_path / "rig", {"lateral": rigs.all_tests()["lateral"][:1]}, merits)
    assert [one.holds for one in trends(rondo.open_rig(folder))] == [False, None, None, None]


def test_a_rig_that_is_not_finished(tmp_path):
    """A test in the middle with failed points, one that failed as a whole, one that has not begun."""
    rows = [row | ({"status": "failed", "reason": f"no steady state: {EVIL}"} if k in (3, 7) else {})
            for k, row in enumerate(rigs.all_tests()["lateral"][:39])]
    folder = rigs.write(tmp_path / "rig", {"lateral": rows},
                        {"lateral": {"status": "partial"}, "cleat": {"status": "failed", "reason": "no cleat.toml"},
                         "modes": {"status": "not begun"}, "road": {"status": "left out", "reason": "no road"}})
    page = page_of(folder)
    assert "These tests are not finished" in page.text and "0 of 3" in page.text
    assert "point 4 (2 kN, 2.2 bar, α = −3°, 60.1 km/h); point 8 (2 kN, 2.2 bar, α = 1°, 60.1 km/h): no steady state: </script>" in page.text
    assert "Status: failed: no cleat.toml" in page.text and "Status: left out: no road" in page.text and \
        "There is no tyre.tir: rondo.rig.fit.write_tir" in page.text


def test_a_rig_that_has_just_begun(tmp_path):
    folder = rigs.write(tmp_path / "rig", {}, {"vertical": {"status": "running"}})
    page = page_of(folder)
    assert "There is no tyre.tir: no points to fit" in page.text
    assert "0 of 1" in page.text and not [tag for tag, _ in page.elements if tag == "img"]


def test_rondo_report_knows_a_rig(tmp_path):
    folder = rigs.write(tmp_path / "rig", {"vertical": rigs.vertical()})
    assert rondo.report(folder).read_bytes() == report.write(rondo.open_rig(folder), folder / "other.html").read_bytes()


def test_texts_of_the_user_do_nothing(tmp_path):
    folder = rigs.write(tmp_path / "rig", {}, {"cleat": {"status": EVIL}}, {"road": EVIL}, title=EVIL)
    page = page_of(folder)
    assert page.text.count(EVIL) >= 3


def test_measurements_beside_the_rig(tmp_path):
    rows = rigs.all_tests()["lateral"]
    folder = rigs.write(tmp_path / "rig", {"lateral": rows})
    lines = [f"{row['slip_angle']},{row['load']},{1.1 * row['Fy']}" for row in rows if row["pressure"] == rigs.PRESSURE
             and not row["camber"]]
    (tmp_path / "measured.csv").write_text("\n".join(["SLIPANGL,FZW,FYW", *lines]))
    compared = against.compare(rondo.open_rig(folder), tmp_path / "measured.csv")
    page = page_of(folder, compared=compared)
    assert "against" in headings(page) and "measured.csv" in page.text
    assert f"{100 * compared.differences[0].of_largest:.3g} %" in page.text


def test_no_folder_to_write_into(tmp_path):
    folder = rigs.write(tmp_path / "rig", {})
    with pytest.raises(rondo.Error, match="cannot be written.*choose another -o"):
        report.write(rondo.open_rig(folder), tmp_path / "missing" / "page.html")

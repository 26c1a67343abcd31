# SPDX-License-Identifier: BSD-3-Clause
"""Reports in headless Chromium, by clicks: play, slider, fields, zoom, axes, modes; no complaint in the
console, nothing asked of the network, nothing wider than a phone."""
import numpy as np
import pytest
import solids
import sweeps
from browser import WHY_NOT, Browser
from program import ROOT, run

import rondo
from rondo.data.errors import Error
from rondo.plots.cells import cell_means
from rondo.reports import run_page, sweep_page
from rondo.reports.plotly import find_plotly

if WHY_NOT:
    pytest.skip(WHY_NOT, allow_module_level=True)
try:
    find_plotly()
except Error as missing:
    pytest.skip(str(missing), allow_module_level=True)

from selenium.webdriver.common.action_chains import ActionChains  # noqa: E402
from selenium.webdriver.common.by import By  # noqa: E402
from selenium.webdriver.common.keys import Keys  # noqa: E402

COUNT = "return rondo.viewers.length"


@pytest.fixture(scope="module")
def browser():
    opened = Browser()
    yield opened
    opened.close()


@pytest.fixture(scope="module")
def pages(tmp_path_factory, smooth, studies):
    """Reports of a run, a POD, a sweep, a wheel in three dimensions."""
    folder = tmp_path_factory.mktemp("pages")
    wheel = solids.write_run(folder / "solid")
    results = {"run": smooth, "pod": smooth / "pod" / "velocity-rectified", "sweep": studies / "grid",
               "solid": wheel, "disks": folder / "disks", "unknown": folder / "unknown"}
    done = run("run", ROOT / "cases" / "two-disks.toml", "-o", results["disks"], "--quiet", "--set",
               "output.snapshots=6", "--set", "output.stress=true")
    assert done.returncode == 0, done.stderr
    sweeps.write(results["unknown"], [("ground.friction", "1", "values")],
                 [{"ground.friction": 0.1 * k, "steps": 10.0 * k} for k in (1, 2, 3)])
    with pytest.MonkeyPatch.context() as without:  # figures take seconds, and are looked at elsewhere
        for module in (run_page, sweep_page):
            without.setattr(module, "_pictures", lambda *_: "<p>pictures</p>")
        return {name: rondo.report(path, folder / f"{name}.html") for name, path in results.items()}


@pytest.fixture
def page(browser, pages):
    """Opens one; at the end it must have been silent, in the console and on the network."""
    def open_page(name, width=1200, height=800, dark=False):
        browser.look(width, height, dark)
        browser.complaints(), browser.asked()
        browser.open(pages[name])
        if name not in ("sweep", "unknown"):
            browser.until(COUNT)
        return browser
    yield open_page
    assert browser.complaints() == []
    assert browser.asked() == []


def test_play_moves_body_slider_and_time(page):
    browser = page("run")
    before, time = browser.picture(), browser.js("return document.querySelector('.time').textContent")
    assert browser.js("return rondo.viewers[0].playing") is False  # nothing plays by itself
    button = browser.driver.find_element(By.CSS_SELECTOR, ".play")
    button.click()
    browser.until("return Number(document.querySelector('.transport input').value)", lambda value: value >= 2)
    assert button.text.endswith("Pause")
    button.click()
    assert browser.js("return rondo.viewers[0].playing") is False
    assert browser.picture() != before
    assert browser.js("return document.querySelector('.time').textContent") != time


def test_the_slider_and_keys_choose_a_moment(page):
    browser = page("run")
    first = browser.picture()
    slider = browser.driver.find_element(By.CSS_SELECTOR, ".transport input")
    slider.send_keys(Keys.END)
    assert browser.js("return document.querySelector('.time').textContent") == "t = 20.0 ms"
    last = browser.picture()
    assert last != first
    canvas = browser.driver.find_element(By.CSS_SELECTOR, "canvas")
    canvas.send_keys(Keys.HOME)
    assert browser.picture() == first and slider.get_attribute("value") == "0"
    canvas.send_keys(Keys.ARROW_RIGHT)
    assert slider.get_attribute("value") == "1"
    canvas.send_keys(" ")
    assert browser.js("return rondo.viewers[0].playing") is True
    canvas.send_keys(" ")


def test_fields_colours_and_size_are_chosen(page):
    browser = page("run")
    browser.js("rondo.viewers[0].show(10)")
    seen = {browser.picture()}
    for value in range(browser.js("return rondo.viewers[0].fields.length")):
        browser.choose("Colour", str(value))
        seen.add(browser.picture())
    assert len(seen) == 1 + browser.js("return rondo.viewers[0].fields.length")
    assert "MPa" in browser.js("return document.querySelector('.colourbar').textContent")
    for label, value in (("Deformation", "10"), ("from 0", "now")):
        before = browser.picture()
        browser.choose(label, value)
        assert browser.picture() != before, label
    for label in ("forces of contact", "mesh", "view follows"):
        before = browser.picture()
        browser.js("[...document.querySelectorAll('.options label')].find((one) => "
                   f"one.textContent.includes({label!r})).querySelector('input').click()")
        browser.until("return document.querySelector('canvas').width")
        assert browser.picture() != before or label == "view follows", label


def test_the_body_is_seen_in_its_colours(page):
    """Some pixels are of the body, the colour of the darkest is that of the largest value."""
    browser = page("run")
    browser.js("rondo.viewers[0].show(10)")
    shades = browser.js("const v = rondo.viewers[0]; return [...new Set(v.shades(v.k))].length")
    assert shades > 10
    assert browser.js("""const c = document.querySelector('canvas'), d = c.getContext('2d').getImageData(
        0, 0, c.width, c.height).data; let n = 0; for (let k = 3; k < d.length; k += 4) n += d[k] > 0;
        return n / (c.width * c.height)""") > 0.2


def test_the_nodes_are_drawn_where_the_run_has_them(page, smooth):
    browser, opened = page("run"), rondo.open(smooth)
    for k in (0, 3, opened.n_snapshots - 1):
        places = np.array(browser.js(f"return Array.from(rondo.viewers[0].places({k}))")).reshape(-1, 2)
        assert np.abs(places - opened.position(k)).max() < 2e-6
    values = browser.js("const v = rondo.viewers[0]; v.field = 0; return v.range(0)[1]")
    speed = np.linalg.norm(opened.velocity[:], axis=2)[:, opened.mesh.cells].mean(axis=2)
    assert values == pytest.approx(speed.max(), rel=0.01)


def test_triangles_have_the_colour_of_their_mean(page, pages):
    browser, opened = page("disks"), rondo.open(pages["disks"].with_suffix(""))
    assert (opened.mesh.cells < 0).any() or opened.mesh.cells.shape[1] == 3
    names = browser.js("return rondo.viewers[0].data.fields.map((field) => field.name)")
    tops = browser.js(f"const v = rondo.viewers[0]; v.field = {names.index('von Mises stress')}; return v.range(0)[1]")
    stress = opened.field("von_mises")
    wanted = max(cell_means(stress[k], opened.mesh.cells).max() for k in range(opened.n_snapshots)) * 1e-6
    assert tops == pytest.approx(wanted, abs=1.01 / 254 * np.max(stress[:]) * 1e-6)
    corners = browser.js("""const v = rondo.viewers[0]; v.show(0); v.field = 0; v.data.fields[0].low = 0;
        v.data.fields[0].scale = 1; v.fields[0].fill(0); v.fields[0][v.cells[2]] = 3; v.wholeRange = false;
        return v.range(0)[1]""")
    assert corners == pytest.approx(1.0)  # a third of it, in each triangle round the node


def test_a_field_of_nothing_is_zero_in_the_colour_of_zero(page):
    browser = page("run")
    found = browser.js("""const v = rondo.viewers[0]; v.field = v.data.fields.findIndex((one) => one.signed);
        v.data.fields[v.field].low = 0; v.fields[v.field].fill(0); v.show(0);
        return [v.field, v.range(0)[1], [...new Set(v.shades(0))], v.bar.textContent]""")
    assert found[0] >= 0 and found[1] == 0 and found[2] == [32] and "00 MPa" in found[3]


def test_a_sweep_without_slip_and_forces_is_drawn(page):
    browser = page("unknown")
    browser.js("document.getElementById('curves').scrollIntoView()")
    browser.until("return document.querySelector('.plot-sweep')?.data?.length > 0")


def test_the_browser_is_blamed_only_where_it_lacks_something(page):
    browser = page("run")
    words = "const p = document.createElement('p'); rondo.refuse(p, 'because'); return p.textContent"
    assert "because" in browser.js(words) and "2023" not in browser.js(words)
    assert "2023" in browser.js("delete window.DecompressionStream; " + words)


def test_numbers_of_the_ledger_are_seen_on_a_phone(page):
    browser = page("run", 390, 844)
    browser.js("document.getElementById('ledger').scrollIntoView()")
    right, edge = browser.js("""const right = (one) => one.getBoundingClientRect().right;
        return [Math.max(...[...document.querySelectorAll('#ledger td.number')].map(right)),
                right(document.querySelector('#ledger .wide'))]""")
    assert 0 < right <= edge <= 390


def test_curves_zoom_by_dragging_and_come_back(page):
    browser = page("run")
    browser.js("document.getElementById('histories').scrollIntoView()")
    browser.until("return document.querySelector('.plot .nsewdrag') !== null")
    place = "document.querySelector('.plot')"
    whole = browser.js(f"return {place}._fullLayout.xaxis.range.slice()")
    layer = browser.driver.find_element(By.CSS_SELECTOR, ".plot .nsewdrag")
    ActionChains(browser.driver).move_to_element_with_offset(layer, -100, -40).click_and_hold().move_by_offset(
        120, 60).move_by_offset(20, 10).release().perform()
    zoomed = browser.until(f"return {place}._fullLayout.xaxis.range.slice()", lambda now: now != whole)
    assert zoomed[1] - zoomed[0] < 0.5 * (whole[1] - whole[0])
    ActionChains(browser.driver).double_click(layer).perform()
    browser.until(f"return {place}._fullLayout.xaxis.range.slice()", lambda now: now == pytest.approx(whole))


def test_no_button_sends_anything_away(page):
    browser = page("run")
    browser.js("document.getElementById('histories').scrollIntoView()")
    titles = browser.until("return [...document.querySelectorAll('.modebar-btn')].map((b) => "
                           "b.getAttribute('data-title') ?? b.getAttribute('data-attr') ?? '')")
    assert titles and not [title for title in titles if "hare" in title or "loud" in title]


def test_modes_are_chosen_and_swing(page):
    browser = page("pod")
    still = browser.picture()
    browser.js("rondo.viewers[0].show(12)")
    first = browser.picture()
    browser.choose("Mode", "1")
    assert len({still, first, browser.picture()}) == 3
    assert "phase 90°" in browser.js("return document.querySelector('.time').textContent")


def test_a_wheel_is_turned_by_dragging(page):
    browser = page("solid")
    before = browser.picture()
    canvas = browser.driver.find_element(By.CSS_SELECTOR, "canvas")
    ActionChains(browser.driver).click_and_hold(canvas).move_by_offset(80, -200).release().perform()
    after = browser.picture()
    assert after != before
    assert browser.js("return rondo.viewers[0].scene.azimuth") == pytest.approx(0.6 - 0.8)
    browser.choose("Colour", "1")
    assert browser.picture() != after


def test_axes_of_a_sweep_are_chosen(page):
    browser = page("sweep")
    browser.js("document.getElementById('curves').scrollIntoView()")
    browser.until("return document.querySelector('.plot-sweep')?.data?.length > 0")
    plot = "document.querySelector('.plot-sweep')"
    before = browser.js(f"return {plot}.layout.yaxis.title.text")
    browser.choose("up", "force_y_mean")
    assert browser.until(f"return {plot}.layout.yaxis.title.text", lambda now: now != before).startswith("vertical")
    browser.choose("across", "ground.friction")
    assert "friction" in browser.until(f"return {plot}.layout.xaxis.title.text", lambda now: "friction" in now)
    browser.choose("Show", "map")
    browser.until(f"return {plot}.data[0].mode", lambda now: now == "markers")


def test_members_are_sorted_by_a_click(page):
    browser = page("sweep")
    first = "return document.querySelector('.sortable tbody tr').cells[0].textContent"
    assert browser.js(first) == "5"  # the failures
    head = browser.driver.find_element(By.CSS_SELECTOR, ".sortable th button")
    for wanted in ("1", "24"):
        browser.js("arguments[0].click()", head)
        assert browser.js(first) == wanted


@pytest.mark.parametrize("dark", [False, True])
@pytest.mark.parametrize("name", ["run", "pod", "sweep", "solid"])
def test_a_phone_shows_all_without_scrolling_aside(page, name, dark):
    browser = page(name, 390, 844, dark)
    for section in browser.js("return [...document.querySelectorAll('section')].map((one) => one.id)"):
        browser.js(f"document.getElementById({section!r}).scrollIntoView()")
    assert browser.js("return document.documentElement.scrollWidth") <= 390  # innerWidth grows with it
    ground, text = browser.js("const s = getComputedStyle(document.body); return [s.backgroundColor, s.color]")
    light = [sum(int(part) for part in colour[4:-1].split(",")) for colour in (ground, text)]
    assert (light[0] < light[1]) == dark and abs(light[0] - light[1]) > 450

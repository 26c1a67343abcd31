# SPDX-License-Identifier: BSD-3-Clause
"""The site of the documentation in headless Chromium: every equation is drawn, no console says anything, nothing
is wider than a phone, search answers, both palettes.

    python3 tests/docs/test_site_browser.py [--all]

Without --all: the page with most equations and the first page of each folder as files, the rest over http from
127.0.0.1. With it: all pages with an equation and all of docs/ too, and the rest also with the site opened as files.

Skipped, with a word, where there is no Chromium with its driver and Selenium."""
import functools
import http.server
import pathlib
import shutil
import subprocess
import sys
import tempfile
import threading
import time

from pages import ROOT

LEFT_OUT = 77
PHONE, DESK = (390, 844), (1400, 1000)
WAIT = 20.0

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
except ImportError:
    webdriver = None

STATE = """
const all = (what) => [...document.querySelectorAll(what)];
return {width: document.documentElement.scrollWidth, maths: all('.arithmatex').length,
        drawn: all('.arithmatex .katex-html').length, wrong: all('.katex-error').map(e => e.title),
        tags: all('.katex-html > .tag').length,
        asked: all('.arithmatex annotation').filter(e => e.textContent.includes('\\\\tag')).length,
        far: performance.getEntriesByType('resource').map(e => e.name)
             .filter(name => !name.startsWith('file:') && !name.startsWith('blob:') && !name.startsWith('data:')
                             && new URL(name).host !== location.host)};
"""


def browser():
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--hide-scrollbars"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)


def size(driver, width, height):
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
        "width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 500})


def prefers(driver, palette):
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {
        "features": [{"name": "prefers-color-scheme", "value": palette}]})


def until(what, condition):
    end = time.monotonic() + WAIT
    while time.monotonic() < end:
        if found := condition():
            return found
        time.sleep(0.05)
    raise AssertionError(f"after {WAIT} s: {what}")


def said(driver):
    return [entry["message"] for entry in driver.get_log("browser")]


def looked_at(site, of_all):
    seen = {site / "docs" / "theory.html"}
    yield from seen
    for path in sorted(site.rglob("*.html")):
        more = of_all and (path.parent == site / "docs" or "arithmatex" in path.read_text())
        if path not in seen and (more or path.parent not in seen):
            yield path
        seen.add(path.parent)


def every_page(driver, site, of_all):
    """Each page as a file on a phone."""
    wrong, drawn = [], 0
    size(driver, *PHONE)
    for path in looked_at(site, of_all):
        driver.get(path.as_uri())
        name, state = path.relative_to(site), driver.execute_script(STATE)
        drawn += state["drawn"]
        for fault, what in ((state["width"] > PHONE[0], f"{state['width']} px wide"),
                            (state["drawn"] != state["maths"], f"{state['drawn']} of {state['maths']} equations"),
                            (state["tags"] != state["asked"], f"{state['tags']} of {state['asked']} numbers"),
                            (state["wrong"], state["wrong"]), (state["far"], state["far"])):
            if fault:
                wrong.append(f"{name}: {what}")
        wrong += [f"{name}: {text}" for text in said(driver)]
    assert not wrong, "\n".join(wrong)
    assert drawn > 1000, drawn
    print(f"{drawn} equations drawn")


def search(driver, address, words, expected):
    """What is typed into the search is answered by a link to the page; a click leads there."""
    size(driver, *DESK)
    driver.get(address)
    field = driver.find_element(By.CSS_SELECTOR, "input.md-search__input")
    driver.execute_script("arguments[0].focus()", field)
    field.send_keys(words)
    links = until(f"no result for {words}", lambda: driver.find_elements(
        By.CSS_SELECTOR, ".md-search-result__link"))
    found = [link.get_attribute("href") for link in links]
    assert any(expected in link for link in found), (words, expected, found)
    driver.get(next(link for link in found if expected in link))
    assert expected in driver.current_url and driver.find_elements(By.TAG_NAME, "h1"), driver.current_url
    assert not said(driver)


def searches(driver, base):
    search(driver, f"{base}/index.html", "slip ratio", "docs/")
    search(driver, f"{base}/docs/decisions/036-rubber.html", "Delassus", "docs/theory.html")
    search(driver, f"{base}/docs/cases.html", "braked in pulses", "cases/wheel-abs.html")


def anchor(driver, base):
    """A link to a heading, as the sources have it, lands at that heading."""
    driver.get(f"{base}/docs/reduced.html#1-what-it-can-do")
    top = until("the heading is not in sight", lambda: driver.execute_script(
        "const y = document.getElementById('1-what-it-can-do').getBoundingClientRect().top;"
        "return y > -5 && y < 200 ? [y] : null"))
    assert top


def copies(driver, base):
    """A block of commands has its button."""
    driver.get(f"{base}/docs/tutorial.html")
    driver.execute_script("document.querySelector('pre').scrollIntoView()")
    until("no button to copy", lambda: driver.find_elements(By.CSS_SELECTOR, "pre > button.md-clipboard"))


def palettes(driver, base):
    """As the system prefers, and the other by a click."""
    size(driver, *DESK)
    for prefered, first, second in (("dark", "slate", "default"), ("light", "default", "slate")):
        driver.get("about:blank")
        prefers(driver, prefered)
        driver.get(f"{base}/index.html")
        driver.execute_script("localStorage.clear()")
        driver.get(f"{base}/docs/cases.html")
        scheme = lambda: driver.find_element(By.TAG_NAME, "body").get_attribute("data-md-color-scheme")  # noqa: E731
        until(f"{prefered}: not {first}", lambda: scheme() == first)
        toggle = next(label for label in driver.find_elements(By.CSS_SELECTOR, "form.md-header__option label")
                      if label.is_displayed())
        toggle.click()
        until(f"{prefered}: not {second} after a click", lambda: scheme() == second)


def main():
    of_all = "--all" in sys.argv
    missing = [name for name, there in (("python3-selenium", webdriver), ("chromium", shutil.which("chromium")),
                                        ("chromium-driver", shutil.which("chromedriver"))) if not there]
    if missing:
        print(f"left out: the site is not tested in a browser: {', '.join(missing)} missing (scripts/setup.sh --dev)")
        return LEFT_OUT
    with tempfile.TemporaryDirectory() as folder:
        site = pathlib.Path(folder).resolve() / "the site"  # a path with a space
        subprocess.run(["/usr/bin/python3", ROOT / "scripts" / "site" / "build.py", site], check=True)

        class Handler(http.server.SimpleHTTPRequestHandler):
            def log_message(self, *_):
                pass

        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Handler, directory=str(site)))
        threading.Thread(target=server.serve_forever, daemon=True).start()
        driver = browser()
        try:
            every_page(driver, site, of_all)
            bases = [site.as_uri()] if of_all else []
            for base in [*bases, f"http://127.0.0.1:{server.server_port}"]:
                for check in (searches, anchor, copies, palettes):
                    check(driver, base)
                    print(f"ok: {check.__name__}, {base.split(':')[0]}")
        finally:
            driver.quit()
            server.shutdown()
    return 0


if __name__ == "__main__":
    sys.exit(main())

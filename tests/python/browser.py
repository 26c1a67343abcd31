# SPDX-License-Identifier: BSD-3-Clause
"""Headless Chromium with a page of one file, for tests that click."""
from __future__ import annotations

import json
import pathlib
import shutil
import time
from collections.abc import Callable
from typing import Any

WHY_NOT = ""
try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
except ImportError:
    WHY_NOT = "python3-selenium is not installed"
CHROMIUM, DRIVER = shutil.which("chromium") or "", shutil.which("chromedriver") or ""
if not WHY_NOT and not (CHROMIUM and DRIVER):
    WHY_NOT = "chromium and chromium-driver are not installed (scripts/setup.sh --dev)"
PATIENCE = 20.0  # s: for what a script does; a loaded machine is slow


class Browser:
    """width, height in pixels of the page; below 500 a phone."""

    def __init__(self, width: int = 1200, height: int = 800, dark: bool = False) -> None:
        options = webdriver.ChromeOptions()
        options.binary_location = CHROMIUM
        for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                         f"--window-size={width},{height}"):
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(service=Service(DRIVER), options=options)
        self.look(width, height, dark)

    def look(self, width: int, height: int, dark: bool) -> None:
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 500})
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [
            {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}]})

    def open(self, path: pathlib.Path) -> None:
        self.driver.get(path.resolve().as_uri())

    def js(self, script: str, *arguments: Any) -> Any:
        return self.driver.execute_script(script, *arguments)

    def until(self, script: str, wanted: Callable[[Any], bool] = bool) -> Any:
        """What the script returns, once it is as wanted."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            found = self.js(script)
            if wanted(found):
                return found
            time.sleep(0.05)
        raise AssertionError(f"{script}: still {found!r} after {PATIENCE} s")

    def complaints(self) -> list[str]:
        """Errors and warnings of the console."""
        return [entry["message"] for entry in self.driver.get_log("browser")
                if entry["level"] in ("SEVERE", "WARNING")]

    def asked(self) -> list[str]:
        """Addresses that the page has asked for, without its own and what it holds itself."""
        found = []
        for entry in self.driver.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                found.append(message["params"]["request"]["url"])
        return [url for url in found if not url.startswith(("data:", "blob:", "file:", "chrome:"))]

    def picture(self, selector: str = "canvas") -> str:
        """What is on the first canvas."""
        return str(self.js(f"return document.querySelector({json.dumps(selector)}).toDataURL()"))

    def choose(self, label: str, value: str) -> None:
        """In the select box whose label begins so."""
        self.js("""const [words, value] = arguments;
            const label = [...document.querySelectorAll('label')].find((one) => one.textContent.startsWith(words));
            const box = label.querySelector('select');
            box.value = value;
            box.dispatchEvent(new Event('change'));""", label, value)

    def close(self) -> None:
        self.driver.quit()

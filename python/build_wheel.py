# SPDX-License-Identifier: BSD-3-Clause
"""Build backend (PEP 517) of the package rondo: a wheel with the library and the programs as CMake
builds them, or a source archive to build it from, without other packages; of the same build the
same bits each time. Why not setuptools: docs/decisions/012.

    pip install --config-settings build-dir=DIRECTORY ./python    the build directory to take
    pip install --config-settings module=no ./python              pure Python: reads and draws only
"""
from __future__ import annotations

import base64
import gzip
import hashlib
import io
import pathlib
import re
import sys
import tarfile
import tomllib
import zipfile
from typing import Any

import build_module

ROOT = pathlib.Path(__file__).resolve().parent
PROJECT: dict[str, Any] = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
NAME = PROJECT["name"]
DATE = (1980, 1, 1, 0, 0, 0)  # of all files: the earliest that zip knows
PURE = "py3-none-any"
PLOTLY = [pathlib.Path(prefix) / "lib/node_modules/plotly.js-basic-dist-min"  # npm install -g
          for prefix in ("/usr/local", "/usr")]
# Runs the program of the package; pip puts in its own Python.
SCRIPT = b"""#!python
import importlib.util
import os
import sys

spec = importlib.util.find_spec("rondo")
program = os.path.join(os.path.dirname(spec.origin), "bin", "rondo")
os.execv(program, [program, *sys.argv[1:]])
"""


def version() -> str:
    """From the package, without importing it and what it needs."""
    text = (ROOT / NAME / "__init__.py").read_text()
    found = re.search(r'^__version__ = "([^"]+)"$', text, re.MULTILINE)
    if found is None:
        raise ValueError(f"{NAME}/__init__.py: no line __version__ = \"...\"")
    return found[1]


def shipped_files() -> dict[str, pathlib.Path]:
    """What `rondo paper` needs besides the package, with its place in it: the study and
    its cases. In a source archive they are there already."""
    there = ROOT / NAME / "shipped"
    if there.is_dir():
        return {path.relative_to(ROOT).as_posix(): path for path in there.rglob("*.toml")}
    study = ROOT.parent / "studies" / "paper" / "study.toml"
    cases = [study.parent / run["case"] for run in tomllib.loads(study.read_text())["run"]]
    found = {study, *(case.resolve() for case in cases)}
    return {f"{NAME}/shipped/{path.relative_to(ROOT.parent).as_posix()}": path for path in found}


def plotly_files() -> dict[str, pathlib.Path]:
    """plotly.js, which draws the curves of reports, with its licence, where it is installed."""
    folder = f"{NAME}/reports/assets"
    for place in PLOTLY:
        if (place / "plotly-basic.min.js").is_file():
            found = {f"{folder}/plotly-basic.min.js": place / "plotly-basic.min.js"}
            if (place / "LICENSE").is_file():
                found[f"{folder}/plotly-LICENSE"] = place / "LICENSE"
            return found
    return {}


def package_files() -> dict[str, pathlib.Path]:
    """Files of the package by their names in it, sorted."""
    kept = {path.relative_to(ROOT).as_posix(): path for path in (ROOT / NAME).rglob("*")
            if path.suffix in (".py", ".pyi", ".typed") or path.parent.name == "assets"}
    kept |= plotly_files()
    return dict(sorted((kept | shipped_files()).items()))


def metadata() -> str:
    lines = ["Metadata-Version: 2.1", f"Name: {NAME}", f"Version: {version()}",
             f"Summary: {PROJECT['description']}", f"License: {PROJECT['license']['text']}",
             "License-File: LICENSE", f"Requires-Python: {PROJECT['requires-python']}"]
    lines += [f"Requires-Dist: {needed}" for needed in PROJECT["dependencies"]]
    return "\n".join(lines) + "\n"


def _settings(given: dict[str, Any] | None) -> dict[str, Any]:
    allowed = {"build-dir": "a directory", "module": "yes or no"}
    for name, value in (given or {}).items():
        if name not in allowed or (name == "module" and value not in ("yes", "no")):
            raise build_module.NotBuilt(f"--config-settings {name}={value}: there are "
                                        + ", ".join(f"{key} ({what})" for key, what in allowed.items()))
    return given or {}


def _contents(settings: dict[str, Any]) -> tuple[dict[str, bytes], str]:
    """Files of the wheel besides those of its dist-info, and its tag."""
    contents = {name: path.read_bytes() for name, path in package_files().items()}
    if settings.get("module") == "no":
        return contents, PURE
    contents |= build_module.build(settings.get("build-dir"))
    contents[f"{NAME}-{version()}.data/scripts/rondo"] = SCRIPT
    return dict(sorted(contents.items())), build_module.tag()


def _write_zip(path: pathlib.Path, contents: dict[str, bytes]) -> None:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as out:
        for name, data in contents.items():
            entry = zipfile.ZipInfo(name, DATE)
            runs = name.startswith(f"{NAME}/bin/") or "/scripts/" in name
            entry.external_attr = (0o100755 if runs else 0o100644) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            out.writestr(entry, data)


def build_wheel(wheel_directory: str, config_settings: dict[str, Any] | None = None,
                metadata_directory: str | None = None) -> str:
    """Writes the wheel into the folder and returns its name. What is missing is said without a trace
    of Python, by exit code 1."""
    try:
        contents, tag = _contents(_settings(config_settings))
    except build_module.NotBuilt as reason:
        sys.exit(f"rondo: {reason}")
    info = f"{NAME}-{version()}.dist-info"
    contents[f"{info}/METADATA"] = metadata().encode()
    contents[f"{info}/WHEEL"] = (f"Wheel-Version: 1.0\nGenerator: rondo\nRoot-Is-Purelib: "
                                 f"{'true' if tag == PURE else 'false'}\nTag: {tag}\n").encode()
    contents[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    record = []
    for name, data in contents.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        record.append(f"{name},sha256={digest},{len(data)}")
    contents[f"{info}/RECORD"] = ("\n".join([*record, f"{info}/RECORD,,"]) + "\n").encode()
    wheel = f"{NAME}-{version()}-{tag}.whl"
    _write_zip(pathlib.Path(wheel_directory) / wheel, contents)
    return wheel


def prepare_metadata_for_build_wheel(metadata_directory: str,
                                     config_settings: dict[str, Any] | None = None) -> str:
    """What pip asks first: name, version and requirements need no build."""
    info = f"{NAME}-{version()}.dist-info"
    folder = pathlib.Path(metadata_directory) / info
    folder.mkdir()
    (folder / "METADATA").write_text(metadata())
    return info


def build_sdist(sdist_directory: str, config_settings: dict[str, Any] | None = None) -> str:
    """Writes the source archive, with the sources of the library, into the folder; its name."""
    top = f"{NAME}-{version()}"
    own = {name: ROOT / name for name in ("LICENSE", "build_module.py", "build_wheel.py",
                                          "pyproject.toml")}
    try:
        library = {f"sources/{name}": path for name, path in
                   sorted(build_module.source_files().items())}
    except build_module.NotBuilt as reason:
        sys.exit(f"rondo: {reason}")
    contents = {name: path.read_bytes() for name, path in (own | package_files() | library).items()}
    contents["PKG-INFO"] = metadata().encode()
    archive = io.BytesIO()
    with tarfile.open(fileobj=archive, mode="w", format=tarfile.PAX_FORMAT) as out:
        for name, data in contents.items():
            entry = tarfile.TarInfo(f"{top}/{name}")  # owner 0 and time 0
            entry.size = len(data)
            out.addfile(entry, io.BytesIO(data))
    packed = gzip.compress(archive.getvalue(), mtime=0)
    (pathlib.Path(sdist_directory) / f"{top}.tar.gz").write_bytes(packed)
    return f"{top}.tar.gz"

# SPDX-License-Identifier: BSD-3-Clause
"""Build backend (PEP 517) of the package rondo: a wheel or a source archive of pure Python, without
other packages; the same bits each time. Why not setuptools: docs/decisions/012."""
from __future__ import annotations

import base64
import gzip
import hashlib
import io
import pathlib
import re
import tarfile
import tomllib
import zipfile
from typing import Any

ROOT = pathlib.Path(__file__).resolve().parent
PROJECT: dict[str, Any] = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
NAME = PROJECT["name"]
DATE = (1980, 1, 1, 0, 0, 0)  # of all files: the earliest that zip knows


def version() -> str:
    """From the package, without importing it and what it needs."""
    text = (ROOT / NAME / "__init__.py").read_text()
    found = re.search(r'^__version__ = "([^"]+)"$', text, re.MULTILINE)
    if found is None:
        raise ValueError(f"{NAME}/__init__.py: no line __version__ = \"...\"")
    return found[1]


def shipped_files() -> dict[str, pathlib.Path]:
    """What `python3 -m rondo paper` needs besides the package, with its place in it: the study and
    its cases. In a source archive they are there already."""
    there = ROOT / NAME / "shipped"
    if there.is_dir():
        return {path.relative_to(ROOT).as_posix(): path for path in there.rglob("*.toml")}
    study = ROOT.parent / "studies" / "paper" / "study.toml"
    cases = [study.parent / run["case"] for run in tomllib.loads(study.read_text())["run"]]
    found = {study, *(case.resolve() for case in cases)}
    return {f"{NAME}/shipped/{path.relative_to(ROOT.parent).as_posix()}": path for path in found}


def package_files() -> dict[str, pathlib.Path]:
    """Files of the package by their names in it, sorted."""
    kept = {path.relative_to(ROOT).as_posix(): path for path in (ROOT / NAME).rglob("*")
            if path.suffix in (".py", ".typed")}
    return dict(sorted((kept | shipped_files()).items()))


def metadata() -> str:
    lines = ["Metadata-Version: 2.1", f"Name: {NAME}", f"Version: {version()}",
             f"Summary: {PROJECT['description']}", f"License: {PROJECT['license']['text']}",
             "License-File: LICENSE", f"Requires-Python: {PROJECT['requires-python']}"]
    lines += [f"Requires-Dist: {needed}" for needed in PROJECT["dependencies"]]
    return "\n".join(lines) + "\n"


def build_wheel(wheel_directory: str, config_settings: dict[str, Any] | None = None,
                metadata_directory: str | None = None) -> str:
    """Writes the wheel into the folder and returns its name."""
    info = f"{NAME}-{version()}.dist-info"
    contents = {name: path.read_bytes() for name, path in package_files().items()}
    contents[f"{info}/METADATA"] = metadata().encode()
    contents[f"{info}/WHEEL"] = (b"Wheel-Version: 1.0\nGenerator: rondo\nRoot-Is-Purelib: true\n"
                                 b"Tag: py3-none-any\n")
    contents[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    record = []
    for name, data in contents.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        record.append(f"{name},sha256={digest},{len(data)}")
    contents[f"{info}/RECORD"] = ("\n".join([*record, f"{info}/RECORD,,"]) + "\n").encode()
    wheel = f"{NAME}-{version()}-py3-none-any.whl"
    with zipfile.ZipFile(pathlib.Path(wheel_directory) / wheel, "w", zipfile.ZIP_DEFLATED) as out:
        for name, data in contents.items():
            entry = zipfile.ZipInfo(name, DATE)
            entry.external_attr = 0o100644 << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            out.writestr(entry, data)
    return wheel


def build_sdist(sdist_directory: str, config_settings: dict[str, Any] | None = None) -> str:
    """Writes the source archive into the folder and returns its name."""
    top = f"{NAME}-{version()}"
    own = {name: ROOT / name for name in ("LICENSE", "build_wheel.py", "pyproject.toml")}
    contents = {name: path.read_bytes() for name, path in (own | package_files()).items()}
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

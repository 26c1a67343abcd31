# SPDX-License-Identifier: BSD-3-Clause
"""The wheel that is tested: its case file, and what the rig takes from it."""
from __future__ import annotations

import math
import pathlib
import tomllib
from dataclasses import dataclass
from typing import Any

from ..data.errors import InputError
from ..data.plain_files import text_of


@dataclass(frozen=True)
class Tyre:
    """`case`: the document of the file, as tomllib reads it."""

    path: pathlib.Path
    text: str
    case: dict[str, Any]

    @property
    def title(self) -> str:
        return str(self.case.get("title", self.path.stem))

    @property
    def load(self) -> float | None:
        """N: of the analysis, or the last of the table of the rim."""
        found = self.case.get("analysis", {}).get("load")
        if not isinstance(found, (int, float)):
            found = -(_last(self.case.get("rim", {}).get("force_y")) or 0.0)
        return float(found) if found > 0.0 else None

    @property
    def pressure(self) -> float | None:
        found = self.case.get("inflation", {}).get("pressure")
        return float(found) if found is not None else None

    @property
    def sectors(self) -> int:
        return int(self.case["section"]["sectors"] if "section" in self.case
                   else self.case["disk"]["mesh"]["circumferential"])

    @property
    def samples(self) -> int:
        return int(self.case.get("analysis", {}).get("samples_per_sector", 2))

    @property
    def friction(self) -> float | None:
        """None: tables, which stay those of the case."""
        found = self.case.get("ground", {}).get("friction", 0.0)
        return float(found) if isinstance(found, (int, float)) else None

    @property
    def spin(self) -> float | None:
        """rad/s: the last of a table; None: none."""
        found = _last(self.case.get("motion", {}).get("angular_velocity"))
        return abs(float(found)) if found else None

    @property
    def mirrored_cords(self) -> list[dict[str, Any]] | None:
        """The cords of the mirror image about a plane through the axle; None: it is the tyre itself."""
        cords = self.case.get("cords", [])
        if all(abs(math.sin(2.0 * float(one.get("angle", 0.0)))) < 1e-9 for one in cords):
            return None
        return [{**one, "angle": -float(one["angle"])} if abs(math.sin(2.0 * float(one["angle"]))) >= 1e-9 else one
                for one in cords]


def read_tyre(path: pathlib.Path) -> Tyre:
    """@raise InputError: no TOML, or no wheel with a width."""
    text = text_of(path)
    try:
        case = tomllib.loads(text)
    except ValueError as reason:
        raise InputError(f"{path}: cannot be read: {reason}") from None
    if "section" not in case and not (isinstance(case.get("disk"), dict) and "width" in case["disk"]):
        raise InputError(f"{path}: the rig tests wheels in three dimensions: a [section], or a [disk] with a width; "
                         "for a wheel in the plane, rondo sweep varies load, slip and speed (docs/steady.md)")
    if "section" in case and "file" not in case["section"]:
        raise InputError(f"{path}: section.file: is missing (allowed: a mesh of the section, docs/tyre.md)")
    if "sectors" not in case.get("section", {"sectors": 1}):
        raise InputError(f"{path}: section.sectors: is missing: the rig tests wheels that are swept around the axle")
    disk = case.get("disk", {})
    if "tread" in disk or "section" not in case and "circumferential" not in disk.get("mesh", {}):
        raise InputError(f"{path}: disk.tread and meshes by pitches: the rig tests wheels that are the same around the axle "
                         "(allowed: a disk with disk.mesh.circumferential and without disk.tread, or a [section])")
    return Tyre(path, text, case)


def _last(value: Any) -> float | None:
    """Of a number, or of a table [[time, value], ...]."""
    if isinstance(value, list):
        return float(value[-1][1]) if value and isinstance(value[-1], list) and len(value[-1]) == 2 else None
    return float(value) if isinstance(value, (int, float)) else None

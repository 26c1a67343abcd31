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
from .keys import PLANE, SPACE
from .plane import demand_plane_wheel, is_plane, kind_of
from .plane.slip_step import sectors_of

# What the rig reads of a case before the program has checked it (checks/case.py): a case that has it of another kind is refused.
TABLES = ("section", "disk", "disk.mesh", "disk.tread", "material", "inflation", "damping", "motion", "ground", "analysis", "rim")
LISTS_OF_TABLES = ("material.region", "cords")
COUNTS = {"section.sectors": 1, "disk.mesh.circumferential": 1, "disk.tread.pitches": 1, "disk.tread.land_columns": 1,
          "disk.tread.groove_columns": 0, "analysis.samples_per_sector": 1}  # and the least
TREAD = ("disk.tread.pitches", "disk.tread.land_columns", "disk.tread.groove_columns")  # which a tread has to have


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
        """N, of a plane wheel N/m: of the analysis, or the last of the table of the rim."""
        found = self.case["analysis"]["load"] if self.says_load == "analysis.load" else \
            -(_last(self.case.get("rim", {}).get("force_y")) or 0.0)
        return float(found) if found > 0.0 else None

    @property
    def says_load(self) -> str:
        """The key of the case that has the load."""
        return "analysis.load" if "load" in self.case.get("analysis", {}) else "rim.force_y"

    @property
    def has_air(self) -> bool:
        return "inflation" in self.case

    @property
    def pressure(self) -> float | None:
        """Pa; None: a wheel without air."""
        return float(self.case["inflation"].get("pressure", 0.0)) if self.has_air else None

    @property
    def sectors(self) -> int:
        """Around the axle; of a tread its pitches."""
        return int(self.case["section"]["sectors"]) if "section" in self.case else sectors_of(self.case)

    @property
    def is_plane(self) -> bool:
        return is_plane(self.case)

    @property
    def plane_kind(self) -> str:
        """"strain" or "stress"; "" of a wheel in three dimensions."""
        return kind_of(self.case) if self.is_plane else ""

    @property
    def wheels(self) -> str:
        """The kind of wheel, as keys of rig files name it."""
        return PLANE if self.is_plane else SPACE

    @property
    def has_tread(self) -> bool:
        return "tread" in self.case.get("disk", {})

    @property
    def samples(self) -> int:
        """In the pass of a sector: those of the case, but no more than the rig needs."""
        most = (16 if self.has_tread else 4) if self.is_plane else 2
        return min(most, int(self.case.get("analysis", {}).get("samples_per_sector", most)))

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
    """@raise InputError: no TOML, or no wheel that the rig can test."""
    try:
        text = text_of(path)
        case = tomllib.loads(text)
    except ValueError as reason:
        raise InputError(f"{path}: cannot be read: {reason}") from None
    if "section" not in case and not isinstance(case.get("disk", case.get("mesh")), dict):
        raise InputError(f"{path}: has no wheel (allowed: a [section], or a [disk], in the plane or with a width)")
    _demand_kinds(path, case)
    if is_plane(case):
        demand_plane_wheel(path, case)
    if "section" in case and "file" not in case["section"]:
        raise InputError(f"{path}: section.file: is missing (allowed: a mesh of the section, docs/tyre.md)")
    if "sectors" not in case.get("section", {"sectors": 1}):
        raise InputError(f"{path}: section.sectors: is missing: the rig tests wheels that are swept around the axle")
    disk = case.get("disk", {})
    if "tread" in disk and not is_plane(case):
        raise InputError(f"{path}: disk.tread: of wheels in three dimensions the rig tests those that are the same around the "
                         "axle (allowed: no disk.tread; or a plane disk, without disk.width)")
    if "section" not in case and "tread" not in disk and "circumferential" not in disk.get("mesh", {}):
        raise InputError(f"{path}: disk.mesh.circumferential: is missing (allowed: columns of elements around the axle, as 120)")
    return Tyre(path, text, case)


def read_mesh(tyre: Tyre) -> tuple[bytes, str]:
    """The file of its section, and the name of that; nothing of a disk. @raise InputError: it cannot be read."""
    name = tyre.case.get("section", {}).get("file")
    if name is None:
        return b"", ""
    path = tyre.path.parent / name
    try:
        return path.read_bytes(), path.name
    except OSError as reason:
        raise InputError(f"{tyre.path}: section.file: {path}: cannot be read: {reason.strerror}") from None


def _demand_kinds(path: pathlib.Path, case: dict[str, Any]) -> None:
    for name in TABLES:
        if not isinstance(_at(case, name, {}), dict):
            raise InputError(f"{path}: {name}: is no table (allowed: [{name}])")
    for name in LISTS_OF_TABLES:
        found = _at(case, name, [])
        if not isinstance(found, list) or not all(isinstance(one, dict) for one in found):
            raise InputError(f"{path}: {name}: is no list of tables (allowed: [[{name}]], once for each)")
    for name, least in COUNTS.items():
        found = _at(case, name, least)
        if not isinstance(found, int) or isinstance(found, bool) or found < least:
            raise InputError(f"{path}: {name} = {found!r} (allowed: a whole number >= {least})")
    if "tread" in case.get("disk", {}) and (missing := [name for name in TREAD if _at(case, name, None) is None]):
        raise InputError(f"{path}: {', '.join(missing)}: is missing (allowed: whole numbers, docs/cases.md, [disk.tread])")


def _at(case: dict[str, Any], name: str, otherwise: Any) -> Any:
    """Of a key of a case by its name with points."""
    for part in name.split("."):
        if part not in case:
            return otherwise
        case = case[part]
    return case


def _last(value: Any) -> float | None:
    """Of a number, or of a table [[time, value], ...]."""
    if isinstance(value, list):
        return float(value[-1][1]) if value and isinstance(value[-1], list) and len(value[-1]) == 2 else None
    return float(value) if isinstance(value, (int, float)) else None

# SPDX-License-Identifier: BSD-3-Clause
"""Wheels in the plane on the rig: the cases it takes, the tests they do, and what their forces are (docs/rig.md, 4)."""
from __future__ import annotations

import pathlib
from collections.abc import Mapping
from typing import Any

from ...data.errors import InputError

LEFT_OUT = {"lateral": "a plane wheel has no slip angle, no camber and no force along its axle: give the disk a width in the "
                       "case, disk.width, for this test",
            "combined": "a plane wheel has no slip angle: give the disk a width in the case, disk.width, for this test"}
VISCOUS = ("relaxation of a plane wheel is by steps in time that begin with steady rolling, and a viscous material cannot begin so: leave "
           "out loss_factor and viscosity of the material for this test; a wheel in three dimensions, disk.width in the case, does "
           "it with them")
NOTES = {"footprint": "A plane wheel has a length of contact, of a tread without its grooves, and a pressure along it. Both are "
                      "the same all over the width: there is no width of the contact and no area.",
         "relaxation": "A plane wheel has a step of the slip ratio, and none of the slip angle. It is computed by steps in time "
                       "at the height of free rolling, and the force is the mean over the pass of a sector. Waves in its course "
                       "are vibrations that the step excites, so that the length of the exponential is the better one.",
         "modes": "Of a plane wheel there are the modes of the free wheel; those of one that stands on the ground are of "
                  "wheels in three dimensions."}
WITHOUT_WIDTH = ("the forces of this plane wheel are per metre of width: give its width in the rig file, as width = 0.2 in m, "
                 "which multiplies them")
NO_TIR = f"tyre.tir is in newtons, and {WITHOUT_WIDTH}"
NO_FILES = f"TYDEX files and tyre.tir are not written: they are in newtons, and {WITHOUT_WIDTH}."
ONLY_PLANE = ("A plane wheel: the file has the longitudinal force, the rolling resistance moment and the vertical stiffness "
              "(USE_MODE 1), and no lateral force and no aligning and overturning moment. It is for braking, driving and "
              "ride, not for cars that turn.")
USE_MODE = 1.0  # of MF-Tyre: F_x and M_y alone
STEADY = "the rig tests by steady rolling, for which"


def is_plane(case: Mapping[str, Any]) -> bool:
    """A disk without a width, or a mesh in the plane."""
    return "section" not in case and "width" not in _table(case, "disk") and ("disk" in case or "mesh" in case)


def left_out_of(case: Mapping[str, Any]) -> dict[str, str]:
    """Tests that this plane wheel cannot do, and why."""
    return LEFT_OUT | ({"relaxation": VISCOUS} if _is_viscous(case) else {})


def _is_viscous(case: Mapping[str, Any]) -> bool:
    material = _table(case, "material")
    return any(one.get("loss_factor") or one.get("viscosity") for one in (material, *material.get("region", [])))


def kind_of(case: Mapping[str, Any]) -> str:
    """"strain" or "stress"."""
    return str(_table(case, "material").get("plane", "strain"))


def sentence(kind: str, width: float | None) -> str:
    """What the forces of a plane wheel are, in words."""
    if width is None:
        return f"A wheel in the plane, plane {kind}: forces and moments are per metre of width, in N/m and N m/m."
    return (f"A wheel in the plane, plane {kind}, times a width of {width:g} m: forces and moments are in N and N m. The "
            "pressure is the same all over the width, as far as its edges.")


def fmu_note(width: float | None) -> str:
    """What the importer of tyre.fmu has to know."""
    return ("It is of a width of 1 m. Its parameter width multiplies forces and masses: set it in the importer"
            + (f" to {width:g} m, the width of this rig." if width else ", to the width of the wheel in m."))


def demand_plane_wheel(path: pathlib.Path, case: Mapping[str, Any]) -> None:
    """@raise InputError: with what is in the case that the rig cannot test."""
    if "mesh" in case:
        raise InputError(f"{path}: [mesh]: {STEADY} a wheel has to be the same around its axle, and a mesh from a file is not "
                         "known to be (allowed: a [disk]; for this wheel, rondo sweep varies load, slip and speed of runs in "
                         "time, docs/studies.md)")
    if _table(case, "disk").get("rim", "bonded") == "free":
        raise InputError(f'{path}: disk.rim = "free": the rig turns the wheel by its rim (allowed: disk.rim = "bonded")')
    material = _table(case, "material")
    for where, one in (("material", material), *(("material.region", region) for region in material.get("region", []))):
        if one.get("model", "linear") != "linear":
            raise InputError(f'{path}: {where}.model = "{one["model"]}": {STEADY} a plane wheel has small strains (allowed: '
                             f'"linear", with {_small_strain(one)}; or runs in time by rondo sweep, docs/rubber.md)')
    for name, instead in (("load", "pressures are of wheels in three dimensions with [inflation], docs/tyre.md"),
                          ("inflation", "air is of wheels in three dimensions, docs/tyre.md"),
                          ("contact", "for contact of bodies, rondo sweep varies runs in time")):
        if name in case:
            raise InputError(f"{path}: [{name}]: the rig tests a plane wheel without it (allowed: leave it out; {instead})")


def _small_strain(law: Mapping[str, Any]) -> str:
    """The modulus of this law at small strain, if it is told by one number."""
    modulus, ratio = law.get("shear_modulus"), law.get("poissons_ratio")
    told = "the modulus of small strain as youngs_modulus"
    if isinstance(modulus, (int, float)) and isinstance(ratio, (int, float)):
        told = f"youngs_modulus = {2.0 * modulus * (1.0 + ratio):g}"
    return f"{told}, 2 mu (1 + nu), for what the wheel does at small strain"


def _table(case: Mapping[str, Any], name: str) -> dict[str, Any]:
    found = case.get(name, {})
    return found if isinstance(found, dict) else {}

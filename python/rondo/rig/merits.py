# SPDX-License-Identifier: BSD-3-Clause
"""Figures of merit of a rig as tables of its page."""
from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ..reports.document import folded, table
from ..reports.encoding import number
from .figures.drawing import said
from .points import levels, nominal
from .units import of_width

if TYPE_CHECKING:
    from ..data.rig import Rig

# By test and name in rig.json: what it is, factor from SI, unit.
MERITS = {("vertical", "radial_stiffness"): ("Radial stiffness", 1e-3, "N/mm"),
          ("vertical", "effective_radius"): ("Effective radius of free rolling", 1e3, "mm"),
          ("lateral", "cornering_stiffness"): ("Cornering stiffness", 1e-3 * np.pi / 180, "kN/°"),
          ("lateral", "pneumatic_trail"): ("Pneumatic trail", 1e3, "mm"),
          ("lateral", "ply_steer_force"): ("Ply steer force", 1.0, "N"),
          ("lateral", "conicity_force"): ("Conicity force", 1.0, "N"),
          ("longitudinal", "slip_stiffness"): ("Slip stiffness", 1e-5, "kN/%"),
          ("rolling-resistance", "coefficient"): ("Rolling resistance coefficient", 1.0, "N/kN"),
          ("relaxation", "length"): ("Relaxation length, 63.2 % of the change", 1.0, "m"),
          **{("cleat", f"peak_to_peak_{force}"): (f"{force} over the cleat, peak to peak", 1.0, "N") for force in ("Fx", "Fz")},
          **{("road", f"rms_{force}"): (f"{force} on the road, standard deviation", 1.0, "N") for force in ("Fx", "Fz")},
          **{("modes", f"first_frequency_{state}"): (f"First natural frequency, {state}", 1.0, "Hz")
             for state in ("free", "standing")}}
STATES = ("load", "pressure", "speed")  # that tell the entries of a figure apart
DIGITS = 6  # behind the point, in these units: what is smaller is round-off
HEAD = ("figure of merit", "at", "value")


def merits_of(rig: Rig) -> str:
    """A table of the figures at the nominal state, and one of all, folded. "": there are none."""
    usual_rows, whole = [], []
    for test, found in rig.figures.items():
        for name, entries in found.items():
            if not isinstance(entries, Sequence) or not all(isinstance(one, Mapping) for one in entries):
                continue
            what, factor, unit = MERITS.get((test, name), (name.replace("_", " ").capitalize(), 1.0, "SI"))
            shown_unit = of_width(unit, rig.per_metre)
            rows = [(what, _at(one, rig.per_metre), f"{number(round(factor * one['value'], DIGITS) + 0.0)} {shown_unit}")
                    for one in entries if _is_number(one.get("value"))]
            whole += rows
            usual = _nominal(rig, entries)
            usual_rows += [row for one, row in zip(entries, rows) if all(one.get(key) == value for key, value in usual.items())]
    if not whole:
        return ""
    shown = table(HEAD, usual_rows, "Figures of merit at the nominal load, pressure and speed, or at the points next to them")
    return shown + (folded(f"All {len(whole)} figures of merit", table(HEAD, whole, "Figures of merit"))
                    if len(whole) > len(usual_rows) else "")


def _nominal(rig: Rig, entries: Sequence[Mapping[str, Any]]) -> dict[str, float]:
    """The state next to the nominal one, one setting after another among the entries that have the ones before."""
    state: dict[str, float] = {}
    for key in STATES:
        left = np.array([one[key] for one in entries if _is_number(one.get(key))
                         and all(one.get(other) == value for other, value in state.items())], dtype=float)
        if len(left):
            there = levels(left)
            state[key] = float(there[np.argmin(np.abs(there - nominal(rig, key, there)))])
    return state


def _at(one: Mapping[str, Any], per_metre: bool) -> str:
    return ", ".join(said(key, float(one[key]), per_metre) if _is_number(one[key]) else str(one[key]).replace("-", " ")
                     for key in (*STATES, "step") if one.get(key) is not None)


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)

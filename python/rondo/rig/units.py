# SPDX-License-Identifier: BSD-3-Clause
"""Units of a rig. Forces of a plane wheel are per metre of width, unless the rig file gives a width that multiplies them."""
from __future__ import annotations

from collections.abc import Iterable

PER_METRE = "_per_m"  # ends the names of columns that are per metre of width
COLUMNS = {"load": "N", "pressure": "Pa", "camber": "rad", "slip_angle": "rad", "slip_ratio": "1", "speed": "m/s",
           "height": "m", "deflection": "m", "effective_radius": "m", "contact_length": "m", "contact_width": "m",
           "contact_area": "m2", "mean_pressure": "Pa", "Fx": "N", "Fy": "N", "Fz": "N", "Mx": "N m", "My": "N m", "Mz": "N m",
           "cornering_stiffness": "N/rad", "resistance": "N", "coefficient": "N/kN", "scheme_share": "1",
           "relaxation_length_63": "m", "relaxation_length_fit": "m", "peak_to_peak_Fx": "N", "peak_to_peak_Fz": "N",
           "rms_Fx": "N", "rms_Fz": "N", "mean_Fz": "N", "ripple_Fz": "N", "frequency": "Hz", "damping_ratio": "1"}
FIGURES = {"radial_stiffness": "N/m", "effective_radius": "m", "cornering_stiffness": "N/rad", "pneumatic_trail": "m",
           "ply_steer_force": "N", "conicity_force": "N", "slip_stiffness": "N", "coefficient": "N/kN", "length": "m",
           "peak_to_peak_Fx": "N", "peak_to_peak_Fz": "N", "rms_Fx": "N", "rms_Fz": "N", "first_frequency_free": "Hz",
           "first_frequency_standing": "Hz"}
SHARES = ("N/kN",)  # of a force in a load, whatever the width


def of_width(unit: str, per_metre: bool) -> str:
    """The unit of what is per metre of width: of a force N/m, of a stiffness N/mm per m. Others stay as they are."""
    if not per_metre or unit in SHARES or not unit.lstrip("kM").startswith("N"):
        return unit
    return f"{unit} per m" if "/" in unit else f"{unit}/m"


def column_name(name: str, per_metre: bool) -> str:
    """As tables have it: Fx_per_m is Fx per metre of width."""
    unit = COLUMNS.get(name, "1")
    return name if of_width(unit, per_metre) == unit else name + PER_METRE


def units_of(columns: Iterable[str], figures: Iterable[str], per_metre: bool) -> dict[str, dict[str, str]]:
    """Of columns of tables and of figures of merit, for rig.json."""
    return {"columns": {column_name(name, per_metre): of_width(COLUMNS[name], per_metre) for name in columns if name in COLUMNS},
            "figures": {name: of_width(FIGURES[name], per_metre) for name in figures if name in FIGURES}}

# SPDX-License-Identifier: BSD-3-Clause
"""The tests of the rig: their blocks, and the columns of their tables."""
from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from . import steady_tests as steady
from . import time_tests as in_time
from .steady_tests import Builder

STATE = ("load", "pressure", "camber", "slip_angle", "slip_ratio", "speed")
RESULT = ("height", "deflection", "effective_radius", "contact_length", "contact_width", "contact_area", "mean_pressure")
FORCES = ("Fx", "Fy", "Fz", "Mx", "My", "Mz")
END = ("run", "status", "reason")
_STEADY = (*STATE, *RESULT, *FORCES)
SIDEWAYS = ("Fy", "Mx", "Mz")  # forces that a plane wheel does not have
SPATIAL = ("pressure", "camber", "slip_angle", "contact_width", "contact_area", "standing", *SIDEWAYS)


@dataclass(frozen=True)
class Test:
    blocks: Builder
    columns: tuple[str, ...]
    has_forces: bool = True  # its table is a TYDEX file as well

    def columns_of(self, is_plane: bool) -> tuple[str, ...]:
        return tuple(name for name in self.columns if not is_plane or name not in SPATIAL)


TESTS: Mapping[str, Test] = {
    "vertical": Test(steady.vertical, (*_STEADY, *END)),
    "footprint": Test(steady.footprint, (*_STEADY, *END)),
    "longitudinal": Test(steady.longitudinal, (*_STEADY, *END)),
    "lateral": Test(steady.lateral, (*_STEADY, "cornering_stiffness", "mirrored", *END)),
    "combined": Test(steady.combined, (*_STEADY, *END)),
    "rolling-resistance": Test(steady.rolling_resistance, (*_STEADY, "resistance", "coefficient", "scheme_share", *END)),
    "relaxation": Test(steady.relaxation, ("load", "pressure", "speed", "step", "relaxation_length_63",
                                           "relaxation_length_fit", *END), False),
    "cleat": Test(in_time.cleat, ("load", "pressure", "speed", "peak_to_peak_Fx", "peak_to_peak_Fz", "mean_Fz", "ripple_Fz", *END), False),
    "modes": Test(in_time.modes, ("pressure", "standing", "mode", "frequency", "damping_ratio", "nodal_diameter", *END), False),
    "road": Test(in_time.road, ("load", "pressure", "speed", "rms_Fx", "rms_Fz", "mean_Fz", "ripple_Fz", *END), False),
}

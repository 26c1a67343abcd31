# SPDX-License-Identifier: BSD-3-Clause
"""How much mass damping the relaxation of a plane wheel may have: half of critical damping of its lowest mode.

Damping holds back the deformation that the relaxation is: with 36 % of critical damping the length of a small disk is 4 % shorter
than with 9 %, with 72 % it is 14 % shorter."""
from __future__ import annotations

import csv
import math
import pathlib

from ...data.errors import Error, InputError
from ...data.plain_files import text_of
from ..settings import Settings

KEY = "mass_damping"


def lowest_of(folder: pathlib.Path) -> float:
    """rad/s. @raise Error: there is no mode."""
    for row in csv.DictReader(text_of(folder / "modes.csv").splitlines()):
        return float(row["frequency_rad_s"])
    raise Error(f"{folder / 'modes.csv'}: has no mode")


def with_damping_below(lowest: float, settings: Settings, given: Settings, rig: pathlib.Path | None) -> Settings:
    """The settings, with the default lowered to the bound. Critical is twice the frequency of the mode, `lowest` [rad/s].
    @raise InputError: the rig file says more."""
    own = settings["relaxation"]
    if own[KEY] <= lowest:
        return settings
    if KEY in given.get("relaxation", {}):
        raise InputError(f"{rig}: relaxation.{KEY} = {own[KEY]:g} (allowed: a number in 1/s, >= 0 and <= {lowest:.4g}, half of critical "
                         f"damping of the lowest mode of this wheel, {lowest / (2.0 * math.pi):.4g} Hz: more makes the relaxation length "
                         "shorter)")
    return settings | {"relaxation": own | {KEY: float(f"{0.999 * lowest:.3g}")}}

# SPDX-License-Identifier: BSD-3-Clause
"""Values that the state of reference shows to be out of reach of the wheel: they are refused before any test begins."""
from __future__ import annotations

import pathlib
from collections.abc import Collection

from ...data.errors import InputError
from ..blocks import Bench
from ..keys import TOP
from ..settings import Settings
from ..time_tests import cleat_ramp, node_distance
from ..units import of_width

# The deflection grows at least with this power of the load: that of a thin incompressible layer on a rigid rim (Johnson, Contact
# Mechanics, 1985, section 5.8). The shipped tyre has 0.67 from 4 to 10 kN, a disk of rubber 0.72 from 4 to 100 kN.
LEAST_POWER = 0.4


def demand_bearable(bench: Bench, given: Settings, rig: pathlib.Path | None, deflection: float, tests: Collection[str]) -> None:
    """`given`: what the rig file `rig` says; defaults that fail are rows that failed. `deflection`: under the nominal load [m].
    `tests`: those that are done.
    @raise InputError: loads that press the wheel onto its rim even by a low estimate; a cleat that is a hill on this mesh."""
    nominal, wall = bench.top["load"], _wall(bench)
    if deflection > 0.0:
        most = nominal * (wall / deflection) ** (1.0 / LEAST_POWER)
        beyond = sorted({load for name, values in given.items() if name in (TOP, *tests) for load in values.get("loads", []) if load > most})
        if beyond:
            unit = of_width("N", bench.per_metre)
            raise InputError(f"{rig}: loads: {', '.join(f'{load:g}' for load in beyond)} {unit}: the wheel comes down by {1e3 * deflection:.3g} mm "
                             f"under its nominal load of {nominal:g} {unit}, and these would press it by all of the {1e3 * wall:.3g} mm that it "
                             f"has (allowed: at most {most:.2g} {unit}, and points that come near the rim fail)")
    if "cleat" not in tests:
        return
    own, apart = bench.settings["cleat"], node_distance(bench)
    ramp = cleat_ramp(own["height"], own["length"], apart)
    if ramp > bench.radius:
        raise InputError(f"{rig or bench.tyre.path}: cleat: height = {own['height']:g} and length = {own['length']:g}: nodes of the tread are {1e3 * apart:.3g} mm "
                         f"apart, and edges that they feel make ramps of {ramp:.3g} m, longer than the radius of the wheel (allowed: a longer "
                         "top, a lower cleat, more sectors)")


def _wall(bench: Bench) -> float:
    """m: between tread and rim of a disk; of a section, whose rim the rig does not know, the radius."""
    disk = bench.tyre.case.get("disk")
    return bench.radius if disk is None else float(disk["outer_radius"]) - float(disk["inner_radius"])

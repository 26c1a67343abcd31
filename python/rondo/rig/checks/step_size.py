# SPDX-License-Identifier: BSD-3-Clause
"""How large a step of the slip may be that tells a relaxation length: the contact must not slide."""
from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ...data.errors import Error

# Of what friction carries: the most that a step may change the force. Beside small steps the length of a plane disk is 5 % shorter
# where the step takes 26 % of it, 8 % at 35 %, 17 % at 65 %; that of a wheel in three dimensions 8 % at 32 to 46 % (docs/rig.md, 1).
CARRIED = 0.4


def friction_of(case: Mapping[str, Any], slip_speed: float) -> float:
    """The smaller coefficient of those at rest and at this slip speed. The factor of the pressure is taken as 1."""
    friction = case["ground"]["friction"]
    if not isinstance(friction, Mapping):
        return float(friction)
    speeds, factors = np.array(friction.get("slip_speed", [[0.0, 1.0]]), dtype=float).T
    return float(friction["coefficient"]) * float(np.interp([0.0, slip_speed], speeds, factors).min())


def demand_small(change: float, carried: float, step: str, force: str, key: str) -> None:
    """`change`: of the force by the step; `carried`: what friction carries; `step`: in words, with its size; `key`: of the rig file.
    @raise Error: the step is too large."""
    if carried == 0.0:
        raise Error("friction vanishes at rest (slip speed 0 of ground.friction): the contact slides in any step, and there is no relaxation length "
                    "of a contact that does not slide")
    if not change <= CARRIED * carried:
        raise Error(f"the step of the {step}, changes {force} by {100.0 * change / carried:.0f} % of what friction "
                    "carries, and the contact slides, which makes the relaxation length shorter (allowed: up to "
                    f"{100.0 * CARRIED:.0f} %): make the step smaller (relaxation.{key})")

# SPDX-License-Identifier: BSD-3-Clause
"""What a rig will take: tests, points, time and disk, from what one state took."""
from __future__ import annotations

from collections.abc import Mapping, Sequence

from ..studies.progress import readable_time
from .blocks import SWEEP, Bench, Block
from .states import States
from .steady_tests import pressures_of
from .tests_table import TESTS

# Seconds of a block beside its points, and of a point, in those of a point of the reference.
SETUP, STEADY, STEP, IN_TIME, MODES = 12.0, 3.0, 90.0, 80.0, 60.0
PER_SECOND = 50.0  # beside IN_TIME: of a second in which the wheel rolls; measured 20 to 110
PAGES = 35.0  # s, of fit, figures and report


def cost_of(block: Block, point_s: float) -> float:
    """s, about. point_s: of a point of the reference; 0: not known, taken as 1 s."""
    each = {"cleat": IN_TIME, "road": IN_TIME, "relaxation": STEP, "modes": MODES}.get(block.test, STEADY)
    if block.test in ("cleat", "road"):
        each += PER_SECOND * block.case["time"]["end"]
    return (SETUP + each * len(block.points)) * (point_s or 1.0)


def plan_text(bench: Bench, tests: Sequence[str], left_out: Mapping[str, str], point_s: float, disk: int, jobs: int) -> str:
    """A line for each test, and one for all. left_out: tests that the wheel cannot do, and why; disk: bytes of the results of a
    state."""
    about = bench.radius, bench.radius  # the height and the effective radius of all states
    speeds = {speed for test in ("cleat", "road") for speed in bench.settings[test]["speeds"]}
    loads = bench.settings["vertical"]["loads"]
    states = States({(p, load): about for p in pressures_of(bench, "vertical") for load in loads}, dict.fromkeys(speeds, about))
    lines, total, points, parts = [], 0.0, 0, 0.0
    for name in tests:
        if name in left_out:
            lines.append(f"{name:20}left out: {left_out[name]}")
            continue
        blocks = TESTS[name].blocks(bench, states)
        cost, count = sum(cost_of(block, point_s) for block in blocks if block.points), sum(block.count for block in blocks)
        lines.append(f"{name:20}{count:5} points  about {readable_time(cost)} of one core")
        if cannot := [why for block in blocks for _, why in block.cannot]:
            lines.append(f"{'':20}{len(cannot):5} of them cannot begin: {cannot[0]}")
        total, points, parts = total + cost, points + count, parts + sum(0.1 if block.kind == SWEEP else 1.0 for block in blocks)
    lines.append(f"{'all':20}{points:5} points  about {readable_time(total / jobs + PAGES)} on {jobs} cores, with "
                 f"the report; {1e-6 * parts * disk:.0f} MB")
    return "\n".join(lines) + "\n"

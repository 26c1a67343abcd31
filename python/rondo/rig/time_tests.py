# SPDX-License-Identifier: BSD-3-Clause
"""Tests in time, by the reduced wheel, and modes: the blocks of each."""
from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from ..data.errors import Error
from .blocks import FMU, MODES, RUN, Bench, Block, Point, block_or_why_not, ground_of, steady_case, tyre_case
from .plane.slip_step import JUMP, steps_of, times_of
from .states import States

LANDING = 0.06        # s, in which the wheel comes down to its height
SETTLING = 0.15       # s, after which the cleat or the road begins
AFTER = 0.15          # s, after the cleat
RISE = 1.0            # m, over which a road comes to its roughness
SPACING = 0.05        # m, of the points of a road
WAVES = 400
LONGEST, SHORTEST = 20.0, 0.2  # m, wave lengths of a road
INTERVAL = 1e-3       # s, at most: of the history of these tests
FINEST = 2e-4


def measured_from(bench: Bench, block: Block) -> float:
    """s: all of the contact is at the cleat or on the road."""
    return SETTLING + (0.0 if block.test == "cleat" else (RISE + bench.radius) / block.points[0].speed)


def node_distance(bench: Bench) -> float:
    """m, of two contact nodes around the wheel, with a margin: edges of the ground are as round, because contacts are at
    nodes."""
    between = bench.top["sectors"]
    if bench.tyre.has_tread:  # across a groove
        tread = bench.tyre.case["disk"]["tread"]
        columns = max(1, tread["groove_columns"])
        between *= (tread["land_columns"] + tread["groove_columns"]) / columns
    return 1.05 * 2.0 * math.pi * bench.radius / float(between)


def cleat_ramp(height: float, length: float, fillet: float) -> float:
    """m, along the ground: 45 degrees, or as flat as it takes that fillets of this radius fit on half of the top and on
    the ramp."""
    angle = min(0.25 * math.pi, 2.0 * math.atan(0.49 * length / fillet), math.acos(max(0.0, 1.0 - 0.98 * height / fillet)))
    return height / math.tan(angle)


def cleat_profile(at: float, ramp: float, height: float, length: float, end: float) -> list[list[float]]:
    return [[-10.0, 0.0], [at, 0.0], [at + ramp, height], [at + ramp + length, height],
            [at + 2.0 * ramp + length, 0.0], [end, 0.0]]


def road_profile(roughness: float, seed: int, begin: float, length: float) -> list[list[float]]:
    """A road with the displacement spectrum G(n) = roughness (n / n0)^-2, n0 = 0.1 1/m, as sum of cosines with random
    phases; it begins at 0 and comes to its roughness over RISE."""
    random = np.random.default_rng(seed)
    phases = random.uniform(0.0, 2.0 * math.pi, WAVES)
    apart = (1.0 / SHORTEST - 1.0 / LONGEST) / WAVES
    n = 1.0 / LONGEST + apart * (np.arange(WAVES) + random.uniform(0.0, 1.0, WAVES))  # uneven, so that nothing repeats
    amplitudes = np.sqrt(2.0 * roughness * (n / 0.1) ** -2 * apart)
    x = np.arange(0.0, length + SPACING, SPACING)
    heights = (amplitudes[:, None] * np.cos(2.0 * math.pi * n[:, None] * x + phases[:, None])).sum(axis=0)
    heights = (heights - heights[0]) * np.minimum(x / RISE, 1.0)
    points = np.column_stack([x + begin, heights]).round(6).tolist()
    return [[-10.0, 0.0], *points, [begin + length + 100.0, points[-1][1]]]


def _held(bench: Bench, states: States, p: Point) -> tuple[float, float]:
    """Height and effective radius of free rolling at the speed of a point."""
    if p.speed == bench.top["speed"]:
        return states.height(p.pressure, p.load), states.effective_radius(p.pressure, p.load)
    return states.at_speed(p.speed)


def _rolling(bench: Bench, states: States, name: str, p: Point, own: dict[str, Any], profile: Any, end: float) -> Block:
    """Rolls freely at the height that the load has on flat ground; height, speed and spin are held."""
    height, radius = _held(bench, states, p)
    case = tyre_case(bench, name, p.pressure)
    case["damping"] = {**case.get("damping", {}), "mass": own["mass_damping"]}
    case["motion"] = {"angular_velocity": bench.spin(p.speed), "speed": bench.spin(p.speed) * radius,
                      "height": [[0.0, 1.01 * bench.radius], [LANDING, height]]}
    case["ground"] = {**ground_of(bench, profile), "fillet": node_distance(bench)}
    case["time"] = {"end": end}
    case["output"] = {"stress": False, "snapshots": 1, "history_interval": max(FINEST, min(INTERVAL, 0.005 / p.speed))}
    return Block(name.split("-")[0], name, RUN, case, (p,), options=("--reduced", "--modes", str(own["modes"])))


def _at_speeds(bench: Bench, test: str, made: Callable[[Point], Block]) -> list[Block]:
    """A block for each speed of a test, under the nominal load."""
    points = [Point(bench.top["load"], bench.pressure, speed) for speed in bench.settings[test]["speeds"]]
    return [block_or_why_not(test, p, partial(made, p)) for p in points]


def cleat(bench: Bench, states: States) -> list[Block]:
    own = bench.settings["cleat"]
    ramp = cleat_ramp(own["height"], own["length"], node_distance(bench))

    def made(p: Point) -> Block:
        at = p.speed * SETTLING + 0.5 * bench.radius
        passed = at + 2.0 * ramp + own["length"] + 0.5 * bench.radius
        end = passed / p.speed + AFTER
        profile = cleat_profile(at, ramp, own["height"], own["length"], 2.0 * passed + p.speed)
        return _rolling(bench, states, f"cleat-{p.speed:.9g}mps", p, own, profile, end)

    return _at_speeds(bench, "cleat", made)


def road(bench: Bench, states: States) -> list[Block]:
    own = bench.settings["road"]

    def made(p: Point) -> Block:
        begin = p.speed * SETTLING + 0.5 * bench.radius
        profile = road_profile(own["roughness"], own["seed"], begin, own["length"])
        return _rolling(bench, states, f"road-{p.speed:.9g}mps", p, own, profile, (begin + own["length"]) / p.speed)

    return _at_speeds(bench, "road", made)


def fmu(bench: Bench, states: States) -> Block:
    """The reduced wheel on flat ground, at its height under the nominal load."""
    p = Point(bench.top["load"], bench.pressure, bench.top["speed"])
    block = _rolling(bench, states, "fmu", p, bench.settings["road"], "flat", 1.0)
    return replace(block, kind=FMU, options=block.options[1:])  # without --reduced, which it is


def lowest_mode(bench: Bench) -> Block:
    """Of the free wheel: how much damping its runs in time may have."""
    case = steady_case(bench, "mode", None, bench.spin(), torque=0.0)
    point = Point(bench.top["load"], None, 0.0)
    return Block("reference", "lowest-mode", MODES, case, (point,), options=("--count", "1", "--spin", "0"))


def stable_step(bench: Bench) -> Block:
    """A run of a plane wheel above the ground for a moment, which tells the time step of its runs in time."""
    case = tyre_case(bench, "step", None)
    case["damping"] = {**case.get("damping", {}), "mass": bench.settings["relaxation"]["mass_damping"]}
    case["motion"] = {"angular_velocity": bench.spin(), "speed": bench.top["speed"], "height": 1.01 * bench.radius}
    case["ground"] = ground_of(bench)
    case["time"] = {"end": 1e-6}
    case["output"] = {"stress": False, "snapshots": 1}
    point = Point(bench.top["load"], None, bench.top["speed"])
    return Block("reference", "time-step", RUN, case, (point,))


def plane_relaxation(bench: Bench, states: States, load: float) -> Block:
    """Rolls freely at the height of its load, and turns on at the speed of another slip ratio."""
    p = Point(load, None, bench.top["speed"], extra={"step": "slip-ratio"})
    return block_or_why_not("relaxation", p, lambda: _plane_relaxation(bench, states, p))


def _plane_relaxation(bench: Bench, states: States, p: Point) -> Block:
    if bench.no_steps:
        raise Error(bench.no_steps)
    own, spin, load = bench.settings["relaxation"], bench.spin(), p.load
    speed = spin * states.effective_radius(None, load)
    after = speed / (1.0 + own["slip_ratio_step"])
    pass_s = 2.0 * math.pi / spin / bench.top["sectors"]
    begin, end = times_of(own["distance"], speed, pass_s)
    step, interval = steps_of(pass_s, bench.stable_step or pass_s)
    case = tyre_case(bench, "relaxation", None)
    case["damping"] = {**case.get("damping", {}), "mass": own["mass_damping"]}
    case["motion"] = {"angular_velocity": spin, "height": states.height(None, load),
                      "speed": [[0.0, speed], [begin, speed], [begin + JUMP * pass_s, after]]}
    case["ground"] = ground_of(bench)
    case["initial"] = {"state": "steady-rolling"}
    case["time"] = {"end": end, "step": step}
    case["output"] = {"stress": False, "snapshots": 1, "history_interval": interval}
    return Block("relaxation", f"relaxation-slip-ratio-{load:.9g}N{'-per-m' if bench.per_metre else ''}", RUN, case, (p,))


def modes(bench: Bench, states: States) -> list[Block]:
    """Free under air, and standing on the ground under the nominal load; both without spin."""
    p = Point(bench.top["load"], bench.pressure, 0.0)
    count = str(bench.settings["modes"]["count"])
    blocks = []
    for name, more in (("free", ()), *(() if bench.tyre.is_plane else (("standing", ("--standing",)),))):
        case = steady_case(bench, f"modes-{name}", p.pressure, bench.spin(), torque=0.0)
        options: Sequence[str] = ("--count", count, "--spin", "0", *more)
        point = Point(p.load, p.pressure, 0.0, extra={"standing": int(name == "standing")})
        blocks.append(Block("modes", f"modes-{name}", MODES, case, (point,), options=tuple(options)))
    return blocks

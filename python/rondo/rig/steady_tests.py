# SPDX-License-Identifier: BSD-3-Clause
"""Tests by steady rolling: the blocks of points of each."""
from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

from ..data.errors import Error
from .blocks import RUN, SWEEP, Bench, Block, Point, block_or_why_not, steady_block, steady_case
from .states import States
from .time_tests import plane_relaxation

Builder = Callable[[Bench, States], list[Block]]


def pressures_of(bench: Bench, test: str) -> list[float | None]:
    """None of a wheel without air."""
    return list(bench.settings[test].get("pressures", [])) or [None]


def _name(test: str, pressure: float | None, *more: str) -> str:
    return "-".join([test, *([f"{pressure / 1e3:.9g}kPa"] if pressure is not None else []), *more])


def _load_text(bench: Bench, load: float) -> str:
    return f"{load:.9g}N{'-per-m' if bench.per_metre else ''}"


def reference(bench: Bench, spin: float) -> Block:
    """A state under the nominal load: it tells the radius without load, and what a point costs."""
    p = Point(bench.top["load"], bench.pressure, 0.0)
    return Block("reference", "reference", RUN, steady_case(bench, "reference", p.pressure, spin, torque=0.0), (p,))


def vertical(bench: Bench, states: States) -> list[Block]:
    """Freely rolling straight ahead, over loads and pressures."""
    speed = bench.top["speed"]
    return [steady_block(bench, "vertical", _name("vertical", p),
                         [Point(load, p, speed) for load in bench.settings["vertical"]["loads"]])
            for p in pressures_of(bench, "vertical")]


def at_speeds(bench: Bench, tests: Sequence[str]) -> list[Block]:
    """States under the nominal load at the other speeds of these tests in time, which begin with their heights."""
    speeds = {speed for test in ("cleat", "road") if test in tests for speed in bench.settings[test]["speeds"]}
    blocks = []
    for speed in sorted(speeds - {bench.top["speed"]}):
        p = Point(bench.top["load"], bench.pressure, speed)
        case = steady_case(bench, f"state-{speed:.9g}mps", p.pressure, bench.spin(speed), torque=0.0)
        blocks.append(Block("state", f"state-{speed:.9g}mps", RUN, case, (p,)))
    return blocks


def footprint(bench: Bench, states: States) -> list[Block]:
    """Runs of their own, which keep their contact patches."""
    own, blocks = bench.settings["footprint"], []
    if bench.tyre.is_plane:
        for load in own["loads"]:
            case = steady_case(bench, "footprint", None, bench.spin(), load, torque=0.0)
            blocks.append(Block("footprint", f"footprint-{_load_text(bench, load)}", RUN, case,
                                (Point(load, None, bench.top["speed"]),)))
        return blocks
    for camber_deg in own["cambers_deg"]:
        for load in own["loads"]:
            p = Point(load, bench.pressure, bench.top["speed"], math.radians(camber_deg))
            case = steady_case(bench, "footprint", p.pressure, bench.spin(), load, torque=0.0)
            case["motion"]["camber"] = 0.0 - p.camber
            blocks.append(Block("footprint", f"footprint-{load:.9g}N-camber{camber_deg:.9g}deg", RUN, case, (p,)))
    return blocks


def lateral(bench: Bench, states: States) -> list[Block]:
    """Freely rolling at slip angles: all angles at the nominal pressure without camber, few elsewhere."""
    own, nominal, speed = bench.settings["lateral"], bench.pressure, bench.top["speed"]
    blocks = []
    for p in pressures_of(bench, "lateral"):
        for camber_deg in own["cambers_deg"]:
            if p != nominal and camber_deg != 0.0:
                continue
            angles = own["slip_angles_deg" if p == nominal and camber_deg == 0.0 else "few_slip_angles_deg"]
            points = [Point(load, p, speed, math.radians(camber_deg), math.radians(angle))
                      for load in own["loads"] for angle in angles]
            blocks.append(steady_block(bench, "lateral", _name("lateral", p, f"camber{camber_deg:.9g}deg"), points))
    if (mirrored := bench.tyre.mirrored_cords) is not None:
        points = [Point(load, nominal, speed, extra={"mirrored": 1}) for load in own["loads"]]
        blocks.append(steady_block(bench, "lateral", _name("lateral", nominal, "mirrored"), points, cords=mirrored))
    return blocks


def _slipping(bench: Bench, states: States, test: str, name: str, points: Sequence[Point]) -> Block:
    """With the speeds that the slip ratios ask for: spin times the effective radius over 1 + slip, along the heading."""
    begun, speeds, cannot = [], [], []
    for p in points:
        try:
            rim = bench.spin(p.speed) * states.effective_radius(p.pressure, p.load)
        except Error as reason:
            cannot.append((p, str(reason)))
            continue
        begun.append(p)
        speeds.append(rim / (1.0 + (p.slip_ratio or 0.0)) / math.cos(p.slip_angle))
    made = steady_block(bench, test, name, begun, speeds) if begun else Block(test, name, SWEEP, {}, ())
    return replace(made, cannot=tuple(cannot))


def longitudinal(bench: Bench, states: States) -> list[Block]:
    own, nominal = bench.settings["longitudinal"], bench.pressure
    blocks = []
    for p in pressures_of(bench, "longitudinal"):
        ratios = own["slip_ratios" if p == nominal else "few_slip_ratios"]
        points = [Point(load, p, bench.top["speed"], slip_ratio=ratio) for load in own["loads"] for ratio in ratios]
        blocks.append(_slipping(bench, states, "longitudinal", _name("longitudinal", p), points))
    return blocks


def combined(bench: Bench, states: States) -> list[Block]:
    own, p = bench.settings["combined"], bench.pressure
    return [_slipping(bench, states, "combined", f"combined-{load:.9g}N", [
        Point(load, p, bench.top["speed"], slip_angle=math.radians(angle), slip_ratio=ratio)
        for angle in own["slip_angles_deg"] for ratio in own["slip_ratios"]]) for load in own["loads"]]


def rolling_resistance(bench: Bench, states: States) -> list[Block]:
    """Loads and pressures at the nominal speed, speeds at the nominal load and pressure."""
    own, nominal, load = bench.settings["rolling-resistance"], bench.pressure, bench.top["load"]
    blocks = []
    for p in pressures_of(bench, "rolling-resistance"):
        points = [Point(one, p, bench.top["speed"]) for one in own["loads"]]
        blocks.append(steady_block(bench, "rolling-resistance", _name("rolling-resistance", p), points))
    for speed in own["speeds"]:
        if speed != bench.top["speed"]:
            blocks.append(steady_block(bench, "rolling-resistance", _name("rolling-resistance", nominal, f"{speed:.9g}mps"),
                                       [Point(load, nominal, speed)]))
    return blocks


def relaxation(bench: Bench, states: States) -> list[Block]:
    """The way after a step of the slip angle and of the slip ratio, from free rolling: of the latter at its speed."""
    own, p = bench.settings["relaxation"], bench.pressure
    if bench.tyre.is_plane:
        return [plane_relaxation(bench, states, load) for load in own["loads"]]
    return [_solid_relaxation(bench, states, step, Point(load, p, bench.top["speed"], extra={"step": step}))
            for step in ("slip-angle", "slip-ratio") for load in own["loads"]]


def _solid_relaxation(bench: Bench, states: States, step: str, p: Point) -> Block:
    """By a step of the steady solver."""
    own, by_angle = bench.settings["relaxation"], step == "slip-angle"
    size = -math.radians(own["slip_angle_step_deg"]) if by_angle else own["slip_ratio_step"]

    def made() -> Block:
        case = steady_case(bench, "relaxation", p.pressure, bench.spin(), p.load, slip="upwind",
                           **{f"{step.replace('-', '_')}_step": size, "step_distance": own["distance"]})
        if by_angle:
            case["analysis"]["torque"] = 0.0
        else:
            case["motion"]["speed"] = bench.spin() * states.effective_radius(p.pressure, p.load)
        return Block("relaxation", f"relaxation-{step}-{p.load:.9g}N", RUN, case, (p,))

    return block_or_why_not("relaxation", p, made)

# SPDX-License-Identifier: BSD-3-Clause
"""A rig beside measurements of a tyre: rondo.rig.against.compare(rig, file) (docs/rig.md)."""
from __future__ import annotations

import csv
import os
import pathlib
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..data.errors import FileError, InputError
from .against_points import Axis, Way, interpolated
from .plane import WITHOUT_WIDTH
from .points import points
from .against_reading import ALIKE, CHANNEL_OF, UNITS, Measured, read_measured, told

if TYPE_CHECKING:
    from ..data.rig import Rig

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

ANGLE, SLIP = np.radians(0.25), 0.005  # up to which there is no slip angle and no slip ratio
CAMBER, PRESSURE = Axis("camber", np.radians(0.5)), Axis("pressure", 0.1, relative=True)
LOAD = Axis("load", 0.05, relative=True)  # of measured points that are drawn beside those of one load
WAYS = {"vertical": Way("height", (PRESSURE,), by_load=False),
        "longitudinal": Way("slip_ratio", (CAMBER, PRESSURE)),
        "lateral": Way("slip_angle", (CAMBER, PRESSURE)),
        "combined": Way("slip_ratio", (Axis("slip_angle", np.radians(0.3)), CAMBER, PRESSURE)),
        "rolling-resistance": Way("speed", (CAMBER, PRESSURE))}
CHANNELS = {"vertical": ("Fz",), "longitudinal": ("Fx", "My"), "lateral": ("Fy", "Mx", "Mz"),
            "combined": ("Fx", "Fy", "Mx", "Mz"), "rolling-resistance": ("Fx", "My")}


FEWEST = 4  # states that tell a sign
_MOMENT = "a moment that turns the wheel back into its direction of travel is > 0 at a slip angle > 0"
# Channels whose sign is compared with that of the rig, with what it has to be. Those of other channels are refused when the
# file is read, or may differ between two tyres.
SIGNED = {"lateral": {"Mz": _MOMENT}, "combined": {"Mz": _MOMENT},
          "longitudinal": {"Fx": "a force that brakes is < 0 at a slip ratio < 0"}}
COLUMNS = (*UNITS, "load")  # of the points of a rig


@dataclass(frozen=True)
class Difference:
    """A channel of a test: the rig less the measurement, over the states that both have."""

    test: str
    channel: str
    unit: str
    rms: float
    mean: float
    of_largest: float  # rms over the largest measured size
    rows: int          # compared
    beyond: int        # measured beyond the points of the rig, and not compared


@dataclass(frozen=True)
class Comparison:
    """Measurements beside a rig."""

    path: pathlib.Path
    measured: dict[str, dict[str, Array]]  # by test: the columns of its rows in SI and ISO-W
    differences: tuple[Difference, ...]
    warnings: tuple[str, ...] = ()  # of channels whose sign is likely that of other axes, and of tests not compared

    @property
    def lines(self) -> list[str]:
        return [f"{one.test}: {one.channel}: rms {one.rms:.4g} {one.unit}, {100 * one.of_largest:.3g} % of the largest "
                f"measured; on the mean {one.mean:+.4g} {one.unit}; {one.rows} rows"
                + (f", {one.beyond} more are beyond the points of the rig" if one.beyond else "")
                for one in self.differences]

    @property
    def summary(self) -> dict[str, Any]:
        """For rig.json."""
        return {"file": str(self.path), "differences": [asdict(one) for one in self.differences],
                "warnings": list(self.warnings)}

    def write(self, path: str | os.PathLike[str]) -> pathlib.Path:
        """A table of the differences as CSV."""
        file = pathlib.Path(path)
        names = list(Difference.__dataclass_fields__)
        try:
            with file.open("w", newline="", encoding="utf-8") as stream:
                table = csv.writer(stream, lineterminator="\n")
                table.writerow(names)
                table.writerows([getattr(one, name) for name in names] for one in self.differences)
        except OSError as reason:
            raise FileError(f"{file}: cannot be written: {reason.strerror or reason}") from None
        return file


def compare(rig: Rig, file: str | os.PathLike[str]) -> Comparison:
    """The measurements of a file beside the points of a rig. A measured state is compared with the points of the rig
    that have its camber to .5 degrees and its pressure to 10 %, interpolated along the slip and over the load; channels
    of the state that the file does not have agree with any.
    @raise InputError: no channel in common, or no state within the points of the rig; FileError: the file cannot be
    read."""
    if rig.per_metre:
        raise InputError(f"{file}: measurements are in newtons, and {WITHOUT_WIDTH}")
    measured = read_measured(file)
    shown: dict[str, dict[str, Array]] = {}
    differences: list[Difference] = []
    warnings: list[str] = []
    for test, way in WAYS.items():
        ours = points(rig, test, COLUMNS)
        rows = rows_of_test(test, measured)
        if not len(ours["load"]) or not rows.any():
            continue
        states = {name: measured.get(name)[rows] for name in UNITS}
        states["load"] = states["Fz"]
        channels = [name for name in CHANNELS[test] if np.isfinite(states[name]).any() and np.isfinite(ours[name]).any()]
        if not channels:
            continue
        shown[test] = states
        of_test = [one for name in channels if (one := _difference(test, name, way, ours, states)) is not None]
        differences += of_test
        if not of_test:
            warnings.append(_warning_of_beyond(measured, test, ours, states))
        warnings += [text for name in SIGNED.get(test, ()) if name in channels
                     if (text := _warning_of_sign(measured, test, name, way, ours, states))]
    if not differences:
        raise InputError(_nothing_in_common(rig, measured, shown))
    return Comparison(measured.path, shown, tuple(differences), tuple(warnings))


def rows_of_test(test: str, measured: Measured) -> Mask:
    """The rows that a test of this name would have made: free rolling is part of a test of slip, but none by itself."""
    angle, slip = np.abs(measured.get("slip_angle")), np.abs(measured.get("slip_ratio"))
    no_angle, no_slip = ~(angle > ANGLE), ~(slip > SLIP)
    has = {name: np.isfinite(measured.get(name)) for name in UNITS}
    masks = {"vertical": has["height"] & has["Fz"] & no_angle & no_slip,
             "longitudinal": has["slip_ratio"] & has["Fz"] & no_angle,
             "lateral": has["slip_angle"] & has["Fz"] & no_slip,
             "combined": has["slip_angle"] & has["slip_ratio"] & has["Fz"] & ~no_angle & ~no_slip,
             "rolling-resistance": has["speed"] & has["Fz"] & no_angle & no_slip}
    slips = {"longitudinal": slip > SLIP, "lateral": angle > ANGLE}.get(test)
    if slips is not None and not (masks[test] & slips).any():
        return np.zeros(len(measured), dtype=bool)
    return np.asarray(masks[test])


def rows_near(comparison: Comparison | None, test: str, settings: Mapping[str, float]) -> dict[str, Array] | None:
    """The measured states of a test at these settings, as far as a comparison takes them as the same; None: none."""
    states = comparison.measured.get(test) if comparison is not None else None
    if states is None:
        return None
    near = np.ones(len(states["load"]), dtype=bool)
    for axis in (CAMBER, PRESSURE, LOAD):
        value = settings.get(axis.name, np.nan)
        if np.isfinite(value):
            near &= axis.distance(value, states[axis.name]) <= 1.0
    return {name: column[near] for name, column in states.items()} if near.any() else None


def _difference(test: str, channel: str, way: Way, mine: dict[str, Array], states: dict[str, Array]
                ) -> Difference | None:
    """None: no state is within the points."""
    theirs, ours = _beside(channel, way, mine, states)
    apart = ours - theirs
    inside = np.isfinite(apart)
    if not inside.any():
        return None
    largest = float(np.abs(theirs[inside]).max())
    rms = float(np.sqrt(np.mean(apart[inside] ** 2)))
    return Difference(test, channel, UNITS[channel], rms, float(apart[inside].mean()), rms / largest if largest else np.inf,
                      int(inside.sum()), int((~inside).sum()))


def _beside(channel: str, way: Way, mine: dict[str, Array], states: dict[str, Array]) -> tuple[Array, Array]:
    """A measured channel where it has numbers, and the rig at these states; NaN: beyond its points."""
    there = np.isfinite(states[channel])
    return states[channel][there], interpolated(mine, channel, way, {name: column[there] for name, column in states.items()})


def _warning_of_sign(measured: Measured, test: str, channel: str, way: Way, mine: dict[str, Array],
                     states: dict[str, Array]) -> str:
    """"": the channel goes with that of the rig, or these states do not tell."""
    pair = np.stack(_beside(channel, way, mine, states))
    pair = pair[:, np.isfinite(pair).all(axis=0)]
    if pair.shape[1] < FEWEST or pair.std(axis=1).min() == 0:
        return ""
    correlation = float(np.corrcoef(pair)[0, 1])
    if correlation > -ALIKE:
        return ""
    return (f"{measured.path}: {test}: {_channel(channel)} has the other sign than the rig at {pair.shape[1]} states (correlation "
            f"{correlation:.2f}): in the axes W of TYDEX, ISO 8855, {SIGNED[test][channel]}. If the file has other axes, convert "
            "it with rondo.axes.convert (docs/conventions.md); the differences here are as the file has it")


def _warning_of_beyond(measured: Measured, test: str, mine: dict[str, Array], states: dict[str, Array]) -> str:
    theirs = "; ".join(told(states, name) for name in UNITS if np.isfinite(states[name]).any())
    return (f"{measured.path}: {test}: none of its {len(states['load'])} states is within the points of the rig, and the test is not "
            f"compared: the file has {theirs} (allowed: states between those of the rig: {_extent(test, mine)}): run the rig with the "
            "loads, pressures and cambers of the measurement")


def _extent(test: str, mine: dict[str, Array]) -> str:
    """Of the points of the rig, in words."""
    return f"{told(mine, WAYS[test].along)}, loads {_range(mine['load'])} N"


def _nothing_in_common(rig: Rig, measured: Measured, shown: dict[str, dict[str, Array]]) -> str:
    """What each side has."""
    if shown:
        theirs = "; ".join(told(measured.columns, name) for name in measured.columns)
        ours = "; ".join(f"{test}: {_extent(test, points(rig, test, COLUMNS))}" for test in shown)
        return (f"{measured.path}: no state within the points of the rig: the file has {theirs} (allowed: states between "
                f"those of the rig: {ours}): run the rig with the loads, pressures and cambers of the measurement")
    there = [test for test in WAYS if len(points(rig, test, ("load",))["load"])]
    needed = "; ".join(f"{test}: {_channel(WAYS[test].along)}, FZW, {', '.join(map(_channel, CHANNELS[test]))}"
                       for test in there) or "a rig with points"
    return (f"{measured.path}: no channel in common with {rig.directory}: found {', '.join(measured.channels)} (needed: "
            f"{needed})")


def _channel(name: str) -> str:
    return CHANNEL_OF[name]


def _range(values: Array) -> str:
    return f"{np.nanmin(values):.4g} to {np.nanmax(values):.4g}"

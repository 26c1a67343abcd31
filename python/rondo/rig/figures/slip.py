# SPDX-License-Identifier: BSD-3-Clause
"""Forces and moments of a rig over the slip angle and the slip ratio, with the fitted curves."""
from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from ... import magic_formula
from ..against import rows_near
from ..fit_rows import INPUTS
from ..points import Array, Columns, chosen, levels, nominal, points
from .drawing import (AXES, FX, FY, MX, MZ, SLIP_ANGLE, SLIP_RATIO, Channel, Drawn, Given, cross, curve, few, legend,
                      measured, panels)

STEPS = 121  # of a fitted curve
SETTINGS = ("load", "pressure", "camber")
NAMES = {"load": "load", "pressure": "pressure of the air", "camber": "camber"}
LATERAL = "Lateral force and aligning moment over the slip angle"
LONGITUDINAL = "Longitudinal force over the slip ratio"


def draw(given: Given) -> Iterator[Drawn]:
    yield from _families(given, "lateral", SLIP_ANGLE, (FY, MZ), LATERAL)
    yield from _family(given, "lateral", SLIP_ANGLE, (MX,), "load", "Overturning moment over the slip angle", "moment-x")
    yield from _families(given, "longitudinal", SLIP_RATIO, (FX,), LONGITUDINAL)


def _families(given: Given, test: str, along: Channel, channels: Sequence[Channel], words: str) -> Iterator[Drawn]:
    """A figure for each setting that varies, the others at their middle."""
    for by in SETTINGS:
        yield from _family(given, test, along, channels, by, words, by)


def _family(given: Given, test: str, along: Channel, channels: Sequence[Channel], by: str, words: str, name: str
            ) -> Iterator[Drawn]:
    found = points(given.rig, test, {*INPUTS, *(channel.name for channel in channels)})
    if not len(found["load"]):
        return
    rest = {key: nominal(given.rig, key, found[key]) for key in SETTINGS if key != by}
    here = chosen(found, _at(found, rest))
    values = few(levels(here[by]))
    if by != "load" and len(values) < 2 or not any(np.isfinite(here[channel.name]).any() for channel in channels):
        return
    figure, axes = panels(len(channels), narrow=len(channels) == 1)
    has_fit = has_measured = False
    for ax, channel in zip(axes, channels):
        factor_x, label_x = given.scaled(along, here[along.name])
        factor_y, label_y = given.scaled(channel, here[channel.name])
        cross(ax)
        for k, value in enumerate(values):
            one = chosen(here, _at(here, {by: value}))
            smooth = fitted_curve(given, {**rest, by: value}, along.name, one[along.name], channel.name)
            has_fit |= smooth is not None
            curve(ax, k, factor_x * one[along.name], factor_y * one[channel.name],
                  None if smooth is None else (factor_x * smooth[0], factor_y * smooth[1]))
        states = rows_near(given.against, test, rest)
        if states is not None and np.isfinite(states[channel.name]).any():
            measured(ax, factor_x * states[along.name], factor_y * states[channel.name])
            has_measured = True
        ax.set(xlabel=label_x, ylabel=label_y)
    legend(figure, [given.said(by, value) for value in values], has_fit, has_measured)
    at = ", ".join(given.said(key, value) for key, value in rest.items() if np.isfinite(value) and not (given.rig.plane and key == "pressure"))
    yield Drawn(test, f"{test}-{name}", f"{words}, by {NAMES[by]}{', at ' if at else ''}{at}. {AXES}.", figure)


def _at(found: Columns, values: dict[str, float]) -> np.ndarray:
    """Where the settings have these values; what the test does not say agrees."""
    mask = np.ones(len(next(iter(found.values()))), dtype=bool)
    for name, value in values.items():
        if np.isfinite(value):
            mask &= np.isclose(found[name], value, rtol=1e-6, atol=1e-9)
    return mask


def fitted_curve(given: Given, state: Mapping[str, float], along: str, values: Array, channel: str
                 ) -> tuple[Array, Array] | None:
    """tyre.tir over the extent of the points; None: there is none, or it does not have the channel."""
    if given.tir is None or not np.isfinite(values).any():
        return None
    x = np.linspace(np.nanmin(values), np.nanmax(values), STEPS)
    inputs: dict[str, Any] = {name: value for name, value in state.items()
                              if np.isfinite(value) and (name != "pressure" or given.tir.number("NOMPRES"))}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of ranges of the file, whose ends are these points
        inputs[along] = x
        forces = magic_formula.evaluate(given.tir, **inputs)
    y: Array = getattr(forces, channel)
    return (x, y) if np.abs(y).max() > 0 else None

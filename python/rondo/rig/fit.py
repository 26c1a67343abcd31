# SPDX-License-Identifier: BSD-3-Clause
"""A tyre model from a rig: tyre.tir, its Magic Formula and its stiffnesses (docs/rig.md)."""
from __future__ import annotations

import os
import textwrap
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import magic_formula
from ..data.errors import Error, InputError
from ..data.tir import Tir, tir, write_tir as write_file
from .fit_relaxation import with_relaxation
from .fit_rows import CHANNELS_OF, FORCES, INPUTS, Rows, rows_of
from .fit_structure import sizes_of, structure_of
from .plane import LEFT_OUT, NO_TIR, ONLY_PLANE, USE_MODE, sentence
from .points import Array, nominal
from .units import COLUMNS

if TYPE_CHECKING:
    from ..data.rig import Rig

FITTYP = 61
NOTHING = 1e-6        # of the load: channels that are smaller are none, as the lateral force of a plane wheel
LINE = 110            # characters of a comment
DEFAULT_SPEED = 16.7  # m/s, 60 km/h, of a rig that does not say it
RANGES = {"slip_ratio": ("KPUMIN", "KPUMAX"), "slip_angle": ("ALPMIN", "ALPMAX"), "camber": ("CAMMIN", "CAMMAX"),
          "load": ("FZMIN", "FZMAX"), "pressure": ("PRESMIN", "PRESMAX")}


NO_POINTS = "no points to fit a Magic Formula to (needed: the tests {needed}): run the rig with --tests {tests}"


@dataclass(frozen=True)
class Residual:
    """How far the formula is from the points of one channel."""

    unit: str
    rms: float
    largest: float     # difference
    of_largest: float  # rms over the largest size of the channel
    rows: int


@dataclass(frozen=True)
class Fitted:
    """A file of parameters and how well it meets the rig."""

    tir: Tir
    residuals: dict[str, Residual]  # by channel
    left: dict[str, str]            # coefficients without influence, and why
    at_bounds: tuple[str, ...]      # coefficients at a bound of their search


def write_tir(rig: Rig, path: str | os.PathLike[str]) -> dict[str, dict[str, Any]]:
    """Fits tyre.tir to the points of a rig and writes it; returns the residuals by channel, each with unit, rms,
    largest, of_largest and rows.
    @raise Error: the rig has no points to fit to, or scipy is missing."""
    found = fit_rig(rig)
    write_file(path, found.tir)
    return {name: asdict(one) for name, one in found.residuals.items()}


def fit_rig(rig: Rig) -> Fitted:
    """Fits all that the points of the rig hold.
    @raise Error: there are no points of steady rolling."""
    rows = rows_of(rig)
    if (why := why_none(rig, rows)):
        raise Error(f"{rig.directory}: {why}")
    known = _nominal(rig, rows)
    plane = {"USE_MODE": USE_MODE, "WIDTH": float(rig.width or 0.0)} if rig.plane else {}
    start = tir({**known, **plane, **structure_of(rig, known | plane)}, FITTYP)
    found, missing = _fit(start, rows)
    made, lengths = with_relaxation(found.tir.with_values(_ranges(rows)), rig)
    left = {**missing, **found.left}
    residuals = residuals_of(made, rows)
    return Fitted(_commented(made, rig, residuals, left, found.at_bounds, lengths), residuals, left, found.at_bounds)


def why_none(rig: Rig, rows: Rows) -> str:
    """Why a rig can have no tyre.tir; "": it can."""
    if rig.per_metre or has_forces(rows):
        return NO_TIR if rig.per_metre else ""
    tests = [name for name in CHANNELS_OF if not rig.plane or name not in LEFT_OUT]
    return NO_POINTS.format(needed=" or ".join(name for name in tests if CHANNELS_OF[name] is FORCES and name != "combined"),
                            tests=",".join(tests))


def has_forces(rows: Rows) -> bool:
    """That there is something to fit to."""
    return any(name in rows.channels for name in FORCES)


def residuals_of(made: Tir, rows: Rows) -> dict[str, Residual]:
    """The file evaluated at the points."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of ranges, whose last digits are rounded
        states: dict[str, Any] = _states(rows, made)
        forces = magic_formula.evaluate(made, **states)
    found = {}
    for name, values in rows.channels.items():
        there = np.isfinite(values)
        apart = getattr(forces, name)[there] - values[there]
        size, rms = float(np.abs(values[there]).max()), float(np.sqrt(np.mean(apart ** 2)))
        found[name] = Residual(COLUMNS[name], rms, float(np.abs(apart).max()), rms / size if size else np.inf,
                               int(there.sum()))
    return found


def _states(rows: Rows, made: Tir) -> dict[str, Array]:
    """Inputs of the Magic Formula; what a test does not say is as the file has it."""
    usual = {"pressure": made.number("NOMPRES"), "speed": made.number("LONGVL"), "load": made.number("FNOMIN")}
    names = [name for name in INPUTS if name != "pressure" or usual["pressure"]]
    return {name: np.where(np.isfinite(rows.inputs[name]), rows.inputs[name], usual.get(name, 0.0)) for name in names}


def _nominal(rig: Rig, rows: Rows) -> dict[str, float]:
    """What the file calls nominal: load, pressure and speed."""
    forces = rows.where(np.isin(rows.tests, [name for name, channels in CHANNELS_OF.items() if channels is FORCES]))
    known = {key: nominal(rig, name, forces.inputs[name]) for key, name in (("FNOMIN", "load"), ("NOMPRES", "pressure"),
                                                                ("LONGVL", "speed"))}
    if isinstance(said := rig.settings.get("load"), (int, float)):
        known["FNOMIN"] = float(said)  # also where no point has it
    known = {key: value for key, value in known.items() if np.isfinite(value) and value > 0}
    return {"LONGVL": DEFAULT_SPEED, **known, **sizes_of(rig)}


def _fit(start: Tir, rows: Rows) -> tuple[magic_formula.Fit, dict[str, str]]:
    """The fit of all channels that have enough points, and why others are missing."""
    states: dict[str, Any] = _states(rows, start)
    size = max(float(np.abs(states["load"]).max()), 1.0)
    channels: dict[str, Any] = {name: values for name, values in rows.channels.items()
                                if np.nanmax(np.abs(values)) > NOTHING * size}
    left = {name: "nothing acts in this channel" for name in rows.channels if name not in channels}
    while channels:
        try:
            return magic_formula.fit(start, **states, **channels), left
        except magic_formula.TooFewRows as reason:
            left[reason.channel] = str(reason)
            del channels[reason.channel]
    raise InputError("no channel has enough points for a Magic Formula: " + "; ".join(left.values()))


def _ranges(rows: Rows) -> dict[str, float]:
    """The states that the points cover."""
    found: dict[str, float] = {}
    for name, (low, high) in RANGES.items():
        values = rows.inputs[name][np.isfinite(rows.inputs[name])]
        if len(values) and (name != "pressure" or values.max() > 0):
            found |= {low: float(values.min()), high: float(values.max())}
    return found


def _commented(made: Tir, rig: Rig, residuals: Mapping[str, Residual], left: Mapping[str, str],
               at_bounds: Sequence[str], lengths: Sequence[str]) -> Tir:
    """With what a reader of the file has to know at its top."""
    rows = rows_of(rig)
    counts = ", ".join(f"{test} {int((rows.tests == test).sum())}" for test in dict.fromkeys(rows.tests.tolist()))
    failed = ", ".join(f"{name} {test.failed}" for name, test in rig.tests.items()
                       if test.failed and name in (*CHANNELS_OF, "vertical", "relaxation"))
    lines = [f"{rig.title}: Magic Formula 6.1 by rondo, fitted to the points of a rig: {counts}",
             *([f"Points of the rig that failed, and are not in this file: {failed}; their tables say why"] if failed else []),
             "Axes and signs: ISO 8855 (TYDEX W). SI units; angles in rad.",
             *((sentence(rig.plane, rig.width), ONLY_PLANE) if rig.plane else ()),
             *(f"{name}: rms {one.rms:.4g} {one.unit}, {100 * one.of_largest:.3g} % of the largest of {one.rows} points; "
               f"largest difference {one.largest:.4g} {one.unit}" for name, one in residuals.items()),
             *lengths]
    reasons: dict[str, list[str]] = {}
    for key, why in left.items():
        reasons.setdefault(why, []).append(key)
    lines += [f"Left without influence: {', '.join(keys)}: {why}" for why, keys in reasons.items()]
    if at_bounds:
        lines.append(f"At a bound of the search, so that they mean little: {', '.join(at_bounds)}")
    wrapped = [part for line in lines for part in textwrap.wrap(line, LINE, subsequent_indent="  ")]
    return replace(made, comments=tuple(f"! {line}" for line in wrapped))

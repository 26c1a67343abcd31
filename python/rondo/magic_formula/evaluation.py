# SPDX-License-Identifier: BSD-3-Clause
"""Forces and moments of a tyre by the parameters of a .tir file: rondo.magic_formula.evaluate."""
from __future__ import annotations

import warnings
from collections.abc import Mapping
from copy import copy
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..data.errors import InputError
from ..data.tir import Tir
from ..data.tir_keys import COEFFICIENTS, DEFAULTS
from . import formulas
from .formulas import Aligning, Curve, State, Tyre

Array = NDArray[np.float64]

PAPER, BOOK = "besselink-2010", "pacejka-2012"
ALIASES = {"PPZ1": "QPZ1", "PPZ2": "QPZ2", "PPMX1": "QPX1"}  # names of PAC2002 for the influence of pressure
_OTHERS = ("FNOMIN", "UNLOADED_RADIUS", "LONGVL")
_RANGES = {"slip_ratio": ("KPUMIN", "KPUMAX", ""), "slip_angle": ("ALPMIN", "ALPMAX", " rad"),
           "camber": ("CAMMIN", "CAMMAX", " rad"), "load": ("FZMIN", "FZMAX", " N"),
           "pressure": ("PRESMIN", "PRESMAX", " Pa")}


@dataclass(frozen=True)
class Forces:
    """Forces and moments of the ground on the tyre in the axes ISO-W (docs/conventions.md), arrays of the shape
    of the inputs."""

    Fx: Array  # N
    Fy: Array  # N, > 0 to the left
    Fz: Array  # N, the load
    Mx: Array  # N m
    My: Array  # N m, < 0 resists rolling
    Mz: Array  # N m
    trail: Array                # m, pneumatic trail: M_z = -trail F_y + residual_moment + arm F_x
    residual_moment: Array      # N m
    mu_x: Array                 # peak coefficients of the pure curves, with the sign of the file
    mu_y: Array
    slip_stiffness: Array       # N, dF_x/dkappa of the pure curve
    cornering_stiffness: Array  # N/rad, dF_y/dalpha of the pure curve, < 0
    camber_stiffness: Array     # N/rad, dF_y/dgamma at zero slip angle and camber


def evaluate(tir: Tir, *, slip_angle: ArrayLike = 0.0, slip_ratio: ArrayLike = 0.0, camber: ArrayLike = 0.0,
             load: ArrayLike | None = None, pressure: ArrayLike | None = None, speed: ArrayLike | None = None,
             variant: str = PAPER, side: str | None = None) -> Forces:
    """Forces and moments in steady rolling ahead. Numbers and arrays are broadcast.

    slip_angle [rad] > 0: the wheel moves to the left of its heading; slip_ratio over the speed of travel and the
    effective radius; camber [rad] > 0: the top leans to the right (axes ISO-W). load [N], by default FNOMIN;
    pressure [Pa], by default the nominal one; speed [m/s] > 0, by default LONGVL, counts in My alone.
    variant: "besselink-2010", as MF-Tyre computes, or "pacejka-2012", as the book prints them.
    side: "left" or "right", where the wheel is mounted: the mirror image if TYRESIDE is the other one; None: as
    in the file. Inputs beyond the ranges of the file are evaluated, with a warning.
    @raise InputError: an input is not finite, a load is below 0, a speed not above 0, or a word is not known."""
    inputs = checked(tir, {"slip_angle": slip_angle, "slip_ratio": slip_ratio, "camber": camber, "load": load,
                           "pressure": pressure, "speed": speed})
    _warn_of_ranges(tir, inputs)
    _warn_of_combined_slip(tir, inputs)
    if variant not in (PAPER, BOOK):
        raise InputError(f"variant = {variant!r} (allowed: {PAPER}, {BOOK})")
    mirror = -1.0 if _mirrored(tir, side) else 1.0
    inputs["slip_angle"], inputs["camber"] = mirror * inputs["slip_angle"], mirror * inputs["camber"]
    found = Channels(tyre_of(tir), inputs, nominal_pressure(tir), variant == BOOK).forces()
    return found if mirror > 0 else _in_the_mirror(found)


def tyre_of(tir: Tir) -> Tyre:
    """All coefficients as numbers, with those that the file does not have."""
    values = {key: tir.number(key) for key in (*COEFFICIENTS, *_OTHERS)}
    for key, other in ALIASES.items():
        if key not in tir and other in tir:
            values[key] = tir.number(other)
    if "LKYG" not in tir and "LKYC" in tir:
        values["LKYG"] = values["LKYC"]  # MF-Tyre 5.2 has this name for it
    return Tyre(values, tir.fittyp == 6)


class Channels:
    """Forces and moments of inputs that are checked and have one shape, each computed when it is first asked for."""

    def __init__(self, tyre: Tyre, given: dict[str, Array], nominal_pressure: float, book: bool) -> None:
        self.tyre, self.camber = tyre, given["camber"]
        self.state = _state(tyre, given, nominal_pressure, book)
        self.level = _state(tyre, {**given, "camber": np.zeros_like(given["camber"])}, nominal_pressure, book)

    @cached_property
    def pure_x(self) -> Curve:
        return formulas.pure_longitudinal(self.tyre, self.state)

    @cached_property
    def pure_y(self) -> Curve:
        return formulas.pure_lateral(self.tyre, self.state)

    @cached_property
    def Fx(self) -> Array:
        return formulas.longitudinal_weight(self.tyre, self.state) * self.pure_x.value

    @cached_property
    def induced(self) -> Array:
        return formulas.induced_lateral(self.tyre, self.state, self.pure_y.peak)

    @cached_property
    def Fy(self) -> Array:
        return formulas.lateral_weight(self.tyre, self.state) * self.pure_y.value + self.induced

    @cached_property
    def upright(self) -> Array:
        return formulas.lateral_weight(self.tyre, self.level) * formulas.pure_lateral(self.tyre, self.level).value

    @property
    def aligning(self) -> Aligning:
        return formulas.aligning_moment(self.tyre, self.state, self.pure_x, self.pure_y, self.upright,
                                        (self.Fx, self.Fy), self.induced)

    @property
    def Mx(self) -> Array:
        return formulas.overturning_moment(self.tyre, self.state, self.camber, self.Fy)

    @property
    def My(self) -> Array:
        return formulas.rolling_moment(self.tyre, self.state, self.camber, self.Fx)

    @property
    def Mz(self) -> Array:
        return self.aligning.value

    def with_coefficients(self, tyre: Tyre, channel: str) -> Channels:
        """The same inputs with other coefficients of one channel. Those of a moment leave the forces as they are."""
        other = copy(self)
        other.tyre = tyre
        if channel in ("Fx", "Fy"):
            for name in ("pure_x", "pure_y", "Fx", "induced", "Fy", "upright"):
                other.__dict__.pop(name, None)
        return other

    def forces(self) -> Forces:
        x, y, mz = self.pure_x, self.pure_y, self.aligning
        return Forces(self.Fx, self.Fy, self.state.load, self.Mx, self.My, mz.value, mz.trail, mz.residual, x.peak,
                      y.peak, x.stiffness, y.stiffness, y.camber_stiffness)


def _state(tyre: Tyre, given: dict[str, Array], nominal_pressure: float, book: bool) -> State:
    nominal = tyre["LFZO"] * tyre["FNOMIN"]
    alpha, gamma = given["slip_angle"], given["camber"]
    dpi = (given["pressure"] - nominal_pressure) / nominal_pressure if nominal_pressure else np.zeros_like(alpha)
    return State(np.tan(alpha) if book else alpha, np.sin(gamma) if book else gamma, given["slip_ratio"], given["load"],
                 (given["load"] - nominal) / nominal, dpi, np.cos(alpha), given["speed"], nominal, book)


def nominal_pressure(tir: Tir) -> float:
    """Pa; 0: the file has none."""
    for key in ("NOMPRES", "IP_NOM"):
        if key in tir:
            return tir.number(key)
    return 0.0


def _usual_speed(tir: Tir) -> float:
    return tir.number("LONGVL") if "LONGVL" in tir else 1.0


def checked(tir: Tir, given: Mapping[str, ArrayLike | None]) -> dict[str, Array]:
    """Inputs of evaluate() as arrays of one shape; None: load, pressure and speed of the file.
    @raise InputError: as evaluate()."""
    usual = {"load": tir.number("FNOMIN"), "pressure": nominal_pressure(tir), "speed": _usual_speed(tir)}
    with_pressure = given["pressure"] is not None
    try:
        arrays = np.broadcast_arrays(*(np.asarray(usual[name] if value is None else value, dtype=float)
                                       for name, value in given.items()))
    except (TypeError, ValueError) as reason:
        raise InputError(f"inputs of evaluate() do not go together: {reason} (allowed: numbers, or arrays whose "
                         "shapes go together)") from None
    inputs = {name: np.array(array) for name, array in zip(given, arrays)}
    for name, values in inputs.items():
        if not np.isfinite(values).all():
            raise InputError(f"{name}: not finite at {int((~np.isfinite(values)).sum())} of {values.size} places "
                             "(allowed: finite numbers)")
    for name, wrong, allowed in (("load", inputs["load"] < 0, "0 or more, in N"),
                                 ("speed", inputs["speed"] <= 0, "above 0, in m/s"),
                                 ("slip_angle", np.abs(inputs["slip_angle"]) >= np.pi / 2, "within pi/2 of 0, in rad")):
        if wrong.any():
            raise InputError(f"{name} = {inputs[name][wrong].flat[0]:g} (allowed: {allowed})")
    if with_pressure and not nominal_pressure(tir):
        raise InputError("pressure is given, and the file has no nominal one, NOMPRES (allowed: files with NOMPRES "
                         "above 0, or no pressure)")
    if tir.number("USE_MODE") < 0:
        raise InputError(f"USE_MODE = {tir['USE_MODE']}: the mirror image of the file is asked for (allowed: 0 or "
                         "more): write its number without the minus, and evaluate with side=")
    return inputs


def _warn_of_ranges(tir: Tir, inputs: dict[str, Array]) -> None:
    for name, (low, high, unit) in _RANGES.items():
        if low not in tir or high not in tir:
            continue
        least, most = tir.number(low), tir.number(high)
        outside = (inputs[name] < least * (1 - 1e-12) - 1e-12) | (inputs[name] > most * (1 + 1e-12) + 1e-12)
        if least < most and outside.any():
            warnings.warn(f"{name}: {int(outside.sum())} of {outside.size} values are beyond the range of the file, "
                          f"{least:g} to {most:g}{unit}: the formulas are extrapolated there", stacklevel=3)


def _warn_of_combined_slip(tir: Tir, inputs: dict[str, Array]) -> None:
    both = (inputs["slip_angle"] != 0) & (inputs["slip_ratio"] != 0)
    if not both.any():
        return
    if not tir.number("RBX1") and not tir.number("RBY1"):
        warnings.warn("combined slip, and the file has no coefficients of it (RBX1, RBY1): the forces are those of "
                      "pure slip, and too large", stacklevel=3)
    elif str(tir.get("FE_METHOD", "")).upper() == "YES":
        warnings.warn("combined slip, and FE_METHOD = YES asks for the friction ellipse: the forces are those of the "
                      "coefficients of combined slip (RBX1, RBY1, ...) instead", stacklevel=3)


def _mirrored(tir: Tir, side: str | None) -> bool:
    if side is None:
        return False
    measured = str(tir.get("TYRESIDE", "")).lower()
    if side not in ("left", "right"):
        raise InputError(f"side = {side!r} (allowed: left, right, or None)")
    if measured not in ("left", "right"):
        raise InputError(f"side = {side!r}, and TYRESIDE of the file is {measured or 'missing'} (allowed: files with "
                         "TYRESIDE left or right, or no side)")
    return side != measured


def _in_the_mirror(found: Forces) -> Forces:
    return Forces(found.Fx, -found.Fy, found.Fz, -found.Mx, found.My, -found.Mz, found.trail, -found.residual_moment,
                  found.mu_x, found.mu_y, found.slip_stiffness, found.cornering_stiffness, found.camber_stiffness)

# SPDX-License-Identifier: BSD-3-Clause
"""The Magic Formula: forces and moments of a tyre in steady rolling, MF 6.1 and 6.2, and 5.2 (PAC2002).

Numbers as (4.E9) are equations of Pacejka, Tire and Vehicle Dynamics, 3rd ed. (2012), section 4.3.2; inflation
pressure after Besselink, Schmeitz, Pacejka, Vehicle System Dynamics 48 (2010) S1, 337. Both write the same model and
differ in details, which `book` chooses:

                        the paper, as MF-Tyre computes         the book
    slip angle, camber  alpha, gamma                           tan(alpha), sin(gamma)
    trail over camber   1 + QDZ3 gamma + QDZ4 gamma^2          1 + QDZ3 |gamma| + QDZ4 gamma^2
    equivalent slip     atan sqrt(tan(alpha)^2 + (K k)^2)      sqrt(alpha^2 + (K k)^2)
    arm of F_x          over F_z0                              over the scaled F_z0'
    friction of shifts  LMUX, LMUY                             10 L / (1 + 9 L)

Turn slip and the reduction of friction with the slip speed are left out. Axes and signs: ISO-W
(docs/conventions.md)."""
from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class State:
    """What a tyre is in, arrays of one shape."""

    alpha: Array   # rad, or its tangent (4.E3)
    gamma: Array   # rad, or its sine (4.E4)
    kappa: Array
    load: Array    # N
    dfz: Array     # of the load over the scaled nominal one (4.E2a)
    dpi: Array     # of the pressure over the nominal one (4.E2b)
    cosine: Array  # of the slip angle
    speed: Array   # m/s
    nominal: float  # F_z0' = LFZO FNOMIN (4.E1)
    book: bool


@dataclass(frozen=True)
class Tyre:
    """Coefficients by key, and the version that they are of."""

    values: Mapping[str, float]  # all keys, those that the file does not have as what counts without
    old: bool                    # MF 5.2, PAC2002

    def __getitem__(self, key: str) -> float:
        return self.values[key]

    def polynomial(self, stem: str, x: Array, *numbers: int) -> Array:
        """stem1 + stem2 x + stem3 x^2, with the numbers of the keys."""
        total = np.zeros_like(x)
        for k, number in enumerate(numbers):
            value = self.values[f"{stem}{number}"]
            if value:
                total = total + (value if k == 0 else value * x ** k)
        return total

    def camber_of(self, force: str, gamma: Array) -> Array:
        """Camber with the scale factor that MF 5.2 has for it: "X", "Y" or "Z"."""
        return gamma * self.values[f"LGA{force}"] if self.old else gamma


@dataclass(frozen=True)
class Curve:
    """D sin(C atan(B x - E (B x - atan(B x)))) + S_V over x = slip + S_H, and its value."""

    value: Array
    stiffness: Array  # K = B C D, slope at x = 0
    peak: Array       # mu
    B: Array
    C: float
    SH: Array
    SV: Array
    camber_stiffness: Array


def ratio(a: Array, b: Array) -> Array:
    """a / b, and 0 where b is: without load there is no force."""
    safe = np.where(b == 0, 1.0, b)
    return np.asarray(np.where(b == 0, 0.0, a / safe))


def sign(x: Array) -> Array:
    """1 at 0 too."""
    return np.where(x < 0, -1.0, 1.0)


def bent(B: Array, E: Array, x: Array) -> Array:
    """B x - E (B x - atan(B x))."""
    slope = B * x
    return slope - E * (slope - np.arctan(slope))


def shift_friction(factor: float, book: bool) -> float:
    """(4.E8)."""
    return 10 * factor / (1 + 9 * factor) if book else factor


def pure_longitudinal(t: Tyre, s: State) -> Curve:
    """(4.E9) to (4.E18)."""
    gamma = t.camber_of("X", s.gamma)
    pressure = 1 + t.polynomial("PPX", s.dpi, 3, 4) * s.dpi
    mu = t.polynomial("PDX", s.dfz, 1, 2) * pressure * (1 - t["PDX3"] * gamma ** 2) * t["LMUX"]
    stiffness = (s.load * t.polynomial("PKX", s.dfz, 1, 2) * np.exp(t["PKX3"] * s.dfz) * t["LKX"]
                 * (1 + t.polynomial("PPX", s.dpi, 1, 2) * s.dpi))
    C, D = t["PCX1"] * t["LCX"], mu * s.load
    B = ratio(stiffness, C * D)
    SH = t.polynomial("PHX", s.dfz, 1, 2) * t["LHX"]
    SV = s.load * t.polynomial("PVX", s.dfz, 1, 2) * t["LVX"] * shift_friction(t["LMUX"], s.book)
    x = s.kappa + SH
    E = np.minimum(t.polynomial("PEX", s.dfz, 1, 2, 3) * (1 - t["PEX4"] * sign(x)) * t["LEX"], 1.0)
    value = D * np.sin(C * np.arctan(bent(B, E, x))) + SV
    return Curve(value, stiffness, mu, B, C, SH, SV, np.zeros_like(value))


def pure_lateral(t: Tyre, s: State) -> Curve:
    """(4.E19) to (4.E30); of MF 5.2 the shift PHY3 gamma stands for the camber stiffness."""
    gamma = t.camber_of("Y", s.gamma)
    camber_scale = t["LKYG"] if t.old else t["LKYC"]
    mu = (t.polynomial("PDY", s.dfz, 1, 2) * (1 + t.polynomial("PPY", s.dpi, 3, 4) * s.dpi)
          * (1 - t["PDY3"] * gamma ** 2) * t["LMUY"])
    reference = (t["PKY2"] + t["PKY5"] * gamma ** 2) * (1 + t["PPY2"] * s.dpi)
    upright = (t["PKY1"] * s.nominal * (1 + t["PPY1"] * s.dpi) * t["LKY"]
               * np.sin(t["PKY4"] * np.arctan(ratio(s.load / s.nominal, reference))))
    stiffness = upright * (1 - t["PKY3"] * np.abs(gamma))
    friction = shift_friction(t["LMUY"], s.book)
    SVg = s.load * t.polynomial("PVY", s.dfz, 3, 4) * gamma * camber_scale * friction
    SH = t.polynomial("PHY", s.dfz, 1, 2) * t["LHY"]
    if t.old:
        SH = SH + t["PHY3"] * gamma * camber_scale
        camber_stiffness = (t["PHY3"] * upright + s.load * t.polynomial("PVY", s.dfz, 3, 4)) * camber_scale
    else:
        camber_stiffness = s.load * t.polynomial("PKY", s.dfz, 6, 7) * (1 + t["PPY5"] * s.dpi) * camber_scale
        SH = SH + ratio(camber_stiffness * gamma - SVg, stiffness)
    SV = s.load * t.polynomial("PVY", s.dfz, 1, 2) * t["LVY"] * friction + SVg
    C, D = t["PCY1"] * t["LCY"], mu * s.load
    B = ratio(stiffness, C * D)
    x = s.alpha + SH
    E = np.minimum(t.polynomial("PEY", s.dfz, 1, 2) * t["LEY"]
                   * (1 + t["PEY5"] * gamma ** 2 - (t["PEY3"] + t["PEY4"] * gamma) * sign(x)), 1.0)
    value = D * np.sin(C * np.arctan(bent(B, E, x))) + SV
    return Curve(value, stiffness, mu, B, C, SH, SV, camber_stiffness)


def _weight(B: Array, C: float, E: Array, x: Array, shift: Array) -> Array:
    """G, 1 at x = 0 (4.E51), (4.E59)."""
    return np.asarray(np.cos(C * np.arctan(bent(B, E, x + shift))) / np.cos(C * np.arctan(bent(B, E, shift))))


def longitudinal_weight(t: Tyre, s: State) -> Array:
    """G of F_x under a slip angle (4.E51) to (4.E57)."""
    B = (t["RBX1"] + t["RBX3"] * s.gamma ** 2) * np.cos(np.arctan(t["RBX2"] * s.kappa)) * t["LXAL"]
    E = np.minimum(t.polynomial("REX", s.dfz, 1, 2), 1.0)
    return _weight(B, t["RCX1"], E, s.alpha, np.full_like(s.alpha, t["RHX1"]))


def lateral_weight(t: Tyre, s: State) -> Array:
    """G of F_y under a longitudinal slip (4.E59) to (4.E65)."""
    B = (t["RBY1"] + t["RBY4"] * s.gamma ** 2) * np.cos(np.arctan(t["RBY2"] * (s.alpha - t["RBY3"]))) * t["LYKA"]
    E = np.minimum(t.polynomial("REY", s.dfz, 1, 2), 1.0)
    return _weight(B, t["RCY1"], E, s.kappa, t.polynomial("RHY", s.dfz, 1, 2))


def induced_lateral(t: Tyre, s: State, mu: Array) -> Array:
    """F_y that a longitudinal slip makes, S_Vyk (4.E66), (4.E67)."""
    size = (mu * s.load * (t.polynomial("RVY", s.dfz, 1, 2) + t["RVY3"] * s.gamma)
            * np.cos(np.arctan(t["RVY4"] * s.alpha)))
    return np.asarray(size * np.sin(t["RVY5"] * np.arctan(t["RVY6"] * s.kappa)) * t["LVYKA"])


@dataclass(frozen=True)
class Aligning:
    """M_z (4.E71) and its parts."""

    value: Array
    trail: Array     # m
    residual: Array  # N m, M_zr


def aligning_moment(t: Tyre, s: State, fx: Curve, fy: Curve, upright: Array, total: tuple[Array, Array],
                    induced: Array) -> Aligning:
    """(4.E31) to (4.E49) and (4.E71) to (4.E78). fy: of the state; upright: G F_y0 without camber (4.E74);
    total: F_x and F_y; induced: the part of F_y that has no trail in MF 5.2."""
    gamma, size = t.camber_of("Z", s.gamma), np.abs(t.camber_of("Z", s.gamma))
    radius, friction = t["UNLOADED_RADIUS"], t["LMUY"]
    at = s.alpha + t.polynomial("QHZ", s.dfz, 1, 2) + t.polynomial("QHZ", s.dfz, 3, 4) * gamma
    ar = s.alpha + fy.SH + ratio(fy.SV, fy.stiffness)
    slip = ratio(fx.stiffness, fy.stiffness) * s.kappa
    if s.book:
        at_eq, ar_eq = (np.sqrt(x ** 2 + slip ** 2) * sign(x) for x in (at, ar))
    else:
        at_eq, ar_eq = (np.arctan(np.sqrt(np.tan(x) ** 2 + slip ** 2)) * sign(x) for x in (at, ar))
    B = t.polynomial("QBZ", s.dfz, 1, 2, 3) * (1 + t["QBZ4"] * gamma + t["QBZ5"] * size) * t["LKY"] / friction
    C = t["QCZ1"]
    D = (s.load * radius / s.nominal * t.polynomial("QDZ", s.dfz, 1, 2) * (1 - t["PPZ1"] * s.dpi) * t["LTR"]
         * (1 + t["QDZ3"] * (size if s.book else gamma) + t["QDZ4"] * gamma ** 2))
    E = np.minimum(t.polynomial("QEZ", s.dfz, 1, 2, 3) * (1 + (t["QEZ4"] + t["QEZ5"] * gamma) * 2 / np.pi
                                                          * np.arctan(B * C * at)), 1.0)
    trail = D * np.cos(C * np.arctan(bent(B, E, at_eq))) * s.cosine
    Br = t["QBZ9"] * t["LKY"] / friction + t["QBZ10"] * fy.B * fy.C
    leaning = gamma * (t.polynomial("QDZ", s.dfz, 8, 9) * (1 + t["PPZ2"] * s.dpi)
                       + t.polynomial("QDZ", s.dfz, 10, 11) * size)
    Dr = s.load * radius * (t.polynomial("QDZ", s.dfz, 6, 7) * t["LRES"] + leaning * t["LKZC"]) * friction * s.cosine
    residual = Dr * np.cos(np.arctan(Br * ar_eq))
    lateral = total[1] - induced if t.old else upright
    arm = radius * (t["SSZ1"] + t["SSZ2"] * total[1] / (s.nominal if s.book else t["FNOMIN"])
                    + t.polynomial("SSZ", s.dfz, 3, 4) * gamma) * t["LS"]
    return Aligning(-trail * lateral + residual + arm * total[0], trail, residual)


def overturning_moment(t: Tyre, s: State, gamma: Array, lateral: Array) -> Array:
    """M_x (4.E69), with QSX12 to QSX14 of MF 6.1.2; gamma [rad] is the camber itself."""
    load, side, radius = s.load / t["FNOMIN"], lateral / t["FNOMIN"], t["UNLOADED_RADIUS"]
    mixed = (t["QSX4"] * np.cos(t["QSX5"] * np.arctan((t["QSX6"] * load) ** 2))
             * np.sin(t["QSX7"] * gamma + t["QSX8"] * np.arctan(t["QSX9"] * side)))
    by_load = (t["QSX1"] * t["LVMX"] - t["QSX2"] * gamma * (1 + t["PPMX1"] * s.dpi) - t["QSX12"] * gamma * np.abs(gamma)
               + t["QSX3"] * side + mixed + t["QSX10"] * np.arctan(t["QSX11"] * load) * gamma)
    return radius * t["LMX"] * (s.load * by_load + lateral * (t["QSX13"] + t["QSX14"] * np.abs(gamma)))


def rolling_moment(t: Tyre, s: State, gamma: Array, along: Array) -> Array:
    """M_y (4.E70), < 0 as it resists rolling ahead. MF 5.2: proportional to the load."""
    load = s.load / t["FNOMIN"]
    speed = ratio(s.speed, np.full_like(s.speed, t["LONGVL"]))
    sum_ = t["QSY1"] + t["QSY2"] * along / t["FNOMIN"] + t["QSY3"] * np.abs(speed) + t["QSY4"] * speed ** 4
    if t.old:
        return -t["UNLOADED_RADIUS"] * s.load * sum_ * t["LMY"]
    sum_ = sum_ + (t["QSY5"] + t["QSY6"] * load) * gamma ** 2
    power = np.where(load > 0, np.maximum(load, 1e-300) ** t["QSY7"], 0.0) * (1 + s.dpi) ** t["QSY8"]
    return np.asarray(-t["UNLOADED_RADIUS"] * t["FNOMIN"] * sum_ * power * t["LMY"])

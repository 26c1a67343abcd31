# SPDX-License-Identifier: BSD-3-Clause
"""Closed form of the annulus in stationary spin (docs/theory.md, 6.2)."""
from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

_TERMS = 40  # of the series: arguments are below 10, whose power 80 over 40!² is 1e-15


def bessel_j(n: int, x: float) -> float:
    """J_n(x), n = 0 or 1, by its series (DLMF 10.2.2)."""
    return sum((-1) ** k * (x / 2) ** (2 * k + n) / (math.factorial(k) * math.factorial(k + n))
               for k in range(_TERMS))


def bessel_y(n: int, x: float) -> float:
    """Y_n(x), n = 0 or 1, by its series (DLMF 10.8.1)."""
    harmonic = [sum(1.0 / i for i in range(1, k + 1)) for k in range(_TERMS + 2)]
    euler = 0.5772156649015328606
    rest = sum((-1) ** k * (harmonic[k] + harmonic[k + n] - 2 * euler) * (x / 2) ** (2 * k + n)
               / (math.factorial(k) * math.factorial(k + n)) for k in range(_TERMS))
    pole = -2 / (math.pi * x) if n == 1 else 0.0
    return pole + 2 / math.pi * math.log(x / 2) * bessel_j(n, x) - rest / math.pi


def spinning_annulus(material: Mapping[str, Any], a: float, b: float, spin: float,
                     r: float) -> float:
    """u_r [m] at r of a ring held at a, free at b, at a spin below the softening limit [rad/s]:
    r + u_r = A J1(κr) + B Y1(κr), κ² = ρ s²/D11, centrifugal softening included."""
    young, nu = material["youngs_modulus"], material["poissons_ratio"]
    if material["plane"] == "strain":
        d11, d12 = (young * share / ((1 + nu) * (1 - 2 * nu)) for share in (1 - nu, nu))
    else:
        d11, d12 = (young * share / (1 - nu * nu) for share in (1.0, nu))
    kappa = abs(spin) * math.sqrt(material["density"] / d11)

    def stress(value: float, slope: float) -> float:
        """σ_rr at b."""
        return d11 * slope + d12 * value / b

    # u(a) = 0 and σ_rr(b) = D11 u' + D12 u/r = 0. Slopes: J1' = J0 - J1/x, and Y1' likewise.
    x = kappa * b
    j, y = bessel_j(1, kappa * a), bessel_y(1, kappa * a)
    sj = stress(bessel_j(1, x), kappa * (bessel_j(0, x) - bessel_j(1, x) / x))
    sy = stress(bessel_y(1, x), kappa * (bessel_y(0, x) - bessel_y(1, x) / x))
    sr = stress(b, 1.0)  # what the "r" on the left takes away
    det = j * sy - y * sj
    first, second = (a * sy - y * sr) / det, (j * sr - a * sj) / det
    return first * bessel_j(1, kappa * r) + second * bessel_y(1, kappa * r) - r

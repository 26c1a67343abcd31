# SPDX-License-Identifier: BSD-3-Clause
"""How a figure converges with the mesh or the step: observed order, Richardson's extrapolated value and
its error bar (P. J. Roache, Annu. Rev. Fluid Mech. 29, 1997; I. B. Celik and others, J. Fluids Eng. 130,
2008), or that it does not converge monotonically, and then none of these."""
from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .errors import Error

FORMAL = 2.0  # order of the elements and of the steps: no higher one is relied upon
SAFE, DOUBTFUL = 1.25, 3.0  # factors on the error: the orders are plausible, and they are not
PLAUSIBLE = (0.5, 3.0)  # orders
AGREEING = 0.5  # orders of two triples of levels differ by no more
ROUND_OFF = 1e-9  # of the largest value
HIGHEST = 20.0  # order that is looked for


@dataclass(frozen=True)
class Convergence:
    """values: coarsest first; orders: of each three levels in turn, empty without convergence;
    extrapolated: to size 0; bar: it is off by no more, as far as can be told; trouble: why there is no
    order, "" where there is one; doubt: why the bar is wide."""

    sizes: np.ndarray
    values: np.ndarray
    orders: tuple[float, ...] = ()
    extrapolated: float = math.nan
    bar: float = math.nan
    trouble: str = ""
    doubt: str = ""

    @property
    def relative(self) -> float:
        """The error bar over the extrapolated value."""
        return abs(self.bar / self.extrapolated) if self.extrapolated else math.inf


def converge(sizes: Sequence[float] | np.ndarray, values: Sequence[float] | np.ndarray) -> Convergence:
    """sizes: of the elements or steps, any unit, in any order."""
    h, f = np.asarray(sizes, dtype=float), np.asarray(values, dtype=float)
    if len(h) < 3 or h.shape != f.shape or len(np.unique(h)) < len(h):
        raise Error(f"an order needs three levels of refinement and more, each once; these are {len(h)}")
    order = np.argsort(-h)
    h, f = h[order], f[order]
    if not np.isfinite(f).all():
        return Convergence(h, f, trouble="not all values are finite")
    steps = np.diff(f)
    if np.abs(steps).max() <= ROUND_OFF * np.abs(f).max():
        return Convergence(h, f, trouble="the same on all levels")
    if (steps > 0).any() and (steps < 0).any() or (steps == 0).any():
        return Convergence(h, f, trouble="not monotone: the values go up and down")
    orders = tuple(_order(h[k:k + 3], f[k:k + 3]) for k in range(len(h) - 2))
    if math.isnan(orders[-1]):
        return Convergence(h, f, trouble="the steps between the levels do not shrink")
    value, error = _extrapolated(h, f, orders[-1])
    doubt = _doubt(orders)
    return Convergence(h, f, orders, value, (DOUBTFUL if doubt else SAFE) * error, doubt=doubt)


def _order(h: np.ndarray, f: np.ndarray) -> float:
    """p of f = F + C h**p through three levels; NaN: there is none above 0."""
    wanted = (f[1] - f[0]) / (f[2] - f[1])

    def ratio(p: float) -> float:
        return float((h[0]**p - h[1]**p) / (h[1]**p - h[2]**p))
    low, high = 1e-6, HIGHEST
    if not ratio(low) < wanted:
        return math.nan
    if wanted > ratio(high):
        return HIGHEST
    for _ in range(60):  # the ratio grows with p
        middle = 0.5 * (low + high)
        low, high = (middle, high) if ratio(middle) < wanted else (low, middle)
    return 0.5 * (low + high)


def _extrapolated(h: np.ndarray, f: np.ndarray, p: float) -> tuple[float, float]:
    """The value at size 0, by the observed order, but by none above the formal one; what it is off by
    is the distance from the finest level."""
    q = min(p, FORMAL)
    change = (f[-1] - f[-2]) * h[-1]**q / (h[-2]**q - h[-1]**q)
    return float(f[-1] + change), float(abs(change))


def _doubt(orders: tuple[float, ...]) -> str:
    """Why the levels are not fine enough to rely on the order; "": they are."""
    low, high = PLAUSIBLE
    if not low <= orders[-1] <= high:
        return f"an order of {orders[-1]:.2g} is not that of the method"
    if len(orders) > 1 and not abs(orders[-1] - orders[-2]) <= AGREEING:
        return "the orders of the levels differ"
    return ""

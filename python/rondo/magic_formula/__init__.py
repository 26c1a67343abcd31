# SPDX-License-Identifier: BSD-3-Clause
"""The Magic Formula of tyres: rondo.magic_formula.evaluate(tir, ...), fit(tir, ...) (docs/tyre-files.md)."""
from .evaluation import Forces, evaluate
from .fitting import Fit, Residual, TooFewRows, fit

__all__ = ["Fit", "Forces", "Residual", "TooFewRows", "evaluate", "fit"]

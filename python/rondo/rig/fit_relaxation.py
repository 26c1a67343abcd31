# SPDX-License-Identifier: BSD-3-Clause
"""Relaxation lengths of a rig as a .tir file of version 6.1 has them: the slip or cornering stiffness K of the file over
a stiffness C of the tyre, sigma = K / C with C = C_0 (1 + p_1 df_z + p_2 df_z^2).

Pacejka, Tire and Vehicle Dynamics, 3rd ed. (2012), appendix 3, (A3.9) and (A3.10). PTX1 to PTY2 are those of versions before."""
from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

import numpy as np

from .. import magic_formula
from ..data.tir import Tir
from .points import Array, chosen, levels, points, texts

if TYPE_CHECKING:
    from ..data.rig import Rig

TEST = "relaxation"
# By step: what it is, key of C_0, beginning of the others, stiffness of the file.
STEPS = {"slip-ratio": ("slip ratio", "LONGITUDINAL_STIFFNESS", "PCFX", "slip_stiffness"),
         "slip-angle": ("slip angle", "LATERAL_STIFFNESS", "PCFY", "cornering_stiffness")}
EXACT = 1e-9  # relative: what is less is round-off
MOST = 3  # coefficients of C over the load
EVERY = 201  # loads between those of the rig and of the file, at which C is to be above 0


def with_relaxation(made: Tir, rig: Rig) -> tuple[Tir, list[str]]:
    """The file with the stiffnesses that give it the relaxation lengths of the rig, and what a reader has to know of them."""
    found = points(rig, TEST, ("load", "pressure", "relaxation_length_fit"))
    kinds = np.array(texts(rig, TEST, "step"), dtype=str)
    lines = []
    for step, (name, key, prefix, attribute) in STEPS.items():
        here = chosen(found, (kinds == step) & np.isfinite(found["relaxation_length_fit"]))
        if not len(here["load"]):
            continue
        stiffness = _stiffness(made, attribute, here["load"], here["pressure"])
        change = here["load"] / made.number("FNOMIN") - 1.0
        values = _over_load(change, stiffness / here["relaxation_length_fit"], len(levels(here["load"])), _range(made, here["load"]))
        slope = attribute.replace("_", " ")
        if values is None:
            lines.append(f"No relaxation length of the {name}: the file has no {slope} at its loads")
            continue
        made = made.with_values({key: values[0]} | {f"{prefix}{k}": value / values[0] for k, value in enumerate(values[1:], 1)})
        again = stiffness / np.polynomial.polynomial.polyval(change, values)
        fewer = _fewer(values, here["load"])
        apart = float(np.abs(again / here["relaxation_length_fit"] - 1.0).max())
        lines.append(f"Relaxation lengths of the {name}: {key} is the {slope} of this file over the length of the rig, "
                     f"sigma = K / C; met {f'to {100 * apart:.2g} %' if apart > EXACT else 'exactly'} at {len(change)} load{'s' if len(change) != 1 else ''}{fewer}")
    return made, lines


def _stiffness(made: Tir, attribute: str, load: Array, pressure: Array) -> Array:
    """Of the pure curve, > 0."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of ranges, whose last digits are rounded
        forces = magic_formula.evaluate(made, load=load, pressure=pressure if made.number("NOMPRES") else None)
    return np.abs(np.asarray(getattr(forces, attribute)))


def _fewer(values: list[float], load: Array) -> str:
    less = min(len(levels(load)), MOST) - len(values)
    return f", with {less} power{'s' if less > 1 else ''} of the load less, because C has to be above 0 from FZMIN to FZMAX" if less else ""


def _range(made: Tir, load: Array) -> Array:
    """df_z over the loads of the rig and those that the file allows."""
    ends = [*load, *(made.number(key) for key in ("FZMIN", "FZMAX") if key in made)]
    return np.linspace(min(ends), max(ends), EVERY) / made.number("FNOMIN") - 1.0


def _over_load(change: Array, values: Array, loads: int, allowed: Array) -> list[float] | None:
    """Coefficients of the powers of df_z, as many as the loads tell and as keep C above 0 at all loads that are allowed; None:
    not all of the values are above 0."""
    if not (np.isfinite(values) & (values > 0)).all():
        return None
    for count in range(min(loads, MOST), 0, -1):
        found = np.linalg.lstsq(np.vander(change, count, increasing=True), values, rcond=None)[0]
        if found[0] > 0 and (np.polynomial.polynomial.polyval(allowed, found) > 0).all():
            return [float(one) for one in found]
    return None

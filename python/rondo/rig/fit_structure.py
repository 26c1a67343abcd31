# SPDX-License-Identifier: BSD-3-Clause
"""The keys of a .tir file that are not of the Magic Formula: vertical stiffness and size of the contact patch.

Formulas: Besselink, Schmeitz, Pacejka, Vehicle System Dynamics 48 (2010) S1, 337; Pacejka, Tire and Vehicle Dynamics,
3rd ed. (2012), sections 4.3, 9.3 and appendix 3."""
from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from .points import Array, chosen, points

if TYPE_CHECKING:
    from ..data.rig import Rig

LEAST = 3        # points of a fit with two or three coefficients
APART = 0.01     # relative: loads and pressures that differ by more are several


def vertical(deflection: Array, load: Array, pressure: Array, nominal: Mapping[str, float]) -> dict[str, float]:
    """VERTICAL_STIFFNESS, Q_FZ1, Q_FZ2, PFZ1 of F_z = (q1 x + q2 x^2) (1 + p dpi) F_z0 with x = deflection / R_0 of a
    wheel that is upright. {}: fewer than LEAST points. The stiffness is that of the format,
    F_z0 / R_0 sqrt(q1^2 + 4 q2), the slope at the nominal load and pressure."""
    from scipy.optimize import least_squares  # optional: only fits need it

    radius, force = nominal["UNLOADED_RADIUS"], nominal["FNOMIN"]
    chosen = (deflection > 0) & (load > 0)
    x, y = deflection[chosen] / radius, load[chosen] / force
    if len(x) < LEAST:
        return {}
    several = np.ptp(pressure[chosen]) > APART * pressure[chosen].max()
    dpi = pressure[chosen] / nominal["NOMPRES"] - 1 if several else np.zeros_like(x)

    def apart(q: Array) -> Array:
        return np.asarray((q[0] * x + q[1] * x ** 2) * (1 + (q[2] if several else 0.0) * dpi) - y)

    first, second, by_pressure = least_squares(apart, [float(np.sum(x * y) / np.sum(x * x)), 0.0, 0.5],
                                               x_scale=[10.0, 100.0, 1.0]).x
    slope = first ** 2 + 4 * second
    if slope <= 0:  # the curve turns down before the nominal load
        return {}
    found = {"VERTICAL_STIFFNESS": force / radius * float(np.sqrt(slope)), "Q_FZ1": float(first),
             "Q_FZ2": float(second)}
    return {**found, "PFZ1": float(by_pressure)} if several else found


def patch(length: Array, width: Array, load: Array, known: Mapping[str, float]) -> dict[str, float]:
    """Q_RA1, Q_RA2, Q_RB1, Q_RB2: half the length of the contact patch is R_0 (q_ra2 s + q_ra1 sqrt(s)), half its width
    WIDTH (q_rb2 s + q_rb1 s^(1/3)), with s = F_z / (c_z R_0). The last two need a width of the contact."""
    if "VERTICAL_STIFFNESS" not in known or "WIDTH" not in known or len(load) < 2:
        return {}
    share = load / (known["VERTICAL_STIFFNESS"] * known["UNLOADED_RADIUS"])
    along = np.linalg.lstsq(np.stack([np.sqrt(share), share], axis=1), 0.5 * length / known["UNLOADED_RADIUS"],
                            rcond=None)[0]
    lengths = {"Q_RA1": float(along[0]), "Q_RA2": float(along[1])}
    if not np.isfinite(width).all():
        return lengths
    across = np.linalg.lstsq(np.stack([np.cbrt(share), share], axis=1), 0.5 * width / known["WIDTH"], rcond=None)[0]
    return {**lengths, "Q_RB1": float(across[0]), "Q_RB2": float(across[1])}


def sizes_of(rig: Rig) -> dict[str, float]:
    """UNLOADED_RADIUS of the inflated wheel: the height of its center and how far it has come down; without such points, that
    of the state of reference in rig.json."""
    found = points(rig, "vertical", ("height", "deflection"))
    radius = found["height"] + found["deflection"]
    if np.isfinite(radius).any():
        return {"UNLOADED_RADIUS": float(np.nanmean(radius))}
    known = rig.info.get("radius")
    return {"UNLOADED_RADIUS": float(known)} if isinstance(known, (int, float)) and known > 0 else {}


def structure_of(rig: Rig, known: Mapping[str, float]) -> dict[str, float]:
    """All of these keys that the rig has points for."""
    if "UNLOADED_RADIUS" not in known or "FNOMIN" not in known:
        return {}
    upright = points(rig, "vertical", ("deflection", "load", "pressure", "contact_length", "contact_width", "camber"))
    upright = chosen(upright, np.isfinite(upright["deflection"]) & ~(np.abs(upright["camber"]) > 0))
    found = vertical(upright["deflection"], upright["load"], upright["pressure"], known)
    known = {**known, **found}
    without_air = (upright["pressure"] == 0.0) & bool(rig.plane)
    nominal = chosen(upright, (np.isclose(upright["pressure"], known.get("NOMPRES", np.nan), rtol=APART) | without_air)
                     & np.isfinite(upright["contact_length"]))
    found |= patch(nominal["contact_length"], nominal["contact_width"], nominal["load"], known)
    return found

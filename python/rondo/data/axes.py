# SPDX-License-Identifier: BSD-3-Clause
"""Axes and signs of wheels in three dimensions: one table of the systems in use, and conversions between
them: run.history.in_axes("iso-w"), rondo.axes.convert(...). docs/conventions.md draws and explains them.

All conversions go through rondo's own axes on the ground: t1 along the heading, n out of the ground,
t2 = t1 x n to the right, moments about the point c0 below the center of the wheel (docs/wheel3d.md,
sections 1 and 4). Sources: ISO 8855:2011; SAE J670e (1976) and J670:2008, axes with z down; TYDEX-Format 1.3
(Unrau, Zamow 1997); Pacejka, Tire and Vehicle Dynamics, 3rd ed. (2012), appendix 1."""
from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import InputError

Array = NDArray[np.float64]

GROUND, CONTACT, CENTER = "below the center", "contact center", "wheel center"  # origins of moments


@dataclass(frozen=True)
class System:
    """A system of axes, as multiples of rondo's: x is t1 in all of them."""

    name: str
    title: str
    y: str            # where y points at an upright wheel: "left", "right", "up"
    z: str            # where z points: "up", "down", "right"
    origin: str       # about which point moments are: GROUND, CONTACT or CENTER
    leans: bool       # y and z lean with the wheel, and do not lie in and on the ground
    load_positive: bool  # the normal force is given as the load, whatever the sense of the axis
    slip_angle: int   # sign of a velocity to the right of the heading
    camber: int       # sign of a wheel whose top leans to the left
    turn_slip: int    # sign of a path that bends to the left
    slip_ratio: str   # a key of SLIP_RATIOS


SLIP_RATIOS = {
    "travel": "(w R - V) / |V|: -1 with the wheel locked, unbounded when it spins",
    "larger": "(w R - V) / max(|V|, |w R|): from -1 with the wheel locked to 1 when it spins on the spot"}

_ROWS = (
    System("rondo", "rondo's own: x ahead, y out of the ground, z to the right", "up", "right", GROUND, False, False,
           1, 1, 1, "larger"),
    System("iso-w", "ISO 8855 tyre axes = TYDEX W: z out of the ground, at the contact center", "left", "up", CONTACT,
           False, False, -1, -1, 1, "travel"),
    System("tydex-h", "TYDEX H: directions of W, at the wheel center", "left", "up", CENTER, False, False,
           -1, -1, 1, "travel"),
    System("tydex-c", "TYDEX C: y along the axle, z in the plane of the wheel, at the wheel center", "left", "up",
           CENTER, True, False, -1, -1, 1, "travel"),
    System("sae", "SAE J670, z down: at the contact center; the normal force on the tyre is negative", "right", "down",
           CONTACT, False, False, 1, -1, -1, "travel"),
    System("adapted-sae", "SAE as Pacejka adapted it: slip angle reversed, load and turn slip positive", "right",
           "down", CONTACT, False, True, -1, -1, 1, "travel"))
SYSTEMS: Mapping[str, System] = {row.name: row for row in _ROWS}
_OTHER_NAMES = {"tydex-w": "iso-w"}
NAMES = (*SYSTEMS, *_OTHER_NAMES)  # what --axes takes


def system(name: str) -> System:
    """@raise InputError: there is no such system."""
    found = SYSTEMS.get(_OTHER_NAMES.get(name, name))
    if found is None:
        raise InputError(f"axes {name!r}: no such system (allowed: {', '.join(NAMES)})")
    return found


@dataclass(frozen=True)
class Quantities:
    """Forces and moments of the ground on a wheel and its motion, in the axes named `system`. Arrays of
    one shape."""

    system: str
    Fx: Array          # N
    Fy: Array
    Fz: Array
    Mx: Array          # N m
    My: Array
    Mz: Array
    slip_angle: Array  # rad
    camber: Array      # rad
    slip_ratio: Array
    turn_slip: Array   # 1/m, curvature of the path
    height: Array      # m, of the wheel center above the ground, in all systems
    time: Array | None = None  # s, end of the intervals of a history

    def mean(self, weights: ArrayLike, rows: ArrayLike | None = None) -> Quantities:
        """Means of all quantities over rows, those of the mask or all; a weight for each."""
        chosen = slice(None) if rows is None else np.asarray(rows, dtype=bool)
        means = {name: np.average(getattr(self, name)[chosen], weights=weights) for name in QUANTITIES}
        return Quantities(self.system, **{name: np.asarray(value) for name, value in means.items()})

    @property
    def forces(self) -> Array:
        """(..., 3) N."""
        return np.stack([self.Fx, self.Fy, self.Fz], axis=-1)

    @property
    def moments(self) -> Array:
        """(..., 3) N m."""
        return np.stack([self.Mx, self.My, self.Mz], axis=-1)


def sense_in(name: str, key: str) -> int:
    """-1 where a key of the case, `motion.camber`, `motion.slip_angle` or `motion.turn_slip`, has the other
    sign in these axes than in the case; else 1, also of other keys."""
    quantity = key.removeprefix("motion.")
    if quantity not in ("camber", "slip_angle", "turn_slip"):
        return 1
    return int(getattr(system(name), quantity) * getattr(SYSTEMS["rondo"], quantity))


QUANTITIES = {  # their units, and the ends of their names in tables
    "Fx": ("N", "_N"), "Fy": ("N", "_N"), "Fz": ("N", "_N"), "Mx": ("N·m", "_Nm"), "My": ("N·m", "_Nm"),
    "Mz": ("N·m", "_Nm"), "slip_angle": ("rad", "_rad"), "camber": ("rad", "_rad"), "slip_ratio": ("1", ""),
    "turn_slip": ("1/m", "_per_m"), "height": ("m", "_m")}


def directions(name: str, camber: ArrayLike) -> Array:
    """(..., 3, 3) rows x, y, z of a system as components along t1, n, t2. camber [rad] is rondo's: > 0
    leans the top of the wheel to the left."""
    row = system(name)
    angle = np.asarray(camber, dtype=float) * (1.0 if row.leans else 0.0)
    zero, one = np.zeros_like(angle), np.ones_like(angle)
    up = np.stack([zero, np.cos(angle), -np.sin(angle)], axis=-1)    # in the plane of the wheel
    right = np.stack([zero, np.sin(angle), np.cos(angle)], axis=-1)  # along the axle
    ahead = np.stack([one, zero, zero], axis=-1)
    towards = {"up": up, "down": -up, "right": right, "left": -right}
    return np.stack([ahead, towards[row.y], towards[row.z]], axis=-2)


def origin(name: str, camber: ArrayLike, height: ArrayLike) -> Array:
    """(..., 3) m along t1, n, t2: from c0, below the wheel center on the ground, to the origin of the
    system. The contact center is where the line in the plane of the wheel from its center down meets the
    ground: on the right of c0 if the top leans to the left."""
    angle, above = np.broadcast_arrays(np.asarray(camber, float), np.asarray(height, float))
    where, zero = system(name).origin, np.zeros(angle.shape)
    along_n = above if where == CENTER else zero
    along_t2 = above * np.tan(angle) if where == CONTACT else zero
    return np.stack([zero, along_n, along_t2], axis=-1)


def convert(given: Quantities, to: str, effective_radius: ArrayLike | None = None,
            radius: ArrayLike | None = None) -> Quantities:
    """The same forces and motion in another system. The wheel rolls ahead. Slip ratios keep their radius
    unless both are given: `radius` [m] is that of the slip ratio in rondo's definition (the outer radius),
    `effective_radius` [m] that of the other systems (V / w of free rolling)."""
    source, target = system(given.system), system(to)
    camber = given.camber * source.camber
    forces, moments = _to_own(given, camber)
    arm = origin(to, camber, given.height)
    moments = moments - np.cross(arm, forces)  # about the origin of `to`: M - r x F
    rows = directions(to, camber)
    force = np.einsum("...ij,...j->...i", rows, forces)
    moment = np.einsum("...ij,...j->...i", rows, moments)
    if target.load_positive:
        force[..., 2] *= -1.0
    slip = _converted_slip(given.slip_ratio, source.slip_ratio, target.slip_ratio, radius, effective_radius)
    return Quantities(target.name, force[..., 0], force[..., 1], force[..., 2], moment[..., 0], moment[..., 1], moment[..., 2],
                      given.slip_angle * (source.slip_angle * target.slip_angle) + 0.0, camber * target.camber + 0.0, slip,
                      given.turn_slip * (source.turn_slip * target.turn_slip) + 0.0, given.height, given.time)  # no -0


def _to_own(given: Quantities, camber: Array) -> tuple[Array, Array]:
    """Along t1, n, t2, moments about c0."""
    force = given.forces
    if system(given.system).load_positive:
        force = force * np.array([1.0, 1.0, -1.0])
    rows = directions(given.system, camber)
    forces = np.einsum("...ji,...j->...i", rows, force)  # rows are orthonormal: their inverse is their transpose
    moments = np.einsum("...ji,...j->...i", rows, given.moments)
    return forces, moments + np.cross(origin(given.system, camber, given.height), forces)


# Slip ratios

def slip_ratio(speed: ArrayLike, spin: ArrayLike, radius: ArrayLike, definition: str = "travel") -> Array:
    """Of a wheel that travels at `speed` V [m/s] along its heading and turns at `spin` w [rad/s], > 0 ahead,
    with the radius R [m] that counts: the effective one in ISO 8855, SAE J670 and TYDEX, the outer one in
    rondo's columns. `definition`: a key of SLIP_RATIOS."""
    travel, rim = np.broadcast_arrays(np.asarray(speed, float), np.asarray(spin, float) * np.asarray(radius, float))
    size = np.abs(travel)
    if _definition(definition) == "larger":
        size = np.maximum(size, np.abs(rim))
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.where((size > 0) | (rim != 0), (rim - travel) / size, 0.0))


def convert_slip_ratio(value: ArrayLike, given: str, wanted: str) -> Array:
    """A slip ratio of a wheel that rolls ahead, in the other definition and with the same radius."""
    s = np.asarray(value, dtype=float)
    if _definition(given) == _definition(wanted):
        return s
    if given == "larger" and np.any(s >= 1.0):
        raise InputError("a slip ratio of 1 or more over the larger speed: the wheel spins on the spot, and its slip "
                         "ratio over the speed of travel is not finite (allowed: less than 1)")
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.where(s > 0, s / (1 - s) if given == "larger" else s / (1 + s), s))


def _definition(name: str) -> str:
    if name not in SLIP_RATIOS:
        raise InputError(f"slip ratio {name!r}: no such definition (allowed: {', '.join(SLIP_RATIOS)})")
    return name


def _converted_slip(value: Array, given: str, wanted: str, radius: ArrayLike | None,
                    effective: ArrayLike | None) -> Array:
    if (radius is None) != (effective is None):
        raise InputError("a slip ratio changes its radius with both `radius` and `effective_radius`, and one of them "
                         "is missing (allowed: both, or neither)")
    if effective is not None:
        _demand_effective(effective, given, wanted)
    if radius is None or effective is None:
        return convert_slip_ratio(value, given, wanted)
    share = np.asarray(effective, float) / np.asarray(radius, float)  # of the new radius, from "larger"
    if given == "travel":
        share = 1.0 / share
    travel = convert_slip_ratio(value, given, "travel")
    return convert_slip_ratio((1.0 + travel) * share - 1.0, "travel", wanted)


def _demand_effective(radius: ArrayLike, given: str, wanted: str) -> None:
    """An error of what is no effective radius, or replaces no outer radius."""
    values = np.asarray(radius, float)
    if not np.all(np.isfinite(values) & (values > 0.0)):
        raise InputError(f"effective_radius {radius!r}: is no radius (allowed: above 0 m, V / w of free rolling)")
    if given == wanted:
        raise InputError(f"effective_radius {radius!r}: the slip ratio has the same radius in both systems (allowed: no "
                         "effective radius, or one system with the outer radius, rondo, and one with the effective one)")


# Columns

def own(*, force_x: ArrayLike, force_y: ArrayLike, force_lateral: ArrayLike, moment_aligning: ArrayLike,
        moment_overturning: ArrayLike, torque: ArrayLike, height: ArrayLike, camber: ArrayLike = 0.0,
        slip_angle: ArrayLike = 0.0, slip_ratio: ArrayLike = 0.0, turn_slip: ArrayLike = 0.0,
        time: Array | None = None) -> Quantities:
    """Quantities in rondo's own axes, of columns with the names and signs of a history or a sweep of wheels in three
    dimensions, to be converted. N, N m, m, rad, 1/m; numbers and arrays are broadcast."""
    given = (force_x, force_y, force_lateral, moment_overturning, moment_aligning, torque, slip_angle, camber, slip_ratio,
             turn_slip, height)
    arrays: list[Array] = [np.array(values, dtype=float) for values in np.broadcast_arrays(*given)]
    along, up, right, about_t1, about_n, axle, angle, lean, slip, turn, above = arrays
    # The torque is that about the axle, through the center: torque = sin(camber) M_n + cos(camber) M_t2(center),
    # and about c0, a height below it, M_t2 is less by the height times the force along t1.
    about_t2 = (axle - np.sin(lean) * about_n) / np.cos(lean) - above * along
    return Quantities("rondo", along, up, right, about_t1, about_n, about_t2, angle, lean, slip, turn, above, time)

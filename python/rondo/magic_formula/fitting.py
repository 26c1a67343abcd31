# SPDX-License-Identifier: BSD-3-Clause
"""Coefficients of the Magic Formula from measured or computed forces: rondo.magic_formula.fit."""
from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..data.errors import InputError
from ..data.tables import installed
from ..data.tir import Tir
from .evaluation import BOOK, PAPER, Channels, checked, nominal_pressure, tyre_of
from .fit_keys import NEUTRAL, NOT_OLD, ONLY_OLD, STAGES, Key, Stage
from .formulas import Tyre

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

CHANNELS = ("Fx", "Fy", "Mx", "My", "Mz")
SLIP_ANGLE, CAMBER, SLIP = np.radians(0.1), np.radians(0.1), 0.002  # up to which there is none
APART = 0.01        # relative: loads, pressures, speeds that differ by more are several
EXACT = 1e-9        # rms of the residual over that of the channel: no better start is looked for
WEAK = 1e-9         # a singular value of the scaled Jacobian over the largest: the data do not hold what it stands for
_SMALLEST = 1e-12   # of a residual's scale
LAST = {stage.channel: stage for stage in STAGES}  # after which all coefficients of a channel are refined together


class TooFewRows(InputError):
    """A channel has fewer rows than coefficients."""

    def __init__(self, channel: str, text: str) -> None:
        super().__init__(text)
        self.channel = channel


@dataclass(frozen=True)
class Residual:
    """How far the fit is from the data of a channel, in its unit."""

    rms: float
    largest: float
    share: float  # rms over that of the data
    rows: int


@dataclass(frozen=True)
class Fit:
    """What a fit has found."""

    tir: Tir                        # with the coefficients
    residuals: dict[str, Residual]  # by channel
    fitted: tuple[str, ...]         # keys that the data hold
    left: dict[str, str]            # keys that are left without influence, and why
    at_bounds: tuple[str, ...]      # fitted keys that stand at a bound of their search

    @property
    def lines(self) -> list[str]:
        """The residuals and what was left out, in sentences."""
        said = [f"{name}: rms {one.rms:.4g}, largest {one.largest:.4g} {'N' if name[0] == 'F' else 'N m'}; "
                f"{100 * one.share:.3g} % of the rms of {one.rows} rows" for name, one in self.residuals.items()]
        reasons: dict[str, list[str]] = {}
        for key, why in self.left.items():
            reasons.setdefault(why, []).append(key)
        said += [f"left without influence: {', '.join(keys)}: {why}" for why, keys in reasons.items()]
        if self.at_bounds:
            said.append(f"at a bound of the search, so that they mean little: {', '.join(self.at_bounds)}")
        return said


def fit(tir: Tir, *, load: ArrayLike, slip_angle: ArrayLike = 0.0, slip_ratio: ArrayLike = 0.0, camber: ArrayLike = 0.0,
        pressure: ArrayLike | None = None, speed: ArrayLike | None = None, Fx: ArrayLike | None = None,
        Fy: ArrayLike | None = None, Mx: ArrayLike | None = None, My: ArrayLike | None = None,
        Mz: ArrayLike | None = None, variant: str = PAPER) -> Fit:
    """Fits the coefficients of the channels that are given, stage by stage: pure slip, camber, combined slip, F_x
    before F_y before the moments. Inputs and axes are those of evaluate() (ISO-W); all arrays (rows,), NaN in a
    channel: not measured there.

    tir: nominal load, radius, speed and pressure, and scale factors. Coefficients of channels that are not given
    stay as they are; so do PKY4 and QSX4 to QSX9, which are not fitted. Those that the data do not hold, as the
    influence of a pressure that does not change, are left at 0 (PKY2: 1.5, QSY7: 1) and named in `left`.
    @raise InputError: no channel, too few rows, an input out of its range; Error: no scipy."""
    installed("scipy", "magic_formula.fit()")
    data = _Data.of(tir, {"slip_angle": slip_angle, "slip_ratio": slip_ratio, "camber": camber, "load": load,
                          "pressure": pressure, "speed": speed},
                    {"Fx": Fx, "Fy": Fy, "Mx": Mx, "My": My, "Mz": Mz}, variant)
    for stage in STAGES:
        if stage.channel in data.measured:
            data.run(stage)
        if stage.channel in data.measured and stage is LAST.get(stage.channel):
            data.together(stage.channel)
    return data.result()


@dataclass
class _Data:
    """The rows, and the coefficients as far as they are known."""

    tir: Tir
    inputs: dict[str, Array]
    measured: dict[str, Array]
    book: bool
    values: dict[str, float]
    fitted: list[Key] = field(default_factory=list)
    left: dict[str, str] = field(default_factory=dict)

    @staticmethod
    def of(tir: Tir, given: Mapping[str, ArrayLike | None], channels: Mapping[str, ArrayLike | None],
           variant: str) -> _Data:
        if variant not in (PAPER, BOOK):
            raise InputError(f"variant = {variant!r} (allowed: {PAPER}, {BOOK})")
        there = {name: np.asarray(values, dtype=float) for name, values in channels.items() if values is not None}
        if not there:
            raise InputError(f"fit() without data (allowed: one or more of {', '.join(CHANNELS)})")
        inputs = checked(tir, given)
        shapes = {values.shape for values in (*inputs.values(), *there.values())} - {()}
        if len(shapes) != 1 or len(next(iter(shapes))) != 1:
            raise InputError(f"shapes of inputs and channels: {', '.join(map(str, sorted(shapes)))} (allowed: "
                             "(rows,), or numbers as inputs)")
        rows = next(iter(shapes))
        inputs = {name: np.broadcast_to(values, rows) for name, values in inputs.items()}
        return _Data(tir, inputs, there, variant == BOOK, dict(tyre_of(tir).values))

    def rows(self, stage: Stage) -> Mask:
        """Those that a stage takes its coefficients from."""
        mask = np.isfinite(self.measured[stage.channel])
        other, least = (("slip_angle", SLIP_ANGLE) if stage.channel == "Fx" else ("slip_ratio", SLIP))
        if stage.rows in ("pure", "cambered"):
            mask &= np.abs(self.inputs[other]) <= least
        if stage.rows == "pure":
            mask &= np.abs(self.inputs["camber"]) <= CAMBER
        return np.asarray(mask)

    def run(self, stage: Stage) -> None:
        rows, old = self.rows(stage), self.tir.fittyp == 6
        keys = [key for key in stage.keys if key.name not in (NOT_OLD if old else ONLY_OLD)]
        held = []
        for key in keys:
            reason = self._missing(key, rows)
            self.values[key.name] = NEUTRAL.get(key.name, 0.0)
            if reason:
                self.left[key.name] = reason
            else:
                held.append(key)
        if not held:
            return
        if int(rows.sum()) < len(held):
            raise TooFewRows(stage.channel, f"{stage.channel}: {int(rows.sum())} rows of {stage.name} for {len(held)} "
                             f"coefficients (allowed: as many rows or more, {_asked(stage)}): measure more of them, or "
                             f"leave {stage.channel} out")
        self._best(stage, held, rows)

    def together(self, channel: str) -> None:
        """All coefficients of a channel at once: its stages know little of one another's."""
        stages = [(stage, [key for key in stage.keys if key in self.fitted]) for stage in STAGES
                  if stage.channel == channel]
        keys = [key for _, held in stages for key in held]
        if not keys:
            return
        rows = np.logical_or.reduce([self.rows(stage) for stage, held in stages if held])
        found = self._solve(channel, keys, rows, [self.values[key.name] for key in keys])
        self.values.update(zip((key.name for key in keys), found.x))

    def _best(self, stage: Stage, keys: list[Key], rows: Mask) -> None:
        """The best of all starts, without the coefficients that the data do not hold."""
        best: Any = None
        for tried in stage.tries:
            start = {key.name: key.start for key in keys} | {k: v for k, v in tried if k in {key.name for key in keys}}
            found = self._solve(stage.channel, keys, rows, [start[key.name] for key in keys])
            if best is None or found.cost < best.cost:
                best = found
            if np.sqrt(2 * best.cost) < EXACT:
                break
        weak = _weakest(best.jac, keys)
        if weak is not None:
            self.values[weak.name] = NEUTRAL.get(weak.name, 0.0)
            self.left[weak.name] = f"the rows of {stage.name} do not tell it from the other coefficients"
            rest = [key for key in keys if key is not weak]
            if rest:
                self._best(stage, rest, rows)
            return
        self.values.update(zip((key.name for key in keys), map(float, best.x)))
        self.fitted += keys

    def _solve(self, channel: str, keys: list[Key], rows: Mask, start: list[float]) -> Any:
        from scipy.optimize import least_squares  # optional: only fits need it

        inputs = {name: values[rows] for name, values in self.inputs.items()}
        measured = self.measured[channel][rows]
        scale = max(float(np.sqrt(np.mean(measured ** 2))), _SMALLEST) * np.sqrt(len(measured))
        values = dict(self.values)
        old, names = self.tir.fittyp == 6, [key.name for key in keys]
        known = Channels(Tyre(self.values, old), inputs, nominal_pressure(self.tir), self.book)
        getattr(known, channel)  # what does not change is computed once

        def residual(x: Array) -> Array:
            values.update(zip(names, x))
            found = known.with_coefficients(Tyre(values, old), channel)
            return np.asarray((getattr(found, channel) - measured) / scale)

        low, high = np.array([key.low for key in keys]), np.array([key.high for key in keys])
        inside = np.clip(start, low + 1e-6 * (high - low), high - 1e-6 * (high - low))
        return least_squares(residual, inside, bounds=(low, high), x_scale=_sizes(keys), method="trf", ftol=1e-10,
                             xtol=1e-12, gtol=1e-15, max_nfev=100)

    def _missing(self, key: Key, rows: Mask) -> str:
        """Why the rows do not hold a coefficient; "": they may."""
        slipping = np.abs(self.inputs["slip_ratio"][rows]) > SLIP
        if "k" in key.needs and not slipping.any():
            return "no slip ratio in the data"
        if "b" in key.needs and not (slipping & (np.abs(self.inputs["slip_angle"][rows]) > SLIP_ANGLE)).any():
            return "no combined slip in the data"
        for letter, (name, what) in _QUANTITIES.items():
            count = key.needs.count(letter)
            if not count:
                continue
            values = np.abs(self.inputs[name][rows])
            if letter == "c":
                n = _several(values, CAMBER, relative=False) - int(bool((values <= CAMBER).any()))
                if n < count:
                    return f"no {'two sizes of ' if count > 1 else ''}camber in the data"
            elif _several(values, APART, relative=True) < count + 1:
                return f"fewer than {('two', 'three')[count - 1]} {what} in the data"
        return ""

    def result(self) -> Fit:
        found = Channels(Tyre(self.values, self.tir.fittyp == 6), {k: np.array(v) for k, v in self.inputs.items()},
                         nominal_pressure(self.tir), self.book)
        residuals = {}
        for name, measured in self.measured.items():
            there = np.isfinite(measured)
            apart = (np.broadcast_to(getattr(found, name), measured.shape) - measured)[there]
            size = float(np.sqrt(np.mean(measured[there] ** 2)))
            rms = float(np.sqrt(np.mean(apart ** 2)))
            residuals[name] = Residual(rms, float(np.abs(apart).max()), rms / size if size else np.inf,
                                       int(there.sum()))
        fitted = tuple(key.name for key in self.fitted)
        edge = tuple(key.name for key in self.fitted if self._at_bound(key))
        changed = {name: float(self.values[name]) for name in (*fitted, *self.left)}
        return Fit(self.tir.with_values(changed), residuals, fitted, dict(self.left), edge)

    def _at_bound(self, key: Key) -> bool:
        slack = 1e-5 * (key.high - key.low)
        return not key.low + slack < self.values[key.name] < key.high - slack and self.values[key.name] != 0


_QUANTITIES = {"z": ("load", "loads"), "p": ("pressure", "pressures"), "v": ("speed", "speeds"),
               "c": ("camber", "cambers")}


def _several(values: Array, apart: float, relative: bool) -> int:
    """How many values there are that differ by more than `apart`."""
    if not values.size:
        return 0
    ordered = np.sort(values)
    step = apart * max(float(ordered[-1]), 1e-300) if relative else apart
    count, last = 1, float(ordered[0])
    for value in np.unique(ordered):
        if value - last > step:
            count, last = count + 1, float(value)
    return count


def _sizes(keys: list[Key]) -> Array:
    """Typical size of each coefficient."""
    return np.array([abs(key.start) if key.start else 0.01 * (key.high - key.low) for key in keys])


def _weakest(jacobian: Array, keys: list[Key]) -> Key | None:
    """The coefficient that the data hold least, where they do not hold all."""
    scaled = jacobian * _sizes(keys)
    size = np.linalg.norm(scaled, axis=0)
    if size.min() <= WEAK * size.max():
        return keys[int(size.argmin())]
    _, singular, directions = np.linalg.svd(scaled / size, full_matrices=False)
    if singular[-1] > WEAK * singular[0]:
        return None
    return keys[int(np.abs(directions[-1]).argmax())]


def _asked(stage: Stage) -> str:
    other = "slip angle" if stage.channel == "Fx" else "slip ratio"
    return {"pure": f"without {other} and camber", "cambered": f"without {other}", "all": "of any slip"}[stage.rows]


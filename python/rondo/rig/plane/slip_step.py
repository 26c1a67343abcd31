# SPDX-License-Identifier: BSD-3-Clause
"""Relaxation of a plane wheel: the longitudinal force after a step of the slip ratio, in a run in time.

Contacts at nodes make the force go up and down with each sector that passes, by more than a small step of the slip
changes it. A whole number of time steps in the pass of a sector makes each pass the same, and the mean over a pass has
none of it. With other time steps, the instants of contact shift from pass to pass, and the mean goes up and down."""
from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ...data.errors import Error
from ..checks.step_size import demand_small, friction_of

if TYPE_CHECKING:
    from ...data.run import Run

Array = NDArray[np.float64]

REACHED = 1.0 - math.exp(-1.0)
BEFORE = 0.5    # of the distance after the step: rolled ahead of it, until the start has died away
ROWS = 20       # of the history in the pass of a sector, at least
FINER = 4       # than the stable step: instants of contact are those of steps, and what they are late makes the mean go up and down
JUMP = 0.1      # of the pass of a sector: how long the speed takes for its step
LAST = 0.1      # of the distance: its force counts as that after the step
UNSETTLED = 0.02  # of the change: how much the force may still change from the last tenth but one to the last
LENGTHS = 41    # that a fit tries at once
APART = 2.0     # times: the most that the length at 63.2 % and that of the exponential may differ; vibrations alone make 1.7


@dataclass(frozen=True)
class SlipStep:
    """distance: (rows,) m rolled after the step; force: (rows,) as in the history, means over the pass of a sector."""

    distance: Array
    force: Array
    before: float
    after: float

    @property
    def share(self) -> Array:
        """Of the change, that is reached."""
        return (self.force - self.before) / (self.after - self.before)

    @property
    def length(self) -> float:
        """m: where 63.2 % of the change is reached."""
        first = int(np.argmax(self.share >= REACHED))
        rows = slice(max(first - 1, 0), first + 1)
        return float(np.interp(REACHED, self.share[rows], self.distance[rows]))

    @property
    def fitted(self) -> float:
        """m: of the exponential that fits all rows."""
        low, high = 0.1 * self.distance[1], 10.0 * self.distance[-1]
        for _ in range(6):
            lengths = np.geomspace(low, high, LENGTHS)
            apart = [np.mean((self.share + np.expm1(-self.distance / one)) ** 2) for one in lengths]
            best = int(np.argmin(apart))
            low, high = lengths[max(best - 1, 0)], lengths[min(best + 1, LENGTHS - 1)]
        return float(lengths[best])


def times_of(distance: float, speed: float, pass_s: float) -> tuple[float, float]:
    """s: of the step, and of the end of the run, which is half a pass after the last mean."""
    begin = BEFORE * distance / speed + pass_s
    return begin, begin + (1.0 + JUMP) * pass_s + distance / speed


def steps_of(pass_s: float, stable_s: float) -> tuple[float, float]:
    """s: the time step, a whole number of which is the pass of a sector, and the interval of the history."""
    least = FINER * pass_s / stable_s
    together = max(1, math.floor(least / ROWS))  # steps between two rows
    rows = max(ROWS, math.ceil(least / together))
    return pass_s / (rows * together), pass_s / rows


def slip_step_of(run: Run) -> SlipStep:
    """@raise Error: the force has not settled after the step, the step is too large for the friction, or the course of the force is
    no exponential."""
    motion = run.case["motion"]
    (_, _), (begin, speed_before), (_, speed) = motion["speed"]
    pass_s = 2.0 * math.pi / abs(float(motion["angular_velocity"])) / sectors_of(run.case)
    time, mean = _means(np.asarray(run.history["time_s"]), np.asarray(run.history["force_x"]), pass_s)
    ahead = (time < begin - 0.5 * pass_s) & (time > 0.5 * begin)
    rolled = time >= begin
    distance, force = abs(float(speed)) * (time[rolled] - begin), mean[rolled]
    if not ahead.any() or len(distance) < ROWS:
        raise Error("the run is too short for a step of the slip (relaxation.distance)")
    share = distance / distance[-1]
    last, before_last = force[share > 1.0 - LAST].mean(), force[(share > 1.0 - 2.0 * LAST) & (share <= 1.0 - LAST)].mean()
    before = float(mean[ahead].mean())
    if not abs(last - before_last) <= UNSETTLED * abs(last - before):
        raise Error("force_x has not settled after the step: roll farther (relaxation.distance)")
    slip_speed = abs(float(speed_before) - float(speed))
    carried = friction_of(run.case, slip_speed) * abs(float(np.mean(run.history["force_y"])))
    demand_small(abs(float(last) - before), carried, f"slip ratio, {slip_speed / abs(float(speed)):.3g}", "force_x", "slip_ratio_step")
    step = SlipStep(distance, force, before, float(last))
    _demand_exponential(step)
    return step


def _demand_exponential(step: SlipStep) -> None:
    lengths = step.length, step.fitted
    if not max(lengths) <= APART * min(lengths):
        raise Error(f"force_x does not follow the step exponentially: 63.2 % of its change are reached after {step.length:.3g} m, and the "
                    f"length of the exponential is {step.fitted:.3g} m: change the damping of the vibrations or the step "
                    "(relaxation.mass_damping, relaxation.slip_ratio_step)")


def sectors_of(case: Mapping[str, Any]) -> int:
    """Columns of elements around a disk, or pitches of its tread."""
    disk = case["disk"]
    return int(disk["tread"]["pitches"] if "tread" in disk else disk["mesh"]["circumferential"])


def _means(time: Array, force: Array, width: float) -> tuple[Array, Array]:
    """Over a time `width` around each row that has as much on both sides."""
    sums = np.concatenate([[0.0], np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(time))])
    inside = time[(time >= time[0] + 0.5 * width) & (time <= time[-1] - 0.5 * width)]
    return inside, (np.interp(inside + 0.5 * width, time, sums) - np.interp(inside - 0.5 * width, time, sums)) / width

# SPDX-License-Identifier: BSD-3-Clause
"""Power spectral density of a column of a run's history, by Welch's method: P. D. Welch, IEEE Trans.
Audio Electroacoust. 15 (1967) 70."""
from __future__ import annotations

import math
import pathlib
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes

from .. import style
from ..data.errors import Error, unknown
from ..data.files import write_table
from .curves import MIN_ROWS, NO_COURSE, even_rows, mark_passing
from .labels import axes_of, column_label

if TYPE_CHECKING:
    from ..data.run import Run

SEGMENTS = 8  # that overlap by half, where no length of theirs is given


@dataclass(frozen=True)
class Psd:
    """One-sided: the integral over the frequency is the mean square about the mean."""

    column: str
    frequency: np.ndarray  # (f,) [Hz]
    density: np.ndarray    # (f,) in `unit`
    unit: str              # e.g. "(N/m)²/Hz"
    segments: int          # whose mean it is
    segment: float         # length of each [s]
    step: float            # of the rows [s]

    @property
    def root_mean_square(self) -> float:
        """About the mean of each segment, in the unit of the column."""
        return float(np.sqrt(self.density.sum() * self.frequency[1]))


def power_spectral_density(run: Run, column: str = "force_y", from_time: float | None = None,
                           to_time: float | None = None, segment: float | None = None) -> Psd:
    """Of the rows between two times [s]: the mean of the periodograms of segments that overlap by
    half, each less its mean and under a Hann window. `segment`: their length [s], by default such
    that there are eight; the longer, the finer the frequencies and the rougher the density. Rows
    are as even_rows() has them: means over their intervals, so that at a frequency f the density
    is that of the column times (sin(πfΔ)/(πfΔ))², 0.41 at the highest."""
    step, signal = even_rows(run, column, from_time, to_time)
    rows = len(signal)
    if segment is None:
        length = max(2 * rows // (SEGMENTS + 1), min(MIN_ROWS, rows))
    else:
        if not math.isfinite(segment):
            raise Error(f"segments of {segment:g} s: a finite time is needed")
        length = round(segment / step)
    if not MIN_ROWS <= length <= rows:
        raise Error(f"{run.history.path}: segments of {length * step:g} s have {length} rows: "
                    f"{MIN_ROWS} to {rows} are possible here, {MIN_ROWS * step:g} to "
                    f"{rows * step:g} s")
    window = 0.5 - 0.5 * np.cos(2 * np.pi * np.arange(length) / length)
    starts = range(0, rows - length + 1, max(length - length // 2, 1))
    power = np.zeros(length // 2 + 1)
    for begin in starts:
        part = signal[begin:begin + length]
        power += np.abs(np.fft.rfft((part - part.mean()) * window)) ** 2
    density = power * step / ((window ** 2).sum() * len(starts))
    density[1: (length + 1) // 2] *= 2  # the other half of the spectrum; not of 0 nor of Nyquist's
    unit = run.history.unit_of(column)
    return Psd(column, np.fft.rfftfreq(length, step), density,
               "1/Hz" if unit == "1" else f"({unit})²/Hz", len(starts), length * step, step)


@style.paper()
def plot_psd(run: Run, column: str = "force_y", from_time: float | None = None,
             to_time: float | None = None, segment: float | None = None,
             ax: Axes | None = None) -> Axes:
    """Power spectral density of a column (see power_spectral_density) over frequency, with the
    marks of plot_force_spectrum()."""
    return draw_psd(run, checked_psd(run, column, from_time, to_time, segment), ax)


def checked_psd(run: Run, column: str, from_time: float | None, to_time: float | None,
                segment: float | None) -> Psd:
    """As power_spectral_density(), of a column that is there and says something."""
    run.history.need_time(NO_COURSE)
    if column not in run.history:
        raise unknown(run.history.path, "column", column, run.history)
    run.history.need_ground(column)
    return power_spectral_density(run, column, from_time, to_time, segment)


@style.paper()
def draw_psd(run: Run, psd: Psd, ax: Axes | None = None) -> Axes:
    ax = axes_of(ax, 2.4)
    mark_passing(ax, run, psd.frequency[-1])
    line: dict[str, Any] = {**style.CURVES[0], "linewidth": 0.8}
    ax.plot(psd.frequency[1:], psd.density[1:], **line)
    if psd.density[1:].max() > 0:
        ax.set_yscale("log")
    ax.set_xlim(0, psd.frequency[-1])
    ax.set_xlabel("frequency (Hz)")
    ax.set_ylabel(f"density of the\n{column_label(psd.column)} ({psd.unit})")
    return ax


def write_psd(psd: Psd, path: pathlib.Path) -> pathlib.Path:
    """A CSV file: frequency_hz, and the density in psd.unit under the column's name."""
    return write_table(path, {"frequency_hz": psd.frequency, f"{psd.column}_psd": psd.density})


def psd_in_words(psd: Psd) -> str:
    return (f"{psd.column}: {psd.segments} segment{'s' if psd.segments > 1 else ''} of "
            f"{psd.segment:.6g} s, rows of {psd.step:.6g} s: {psd.frequency[1]:.6g} to "
            f"{psd.frequency[-1]:.6g} Hz, density in {psd.unit}; root mean square "
            f"{psd.root_mean_square:.6g}")

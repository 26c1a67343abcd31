# SPDX-License-Identifier: BSD-3-Clause
"""Power spectral densities: a sine of known amplitude, Parseval's theorem, scipy, the command."""
import csv

import numpy as np
import pytest
import rondo
from test_cli import rondo_module
from rondo.plots.psd import power_spectral_density
from test_curves import with_history

STEP = 1e-3


def noise(copy, rows):
    times = STEP * np.arange(1, rows + 1)
    return with_history(copy, times, force_y=1e4 + np.random.default_rng(3).normal(0.0, 7.0, rows))


def test_a_sine_of_known_amplitude(copy):
    """Whole periods in each segment: the mean square is half the amplitude squared, and Hann's
    window spreads it over 1.5 lines."""
    times = STEP * np.arange(1, 1001)
    run = with_history(copy, times, force_y=500.0 + 3.0 * np.sin(2 * np.pi * 50.0 * times))
    psd = power_spectral_density(run, segment=0.2)
    assert (psd.segments, psd.unit) == (9, "(N/m)²/Hz")
    line = int(psd.density.argmax())
    assert psd.frequency[line] == pytest.approx(50.0)
    assert psd.density[line] == pytest.approx(0.5 * 3.0**2 / 1.5 / psd.frequency[1], rel=1e-9)
    assert psd.root_mean_square == pytest.approx(3.0 / np.sqrt(2.0), rel=1e-9)


@pytest.mark.parametrize("rows", [512, 511])
def test_parseval(copy, rows):
    """One segment: the integral is the mean square under the window."""
    run = noise(copy, rows)
    psd = power_spectral_density(run, segment=rows * STEP)
    signal = run.history["force_y"] - run.history["force_y"].mean()
    window = 0.5 - 0.5 * np.cos(2 * np.pi * np.arange(rows) / rows)
    assert psd.segments == 1
    assert psd.root_mean_square**2 == pytest.approx(
        ((signal * window)**2).sum() / (window**2).sum(), rel=1e-9)


@pytest.mark.parametrize("segment", [None, 0.128, 0.099])
def test_as_of_scipy(copy, segment):
    signal = pytest.importorskip("scipy.signal")
    run = noise(copy, 1000)
    psd = power_spectral_density(run, segment=segment)
    frequency, density = signal.welch(run.history["force_y"], 1 / STEP,
                                      nperseg=round(psd.segment / STEP))
    assert psd.segments == {None: 8, 0.128: 14, 0.099: 19}[segment]
    np.testing.assert_allclose(psd.frequency, frequency, rtol=1e-9)
    np.testing.assert_allclose(psd.density, density, rtol=1e-6, atol=1e-9 * density.max())


def test_refusals(copy, crush):
    run = noise(copy, 100)
    with pytest.raises(rondo.Error, match="segments of 0.5 s have 500 rows: 16 to 100 are"):
        power_spectral_density(run, segment=0.5)
    with pytest.raises(rondo.Error, match="a crush has no course in time"):
        power_spectral_density(rondo.open(crush))
    with pytest.raises(rondo.UnknownNameError, match="no column 'force_z'"):
        run.plot_psd("force_z")


def test_the_command(treaded, tmp_path):
    done = rondo_module("psd", treaded, "--column", "force_x", "--from", 0.005, "-o", tmp_path)
    assert done.returncode == 0, done.stderr
    assert "segments of" in done.stdout and "density in (N/m)²/Hz" in done.stdout
    assert {path.name for path in tmp_path.iterdir()} == {f"psd-force_x.{end}"
                                                          for end in ("csv", "png", "svg")}
    with open(tmp_path / "psd-force_x.csv", newline="") as file:
        header, *rows = csv.reader(file)
    assert header == ["frequency_hz", "force_x_psd"]
    psd = power_spectral_density(rondo.open(treaded), "force_x", from_time=0.005)
    np.testing.assert_array_equal(np.array(rows, dtype=float).T, [psd.frequency, psd.density])
    wrong = rondo_module("psd", treaded, "--column", "force_z", "-o", tmp_path)
    assert wrong.returncode == 2 and "no column 'force_z'" in wrong.stderr

# SPDX-License-Identifier: BSD-3-Clause
"""Curves of the history, and the spectrum of a signal that is known."""
import json

import matplotlib.pyplot as plt
import numpy as np
import pytest

import rondo
from rondo.plots import curves

AMPLITUDE, FREQUENCY, MEAN = 3.0, 250.0, 1000.0  # N/m, Hz, N/m


@pytest.fixture(autouse=True)
def closed_figures():
    yield
    plt.close("all")


def with_history(directory, times, **columns):
    """The run, with a history of other columns at other times [s], the last of which is its end."""
    rows = np.column_stack([times, *columns.values()])
    np.savetxt(directory / "history.csv", rows, fmt="%.17g", delimiter=",", comments="",
               header=",".join(["time_s", *columns]))
    info = json.loads((directory / "run.json").read_text()) | {"end_time": times[-1]}
    (directory / "run.json").write_text(json.dumps(info))
    return rondo.open(directory)


def sine(directory, intervals):
    """A run whose force_y is a sine about a mean."""
    times = np.cumsum(intervals)
    middle = times - 0.5 * np.asarray(intervals)
    return with_history(directory, times, force_x=np.zeros(len(times)), force_y=MEAN + AMPLITUDE
                        * np.cos(2 * np.pi * FREQUENCY * middle + 0.3))


def test_spectrum_of_a_sine(copy):
    """40 periods in the window: all of it in one line, and in its neighbours half (Hann)."""
    frequency, amplitude = curves.force_spectrum(sine(copy, np.full(1600, 1e-4)))
    line = int(np.argmax(amplitude))
    assert frequency[line] == pytest.approx(FREQUENCY, rel=1e-9)
    assert amplitude[line] == pytest.approx(AMPLITUDE, rel=1e-9)
    np.testing.assert_allclose(amplitude[[line - 1, line + 1]], AMPLITUDE / 2, rtol=1e-9)
    rest = np.delete(amplitude, [line - 1, line, line + 1])
    assert rest.max() < 1e-9 * MEAN
    assert frequency[-1] == pytest.approx(5000.0)
    assert frequency[1] == pytest.approx(1 / 0.16)


def test_spectrum_between_two_lines(copy):
    frequency, amplitude = curves.force_spectrum(sine(copy, np.full(1620, 1e-4)))  # 40.5 periods
    near = np.argsort(amplitude)[-2:]
    np.testing.assert_allclose(amplitude[near], 0.849 * AMPLITUDE, rtol=2e-3)  # 8 / (3 pi)
    assert abs(frequency[near].mean() - FREQUENCY) < 0.01


def test_spectrum_at_the_ends(copy):
    times = 1e-3 * np.arange(1, 65)
    run = with_history(copy, times, force_x=np.full(64, 5.0), force_y=2.0 * (-1.0) ** np.arange(64))
    assert curves.force_spectrum(run)[1][-1] == pytest.approx(2.0)  # Nyquist's line
    assert curves.force_spectrum(run, "force_x")[1].max() < 1e-12  # the mean is removed


def test_spectrum_of_uneven_intervals(copy):
    """Twice as long in the second half: taken for even, the sine would have two frequencies."""
    run = sine(copy, np.repeat([1e-4, 2e-4], 800))
    frequency, amplitude = curves.force_spectrum(run)
    line = int(np.argmax(amplitude))
    assert frequency[line] == pytest.approx(FREQUENCY, rel=2e-3)
    assert amplitude[line] == pytest.approx(AMPLITUDE, rel=1e-2)
    assert np.delete(amplitude, np.arange(line - 2, line + 3)).max() < 0.03 * AMPLITUDE


def test_rows_are_values_at_the_middle_of_their_intervals(copy):
    """A ramp then stays one, whatever the intervals."""
    intervals = np.random.default_rng(5).uniform(1e-4, 3e-4, 64)
    middle = np.cumsum(intervals) - 0.5 * intervals
    run = with_history(copy, np.cumsum(intervals), force_y=1e5 * middle)
    ramp = np.linspace(1e5 * middle[0], 1e5 * middle[-1], 64)
    window = 0.5 * (1 - np.cos(2 * np.pi * np.arange(64) / 64))
    expected = 2 * np.abs(np.fft.rfft((ramp - ramp.mean()) * window))[1:-1] / window.sum()
    got = curves.force_spectrum(run)[1][1:-1]
    np.testing.assert_allclose(got, expected, rtol=0, atol=1e-9 * expected.max())


def test_spectrum_of_a_window(copy):
    times = 1e-3 * np.arange(1, 201)
    force = np.where(times <= 0.1, 50.0, 1.0) * np.sin(2 * np.pi * 100.0 * (times - 0.5e-3))
    run = with_history(copy, times, force_y=force)
    assert curves.force_spectrum(run, from_time=0.1)[1].max() == pytest.approx(1.0, rel=1e-3)
    assert curves.force_spectrum(run, to_time=0.1)[1].max() == pytest.approx(50.0, rel=1e-3)


def test_no_spectrum(smooth, crush):
    with pytest.raises(rondo.Error, match="10 rows of the history from .*; a spectrum takes at "
                                          "least 16: widen the window or lower output.history_"):
        times = rondo.open(smooth).history["time_s"]
        curves.force_spectrum(rondo.open(smooth), from_time=times[-11])
    with pytest.raises(rondo.Error, match="a crush has no course in time"):
        curves.force_spectrum(rondo.open(crush))
    with pytest.raises(rondo.UnknownNameError, match="no column 'force_z'"):
        rondo.open(smooth).plot_spectrum("force_z")


def test_plot_spectrum(treaded, smooth):
    run = rondo.open(treaded)
    ax = run.plot_spectrum(from_time=0.005)
    frequency, amplitude = curves.force_spectrum(run, from_time=0.005)
    line, = ax.lines
    np.testing.assert_array_equal(line.get_xdata(), frequency[1:])
    np.testing.assert_array_equal(line.get_ydata(), amplitude[1:])
    assert ax.get_xlabel() == "frequency (Hz)" and "(N/m)" in ax.get_ylabel()
    assert run.mesh_frequency == pytest.approx(36 * 33.333333 / (2 * np.pi))  # 12 pitches of 3
    tread, mesh = ax.collections
    for marks, passing, name in ((tread, run.pitch_frequency, "tread (pitches × spin)"),
                                 (mesh, run.mesh_frequency, "mesh (columns × spin)")):
        places = [path[0, 0] for path in marks.get_segments()]
        np.testing.assert_allclose(places, passing * np.arange(1, len(places) + 1))
        assert len(places) == int(frequency[-1] / passing)
        assert marks.get_label().startswith(f"{name}: {passing:.0f} Hz")
    assert len(ax.get_legend().get_texts()) == 2


def test_the_ripple_of_a_smooth_disk_is_of_the_mesh(smooth, crush):
    run = rondo.open(smooth)
    assert run.mesh_frequency == pytest.approx(40 * 33.333333 / (2 * np.pi))
    ax = run.plot_spectrum()
    marks, = ax.collections
    assert marks.get_segments()[0][0, 0] == pytest.approx(run.mesh_frequency)
    text, = ax.get_legend().get_texts()
    assert text.get_text().startswith("mesh (columns × spin): 212 Hz")
    assert rondo.open(crush).mesh_frequency is None  # nothing turns


def test_plot_history(smooth, crush):
    run = rondo.open(smooth)
    ax = run.plot_history()
    vertical, horizontal = ax.lines
    np.testing.assert_allclose(vertical.get_ydata(), run.history["force_y"] / 1e3)
    np.testing.assert_allclose(horizontal.get_ydata(), run.history["force_x"] / 1e3)
    np.testing.assert_allclose(vertical.get_xdata(), run.history["time_s"] * 1e3)
    assert ax.get_xlabel() == "time (ms)" and "(kN/m)" in ax.get_ylabel()
    figure, ax = plt.subplots()
    assert run.plot_history("penetration_max_m", ax=ax) is ax
    assert ax.get_ylabel() == "largest penetration (mm)" and ax.get_legend() is None
    assert run.plot_history("slip_ratio").get_ylabel() == "slip ratio (–)"
    ax = run.plot_history("contact_nodes", "sticking_nodes")
    assert ax.get_ylabel() == "nodes (–)"
    assert run.plot_history("contact_nodes").get_ylabel() == "nodes in contact (–)"
    ax = rondo.open(crush).plot_history()
    np.testing.assert_allclose(ax.lines[0].get_xdata()[-1], 20.0)
    assert ax.get_xlabel() == "depth (mm)"


@pytest.mark.parametrize("level", [0.29, -4e5, 0.0])
def test_what_is_constant_is_a_level_line(copy, level):
    """Not its round-off, magnified, with an offset at the axis."""
    times = 1e-3 * np.arange(1, 21)
    run = with_history(copy, times, force_y=level * (1 + 1e-9 * (-1.0) ** np.arange(20)))
    ax = run.plot_history("force_y")
    ax.figure.canvas.draw()
    low, high = ax.get_ylim()
    values = ax.lines[0].get_ydata()
    assert high - low > 1e5 * np.ptp(values) and low < values.min() and values.max() < high
    assert ax.yaxis.get_offset_text().get_text() == ""


def test_a_ratio_of_round_off_is_a_level_line(copy):
    """Not one of some 1e-8 at the axis."""
    times = 1e-3 * np.arange(1, 21)
    run = with_history(copy, times, slip_ratio=np.where(times < 2e-3, 0.0, -1e-8))
    ax = run.plot_history("slip_ratio")
    ax.figure.canvas.draw()
    low, high = ax.get_ylim()
    assert high - low >= 0.02 and low < 0 < high
    assert ax.yaxis.get_offset_text().get_text() == ""


def test_forces_without_ground(air):
    run = rondo.open(air)
    for function in (run.plot_spectrum, lambda: run.plot_history("force_y"),
                     lambda: run.plot_spectrum("torque"), lambda: run.history.mean("force_y")):
        with pytest.raises(rondo.Error, match="no ground: the case has no .ground., so "):
            function()
    assert [line.get_label() for line in run.plot_history().lines] == ["kinetic energy",
                                                                       "strain energy"]
    assert run.plot_history("kinetic").lines and run.plot_spectrum("kinetic").lines
    assert run.history.mean("kinetic") > 0


def test_columns_that_do_not_go_together(smooth):
    with pytest.raises(rondo.Error, match=r"force_y, strain: of different units \(J/m, N/m\)"):
        rondo.open(smooth).plot_history("force_y", "strain")
    with pytest.raises(rondo.Error, match="7 columns: at most 6"):
        rondo.open(smooth).plot_history(*["force_x"] * 7)
    with pytest.raises(rondo.UnknownNameError, match="no column 'x'"):
        rondo.open(smooth).plot_history("x")


def test_the_curves_of_the_ledger_sum_up_to_the_energy(treaded, air):
    for directory, terms in ((treaded, 6), (air, 3)):
        ax = rondo.open(directory).plot_energy()
        curve = {line.get_label(): np.array(line.get_ydata()) for line in ax.lines
                 if not line.get_label().startswith("_")}
        total = curve.pop("energy: kinetic and strain")
        assert set(curve) <= {label for _, label, _ in curves.TERMS.values()}
        assert len(curve) == terms
        rest = total - sum(curve.values())  # the energy at the start
        np.testing.assert_allclose(rest, rest[0], rtol=0, atol=1e-13 * total.max())
        assert 0 <= rest[0] < 1e-3 * total.max()


def test_what_is_zero_all_along_is_left_out(copy):
    run = rondo.open(copy)
    count = len(run.plot_energy().get_legend().get_texts())
    columns = {name: run.history[name] for name in run.history if name != "time_s"}
    assert columns["dissipation_friction"].any()
    columns["dissipation_friction"] = 1e-18 * np.ones(len(run.history["time_s"]))
    changed = with_history(copy, run.history["time_s"], **columns)
    names = [text.get_text() for text in changed.plot_energy().get_legend().get_texts()]
    assert "friction" not in names and len(names) == count - 1


def test_the_residual_of_the_ledger(smooth):
    run = rondo.open(smooth)
    ax = run.plot_energy()
    below = [other for other in ax.figure.axes if other is not ax][0]
    assert below.get_ylabel().endswith("(–)")
    assert below.get_yscale() == "log" and "time (ms)" == below.get_xlabel()
    drawn = below.lines[0].get_ydata()
    assert np.nanmax(drawn) == pytest.approx(run.info["energy_residual_relative"], rel=0.5)
    assert below.get_ylim()[1] > np.nanmax(drawn)
    assert "(kJ/m)" in ax.get_ylabel() or "(J/m)" in ax.get_ylabel()


def test_the_ledger_in_given_axes(smooth):
    figure, axes = plt.subplots(1, 2)
    assert rondo.open(smooth).plot_energy(ax=axes[1]) is axes[1]
    assert len(figure.axes) == 3
    with pytest.raises(rondo.Error, match="divides its axes"):
        rondo.open(smooth).plot_energy(ax=figure.add_axes((0, 0, 1, 1)))

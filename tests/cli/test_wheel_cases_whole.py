# SPDX-License-Identifier: BSD-3-Clause
"""The ready cases of a rim that forces move, in full: the figures that their comments say to expect,
within one of the last digit given there."""
import unittest
from typing import Callable, NamedTuple

import numpy as np

from program import ROOT, ProgramTest, history, run, summary
from test_wheel_cases import CASES, LEDGER

LANDED = 0.05  # s: the load is on, the height of a held hub reached
FLAT = 0.07    # s: the swing of the start is small against what obstacles do, which come later
BUMP = 0.1     # s: as FLAT, where the bump does less; the wheel comes to it at 0.13 s


class Figure(NamedTuple):
    column: str
    of: Callable  # its rows in the window
    expected: float
    digit: float  # the last one given
    begin: float = 0.0  # s, of the window
    end: float = np.inf


def last(values):
    return values[-1]


def extremes(column, least, most, digit, begin, end=np.inf):
    return [Figure(column, np.min, least, digit, begin, end),
            Figure(column, np.max, most, digit, begin, end)]


EXPECTED = {
    "wheel-settle": [
        Figure("center_y_m", np.min, 0.3 - 7.40e-3, 1e-5),
        Figure("center_y_m", last, 0.29382, 1e-5),
        Figure("force_y", last, 1e5, 1e-4)],
    "wheel3d-load": [
        Figure("force_y", np.mean, 8326.0, 2.0, 0.4),
        Figure("center_y_m", np.mean, 0.29469, 1e-5, 0.4),
        Figure("spin_rad_s", np.mean, 33.634, 1e-3, 0.4),
        Figure("torque", np.mean, 0.0, 0.1, 0.4),
        Figure("force_lateral", np.mean, -2425.0, 1.0, 0.4),
        Figure("moment_aligning", np.mean, -35.4, 0.1, 0.4)],
    "wheel3d-cobbles": [
        Figure("force_y", np.mean, 1799.9, 1.0, 0.1),
        *extremes("force_y", 742.0, 3407.0, 5.0, 0.1),
        *extremes("force_lateral", -655.0, 776.0, 5.0, 0.1),
        *extremes("center_y_m", 0.30152, 0.30705, 1e-5, 0.1),
        *extremes("spin_rad_s", 6.503, 6.898, 1e-3, 0.1)],
    "wheel-rolling": [
        Figure("center_y_m", np.mean, 0.29166, 1e-5, 0.2),
        Figure("spin_rad_s", np.mean, 33.753, 1e-3, 0.2),
        Figure("force_x", np.mean, -237.0, 1.0, 0.2),
        Figure("hub_force_x", np.mean, 237.0, 1.0, 0.2)],
    "wheel-driven": [
        Figure("spin_rad_s", np.mean, 34.438, 1e-3, 0.2),
        Figure("force_x", np.mean, 33652.0, 1.0, 0.2),
        Figure("hub_force_x", np.mean, -33652.0, 1.0, 0.2)],
    "wheel-braked": [
        Figure("spin_rad_s", np.mean, 33.007, 1e-3, 0.2),
        Figure("force_x", np.mean, -34226.0, 1.0, 0.2)],
    "wheel-lock": [
        Figure("standing_s", last, 0.6 - 0.5426, 1e-4),
        Figure("spin_rad_s", last, 0.0, 0.0),
        Figure("traction", last, -0.6, 1e-3),
        Figure("dissipation_brake", last, 203e3, 1e3),
        Figure("dissipation_friction", last, 104e3, 1e3)],
    "wheel-abs": [
        Figure("spin_rad_s", np.min, 0.0, 0.0, 0.12, 0.2),
        Figure("spin_rad_s", np.max, 36.0, 1.0, 0.2, 0.25),
        Figure("spin_rad_s", np.min, 5.0, 1.0, 0.25, 0.44),
        Figure("force_x", np.mean, -81.5e3, 100.0, 0.12, 0.44)],
    "wheel-mu-jump": [
        Figure("force_x", np.mean, -55.3e3, 100.0, 0.1, 0.14),
        Figure("spin_rad_s", np.mean, 32.06, 1e-2, 0.1, 0.14),
        Figure("force_x", np.mean, -14.4e3, 100.0, 0.18, 0.2),
        Figure("spin_rad_s", np.max, 0.0, 0.0, 0.1898, 0.2092),
        Figure("spin_rad_s", np.mean, 32.11, 1e-2, 0.36),
        Figure("force_x", np.mean, -54.6e3, 100.0, 0.36)],
    "wheel3d-mu-split": [
        Figure("force_x", np.mean, -2038.0, 1.0, 0.1, 0.14),
        Figure("moment_aligning", np.max, 0.0, 1e-9, 0.1, 0.14),
        Figure("force_x", np.mean, -2043.0, 1.0, 0.22),
        Figure("moment_aligning", np.mean, -29.7, 0.1, 0.22),
        Figure("force_lateral", np.mean, -82.0, 1.0, 0.22)],
    "wheel-incline": [
        Figure("acceleration", last, 0.62463, 1e-5)],
    "wheel-drop": [
        Figure("impulse_x", last, -351.8, 0.1),
        Figure("impulse_y", last, 703.6, 0.1),
        Figure("first_contact_s", last, 0.1010, 1e-4),
        Figure("last_contact_s", last, 0.1161, 1e-4),
        Figure("speed_x", np.mean, 0.945, 1e-3, 0.15),
        Figure("spin_rad_s", np.mean, -12.65, 1e-2, 0.15),
        Figure("center_y_m", np.max, 0.348, 1e-3, 0.15)],
    "wheel-landing": [
        Figure("force_x", np.min, -57e3, 1e3),
        Figure("spin_rad_s", np.max, 69.1, 0.1),
        Figure("spin_rad_s", np.mean, 67.47, 1e-2, 0.1),
        Figure("dissipation_friction", last, 32.6e3, 100.0)],
    "cleat-load": [
        *extremes("force_y", 104e3, 210e3, 1e3, FLAT),
        *extremes("force_x", -23e3, 17e3, 1e3, FLAT),
        *extremes("spin_rad_s", 16.42, 17.71, 1e-2, FLAT),
        Figure("center_y_m", np.max, 0.30039, 1e-5, FLAT)],
    "cleat-height": [
        Figure("force_y", np.mean, 148e3, 1e3, LANDED, FLAT),
        Figure("force_y", np.max, 285e3, 1e3, LANDED),
        *extremes("spin_rad_s", 15.92, 17.99, 1e-2, LANDED)],
    "cleat-load-treaded": [
        *extremes("force_y", 108e3, 213e3, 1e3, FLAT),
        *extremes("spin_rad_s", 16.52, 17.54, 1e-2, FLAT),
        Figure("center_y_m", np.max, 0.29873, 1e-5, FLAT)],
    "cleat-height-treaded": [
        Figure("force_y", np.mean, 133e3, 1e3, LANDED, FLAT),
        Figure("force_y", np.max, 254e3, 1e3, LANDED),
        *extremes("spin_rad_s", 16.03, 18.09, 1e-2, LANDED)],
    "pothole-load": [
        *extremes("force_y", 77e3, 255e3, 1e3, FLAT),
        *extremes("force_x", -54e3, 37e3, 1e3, FLAT),
        *extremes("spin_rad_s", 14.13, 20.37, 1e-2, FLAT),
        Figure("center_y_m", np.min, 0.2771, 1e-4, FLAT)],
    "rolling-cobbles": [
        Figure("force_y", np.mean, 80.84e3, 20.0, 0.1),
        *extremes("force_y", 60.1e3, 98.3e3, 100.0, 0.1),
        *extremes("center_y_m", 0.29236, 0.30356, 1e-5, 0.1),
        *extremes("spin_rad_s", 9.514, 10.917, 1e-3, 0.1)],
    "sine-road-load": [
        *extremes("center_y_m", 0.2889, 0.2967, 1e-4, 0.2, 0.28),
        *extremes("force_y", 71e3, 241e3, 1e3, 0.2, 0.28),
        *extremes("spin_rad_s", 33.36, 34.19, 1e-2, 0.2, 0.28)],
    "quarter-car": [
        *extremes("force_y", 107e3, 193e3, 1e3, FLAT),
        *extremes("on_the_body", -14.2e3, 15.1e3, 100.0, FLAT),
        Figure("center_y_m", np.max, 0.30028, 1e-5, FLAT)],
    "quarter-car-bump": [
        *extremes("force_y", 145.9e3, 169.3e3, 100.0, BUMP),
        Figure("center_y_m", np.max, 0.31026, 1e-5, BUMP)],
    "rubber-tyre": [
        Figure("force_y", np.mean, 20.1e3, 100.0, 0.06),
        *extremes("center_y_m", 0.28903, 0.28949, 1e-5, 0.06)],
    "tyre-load": [
        Figure("force_y", np.mean, 4027.0, 1.0, 0.09),
        Figure("force_lateral", np.mean, -1322.0, 1.0, 0.09),
        Figure("moment_aligning", np.mean, -19.8, 0.1, 0.09),
        Figure("center_y_m", np.mean, 0.30004, 1e-5, 0.09)],
    "tyre-lane-change": [
        *extremes("force_lateral", -2790.0, 2650.0, 10.0, 0.1),
        *extremes("moment_aligning", -26.5, 26.2, 0.1, 0.1)],
}
EACH_STEP = {"wheel-drop"}  # for the impulses and the times of contact
REDUCED = {"tyre-lane-change"}  # as its comment says; the mesh takes minutes
LONGEST = 600  # s: tyre-load takes 50 s of an idle core


def with_derived(name, h):
    """Beside the columns, what the comment of a case makes of them."""
    t = h["time_s"]
    if name == "wheel-lock":
        h["standing_s"] = [t[-1] - t[h["spin_rad_s"] == 0.0][0]]
        h["traction"] = h["force_x"] / np.maximum(h["force_y"], 1.0)
    if name == "wheel-incline":
        h["acceleration"] = np.polyfit(t[t >= 0.3], h["speed_x"][t >= 0.3], 1)[:1]
    if name == "wheel-drop":
        step, touching = np.diff(t, prepend=0.0), h["force_y"] > 0.0
        for axis in "xy":
            h[f"impulse_{axis}"] = np.cumsum(h[f"force_{axis}"] * step)
        h["first_contact_s"], h["last_contact_s"] = t[touching][:1], t[touching][-1:]
    if name == "quarter-car":
        h["on_the_body"] = -1e6 * (h["center_y_m"] - 0.29167) - 2e4 * h["speed_y"]
    return {column: np.asarray(values) for column, values in h.items()}


class WholeCases(ProgramTest):
    def test_all_are_here(self):
        self.assertEqual(set(EXPECTED), {path.stem for path in CASES})

    def whole(self, name):
        out = self.folder / name
        each = ["--set", "output.history_interval=0"] if name in EACH_STEP else []
        reduced = ["--reduced"] if name in REDUCED else []
        done = run("run", ROOT / "cases" / f"{name}.toml", "-o", out, "--quiet", "--set",
                   "output.snapshots=0", *each, *reduced, timeout=LONGEST)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertLess(summary(out)["energy_residual_relative"], LEDGER)
        return with_derived(name, history(out))

    def test_figures_are_those_of_the_comments(self):
        for name, figures in EXPECTED.items():
            h = self.whole(name)
            for figure in figures:
                values = h[figure.column]
                if len(values) == len(h["time_s"]):
                    values = values[(h["time_s"] > figure.begin) & (h["time_s"] <= figure.end)]
                with self.subTest(case=name, column=figure.column, of=figure.of.__name__):
                    self.assertAlmostEqual(figure.of(values), figure.expected, delta=figure.digit)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""Wear and flash temperature of a run: what is found in words, and files of it."""
from __future__ import annotations

import pathlib
from typing import TYPE_CHECKING

import numpy as np

from .. import style
from ..data.files import write_table
from ..data.friction import Wear
from ..data.heat import FlashTemperature, Heat
from ..plots.friction import draw_flash, plot_wear

if TYPE_CHECKING:
    from ..data.run import Run

Written = tuple[str, list[pathlib.Path]]


def has_wear(run: Run) -> bool:
    """Steady rolling whose rows have powers, or a run with output.friction_work."""
    if run.is_steady:
        return run.contact is not None and "friction_power" in run.contact.rows
    return "friction_work" in run.contact_datasets and run.n_snapshots > 1


def draw_wear(run: Run, folder: pathlib.Path, from_time: float | None = None,
              to_time: float | None = None) -> Written:
    """The energy in words, and wear.csv, .png and .svg in the folder."""
    wear = run.wear(from_time, to_time)
    columns = {"node": wear.node, "angle_rad": wear.angle, "across_m": wear.across,
               "work_j_m2": wear.work, "work_per_turn_j_m2": wear.per_turn}
    table = write_table(folder / "wear.csv", columns)
    return wear_in_words(run, wear), [table, *style.save(plot_wear(run, from_time, to_time), folder / "wear")]


def draw_heat(run: Run, folder: pathlib.Path, heat: Heat, time: float | None = None) -> Written:
    """The temperature in words, and flash-temperature.csv, .png and .svg in the folder."""
    found = run.flash_temperature(heat, time)
    columns = {"node": found.node, "ahead_m": found.place[:, 0], "right_m": found.place[:, 1],
               "friction_power_w_m2": found.power, "flash_temperature_k": found.rise}
    table = write_table(folder / "flash-temperature.csv", columns)
    return flash_in_words(found), [table, *style.save(draw_flash(run, found), folder / "flash-temperature")]


def wear_in_words(run: Run, wear: Wear) -> str:
    most = int(np.argmax(wear.work))
    return (f"friction takes {wear.total:.6g} J{run.per_width} "
            f"{'in a turn' if run.is_steady else f'in {wear.turns:.4g} turns'}, at node {wear.node[most]} the most: "
            f"{wear.work[most]:.6g} J/m2")


def flash_in_words(found: FlashTemperature) -> str:
    hottest = int(np.argmax(found.rise))
    x, z = 1e3 * found.place[hottest]
    return (f"flash temperature {found.largest:.5g} K, {x:.4g} mm ahead of the center and {z:.4g} mm to its right, "
            f"at {found.speed:.5g} m/s")

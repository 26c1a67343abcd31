# SPDX-License-Identifier: BSD-3-Clause
"""A picture of a rolling run: the disk at three times, coloured by its displacement in the turning
frame, and the force of the ground over time. The times are those of the paper's figure 3.

    /usr/bin/python3 python/draw_ledge.py RESULTS PICTURE.png
"""
import pathlib
import sys
import tomllib

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection

from history import read_history

TIMES = (0.0125, 0.0625, 0.1)  # s


def ground_profile(directory):
    """Corners and fillet of the ground as case.toml has them; the plane y = 0 where it is flat."""
    ground = tomllib.loads((directory / "case.toml").read_text())["ground"]
    corners = [[-1, 0], [1, 0]] if ground["profile"] == "flat" else ground["profile"]
    return np.array(corners, dtype=float), ground["fillet"]


def rounded(corners, radius):
    """The profile with its convex corners rounded, as points to draw."""
    points = [corners[0]]
    for before, corner, after in zip(corners, corners[1:], corners[2:]):
        a, b = before - corner, after - corner
        a, b = a / np.linalg.norm(a), b / np.linalg.norm(b)
        if radius == 0 or a[0] * b[1] - a[1] * b[0] < 0:  # sharp, or concave
            points.append(corner)
            continue
        half = 0.5 * np.arccos(np.clip(a @ b, -1, 1))
        reach = radius / np.tan(half)
        middle = corner + (a + b) / np.linalg.norm(a + b) * radius / np.sin(half)
        for share in np.linspace(0, 1, 12):
            chord = corner + reach * ((1 - share) * a + share * b)
            points.append(middle + radius * (chord - middle) / np.linalg.norm(chord - middle))
    points.append(corners[-1])
    return np.array(points)


def draw_disk(axis, results, index, scale):
    cells = results["/mesh/cells"][:]
    size = np.linalg.norm(results["/snapshots/displacement"][index], axis=1) * 1e3
    patches = PolyCollection(results["/fields/position"][index, :, :2][cells],
                             array=size[cells].mean(axis=1), cmap="viridis_r",
                             edgecolors="0.35", linewidths=0.1)
    patches.set_clim(0, scale)
    axis.add_collection(patches)
    axis.set_title(f"t = {results['/frame/time'][index] * 1e3:.1f} ms", fontsize=9)
    return patches


def draw_ground(axis, profile, center):
    """The ground in a window about the centre."""
    reach = 0.36
    points = profile.copy()
    points[0, 0] = min(points[0, 0], center[0] - reach)  # the ends go on for ever
    points[-1, 0] = max(points[-1, 0], center[0] + reach)
    axis.fill_between(points[:, 0], points[:, 1], -10.0, color="0.7", lw=0, zorder=0)
    axis.set_xlim(center[0] - reach, center[0] + reach)
    axis.set_ylim(center[1] - 0.43, center[1] + 0.33)
    axis.set_aspect("equal")
    axis.set_xlabel("x (m)")


def draw_forces(axis, history, times):
    t = history["time_s"] * 1e3
    axis.plot(t, history["force_y"] / 1e3, color="#0072b2", lw=1, label="vertical")
    axis.plot(t, history["force_x"] / 1e3, color="#d55e00", lw=1, ls="--", label="horizontal")
    for time in times:
        axis.axvline(time * 1e3, color="0.8", lw=0.8, zorder=0)
    axis.set_xlim(0, t[-1])
    axis.set_xlabel("time (ms)")
    axis.set_ylabel("force of the ground\non the disk (kN/m)")
    axis.legend(frameon=False, loc="center right")


def draw(directory, picture):
    profile = rounded(*ground_profile(directory))
    figure = plt.figure(figsize=(7.2, 5.2), layout="constrained")
    grid = figure.add_gridspec(2, 3, height_ratios=(3, 2))
    disks = [figure.add_subplot(grid[0, k]) for k in range(3)]
    with h5py.File(directory / "results.h5") as results:
        times = results["/frame/time"][:]
        chosen = [int(np.nanargmin(np.abs(times - t))) for t in TIMES]
        scale = max(np.linalg.norm(results["/snapshots/displacement"][k], axis=1).max()
                    for k in chosen) * 1e3
        for axis, k in zip(disks, chosen):
            patches = draw_disk(axis, results, k, scale)
            draw_ground(axis, profile, results["/frame/center"][k])
    disks[0].set_ylabel("y (m)")
    for axis in disks[1:]:
        axis.tick_params(labelleft=False)
    figure.colorbar(patches, ax=disks, label="displacement (mm)", shrink=0.8)
    draw_forces(figure.add_subplot(grid[1, :]), read_history(directory), times[chosen])
    figure.savefig(picture, dpi=150)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    draw(pathlib.Path(sys.argv[1]), sys.argv[2])

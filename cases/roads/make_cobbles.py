# SPDX-License-Identifier: BSD-3-Clause
"""Makes cobbles.crg: 10 m of a road of cobbles, 0.5 m wide, heights every centimetre.

    python3 cases/roads/make_cobbles.py [FILE]      by default cobbles.crg beside this script

Rows of stones lie across the road, each row shifted by half a stone. A stone is a dome of its own
height and tilt. The numbers are chosen so that the steepest flank has a slope below 0.8. The file is
binary, in single precision (KRBI).
"""
import pathlib
import struct
import sys

import numpy as np

LENGTH, WIDTH, STEP = 10.0, 0.5, 0.01  # m
ROW, STONE = 0.14, 0.125               # m: a row of stones along the road, a stone across it
DOME, JOINT = 0.009, 0.007             # m: rise of a stone, and depth of the joints below its rim
UNEVEN, TILT = 0.004, 0.02             # m, slope: what stones differ by


def stone_heights(u, v, random):
    """(n_u, n_v) heights [m] of all stones at the positions (u, v)."""
    n_rows, n_stones = int(LENGTH / ROW) + 3, int(WIDTH / STONE) + 4
    lift = random.uniform(-UNEVEN, UNEVEN, (n_rows, n_stones))
    tilt = random.uniform(-TILT, TILT, (2, n_rows, n_stones))
    row = np.floor(u[:, None] / ROW).astype(int)
    shift = 0.5 * STONE * (row % 2)
    across = v[None, :] + WIDTH / 2 + STONE + shift
    stone = np.floor(across / STONE).astype(int)
    x = (u[:, None] / ROW - row) * 2 - 1           # -1 to 1 along the stone
    y = (across / STONE - stone) * 2 - 1           # -1 to 1 across it
    rim = (1 - x**2) * (1 - y**2)                  # 0 at the joint, 1 in the middle
    dome = DOME * rim**0.5 + JOINT * (1 - (1 - rim)**6)
    own = lift[row, stone] + tilt[0, row, stone] * x * ROW / 2 + tilt[1, row, stone] * y * STONE / 2
    return dome + own * (1 - (1 - rim)**3)


def header(n_u, n_v):
    sections = "".join(f"D:long section {j},m\n" for j in range(1, n_v + 1))
    return (f"$CT\n{LENGTH:g} m of cobbles, {WIDTH:g} m wide, made by cases/roads/make_cobbles.py\n$\n"
            "$ROAD_CRG\nREFERENCE_LINE_START_U   = 0.0\n"
            f"REFERENCE_LINE_END_U     = {(n_u - 1) * STEP:.2f}\nREFERENCE_LINE_INCREMENT = {STEP}\n"
            f"LONG_SECTION_V_RIGHT     = {-WIDTH / 2}\nLONG_SECTION_V_LEFT      = {WIDTH / 2}\n"
            f"LONG_SECTION_V_INCREMENT = {STEP}\n$\n$KD_Definition\n#:KRBI\n"
            f"U:reference line u,m,0,{STEP}\n{sections}$\n$$$$\n")


def smoothed(z):
    """The mean over three points each way: a laser's spot sees no sharp joint."""
    for axis in (0, 1):
        padded = np.concatenate([z.take([0], axis), z, z.take([-1], axis)], axis)
        n = z.shape[axis]
        z = sum(padded.take(range(k, k + n), axis) for k in range(3)) / 3
    return z


def main():
    default = pathlib.Path(__file__).with_name("cobbles.crg")
    path = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else default
    u = np.arange(round(LENGTH / STEP) + 1) * STEP
    v = np.arange(round(WIDTH / STEP) + 1) * STEP - WIDTH / 2
    z = smoothed(stone_heights(u, v, np.random.default_rng(1)))
    numbers = np.round(z, 5).astype(">f4").ravel()
    fill = -numbers.size % 20  # records have 20 numbers
    path.write_bytes(header(len(u), len(v)).encode() + numbers.tobytes()
                     + struct.pack(f">{fill}f", *[float("nan")] * fill))
    print(f"{path}: {len(u)} x {len(v)} heights from {z.min() * 1e3:.1f} to {z.max() * 1e3:.1f} mm")


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""Damage to texts, at random and seeded."""
import numpy as np


def spoilt(text, rng):
    """A text with a byte, a line or a piece less, more or other than before."""
    data, at = bytearray(text.encode()), int(rng.integers(0, len(text) - 20))
    kind = int(rng.integers(0, 5))
    if kind == 0:
        data[at] = int(rng.integers(0, 256))
    elif kind == 1:
        del data[at:at + int(rng.integers(1, 20))]
    elif kind == 2:
        data[at:at] = rng.choice(list(b"*!\t ,.-+0123456789Ee\n$=['{"), 3).astype(np.uint8).tobytes()
    elif kind == 3:
        lines = data.split(b"\n")
        del lines[int(rng.integers(0, len(lines)))]
        data = bytearray(b"\n").join(lines)
    else:
        lines = data.split(b"\n")
        first, second = rng.integers(0, len(lines), 2)
        lines[first], lines[second] = lines[second], lines[first]
        data = bytearray(b"\n").join(lines)
    return bytes(data)

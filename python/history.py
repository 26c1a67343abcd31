# SPDX-License-Identifier: BSD-3-Clause
"""history.csv of a results directory as arrays."""
import csv
import pathlib

import numpy as np


def read_history(directory):
    """{column: array of all rows}."""
    with open(pathlib.Path(directory) / "history.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}

# SPDX-License-Identifier: BSD-3-Clause
"""Columns as tables of pandas, which is used where it is installed and never required."""
from __future__ import annotations

import importlib
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import Error

if TYPE_CHECKING:
    import pandas

WHOLE = ("node", "sticks", "run", "iteration")  # columns of whole numbers


def installed(package: str, what: str) -> Any:
    """The module of a package that only `what` needs; an error that says how to install it."""
    try:
        return importlib.import_module(package)
    except ImportError:
        raise Error(f"{what} needs the package {package}, which is not installed for this Python: "
                    f"apt-get install python3-{package} (Debian), or pip install {package}"
                    ) from None


def frame_of(columns: Mapping[str, np.ndarray], units: Mapping[str, str], what: str,
             index: str | None = None) -> pandas.DataFrame:
    """The columns as a DataFrame, copied; attrs["units"]: of each column and of the index that have
    a known one. index: the column that becomes the index."""
    pandas = installed("pandas", what)
    table = {name: values.astype(np.int64) if name in WHOLE and np.isfinite(values).all()
             else np.array(values) for name, values in columns.items()}
    frame = pandas.DataFrame(table)
    frame.attrs["units"] = {name: units[name] for name in table if name in units}
    return frame if index is None else frame.set_index(index)

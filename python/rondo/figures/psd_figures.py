# SPDX-License-Identifier: BSD-3-Clause
"""The power spectral density of a column of a run: numbers, a figure, and a file of both."""
from __future__ import annotations

import pathlib
from typing import TYPE_CHECKING

from .. import style
from ..plots.psd import checked_psd, draw_psd, psd_in_words, write_psd

if TYPE_CHECKING:
    from ..data.run import Run


def draw_psd_of(run: Run, folder: pathlib.Path, column: str, from_time: float | None = None,
                to_time: float | None = None,
                segment: float | None = None) -> tuple[str, list[pathlib.Path]]:
    """What was found in words, and psd-COLUMN.csv, .png and .svg in the folder."""
    psd = checked_psd(run, column, from_time, to_time, segment)
    name = f"psd-{psd.column}"
    table = write_psd(psd, folder / f"{name}.csv")
    return psd_in_words(psd), [table, *style.save(draw_psd(run, psd).figure, folder / name)]

# SPDX-License-Identifier: BSD-3-Clause
"""Axes and signs of wheels in three dimensions: systems and conversions (docs/conventions.md)."""
from .data.axes import (
    CENTER,
    CONTACT,
    GROUND,
    NAMES,
    QUANTITIES,
    SLIP_RATIOS,
    SYSTEMS,
    Quantities,
    System,
    convert,
    convert_slip_ratio,
    directions,
    origin,
    own,
    slip_ratio,
    system,
)

__all__ = ["CENTER", "CONTACT", "GROUND", "NAMES", "QUANTITIES", "SLIP_RATIOS", "SYSTEMS", "Quantities", "System", "convert",
           "convert_slip_ratio", "directions", "origin", "own", "slip_ratio", "system"]

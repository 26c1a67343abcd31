# SPDX-License-Identifier: BSD-3-Clause
"""Names, units and scales at the axes of curves."""
from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from .. import style

LABELS = {  # of columns, where their name does not say it
    "angle_rad": "angle", "center_x_m": "center, x", "center_y_m": "center, y",
    "force_x": "horizontal force", "force_y": "vertical force",
    "force_lateral": "lateral force", "moment_aligning": "aligning moment",
    "moment_overturning": "overturning moment", "slip_angle": "slip angle",
    "moment_aligning_iso": "aligning moment (ISO 8855)",
    "moment_overturning_iso": "overturning moment (ISO 8855)",
    "slip_angle_degrees": "slip angle", "contact_area_m2": "contact area",
    "footprint_length_m": "length of the footprint", "footprint_width_m": "width of the footprint",
    "pressure_mean_pa": "mean pressure", "relaxation_length_m": "relaxation length",
    "torque": "torque about the center", "contact_nodes": "nodes in contact",
    "sticking_nodes": "nodes that stick", "contact_length_m": "contact length",
    "penetration_max_m": "largest penetration", "kinetic": "kinetic energy",
    "strain": "strain energy", "depth_m": "depth", "pressure_max_pa": "largest pressure",
    "shear_max_pa": "largest shear",
    "spin_rad_s": "spin", "speed_x": "speed of the hub, x", "speed_y": "speed of the hub, y",
    "hub_force_x": "hub force, x", "hub_force_y": "hub force, y", "hub_torque": "hub torque",
    "slip_percent": "slip ratio",
    "load_share": "share of the loads", "pressure_pa": "pressure of the air",
    "outer_radius_m": "outer radius", "width_m": "width", "twist_m": "largest displacement around the axle",
    "cavity_volume_m3": "volume of the cavity", "det_f_min": "smallest det F",
    "stretch_max": "largest stretch", "cord_force_min_n": "smallest force of a cord",
    "cord_force_max_n": "largest force of a cord",
    "kinetic_rim": "kinetic energy of the rim", "support_energy": "energy of the supports",
}
PARAMETERS = {"analysis.load": "load", "rim.force_y": "load", "ground.friction": "friction μ",
              "motion.slip_angle": "slip angle", "motion.camber": "camber",
              "motion.turn_slip": "turn slip",
              "motion.height": "height", "motion.speed": "speed", "motion.angular_velocity": "spin"}  # in words
SCALED = ("N/m", "J/m", "W/m", "N·m/m", "Pa", "N", "J", "W", "N·m")  # with k and M
CONSTANT = 1e-6  # span over size of a column that does not change
LEVEL = 0.01  # least height of the axis on both sides of such a one, in its unit


def column_label(column: str) -> str:
    return LABELS.get(column, column.replace("_", " "))


def parameter_label(key: str) -> str:
    """A key of a case in words, where there are some."""
    return PARAMETERS.get(key, key)


def readable(size: float, unit: str) -> tuple[float, str]:
    """Factor and unit for values up to `size`: 1.9e5 N/m is 190 kN/m."""
    for factor, prefix in ((1e-6, "M"), (1e-3, "k")):
        if unit in SCALED and size * factor >= 1:
            return factor, prefix + unit
    if unit == "m" and 0 < size < 0.1:
        return 1e3, "mm"
    return 1.0, "–" if unit == "1" else unit


def share_of_loads(share: float) -> str:
    """Of an inflation, in words."""
    return f"{100.0 * share:.4g} % of the loads"


def axes_of(ax: Axes | None, height: float) -> Axes:
    """The axes given, or those of a new figure, two columns wide."""
    import matplotlib.pyplot as plt

    if ax is not None:
        return ax
    return plt.figure(figsize=(style.PAGE, height)).add_subplot()


def steady_scale(ax: Axes, values: np.ndarray, unit: str) -> None:
    """Numbers at the axis as they are, and columns that do not change drawn as level lines, not
    magnified until round-off fills the axes."""
    ax.ticklabel_format(axis="y", useOffset=False)
    size = np.abs(values).max(initial=1.0 if unit == "–" else 0.0)  # 1e-8 of a ratio is nothing
    if not len(values) or np.ptp(values) > CONSTANT * size:
        return
    middle = 0.5 * (values.min() + values.max())
    around = max(0.1 * abs(middle), LEVEL)
    ax.set_ylim(middle - around, middle + around)

# SPDX-License-Identifier: BSD-3-Clause
"""Figure 6: the first modes of the velocity in steady rolling, co-rotating frame and rectified."""
from __future__ import annotations

from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from ..plots.modes import plot_modes

if TYPE_CHECKING:
    from ..data.paper import Paper

COUNT = 6  # as in the paper
LOWER = ((-0.75, 0.75), (-1.16, -0.3))  # over the outer radius: the part above the contact


def draw(paper: Paper) -> dict[str, Figure]:
    """The co-rotating frame first, the paper's own. In the rectified one the modes are near the
    contact, and only the lower part of the body is shown."""
    figures = {}
    for name in ("smooth", "treaded"):
        radius = paper.run(f"turn-{name}").outer_radius
        (left, right), (low, high) = LOWER
        lower = ((left * radius, right * radius), (low * radius, high * radius))
        for frame, window in (("co-rotating", None), ("rectified", lower)):
            pod = paper.pod(f"turn-{name}", "velocity", frame)
            figures[f"figure-6-{frame.removeprefix('co-')}-{name}"] = plot_modes(pod, COUNT, window)
    return figures

# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of figures look at in a drawn figure."""
from __future__ import annotations

import pathlib
import xml.etree.ElementTree

from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from PIL import Image

SVG = "{http://www.w3.org/2000/svg}"


def numbered(axis: Axis) -> bool:
    """Whether the axis shows numbers."""
    return any(label.get_visible() and label.get_text() for label in axis.get_ticklabels())


def without_unit(figure: Figure) -> list[str]:
    """Axes that show numbers without a label that ends in a unit, as "time (ms)"."""
    figure.canvas.draw()
    found = []
    for number, ax in enumerate(figure.axes):
        for axis, name in ((ax.xaxis, "x"), (ax.yaxis, "y")):
            label = axis.get_label_text()
            if numbered(axis) and not (label.endswith(")") and "(" in label):
                found.append(f"axes {number}, {name}: {label!r}")
    return found


def bodies(ax: Axes) -> list[PolyCollection]:
    """The meshes drawn in an axes: collections with a number for each cell."""
    return [c for c in ax.collections if isinstance(c, PolyCollection) and c.get_array() is not None
            and len(c.get_array()) == len(c.get_paths()) > 1]


def body_axes(figure: Figure) -> list[Axes]:
    return [ax for ax in figure.axes if ax.get_label() != "<colorbar>" and bodies(ax)]


def check_files(png: pathlib.Path, svg: pathlib.Path, width: float, dpi: int) -> None:
    """A PNG of the width (in), light enough, and an SVG of that width with its text as text."""
    with Image.open(png) as image:
        image.load()
        assert image.width == round(width * dpi), png
    assert png.stat().st_size < 400_000, png
    root = xml.etree.ElementTree.parse(svg).getroot()
    assert root.tag == f"{SVG}svg", svg
    assert root.get("width") == f"{72 * width:g}pt", svg
    assert next(root.iter(f"{SVG}text"), None) is not None, svg

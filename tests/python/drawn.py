# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of figures look at in a drawn figure."""
from __future__ import annotations

import pathlib
import xml.etree.ElementTree

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Polygon
from matplotlib.quiver import Quiver
from PIL import Image

Array = np.ndarray
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


def panel(figure: Figure, letter: str) -> Axes:
    """The panel of a letter."""
    found, = (ax for ax in figure.axes if ax.get_title(loc="left").startswith(f"({letter})"))
    return found


def beneath(ax: Axes) -> Axes:
    """The panel below in the grid."""
    place = ax.get_subplotspec()
    row, column = place.rowspan.stop, place.colspan.start
    found, = (other for other in ax.figure.axes if other.get_label() != "<colorbar>"
              and (spec := other.get_subplotspec()).rowspan.start == row
              and spec.colspan.start == column)
    return found


def curves(ax: Axes) -> list[Line2D]:
    """Lines of several points, not what marks a level or a moment."""
    return [line for line in ax.lines if line.get_visible() and len(line.get_xdata()) > 2
            and line.get_linestyle() != "None"]


def named(ax: Axes, *words: str, without: str = "none of them") -> Array:
    """(points, 2): the curve whose label holds all these words."""
    found, = (line for line in curves(ax) if without not in str(line.get_label())
              and all(word in str(line.get_label()) for word in words))
    return found.get_xydata()


def check_body(ax: Axes, points: Array, cells: Array, values: Array) -> None:
    """One body with its nodes at points (n, 2), its cells coloured by the mean of values (n,)."""
    body, = bodies(ax)
    assert body.get_visible() and (cells >= 0).all()
    drawn = np.array([path.vertices[:cells.shape[1]] for path in body.get_paths()])
    assert np.allclose(drawn, points[cells], rtol=0, atol=1e-9)
    assert np.allclose(body.get_array(), values[cells].mean(axis=1), rtol=1e-9, atol=1e-9)


def outline(cells: Array) -> set[tuple[int, int]]:
    """Sides of one cell only, as their two nodes, the lower first."""
    sides = np.sort(np.stack([cells, np.roll(cells, -1, axis=1)], axis=-1).reshape(-1, 2), axis=1)
    unique, count = np.unique(sides, axis=0, return_counts=True)
    return {(int(a), int(b)) for a, b in unique[count == 1]}


def contact(ax: Axes, points: Array) -> tuple[set[tuple[int, int]], set[int]]:
    """What is marked of a body with its nodes at points (n, 2), above it: sides, as their two
    nodes, the lower first, by lines other than that along its whole edge; nodes, by dots."""
    body, = bodies(ax)

    def nodes(places: Array) -> list[int]:
        apart = np.linalg.norm(points[None] - np.reshape(places, (-1, 1, 2)), axis=2)
        return apart.argmin(axis=1).tolist() if (apart.min(axis=1) < 1e-9).all() else []

    def seen(artist: Line2D | LineCollection) -> bool:
        return (artist.get_visible() and artist.get_zorder() > body.get_zorder()
                and artist.get_alpha() in (None, 1))

    sides: set[tuple[int, int]] = set()
    for lines in (c for c in ax.collections if isinstance(c, LineCollection) and seen(c)):
        chains = [nodes(segment) for segment in lines.get_segments()]
        closed = any(chain and chain[0] == chain[-1] for chain in chains)
        if not closed and max(lines.get_linewidths()) > 0.6:
            sides |= {(min(s), max(s)) for chain in chains for s in zip(chain, chain[1:])}
    dots = {node for line in ax.lines if line.get_marker() == "o" and seen(line)
            for node in nodes(line.get_xydata())}
    return sides, dots


def check_ground(ax: Axes, profile: Array, fillet: float) -> None:
    """Ground filled from its profile (k, 2), level parts and walls, down to the end of the view,
    under the body, and nothing above it, with a line along its surface; but not near corners."""
    filled = [p for p in ax.patches if isinstance(p, Polygon) and p.get_visible() and p.get_fill()]
    assert filled and max(p.get_zorder() for p in filled) < bodies(ax)[0].get_zorder()
    (left, right), (low, high) = ax.get_xlim(), ax.get_ylim()

    def solid(x: float, y: float) -> bool:
        return any(p.get_path().contains_point((x, y)) for p in filled)

    tested = 0
    for x in np.linspace(left, right, 43)[1:-1]:
        if np.abs(x - profile[:, 0]).min() < 1.1 * fillet:
            continue
        level = float(profile[np.searchsorted(profile[:, 0], x), 1])  # all parts are level
        assert not solid(x, level + 1e-3)
        if low < level - 1e-3:
            tested += 1
            assert solid(x, level - 1e-3) and solid(x, low + 1e-4)
            assert any(line.get_visible() and _passes(line.get_xydata(), x, level)
                       for line in curves(ax))
    assert tested > 10


def _passes(line: Array, x: float, y: float) -> bool:
    start, end = line[:-1], line[1:]
    over = (start[:, 0] < x) & (x < end[:, 0])
    return bool(np.any(np.abs(start[over, 1] - y) + np.abs(end[over, 1] - y) < 1e-9))


def arrows(ax: Axes) -> tuple[Array, Array]:
    """(m, 2) m each: tips and tails of the arrows, as they are on the page."""
    tips, tails = [], []
    for quiver in (c for c in ax.collections if isinstance(c, Quiver) and c.get_visible()):
        places = quiver.get_offset_transform().transform(quiver.get_offsets())
        for path, place, u, v in zip(quiver.get_paths(), places, quiver.U, quiver.V):
            corners = quiver.get_transform().transform(path.vertices) + place
            along = corners @ np.array([u, v])
            tips.append(corners[along.argmax()])  # the point; the end has two corners
            tails.append(corners[along < along.min() + 1e-6 * np.ptp(along)].mean(axis=0))
    back = ax.transData.inverted()
    return back.transform(np.reshape(tips, (-1, 2))), back.transform(np.reshape(tails, (-1, 2)))


def said(drawn: Figure | Axes) -> str:
    """The title, in one line."""
    title = drawn.get_title() if isinstance(drawn, Axes) else drawn._suptitle.get_text()
    return title.replace("\n", " ")


def crosses(ax: Axes) -> list[float]:
    """x of the members of a sweep without a value."""
    marks, = (line for line in ax.lines if line.get_label() == "_lost")
    assert marks.get_marker() == "x"
    return sorted(marks.get_xdata())

# SPDX-License-Identifier: BSD-3-Clause
"""Colours that colour-blind readers and prints in grey tell apart, and files as they should be."""
import pathlib

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import pytest
from drawn import check_files
from matplotlib.colors import Colormap, to_rgb
from PIL import Image

from rondo import style


def lightness(rgb: np.ndarray) -> np.ndarray:
    """L* of CIELAB, 0 to 100, of (..., 3) sRGB: what is left of a colour in grey."""
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    y = linear @ np.array([0.2126, 0.7152, 0.0722])
    return np.where(y > 0.008856, 116 * np.cbrt(y) - 16, 903.3 * y)


def levels(colours: Colormap) -> np.ndarray:
    return lightness(colours(np.arange(colours.N))[:, :3])


def test_magnitudes_get_darker_with_every_step() -> None:
    level = levels(style.SEQUENTIAL)
    assert np.all(np.diff(level) < 0)
    assert level[0] - level[-1] > 80


def test_signed_quantities_get_lighter_from_end_to_end() -> None:
    """The sign is told in grey: each step is seen, and they are much the same."""
    level = levels(style.DIVERGING)
    steps = np.diff(level)
    assert steps.min() > 1.5 and steps.max() < 2 * steps.min()
    assert level[-1] - level[0] > 80


def test_zero_has_a_grey_of_its_own() -> None:
    assert style.DIVERGING.N % 2 == 1
    red, green, blue, _ = style.DIVERGING(0.5)
    assert red == green == blue
    assert 45 < levels(style.DIVERGING)[style.DIVERGING.N // 2] < 60


def test_signs_differ_in_blue_against_yellow() -> None:
    """What red-green blindness leaves: blue over the other two below zero, under them above."""
    colour = style.DIVERGING(np.arange(style.DIVERGING.N))[:, :3]
    excess = colour[:, 2] - colour[:, :2].mean(axis=1)
    middle = style.DIVERGING.N // 2
    assert np.all(excess[:middle] > 0) and np.all(excess[middle + 1:] < 0)


def test_curves_differ_in_colour_and_in_line() -> None:
    assert len({to_rgb(curve["color"]) for curve in style.CURVES}) == len(style.CURVES)
    assert len({str(curve["linestyle"]) for curve in style.CURVES}) == len(style.CURVES)


def test_the_style_ends_with_its_context() -> None:
    before = dict(matplotlib.rcParams)
    with style.paper():
        assert matplotlib.rcParams["font.size"] == 8.0
    assert dict(matplotlib.rcParams) == before


def example(width: float) -> plt.Figure:
    with style.paper():
        figure = plt.figure(figsize=(width, 2.0))
        ax = figure.add_subplot()
        grey = np.linspace(0, 1, 400)[:, None] * np.ones(400)
        ax.imshow(grey, cmap="gray", aspect="auto")
        ax.set_xlabel("an axis (m)")
    return figure


@pytest.mark.parametrize("width", [style.COLUMN, style.PAGE])
def test_files_have_the_width_of_the_figure(tmp_path: pathlib.Path, width: float) -> None:
    figure = example(width)
    assert style.save(figure, tmp_path / "new" / "a") == [tmp_path / "new" / "a.png",
                                                          tmp_path / "new" / "a.svg"]
    check_files(tmp_path / "new" / "a.png", tmp_path / "new" / "a.svg", width, style.DPI)


def test_a_name_with_a_point_keeps_it(tmp_path: pathlib.Path) -> None:
    written = style.save(example(style.COLUMN), tmp_path / "friction-0.2")
    assert [path.name for path in written] == ["friction-0.2.png", "friction-0.2.svg"]


def test_the_same_figure_gives_the_same_bits(tmp_path: pathlib.Path) -> None:
    for name in "ab":
        style.save(example(style.COLUMN), tmp_path / name)
    for ending in ("png", "svg"):
        assert (tmp_path / f"a.{ending}").read_bytes() == (tmp_path / f"b.{ending}").read_bytes()
    assert "<dc:date>" not in (tmp_path / "a.svg").read_text()


def test_rare_colours_survive_in_png(tmp_path: pathlib.Path) -> None:
    figure = example(style.PAGE)
    with style.paper():
        for left, colours in ((0.2, style.SEQUENTIAL), (0.6, style.DIVERGING)):
            ax = figure.add_axes((left, 0.4, 0.02, 0.4))
            ax.imshow(np.linspace(0, 1, 64)[:, None], cmap=colours, aspect="auto")
        figure.savefig(tmp_path / "all.png", dpi=style.DPI)
    style.save(figure, tmp_path / "few")
    every, few = (np.asarray(Image.open(tmp_path / f"{name}.png").convert("RGB")).astype(int)
                  for name in ("all", "few"))
    assert np.abs(every - few).max() < 32
    assert np.abs(every - few).mean() < 0.5
    assert np.all(few[0] == 255)  # white stays white

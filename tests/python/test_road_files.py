# SPDX-License-Identifier: BSD-3-Clause
"""rondo.files.read_crg on files that the tests write by the definition of the format, against the digits
in them and against bilinear interpolation by numpy; the road of cases/roads."""
import pathlib
import struct
import subprocess
import sys

import matplotlib.pyplot as plt
import numpy as np
import pytest
from built import cached
from program import PROGRAM

import rondo
from rondo import files

ROOT = pathlib.Path(__file__).resolve().parents[2]
COBBLES = ROOT / "cases" / "roads" / "cobbles.crg"
BUILD = pathlib.Path(PROGRAM).resolve().parent
U = 2.0 + 0.5 * np.arange(7)
V = np.array([-1.5, -1.25, -0.5, 0.0, 1.0])
FORMATS = ("LRFI", "LDFI", "KRBI", "KDBI")


@pytest.fixture(autouse=True)
def module(monkeypatch):
    if not cached(BUILD, "RONDO_PYTHON_MODULE"):
        pytest.skip(cached(BUILD, "RONDO_PYTHON_MODULE_MISSING"))
    monkeypatch.setenv("RONDO", PROGRAM)


def heights():
    """Digits that each format holds."""
    z = np.random.default_rng(3).integers(-50, 50, (len(U), len(V))) / 128
    z[0, 0] = z[3, -1] = z[4, -2] = z[4, -1] = np.nan
    return z


def data_of(rows, form):
    if form[0] == "K":
        letter = "f" if form == "KRBI" else "d"
        data = b"".join(struct.pack(f">{letter}", x) for x in rows.ravel())
        while len(data) % 80:
            data += struct.pack(f">{letter}", float("nan"))
        return data
    width = 10 if form == "LRFI" else 20
    texts = [[f"{'*missing*':>{width}}" if np.isnan(x) else f"{x:{width}.{7 if width == 10 else 12}f}"
              for x in row] for row in rows]
    lines = ["".join(row[k:k + 80 // width]) for row in texts for k in range(0, len(row), 80 // width)]
    return ("\n".join(lines) + "\n").encode()


def road_file(folder, form, z, blocks="", banking=0.0, slope=0.0):
    sections = "".join(f"D:long section at v = {v:.3f},m\n" for v in V)
    text = (f"$CT\nStra\xdfe der Tests\n$\n$Road_Crg\nreference_line_start_u = 2\n"
            f"reference_line_increment = 0.5\nreference_line_start_b = {banking}\n"
            f"reference_line_start_s = {slope}\n$\n{blocks}$KD_definition\n#:{form}\n{sections}$\n$$$$\n")
    path = folder / f"{form}.crg"
    path.write_bytes(text.encode("latin-1") + data_of(z, form))
    return path


def bilinear(z, u, v):
    """By one-dimensional interpolation across, then along."""
    rows = np.array([np.interp(v, V, row) for row in z])
    return np.array([np.interp(a, U, column) for a, column in zip(u, rows.T)])


@pytest.mark.parametrize("form", FORMATS)
def test_digits_of_the_file_and_heights_between_them(tmp_path, form):
    z = heights()
    road = files.read_crg(road_file(tmp_path, form, z, banking=-0.05, slope=0.125))
    assert (road.format, road.file.name) == (form, f"{form}.crg")
    assert (road.border_u, road.border_v) == ("keep", "keep")
    np.testing.assert_array_equal(road.u, U)
    np.testing.assert_array_equal(road.v, V)
    np.testing.assert_array_equal(road.heights, z)
    np.testing.assert_allclose(road.line_height, 0.125 * (U - 2.0), rtol=0, atol=1e-15)
    filled = z.copy()
    filled[0, 0], filled[3, -1], filled[4, 3:] = z[0, 1], z[3, -2], z[4, 2]
    random = np.random.default_rng(4)
    u, v = random.uniform(2.0, 5.0, 500), random.uniform(-1.5, 1.0, 500)
    expected = bilinear(filled, u, v) + 0.125 * (u - 2.0) - 0.05 * v
    np.testing.assert_allclose(road.height(u, v), expected, rtol=0, atol=1e-12)
    assert road.height(3.0, V).shape == (5,)
    assert road.height(U[:, None], V[None, :]).shape == (7, 5)
    assert float(road.height(2.5, -1.5)) == pytest.approx(filled[1, 0] + 0.125 * 0.5 + 0.075, abs=1e-15)


def test_borders_and_options(tmp_path):
    z = np.nan_to_num(heights())
    path = road_file(tmp_path, "KDBI", z, "$ROAD_CRG_OPTS\nBORDER_MODE_U = 3\nBORDER_MODE_V = 0\n$\n")
    road = files.read_crg(path)
    assert (road.border_u, road.border_v) == ("repeat", "none")
    assert road.height(6.25, 0.3) == pytest.approx(float(road.height(3.25, 0.3)), abs=1e-12)
    assert np.isnan(road.height(3.0, 1.5))
    kept = files.read_crg(path, border="keep")
    assert kept.height(99.0, 7.0) == z[-1, -1]
    assert files.read_crg(path, border="zero").height(99.0, 0.0) == 0.0
    with pytest.raises(rondo.InputError, match="allowed: none, zero, keep, repeat, reflect"):
        files.read_crg(path, border="wall")


def test_smooth_surface(tmp_path):
    """The same heights at the grid, the slopes of its own heights between."""
    road = files.read_crg(road_file(tmp_path, "KDBI", np.nan_to_num(heights())))
    there = road.smooth(U[:, None], V[None, :])
    np.testing.assert_allclose(there.height, road.heights, rtol=0, atol=1e-15)
    u, v, h = 2.0 + np.linspace(0.07, 2.9, 40), 0.37, 1e-6
    middle, left, ahead, behind = (road.smooth(a, b) for a, b in
                                   ((u, v), (u, v + h), (u + h, v), (u - h, v)))
    right = road.smooth(u, v - h)
    np.testing.assert_allclose(middle.slope_u, (ahead.height - behind.height) / (2 * h), atol=1e-6)
    np.testing.assert_allclose(middle.slope_v, (left.height - right.height) / (2 * h), atol=1e-6)


def test_what_is_refused(tmp_path):
    with pytest.raises(rondo.FileError, match="nothing.crg: cannot be opened"):
        files.read_crg(tmp_path / "nothing.crg")
    path = road_file(tmp_path, "KRBI", heights(), "$ROAD_CRG_MODS\nSCALE_Z = 2\n$\n")
    with pytest.raises(rondo.InputError, match=r":11:1: \$ROAD_CRG_MODS SCALE_Z = 2.*SCALE_Z_GRID") as error:
        files.read_crg(path)
    assert error.value.faults[0]["line"] == 11
    cut = road_file(tmp_path, "KDBI", heights())
    cut.write_bytes(cut.read_bytes()[:-3])
    with pytest.raises(rondo.FileError, match="no multiple of the 80 of a record"):
        files.read_crg(cut)
    road = files.read_crg(road_file(tmp_path, "LRFI", heights()))
    with pytest.raises(rondo.InputError, match="no places of a road"):
        road.height([1, 2], [1, 2, 3])
    with pytest.raises(rondo.InputError, match="allowed: a part of 2 to 5 m"):
        road.plot(u=(7.0, 8.0))


def test_picture(tmp_path):
    z = heights()
    road = files.read_crg(road_file(tmp_path, "LDFI", z, banking=0.01))
    ax = road.plot(u=(2.4, 4.0))
    assert ax.get_xlabel() == "u, along the reference line (m)"
    assert ax.get_ylabel() == "v, to the left (m)"
    drawn = ax.collections[0].get_array().reshape(5, 4)
    expected = np.ma.masked_invalid(z[1:5] + 0.01 * V).T
    np.testing.assert_array_equal(np.ma.getmaskarray(drawn), np.ma.getmaskarray(expected))
    np.testing.assert_allclose(drawn.compressed(), expected.compressed(), rtol=0, atol=1e-12)
    label = ax.figure.axes[1].get_ylabel()
    assert label == "height (m)"
    plt.close(ax.figure)


def test_the_road_of_cobbles(tmp_path):
    """The file in cases/roads is the one that its script makes, and smooth enough to roll over."""
    again = tmp_path / "cobbles.crg"
    subprocess.run([sys.executable, COBBLES.with_name("make_cobbles.py"), str(again)], check=True,
                   capture_output=True)
    old, new = files.read_crg(COBBLES), files.read_crg(again)
    np.testing.assert_allclose(new.heights, old.heights, rtol=0, atol=1.01e-5)  # its last digit
    assert COBBLES.stat().st_size == again.stat().st_size < 300_000
    assert old.heights.shape == (1001, 51)
    assert (old.u[0], old.u[-1], old.v[0], old.v[-1]) == pytest.approx((0.0, 10.0, -0.25, 0.25))
    slopes = old.smooth(old.u[:, None], old.v[None, :])
    assert np.hypot(slopes.slope_u, slopes.slope_v).max() < 0.8
    assert any("largest slope of its smooth surface is 0.776" in line for line in old.lines)

# SPDX-License-Identifier: BSD-3-Clause
"""The Campbell diagram, of modes computed by the built program."""
import pathlib
import subprocess
import sys

import matplotlib.pyplot as plt
import numpy as np
import pytest
from drawn import without_unit
from program import SMALL, run

import rondo

SPINS = np.linspace(0.0, 90.0, 10)


@pytest.fixture(autouse=True)
def closed() -> None:
    plt.close("all")


@pytest.fixture(scope="module")
def modes(tmp_path_factory: pytest.TempPathFactory) -> pathlib.Path:
    folder = tmp_path_factory.mktemp("modes")
    (folder / "case.toml").write_text(SMALL)
    done = run("modes", folder / "case.toml", "-o", folder / "out", "--spins", "0:90:10", "--quiet")
    assert done.returncode == 0, done.stderr
    return folder / "out"


def test_branches(modes: pathlib.Path) -> None:
    found = rondo.open_modes(modes)
    assert np.allclose(found.spins, SPINS)
    branches = {(b.diameters, b.wave, b.order): b for b in found.branches}
    back, forth = branches[2, "backward", 1], branches[2, "forward", 1]
    assert np.array_equal(back.spin, found.spins)
    assert np.isclose(back.frequency[0], forth.frequency[0], rtol=1e-12)  # a pair at rest
    assert np.all(back.frequency[1:] > forth.frequency[1:])
    assert np.allclose(back.frequency_fixed, np.abs(back.frequency - 2 * back.spin))
    assert np.allclose(forth.frequency_fixed, forth.frequency + 2 * forth.spin)


def test_what_is_drawn(modes: pathlib.Path) -> None:
    found = rondo.open_modes(modes)
    branches = [b for b in found.branches if b.order == 1 and b.diameters <= 6]
    for frame, lines in ("co-rotating", [b.frequency for b in branches]), ("fixed", None):
        figure = found.plot_campbell(frame)
        ax, = figure.axes
        assert without_unit(figure) == []
        curves = [line.get_ydata() for line in ax.lines]
        if lines is not None:
            for values in lines:
                assert any(np.array_equal(values, curve) for curve in curves)
            # The lines n s of n > 0 besides.
            assert len(curves) == len(lines) + len({b.diameters for b in branches} - {0})
        else:
            assert len(curves) == len(branches)
            for branch, curve in zip(branches, ax.lines):
                at = np.searchsorted(curve.get_xdata(), branch.spin)
                assert np.allclose(curve.get_ydata()[at], branch.frequency_fixed)
    with pytest.raises(rondo.Error, match="co-rotating"):
        found.plot_campbell("standing")
    with pytest.warns(DeprecationWarning, match='"turning" is called "co-rotating"') as said:
        assert len(found.plot_campbell("turning").axes[0].lines) > len(branches)
    assert [warning.filename for warning in said] == [__file__]


def test_command(modes: pathlib.Path, tmp_path: pathlib.Path) -> None:
    def campbell(*arguments: object) -> "subprocess.CompletedProcess[str]":
        return subprocess.run([sys.executable, "-m", "rondo", "campbell", *map(str, arguments)],
                              text=True, capture_output=True, timeout=120)

    done = campbell(modes, "-o", tmp_path, "--frame", "fixed")
    assert (done.returncode, done.stderr) == (0, "")
    assert {p.name for p in tmp_path.iterdir()} == {"campbell-fixed.png", "campbell-fixed.svg"}
    done = campbell(modes, "-o", tmp_path / "older", "--frame", "turning")
    assert (done.returncode, done.stderr) == (
        0, "rondo: warning: --frame turning is called co-rotating\n")
    assert (tmp_path / "older" / "campbell-co-rotating.svg").is_file()
    done = campbell(tmp_path)
    assert done.returncode == 2 and "has no modes.json" in done.stderr
    (tmp_path / "modes.json").write_text("{}")
    done = campbell(tmp_path)
    assert done.returncode == 2 and "--spins" in done.stderr


def test_a_single_spin(modes: pathlib.Path, tmp_path: pathlib.Path) -> None:
    case = modes.parent / "case.toml"
    found = rondo.modes(case, tmp_path / "own", spins=[30.0], count=4)
    assert np.array_equal(found.spins, [30.0]) and not found.has_branches
    table = found.table
    assert np.array_equal(table["mode"], [1, 2, 3, 4]) and set(table["wave"]) > {"forward"}
    assert np.allclose(table["frequency_rad_s"], 2 * np.pi * table["frequency_hz"])
    over = rondo.open_modes(modes)
    for n, wave, own in zip(table["nodal_diameters"], table["wave"], table["frequency_rad_s"]):
        b, = (b for b in over.branches if (b.diameters, b.wave, b.order) == (n, wave, 1))
        assert np.isclose(own, b.frequency[3], rtol=1e-9)  # at 30 rad/s, too
    assert "30" in found._repr_html_() and "forward" in found._repr_html_()
    for what in (lambda: found.branches, found.plot_campbell):
        with pytest.raises(rondo.Error, match="single spins only.*--spins"):
            what()
    assert over.has_branches and len(over.table["mode"]) > 0
    (tmp_path / "own" / "modes.csv").write_text("mode\nx\n")
    with pytest.raises(rondo.Error, match="modes.csv: cannot be read"):
        rondo.open_modes(tmp_path / "own").table


def test_a_single_spin_in_pandas(modes: pathlib.Path, tmp_path: pathlib.Path) -> None:
    pytest.importorskip("pandas")
    frame = rondo.modes(modes.parent / "case.toml", tmp_path / "own", spins=[0.0], count=4).to_pandas()
    assert list(frame["mode"]) == [1, 2, 3, 4, 5] and frame.attrs["units"]["frequency_hz"] == "Hz"


def test_damaged(tmp_path: pathlib.Path) -> None:
    (tmp_path / "modes.json").write_text("{}")
    header = "spin_rad_s,nodal_diameters,wave,order,frequency_rad_s,frequency_fixed_rad_s\n"
    for text, said in (("a,b\n1,2\n", "cannot be read"), (header, "no frequency"),
                       (header + "1,2,forward,1,x,1\n", "cannot be read")):
        (tmp_path / "campbell.csv").write_text(text)
        with pytest.raises(rondo.Error, match=said):
            rondo.open_modes(tmp_path)

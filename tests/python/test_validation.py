# SPDX-License-Identifier: BSD-3-Clause
"""A validation of reduced runs, made by the built program, read and drawn."""
import json
import pathlib
import shutil
import subprocess
import sys

import matplotlib.pyplot as plt
import numpy as np
import pytest
from drawn import check_files, without_unit
from program import SMALL, replaced, run

import rondo
from rondo import style
from rondo.plots.validation import ERRORS, LEAST
from rondo.studies.validate import validate

TEXT = replaced(SMALL, "circumferential", "circumferential = 60")


@pytest.fixture(autouse=True)
def closed() -> None:
    plt.close("all")


@pytest.fixture(scope="module")
def directory(tmp_path_factory: pytest.TempPathFactory) -> pathlib.Path:
    folder = tmp_path_factory.mktemp("validation")
    (folder / "case.toml").write_text(replaced(TEXT, "snapshots", "snapshots = 41"))
    pairs = []
    for friction in ("0.2", "0.3"):
        pairs.append((folder / f"reduced-{friction}", folder / friction))
        setting = ("--set", f"ground.friction={friction}")
        made("run", folder / "case.toml", "-o", pairs[-1][1], *setting)
        made("run", folder / "case.toml", "-o", pairs[-1][0], *setting, "--reduced", "--modes", "20")
    validate(pairs, folder / "validation")
    return folder / "validation"


def made(*arguments: object) -> None:
    done = run(*arguments, "--quiet")
    assert done.returncode == 0, done.stderr


@pytest.fixture
def copy(directory: pathlib.Path, tmp_path: pathlib.Path) -> pathlib.Path:
    shutil.copytree(directory.parent / "reduced-0.3", tmp_path / "reduced-0.3")
    return pathlib.Path(shutil.copytree(directory, tmp_path / "copy"))


def test_reading(directory: pathlib.Path) -> None:
    found = rondo.open_validation(directory)
    assert found.names == ["0.2", "0.3"]
    assert "0.2, 0.3" in repr(found)
    assert found.units["force_y_full_n_m"] == "N/m" and found.units["force_y_error"] == "1"
    assert found["force_y_error"].shape == (2,)
    row = found.row("0.3")
    assert row["force_y_error"] == found["force_y_error"][1]
    assert row["force_y_error"] == pytest.approx(
        row["force_y_reduced_n_m"] / row["force_y_full_n_m"] - 1, abs=1e-12)
    prediction = found.prediction("0.3")
    assert prediction.info["wheel_modes"] in (20, 21)
    assert prediction.history.mean("force_y", row["from_s"], row["to_s"]) == pytest.approx(
        row["force_y_reduced_n_m"], rel=1e-12)
    profiles = found.profiles("0.3")
    assert profiles is not None
    assert len(profiles["angle_rad"]) == 60 and profiles["pressure_full_pa"].max() > 1e5
    for name, wrong in (("0.4", found.row), ("force_z", found.__getitem__)):
        with pytest.raises(rondo.UnknownNameError, match=name):
            wrong(name)


def test_what_is_drawn(directory: pathlib.Path) -> None:
    found = rondo.open_validation(directory)
    figure = found.plot()
    *panels, bars = figure.axes
    assert [ax.get_title("left") for ax in figure.axes] == ["(a) 0.2", "(b) 0.3", "(c)"]
    assert without_unit(figure) == ["axes 2, y: ''"]  # names of errors
    factor = {"mean traction (MPa)": 1e-6, "mean traction (kPa)": 1e-3}[panels[0].get_ylabel()]
    for ax, name in zip(panels, found.names):
        profiles = found.profiles(name)
        assert profiles is not None
        for line in ax.lines:
            quantity, _, side = str(line.get_label()).partition(", ")
            if not side:
                continue  # the level of zero
            assert np.allclose(line.get_xdata(), np.degrees(profiles["angle_rad"]))
            assert np.allclose(line.get_ydata(), factor * profiles[f"{quantity}_{side}_pa"])
            pressed = profiles["pressure_full_pa"] > 0.1 * profiles["pressure_full_pa"].max()
            shown = np.degrees(profiles["angle_rad"])[pressed]
            assert ax.get_xlim()[0] < shown.min() and shown.max() < ax.get_xlim()[1]
        assert len(ax.lines) == 5
    for name, container in zip(found.names, bars.containers):
        assert container.get_label() == name
        ends = [bar.get_x() + bar.get_width() for bar in container]
        wanted = [max(100 * abs(found.row(name)[column]), LEAST) for column in ERRORS]
        assert np.allclose(ends, wanted)
    assert [label.get_text() for label in bars.get_yticklabels()] == list(ERRORS.values())
    assert bars.get_ylim()[0] > bars.get_ylim()[1]  # the first at the top


def test_some_of_the_runs(directory: pathlib.Path) -> None:
    figure = rondo.open_validation(directory).plot(["0.3"])
    assert [ax.get_title("left") for ax in figure.axes] == ["(a) 0.3", "(b)"]
    with pytest.raises(rondo.Error, match="at most 6"):
        rondo.open_validation(directory).plot(["0.3"] * 7)


def test_predictions_that_failed_and_runs_without_contact(copy: pathlib.Path) -> None:
    header, first, _ = (copy / "validation.csv").read_text().splitlines()
    nothing = ",".join(["0.3"] + ["nan"] * header.count(","))
    (copy / "validation.csv").write_text("\n".join([header, first, nothing]) + "\n")
    info = json.loads((copy / "validation.json").read_text())
    for entry in info["runs"]:
        entry["profiles"] = False
    (copy / "validation.json").write_text(json.dumps(info))
    found = rondo.open_validation(copy)
    assert found.profiles("0.2") is None
    bars, = found.plot().axes
    assert [len(container) for container in bars.containers] == [len(ERRORS), 0]


def test_command(directory: pathlib.Path, tmp_path: pathlib.Path) -> None:
    def command(*arguments: object) -> "subprocess.CompletedProcess[str]":
        return subprocess.run([sys.executable, "-m", "rondo", "validation", *map(str, arguments)],
                              text=True, capture_output=True, timeout=120)

    done = command(directory, "-o", tmp_path, "--run", "0.2")
    assert (done.returncode, done.stderr) == (0, "")
    png, svg = (tmp_path / f"validation{ending}" for ending in (".png", ".svg"))
    assert done.stdout.splitlines() == [str(png), str(svg)]
    check_files(png, svg, style.PAGE, style.DPI)
    assert "(a) 0.2" in svg.read_text() and "(b) 0.3" not in svg.read_text()
    done = command(directory.parent)
    assert done.returncode == 2
    assert "has no validation.json; it holds validation" in done.stderr
    done = command(directory.parent / "0.2")
    assert done.returncode == 2
    assert "is a run, not a validation" in done.stderr


def test_of_an_earlier_version(copy: pathlib.Path) -> None:
    """It has columns for what the modes of a model left out, and names the model."""
    path = copy / "validation.csv"
    header, *rows = path.read_text().splitlines()
    path.write_text("\n".join([f"{header},displacement_left", *(f"{row},0.001" for row in rows)]) + "\n")
    info = json.loads((copy / "validation.json").read_text())
    info["units"]["displacement_left"] = "1"
    (copy / "validation.json").write_text(json.dumps({**info, "model": "model.h5"}))
    found = rondo.open_validation(copy)
    assert found["displacement_left"].tolist() == [0.001, 0.001]
    assert len(found.plot().axes) == 3


@pytest.mark.parametrize("change, said", [
    (lambda text: text.replace("run,", "name,", 1), "damaged"),
    (lambda text: text.replace(",", ",x", 40), "cannot be read"),
    (lambda text: text.rpartition(",")[0] + "\n", "damaged"),
    (lambda text: text.replace("0.3,", "0.4,", 1), "not of one validation"),
    (lambda text: "", "damaged"),
])
def test_damaged(copy: pathlib.Path, change, said: str) -> None:
    path = copy / "validation.csv"
    path.write_text(change(path.read_text()))
    with pytest.raises(rondo.Error, match=said):
        rondo.open_validation(copy)


def test_newer_and_missing(copy: pathlib.Path) -> None:
    path = copy / "validation.json"
    info = json.loads(path.read_text())
    path.write_text(json.dumps({**info, "format": "rondo validation 2"}))
    with pytest.raises(rondo.NewerSchemaError):
        rondo.open_validation(copy)
    path.write_text(json.dumps({**info, "runs": 3}))
    with pytest.raises(rondo.Error, match="damaged"):
        rondo.open_validation(copy)
    (copy / "validation.csv").unlink()
    with pytest.raises(rondo.NotARunError, match="no validation.csv"):
        rondo.open_validation(copy)

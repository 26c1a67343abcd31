# SPDX-License-Identifier: BSD-3-Clause
"""rondo validate: its figures against those computed here from the two results
directories, wrong input; what it measures with, on data made by hand."""
import csv
import json
import math
import pathlib
import subprocess
import sys
from types import SimpleNamespace

import h5py
import numpy as np
import pytest
from program import ROOT, SMALL, history, replaced, run, summary

from rondo.data.errors import Error
from rondo.studies.validate import _names
from rondo.studies.validate_measures import (Field, Window, mean_profile, profile_error, share_of)

TEXT = SMALL
for key, line in (("radial", "radial = 8"), ("circumferential", "circumferential = 120"),
                  ("end", "end = 0.04"), ("snapshots", "snapshots = 161")):
    TEXT = replaced(TEXT, key, line)


def rectified(directory, field):
    """(times (t,), fields (t, n) x + iy in the fixed frame, masses (n,)), rings in turn."""
    with h5py.File(directory / "results.h5") as f:
        sector, within = f["mesh/sector"][:], f["mesh/sector_node"][:]
        order, n = np.lexsort((sector, within)), sector.max() + 1
        end = "" if field == "displacement" else "_velocity"
        time, angle = f["frame/time" + end][:], f["frame/angle" + end][:]
        values = f["snapshots/" + field][:][:, order] @ np.array([1, 1j])
        mass = f["mesh/mass"][:][order]
    polar = np.exp(2j * np.pi * np.arange(n) / n)  # radial and tangential parts are what moves
    k = np.fft.fftfreq(n, 1 / n)
    turned = np.exp(-1j * k * angle[:, None])
    turned[:, abs(k) == n / 2] = 1  # the highest stays where it is (docs/theory.md, 7.3)
    rings = np.fft.fft(values.reshape(len(time), -1, n) / polar, axis=2) * turned[:, None]
    moved = (np.fft.ifft(rings, axis=2) * polar).reshape(len(time), -1)
    return time, moved, mass


def field_errors(full, reduced, field, window):
    """(error, error of the means, snapshots compared)."""
    time, values, mass = rectified(full, field)
    known, theirs, _ = rectified(reduced, field)
    inside = (time >= window[0]) & (time <= window[1])

    def norm(fields):
        return np.sqrt(np.sum(mass * abs(fields) ** 2))

    both = inside & (time >= known[0]) & (time <= known[-1])
    a = values[both]
    b = np.stack([np.interp(time[both], known, part) for part in theirs.real.T], axis=1) + 1j * \
        np.stack([np.interp(time[both], known, part) for part in theirs.imag.T], axis=1)
    means = norm(b.mean(axis=0) - a.mean(axis=0)) / norm(a.mean(axis=0))
    return norm(b - a) / norm(a), means, len(a)


def profile(directory, window):
    """(angles (m,), pressure, shear): each force shared by the two places next to its node."""
    with h5py.File(directory / "results.h5") as f:
        x = f["mesh/coordinates"][:][f["mesh/boundary"][:]]
        length = f["mesh/tributary"][:].sum()
        time, theta = f["frame/time"][:], f["frame/angle"][:]
        inside = (time >= window[0]) & (time <= window[1])
        force, theta = f["contact/force"][:][inside], theta[inside]
    n = len(x)
    pitch = 2 * np.pi / n
    place = (np.arange(n) - n // 2) * pitch
    stands = np.arctan2(x[:, 0], -x[:, 1]) + theta[:, None]  # (t, nb)
    away = stands[:, :, None] - place
    away = (away + np.pi) % (2 * np.pi) - np.pi
    share = np.maximum(0, 1 - abs(away) / pitch)
    mean = np.einsum("tip,tix->px", share, force) / len(theta) / (length / n)
    return place, mean[:, 0], mean[:, 1]


def means(directory, window):
    """Of the history: means and fluctuations of the forces, power of friction."""
    h = history(directory)
    begin = np.concatenate([[0], h["time_s"][:-1]])
    rows = np.flatnonzero((begin >= window[0]) & (h["time_s"] <= window[1] * (1 + 1e-12)))
    span = (h["time_s"] - begin)[rows]
    found = {}
    for name in ("force_x", "force_y"):
        found[name] = np.average(h[name][rows], weights=span)
        found[name + "_fluctuation"] = np.sqrt(
            np.average((h[name][rows] - found[name]) ** 2, weights=span))
    lost = h["dissipation_friction"]
    found["friction_power"] = (lost[rows[-1]] - lost[rows[0] - 1]) / span.sum()
    return found


def table(folder):
    with open(folder / "validation.csv", newline="") as file:
        return {row["run"]: {name: float(text) for name, text in row.items() if name != "run"}
                for row in csv.DictReader(file)}


def made(*arguments):
    done = run(*arguments, "--quiet")
    assert done.returncode == 0, done.stderr


def validate(*arguments):
    return subprocess.run([sys.executable, "-m", "rondo", "validate", *map(str, arguments)],
                          capture_output=True, text=True, timeout=120)


@pytest.fixture(scope="module")
def shared(tmp_path_factory):
    """Full runs, and predictions of two."""
    folder = tmp_path_factory.mktemp("validate")
    case = folder / "case.toml"
    case.write_text(TEXT)
    for friction in ("0.2", "0.3"):
        setting = ("--set", f"ground.friction={friction}")
        made("run", case, "-o", folder / friction, *setting)
        made("run", case, "-o", folder / f"reduced-{friction}", *setting, "--reduced")
    return folder


@pytest.mark.parametrize("options", [(), ("--from", 0.012, "--to", 0.026)])
def test_figures_are_those_of_the_two_runs(shared, tmp_path, options):
    full, reduced, out = shared / "0.3", shared / "reduced-0.3", tmp_path / "out"
    done = validate(reduced, full, "-o", out, *options)
    assert done.returncode == 0 and "warning" not in done.stderr, done.stderr
    row = table(out)["0.3"]
    with h5py.File(full / "results.h5") as file:
        end = 0.026 if options else file["frame/time"][-1]
    window = (0.012 if options else 0.75 * end, end)
    assert (row["from_s"], row["to_s"]) == window
    expected = {}
    for field in ("displacement", "velocity"):
        error, mean_error, count = field_errors(full, reduced, field, window)
        expected |= {f"{field}_error": error, f"{field}_mean_error": mean_error}
        assert count >= row["snapshots"]
    place, *theirs = profile(full, window)
    _, *ours = profile(reduced, window)
    size = np.linalg.norm(theirs[0])
    expected |= {f"{name}_error": np.linalg.norm(b - a) / size
                 for name, a, b in zip(("pressure", "shear"), theirs, ours)}
    sides = {"full": means(full, window), "reduced": means(reduced, window)}
    for side, found in sides.items():
        expected |= {f"{name}_{side}_{'w_m' if name == 'friction_power' else 'n_m'}": value
                     for name, value in found.items()}
    load = sides["full"]["force_y"]
    expected |= {f"{name}_error": (sides["reduced"][name] - sides["full"][name]) / load
                 for name in ("force_x", "force_y")}
    a, b = (sides[side]["force_x"] for side in ("full", "reduced"))
    expected["force_x_own_error"] = (b - a) / abs(a)
    expected["shear_own_error"] = (np.linalg.norm(ours[1] - theirs[1]) / np.linalg.norm(theirs[1]))
    a, b = (sides[side]["friction_power"] for side in ("full", "reduced"))
    expected["friction_error"] = (b - a) / a
    for name, value in expected.items():
        # Sums of some 10^5 terms in another order.
        assert row[name] == pytest.approx(value, rel=1e-8), name
    with open(out / "0.3" / "profiles.csv", newline="") as file:
        rows = np.array(list(csv.reader(file))[1:], dtype=float).T
    for found, wanted in zip(rows, (place, theirs[0], ours[0], theirs[1], ours[1])):
        np.testing.assert_allclose(found, wanted, atol=1e-10 * abs(wanted).max())
    j, k = summary(full), summary(reduced)
    for name, key in (("steps", "steps_done"), ("threads", "threads")):
        assert (row[name + "_full"], row[name + "_reduced"]) == (j[key], k[key])
    assert row["speed_up"] == j["loop_wall_s"] / k["loop_wall_s"]
    assert row["same_host"] == 1
    assert abs(row["force_y_error"]) < 0.02 and abs(row["friction_error"]) < 0.05  # five nodes in contact
    assert row["displacement_error"] < 0.08  # early in the run the step of the wheel is seen
    assert f"{100 * row['velocity_error']:.2f} %" in done.stdout
    for words, column in (("F_x, over itself", "force_x_own_error"), ("friction, dissipated ", "friction_error")):
        line = next(line for line in done.stdout.splitlines() if words in line)
        assert f" {100 * row[column]:.2f} %" in line
    record = json.loads((out / "validation.json").read_text())
    assert record["format"] == "rondo validation 1" and record["status"] == "done"
    assert set(record["units"]) == set(row)
    assert [(r["name"], r["wheel_modes"], r["wheel_basis"], r["wheel_file"]) for r in record["runs"]] == [
        ("0.3", k["wheel_modes"], "eigenmodes", None)]


def test_two_runs_and_an_option_of_earlier_versions(shared, tmp_path):
    pairs = [shared / name for name in ("reduced-0.2", "0.2", "reduced-0.3", "0.3")]
    for _ in range(2):  # the second replaces what the first made
        done = validate(*pairs, "-o", tmp_path, "--model", tmp_path / "none.h5")
        assert done.returncode == 0, done.stderr
    assert done.stderr == "rondo: warning: --model is ignored: a reduced run needs no model now\n"
    assert list(table(tmp_path)) == ["0.2", "0.3"]
    assert "--model" not in validate("--help").stdout


def test_without_contact(tmp_path):
    """What stays in the air has no profile, and forces to relate to."""
    case = tmp_path / "case.toml"
    case.write_text(replaced(TEXT, "height", "height = 0.4"))
    made("run", case, "-o", tmp_path / "full")
    made("run", case, "-o", tmp_path / "reduced", "--reduced")
    done = validate(tmp_path / "reduced", tmp_path / "full")
    assert done.returncode == 0, done.stderr
    row = table(tmp_path / "reduced-validation")["full"]
    for name in ("pressure_error", "shear_error", "force_y_error", "force_x_own_error", "friction_error"):
        assert math.isnan(row[name]), name
    assert row["displacement_error"] > 0
    assert "  F_y                 " in done.stdout and " -\n" in done.stdout


def test_a_mesh_without_equal_sectors(tmp_path):
    """Forces are compared; fields are not, as there are no sectors to turn them by."""
    case = ROOT / "cases" / "rolling-spokes.toml"
    short = ("--set", "time.end=0.03", "--set", "output.snapshots=20")
    made("run", case, "-o", tmp_path / "full", *short)
    made("run", case, "-o", tmp_path / "reduced", *short, "--reduced")
    done = validate(tmp_path / "reduced", tmp_path / "full")
    assert done.returncode == 0, done.stderr
    row = table(tmp_path / "reduced-validation")["full"]
    assert math.isnan(row["displacement_error"]) and row["snapshots"] == 0
    assert abs(row["force_y_error"]) < 0.1 and row["pressure_error"] < 0.5


def test_refuses(shared, tmp_path):
    case, full, reduced = shared / "case.toml", shared / "0.3", shared / "reduced-0.3"

    def fails(said, *arguments):
        done = validate(*arguments, "-o", tmp_path / "out")
        assert (done.returncode, done.stdout) == (2, ""), done.stderr
        assert said in done.stderr
        assert not (tmp_path / "out").exists()

    def full_run(name, *settings):
        made("run", case, "-o", tmp_path / name, *(x for s in settings for x in ("--set", s)))
        return tmp_path / name

    with h5py.File(full / "results.h5") as file:
        at = file["frame/time"][120]
    fails("mesh", reduced, full_run("mesh", "disk.mesh.radial=3"))
    fails("mesh", reduced, full_run("soft", "material.density=1000"))
    fails("ground.friction = 0.3 against 0.2", reduced, shared / "0.2")
    fails("0 snapshots", reduced, full_run("blind", "output.snapshots=0"))
    fails("a crush does not roll", reduced,
          full_run("crush", "analysis.kind=crush", "analysis.depth=0.004", "analysis.increments=4"))
    cut = full_run("cut")
    (cut / "run.json").write_text(json.dumps({**summary(cut), "status": "interrupted"}))
    fails("not finished (status interrupted)", reduced, cut)
    fails("is a reduced run itself", reduced, reduced)
    fails("is no run of a reduced wheel", full, reduced)
    before = full_run("before")  # a reduced run of an earlier version
    (before / "run.json").write_text(json.dumps({**summary(before), "reduced_modes": 60}))
    fails("is a reduced run itself", reduced, before)
    fails("is no run of a reduced wheel", before, full)
    fails("after each reduced run", reduced)
    fails("named twice", reduced, full, reduced, full)
    fails("nowhere", reduced, tmp_path / "nowhere")
    fails("no snapshot", reduced, full, "--from", 1)
    fails("no row lies in the window", reduced, full, "--from", at - 1e-6, "--to", at + 1e-6)
    done = validate(reduced, full, "-o", full)
    assert done.returncode == 2 and "holds a run" in done.stderr


# What it measures with


def test_shares_of_nothing_are_no_numbers():
    assert share_of(1.0, -4.0) == -0.25
    assert math.isnan(share_of(0.0, 0.0))


def test_names_are_unique():
    paths = [pathlib.Path(text) for text in ("/a/0.3", "/b/0.3", "/b/0.3/", "/c/x")]
    assert _names(paths) == ["0.3", "0.3-2", "0.3-3", "x"]


@pytest.mark.parametrize("columns", [12, 13])
def test_forces_stand_at_their_angle_in_space(columns):
    pitch = 2 * np.pi / columns
    around = np.arange(columns) * pitch
    mesh = SimpleNamespace(coordinates=np.stack([np.sin(around), -np.cos(around)], axis=1),
                           boundary=np.arange(columns), tributary=np.full(columns, 0.1))
    force = np.zeros((3, columns, 2))
    force[:, 0] = 6.0, -2.0  # straight down in the turning frame
    # Two places to the right exactly, a quarter of a place to the left, up.
    angle = np.array([2.0 * pitch, -2 * np.pi - 0.25 * pitch, np.pi])
    made_up = SimpleNamespace(mesh=mesh, times=np.array([1.0, 2.0, 3.0]), angle=angle,
                              contact=SimpleNamespace(force=force))
    place, pressure, shear = mean_profile(made_up, Window(0.0, 5.0))
    np.testing.assert_allclose(np.diff(place), pitch, atol=1e-13)
    assert -np.pi - 1e-13 <= place[0] and place[-1] < np.pi

    def at(angle):
        return int(np.argmin(abs(place - angle)))

    unit = 1.0 / 3.0 / 0.1  # three snapshots; force by length of a place
    assert pressure[at(2 * pitch)] / unit == pytest.approx(6.0)
    assert shear[at(2 * pitch)] / unit == pytest.approx(-2.0)
    assert pressure[at(0)] / unit == pytest.approx(4.5)
    assert pressure[at(-pitch)] / unit == pytest.approx(1.5)
    assert shear[at(-pitch)] / unit == pytest.approx(-0.5)
    assert pressure.sum() * 0.1 == pytest.approx(6.0)  # the integral is the mean force
    assert mean_profile(made_up, Window(4.0, 5.0)) is None


def test_errors_of_profiles_are_by_the_one_named():
    full, reduced, pressure = np.array([[3.0, 0, 4], [3, 2, 4], [0, 8, 0]])
    assert profile_error(full, reduced, full) == pytest.approx(0.4)
    assert profile_error(full, reduced, pressure) == pytest.approx(0.25)


def test_between_two_snapshots_on_a_line(shared):
    import rondo

    field = Field(rondo.open(shared / "0.3"), "displacement")
    t = field.time
    whole = field.fixed(slice(0, 4))
    found = field.at(np.array([t[0], 0.25 * t[1] + 0.75 * t[2], t[3]]))
    np.testing.assert_allclose(found, [whole[0], 0.25 * whole[1] + 0.75 * whole[2], whole[3]],
                               atol=1e-9 * abs(whole).max())
    np.testing.assert_array_equal(field.at(t[-1:])[0], field.fixed(slice(len(t) - 1, None))[0])
    with pytest.raises(Error, match="no equal sectors"):
        Field(SimpleNamespace(times=t, angle=t, field=lambda name: None, directory="x",
                              mesh=SimpleNamespace(sector=None, sector_node=None)), "displacement")

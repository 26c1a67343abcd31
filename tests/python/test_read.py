# SPDX-License-Identifier: BSD-3-Clause
"""Runs and PODs as read by the package, against their files read directly."""
import csv
import json
import pathlib
import warnings

import h5py
import numpy as np
import pytest
from conftest import of_modes

import rondo

ROOT = pathlib.Path(__file__).resolve().parents[2]


def results(directory):
    return h5py.File(directory / "results.h5", "r")


@pytest.fixture(params=["smooth", "treaded", "crush", "air"])
def any_run(request, runs):
    return rondo.open(runs / request.param)


def test_times_angles_and_mesh(any_run):
    with results(any_run.directory) as file:
        for name, got in (("time", any_run.times), ("time_velocity", any_run.times_velocity),
                          ("angle", any_run.angle), ("angle_velocity", any_run.angle_velocity),
                          ("center", any_run.center)):
            np.testing.assert_array_equal(got, file[f"frame/{name}"][:])
        for name in ("coordinates", "cells", "boundary", "tributary", "mass", "sector",
                     "sector_node"):
            np.testing.assert_array_equal(getattr(any_run.mesh, name), file[f"mesh/{name}"][:])
        assert any_run.n_snapshots == len(file["frame/time"])
        assert any_run.mesh.n_nodes == len(file["mesh/mass"])
        assert any_run.mesh.n_cells == len(file["mesh/cells"])


def test_fields(any_run):
    stress = ("stress_xx", "stress_xy", "stress_xz", "stress_yy", "stress_yz", "stress_zz")
    with results(any_run.directory) as file:
        expected = {"displacement": file["snapshots/displacement"][:],
                    "velocity": file["snapshots/velocity"][:]}
        expected |= {name: file[f"fields/{name}"][:] for name in file["fields"]
                     if name not in expected}
        expected |= {name: file["fields/cauchy_stress"][:, :, k] for k, name in enumerate(stress)}
        turned = file["fields/velocity"][:]
    assert any_run.field_names == sorted(expected)
    for name, values in expected.items():
        field = any_run.field(name)
        assert field.shape == values.shape
        np.testing.assert_array_equal(field[:], values)
    assert any_run.field("stress_xy").units == "Pa"
    np.testing.assert_array_equal(any_run.field("fields/velocity")[:], turned)
    np.testing.assert_array_equal(any_run.velocity[2], expected["velocity"][2])
    np.testing.assert_array_equal(any_run.displacement[-1], expected["displacement"][-1])


def test_snapshots_of_modes_of_an_earlier_version(copy):
    of_modes(copy)
    run = rondo.open(copy)
    assert run.field_names == [] and run.contact is not None and len(run.history["force_y"])
    for read in (lambda: run.displacement, lambda: run.field("von_mises"), lambda: run.position(0)):
        with pytest.raises(rondo.Error, match="was written with --snapshots modes of an earlier version: run "
                                              "the case again"):
            read()


def test_position_is_that_of_the_pictures(any_run):
    for k in (0, 3, -1):
        with results(any_run.directory) as file:
            expected = file["fields/position"][k, :, :2]  # single precision
        np.testing.assert_allclose(any_run.position(k), expected, rtol=0, atol=1e-7)


def test_contact(smooth, crush, air):
    for directory in (smooth, crush):
        contact = rondo.open(directory).contact
        with results(directory) as file:
            np.testing.assert_array_equal(contact.force[:], file["contact/force"][:])
            np.testing.assert_array_equal(contact.traction[:], file["contact/traction"][:])
            np.testing.assert_array_equal(contact.nodes, file["mesh/boundary"][:])
        with open(directory / "contact.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        assert list(contact.rows) == list(rows[0])
        for name, column in contact.rows.items():
            np.testing.assert_array_equal(column, [float(row[name]) for row in rows])
    assert rondo.open(air).contact is None


def test_history(any_run):
    with open(any_run.directory / "history.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert any_run.history.names == list(any_run.history) == list(rows[0])
    assert len(any_run.history) == len(rows[0])
    for name, column in any_run.history.items():
        np.testing.assert_array_equal(column, [float(row[name]) for row in rows])
    for known, alike in (("time_s", "time"), ("center_x_m", "center_x"), ("angle_rad", "angle")):
        assert any_run.history[alike] is any_run.history[known]
        assert any_run.history.unit_of(alike) == any_run.history.units[known]


def test_every_column_has_its_unit(any_run):
    units = any_run.history.units
    assert sorted(units) == sorted(any_run.history)
    assert units["time_s"] == any_run.time_unit == ("1" if any_run.is_crush else "s")
    assert (units["force_y"], units["torque"], units["strain"]) == ("N/m", "N·m/m", "J/m")
    for name in ("angle_rad", "center_x_m", "penetration_max_m"):
        assert name.endswith("_" + units[name])


def test_units_are_those_of_the_run(any_run):
    said = {column["name"]: column["unit"] for column in any_run.info["columns"]}
    assert list(said) == any_run.history.names
    assert any_run.history.units == said


def without_columns(directory):
    """As runs of earlier versions are."""
    info = json.loads((directory / "run.json").read_text())
    del info["columns"]
    (directory / "run.json").write_text(json.dumps(info))


def test_units_of_a_run_of_an_earlier_version(copy):
    said = rondo.open(copy).history.units
    without_columns(copy)
    units = rondo.open(copy).history.units
    assert {"time_s", "angle_rad", "center_x_m", "penetration_max_m"} <= set(units)
    assert "force_y" not in units
    assert units == {name: said[name] for name in units}


def test_columns_that_are_damaged(copy):
    info = json.loads((copy / "run.json").read_text()) | {"columns": [{"name": "time_s"}]}
    (copy / "run.json").write_text(json.dumps(info))
    with pytest.raises(rondo.Error, match="run.json: damaged: its columns: KeyError"):
        rondo.open(copy).history  # noqa: B018


def test_means_are_weighted_by_intervals(copy):
    (copy / "history.csv").write_text("time_s,force_y\n1,100\n2,1\n4,2\n5,3\n9,4\n10,100\n")
    info = json.loads((copy / "run.json").read_text()) | {"end_time": 10}
    (copy / "run.json").write_text(json.dumps(info))
    history = rondo.open(copy).history
    assert history.mean("force_y", 1, 9) == (1 * 1 + 2 * 2 + 1 * 3 + 4 * 4) / 8
    assert history.mean("force_y", 1.5, 8.9) == (2 * 2 + 1 * 3) / 3  # whole intervals
    assert history.mean("force_y") == (100 + 1 + 4 + 3 + 16 + 100) / 10


def test_figures_of_the_case(smooth, treaded, crush, air):
    run = rondo.open(smooth)
    assert (run.title, run.status) == ("small", "done")
    assert (run.analysis, run.is_crush) == ("dynamic", False)
    assert (run.outer_radius, run.inner_radius, run.friction) == (0.3, 0.15, 0.3)
    assert (run.pitches, run.pitch_frequency, run.spin) == (0, None, 33.333333)
    assert run.case["time"]["end"] == 0.02
    assert run.info == json.loads((smooth / "run.json").read_text())
    assert rondo.open(str(treaded)).pitches == 12
    assert rondo.open(treaded).pitch_frequency == 12 * 33.333333 / (2 * np.pi)
    assert (rondo.open(crush).spin, rondo.open(crush).is_crush) == (0.0, True)
    assert rondo.open(air).friction is None


def test_spin_is_that_at_the_end(copy):
    text = (copy / "case.toml").read_text()
    table = "[[0.0, 0.0], [0.01, 10.0], [0.03, 30.0]]"
    (copy / "case.toml").write_text(text.replace("angular_velocity = 33.333333",
                                                 f"angular_velocity = {table}"))
    assert rondo.open(copy).spin == pytest.approx(20.0)


def test_curves_of_a_crush(crush, smooth):
    run = rondo.open(crush)
    with results(crush) as file:
        for name in ("depth", "force", "contact_length", "pressure_max"):
            np.testing.assert_array_equal(getattr(run.crush, name), file[f"crush/{name}"][:])
    np.testing.assert_array_equal(run.crush.depth, run.history["depth_m"][1:])
    assert rondo.open(smooth).crush is None


def test_index_is_the_nearest_snapshot(smooth):
    run = rondo.open(smooth)
    middle = 0.5 * (run.times[3] + run.times[4])
    assert run.index(middle - 1e-9) == 3
    assert run.index(middle + 1e-9) == 4
    assert run.index(run.times[-1] + 1e-4) == run.n_snapshots - 1
    for time in (-1.0, 0.05):
        with pytest.raises(rondo.Error, match="no snapshot near .* from 0.* to 0.02.* s"):
            run.index(time)


def test_position_reads_one_snapshot(smooth, monkeypatch):
    run = rondo.open(smooth)
    read = []
    original = h5py.Dataset.__getitem__

    def counted(self, key, **options):
        found = original(self, key, **options)
        read.append((self.name, np.asarray(found).nbytes))
        return found

    monkeypatch.setattr(h5py.Dataset, "__getitem__", counted)
    run.position(3)
    assert read == [("/snapshots/displacement", run.mesh.n_nodes * 2 * 8)]
    read.clear()
    rondo.open(smooth)
    assert {name.split("/")[1] for name, _ in read} == {"mesh", "frame"}


def test_pod_arrays(smooth):
    run = rondo.open(smooth)
    assert sorted(run.pods) == ["contact-rotating", "displacement-rotating", "velocity-rectified"]
    for name, pod in run.pods.items():
        with h5py.File(smooth / "pod" / name / "pod.h5") as file:
            for place in ("modes/spatial", "modes/temporal", "modes/coefficients",
                          "spectrum/singular_value", "spectrum/energy",
                          "spectrum/cumulative_energy", "spectrum/discarded_energy",
                          "snapshots/time", "snapshots/angle", "snapshots/run"):
                np.testing.assert_array_equal(getattr(pod, place.split("/")[1]), file[place][:])
            np.testing.assert_array_equal(pod.weights, file["weight"][:])
            np.testing.assert_array_equal(pod.mesh.coordinates, file["mesh/coordinates"][:])
            assert (pod.weight, pod.frame) == (file.attrs["weight"], file.attrs["frame"])
            assert name == pod.name == f"{file.attrs['quantity']}-{pod.frame}"
        assert pod.n_modes == len(pod.spatial) == 3
        assert len(pod.points) == pod.spatial.shape[1]
        assert pod.modes_for == {float(k): v for k, v in pod.info["modes_for"].items()}
    assert run.pods["contact-rotating"].points is run.pods["contact-rotating"].mesh.boundary
    assert run.pod("velocity", "rectified") is run.pods["velocity-rectified"]
    assert run.pods["velocity-rectified"].unit == "m/s"
    with pytest.warns(DeprecationWarning, match="co-rotating") as said:
        assert run.pod("contact", "rotating") is run.pods["contact-rotating"]
    assert [warning.filename for warning in said] == [__file__]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert run.pod("contact", "co-rotating") is run.pods["contact-rotating"]


def test_a_snapshot_from_its_modes(smooth):
    pod = rondo.open_pod(smooth / "pod" / "displacement-rotating")
    snapshots = rondo.open(smooth).displacement[:]
    with h5py.File(pod.path) as file:
        errors = file["snapshots/error"][:]
    for k in (2, 10):
        norm = np.sum(pod.weights[:, None] * snapshots[k] ** 2)
        rest = np.sum(pod.weights[:, None] * (snapshots[k] - pod.reconstruct(k)) ** 2)
        assert np.sqrt(rest / norm) == pytest.approx(errors[k], rel=1e-6)
    np.testing.assert_array_equal(pod.reconstruct(2, modes=0), 0)
    first = pod.coefficients[2, 0] * pod.spatial[0]
    np.testing.assert_allclose(pod.reconstruct(2, modes=1), first, rtol=1e-14)


def test_a_paper_study(runs, tmp_path):
    entry = {"name": "turn", "directory": str(runs / "smooth"), "status": "done"}
    row = {"figure": 2, "name": "a", "ours": 1.0, "expected": 1.0, "pass": True}
    (tmp_path / "paper.json").write_text(json.dumps(
        {"format": "rondo paper 1", "status": "done", "quick": True, "runs": [entry],
         "pods": [], "table": [row]}))
    paper = rondo.open_paper(tmp_path)
    assert (paper.quick, paper.status, paper.table) == (True, "done", [row])
    assert paper.row("a") == row
    assert paper.run("turn").title == "small"
    assert paper.run("turn") is paper.run("turn")
    assert paper.pod("turn", "velocity", "rectified").field == "velocity"

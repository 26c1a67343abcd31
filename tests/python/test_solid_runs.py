# SPDX-License-Identifier: BSD-3-Clause
"""A wheel in three dimensions as the program runs it, read and drawn: its files mean what Python takes
them for."""
import matplotlib.pyplot as plt
import numpy as np
import pytest
from conftest import ok
from program import run as program
from test_cli import rondo_module
from test_errors import says

import rondo
from rondo.data import solid
from rondo.plots.solid import footprint

CASE = """schema = 1
title = "a small wheel"
[disk]
outer_radius = 0.30
inner_radius = 0.15
width = 0.10
[disk.mesh]
radial = 2
circumferential = 60
axial = 3
[material]
youngs_modulus = 2.0e7
poissons_ratio = 0.3
density = 1100.0
[damping]
mass = 200.0
stiffness = 2.0e-5
[motion]
angular_velocity = 33.76455
speed = 10.0
height = 0.29
slip_angle = 0.03
camber = 0.04
[ground]
profile = "flat"
friction = 0.3
[time]
end = 0.03
[output]
snapshots = 7
history_interval = 0.0
"""
STUDY = """schema = 1
title = "slip angles"
base = "wheel.toml"
[window]
from = 0.02
[[vary]]
key = "motion.slip_angle"
values = [-0.03, 0.0, 0.03]
"""


@pytest.fixture(autouse=True)
def closed_figures():
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The run `out` with a POD, and the sweep `sweep`."""
    folder = tmp_path_factory.mktemp("solid-runs")
    (folder / "wheel.toml").write_text(CASE)
    (folder / "study.toml").write_text(STUDY)
    ok("run", folder / "wheel.toml", "-o", folder / "out")
    ok("pod", folder / "out", "--frame", "rectified", "--from", "0.01", "--modes", 3)
    ok("sweep", folder / "study.toml", "-o", folder / "sweep")
    return folder


@pytest.fixture(scope="module")
def run(folder):
    return rondo.open(folder / "out")


def test_the_mesh_is_a_closed_surface_of_hexahedra(run):
    assert run.is_solid and run.info["dimensions"] == 3
    assert run.mesh.cells.shape == (60 * 2 * 3, 8) and run.mesh.coordinates.shape == (60 * 3 * 4, 3)
    faces = solid.outer_faces(run.mesh.cells)
    a, b, c, d = (run.mesh.coordinates[faces[:, k]] for k in range(4))
    areas = 0.5 * np.cross(c - a, d - b)
    assert np.abs(areas.sum(axis=0)).max() < 1e-15
    volume = np.sum(areas * (a + b + c + d) / 4) / 3  # outward: positive
    assert volume == pytest.approx(0.1 * np.pi * (0.3**2 - 0.15**2), rel=3e-3)
    assert run.mesh.mass.sum() == pytest.approx(1100 * volume, rel=1e-3)
    assert run.mesh.tributary.sum() == pytest.approx(0.1 * 2 * np.pi * 0.3, rel=1e-3)


def test_places_are_those_of_the_program(run):
    for k in (3, 6):
        assert np.allclose(run.position(k), run.field("position")[k], atol=2e-7)  # of float32
        found = footprint.footprint_of(run, k)
        rows = run.contact.rows
        chosen = rows["time_s"] == run.times[k]
        assert chosen.sum() == len(found.node) > 4
        assert np.allclose(found.place[:, 0], rows["x_m"][chosen] - run.center[k][0], atol=1e-12)
        assert np.allclose(found.place[:, 1], rows["z_m"][chosen] - run.lateral[k], atol=1e-12)
        assert np.abs(run.on_ground(k)[found.node, 1]).max() < 5e-4  # on the ground


def test_forces_are_the_sums_of_the_footprint(run):
    history, k = run.history, 6
    found = footprint.footprint_of(run, k)
    rows = run.contact.rows
    there = rows["time_s"] == run.times[k]
    areas = dict(zip(rows["node"][there], rows["area_m2"][there]))
    area = np.array([areas[node] for node in found.node])
    assert history["contact_area_m2"][np.abs(history["time_s"] - run.times[k]).argmin()] == pytest.approx(area.sum())
    row = np.abs(history["time_s"] - run.times[k]).argmin()  # a step each
    normal, along, across = (area @ found.pressure, *(area @ found.shear))
    for name, value in (("force_y", normal), ("force_x", along), ("force_lateral", across)):
        assert history[name][row] == pytest.approx(value, rel=1e-9), name
        assert history.unit_of(name) == "N"
    assert across < 0 < normal and history.unit_of("moment_aligning") == "N·m"
    # Moments about the center's projection on the ground, r × f in the right-handed (t1, n, t2).
    x, z = found.place.T
    aligning = area @ (z * found.shear[:, 0] - x * found.shear[:, 1])
    assert history["moment_aligning"][row] == pytest.approx(aligning, rel=1e-9)
    assert history["moment_overturning"][row] == pytest.approx(
        area @ (run.on_ground(k)[found.node, 1] * found.shear[:, 1] - z * found.pressure), rel=1e-9)
    size = np.linalg.norm(found.shear, axis=1)
    assert (size <= 0.3 * found.pressure * (1 + 1e-9)).all()
    slips = ~found.sticks
    assert np.allclose(size[slips], 0.3 * found.pressure[slips], rtol=1e-9)
    force = np.asarray(run.contact.force[k])
    assert force.shape == (len(run.mesh.boundary), 3) and force[:, 0].sum() == pytest.approx(normal)


@pytest.mark.long
def test_figures(run, tmp_path):
    done = rondo_module("figures", run.directory, "-o", tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    names = {path.name for path in tmp_path.iterdir() if path.suffix == ".png"}
    assert {"field-displacement.png", "field-pressure.png", "footprint.png", "forces.png", "energy.png",
            "force-spectrum.png", "modes-displacement-rectified.png", "pod-spectrum.png"} <= names
    assert run.plot_energy().get_ylabel().endswith("J)")


def test_the_pod(run):
    pod = run.pod("displacement", "rectified")
    assert pod.spatial.shape == (3, run.mesh.n_nodes, 3) and pod.mesh.is_solid
    gram = np.einsum("ipc,p,jpc->ij", pod.spatial, pod.weights, pod.spatial)
    assert np.abs(gram - np.eye(3)).max() < 1e-12
    assert np.allclose(pod.weights, run.mesh.mass)
    # Standing in space, most of it is the first mode; the program's files say so to Python.
    assert pod.energy[0] > 0.9
    figure = pod.plot_modes(2)
    titles = [ax.get_title(loc="left") for ax in figure.axes]
    assert titles[0].startswith("(a) mode 1: 9") and "radial" in titles[0]
    k = 3  # the rest is outside of the modes
    u = pod.reconstruct(k)
    assert u.shape == (run.mesh.n_nodes, 3)
    says(rondo.Error, lambda: rondo.open_pod(pod.directory).plot_modes(0), words=("count = 0",))


def test_the_sweep(folder):
    sweep = rondo.open_sweep(folder / "sweep")
    assert sweep.units["force_lateral_mean"] == "N" and sweep.units["moment_aligning_mean"] == "N·m"
    assert sweep.units["friction_power"] == "W" and sweep.units["trail_m"] == "m"
    lateral = sweep["force_lateral_mean"]
    assert lateral[0] > lateral[1] > lateral[2]
    trail = sweep["moment_aligning_mean"] / lateral
    assert np.allclose(sweep["trail_m"], trail, rtol=1e-12)
    assert np.allclose(sweep["slip_angle_mean"], sweep["motion.slip_angle"], atol=1e-15)
    one = rondo.open(folder / "out").history
    assert lateral[2] == pytest.approx(one.mean("force_lateral", from_time=0.02), rel=1e-3)
    figure = sweep.plot_tyre_curves()
    assert np.allclose(figure.axes[0].lines[0].get_xdata(), np.degrees([-0.03, 0.0, 0.03]))


def test_reduced_wheels_are_plane(folder):
    done = program("reduce", folder / "out", "-o", folder / "wheel.h5")
    assert done.returncode == 2 and "three dimensions" in done.stderr

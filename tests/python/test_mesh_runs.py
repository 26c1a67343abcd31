# SPDX-License-Identifier: BSD-3-Clause
"""Runs of meshes from files and of unconstrained bodies."""
import shutil

import h5py
import numpy as np
import pytest

import rondo
from conftest import ROOT, ok
from rondo.figures.run_figures import draw_run
from rondo.plots import field

CASE = """schema = 1
title = "Two disks"
[mesh]
file = "two-disks.msh"
contact = "tread"
[material]
youngs_modulus = 5e6
poissons_ratio = 0.45
density = 1100
[[material.region]]
surface = "right"
density = 2200
[contact]
between = "bodies"
[ground]
profile = [[-1, -0.15], [1, -0.15]]
[initial]
angular_velocity = 20.0
velocity = [0.0, -1.0]
[[initial.region]]
surface = "left"
velocity = [1.0, -1.0]
[time]
end = 0.1
[output]
snapshots = 6
[[output.probe]]
name = "left"
position = [-0.1005, 0.0]
"""


@pytest.fixture(scope="module")
def thrown(tmp_path_factory):
    folder = tmp_path_factory.mktemp("thrown")
    shutil.copy(ROOT / "cases" / "meshes" / "two-disks.msh", folder)
    (folder / "case.toml").write_text(CASE)
    ok("run", folder / "case.toml", "-o", folder / "out")
    return rondo.open(folder / "out")


def test_places_are_those_of_the_fields(thrown):
    assert thrown.mesh.free.all()
    assert thrown.mesh.region_names == ("left", "right")
    assert thrown.mesh.region.shape == (thrown.mesh.n_cells,)
    with h5py.File(thrown.path, "r") as file:
        position = file["fields/position"][:, :, :2]
    for k in range(thrown.n_snapshots):
        np.testing.assert_allclose(thrown.position(k), position[k], atol=1e-7)  # single precision
    assert np.ptp(position, axis=0).max() > 0.05  # they have moved


def test_history_has_probes_with_units(thrown):
    assert thrown.history.units["left_ux"] == "m"
    assert thrown.history.units["left_vy"] == "m/s"
    assert thrown.history.units["left_szz"] == "Pa"
    assert thrown.history.units["work_load"] == "J/m"


def test_contact_and_what_a_disk_has(thrown):
    assert thrown.contact is not None
    assert thrown.contact.force.shape == (6, len(thrown.mesh.boundary), 2)
    assert thrown.spin == 0.0
    assert thrown.pitches == 0
    assert thrown.inner_radius == 0.0
    assert 0.19 < thrown.outer_radius < 0.21


def test_components_are_along_the_fixed_axes(thrown):
    seen = field.nodal(thrown, 3, "displacement_x")
    np.testing.assert_allclose(seen.values, 1e3 * thrown.displacement[3][:, 0])  # mm


def test_figures_and_a_film(thrown, tmp_path):
    assert {path.stem for path in draw_run(thrown, tmp_path)} >= {
        "field-displacement", "field-von_mises", "energy", "forces"}
    assert thrown.animate(tmp_path / "film.gif", frames=2).stat().st_size > 1000


def test_the_film_shows_all_of_the_motion(thrown):
    from rondo.plots.animation import _views
    low, high = _views(thrown, np.arange(thrown.n_snapshots), False, 1.0)
    assert np.ptp(low, axis=0).max() == 0
    for k in range(thrown.n_snapshots):
        places = thrown.position(k)
        assert (places > low[k]).all() and (places < high[k]).all()

# SPDX-License-Identifier: BSD-3-Clause
"""Simulation.matrices(): a step of the program by them, contact rows as it moves, wrong use."""
import h5py
import numpy as np
import pytest
from conftest import IN_THE_AIR, WHEEL
from program import ROOT, run
from stepping import SOLID, python

import rondo

sparse = pytest.importorskip("scipy.sparse")


def residual_of_a_step(simulation):
    """Of (3.3), from three states: u, v before, v after; the contact forces are those of the step."""
    m, dt = simulation.matrices(), simulation.dt
    u, before = simulation.displacement[m.nodes].ravel(), simulation.velocity[m.nodes].ravel()
    rows, spin = m.contact_rows(), -simulation.get("motion.angular_velocity")
    simulation.advance(1)
    after = simulation.velocity[m.nodes].ravel()
    mean, arm = 0.5 * (before + after), u + m.reference.ravel()
    alpha = simulation.case["damping"]["mass"]
    force = (spin**2 * (m.centrifugal @ arm) - m.stiffness @ u - m.damping @ before
             - alpha * (m.mass @ (mean - before)) - spin * (m.gyroscopic @ mean))
    rest = m.mass @ (after - before) - dt * force  # what contact has done
    pressed = rows.rows @ rest
    return np.linalg.norm(rest - rows.rows.T @ pressed) / np.linalg.norm(rest), pressed, rows, m


def test_a_step_of_the_program(case):
    simulation = rondo.Simulation(case)
    simulation.advance_to(0.01)
    residual, pressed, rows, m = residual_of_a_step(simulation)
    assert residual < 1e-9
    normal, tangential = pressed[::2], pressed[1::2]
    least = 1e-9 * normal.max()
    touch = rows.gap <= 0.0
    assert touch.sum() > 1 and normal.min() > -least and np.abs(normal[~touch]).max() < least
    assert (np.abs(tangential) <= 0.3 * normal + least).all()  # Coulomb
    np.testing.assert_array_equal(m.contact_nodes, simulation.mesh.boundary)


def test_units_and_shapes(case):
    m = rondo.Simulation(case).matrices()
    n = 2 * len(m.nodes)
    for matrix in (m.mass, m.damping, m.stiffness, m.gyroscopic, m.centrifugal):
        assert isinstance(matrix, sparse.csr_matrix) and matrix.shape == (n, n)
        assert matrix.has_sorted_indices
    assert (m.gyroscopic + m.gyroscopic.T).nnz == 0 or abs(m.gyroscopic + m.gyroscopic.T).max() == 0.0
    assert sorted([*m.nodes, *m.clamped]) == list(range(160))
    np.testing.assert_array_equal(m.unknowns_of(m.nodes[[3, 1]]), [6, 7, 2, 3])
    with pytest.raises(rondo.InputError, match=f"node {m.clamped[0]} is no free node"):
        m.unknowns_of([m.nodes[0], m.clamped[0]])


def test_contact_rows_of_a_displacement_and_a_place(case):
    simulation = rondo.Simulation(case)
    m = simulation.matrices()
    still, moved = m.contact_rows(), np.zeros(m.mass.shape[0])
    moved[m.unknowns_of(m.contact_nodes)[1::2]] = 0.001
    np.testing.assert_allclose(m.contact_rows(0.0, moved).gap - still.gap, 0.001, rtol=1e-9)
    np.testing.assert_allclose(still.rows @ moved, np.tile([0.001, 0.0], 40), atol=1e-15)
    everywhere = np.zeros_like(simulation.mesh.coordinates)
    everywhere[m.nodes] = moved.reshape(-1, 2)
    np.testing.assert_array_equal(m.contact_rows(0.0, everywhere).gap, m.contact_rows(0.0, moved).gap)
    turned = m.contact_rows(angle=-np.pi / 2, center=(0.0, 0.3))
    np.testing.assert_allclose(turned.normal_corotating, np.tile([-1.0, 0.0], (40, 1)), atol=1e-15)
    np.testing.assert_array_equal(turned.normal, np.tile([0.0, 1.0], (40, 1)))
    for wrong, match in ((dict(displacement=np.zeros(3)), r"shape \(3,\)"),
                         (dict(angle=0.0, center=(1, 2, 3)), "2 of the center"),
                         (dict(time=-1.0), "time = -1: is no time of the motion")):
        with pytest.raises(rondo.InputError, match=match):
            m.contact_rows(**wrong)


def test_now_is_where_the_simulation_is(case):
    simulation = rondo.Simulation(case)
    m = simulation.matrices()
    simulation.advance_to(0.008)
    rows = m.contact_rows()
    place = simulation.position[m.contact_nodes]
    np.testing.assert_allclose(rows.gap, place[:, 1], atol=1e-15)
    touching, gap = simulation.touching, dict(zip(m.contact_nodes, rows.gap, strict=True))
    assert len(touching.nodes) > 1
    np.testing.assert_allclose([gap[node] for node in touching.nodes], touching.gap, atol=1e-15)


def test_three_dimensions():
    settings = {"disk.mesh.circumferential": 30, "disk.mesh.radial": 2, "disk.mesh.axial": 2}
    simulation = rondo.Simulation(SOLID, settings)
    m = simulation.matrices()
    assert m.reference.shape == (len(m.nodes), 3) and m.mass.shape == 2 * (3 * len(m.nodes),)
    rows = m.contact_rows(0.0)
    assert rows.rows.shape == (3 * len(m.contact_nodes), 3 * len(m.nodes))
    assert m.centrifugal.diagonal()[2::3].max() == 0.0


def test_a_mesh_from_a_file():
    simulation = rondo.Simulation(ROOT / "cases" / "tyre-section.toml")
    m = simulation.matrices()
    spin = -simulation.get("motion.angular_velocity")
    assert abs(m.stiffness - m.stiffness.T).max() == 0.0 and np.isfinite(spin)
    mass = simulation.mesh.mass[m.nodes]
    np.testing.assert_array_equal(m.mass.diagonal(), np.repeat(mass, 2))


def test_a_rim_that_forces_move(case):
    case.write_text(WHEEL)
    simulation = rondo.Simulation(case)
    m = simulation.matrices()
    simulation.advance(50)
    assert m.contact_rows().gap.min() < 0.01
    with pytest.raises(rondo.InputError, match="forces move the rim"):
        m.contact_rows(0.01)


def test_without_a_ground(case):
    case.write_text(IN_THE_AIR)
    m = rondo.Simulation(case).matrices()
    assert len(m.contact_nodes) == 0
    with pytest.raises(rondo.InputError, match="there are no contact rows"):
        m.contact_rows()


def test_a_body_without_a_constant_stiffness():
    simulation = rondo.Simulation(ROOT / "cases" / "thrown-disk.toml")
    with pytest.raises(rondo.InputError, match="leaves bodies free") as caught:
        simulation.matrices()
    assert caught.value.faults[0]["key"] == "disk.rim"


def test_without_scipy(case):
    done = python(f"import sys; sys.modules['scipy'] = None; import rondo\n"
                  f"s = rondo.Simulation({str(case)!r})\n"
                  f"try: s.matrices()\nexcept rondo.Error as error: print(error)")
    assert "needs the package scipy" in done.stdout and "python3-scipy" in done.stdout, done.stderr


def test_scipy_is_loaded_by_the_call_alone():
    done = python("import sys, rondo; print('scipy' in sys.modules)")
    assert done.stdout == "False\n", done.stderr


def test_the_file_has_the_same(case):
    assert run("matrices", case, "-o", "matrices.h5", "--quiet").returncode == 0
    m = rondo.Simulation(case).matrices()
    with h5py.File("matrices.h5") as file:
        for name in ("mass", "damping", "stiffness", "gyroscopic", "centrifugal"):
            group = file[name]
            there = sparse.csr_matrix((group["data"][()], group["indices"][()], group["indptr"][()]),
                                      group["shape"][()])
            assert abs(there - getattr(m, name)).max() == 0.0



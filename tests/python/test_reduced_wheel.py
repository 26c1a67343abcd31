# SPDX-License-Identifier: BSD-3-Clause
"""rondo.ReducedWheel: its arrays against matrices of the whole mesh, its simulation, wrong files."""
import gc
import pathlib

import h5py
import numpy as np
import pytest
from conftest import TREADED
from program import ROOT, SMALL, replaced

import rondo

pytest.importorskip("scipy.sparse")

SPIN = 33.333333
RING = replaced(SMALL, "circumferential", "circumferential = 24")
TREAD = replaced(TREADED, "radial", "radial = 2")
STILL = {"motion.angular_velocity": 0.0, "motion.speed": 0.0}
CHANGING = {"motion.angular_velocity": [[0.0, 0.0], [0.01, SPIN]]}

pytestmark = pytest.mark.filterwarnings("ignore:contact has")


@pytest.fixture(params=[RING, TREAD], ids=["smooth", "treaded"])
def any_case(case, request):
    case.write_text(request.param)
    return case


@pytest.fixture
def ring(case):
    case.write_text(RING)
    return case


def turned(vectors):
    """J u of (..., 2)."""
    return np.stack([-vectors[..., 1], vectors[..., 0]], axis=-1)


def in_sectors(wheel, case, settings):
    """Of the whole mesh: (N, rows, N, rows) stiffness in the frames of the sectors, rows = 2 n_local."""
    m = rondo.Simulation(case, settings).matrices()
    sectors, rows = np.arange(wheel.n_sectors), np.arange(len(wheel.mass))
    nodes = wheel.node(rows, sectors[:, None])  # (N, n_local)
    place = m.unknowns_of(nodes.ravel()).reshape(len(sectors), -1, 2)
    cos, sin = np.cos(2 * np.pi * sectors / len(sectors)), np.sin(2 * np.pi * sectors / len(sectors))
    frame = np.moveaxis(np.array([[cos, -sin], [sin, cos]]), -1, 0)
    stiffness = m.stiffness.toarray()[place.ravel()][:, place.ravel()]
    found = stiffness.reshape(*place.shape, *place.shape)
    found = np.einsum("jrx,jarkbs,ksy->jaxkby", frame, found, frame)
    return found.reshape(len(sectors), 2 * len(rows), len(sectors), 2 * len(rows))


def rows_of(wheel):
    """Unknowns of a sector that may touch."""
    return (2 * wheel.contact_rows[:, None] + np.arange(2)).ravel()


def shapes_of(wheel):
    """(m, 2C) at the contact nodes."""
    return wheel.contact.reshape(-1, 2 * len(wheel.contact_rows))


def modes_alone(wheel, lags):
    """(lags, 2C, 2C) static compliance of the modes."""
    n, contact = wheel.n_sectors, shapes_of(wheel)
    weight = np.where(wheel.harmonic > 0, 2, 1) / n / wheel.frequency**2
    wave = np.exp(2j * np.pi * np.outer(lags, wheel.harmonic) / n)
    return np.einsum("dm,mi,mj->dij", weight * wave, contact, contact.conj()).real


@pytest.mark.parametrize("modes", [0, 20])
def test_at_rest_modes_and_the_rest_are_the_inverse_of_the_stiffness(any_case, modes):
    wheel = rondo.ReducedWheel.of(any_case, STILL, modes=modes)
    stiffness, rows, n = in_sectors(wheel, any_case, STILL), rows_of(wheel), wheel.n_sectors
    size = n * 2 * len(wheel.mass)
    inverse = np.linalg.inv(stiffness.reshape(size, size)).reshape(stiffness.shape)
    wanted = inverse[:, rows][:, :, 0][:, :, rows]  # by forces on sector 0
    found = wheel.compliance() + modes_alone(wheel, np.arange(n))
    np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-11 * np.abs(wanted).max())


def test_rolling_harmonics_are_those_of_the_mesh(any_case):
    """A pattern of forces that stands still in space, at the spin s: (R.30) with what stands still."""
    wheel = rondo.ReducedWheel.of(any_case, modes=20)
    stiffness, rows, n = in_sectors(wheel, any_case, None), rows_of(wheel), wheel.n_sectors
    mass = np.diag(np.repeat(wheel.mass, 2))
    turn = np.kron(np.diag(wheel.mass), [[0.0, -1.0], [1.0, 0.0]])
    table = wheel.compliance()
    for k in range(1, (n + 1) // 2):
        wave = np.exp(2j * np.pi * k * np.arange(n) / n)
        z = np.einsum("d,idj->ij", wave, stiffness[0].reshape(len(mass), n, len(mass)))
        z = z - SPIN**2 * (1 + k**2) * mass + 2j * k * SPIN**2 * turn
        wanted = np.linalg.inv(z)[np.ix_(rows, rows)]
        mine = wheel.harmonic == k
        z = (np.diag(wheel.frequency[mine]**2 - SPIN**2 * (1 + k**2))
             + 2j * k * SPIN**2 * wheel.coriolis[np.ix_(mine, mine)])
        shapes = shapes_of(wheel)[mine].T
        found = np.einsum("d,dij->ij", wave.conj(), table) + shapes @ np.linalg.inv(z) @ shapes.conj().T
        np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-10 * np.abs(wanted).max())


def test_a_viscous_wheel_creeps(any_case):
    """Both tables, with the terms of the creep at the rate of the pattern, are the harmonics of the mesh with the
    modulus of the branches."""
    branches = [(0.3, 2e-3), (0.2, 2e-2)]
    elastic = rondo.ReducedWheel.of(any_case, modes=0)
    stiffness = in_sectors(elastic, any_case, None)  # of slow strains
    with any_case.open("a") as text:
        for r, t in branches:
            text.write(f"[[material.viscosity]]\nrelative_modulus = {r}\ntime = {t}\n")
    wheel = rondo.ReducedWheel.of(any_case, modes=0)
    rows, n = rows_of(wheel), wheel.n_sectors
    np.testing.assert_allclose(sorted(map(tuple, wheel.branches)), sorted(branches))
    mass = np.diag(np.repeat(wheel.mass, 2))
    turn = np.kron(np.diag(wheel.mass), [[0.0, -1.0], [1.0, 0.0]])
    beta = 2e-5  # of the case
    for k in range(1, (n + 1) // 2):
        rate = 1j * k * SPIN
        lags = wheel.creep[:, 0] / (1 + rate * wheel.creep[:, 1])
        modulus = 1 + rate * beta + sum(r * rate * t / (1 + rate * t) for r, t in branches)
        np.testing.assert_allclose(lags.sum() * modulus, 1.0, atol=1e-12)
        wave = np.exp(2j * np.pi * k * np.arange(n) / n)
        z = modulus * np.einsum("d,idj->ij", wave, stiffness[0].reshape(len(mass), n, len(mass)))
        z = z - SPIN**2 * (1 + k**2) * mass + 2j * k * SPIN**2 * turn
        wanted = np.linalg.inv(z)[np.ix_(rows, rows)]
        found = sum(lag * np.einsum("d,dij->ij", wave.conj(), wheel.compliance(later=later))
                    for lag, later in ((lags[0], False), (lags[1:].sum(), True)))
        np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-9 * np.abs(wanted).max())
    assert elastic.creep.tolist() == [[1.0, 0.0]] and len(elastic.branches) == 0
    with pytest.raises(rondo.InputError, match="elastic"):
        elastic.compliance(later=True)


def test_what_its_modes_mean(any_case):
    wheel = rondo.ReducedWheel.of(any_case, modes=20)
    shape, mass, k = wheel.shape, wheel.mass, wheel.harmonic
    assert wheel.basis == "eigenmodes" and wheel.runs == [] and wheel.n_modes in (20, 21)
    assert mass[wheel.contact_rows].max() == 0.0
    same = k[:, None] == k
    overlap = np.einsum("mac,a,nac->mn", shape.conj(), mass, shape)
    np.testing.assert_allclose(overlap[same], np.eye(len(k))[same], atol=1e-12)
    coriolis = np.einsum("mac,a,nac->mn", shape.conj(), mass, turned(shape))
    np.testing.assert_allclose(wheel.coriolis, np.where(same, coriolis, 0), atol=1e-12)
    np.testing.assert_array_equal(wheel.coriolis, -wheel.coriolis.conj().T)
    np.testing.assert_array_equal(wheel.contact, shape[:, wheel.contact_rows])
    place = wheel.mesh.coordinates[wheel.node(np.arange(len(mass)), 0)]
    for found, vectors, harmonic in ((wheel.reference, place, 0), (wheel.turned, turned(place), 0)):
        wanted = np.einsum("mac,a,ac->m", shape.conj(), mass, vectors)
        np.testing.assert_allclose(found, np.where(k == harmonic, wanted, 0), atol=1e-12)
    moves = np.einsum("mac,a,c->m", shape, mass, [1, -1j])
    np.testing.assert_allclose(wheel.translation, np.where(k == 1, moves, 0), atol=1e-12)
    held = wheel.mesh.mass.sum() - wheel.n_sectors * mass.sum()  # by the rim
    assert 0.05 < held / wheel.mesh.mass.sum() < 0.3


def test_the_compliance_is_symmetric_and_positive(any_case):
    wheel = rondo.ReducedWheel.of(any_case)
    table, n = wheel.compliance(), wheel.n_sectors
    np.testing.assert_allclose(table, table[-np.arange(n) % n].transpose(0, 2, 1), rtol=0,
                               atol=1e-14 * np.abs(table).max())
    lag = (np.arange(n)[:, None] - np.arange(n)) % n
    whole = table[lag].transpose(0, 2, 1, 3).reshape(2 * n * len(wheel.contact_rows), -1)
    assert np.linalg.eigvalsh(whole).min() > 0.0


def test_nodes_of_rows(any_case):
    wheel = rondo.ReducedWheel.of(any_case)
    sector = np.arange(wheel.n_sectors)
    nodes = wheel.node(wheel.contact_rows, sector[:, None])
    assert sorted(nodes.ravel()) == sorted(wheel.mesh.boundary)
    np.testing.assert_array_equal(wheel.mesh.sector[nodes], np.broadcast_to(sector[:, None], nodes.shape))
    assert wheel.node(0, -1) == wheel.node(0, wheel.n_sectors - 1)


def test_tables_between_spins(ring):
    wheel = rondo.ReducedWheel.of(ring, CHANGING, modes=10)
    assert len(wheel.spins) == 3 and wheel.largest_spin == pytest.approx(SPIN, rel=1e-12)
    for spin in (0.0, 20.0, SPIN):
        fixed = {"motion.angular_velocity": spin, "motion.speed": 0.3 * spin}
        one = rondo.ReducedWheel.of(ring, fixed, modes=10)
        for found, wanted in ((wheel.compliance(spin), one.compliance()),
                              (wheel.centrifugal(spin), one.centrifugal(spin))):
            np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-4 * np.abs(one.compliance()).max()
                                       if found.ndim == 3 else 1e-3 * np.abs(wheel.centrifugal()).max())
    np.testing.assert_array_equal(wheel.compliance(), wheel.compliance(wheel.largest_spin))
    np.testing.assert_allclose(wheel.compliance(wheel.spins[1]), wheel._compliance[1].transpose(0, 2, 1),
                               rtol=1e-12, atol=1e-14 * wheel.compliance().max())
    for wrong in (-1.0, 40.0, float("nan")):
        with pytest.raises(rondo.InputError, match="allowed: 0 to 33.3333 rad/s"):
            wheel.compliance(wrong)
    with pytest.raises(rondo.InputError, match="allowed: 20 rad/s; of a case"):
        rondo.ReducedWheel.of(ring, {"motion.angular_velocity": 20.0}).centrifugal(19.0)


def test_a_file_and_its_simulation(ring):
    """The same wheel as that of the case, which needs no file."""
    wheel = rondo.ReducedWheel(rondo.reduce(ring, "wheel.h5", modes=20))
    steps = wheel.simulation(ring, {"ground.friction": 0.1}).run()
    other = rondo.Simulation(ring, {"ground.friction": 0.1}, reduced="case", modes=20).run()
    np.testing.assert_allclose(steps.displacement, other.displacement, rtol=0, atol=1e-12)
    assert steps.info["wheel_file"] == "wheel.h5" and steps.info["wheel_modes"] == wheel.n_modes
    assert str(wheel).startswith(f"ReducedWheel(wheel.h5: {wheel.n_modes} modes (eigenmodes), 24 sectors")
    with pytest.raises(rondo.InputError, match="mesh or material"):
        wheel.simulation(ring, {"material.density": 1000.0})


def test_of_a_case_keeps_its_file_as_long_as_itself(ring):
    wheel = rondo.ReducedWheel.of(ring)
    folder = wheel.path.parent
    steps = wheel.simulation(ring)
    del wheel
    gc.collect()
    assert not folder.exists()
    assert steps.run().is_over
    before = set(folder.parent.glob("rondo-wheel-*"))
    with pytest.raises(rondo.InputError, match="ground"):
        rondo.ReducedWheel.of(ring, {"ground.friction": -1.0})
    assert set(folder.parent.glob("rondo-wheel-*")) <= before


def test_a_pod_of_runs(ring):
    run = rondo.run(ring, "full", {"output.snapshots": 60})
    wheel = rondo.ReducedWheel(rondo.reduce(run, "pod.h5", modes=7))
    assert wheel.basis == "pod" and [pathlib.Path(one).name for one in wheel.runs] == ["full"]
    assert wheel.n_modes in (7, 8)


@pytest.mark.parametrize("form, error, said", [
    ("rondo reduced model 3", rondo.Error, "earlier version.*rondo reduce CASE.toml -o wheel.h5"),
    ("rondo results 1", rondo.Error, "is no reduced wheel.*rondo reduce CASE.toml -o wheel.h5"),
    ("rondo reduced wheel 2", rondo.NewerSchemaError, "install the Python package of that version")])
def test_other_files(tmp_path, form, error, said):
    with h5py.File(tmp_path / "x.h5", "w") as file:
        file.attrs["format"] = form
    with pytest.raises(error, match=said):
        rondo.ReducedWheel(tmp_path / "x.h5")
    with pytest.raises(rondo.Error, match="no such file"):
        rondo.ReducedWheel(tmp_path / "none.h5")


def test_a_mesh_without_equal_sectors_is_one_sector():
    from scipy.sparse.linalg import splu

    case = ROOT / "cases" / "rolling-spokes.toml"
    wheel = rondo.ReducedWheel.of(case, STILL, modes=20)
    assert wheel.n_sectors == 1 and wheel.n_modes == 20 and not wheel.harmonic.any()
    m = rondo.Simulation(case, STILL).matrices()
    one, other = m.unknowns_of(wheel.node(wheel.contact_rows[[3, 7]], 0)).reshape(2, 2)
    force = np.zeros(m.mass.shape[0])
    force[one] = 1.0, 2.0
    wanted = splu(m.stiffness.tocsc()).solve(force)[other]
    shapes = shapes_of(wheel).real
    whole = wheel.compliance()[0] + shapes.T @ (shapes / wheel.frequency[:, None]**2)
    np.testing.assert_allclose(whole[14:16, 6:8] @ [1.0, 2.0], wanted, rtol=1e-8)

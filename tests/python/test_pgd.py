# SPDX-License-Identifier: BSD-3-Clause
"""The modes of LATIN-PGD as a POD, PODs compared, and the table of convergence: on a run that is
made to look like one by LATIN-PGD."""
import json
import shutil

import h5py
import matplotlib.pyplot as plt
import numpy as np
import pytest
from drawn import without_unit
from test_errors import edit, says

import rondo
from rondo.figures.run_figures import draw_run
from program import run as program

TABLE = """iteration,indicator,residual,modes,solves
1,1.0,0.9,1,1
2,0.5,0.4,4,4
3,0.01,0.0,3,5
"""


def decompose(run, *arguments):
    done = program("pod", run, "--quiet", *arguments)
    assert done.returncode == 0, done.stderr


@pytest.fixture(autouse=True)
def closed():
    plt.close("all")


@pytest.fixture(scope="session")
def solved(crush, tmp_path_factory):
    """A crush with a PGD, of which the norm is that of numbers, and PODs of displacement and contact
    forces."""
    run = tmp_path_factory.mktemp("latin") / "run"
    shutil.copytree(crush, run, ignore=shutil.ignore_patterns("pod"))
    decompose(run, "--weight", "none", "--modes", "2", "--reconstruct", "0")
    pgd = run / "pod" / "displacement-pgd"
    (run / "pod" / "displacement-rotating").rename(pgd)
    latin = {"search_direction": 1e9, "last_cut": 1e-3, "iterations": 3, "solves": 5}
    edit(pgd / "pod.json", method="latin-pgd", weight="search-direction", latin=latin)
    with h5py.File(pgd / "pod.h5", "a") as file:
        file.attrs["weight"] = "search-direction"
        del file["weight"]
    decompose(run, "--modes", "4")
    decompose(run, "--field", "contact", "--modes", "3")
    (run / "convergence.csv").write_text(TABLE)
    return run


@pytest.fixture
def latin(solved):
    return rondo.open(solved)


@pytest.fixture
def pgd(latin):
    return latin.pod("displacement", "pgd")


def test_a_pgd_is_a_pod(latin, pgd):
    assert list(latin.pods) == ["contact-rotating", "displacement-pgd", "displacement-rotating"]
    assert pgd is latin.pods["displacement-pgd"]
    assert (pgd.name, pgd.kind, pgd.frame) == ("displacement-pgd", "pgd", "rotating")
    assert pgd.is_pgd and pgd.weight == "search-direction"
    assert "displacement, pgd, weight search-direction, 40 snapshots, 2 modes" in repr(pgd)
    pod = latin.pod("displacement")
    assert (pod.name, pod.kind, pod.is_pgd) == ("displacement-rotating", "rotating", False)


def test_weights_of_points_are_refused(pgd):
    says(rondo.Error, getattr, pgd, "weights",
         words=[pgd.directory, "no weights of points", "(K + k HᵀH)", "orthonormality"])


def test_a_snapshot_from_the_modes_of_a_pgd(latin, pgd):
    u = latin.displacement[-1]
    assert np.abs(pgd.reconstruct(-1) - u).max() < 1e-2 * np.abs(u).max()
    message = says(rondo.Error, pgd.reconstruct, 0, 3, words=["2 modes are kept; 3 were asked for"])
    assert "rondo pod" not in message


def test_a_pgd_that_is_not_there(crush):
    says(rondo.UnknownNameError, rondo.open(crush).pod, "displacement", "pgd",
         words=[crush, "no POD 'displacement-pgd'", 'analysis.solver="latin-pgd"'])
    says(rondo.UnknownNameError, rondo.open(crush).pod, "velocity", "rectified",
         words=[f"rondo pod {crush} --field velocity --frame rectified"])


def test_pictures_of_a_pgd(latin, pgd):
    from rondo.plots.modes import plot_pod_spectrum

    assert len(pgd.plot_spectrum().lines) > 1
    figure = latin.plot_modes("displacement", "pgd", count=2)
    assert len(pgd.plot_modes(2).axes) == len(figure.axes)
    legend = plot_pod_spectrum([pgd, latin.pod("displacement")]).get_legend()
    assert [text.get_text() for text in legend.get_texts()] == ["displacement, pgd",
                                                                "displacement, rotating"]


def turned(pod, angle, folder):
    """The POD again, its first mode turned towards one that is orthonormal to all of them."""
    copy = folder / "turned"
    shutil.copytree(pod.directory, copy)
    root = np.sqrt(pod.mesh.mass)[:, None]
    span = (pod.spatial * root).reshape(pod.n_modes, -1).T
    new = np.random.default_rng(3).normal(size=span.shape[0])
    new -= span @ (span.T @ new)
    new /= np.linalg.norm(new)
    first = (np.cos(angle) * span[:, 0] + np.sin(angle) * new).reshape(pod.spatial[0].shape) / root
    with h5py.File(copy / "pod.h5", "a") as file:
        file["modes/spatial"][0] = first
    return rondo.open_pod(copy)


@pytest.mark.parametrize("angle", [1e-10, 1e-4, 0.3, 1.2])
def test_angles_between_pods(latin, tmp_path, angle):
    pod = latin.pod("displacement")
    other = turned(pod, angle, tmp_path)
    expected = np.append(np.zeros(pod.n_modes - 1), angle)
    for found in (pod.angles(other), other.angles(pod)):
        np.testing.assert_allclose(found, expected, rtol=1e-4, atol=1e-14)
    np.testing.assert_allclose(pod.angles(other, 1), [angle], rtol=1e-4)
    np.testing.assert_allclose(pod.angles(pod), 0, atol=1e-14)


def test_angles_of_fewer_modes(latin, pgd):
    pod = latin.pod("displacement")
    angles = pgd.angles(pod)
    assert angles.shape == (2,) and angles[1] < 1e-6  # all that there is in the run
    angles = pgd.angles(pod, 2)
    assert angles.shape == (2,) and 0 <= angles[0] < angles[1]
    assert 1e-5 < angles[1] < 1e-3  # found in another norm
    force = latin.pod("contact")
    np.testing.assert_allclose(force.angles(force), 0, atol=1e-7)


def test_what_cannot_be_compared(latin, pgd, smooth):
    says(rondo.Error, pgd.angles, latin.pod("contact"),
         words=[pgd.directory, "displacement", "contact", "must be the same"])
    elsewhere = rondo.open_pod(smooth / "pod" / "displacement-rotating")
    assert pgd.angles(elsewhere, 1).shape == (1,)  # the same mesh
    elsewhere.mesh.coordinates[3] += 1e-9
    says(rondo.Error, pgd.angles, elsewhere, words=["the meshes must be the same"])
    for modes in (0, 3):
        says(rondo.Error, pgd.angles, latin.pod("displacement"), modes,
             words=[f"2 modes are kept; {modes} are to be compared"])
    says(rondo.Error, pgd.projection_error, latin.displacement[-1], words=["(any, "])


def test_what_modes_leave_of_fields(latin, pgd):
    """In the norm of a POD it is the root of what the spectrum leaves; no other modes leave less."""
    pod = latin.pod("displacement")
    u = latin.displacement[:]
    left = pod.projection_error(u)
    assert left.shape == (5,) and left[0] == 1.0
    np.testing.assert_allclose(left[1:4], np.sqrt(pod.discarded_energy[:3]), rtol=1e-6)
    other = pgd.projection_error(u)
    assert other.shape == (3,) and np.all(other >= left[:3] * (1 - 1e-9))
    assert other[-1] < 3 * left[2]
    force = latin.pod("contact")
    found = force.projection_error(latin.contact.force[:])
    np.testing.assert_allclose(found[1:], np.sqrt(force.discarded_energy[:3]), rtol=1e-6)
    np.testing.assert_array_equal(pod.projection_error(0 * u), 0)


def test_the_table_of_convergence(latin):
    table = latin.convergence
    assert list(table) == ["iteration", "indicator", "residual", "modes", "solves"]
    np.testing.assert_array_equal(table["indicator"], [1.0, 0.5, 0.01])
    assert "3 iterations" in repr(table) and len(table) == 5
    says(rondo.UnknownNameError, table.__getitem__, "eta", words=["'eta'", "indicator, residual"])


def test_a_run_without_it(crush, tmp_path):
    says(rondo.Error, getattr, rondo.open(crush), "convergence",
         words=[crush / "convergence.csv", 'analysis.solver = "latin" or "latin-pgd"',
                'analysis.kind = "crush", solver = "direct"'])
    says(rondo.Error, rondo.open(crush).plot_convergence, words=["convergence.csv"])
    damaged = tmp_path / "damaged"
    shutil.copytree(crush, damaged)
    (damaged / "convergence.csv").write_text("iteration,residual\n1,1.0\n")
    says(rondo.Error, getattr, rondo.open(damaged), "convergence",
         words=["damaged: it has no column indicator"])


def test_convergence_as_drawn(latin):
    ax = latin.plot_convergence()
    below = ax.figure.axes[1]
    assert ax.get_yscale() == "log" and without_unit(ax.figure) == []
    curves = {line.get_label(): line.get_ydata() for line in [*ax.lines, *below.lines]}
    np.testing.assert_array_equal(curves["indicator"], [1.0, 0.5, 0.01])
    np.testing.assert_array_equal(curves["residual of the contact law"], [0.9, 0.4, np.nan])
    np.testing.assert_array_equal(curves["modes"], [1, 4, 3])
    np.testing.assert_array_equal(curves["solves so far"], [1, 4, 5])
    assert below.get_xlabel() == "iteration (–)"
    figure, given = plt.subplots()
    assert latin.plot_convergence(ax=given) is given and len(figure.axes) == 2


def test_convergence_without_modes(solved, tmp_path):
    copy = tmp_path / "latin"
    shutil.copytree(solved, copy)
    (copy / "convergence.csv").write_text("iteration,indicator,residual\n1,1.0,0.9\n2,0.1,0.2\n")
    ax = rondo.open(copy).plot_convergence()
    assert len(ax.figure.axes) == 1 and ax.get_xlabel() == "iteration (–)"


@pytest.mark.long
def test_the_figures_of_a_run(solved, tmp_path):
    names = {path.name for path in draw_run(rondo.open(solved), tmp_path)}
    assert {"convergence.png", "modes-displacement-pgd.png", "pod-spectrum.png"} <= names


def test_a_pgd_is_no_run_to_the_program(solved, tmp_path):
    pgd = solved / "pod" / "displacement-pgd"
    for command in (["pod", pgd, "-o", tmp_path / "out"], ["reduce", pgd, "-o", tmp_path / "m.h5"]):
        done = program(*command)
        assert done.returncode == 2 and "results.h5" in done.stderr, done.stderr
    done = program("pod", solved, "--frame", "pgd")
    assert done.returncode == 2 and "co-rotating | rectified" in done.stderr, done.stderr
    assert json.loads((pgd / "pod.json").read_text())["method"] == "latin-pgd"

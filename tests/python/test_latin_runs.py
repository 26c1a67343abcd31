# SPDX-License-Identifier: BSD-3-Clause
"""Crushes by LATIN and LATIN-PGD, run by the program and read by the package."""
import json
import pathlib

import matplotlib.pyplot as plt
import numpy as np
import pytest
from conftest import TO_CRUSH, ok
from program import run as program
from program import SMALL
from test_errors import says

import rondo

CUT = 10  # what is left in the norm of the mass, over what the last cut leaves in its own


@pytest.fixture(autouse=True)
def closed():
    plt.close("all")


@pytest.fixture(scope="session")
def solvers(tmp_path_factory):
    """The folder of the same crush by each solver: `direct`, `latin`, `latin-pgd`, with a POD each."""
    folder = tmp_path_factory.mktemp("solvers")
    case = folder / "case.toml"
    case.write_text(SMALL.replace("circumferential = 40", "circumferential = 180"))
    for solver in ("direct", "latin", "latin-pgd"):
        ok("run", case, "-o", folder / solver, *TO_CRUSH, "--set", f"analysis.solver={solver}")
        ok("pod", folder / solver, "--modes", "4")
    return folder


@pytest.fixture
def pgd(solvers):
    return rondo.open(solvers / "latin-pgd").pod("displacement", "pgd")


def relative(a, b):
    return np.linalg.norm(a - b) / np.linalg.norm(b)


def test_the_modes_give_the_displacement_of_the_run(solvers, pgd):
    """Each increment within what the file says that the modes kept leave; all within the cut."""
    run = rondo.open(solvers / "latin-pgd")
    assert list(run.pods) == ["displacement-pgd", "displacement-rotating"]
    np.testing.assert_allclose(pgd.time, run.times, rtol=1e-12)
    rebuilt = np.array([pgd.reconstruct(k) for k in range(len(pgd.time))])
    assert relative(rebuilt, run.displacement[:]) < CUT * pgd.info["latin"]["last_cut"] + 1e-6
    assert pgd.projection_error(run.displacement[:])[-1] < CUT * pgd.info["latin"]["last_cut"] + 1e-6


def test_what_pod_json_says_of_the_modes(pgd):
    assert pgd.is_pgd and pgd.weight == "search-direction" and pgd.time_unit == "1"
    assert pgd.info["status"] == "done" and pgd.info["orthonormality"] < 1e-9
    assert 1 <= pgd.n_modes == len(pgd.spatial) <= len(pgd.singular_value)
    assert pgd.coefficients.shape == (len(pgd.time), pgd.n_modes)
    assert np.all(np.diff(pgd.singular_value) <= 0)
    assert pgd.discarded_energy[pgd.n_modes - 1] <= pgd.info["latin"]["last_cut"] ** 2 * (1 + 1e-9)
    for share, count in pgd.modes_for.items():
        assert count == 1 + np.argmax(pgd.discarded_energy <= share)
    for mode in pgd.spatial:
        assert mode.flat[np.abs(mode).argmax()] > 0
    latin = pgd.info["latin"]
    assert latin["solves"] >= latin["most_modes"] >= len(pgd.singular_value) >= pgd.n_modes


def test_the_modes_are_nearly_those_of_a_pod(solvers, pgd):
    direct = rondo.open(solvers / "direct")
    pod = direct.pod("displacement")
    count = min(3, pod.n_modes, pgd.n_modes)
    assert pgd.angles(pod, 1)[0] < 0.05
    u = direct.displacement[:]
    assert np.all(pgd.projection_error(u)[1:count + 1] >= 0.999 * pod.projection_error(u)[1:count + 1])


@pytest.mark.parametrize("solver", ["latin", "latin-pgd"])
def test_convergence(solvers, solver):
    run = rondo.open(solvers / solver)
    table = run.convergence
    assert list(table) == ["iteration", "indicator", "residual", "modes", "solves"]
    np.testing.assert_array_equal(table["iteration"], np.arange(len(table["iteration"])) + 1)
    assert table["indicator"][-1] < 0.1 * table["indicator"][0]
    ax = run.plot_convergence()
    assert ax.get_yscale() == "log"
    assert len(ax.figure.axes) == (2 if solver == "latin-pgd" else 1)
    if solver == "latin-pgd":
        latin = json.loads((run.directory / "pod/displacement-pgd/pod.json").read_text())["latin"]
        assert latin["iterations"] == table["iteration"][-1]
        assert latin["solves"] == table["solves"][-1] and np.all(np.diff(table["solves"]) >= 0)
        assert latin["most_modes"] >= table["modes"].max()
        assert latin["indicator"] == table["indicator"][-1]
        assert latin["residual"] == table["residual"][-1]


def test_of_a_direct_crush_there_is_neither(solvers):
    run = rondo.open(solvers / "direct")
    says(rondo.Error, getattr, run, "convergence", words=["latin-pgd", 'solver = "direct"'])
    says(rondo.UnknownNameError, run.pod, "displacement", "pgd", words=["analysis.solver"])
    says(rondo.UnknownNameError, rondo.open(solvers / "latin").pod, "displacement", "pgd",
         words=["analysis.solver"])


def test_modes_of_another_run(solvers, tmp_path):
    """They are begun with; those of another mesh, of a run without them, half of them are refused."""
    case = solvers / "latin-pgd" / "case.toml"

    def again(modes, *settings):
        return program("run", case, "-o", tmp_path / "again", "--overwrite", "--modes-from", modes,
                       *settings, "--quiet")

    done = again(solvers / "latin-pgd", "--set", "ground.friction=0.2")
    assert done.returncode == 0, done.stderr
    first, second = (rondo.open(path).pod("displacement", "pgd").info["latin"]["solves"]
                     for path in (solvers / "latin-pgd", tmp_path / "again"))
    assert second <= first / 2
    for modes, settings, words in (
            (solvers / "direct", (), "holds no modes of LATIN-PGD"),
            (tmp_path / "none", (), "no such directory"),
            (solvers / "latin-pgd", ("--set", "disk.mesh.radial=4"), "of another mesh")):
        done = again(modes, *settings)
        assert done.returncode == 2 and words in done.stderr, done.stderr


def test_overwritten_modes_are_gone(solvers, tmp_path):
    case = solvers / "direct" / "case.toml"
    ok("run", case, "-o", tmp_path / "run", "--set", "analysis.solver=latin-pgd")
    assert (tmp_path / "run" / "pod" / "displacement-pgd" / "basis.h5").exists()
    ok("run", case, "-o", tmp_path / "run", "--overwrite")
    assert not (tmp_path / "run" / "pod").exists()
    assert not (tmp_path / "run" / "convergence.csv").exists()


@pytest.mark.long
def test_figures(solvers, tmp_path):
    from rondo.figures.run_figures import draw_run

    names = {pathlib.Path(path).name for path in draw_run(rondo.open(solvers / "latin-pgd"), tmp_path)}
    assert {"convergence.png", "modes-displacement-pgd.png", "pod-spectrum.png"} <= names

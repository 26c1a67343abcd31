# SPDX-License-Identifier: BSD-3-Clause
"""Runs made by the built program, once for all tests: small ones, which the tests do not change."""
import pathlib
import shutil
import subprocess
import sys
import time

import h5py
import numpy as np
import pytest
import sweeps

import rondo

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "cli"))

from program import PROGRAM, SMALL, replaced, run  # noqa: E402

TREADED = replaced(SMALL, "circumferential", "[disk.tread]\npitches = 12\ndepth = 0.02\n"
                   "land_columns = 2\ngroove_columns = 1\nlayers = 1")
IN_THE_AIR = "\n".join(line for line in SMALL.splitlines()
                       if not line.startswith(("[ground]", "profile", "friction")))
LONG = replaced(SMALL, "end", "end = 500.0").replace("snapshots = 11", "snapshots = 100000")
# Free to rise and to turn; braked; gravity, so that there is weight beside the load.
WHEEL = replaced(SMALL, "height", """height = 0.3
gravity = 9.81
[rim]
free = ["height", "angular_velocity"]
mass = 100.0
inertia = 1.0
force_y = [[0.0, 0.0], [0.005, -5.0e4]]
brake = [[0.0, 0.0], [0.01, 2.0e3]]
[rim.support.y]
stiffness = 1.0e5
damping = 6.0e4""")
EACH_STEP = ["--set", "output.history_interval=0"]
TO_CRUSH = ["--set", "analysis.kind=crush", "--set", "analysis.depth=0.02", "--set",
            "analysis.increments=40"]


def pytest_configure(config):
    config.addinivalue_line("markers", "long: run by scripts/long.sh only (CONTRIBUTING.md)")


def ok(*arguments):
    done = run(*arguments, "--quiet")
    assert done.returncode == 0, done.stderr


@pytest.fixture(scope="session")
def runs(tmp_path_factory):
    """The folder of the runs `smooth` (with three PODs), `treaded`, `crush`, `air`, `wheel`."""
    folder = tmp_path_factory.mktemp("runs")
    for name, text, settings in (("smooth", SMALL, []), ("treaded", TREADED, EACH_STEP),
                                 ("crush", SMALL, TO_CRUSH), ("air", IN_THE_AIR, EACH_STEP),
                                 ("wheel", WHEEL, [])):
        case = folder / f"{name}.toml"
        case.write_text(text)
        ok("run", case, "-o", folder / name, *settings)
        case.unlink()
    for field, frame in (("velocity", "rectified"), ("displacement", "rotating"),
                         ("contact", "rotating")):
        ok("pod", folder / "smooth", "--field", field, "--frame", frame, "--modes", 3)
    return folder


@pytest.fixture(scope="session")
def smooth(runs):
    return runs / "smooth"


@pytest.fixture(scope="session")
def treaded(runs):
    return runs / "treaded"


@pytest.fixture(scope="session")
def crush(runs):
    return runs / "crush"


@pytest.fixture(scope="session")
def air(runs):
    """A run without ground."""
    return runs / "air"


@pytest.fixture(scope="session")
def wheel(runs):
    """A run on a rim that forces move."""
    return runs / "wheel"


@pytest.fixture(scope="session")
def killed(tmp_path_factory):
    """A run that was killed in the middle."""
    folder = tmp_path_factory.mktemp("killed")
    (folder / "case.toml").write_text(LONG)
    out = folder / "out"
    process = subprocess.Popen([PROGRAM, "run", str(folder / "case.toml"), "-o", str(out)],
                               stderr=subprocess.DEVNULL)
    deadline = time.time() + 60
    rows = out / "history.csv"
    while not (rows.exists() and rows.stat().st_size > 60000) and time.time() < deadline:
        time.sleep(0.05)
    process.kill()
    process.wait()
    assert rows.stat().st_size > 60000, "the run did not start"
    return out


@pytest.fixture
def copy(smooth, tmp_path):
    """A copy of the run `smooth` that a test may change."""
    return pathlib.Path(shutil.copytree(smooth, tmp_path / "copy"))


def of_modes(directory):
    """Makes of a run one of an earlier version, of a reduced model with --snapshots modes."""
    with h5py.File(directory / "results.h5", "r+") as file:
        for group in ("snapshots", "fields"):
            if group in file:
                del file[group]
        file.create_group("reduced")


@pytest.fixture(scope="session")
def paper(tmp_path_factory):
    """The study of the paper on coarse meshes, a few seconds."""
    folder = tmp_path_factory.mktemp("paper") / "study"
    done = subprocess.run([sys.executable, "-m", "rondo", "paper", "--quick", "-o", str(folder)],
                          capture_output=True, text=True, timeout=300)
    assert (folder / "paper.json").exists(), done.stderr
    return rondo.open_paper(folder)


@pytest.fixture(scope="session")
def studies(tmp_path_factory):
    """The folder of three sweeps, which the tests do not change: `grid`, `sampled`, `loaded`."""
    folder = tmp_path_factory.mktemp("studies")
    sweeps.grid(folder / "grid", schemes=("symplectic", "as-printed"), failed=(5, 18))
    sweeps.sampled(folder / "sampled", failed=(7,))
    sweeps.loaded(folder / "loaded")
    return folder


@pytest.fixture
def grid(studies):
    """Friction by spin by scheme, 24 members, the 5th and the 18th failed."""
    return rondo.open_sweep(studies / "grid")


@pytest.fixture
def sampled(studies):
    """A Latin hypercube of 120 members, the 7th failed."""
    return rondo.open_sweep(studies / "sampled")


@pytest.fixture
def loaded(studies):
    """Crushes to three loads with two frictions."""
    return rondo.open_sweep(studies / "loaded")


@pytest.fixture
def plane(tmp_path):
    """60 members of two sampled parameters, over which force_y_mean is a plane."""
    places = [(0.1 + 0.8 * np.mod(0.618 * k, 1.0), 30 + 10 * (k + 0.5) / 60) for k in range(60)]
    rows = [{sweeps.FRICTION: a, sweeps.SPIN: b, **sweeps.forces(a, b)} for a, b in places]
    for row in rows:
        row["force_y_mean"] = 1e6 * row[sweeps.FRICTION] + 1e4 * row[sweeps.SPIN]
    parameters = [(sweeps.FRICTION, "-", "uniform"), (sweeps.SPIN, "rad/s", "uniform")]
    return rondo.open_sweep(sweeps.write(tmp_path / "plane", parameters, rows))


@pytest.fixture
def case(tmp_path, monkeypatch):
    """A small case in a folder that is the working one."""
    monkeypatch.setenv("RONDO", PROGRAM)
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "small.toml"
    path.write_text(SMALL)
    return path

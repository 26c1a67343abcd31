# SPDX-License-Identifier: BSD-3-Clause
"""The package as a package: version, wheel, installation without network, its guide."""
import base64
import csv
import hashlib
import importlib.util
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile
import venv
import zipfile

import pytest
import sweeps
from conftest import ok
from program import PROGRAM

import rondo

ROOT = pathlib.Path(__file__).resolve().parents[2]
PYTHON = ROOT / "python"
GUIDE = ROOT / "docs" / "python.md"


def backend(folder):
    """python/build_wheel.py, or a copy, as a module."""
    spec = importlib.util.spec_from_file_location("build_wheel", folder / "build_wheel.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def clean_environment(**changes):
    """Without this test's PYTHONPATH; pip asks no index."""
    kept = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    return kept | {"PIP_NO_INDEX": "1", "PIP_DISABLE_PIP_VERSION_CHECK": "1"} | changes


def test_one_version():
    cmake = (ROOT / "CMakeLists.txt").read_text()
    assert rondo.__version__ == re.search(r"project\(rondo VERSION ([\d.]+)", cmake)[1]
    said = subprocess.run([PROGRAM, "--version"], capture_output=True, text=True).stdout
    assert rondo.__version__ == said.split()[1]


def test_the_wheel_is_the_same_each_time(tmp_path):
    first, second = tmp_path / "first", tmp_path / "second"
    for name in ("python", "studies", "cases"):
        shutil.copytree(ROOT / name, second / name, ignore=shutil.ignore_patterns("__pycache__"))
    first.mkdir()
    for path in sorted(second.rglob("*"), reverse=True):
        os.utime(path, (1.6e9, 1.6e9))  # other dates
    names = [backend(PYTHON).build_wheel(str(first)), backend(second / "python").build_wheel(str(second))]
    assert names == [f"rondo-{rondo.__version__}-py3-none-any.whl"] * 2
    assert (first / names[0]).read_bytes() == (second / names[1]).read_bytes()


def test_what_is_in_the_wheel(tmp_path):
    with zipfile.ZipFile(tmp_path / backend(PYTHON).build_wheel(str(tmp_path))) as wheel:
        assert wheel.testzip() is None
        names = wheel.namelist()
        info = f"rondo-{rondo.__version__}.dist-info"
        rows = {row[0]: row[1:] for row in
                csv.reader(io.StringIO(wheel.read(f"{info}/RECORD").decode()))}
        assert sorted(rows) == sorted(names)
        assert rows.pop(f"{info}/RECORD") == ["", ""]
        for name, (digest, size) in rows.items():
            data = wheel.read(name)
            sha = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).decode().rstrip("=")
            assert (digest, int(size)) == (f"sha256={sha}", len(data))
        metadata = wheel.read(f"{info}/METADATA").decode()
        assert wheel.read(f"{info}/LICENSE") == (PYTHON.parent / "LICENSE").read_bytes()
    sources = [path.relative_to(PYTHON).as_posix() for path in (PYTHON / "rondo").rglob("*.py")]
    assert {name for name in names if name.endswith(".py")} == set(sources)
    shipped = {name for name in names if name.endswith(".toml")}
    assert {"rondo/shipped/studies/paper/study.toml", "rondo/shipped/cases/ledge-smooth.toml"
            } < shipped <= {f"rondo/shipped/{path.relative_to(ROOT)}" for folder in
                            ("cases", "studies") for path in (ROOT / folder).rglob("*.toml")}
    assert "rondo/py.typed" in names and not any("__pycache__" in name for name in names)
    for line in ("Name: rondo", f"Version: {rondo.__version__}", "Requires-Dist: h5py>=3.7",
                 "Requires-Python: >=3.11"):
        assert line in metadata.splitlines()


def test_a_wheel_from_the_source_archive(tmp_path):
    with tarfile.open(tmp_path / backend(PYTHON).build_sdist(str(tmp_path))) as archive:
        assert not any(pathlib.PurePath(name).is_absolute() for name in archive.getnames())
        archive.extractall(tmp_path)
    unpacked = tmp_path / f"rondo-{rondo.__version__}"
    assert (unpacked / "PKG-INFO").read_text().startswith("Metadata-Version: 2.1\nName: rondo\n")
    (tmp_path / "direct").mkdir()
    wheel = backend(PYTHON).build_wheel(str(tmp_path / "direct"))
    backend(unpacked).build_wheel(str(tmp_path))
    assert (tmp_path / wheel).read_bytes() == (tmp_path / "direct" / wheel).read_bytes()


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """The Python of a new environment, with the package installed from the sources by pip."""
    folder = tmp_path_factory.mktemp("venv")
    venv.create(folder / "env", system_site_packages=True, with_pip=True)
    python = folder / "env" / "bin" / "python"
    done = subprocess.run([python, "-m", "pip", "install", "--no-deps", PYTHON], text=True,
                          capture_output=True, env=clean_environment(), cwd=folder)
    assert done.returncode == 0, done.stdout + done.stderr
    return python


def test_it_installs_without_network(installed, smooth, tmp_path):
    text = ("import rondo, rondo.figures.run_figures, rondo.plots.animation\n"
            f"print(rondo.__file__, rondo.__version__, rondo.open({str(smooth)!r}).n_snapshots)")
    done = subprocess.run([installed, "-c", text], text=True, capture_output=True, cwd=tmp_path,
                          env=clean_environment())
    assert done.returncode == 0, done.stderr
    where, version, snapshots = done.stdout.split()
    assert installed.parent.parent in pathlib.Path(where).parents
    assert (version, snapshots) == (rondo.__version__, "11")


def test_the_study_of_the_paper_is_installed(installed, tmp_path):
    text = ("from rondo.studies.paper_plan import read_plan, study_folder\n"
            "plan = read_plan(study_folder(), False)\n"
            "print(len(plan.rows), all(run.case.is_file() for run in plan.runs))")
    done = subprocess.run([installed, "-c", text], text=True, capture_output=True, cwd=tmp_path,
                          env=clean_environment())
    assert done.stdout == "68 True\n", done.stderr


def test_the_build_leaves_the_sources_alone(installed):
    assert not [path for name in ("build", "dist", "*.egg-info") for path in PYTHON.glob(name)]


def test_reading_does_not_need_matplotlib(smooth):
    """Nor its time to load."""
    text = (f"import sys, rondo; rondo.open({str(smooth)!r}).position(0); "
            "print([name for name in sys.modules if 'matplotlib' in name])")
    done = subprocess.run([sys.executable, "-c", text], text=True, capture_output=True)
    assert (done.stdout, done.stderr) == ("[]\n", "")


def test_the_guide(runs, tmp_path, monkeypatch):
    """Its examples run, in their order, where it says: beside the directories of two runs and a
    sweep."""
    for name in ("smooth", "crush"):
        shutil.copytree(runs / name, tmp_path / "results" / name)
    traction = sweeps.grid(tmp_path / "results" / "traction", (0.1, 0.2, 0.4, 0.6))
    shutil.copytree(runs / "smooth", traction / "runs" / "0001")
    shutil.copytree(ROOT / "cases", tmp_path / "cases")
    pgd = tmp_path / "results" / "pgd"
    ok("run", ROOT / "cases" / "crush-smooth.toml", "-o", pgd, "--set", "analysis.solver=latin-pgd")
    ok("pod", pgd)
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"^```python\n(.*?)^```$", GUIDE.read_text(), re.MULTILINE | re.DOTALL)
    assert len(blocks) > 5
    names: dict = {}
    for block in blocks:
        exec(compile(block, str(GUIDE), "exec"), names)
    names["plt"].close("all")
    files = {path.name for path in tmp_path.iterdir() if path.is_file()}
    written = set(re.findall(r'"(\w+\.(?:png|gif|mp4))"', "".join(blocks)))
    assert written and written <= files

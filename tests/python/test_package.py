# SPDX-License-Identifier: BSD-3-Clause
"""The package as a package: version, wheel, source archive, installation without network, its guide."""
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
import sysconfig
import venv
import zipfile

import pytest
import sweeps
from built import cached
from conftest import ok
from program import PROGRAM

import rondo

ROOT = pathlib.Path(__file__).resolve().parents[2]
PYTHON = ROOT / "python"
GUIDE = ROOT / "docs" / "python.md"
BUILD = pathlib.Path(PROGRAM).resolve().parent
PURE = {"module": "no"}
MODULE = cached(BUILD, "RONDO_PYTHON_MODULE")  # "": built without
SETTINGS = {"build-dir": str(BUILD)} if MODULE else PURE
with_module = pytest.mark.skipif(
    not MODULE, reason=f"{BUILD}: {cached(BUILD, 'RONDO_PYTHON_MODULE_MISSING')}")


def backend(folder):
    """python/build_wheel.py, or a copy, as a module."""
    sys.modules.pop("build_module", None)
    sys.path.insert(0, str(folder))
    try:
        return loaded(folder)
    finally:
        sys.path.remove(str(folder))


def loaded(folder):
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
    names = [backend(PYTHON).build_wheel(str(first), PURE),
             backend(second / "python").build_wheel(str(second), PURE)]
    assert names == [f"rondo-{rondo.__version__}-py3-none-any.whl"] * 2
    assert (first / names[0]).read_bytes() == (second / names[1]).read_bytes()


@with_module
def test_the_wheel_of_a_build(wheel, tmp_path):
    """The module is the build's own file, and nothing is looked for where it was built."""
    assert wheel.name == f"rondo-{rondo.__version__}-{platform_tag()}.whl"
    backend(PYTHON).build_wheel(str(tmp_path), SETTINGS)
    assert (tmp_path / wheel.name).read_bytes() == wheel.read_bytes()
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tmp_path)
        modes = {entry.filename: entry.external_attr >> 16 for entry in archive.infolist()}
        info = archive.read(f"rondo-{rondo.__version__}.dist-info/WHEEL").decode().splitlines()
    assert {"Root-Is-Purelib: false", f"Tag: {platform_tag()}"} < set(info)
    binaries = [f"rondo/{MODULE}", "rondo/bin/rondo", "rondo/bin/rondo-mesh-reader"]
    assert [modes[name] for name in binaries] == [0o100644, 0o100755, 0o100755]
    assert (tmp_path / binaries[0]).read_bytes() == (BUILD / "python" / MODULE).read_bytes()
    for name in binaries:
        said = subprocess.run(["readelf", "-d", tmp_path / name], text=True, capture_output=True,
                              check=True).stdout
        assert "NEEDED" in said and "PATH)" not in said, said


def platform_tag():
    python = f"cp{sys.version_info[0]}{sys.version_info[1]}"
    return f"{python}-{python}-{sysconfig.get_platform().replace('-', '_')}"


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheel")
    return folder / backend(PYTHON).build_wheel(str(folder), SETTINGS)


def test_what_is_in_the_wheel(wheel):
    with zipfile.ZipFile(wheel) as wheel:
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
    assert {"rondo/py.typed", "rondo/_core.pyi"} < set(names) and not any("__pycache__" in name for name in names)
    for line in ("Name: rondo", f"Version: {rondo.__version__}", "Requires-Dist: h5py>=3.7",
                 "Requires-Python: >=3.11"):
        assert line in metadata.splitlines()


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """The Python of a new environment, with the package installed from the sources by pip."""
    folder = tmp_path_factory.mktemp("venv")
    venv.create(folder / "env", system_site_packages=True, with_pip=True)
    python = folder / "env" / "bin" / "python"
    settings = [word for name, value in SETTINGS.items()
                for word in ("--config-settings", f"{name}={value}")]
    done = subprocess.run([python, "-m", "pip", "install", "--no-deps", *settings, PYTHON], text=True,
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


@with_module
def test_library_and_program_are_installed(installed, tmp_path):
    """From a folder elsewhere, without RONDO and with nothing else on PATH."""
    environment = {"PATH": "/usr/bin", "HOME": str(tmp_path)}
    (tmp_path / "meshes").symlink_to(ROOT / "cases" / "meshes")
    for name in ("ledge-smooth", "tyre-section"):
        shutil.copy(ROOT / "cases" / f"{name}.toml", tmp_path)
    text = ("import rondo\n"
            "from rondo.studies.program import find_program\n"
            "for name in 'ledge-smooth', 'tyre-section':\n"
            "    print(rondo.Simulation(f'{name}.toml').advance(3))\n"
            "print(find_program().path)\n"
            "print(rondo.about())")
    done = subprocess.run([installed, "-c", text], text=True, capture_output=True, cwd=tmp_path,
                          env=environment)
    assert done.returncode == 0, done.stderr
    first, second, program, *about = done.stdout.splitlines()
    inside = next(installed.parent.parent.glob("lib/python*/site-packages/rondo"))
    assert (first, second, program) == ("3", "3", str(inside / "bin" / "rondo"))
    assert [line.split()[1].rstrip(":") for line in about[1:5]] == [
        str(inside), str(inside / MODULE), program, str(inside / "bin" / "rondo-mesh-reader")]
    assert len(about) == 6, about  # no line that says that the builds differ
    said = subprocess.run([installed.parent / "rondo", "--version"], text=True, capture_output=True,
                          env=environment, cwd=tmp_path)
    own = subprocess.run([program, "--version"], text=True, capture_output=True)
    assert said.stdout == own.stdout and own.returncode == 0


RIGHT = """\
import pathlib

import rondo

simulation = rondo.Simulation("case.toml", {"ground.friction": 0.3}, threads=2)
made: int = simulation.advance(100)
force: float = simulation.now["force_y"]
times = rondo.solve("case.toml", {"output.snapshots": 3}).times
run: rondo.Run = rondo.run(pathlib.Path("case.toml"), "out", overwrite=True)
print(made, force, times[-1], run.status)
"""
WRONG = """\
import rondo
import rondo._core
rondo.Simulation("case.toml", treads=2)
text: str = rondo.Simulation("case.toml").advance(1)
rondo.Simulation("case.toml").advance("1")
rondo.solve("case.toml", 3)
rondo.run("case.toml", "out").no_such_field
rondo._core.run()
"""


@pytest.mark.long
def test_mypy_reads_the_installed_package(installed, tmp_path):
    """Its types are shipped: a right use has no errors, and each wrong one has one."""
    if not shutil.which("mypy", path="/usr/bin"):
        pytest.skip("mypy is missing: scripts/setup.sh --dev")
    (tmp_path / "right.py").write_text(RIGHT)
    (tmp_path / "wrong.py").write_text(WRONG)
    done = subprocess.run(["/usr/bin/mypy", "--python-executable", installed, "--cache-dir",
                           BUILD / "mypy", "right.py", "wrong.py"], text=True, capture_output=True,
                          cwd=tmp_path, env=clean_environment())
    lines = [line.split(":")[:2] for line in done.stdout.splitlines() if ": error: " in line]
    wrong = range(3, len(WRONG.splitlines()) + 1)
    assert lines == [["wrong.py", str(number)] for number in wrong], done.stdout + done.stderr


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


@pytest.mark.long
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

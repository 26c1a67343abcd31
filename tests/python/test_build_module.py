# SPDX-License-Identifier: BSD-3-Clause
"""python/build_module.py: which build directory a wheel is made of, what is said where something is
missing, and a source archive that the library can be built from."""
import os
import pathlib
import shutil
import subprocess
import sys
import sysconfig
import tarfile

import pytest
from built import cached
from program import PROGRAM

import rondo
from rondo import native

ROOT = pathlib.Path(__file__).resolve().parents[2]
PYTHON = ROOT / "python"
BUILD = pathlib.Path(PROGRAM).resolve().parent


def hook(call, folder=PYTHON, **environment):
    """A hook as pip calls it: in a process of its own."""
    text = f"import sys; sys.path.insert(0, {str(folder)!r}); import build_wheel as b; print({call})"
    return subprocess.run([sys.executable, "-c", text], text=True, capture_output=True,
                          env={**os.environ, "PYTHONPATH": "", **environment})


def refused(call, folder=PYTHON, **environment):
    """What is said on stderr, which is no trace of Python."""
    done = hook(call, folder, **environment)
    assert done.returncode == 1 and "Traceback" not in done.stderr, done.stderr
    assert done.stderr.startswith("rondo: "), done.stderr
    return done.stderr


@pytest.fixture(scope="module")
def unpacked(tmp_path_factory):
    """The source archive, unpacked."""
    folder = tmp_path_factory.mktemp("sdist")
    assert hook(f"b.build_sdist({str(folder)!r})").returncode == 0
    with tarfile.open(folder / f"rondo-{rondo.__version__}.tar.gz") as archive:
        assert not any(pathlib.PurePath(name).is_absolute() for name in archive.getnames())
        archive.extractall(folder)
    return folder / f"rondo-{rondo.__version__}"


def test_a_wheel_from_the_source_archive(unpacked, tmp_path):
    assert (unpacked / "PKG-INFO").read_text().startswith("Metadata-Version: 2.1\nName: rondo\n")
    wheel = f"rondo-{rondo.__version__}-py3-none-any.whl"
    for folder in (PYTHON, unpacked):
        (tmp_path / folder.name).mkdir()
        done = hook(f"b.build_wheel({str(tmp_path / folder.name)!r}, {{'module': 'no'}})", folder)
        assert done.stdout == f"{wheel}\n", done.stderr
    assert (tmp_path / "python" / wheel).read_bytes() == (tmp_path / unpacked.name / wheel).read_bytes()
    again = hook(f"b.build_sdist({str(tmp_path)!r})", unpacked)
    assert again.returncode == 0, again.stderr
    archive = f"rondo-{rondo.__version__}.tar.gz"
    assert (tmp_path / archive).read_bytes() == (unpacked.parent / archive).read_bytes()


def test_the_source_archive_has_the_sources_of_the_library(unpacked, tmp_path):
    """All of them, and CMake takes them."""
    for name in ("src", "apps", "cmake", "python/bindings"):
        there = {path.relative_to(ROOT) for path in (ROOT / name).rglob("*") if path.is_file()}
        inside = {path.relative_to(unpacked / "sources")
                  for path in (unpacked / "sources" / name).rglob("*") if path.is_file()}
        assert inside == there, name
    options = ["-DRONDO_BUILD_TESTS=OFF", "-DCMAKE_BUILD_TYPE=Release"]
    done = subprocess.run(["cmake", "-S", unpacked / "sources", "-B", tmp_path, *options], text=True,
                          capture_output=True)
    assert done.returncode == 0, done.stderr
    if cached(BUILD, "RONDO_PYTHON_MODULE"):
        assert cached(tmp_path, "RONDO_PYTHON_MODULE") == cached(BUILD, "RONDO_PYTHON_MODULE")


def test_what_is_missing_is_said(tmp_path):
    call = f"b.build_wheel({str(tmp_path)!r})"
    tools = tmp_path / "bin"
    tools.mkdir()
    said = refused(call, PATH=str(tools))
    assert "no cmake, no C++ compiler (g++), no ninja-build or make: bash " in said
    assert str(ROOT / "scripts" / "setup.sh") in said and "module=no" in said
    for name in ("cmake", "ninja"):
        (tools / name).symlink_to(shutil.which(name))
    assert "there is no C++ compiler" in refused(call, PATH=str(tools), CXX="no-such-compiler")


def test_a_build_without_the_module_is_refused(tmp_path):
    """Configured anew, it still has none: here with a Python that has no headers for it."""
    build = tmp_path / "build"
    done = subprocess.run(["cmake", "-S", ROOT, "-B", build, "-DRONDO_BUILD_TESTS=OFF",
                           "-DCMAKE_DISABLE_FIND_PACKAGE_pybind11=ON"], text=True, capture_output=True)
    assert done.returncode == 0 and "The module of Python will not be built: pybind11" in done.stdout
    said = refused(f"b.build_wheel({str(tmp_path)!r}, {{'build-dir': {str(build)!r}}})")
    assert "pybind11 2.10 or later is missing" in said and "scripts/setup.sh" in said
    (build / "python").mkdir(exist_ok=True)
    script = (build / "cmake_install.cmake").read_text()
    assert "goes without the library (rondo._core)" in script
    assert "pybind11 2.10 or later is missing" in script


def test_builds_of_other_sources_and_other_settings_are_refused(tmp_path):
    (tmp_path / "CMakeCache.txt").write_text(f"CMAKE_HOME_DIRECTORY:INTERNAL={tmp_path}\n")
    call = f"b.build_wheel({str(tmp_path)!r}, {{'build-dir': {str(tmp_path)!r}}})"
    assert f"is a build of {tmp_path}, not of {ROOT}" in refused(call)
    assert "build-dir (a directory), module (yes or no)" in refused("b.build_wheel('.', {'pure': 1})")
    shutil.copytree(PYTHON, tmp_path / "python", ignore=shutil.ignore_patterns("bindings"))
    said = refused("b.build_sdist('.')", tmp_path / "python")
    assert "the sources of the library are neither in" in said


def test_each_python_has_its_build(tmp_path):
    """build/release where it has the module of this Python, else one of its own."""
    top = tmp_path / "rondo"
    (top / "python" / "bindings").mkdir(parents=True)
    (top / "python" / "bindings" / "CMakeLists.txt").touch()
    for name in ("build_module.py", "build_wheel.py", "pyproject.toml"):
        shutil.copy(PYTHON / name, top / "python")
    call = "b.build_module.build_directory(None)"
    own = top / "build" / f"python-{sys.version_info[0]}.{sys.version_info[1]}"
    release = top / "build" / "release"
    release.mkdir(parents=True)
    name = hook("b.build_module.module_name()").stdout.strip()
    for kept, expected in ((name, release), ("_core.cpython-399-x.so", own)):
        (release / "CMakeCache.txt").write_text(f"RONDO_PYTHON_MODULE:INTERNAL={kept}\n")
        assert hook(call, top / "python").stdout == f"{expected}\n"
    (release / "CMakeCache.txt").unlink()
    assert hook(call, top / "python").stdout == f"{release}\n"  # the tests' Python is the system's


NEEDY = """
extern void a_function_that_no_library_has(void);
void *PyInit__core(void) { a_function_that_no_library_has(); return 0; }
"""


def test_a_module_that_cannot_be_loaded(tmp_path):
    """Its library is not there, or is of another version."""
    (tmp_path / "needy.c").write_text(NEEDY)
    module = tmp_path / f"_core{sysconfig.get_config_var('EXT_SUFFIX')}"
    subprocess.run(["cc", "-shared", "-fPIC", "-o", module, tmp_path / "needy.c"], check=True)
    kept = sys.modules.get("rondo._core")
    for said in ("undefined symbol: a_function_that_no_library_has", "file too short"):
        with pytest.raises(rondo.Error, match=rf"{module.name}: cannot be loaded: .*{said}.*setup.sh"):
            native._load(module)
        module.write_text("")
    assert sys.modules.get("rondo._core") is kept


def test_the_build_says_that_a_module_cannot_be_loaded(tmp_path):
    """When it is linked, not when it is first used."""
    (tmp_path / "needy.c").write_text(NEEDY)
    (tmp_path / "CMakeLists.txt").write_text(f"""
cmake_minimum_required(VERSION 3.20)
project(needy C)
set(Python_EXECUTABLE "{sys.executable}")
include("{ROOT}/cmake/module_loads.cmake")
add_library(needy MODULE needy.c)
rondo_module_must_load(needy)
""")
    for text, code in ((NEEDY, 1), (NEEDY.replace("a_function_that_no_library_has();", ""), 0)):
        (tmp_path / "needy.c").write_text(text)
        subprocess.run(["cmake", "-G", "Ninja", "-S", tmp_path, "-B", tmp_path / "build"], check=True,
                       capture_output=True)
        done = subprocess.run(["cmake", "--build", tmp_path / "build"], capture_output=True, text=True)
        assert done.returncode == code, done.stdout
        assert ("undefined symbol: a_function_that_no_library_has" in done.stdout) == (code == 1)
    built = (ROOT / "python" / "bindings" / "CMakeLists.txt").read_text()
    assert "rondo_module_must_load(rondo_python)" in built

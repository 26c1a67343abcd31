# SPDX-License-Identifier: BSD-3-Clause
"""What a wheel holds besides Python: the library as the module rondo._core and the programs, built by
CMake, in build/release of the checkout where they are built already (docs/decisions/012)."""
from __future__ import annotations

import contextlib
import fcntl
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from collections.abc import Iterator

ROOT = pathlib.Path(__file__).resolve().parent
SYSTEM_PYTHON = "/usr/bin/python3"  # for which build/release has the module, as CMakeLists.txt says
TARGETS = ("rondo", "rondo-mesh-reader", "rondo_fmu_binary", "rondo_python")
SOURCES = ("CMakeLists.txt", "LICENSE", "apps", "cmake", "python/bindings", "scripts/setup.sh", "src")
WITHOUT = ("Without the library, to read and draw results only: pip install "
           "--config-settings module=no ...")


class NotBuilt(Exception):
    """Says what is missing and what to install."""


def sources() -> pathlib.Path:
    """Of the library: beside this folder in a checkout, within it in a source archive."""
    for folder in (ROOT / "sources", ROOT.parent):
        if (folder / "python" / "bindings" / "CMakeLists.txt").is_file():
            return folder
    raise NotBuilt(f"{ROOT}: the sources of the library are neither in {ROOT / 'sources'} nor in "
                   f"{ROOT.parent}: take the whole project, or its source archive. {WITHOUT}")


def source_files() -> dict[str, pathlib.Path]:
    """Of the library, by their names below sources()."""
    top = sources()
    found = [path for name in SOURCES for path in ((top / name).rglob("*") if (top / name).is_dir()
                                                   else [top / name])]
    return {path.relative_to(top).as_posix(): path for path in found
            if path.suffix in (".cpp", ".hpp", ".cmake", ".in", ".map", ".txt", ".sh") or path.name == "LICENSE"}


def module_name() -> str:
    """File of the module, for the Python that runs this."""
    return f"_core{sysconfig.get_config_var('EXT_SUFFIX')}"


def tag() -> str:
    """Of a wheel for the Python that runs this: cp311-cp311-linux_x86_64."""
    if sys.implementation.name != "cpython":
        raise NotBuilt(f"the module is for CPython, not for {sys.implementation.name}. {WITHOUT}")
    abi = sysconfig.get_config_var("SOABI").split("-")[1]  # of cpython-311-x86_64-linux-gnu
    platform = re.sub(r"[-.]", "_", sysconfig.get_platform())
    return f"cp{sys.version_info[0]}{sys.version_info[1]}-cp{abi}-{platform}"


def cached(build: pathlib.Path, name: str) -> str | None:
    """What a build directory was configured with; None: not, or nothing of this name."""
    try:
        text = (build / "CMakeCache.txt").read_text()
    except OSError:
        return None
    found = re.search(rf"^{name}:\w+=(.*)$", text, re.MULTILINE)
    return found[1] if found else None


def _of_system_python() -> str:
    text = "import sysconfig; print('_core' + sysconfig.get_config_var('EXT_SUFFIX'))"
    try:
        return subprocess.run([SYSTEM_PYTHON, "-c", text], capture_output=True, text=True,
                              check=True, env=_environment()).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


def build_directory(given: str | None) -> pathlib.Path:
    """build/release where its module is for this Python, else one of this Python's own."""
    top = sources()
    if given is not None:
        return pathlib.Path(given).resolve()
    release = top / "build" / "release"
    if (cached(release, "RONDO_PYTHON_MODULE") or _of_system_python()) == module_name():
        return release
    return top / "build" / f"python-{sys.version_info[0]}.{sys.version_info[1]}"


def _environment() -> dict[str, str]:
    """Without what pip sets for this process: CMake asks Pythons for their places."""
    return {key: value for key, value in os.environ.items()
            if key not in ("PYTHONPATH", "PYTHONHOME", "PYTHONNOUSERSITE")}


def _cmake(*arguments: str | os.PathLike[str]) -> bool:
    command = ["cmake", *map(str, arguments)]
    print("rondo:", *command, flush=True)
    return subprocess.run(command, env=_environment(), check=False).returncode == 0


def _setup() -> str:
    return f"bash {sources() / 'scripts' / 'setup.sh'} installs what is needed on Debian"


def _look_for_tools() -> None:
    compilers = [os.environ["CXX"].split()[0]] if os.environ.get("CXX") else ["c++", "g++", "clang++"]
    missing = [package for package, programs in (
        ("cmake", ["cmake"]), ("C++ compiler (g++)", compilers),
        ("ninja-build or make", ["ninja", "make"])) if not any(map(shutil.which, programs))]
    if missing:
        raise NotBuilt(f"the library is built from C++, and there is no {', no '.join(missing)}: "
                       f"{_setup()}. {WITHOUT}")


def _configure(build: pathlib.Path) -> None:
    """Anew, or again where its module is for no Python or for another one."""
    arguments: list[str | os.PathLike[str]] = ["-S", sources(), "-B", build]
    if cached(build, "CMAKE_HOME_DIRECTORY") is None:
        arguments += ["-DCMAKE_BUILD_TYPE=Release", "-DRONDO_BUILD_TESTS=OFF"]
        arguments += ["-G", "Ninja"] if shutil.which("ninja") else []
    if module_name() != _of_system_python():
        python = os.path.realpath(getattr(sys, "_base_executable", "") or sys.executable)
        arguments.append(f"-DPython_EXECUTABLE={python}")
    if not _cmake(*arguments):
        raise NotBuilt(f"CMake found something missing, or wrong, as it says above: {_setup()}. "
                       f"{WITHOUT}")
    its = cached(build, "RONDO_PYTHON_MODULE")
    if its != module_name():
        why = cached(build, "RONDO_PYTHON_MODULE_MISSING") or f"its module is {its}"
        raise NotBuilt(f"{build}: {why}; wanted for {sys.executable}: {module_name()}; pybind11 and "
                       f"the headers of this Python (pybind11-dev, python3-dev): {_setup()}. {WITHOUT}")


def _check_home(build: pathlib.Path) -> None:
    home = cached(build, "CMAKE_HOME_DIRECTORY")
    if home is not None and not (os.path.exists(home) and os.path.samefile(home, sources())):
        raise NotBuilt(f"{build}: is a build of {home}, not of {sources()}: remove it, or name "
                       "another one, --config-settings build-dir=DIRECTORY")


@contextlib.contextmanager
def _alone(build: pathlib.Path) -> Iterator[None]:
    """One pip at a time in a build directory."""
    build.mkdir(parents=True, exist_ok=True)
    with open(build / ".wheel.lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def build(given: str | None = None) -> dict[str, bytes]:
    """The files of the package that CMake makes, by their names in it. given: build directory."""
    tag()
    _look_for_tools()
    directory = build_directory(given)
    _check_home(directory)
    with _alone(directory), tempfile.TemporaryDirectory() as folder:
        if cached(directory, "RONDO_PYTHON_MODULE") != module_name():
            _configure(directory)
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL") or str(len(os.sched_getaffinity(0)))
        if not _cmake("--build", directory, "--parallel", jobs, "--target", *TARGETS):
            raise NotBuilt(f"{directory}: cannot be built, as the compiler says above")
        if not _cmake("--install", directory, "--component", "wheel", "--prefix", folder):
            raise NotBuilt(f"{directory}: CMake cannot install what it has built")
        found = {path.relative_to(folder).as_posix(): path.read_bytes()
                 for path in pathlib.Path(folder).rglob("*") if path.is_file()}
    wanted = {f"rondo/{module_name()}", "rondo/bin/rondo", "rondo/bin/rondo-mesh-reader",
              "rondo/bin/rondo_fmu.so"}
    if set(found) != wanted:
        raise NotBuilt(f"{directory}: made {sorted(found)}, not {sorted(wanted)}")
    return found

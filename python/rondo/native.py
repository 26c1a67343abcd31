# SPDX-License-Identifier: BSD-3-Clause
"""The library in this process: where its module is, and what every call to it shares."""
from __future__ import annotations

import atexit
import importlib.machinery
import importlib.util
import json
import os
import pathlib
import sys
import warnings
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from .data.errors import Error, InputError
from .options import OPTIONS
from .studies.program import CHECKOUT, find_program

if TYPE_CHECKING:
    from types import ModuleType

Place = str | os.PathLike[str]

PACKAGE = pathlib.Path(__file__).resolve().parent
READER = "rondo-mesh-reader"


@cache
def core() -> Any:
    """The module, as _core.pyi has it (a module is no type for mypy): that of this package or, where
    it has none, the one beside the program."""
    suffixes = [suffix for suffix in importlib.machinery.EXTENSION_SUFFIXES if "abi" in suffix
                or "cpython" in suffix]
    found = next((file for folder in _folders() for suffix in suffixes
                  if (file := folder / f"_core{suffix}").is_file()), None)
    if found is None:
        others = [file.name for folder in _folders() for file in folder.glob("_core.*.so")]
        why = (f"; {', '.join(others)} is of another Python than this one ({sys.executable}, "
               f"{sys.implementation.cache_tag})" if others else "")
        raise Error(f"rondo._core, the library for Python, is not built{why}: build rondo with "
                    "pybind11-dev installed (scripts/setup.sh), with this Python "
                    "(-DPython_EXECUTABLE), or use the commands of the program")
    _give_mesh_reader(found.parent)
    return _load(found)


def _folders() -> Iterator[pathlib.Path]:
    """Where the module may be; the program is asked for only where the package has none."""
    yield PACKAGE
    try:
        yield pathlib.Path(find_program().path).resolve().parent / "python"
    except Error:
        pass  # the package may go without
    yield CHECKOUT / "build" / "release" / "python"


def _load(file: pathlib.Path) -> Any:
    name = f"{__package__}._core"
    spec = importlib.util.spec_from_file_location(name, file)
    assert spec is not None and spec.loader is not None
    try:
        module: ModuleType = importlib.util.module_from_spec(spec)
        sys.modules[name] = module
        spec.loader.exec_module(module)
    except ImportError as reason:
        raise Error(f"{file}: cannot be loaded: {reason}; install the libraries it was built with "
                    "(scripts/setup.sh), or build rondo anew") from None
    if module.version != _version():
        raise Error(f"{file}: is of rondo {module.version}, and this package of {_version()}: "
                    "build both from the same sources")
    atexit.register(module.end_calls)
    return module


def _version() -> str:
    return str(sys.modules[PACKAGE.name].__version__)  # imported by it: an import would go in a circle


def _give_mesh_reader(folder: pathlib.Path) -> None:
    """The program that reads Gmsh files is looked for beside the one that runs: Python, here."""
    if os.environ.get("RONDO_MESH_READER"):
        return
    for place in (folder / "bin" / READER, folder.parent / READER):
        if os.access(place, os.X_OK):
            os.environ["RONDO_MESH_READER"] = str(place)
            return
    try:
        place = pathlib.Path(find_program().path).resolve().parent / READER
    except Error:
        return
    if os.access(place, os.X_OK):
        os.environ["RONDO_MESH_READER"] = str(place)


def warn(text: str) -> None:
    """A warning at the line that called the package."""
    level, caller = 2, sys._getframe(1)
    while caller.f_back and caller.f_globals.get("__name__", "").startswith("rondo."):
        level, caller = level + 1, caller.f_back
    warnings.warn(text, stacklevel=level)


def toml(value: Any) -> str:
    """A value of a case as --set takes it."""
    if isinstance(value, (np.ndarray, np.generic)):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(toml(item) for item in value)}]"
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value), ensure_ascii=False)
    if isinstance(value, (int, float)):
        return repr(value)
    raise Error(f"a setting is a number, a text, a boolean or a list of them, not {value!r}")


def pairs_of(settings: Mapping[str, Any] | None) -> list[tuple[str, Any]]:
    """Keys of a case with their values."""
    if not isinstance(settings, Mapping | None):
        raise InputError(f"settings = {settings!r}: are no dict of keys and values, as "
                         '{"ground.friction": 0.6}')
    for key in settings or {}:
        if not isinstance(key, str):
            raise InputError(f'{key!r}: is no key of a case, as "ground.friction"')
    return list((settings or {}).items())


def settings_of(settings: Mapping[str, Any] | None) -> list[str]:
    """The same, as the program takes them."""
    return [_as_utf8(f"{key}={toml(value)}") for key, value in pairs_of(settings)]


def options_in(command: str, given: Mapping[str, Any]) -> dict[str, Any]:
    """The options of a command that are given among the arguments of a function, as the library takes them."""
    found = {name: given[name] for name in OPTIONS[command] if given.get(name) is not None}
    return {name: _as_utf8(os.fspath(value)) if isinstance(value, (str, os.PathLike)) else value
            for name, value in found.items()}


Function = TypeVar("Function", bound=Callable[..., Any])


def documented(command: str) -> Callable[[Function], Function]:
    """Adds to a function's documentation the options of the command that it takes."""
    def with_options(function: Function) -> Function:
        taken = getattr(function, "__kwdefaults__")
        rows = [f"    {name}: {meaning}." for name, (_, meaning) in OPTIONS[command].items() if name in taken]
        function.__doc__ = "\n".join([f"{function.__doc__}\n", *rows])
        return function
    return with_options


def place_of(path: Any) -> pathlib.Path:
    """A path that the library can name in what it says."""
    try:
        place = pathlib.Path(path)
    except TypeError:
        raise InputError(f"{path!r}: is no path: a text or a pathlib.Path is expected") from None
    _as_utf8(str(place))
    return place


def _as_utf8(text: str) -> str:
    """Bytes that are no UTF-8 stand in Python's texts as characters that nothing else takes."""
    try:
        text.encode()
    except UnicodeEncodeError:
        raise InputError(f"{text!r}: is not UTF-8, as paths and texts have to be: rename "
                         "it") from None
    return text


def whole_number(what: str, value: Any, least: int) -> int:
    """Where it is one, and not below the least."""
    try:
        number = int(value)
        if number != value or number < least:
            raise ValueError
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"{what} = {value!r}: is no whole number of {least} or more") from None
    return number

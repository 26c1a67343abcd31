# SPDX-License-Identifier: BSD-3-Clause
"""rondo/_core.pyi says what the built module has: names, arguments, and their types as the module's
own signatures have them. (mypy.stubtest reads no signatures of pybind11, and takes a minute.)"""
import ast
import pathlib

import pytest
from built import cached
from program import PROGRAM

import rondo
from rondo.native import core

STUB = pathlib.Path(rondo.__file__).with_name("_core.pyi")
BUILD = pathlib.Path(PROGRAM).resolve().parent
SAME = {"os.PathLike": "path", "pathlib.Path": "path", "List": "list", "Sequence": "list",
        "Dict": "dict", "Tuple": "tuple", "typing.List": "list", "SupportsInt": "int",
        "SupportsFloat": "float", "numpy.ndarray": "np.ndarray"}


@pytest.fixture
def module(monkeypatch):
    if not cached(BUILD, "RONDO_PYTHON_MODULE"):
        pytest.skip(cached(BUILD, "RONDO_PYTHON_MODULE_MISSING"))
    monkeypatch.setenv("RONDO", PROGRAM)
    return core()


def kinds(annotation):
    """{"path", "str"} of `pathlib.Path | str`: without what containers hold."""
    text = ast.unparse(annotation)
    names = {one.split("[")[0].strip() for one in text.split(" | ")}
    return {SAME.get(name, name) for name in names}


def signature(function):
    return ([(one.arg, kinds(one.annotation)) for one in function.args.args if one.arg != "self"],
            kinds(function.returns))


def of_stub(body):
    return {item.name: signature(item) for item in body if isinstance(item, ast.FunctionDef)}


def of_module(space):
    """From the line that pybind11 writes: run(file: os.PathLike, settings: List[str]) -> tuple"""
    lines = {name: thing.__doc__.splitlines()[0] for name, thing in vars(space).items()
             if callable(thing) and not isinstance(thing, type)
             and (name == "__init__" or not name.startswith("_"))}
    return {name: signature(ast.parse(f"def {line}: ...").body[0]) for name, line in lines.items()}


def same(stub, built):
    """Where the module says `object` the stub says which."""
    return "object" in built or built <= stub


def compare(stub, built, where):
    assert sorted(stub) == sorted(built), where
    for name, (arguments, returned) in built.items():
        expected, expected_returned = stub[name]
        assert [arg for arg, _ in expected] == [arg for arg, _ in arguments], f"{where}{name}"
        for (arg, expected_kinds), (_, kinds_) in zip(expected, arguments):
            assert same(expected_kinds, kinds_), f"{where}{name}: {arg}: {expected_kinds} {kinds_}"
        assert same(expected_returned, returned), f"{where}{name}: {expected_returned} {returned}"


def test_stub_and_module_agree(module):
    tree = ast.parse(STUB.read_text()).body
    compare(of_stub(tree), of_module(module), "")
    classes = {item.name: item for item in tree if isinstance(item, ast.ClassDef)}
    assert sorted(classes) == sorted(name for name, thing in vars(module).items()
                                     if isinstance(thing, type))
    for name, item in classes.items():
        compare(of_stub(item.body), of_module(getattr(module, name)), f"{name}.")
    values = {item.target.id: ast.unparse(item.annotation) for item in tree
              if isinstance(item, ast.AnnAssign)}
    assert values == {name: type(thing).__name__ for name, thing in vars(module).items()
                      if not name.startswith("_") and not callable(thing)}

# SPDX-License-Identifier: BSD-3-Clause
"""Which module of the package imports which: data draws nothing, and nothing goes round in a
circle. Imports inside functions and those for types alone count as all others do."""
import ast
import pathlib

import pytest

PACKAGE = pathlib.Path(__file__).resolve().parents[2] / "python" / "rondo"
DRAWS = ("plots", "figures", "pictures", "style")
ALLOWED = {  # by the first folder, or the module itself: what it may import besides its own
    "data": set(), "style": set(), "plots": {"data", "files", "style"}, "studies": {"data", "native"},
    "figures": {"data", "plots", "style"}, "pictures": {"data", "files", "plots", "reports"},
    "reports": {"data", "figures", "plots", "rig", "style"},
    "rig": {"data", "files", "magic_formula", "plots", "reports", "style", "studies"},
    "native": {"data", "options", "studies"}, "options": set(), "about": {"data", "native", "studies"},
    "_core": set(), "matrices": {"_core", "data"},
    "simulation": {"_core", "data", "matrices", "native"}, "solution": {"data", "native", "simulation"},
    "files": {"_core", "data", "native"}, "axes": {"data"}, "magic_formula": {"data"},
    "calls": {"data", "native", "studies"}, "reduced_wheel": {"calls", "data", "native", "simulation"},
    "__init__": {"about", "axes", "calls", "data", "files", "magic_formula", "pictures", "interrupts", "needs",
                 "reduced_wheel", "simulation", "solution"},
    "command_help": set(), "interrupts": {"needs"}, "needs": set(),
    "__main__": {"__init__", "about", "command_help", "interrupts", "needs", "data", "studies", "figures", "reports", "rig", "style"},
}


def imports(root):
    """{module: modules of the package that it imports}, as "data.run"; the package itself is
    "__init__"."""
    files = {".".join(path.relative_to(root).with_suffix("").parts): path
             for path in [*root.rglob("*.py"), *root.rglob("*.pyi")]}
    known = {name.removesuffix(".__init__"): name for name in files}
    found = {}
    for name, path in files.items():
        found[name] = set()
        here = name.split(".")[:-1]
        for node in ast.walk(ast.parse(path.read_text())):
            targets = []
            if isinstance(node, ast.Import):
                targets = [alias.name for alias in node.names]
            elif isinstance(node, ast.ImportFrom):
                base = here[: len(here) - node.level + 1] if node.level else []
                stem = ".".join([*(["rondo"] if node.level else []), *base,
                                 *([node.module] if node.module else [])])
                targets = [f"{stem}.{alias.name}" for alias in node.names]
            for target in targets:
                parts = target.split(".")
                if parts[0] != "rondo":
                    continue
                inside = [".".join(parts[1:k]) for k in (len(parts), len(parts) - 1)]
                wanted = next((known[one] for one in inside if one in known), "__init__")
                if wanted != name:
                    found[name].add(wanted)
    return found


def circle(graph):
    """The modules of a circle, in turn; none: []."""
    done = set()

    def walk(name, path):
        if name in path:
            return path[path.index(name):]
        if name in done:
            return []
        for other in sorted(graph[name]):
            if found := walk(other, [*path, name]):
                return found
        done.add(name)
        return []

    return next((found for name in sorted(graph) if (found := walk(name, []))), [])


def room(name):
    return name.split(".")[0]


def test_no_circle():
    graph = imports(PACKAGE)
    assert graph["pictures"] >= {"data.run", "plots.field"}  # within a function
    assert circle(graph) == []


def test_each_room_imports_what_it_may():
    for name, others in imports(PACKAGE).items():
        for other in others:
            assert room(other) == room(name) or room(other) in ALLOWED[room(name)], (name, other)
    assert not ALLOWED["data"] & set(DRAWS) and not ALLOWED["studies"] & set(DRAWS)


@pytest.mark.parametrize("line", ["from .b import x", "from rondo import b", "import rondo.b",
                                  "def f():\n    from . import b", "from rondo.b import x",
                                  "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n"
                                  "    from .b import x"])
def test_a_circle_is_found(tmp_path, line):
    (tmp_path / "__init__.py").write_text("")
    (tmp_path / "a.py").write_text(line)
    (tmp_path / "b.py").write_text("import os\nfrom .c import y")
    (tmp_path / "c.py").write_text("x = 1")
    assert circle(imports(tmp_path)) == []
    (tmp_path / "c.py").write_text("from . import a")
    assert sorted(circle(imports(tmp_path))) == ["a", "b", "c"]

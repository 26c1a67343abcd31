# SPDX-License-Identifier: BSD-3-Clause
"""A module includes only what its line below names; a back edge or a cycle fails the test.

    python3 check_layers.py [ROOT]     prints each include that breaks the rule
"""
import pathlib
import re
import sys

# Direct and indirect: what a module may include besides itself.
ALLOWED = {
    "core": set(),
    "mesh": {"core"},
    "fem": {"core", "mesh"},
    "contact": {"core"},
    "dynamics": {"core", "mesh", "fem", "contact"},
    "statics": {"core", "mesh", "fem", "contact"},
    "modal": {"core", "mesh", "fem"},
    "reduction": {"core", "mesh"},
    "reduced": {"core", "mesh", "contact", "dynamics", "reduction"},
}
ALLOWED["io"] = set(ALLOWED)
ALLOWED["study"] = set(ALLOWED)
ALLOWED["apps"] = {"core", "study"}
ALLOWED["mesh_reader"] = {"mesh"}  # a program of its own; it shares the layout of its output

# Libraries that only these modules may see.
ONLY_IN = {"hdf5.h": {"io"}, "toml++/": {"study"}, "CLI/": {"apps"}, "cholmod": {"statics"},
           "CholmodSupport": {"modal", "statics"}, "Spectra/": {"dynamics"},
           "lapacke": {"reduction"}, "xxhash": {"io"}, "fftw3": {"reduction"},
           "gmsh.h": {"mesh_reader"}, "mpi.h": {"apps"}}

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^">]+)[">]', re.MULTILINE)


def module_of(path, root):
    parts = path.relative_to(root).parts
    if parts[:2] == ("apps", "mesh_reader"):
        return "mesh_reader"
    return "apps" if parts[0] == "apps" else parts[2]


def faults(root):
    files = [p for folder in ("src/rondo", "apps") for p in sorted((root / folder).rglob("*.?pp"))]
    if not files:
        yield f"no sources under {root}"
    for path in files:
        module = module_of(path, root)
        for name in INCLUDE.findall(path.read_text()):
            place = f"{path.relative_to(root)} includes {name}"
            if name.startswith("rondo/"):
                other = name.split("/")[1]
                if other != module and other not in ALLOWED.get(module, set()):
                    yield f"{place}: {module} may not see {other}"
            for library, homes in ONLY_IN.items():
                if library in name and module not in homes:
                    yield f"{place}: only {' and '.join(sorted(homes))} may"


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()
    found = list(faults(root))
    print("\n".join(found) if found else "layers: no back edge")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

# SPDX-License-Identifier: BSD-3-Clause
"""A module includes only what its line below names; a back edge or a cycle fails the test.

    python3 check_layers.py [ROOT]     prints each include that breaks the rule
"""
import pathlib
import re
import sys

# Direct and indirect: what a room may include besides itself. A room is a folder of src/rondo, or
# of one of those in SUB_ROOMS.
BELOW_MODEL = {"core", "mesh", "fem", "contact"}
ALLOWED = {
    "core": set(),
    "mesh": {"core"},
    "fem": {"core", "mesh"},
    "contact": {"core"},
    "model": BELOW_MODEL,
    "integrators": BELOW_MODEL | {"model"},
    "statics": BELOW_MODEL,
    "modal": {"core", "mesh", "fem"},
    "pod": {"core", "mesh"},
    "rom": BELOW_MODEL | {"model", "integrators", "pod"},
    "case": BELOW_MODEL | {"model"},
}
ALLOWED["io"] = set(ALLOWED) - {"case"}
ALLOWED["output"] = BELOW_MODEL | {"model", "integrators", "case", "io"}
ALLOWED["analysis"] = set(ALLOWED)
ALLOWED["study/sweep"] = set(ALLOWED["analysis"]) | {"analysis"}
ALLOWED["study/pod"] = ALLOWED["study/sweep"] | {"study/sweep"}
ALLOWED["study/reduce"] = ALLOWED["study/pod"] | {"study/pod"}
ALLOWED["apps"] = {"core", "analysis", "output", "case", "study/pod", "study/sweep", "study/reduce"}
ALLOWED["mesh_reader"] = {"mesh"}  # a program of its own; it shares the layout of its output
SUB_ROOMS = {"study"}

# Libraries that only these modules may see.
ONLY_IN = {"hdf5.h": {"io"}, "toml++/": {"case"}, "CLI/": {"apps"}, "cholmod": {"statics"},
           "CholmodSupport": {"modal", "statics"}, "Spectra/": {"model"},
           "lapacke": {"pod"}, "xxhash": {"io"}, "fftw3": {"pod"},
           "gmsh.h": {"mesh_reader"}, "mpi.h": {"apps"}}

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^">]+)[">]', re.MULTILINE)


def module_of(path, root):
    parts = path.relative_to(root).parts
    if parts[:2] == ("apps", "mesh_reader"):
        return "mesh_reader"
    return "apps" if parts[0] == "apps" else room_of(parts[2:])


def room_of(parts):
    """Of a path below src/rondo, or of the name of an include behind "rondo/"."""
    return "/".join(parts[:2]) if parts[0] in SUB_ROOMS else parts[0]


def faults(root):
    files = [p for folder in ("src/rondo", "apps") for p in sorted((root / folder).rglob("*.?pp"))]
    if not files:
        yield f"no sources under {root}"
    for path in files:
        module = module_of(path, root)
        for name in INCLUDE.findall(path.read_text()):
            place = f"{path.relative_to(root)} includes {name}"
            if name.startswith("rondo/"):
                other = room_of(name.split("/")[1:])
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

# SPDX-License-Identifier: BSD-3-Clause
"""A module includes only what its line below names; a back edge or a cycle fails the test, and so
does a folder with more files than a reader takes in.

    python3 check_layers.py [ROOT]     prints each include that breaks the rule
"""
import collections
import pathlib
import re
import sys

# What a module may include besides itself, direct and indirect. A module is a folder of src/rondo; its
# sub-modules are the folders in it that have a line of their own.
SOLIDS = {"core", "road", "mesh", "fem", "contact", "contact/coupled", "model/stability"}
ALLOWED = {
    "core": set(),
    "road": {"core"},
    "mesh": {"core"},
    "fem": {"core", "mesh"},
    "contact": {"core", "road"},
    "contact/coupled": {"core", "contact"},
    "model/stability": {"core", "mesh", "fem"},
    "model": SOLIDS,
    "integrators/implicit": SOLIDS | {"model"},
    "integrators/massless": SOLIDS | {"model", "integrators/implicit"},
    "integrators/general": SOLIDS | {"model", "integrators/implicit", "integrators/massless"},
    "integrators/hati": SOLIDS | {"model", "integrators/implicit", "integrators/general"},
    "integrators/solid": SOLIDS | {"model", "integrators/implicit", "integrators/general"},
    "integrators/fused": SOLIDS | {"model", "integrators/implicit", "integrators/massless",
                                   "integrators/general", "integrators/solid"},
    "integrators/bodies": SOLIDS | {"model", "integrators/implicit", "integrators/massless",
                                    "integrators/general", "integrators/solid",
                                    "integrators/fused"},
    "integrators": SOLIDS | {"model", "integrators/implicit", "integrators/massless",
                             "integrators/general", "integrators/hati", "integrators/fused",
                             "integrators/bodies", "integrators/solid"},
    "statics": SOLIDS,
    "statics/inflation": {"core", "mesh", "fem"},
    "statics/latin": SOLIDS | {"statics"},
    "statics/steady": SOLIDS | {"statics"},
    "modal": {"core", "mesh", "fem"},
    "pod": {"core", "mesh"},
    "rom/wheel": {"core", "mesh", "fem", "contact", "contact/coupled", "modal", "model",
                  "statics"},
    "rom/solid": SOLIDS | {"modal", "model", "statics", "integrators/fused", "rom/wheel"},
    "rom": SOLIDS | {"modal", "model", "integrators", "integrators/fused", "pod", "rom/wheel",
                     "rom/solid"},
    "case": SOLIDS | {"model"},
    "io/h5": {"core"},
}
ALLOWED["io"] = set(ALLOWED) - {"case"}
STEPS = {"model", "integrators", "integrators/massless", "integrators/fused"}
ALLOWED["output"] = SOLIDS | STEPS | {"case", "io"}
ALLOWED["analysis/elements"] = SOLIDS | {"model", "integrators/massless", "case"}
ALLOWED["analysis/build"] = SOLIDS | STEPS | {"statics", "statics/inflation", "statics/steady", "case",
                                              "output", "analysis/elements"}
ALLOWED["analysis/figures"] = {"core", "io", "output"}
ALLOWED["analysis/base"] = SOLIDS | {"model", "case", "io", "output"}
ALLOWED["analysis/steady"] = (ALLOWED["analysis/build"] | ALLOWED["analysis/base"] |
                              {"statics/steady", "modal", "analysis/base", "analysis/build",
                               "analysis/figures"})
ALLOWED["analysis/matrices"] = ALLOWED["analysis/build"] | {"io", "io/h5", "analysis/build"}
ALLOWED["analysis"] = set(ALLOWED)
ALLOWED["analysis/modes"] = ALLOWED["analysis"] | {"analysis"}
ALLOWED["analysis/simulation"] = ALLOWED["analysis"] | {"analysis"}
ALLOWED["fmu"] = ALLOWED["analysis"] | {"analysis"}
ALLOWED["study/sweep"] = ALLOWED["analysis"] | {"analysis"}
ALLOWED["study/shards"] = ALLOWED["study/sweep"] | {"study/sweep"}
ALLOWED["study/pod"] = ALLOWED["study/sweep"] | {"study/sweep"}
ALLOWED["study/reduce"] = ALLOWED["study/pod"] | {"study/pod"}
ALLOWED["study/options"] = ALLOWED["study/reduce"] | {"study/reduce", "analysis/matrices",
                                                             "analysis/modes"}
ALLOWED["study/run_json"] = ALLOWED["analysis/modes"] | {"analysis/modes"}
ALLOWED["apps"] = {"core", "case", "output", "analysis/base", "analysis/build", "analysis",
                   "analysis/matrices", "analysis/modes", "fmu", "io", "study/pod", "study/sweep",
                   "study/shards", "study/reduce", "study/run_json", "study/options"}
ALLOWED["mesh_reader"] = {"mesh"}  # a program of its own; it shares the layout of its output

# Libraries that only these modules may see.
ONLY_IN = {"hdf5.h": {"io/h5"}, "toml++/": {"case"}, "CLI/": {"apps"}, "cholmod": {"statics"},
           "CholmodSupport": {"modal", "statics"}, "Spectra/": {"model/stability"},
           "lapacke": {"core", "pod", "statics/steady"}, "xxhash": {"io/h5"},
           "fftw3": {"pod", "statics/steady"},
           "gmsh.h": {"mesh_reader"}, "mpi.h": {"apps"}}

MOST_FILES = 30  # in a folder: 30 that each hold one concept are read more easily than two folders of 15

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^">]+)[">]', re.MULTILINE)


def module_of(path, root):
    parts = path.relative_to(root).parts
    if parts[:2] == ("apps", "mesh_reader"):
        return "mesh_reader"
    return "apps" if parts[0] == "apps" else module_of_parts(parts[2:])


def module_of_parts(parts):
    """Of a path below src/rondo, or of the name of an include behind "rondo/"."""
    module = "/".join(parts[:2])
    return module if module in ALLOWED else parts[0]


def faults(root):
    files = [p for folder in ("src/rondo", "apps") for p in sorted((root / folder).rglob("*.?pp"))]
    if not files:
        yield f"no sources under {root}"
    for folder, n in sorted(collections.Counter(path.parent for path in files).items()):
        if n > MOST_FILES:
            yield f"{folder.relative_to(root)} holds {n} files, more than {MOST_FILES}: sub-modules"
    for path in files:
        module = module_of(path, root)
        for name in INCLUDE.findall(path.read_text()):
            place = f"{path.relative_to(root)} includes {name}"
            if name.startswith("rondo/"):
                other = module_of_parts(name.split("/")[1:])
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

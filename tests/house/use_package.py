# SPDX-License-Identifier: BSD-3-Clause
"""The installed Python package, as who has nothing else uses it:
    use_package.py PREFIX MODULE WHY-THERE-IS-NONE"""
import os
import pathlib
import subprocess
import sys

import rondo
import rondo.figures.run_figures  # the folders below are there too
from rondo.studies.program import find_program

PREFIX, MODULE = pathlib.Path(sys.argv[1]), sys.argv[2]
CASES = PREFIX / "share" / "rondo" / "cases"


def in_process(package):
    assert rondo.native.core().__file__ == str(package / MODULE)
    for name in ("ledge-smooth", "tyre-section"):  # a disk, and a mesh of Gmsh
        simulation = rondo.Simulation(CASES / f"{name}.toml")
        assert simulation.advance(5) == 5, name
    run = rondo.run(CASES / "crush-smooth.toml", "crush", {"analysis.increments": 3})
    assert run.status == "done" and run.directory == pathlib.Path("crush")
    said = rondo.about()
    assert str(package / MODULE) in said and "different builds" not in said, said


package = pathlib.Path(rondo.__file__).parent
assert PREFIX in package.parents, package
program = find_program()
assert os.path.samefile(program.path, PREFIX / "bin" / "rondo"), program
assert program.version == rondo.__version__
subprocess.run([program.path, "check", CASES / "tyre-section.toml"], check=True,
               stdout=subprocess.DEVNULL)
if MODULE:
    in_process(package)
else:
    print(f"LEFT OUT: the library in this process: {sys.argv[3]}")
print("rondo", rondo.__version__, "for Python")

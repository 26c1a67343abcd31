# SPDX-License-Identifier: BSD-3-Clause
"""Break the program one term at a time: the tests that check the term must fail.

    python3 tests/mutations.py [--only TEXT] [--build DIR]
    python3 tests/mutations.py --check

Run by hand, not by ctest: a quarter of an hour on one core. Works on the last commit, in a clone in
a temporary folder, or in DIR, kept for the next time. --only takes the mutations whose name holds
TEXT. --check breaks nothing: it looks whether the table fits the sources as they stand. A mutation
is seen if of each of its test patterns at least one test fails. Prints a table
`mutation | tests that failed | verdict`; exit 1 if a mutation survives, 2 if the table no longer
fits the sources or if tests fail without any mutation.
"""
import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
TIMEOUT = 900  # s for one call of a test program; what hangs has failed

PROGRAMS = {"V": "verification/verification", "W": "verification/verification_long",
            "R": "verification/verification_reducibility"}
PROGRAMS |= {m: f"unit/unit_{m}" for m in ("core", "road", "mesh", "fem", "contact", "model", "integrators",
                                           "statics", "modal", "pod", "rom", "case", "io",
                                           "output", "analysis", "study")} | {"fmuunit": "unit/unit_fmu"}

SCRIPTS = {"cli": "test_run.py", "lengths": "test_contact_lengths.py", "disk": "test_full_disk.py", "crush": "test_crush.py", "slipstep": "test_slip_step.py",
           "histories": "test_crush_histories.py",
           "pod": "test_pod.py", "ring": "test_ring.py", "modes": "test_modes.py", "limits": "test_limits.py",
           "numerical": "test_numerical.py", "resume": "test_resume.py",
           "terminal": "test_terminal.py", "sweep": "test_sweep.py", "sweeplatin": "test_sweep_latin.py", "team": "test_sweep_team.py",
           "shards": "test_sweep_shards.py", "shardswrong": "test_sweep_shards_wrong.py",
           "reduce": "test_reduce.py", "solid": "test_solid.py", "tyre": "test_tyre.py", "tyrerolling": "test_tyre_rolling.py", "tyresteady": "test_tyre_steady_nonlinear.py", "tyrecheck": "test_tyre_check.py", "tyrecrush": "test_tyre_crush.py", "viscosity": "test_viscosity.py", "loss3d": "test_reduced_loss_3d.py",
           "fmu": "test_fmu.py", "fmuspace": "test_fmu_space.py", "fmufiles": "test_fmu_files.py", "rim": "test_wheel_rim.py", "schema": "test_schema.py", "small": "test_small_obstacles.py", "roads": "test_road.py",
           "obstacles": "test_obstacles.py", "angles": "test_obstacle_angles.py", "frictionwork": "test_friction_work.py", "frictiontables": "test_friction_tables.py",
           "push": "test_push_words.py", "latin": "test_latin.py"}

PACKAGE = {"rigfit": "test_rig_fit.py", "rigreport": "test_rig_report.py", "rigagainst": "test_rig_against.py",
           "rigfigures": "test_rig_figures.py", "rigcommand": "test_rig_command.py",
           "rigplane": "test_rig_plane.py"}  # in tests/python

# @file in src/rondo, or from the root where it begins with python/, then of each mutation in it: name | old text => new text | tests.
# \n is a new line; a line that begins with spaces continues the one above. The tests are
# program:filter, with the names in PROGRAMS and gtest's filters, or name:pattern with those in
# SCRIPTS (unittest's -k) and in PACKAGE (pytest's -k).
TABLE = (ROOT / "tests" / "mutations.txt").read_text()


def table(tree, only):
    """[(name, path, old, new, [(program, filter)])]; each old text must be there exactly once."""
    rows, faults, path = [], [], None
    for line in TABLE.strip().replace("\n  ", " ").splitlines():
        if line.startswith("@"):
            path = tree / ("" if line.startswith("@python/") else "src/rondo") / line[1:]
            continue
        name, change, tests = line.split(" | ")
        old, new = (part.strip().replace("\\n", "\n") for part in change.split("=>"))
        found = path.read_text().count(old)
        if found != 1:
            faults.append(f"{name}: found {found} times in {path.name}: {old!r}")
        if only in name:
            rows.append((name, path, old, new, [tuple(t.split(":", 1)) for t in tests.split()]))
    if faults or not rows:
        print(*faults or ["no mutation of that name"], sep="\n")
        sys.exit(2)
    return rows


def run(command, **options):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          errors="replace", **options)
    return done.returncode, done.stdout


def make(build, tests):
    targets = {pathlib.Path(PROGRAMS.get(program, "rondo")).name for program, _ in tests}
    return run(["cmake", "--build", build, "-j1", "--target", *sorted(targets)])


def failures(tree, build, program, pattern):
    """Names of the tests that fail, sorted."""
    command = [build / "tests" / PROGRAMS.get(program, ""), f"--gtest_filter={pattern}"]
    if program in SCRIPTS:
        command = ["/usr/bin/python3", tree / "tests/cli" / SCRIPTS[program], "-k", pattern]
    if program in PACKAGE:
        command = ["/usr/bin/python3", "-m", "pytest", "-q", "-p", "no:cacheprovider", tree / "tests/python" / PACKAGE[program],
                   "-k", pattern]
    try:
        code, said = run(command, timeout=TIMEOUT,
                         env={**os.environ, "RONDO": str(build / "rondo"), "PYTHONPATH": str(tree / "python"),
                              "MPLBACKEND": "Agg", "RONDO_MESH_READER": str(build / "rondo-mesh-reader")})
    except subprocess.TimeoutExpired:
        return [f"{program}:{pattern} (out of time)"]
    if re.search(r"Ran 0 tests|Running 0 tests|^\d+ deselected", said, re.M):
        sys.exit(f"no test is called {program}:{pattern}")
    names = set(re.findall(r"^\[  FAILED  \] (\w\S*\.[^\s,]+)|^(?:FAIL|ERROR): (\w+)|"
                           r"^(?:FAILED|ERROR) \S+::(\w+)", said, re.M))
    names = sorted("".join(name) for name in names)
    return names or ([f"{program}:{pattern} (crash)"] if code else [])


def mutate(tree, build, row):
    """(tests that failed, verdict) of one mutation."""
    _, path, old, new, tests = row
    text = path.read_text()
    path.write_text(text.replace(old, new))
    try:
        if make(build, tests)[0]:
            return [], "DOES NOT BUILD"
        red = [failures(tree, build, *test) for test in tests]
    finally:
        path.write_text(text)
    unseen = [":".join(test) for test, names in zip(tests, red) if not names]
    return sum(red, []), "SURVIVES " + " ".join(unseen) if unseen else "seen"


def clone(folder):
    tree, build = folder / "source", folder / "build"
    if not tree.exists():
        subprocess.run(["git", "clone", "-q", ROOT, tree], check=True)
    subprocess.run(["git", "-C", tree, "fetch", "-q", "origin", "HEAD"], check=True)
    subprocess.run(["git", "-C", tree, "reset", "-q", "--hard", "FETCH_HEAD"], check=True)
    subprocess.run(["cmake", "-S", tree, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release"],
                   check=True, stdout=subprocess.DEVNULL)
    return tree, build


def unmutated(tree, build, tests):
    """What is wrong without any mutation."""
    code, said = make(build, tests)
    return said if code else [name for test in tests for name in failures(tree, build, *test)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--only", default="", metavar="TEXT")
    parser.add_argument("--build", type=pathlib.Path, metavar="DIR")
    parser.add_argument("--check", action="store_true", help="only whether the table fits")
    given = parser.parse_args()
    if given.check:
        print(f"{len(table(ROOT, given.only))} mutations fit the sources")
        return 0
    with tempfile.TemporaryDirectory() as temporary:
        tree, build = clone((given.build or pathlib.Path(temporary)).resolve())
        rows = table(tree, given.only)
        wrong = unmutated(tree, build, sorted({test for row in rows for test in row[4]}))
        if wrong:
            print("without any mutation:", wrong)
            return 2
        print("mutation | tests that failed | verdict", flush=True)
        seen = 0
        for row in rows:
            red, verdict = mutate(tree, build, row)
            print(f"{row[0]} | {', '.join(red)} | {verdict}", flush=True)
            seen += verdict == "seen"
    print(f"{seen} of {len(rows)} mutations seen")
    return 0 if seen == len(rows) else 1


if __name__ == "__main__":
    sys.exit(main())

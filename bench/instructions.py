# SPDX-License-Identifier: BSD-3-Clause
"""Instructions of one step, counted by callgrind: a step that does more work is seen on a machine
whose clock shows nothing because others use it too.

    python3 bench/instructions.py --check PROGRAM      compares with bench/instructions.json
    python3 bench/instructions.py --record PROGRAM     writes that file

PROGRAM is one_step (build/release/bench/one_step). More than 2 % off, in either direction, is a
failure: a gain is to be recorded, so that it cannot be lost unseen. Counts belong to a compiler,
its flags and a version of valgrind: --check exits with 77, "skipped", where these are others or
where valgrind or an instruction set is missing. Exit 1: a count is off; 2: wrong use.

callgrind knows no AVX-512: the levels counted are those that RONDO_DISPATCH can ask for below it.
"""
import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
from typing import Any, NamedTuple

RECORD = pathlib.Path(__file__).resolve().with_name("instructions.json")
TOLERANCE = 0.02
MOTIONS = ("free_spin", "rolling")
LEVELS = ("avx2", "baseline")
SKIPPED = 77


class Counted(NamedTuple):
    """What is counted: mesh as one_step names it; steps of the call, whole passes."""
    operator: str
    mesh: str
    steps: int
    levels: tuple[str, ...] = LEVELS


# What is particular to chunks and treads shows at one level.
COUNTED = (Counted("cyclic", "ring", 64), Counted("sparse", "ring", 64),
           Counted("cyclic", "chunks", 8, ("avx2",)), Counted("cyclic", "treaded", 32, ("avx2",)))


class Skip(Exception):
    """Nothing can be compared here; the message says why."""


def valgrind_version() -> str:
    """Such as "3.19.0"."""
    if shutil.which("valgrind") is None:
        raise Skip("valgrind is not installed (scripts/setup.sh installs it)")
    said = subprocess.run(["valgrind", "--version"], capture_output=True, text=True, check=True)
    return said.stdout.strip().removeprefix("valgrind-")


def check_processor() -> None:
    """Beyond AVX2, the counts of all processors are the same: callgrind hides the rest."""
    flags = re.search(r"^flags\s*:(.*)$", pathlib.Path("/proc/cpuinfo").read_text(), re.MULTILINE)
    missing = {"avx2", "fma"} - set(flags.group(1).split() if flags else [])
    if missing:
        raise Skip(f"this processor has no {' and no '.join(sorted(missing))}")


def circumstances(program: str) -> dict[str, str]:
    """What the counts belong to: compiler, flags, valgrind."""
    said = subprocess.run([program, "build"], capture_output=True, text=True, check=True)
    compiler, flags = said.stdout.splitlines()
    return {"compiler": compiler, "flags": flags, "valgrind": valgrind_version()}


def count(program: str, what: Counted, motion: str, level: str) -> int:
    """Instructions of one step, the mean of what.steps."""
    words = [program, what.operator, motion, what.mesh, str(what.steps)]
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "callgrind.out"
        run = subprocess.run(
            ["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}",
             "--toggle-collect=rondo_measured_steps", *words],
            env=os.environ | {"RONDO_DISPATCH": level, "OMP_NUM_THREADS": "1"},
            capture_output=True, text=True, check=False)
        if run.returncode != 0:
            sys.exit(f"{' '.join(words)} with RONDO_DISPATCH={level} ended with exit code "
                     f"{run.returncode}:\n{run.stdout}{run.stderr}")
        total = re.search(r"^totals: (\d+)$", out.read_text(), re.MULTILINE)
    if total is None or int(total.group(1)) == 0:
        sys.exit("callgrind counted nothing: rondo_measured_steps was not called, or not found")
    return round(int(total.group(1)) / what.steps)


def count_all(program: str) -> dict[str, int]:
    """Instructions of one step by "operator/mesh/motion/level"."""
    return {f"{what.operator}/{what.mesh}/{motion}/{level}": count(program, what, motion, level)
            for what in COUNTED for motion in MOTIONS for level in what.levels}


def compare(recorded: dict[str, Any], program: str) -> int:
    """Prints each count beside the recorded one. @return exit code"""
    here = circumstances(program)
    for key, found in here.items():
        if recorded[key] != found:
            raise Skip(f"the counts were recorded with {key} {recorded[key]!r}, this is {found!r}")
    check_processor()
    before, now = recorded["instructions_per_step"], count_all(program)
    if set(before) != set(now):
        print(f"{RECORD} holds {sorted(before)}; counted: {sorted(now)}; record anew")
        return 1
    off = 0
    print(f"{'instructions of a step':32} {'recorded':>12} {'now':>12}")
    for key, value in now.items():
        change = value / before[key] - 1.0
        bad = abs(change) > TOLERANCE
        off += bad
        print(f"{key:32} {before[key]:12} {value:12} {100 * change:+7.2f} %",
              "  OFF" if bad else "")
    if off:
        print(f"\n{off} of {len(now)} are off by more than {100 * TOLERANCE:g} %. If the change is "
              f"meant, run\n    /usr/bin/python3 bench/instructions.py --record {program}\n"
              "and say in the commit why.")
    return 1 if off else 0


def main() -> int:
    parser = argparse.ArgumentParser(description="Instructions of one step")
    parser.add_argument("program", help="one_step, as built")
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--check", action="store_true", help="compare with bench/instructions.json")
    what.add_argument("--record", action="store_true", help="write bench/instructions.json")
    arguments = parser.parse_args()
    try:
        if arguments.check:
            return compare(json.loads(RECORD.read_text()), arguments.program)
        check_processor()
        record: dict[str, Any] = {**circumstances(arguments.program),
                                  "instructions_per_step": count_all(arguments.program)}
        RECORD.write_text(json.dumps(record, indent=2) + "\n")
        print(RECORD.read_text(), end="")
        return 0
    except Skip as skip:
        print(f"SKIPPED: {skip}")
        return SKIPPED


if __name__ == "__main__":
    sys.exit(main())

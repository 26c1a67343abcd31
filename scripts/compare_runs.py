#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs cases by two programs and compares history.csv, contact.csv and all datasets of results.h5.

    scripts/compare_runs.py BEFORE AFTER cases/rolling-flat.toml ... [--set key=value]
        [--dispatch avx512,avx2,baseline] [--keep DIR]

For each case and instruction set one line: identical, or what differs first and by how much of the
largest number of that field. Exit status 1 if anything differs or one of the programs fails.
"""
import argparse
import csv
import math
import os
import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy as np


def run(program, case, directory, dispatch, settings):
    """Exit status of `program run`, whose results are in `directory`."""
    command = [program, "run", case, "-o", str(directory)]
    for setting in settings:
        command += ["--set", setting]
    environment = dict(os.environ)
    if dispatch:
        environment["RONDO_DISPATCH"] = dispatch
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        print(f"  {program}: exit status {done.returncode}: {done.stderr.strip()[-300:]}")
    return done.returncode


def relative(a, b):
    """Largest difference over the largest finite number of both; nan == nan."""
    a, b = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
    if a.shape != b.shape:
        return math.inf
    with np.errstate(invalid="ignore"):
        difference = np.abs(a - b)
    difference = np.where((a == b) | (np.isnan(a) & np.isnan(b)), 0.0, difference)
    if np.isnan(difference).any():
        return math.inf
    finite = np.concatenate([np.abs(x[np.isfinite(x)]).ravel() for x in (a, b)])
    size = finite.max() if finite.size else 0.0
    largest = difference.max() if difference.size else 0.0
    return largest / size if size > 0.0 else largest


def columns(path):
    with open(path, newline="") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    if not rows:
        return {}
    return {name: [float(row[i]) for row in rows[1:]] for i, name in enumerate(rows[0])}


def csv_differences(before, after):
    if before.read_bytes() == after.read_bytes():
        return
    a, b = columns(before), columns(after)
    for name in a:
        if name not in b:
            yield f"{before.name}: {name} is missing", math.inf
        elif (size := relative(a[name], b[name])) > 0.0:
            yield f"{before.name}: {name}", size
    for name in b.keys() - a.keys():
        yield f"{before.name}: {name} is new", math.inf


def datasets(path):
    found = {}
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, item: found.update({name: item[()]})
                        if isinstance(item, h5py.Dataset) else None)
    return found


def h5_differences(before, after):
    a, b = datasets(before), datasets(after)
    for name in sorted(a.keys() | b.keys()):
        if name not in a or name not in b:
            yield f"results.h5: /{name} is {'new' if name in b else 'missing'}", math.inf
            continue
        x, y = np.asarray(a[name]), np.asarray(b[name])
        if x.dtype == y.dtype and x.shape == y.shape and x.tobytes() == y.tobytes():
            continue
        yield f"results.h5: /{name}", relative(x, y) if x.dtype.kind in "fiu" else math.inf


def differences(before, after):
    """(what, relative size) of all that is not the same to the bit."""
    found = []
    for name, compare in (("history.csv", csv_differences), ("contact.csv", csv_differences),
                          ("results.h5", h5_differences)):
        there = [(directory / name).exists() for directory in (before, after)]
        if all(there):
            found += compare(before / name, after / name)
        elif any(there):
            found.append((f"{name} is {'missing' if there[0] else 'new'}", math.inf))
    return found


def compare(options, case, dispatch, work):
    """True if both programs give the same bits."""
    label = pathlib.Path(case).stem + (f" ({dispatch})" if dispatch else "")
    folders = [work / f"{pathlib.Path(case).stem}-{dispatch or 'default'}-{side}"
               for side in ("before", "after")]
    states = [run(program, case, folder, dispatch, options.set)
              for program, folder in zip((options.before, options.after), folders)]
    if any(states):
        print(f"{label}: a program failed")
        return False
    found = differences(*folders)
    if not found:
        print(f"{label}: identical")
        return True
    what, size = found[0]
    worst = max(size for _, size in found)
    print(f"{label}: {len(found)} differ, first {what} by {size:.3g}, at most by {worst:.3g}")
    for what, size in found[1:] if options.all else []:
        print(f"  {what} by {size:.3g}")
    return False


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("before", help="program")
    parser.add_argument("after", help="program")
    parser.add_argument("cases", nargs="+", help="case files")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE",
                        help="changes of the case, for both")
    parser.add_argument("--dispatch", default="", metavar="LEVELS",
                        help="instruction sets, one run each: avx512,avx2,baseline")
    parser.add_argument("--all", action="store_true", help="list all that differs")
    parser.add_argument("--keep", metavar="DIR", help="where the results stay")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        work = pathlib.Path(options.keep or scratch)
        same = [compare(options, case, dispatch, work) for case in options.cases
                for dispatch in options.dispatch.split(",")]
    return 0 if all(same) else 1


if __name__ == "__main__":
    sys.exit(main())

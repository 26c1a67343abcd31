# SPDX-License-Identifier: BSD-3-Clause
"""Runs the benchmarks and writes the tables of docs/performance.md and bench/README.md.

    cmake --preset bench && cmake --build --preset bench
    /usr/bin/python3 bench/performance.py                  all: some 20 minutes
    /usr/bin/python3 bench/performance.py --quick          up to 2·10⁵ dofs, twice; writes no page
    /usr/bin/python3 bench/performance.py --huge           4·10⁷ dofs too (6 GB)
    /usr/bin/python3 bench/performance.py --tables         tables anew from the last results

One program a mesh, its operators and repetitions mixed at random, so that a disturbance of the
machine does not fall on one of them; tables show the median and in brackets the least and the
largest. Raw results stay in BUILD/performance. Text of the pages outside the markers is left alone.
"""
import argparse
import datetime
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import time

from performance_data import Results, build, machine
from performance_tables import all_tables

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGES = [ROOT / "docs" / "performance.md", ROOT / "bench" / "README.md"]
RECORD = ROOT / "bench" / "instructions.json"

SMALL = ["smooth-4x60", "smooth-5x75", "smooth-12x180", "smooth-26x390", "smooth-82x1230",
         "treaded-60x4", "treaded-60x8", "treaded-60x24", "treaded-98x4", "treaded-308x4"]
LARGE = ["smooth-260x3900", "smooth-577x8655", "treaded-60x80", "treaded-975x4"]
HUGE = ["smooth-1155x17320"]

# Of MOTION/DAMPING/OPERATOR/THREADS: one factor is changed at a time.
SMOOTH = ["free_spin/beta/[a-z]+/1", "free_spin/no_beta/cyclic/1",
          "rolling/beta/(cyclic|sparse|eigen)/1", "free_spin/beta/(cyclic|sparse|eigen)/2"]
TREADED = ["(free_spin|rolling)/beta/(cyclic|sparse|eigen)/1"]


class Runner:
    """Runs commands from the project's folder and notes them, as one would type them."""

    def __init__(self, program_folder: pathlib.Path, raw: pathlib.Path) -> None:
        self.folder = program_folder
        self.raw = raw
        self.commands: list[str] = []

    def run(self, command: list[str], environment: dict[str, str] | None = None) -> float:
        """@return wall time in seconds; a program that fails ends the script."""
        given = environment or {}
        told = " ".join([*(f"{k}={v}" for k, v in given.items()), *map(shlex.quote, command)])
        print(told, flush=True)
        begin = time.perf_counter()
        done = subprocess.run(command, cwd=ROOT, env=os.environ | given, check=False,
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        if done.returncode != 0:
            sys.exit(f"{told}\nended with exit code {done.returncode}:\n{done.stderr}")
        return time.perf_counter() - begin

    def benchmark(self, program: str, name: str, patterns: str, repetitions: int,
                  environment: dict[str, str] | None = None) -> None:
        out = self.raw / f"{name}.json"
        out.unlink(missing_ok=True)
        self.run([str(self.folder / "bench" / program), f"--benchmark_filter={patterns}",
                  f"--benchmark_repetitions={repetitions}",
                  "--benchmark_enable_random_interleaving=true", f"--benchmark_out={out}",
                  "--benchmark_out_format=json"], environment)


def measure(arguments: argparse.Namespace, raw: pathlib.Path) -> None:
    raw.mkdir(parents=True, exist_ok=True)
    for old in raw.glob("*.json"):
        old.unlink()
    try:
        folder = arguments.build.resolve().relative_to(ROOT)
    except ValueError:
        folder = arguments.build.resolve()
    runner = Runner(folder, raw)
    repetitions = 2 if arguments.quick else arguments.repetitions
    written = tuple(str(page.relative_to(ROOT)) for page in PAGES)
    about = {"machine": machine(), "build": build(arguments.build, ROOT, written),
             "date": datetime.date.today().isoformat(), "repetitions": repetitions,
             "load at the start": f"{os.getloadavg()[0]:.2f}"}
    meshes = SMALL + ([] if arguments.quick else LARGE) + (HUGE if arguments.huge else [])
    for mesh in meshes:
        if re.search(arguments.only, mesh):
            variants = SMOOTH if mesh.startswith("smooth") else TREADED
            runner.benchmark("bench_step", f"step-{mesh}", f"^step/{mesh}/({'|'.join(variants)})/",
                             repetitions, {"RONDO_BENCH_HUGE": "1"} if mesh in HUGE else None)
    if not arguments.steps_only:
        small = "^(stream/(4320|20280|201720)/|(product.*|contact_search)/(12|26|82)(/|$)|multiply)"
        runner.benchmark("bench_kernels", "kernels", small if arguments.quick else ".", repetitions)
        with tempfile.TemporaryDirectory() as out:
            about["paper_seconds"] = runner.run(
                [sys.executable, "-m", "rondo", "paper", "-o", out, "--overwrite"],
                {"RONDO": str(folder / "rondo"), "PYTHONPATH": "python"})
    about["commands"] = ["cmake --preset bench && cmake --build --preset bench",
                         shlex.join(["/usr/bin/python3", "bench/performance.py", *sys.argv[1:]])]
    (raw / "run.json").write_text(json.dumps(about, indent=2) + "\n")


def fill(pages: dict[pathlib.Path, str], tables: dict[str, str]) -> dict[pathlib.Path, str]:
    """The pages with what is between the markers of each name replaced, in the one that has them."""
    filled = dict(pages)
    for name, text in tables.items():
        begin, end = f"<!-- begin {name} -->", f"<!-- end {name} -->"
        having = [page for page, old in filled.items() if begin in old or end in old]
        old = filled[having[0]] if len(having) == 1 else ""
        if old.count(begin) != 1 or old.count(end) != 1 or old.index(begin) > old.index(end):
            sys.exit(f"one of {', '.join(map(str, pages))} needs one line {begin} and one line {end} after it")
        head, rest = old.split(begin)
        filled[having[0]] = f"{head}{begin}\n{text}\n{end}{rest.split(end)[1]}"
    return filled


def main() -> None:
    parser = argparse.ArgumentParser(description="Benchmarks to docs/performance.md")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "bench")
    parser.add_argument("--repetitions", type=int, default=5)
    parser.add_argument("--quick", action="store_true",
                        help="up to 2·10⁵ dofs, twice each; tables to the screen")
    parser.add_argument("--huge", action="store_true", help="4·10⁷ dofs too")
    parser.add_argument("--only", default="", metavar="REGEX",
                        help="meshes whose name it finds; tables to the screen")
    parser.add_argument("--steps-only", action="store_true", help="no kernels and no study of the paper")
    parser.add_argument("--tables", action="store_true", help="run nothing, write the tables anew")
    arguments = parser.parse_args()
    partial = arguments.quick or arguments.only or arguments.steps_only
    raw = arguments.build / ("performance-part" if partial else "performance")
    if not arguments.tables:
        measure(arguments, raw)
    results = Results(raw)
    if not results.run:
        sys.exit(f"{raw} holds no results: run without --tables first")
    tables = all_tables(results, RECORD)
    if partial:
        print("\n\n".join(f"## {name}\n\n{text}" for name, text in tables.items()))
    else:
        for page, text in fill({page: page.read_text() for page in PAGES}, tables).items():
            page.write_text(text)
            print(f"{page} is written")
    for step, error in results.errors.items():
        print(f"ERROR {'/'.join(map(str, step))}: {error}")
    if results.errors:
        sys.exit(1)


if __name__ == "__main__":
    main()

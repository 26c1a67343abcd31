# SPDX-License-Identifier: BSD-3-Clause
"""What keeps small elements from setting the step, against each other (docs/schemes.md): implicit elements, contact
nodes without mass, an asynchronous step, more mass, on a bar, a pulse, a rolling disk.

    /usr/bin/python3 bench/schemes.py [--write] [--repeat 3] [--program build/release/rondo]

Prints tables in Markdown; with --write puts them, and the figures, into docs/schemes.md. A scheme that the
program does not know, or that fails, is left out, and told of. Some two minutes on one core."""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

from schemes_bars import Bar, Pulse
from schemes_disk import Belt, Disk

ROOT = pathlib.Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "schemes.md"
PROBLEMS = (Bar(), Pulse(), Disk(), Belt())
SECONDS = "time (s)"


def run(program, case, out, repeat):
    """Seconds of stepping, the best; None, and why, where the program refuses the case or fails."""
    best = None
    for _ in range(repeat):
        done = subprocess.run([program, "run", case, "-o", out, "--quiet", "--overwrite", "--threads", "1"],
                              capture_output=True, text=True)
        if done.returncode != 0:
            return None, next(line for line in done.stderr.splitlines() if "error" in line)
        wall = json.loads((out / "run.json").read_text())["loop_wall_s"]
        best = wall if best is None else min(best, wall)
    return best, ""


def rows_of(problem, options, folder):
    """(name, measures, seconds, results) of each scheme that the program has."""
    rows = []
    for name, text in problem.cases(folder):
        case = folder / f"{problem.NAME}-{len(rows)}.toml"
        out = case.with_suffix("")
        case.write_text(text)
        seconds, why = run(options.program, case, out, options.repeat)
        if seconds is None:
            print(f"{problem.NAME}: {name} is left out: {why}", file=sys.stderr)
            continue
        rows.append((name, seconds, problem.measure(out), out))
    return rows


def table(problem, rows):
    lines = ["| | " + " | ".join(problem.COLUMNS) + " |", "|---" * (len(problem.COLUMNS) + 1) + "|"]
    for name, seconds, measures, _ in rows:
        numbers = [f"{seconds:.3g}" if column == SECONDS else measures[column]
                   for column in problem.COLUMNS]
        lines.append(f"| {name} | " + " | ".join(numbers) + " |")
    return "\n".join(lines)


def written(page, name, text):
    """The page with what stands between the marks of this table replaced."""
    begin, end = f"<!-- table: {name} -->\n", "<!-- end -->"
    before, rest = page.split(begin)
    return before + begin + text + "\n" + rest[rest.index(end):]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/release/rondo")
    parser.add_argument("--repeat", type=int, default=3, help="runs of each, of which the fastest counts")
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        for problem in PROBLEMS:
            rows = rows_of(problem, options, pathlib.Path(folder))
            text = table(problem, rows)
            print(f"{problem.TITLE}\n\n{text}\n")
            if options.write:
                PAGE.write_text(written(PAGE.read_text(), problem.NAME, text))
                problem.draw([(name, out) for name, _, _, out in rows], PAGE.parent / "figures")


if __name__ == "__main__":
    main()

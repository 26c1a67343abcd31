# SPDX-License-Identifier: BSD-3-Clause
"""Runs per minute of a sweep, against the same runs one at a time by `rondo run`.

    /usr/bin/python3 bench/sweep.py [--runs 1000] [--alone 50] [--program build/release/rondo]

Prints a table in Markdown. The runs: the disk of 8×120 elements pressed onto flat ground, 0.1 s each,
of other friction and spin."""
import argparse
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
SETTINGS = ("disk.mesh.radial=8", "disk.mesh.circumferential=120", "time.end=0.1")
FRICTIONS = 10


def study(spins):
    return f"""schema = 1
base = "{ROOT / 'cases' / 'rolling-flat.toml'}"
set = [{', '.join(f'"{setting}"' for setting in SETTINGS)}]
[[vary]]
key = "ground.friction"
linspace = [0.0, 0.9, {FRICTIONS}]
[[vary]]
key = "motion.angular_velocity"
linspace = [30.0, 36.0, {spins}]
"""


def timed(command):
    begin = time.perf_counter()
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return time.perf_counter() - begin


def alone(program, folder, n):
    """Seconds of n runs, one process after the other, and without sharing."""
    seconds = 0.0
    for k in range(n):
        settings = [*SETTINGS, f"ground.friction={0.1 * (k % FRICTIONS)}",
                    f"motion.angular_velocity={30 + 6 * k / n}", "output.snapshots=0"]
        words = [word for setting in settings for word in ("--set", setting)]
        seconds += timed([program, "run", ROOT / "cases" / "rolling-flat.toml", "--quiet",
                          "--threads", 1, "-o", folder / f"alone-{k}", *words])
    return seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=1000)
    parser.add_argument("--alone", type=int, default=50)
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/release/rondo")
    options = parser.parse_args()
    spins = max(2, options.runs // FRICTIONS)
    n = FRICTIONS * spins
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        path = folder / "study.toml"
        path.write_text(study(spins))
        rows = [("one at a time, `rondo run`", options.alone,
                 alone(options.program, folder, options.alone))]
        sweep = [options.program, "sweep", path, "--quiet", "-o"]
        rows.append(("`rondo sweep --jobs 1`", n, timed([*sweep, folder / "one", "--jobs", 1])))
        rows.append(("`rondo sweep`, all cores", n, timed([*sweep, folder / "all"])))
        if shutil.which("mpirun"):
            rows.append(("`mpirun -n 2 rondo sweep`", n, timed(
                ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", 2, *sweep,
                 folder / "mpi"])))
        print("|  | runs | s | runs a minute |\n|---|---|---|---|")
        for what, runs, seconds in rows:
            print(f"| {what} | {runs} | {seconds:.1f} | {60 * runs / seconds:.0f} |")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What a step costs through Python, against the program, and two simulations in two threads against
one: docs/performance.md.

    /usr/bin/python3 bench/python_steps.py [CASE]     default cases/rolling-flat.toml
"""
import pathlib
import statistics
import sys
import tempfile
import threading
import time
import warnings

import rondo

ROOT = pathlib.Path(__file__).resolve().parents[1]
REPEATS = 7


def seconds(work):
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin


def through_python(case, every):
    simulation = rondo.Simulation(case)
    assert simulation.displacement.shape
    return seconds(lambda: all(row.step for row in simulation.steps(every)))


def by_program(case, folder):
    return rondo.run(case, folder, {"output.snapshots": 0}, overwrite=True,
                     arguments=["--threads", "1"]).info["loop_wall_s"]


def two_at_once(case, settings):
    simulations = [rondo.Simulation(case, settings, threads=1) for _ in range(2)]
    threads = [threading.Thread(target=simulation.run) for simulation in simulations]

    def work():
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()

    return seconds(work)


def main(case=ROOT / "cases" / "rolling-flat.toml"):
    warnings.simplefilter("ignore")
    one = rondo.Simulation(case)
    print(f"{pathlib.Path(case).name}: {one.n_steps} steps, "
          f"{one.mesh.n_nodes} nodes; medians of {REPEATS}")
    with tempfile.TemporaryDirectory() as folder:
        program = statistics.median(by_program(case, folder) for _ in range(REPEATS))
    print(f"program, no snapshots     {1e6 * program / one.n_steps:8.3f} us a step")
    for every in (1, 10, 100, 1000):
        mine = statistics.median(through_python(case, every) for _ in range(REPEATS))
        print(f"Python, {every:4} steps a call {1e6 * mine / one.n_steps:8.3f} us a step, "
              f"{mine / program:.3f} times the program")
    longer = {"time.end": 10 * one.n_steps * one.dt, "output.snapshots": 0}
    alone = statistics.median(seconds(rondo.Simulation(case, longer, threads=1).run)
                              for _ in range(REPEATS))
    both = statistics.median(two_at_once(case, longer) for _ in range(REPEATS))
    print(f"ten times as long: one simulation {alone:.3f} s; two in two threads {both:.3f} s, {both / alone:.3f} times")


if __name__ == "__main__":
    main(*sys.argv[1:])

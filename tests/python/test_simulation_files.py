# SPDX-License-Identifier: BSD-3-Clause
"""rondo.Simulation in files and in threads: what is written, interrupted, resumed, forked, broken off."""
import os
import pathlib
import signal
import subprocess
import sys
import threading
import time

import h5py
import numpy as np
import pytest
from conftest import WHEEL
from program import run
from stepping import ROOT, by_program, closed, python, same_rows

import rondo


def test_what_is_written_may_be_read_meanwhile(case):
    with rondo.Simulation(case, output="out") as steps:
        steps.advance(60)
        for _ in range(1000):  # they are written while the next steps are made
            there = rondo.open("out", unfinished=True)
            k = there.n_snapshots - 1
            if k >= 5:
                break
            time.sleep(0.01)
        assert there.status == "running" and k == 5
        with h5py.File("out/results.h5", "r", locking=False) as file:
            assert np.isfinite(file["frame/time"][k])
        kept = there.displacement[k]
        assert np.abs(kept).max() > 0 and len(there.history["time_s"]) > 0
        steps.run()
        np.testing.assert_array_equal(there.displacement[k], kept)
    np.testing.assert_array_equal(rondo.open("out").displacement[k], kept)


def test_files_are_those_of_the_program(case):
    there = by_program(case, "out")
    with rondo.Simulation(case, output="mine") as steps:
        while steps.advance(100):
            pass
    here = rondo.open("mine")
    for name in ("history.csv", "contact.csv", "fields.xdmf", "case.toml"):
        assert pathlib.Path("mine", name).read_bytes() == pathlib.Path("out", name).read_bytes()
    np.testing.assert_array_equal(here.displacement[:], there.displacement[:])
    np.testing.assert_array_equal(here.field("von_mises")[:], there.field("von_mises")[:])
    assert here.info["build_id"] == there.info["build_id"] and here.status == "done"
    same_rows(steps.history, there.history)
    with pytest.raises(rondo.InputError, match="mine.*holds another run"):
        rondo.Simulation(case, output="mine")


@pytest.mark.parametrize("by", ["program", "python"])
def test_driven_closed_and_resumed(case, by):
    whole = rondo.Simulation(case)
    for steps in (whole, rondo.Simulation(case, output="cut")):
        steps.advance(40)
        steps.set({"motion.speed": 9.0}, 1e-3)
        steps.advance(20)
        if steps is not whole:
            steps.close()
            assert rondo.open("cut", unfinished=True).status == "interrupted"
    closed(whole.run())
    if by == "program":
        done = run("run", "cut", "--resume", "--quiet")
        assert done.returncode == 0, done.stderr
    else:
        with rondo.Simulation("cut", resume=True) as steps:
            assert steps.step == 60
            with pytest.raises(rondo.Error, match="no step has been made since.*advance"):
                steps.displacement
            steps.advance()
            np.testing.assert_array_equal(steps.displacement.shape, whole.displacement.shape)
            steps.run()
    same_rows(rondo.open("cut").history, whole.history)
    np.testing.assert_array_equal(rondo.open("cut").displacement[-1], whole.displacement)


def test_tables_of_later_times_may_change_on_resume(case):
    with rondo.Simulation(case, output="cut") as steps:
        steps.advance(40)
    at = 42 * steps.dt
    for points, code in ([[0, 10.0], [at, 10.0], [0.02, 5.0]], 0), ([[0, 10.0], [0.02, 5.0]], 2):
        done = run("run", "cut", "--resume", "--quiet", "--set", f"motion.speed={points}")
        if code == 2:
            assert done.returncode == 2 and "motion.speed" in done.stderr, done.stderr
            continue
        assert done.returncode == 0, done.stderr
        whole = rondo.run(case, "whole", {"motion.speed": points})
        same_rows(rondo.open("cut").history, whole.history)


INTERRUPTED = """
import rondo, sys
steps = rondo.Simulation({case!r}, {{"time.end": 1000.0, "output.history_interval": 1e-2}}, {output})
steps.set({{"motion.speed": 9.9}})
print("begun", flush=True)
try:
    steps.advance(steps.n_steps)
except KeyboardInterrupt:
    before = steps.step
    print(before, abs(steps.displacement).max() > 0, steps.advance(3), steps.step - before, flush=True)
    {then}
"""


@pytest.mark.parametrize("output, then", [("None", "pass"), ("'out'", "pass"),
                                          ("'out'", "import os; os._exit(1)")])
def test_ctrl_c_leaves_a_simulation_that_goes_on(case, output, then):
    text = INTERRUPTED.format(case=str(case), output=output, then=then)
    process = subprocess.Popen([sys.executable, "-c", text], stdout=subprocess.PIPE, text=True,
                               env={**os.environ, "PYTHONPATH": str(ROOT / "python")})
    assert process.stdout.readline() == "begun\n"
    time.sleep(0.3)
    process.send_signal(signal.SIGINT)
    step, *rest = process.communicate(timeout=60)[0].split()
    assert rest == ["True", "3", "3"]
    if output == "None":
        return
    there = rondo.open("out", unfinished=True)
    at_exit = then == "pass"  # else it died with the checkpoint of the interrupt
    assert there.status == ("interrupted" if at_exit else "running")
    with rondo.Simulation("out", resume=True) as steps:
        assert steps.step == int(step) + (3 if at_exit else 0)
        assert steps.case["motion"]["speed"][-1][1] == 9.9


def test_a_failure_is_raised_and_told(case):
    case.write_text(WHEEL)
    # The state of the step that fails is at hand only where a row was due there.
    steps = rondo.Simulation(case, {"rim.force_y": -1e9, "output.history_interval": 1.0}, output="out")
    with pytest.raises(rondo.NumericalError, match="step .* of "):
        steps.run()
    assert steps.is_over
    with pytest.raises(rondo.Error, match="not at hand: step"):
        steps.displacement
    steps.close()
    with pytest.raises(rondo.UnfinishedRunError, match="failed"):
        rondo.open("out")


def test_one_thread_at_a_time_and_others_meanwhile(case):
    steps = rondo.Simulation(case, {"time.end": 1000.0, "output.history_interval": 1.0})
    counted, refused = 0, None
    worker = threading.Thread(target=steps.advance, args=(200_000,))
    worker.start()
    while worker.is_alive():
        counted += 1
        try:
            steps.advance()
        except rondo.InputError as error:
            refused = error
        time.sleep(0.001)
    assert counted > 20 and "another thread is at work" in str(refused)


def test_threads_have_the_bits_of_one(case):
    alone = [closed(rondo.Simulation(case, {"ground.friction": mu}).run()).history
             for mu in (0.1, 0.5)]
    found = [None, None]

    def work(k):
        found[k] = closed(rondo.Simulation(case, {"ground.friction": (0.1, 0.5)[k]}).run()).history

    for _ in range(5):
        threads = [threading.Thread(target=work, args=(k,)) for k in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for mine, other in zip(found, alone, strict=True):
            same_rows(mine, other)


def test_a_run_that_has_come_to_its_end(case):
    rondo.run(case, "out")
    before = pathlib.Path("out/run.json").read_bytes()
    with rondo.Simulation("out", resume=True) as steps:
        assert steps.is_over and steps.advance(3) == 0 and steps.step == steps.n_steps
        with pytest.raises(rondo.Error, match="come to its end when it was resumed"):
            steps.displacement
        with pytest.raises(rondo.InputError, match="save.*the run has ended"):
            steps.save()
    assert pathlib.Path("out/run.json").read_bytes() == before


def test_a_directory_is_one_simulations(case):
    with rondo.Simulation(case, output="out") as steps:
        with pytest.raises(rondo.Error, match="out.*at work"):
            rondo.Simulation(case, output="out", overwrite=True)
        steps.run()
    assert rondo.open("out").status == "done"


FORKED = """
import os, rondo
steps = rondo.Simulation({case!r}, output="out")
steps.advance(40)
child = os.fork()
if child == 0:
    try:
        steps.advance(3)
    except rondo.InputError as error:
        print(error, flush=True)
    steps.close()
    del steps
    os._exit(0)  # HDF5's lock may be held by a thread that is not there to give it back
print(os.waitpid(child, 0)[1], flush=True)
with steps:
    steps.run()
"""


def test_a_forked_process_leaves_the_files_alone(case):
    done = python(FORKED.format(case=str(case)))
    said, code = done.stdout.splitlines()
    assert "is that of the process that this one was forked from" in said and code == "0", done
    there = by_program(case, "alone")
    assert pathlib.Path("out/history.csv").read_bytes() == pathlib.Path("alone/history.csv").read_bytes()
    np.testing.assert_array_equal(rondo.open("out").displacement[:], there.displacement[:])


ENDS = """
import rondo, threading, time
steps = rondo.Simulation({case!r}, {{"time.end": 1000.0, "output.history_interval": 1.0}}, "out")
threading.Thread(target=steps.run, daemon=True).start()
threading.Thread(target=rondo.solve, args=({case!r}, {{"time.end": 1000.0, "output.history_interval": 1.0}}), daemon=True).start()
time.sleep(0.5)
"""


def test_python_ends_while_threads_are_at_work(case):
    done = python(ENDS.format(case=str(case)))
    assert done.returncode == 0, done
    assert rondo.open("out", unfinished=True).status == "interrupted"
    with rondo.Simulation("out", resume=True) as steps:
        assert steps.step > 0


def test_close_ends_another_threads_steps(case):
    steps = rondo.Simulation(case, {"time.end": 1000.0, "output.history_interval": 1.0})
    worker = threading.Thread(target=steps.advance, args=(10**9,))
    worker.start()
    time.sleep(0.2)
    steps.close()
    worker.join(timeout=10)
    assert not worker.is_alive() and 0 < steps.step < steps.n_steps


FULL = """
import resource, rondo
settings = {{"output.snapshots": 0, "output.history_interval": 0, "time.end": 50.0}}
steps = rondo.Simulation({case!r}, settings, "out")
most = resource.getrlimit(resource.RLIMIT_FSIZE)
resource.setrlimit(resource.RLIMIT_FSIZE, ({bytes}, most[1]))
for wanted in steps.n_steps, 3:
    try:
        steps.advance(wanted)
    except rondo.FileError as error:
        print(error)
print(steps.is_over)
steps.close()
print(rondo.open("out", unfinished=True).status)
resource.setrlimit(resource.RLIMIT_FSIZE, most)
again = rondo.Simulation({case!r}, settings, "out", overwrite=True)  # steps is still there
print(again.advance(3))
"""


def test_a_full_disk(case):
    text = FULL.format(case=str(case), bytes=500_000)
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True,
                          env={**os.environ, "PYTHONPATH": str(ROOT / "python")})
    said, after, over, status, *again = done.stdout.strip().splitlines()
    assert "history.csv" in said and "kept are" in said and said == after and over == "True", done
    assert status == "failed"
    assert again == ["3"], done.stderr  # the directory is free again, while the old simulation lives

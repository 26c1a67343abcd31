# SPDX-License-Identifier: BSD-3-Clause
"""rondo.solve, crush, steady_rolling, modes, pod, reduce, sweep: in process what the program does."""
import os
import pathlib
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
from conftest import TREADED, WHEEL
from program import SMALL, run

import rondo

ROOT = pathlib.Path(__file__).resolve().parents[2]
STEADY = {"analysis.kind": "steady-rolling", "motion.height": 0.296}
CRUSH = {"analysis.kind": "crush", "analysis.depth": 0.01, "analysis.increments": 10}
STUDY = """schema = 1
base = "small.toml"
[[vary]]
key = "ground.friction"
values = [0.1, 0.3, 0.5]
"""


def by_program(*arguments):
    done = run(*arguments, "--quiet")
    assert done.returncode == 0, done.stderr


def same(solution, there):
    assert solution.history.names == there.history.names
    assert solution.history.units == there.history.units
    for name in solution.history.names:
        np.testing.assert_array_equal(solution.history[name], there.history[name], err_msg=name)
    for name in ("times", "times_velocity", "angle", "angle_velocity"):
        np.testing.assert_array_equal(getattr(solution, name), getattr(there, name), err_msg=name)
    np.testing.assert_array_equal(solution.center[:, :2], there.center)
    np.testing.assert_array_equal(solution.displacement, there.displacement[:])
    np.testing.assert_array_equal(solution.velocity, there.velocity[:])
    np.testing.assert_array_equal(solution.contact_force, there.contact.force[:])
    np.testing.assert_array_equal(solution.mesh.boundary, there.contact.nodes)
    for key in ("steps", "energy_residual_relative", "strain_max", "title", "analysis", "status",
                "columns", "build_id", "steady"):
        assert solution.info.get(key) == there.info.get(key), key


@pytest.mark.parametrize("text, settings, solve", [
    (SMALL, {}, rondo.solve), (WHEEL, {}, rondo.solve), (TREADED, CRUSH, rondo.crush),
    (SMALL, CRUSH | {"analysis.solver": "latin-pgd"}, rondo.crush),
    (SMALL, STEADY, rondo.steady_rolling), (TREADED, STEADY, rondo.steady_rolling)])
def test_arrays_are_those_of_the_files(case, text, settings, solve):
    case.write_text(text)
    there = rondo.run(case, "out", settings, arguments=["--threads", "1"])
    before = sorted(pathlib.Path().rglob("*"))
    solution = solve(case, settings, threads=1)
    assert sorted(pathlib.Path().rglob("*")) == before  # nothing is written
    same(solution, there)
    assert solution.displacement.flags.c_contiguous and solution.n_snapshots == there.n_snapshots


def test_a_wheel_in_three_dimensions(case):
    settings = {"disk.mesh.circumferential": 30, "disk.mesh.radial": 2, "disk.mesh.axial": 2,
                "time.end": 2e-2, "output.snapshots": 3}
    solid = ROOT / "cases" / "wheel3d-load.toml"
    solution, there = rondo.solve(solid, settings), rondo.run(solid, "out", settings)
    same(solution, there)
    np.testing.assert_array_equal(solution.center[:, 2], there.lateral)
    assert np.abs(solution.contact_force[-1]).max() > 0


def test_run_has_the_bytes_of_the_program(case):
    by_program("run", case, "-o", "out")
    rondo.run(case, "mine")
    for name in ("history.csv", "contact.csv", "fields.xdmf", "case.toml"):
        assert pathlib.Path("mine", name).read_bytes() == pathlib.Path("out", name).read_bytes()


@pytest.mark.parametrize("source, options", [("small.toml", {"modes": 12}),
                                             ("full", {"modes": 12, "from_time": 0.005})])
def test_reduced_wheels_of_files(case, source, options):
    rondo.run(case, "full", {"output.snapshots": 100})
    words = [str(word) for name, value in options.items() for word in (f"--{name.removesuffix('_time')}", value)]
    by_program("reduce", source, "-o", "by-program.h5", *words)
    wheel = rondo.reduce(source, "mine.h5", **options)
    assert wheel.read_bytes() == pathlib.Path("by-program.h5").read_bytes()
    by_program("run", case, "-o", "out", "--reduced", wheel, "--reduced-step", "0.0001")
    there = rondo.open("out")
    assert there.info["wheel_basis"] == ("pod" if source == "full" else "eigenmodes")
    same(rondo.solve(case, reduced=wheel, reduced_step=1e-4), there)
    worded = rondo.run(case, "worded", reduced=wheel, reduced_step=1e-4, arguments=["--threads", "1"])
    assert worded.history.path.read_bytes() == there.history.path.read_bytes()
    steps = rondo.Simulation(case, reduced=wheel)
    steps.advance(10)
    steps.set({"motion.speed": 9.0})
    steps.run()
    pathlib.Path("driven.toml").write_text(steps.case_text)
    driven = rondo.run("driven.toml", "driven", reduced=wheel)
    np.testing.assert_array_equal(steps.displacement, driven.displacement[-1])
    assert np.abs(driven.center[-1, 0] - there.center[-1, 0]) > 1e-3


def test_reduced_wheels_that_are_refused(case):
    rondo.run(case, "full", {"output.snapshots": 100})
    wheel = rondo.reduce(case, "wheel.h5", {"material.density": 1000.0})
    for call, said in ((lambda: rondo.reduce("full", "x.h5", {"ground.friction": 0.1}), "is of a case, and a POD is of runs"),
                       (lambda: rondo.reduce(case, "x.h5", basis="wavelets"), "^basis = wavelets: "),
                       (lambda: rondo.reduce(case, "x.h5", from_time=0.1), "^from_time = 0.1: "),
                       (lambda: rondo.reduce([case, case], "x.h5"), "is of one case"),
                       (lambda: rondo.solve(case, reduced=wheel), "mesh or material"),
                       (lambda: rondo.solve(case, reduced="case", reduced_step=-1.0), "^reduced_step = -1: ")):
        with pytest.raises(rondo.InputError, match=said):
            call()


def test_a_reduced_wheel_of_the_case(case):
    by_program("run", case, "-o", "out", "--reduced", "--modes", 12)
    there = rondo.open("out")
    same(rondo.solve(case, reduced="case", modes=12), there)
    assert rondo.run(case, "mine", reduced="case", modes=12).history.path.read_bytes() == there.history.path.read_bytes()
    steps = rondo.Simulation(case, reduced="case", modes=12)
    steps.advance(5)
    with pytest.raises(rondo.InputError, match="are for a spin that stays"):
        steps.set({"motion.angular_velocity": 30.0})
    steps.set({"motion.speed": 9.0})
    steps.run()
    assert np.abs(steps.history["center_x_m"][-1] - there.history["center_x_m"][-1]) > 1e-3


def test_a_wheel_as_an_fmu(case):
    by_program("fmu", case, "-o", "wheel.fmu", "--set", "ground.friction=0.3", "--modes", 12)
    mine = pathlib.Path("mine")
    mine.mkdir()
    assert rondo.fmu(case, mine / "wheel.fmu", {"ground.friction": 0.3}, modes=12) == mine / "wheel.fmu"
    assert (mine / "wheel.fmu").read_bytes() == pathlib.Path("wheel.fmu").read_bytes()
    rondo.fmu(case, mine / "wheel.fmu", {"ground.friction": 0.3}, modes=12, reduced_step=2e-4)
    assert (mine / "wheel.fmu").read_bytes() != pathlib.Path("wheel.fmu").read_bytes()
    with pytest.raises(rondo.Error, match="none.toml"):
        rondo.fmu("none.toml", "wheel.fmu")


def test_modes_pod_and_sweep(case):
    by_program("modes", case, "-o", "modes", "--count", 5)
    assert rondo.modes(case, "mine", count=5, sweep="0:50:3").directory == pathlib.Path("mine")
    for name in ("modes.csv", "critical-speeds.csv"):
        assert pathlib.Path("mine", name).read_bytes() == pathlib.Path("modes", name).read_bytes()
    run_there = rondo.run(case, "out")
    by_program("pod", "out", "--field", "velocity", "--frame", "rectified", "-o", "pod")
    pod = rondo.pod(run_there, "mypod", field="velocity", frame="rectified")
    np.testing.assert_array_equal(pod.spatial, rondo.open_pod("pod/velocity-rectified").spatial)
    assert rondo.pod("out", field="displacement", modes=2).n_modes == 2
    pathlib.Path("study.toml").write_text(STUDY)
    by_program("sweep", "study.toml", "-o", "sweep")
    mine = rondo.sweep("study.toml", "mysweep")
    for name in ("results.csv", "sweep.h5"):
        assert (pathlib.Path("mysweep") / name).read_bytes() == (pathlib.Path("sweep") / name).read_bytes()
    two = rondo.sweep("study.toml", "two", {"time.end": 0.01}, jobs=2)
    np.testing.assert_array_equal(two["ground.friction"], mine["ground.friction"])
    assert two["end_time_s"].max() < 0.011 and mine.done.all()


@pytest.mark.parametrize("call, kind, said", [
    (lambda c: rondo.crush(c), rondo.Error, 'analysis.kind is "dynamic", not "crush"'),
    (lambda c: rondo.steady_rolling(c, STEADY | {"ground.friction": -1.0}), rondo.InputError, "ground.friction"),
    (lambda c: rondo.solve(c, {"output.snapshots": 10**6, "time.end": 100.0,
                               "disk.mesh.circumferential": 400, "disk.mesh.radial": 12}), rondo.InputError, "output.snapshots.*take.*memory"),
    (lambda c: rondo.pod([], "x"), rondo.InputError, "run"),
    (lambda c: rondo.pod("none"), rondo.Error, "none"),
    (lambda c: rondo.pod(c.parent / "out", field="warmth"), rondo.Error, "warmth|out"),
    (lambda c: rondo.modes(c, count=0), rondo.InputError, "count = 0.*1 to 100000"),
    (lambda c: rondo.modes(c, count="a"), rondo.InputError, "count = 'a': is of a wrong type"),
    (lambda c: rondo.solve(c, threads=0), rondo.InputError, "threads = 0.*1 to 1024"),
    (lambda c: rondo.Simulation(c, threads=-1), rondo.InputError, "threads = -1"),
    (lambda c: rondo.run(c, "x", overwrite=True, resume=True), rondo.InputError, "one of the two"),
    (lambda c: rondo.reduce([], "m.h5"), rondo.InputError, "nothing is given"),
    (lambda c: rondo.modes(c, sweep="1:2"), rondo.InputError, "sweep"),
    (lambda c: rondo.reduce("none", "m.h5"), rondo.Error, "none"),
    (lambda c: rondo.sweep(c, jobs=0), rondo.Error, "jobs = 0"),
    (lambda c: rondo.sweep(c), rondo.InputError, "base"),
    (lambda c: rondo.solve(c, {"time.end": None}), rondo.Error, "a setting is a number")])
def test_wrong_use(case, call, kind, said):
    with pytest.raises(kind, match=said):
        call(case)
    assert sorted(path.name for path in pathlib.Path().iterdir()) == ["small.toml"]


def test_numerical_failures(case):
    case.write_text(WHEEL)
    with pytest.raises(rondo.NumericalError, match="step .*results so far are in out"):
        rondo.run(case, "out", {"rim.force_y": -1e9})
    with pytest.raises(rondo.NumericalError, match="step"):
        rondo.solve(case, {"rim.force_y": -1e9})


def interrupted(text, begun):
    """Python at work on the text, stopped by Ctrl-C once `begun` is true."""
    process = subprocess.Popen([sys.executable, "-c", f"import rondo; print(1, flush=True); {text}"],
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                               env={**os.environ, "PYTHONPATH": str(ROOT / "python")})
    process.stdout.readline()
    for _ in range(6000):
        if begun():
            break
        time.sleep(0.005)
    process.send_signal(signal.SIGINT)
    assert "KeyboardInterrupt" in process.communicate(timeout=60)[1]


def test_ctrl_c(case):
    began = time.monotonic()
    interrupted("rondo.solve('small.toml', {'time.end': 1000.0, 'output.history_interval': 1.0})",
                lambda: time.monotonic() > began + 1.0)


def test_ctrl_c_in_a_sweep_that_goes_on(case):
    pathlib.Path("study.toml").write_text(STUDY)
    settings = {"time.end": 10.0, "output.history_interval": 0.1}  # half a second each
    interrupted(f"rondo.sweep('study.toml', 'out', {settings})",
                pathlib.Path("out/runs/0002/history.csv").is_file)
    cut = rondo.open_sweep("out", unfinished=True)
    assert list(cut["status"]) == ["done", "interrupted", "waiting"]
    there = pathlib.Path("out/runs/0001/run.json").stat().st_mtime_ns
    whole = rondo.sweep("study.toml", "out", settings, resume=True)
    assert whole.done.all() and pathlib.Path("out/runs/0001/run.json").stat().st_mtime_ns == there
    rondo.sweep("study.toml", "whole", settings)
    for name in ("results.csv", "sweep.h5", "runs/0002/history.csv"):
        assert pathlib.Path("out", name).read_bytes() == pathlib.Path("whole", name).read_bytes()


@pytest.mark.parametrize("jobs", [1, 2])
def test_runs_that_cannot_be_written_are_rows(case, jobs):
    pathlib.Path("study.toml").write_text(STUDY.replace("ground.friction", "output.history_interval")
                                          .replace("[0.1, 0.3, 0.5]", "[0.01, 0, 0.02]"))
    text = ("import resource, rondo, warnings\n"
            "warnings.simplefilter('ignore')\n"
            "resource.setrlimit(resource.RLIMIT_FSIZE, (1000000, resource.RLIM_INFINITY))\n"
            "sweep = rondo.sweep('study.toml', 'out', {'time.end': 1.0}, "
            f"jobs={jobs})\n"
            "print(*sweep['status'], sweep.failures)")
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True,
                          env={**os.environ, "PYTHONPATH": str(ROOT / "python")})
    assert done.stdout.startswith("done failed done"), done.stderr
    assert "history.csv" in done.stdout or "limit of a file's size" in done.stdout, done.stdout


def test_steady_rolling_in_two_threads(case):
    alone = [rondo.steady_rolling(case, STEADY | {"ground.friction": mu}) for mu in (0.1, 0.4)]
    found = {}

    def work(k):
        for _ in range(10):
            found[k] = rondo.steady_rolling(case, STEADY | {"ground.friction": (0.1, 0.4)[k]})
            np.testing.assert_array_equal(found[k].displacement, alone[k].displacement)

    threads = [threading.Thread(target=work, args=(k,)) for k in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for k in range(2):
        np.testing.assert_array_equal(found[k].displacement, alone[k].displacement)
        assert found[k].info["steady"] == alone[k].info["steady"]

# SPDX-License-Identifier: BSD-3-Clause
"""A sweep as a table: columns, selections, runs; and what is unfinished, newer or damaged."""
import json
import pathlib
import shutil

import numpy as np
import pytest
import sweeps
from sweeps import DEPTH, FRICTION, HEIGHT, LOAD, MODULUS, SCHEME, SPIN
from conftest import SMALL, ok
from drawn import said
from test_errors import edit, says

import rondo

TWO = ("symplectic", "as-printed")


@pytest.fixture
def grid(tmp_path: pathlib.Path) -> pathlib.Path:
    """The directory of 24 members that a test may change, the 5th and the 18th failed."""
    return sweeps.grid(tmp_path / "grid", schemes=TWO, failed=(5, 18))


def test_names_without_units_and_of_crushes(grid: pathlib.Path, tmp_path: pathlib.Path) -> None:
    sweep, crush = rondo.open_sweep(grid), rondo.open_sweep(sweeps.loaded(tmp_path / "c"))
    for known, alike in (("force_y_mean", "force_y"), ("end_time_s", "end_time"),
                         ("contact_length_mean_m", "contact_length"),
                         ("contact_length_mean_m", "contact_length_m")):
        np.testing.assert_array_equal(sweep[alike], sweep[known])
        assert sweep.unit_of(alike) == sweep.units[known] != "unknown"
    for known, alike in (("force_y", "force_y_mean"), ("pressure_max_pa", "pressure_max"),
                         ("contact_length_m", "contact_length_mean_m")):
        np.testing.assert_array_equal(crush[alike], crush[known])
    with pytest.raises(rondo.Error, match="no column 'force_z'"):
        sweep["force_z"]


def test_columns(grid: pathlib.Path) -> None:
    sweep = rondo.open_sweep(grid)
    assert (len(sweep), sweep.status, sweep.analysis, sweep.title) == (24, "failed", "dynamic",
                                                                       "a study")
    assert list(sweep.parameters) == [FRICTION, SPIN, SCHEME]
    assert [p.unit for p in sweep.parameters.values()] == ["1", "rad/s", "1"]
    assert sweep.figures == sweeps.FIGURES
    assert sweep.names == ["run", FRICTION, SPIN, SCHEME, "status", *sweeps.FIGURES]
    assert sweep["run"].tolist() == list(range(1, 25)) and sweep["run"].dtype.kind == "i"
    np.testing.assert_array_equal(sweep[FRICTION], np.repeat(sweeps.FRICTIONS, 8))
    np.testing.assert_array_equal(sweep[SPIN], np.tile(np.repeat(sweeps.SPINS, 2), 3))
    assert sweep[SCHEME].tolist() == list(TWO) * 12
    expected = [sweeps.forces(f, s)["force_x_mean"] * (1.01 if scheme == TWO[1] else 1.0)
                for f, s, scheme in zip(sweep[FRICTION], sweep[SPIN], sweep[SCHEME])]
    expected[4] = expected[17] = np.nan
    np.testing.assert_array_equal(sweep["force_x_mean"], expected)
    assert sweep.done.tolist() == [k not in (4, 17) for k in range(24)]
    assert sweep["status"][4] == "failed"
    assert sweep.varied == [FRICTION, SPIN, SCHEME]
    assert "force_x_mean" in sweep and "force_z_mean" not in sweep
    assert (sweep.units["force_x_mean"], sweep.units["torque_mean"], sweep.units["friction_power"],
            sweep.units["penetration_max_m"], sweep.units[SPIN]) == ("N/m", "N·m/m", "W/m", "m",
                                                                     "rad/s")
    assert sweep.timings["wall_s"].tolist() == [0.25] * 24
    assert sweep.failures == {5: "it blew up", 18: "it blew up"}


def test_all_figures_of_the_program_have_a_unit(tmp_path: pathlib.Path) -> None:
    for sweep in (rondo.open_sweep(sweeps.grid(tmp_path / "motions")),
                  rondo.open_sweep(sweeps.loaded(tmp_path / "crushes"))):
        assert "unknown" not in sweep.units.values()


def test_rows(grid: pathlib.Path) -> None:
    sweep = rondo.open_sweep(grid)
    rows = list(sweep)
    assert rows[2] == {name: sweep[name][2] for name in sweep.names}
    assert (rows[2]["run"], rows[2][SPIN], rows[2][SCHEME]) == (3, 33.0, "symplectic")
    assert [type(rows[2][name]) for name in ("run", SPIN, SCHEME)] == [int, float, str]
    assert len(rows) == 24 and rows[0].keys() == next(sweep.rows()).keys()


def test_printed(grid: pathlib.Path, tmp_path: pathlib.Path) -> None:
    sweep = rondo.open_sweep(grid)
    assert repr(sweep) == f"Sweep({grid}: a study; dynamic, 24 members: 22 done, 2 failed)"
    assert str(sweep).splitlines() == [
        repr(sweep), "  ground.friction          0.1 to 0.5, 3 values",
        "  motion.angular_velocity  30 to 40 rad/s, 4 values",
        "  solver.scheme            as-printed, symplectic"]
    lines = str(rondo.open_sweep(sweeps.loaded(tmp_path / "crushes"))).splitlines()
    assert lines[1:3] == ["  target.force_y   100000 to 300000 N/m, 3 values",
                          "  motion.height    0.285 to 0.2954 m, for the target"]


def test_selections(grid: pathlib.Path) -> None:
    sweep = rondo.open_sweep(grid)
    some = sweep.select({FRICTION: 0.1 + 0.2, SCHEME: "as-printed"})  # not 0.3 to the last bit
    assert some["run"].tolist() == [10, 12, 14, 16]
    assert (some.varied, some.parameters, some.status) == ([SPIN], sweep.parameters, "failed")
    assert sweep.select({SPIN: [30.0, 40]}).select({"status": "done"})["run"].tolist() == [
        1, 2, 7, 8, 9, 10, 15, 16, 17, 23, 24]
    assert sweep.where(sweep["force_x_mean"] > 9e4)["run"].tolist() == [22, 23, 24]
    assert sweep.where(sweep.done).done.all()
    assert len(sweep) == 24  # is what it was
    says(rondo.Error, sweep.select, {FRICTION: 0.2}, words=[grid, f"no member with {FRICTION} 0.2",
                                                            "there are: 0.1, 0.3, 0.5"])
    says(rondo.Error, sweep.select, {SCHEME: 3}, words=["as-printed, symplectic"])
    says(rondo.Error, sweep.select, {FRICTION: "high"}, words=["0.1, 0.3, 0.5"])
    says(rondo.Error, sweep.select, {SPIN: []}, words=["no member with", "[]"])
    says(rondo.UnknownNameError, sweep.select, {"friction": 0.3}, words=["no column 'friction'"])
    says(rondo.Error, sweep.select, {FRICTION: 0.1, "run": 20}, words=["no member with all of"])
    says(rondo.Error, sweep.where, [True] * 23, words=["each of the 24 members"])
    says(rondo.Error, sweep.where, sweep["force_y_mean"], words=["float64"])
    says(rondo.Error, sweep.where, sweep["run"] < 0, words=["no member is chosen"])


def test_a_figure_of_ones_own(grid: pathlib.Path) -> None:
    sweep = rondo.open_sweep(grid)
    ratio = sweep["force_x_mean"] / sweep["force_y_mean"]
    more = sweep.with_figure("traction", ratio, "1")
    np.testing.assert_array_equal(more["traction"], ratio)
    assert more.figures == [*sweep.figures, "traction"] and more.units["traction"] == "1"
    assert "traction" not in sweep
    np.testing.assert_array_equal(more.select({FRICTION: 0.5})["traction"], ratio[16:])
    says(rondo.Error, sweep.with_figure, "torque_mean", ratio, "N", words=["already"])
    says(rondo.Error, sweep.with_figure, "traction", ratio[1:], "1", words=["each of the 24"])


def test_sampled_and_targets(tmp_path: pathlib.Path) -> None:
    sweep = rondo.open_sweep(sweeps.sampled(tmp_path / "sampled"))
    assert sweep.varied == [FRICTION, MODULUS, DEPTH]
    assert [sweep.is_sampled(name) for name in (FRICTION, "force_y_mean")] == [True, True]
    loaded = rondo.open_sweep(sweeps.loaded(tmp_path / "loaded"))
    assert list(loaded.parameters) == [LOAD, HEIGHT, FRICTION]
    assert loaded.varied == [LOAD, FRICTION]  # the load decides the height
    assert [loaded.is_sampled(name) for name in (LOAD, HEIGHT, FRICTION)] == [False, True, False]
    assert (loaded.units[LOAD], loaded.units[HEIGHT]) == ("N/m", "m")
    np.testing.assert_array_equal(loaded[LOAD], np.repeat([1e5, 2e5, 3e5], 2))
    assert LOAD not in loaded.figures and loaded.analysis == "crush"


def test_texts_with_commas_and_quotes(tmp_path: pathlib.Path) -> None:
    spins = ["[[0, 0], [0.1, 50]]", 'the "old" one', "30"]
    sweep = rondo.open_sweep(sweeps.write(tmp_path / "x", [(SPIN, "rad/s", "values")],
                                          [{SPIN: spin} for spin in spins]))
    assert sweep[SPIN].tolist() == spins
    assert sweep.select({SPIN: spins[0]})["run"].tolist() == [1]
    assert sweep.select({SPIN: 30})["run"].tolist() == [3]


def test_truth_as_the_program_writes_it(tmp_path: pathlib.Path) -> None:
    sweep = rondo.open_sweep(sweeps.write(tmp_path / "x", [("output.stress", "-", "values")],
                                          [{"output.stress": text} for text in ("true", "false")]))
    assert sweep.select({"output.stress": False})["run"].tolist() == [2]


def test_runs_of_members(grid: pathlib.Path, smooth: pathlib.Path) -> None:
    for number in (3, 5):
        shutil.copytree(smooth, grid / "runs" / f"{number:04d}")
    edit(grid / "runs" / "0005" / "run.json", status="failed")
    sweep = rondo.open_sweep(grid)
    assert sweep.run(3).directory == grid / "runs" / "0003"
    assert sweep.run(5).status == "failed"  # as the table says of it
    says(rondo.UnknownNameError, sweep.run, 25, words=["no run 25; there are: 1 to 24"])
    says(rondo.UnknownNameError, sweep.run, 0)
    says(rondo.NotARunError, sweep.run, 4, words=["runs/0004: no such directory"])
    edit(grid / "sweep.json", members=20000, status="running")
    sweep = rondo.open_sweep(grid, unfinished=True)
    assert sweep.run_directory(7) == grid / "runs" / "00007"


def test_an_unfinished_sweep(tmp_path: pathlib.Path, smooth: pathlib.Path) -> None:
    def interrupted(row: sweeps.Row) -> None:
        if row[FRICTION] > 0.4:
            for name in sweeps.FIGURES:
                row.pop(name, None)
            row["status"] = "interrupted" if row[SPIN] == 30 else "waiting"

    directory = sweeps.grid(tmp_path / "x", failed=[2], change=interrupted, status="interrupted")
    resume = f'"rondo sweep study.toml -o {directory} --resume" goes on with it'
    says(rondo.UnfinishedRunError, rondo.open_sweep, directory,
         words=['status "interrupted"', "stopped before its end",
                "12 members: 7 done, 3 waiting, 1 failed, 1 interrupted", resume,
                f'rondo.open_sweep("{directory}", unfinished=True) reads what is there'])
    sweep = rondo.open_sweep(directory, unfinished=True)
    assert (sweep.status, sweep.done.sum()) == ("interrupted", 7)
    says(rondo.UnfinishedRunError, sweep.run, 11, words=["run 11 has not begun", resume])
    shutil.copytree(smooth, directory / "runs" / "0009")
    edit(directory / "runs" / "0009" / "run.json", status="interrupted")
    says(rondo.UnfinishedRunError, sweep.run, 9, words=["stopped before its end"])
    assert sweep.run(9, unfinished=True).status == "interrupted"
    for status, meaning in ("running", "was killed"), ("asleep", "not known to this package"):
        edit(directory / "sweep.json", status=status)
        says(rondo.UnfinishedRunError, rondo.open_sweep, directory, words=[meaning])


def test_the_line_that_a_killed_sweep_was_writing(grid: pathlib.Path) -> None:
    text = (grid / "results.csv").read_text()
    (grid / "results.csv").write_text(text[:-1])
    says(rondo.Error, rondo.open_sweep, grid, words=["results.csv: damaged", "23 members",
                                                     "24 in sweep.json"])
    edit(grid / "sweep.json", status="running")
    assert len(rondo.open_sweep(grid, unfinished=True)) == 23
    (grid / "results.csv").write_text(text.splitlines()[0] + "\n")
    empty = rondo.open_sweep(grid, unfinished=True)
    assert (len(empty), empty.varied, list(empty)) == (0, [], [])
    assert str(empty).splitlines()[1].endswith("no values yet")


def test_other_directories(grid: pathlib.Path, smooth: pathlib.Path, tmp_path: pathlib.Path
                           ) -> None:
    says(rondo.NotARunError, rondo.open_sweep, tmp_path / "nowhere", words=["no such directory"])
    says(rondo.NotARunError, rondo.open_sweep, tmp_path, words=["has no sweep.json", "holds grid"])
    says(rondo.NotARunError, rondo.open_sweep, smooth, words=[f'rondo.open("{smooth}") opens it'])
    says(rondo.NotARunError, rondo.open, grid,
         words=["is a sweep, not a run", f'rondo.open_sweep("{grid}") opens it'])
    for number in range(1, 25):
        (grid / "runs" / f"{number:04d}").mkdir(parents=True)
        (grid / "runs" / f"{number:04d}" / "run.json").touch()
    says(rondo.NotARunError, rondo.open, grid / "runs",
         words=["it holds 0001, 0002, ", ", 0012, ... (24 in all)"])
    (grid / "results.csv").unlink()
    says(rondo.NotARunError, rondo.open_sweep, grid, words=["has sweep.json, but no results.csv"])


def test_a_newer_sweep(grid: pathlib.Path) -> None:
    edit(grid / "sweep.json", format="rondo sweep 2")
    says(rondo.NewerSchemaError, rondo.open_sweep, grid,
         words=[grid / "sweep.json", "rondo sweep 2", '"rondo sweep 1"'])


@pytest.mark.parametrize("change, words", [
    ({"members": None}, ["damaged", "members"]), ({"members": "many"}, ["damaged", "many"]),
    ({"parameters": None}, ["damaged", "parameters"]), ({"parameters": 3}, ["damaged"]),
    ({"parameters": [{"key": "a"}]}, ["damaged", "unit"]), ({"format": None}, ["its format is"])])
def test_a_damaged_summary(grid: pathlib.Path, change: dict, words: list) -> None:
    edit(grid / "sweep.json", **change)
    says(rondo.Error, rondo.open_sweep, grid, words=[grid / "sweep.json", *words])


def test_a_table_of_other_parameters(grid: pathlib.Path) -> None:
    found = json.loads((grid / "sweep.json").read_text())["parameters"]
    for wrong in (found[:2], [*found, {"key": "time.end", "unit": "s", "kind": "values"}]):
        edit(grid / "sweep.json", parameters=wrong)
        says(rondo.Error, rondo.open_sweep, grid, words=[
            grid / "results.csv", "damaged", f"are {FRICTION}, {SPIN}, {SCHEME}, but those of"])


@pytest.mark.parametrize("old, new, words", [
    (None, "", ["no header"]), (None, "run,a,b\n1,2,3\n", ["columns of a sweep are run"]),
    (None, "run,status,steps,steps\n", ["columns of a sweep are run"]),
    (None, b"\xff\xfe", ["cannot be read"]), ("\n2,", "\n2,5,", ["line 3 has 30"]),
    ("\n3,0.1", "\n3", ["line 4 has 28"]), ("\n3,", "\n2,", ["numbered 1, 2, ... in order"]),
    ("\n3,", "\n2.5,", ["numbered"]), ("done,6000", "done,many", ["steps", "'many'"]),
    ("\n2,0.1", '\n2,"0.1', ["damaged"]), ("\n2,0.1", '\n2,"0.1"5', ["damaged"])])
def test_a_damaged_table(grid: pathlib.Path, old: str | None, new: str | bytes, words: list
                         ) -> None:
    path = grid / "results.csv"
    if isinstance(new, bytes):
        path.write_bytes(new)
    else:
        path.write_text(new if old is None else path.read_text().replace(old, new, 1))
    says(rondo.Error, rondo.open_sweep, grid, words=[path, *words])


def test_more_members_than_there_are(grid: pathlib.Path) -> None:
    edit(grid / "sweep.json", members=23, status="running")
    says(rondo.Error, rondo.open_sweep, grid, True, words=["24 members, but there are 23"])


def test_what_the_program_writes(tmp_path: pathlib.Path) -> None:
    """A sample at each of two speeds; then crushes to two depths."""
    (tmp_path / "base.toml").write_text(SMALL)
    study = ('schema = 1\nbase = "base.toml"\n[[vary]]\nkey = "ground.friction"\n'
             'uniform = [0.1, 0.5]\n[sample]\nkind = "latin-hypercube"\ncount = 3\n'
             '[[vary]]\nkey = "motion.speed"\nvalues = [9.0, 10.0]\n')
    (tmp_path / "study.toml").write_text(study)
    ok("sweep", tmp_path / "study.toml", "-o", tmp_path / "out")
    sweep = rondo.open_sweep(tmp_path / "out")
    assert (len(sweep), sweep.done.all(), sweep.analysis, sweep.failures) == (6, True, "dynamic",
                                                                              {})
    assert [(p.unit, p.kind) for p in sweep.parameters.values()] == [
        ("1", "uniform"), ("m/s", "values")]
    assert sweep.varied == [FRICTION, "motion.speed"] and "unknown" not in sweep.units.values()
    assert set(sweep["motion.speed"]) == {9.0, 10.0} and len(set(sweep[FRICTION])) == 3
    run = sweep.run(4)
    assert run.friction == sweep[FRICTION][3] and run.info["steps"] == sweep["steps"][3]
    assert run.case["motion"]["speed"] == sweep["motion.speed"][3]
    assert sweep["force_y_mean"][3] == pytest.approx(run.history.mean("force_y", 0.01))
    assert len(sweep.timings["run"]) == 6
    (tmp_path / "study.toml").write_text(study.replace("motion.speed", "analysis.depth")
                                         .replace("[9.0, 10.0]", "[0.005, 0.01]"))
    ok("sweep", tmp_path / "study.toml", "-o", tmp_path / "crushes", "--set",
       "analysis.kind=crush", "--set", "analysis.increments=20")
    crushes = rondo.open_sweep(tmp_path / "crushes")
    assert crushes.figures == sweeps.CRUSH_FIGURES and sweep.figures == sweeps.FIGURES
    assert crushes.analysis == "crush" and crushes.run(1).is_crush
    np.testing.assert_array_equal(crushes["depth_m"], crushes["analysis.depth"])
    assert "force_x, torque" in said(crushes.plot_spread())  # round-off beside the load


def test_timings_that_are_gone(grid: pathlib.Path) -> None:
    sweep = rondo.open_sweep(grid)
    (grid / "timings.csv").unlink()
    says(rondo.Error, getattr, sweep, "timings", words=["timings.csv: cannot be read"])
    says(rondo.UnknownNameError, sweep.__getitem__, "force", words=["no column 'force'"])

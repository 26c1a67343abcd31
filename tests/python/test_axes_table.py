# SPDX-License-Identifier: BSD-3-Clause
"""rondo axes, and --axes of the other commands: tables, means and figures against History.in_axes and against single
runs, what is refused and when, and that no table tells of a run that has been replaced."""
import json
import pathlib
import shutil

import numpy as np
import pytest
from conftest import ok
from program import SMALL, replaced, run

import rondo
from rondo import axes
from rondo.data.axes_table import in_words
from rondo.figures.axes_figures import forces_in_axes
from rondo.plots.solid.tyre import plot_tyre_curves

ROOT = pathlib.Path(__file__).resolve().parents[2]
STEADY = (ROOT / "cases" / "wheel3d-steady.toml").read_text().replace("circumferential = 90", "circumferential = 45")
IN_TIME = (STEADY.replace('[analysis]\nkind = "steady-rolling"', "[time]\nend = 0.004\n[output]\nhistory_interval = 0.0005\nsnapshots = 2")
           .replace("height = 0.29 ", "height = [[0.0, 0.3001], [0.002, 0.2995]] "))
CAMBER = "motion.camber=0.05"
STUDY = """schema = 1
base = "{base}"
{more}
[[vary]]
key = "motion.camber"
values = [0.0, 0.05]
[[vary]]
key = "motion.slip_angle"
values = [-0.01, 0.02]
"""


def table(path):
    """Columns of a CSV file: numbers, and the status as text."""
    header, *rows = path.read_text().splitlines()
    columns = dict(zip(header.split(","), zip(*(row.split(",") for row in rows))))
    return {name: np.array(column, dtype=str if name == "status" else float) for name, column in columns.items()}


def same(found, columns):
    """Columns of a table against quantities."""
    for name, (_, end) in axes.QUANTITIES.items():
        np.testing.assert_allclose(columns[name + end], getattr(found, name), rtol=1e-14, err_msg=name)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The runs `steady` and `time`, which lean, and the sweep `sweep` of steady states without directories."""
    folder = tmp_path_factory.mktemp("tables")
    for name, text in (("steady", STEADY), ("time", IN_TIME)):
        (folder / f"{name}.toml").write_text(text)
        ok("run", folder / f"{name}.toml", "-o", folder / name, "--set", CAMBER)
    (folder / "study.toml").write_text(STUDY.format(base="steady.toml", more=""))
    ok("sweep", folder / "study.toml", "-o", folder / "sweep", "--set", "motion.turn_slip=0.03")
    return folder


@pytest.mark.parametrize("name", ["steady", "time"])
def test_the_table_of_a_run(folder, name, tmp_path):
    before = (folder / name / "history.csv").read_bytes()
    for system in axes.NAMES:
        done = run("axes", folder / name, "--axes", system)
        assert done.returncode == 0, done.stderr
        path = folder / name / f"history-{system}.csv"
        assert done.stdout.splitlines()[1:] == [str(path), str(path.with_suffix(".json"))]
        history = rondo.open(folder / name).history
        found, columns = history.in_axes(system), table(path)
        same(found, columns)
        np.testing.assert_array_equal(columns["time_s"], history["time_s"])
        said = json.loads(path.with_suffix(".json").read_text())
        assert said["axes"] == found.system and said["moments_about"] == axes.system(system).origin
        assert [column["name"] for column in said["columns"]] == list(columns)[1:] and said["source"].endswith("history.csv")
        assert f"Fy {found.Fy[-1]:.6g} N" in done.stdout or name == "steady"
        if name == "steady":
            assert f"mean over a sector's pass: axes {found.system}: Fx {found.Fx.mean():.6g} N" in done.stdout
    assert (folder / name / "history.csv").read_bytes() == before
    away = tmp_path / "new" / "forces.csv"
    assert run("axes", folder / name, "--axes", "sae", "-o", away).returncode == 0
    assert away.read_bytes() == (folder / name / "history-sae.csv").read_bytes()


def test_an_effective_radius(folder, tmp_path):
    path = tmp_path / "forces.csv"
    assert run("axes", folder / "steady", "--axes", "iso-w", "--effective-radius", "0.298", "-o", path).returncode == 0
    same(rondo.open(folder / "steady").history.in_axes("iso-w", 0.298), table(path))
    assert json.loads(path.with_suffix(".json").read_text())["radius_of_slip_ratio_m"] == 0.298
    done = run("axes", folder / "steady", "--axes", "iso-w", "--effective-radius", "-1", "-o", path)
    assert done.returncode == 2 and "above 0 m" in done.stderr
    done = run("axes", folder / "steady", "--axes", "rondo", "--effective-radius", "0.298", "-o", path)
    assert done.returncode == 2 and "the same radius in both systems" in done.stderr


def test_the_table_of_a_sweep_without_directories(folder, tmp_path):
    """Each member against a run of its own: keys that vary, one that is set for all, and those of the base case."""
    assert run("axes", folder / "sweep", "--axes", "iso-w").returncode == 0
    columns = table(folder / "sweep" / "results-iso-w.csv")
    assert list(columns)[:4] == ["run", "motion.camber", "motion.slip_angle", "status"]
    assert not (folder / "sweep" / "runs").exists()
    same(rondo.open_sweep(folder / "sweep").in_axes("tydex-w"), columns)
    assert "-0.0," not in (folder / "sweep" / "results-iso-w.csv").read_text()
    for k in range(4):
        one = tmp_path / str(k)
        ok("run", folder / "steady.toml", "-o", one, "--set", "motion.turn_slip=0.03", "--set",
           f"motion.camber={columns['motion.camber'][k]}", "--set", f"motion.slip_angle={columns['motion.slip_angle'][k]}")
        history = rondo.open(one).history
        found = history.in_axes("iso-w").mean(np.ones(history.n_rows))
        for name, (_, end) in axes.QUANTITIES.items():
            assert columns[name + end][k] == pytest.approx(float(getattr(found, name)), rel=1e-9, abs=1e-9), name
    assert set(columns["turn_slip_per_m"]) == {0.03} and set(columns["camber_rad"]) == {-0.05, 0.0}


def test_the_table_of_a_sweep_in_time(folder, tmp_path):
    """Forces are those of the means of its runs; moments with the mean height, off by less than the load times what the
    height varies in a window."""
    (tmp_path / "study.toml").write_text(STUDY.format(base=folder / "time.toml", more="[window]\nfrom = 0.002"))
    ok("sweep", tmp_path / "study.toml", "-o", tmp_path / "sweep", "--axes", "tydex-h")
    columns, sweep = table(tmp_path / "sweep" / "results-tydex-h.csv"), rondo.open_sweep(tmp_path / "sweep")
    for k in range(4):
        history = sweep.run(k + 1).history
        chosen, weights = history.weights(0.002)
        found = history.in_axes("tydex-h").mean(weights, chosen)
        for name, (_, end) in axes.QUANTITIES.items():
            assert columns[name + end][k] == pytest.approx(float(getattr(found, name)), rel=1e-9, abs=1e-9), name


def test_the_end_of_a_run_writes_the_table(folder, tmp_path):
    case, out = folder / "steady.toml", tmp_path / "out"
    done = run("run", case, "-o", out, "--set", CAMBER, "--axes", "iso-w")
    assert done.returncode == 0 and f"{out}: mean over a sector's pass: axes iso-w: Fx" in done.stdout
    assert (out / "history-iso-w.csv").read_bytes() == table_bytes(folder / "steady", "iso-w")
    quiet = run("run", case, "-o", tmp_path / "quiet", "--axes", "sae", "--quiet")
    assert quiet.returncode == 0 and quiet.stdout == "" and (tmp_path / "quiet" / "history-sae.csv").exists()
    document = run("run", case, "-o", tmp_path / "json", "--axes", "sae", "--json")
    assert json.loads(document.stdout)["status"] == "done" and (tmp_path / "json" / "history-sae.csv").exists()
    ok("run", case, "-o", out, "--overwrite")  # without camber: the table would tell of another run
    assert not list(out.glob("history-*"))


def table_bytes(directory, system):
    assert run("axes", directory, "--axes", system).returncode == 0
    return (directory / f"history-{system}.csv").read_bytes()


def test_a_sweep_removes_tables_of_the_one_before(folder, tmp_path):
    study, out = folder / "study.toml", tmp_path / "sweep"
    done = run("sweep", study, "-o", out, "--axes", "iso-w")
    assert done.returncode == 0 and "4 of 4 members have forces; the last of them, run 4: axes iso-w: Fx" in done.stdout
    ok("sweep", study, "-o", out, "--overwrite", "--set", "motion.turn_slip=0.01")
    assert not list(out.glob("results-*"))


def test_what_is_refused_before_the_run_starts(folder, tmp_path):
    case, out = folder / "steady.toml", tmp_path / "out"
    (tmp_path / "plane.toml").write_text(SMALL)
    (tmp_path / "air.toml").write_text(replaced(replaced(IN_TIME, "friction", ""), "profile", "").replace("[ground]", ""))
    back = ["motion.speed=-10", "motion.angular_velocity=-33.76"]
    for words, reason, allowed in (
            ([tmp_path / "plane.toml"], "the body is plane", "without --axes"),
            ([tmp_path / "air.toml"], "no [ground]", "without --axes"),
            ([case, "--set", back[0], "--set", back[1]], "rolls backwards (motion.speed < 0)", "the mirror image"),
            ([folder / "time.toml", "--set", "analysis.kind=crush", "--set", "analysis.depth=0.005", "--set",
              "analysis.increments=4", "--set", "motion.slip_angle=0"], 'analysis.kind is "crush"', "without --axes")):
        done = run("run", *words, "-o", out, "--axes", "iso-w")
        assert done.returncode == 2 and reason in done.stderr and allowed in done.stderr, done.stderr
        assert "--axes" in done.stderr and not out.exists()
    done = run("run", case, "-o", out, "--axes", "iso")
    assert done.returncode == 2 and "tydex-c" in done.stderr and not out.exists()
    study = tmp_path / "study.toml"
    study.write_text(f'schema = 1\nbase = "{case}"\n[[vary]]\nkey = "motion.angular_velocity"\nvalues = [33.0, -33.0]\n')
    done = run("sweep", study, "-o", out, "--axes", "iso-w")
    assert done.returncode == 2 and "run 2 (" in done.stderr and "rolls backwards" in done.stderr and not out.exists()
    done = run("sweep", study, "-o", out, "--axes", "iso-w", "--set", "disk.width=-1")  # refused as without --axes
    assert done.returncode == 2 and "run 1 (" in done.stderr and "disk.width = -1" in done.stderr and not out.exists()
    for more in (["--dry-run"], ["--shard", "1/2"]):
        done = run("sweep", folder / "study.toml", "-o", out, "--axes", "iso-w", *more)
        assert done.returncode == 2 and "whole sweep" in done.stderr and not out.exists()
    done = run("run", case, "-o", out, "--axes", "iso-w", env={"RONDO_PYTHON": "/bin/false"})
    assert done.returncode == 4 and "no Python" in done.stderr and not out.exists()


def test_what_the_command_refuses(folder, smooth, crush, grid, tmp_path):
    for directory, reason in ((smooth, "no wheel in three dimensions"), (crush, "no wheel in three dimensions"),
                              (grid.directory, "no force_lateral"), (tmp_path, "run.json")):
        done = run("axes", directory, "--axes", "iso-w")
        assert done.returncode == 2 and reason in done.stderr, done.stderr
    done = run("axes", folder / "steady", "--axes", "w")
    assert done.returncode == 2 and "axes 'w': no such system (allowed: rondo, iso-w" in done.stderr
    done = run("axes", folder / "steady", "--axes", "sae", "-o", tmp_path / "table.txt")
    assert done.returncode == 2 and "ends in .csv" in done.stderr
    (tmp_path / "file").write_text("")
    done = run("axes", folder / "steady", "--axes", "sae", "-o", tmp_path / "file" / "table.csv")
    assert done.returncode == 4 and "choose another -o" in done.stderr


def test_a_run_that_has_not_ended_as_far_as_it_goes(folder, tmp_path):
    out = pathlib.Path(shutil.copytree(folder / "time", tmp_path / "cut"))
    rows = (out / "history.csv").read_text().splitlines(keepends=True)
    (out / "history.csv").write_text("".join(rows[:4]) + rows[4][:20])
    info = json.loads((out / "run.json").read_text())
    (out / "run.json").write_text(json.dumps({**info, "status": "running"}))
    done = run("axes", out, "--axes", "iso-w")
    assert done.returncode == 2 and "--unfinished" in done.stderr
    done = run("axes", out, "--axes", "iso-w", "--unfinished")
    assert done.returncode == 0 and "last row, to 0.0015" in done.stdout
    assert len(table(out / "history-iso-w.csv")["Fx_N"]) == 3
    (out / "history.csv").write_text(rows[0])
    done = run("axes", out, "--axes", "iso-w", "--unfinished")
    assert done.returncode == 2 and "no rows yet" in done.stderr


def test_a_sweep_of_an_earlier_version(folder, tmp_path):
    out = pathlib.Path(shutil.copytree(folder / "sweep", tmp_path / "old"))
    info = json.loads((out / "sweep.json").read_text())
    del info["case"]
    (out / "sweep.json").write_text(json.dumps(info))
    with pytest.raises(rondo.Error, match="earlier version"):
        rondo.open_sweep(out).in_axes("iso-w")


def test_means(folder):
    done = run("means", folder / "time", "--axes", "iso-w", "--from", "0.001", "--to", "0.003")
    history = rondo.open(folder / "time").history
    found = history.in_axes("iso-w")
    begin, end = np.append(0.0, history["time_s"])[:-1], history["time_s"]
    spans = np.where((begin >= 0.001) & (end <= 0.003), end - begin, 0.0)
    assert done.returncode == 0 and (spans > 0).sum() == 3
    for name in ("Fx", "Fy", "Fz", "Mx", "My", "Mz"):
        assert f"{name} {getattr(found, name) @ spans / spans.sum():.6g} N" in done.stdout, done.stdout
    plain = run("means", folder / "time", "--from", "0.001", "--to", "0.003").stdout
    assert f"force_lateral {-found.Fy @ spans / spans.sum():.5g} N" in plain
    steady = run("means", folder / "steady", "--axes", "sae")
    rows = rondo.open(folder / "steady").history
    assert in_words(rows.in_axes("sae").mean(np.ones(rows.n_rows))) in steady.stdout


def test_figures(folder, tmp_path):
    done = run("figures", folder / "time", "--axes", "tydex-c", "-o", tmp_path)
    assert done.returncode == 0 and (tmp_path / "forces-tydex-c.png").exists() and (tmp_path / "forces.png").exists()
    found = rondo.open(folder / "time").history.in_axes("tydex-c")
    above, below = forces_in_axes(rondo.open(folder / "time"), "tydex-c").axes
    unit = 1e-3 if "kN" in above.get_ylabel() else 1.0
    for line, values in zip(above.lines, found.forces.T):
        np.testing.assert_allclose(line.get_ydata(), unit * values)
    assert [line.get_label() for line in below.lines] == ["$M_x$", "$M_y$", "$M_z$"]
    for directory, reason in ((folder / "steady", "no forces over time"), (folder / "sweep", "rondo tyre --axes")):
        done = run("figures", directory, "--axes", "sae", "-o", tmp_path)
        assert done.returncode == 2 and reason in done.stderr


def test_curves_of_a_tyre(folder, tmp_path):
    done = run("tyre", folder / "sweep", "--axes", "iso-w", "-o", tmp_path)
    assert done.returncode == 0 and (tmp_path / "tyre-motion.camber-iso-w.png").exists(), done.stderr
    sweep = rondo.open_sweep(folder / "sweep")
    found = sweep.in_axes("iso-w")
    figure = plot_tyre_curves(sweep, axes="iso-w")
    assert [text.get_text() for text in figure.legends[0].texts] == ["camber 0°", "camber \u22122.86°"]  # to the left: < 0
    force, moment = figure.axes[:2]
    for ax, values in ((force, found.Fy), (moment, found.Mz)):
        unit = 1e-3 if "kN" in ax.get_ylabel() else 1.0
        for line, rows in zip(ax.lines, ([1, 0], [3, 2])):  # in the order of the slip angles in ISO axes
            np.testing.assert_allclose(line.get_xdata(), [-np.degrees(0.02), np.degrees(0.01)])
            np.testing.assert_allclose(line.get_ydata(), unit * values[rows])

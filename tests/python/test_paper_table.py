# SPDX-License-Identifier: BSD-3-Clause
"""The study of the paper, quick: its table against numbers computed here from its files; the
measures that it is made with, on data made by hand."""
import math
import pathlib
import shlex
import shutil

import h5py
import numpy as np
import pytest
from program import ROOT, history, run, summary
from studies import record, table

from rondo.data.errors import Error
from rondo.data.history import History
from rondo.studies.annulus import bessel_j, bessel_y, spinning_annulus
from rondo.studies.paper_measures import Measures, _Rows
from rondo.studies.paper_plan import Plan, read_plan
from rondo.studies.paper_table import passes

N_RUNS, N_PODS = 19, 18


@pytest.fixture(scope="module")
def folder(paper):
    return paper.directory


def test_every_row_is_as_expected(folder):
    found = record(folder)
    assert (found["status"], found["quick"]) == ("done", True)
    assert (found["passed"], found["failed"]) == (36, 0) == (len(found["table"]), 0)
    assert [row["figure"] for row in found["table"]] == sorted(
        row["figure"] for row in found["table"])
    for row in found["table"]:
        assert row["pass"] and row["source"], row


def test_runs_and_pods_are_all_there_with_their_commands(folder):
    found = record(folder)
    assert (len(found["runs"]), len(found["pods"])) == (N_RUNS, N_PODS)
    for entry in found["runs"]:
        assert entry["command"].startswith("rondo run "), entry
        blows_up = entry["name"] == "spin-up-fast-as-printed"
        assert entry["status"] == ("failed" if blows_up else "done"), entry
        assert entry["status"] == summary(folder / entry["directory"])["status"]
        assert ("blown up" in entry.get("message", "")) == blows_up
    for entry in found["pods"]:
        assert (folder / entry["directory"] / "pod.h5").is_file(), entry
        assert entry["command"].startswith(f"rondo pod {folder}/runs/"), entry


def test_a_command_of_the_record_gives_the_same_bits(folder, tmp_path):
    entry = next(e for e in record(folder)["runs"] if e["name"] == "friction-0.2")
    words = shlex.split(entry["command"])
    words[words.index("-o") + 1] = str(tmp_path / "by-hand")
    assert run(*words[1:]).returncode == 0
    assert ((tmp_path / "by-hand" / "history.csv").read_bytes()
            == (folder / "runs" / "friction-0.2" / "history.csv").read_bytes())


def test_the_table_is_what_the_files_say(folder):
    rows, runs = table(folder), folder / "runs"
    # Rows of the history are means over their intervals.
    h = history(runs / "friction-0.2")
    spans = np.diff(h["time_s"], prepend=0)
    late = h["time_s"] - spans >= 0.095
    assert rows["friction-0.2-force-y"]["ours"] == pytest.approx(
        np.average(h["force_y"][late], weights=spans[late]), abs=1e-6)
    # The pitch frequency by an FFT of the rows: within its resolution.
    h = history(runs / "turn-treaded")
    late = h["time_s"] > 0.1
    force = h["force_y"][late] - h["force_y"][late].mean()
    step = (h["time_s"][late][-1] - h["time_s"][late][0]) / (late.sum() - 1)
    lines = np.abs(np.fft.rfft(force * np.hanning(late.sum())))
    frequency = np.fft.rfftfreq(late.sum(), step)
    low = frequency < 500
    assert rows["treaded-frequency"]["ours"] == pytest.approx(
        frequency[low][np.argmax(lines[low])], abs=frequency[1])
    # The edge of the spun-up ring.
    with h5py.File(runs / "spin-up-damped" / "results.h5") as file:
        edge = file["mesh/boundary"][:]
        x = file["mesh/coordinates"][:][edge]
        u = file["snapshots/displacement"][-1][edge]
    radial = np.einsum("ij,ij->i", u, x / np.linalg.norm(x, axis=1)[:, None]).mean()
    assert rows["damped-closed-form"]["ours"] == pytest.approx(radial, abs=1e-16)
    assert rows["damped-closed-form"]["expected"] == pytest.approx(1.591599e-4, abs=1e-10)

    # Numbers of modes, from the spectra.
    def modes(name):
        spectrum = np.genfromtxt(runs / name / "spectrum.csv", delimiter=",", names=True)
        return 1 + np.argmax(spectrum["discarded_energy"] <= 1e-4)

    gain = modes("turn-smooth/pod/velocity-rotating") / modes(
        "turn-smooth/pod/velocity-rectified")
    assert rows["smooth-velocity-gain"]["ours"] == gain
    as_crush = rows["treaded-displacement-as-crush"]
    assert as_crush["ours"] == modes("turn-treaded/pod/displacement-rectified")
    assert as_crush["expected"] == modes("crush-treaded/pod/displacement-rotating")
    # Coulomb's law, node by node.
    worst = -1.0
    for friction in ("0.0", "0.2", "0.4", "0.6"):
        with h5py.File(runs / f"friction-{friction}" / "results.h5") as file:
            force = file["contact/force"][:]
        outside = np.abs(force[..., 1]) - float(friction) * force[..., 0]
        worst = max(worst, outside.max() / force[..., 0].max())
    assert rows["shear-in-cone"]["ours"] == pytest.approx(worst, abs=1e-20)


@pytest.mark.parametrize("quick", [False, True])
def test_the_plan(quick):
    plan = read_plan(ROOT / "studies" / "paper", quick)
    assert len(plan.rows) == (36 if quick else 68)
    assert len({row["name"] for row in plan.rows}) == len(plan.rows)
    names = {planned.name for planned in plan.runs}
    assert len(names) == N_RUNS and {pod.run for pod in plan.pods} <= names
    for planned in plan.runs:
        settings = [part for text in planned.settings for part in ("--set", text)]
        said = run("check", planned.case, *settings)
        assert said.returncode == 0, said.stderr
        assert ("warning" in said.stderr) == planned.name.endswith("as-printed"), said.stderr
        if planned.name.startswith("ledge"):  # they meet the paper's times
            snapshots = next(int(text.split("=")[1]) for text in planned.settings
                             if text.startswith("output.snapshots="))
            for time in (0.0125, 0.0625, 0.1):
                at = time / (0.12 / (snapshots - 1))
                assert at == pytest.approx(round(at), abs=1e-9), (planned.name, time)


# What it measures with


def rows_of(tmp_path: pathlib.Path, time, value, begin=0.0) -> _Rows:
    lines = "".join(f"{float(t)!r},{float(v)!r}\n" for t, v in zip(time, value))
    (tmp_path / "history.csv").write_text("time_s,y\n" + lines)
    return _Rows(History(tmp_path / "history.csv"), "y", begin)


def wave(a, b, f, end):
    """a + b cos(2π f t + 0.3), as means over intervals of 0.3, 0.5, 0.7 ms in turn."""
    time = np.cumsum(np.resize([3e-4, 5e-4, 7e-4], int(end / 5e-4)))
    start, w = np.append(0.0, time)[:-1], 2 * np.pi * f
    return time, a + b * (np.sin(w * time + 0.3) - np.sin(w * start + 0.3)) / (w * (time - start))


def test_means_and_deviations_are_by_time_not_by_row(tmp_path):
    rows = rows_of(tmp_path, [1.0, 2.0, 5.0], [100.0, 1.0, 3.0])
    assert rows.mean == 22.0
    later = rows_of(tmp_path, [1.0, 2.0, 5.0], [100.0, 1.0, 3.0], begin=1.0)
    assert (later.mean, later.deviation) == (2.5, math.sqrt(0.75))
    with pytest.raises(Error, match="no rows"):
        rows_of(tmp_path, [1.0], [1.0], begin=1.0)


@pytest.mark.parametrize("time", [(0.1, 0.3, 0.2), (0.1, 0.1, 0.2), (-0.1, 0.1, 0.2),
                                  (0.1, math.nan, 0.2), (0.1, 0.2, math.inf)])
def test_times_that_do_not_rise_are_refused(tmp_path, time):
    with pytest.raises(Error, match="do not rise"):
        rows_of(tmp_path, time, (1.0, 2.0, 3.0))


def test_a_line_has_the_height_and_frequency_of_its_harmonic(tmp_path):
    rows = rows_of(tmp_path, *wave(1000.0, 7.0, 123.4, 0.4), begin=0.1)
    # Means over up to 0.7 ms damp the harmonic by at most (w Δt)²/24 = 1.2 %.
    high, low = rows.line(np.array([123.4, 223.4]))
    assert high == pytest.approx(7.0, abs=0.12) and low < 0.05
    assert rows.highest_line() == pytest.approx(123.4, abs=0.11)  # steps of a tenth of a hertz
    assert math.isnan(rows_of(tmp_path, [1e-9, 2e-9], [1.0, 2.0]).highest_line())


def test_the_edge_of_a_ring(smooth, tmp_path):
    copy = tmp_path / "runs" / "ring"
    shutil.copytree(smooth, copy)
    with h5py.File(copy / "results.h5", "r+") as file:
        x, t = file["mesh/coordinates"][:], file["frame/time"][:]
        turned = np.stack([-x[:, 1], x[:, 0]], axis=1)
        swing = np.array([0, 2, -2, 0, 0, 0, 0, 0, 0, 1, -1])[:, None, None]
        file["snapshots/displacement"][:] = 0.01 * (5 + swing) * x + 0.3 * turned  # radius 0.3
    measures = Measures(tmp_path, Plan([], [], 0, [], tmp_path / "study.toml"))
    assert measures.edge_at_the_end("ring") == pytest.approx(0.01 * 4 * 0.3)
    assert measures.edge_at_the_start("ring") == pytest.approx(0.01 * 5 * 0.3)
    assert measures.edge_mean("ring") == pytest.approx(0.01 * 5 * 0.3)
    assert measures.largest_tangential("ring", t[3]) == pytest.approx(0.3 * 0.3)
    assert measures.swing_kept("ring", 0.2) == pytest.approx(0.5)
    with pytest.raises(Error, match="no measure 'edge'"):
        measures.of(["edge", "ring"])


def test_a_row_passes_within_its_bound():
    def with_(comparison, ours):
        return passes({"ours": ours, "expected": 2.0, "comparison": comparison, "tolerance": 0.5})

    assert [with_("within", x) for x in (2.5, 2.51, 1.49)] == [True, False, False]
    assert [with_("at most", x) for x in (2.0, 2.1)] == [True, False]
    assert [with_("at least", x) for x in (2.0, 1.9)] == [True, False]
    assert not any(with_(c, math.nan) for c in ("within", "at most", "at least"))


def test_the_closed_form():
    # Tables of Abramowitz and Stegun, 9.1.
    assert bessel_j(0, 1.0) == pytest.approx(0.7651976865579666, rel=1e-14)
    assert bessel_j(1, 5.0) == pytest.approx(-0.3275791375914652, rel=1e-12)
    assert bessel_y(0, 1.0) == pytest.approx(0.0882569642156769, rel=1e-13)
    assert bessel_y(1, 0.1) == pytest.approx(-6.4589510947020270, rel=1e-13)
    material = {"youngs_modulus": 5e6, "poissons_ratio": 0.45, "density": 1100.0,
                "plane": "strain"}
    at = [spinning_annulus(material, 0.2, 0.3, 50.0, r) for r in (0.2, 0.3)]
    assert at[0] == pytest.approx(0.0, abs=1e-15)
    assert at[1] == pytest.approx(1.5915988918730e-4, rel=1e-10)
    plane = spinning_annulus({**material, "plane": "stress"}, 0.2, 0.3, 50.0, 0.3)
    assert plane > 2 * at[1]  # free to contract along the axis

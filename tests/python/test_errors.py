# SPDX-License-Identifier: BSD-3-Clause
"""What is no run, unfinished, newer or damaged: which error, and what it says to do."""
import json
import pathlib
import re
import shutil

import h5py
import numpy as np
import pytest

import rondo
from rondo.plots.contact import contact_of


def says(kind, function, *arguments, words=()):
    """The message of the error that is expected; `words` are in it."""
    with pytest.raises(rondo.Error) as caught:
        function(*arguments)
    assert type(caught.value) is kind
    message = str(caught.value)
    assert "\n" not in message
    for word in words:
        assert str(word) in message, message
    return message


def edit(path, **changes):
    """Changes keys of a JSON file; None takes one out."""
    found = json.loads(path.read_text()) | changes
    path.write_text(json.dumps({key: value for key, value in found.items() if value is not None}))


def test_all_errors_are_rondos():
    for name in rondo.__all__:
        if name.endswith("Error"):
            assert issubclass(getattr(rondo, name), rondo.Error)
    assert issubclass(rondo.UnknownNameError, KeyError)


def test_no_such_directory(tmp_path):
    nowhere = tmp_path / "x"
    says(rondo.NotARunError, rondo.open, nowhere, words=[nowhere, "no such directory"])


def test_a_file_is_no_directory(smooth):
    says(rondo.NotARunError, rondo.open, smooth / "results.h5",
         words=["is a file", "rondo.open takes the directory of a run"])


def test_an_empty_directory_and_the_one_above(tmp_path, runs):
    says(rondo.NotARunError, rondo.open, tmp_path, words=[tmp_path, "it has no run.json"])
    says(rondo.NotARunError, rondo.open, runs, words=["it holds air, crush, smooth, treaded"])


def test_half_a_run(copy):
    (copy / "results.h5").unlink()
    says(rondo.NotARunError, rondo.open, copy, words=["has run.json, but no results.h5"])


def test_one_kind_opened_as_another(smooth, tmp_path):
    pod = smooth / "pod" / "velocity-rectified"
    says(rondo.NotARunError, rondo.open, pod, words=["is a POD", f'rondo.open_pod("{pod}")'])
    says(rondo.NotARunError, rondo.open_pod, smooth, words=["is a run", f'rondo.open("{smooth}")'])
    (tmp_path / "paper.json").write_text("{}")
    says(rondo.NotARunError, rondo.open, tmp_path,
         words=["is a paper study", f'rondo.open_paper("{tmp_path}")'])
    says(rondo.NotARunError, rondo.open_paper, smooth, words=["is a run", "not a paper study"])


def test_a_killed_run(killed):
    says(rondo.UnfinishedRunError, rondo.open, killed,
         words=['status "running"', "still running, or was killed", "snapshots are there",
                f'rondo.open("{killed}", unfinished=True)'])
    run = rondo.open(killed, unfinished=True)
    with h5py.File(killed / "results.h5") as file:
        times = file["frame/time"][:]
        last = file["snapshots/displacement"][run.n_snapshots - 1]
    assert 2 <= run.n_snapshots == np.isfinite(times).sum() < len(times)
    np.testing.assert_array_equal(run.times, times[:run.n_snapshots])
    np.testing.assert_array_equal(run.displacement[-1], last)
    assert np.abs(last).max() > 0
    assert len(run.displacement) == len(run.contact.force) == len(run.center) == run.n_snapshots
    with pytest.raises(IndexError):
        run.displacement[run.n_snapshots]


def test_the_line_that_a_killed_run_was_writing(copy):
    edit(copy / "run.json", status="running")
    text = (copy / "history.csv").read_text()
    whole = len(text.splitlines()) - 1
    cut = text[:-1]  # the last number may have lost digits: not to be told from a whole one
    (copy / "history.csv").write_text(cut)
    assert len(rondo.open(copy, unfinished=True).history["time_s"]) == whole - 1
    (copy / "history.csv").write_text(text.splitlines()[0] + "\n0.0")
    assert len(rondo.open(copy, unfinished=True).history["force_y"]) == 0


@pytest.mark.parametrize("cut", [1, 300, -1])
def test_a_history_that_has_lost_its_end(copy, cut):
    """Of a run that is done it is whole: its last row within a line, some rows, all rows gone."""
    text = (copy / "history.csv").read_text()
    (copy / "history.csv").write_text(text[:-cut] if cut > 0 else text.splitlines()[0] + "\n")
    says(rondo.Error, getattr, rondo.open(copy), "history",
         words=[copy / "history.csv", "damaged", "it ends at", "the run is done, to 0.02"])
    edit(copy / "run.json", status="interrupted")
    assert rondo.open(copy, unfinished=True).history.names[0] == "time_s"


def test_a_crush_that_has_lost_its_end(crush, tmp_path):
    copy = shutil.copytree(crush, tmp_path / "crush")
    text = (copy / "history.csv").read_text()
    assert len(rondo.open(copy).history["depth_m"]) == 41
    (copy / "history.csv").write_text(text[:-1])
    says(rondo.Error, getattr, rondo.open(copy), "history",
         words=["history.csv", "damaged", "40 rows", "done, with 41"])


@pytest.mark.parametrize("status, meaning", [("interrupted", "stopped before its end"),
                                             ("failed", "ended with an error: step 5 blew up"),
                                             ("sleeping", "not known to this package")])
def test_other_unfinished_runs(copy, status, meaning):
    edit(copy / "run.json", status=status, message="step 5 blew up" if status == "failed" else None)
    says(rondo.UnfinishedRunError, rondo.open, copy,
         words=[f'status "{status}"', meaning, "11 snapshots are there"])
    assert rondo.open(copy, unfinished=True).n_snapshots == 11


def test_newer_files(copy, tmp_path):
    with h5py.File(copy / "results.h5", "r+") as file:
        file.attrs["format"] = "rondo results 2"
    says(rondo.NewerSchemaError, rondo.open, copy,
         words=["results.h5", '"rondo results 2"', '"rondo results 1"', "install"])
    pod = copy / "pod" / "velocity-rectified"
    with h5py.File(pod / "pod.h5", "r+") as file:
        file.attrs["format"] = "rondo pod 12"
    says(rondo.NewerSchemaError, rondo.open_pod, pod, words=["pod.h5", '"rondo pod 12"'])
    (tmp_path / "paper.json").write_text('{"format": "rondo paper 2"}')
    says(rondo.NewerSchemaError, rondo.open_paper, tmp_path, words=["paper.json", "rondo paper 2"])


def test_a_newer_case(copy):
    text = (copy / "case.toml").read_text()
    (copy / "case.toml").write_text(text.replace("schema = 1", "schema = 2"))
    says(rondo.NewerSchemaError, rondo.open, copy, words=["case.toml", "schema 2", "reads 1"])


@pytest.mark.parametrize("name, text, words", [
    ("run.json", '{"status": "do', ["cannot be read", "line 1"]),
    ("run.json", "[1, 2]", ["an object is expected, found list"]),
    ("case.toml", "schema = ", ["cannot be read"]),
    ("case.toml", 'title = "x"\n', ["no schema"]),
    ("results.h5", "rubbish", ["may be damaged"]),
])
def test_damaged_files(copy, name, text, words):
    (copy / name).write_text(text)
    says(rondo.Error, rondo.open, copy, words=[copy / name, *words])


def test_a_truncated_file(copy):
    data = (copy / "results.h5").read_bytes()
    (copy / "results.h5").write_bytes(data[:len(data) // 2])
    says(rondo.Error, rondo.open, copy, words=["results.h5", "may be damaged", "truncated"])


def test_a_foreign_file(copy):
    with h5py.File(copy / "results.h5", "w") as file:
        file["x"] = 1
    says(rondo.Error, rondo.open, copy, words=["format is None", '"rondo results 1" is expected'])


def test_a_dataset_that_is_not_there(copy):
    run = rondo.open(copy)
    with h5py.File(copy / "results.h5", "r+") as file:
        del file["snapshots/displacement"], file["mesh/mass"]
    says(rondo.Error, run.position, 0, words=["results.h5", "may be damaged", "displacement"])
    says(rondo.Error, rondo.open, copy, words=["results.h5", "may be damaged", "mass"])


@pytest.mark.parametrize("text, words", [
    ("", ["no header"]), ("time_s,force_y\n1,2\nx,3\n", ["damaged", "row 1 is line 2"]),
    ("time_s,force_y\n1,2,3\n", ["2 columns are named, but there are 3"]),
    ("time_s,force_y\n1,2\n1\n", ["damaged"])])
def test_a_damaged_history(copy, text, words):
    (copy / "history.csv").write_text(text)
    says(rondo.Error, getattr, rondo.open(copy), "history", words=[copy / "history.csv", *words])


def test_damaged_pods_and_papers(copy, tmp_path):
    pod = copy / "pod" / "velocity-rectified"
    edit(pod / "pod.json", unit=None)
    says(rondo.Error, rondo.open_pod, pod, words=["pod.json", "damaged", "unit"])
    (pod / "pod.h5").unlink()
    says(rondo.NotARunError, rondo.open_pod, pod, words=["has pod.json, but no pod.h5"])
    (tmp_path / "paper.json").write_text('{"format": "rondo paper 1", "status": "done"}')
    says(rondo.Error, rondo.open_paper, tmp_path, words=["paper.json", "damaged", "quick"])


def test_names_that_are_not_there(smooth, air):
    run = rondo.open(smooth)
    says(rondo.UnknownNameError, run.field, "stress", words=["'stress'", "stress_xx, "])
    says(rondo.UnknownNameError, run.history.__getitem__, "force", words=["history.csv", "force_y"])
    says(rondo.UnknownNameError, run.pods.__getitem__, "x", words=["contact-rotating, "])
    says(rondo.UnknownNameError, run.pod, "velocity", words=["velocity-rectified", "to make it: "
         f"rondo pod {smooth} --field velocity --frame co-rotating"])
    says(rondo.UnknownNameError, rondo.open(air).field, "contact_force", words=["displacement"])
    for name in "force_y_mean", "contact_length_mean_m", "time_mean":  # which a sweep would have
        says(rondo.UnknownNameError, run.history.__getitem__, name, words=["history.csv", name])
    assert run.history.get("force") is None and "force" not in run.history
    assert run.pods.get("x") is None


def test_names_that_a_paper_has_not(tmp_path, smooth):
    (tmp_path / "paper.json").write_text(json.dumps({
        "format": "rondo paper 1", "status": "running", "quick": False, "pods": [],
        "runs": [{"name": "turn", "directory": "turn", "status": "failed"},
                 {"name": "next", "directory": "next", "status": "running"}],
        "table": [{"name": "a"}]}))
    paper = rondo.open_paper(tmp_path)
    says(rondo.UnknownNameError, paper.run, "x", words=["run 'x'", "turn, next"])
    says(rondo.UnknownNameError, paper.row, "b", words=["row of the table 'b'", "there are: a"])
    for name in ("turn", "next"):
        shutil.copytree(smooth, tmp_path / name)
    edit(tmp_path / "turn" / "run.json", status="failed")
    edit(tmp_path / "next" / "run.json", status="running")
    assert paper.run("turn").status == "failed"  # as the study says of it
    says(rondo.UnfinishedRunError, paper.run, "next")


@pytest.mark.parametrize("quick", [False, True])
def test_a_study_without_its_table(tmp_path, quick):
    runs = [{"name": name, "directory": name, "status": status} for name, status in
            (("a", "done"), ("b", "failed"), ("c", "running"), ("d", "waiting"))]
    info = {"format": "rondo paper 1", "status": "interrupted", "quick": quick, "runs": runs,
            "pods": [{"directory": "a/pod", "status": "done"}], "table": []}
    (tmp_path / "paper.json").write_text(json.dumps(info))
    goes_on = f'"rondo paper -o {tmp_path}{" --quick" if quick else ""}" goes on'
    says(rondo.UnfinishedRunError, rondo.open_paper, tmp_path,
         words=['status "interrupted"', "2 of 5 parts are done, 1 have failed", goes_on,
                f'rondo.open_paper("{tmp_path}", unfinished=True)'])
    assert rondo.open_paper(tmp_path, unfinished=True).run_names == ["a", "b", "c", "d"]
    edit(tmp_path / "paper.json", status="failed", table=[{"name": "a", "pass": False}])
    assert rondo.open_paper(tmp_path).row("a")["pass"] is False
    edit(tmp_path / "paper.json", status="done", table=[])
    assert rondo.open_paper(tmp_path).table == []


def test_windows_without_rows_and_means_of_a_crush(smooth, crush):
    says(rondo.Error, rondo.open(smooth).history.mean, "force_y", 1.0,
         words=["no rows from 1 s", "there are 0 to 0.02"])
    says(rondo.Error, rondo.open(smooth).history.mean, "force_y", 0.02, 0.01,
         words=["no rows from 0.02 to 0.01 s"])
    says(rondo.Error, rondo.open(crush).history.mean, "force_y", words=["no means over time"])


def test_more_modes_than_are_kept(smooth):
    pod = rondo.open_pod(smooth / "pod" / "velocity-rectified")
    says(rondo.Error, pod.reconstruct, 0, 4, words=["3 modes are kept; 4 were asked", "--modes"])
    says(rondo.Error, pod.reconstruct, 0, -1)


def test_a_run_without_snapshots(copy):
    with h5py.File(copy / "results.h5", "r+") as file:
        for group in ("frame", "snapshots", "fields", "contact"):
            del file[group]
    run = rondo.open(copy)
    assert (run.n_snapshots, run.center.shape, run.field_names) == (0, (0, 2), [])
    assert run.contact is None
    says(rondo.Error, run.index, 0.0, words=["no snapshots yet"])
    says(rondo.Error, run.field, "displacement", words=["no snapshots yet"])


def test_a_run_that_was_to_have_no_snapshots(copy, tmp_path):
    with h5py.File(copy / "results.h5", "r+") as file:
        for group in ("frame", "snapshots", "fields", "contact"):
            del file[group]
    text = (copy / "case.toml").read_text()
    (copy / "case.toml").write_text(text.replace("snapshots = 11", "snapshots = 0"))
    run = rondo.open(copy)
    assert run.case["output"]["snapshots"] == 0
    for function, arguments in ((run.index, [0.0]), (run.field, ["displacement"]),
                                (run.plot_field, [0.0]), (run.animate, [tmp_path / "a.gif"]),
                                (contact_of, [run])):
        says(rondo.Error, function, *arguments, words=["no snapshots: output.snapshots was 0"])


def test_all_messages_name_a_place(tmp_path):
    """Where: the path is always first."""
    for function in (rondo.open, rondo.open_pod, rondo.open_paper):
        assert re.match(re.escape(str(pathlib.Path(tmp_path))) + ": ",
                        says(rondo.NotARunError, function, tmp_path))

# SPDX-License-Identifier: BSD-3-Clause
"""rondo paper on a study of small runs: killed, interrupted, gone on with, what it keeps
and what it refuses. The study itself: test_paper_table.py, paper_in_full.py."""
import json
import os
import pathlib
import signal
import subprocess
import time

import pytest
from studies import command, paper, parts, record, small_study, table

from rondo.studies.jobs import Job
from rondo.studies.progress import bar_line, ended_line, readable_time

END = 2000.0  # s of the long run: minutes of computing


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    return small_study(tmp_path_factory.mktemp("plan"))


@pytest.fixture(scope="module")
def done(study, tmp_path_factory):
    """A study that is done."""
    folder = tmp_path_factory.mktemp("done") / "study"
    found = paper("--study", study, "-o", folder)
    assert found.returncode == 0, found.stderr
    assert "2 of 2 as expected" in found.stdout
    return folder


def until(condition):
    deadline = time.monotonic() + 60
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.01)


def ended(folder):
    return {part["directory"] for part in parts(folder) if part["status"] in ("done", "failed")}


def made_again(study, folder, code=0):
    """Directories of what the next call does anew."""
    again = paper("--study", study, "-o", folder)
    assert again.returncode == code, again.stderr
    return {part["directory"] for part in parts(folder) if not part["kept"]}


def started(study, folder, *more):
    return subprocess.Popen([*more, *command("--study", study, "-o", folder, "--jobs", 2)],
                            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                            stderr=subprocess.PIPE, text=True)


def at_work(folder):
    """All but the long run and what is done have ended."""
    return (folder / "paper.json").exists() and len(ended(folder)) >= 4


def processes_of(folder):
    found = []
    for file in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
        try:
            found.append(file.read_bytes())
        except OSError:  # it has just ended
            pass
    return [line for line in found if str(folder).encode() in line]


def test_killed_interrupted_and_gone_on_with(tmp_path):
    study, folder = small_study(tmp_path / "plan", END), tmp_path / "study"
    process = started(study, folder)
    until(lambda: at_work(folder))
    process.kill()
    process.wait()
    assert record(folder)["status"] == "running"
    until(lambda: not processes_of(folder))  # the long run dies with it
    kept = ended(folder)
    times = {name: (folder / name).stat().st_mtime_ns for name in kept}

    process = started(study, folder)
    until(lambda: (folder / "runs/long/run.json").exists()
          and json.loads((folder / "runs/long/run.json").read_text())["status"] == "running"
          and processes_of(folder / "runs/long"))
    busy = paper("--study", study, "-o", folder)
    assert busy.returncode == 4
    assert f"rondo: error: {folder}: another rondo is at work here" in busy.stderr
    process.send_signal(signal.SIGTERM)
    said = process.communicate()[1]
    assert process.returncode == 130, said
    assert f"{len(kept)} of 5 jobs are there already" in said
    assert "the same command goes on" in said
    found = record(folder)
    assert (found["status"], found["table"]) == ("interrupted", [])
    cut = json.loads((folder / "runs/long/run.json").read_text())
    assert cut["status"] == "interrupted" and cut["steps_done"] < cut["steps"]

    small_study(tmp_path / "plan")  # the long run is short now: of another case
    assert made_again(study, folder) == {"runs/long"}
    assert {name: (folder / name).stat().st_mtime_ns for name in kept} == times
    assert record(folder)["status"] == "done"


def test_under_nohup_it_goes_on(tmp_path):
    folder = tmp_path / "study"
    process = started(small_study(tmp_path / "plan", 10.0), folder, "nohup")
    until(lambda: at_work(folder))
    process.send_signal(signal.SIGHUP)
    process.communicate()
    assert process.returncode == 0


def test_one_at_a_time_gives_the_same(study, done, tmp_path):
    assert paper("--study", study, "-o", tmp_path, "--jobs", 1, "--quiet").returncode == 0
    for name, row in table(done).items():
        assert row == table(tmp_path)[name]


def test_its_record(done):
    found = record(done)
    assert (found["format"], found["status"], found["quick"]) == ("rondo paper 1", "done", False)
    assert (found["passed"], found["failed"]) == (2, 0)
    assert [run["status"] for run in found["runs"]] == ["done", "done", "failed"]
    assert found["runs"][2]["message"].startswith("failed, as it should: ")
    assert all(part["wall_s"] > 0 for part in parts(done))


def test_what_is_not_as_it_should_be_is_made_again(study, done):
    assert made_again(study, done) == set()
    runs = done / "runs"

    def edit(file, change):
        file.write_text(change(file.read_text()))

    def of_another_program(text):
        return text.replace('"build_id": "', '"build_id": "0')

    pods = {"runs/rolls/pod/velocity-rotating", "runs/rolls/pod/contact-rotating"}
    velocity, contact = (runs / "rolls" / "pod" / name for name in
                         ("velocity-rotating", "contact-rotating"))
    # Of another case, truncated, of another program; a failure of the machine's.
    edit(runs / "long" / "case.toml", lambda text: text.replace("end = 0.02", "end = 0.03"))
    edit(runs / "blows-up" / "run.json", lambda text: text.replace('"steps_done"', '"lost"'))
    os.truncate(velocity / "pod.h5", 10)
    edit(contact / "pod.json", of_another_program)
    assert made_again(study, done) == {"runs/long", "runs/blows-up", *pods}
    os.truncate(runs / "long" / "history.csv", 1000)
    edit(runs / "rolls" / "run.json", of_another_program)
    os.truncate(contact / "spectrum.csv", 0)
    assert made_again(study, done) == {"runs/long", "runs/rolls", *pods}
    (runs / "long" / "results.h5").unlink()
    edit(velocity / "pod.json", lambda text: text.replace('"modes_kept": 2', '"modes_kept": 1'))
    edit(contact / "pod.json", lambda text: text.replace('"delassus"', '"none"'))
    left = [velocity / ".pod.123.tmp" / "half", runs / "long" / "case.toml.123.tmp"]
    left[0].parent.mkdir()
    for file in left:
        file.write_text("half")
    assert made_again(study, done) == {"runs/long", *pods}
    assert not any(file.exists() for file in left)
    os.truncate(runs / "rolls" / "results.h5", 10_000)
    assert made_again(study, done) == {"runs/rolls", *pods}  # a run takes its PODs with it
    (done / "paper.json").unlink()  # nothing says of which case the runs are
    assert made_again(study, done) == {"runs/long", "runs/rolls", "runs/blows-up", *pods}


def test_another_plan_is_another_case(study, done, tmp_path):
    plan = small_study(tmp_path)
    file = plan / "study.toml"
    file.write_text(file.read_text().replace("snapshots=41", "snapshots=31"))
    pods = {f"runs/rolls/pod/{name}-rotating" for name in ("velocity", "contact")}
    assert made_again(plan, done) == {"runs/rolls", *pods}
    small = plan / "small.toml"
    small.write_text(small.read_text().replace("density = 1100.0", "density = 1000.0"))
    assert len(made_again(plan, done)) == 5
    assert len(made_again(study, done)) == 5


def test_wrong_figures_are_told(study, done):
    path = done / "runs" / "rolls" / "history.csv"
    text = path.read_text()
    header, *rows = [line.split(",") for line in text.splitlines()]
    place = header.index("force_y")
    for row in rows:
        row[place] = repr(1e-3 * float(row[place]))
    path.write_text("".join(",".join(row) + "\n" for row in [header, *rows]))
    again = paper("--study", study, "-o", done)
    assert again.returncode == 3, again.stderr
    assert "NOT  mean vertical force" in again.stdout
    assert "1 of 2 rows of the table are not as expected" in again.stderr
    found = record(done)
    assert (found["status"], found["failed"], table(done)["force"]["pass"]) == ("failed", 1, False)
    path.write_text(text.replace("force_y", "force_z", 1))
    again = paper("--study", study, "-o", done)
    assert again.returncode == 4 and "force_y" in again.stderr
    assert (record(done)["status"], record(done)["table"]) == ("failed", [])
    assert "force_y" in record(done)["message"]
    path.write_text(text)


def test_a_part_that_fails_is_named_and_the_others_are_done(study, done):
    results = done / "runs" / "rolls" / "results.h5"
    results.unlink()
    (results / "in-the-way").mkdir(parents=True)
    (done / "runs" / "long" / "run.json").unlink()
    again = paper("--study", study, "-o", done)
    assert again.returncode == 4, again.stderr
    assert "rolls" in again.stderr.splitlines()[-1]
    assert "the same command goes on" in again.stderr
    status = {part["directory"]: part["status"] for part in parts(done)}
    assert status["runs/rolls"] == status["runs/rolls/pod/contact-rotating"] == "failed"
    assert status["runs/long"] == "done"
    (results / "in-the-way").rmdir()
    results.rmdir()
    assert made_again(study, done) >= {"runs/rolls"}


@pytest.mark.parametrize("file, content, code, words", [
    ("run.json", "{}", 2, ["holds a run", "choose another -o"]),
    ("runs/mine/x", "", 2, ["runs/mine"]),
    ("paper.json", '{"format": "rondo paper 1", "quick": false}', 2,
     ["holds the study in full", "--overwrite"]),
    ("paper.json", '{"format": "rondo paper 2", "quick": true}', 2, ['"rondo paper 2"']),
    ("paper.json", "{", 4, ["--overwrite"]),
])
def test_refuses(tmp_path, study, file, content, code, words):
    (tmp_path / file).parent.mkdir(parents=True, exist_ok=True)
    (tmp_path / file).write_text(content)
    found = paper("--quick", "--study", study, "-o", tmp_path)
    assert found.returncode == code and found.stdout == "", found.stderr
    assert all(word in found.stderr for word in words), found.stderr
    assert (tmp_path / file).read_text() == content


def test_refuses_before_it_begins(tmp_path, study):
    (tmp_path / "file").write_text("")
    assert "not a directory" in paper("--study", study, "-o", tmp_path / "file").stderr
    assert "--jobs" in paper("--jobs", 0).stderr
    none = paper("--study", tmp_path, "-o", tmp_path / "new")
    assert none.returncode == 2 and "study.toml" in none.stderr
    lost = paper("--study", study, "-o", tmp_path / "new", env={**os.environ, "RONDO": "/none"})
    assert lost.returncode == 2 and "RONDO=" in lost.stderr
    assert not (tmp_path / "new").exists()


def test_progress():
    job = Job("turn-smooth", [], status="done", wall_s=1.44)
    assert ended_line(3, 35, job) == " 3 of 35  turn-smooth: done in 1.4 s"
    failed = Job("pod", [], status="failed", message="one\ntwo")
    assert ended_line(12, 35, failed) == "12 of 35  pod: failed: one\n    two"
    assert [readable_time(s) for s in (42, 200, 3900)] == ["42 s", "3 min 20 s", "1 h 05 min"]
    assert bar_line(7, 35, 9.0, [job], 80) == f"[####{'':16}] 7 of 35  9 s  turn-smooth"
    assert len(bar_line(7, 35, 9.0, [job], 20)) == 19

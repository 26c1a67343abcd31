# SPDX-License-Identifier: BSD-3-Clause
"""python3 -m rondo, from outside."""
import json
import os
import re
import shutil
import subprocess
import sys

import pytest
from program import PROGRAM, run

import rondo
from rondo import __main__, style
from rondo.figures.run_figures import draw_run


def rondo_module(*arguments, **options):
    return subprocess.run([sys.executable, "-m", "rondo", *map(str, arguments)], text=True,
                          capture_output=True, timeout=120, **options)


def test_figures_of_a_run(smooth, tmp_path):
    done = rondo_module("figures", smooth, "-o", tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    printed = done.stdout.splitlines()
    names = {path.name for path in tmp_path.iterdir()}
    assert [tmp_path / name for name in sorted(names)] == sorted(tmp_path / p for p in printed)
    stems = {"field-displacement", "field-von_mises", "energy", "forces", "force-spectrum",
             "contact", "contact-map", "pod-spectrum", "modes-velocity-rectified", "modes-displacement-rotating",
             "modes-contact-rotating"}
    assert names == {stem + ending for stem in stems for ending in (".png", ".svg")}
    for path in tmp_path.glob("*.png"):
        assert path.read_bytes().startswith(b"\x89PNG")
        assert path.stat().st_size < 400e3


@pytest.mark.long
def test_figures_go_into_the_directory(air, tmp_path):
    run = shutil.copytree(air, tmp_path / "air")
    text = (run / "run.json").read_text()
    (run / "run.json").write_text(text.replace('"done"', '"interrupted"'))
    assert rondo_module("figures", run).returncode == 2
    done = rondo_module("figures", run, "--unfinished")
    assert (done.returncode, done.stderr) == (0, "")
    assert sorted(path.stem for path in (run / "figures").glob("*.svg")) == [
        "energy", "field-displacement", "field-von_mises"]


def test_figures_of_a_crush(crush, tmp_path, monkeypatch):
    drawn = []

    def keep(figure, path):
        drawn.append(path.name)
        assert all(ax.get_xlabel() for ax in figure.axes if ax.get_title())
        return [path]

    monkeypatch.setattr(style, "save", keep)
    draw_run(rondo.open(crush), tmp_path)
    assert drawn == ["field-displacement", "field-von_mises", "contact", "contact-map", "energy",
                     "forces"]


def test_film(smooth, tmp_path):
    done = rondo_module("animate", smooth, tmp_path / "a.gif", "--quantity", "velocity", "--frames",
                        3, "--from", 0.01)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == f"{tmp_path / 'a.gif'}\n"
    assert (tmp_path / "a.gif").read_bytes().startswith(b"GIF8")


def test_means(smooth, treaded):
    done = rondo_module("means", "--from", 0.01, "--to", 0.015, smooth, treaded)
    assert (done.returncode, done.stderr) == (0, "")
    for directory, line in zip((smooth, treaded), done.stdout.splitlines()):
        history = rondo.open(directory).history
        force_x, force_y = (history.mean(name, 0.01, 0.015) for name in ("force_x", "force_y"))
        assert line == f"{directory}: force_x {force_x:.5g} N/m, force_y {force_y:.6g} N/m"
    assert len(done.stdout.splitlines()) == 2
    assert rondo_module("means", smooth).stdout != done.stdout.splitlines()[0] + "\n"


def test_version():
    lines = rondo_module("--version").stdout.splitlines()
    assert lines[0] == f"rondo {rondo.__version__}"
    assert [line.split()[0] for line in lines[1:]] == ["package", "module", "program", "meshes", "python"]
    assert os.environ["RONDO"] in lines[3]


def test_unfinished(killed, tmp_path):
    refused = rondo_module("means", killed)
    assert refused.returncode == 2
    assert refused.stderr.endswith("(here: --unfinished)\n")
    for arguments in (("means", killed), ("animate", killed, tmp_path / "a.gif", "--frames", 2)):
        done = rondo_module(*arguments, "--unfinished")
        assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize("arguments, words", [
    (["figures", "nowhere"], "nowhere: no such directory"),
    (["animate", "SMOOTH", "a.avi"], "ends in .mp4 or .gif"),
    (["animate", "SMOOTH", "a.gif", "--quantity", "x"], "no field 'x'"),
    (["animate", "SMOOTH", "a.gif", "--from", "0.01", "--to", "0.005"], "from 0.01 to 0.005 s"),
    (["means", "SMOOTH", "--from", "7"], "no rows from 7 s"),
    (["figures", "SMOOTH/pod/velocity-rectified"], "is a POD"),
    (["animate", "SMOOTH", "new/a.gif"], "no directory new"),
    (["means", "AIR"], "no ground: the case has no [ground]"),
    (["figures", "SMOOTH", "-o", "SMOOTH/run.json"], "/run.json: File exists; choose another -o")])
def test_wrong_input_is_one_line_and_code_2(smooth, air, tmp_path, arguments, words):
    done = rondo_module(*(text.replace("SMOOTH", str(smooth)).replace("AIR", str(air))
                          for text in arguments), cwd=tmp_path)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("rondo: ") and done.stderr.count("\n") == 1
    assert words in done.stderr


@pytest.mark.parametrize("command", ["figures", "footprint", "wheel", "report", "validation"])
def test_an_empty_output_is_refused(tmp_path, command):
    done = rondo_module(command, tmp_path, "-o", "", cwd=tmp_path)
    assert (done.returncode, done.stdout) == (2, "")
    assert "-o/--output: is empty" in done.stderr
    assert not list(tmp_path.iterdir())


def test_figures_of_a_study_without_its_table(tmp_path):
    (tmp_path / "paper.json").write_text(json.dumps(
        {"format": "rondo paper 1", "status": "running", "quick": True, "table": [], "pods": [],
         "runs": [{"name": "a", "directory": "a", "status": "running"}]}))
    done = rondo_module("figures", tmp_path, "-o", tmp_path / "figures")
    assert done.returncode == 2 and "0 of 1 parts are done" in done.stderr
    assert f'"rondo paper -o {tmp_path} --quick" goes on' in done.stderr
    done = rondo_module("figures", tmp_path, "--unfinished")
    assert done.returncode == 2 and "no run 'spin-up-damped'" in done.stderr


def test_a_reader_that_has_enough(smooth):
    """As `| head` ends: without a trace."""
    reading, writing = os.pipe()
    os.close(reading)
    process = subprocess.run([sys.executable, "-m", "rondo", "means", str(smooth)], stdout=writing,
                             stderr=subprocess.PIPE, text=True, timeout=120)
    os.close(writing)
    assert (process.returncode, process.stderr) == (141, "")


def test_wrong_options_are_code_2():
    for arguments in ((), ("fly",), ("figures",), ("means", "a", "--from", "now")):
        done = rondo_module(*arguments)
        command = "rondo" if arguments[:1] in (("figures",), ("means",)) else "python3 -m rondo"
        assert done.returncode == 2 and f"usage: {command}" in done.stderr


def test_the_program_does_the_commands_with_a_python_that_can(smooth, tmp_path):
    """Whichever is first on the path; and the program that was called is the one that they call."""
    bad = tmp_path / "python3"
    bad.write_text("#!/bin/sh\nexit 1\n")
    bad.chmod(0o755)
    (tmp_path / "numpy.py").write_text("raise SystemExit('not this one')\n")  # where it is called
    there = {"PATH": f"{tmp_path}:/usr/bin:/bin", "RONDO": "/none"}
    done = subprocess.run([PROGRAM, "means", "--from", "0.01", str(smooth)], env=there, cwd=tmp_path,
                          capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == rondo_module("means", "--from", 0.01, smooth).stdout
    assert run("figures", "nowhere").returncode == 2 and run("figures").returncode == 2
    done = subprocess.run([PROGRAM, "means", str(smooth)], env={"RONDO_PYTHON": str(bad)}, capture_output=True, text=True)
    assert done.returncode == 4 and done.stderr.count("\n") == 1 and "setup.sh" in done.stderr


def test_the_program_names_each_command_with_its_meaning():
    told = run("--help").stdout.split("Subcommands:")[1]
    meanings = dict(re.findall(r"^  (\w+) +(\S.*)$", told, re.MULTILINE))
    parsers = __main__._parser()._subparsers._group_actions[0].choices
    assert set(parsers) <= set(meanings)
    for name, parser in parsers.items():
        if name not in ("sweep", "report"):  # the program's own
            assert meanings[name] == parser.description, name
            assert run(name, "--help").stdout == parser.format_help(), name


def test_a_python_without_what_it_needs_is_one_line(tmp_path):
    """-S: without the packages of the system."""
    for arguments in (["-m", "rondo", "means", "x"], ["-m", "rondo.figures.bars", "x"]):
        done = subprocess.run(["/usr/bin/python3", "-S", *arguments], capture_output=True, text=True, timeout=60)
        assert (done.returncode, done.stdout) == (4, "")
        assert done.stderr.startswith("rondo: /usr/bin/python3") and done.stderr.count("\n") == 1
        assert "without numpy, h5py" in done.stderr and "scripts/setup.sh" in done.stderr
    script = subprocess.run(["/usr/bin/python3", "-S", "-c", "import rondo"], capture_output=True, text=True)
    assert script.stderr.splitlines()[-1].startswith("ImportError: /usr/bin/python3")


def test_a_python_without_matplotlib_is_one_line(smooth, monkeypatch, capsys):
    monkeypatch.setattr(__main__, "missing", lambda *modules: f"without {modules}")
    assert __main__.main(["figures", str(smooth)]) == 4
    assert capsys.readouterr().err == "rondo: without ('matplotlib',)\n"
    assert __main__.main(["means", str(smooth)]) == 0  # needs none


def test_figures_of_a_sweep_alone_take_its_options(smooth):
    done = rondo_module("figures", smooth, "--map", "a", "b")
    assert done.returncode == 2 and "holds no sweep" in done.stderr

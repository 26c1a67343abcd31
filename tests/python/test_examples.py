# SPDX-License-Identifier: BSD-3-Clause
"""The scripts in examples/: each runs as its head says, and what it says comes out."""
import ast
import csv
import importlib.util
import json
import pathlib
import re
import subprocess
import sys

import numpy as np
import pytest
from conftest import ok

import rondo

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = sorted((ROOT / "examples").glob("*.py"))
TOUR = ROOT / "examples" / "tour.py"


def made(name, folder):
    """The table that an example writes: a dict for each row; and what it says."""
    done = subprocess.run([sys.executable, ROOT / "examples" / f"{name}.py", folder / "out"],
                          capture_output=True, text=True, cwd=folder)
    assert (done.returncode, done.stderr) == (0, ""), done.stderr
    tables = list((folder / "out").glob("*.csv"))
    assert len(tables) == 1
    assert {path.suffix for path in (folder / "out").iterdir()} == {".csv", ".png", ".svg"}
    assert sorted(path.name for path in folder.iterdir()) == ["out"]
    with open(tables[0], newline="") as file:
        rows = [{key: value if key == "brake" else float(value) for key, value in row.items()}
                for row in csv.DictReader(file)]
    return rows, done.stdout


def module_of(name, monkeypatch):
    monkeypatch.syspath_prepend(ROOT / "examples")
    spec = importlib.util.spec_from_file_location(name, ROOT / "examples" / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_a_reader_finds_them_short(path):
    text = path.read_text()
    assert len(text.splitlines()) < (100 if path == TOUR else 81)
    guide = (ROOT / "docs" / "python.md").read_text()
    assert f"examples/{path.name}" in guide
    if path != TOUR:
        assert f"python3 examples/{path.name} results/" in ast.get_docstring(ast.parse(text))


def test_the_anti_lock_brake_stops_as_soon_and_spares_the_tread(tmp_path):
    (locked, anti_lock), _ = made("abs_controller", tmp_path)
    assert (locked["brake"], anti_lock["brake"]) == ("locked", "anti-lock")
    assert locked["deceleration_m_s2"] < 0.6 * 9.81  # while the brake grows it is less
    assert anti_lock["deceleration_m_s2"] > 0.98 * locked["deceleration_m_s2"]
    assert anti_lock["distance_m"] < 1.02 * locked["distance_m"]
    assert anti_lock["into_ground_j_m"] < 0.2 * locked["into_ground_j_m"]


def test_the_controller_keeps_the_slip(monkeypatch):
    """Down to 2 m/s; below, a millisecond is long for it."""
    example = module_of("abs_controller", monkeypatch)
    with rondo.Simulation(example.CASES / "wheel-abs.toml", example.CAR) as simulation:
        rows = example.braked(simulation, example.anti_lock, 4.0e4, settled=0.25, slowest=5.0)
    kept = rows["slip"][rows["time_s"] > rows["time_s"][0] + 0.15]
    assert 0.07 < kept.min() < 0.11 and 0.13 < kept.max() < 0.16, (kept.min(), kept.max())
    late = rows["time_s"] > rows["time_s"][0] + 0.15
    friction = -rows["force_x"][late].mean() / rows["force_y"][late].mean()
    assert 0.985 * 0.6 < friction < 0.6


def test_the_controller_lets_go_on_ice(monkeypatch):
    """The friction jumps from 0.6 to 0.12 at 0.15 s and back at 0.25 s, which nothing tells it."""
    example = module_of("abs_controller", monkeypatch)
    slips = {}
    for controller in (example.locking, example.anti_lock):
        with rondo.Simulation(example.CASES / "wheel-mu-jump.toml", {"rim.brake": 0.0}) as simulation:
            rows = example.braked(simulation, controller, 3.0e4, settled=0.08)
        ice = (rows["time_s"] > 0.17) & (rows["time_s"] < 0.24)
        assert rows["force_x"][ice].mean() == pytest.approx(-0.12 * rows["force_y"][ice].mean(), rel=2e-3)
        slips[controller.__name__] = rows["slip"][ice].mean(), rows["slip"][rows["time_s"] > 0.3].max()
    assert min(slips["locking"]) > 0.99
    assert slips["anti_lock"][0] < 0.2 and slips["anti_lock"][1] < 0.15


def test_a_locked_wheel_has_no_side_force(tmp_path):
    (locked, anti_lock), _ = made("abs_corner", tmp_path)
    assert locked["slip"] == 1.0
    along = 0.6 * locked["force_y_n"]  # all of the friction, against the way the wheel goes
    assert locked["force_lateral_n"] == pytest.approx(-along * np.sin(0.0349), rel=1e-3)
    assert anti_lock["force_x_n"] < 0.94 * locked["force_x_n"] < 0.0
    assert anti_lock["force_lateral_n"] < 5.0 * locked["force_lateral_n"]


def test_the_tread_found_has_less_ripple(tmp_path, monkeypatch):
    rows, said = made("tread_ripple", tmp_path)
    example = module_of("tread_ripple", monkeypatch)
    ripples = {(row["pitches"], row["groove_columns"], row["depth_m"]): row["ripple"] for row in rows}
    assert len(ripples) == 13 and min(ripples.values()) < 0.4 * ripples[example.START]
    best = min(ripples, key=ripples.get)
    assert f"least: {best[0]:.0f} pitches, grooves of {best[1]:.0f} columns, {1e3 * best[2]:g} mm" in said
    case = {"disk.tread.pitches": int(best[0]), "disk.tread.groove_columns": int(best[1]),
            "disk.tread.land_columns": 180 // int(best[0]) - int(best[1]), "disk.tread.depth": best[2],
            "disk.mesh.radial": 8, "analysis.load": 1.5e5, "analysis.torque": 0.0,
            "analysis.samples_per_sector": 4 * 180 // int(best[0])}
    run = rondo.run(example.CASE, tmp_path / "best", case)
    assert example.ripple(run.history["force_y"]) == ripples[best]  # of the files, to the bit


def test_the_traction_curve_is_that_of_the_program(tmp_path):
    rows, _ = made("traction_curve", tmp_path)
    study = ROOT / "cases" / "studies" / "steady-traction.toml"
    ok("sweep", study, "-o", tmp_path / "sweep")
    sweep = rondo.open_sweep(tmp_path / "sweep").select({"analysis.load": 1.5e5, "ground.friction": 0.4})
    assert len(sweep) == 25
    for name in ("slip_ratio", "force_x"):
        assert [row[name] for row in rows] == list(sweep[name])
    run = rondo.run(ROOT / "cases" / "steady-rolling.toml", tmp_path / "run",
                    {"motion.speed": 9.2, "analysis.load": 1.5e5, "ground.friction": 0.4})
    assert run.steady["force_x"] == rows[0]["force_x"]


def test_the_tour_runs(tmp_path):
    done = subprocess.run([sys.executable, TOUR], capture_output=True, text=True, cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, ""), done.stderr
    spins = [float(spin) for spin in re.findall(r"spin ([\d.]+) rad/s", done.stdout)]
    assert spins[-1] == pytest.approx(33.007, abs=0.02)  # cases/wheel-braked.toml
    assert "writeable: False" in done.stdout


def cells_of(text):
    """Cells of the percent format: (is markdown, source)."""
    cells = []
    for part in re.split(r"^# %%", text, flags=re.MULTILINE)[1:]:
        head, _, body = part.partition("\n")
        markdown = "[markdown]" in head
        if markdown:
            body = "\n".join(line.removeprefix("#").removeprefix(" ") for line in body.splitlines())
        cells.append((markdown, body.strip()))
    return cells


def test_the_tour_as_a_notebook(tmp_path, monkeypatch):
    """Its pictures are in line."""
    nbclient = pytest.importorskip("nbclient", reason="no nbclient (python3-nbclient): the notebook "
                                                      "was run as a script alone")
    nbformat = pytest.importorskip("nbformat")
    pytest.importorskip("ipykernel")
    monkeypatch.delenv("MPLBACKEND", raising=False)  # a notebook has its own
    v4 = nbformat.v4
    book = v4.new_notebook(cells=[(v4.new_markdown_cell if markdown else v4.new_code_cell)(body)
                                  for markdown, body in cells_of(TOUR.read_text())])
    nbclient.NotebookClient(book, timeout=120, kernel_name="python3",
                            resources={"metadata": {"path": str(tmp_path)}}).execute()
    assert json.dumps(book).count('"image/png":') == 5


def test_the_cells_of_the_tour():
    cells = cells_of(TOUR.read_text())
    assert sum(markdown for markdown, _ in cells) >= 6
    assert [body for _, body in cells if not body] == []
    compile("\n".join(body for markdown, body in cells if not markdown), "tour", "exec")

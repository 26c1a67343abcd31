# SPDX-License-Identifier: BSD-3-Clause
"""rondo rig: a small wheel through all tests; resumed, refused, with points that fail."""
import json
import pathlib
import shutil
import signal
import subprocess
import sys
import time
import zipfile

import numpy as np
import pytest
from rig_wheels import RIG, WHEEL, failing, files, rig

import rondo
from rondo import files as exchanged
from rondo.rig.findings import doubt_of, find
from rondo.rig.settings import read_settings, settings_text
from rondo.rig.time_tests import cleat_ramp, road_profile

FEW = "vertical,footprint,rolling-resistance"


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    folder = tmp_path_factory.mktemp("rig")
    case, settings = files(folder)
    said = rig(case, "--rig", settings, "--quick", "-o", folder / "done").stderr
    assert "15 of 15" in said and "left" in said
    return folder / "done"


def columns(found, test, *names, **wanted):
    table = found.tests[test].table
    rows = np.logical_and.reduce([np.isclose(table[name], value) for name, value in wanted.items()])
    return [table[name][rows] for name in names]


def test_all_tests_are_done(done):
    found = rondo.open_rig(done)
    assert [test.info["status"] for test in found.tests.values()] == ["finished"] * 10
    assert all((test.table["status"] == "done").all() for test in found.tests.values())
    for name in ("report.html", "tyre.tir", "lateral.tdx", "figures/vertical.png", "runs/vertical/study.toml"):
        assert (done / name).is_file(), name
    page = (done / "report.html").read_text()
    assert "deflection (m)" in page and "speeds: 12, 20 m/s; height: 0.006 m" in page


def test_signs_and_trends(done):
    found = rondo.open_rig(done)
    force, moment = columns(found, "lateral", "Fy", "Mz", slip_angle=np.radians(2.0), camber=0.0)
    assert (force < 0).all() and (moment > 0).all()  # ISO 8855: it moves to the left, and is pushed to the right
    drive, = columns(found, "longitudinal", "Fx", slip_ratio=0.03, load=4000.0)
    brake, = columns(found, "longitudinal", "Fx", slip_ratio=-0.03, load=4000.0)
    assert drive[0] > 0 > brake[0]
    asked = [-0.1, -0.03, -0.01, 0.01, 0.03, 0.1]
    assert found.tests["longitudinal"].table["slip_ratio"][:6] == pytest.approx(asked)
    merits = found.figures["lateral"]
    stiffness = [one["value"] for one in merits["cornering_stiffness"]]
    trail = [one["value"] for one in merits["pneumatic_trail"]]
    assert np.all(np.diff(stiffness) > 0) and np.diff(stiffness, 2)[0] < 0.5 * stiffness[0]
    assert np.all(np.diff(trail) > 0)


def test_friction_is_felt(done, tmp_path):
    case, settings = files(tmp_path, settings=RIG.replace("schema = 1", "schema = 1\nfriction = 0.5"))
    rig(case, "--rig", settings, "--quick", "--tests", "lateral", "-o", tmp_path / "slippery")
    force = [columns(rondo.open_rig(folder), "lateral", "Fy", slip_angle=np.radians(6.0), load=2000.0, camber=0.0)[0][0]
             for folder in (done, tmp_path / "slippery")]
    assert 0.5 / 0.8 < force[1] / force[0] < 0.75  # nearly all of the contact slides


def test_slopes_are_those_of_the_points(done):
    """Cornering stiffness is the solver's slope, slip stiffness a difference."""
    found = rondo.open_rig(done)
    for one in found.figures["lateral"]["cornering_stiffness"]:
        left, = columns(found, "lateral", "Fy", slip_angle=np.radians(-0.5), load=one["load"], camber=0.0)
        right, = columns(found, "lateral", "Fy", slip_angle=np.radians(0.5), load=one["load"], camber=0.0)
        assert one["value"] == pytest.approx((left - right)[0] / np.radians(1.0), rel=0.05)


def test_tydex_has_the_points(done):
    tydex, table = exchanged.read_tydex(done / "lateral.tdx"), rondo.open_rig(done).tests["lateral"].table
    assert tydex["FYW"] == pytest.approx(table["Fy"], rel=1e-5, abs=1e-3)
    assert tydex["SLIPANGL"] == pytest.approx(table["slip_angle"], abs=1e-6)


def test_the_same_command_keeps_all(done):
    before = {path: path.stat().st_mtime_ns for path in (done / "runs").rglob("*.csv")}
    again = rig(done.parent / "wheel.toml", "--rig", done.parent / "rig.toml", "--quick", "--tests", FEW, "-o", done)
    assert "1 of 1 parts are there already" in again.stderr
    assert {path: path.stat().st_mtime_ns for path in (done / "runs").rglob("*.csv")
            if path.parts[-3] != "reference"} == {path: when for path, when in before.items() if path.parts[-3] != "reference"}


def test_killed_and_resumed(done, tmp_path):
    case, settings = files(tmp_path)
    command = [sys.executable, "-m", "rondo", "rig", str(case), "--rig", str(settings), "--quick", "--tests", FEW, "-o",
               str(tmp_path / "killed"), "--jobs", "1"]
    running = subprocess.Popen(command, stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    kept = tmp_path / "killed" / "footprint.csv"
    deadline = time.monotonic() + 60
    while not (kept.exists() and len(kept.read_text().splitlines()) > 1):
        assert time.monotonic() < deadline and running.poll() is None
        time.sleep(0.01)
    running.send_signal(signal.SIGKILL)
    running.wait()
    assert rondo.open_rig(tmp_path / "killed").tests["footprint"].info["status"] in ("running", "unfinished", "finished")
    assert "already and kept" in rig(*command[4:]).stderr
    for test in FEW.split(","):
        assert (tmp_path / "killed" / f"{test}.csv").read_bytes() == (done / f"{test}.csv").read_bytes(), test


def test_other_tests_stay(tmp_path):
    case, settings = files(tmp_path)
    for tests in ("rolling-resistance", "footprint"):
        rig(case, "--rig", settings, "--quick", "--tests", tests, "-o", tmp_path / "rig")
    found = rondo.open_rig(tmp_path / "rig")
    assert [test.info["status"] for test in found.tests.values()] == ["finished"] * 3


def test_results_that_are_gone_are_made_again(done, tmp_path):
    shutil.copytree(done.parent, tmp_path / "copy")
    shutil.rmtree(tmp_path / "copy" / "done" / "runs" / "footprint-2000N-camber0deg" / "results")
    shutil.rmtree(tmp_path / "copy" / "done" / "runs" / "reference")
    again = rig(tmp_path / "copy" / "wheel.toml", "--rig", tmp_path / "copy" / "rig.toml", "--quick", "--tests", "footprint",
                "-o", tmp_path / "copy" / "done").stderr
    assert "1 of 1  footprint-2000N" in again


def test_interrupted(tmp_path, monkeypatch):
    """In the middle of the test `lateral`, which takes long here."""
    case, settings = files(tmp_path)
    monkeypatch.setenv("RONDO", failing(tmp_path, "runs/lateral", "exec sleep 60"))
    command = [sys.executable, "-m", "rondo", "rig", str(case), "--rig", str(settings), "--tests", "lateral,longitudinal", "-o",
               str(tmp_path / "rig"), "--jobs", "1"]
    running = subprocess.Popen(command, stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    deadline = time.monotonic() + 60
    while not (tmp_path / "rig" / "vertical.csv").exists():
        assert time.monotonic() < deadline and running.poll() is None
        time.sleep(0.01)
    running.send_signal(signal.SIGINT)
    said = running.communicate()[1]
    assert running.returncode == 130 and "the same command goes on" in said
    assert rondo.open_rig(tmp_path / "rig").tests["lateral"].info["status"] == "unfinished"
    assert all(test.info.get("failed", 0) == 0 for test in rondo.open_rig(tmp_path / "rig").tests.values())


def test_loads_of_other_tests_are_those_of_vertical(tmp_path):
    text = "schema = 1\nloads = [3000.0]\n[vertical]\nloads = [1000.0]\n[longitudinal]\nloads = [7000.0]\n"
    case, settings = files(tmp_path, settings=text)
    rig(case, "--rig", settings, "--quick", "--tests", "longitudinal", "-o", tmp_path / "rig")
    found = rondo.open_rig(tmp_path / "rig")
    assert list(found.tests["vertical"].table["load"]) == [1000.0, 3000.0, 4000.0, 7000.0]
    small = found.tests["longitudinal"].table
    near = np.abs(small["slip_ratio"]) < 0.02
    assert abs(small["Fx"][near].sum()) < 0.05 * np.abs(small["Fx"][near]).max()  # as far from free rolling to both sides


def test_a_tyre_with_air_and_cords(tmp_path):
    """Ply steer changes its side with the cords; a symmetrical tyre has no conicity; air stiffens it."""
    case = pathlib.Path(__file__).parents[2] / "cases" / "tyre-cornering.toml"
    (tmp_path / "rig.toml").write_text("schema = 1\nsectors = 24\nload = 3000.0\nloads = [3000.0]\n[vertical]\nloads = [2000.0]\n"
                                       "[lateral]\nslip_angles_deg = [0.0]\nfew_slip_angles_deg = [0.0]\n")
    rig(case, "--rig", tmp_path / "rig.toml", "--quick", "--tests", "lateral", "-o", tmp_path / "rig")
    found = rondo.open_rig(tmp_path / "rig")
    merits = found.figures["lateral"]
    ply_steer, conicity = merits["ply_steer_force"][0]["value"], merits["conicity_force"][0]["value"]
    force, = columns(found, "lateral", "Fy", slip_angle=0.0, camber=0.0, pressure=2.2e5)
    assert ply_steer == pytest.approx(force[0]) and ply_steer > 30.0 and abs(conicity) < 1e-3
    low, high = (one["value"] for one in found.figures["vertical"]["radial_stiffness"] if one["load"] == 3000.0)
    assert low < high


def statuses(found, test):
    """(points that are done, reasons of the others)"""
    table = found.tests[test].table
    return int((table["status"] == "done").sum()), [str(one) for one in table["reason"][table["status"] != "done"]]


def test_a_run_that_fails_is_a_row_of_its_test(done, tmp_path, monkeypatch):
    """Of every test one run fails, or the state that it begins with; what ran stays."""
    shutil.copytree(done.parent, tmp_path / "copy")
    names = ("state-20mps", "footprint-2000N-camber0deg", "lateral-camber3deg", "combined-4000N", "rolling-resistance-24mps",
             "relaxation-slip-angle-4000N", "modes-standing", "road-12mps")
    for name in names:
        shutil.rmtree(tmp_path / "copy" / "done" / "runs" / name)
    monkeypatch.setenv("RONDO", failing(tmp_path, f"runs/({'|'.join(names)}|fmu)/"))
    said = rig(tmp_path / "copy" / "wheel.toml", "--rig", tmp_path / "copy" / "rig.toml", "--quick", "--fmu",
               "-o", tmp_path / "copy" / "done", code=3).stderr
    found, why = rondo.open_rig(tmp_path / "copy" / "done"), "made to fail"
    assert statuses(found, "cleat") == (1, ["this point begins with the height and the effective radius of free rolling at 20 m/s, "
                                            "which failed: made to fail"])
    assert [statuses(found, test) for test in ("vertical", "footprint", "longitudinal", "lateral", "combined", "rolling-resistance",
                                               "relaxation", "road")] == \
        [(4, []), (1, [why]), (18, []), (21, [why] * 9), (0, [why] * 4), (3, [why]), (1, [why]), (0, [why])]
    assert statuses(found, "modes")[1] == [why] and "lateral: 9 of 30 points failed" in said and "tyre.fmu: failed: made to fail" in said
    assert [name for name, test in found.tests.items() if test.info["status"] == "failed"] == ["combined", "road"]
    page = (found.directory / "report.html").read_text()
    assert "All points of these tests failed: combined, road" in page and "point 2 (4 kN, 72 km/h): this point begins" in page
    assert "9 of 30 points failed and are left out: lateral.csv says why" in (found.directory / "lateral.tdx").read_text()
    assert "not in this file: lateral 9, combined 4, rolling-resistance 1" in (found.directory / "tyre.tir").read_text()


def test_without_vertical_others_say_what_they_lack(tmp_path, monkeypatch):
    """Slip angles need none of its states; slip ratios do."""
    case, settings = files(tmp_path)
    monkeypatch.setenv("RONDO", failing(tmp_path, "runs/vertical/"))
    rig(case, "--rig", settings, "--quick", "--tests", "lateral,combined", "-o", tmp_path / "rig", code=3)
    found = rondo.open_rig(tmp_path / "rig")
    why = ("this point begins with the height and the effective radius of free rolling under 4000 N, which the test vertical does "
           "not have: made to fail")
    assert statuses(found, "combined") == (0, [why] * 4) and statuses(found, "lateral") == (30, [])
    slipping = found.tests["lateral"].table["slip_angle"] != 0
    slipping |= found.tests["lateral"].table["camber"] != 0
    assert np.isnan(found.tests["lateral"].table["slip_ratio"][slipping]).all()
    assert exchanged.read_tir(tmp_path / "rig" / "tyre.tir").number("UNLOADED_RADIUS") == pytest.approx(0.3)
    assert np.isnan(exchanged.read_tydex(tmp_path / "rig" / "lateral.tdx")["LONGSLIP"][slipping]).all()


def test_slopes_are_of_the_smallest_slips():
    """A larger slip does not take the place of one that failed."""
    rows = [{"load": 1.0, "pressure": None, "slip_ratio": slip, "Fx": 1e3 * slip, "status": "done"} for slip in (-0.03, -0.01, 0.01, 0.03)]
    assert find(None, "longitudinal", rows)["slip_stiffness"][0]["value"] == pytest.approx(1e3)
    assert find(None, "longitudinal", [*rows[:2], rows[2] | {"status": "failed"}, rows[3]]) == {}


def test_a_swing_with_the_mesh_is_told():
    row = {"status": "done", "load": 4000.0, "mean_Fz": 4010.0, "ripple_Fz": 100.0}
    assert doubt_of("cleat", [row, {"status": "failed"}]) == ""
    assert "swings by up to 8 % of the load" in doubt_of("road", [row, row | {"ripple_Fz": 330.0}])
    assert "differs from it by up to 41 %" in doubt_of("cleat", [row | {"mean_Fz": 5625.0}])


def test_a_step_that_slides_has_no_relaxation_length(tmp_path):
    case, settings = files(tmp_path, settings=f"{RIG}[relaxation]\nslip_ratio_step = 0.1\n")
    rig(case, "--rig", settings, "--quick", "--tests", "relaxation", "-o", tmp_path / "rig", code=3)
    count, reasons = statuses(rondo.open_rig(tmp_path / "rig"), "relaxation")
    assert count == 1 and reasons[0].startswith("the step of the slip ratio, 0.1, changes force_x by 101 % of what friction carries")


def test_a_point_that_fails_is_a_row(tmp_path):
    case, settings = files(tmp_path, settings=RIG + "[vertical]\nloads = [4000.0, 1.8e5]\n")
    said = rig(case, "--rig", settings, "--quick", "--tests", "vertical", "-o", tmp_path / "rig", code=3).stderr
    assert "vertical: 1 of 4 points failed" in said
    table = rondo.open_rig(tmp_path / "rig").tests["vertical"].table
    assert list(table["status"]) == ["done"] * 3 + ["failed"] and "load" in table["reason"][3]


@pytest.mark.parametrize("text, words", [('{"sources": []}', '"sources" has to be an object'), ('{"tests": {"road": 1}}', "object of objects")])
def test_a_damaged_record_is_refused(tmp_path, text, words):
    case, _ = files(tmp_path)
    (tmp_path / "rig").mkdir()
    (tmp_path / "rig" / "rig.json").write_text(text)
    assert words in rig(case, "-o", tmp_path / "rig", code=2).stderr


def test_another_tyre_is_refused(done, tmp_path):
    case, settings = files(tmp_path, WHEEL.replace("5.0e6", "6.0e6"))
    said = rig(case, "--rig", settings, "--quick", "-o", done, code=2).stderr
    assert "holds a rig of another case" in said and "--overwrite" in said


def test_measurements_are_read_first(tmp_path):
    case, settings = files(tmp_path)
    (tmp_path / "forces.csv").write_text("speed,colour\n1,2\n")
    said = rig(case, "--rig", settings, "--against", tmp_path / "forces.csv", "-o", tmp_path / "rig", code=2).stderr
    assert "forces.csv" in said and "SLIPANGL" in said
    assert not (tmp_path / "rig").exists()


def test_measurements_and_fmu(done, tmp_path):
    """Forces of the same tyre do not differ from its own."""
    case, settings = files(tmp_path)
    rig(case, "--rig", settings, "--quick", "--tests", "lateral", "--against", done / "lateral.tdx", "--fmu", "-o",
        tmp_path / "rig")
    assert zipfile.is_zipfile(tmp_path / "rig" / "tyre.fmu")
    assert "lateral.tdx" in (tmp_path / "rig" / "report.html").read_text()
    differences = json.loads((tmp_path / "rig" / "rig.json").read_text())["against"]["differences"]
    lateral = {one["channel"]: one["of_largest"] for one in differences if one["test"] == "lateral"}
    assert {"Fy", "Mz"} <= set(lateral) and max(lateral.values()) < 1e-4
    assert len((tmp_path / "rig" / "against.csv").read_text().splitlines()) == 1 + len(differences)


def test_dry_run_and_defaults(tmp_path):
    case, settings = files(tmp_path)
    plan = rig(case, "--rig", settings, "--dry-run").stdout
    assert all(name in plan for name in ("vertical", "relaxation", "road", "all")) and "points" in plan
    text = rig(case, "--rig", settings, "--write-defaults").stdout
    (tmp_path / "all.toml").write_text(text)
    found = read_settings(tmp_path / "all.toml")
    assert found["lateral"]["slip_angles_deg"] == [-6.0, -2.0, -0.5, 0.0, 0.5, 2.0, 6.0]
    assert settings_text(found, "Small wheel") == text
    assert not (tmp_path / "wheel-rig").exists()


@pytest.mark.parametrize("text, words", [
    ("load = 1\n", "schema: is missing"),
    ("schema = 1\nlaod = 1.0\n", "laod: no such key (allowed: load?"),
    ("schema = 1\n[lateral]\nslip_angles_deg = [50.0]\n", "slip_angles_deg = [50.0] (allowed: a list of numbers in degrees"),
    ("schema = 1\n[latral]\n", "[latral]: no such table (allowed: lateral?"),
    ("schema = 1\npressures = [2e5]\n", "has no [inflation]"),
    ("schema = 1\nloads = []\n", "loads = []"), ("schema = ", "cannot be read"),
    ("schema = 1\nloads = [4000.0, nan]\n", "loads = [4000.0, nan] (allowed"), ("schema = 1\nload = true\n", "load = true (allowed"),
    (f"schema = 1\nload = 1{'0' * 400}\n", "(allowed: a number in N, >= 20 and <= 1e+08)"),
    ("schema = 1\nlateral = 3\n", "lateral: is no table (allowed: [lateral], once)"),
    ("schema = 1\n[cleat]\nspeeds = [1e-9]\n", "cleat.speeds = [1e-09] (allowed: a list of numbers in m/s, >= 0.5 and <= 500"),
    ("schema = 1\n[cleat]\nheight = 0.1\nlength = 1e-3\n", "longer than the radius of the wheel"),
    ("schema = 1\nloads = [4000.0, 1e7]\n", "loads: 1e+07 N: the wheel comes down by 7.03 mm under its nominal load")])
def test_mistakes_in_a_rig_file(tmp_path, text, words):
    case, settings = files(tmp_path, settings=text)
    assert words in rig(case, "--rig", settings, "-o", tmp_path / "rig", code=2).stderr
    assert not (tmp_path / "rig" / "rig.json").exists()


@pytest.mark.parametrize("old, new, words", [
    ("load = 4000.0\n", "", "give load = 4000.0 in a rig file"),
    ("angular_velocity = 40.0\n", "", "give speed = 13.7"), ("angular_velocity = 40.0", "angular_velocity = 1e-3", ">= 0.5 and <= 500"),
    ("friction = 0.8\n", "", "give friction = 0.9"), ("load = 4000.0", "load = true", "wheel.toml:24:8: analysis.load = true: must be a float"),
    ("load = 4000.0", "load = 2.0", "analysis.load: 2 N (allowed: a number in N, >= 20"), ("[damping]", "[dampnig]", "did you mean damping?"),
    ("angular_velocity = 40.0", 'angular_velocity = [[0.0, "a"]]', 'angular_velocity = "a": must be a float'),
    ('"Small wheel"', "5", "title = 5: must be a string"), ("friction = 0.8", "friction = {}", "ground.friction.coefficient: is missing"), ("circumferential = 60\n", "", "disk.mesh.circumferential"),
    ("[material]", "[disk.tread]\n[material]", "disk.tread"),
    ("load = 4000.0\n", "load = 1.8e5\n", "the wheel does not roll under its nominal load, 180000 N at 40 rad/s: ")])
def test_mistakes_in_a_case(tmp_path, old, new, words):
    case, _ = files(tmp_path, WHEEL.replace(old, new))
    assert words in rig(case, "-o", tmp_path / "rig", code=2).stderr


@pytest.mark.parametrize("old, new", [
    ("[motion]\nangular_velocity = 40.0\n", ""), ('[ground]\nprofile = "flat"\nfriction = 0.8\n', ""), ('profile = "flat"', 'road = "no.crg"'),
    (WHEEL[WHEEL.index("[analysis]"):], ""), (WHEEL[WHEEL.index("[analysis]"):], "[time]\nend = 0.1\nstep = 1e-2\n")])
def test_a_case_need_not_run_by_itself(tmp_path, old, new):
    assert old in WHEEL
    case, settings = files(tmp_path, WHEEL.replace(old, new), "schema = 1\nspeed = 12.0\nload = 4000.0\nfriction = 0.8\n")
    rig(case, "--rig", settings, "--quick", "--dry-run", "--tests", "vertical")


def test_settings_of_tests_that_are_not_done_do_not_count(tmp_path):
    case, settings = files(tmp_path, settings="schema = 1\n[cleat]\nheight = 0.1\nlength = 1e-3\n")
    rig(case, "--rig", settings, "--quick", "--dry-run", "--tests", "vertical")


@pytest.mark.parametrize("old, new, words", [
    ("pressure = 2.2e5 ", 'pressure = "2.2e5"', "inflation.pressure = \"2.2e5\": must be a float"),
    ("pressure = 2.2e5 ", "pressure = 0.0", "inflation.pressure: 0 Pa (allowed: a number in Pa, >= 10000"),
    ("angle = 0.3839724354387525", 'angle = "22"', "cords[2].angle = \"22\": must be a float"),
    ("/tyre-205-55-r16.msh\"", "\" # ", "is a directory")])
def test_mistakes_in_the_case_of_a_tyre(tmp_path, old, new, words):
    folder = pathlib.Path(__file__).parents[2] / "cases"
    text = (folder / "tyre-cornering.toml").read_text().replace('"meshes/', f'"{folder}/meshes/')
    assert old in text
    (tmp_path / "tyre.toml").write_text(text.replace(old, new))
    assert words in rig(tmp_path / "tyre.toml", "-o", tmp_path / "rig", code=2).stderr


def test_a_case_that_is_no_text(tmp_path):
    (tmp_path / "tyre.toml").write_bytes(b"\xff\xfe")
    assert "tyre.toml:1:1: is not TOML" in rig(tmp_path / "tyre.toml", "--dry-run", code=2).stderr


def test_unknown_tests_are_refused(tmp_path):
    case, _ = files(tmp_path)
    assert "--tests: braking: no such test (allowed: vertical" in rig(case, "--tests", "braking", code=2).stderr


def test_roads_have_their_roughness():
    """rms of the displacement: the integral of G over the wave numbers."""
    points = np.array(road_profile(1.6e-5, 3, 0.0, 400.0))[1:-1]
    expected = np.sqrt(1.6e-5 * 0.1**2 * (1 / 0.05 - 1 / 5.0))
    assert points[20:, 1].std() == pytest.approx(expected, rel=0.15)
    assert json.dumps(road_profile(1.6e-5, 3, 0.0, 9.0)) == json.dumps(road_profile(1.6e-5, 3, 0.0, 9.0))


def test_ramps_leave_room_for_fillets():
    assert cleat_ramp(0.01, 0.02, 0.005) == pytest.approx(0.01)
    flat = cleat_ramp(0.01, 0.02, 0.03)
    assert flat > 0.01 and 0.03 * np.tan(0.5 * np.arctan(0.01 / flat)) <= 0.01

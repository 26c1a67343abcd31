# SPDX-License-Identifier: BSD-3-Clause
"""rondo rig of wheels in the plane: the tests they do, in newtons with a width and per metre of width without one."""
import json
import types

import matplotlib.pyplot as plt
import numpy as np
import pytest
from rig_wheels import WHEEL, files, rig

import rondo
from rondo import files as exchanged
from rondo.data.errors import InputError
from rondo.rig import figures, report
from rondo.rig.against import compare
from rondo.rig.defaults import with_defaults
from rondo.rig.findings import doubt_of
from rondo.rig.keys import PLANE, SPACE
from rondo.rig.plane import LEFT_OUT, left_out_of, slip_step
from rondo.rig.plane.damping import with_damping_below
from rondo.rig.settings import read_settings
from rondo.rig.tyre import read_tyre

WIDTH, LOAD = 0.1, 4000.0  # m, N
# Without lateral contraction a wheel with a width is the plane one, times the width.
PLANE_WHEEL = (WHEEL.replace("width = 0.10\n", "").replace("circumferential = 60\naxial = 4", "circumferential = 90")
               .replace("poissons_ratio = 0.3", "poissons_ratio = 0.0").replace("load = 4000.0", "load = 4.0e4")
               .replace("samples_per_sector = 2\n", ""))
SPACE_WHEEL = PLANE_WHEEL.replace("inner_radius = 0.20", f"inner_radius = 0.20\nwidth = {WIDTH}").replace(
    "radial = 2", "radial = 2\naxial = 1").replace("load = 4.0e4", f"load = {LOAD}\nsamples_per_sector = 4")
RIG = f"schema = 1\nwidth = {WIDTH}\nloads = [2000.0, 4000.0]\n[cleat]\nmodes = 20\n[road]\nlength = 2.0\nmodes = 20\n"
SAME = "schema = 1\nsectors = 90\nsamples_per_sector = 4\nloads = [2000.0, 4000.0]\n[relaxation]\nslip_ratio_step = 0.005\n"
PER_METRE = "schema = 1\nloads = [2.0e4, 4.0e4]\n"
BOTH = "vertical,longitudinal,relaxation"


@pytest.fixture(scope="module")
def with_width(tmp_path_factory):
    """All tests."""
    case, settings = files(tmp_path_factory.mktemp("plane"), PLANE_WHEEL, RIG)
    assert "points failed" not in rig(case, "--rig", settings, "--quick", "-o", case.parent / "rig").stderr
    return rondo.open_rig(case.parent / "rig")


@pytest.fixture(scope="module")
def per_metre(tmp_path_factory):
    case, settings = files(tmp_path_factory.mktemp("per-metre"), PLANE_WHEEL, PER_METRE)
    said = rig(case, "--rig", settings, "--quick", "--tests", "vertical,longitudinal", "-o", case.parent / "rig").stderr
    assert "no tyre.tir" in said and "per metre of width: give its width in the rig file" in said
    return rondo.open_rig(case.parent / "rig")


def columns(found, test, *names):
    return [found.tests[test].table[name] for name in names]


def test_all_tests_that_make_sense_are_done(with_width):
    statuses = {name: test.info["status"] for name, test in with_width.tests.items()}
    assert {name for name, status in statuses.items() if status == "left out"} == {"lateral", "combined"} == set(LEFT_OUT)
    assert set(statuses.values()) == {"left out", "finished"} and len(statuses) == 10
    for name in ("report.html", "tyre.tir", "longitudinal.tdx", "figures/footprint.png", "runs/vertical/study.toml"):
        assert (with_width.directory / name).is_file(), name
    assert not (with_width.directory / "lateral.csv").exists()


def test_the_page_says_what_its_forces_are(with_width, per_metre):
    page = (with_width.directory / "report.html").read_text()
    assert "plane strain, times a width of 0.1 m" in page and "a plane wheel has no slip angle" in page
    page = (per_metre.directory / "report.html").read_text()
    assert "forces and moments are per metre of width" in page and "TYDEX files and tyre.tir are not written" in page
    assert "kN/m" in page and "N/mm per m" in page and "Trends of tyres" not in page and "None" not in page


def test_forces_are_those_of_the_width(with_width, per_metre):
    newtons, metres = ((*columns(with_width, "longitudinal", "load", "Fx", "Fz", "My"),
                        *columns(with_width, "longitudinal", "height", "slip_ratio")),
                       (*columns(per_metre, "longitudinal", "load_per_m", "Fx_per_m", "Fz_per_m", "My_per_m"),
                        *columns(per_metre, "longitudinal", "height", "slip_ratio")))
    for mine, theirs, factor in zip(newtons, metres, (WIDTH,) * 4 + (1.0, 1.0)):
        assert mine == pytest.approx(factor * theirs, rel=1e-9)
    stiffness = [found.figures["vertical"]["radial_stiffness"][0]["value"] for found in (with_width, per_metre)]
    assert stiffness[0] == pytest.approx(WIDTH * stiffness[1], rel=1e-9)


def test_units_are_told(with_width, per_metre):
    assert with_width.width == WIDTH and not with_width.per_metre and with_width.plane == "strain"
    assert per_metre.per_metre and "Fx" not in per_metre.tests["longitudinal"].table
    units = [json.loads((found.directory / "rig.json").read_text())["units"] for found in (with_width, per_metre)]
    assert units[0]["columns"]["Fx"] == "N" and units[0]["figures"]["radial_stiffness"] == "N/m"
    assert units[1]["columns"]["Fx_per_m"] == "N/m" and units[1]["columns"]["My_per_m"] == "N m/m"
    assert units[1]["figures"] == {"radial_stiffness": "N/m per m", "effective_radius": "m", "slip_stiffness": "N/m"}
    drawn = {one.name: [ax.get_ylabel() for ax in one.figure.axes] for one in figures.figures_of(per_metre)}
    plt.close("all")
    assert "(kN/m)" in drawn["longitudinal-load"][0] and "(N/mm per m)" in drawn["vertical"][1]
    assert not list(per_metre.directory.glob("*.tdx")) and not (per_metre.directory / "tyre.tir").exists()


def test_runs_in_time_have_the_width(with_width):
    """The wheel stands at the height of its load. The figure is of the same forces."""
    for test in ("cleat", "road"):
        assert columns(with_width, test, "mean_Fz")[0] == pytest.approx(LOAD, rel=0.03)
    drawn = {one.name: one.figure for one in figures.figures_of(with_width)}
    up = drawn["cleat"].axes[1].lines[0].get_ydata()
    plt.close("all")
    assert up[:10].mean() == pytest.approx(1e-3 * LOAD, rel=0.03)


def test_a_wheel_with_a_width_is_the_same(with_width, tmp_path):
    """In three dimensions, without lateral contraction. Its step of the slip ratio is another algorithm: without steps in
    time and without vibrations."""
    case, settings = files(tmp_path, SPACE_WHEEL, SAME)
    rig(case, "--rig", settings, "--quick", "--tests", BOTH, "-o", tmp_path / "rig")
    solid = rondo.open_rig(tmp_path / "rig")
    for name, bound in (("Fx", 3e-3), ("deflection", 1e-3), ("contact_length", 2e-3), ("mean_pressure", 2e-3)):
        mine, theirs = columns(with_width, "longitudinal", name) + columns(solid, "longitudinal", name)
        assert np.abs(mine - theirs).max() < bound * np.abs(theirs).max(), name
    steps = columns(solid, "relaxation", "step")[0] == "slip-ratio"
    assert columns(with_width, "relaxation", "relaxation_length_fit")[0] == pytest.approx(
        columns(solid, "relaxation", "relaxation_length_fit")[0][steps], rel=0.1)


def test_files_have_what_a_plane_wheel_has(with_width):
    tydex = exchanged.read_tydex(with_width.directory / "longitudinal.tdx")
    assert tydex["FX"] == pytest.approx(columns(with_width, "longitudinal", "Fx")[0], rel=1e-5)
    assert not {"FYW", "MXW", "MZW"} & set(tydex.channels)
    assert "times a width of 0.1 m" in (with_width.directory / "longitudinal.tdx").read_text().replace("\n", " ")
    tir = exchanged.read_tir(with_width.directory / "tyre.tir")
    assert tir.number("USE_MODE") == 1 and tir.number("WIDTH") == WIDTH and "PCY1" not in tir
    assert tir.number("Q_RA2") != 0.0 and "Q_RB1" not in tir
    assert "no lateral force" in " ".join(line.lstrip("! ") for line in tir.comments)
    stiffness = [one["value"] for one in with_width.figures["vertical"]["radial_stiffness"] if one["load"] == LOAD]
    assert tir.number("VERTICAL_STIFFNESS") == pytest.approx(stiffness[0], rel=0.05)
    length, = columns(with_width, "relaxation", "relaxation_length_fit")[0]
    assert rondo.magic_formula.evaluate(tir, load=LOAD).slip_stiffness / tir.number("LONGITUDINAL_STIFFNESS") == pytest.approx(length)
    fx, slip, load = columns(with_width, "longitudinal", "Fx", "slip_ratio", "load")
    found = rondo.magic_formula.evaluate(tir, slip_ratio=slip, load=load)
    assert np.abs(found.Fx - fx).max() < 0.05 * np.abs(fx).max() and (found.Fy == 0).all()


@pytest.mark.parametrize("test, channels", [("longitudinal", {"Fx", "My"}), ("rolling-resistance", {"Fx", "My"})])
def test_the_rig_is_as_its_own_files(with_width, test, channels):
    found = compare(with_width, with_width.directory / f"{test}.tdx")
    assert {one.channel for one in found.differences if one.test == test} == channels and found.warnings == ()
    assert [one for one in found.differences if one.test == test and not (one.of_largest < 1e-4 and one.rows > 1)] == []


def test_a_measured_test_that_is_nowhere_compared_is_told(with_width, tmp_path):
    """Its loads are beyond those of the rig; the vertical stiffness is not."""
    (tmp_path / "forces.csv").write_text("LONGSLIP,FX,FZW,DSTGRWHC\n-0.03,-9000,40000,\n0.03,9000,40000,\n0,,4000,0.29\n")
    found = compare(with_width, tmp_path / "forces.csv")
    assert {one.test for one in found.differences} == {"vertical"}
    text, = found.warnings
    assert "longitudinal: none of its " in text and "run the rig with the loads" in text
    assert "longitudinal: none of its " in report.write(with_width, tmp_path / "report.html", found).read_text()


def test_an_fmu_that_fails_is_told_at_the_end(tmp_path):
    """There is a folder in the place of its file."""
    case, settings = files(tmp_path, PLANE_WHEEL, RIG)
    (tmp_path / "rig" / "runs" / "fmu" / "results.fmu" / "folder").mkdir(parents=True)
    said = rig(case, "--rig", settings, "--quick", "--tests", "vertical", "--fmu", "-o", tmp_path / "rig", code=3).stderr
    assert "tyre.fmu: failed: " in said and "results.fmu" in said
    told = json.loads((tmp_path / "rig" / "rig.json").read_text())["fmu"]
    assert told["status"] == "failed" and told["reason"] in (tmp_path / "rig" / "report.html").read_text()
    assert not (tmp_path / "rig" / "tyre.fmu").exists() and (tmp_path / "rig" / "figures" / "vertical.png").exists()


@pytest.mark.parametrize("arguments, words", [
    (("--tests", "lateral"), "a plane wheel has no slip angle"),
    (("--against", "forces.csv"), "measurements are in newtons, and the forces of this plane wheel are per metre of width")])
def test_what_a_plane_wheel_cannot_do(tmp_path, monkeypatch, arguments, words):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "forces.csv").write_text("LONGSLIP,FX,FZW\n-0.1,-3000,4000\n0.1,3000,4000\n")
    case, settings = files(tmp_path, PLANE_WHEEL, PER_METRE)
    assert words in rig(case, "--rig", settings, *arguments, "-o", tmp_path / "rig", code=2).stderr
    assert not (tmp_path / "rig" / "rig.json").exists()


@pytest.mark.parametrize("old, new, words", [
    ("youngs_modulus = 5.0e6\n", 'model = "neo-hooke"\nshear_modulus = 2.0e6\n', "youngs_modulus = 4e+06, 2 mu (1 + nu)"),
    ("[disk]", '[mesh]\nfile = "a.msh"\n[disk]', "rondo sweep varies load, slip and speed of runs in time"),
    ("inner_radius", 'rim = "free"\ninner_radius', 'disk.rim = "free"'),
    ("[ground]", "[load]\npressure = 1e5\n[ground]", "[load]: the rig tests a plane wheel without it"),
    ("[ground]", "[inflation]\npressure = 1e5\n[ground]", "air is of wheels in three dimensions"),
    ("circumferential = 90\n", "", "disk.mesh.circumferential: is missing"),
    ("[damping]", "[material.region]\nyoungs_modulus = 1e7\n[damping]", "material.region: is no list of tables (allowed: [[material.region]]"),
    ("[damping]", "[disk.tread]\npitches = 40\ndepth = 0.01\n[damping]", "disk.tread.land_columns, disk.tread.groove_columns: is missing"),
    ("circumferential = 90\n", 'circumferential = "90"\n', "disk.mesh.circumferential = '90' (allowed: a whole number >= 1)"),
    ("[disk.mesh]\nradial = 2\ncircumferential = 90\n", "mesh = 3\n", "disk.mesh: is no table (allowed: [disk.mesh])")])
def test_cases_that_are_refused(tmp_path, old, new, words):
    case, _ = files(tmp_path, PLANE_WHEEL.replace(old, new, 1).replace("poissons_ratio = 0.0", "poissons_ratio = 0"))
    with pytest.raises(InputError) as error:
        read_tyre(case)
    assert words in str(error.value)


def test_a_speed_of_the_rig_file_is_told(tmp_path):
    """Of a case without a spin. Slower ones are refused: cleat and road would take hours."""
    case, settings = files(tmp_path, PLANE_WHEEL.replace("[motion]\nangular_velocity = 40.0\n", ""), f"speed = 0.3\n{RIG}")
    with pytest.raises(InputError, match="speed = 0.3 .allowed: a number in m/s, >= 0.5 and <= 500"):
        with_defaults(read_tyre(case), read_settings(settings, PLANE), True, 0.3)


@pytest.mark.parametrize("wheels, text, words", [
    (PLANE, "load = 1.0\n", "load = 1.0 (allowed: a number in N/m, >= 20 and <= 1e+08)"),
    (PLANE, "width = 0.2\nload = 1.0\n", "load = 1.0 (allowed: a number in N, >= 20 and <= 1e+08)"),
    (PLANE, "width = 200\n", "width = 200 (allowed: a number in m, >= 0.001 and <= 5)"),
    (PLANE, "cambers_deg = [3.0]\n", "cambers_deg: is of wheels in three dimensions"),
    (PLANE, "[lateral]\nloads = [4000.0]\n", "[lateral]: is of wheels in three dimensions, and this one is plane"),
    (SPACE, "width = 0.2\n", "width: is of plane wheels (allowed: leave it out; this wheel has its own width"),
    (SPACE, "[relaxation]\nmass_damping = 9.0\n", "relaxation.mass_damping: is of plane wheels")])
def test_rig_files_that_are_refused(tmp_path, wheels, text, words):
    (tmp_path / "rig.toml").write_text(f"schema = 1\n{text}")
    with pytest.raises(InputError) as error:
        read_settings(tmp_path / "rig.toml", wheels)
    assert words in str(error.value)


def test_a_step_that_does_not_settle_is_a_row(tmp_path):
    case, settings = files(tmp_path, PLANE_WHEEL, RIG + "[relaxation]\ndistance = 0.2\n")
    rig(case, "--rig", settings, "--quick", "--tests", "relaxation", "-o", tmp_path / "rig", code=3)
    table = rondo.open_rig(tmp_path / "rig").tests["relaxation"].table
    assert list(table["status"]) == ["failed"] and table["reason"][0].startswith("force_x has not settled after the step: roll farther")


VISCOUS = PLANE_WHEEL.replace("[damping]", "loss_factor = 0.2\nloss_band = [1.0, 1000.0]\n[damping]")


def test_a_viscous_wheel_has_no_relaxation(tmp_path):
    """Which is no failure, and refused where it is named."""
    case, settings = files(tmp_path, VISCOUS, RIG)
    assert rig(case, "--rig", settings, "--quick", "--dry-run").stdout.count("relaxation          left out: ") == 1
    said = rig(case, "--rig", settings, "--tests", "relaxation", "-o", tmp_path / "rig", code=2).stderr
    assert "--tests: relaxation: " in said and "leave out loss_factor and viscosity" in said
    assert "relaxation" in left_out_of({"material": {"region": [{"viscosity": [[0.1, 0.01]]}]}})
    assert "relaxation" not in left_out_of({"material": {"loss_factor": 0, "region": [{"viscosity": []}]}})


def test_without_a_time_step_all_points_of_relaxation_fail(tmp_path):
    """There is a file in the place of the folder of its results."""
    case, settings = files(tmp_path, PLANE_WHEEL, RIG)
    (tmp_path / "rig" / "runs" / "time-step").mkdir(parents=True)
    (tmp_path / "rig" / "runs" / "time-step" / "results").write_text("")
    said = rig(case, "--rig", settings, "--quick", "--tests", "vertical,relaxation", "-o", tmp_path / "rig", code=3).stderr
    assert "relaxation: 1 of 1 points failed" in said
    tests = rondo.open_rig(tmp_path / "rig").tests
    assert [tests[name].info["status"] for name in ("vertical", "relaxation")] == ["finished", "failed"]
    assert tests["relaxation"].table["reason"][0].startswith("of this wheel a run in time fails: ")
    assert "All points of these tests failed: relaxation" in (tmp_path / "rig" / "report.html").read_text()


def test_a_tread_keeps_its_pitches(tmp_path):
    tread = "[disk.mesh]\nradial = 2\n[disk.tread]\npitches = 40\ndepth = 0.01\nland_columns = 2\ngroove_columns = 1\nlayers = 1\n"
    case, settings = files(tmp_path, PLANE_WHEEL.replace("[disk.mesh]\nradial = 2\ncircumferential = 90\n", tread), RIG)
    rig(case, "--rig", settings, "--quick", "--tests", "footprint", "-o", tmp_path / "rig")
    found = rondo.open_rig(tmp_path / "rig")
    assert found.settings["sectors"] == 40
    length, pressure = columns(found, "footprint", "contact_length", "mean_pressure")
    assert length * pressure * WIDTH == pytest.approx(LOAD, rel=1e-6)
    settings.write_text(RIG.replace("schema = 1", "schema = 1\nsectors = 60"))
    assert "leave sectors out" in rig(case, "--rig", settings, "--dry-run", code=2).stderr


def of_history(length, settles=True, friction=0.8, wave=0.0):
    """A run whose force follows a step exponentially, with a ripple of each sector that passes. wave: of the change, that dies away."""
    case = {"ground": {"friction": friction}, "disk": {"mesh": {"circumferential": 90}}, "motion": {"angular_velocity": 40.0, "speed": [[0.0, 12.0], [0.1, 12.0], [0.1001, 11.9]]}}
    pass_s = 2 * np.pi / 40 / 90
    time = np.arange(0.0, 0.3 if settles else 0.11, pass_s / 40)
    rolled = 11.9 * np.maximum(time - 0.1, 0.0)
    force = 50.0 + 100.0 * (1 - np.exp(-rolled / length)) + 300.0 * np.cos(2 * np.pi * time / pass_s)
    force += 100.0 * wave * np.sin(2 * np.pi * rolled / 0.1) * np.exp(-rolled / 0.3)
    return types.SimpleNamespace(case=case, history={"time_s": time, "force_x": force, "force_y": np.full(len(time), 1000.0)})


def test_lengths_of_a_step():
    step = slip_step.slip_step_of(of_history(0.15))
    assert step.fitted == pytest.approx(0.15, rel=0.01) and step.length == pytest.approx(0.15, rel=0.02)
    assert (step.before, step.after) == (pytest.approx(50.0, abs=0.5), pytest.approx(150.0, abs=0.5))
    with pytest.raises(rondo.Error, match="has not settled"):
        slip_step.slip_step_of(of_history(0.15, settles=False))


@pytest.mark.parametrize("change, words", [
    ({"friction": 0.2}, "50 % of what friction carries, and the contact slides"),
    ({"friction": {"coefficient": 0.8, "slip_speed": [[0.0, 1.0], [0.05, 0.25]]}}, "make the step smaller"),
    ({"friction": {"coefficient": 0.8, "slip_speed": [[0.0, 0.2], [0.2, 1.0]]}}, "62 % of what friction"),
    ({"friction": 0.0}, "friction vanishes at rest"),
    ({"wave": 1.0}, "does not follow the step exponentially")])
def test_steps_that_tell_no_length(change, words):
    assert slip_step.slip_step_of(of_history(0.15, friction=0.26)).fitted == pytest.approx(0.15, rel=0.01)
    with pytest.raises(rondo.Error, match=words):
        slip_step.slip_step_of(of_history(0.15, **change))


@pytest.mark.parametrize("text, code, words", [("friction = 0.04", 3, "of what friction carries"),
                                               ("[relaxation]\nmass_damping = 1e8", 2, "<= 554.7, half of critical damping")])
def test_a_wrong_relaxation_length_is_none(tmp_path, text, code, words):
    case, settings = files(tmp_path, PLANE_WHEEL, f"schema = 1\nwidth = {WIDTH}\nload = 2000.0\n[vertical]\nloads = [2000.0]\n{text}\n" if text[0] == "["
                           else f"schema = 1\nwidth = {WIDTH}\nload = 2000.0\n{text}\n[vertical]\nloads = [2000.0]\n")
    said = rig(case, "--rig", settings, "--quick", "--tests", "relaxation", "-o", tmp_path / "rig", code=code).stderr
    assert words in (said if code == 2 else rondo.open_rig(tmp_path / "rig").tests["relaxation"].table["reason"][0])


def test_damping_of_a_soft_wheel():
    """Critical is twice the frequency: the default is lowered to half of it, and what the rig file says is refused above it."""
    settings = {"relaxation": {"mass_damping": 100.0, "distance": 2.0}}
    assert with_damping_below(101.0, settings, {}, None) is settings
    assert with_damping_below(60.0, settings, {}, None)["relaxation"] == {"mass_damping": pytest.approx(60.0, rel=5e-3), "distance": 2.0}
    with pytest.raises(InputError, match="<= 60, half of critical"):
        with_damping_below(60.0, settings, settings, None)


def test_steps_are_a_whole_number_in_a_pass():
    for stable in (1e-3, 2e-4, 3e-5, 1e-6):
        step, interval = slip_step.steps_of(1.7e-3, stable)
        for part, whole in ((step, interval), (interval, 1.7e-3)):
            assert whole / part == pytest.approx(round(whole / part), rel=1e-9)
        assert step <= stable / slip_step.FINER * (1 + 1e-9) and interval <= 1.7e-3 / slip_step.ROWS * (1 + 1e-9)


def test_resistance_of_the_discretisation_is_told(tmp_path):
    """A wheel without losses of its material: what is left is damping and the scheme."""
    case, settings = files(tmp_path, PLANE_WHEEL.replace("stiffness = 2.0e-5", "stiffness = 1.0e-7"), RIG)
    made = rig(case, "--rig", settings, "--quick", "--tests", "vertical,rolling-resistance", "-o", tmp_path / "rig")
    share = np.abs(rondo.open_rig(tmp_path / "rig").tests["rolling-resistance"].table["scheme_share"]).max()
    assert share > 0.05
    told = f"the discretisation takes up to {100 * share:.0f} % of the power"
    assert f"warning: rolling-resistance: {told}" in made.stderr
    assert told in (tmp_path / "rig" / "report.html").read_text()
    assert doubt_of("rolling-resistance", [{"status": "done", "scheme_share": -0.04}, {"status": "failed"}]) == ""

# SPDX-License-Identifier: BSD-3-Clause
"""rondo.axes: the table of docs/conventions.md against runs, moments against sums over the contact nodes, round
trips, slip ratios and what is refused."""
import pathlib
import re

import numpy as np
import pytest
from built import cached
from conftest import ok, replaced
from program import PROGRAM

import rondo
from rondo import axes

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "conventions.md"
BUILD = pathlib.Path(PROGRAM).resolve().parent
with_module = pytest.mark.skipif(not cached(BUILD, "RONDO_PYTHON_MODULE"),
                                 reason=str(cached(BUILD, "RONDO_PYTHON_MODULE_MISSING")))
CASE = (ROOT / "cases" / "wheel3d-steady.toml").read_text()
# A crowned wheel on a small footprint, which a camber pushes to the side to which it leans.
WHEEL = ["disk.mesh.circumferential=90", "disk.crown_radius=0.2", "motion.height=0.296", "motion.slip_angle=0"]
MANOEUVRES = {"left turn": ["motion.slip_angle=0.02"], "right turn": ["motion.slip_angle=-0.02"],
              "camber to the left": ["motion.camber=0.05"], "driving": ["motion.speed=9.99"],
              "braking": ["motion.speed=10.3"], "turn slip": ["motion.turn_slip=0.1"]}
QUANTITIES = {  # names in the table: in rondo, elsewhere
    "slip angle": ("slip_angle",) * 2, "camber": ("camber",) * 2, "slip ratio": ("slip_ratio",) * 2,
    "turn slip": ("turn_slip",) * 2, "longitudinal force": ("Fx", "Fx"), "lateral force": ("Fz", "Fy"),
    "normal force": ("Fy", "Fz"), "overturning moment": ("Mx", "Mx"), "moment about y": ("Mz", "My"),
    "aligning moment": ("My", "Mz")}
ALL = ("Fx", "Fy", "Fz", "Mx", "My", "Mz", "slip_angle", "camber", "slip_ratio", "turn_slip", "height", "time")


@pytest.fixture(scope="module")
def wheels(tmp_path_factory):
    """Runs of the six manoeuvres, freely rolling but for driving and braking, and of going straight on."""
    folder = tmp_path_factory.mktemp("axes")
    free = "\n".join(line for line in CASE.splitlines() if not line.startswith("speed"))
    (folder / "given.toml").write_text(CASE)
    (folder / "free.toml").write_text(free)
    runs = {}
    for name, settings in {**MANOEUVRES, "straight": [], "leaning corner": ["motion.camber=0.08", "motion.slip_angle=0.03"]}.items():
        case = "given" if name in ("driving", "braking") else "free"
        torque = [] if case == "given" else ["analysis.torque=0"]
        words = [word for one in (*WHEEL, *settings, *torque) for word in ("--set", one)]
        ok("run", folder / f"{case}.toml", "-o", folder / name.replace(" ", "-"), *words)
        runs[name] = rondo.open(folder / name.replace(" ", "-"))
    return runs


def table_of_signs():
    """Rows of the table of six manoeuvres: manoeuvre, quantity, signs by system."""
    lines = PAGE.read_text().split("| manoeuvre |")[1].split("\n\n")[0].splitlines()
    systems = re.findall(r"`([\w-]+)`", lines[0])
    rows, manoeuvre = [], ""
    for line in lines[2:]:
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        manoeuvre = cells[0].split(":")[0] or manoeuvre
        rows.append((manoeuvre, cells[1], dict(zip(systems, cells[2:]))))
    return rows


def test_table_of_systems():
    """The first table of the page says what the module has."""
    lines = PAGE.read_text().split("| `rondo.axes` |")[1].split("\n\n")[0].splitlines()[2:]
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    assert [re.findall(r"`([\w-]+)`", row[0])[0] for row in rows] == list(axes.SYSTEMS)
    for row, system in zip(rows, axes.SYSTEMS.values()):
        y, z = row[2].split(", ")
        assert y.split()[0] == system.y and z.split()[0] == system.z and system.origin in row[3]
        assert row[4] == ("right" if system.slip_angle > 0 else "left")
        assert row[5] == ("left" if system.camber > 0 else "right")
        assert row[6] == ("left" if system.turn_slip > 0 else "right")


def test_table_of_six_manoeuvres(wheels):
    """Each sign of the page, and the sizes that a sign needs to mean something."""
    rows = table_of_signs()
    assert {row[0] for row in rows} == {*MANOEUVRES, "all of them"} and len(rows) == 19
    free = wheels["straight"].steady
    radius = free["speed"] / 33.76455
    for manoeuvre, quantity, signs in rows:
        assert set(signs) == set(axes.SYSTEMS)
        for name in MANOEUVRES if manoeuvre == "all of them" else [manoeuvre]:
            for system, sign in signs.items():
                if sign == "\u00b1":  # depends on the wheel
                    continue
                found = wheels[name].history.in_axes(system, radius if system != "rondo" else None)
                own, other = QUANTITIES[quantity]
                value = float(getattr(found, own if system == "rondo" else other).mean())
                assert sign == ("+" if value > 0 else "\u2212"), (name, quantity, system, value)
                assert abs(value) > 1e-4, (name, quantity, system)


def test_six_manoeuvres_mean_what_they_say(wheels):
    """rondo's own signs, from the columns: a wheel that is turned to the left is pushed to the left, ..."""
    mean = {name: {key: run.history.mean(key) for key in ("force_x", "force_y", "force_lateral", "moment_aligning", "torque")}
            for name, run in wheels.items()}
    assert mean["left turn"]["force_lateral"] < -500 and mean["left turn"]["moment_aligning"] < -5
    assert mean["right turn"]["force_lateral"] == pytest.approx(-mean["left turn"]["force_lateral"], rel=1e-6)
    assert mean["camber to the left"]["force_lateral"] < -30
    assert mean["driving"]["force_x"] > 100 and mean["driving"]["torque"] > 10
    assert mean["braking"]["force_x"] < -500 and mean["braking"]["torque"] < -100
    assert mean["turn slip"]["force_lateral"] > 50 and mean["turn slip"]["moment_aligning"] < -1
    assert abs(mean["straight"]["force_lateral"]) < 1e-6


def test_iso_columns_of_the_program(wheels):
    """The two columns that the program has in ISO axes itself."""
    for name, run in wheels.items():
        found = run.history.in_axes("iso-w")
        np.testing.assert_allclose(found.Mz, run.history["moment_aligning_iso"], rtol=1e-12, atol=1e-9, err_msg=name)
        np.testing.assert_allclose(found.Mx, run.history["moment_overturning_iso"], rtol=1e-12, atol=1e-9, err_msg=name)
        np.testing.assert_array_equal(found.Fy, -run.history["force_lateral"])


@pytest.mark.parametrize("name", ["left turn", "camber to the left", "driving", "leaning corner"])
def test_moments_by_sums_over_the_nodes(wheels, name):
    """Forces at the contact nodes and their places, along t1, n and t2, summed about each origin."""
    run = wheels[name]
    history = {system: run.history.in_axes(system) for system in axes.SYSTEMS}
    for k in range(run.n_snapshots):
        places = run.on_ground(k)[run.mesh.boundary]
        normal, tangential, lateral = np.asarray(run.contact.force[k]).T
        forces = np.stack([-tangential, normal, lateral], axis=1)  # the tangent J n points back
        height, camber = run.center[k][1], run.camber
        contact = np.array([0.0, 0.0, height * np.tan(camber)])
        center = np.array([0.0, height, 0.0])
        for system, found in history.items():
            where = {"rondo": np.zeros(3), "tydex-h": center, "tydex-c": center}.get(system, contact)
            moment = np.cross(places - where, forces).sum(axis=0)
            rows = AXES(system, camber)
            force, moment = rows @ forces.sum(axis=0), rows @ moment
            if system == "adapted-sae":
                force[2] *= -1
            scale = np.abs(forces).sum()
            np.testing.assert_allclose(found.forces[k], force, atol=1e-9 * scale, err_msg=system)
            np.testing.assert_allclose(found.moments[k], moment, atol=1e-9 * scale, err_msg=system)


def AXES(system, camber):
    """x, y and z along t1, n, t2, written down once more."""
    cos, sin = np.cos(camber), np.sin(camber)
    return np.array({"rondo": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "iso-w": [[1, 0, 0], [0, 0, -1], [0, 1, 0]],
                     "tydex-h": [[1, 0, 0], [0, 0, -1], [0, 1, 0]], "tydex-c": [[1, 0, 0], [0, -sin, -cos], [0, cos, -sin]],
                     "sae": [[1, 0, 0], [0, 0, 1], [0, -1, 0]], "adapted-sae": [[1, 0, 0], [0, 0, 1], [0, -1, 0]]}[system], float)


def test_all_systems_are_right_handed():
    for name in axes.SYSTEMS:
        for camber in (0.0, 0.3, -0.3):
            rows = axes.directions(name, camber)
            np.testing.assert_allclose(rows @ rows.T, np.eye(3), atol=1e-15)
            assert np.linalg.det(rows) == pytest.approx(1.0)


def test_from_each_to_each(wheels):
    own = wheels["leaning corner"].history.in_axes("rondo")
    for one in axes.SYSTEMS:
        for other in axes.SYSTEMS:
            there = axes.convert(axes.convert(own, one), other)
            back, direct = axes.convert(there, "rondo"), axes.convert(own, other)
            for key in ALL:
                np.testing.assert_allclose(getattr(there, key), getattr(direct, key), rtol=1e-12, atol=1e-9, err_msg=f"{one} {other} {key}")
                np.testing.assert_allclose(getattr(back, key), getattr(own, key), rtol=1e-12, atol=1e-9, err_msg=f"{one} {other} {key}")


def test_effective_radius(wheels):
    """Slip ratios are 0 of free rolling with the radius of free rolling, and come back."""
    straight = wheels["straight"]
    radius = straight.steady["speed"] / 33.76455
    assert abs(straight.history.in_axes("iso-w", radius).slip_ratio).max() < 1e-9
    assert straight.history.in_axes("iso-w").slip_ratio.mean() == pytest.approx(0.3 / radius - 1, rel=1e-9)
    driving = wheels["driving"]
    found = driving.history.in_axes("sae", radius)
    assert found.slip_ratio.mean() == pytest.approx(33.76455 * radius / 9.99 - 1, rel=1e-9)
    back = axes.convert(found, "rondo", effective_radius=radius, radius=0.3)
    np.testing.assert_allclose(back.slip_ratio, driving.history["slip_ratio"], rtol=1e-12)
    with pytest.raises(rondo.InputError, match="one of them is missing"):
        axes.convert(found, "rondo", effective_radius=radius)


def test_slip_ratios():
    speed, spin = np.array([10.0, 10.0, 10.0, 0.0, 10.0]), np.array([0.0, 40.0, 30.0, 50.0, 25.0])
    np.testing.assert_allclose(axes.slip_ratio(speed[[0, 1, 2, 4]], spin[[0, 1, 2, 4]], 0.3), [-1, 0.2, -0.1, -0.25])
    np.testing.assert_allclose(axes.slip_ratio(speed, spin, 0.3, "larger"), [-1, 2 / 12, -0.1, 1, -0.25])
    assert np.isinf(axes.slip_ratio(0.0, 50.0, 0.3)) and axes.slip_ratio(0.0, 0.0, 0.3) == 0
    travel = np.array([-1.0, -0.3, 0.0, 0.2, 5.0])
    larger = axes.convert_slip_ratio(travel, "travel", "larger")
    np.testing.assert_allclose(larger, [-1, -0.3, 0, 0.2 / 1.2, 5 / 6])
    np.testing.assert_allclose(axes.convert_slip_ratio(larger, "larger", "travel"), travel)
    with pytest.raises(rondo.InputError, match="not finite"):
        axes.convert_slip_ratio(1.0, "larger", "travel")
    with pytest.raises(rondo.InputError, match="no such definition"):
        axes.slip_ratio(1.0, 1.0, 1.0, "sae")


@with_module
def test_a_motion_in_time(tmp_path):
    """Rows of a run in files and of a simulation in memory, with a slip angle that is a table."""
    text = replaced(CASE, "slip_angle", "slip_angle = [[0.0, 0.0], [0.002, 0.02]]")
    text = text.replace('[analysis]\nkind = "steady-rolling"', "[time]\nend = 0.004\n[output]\nhistory_interval = 0.0005\nsnapshots = 5")
    text = text.replace("circumferential = 90", "circumferential = 30").replace("height = 0.29 ", "height = [[0.0, 0.3001], [0.002, 0.2995]] ")
    (tmp_path / "case.toml").write_text(text)
    ok("run", tmp_path / "case.toml", "-o", tmp_path / "run")
    history = rondo.open(tmp_path / "run").history
    found = history.in_axes("iso-w")
    assert found.Fy.shape == history["time_s"].shape and found.slip_angle[-1] == pytest.approx(-0.02)
    np.testing.assert_allclose(found.Mz, history["moment_aligning_iso"], rtol=1e-9, atol=1e-9)
    simulation = rondo.Simulation(tmp_path / "case.toml")
    simulation.run()
    np.testing.assert_array_equal(simulation.history.in_axes("iso-w").My, found.My)


def test_a_camber_in_time(tmp_path):
    """Both moments that the program has in ISO axes, of rows in time at one height."""
    text = replaced(CASE, "slip_angle", "slip_angle = 0.02\ncamber = 0.05").replace("circumferential = 90", "circumferential = 30")
    text = text.replace("height = 0.29 ", "height = 0.2999 ")
    (tmp_path / "case.toml").write_text(text.replace('[analysis]\nkind = "steady-rolling"', "[time]\nend = 0.004\n[output]\nsnapshots = 5"))
    ok("run", tmp_path / "case.toml", "-o", tmp_path / "run")
    history = rondo.open(tmp_path / "run").history
    found = history.in_axes("tydex-w")
    assert found.system == "iso-w" and abs(found.Mx).max() > 1.0
    np.testing.assert_allclose(found.Mz, history["moment_aligning_iso"], rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(found.Mx, history["moment_overturning_iso"], rtol=1e-9, atol=1e-9)


def test_refusals(tmp_path, smooth, wheels):
    with pytest.raises(rondo.Error, match="no wheel in three dimensions"):
        rondo.open(smooth).history.in_axes("iso-w")
    with pytest.raises(rondo.InputError, match="axes 'iso': no such system .*iso-w"):
        wheels["straight"].history.in_axes("iso")
    (tmp_path / "case.toml").write_text(CASE)
    ok("run", tmp_path / "case.toml", "-o", tmp_path / "back", "--set", "disk.mesh.circumferential=45", "--set",
       "motion.speed=-10", "--set", "motion.angular_velocity=-33.76455")
    with pytest.raises(rondo.Error, match="rolls backwards"):
        rondo.open(tmp_path / "back").history.in_axes("iso-w")


@with_module
def test_a_motion_solved_into_memory_is_refused(tmp_path):
    motion = tmp_path / "motion.toml"
    motion.write_text(CASE.replace('[analysis]\nkind = "steady-rolling"', "[time]\nend = 0.0005\n[output]\nsnapshots = 2")
                      .replace("height = 0.29 ", "height = 0.301 "))
    with pytest.raises(rondo.Error, match="solved into memory"):
        rondo.solve(motion, {"disk.mesh.circumferential": 30}).history.in_axes("iso-w")


@with_module
def test_a_state_in_memory(tmp_path):
    """The same numbers as of a run in files, with camber, turn slip and the outer radius."""
    (tmp_path / "case.toml").write_text(CASE)
    settings = {"disk.mesh.circumferential": 45, "motion.camber": 0.03, "motion.turn_slip": 0.05}
    words = [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]
    ok("run", tmp_path / "case.toml", "-o", tmp_path / "run", *words)
    for system in axes.SYSTEMS:
        radius = None if system == "rondo" else 0.298  # rondo's slip ratio has the outer one
        there = rondo.open(tmp_path / "run").history.in_axes(system, radius)
        here = rondo.steady_rolling(tmp_path / "case.toml", settings).history.in_axes(system, radius)
        for key in ALL:
            np.testing.assert_allclose(getattr(here, key), getattr(there, key), rtol=1e-12, atol=1e-12, err_msg=f"{system} {key}")

# SPDX-License-Identifier: BSD-3-Clause
"""Friction work, wear by turn and flash temperature (docs/wear.md)."""
import csv

import matplotlib.pyplot as plt
import numpy as np
import pytest
from conftest import ROOT, SMALL, TREADED, ok
from test_cli import rondo_module
from test_errors import says
from test_footprint import STEADY

import rondo
from rondo.data.heat import Heat, flash_temperature

RUBBER = Heat(conductivity=0.25, density=1150.0, capacity=1700.0, share=1.0)
STEEL = Heat(conductivity=50.0, density=7850.0, capacity=450.0)
HEATED = ["--conductivity", "0.25", "--density", "1150", "--heat-capacity", "1700"]
WIDE = ["disk.width=0.1", "motion.slip_angle=0.05"]


@pytest.fixture(autouse=True)
def closed_figures():
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def friction_runs(tmp_path_factory):
    folder = tmp_path_factory.mktemp("friction")
    (folder / "case.toml").write_text(SMALL)
    (folder / "treaded.toml").write_text(TREADED)
    on = ["output.friction_work=true"]
    for name, case, of in (("steady", "case", STEADY), ("treaded", "treaded", STEADY),
                           ("wide", "case", STEADY + WIDE), ("moved", "case", on),
                           ("moved-wide", "case", on + WIDE)):
        ok("run", folder / f"{case}.toml", "-o", folder / name,
           *(part for setting in of for part in ("--set", setting)))
    return {path.name: rondo.open(path) for path in folder.iterdir() if path.is_dir()}


# The formula

def test_a_constant_source():
    """2 β q √(x / (π k ρ c v)) from where it begins; here it comes up within a tenth of a millimetre."""
    x = np.concatenate([[0.0], np.linspace(1e-4, 0.05, 200)])
    rise = flash_temperature(x, np.where(x > 0, 1e6, 0.0), 20.0, RUBBER, 1e-4)
    expected = 2e6 * np.sqrt(x / (np.pi * 0.25 * 1150 * 1700 * 20.0))
    assert np.abs(rise - expected)[50:].max() < 5e-3 * expected.max()


def test_a_power_that_is_linear_between_places_is_exact():
    """Against the integral by a substitution that removes the root, and many points."""
    x = np.array([0.0, 0.3, 1.0, 1.2, 2.0])
    q = np.array([1.0, 4.0, 2.0, 0.0, 3.0])
    heat = Heat(2.0, 3.0, 5.0, 0.7)
    rise = flash_temperature(x, q, 4.0, heat, 0.3)
    knots = np.concatenate([[-0.3], x, [2.3]])
    values = np.concatenate([[0.0], q, [0.0]])
    for at, found in zip(x, rise):
        root = np.linspace(0.0, np.sqrt(at + 0.3), 200001)
        exact = 2 * np.trapz(np.interp(at - root**2, knots, values), root)
        assert found == pytest.approx(0.7 * exact / np.sqrt(np.pi * 2 * 3 * 5 * 4), rel=1e-8)


def test_more_places_of_one_source_are_one_source():
    """Halves of the pieces change nothing, twice the speed takes a root of two off, and one place is a hat."""
    x, q = np.linspace(0, 0.01, 11), np.sin(np.linspace(0, np.pi, 11))
    finer = np.interp(np.linspace(0, 0.01, 21), x, q)
    coarse = flash_temperature(x, q, 10.0, RUBBER, 1e-3)
    fine = flash_temperature(np.linspace(0, 0.01, 21), finer, 10.0, RUBBER, 1e-3)
    np.testing.assert_allclose(fine[::2], coarse, rtol=1e-12, atol=1e-12 * coarse.max())
    np.testing.assert_allclose(flash_temperature(x, q, 20.0, RUBBER, 1e-3), coarse / np.sqrt(2), rtol=1e-13)
    hat = flash_temperature([-1e-3, 0.0, 1e-3], [0.0, 5.0, 0.0], 10.0, RUBBER, 1e-3)
    assert flash_temperature([0.0], [5.0], 10.0, RUBBER, 1e-3) == pytest.approx(hat[1:2], rel=1e-13)


A, B, P_MAX, SLIDES, SPEED = 5.88e-3, 10.54e-3, 770.6e6, 1.0, 30.0  # of the wheel on its rail
SHEAR_MODULUS, NU, MU = 82e9, 0.28, 0.3


def elastic_slip():
    """By how much of the rigid slip it grows from the middle to the trailing edge where all slides: two
    half-spaces under Hertz's shear, whose displacement is quadratic (Cerruti's, in polar coordinates about
    the point)."""
    phi = np.linspace(0, 2 * np.pi, 2000, endpoint=False)
    c, s = np.cos(phi), np.sin(phi)

    def displacement(x):
        a, b, here = (c / A) ** 2 + (s / B) ** 2, x * c / A**2, 1 - (x / A) ** 2
        whole = np.sqrt(here + b**2 / a)
        begin = np.arcsin(np.clip(b / np.sqrt(a) / whole, -1, 1))
        ray = whole**2 / (2 * np.sqrt(a)) * (0.5 * np.pi - begin - 0.5 * np.sin(2 * begin))
        return MU * P_MAX / SHEAR_MODULUS * np.mean(ray * (1 - NU + NU * c**2))

    slope = 2 * (displacement(0.9 * A) - displacement(0.3 * A)) / (0.6 * A)  # of both, at 0.6 A
    return -slope / 0.6 / (SLIDES / SPEED)


def hertz(x, elastic=0.0):
    """Friction power along the middle of the contact of Ertz and Knothe, x from the middle backwards [W/m2]."""
    return MU * P_MAX * np.sqrt(np.maximum(1 - (x / A) ** 2, 0.0)) * SLIDES * (1 + elastic * x / A)


def test_f6_is_bloks_formula_for_a_hertzian_contact():
    """1.11 μ w |v1 - v2| / (√(k ρ c) √v √(2a)) with w = π a p / 2, and half of the heat."""
    x = np.linspace(-A, A, 2001)
    found = flash_temperature(x, hertz(x), SPEED, STEEL, 1e-9).max()
    line = 0.5 * np.pi * A * P_MAX  # N/m
    blok = 1.11 * 0.3 * line * SLIDES / np.sqrt(2 * A * SPEED * 50.0 * 7850.0 * 450.0)
    assert found == pytest.approx(0.5 * blok, rel=3e-3)
    assert found == pytest.approx(150.33, abs=0.02)
    assert 1.5 * 1e5 / (np.pi * A * B) == pytest.approx(P_MAX, rel=5e-4)


def test_f6_differs_from_contact_by_its_own_cell():
    """CONTACT has 166.8 K: cells of 0.2 mm with a constant power, of which the one where the temperature is
    taken counts twice, and the slip of the elastic surfaces."""
    x = np.arange(-29, 30) * 0.2e-3
    elastic = elastic_slip()
    assert elastic == pytest.approx(0.1137, abs=2e-4)
    q = 0.998 * hertz(x, elastic)
    behind = x[:, None] - x[None, :]
    half = 0.1e-3
    roots = np.sqrt(np.maximum(behind + half, 0.0)) - np.sqrt(np.maximum(behind - half, 0.0))
    factor = 0.5 * 2 / np.sqrt(np.pi * 50.0 * 7850.0 * 450.0 * SPEED)
    once = factor * (q * np.where(behind >= 0, roots, 0.0)).sum(axis=1)
    twice = once + factor * q * np.sqrt(half)
    assert twice.max() == pytest.approx(166.8, abs=0.2)
    assert once.max() == pytest.approx(152.4, abs=0.1)
    ours = flash_temperature(x, q, SPEED, STEEL, 0.2e-3)
    assert ours.max() == pytest.approx(once.max(), rel=3e-3)
    fine = np.linspace(-A, A, 2001)
    assert ours.max() == pytest.approx(0.998 * flash_temperature(fine, hertz(fine, elastic), SPEED, STEEL,
                                                             1e-9).max(),
                                       rel=3e-3)


def test_wrong_materials_and_places():
    says(rondo.Error, lambda: Heat(0.0, 1.0, 1.0), words=("conductivity 0", "not > 0", "rubber 0.25"))
    says(rondo.Error, lambda: Heat(1.0, 1.0, float("nan")), words=("capacity nan",))
    says(rondo.Error, lambda: Heat(1.0, 1.0, 1.0, 1.5), words=("share 1.5", "0 to 1"))
    for x in ([], [0.0, 0.0], [1.0, 0.0]):
        says(rondo.Error, lambda: flash_temperature(np.array(x), np.ones(len(x)), 1.0, RUBBER, 1.0),
             words=("ascend",))
    says(rondo.Error, lambda: flash_temperature([0.0], [1.0], 0.0, RUBBER, 1.0), words=("0 m/s",))


# Runs

@pytest.mark.parametrize("name", ["steady", "treaded", "wide"])
def test_wear_of_a_turn_is_the_power_over_a_turn(friction_runs, name):
    run = friction_runs[name]
    wear = run.wear()
    assert wear.turns == 1.0 and (wear.per_turn == wear.work).all()
    assert wear.total == pytest.approx(run.steady["power"]["friction"] * 2 * np.pi / abs(run.spin), rel=1e-12)
    assert len(wear.node) == len(run.mesh.boundary)
    kinds = np.unique(run.mesh.sector_node[wear.node])
    for kind in kinds:  # every sector does the same
        assert np.ptp(wear.work[run.mesh.sector_node[wear.node] == kind]) < 1e-9 * wear.work.max()


@pytest.mark.parametrize("name", ["moved", "moved-wide"])
def test_wear_of_a_motion_is_its_friction_work(friction_runs, name):
    run = friction_runs[name]
    found = run.friction_work
    assert found.nodes.shape == (run.n_snapshots, len(run.mesh.boundary))
    wear = run.wear()
    assert (wear.work == found.nodes[-1]).all()
    assert wear.turns == pytest.approx((33.333333 * run.times[-1]) / (2 * np.pi), rel=1e-12)
    size = np.full(np.shape(found.places[-1]), np.diff(found.along[:2])[0])
    if run.is_solid:
        size *= np.diff(found.across[:2])[0]
        size[:, [0, -1]] *= 0.5  # at the sides of the tread
    assert (np.asarray(found.places[-1]) * size).sum() == pytest.approx(wear.total, rel=1e-12)
    assert wear.total == pytest.approx(run.history["dissipation_friction"][-1], rel=0.02)  # less a step
    half = run.wear(from_time=0.01)
    np.testing.assert_allclose(half.work + np.asarray(found.nodes[run.index(0.01)]), wear.work, rtol=1e-12)
    says(rondo.Error, lambda: run.wear(from_time=0.02), words=("no time between them", "--to"))


def test_a_settled_motion_wears_as_steady_rolling(tmp_path):
    """The last turn of the treaded disk, at each of the four nodes of a pitch."""
    case = ROOT / "cases" / "rolling-treaded.toml"
    for name, of in (("steady", ("analysis.kind=steady-rolling", "motion.height=0.29")),
                     ("moved", ("output.friction_work=true",))):
        ok("run", case, "-o", tmp_path / name, *(part for setting in of for part in ("--set", setting)))
    steady, moved = (rondo.open(tmp_path / name) for name in ("steady", "moved"))
    still, last = steady.wear(), moved.wear(from_time=0.1115)
    assert last.turns == pytest.approx(1.0, abs=2e-3)
    assert last.total / last.turns == pytest.approx(still.total, rel=5e-3)

    def by_kind(run, wear):
        kind = run.mesh.sector_node[wear.node]
        return np.array([np.median(wear.per_turn[kind == one]) for one in np.unique(kind)])

    # Explicit steps meet the ground node by node, with impacts; both are of the same mesh.
    np.testing.assert_allclose(by_kind(moved, last), by_kind(steady, still), atol=0.02 * still.work.max())


def test_flash_temperature_of_steady_rolling(friction_runs):
    for name in ("steady", "treaded", "wide"):
        run = friction_runs[name]
        found = run.flash_temperature(RUBBER)
        assert len(found.rise) == len(run.contact.rows["node"])
        assert found.speed == pytest.approx(abs(run.spin) * 0.3)
        spacing = 2 * np.pi * 0.3 / ((run.mesh.sector.max() + 1) * run.n_snapshots)
        for node in np.unique(found.node):
            on = np.flatnonzero(found.node == node)
            on = on[np.argsort(-found.place[on, 0])]  # it rolls to the right
            alone = flash_temperature(-found.place[on, 0], found.power[on], found.speed, RUBBER, spacing)
            np.testing.assert_allclose(found.rise[on], alone, rtol=1e-12, atol=1e-12)
        assert found.largest > 0.0
    back = Heat(0.25, 1150.0, 1700.0, 0.25)
    assert friction_runs["steady"].flash_temperature(back).largest == pytest.approx(
        0.25 * friction_runs["steady"].flash_temperature(RUBBER).largest)


def test_flash_temperature_of_a_snapshot(friction_runs):
    for name in ("moved", "moved-wide"):
        run = friction_runs[name]
        found = run.flash_temperature(RUBBER, 0.02)
        rows = run.contact.rows
        assert len(found.node) == (np.abs(rows["time_s"] - run.times[-1]) < 1e-9).sum() > 0
        assert found.speed == pytest.approx(10.0, rel=1e-6)


def test_what_has_none(friction_runs, smooth, air, crush):
    says(rondo.Error, lambda: rondo.open(smooth).friction_work, words=("output.friction_work = true",))
    says(rondo.Error, lambda: rondo.open(smooth).wear(), words=("output.friction_work = true",))
    says(rondo.Error, lambda: rondo.open(air).flash_temperature(RUBBER), words=("no friction",))
    says(rondo.Error, lambda: rondo.open(crush).flash_temperature(RUBBER), words=("friction_power", "crush"))
    slow = Heat(5e5, 1150.0, 1700.0)
    says(rondo.Error, lambda: friction_runs["steady"].flash_temperature(slow), words=("Péclet", "along the surface"))
    says(rondo.Error, lambda: friction_runs["steady"].flash_temperature(RUBBER, 0.0), words=("leave time out",))
    says(rondo.Error, lambda: friction_runs["steady"].wear(0.0), words=("leave the times out",))


@pytest.mark.parametrize("name, panels", [("steady", 2), ("wide", 2), ("moved", 2), ("moved-wide", 2)])
def test_pictures(friction_runs, name, panels):
    run = friction_runs[name]
    axes = [ax for ax in run.plot_wear().axes if ax.get_label() != "<colorbar>"]
    assert len(axes) == panels
    if name == "moved":
        wear = run.wear()
        x, y = axes[1].lines[0].get_xydata().T
        factor = y.max() / wear.work.max()
        assert factor in (1.0, pytest.approx(1e-3), pytest.approx(1e-6))
        np.testing.assert_allclose(np.sort(y), np.sort(factor * wear.work))
    figure = run.plot_flash_temperature(RUBBER)
    assert f"{run.flash_temperature(RUBBER).largest:.4g} K" in figure._suptitle.get_text()


def read(path):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


WEAR, FLASH = ({f"{name}.{ending}" for ending in ("csv", "png", "svg")} for name in ("wear", "flash-temperature"))


@pytest.mark.parametrize("name, drawn", [("steady", {"footprint.png", "footprint.svg"} | WEAR), ("moved", WEAR),
                                         ("moved-wide", {"footprint.png", "footprint.svg"} | WEAR)])
def test_command(friction_runs, tmp_path, name, drawn):
    run = friction_runs[name]
    done = rondo_module("footprint", run.directory, "-o", tmp_path, *HEATED, "--share", "1")
    assert (done.returncode, done.stderr) == (0, "")
    assert {path.name for path in tmp_path.iterdir()} == drawn | FLASH
    wear, flash = read(tmp_path / "wear.csv"), read(tmp_path / "flash-temperature.csv")
    np.testing.assert_array_equal(wear["work_j_m2"], run.wear().work)
    np.testing.assert_array_equal(flash["flash_temperature_k"], run.flash_temperature(RUBBER).rise)
    assert f"friction takes {run.wear().total:.6g} J" in done.stdout
    assert f"flash temperature {flash['flash_temperature_k'].max():.5g} K" in done.stdout


def test_command_between_two_times(friction_runs, smooth, tmp_path):
    run = friction_runs["moved"]
    done = rondo_module("footprint", run.directory, "-o", tmp_path, "--from", "0.01", "--to", "0.016")
    assert (done.returncode, done.stderr) == (0, "")
    np.testing.assert_array_equal(read(tmp_path / "wear.csv")["work_j_m2"], run.wear(0.01, 0.016).work)
    done = rondo_module("footprint", smooth, "-o", tmp_path, "--from", "0.01")
    assert done.returncode == 2 and "output.friction_work = true" in done.stderr


def test_command_needs_all_of_a_material(friction_runs, tmp_path):
    for options, word in ((HEATED[:2], "--density, --heat-capacity: missing"), (["--share", "1"], "--share")):
        done = rondo_module("footprint", friction_runs["steady"].directory, "-o", tmp_path, *options)
        assert done.returncode == 2 and word in done.stderr
    assert not list(tmp_path.iterdir())

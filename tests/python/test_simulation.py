# SPDX-License-Identifier: BSD-3-Clause
"""rondo.Simulation: the program's bits step by step, loads and motion set on the way, wrong use, and
arrays that outlive what they look at."""
import gc
import os
import pathlib
import weakref

import numpy as np
import pytest
from conftest import IN_THE_AIR, TREADED, WHEEL
from program import SMALL, replaced
from stepping import SOLID, by_program, closed, rows_of, same_rows

import rondo


@pytest.mark.parametrize("text", [SMALL, TREADED, WHEEL, IN_THE_AIR,
                                  SMALL + "\n[solver]\noperator = \"sparse\"\n"])
@pytest.mark.parametrize("every", [1, 37])
def test_the_programs_bits_however_it_is_cut(case, text, every):
    case.write_text(text)
    there = by_program(case, "out", "--set", "output.history_interval=0.0011")
    steps = rondo.Simulation(case, {"output.history_interval": 0.0011})
    u, v = steps.displacement, steps.velocity
    np.testing.assert_array_equal(v, there.velocity[0])
    for _ in steps.steps(every):
        k = np.flatnonzero(np.abs(there.times - steps.time) < 1e-12)
        if len(k):
            np.testing.assert_array_equal(u, there.displacement[k[0]])
            np.testing.assert_array_equal(v, there.velocity[k[0]])
            assert steps.angle == there.angle[k[0]]
            np.testing.assert_array_equal(steps.center, there.center[k[0]])
    assert steps.step == steps.n_steps == there.info["steps"] and steps.is_over
    assert steps.advance(5) == 0
    same_rows(closed(steps).history, there.history)


def test_three_dimensions(case):
    settings = {"disk.mesh.circumferential": 30, "disk.mesh.radial": 2, "disk.mesh.axial": 2,
                "time.end": 5e-3, "output.snapshots": 2}
    there = by_program(SOLID, "out", *(word for key, value in settings.items()
                                       for word in ("--set", f"{key}={value}")))
    steps = rondo.Simulation(SOLID, settings)
    u = steps.displacement
    assert u.shape == steps.mesh.coordinates.shape and steps.mesh.is_solid
    steps.run()
    np.testing.assert_array_equal(u, there.displacement[-1])
    np.testing.assert_array_equal(steps.velocity, there.velocity[-1])
    same_rows(closed(steps).history, there.history)


def test_the_mesh_is_that_of_the_run(case):
    there, here = by_program(case, "out"), rondo.Simulation(case).mesh
    for name in ("coordinates", "cells", "boundary", "tributary", "mass", "sector", "sector_node"):
        np.testing.assert_array_equal(getattr(here, name), getattr(there.mesh, name), err_msg=name)
    assert here.free_body is None and here.region is None


def test_a_row_is_of_the_steps_since_the_last(case):
    steps = rondo.Simulation(case, {"output.history_interval": 0})
    assert len(steps.now) == 0
    row = [row for row in steps.steps(25)][2]
    every = closed(steps).history
    chosen = slice(50, 75)
    assert (row.step, row.time) == (75, every["time_s"][74])
    assert row["force_y"] == pytest.approx(every["force_y"][chosen].mean(), rel=1e-12)
    assert row["penetration_max"] == every["penetration_max_m"][chosen].max()
    assert row["kinetic"] == every["kinetic"][74] and row.units["force_y"] == "N/m"
    with pytest.raises(rondo.UnknownNameError, match="step 75: no column 'force'"):
        row["force"]


def test_contacts_of_the_last_step(case):
    steps = rondo.Simulation(case, {"output.history_interval": 0}).run()
    touching, last = steps.touching, closed(steps).history
    pressed = touching.force[:, 0] > 0
    assert pressed.sum() == last["contact_nodes"][-1] > 0
    assert touching.sticks[pressed].sum() == last["sticking_nodes"][-1]
    assert touching.force[:, 0].sum() == pytest.approx(last["force_y"][-1], rel=1e-12)
    assert touching.force[:, 1].sum() == pytest.approx(-last["force_x"][-1], rel=1e-9)
    assert set(touching.nodes) <= set(steps.mesh.boundary)


DRIVES = [({"motion.speed": 9.5}, 0.0), ({"motion.angular_velocity": 30.0}, 2e-3),
          ({"motion.angular_velocity": 34.0, "motion.height": 0.2955}, 1e-4),
          ({"motion.gravity": 9.81}, 0.0)]
LOADS = [({"rim.brake": 3000.0}, 0.0), ({"rim.brake": 0.0, "rim.force_y": -6e4}, 1e-3),
         ({"rim.torque": -100.0}, 0.0), ({"rim.torque": 50.0, "rim.brake": 10.0}, 0.0)]
IMPLICIT = "\n[[solver.implicit]]\nlayers = [3]\n"
MASSLESS = "\n[solver]\ncontact_mass = \"singular\"\n"


@pytest.mark.parametrize("text, drives", [
    (SMALL, DRIVES), (TREADED, DRIVES), (WHEEL, LOADS), (SMALL + MASSLESS, DRIVES),
    (SMALL + IMPLICIT, DRIVES[:2]), (SMALL + "\n[solver]\noperator = \"sparse\"\n", DRIVES),
    (WHEEL + "\n[solver]\noperator = \"sparse\"\n", LOADS)])
def test_the_driven_case_gives_the_same_bits(case, text, drives):
    case.write_text(text)
    steps = rondo.Simulation(case)
    quiet = rows_of(closed(rondo.Simulation(case).run()).history)
    for _ in steps.steps(61):
        if drives and not steps.is_over:
            settings, over = drives[0]
            drives = drives[1:]
            steps.set(settings, over)
    closed(steps)
    pathlib.Path("driven.toml").write_text(steps.case_text)
    there = by_program("driven.toml", "driven")
    same_rows(steps.history, there.history)
    np.testing.assert_array_equal(steps.displacement, there.displacement[-1])
    assert not np.array_equal(rows_of(steps.history), quiet)


@pytest.mark.parametrize("text, drives", [
    (SMALL, [{"motion.speed": 9.5}, {"motion.speed": 9.9},
             {"motion.height": 0.2957, "motion.angular_velocity": 34.0},
             {"motion.height": 0.296, "motion.angular_velocity": 33.0}]),
    (WHEEL, [{"rim.brake": 3000.0}, {"rim.brake": 0.0, "rim.force_y": -6e4},
             {"rim.force_y": -5e4, "rim.brake": 100.0}, {"rim.torque": 5.0}])])
def test_what_is_set_on_the_way_to_what_was_set(case, text, drives):
    """A point between two others of a table is on their line to round-off alone (1e-16 of the
    height), which contact makes 1e-14 to 1e-10 of the forces."""
    case.write_text(text)
    steps = rondo.Simulation(case)
    for _ in steps.steps(15):  # 2.6e-3 s
        if drives:
            steps.set(drives.pop(0), 5e-3)
    closed(steps)
    pathlib.Path("driven.toml").write_text(steps.case_text)
    there = by_program("driven.toml", "driven").history
    for name in set(there.names) - {"energy_residual"}:  # which is round-off
        np.testing.assert_allclose(steps.history[name], there[name], rtol=0,
                                   atol=1e-8 * np.abs(there[name]).max(), err_msg=name)


def test_what_is_set_comes_with_the_next_step_but_one(case):
    steps = rondo.Simulation(case, {"output.history_interval": 0, "time.end": 0.002})
    steps.advance(10)
    steps.set({"motion.speed": 20.0})
    assert steps.get("motion.speed") == 10.0
    steps.advance(2)
    assert steps.get("motion.speed") == 20.0
    way = np.diff(closed(steps.run()).history["center_x_m"]) / steps.dt
    np.testing.assert_allclose(way[8:10], 10.0, rtol=1e-9)   # to the end of step 11
    assert 10.0 < way[10] < 20.0
    np.testing.assert_allclose(way[11:], 20.0, rtol=1e-9)


def test_wrong_settings_change_nothing(case):
    case.write_text(WHEEL)
    steps = rondo.Simulation(case)
    assert steps.keys == ["motion.speed", "motion.gravity", "rim.force_y", "rim.torque",
                          "rim.brake"]
    steps.advance(20)
    before = steps.case_text
    for settings, over, said in (
            ({"rim.brak": 1.0}, 0.0, r"^rim.brak: there is no such key.*rim\.brake.*allowed: motion"),
            ({"ground.friction": 0.5}, 0.0, "ground.friction: stays what it is while"),
            ({"motion.height": 0.29}, 0.0, "motion.height: has no effect on this case after its start"),
            ({"rim.brake": -1.0}, 0.0, r"rim\.brake = -1: is not allowed .*values >= 0"),
            ({"rim.torque": float("inf")}, 0.0, "rim.torque = inf.*a finite number"),
            ({"rim.torque": 1.0}, -1.0, "over.*-1.*seconds")):
        with pytest.raises(rondo.InputError, match=said) as error:
            steps.set(settings, over)
        assert isinstance(error.value, ValueError)
        assert error.value.faults[0]["key"] == next(iter(settings)) or over < 0
    assert steps.case_text == before
    steps.run().set({"rim.brake": 1.0})  # a loop over rows sets after the last one, too
    assert steps.case_text == before


def test_what_cannot_follow_says_so(case):
    text = replaced(SMALL, "profile", 'profile = [[-1, -0.1], [0, -0.1], [0, 0], [1, 0]]')
    case.write_text(replaced(text, "speed", "speed = 10.0\nstart_x = 0.5"))
    with pytest.raises(rondo.InputError, match="sharp convex corners .* has the motion.*fillet"):
        rondo.Simulation(case).set({"motion.speed": 9.0})
    for text, spin, wrong in ((SMALL, 1e5, "the rim turns by .* too far for the contact law"),
                              (IN_THE_AIR + IMPLICIT, 1e4, "the spin changes by.*too far for implicit")):
        case.write_text(text)
        steps = rondo.Simulation(case)
        with pytest.raises(rondo.InputError,
                           match=rf"^motion.angular_velocity = {spin:g}.*: {wrong}"):
            steps.set({"motion.angular_velocity": spin})
        assert steps.get("motion.angular_velocity") == 33.333333
        steps.advance(3)


@pytest.mark.parametrize("bad, kind, said", [
    ({"ground.frction": 1}, rondo.InputError, "did you mean ground.friction"),
    ({"analysis.kind": "crush", "analysis.depth": 0.01, "analysis.increments": 3},
     rondo.InputError, "analysis.kind.*no motion in time"),
    ({"solver.dump_contacts": 1}, rondo.InputError, "solver.dump_contacts.*keeps no files")])
def test_wrong_cases(case, bad, kind, said):
    with pytest.raises(kind, match=said):
        rondo.Simulation(case, bad)


def test_wrong_calls(case):
    steps = rondo.Simulation(case)
    strange = pathlib.Path(os.fsdecode(b"st\xfck"))
    for call, said in ((lambda: steps.advance(-1), "advance: steps = -1: is no whole number"),
                       (lambda: steps.advance(1.5), "advance: steps = 1.5"),
                       (lambda: steps.advance("3"), "advance: steps = '3'"),
                       (lambda: steps.advance(float("nan")), "advance: steps = nan"),
                       (lambda: list(steps.steps(0)), "steps: every = 0"),
                       (lambda: list(steps.steps(None)), "steps: every = None"),
                       (lambda: steps.advance_to(float("nan")), "advance_to: time = nan"),
                       (lambda: steps.advance_to("soon"), "advance_to: time = 'soon'"),
                       (lambda: steps.set({1: 2.0}), "1: is no key"),
                       (lambda: steps.set([("motion.speed", 1.0)]), "settings = .*are no dict"),
                       (lambda: steps.set({"motion.speed": 10**400}), "motion.speed = .*no number"),
                       (lambda: rondo.Simulation(case, ["time.end"]), "settings = .*are no dict"),
                       (lambda: rondo.Simulation(case, {2: 1}), "2: is no key"),
                       (lambda: rondo.Simulation(5), "5: is no path"),
                       (lambda: rondo.Simulation(strange), "is not UTF-8"),
                       (lambda: rondo.Simulation(case, output=strange), "is not UTF-8"),
                       (lambda: rondo.Simulation(case, {"title": str(strange)}), "is not UTF-8"),
                       (lambda: rondo.Simulation(case, reduced=strange), "is not UTF-8"),
                       (lambda: rondo.solve(strange), "is not UTF-8"),
                       (lambda: rondo.run(strange), "is not UTF-8"),
                       (lambda: rondo.modes(strange), "is not UTF-8"),
                       (lambda: rondo.sweep(strange), "is not UTF-8"),
                       (lambda: rondo.pod(strange), "is not UTF-8"),
                       (lambda: rondo.pod("out", from_time="x"), "from_time = 'x'"),
                       (steps.save, "save.*in memory has no files"),
                       (lambda: rondo.Simulation(case, resume=True), "resume.*no checkpoint"),
                       (lambda: rondo.Simulation("none.toml"), "none.toml")):
        with pytest.raises(rondo.Error, match=said):
            call()
    assert steps.step == 0 and steps.advance(10**30) == steps.n_steps
    steps.close()
    with pytest.raises(rondo.InputError, match="is closed"):
        steps.advance()
    with pytest.raises(rondo.InputError, match="is closed"):
        steps.set({"motion.speed": 1.0})
    steps.close()


def test_arrays_outlive_their_simulation(case):
    steps = rondo.Simulation(case)
    u, v = steps.displacement, steps.velocity
    with pytest.raises(ValueError):
        u[0, 0] = 1.0
    with pytest.raises(ValueError):
        u.setflags(write=True)
    steps.advance(100)
    assert u is not steps.displacement and np.shares_memory(u, steps.displacement)
    kept, there = u.copy(), weakref.ref(steps)
    assert np.abs(kept).max() > 0
    steps.close()
    np.testing.assert_array_equal(u, kept)
    del steps
    gc.collect()
    assert there() is None
    blocks = [np.ones(u.shape) for _ in range(200)]  # memory that was given back is used again
    np.testing.assert_array_equal(u, kept)
    assert np.isfinite(v).all() and blocks


def test_what_is_set_obeys_the_rules_of_a_case(case):
    solid = {"disk.mesh.circumferential": 30, "disk.mesh.radial": 2, "disk.mesh.axial": 2}
    steps = rondo.Simulation(SOLID, solid | {"rim.free": ["height", "speed"], "rim.force_x": 0.0,
                                             "motion.slip_angle": 0.0})
    with pytest.raises(rondo.InputError, match="motion.slip_angle = 0.1.*lateral speed"):
        steps.set({"motion.slip_angle": 0.1})
    assert steps.get("motion.slip_angle") == 0.0
    steps = rondo.Simulation(case)
    with pytest.raises(rondo.InputError, match="motion.height = 1.*away from the origin"):
        steps.set({"motion.height": 1e12})
    case.write_text(WHEEL)
    steps = rondo.Simulation(case)
    with pytest.raises(rondo.InputError, match="rim.torque.*is too far from the value before"):
        steps.set({"rim.torque": -1.7e308}, 1e-2)
    assert "e+308" not in steps.case_text


def test_a_reduced_run_is_resumed_with_the_same_bits(case):
    wheel = {"reduced": "case", "modes": 12}
    whole = rondo.Simulation(case, **wheel).run()
    with rondo.Simulation(case, output="out", **wheel) as steps:
        steps.advance(20)
        steps.save()
    again = rondo.Simulation("out", resume=True, **wheel)
    assert again.step == 20
    np.testing.assert_array_equal(again.run().displacement, whole.displacement)
    for wrong in ({"modes": 12}, {"reduced_step": 1e-4}):
        with pytest.raises(rondo.InputError, match="is an option of a reduced run"):
            rondo.Simulation(case, **wrong)


def test_warnings_point_at_the_caller(case):
    with pytest.warns(UserWarning, match="inside the ground") as caught:
        rondo.Simulation(case, {"motion.height": 0.296})
    assert caught[0].filename == __file__

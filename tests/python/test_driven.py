# SPDX-License-Identifier: BSD-3-Clause
"""rondo.Simulation as its users drive it: what it leaves behind, meshes, places, its last step."""
import numpy as np
import pytest
from conftest import ROOT, SMALL, WHEEL

import rondo

TWO_DISKS = ROOT / "cases" / "two-disks.toml"


@pytest.fixture
def case(tmp_path, monkeypatch):
    """That of a wheel, in an empty working folder."""
    (tmp_path / "cases").mkdir()
    (tmp_path / "work").mkdir()
    monkeypatch.chdir(tmp_path / "work")
    path = tmp_path / "cases" / "wheel.toml"
    path.write_text(WHEEL)
    return path


def test_in_memory_nothing_is_written(case, tmp_path):
    with rondo.Simulation(case) as simulation:
        simulation.set({"rim.brake": 10.0})
        simulation.run()
    assert not list((tmp_path / "work").iterdir())


def test_a_loop_over_rows_may_set_after_the_last(case):
    simulation = rondo.Simulation(case)
    for row in simulation.steps(10):
        simulation.set({"rim.brake": 100.0 * row.time})
    assert simulation.is_over and simulation.step == simulation.n_steps
    with pytest.raises(rondo.InputError, match="rim.brak: there is no such key"):
        simulation.set({"rim.brak": 1.0})
    with pytest.raises(rondo.InputError, match="rim.brake = -1: is not allowed"):
        simulation.set({"rim.brake": -1.0})
    simulation.close()
    with pytest.raises(rondo.InputError, match="is closed"):
        simulation.set({"rim.brake": 1.0})


def test_position_is_that_of_a_run(case, tmp_path):
    run = rondo.run(case, tmp_path / "run")
    simulation = rondo.Simulation(case).run()
    assert simulation.time == run.times[-1]
    place = simulation.position
    np.testing.assert_allclose(place, run.position(-1), rtol=0, atol=1e-14)
    np.testing.assert_array_equal(simulation.mesh.cells, run.mesh.cells)
    assert abs(place.mean(axis=0)[1] - 0.29) < 0.02


def test_free_bodies_are_free_in_memory_too(tmp_path):
    settings = {"time.end": 0.001, "output.snapshots": 2}
    run = rondo.run(TWO_DISKS, tmp_path / "run", settings)
    solution = rondo.solve(TWO_DISKS, settings)
    simulation = rondo.Simulation(TWO_DISKS, settings).run()
    for mesh in (solution.mesh, simulation.mesh):
        np.testing.assert_array_equal(mesh.free_body, run.mesh.free_body)
    np.testing.assert_array_equal(simulation.position, run.position(-1))


def test_all_is_set_or_nothing(case):
    simulation = rondo.Simulation(case)
    before = simulation.case_text
    for settings, said in (({"rim.torque": 5.0, "rim.brake": -1.0}, r"rim\.brake = -1: is not allowed"),
                           ({"rim.torque": 5.0, "rim.brak": 1.0}, "rim.brak: there is no such key"),
                           ({"rim.torque": 5.0, "motion.speed": "fast"}, "motion.speed = 'fast': is no number")):
        with pytest.raises(rondo.InputError, match=said) as error:
            simulation.set(settings)
        assert error.value.faults[0]["key"] == list(settings)[1]
        assert simulation.case_text == before
    simulation.set({"rim.torque": 5.0, "rim.brake": 7.0})
    simulation.advance(2)
    assert (simulation.get("rim.torque"), simulation.get("rim.brake")) == (5.0, 7.0)


def test_what_a_motion_cannot_follow_is_named(case):
    """And the keys set beside it are left as they were."""
    case.write_text(SMALL)
    simulation = rondo.Simulation(case)
    before = simulation.case_text
    with pytest.raises(rondo.InputError, match=r"^motion.angular_velocity = 100000:"):
        simulation.set({"motion.speed": 9.0, "motion.angular_velocity": 1e5})
    assert simulation.case_text == before


def test_before_the_first_step_there_is_no_row(case):
    with pytest.raises(rondo.UnknownNameError, match=r"step 0: there is no row before a step: advance\(1\)"):
        rondo.Simulation(case).now["force_y"]


def test_a_solution_of_a_motion_is_not_steady(case):
    with pytest.raises(rondo.Error, match='no steady rolling: analysis.kind is "dynamic"'):
        rondo.solve(case, {"output.snapshots": 0}).steady


def test_what_notebooks_show(case):
    """Small tables, in which the title is text."""
    title = {"title": "a <b> & c"}
    simulation = rondo.Simulation(case, title)
    simulation.advance(3)
    shown = simulation._repr_html_()
    for part in ("<caption>a &lt;b&gt; &amp; c</caption>", f"<td>3 of {simulation.n_steps}</td>",
                 "<td>in memory</td>", "<td>rim.brake</td>"):
        assert part in shown
    solution = rondo.steady_rolling(ROOT / "cases" / "steady-rolling.toml", title)
    shown = solution._repr_html_()
    for part in ("<caption>a &lt;b&gt; &amp; c</caption>", "<td>steady-rolling</td>", "<td>-22074.5</td>",
                 f"<td>{solution.mesh.n_nodes}</td>"):
        assert part in shown
    assert len(shown) < 2000

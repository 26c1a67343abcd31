# SPDX-License-Identifier: BSD-3-Clause
"""Observed orders and extrapolated values of sweeps over the mesh or the step; what does not converge."""
import json
import math
import subprocess
import sys

import numpy as np
import pytest
import sweeps

import rondo
from rondo.data.refinement import converge

RADIAL, ROUND, STEP, FRICTION = "disk.mesh.radial", "disk.mesh.circumferential", "time.step", "ground.friction"


@pytest.mark.parametrize("sizes", [(1, 0.5, 0.25), (1, 0.7, 0.4, 0.1)])
@pytest.mark.parametrize("order", [0.7, 1.0, 2.0])
def test_the_order_and_the_limit_of_a_power_law(sizes, order):
    found = converge(sizes, [5 - 3 * h**order for h in sizes])
    np.testing.assert_allclose(found.orders, order, rtol=1e-9)
    assert found.extrapolated == pytest.approx(5, rel=1e-9)
    assert found.bar == pytest.approx(1.25 * 3 * sizes[-1]**order, rel=1e-7)
    assert (found.trouble, found.doubt) == ("", "")


def test_levels_in_any_order():
    assert converge([0.25, 1, 0.5], [0.0625, 1, 0.25]).orders[0] == pytest.approx(2)


@pytest.mark.parametrize("values, trouble", [
    ((189812, 190100, 190094, 190074), "not monotone"), ((1, 2, 2, 3), "not monotone"),
    ((1, 2, 3, 5), "do not shrink"), ((1, 2, 3, 4), "do not shrink"), ((2, 2, 2, 2 + 1e-12), "the same"),
    ((1, 2, math.nan, 3), "not all values are finite")])
def test_what_does_not_converge_has_no_order(values, trouble):
    found = converge([1 / 6, 1 / 12, 1 / 24, 1 / 48], values)
    assert trouble in found.trouble and found.orders == () and math.isnan(found.extrapolated)


def test_orders_that_are_not_believed_have_a_wide_bar():
    high = converge([1, 0.5, 0.25], [1 - 0.5, 1 - 0.5**6, 1 - 0.25**6])
    assert high.orders[0] > 3 and "not that of the method" in high.doubt
    assert high.bar == pytest.approx(3 * abs(high.extrapolated - high.values[-1]))
    differ = converge([1, 0.5, 0.25, 0.125], [0, 1, 1.5, 1.6])
    assert "differ" in differ.doubt


def test_two_levels_are_too_few():
    with pytest.raises(rondo.Error, match="three levels"):
        converge([1, 2], [1, 2])


def study(folder, rows, *keys, together=False):
    path = sweeps.write(folder, [(key, "-", "values") for key in keys], rows)
    if together:
        said = json.loads((path / "sweep.json").read_text())
        for parameter in said["parameters"][1:]:
            parameter["with"] = keys[0]
        (path / "sweep.json").write_text(json.dumps(said))
    return path


def told(path, *more):
    return subprocess.run([sys.executable, "-m", "rondo", "converge", str(path), *more],
                          capture_output=True, text=True)


def meshes(**figures):
    """Levels of 6 to 48 layers; figures: functions of the size."""
    return [{RADIAL: n, ROUND: 15 * n, **{name: f(6 / n) for name, f in figures.items()}}
            for n in (6, 12, 24, 48)]


def test_the_command(tmp_path):
    rows = meshes(force_y_mean=lambda h: 1e5 + 4e3 * h**2, force_x_mean=lambda h: math.sin(9 * h),
                  torque_mean=lambda h: 7.0)
    path = study(tmp_path / "mesh", rows, RADIAL, ROUND, together=True)
    sweep = rondo.open_sweep(path)
    assert sweep.varied == [RADIAL] and sweep.leader_of(ROUND) == RADIAL
    done = told(path)
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    assert lines[0] == f"4 levels, {RADIAL} = 6, 12, 24, 48, with {ROUND}"
    place = lines.index("force_y_mean: 104000, 101000, 100250, 100062.5 N/m")
    assert lines[place + 1] == "    order 2.00, 2.00; extrapolated 100000 ± 78 N/m (0.078 %)"
    assert "not monotone" in lines[[line[:12] for line in lines].index("force_x_mean") + 1]
    assert "the same on all levels" in done.stdout
    assert not any(line.startswith("energy_residual") for line in lines)
    assert told(path, "--figure", "force_y_mean", "torque_mean").returncode == 0
    assert told(path, "--figure", "force_y_mean", "force_x_mean").returncode == 3
    done = told(path, "--figure", "force_z")
    assert done.returncode == 2 and "no column 'force_z'" in done.stderr


def test_each_value_of_what_else_varies_by_itself(tmp_path):
    rows = [{STEP: dt, FRICTION: mu, "force_y_mean": mu + dt} for mu in (0.1, 0.2) for dt in (1.0, 0.5, 0.25)]
    done = told(study(tmp_path / "step", rows, STEP, FRICTION), "--figure", "force_y_mean")
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    assert lines[0::3] == [f"{FRICTION} = 0.1; 3 levels, {STEP} = 1, 0.5, 0.25",
                           f"{FRICTION} = 0.2; 3 levels, {STEP} = 1, 0.5, 0.25"]
    assert "order 1.00; extrapolated 0.1 ±" in lines[2] and "extrapolated 0.2 ±" in lines[5]


def test_what_is_not_refined_alike_or_not_at_all(tmp_path):
    rows = [{RADIAL: n, ROUND: 90 + n, "force_y_mean": 1 / n} for n in (6, 12, 24)]
    done = told(study(tmp_path / "unlike", rows, RADIAL, ROUND, together=True))
    assert done.returncode == 2 and f"{RADIAL} and {ROUND} are not refined alike" in done.stderr
    done = told(study(tmp_path / "two", rows, RADIAL, ROUND))
    assert done.returncode == 2 and "give one with --by KEY" in done.stderr
    rows = [{FRICTION: mu, "force_y_mean": mu} for mu in (0.1, 0.2, 0.3)]
    done = told(study(tmp_path / "none", rows, FRICTION))
    assert done.returncode == 2 and "no key is refined" in done.stderr

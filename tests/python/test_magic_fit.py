# SPDX-License-Identifier: BSD-3-Clause
"""rondo.magic_formula.fit: known coefficients are found again, noise stays noise, what the data do not hold is left
out and named, and without scipy the call says so."""
import sys

import numpy as np
import pytest
from tyre_sets import APPENDIX_3, TABLE_A3_1, appendix_3, table_a3_1

import rondo
from rondo import files
from rondo.magic_formula import evaluate, fit

pytest.importorskip("scipy")

ANGLES = np.radians([-15, -10, -7, -5, -4, -3, -2, -1, -0.5, 0, 0.5, 1, 2, 3, 4, 5, 7, 10, 15])
SLIPS = np.array([-1, -0.5, -0.3, -0.2, -0.12, -0.08, -0.05, -0.03, -0.015, 0, 0.015, 0.03, 0.05, 0.08, 0.12, 0.2, 0.3, 0.5, 1])
NOMINAL = ("FNOMIN", "UNLOADED_RADIUS", "LONGVL", "NOMPRES")
FIXED = {f"QSX{k}" for k in range(4, 10)}  # not fitted


def rows(loads=(1500.0, 3000.0, 4500.0, 6500.0), pressures=(1.8e5, 2.2e5, 2.6e5), cambers=(-5, -2, 0, 2, 5),
         speeds=(8.0, 16.7, 30.0), combined=True):
    """A test rig's sweeps: slip angles, slip ratios, both."""
    found = []
    for load in loads:
        for camber in np.radians(cambers):
            for pressure in pressures:
                found += [(a, 0.0, camber, load, pressure, 16.7) for a in ANGLES]
                found += [(0.0, k, camber, load, pressure, 16.7) for k in SLIPS]
            if combined:
                found += [(a, k, camber, load, 2.2e5, speed) for speed in speeds for a in np.radians([-8, -4, -2, 2, 4, 8])
                          for k in (-0.3, -0.1, -0.05, -0.02, 0.02, 0.05, 0.1, 0.3)]
    names = ("slip_angle", "slip_ratio", "camber", "load", "pressure", "speed")
    return dict(zip(names, np.array(found).T))


def nothing_known(values):
    return files.tir({key: values[key] for key in (*NOMINAL, "PKY4")})


def channels(found, names=("Fx", "Fy", "Mx", "My", "Mz")):
    return {name: getattr(found, name) for name in names}


@pytest.fixture(scope="module")
def whole():
    """All channels of a known tyre, its fit and its coefficients."""
    truth = appendix_3().with_values(dict.fromkeys(FIXED, 0.0))
    states = rows()
    return truth, fit(nothing_known(APPENDIX_3), **states, **channels(evaluate(truth, **states)))


def test_known_coefficients(whole):
    truth, found = whole
    for key in APPENDIX_3:
        assert found.tir.number(key) == pytest.approx(truth.number(key), rel=1e-6, abs=1e-6), key
    assert not found.left and not found.at_bounds and len(found.fitted) > 100
    assert set(APPENDIX_3) - set(NOMINAL) - FIXED - {"PKY4"} <= set(found.fitted)
    for residual in found.residuals.values():
        assert residual.share < 1e-9 and residual.rows == len(rows()["load"])


def test_fit_is_written_and_read(whole, tmp_path):
    _, found = whole
    read = files.read_tir(files.write_tir(tmp_path / "tyre.tir", found.tir))
    states = rows(loads=(2000.0,), pressures=(2e5,))
    for name, values in channels(evaluate(found.tir, **states)).items():
        np.testing.assert_array_equal(getattr(evaluate(read, **states), name), values)
    assert found.lines[0].startswith("Fx: rms ")


def test_other_signs_are_the_same_forces():
    """Table A3.1 has PDY1, RBX2 and RVY6 below 0: the fit finds other coefficients of the same curves."""
    truth = table_a3_1()
    states = rows(pressures=(2.2e5,), speeds=(16.7,))
    of_truth = evaluate(truth, **states)
    found = fit(files.tir({key: TABLE_A3_1[key] for key in NOMINAL}), **states, **channels(of_truth, ("Fx", "Fy", "Mz")))
    assert found.tir["RBX2"] == pytest.approx(10.77, rel=1e-6) and found.tir["PDY1"] == pytest.approx(0.99, rel=1e-6)
    for name, residual in found.residuals.items():
        assert residual.share < 1e-7, name
    assert "pressures" in found.left["PPX1"]


def test_noise_stays_noise():
    """2 % of the rms, seeded: the fit is as far from the data as that, and nearer to the truth."""
    truth, states, rng = appendix_3(), rows(pressures=(2.2e5,), speeds=(16.7,)), np.random.default_rng(2)
    exact = channels(evaluate(truth, **states), ("Fx", "Fy"))
    noisy = {name: values + rng.normal(0, 0.02 * np.sqrt(np.mean(values ** 2)), values.shape) for name, values in exact.items()}
    found = fit(nothing_known(APPENDIX_3), **states, **noisy)
    again = evaluate(found.tir, **states)
    for name, values in exact.items():
        assert found.residuals[name].share == pytest.approx(0.02, rel=0.05)
        assert np.sqrt(np.mean((getattr(again, name) - values) ** 2)) < 0.004 * np.sqrt(np.mean(values ** 2))


def test_what_the_data_do_not_hold():
    """One load, one pressure, no camber, no combined slip."""
    states = rows(loads=(4000.0,), pressures=(2.2e5,), cambers=(0,), combined=False)
    found = fit(nothing_known(APPENDIX_3), **states, **channels(evaluate(appendix_3(), **states), ("Fx", "Fy", "Mz")))
    # Not exact: each slip weakens the small force that the other one has by its shifts, which only combined slip tells.
    for key in ("PCX1", "PDX1", "PEX1", "PEX4", "PKX1", "PHX1", "PVX1"):
        assert found.tir[key] == pytest.approx(APPENDIX_3[key], rel=1e-6, abs=1e-8), key
    assert found.residuals["Fx"].share < 0.003 and found.residuals["Fy"].share < 0.015 and found.residuals["Mz"].share < 0.03
    for key, why in (("PDX2", "two loads"), ("PEX3", "three loads"), ("PPY1", "two pressures"), ("PPX2", "three pressures"),
                     ("PDY3", "no camber"), ("PEY5", "no two sizes of camber"), ("RBX1", "no combined slip"),
                     ("QDZ8", "camber"), ("PKY2", "two loads")):
        assert why in found.left[key], key
        assert found.tir[key] == (1.5 if key == "PKY2" else 0.0)
        assert key not in found.fitted
    assert any(line.startswith("left without influence: ") and "RBX1" in line for line in found.lines)
    # F_y and the arm of F_x are held by the rows of longitudinal slip. Only what was given has changed.
    assert "RVY1" in found.fitted and "RVY4" in found.left and "SSZ1" in found.fitted
    assert "QSX1" not in found.tir and "QSY1" not in found.tir


def test_slip_angles_alone_and_bounds():
    """Without a slip ratio nothing that one makes is fitted; a coefficient that stands at a bound is named."""
    states = {name: values for name, values in rows(pressures=(2.2e5,), combined=False).items()}
    angles = states["slip_ratio"] == 0
    states = {name: values[angles] for name, values in states.items()}
    stiff = appendix_3().with_values({"PKY1": -1500.0})
    found = fit(nothing_known(APPENDIX_3), **states, Fy=evaluate(stiff, **states).Fy)
    assert found.left["RVY1"] == "no slip ratio in the data" and found.left["RVY4"] == "no combined slip in the data"
    assert "PKY1" in found.at_bounds and any("at a bound" in line and "PKY1" in line for line in found.lines)
    softer = fit(nothing_known(APPENDIX_3), **states, Fy=evaluate(appendix_3(), **states).Fy)
    assert not softer.at_bounds and softer.residuals["Fy"].share < 1e-9


def test_what_the_data_do_not_tell_apart():
    """M_x at one slip angle and two loads: two equations for QSX1, QSX3 and QSX13."""
    states = {"slip_angle": np.full(60, 0.05), "load": np.where(np.arange(60) % 2, 2000.0, 6000.0)}
    truth = appendix_3().with_values(dict.fromkeys(FIXED, 0.0))
    found = fit(truth, **states, Mx=evaluate(truth, **states).Mx)
    told = [key for key, why in found.left.items() if "do not tell it from the other coefficients" in why]
    assert len(told) == 1 and told[0] in ("QSX1", "QSX3", "QSX13") and found.tir[told[0]] == 0.0
    assert found.residuals["Mx"].share < 1e-9


def test_gaps_and_other_channels():
    """NaN is not measured; coefficients of channels that are not given stay."""
    states = rows(loads=(2000.0, 4000.0, 6000.0), pressures=(2.2e5,), speeds=(16.7,))
    truth = appendix_3()
    along = np.where(np.arange(len(states["load"])) % 3 == 0, np.nan, evaluate(truth, **states).Fx)
    start = truth.with_values({key: 0.0 for key in APPENDIX_3 if key.startswith(("PCX", "PDX", "PEX", "PKX", "RBX"))})
    found = fit(start, **states, Fx=along)
    assert found.residuals["Fx"].rows == int(np.isfinite(along).sum()) and found.residuals["Fx"].share < 1e-9
    assert found.tir["PKY1"] == truth["PKY1"] and found.tir["PCX1"] == pytest.approx(truth["PCX1"], rel=1e-6)


@pytest.mark.parametrize("fittyp", [6, 62])
def test_other_versions(fittyp):
    values = APPENDIX_3 | ({"PHY3": 0.03, "PKY4": 2.0} if fittyp == 6 else {})
    truth, states = files.tir(values, fittyp), rows(pressures=(2.2e5,), speeds=(16.7,))
    start = files.tir({key: values[key] for key in (*NOMINAL, "PKY4")}, fittyp)
    found = fit(start, **states, **channels(evaluate(truth, **states), ("Fx", "Fy", "Mz")))
    assert max(one.share for one in found.residuals.values()) < 1e-8
    assert ("PHY3" in found.fitted) == (fittyp == 6) and ("PKY6" in found.fitted) == (fittyp == 62)


@pytest.mark.parametrize("change, words", [
    ({}, "without data"), ({"Fx": np.ones(3)}, "shapes of inputs"), ({"Fx": np.ones((2, 2)), "load": np.ones((2, 2))}, "shapes"),
    ({"Fx": np.full(5, np.nan), "load": np.full(5, 4000.0)}, "0 rows of pure longitudinal slip"),
    ({"Fy": np.ones(5), "load": np.full(5, 4000.0), "slip_ratio": np.full(5, 0.3)}, "0 rows of pure slip angle"),
    ({"Fx": np.ones(5), "load": np.full(5, 4000.0), "variant": "x"}, "variant = 'x'")])
def test_refusals(change, words):
    with pytest.raises(rondo.InputError, match=words):
        fit(appendix_3(), **{"load": np.full(5, 4000.0)} | change)


def test_without_scipy(monkeypatch):
    monkeypatch.setitem(sys.modules, "scipy", None)
    with pytest.raises(rondo.Error, match=r"magic_formula.fit\(\) needs the package scipy.*python3-scipy"):
        fit(appendix_3(), load=np.full(5, 4000.0), Fx=np.ones(5))

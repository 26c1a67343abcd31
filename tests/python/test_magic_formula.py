# SPDX-License-Identifier: BSD-3-Clause
"""rondo.magic_formula.evaluate: against numbers that others have published for two public sets of coefficients,
against a sheet of the equations written here equation by equation, limits, mirror images and refusals."""
import math
import warnings

import numpy as np
import pytest
from tyre_sets import APPENDIX_3, TABLE_A3_1, appendix_3, table_a3_1

import rondo
from rondo import files
from rondo.magic_formula import evaluate

# Published by others for the coefficients of table A3.1. Slip ratio, slip angle (rad), load (N): Fx, Fy, Mz, of the tests of
# MiniEngine, a game engine with a tyre model from the book (2nd ed.): engine/tyre, points of tools/tyre_reference. Its
# cosine of the slip angle is that over V + 0.1 m/s (4.E6a), at V = 16.67 m/s.
OF_THE_BOOK = np.array([
    (-0.5, 0.0, 2000.0, -1986.1194085661953, -88.25461910604399, -27.07868352989113),
    (-0.1, 0.0, 2000.0, -2315.7695764992172, -172.57498320459445, -32.969584382954665),
    (0.02, 0.0, 2000.0, 635.4227365044682, 94.75549551368744, 3.8556858457999166),
    (0.1, 0.0, 2000.0, 2275.6199883833046, 206.6903505970036, 28.836133069566205),
    (0.0, -0.10471975511965978, 2000.0, -65.8087042868421, 1969.3428055291329, -19.819270731012516),
    (0.0, 0.03490658503988659, 2000.0, -99.74079869264452, -854.9944968558626, 6.319249122413891),
    (0.05, 0.0, 4000.0, 3377.6156498002474, 207.63171150297202, 39.83838954622067),
    (1.0, 0.0, 4000.0, 3193.9197411244863, 70.38087199204708, 42.728813087217645),
    (0.0, -0.2617993877991494, 4000.0, -31.618926807264177, 4139.999982840628, -3.3848171078081473),
    (0.0, 0.03490658503988659, 4000.0, -149.7934483537755, -1505.522106253814, 31.681607135511516),
    (0.0, 0.10471975511965978, 4000.0, -88.61698738891505, -3346.4349571737075, 39.682185638630685),
    (-0.02, 0.0, 6000.0, -2881.740919765317, 21.745716094432417, -51.90718407848796),
    (0.0, -0.10471975511965978, 6000.0, -83.4902881081162, 4751.3902844544045, -136.99200734264997),
    (0.0, 0.2617993877991494, 6000.0, -24.438901043871496, -5306.947264719752, -8.62405016796792),
    (0.05, 0.03490658503988659, 4000.0, 3026.296411329449, -1291.3060220469745, 57.64499334529745),
    (-0.1, 0.06981317007977318, 4000.0, -3799.446092908455, -2385.4748885373065, -46.947824740532766),
    (-0.3, -0.13962634015954636, 4000.0, -3852.5413913017182, 1712.9103114386708, -44.10867792328077),
    (0.2, -0.20943951023931956, 4000.0, 2970.4907661809034, 2684.4585867385267, 49.3506641569585)])
# Of github.com/teasit/magic-formula-tyre-library (its F_x has the tangent of the slip angle, its pure F_y the angle itself),
# as evaluated by github.com/KMoula30/outlap, crates/outlap-tire/tests/golden. Slip ratio, slip angle, load: Fx or Fy.
ALONG = np.array([(-0.25, -0.17, 4000.0, -3563.509474), (-0.1, 0.034, 4000.0, -4386.012507), (0.05, -0.068, 4000.0, 2717.691781),
                  (0.15, 0.102, 4000.0, 3783.5636), (0.25, 0.17, 4000.0, 3450.343003), (0.0, -0.21, 2000.0, -30.04203835)])
ASIDE = np.array([(0.0, -0.21, 2000.0, 2228.79166), (0.0, -0.0525, 2000.0, 1298.737165), (0.0, 0.105, 2000.0, -1799.707597),
                  (0.0, -0.21, 4000.0, 4120.387869), (0.0, 0.0525, 2000.0, -1210.487715), (0.0, 0.17, 4000.0, -3723.251718)])


def test_published_forces():
    k, a, z, fx, fy, _ = OF_THE_BOOK.T
    found = evaluate(table_a3_1(), slip_ratio=k, slip_angle=a, load=z, variant="pacejka-2012")
    np.testing.assert_allclose(found.Fx, fx, rtol=2e-9)
    np.testing.assert_allclose(found.Fy, fy, rtol=1e-8, atol=1e-5)  # they add small numbers to denominators
    k, a, z, fx = ALONG.T
    np.testing.assert_allclose(evaluate(table_a3_1(), slip_ratio=k, slip_angle=a, load=z, variant="pacejka-2012").Fx, fx, rtol=2e-9)
    k, a, z, fy = ASIDE.T
    np.testing.assert_allclose(evaluate(table_a3_1(), slip_angle=a, load=z).Fy, fy, rtol=1e-8, atol=1e-4)


def test_published_aligning_moments():
    """Without camber: -trail F_y' + residual + arm F_x, whose first two have the cosine."""
    k, a, z, _, _, mz = OF_THE_BOOK.T
    found = evaluate(table_a3_1(), slip_ratio=k, slip_angle=a, load=z, variant="pacejka-2012")
    v = 16.67 / np.cos(a)
    arm = 0.313 * (TABLE_A3_1["SSZ1"] + TABLE_A3_1["SSZ2"] * found.Fy / 4000.0)
    np.testing.assert_allclose((found.Mz - arm * found.Fx) * v / (v + 0.1) + arm * found.Fx, mz, rtol=5e-6, atol=2e-5)


def test_published_forces_with_scale_factors_and_pressure():
    """Coefficients of appendix 3 with a few of its own, scaled, at slip angle and camber, as the test of
    github.com/henrytad/tire_model, tests/test_tire_mf612.cpp, has them; it adds 0.1 N to denominators."""
    tir = appendix_3().with_values({
        "PVX1": 2.20283e-5, "PCY1": 1.337, "PPY4": -0.2811, "LMUX": 1.28, "LKX": 1.22, "LMUY": 1.38, "LKY": 1.28, "LKYC": 1.18,
        "LTR": 0.86, "LYKA": 1.08})
    found = evaluate(tir, slip_angle=math.atan(0.05), slip_ratio=0.06, camber=0.07, load=4000.0, variant="pacejka-2012")
    assert found.Fx == pytest.approx(3902.7354, rel=1e-5)
    assert found.Fy == pytest.approx(-2511.1272, rel=2e-5)


# A second writing of the equations, one state at a time. Besselink, Schmeitz, Pacejka (2010), the appendix; of MF 5.2 the
# manual of PAC2002. Nothing of rondo.magic_formula is used.

def sheet(c, k, a, g, Fz, p=None, V=None, old=False):
    def v(name, usual=0.0):
        return c.get(name, usual)

    def lam(name):
        return c.get(name, 1.0)

    def sgn(x):
        return -1.0 if x < 0 else 1.0

    sin, cos, atan, tan, exp, pi = math.sin, math.cos, math.atan, math.tan, math.exp, math.pi
    Fz0, R0 = v("FNOMIN"), v("UNLOADED_RADIUS")
    V, p0 = v("LONGVL") if V is None else V, v("NOMPRES")
    p = p0 if p is None else p
    Fz0_ = lam("LFZO") * Fz0
    df = (Fz - Fz0_) / Fz0_
    dp = (p - p0) / p0
    gx, gy, gz = (g * lam(name) if old else g for name in ("LGAX", "LGAY", "LGAZ"))
    # longitudinal, pure
    mux = (v("PDX1") + v("PDX2") * df) * (1 + v("PPX3") * dp + v("PPX4") * dp * dp) * (1 - v("PDX3") * gx * gx) * lam("LMUX")
    Kxk = (Fz * (v("PKX1") + v("PKX2") * df) * exp(v("PKX3") * df) * (1 + v("PPX1") * dp + v("PPX2") * dp * dp) * lam("LKX"))
    Cx, Dx = v("PCX1") * lam("LCX"), mux * Fz
    Bx = Kxk / (Cx * Dx)
    kx = k + (v("PHX1") + v("PHX2") * df) * lam("LHX")
    SVx = Fz * (v("PVX1") + v("PVX2") * df) * lam("LVX") * lam("LMUX")
    Ex = (v("PEX1") + v("PEX2") * df + v("PEX3") * df * df) * (1 - v("PEX4") * sgn(kx)) * lam("LEX")
    Fx0 = Dx * sin(Cx * atan(Bx * kx - Ex * (Bx * kx - atan(Bx * kx)))) + SVx

    def lateral(gy):
        muy = ((v("PDY1") + v("PDY2") * df) * (1 + v("PPY3") * dp + v("PPY4") * dp * dp) * (1 - v("PDY3") * gy * gy) * lam("LMUY"))
        Ky0 = (v("PKY1") * Fz0_ * (1 + v("PPY1") * dp) * lam("LKY")
               * sin(v("PKY4", 2.0) * atan(Fz / ((v("PKY2") + v("PKY5") * gy * gy) * (1 + v("PPY2") * dp) * Fz0_))))
        Kya = Ky0 * (1 - v("PKY3") * abs(gy))
        lg = lam("LKYG") if old else lam("LKYC")
        SVyg = Fz * (v("PVY3") + v("PVY4") * df) * gy * lg * lam("LMUY")
        if old:
            SHy = (v("PHY1") + v("PHY2") * df) * lam("LHY") + v("PHY3") * gy * lg
        else:
            Kyg0 = Fz * (v("PKY6") + v("PKY7") * df) * (1 + v("PPY5") * dp) * lg
            SHy = (v("PHY1") + v("PHY2") * df) * lam("LHY") + (Kyg0 * gy - SVyg) / Kya
        SVy = Fz * (v("PVY1") + v("PVY2") * df) * lam("LVY") * lam("LMUY") + SVyg
        ay = a + SHy
        Cy, Dy = v("PCY1") * lam("LCY"), muy * Fz
        By = Kya / (Cy * Dy)
        Ey = min((v("PEY1") + v("PEY2") * df) * (1 + v("PEY5") * gy * gy - (v("PEY3") + v("PEY4") * gy) * sgn(ay)) * lam("LEY"), 1)
        return Dy * sin(Cy * atan(By * ay - Ey * (By * ay - atan(By * ay)))) + SVy, muy, Kya, SHy, SVy, By, Cy

    Fy0, muy, Kya, SHy, SVy, By, Cy = lateral(gy)
    # combined
    Bxa = (v("RBX1") + v("RBX3") * g * g) * cos(atan(v("RBX2") * k)) * lam("LXAL")
    Exa, SHxa, Cxa = v("REX1") + v("REX2") * df, v("RHX1"), v("RCX1")

    def Gx(x):
        return cos(Cxa * atan(Bxa * x - Exa * (Bxa * x - atan(Bxa * x))))

    Fx = Fx0 * Gx(a + SHxa) / Gx(SHxa)

    def Gy(g):
        Byk = (v("RBY1") + v("RBY4") * g * g) * cos(atan(v("RBY2") * (a - v("RBY3")))) * lam("LYKA")
        Eyk, SHyk, Cyk = v("REY1") + v("REY2") * df, v("RHY1") + v("RHY2") * df, v("RCY1")
        one, two = (cos(Cyk * atan(Byk * x - Eyk * (Byk * x - atan(Byk * x)))) for x in (k + SHyk, SHyk))
        return one / two

    DVyk = muy * Fz * (v("RVY1") + v("RVY2") * df + v("RVY3") * g) * cos(atan(v("RVY4") * a))
    SVyk = DVyk * sin(v("RVY5") * atan(v("RVY6") * k)) * lam("LVYKA")
    Fy = Gy(g) * Fy0 + SVyk
    # aligning moment
    at = a + v("QHZ1") + v("QHZ2") * df + (v("QHZ3") + v("QHZ4") * df) * gz
    ar = a + SHy + SVy / Kya
    ate, are = (atan(math.sqrt(tan(x) ** 2 + (Kxk / Kya) ** 2 * k * k)) * sgn(x) for x in (at, ar))
    Bt = (v("QBZ1") + v("QBZ2") * df + v("QBZ3") * df * df) * (1 + v("QBZ4") * gz + v("QBZ5") * abs(gz)) * lam("LKY") / lam("LMUY")
    Ct = v("QCZ1")
    Dt = (Fz * (R0 / Fz0_) * (v("QDZ1") + v("QDZ2") * df) * (1 - v("PPZ1") * dp) * (1 + v("QDZ3") * gz + v("QDZ4") * gz * gz)
          * lam("LTR"))
    Et = min((v("QEZ1") + v("QEZ2") * df + v("QEZ3") * df * df) * (1 + (v("QEZ4") + v("QEZ5") * gz) * 2 / pi * atan(Bt * Ct * at)), 1)
    t = Dt * cos(Ct * atan(Bt * ate - Et * (Bt * ate - atan(Bt * ate)))) * cos(a)
    Br = v("QBZ9") * lam("LKY") / lam("LMUY") + v("QBZ10") * By * Cy
    Dr = Fz * R0 * ((v("QDZ6") + v("QDZ7") * df) * lam("LRES")
                    + ((v("QDZ8") + v("QDZ9") * df) * (1 + v("PPZ2") * dp) + (v("QDZ10") + v("QDZ11") * df) * abs(gz)) * gz
                    * lam("LKZC")) * lam("LMUY") * cos(a)
    Mzr = Dr * cos(atan(Br * are))
    s = R0 * (v("SSZ1") + v("SSZ2") * Fy / Fz0 + (v("SSZ3") + v("SSZ4") * df) * gz) * lam("LS")
    Mz = -t * ((Fy - SVyk) if old else Gy(0.0) * lateral(0.0)[0]) + Mzr + s * Fx
    # overturning, rolling
    f = Fz / Fz0
    Mx = (R0 * Fz * (v("QSX1") * lam("LVMX") - v("QSX2") * g * (1 + v("PPMX1") * dp) - v("QSX12") * g * abs(g) + v("QSX3") * Fy / Fz0
                     + v("QSX4") * cos(v("QSX5") * atan((v("QSX6") * f) ** 2)) * sin(v("QSX7") * g + v("QSX8") * atan(v("QSX9") * Fy / Fz0))
                     + v("QSX10") * atan(v("QSX11") * f) * g) + R0 * Fy * (v("QSX13") + v("QSX14") * abs(g))) * lam("LMX")
    w = V / v("LONGVL")
    rolling = v("QSY1") + v("QSY2") * Fx / Fz0 + v("QSY3") * abs(w) + v("QSY4") * w ** 4
    if old:
        My = -R0 * Fz * rolling * lam("LMY")
    else:
        rolling += (v("QSY5") + v("QSY6") * f) * g * g
        My = -R0 * Fz0 * rolling * f ** v("QSY7", 1.0) * (p / p0) ** v("QSY8") * lam("LMY")
    return Fx, Fy, Mx, My, Mz, t, Mzr


EXTRA = {"QSX12": 0.7, "QSX13": 0.02, "QSX14": -0.3, "QBZ3": 0.4, "QBZ10": 0.03, "QDZ4": 2.0, "QDZ10": 0.4, "QDZ11": -0.2,
         "QEZ3": -0.3, "PPZ2": 0.6, "PPY5": 0.3, "PPMX1": -0.5, "PDX3": 0.8, "PDY3": 1.1, "PEX3": 0.1, "PEY5": 0.9, "PKY5": 0.4,
         "RBX3": 3.0, "RBY4": -2.0, "RVY3": 0.3, "SSZ3": 0.2, "SSZ4": -0.1, "QSY2": 0.1, "QSY5": 0.2, "QSY6": -0.1}
SCALES = {"LFZO": 1.1, "LCX": 1.05, "LMUX": 0.9, "LEX": 1.2, "LKX": 0.95, "LHX": 1.3, "LVX": 0.7, "LCY": 0.96, "LMUY": 1.1,
          "LEY": 0.9, "LKY": 1.08, "LKYC": 0.8, "LKZC": 1.2, "LHY": 0.6, "LVY": 1.4, "LTR": 0.9, "LRES": 1.1, "LXAL": 1.05,
          "LYKA": 0.92, "LVYKA": 1.15, "LS": 0.85, "LMX": 1.1, "LVMX": 0.9, "LMY": 1.2}
OLD = {"PHY3": 0.03, "LGAX": 1.1, "LGAY": 0.9, "LGAZ": 1.2, "LKYG": 0.8, "PDX3": 0.8, "PDY3": 1.1}


@pytest.mark.parametrize("values, fittyp", [
    (TABLE_A3_1, 61), (APPENDIX_3, 61), (APPENDIX_3 | EXTRA, 62), (APPENDIX_3 | EXTRA | SCALES, 61),
    (APPENDIX_3 | OLD, 6), (APPENDIX_3 | SCALES | OLD, 6)])
def test_against_a_sheet_of_the_equations(values, fittyp):
    rng = np.random.default_rng(11)
    states = np.stack([rng.uniform(-0.8, 0.8, 200), rng.uniform(-0.35, 0.35, 200), rng.uniform(-0.12, 0.12, 200),
                       rng.uniform(500, 9000, 200), rng.uniform(1.6e5, 2.8e5, 200), rng.uniform(3, 60, 200)])
    k, a, g, z, p, v = states
    found = evaluate(files.tir(values, fittyp), slip_ratio=k, slip_angle=a, camber=g, load=z, pressure=p, speed=v)
    expected = np.array([sheet(values, *state[:4], state[4], state[5], fittyp == 6) for state in states.T]).T
    for name, column in zip(("Fx", "Fy", "Mx", "My", "Mz", "trail", "residual_moment"), expected):
        np.testing.assert_allclose(getattr(found, name), column, rtol=1e-11, atol=1e-11 * np.abs(column).max(), err_msg=name)


def test_signs_and_slopes():
    """ISO-W: to the left, pushed to the right; K are the slopes of the pure curves where the shifted slip is 0."""
    tir = appendix_3()
    left = evaluate(tir, slip_angle=0.05)
    assert left.Fy < 0 < left.Mz and left.trail > 0 and left.My < 0
    assert evaluate(tir, slip_ratio=0.05).Fx > 0 > evaluate(tir, slip_ratio=-0.05).Fx
    assert evaluate(tir, camber=0.05).Fy < evaluate(tir).Fy  # leans to the right, pushed to the right
    flat = tir.with_values(dict.fromkeys(["PHX1", "PHX2", "PVX1", "PVX2", "PHY1", "PHY2", "PVY1", "PVY2", "RHX1", "RHY1", "RHY2"], 0.0))
    for load in (2000.0, 4000.0, 7000.0):
        h = 1e-6
        for what, force, stiffness in (("slip_ratio", "Fx", "slip_stiffness"), ("slip_angle", "Fy", "cornering_stiffness"),
                                       ("camber", "Fy", "camber_stiffness")):
            two = [evaluate(flat, load=load, **{what: x}) for x in (-h, h)]
            slope = (getattr(two[1], force) - getattr(two[0], force)) / (2 * h)
            assert slope == pytest.approx(getattr(evaluate(flat, load=load), stiffness), rel=1e-5), what


def test_both_variants_are_one_at_small_angles():
    tir = appendix_3()
    ways = [evaluate(tir, slip_angle=[1e-3, -2e-3], slip_ratio=[0.01, 0.02], camber=[1e-4, -1e-4], variant=variant)
            for variant in ("besselink-2010", "pacejka-2012")]
    for name in ("Fx", "Fy", "Mz"):
        np.testing.assert_allclose(getattr(ways[0], name), getattr(ways[1], name), rtol=2e-3)
    apart = [evaluate(tir, slip_angle=0.3, variant=variant).Fy for variant in ("besselink-2010", "pacejka-2012")]
    assert apart[0] != apart[1]


def test_shapes_and_no_load():
    tir = appendix_3()
    grid = evaluate(tir, slip_angle=np.zeros((3, 1)) + 0.02, load=np.array([0.0, 1000.0, 4000.0, 8000.0]))
    assert grid.Fy.shape == (3, 4) and evaluate(tir).Fy.shape == ()
    for name in ("Fx", "Fy", "Mx", "My", "Mz", "trail"):
        assert (getattr(grid, name)[:, 0] == 0).all(), name
    assert all(np.isfinite(getattr(grid, name)).all() for name in grid.__dataclass_fields__)


def test_mirror_images():
    tir = appendix_3().with_values({"TYRESIDE": "LEFT"})
    states = {"slip_angle": 0.05, "slip_ratio": 0.03, "camber": 0.04}
    same, other = evaluate(tir, side="left", **states), evaluate(tir, side="right", slip_angle=-0.05, slip_ratio=0.03, camber=-0.04)
    assert same == evaluate(tir, **states)
    assert (other.Fx, other.Fy, other.Mx, other.My, other.Mz) == (same.Fx, -same.Fy, -same.Mx, same.My, -same.Mz)
    with pytest.raises(rondo.InputError, match="side = 'front'"):
        evaluate(tir, side="front")
    with pytest.raises(rondo.InputError, match="TYRESIDE of the file is missing"):
        evaluate(appendix_3(), side="left")


def test_ranges_of_the_file_are_warned_of():
    tir = appendix_3().with_values({"ALPMIN": -0.2, "ALPMAX": 0.2, "FZMIN": 500.0, "FZMAX": 8000.0})
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        evaluate(tir, slip_angle=[-0.2, 0.2], load=8000.0)
    with pytest.warns(UserWarning, match="slip_angle: 1 of 2 values are beyond the range of the file, -0.2 to 0.2 rad"):
        evaluate(tir, slip_angle=[0.1, 0.3])
    with pytest.warns(UserWarning, match="load: .* 500 to 8000 N"):
        evaluate(tir, load=100.0)


def test_combined_slip_without_coefficients_is_warned_of():
    pure = appendix_3().with_values(dict.fromkeys([key for key in APPENDIX_3 if key[0] == "R"], 0.0))
    with pytest.warns(UserWarning, match="no coefficients of it .* too large"):
        found = evaluate(pure, slip_angle=0.05, slip_ratio=0.05)
    assert found.Fx == evaluate(pure, slip_ratio=0.05).Fx
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        evaluate(pure, slip_angle=[0.05, 0.0], slip_ratio=[0.0, 0.05])
        evaluate(appendix_3(), slip_angle=0.05, slip_ratio=0.05)
    with pytest.warns(UserWarning, match="friction ellipse"):
        evaluate(appendix_3().with_values({"FE_METHOD": "YES"}), slip_angle=0.05, slip_ratio=0.05)


@pytest.mark.parametrize("inputs, words", [
    ({"load": -1.0}, "load = -1"), ({"speed": 0.0}, "speed = 0"), ({"slip_angle": 1.6}, "within pi/2 of 0"),
    ({"slip_angle": np.nan}, "not finite at 1 of 1"), ({"slip_angle": [1, 2], "load": [1, 2, 3]}, "do not go together"),
    ({"slip_ratio": "fast"}, "do not go together"), ({"variant": "magic"}, "variant = 'magic'")])
def test_refusals(inputs, words):
    with pytest.raises(rondo.InputError, match=words):
        evaluate(appendix_3(), **inputs)


def test_refusals_of_files():
    without = {key: value for key, value in APPENDIX_3.items() if key != "NOMPRES"}
    with pytest.raises(rondo.InputError, match="no nominal one"):
        evaluate(files.tir(without), pressure=2e5)
    with pytest.raises(rondo.InputError, match="USE_MODE = -14"):
        evaluate(appendix_3().with_values({"USE_MODE": -14.0}))


def test_names_of_pac2002(tmp_path):
    """Its own names for the influence of pressure, and a file written and read in between."""
    named = {("QPZ1" if key == "PPZ1" else key): value for key, value in APPENDIX_3.items()}
    files.write_tir(tmp_path / "a.tir", files.tir(named, 6))
    states = {"slip_angle": 0.05, "pressure": 2.6e5}
    assert evaluate(files.read_tir(tmp_path / "a.tir"), **states).Mz == evaluate(files.tir(APPENDIX_3, 6), **states).Mz

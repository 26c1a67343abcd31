# SPDX-License-Identifier: BSD-3-Clause
"""What a fit of the Magic Formula finds: coefficients in stages, with starting values, bounds and what the data
must vary to hold them."""
from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Key:
    """A coefficient. needs: quantities that must take several values: "z" load, "p" pressure, "c" size of the camber,
    "v" speed; a letter twice: three values or more, of camber two sizes beside none. "k": a slip ratio beside 0, "b":
    one together with a slip angle."""

    name: str
    start: float
    low: float
    high: float
    needs: str = ""


@dataclass(frozen=True)
class Stage:
    """Coefficients of one channel that are found together, from the rows that `rows` names: "pure" (no slip of the
    other kind, no camber), "cambered" (no slip of the other kind) or "all"."""

    channel: str
    name: str
    rows: str
    keys: tuple[Key, ...]
    tries: tuple[tuple[tuple[str, float], ...], ...] = ((),)  # other starting values, one after another


def _keys(*rows: tuple[str, float, float, float] | tuple[str, float, float, float, str]) -> tuple[Key, ...]:
    return tuple(Key(*row) for row in rows)


_CURVES = tuple((("PCX1", shape), ("PEX1", bend)) for shape, bend in ((1.6, 0.0), (1.3, -1.0), (1.8, 0.5)))
_LATERAL_CURVES = tuple((("PCY1", shape), ("PEY1", bend)) for shape, bend in ((1.3, -1.0), (1.6, 0.0), (1.2, 0.3)))
_TRAILS = tuple((("QBZ1", slope), ("QCZ1", shape), ("QEZ1", bend))
                for slope, shape, bend in ((10.0, 1.2, -1.5), (8.0, 1.1, -3.0), (15.0, 1.4, 0.0)))
_INDUCED = tuple((("RVY5", shape), ("RVY6", slope), ("RVY4", fall))
                 for shape, slope, fall in ((1.9, 20.0, 50.0), (1.5, 10.0, 10.0), (1.9, 5.0, 100.0)))

STAGES: tuple[Stage, ...] = (
    Stage("Fx", "pure longitudinal slip", "pure", _keys(
        ("PCX1", 1.6, 0.5, 3.0), ("PDX1", 1.0, 0.01, 10.0), ("PDX2", 0.0, -3.0, 3.0, "z"),
        ("PEX1", 0.0, -50.0, 1.0), ("PEX2", 0.0, -50.0, 50.0, "z"), ("PEX3", 0.0, -50.0, 50.0, "zz"),
        ("PEX4", 0.0, -1.0, 1.0), ("PKX1", 20.0, 0.1, 1000.0), ("PKX2", 0.0, -500.0, 500.0, "z"),
        ("PKX3", 0.0, -5.0, 5.0, "zz"), ("PHX1", 0.0, -0.2, 0.2), ("PHX2", 0.0, -0.2, 0.2, "z"),
        ("PVX1", 0.0, -0.5, 0.5), ("PVX2", 0.0, -0.5, 0.5, "z"), ("PPX1", 0.0, -10.0, 10.0, "p"),
        ("PPX2", 0.0, -10.0, 10.0, "pp"), ("PPX3", 0.0, -10.0, 10.0, "p"), ("PPX4", 0.0, -10.0, 10.0, "pp")), _CURVES),
    Stage("Fx", "longitudinal slip with camber", "cambered", _keys(("PDX3", 0.0, -200.0, 200.0, "c"))),
    Stage("Fx", "combined slip", "all", _keys(
        ("RBX1", 10.0, 0.1, 500.0, "b"), ("RBX2", 8.0, 0.0, 500.0, "b"), ("RBX3", 0.0, -5000.0, 5000.0, "bc"),
        ("RCX1", 1.0, 0.3, 3.0, "b"), ("REX1", 0.0, -50.0, 1.0, "b"), ("REX2", 0.0, -50.0, 50.0, "bz"),
        ("RHX1", 0.0, -0.2, 0.2, "b")),
          ((), (("RBX2", 1.0),), (("RBX1", 20.0), ("RCX1", 1.2)))),
    Stage("Fy", "pure slip angle", "pure", _keys(
        ("PCY1", 1.3, 0.5, 3.0), ("PDY1", 1.0, 0.01, 10.0), ("PDY2", 0.0, -3.0, 3.0, "z"),
        ("PEY1", -1.0, -50.0, 1.0), ("PEY2", 0.0, -50.0, 50.0, "z"), ("PEY3", 0.0, -10.0, 10.0),
        ("PKY1", -15.0, -1000.0, -0.1), ("PKY2", 1.5, 0.05, 50.0, "z"), ("PHY1", 0.0, -0.2, 0.2),
        ("PHY2", 0.0, -0.2, 0.2, "z"), ("PVY1", 0.0, -0.5, 0.5), ("PVY2", 0.0, -0.5, 0.5, "z"),
        ("PPY1", 0.0, -10.0, 10.0, "p"), ("PPY2", 0.0, -10.0, 10.0, "pz"), ("PPY3", 0.0, -10.0, 10.0, "p"),
        ("PPY4", 0.0, -10.0, 10.0, "pp")), _LATERAL_CURVES),
    Stage("Fy", "slip angle with camber", "cambered", _keys(
        ("PDY3", 0.0, -200.0, 200.0, "c"), ("PEY4", 0.0, -200.0, 200.0, "c"), ("PEY5", 0.0, -1000.0, 1000.0, "cc"),
        ("PKY3", 0.0, -20.0, 20.0, "c"), ("PKY5", 0.0, -200.0, 200.0, "ccz"), ("PKY6", -1.0, -50.0, 50.0, "c"),
        ("PKY7", 0.0, -50.0, 50.0, "cz"), ("PVY3", 0.0, -20.0, 20.0, "c"), ("PVY4", 0.0, -20.0, 20.0, "cz"),
        ("PPY5", 0.0, -20.0, 20.0, "cp"), ("PHY3", 0.0, -5.0, 5.0, "c"))),
    Stage("Fy", "combined slip", "all", _keys(
        ("RBY1", 10.0, 0.1, 500.0, "b"), ("RBY2", 8.0, 0.0, 500.0, "b"), ("RBY3", 0.0, -0.2, 0.2, "b"),
        ("RBY4", 0.0, -5000.0, 5000.0, "bc"), ("RCY1", 1.0, 0.3, 3.0, "b"), ("REY1", 0.0, -50.0, 1.0, "b"),
        ("REY2", 0.0, -50.0, 50.0, "bz"), ("RHY1", 0.0, -0.2, 0.2, "b"), ("RHY2", 0.0, -0.2, 0.2, "bz"),
        ("RVY1", 0.0, -5.0, 5.0, "k"), ("RVY2", 0.0, -5.0, 5.0, "kz"), ("RVY3", 0.0, -50.0, 50.0, "kc"),
        ("RVY4", 50.0, 0.0, 1000.0, "b"), ("RVY5", 1.9, 0.1, 10.0, "k"), ("RVY6", 20.0, 0.1, 500.0, "k")),
          _INDUCED),
    Stage("Mz", "pure slip angle", "pure", _keys(
        ("QBZ1", 10.0, 0.1, 500.0), ("QBZ2", 0.0, -500.0, 500.0, "z"), ("QBZ3", 0.0, -500.0, 500.0, "zz"),
        ("QBZ9", 15.0, 0.0, 1000.0), ("QBZ10", 0.0, -50.0, 50.0, "z"), ("QCZ1", 1.2, 0.3, 3.0),
        ("QDZ1", 0.1, -1.0, 1.0), ("QDZ2", 0.0, -1.0, 1.0, "z"), ("QDZ6", 0.0, -0.5, 0.5),
        ("QDZ7", 0.0, -0.5, 0.5, "z"), ("QEZ1", -1.5, -100.0, 1.0), ("QEZ2", 0.0, -100.0, 100.0, "z"),
        ("QEZ3", 0.0, -100.0, 100.0, "zz"), ("QEZ4", 0.0, -10.0, 10.0), ("QHZ1", 0.0, -0.2, 0.2),
        ("QHZ2", 0.0, -0.2, 0.2, "z"), ("PPZ1", 0.0, -10.0, 10.0, "p")), _TRAILS),
    Stage("Mz", "slip angle with camber", "cambered", _keys(
        ("QBZ4", 0.0, -50.0, 50.0, "c"), ("QBZ5", 0.0, -50.0, 50.0, "c"), ("QDZ3", 0.0, -50.0, 50.0, "c"),
        ("QDZ4", 0.0, -500.0, 500.0, "c"), ("QDZ8", 0.0, -10.0, 10.0, "c"), ("QDZ9", 0.0, -10.0, 10.0, "cz"),
        ("QDZ10", 0.0, -100.0, 100.0, "cc"), ("QDZ11", 0.0, -100.0, 100.0, "ccz"), ("QEZ5", 0.0, -50.0, 50.0, "c"),
        ("QHZ3", 0.0, -5.0, 5.0, "c"), ("QHZ4", 0.0, -5.0, 5.0, "cz"), ("PPZ2", 0.0, -10.0, 10.0, "cp"))),
    Stage("Mz", "combined slip", "all", _keys(
        ("SSZ1", 0.0, -1.0, 1.0, "k"), ("SSZ2", 0.0, -1.0, 1.0, "k"), ("SSZ3", 0.0, -20.0, 20.0, "kc"),
        ("SSZ4", 0.0, -20.0, 20.0, "kcz"))),
    Stage("Mx", "overturning", "all", _keys(
        ("QSX1", 0.0, -1.0, 1.0), ("QSX2", 1.0, -20.0, 20.0, "c"), ("QSX3", 0.0, -5.0, 5.0),
        ("QSX10", 0.0, -20.0, 20.0, "czz"), ("QSX11", 1.0, 0.01, 100.0, "czz"), ("QSX12", 0.0, -50.0, 50.0, "cc"),
        ("QSX13", 0.0, -5.0, 5.0, "z"), ("QSX14", 0.0, -50.0, 50.0, "c"), ("PPMX1", 0.0, -10.0, 10.0, "cp")),
          ((), (("QSX10", 0.5),), (("QSX10", 0.5), ("QSX11", 5.0)))),
    Stage("My", "rolling resistance", "all", _keys(
        ("QSY1", 0.01, -0.5, 0.5), ("QSY2", 0.0, -5.0, 5.0), ("QSY3", 0.0, -0.5, 0.5, "v"),
        ("QSY4", 0.0, -0.5, 0.5, "vv"), ("QSY5", 0.0, -5.0, 5.0, "c"), ("QSY6", 0.0, -5.0, 5.0, "cz"),
        ("QSY7", 1.0, -3.0, 5.0, "z"), ("QSY8", 0.0, -5.0, 5.0, "p"))))

ONLY_OLD = frozenset({"PHY3"})  # of MF 5.2, which does not have those below
NOT_OLD = frozenset({"PEY5", "PKY5", "PKY6", "PKY7", "PPY5", "QDZ10", "QDZ11", "RBX3", "RBY4", "QSX12", "QSX13",
                     "QSX14", "QSY5", "QSY6", "QSY7", "QSY8"})
NEUTRAL = {"PKY2": 1.5, "QSY7": 1.0}  # what stands for "not known", where that is not 0

# SPDX-License-Identifier: BSD-3-Clause
"""Sections and keys of .tir files of the Magic Formula in the order of the format, the dimension of those that
have one, and what a key is where a file does not have it.

Sources: Besselink, Schmeitz, Pacejka, An improved Magic Formula/Swift tyre model that can handle inflation
pressure changes, Vehicle System Dynamics 48 (2010) S1; Pacejka, Tire and Vehicle Dynamics, 3rd ed. (2012),
section 4.3 and appendix 3."""
from __future__ import annotations


def _numbered(stem: str, *numbers: int) -> list[str]:
    return [f"{stem}{k}" for k in numbers]


def _range(stem: str, last: int, first: int = 1) -> list[str]:
    return _numbered(stem, *range(first, last + 1))


# Dimensions: powers of length, force, mass, time, as [UNITS] has them.
_L, _F, _M, _T = ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))
_SPEED, _PRESSURE, _RATE, _DAMPING = (1, 0, 0, -1), (-2, 1, 0, 0), (-1, 1, 0, 0), (-1, 1, 0, 1)
_INERTIA, _TURNING, _GRAVITY = (2, 0, 1, 0), (1, 1, 0, 0), (1, 0, 0, -2)
Dimension = tuple[int, int, int, int]
_FREQUENCIES = ["FREQ_LONG", "FREQ_LAT", "FREQ_YAW", "FREQ_WINDUP"]

DIMENSIONS: dict[str, Dimension] = {
    "LONGVL": _SPEED, "VXLOW": _SPEED, "UNLOADED_RADIUS": _L, "WIDTH": _L, "RIM_RADIUS": _L, "RIM_WIDTH": _L,
    "INFLPRES": _PRESSURE, "NOMPRES": _PRESSURE, "PRESMIN": _PRESSURE, "PRESMAX": _PRESSURE, "IP": _PRESSURE,
    "IP_NOM": _PRESSURE, "MASS": _M, "IXX": _INERTIA, "IYY": _INERTIA, "BELT_MASS": _M, "BELT_IXX": _INERTIA,
    "BELT_IYY": _INERTIA, "GRAVITY": _GRAVITY, "FNOMIN": _F, "VERTICAL_STIFFNESS": _RATE, "VERTICAL_DAMPING": _DAMPING,
    "BOTTOM_OFFST": _L, "BOTTOM_STIFF": _RATE, "LONGITUDINAL_STIFFNESS": _RATE, "LATERAL_STIFFNESS": _RATE,
    "YAW_STIFFNESS": _TURNING, "FZMIN": _F, "FZMAX": _F, "MBELT": _M, "ELLIPS_MAX_STEP": _L,
    **dict.fromkeys(_FREQUENCIES, (0, 0, 0, -1))}

_HEADER = ["FILE_TYPE", "FILE_VERSION", "FILE_FORMAT"]
_UNITS = ["LENGTH", "FORCE", "ANGLE", "MASS", "TIME"]
_LONGITUDINAL = (["PCX1", *_range("PDX", 3), *_range("PEX", 4), *_range("PKX", 3), *_range("PHX", 2), *_range("PVX", 2),
                  *_range("RBX", 3), "RCX1", *_range("REX", 2), "RHX1", *_range("PPX", 4), *_range("PTX", 3)])
_LATERAL = (["PCY1", *_range("PDY", 3), *_range("PEY", 5), *_range("PKY", 7), *_range("PHY", 3), *_range("PVY", 4),
             *_range("RBY", 4), "RCY1", *_range("REY", 2), *_range("RHY", 2), *_range("RVY", 6), *_range("PPY", 5),
             *_range("PTY", 2)])
_ALIGNING = ([*_range("QBZ", 5), *_range("QBZ", 10, 9), "QCZ1", *_range("QDZ", 4), *_range("QDZ", 11, 6),
              *_range("QEZ", 5), *_range("QHZ", 4), *_range("SSZ", 4), *_range("PPZ", 2), *_range("QPZ", 2)])
_GYROSCOPIC = ["QTZ1", "MBELT"]
_TURN_SLIP = ([*_range("PDXP", 3), "PKYP1", *_range("PDYP", 4), *_range("PHYP", 4), *_range("PECP", 2), "QDTP1",
               *_range("QCRP", 2), "QBRP1", *_range("QDRP", 2)])
_SCALING = ["LFZO", "LCX", "LMUX", "LEX", "LKX", "LHX", "LVX", "LGAX", "LCY", "LMUY", "LEY", "LKY", "LKYC", "LKZC",
            "LHY", "LVY", "LGAY", "LKYG", "LTR", "LRES", "LGAZ", "LXAL", "LYKA", "LVYKA", "LS", "LSGKP", "LSGAL", "LCZ",
            "LGYR", "LMX", "LVMX", "LMY", "LMP"]

SECTIONS: dict[str, list[str]] = {
    "MDI_HEADER": _HEADER,
    "UNITS": _UNITS,
    "MODEL": ["PROPERTY_FILE_FORMAT", "FITTYP", "USE_MODE", "FE_METHOD", "TYRESIDE", "LONGVL", "VXLOW",
              "ROAD_INCREMENT", "ROAD_DIRECTION", "HMAX_LOCAL", "TIME_SWITCH_INTEG", "SWITCH_INTEG", "MESSAGES"],
    "DIMENSION": ["UNLOADED_RADIUS", "WIDTH", "RIM_RADIUS", "RIM_WIDTH", "ASPECT_RATIO"],
    "OPERATING_CONDITIONS": ["INFLPRES", "NOMPRES", "IP", "IP_NOM"],
    "INERTIA": ["MASS", "IXX", "IYY", "BELT_MASS", "BELT_IXX", "BELT_IYY", "GRAVITY"],
    "VERTICAL": ["FNOMIN", "VERTICAL_STIFFNESS", "VERTICAL_DAMPING", "MC_CONTOUR_A", "MC_CONTOUR_B", "BREFF", "DREFF",
                 "FREFF", "Q_RE0", "Q_V1", "Q_V2", *_range("Q_FZ", 3), *_range("QFZ", 3), "Q_FCX", "Q_FCY", "Q_FCY2",
                 "Q_CAM", *_range("Q_CAM", 3), *_range("Q_FYS", 3), "PFZ1", "QPFZ1", "BOTTOM_OFFST", "BOTTOM_STIFF"],
    "STRUCTURAL": ["LONGITUDINAL_STIFFNESS", "LATERAL_STIFFNESS", "YAW_STIFFNESS", *_FREQUENCIES, "DAMP_LONG",
                   "DAMP_LAT", "DAMP_YAW", "DAMP_WINDUP", "DAMP_RESIDUAL", "DAMP_VLOW", "Q_BVX", "Q_BVT",
                   *_range("PCFX", 3), *_range("PCFY", 3), "PCMZ1"],
    "CONTACT_PATCH": [*_range("Q_RA", 2), *_range("Q_RB", 2), "ELLIPS_SHIFT", "ELLIPS_LENGTH", "ELLIPS_HEIGHT",
                      "ELLIPS_ORDER", "ELLIPS_MAX_STEP", "ELLIPS_NWIDTH", "ELLIPS_NLENGTH", *_range("ENV_C", 2)],
    "LONG_SLIP_RANGE": ["KPUMIN", "KPUMAX"],
    "SLIP_ANGLE_RANGE": ["ALPMIN", "ALPMAX"],
    "INCLINATION_ANGLE_RANGE": ["CAMMIN", "CAMMAX"],
    "VERTICAL_FORCE_RANGE": ["FZMIN", "FZMAX"],
    "INFLATION_PRESSURE_RANGE": ["PRESMIN", "PRESMAX"],
    "SCALING_COEFFICIENTS": _SCALING,
    "LONGITUDINAL_COEFFICIENTS": _LONGITUDINAL,
    "OVERTURNING_COEFFICIENTS": [*_range("QSX", 14), "PPMX1", "QPX1"],
    "LATERAL_COEFFICIENTS": _LATERAL,
    "ROLLING_COEFFICIENTS": _range("QSY", 8),
    "ALIGNING_COEFFICIENTS": [*_ALIGNING, *_GYROSCOPIC],
    "TURNSLIP_COEFFICIENTS": _TURN_SLIP}

TEXTS = {"FILE_TYPE", "FILE_FORMAT", "PROPERTY_FILE_FORMAT", "FE_METHOD", "TYRESIDE", "ROAD_DIRECTION", "MESSAGES",
         *_UNITS}  # words, of UNITS too
COEFFICIENTS = frozenset(key for section in ("SCALING_COEFFICIENTS", "LONGITUDINAL_COEFFICIENTS",
                                             "OVERTURNING_COEFFICIENTS", "LATERAL_COEFFICIENTS", "ROLLING_COEFFICIENTS",
                                             "ALIGNING_COEFFICIENTS", "TURNSLIP_COEFFICIENTS")
                         for key in SECTIONS[section])
SECTION_OF: dict[str, str] = {key: section for section, keys in reversed(SECTIONS.items()) if section != "UNITS"
                              for key in keys}
# Not 0: scale factors, and what the first versions had as numbers in the formulas.
DEFAULTS: dict[str, float] = {**dict.fromkeys(_SCALING, 1.0), "PKY4": 2.0, "QSY7": 1.0}

# SPDX-License-Identifier: BSD-3-Clause
"""Coefficients of two tyres as published, numbers only, and forces that others have computed from them."""
from rondo import files

# Pacejka, Tyre and Vehicle Dynamics, 2nd ed. (2006), appendix 3, table A3.1: 205/60R15 91V at 2.2 bar, ISO signs.
TABLE_A3_1 = {
    "FNOMIN": 4000.0, "UNLOADED_RADIUS": 0.313, "LONGVL": 16.67, "NOMPRES": 2.2e5,
    "PCX1": 1.685, "PDX1": 1.210, "PDX2": -0.037, "PEX1": 0.344, "PEX2": 0.095, "PEX3": -0.020, "PEX4": 0.0,
    "PKX1": 21.51, "PKX2": -0.163, "PKX3": 0.245, "PHX1": -0.002, "PHX2": 0.002, "PVX1": 0.0, "PVX2": 0.0,
    "RBX1": 12.35, "RBX2": -10.77, "RBX3": 0.0, "RCX1": 1.092, "RHX1": 0.007,
    "PCY1": 1.193, "PDY1": -0.990, "PDY2": 0.145, "PDY3": -11.23, "PEY1": -1.003, "PEY2": -0.537, "PEY3": -0.083,
    "PEY4": -4.787, "PKY1": -14.95, "PKY2": 2.130, "PKY3": -0.028, "PKY4": 2.0, "PKY5": 0.0, "PKY6": -0.92,
    "PKY7": -0.24, "PHY1": 0.003, "PHY2": -0.001, "PVY1": 0.045, "PVY2": -0.024, "PVY3": -0.532, "PVY4": 0.039,
    "RBY1": 6.461, "RBY2": 4.196, "RBY3": -0.015, "RBY4": 0.0, "RCY1": 1.081, "RHY1": 0.009, "RVY1": 0.053,
    "RVY2": -0.073, "RVY3": 0.517, "RVY4": 35.44, "RVY5": 1.9, "RVY6": -10.71,
    "QBZ1": 8.964, "QBZ2": -1.106, "QBZ3": -0.842, "QBZ5": -0.227, "QBZ9": 18.47, "QBZ10": 0.0, "QCZ1": 1.180,
    "QDZ1": 0.100, "QDZ2": -0.001, "QDZ3": 0.007, "QDZ4": 13.05, "QDZ6": -0.008, "QDZ7": 0.0, "QDZ8": -0.296,
    "QDZ9": -0.009, "QEZ1": -1.609, "QEZ2": -0.359, "QEZ4": 0.174, "QEZ5": -0.896, "QHZ1": 0.007, "QHZ2": -0.002,
    "QHZ3": 0.147, "QHZ4": 0.004, "SSZ1": 0.043, "SSZ2": 0.001, "SSZ3": 0.731, "SSZ4": -0.238, "QSY1": 0.01}

# The same, 3rd ed. (2012), appendix 3: 205/60R15 91V with the influence of the inflation pressure.
APPENDIX_3 = {
    "FNOMIN": 4000.0, "UNLOADED_RADIUS": 0.3135, "LONGVL": 16.7, "NOMPRES": 2.2e5,
    "PCX1": 1.579, "PDX1": 1.0422, "PDX2": -0.08285, "PDX3": 0.0, "PEX1": 0.11113, "PEX2": 0.3143, "PEX3": 0.0,
    "PEX4": 0.001719, "PKX1": 21.687, "PKX2": 13.728, "PKX3": -0.4098, "PHX1": 2.1615e-4, "PHX2": 0.0011598,
    "PVX1": 2.0283e-5, "PVX2": 1.0568e-4, "PPX1": -0.3485, "PPX2": 0.37824, "PPX3": -0.09603, "PPX4": 0.06518,
    "RBX1": 13.046, "RBX2": 9.718, "RBX3": 0.0, "RCX1": 0.9995, "REX1": -0.4403, "REX2": -0.4663, "RHX1": -9.968e-5,
    "QSX1": -0.007764, "QSX2": 1.1915, "QSX3": 0.013948, "QSX4": 4.912, "QSX5": 1.02, "QSX6": 22.83, "QSX7": 0.7104,
    "QSX8": -0.023393, "QSX9": 0.6581, "QSX10": 0.2824, "QSX11": 5.349, "PPMX1": 0.0,
    "PCY1": 1.338, "PDY1": 0.8785, "PDY2": -0.06452, "PDY3": 0.0, "PEY1": -0.8057, "PEY2": -0.6046, "PEY3": 0.09854,
    "PEY4": -6.697, "PEY5": 0.0, "PKY1": -15.324, "PKY2": 1.715, "PKY3": 0.3695, "PKY4": 2.0005, "PKY5": 0.0,
    "PKY6": -0.8987, "PKY7": -0.23303, "PHY1": -0.001806, "PHY2": 0.00352, "PVY1": -0.00661, "PVY2": 0.03592,
    "PVY3": -0.162, "PVY4": -0.4864, "PPY1": -0.6255, "PPY2": -0.06523, "PPY3": -0.16666, "PPY4": 0.2811, "PPY5": 0.0,
    "RBY1": 10.622, "RBY2": 7.82, "RBY3": 0.002037, "RBY4": 0.0, "RCY1": 1.0587, "REY1": 0.3148, "REY2": 0.004867,
    "RHY1": 0.009472, "RHY2": 0.009754, "RVY1": 0.05187, "RVY2": 4.853e-4, "RVY3": 0.0, "RVY4": 94.63, "RVY5": 1.8914,
    "RVY6": 23.8, "QSY1": 0.00702, "QSY2": 0.0, "QSY3": 0.001515, "QSY4": 8.514e-5, "QSY5": 0.0, "QSY6": 0.0,
    "QSY7": 0.9008, "QSY8": -0.4089,
    "QBZ1": 12.035, "QBZ2": -1.33, "QBZ3": 0.0, "QBZ4": 0.176, "QBZ5": -0.14853, "QBZ9": 34.5, "QBZ10": 0.0,
    "QCZ1": 1.2923, "QDZ1": 0.09068, "QDZ2": -0.00565, "QDZ3": 0.3778, "QDZ4": 0.0, "QDZ6": 0.0017015,
    "QDZ7": -0.002091, "QDZ8": -0.1428, "QDZ9": 0.00915, "QDZ10": 0.0, "QDZ11": 0.0, "QEZ1": -1.7924, "QEZ2": 0.8975,
    "QEZ3": 0.0, "QEZ4": 0.2895, "QEZ5": -0.6786, "QHZ1": 0.0014333, "QHZ2": 0.0024087, "QHZ3": 0.24973,
    "QHZ4": -0.21205, "PPZ1": -0.4408, "PPZ2": 0.0, "SSZ1": 0.00918, "SSZ2": 0.03869, "SSZ3": 0.0, "SSZ4": 0.0}


def table_a3_1():
    return files.tir(TABLE_A3_1)


def appendix_3():
    return files.tir(APPENDIX_3)

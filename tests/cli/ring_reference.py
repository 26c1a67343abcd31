# SPDX-License-Identifier: BSD-3-Clause
"""The spin-up of a ring as an axisymmetric problem in the radius alone, in numpy: linear elements,
consistent mass, the exact solution in time by eigenvectors. Nothing of it is shared with the program:
not the elements, the mass, the scheme, nor the two dimensions."""
import numpy as np


class Ring:
    """Fixed to a rim at the radius a, free at b (m); plane strain; at rest in the frame that turns at
    `spin` (rad/s, counter-clockwise) at t = 0, undeformed. Unknowns: u_r and u_t at each radius."""

    def __init__(self, a, b, youngs, poisson, density, spin, elements=60):
        radius = np.linspace(a, b, elements + 1)
        n = 2 * (elements + 1)
        stiffness, mass, turned = np.zeros((n, n)), np.zeros((n, n)), np.zeros((n, n))
        pull = np.zeros(n)
        shear = youngs / (2 * (1 + poisson))
        lame = youngs * poisson / ((1 + poisson) * (1 - 2 * poisson))
        hooke = np.array([[lame + 2 * shear, lame, 0], [lame, lame + 2 * shear, 0], [0, 0, shear]])
        quarter_turn = np.array([[0.0, -1.0], [1.0, 0.0]])  # (u_r, u_t) -> (-u_t, u_r)
        for e in range(elements):
            left, right = radius[e], radius[e + 1]
            place = slice(2 * e, 2 * e + 4)
            for point in (-1 / np.sqrt(3), 1 / np.sqrt(3)):
                shape = np.array([(1 - point) / 2, (1 + point) / 2])
                slope = np.array([-1.0, 1.0]) / (right - left)
                r = shape @ (left, right)
                weight = r * (right - left) / 2
                values = np.kron(shape, np.eye(2))  # (2, 4)
                strain = np.zeros((3, 4))  # rr, tt, rt
                strain[0, 0::2], strain[1, 0::2] = slope, shape / r
                strain[2, 1::2] = slope - shape / r
                stiffness[place, place] += weight * strain.T @ hooke @ strain
                mass[place, place] += weight * density * values.T @ values
                turned[place, place] += weight * density * values.T @ quarter_turn @ values
                pull[place] += weight * density * spin**2 * values.T @ (r, 0.0)
        free = slice(2, n)
        mass, turned = mass[free, free], turned[free, free]
        stiffness = stiffness[free, free] - spin**2 * mass
        inverse = np.linalg.inv(mass)
        size = n - 2
        system = np.block([[np.zeros((size, size)), np.eye(size)],
                           [-inverse @ stiffness, -2 * spin * inverse @ turned]])
        self.stationary = np.linalg.solve(stiffness, pull[free])
        self._rates, self._modes = np.linalg.eig(system)
        start = np.concatenate([-self.stationary, np.zeros(size)])
        self._shares = np.linalg.solve(self._modes, start.astype(complex))

    def edge(self, times):
        """(t, 2) m: u_r and u_t of the free edge."""
        course = self._modes[len(self.stationary) - 2:len(self.stationary)] @ (
            self._shares[:, None] * np.exp(np.outer(self._rates, times)))
        return course.real.T + self.stationary[-2:]

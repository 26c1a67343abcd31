# SPDX-License-Identifier: BSD-3-Clause
"""Cords and air at finite strain against closed forms: a wall with one ply by the theory of laminates, and
a radial carcass without a belt by Purdy's contour."""
import unittest

import h5py
import numpy as np

from program import run
from test_tyre import TyreTest, cords_of


def strip(inner, outer, curves):
    """The text of a .msh file of one row of quadrilaterals between two rows of nodes (r, z), from small z
    to large, and of `curves`: name -> edges of nodes, those of the outer row after all of the inner one."""
    count = len(inner)
    cells = [(k, count + k, count + k + 1, k + 1) for k in range(count - 1)]
    edges = [(tag, edge) for tag, name in enumerate(curves, start=1) for edge in curves[name]]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(curves) + 1)]
    lines += [f'1 {tag} "{name}"' for tag, name in enumerate(curves, start=1)] + ['2 100 "wall"']
    lines += ["$EndPhysicalNames", "$Nodes", str(2 * count)]
    lines += [f"{k} {r!r} {z!r} 0" for k, (r, z) in enumerate([*inner.tolist(), *outer.tolist()], start=1)]
    lines += ["$EndNodes", "$Elements", str(len(edges) + len(cells))]
    rows = [f"1 2 {tag} {tag} {a + 1} {b + 1}" for tag, (a, b) in edges]
    rows += ["3 2 100 100 " + " ".join(str(n + 1) for n in cell) for cell in cells]
    lines += [f"{k} {row}" for k, row in enumerate(rows, start=1)]
    return "\n".join(lines + ["$EndElements", ""])


def chain(first, last):
    """The edges of the nodes `first` to `last`."""
    return [(k, k + 1) for k in range(first, last)]


def cords(curve, angle, stiffness, more=""):
    return f"""[[cords]]
curve = "{curve}"
angle = {angle!r}
stiffness = {stiffness!r}
spacing = 1.0e-3
{more}"""


def case(mesh, sectors, shear_modulus, layers, inflation, steps):
    return f"""schema = 1
title = "closed form"
[section]
file = "{mesh}"
sectors = {sectors}
clamped = ["rim-left", "rim-right"]
[material]
model = "neo-hooke"
shear_modulus = {shear_modulus!r}
poissons_ratio = 0.48
density = 1100.0
{"".join(layers)}[inflation]
steps = {steps}
{inflation}[analysis]
kind = "inflation"
"""


def mounting(axial):
    return "".join(f'[[inflation.mounting]]\ncurve = "{curve}"\naxial = {way!r}\n'
                   for curve, way in (("rim-left", -axial), ("rim-right", axial)))


class ClosedForms(TyreTest):
    def displaced(self, text, nodes):
        """(node, 3) Displacement (radial, around, axial) of the section, nodes in the order of the file."""
        done = run("run", self.case(text), "-o", self.results, "--overwrite")
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.results / "results.h5") as file:
            x = file["mesh/coordinates"][:]
            u = file["snapshots/displacement"][-1]
        inside = np.abs(x[:, 1]) < 1e-12  # of the sector at y = 0
        inside &= x[:, 0] > 0
        places = x[inside][:, [0, 2]]
        order = [int(np.argmin(np.linalg.norm(places - node, axis=1))) for node in nodes]
        np.testing.assert_allclose(places[order], nodes, atol=1e-12)
        return u[inside][order]


class OnePly(ClosedForms):
    """A thin cylinder is pulled along its axle. Its pieces have cords in both faces: from the left end to
    the middle at each of the angles, from there on at the opposite ones, and the middle piece has none.
    By symmetry there is no torque, so that the pieces turn freely, and the strain of the middle piece
    measures the force."""

    DEGREES = (90.0, 70.0, float(np.degrees(np.arctan(np.sqrt(2)))), 35.0, 20.0)
    YOUNG, NU, THICKNESS, RADIUS, STIFFNESS = 9e6, 0.48, 1e-3, 0.5, 1e5  # STIFFNESS: EA / spacing
    LENGTH, PARTS = 0.9, 100  # of each piece: the bending at its ends dies out to 1e-4 in its middle

    def laminate(self, angle):
        """Axial modulus; strain around, shear, and strain of the cords over the axial strain, of a wall
        without forces around and in shear: rubber in plane stress and two layers of cords."""
        c, s = np.cos(angle), np.sin(angle)
        rubber = self.YOUNG / (1 - self.NU**2) * np.array([[1, self.NU, 0], [self.NU, 1, 0],
                                                           [0, 0, (1 - self.NU) / 2]])
        along = np.array([s * s, c * c, s * c])  # of (axial, around, shear)
        stiff = rubber + 2 * self.STIFFNESS / self.THICKNESS * np.outer(along, along)
        compliance = np.linalg.inv(stiff)[:, 0]
        strain = compliance / compliance[0]
        return 1 / compliance[0], strain[1], strain[2], along @ strain

    def cylinder(self):
        """The displacements of the middle of the wall at its nodes z."""
        pieces = [*self.DEGREES, None, *(-d for d in reversed(self.DEGREES))]
        last = len(pieces) * self.PARTS
        m = last + 1
        z = self.LENGTH / self.PARTS * (np.arange(m) - last / 2)
        inner, outer = (np.column_stack([np.full_like(z, self.RADIUS + d), z])
                        for d in (-self.THICKNESS / 2, self.THICKNESS / 2))
        curves, layers = {"rim-left": [(0, m)], "rim-right": [(last, m + last)]}, []
        for piece, degrees in enumerate(pieces):
            for face, first in (("inner", 0), ("outer", m)):
                if degrees is not None:
                    first += piece * self.PARTS
                    curves[f"{face} {piece}"] = chain(first, first + self.PARTS)
                    layers.append(cords(f"{face} {piece}", float(np.radians(degrees)), self.STIFFNESS * 1e-3))
        mesh = self.folder / "cylinder.msh"
        mesh.write_text(strip(inner, outer, curves))
        shear = self.YOUNG / (2 * (1 + self.NU))
        u = self.displaced(case(mesh, 180, shear, layers, mounting(1e-5), 1),
                           np.concatenate([inner, outer]))
        return z, (u[:m] + u[m:]) / 2

    def test_modulus_and_twist(self):
        z, u = self.cylinder()
        rows = cords_of(self.results)

        def strains(piece):
            """Axial, around and in shear, in the middle of a piece."""
            middle = piece * self.PARTS + self.PARTS // 2
            a, b = middle - 5, middle + 5
            way = (u[b] - u[a]) / (z[b] - z[a])
            return np.array([way[2], u[middle, 0] / self.RADIUS, way[1]])

        cell = strains(len(self.DEGREES))
        self.assertLess(abs(cell[2]), 1e-7 * abs(cell[0]))  # no torque
        self.assertAlmostEqual(cell[1] / cell[0], -self.NU, delta=2e-4)
        for piece, degrees in enumerate(self.DEGREES):
            with self.subTest(degrees):
                modulus, around, shear, along = self.laminate(np.radians(degrees))
                strain = strains(piece)
                found = strain / strain[0]
                force = np.mean([row["force_n"] for face in ("inner", "outer")
                                 for row in rows[f"{face} {piece}"]
                                 if abs(row["z_m"] - z[piece * self.PARTS + self.PARTS // 2]) < 0.03])
                # The wheel has 180 flat sides: (pi/180)^2/2 = 1.5e-4.
                self.assertAlmostEqual(self.YOUNG * cell[0] / strain[0] / modulus, 1.0, delta=2.5e-4)
                self.assertAlmostEqual(found[1], around, delta=3e-4)
                self.assertAlmostEqual(found[2], shear, delta=3e-4 * abs(shear) + 1e-5)
                self.assertAlmostEqual(force / (self.STIFFNESS * 1e-3 * strain[0]), along, delta=1e-5)


class RadialCarcass(ClosedForms):
    """Cords that hardly stretch, from bead to bead, in a wall that is nearly nothing. By the forces along the
    axle on the ring between a radius r and the widest place r_w, where the cords have no axial part,
    n T cos(phi) = pi p (r^2 - r_w^2), with n cords around, their force T and their angle phi to the axle
    (Purdy 1963). With phi = 0 at the crown r_c, A = r_c^2 - r_w^2 and the length s of a cord,
    r^2 = r_w^2 + A cos(phi), ds = A / (2 r) dphi, dz = cos(phi) ds and n T = pi p A.

    Around, the wheel has N flat sides: r in the middle of a side is cos(pi/N) of that at its nodes, and the
    air has N tan(pi/N) r^2 instead of pi r^2."""

    HALF_CORD, BEAD, PRESSURE, SPACING, AT, SIDES = 0.17, 0.21, 1e5, 1e-3, 0.3, 36
    MOULD, RIM = 0.070, 0.085  # half the distance of the beads

    def contour(self, half_cord, bead, half_width):
        """A and r_w; and from crown to bead r, z, phi and s."""
        def to_the_bead(crown, widest):
            area = crown**2 - widest**2
            phi = np.linspace(0, np.arccos((bead**2 - widest**2) / area), 4001)
            middle = (phi[1:] + phi[:-1]) / 2
            ds = area / (2 * np.sqrt(widest**2 + area * np.cos(middle))) * np.diff(phi)
            s, z = (np.concatenate([[0.0], np.cumsum(d)]) for d in (ds, np.cos(middle) * ds))
            return np.array([s[-1] - half_cord, z[-1] - half_width]), (
                area, widest, np.sqrt(widest**2 + area * np.cos(phi)), z, phi, s)

        place = np.array([0.33, 0.24])
        for _ in range(20):
            off, found = to_the_bead(*place)
            slope = np.column_stack([(to_the_bead(*(place + step))[0] - off) / 1e-7
                                     for step in 1e-7 * np.eye(2)])
            place = place - np.linalg.solve(slope, off)
        self.assertLess(np.abs(off).max(), 1e-12)
        return found

    def section(self, elements, thickness):
        """The nodes of both sides of the wall, on the contour of a narrower rim."""
        _, _, r, z, phi, s = self.contour(self.HALF_CORD, self.BEAD, self.MOULD)
        place = np.linspace(-self.HALF_CORD, self.HALF_CORD, elements + 1)
        side, place = np.sign(place), np.abs(place)
        angle = np.interp(place, s, phi)
        inner = np.column_stack([np.interp(place, s, r), side * np.interp(place, s, z)])
        return inner, inner + thickness * np.column_stack([np.cos(angle), side * np.sin(angle)])

    def expected(self, inner):
        """Radius of the crown, half the width, its radius, and the force of a cord."""
        turn = np.pi / self.SIDES
        edges = np.diff(inner, axis=0) * [np.cos(turn), 1.0]
        half_cord = np.linalg.norm(edges, axis=1).sum() / 2
        area, widest, r, z, _, _ = self.contour(half_cord, np.cos(turn) * self.BEAD, self.RIM)
        # The spacing is in proportion to the radius of the points of a side, at 1/sqrt(3) of its half.
        count = 2 * self.SIDES * np.sin(turn) * self.AT / self.SPACING / np.sqrt(
            np.cos(turn)**2 + np.sin(turn)**2 / 3)
        force = self.PRESSURE * self.SIDES * np.tan(turn) * area / count
        return np.array([r[0] / np.cos(turn), z.max(), widest / np.cos(turn), force])

    def found(self, inner, outer):
        m, last = len(inner), len(inner) - 1
        mesh = self.folder / "carcass.msh"
        mesh.write_text(strip(inner, outer, {"rim-left": [(0, m)], "rim-right": [(last, m + last)],
                                             "liner": chain(0, last)}))
        text = case(mesh, self.SIDES, 1e3,
                    [cords("liner", np.pi / 2, 1e6, f"spacing_radius = {self.AT}\n")],
                    f'curve = "liner"\npressure = {self.PRESSURE!r}\n'
                    + mounting(self.RIM - self.MOULD), 10)
        x = inner + self.displaced(text, np.concatenate([inner, outer]))[:m, [0, 2]]
        wide = int(np.argmax(x[:, 1]))  # a parabola through three nodes has its top at the widest place
        a, b, c = np.polyfit(x[wide - 1:wide + 2, 0], x[wide - 1:wide + 2, 1], 2)
        force = [row["force_n"] for row in cords_of(self.results)["liner"]]
        force = force[len(force) // 4:-(len(force) // 4)]  # the beads are clamped, and disturb it
        self.assertLess(np.ptp(force) / np.mean(force), 0.6 / last)  # the same all along a cord
        return np.array([x[:, 0].max(), c - b * b / (4 * a), -b / (2 * a), np.mean(force)])

    def test_contour_and_cord_force(self):
        area, widest, r, z, _, _ = self.contour(self.HALF_CORD, self.BEAD, self.RIM)
        force = self.PRESSURE * area * self.SPACING / (2 * self.AT)
        np.testing.assert_allclose([r[0], z.max(), widest, force],
                                   [0.331202, 0.087619, 0.234958, 9.08154], rtol=3e-6)  # of a prototype
        for elements in (40, 80):
            with self.subTest(elements):
                inner, outer = self.section(elements, 1e-3)
                off = self.found(inner, outer) / self.expected(inner) - 1
                # Straight elements are of second order; the wall and the stretch of the cords make 2e-5.
                bound = np.array([0.4, 0.3, 0.25, 2.0]) / elements**2 + 2e-5
                self.assertTrue(np.all(np.abs(off) < bound), f"off by {off}, more than {bound}")


if __name__ == "__main__":
    unittest.main()

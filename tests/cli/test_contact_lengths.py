# SPDX-License-Identifier: BSD-3-Clause
"""Contact lengths and pressures of every analysis are those of the deformed boundary: history.csv, contact.csv
and results.h5 of one state against each other, and against the places of the nodes."""
import csv
import unittest

import h5py
import numpy as np

from program import ROOT, RunTest, contact, history, replaced, run, summary
from test_crush import CRUSH
from test_solid import WHEEL
from test_tyre_crush import DISK as STANDING

ROLLER = (ROOT / "cases" / "rubber-crush.toml").read_text()
STEADY = (ROOT / "cases" / "steady-rolling.toml").read_text()
STEADY_WHEEL = (ROOT / "cases" / "wheel3d-steady.toml").read_text()


def half_edges(file, k):
    """(nb,) m: half of the edges beside each node of the boundary of a plane disk without tread, in snapshot k."""
    nodes = file["mesh/boundary"][:]
    x = file["mesh/coordinates"][:][nodes] + file["snapshots/displacement"][k][nodes]
    edge = np.linalg.norm(np.roll(x, -1, axis=0) - x, axis=1)
    return 0.5 * (edge + np.roll(edge, 1))


def corner_shares(x):
    """(4,) m2: what each corner has of a bilinear face x (4, 3), by 2×2 points of Gauss."""
    share = np.zeros((4, 3))
    corner = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    for xi, eta in corner / np.sqrt(3.0):
        shape = 0.25 * (1 + corner[:, 0] * xi) * (1 + corner[:, 1] * eta)
        along = 0.25 * corner[:, 0] * (1 + corner[:, 1] * eta), 0.25 * corner[:, 1] * (1 + corner[:, 0] * xi)
        share += np.outer(shape, np.cross(along[0] @ x, along[1] @ x))
    return np.linalg.norm(share, axis=1)


def tread_faces(file):
    """Corners of each face of the tread of a wheel in three dimensions."""
    nodes = set(file["mesh/boundary"][:].tolist())
    for cell in file["mesh/hexahedra"][:]:
        for face in ((0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)):  # those round the axle
            corners = cell[list(face)]
            if nodes.issuperset(corners.tolist()):
                yield corners


def face_shares(file, k):
    """{node: m2} of the tread of a wheel in three dimensions, in snapshot k."""
    x = file["mesh/coordinates"][:] + file["snapshots/displacement"][k]
    area = dict.fromkeys(file["mesh/boundary"][:].tolist(), 0.0)
    for corners in tread_faces(file):
        for node, share in zip(corners, corner_shares(x[corners])):
            area[node] += share
    return area


def ground_places(file, k, camber):
    """(n, 2) m: places of all nodes along t1 and t2 from the center, in snapshot k."""
    x = file["mesh/coordinates"][:] + file["snapshots/displacement"][k]
    cos, sin = np.cos(file["frame/angle"][k]), np.sin(file["frame/angle"][k])
    ahead, up = cos * x[:, 0] - sin * x[:, 1], sin * x[:, 0] + cos * x[:, 1]
    return np.stack([ahead, np.cos(camber) * x[:, 2] - np.sin(camber) * up], axis=1)


def footprint(file, k, touched, camber):
    """Length and width in m of the nodes in contact and half of the edges beside them, in snapshot k."""
    place = ground_places(file, k, camber)
    ends = [place[node] for node in touched]
    for corners in tread_faces(file):
        for one, other in zip(corners, np.roll(corners, 1)):
            if one in touched or other in touched:
                ends.append(0.5 * (place[one] + place[other]))
    return np.ptp(ends, axis=0)


class ContactLengths(RunTest):
    def made(self, text, *settings):
        done = run("run", self.case(text), "-o", self.out, "--quiet", "--overwrite",
                   *(a for s in settings for a in ("--set", s)))
        self.assertEqual(done.returncode, 0, done.stderr)
        return history(self.out), contact(self.out)

    def look(self, extents, length="contact_length_m", own="length_m", of_history=True):
        """Of all snapshots with contact. extents(file, k): by node."""
        h, rows = history(self.out), contact(self.out)
        with h5py.File(self.out / "results.h5") as f:
            times, force, traction = f["frame/time"][:], f["contact/force"][:], f["contact/traction"][:]
            nodes = f["mesh/boundary"][:]
            looked, stretched = 0, 0.0
            for k, time in enumerate(times):
                there = rows["time_s"] == time
                if not there.any():
                    continue
                looked += 1
                extent = extents(f, k)
                touched = [int(node) for node in rows["node"][there]]
                np.testing.assert_allclose(rows[own][there], [extent[node] for node in touched], rtol=1e-10)
                pressed = np.searchsorted(nodes, touched) if np.all(np.diff(nodes) > 0) else \
                    np.array([np.flatnonzero(nodes == node)[0] for node in touched])
                np.testing.assert_allclose(traction[k, pressed, 0], force[k, pressed, 0] / rows[own][there], rtol=1e-13)
                np.testing.assert_array_equal(traction[k, pressed, 0], rows["pressure_pa"][there])
                undeformed = f["mesh/tributary"][:][pressed].sum()
                stretched = max(stretched, abs(rows[own][there].sum() / undeformed - 1.0))
                row = np.flatnonzero(np.isclose(h["time_s"], time, rtol=1e-12, atol=0.0))
                if of_history and len(row):
                    self.assertAlmostEqual(h[length][row[0]] / rows[own][there].sum(), 1.0, places=12)
                    if "pressure_max_pa" in h:
                        self.assertEqual(h["pressure_max_pa"][row[0]], rows["pressure_pa"][there].max())
        self.assertGreater(looked, 0)
        return stretched

    @staticmethod
    def plane(file, k):
        return dict(zip(file["mesh/boundary"][:].tolist(), half_edges(file, k)))

    def test_a_crush_of_rubber_as_published(self):
        """docs/validation.md, V35: contact 49.9 to 50.9 mm, largest pressure .431 to .434 MPa."""
        h, rows = self.made(ROLLER)
        self.assertGreater(self.look(self.plane), 0.3)
        last = rows["time_s"] == 1.0
        across = np.ptp(rows["x_m"][last])  # from the first to the last node
        self.assertLess(abs(h["contact_length_m"][-1] - across), 2 * rows["length_m"][last].max())
        self.assertAlmostEqual(h["contact_length_m"][-1], 0.050, delta=0.003)
        self.assertAlmostEqual(h["pressure_max_pa"][-1], 0.433e6, delta=0.015e6)
        with h5py.File(self.out / "results.h5") as f:
            np.testing.assert_array_equal(f["crush/contact_length"][:], h["contact_length_m"][1:])

    def test_linear_crushes(self):
        for solver in ("direct", "latin"):
            self.made(CRUSH, f'analysis.solver="{solver}"')
            self.assertGreater(self.look(self.plane), 5e-3, solver)

    def test_motion_in_time(self):
        self.made(self.text, "output.history_interval=0")
        self.assertGreater(self.look(self.plane), 1e-3)

    def test_every_row_is_that_of_its_own_step(self):
        """Rows at their interval are those of the run that writes all steps."""
        every, _ = self.made(self.text, "output.history_interval=0", "time.end=0.012")
        some, _ = self.made(self.text, "output.history_interval=5e-4", "time.end=0.012")
        at = np.searchsorted(every["time_s"], some["time_s"] * (1 - 1e-12))
        np.testing.assert_array_equal(every["contact_length_m"][at], some["contact_length_m"])
        self.assertGreater(some["contact_length_m"].max(), 0.0)

    def test_steady_rolling(self):
        self.made(STEADY)
        self.assertGreater(self.look(self.plane), 1e-3)
        s, rows = summary(self.out)["steady"], contact(self.out)
        self.assertEqual(s["pressure_max"], rows["pressure_pa"].max())
        self.assertAlmostEqual((s["stick_length"] + s["slip_length"]) * s["samples_per_sector"]
                               / rows["length_m"].sum(), 1.0, places=12)

    def test_wheels_in_three_dimensions(self):
        areas = {"length": "contact_area_m2", "own": "area_m2"}
        self.made(WHEEL, "output.history_interval=0")
        self.assertGreater(self.look(face_shares, **areas), 1e-3)
        self.made(STEADY_WHEEL)
        self.assertGreater(self.look(face_shares, **areas), 1e-3)

    def look_at_footprints(self, camber):
        """Of all snapshots with contact; returns history.csv."""
        h, rows = history(self.out), contact(self.out)
        looked = 0
        with h5py.File(self.out / "results.h5") as f:
            for k, time in enumerate(f["frame/time"][:]):
                there, row = rows["time_s"] == time, np.isclose(h["time_s"], time, rtol=1e-12, atol=0.0)
                if not there.any() or not row.any():
                    continue
                looked += 1
                found = np.array([h["footprint_length_m"][row][0], h["footprint_width_m"][row][0]])
                touched = set(rows["node"][there].astype(int).tolist())
                np.testing.assert_allclose(found, footprint(f, k, touched, camber), rtol=1e-11)
                between = np.array([np.ptp(rows["x_m"][there]), np.ptp(rows["z_m"][there])])
                edge = 2 * np.pi * 0.3 / 40  # the longest of all meshes here
                self.assertTrue((between < found).all() and (found < between + 1.1 * edge).all(), (between, found))
                self.assertLess(rows["area_m2"][there].sum(), found.prod())
                self.assertAlmostEqual(h["pressure_mean_pa"][row][0] / np.average(
                    rows["pressure_pa"][there], weights=rows["area_m2"][there]), 1.0, places=10)
        self.assertGreater(looked, 2)
        return h

    def test_footprints_of_wheels_are_those_of_their_nodes(self):
        """In steps in time, in steady rolling and of a wheel that stands, leaning so that a side of it is up."""
        self.made(WHEEL, "output.history_interval=0", "motion.camber=0.05", "motion.height=[[0, 0.305], [0.004, 0.294]]")
        h = self.look_at_footprints(0.05)
        apart = h["contact_nodes"] == 0
        self.assertTrue(apart.any())
        for name in ("footprint_length_m", "footprint_width_m", "pressure_mean_pa"):
            self.assertTrue((h[name][apart] == 0).all() and (h[name][~apart] > 0).all(), name)
        self.made(STEADY_WHEEL, "motion.camber=0.1", "motion.height=0.298")
        h, steady = self.look_at_footprints(0.1), summary(self.out)["steady"]
        self.assertLess(h["footprint_width_m"].max(), 0.09)
        for name in ("length", "width"):
            self.assertAlmostEqual(steady[f"footprint_{name}"] / h[f"footprint_{name}_m"].mean(), 1.0, places=13)
        self.assertAlmostEqual(steady["pressure_mean"] * h["contact_area_m2"].mean() / steady["force_y"], 1.0, places=12)
        self.made(STANDING, "motion.camber=0.05")
        self.look_at_footprints(0.05)

    def swept(self, text):
        """The row of results.csv of a sweep with the case as its only member."""
        self.case(text)
        (self.folder / "study.toml").write_text('schema = 1\nbase = "case.toml"\n[[vary]]\nkey = "ground.friction"\n'
                                                "values = [0.3]\n")
        done = run("sweep", self.folder / "study.toml", "-o", self.folder / "sweep", "--quiet", "--jobs", "1", "--overwrite")
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.folder / "sweep" / "results.csv", newline="") as file:
            (row,) = csv.DictReader(file)
        return row

    def test_sweeps_have_footprints_in_their_tables(self):
        for text, of in ((WHEEL, "_mean"), (STEADY_WHEEL, ""), (STANDING, "")):
            row = self.swept(text)
            h, _ = self.made(text, "ground.friction=0.3")
            length, width, pressure, area, load = (float(row[name]) for name in (
                f"footprint_length{of}_m", f"footprint_width{of}_m", "pressure_mean_pa", f"contact_area{of}_m2", f"force_y{of}"))
            if text is STANDING:
                self.assertEqual([length, width], [h["footprint_length_m"][-1], h["footprint_width_m"][-1]])
            else:  # means over half a run, and over the pass of a sector
                rows = slice(len(h["time_s"]) // 2 if of else 0, None)
                for found, name in ((length, "footprint_length_m"), (width, "footprint_width_m")):
                    self.assertAlmostEqual(found / h[name][rows].mean(), 1.0, delta=0.02 if of else 1e-12)
            self.assertAlmostEqual(pressure * area / load, 1.0, places=12)

    def test_the_footprint_of_a_crowned_wheel_is_that_of_hertz(self):
        """Of a sphere: its ends lie where the theory says, to the spacing of the nodes."""
        crowned = (("inner_radius", "inner_radius = 0.1"), ("width", "width = 0.2\ncrown_radius = 0.3"),
                   ("radial", "radial = 6\ngrading = 1.25"), ("axial", "axial = 20"), ("circumferential", "circumferential = 180"),
                   ("increments", "increments = 4"), ("friction", "friction = 0.0"), ("poissons", "poissons_ratio = 0.3"))
        text = STANDING
        for beginning, line in crowned:
            text = replaced(text, beginning, line)
        h, _ = self.made(text, "analysis.depth=0.004")
        radius = (0.75 * h["force_y"] * 0.3 * (1 - 0.3**2) / 5.0e6) ** (1 / 3)
        for name, spacing in (("length", 2 * np.pi * 0.3 / 180), ("width", 0.2 / 20)):
            ends = h[f"footprint_{name}_m"] / 2
            np.testing.assert_allclose(ends, radius, rtol=0.0, atol=spacing)
            self.assertGreater(ends[-1], 3 * spacing)

    def test_a_reduced_wheel(self):
        done = run("run", self.case(self.text), "-o", self.out, "--reduced", "--set", "output.history_interval=0")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.look(self.plane, of_history=False)
        h, rows = history(self.out), contact(self.out)
        for time in np.unique(rows["time_s"])[-5:]:
            row = np.argmin(abs(h["time_s"] - time))
            self.assertAlmostEqual(h["contact_length_m"][row] / rows["length_m"][rows["time_s"] == time].sum(), 1.0,
                                   delta=1e-9)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""Contact lengths and pressures of every analysis are those of the deformed boundary: history.csv, contact.csv
and results.h5 of one state against each other, and against the places of the nodes."""
import unittest

import h5py
import numpy as np

from program import ROOT, RunTest, contact, history, replaced, run, summary
from test_crush import CRUSH
from test_solid import WHEEL

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


def face_shares(file, k):
    """{node: m2} of the tread of a wheel in three dimensions, in snapshot k."""
    x = file["mesh/coordinates"][:] + file["snapshots/displacement"][k]
    nodes = set(file["mesh/boundary"][:].tolist())
    area = dict.fromkeys(nodes, 0.0)
    for cell in file["mesh/hexahedra"][:]:
        for face in ((0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)):  # those round the axle
            corners = cell[list(face)]
            if nodes.issuperset(corners.tolist()):
                for node, share in zip(corners, corner_shares(x[corners])):
                    area[node] += share
    return area


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

# SPDX-License-Identifier: BSD-3-Clause
"""rondo matrices: the file as numpy reads it, against `rondo modes` and against a run; what is refused."""
import json
import unittest

import h5py
import numpy as np

from program import ROOT, SMALL, ProgramTest, replaced, run

SOLID = replaced(SMALL, "radial", "radial = 2\naxial = 2").replace("inner_radius = 0.15",
                                                                    "inner_radius = 0.15\nwidth = 0.1")
MATRICES = {"mass": ("kg/m", "kg"), "damping": ("N s/m2", "N s/m"), "stiffness": ("N/m2", "N/m"),
            "gyroscopic": ("kg/m", "kg"), "centrifugal": ("kg/m", "kg")}


def dense(file, name):
    """A matrix of the file, from its compressed rows."""
    data, indices, indptr, shape = (file[f"{name}/{part}"][()] for part in
                                    ("data", "indices", "indptr", "shape"))
    matrix = np.zeros(shape)
    for row, (first, last) in enumerate(zip(indptr[:-1], indptr[1:], strict=True)):
        assert (np.diff(indices[first:last]) > 0).all()
        matrix[row, indices[first:last]] = data[first:last]
    return matrix


class Matrices(ProgramTest):
    def file_of(self, case, *arguments):
        path = self.folder / "matrices.h5"
        done = run("matrices", case, "-o", path, *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        file = h5py.File(path)
        self.addCleanup(file.close)
        return file, done

    def test_frequencies_are_those_of_modes(self):
        case = self.case(SMALL)
        file, done = self.file_of(case)
        self.assertIn("unknowns           240 of 120 nodes", done.stdout)
        stiffness, mass = dense(file, "stiffness"), np.diag(dense(file, "mass"))
        squares = np.linalg.eigvalsh(stiffness / np.sqrt(np.outer(mass, mass)))
        done = run("modes", case, "-o", self.folder / "modes", "--count", 12, "--spin", 0, "--json")
        omega = [mode["omega"] for mode in json.loads(done.stdout)["result"]["modes"]]
        np.testing.assert_allclose(np.sqrt(squares[:12]), sorted(omega)[:12], rtol=1e-9)

    def test_layout_and_units(self):
        for k, (text, nodes, components) in enumerate(((SMALL, 120, 2), (SOLID, 240, 3))):
            file, _ = self.file_of(self.case(text))
            self.assertEqual(file.attrs["format"], "rondo matrices 1")
            for name, units in MATRICES.items():
                self.assertEqual(file[f"{name}/data"].attrs["units"], units[k])
                self.assertEqual(list(file[f"{name}/shape"]), 2 * [components * nodes])
            matrices = {name: dense(file, name) for name in MATRICES}
            np.testing.assert_array_equal(matrices["damping"],
                                          200.0 * matrices["mass"] + 2e-5 * matrices["stiffness"])
            np.testing.assert_array_equal(matrices["gyroscopic"], -matrices["gyroscopic"].T)
            self.assertEqual(file["reference"].shape, (nodes, components))
            self.assertEqual(len(set(file["nodes"]) | set(file["clamped"])),
                             len(file["nodes"]) + len(file["clamped"]))
            rows = dense(file, "contact/rows")
            self.assertEqual(rows.shape, (components * len(file["contact/nodes"]), components * nodes))
            np.testing.assert_allclose(rows @ rows.T, np.eye(len(rows)), atol=1e-15)
            np.testing.assert_allclose(file["frame/spin"][0], -33.333333)

    def test_contact_rows_at_a_time(self):
        """H takes positions, turned into the fixed frame by the angle, to heights over the ground."""
        file, _ = self.file_of(self.case(SMALL), "--time", "0.003")
        self.assertAlmostEqual(file["frame/angle"][0], -0.1, places=7)
        np.testing.assert_allclose(file["frame/center"], (0.03, 0.297), rtol=1e-12)
        arms = dense(file, "contact/rows") @ file["reference"][()].ravel()
        np.testing.assert_allclose(arms[::2] + 0.297, file["contact/gap"], atol=1e-15)
        cos, sin = np.cos(0.1), np.sin(0.1)
        np.testing.assert_allclose(file["contact/normal_corotating"][0], (-sin, cos), atol=1e-8)
        np.testing.assert_array_equal(file["contact/normal"][0], (0.0, 1.0))

    def test_without_ground(self):
        text = "\n".join(line for line in SMALL.splitlines()
                         if not line.startswith(("[ground]", "profile", "friction")))
        file, done = self.file_of(self.case(text))
        self.assertIn("none: there is no ground", done.stdout)
        self.assertNotIn("contact", file)

    def test_document(self):
        file, done = self.file_of(self.case(SMALL), "--json")
        found = json.loads(done.stdout)["result"]
        self.assertEqual((found["unknowns"], found["nodes"], found["contact_nodes"], found["time"]),
                         (240, 120, 40, 0.0))
        self.assertEqual(found["stiffness_entries"], len(file["stiffness/data"]))
        schema = json.loads(run("schema", "matrices").stdout)
        self.assertIn("stiffness_entries", json.dumps(schema))

    def test_what_is_refused(self):
        output = self.folder / "none.h5"
        for arguments, words in (
                ([ROOT / "cases/rubber-roller.toml"], "material.model = \"neo-hooke\": is rubber at finite"),
                ([ROOT / "cases/thrown-disk.toml"], "disk.rim = \"free\": leaves bodies free"),
                ([ROOT / "cases/crush-smooth.toml"], "analysis.kind = \"crush\": is no motion in time"),
                ([ROOT / "cases/wheel-rolling.toml", "--time", "0.1"], "forces move the rim"),
                ([self.case(SMALL), "--time", "-1"], "--time = -1: is no time of the motion")):
            done = run("matrices", *arguments, "-o", output)
            self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
            self.assertIn(words, done.stderr)
        self.assertFalse(output.exists())
        done = run("matrices", self.case(SMALL), "-o", self.folder / "none" / "there.h5")
        self.assertEqual(done.returncode, 4, done.stderr)


if __name__ == "__main__":
    unittest.main()

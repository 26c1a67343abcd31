# SPDX-License-Identifier: BSD-3-Clause
"""rondo run --reduced --snapshots modes from outside: its files, and who refuses them.
tests/python/test_lifted.py lifts them."""
import pathlib
import tempfile
import unittest

import h5py
import numpy as np

from program import ProgramTest, SMALL, replaced, run, summary

TEXT = replaced(replaced(SMALL, "snapshots", "snapshots = 81"), "circumferential",
                "circumferential = 120")


def made(*arguments, code=0):
    done = run(*arguments)
    assert done.returncode == code, done.stderr
    return done


class Snapshots(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.shared = pathlib.Path(folder.name)
        cls.case_file, cls.model = cls.shared / "case.toml", cls.shared / "model.h5"
        cls.case_file.write_text(TEXT)
        made("run", cls.case_file, "-o", cls.shared / "full")
        made("reduce", cls.shared / "full", "-o", cls.model, "--displacement-modes", 20,
             "--velocity-modes", 20)

    def reduced(self, name, *arguments, code=0):
        out = self.folder / name
        return out, made("run", self.case_file, "--reduced", self.model, "-o", out, *arguments,
                         code=code)

    def test_files(self):
        fields, _ = self.reduced("fields")
        modes, _ = self.reduced("modes", "--snapshots", "modes")
        # All that the modes do not hold is the same to the bit.
        for name in ("history.csv", "case.toml"):
            self.assertEqual((modes / name).read_bytes(), (fields / name).read_bytes())
        self.assertEqual(sorted(p.name for p in modes.iterdir()),
                         ["case.toml", "contact.csv", "history.csv", "results.h5", "run.json"])
        self.assertEqual([summary(out)["lifted"] for out in (fields, modes)], [True, False])
        self.assertEqual(summary(modes)["strain_max"], summary(fields)["strain_max"])
        rows = [np.loadtxt(out / "contact.csv", delimiter=",", skiprows=1)
                for out in (fields, modes)]
        self.assertGreater(len(rows[0]), 100)
        np.testing.assert_allclose(rows[1], rows[0], rtol=1e-12, atol=1e-14)
        bytes_ = [(out / "results.h5").stat().st_size for out in (fields, modes)]
        self.assertLess(bytes_[1], 0.6 * bytes_[0])
        with h5py.File(modes / "results.h5") as f, h5py.File(fields / "results.h5") as g, \
                h5py.File(self.model) as model:
            self.assertEqual(sorted(f), ["contact", "frame", "mesh", "reduced"])
            t, r = len(g["frame/time"]), len(model["model/basis"])
            self.assertEqual({name: data.shape for name, data in f["reduced"].items()},
                             {"modes": model["model/basis"].shape, "displacement": (t, r),
                              "velocity": (t, r), "angle": (t, 2)})
            np.testing.assert_array_equal(f["reduced/modes"], model["model/basis"])
            self.assertEqual(f["reduced/modes"].attrs["frame"], model.attrs["frame"])
            for name in ("frame/time", "frame/angle", "frame/center", "contact/force"):
                np.testing.assert_array_equal(f[name], g[name])
            for data in f["reduced"].values():
                self.assertTrue(data.attrs["units"] and data.attrs["description"])

    def test_readers_of_fields_refuse_them(self):
        modes, _ = self.reduced("modes", "--snapshots", "modes")
        for command in (["pod", modes], ["reduce", modes, "-o", self.folder / "none.h5"]):
            said = made(*command, code=2).stderr
            self.assertIn("snapshots of modes", said)
            self.assertIn("--snapshots fields", said)
        self.assertFalse((modes / "pod").exists())

    def test_fields_that_were_there_are_gone(self):
        out, _ = self.reduced("out")
        self.reduced("out", "--snapshots", "modes", "--overwrite")
        self.assertFalse((out / "fields.xdmf").exists())
        self.assertFalse((out / "fields.vtkhdf").exists())

    def test_wrong_input(self):
        out, done = self.reduced("out", "--snapshots", "mode", code=2)
        self.assertIn("--snapshots", done.stderr)
        self.assertIn("fields or modes", done.stderr)
        self.assertFalse(out.exists())
        made("run", self.case_file, "-o", out, "--snapshots", "modes", code=2)


if __name__ == "__main__":
    unittest.main()

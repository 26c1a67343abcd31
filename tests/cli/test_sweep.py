# SPDX-License-Identifier: BSD-3-Clause
"""rondo sweep: its table against runs made alone, and studies that are refused."""
import json
import os
import shutil
import subprocess
import time
import unittest

import h5py
import numpy as np

from program import PROGRAM, ROOT, SMALL, history, replaced, run, summary
from sweep_program import STUDY, SweepTest, column, table


class Results(SweepTest):
    def test_a_row_is_what_the_run_alone_gives(self):
        done = self.sweep()
        self.assertEqual(done.stdout, "")
        rows = table(self.out)
        self.assertEqual([row["run"] for row in rows], [str(k) for k in range(1, 10)])
        self.assertEqual([(row["ground.friction"], row["motion.speed"]) for row in rows[:4]],
                         [("0.0", "9"), ("0.0", "10"), ("0.0", "11"), ("0.2", "9")])
        alone = self.folder / "alone"
        self.assertEqual(run("run", self.folder / "case.toml", "-o", alone, "--set",
                             "ground.friction=0.2", "--set", "motion.speed=11").returncode, 0)
        member = self.out / "runs" / "0006"
        self.assertEqual((member / "history.csv").read_bytes(),
                         (alone / "history.csv").read_bytes())
        h, row = history(alone), rows[5]  # the ground brakes it: force_x < 0
        time = np.concatenate([[0.0], h["time_s"]])
        inside = time[:-1] >= 0.5 * time[-1]
        length = np.diff(time)[inside]
        for name in ("force_x", "force_y", "torque"):
            f = h[name][inside]
            mean = np.average(f, weights=length)
            self.assertAlmostEqual(float(row[f"{name}_mean"]), mean, delta=1e-9 * abs(f).max())
            self.assertEqual(float(row[f"{name}_peak"]), f[np.argmax(abs(f))])
            self.assertTrue(name != "force_x" or mean < 0)
            self.assertAlmostEqual(float(row[f"{name}_fluctuation"]),
                                   np.sqrt(np.average((f - mean) ** 2, weights=length)),
                                   delta=1e-9 * abs(f).max())
        d = h["dissipation_friction"]
        before = np.argmax(inside) - 1
        self.assertAlmostEqual(float(row["friction_power"]),
                               (d[-1] - d[before]) / (h["time_s"][-1] - h["time_s"][before]),
                               delta=1e-9 * d[-1] / h["time_s"][-1])
        self.assertEqual(float(row["energy_residual_relative"]),
                         summary(alone)["energy_residual_relative"])
        self.assertEqual(int(row["steps"]), summary(alone)["steps_done"])

    def test_the_files_say_the_same(self):
        self.sweep()
        with h5py.File(self.out / "sweep.h5") as f:
            for name in f["figures"]:
                np.testing.assert_array_equal(f["figures"][name][:], column(self.out, name))
                self.assertIn("units", f["figures"][name].attrs)
            np.testing.assert_array_equal(f["parameters/ground.friction"][:],
                                          column(self.out, "ground.friction"))
            self.assertTrue((f["status"][:] == 1).all())
        said = json.loads((self.out / "sweep.json").read_text())
        self.assertEqual((said["status"], said["members"], said["done"]), ("done", 9, 9))
        self.assertEqual([p["key"] for p in said["parameters"]],
                         ["ground.friction", "motion.speed"])
        self.assertEqual(len((self.out / "timings.csv").read_text().splitlines()), 10)

    def test_the_window_is_the_part_asked_for(self):
        self.sweep(text=STUDY + "[window]\nfrom = 0.008\nto = 0.012\n")
        h = history(self.out / "runs" / "0001")
        time = np.concatenate([[0.0], h["time_s"]])
        inside = (time[:-1] >= 0.008) & (h["time_s"] <= 0.012)
        self.assertGreater(inside.sum(), 10)
        self.assertAlmostEqual(column(self.out, "force_y_mean")[0],
                               np.average(h["force_y"][inside], weights=np.diff(time)[inside]),
                               places=6)

    def test_text_and_table_parameters(self):
        self.sweep(text="""schema = 1
base = "case.toml"
[[vary]]
key = "solver.operator"
values = ["cyclic", "sparse"]
[[vary]]
key = "motion.height"
values = [[[0, 0.3], [0.004, 0.296]], [[0, 0.3], [0.004, 0.2965]]]
""")
        rows = table(self.out)
        self.assertEqual([row["solver.operator"] for row in rows], ["cyclic"] * 2 + ["sparse"] * 2)
        self.assertEqual(rows[1]["motion.height"], "[[0, 0.3], [0.004, 0.2965]]")
        force = column(self.out, "force_y_mean")
        np.testing.assert_allclose(force[:2], force[2:], rtol=1e-9)
        self.assertGreater(force[0], force[1])
        with h5py.File(self.out / "sweep.h5") as f:
            self.assertEqual(f["parameters/solver.operator"].attrs["values"].split(),
                             ["cyclic", "sparse"])
            np.testing.assert_array_equal(f["parameters/solver.operator"][:], [0, 0, 1, 1])

    def test_keys_that_go_together(self):
        text = STUDY.replace("key = \"motion.speed\"\nlinspace = [9, 11, 3]",
                             "keys = [\"motion.speed\", \"material.youngs_modulus\"]\n"
                             "values = [[9, 1e7], [10, 2e7]]")
        listed = self.sweep("--dry-run", text=text).stdout
        self.assertIn("run 2 (ground.friction = 0.0, motion.speed = 10, "
                      "material.youngs_modulus = 20000000.0): ", listed)
        self.sweep(text=text)
        rows = table(self.out)
        self.assertEqual([(row["ground.friction"], row["motion.speed"],
                           row["material.youngs_modulus"]) for row in rows[1:4]],
                         [("0.0", "10", "20000000.0"), ("0.2", "9", "10000000.0"),
                          ("0.2", "10", "20000000.0")])
        said = json.loads((self.out / "sweep.json").read_text())["parameters"]
        self.assertEqual([p.get("with") for p in said], [None, None, "motion.speed"])
        alone = self.folder / "alone"
        self.assertEqual(run("run", self.folder / "case.toml", "-o", alone, "--set",
                             "ground.friction=0.2", "--set", "motion.speed=9", "--set",
                             "material.youngs_modulus=1e7").returncode, 0)
        self.assertEqual((self.out / "runs" / "0003" / "history.csv").read_bytes(),
                         (alone / "history.csv").read_bytes())

    def test_columns_of_the_histories(self):
        self.case(SMALL + "[[output.probe]]\nname = \"tip\"\nposition = [0, -0.3]\n")
        asked = "columns = [\"tip_uy\", \"force_y\"]\n" + STUDY + "[window]\nfrom = 0.008\nto = 0.012\n"
        self.sweep(text=asked)
        h = history(self.out / "runs" / "0005")
        time = np.concatenate([[0.0], h["time_s"]])
        inside = (time[:-1] >= 0.008) & (h["time_s"] <= 0.012)
        row = table(self.out)[4]
        values = h["tip_uy"][inside]
        self.assertGreater(np.ptp(values), 0)
        self.assertEqual([float(row[f"tip_uy_{name}"]) for name in ("min", "max", "last")],
                         [values.min(), values.max(), values[-1]])
        mean = np.average(values, weights=np.diff(time)[inside])
        self.assertAlmostEqual(float(row["tip_uy_mean"]), mean, delta=1e-12 * abs(values).max())
        names = list(row)
        self.assertEqual(names[-7:], ["tip_uy_mean", "tip_uy_min", "tip_uy_max", "tip_uy_last",
                                      "force_y_min", "force_y_max", "force_y_last"])  # one mean
        with h5py.File(self.out / "sweep.h5") as f:
            self.assertEqual(f["figures/tip_uy_max"].attrs["units"], "m")
            self.assertEqual(f["figures/tip_uy_max"][4], values.max())
        said = json.loads((self.out / "sweep.json").read_text())["columns"]
        self.assertIn({"name": "force_y_min", "unit": "N/m"}, said)
        done = self.sweep("--overwrite", text=asked.replace("tip_uy", "tip_vz"), code=2)
        self.assertIn("\"tip_vz\" is no column of history.csv of these runs", done.stderr)
        self.assertIn("tip_uy, tip_vx", done.stderr)
        self.assertIn("another sweep", self.sweep("--resume", text=STUDY, code=2).stderr)

    def test_columns_of_crushes_and_of_steady_rolling(self):
        self.case(replaced(replaced(SMALL, "end", None), "[time]", None)
                  .replace("snapshots = 11", "stress = false")
                  + "[analysis]\nkind = \"crush\"\ndepth = 0.01\nincrements = 5\n")
        text = ("schema = 1\nbase = \"case.toml\"\ncolumns = [\"pressure_max_pa\"]\n[[vary]]\n"
                "key = \"ground.friction\"\nvalues = [0, 0.4]\n")
        self.sweep(text=text)
        h, row = history(self.out / "runs" / "0002"), table(self.out)[1]
        self.assertEqual([float(row[f"pressure_max_pa_{name}"]) for name in ("min", "max", "last")],
                         [h["pressure_max_pa"].min(), h["pressure_max_pa"].max(),
                          h["pressure_max_pa"][-1]])
        self.assertNotIn("pressure_max_pa_mean", row)
        steady = STUDY.replace("case.toml", str(ROOT / "cases" / "steady-rolling.toml"))
        done = self.sweep("--overwrite", text="columns = [\"force_y\"]\n" + steady, code=2)
        self.assertIn("columns: steady rolling without snapshots leaves no history.csv", done.stderr)

    def test_cores_have_the_same_name_in_all_commands(self):
        self.assertIn("9 runs, 1 at once", self.sweep("--dry-run", "--threads", "1").stdout)
        for name in ("--jobs", "--threads"):
            done = run("run", self.folder / "case.toml", "-o", self.out, "--overwrite", name, 2)
            self.assertEqual((done.returncode, summary(self.out)["threads"]), (0, 2), done.stderr)
            self.assertIn("on 1 thread", run("check", self.folder / "case.toml", name, 1).stdout)

    def test_a_sample_and_geometry(self):
        text = """schema = 1
base = "case.toml"
[sample]
kind = "latin-hypercube"
count = 6
seed = 3
[[vary]]
key = "material.youngs_modulus"
uniform = [1e7, 3e7]
[[vary]]
key = "disk.mesh.radial"
uniform = [2, 3]
"""
        self.sweep(text=text)
        e, radial = column(self.out, "material.youngs_modulus"), column(self.out, "disk.mesh.radial")
        self.assertEqual(sorted((6 * (e - 1e7) / 2e7).astype(int)), list(range(6)))
        self.assertEqual(sorted(radial), [2, 2, 2, 3, 3, 3])
        first = (self.out / "results.csv").read_bytes()
        self.sweep("--overwrite", text=text)
        self.assertEqual((self.out / "results.csv").read_bytes(), first)

    def test_crushes(self):
        self.case(replaced(replaced(SMALL, "end", None), "[time]", None)
                  .replace("snapshots = 11", "stress = false")
                  + "[analysis]\nkind = \"crush\"\ndepth = 0.01\nincrements = 5\n")
        done = self.sweep(text="""schema = 1
base = "case.toml"
[[vary]]
key = "analysis.depth"
values = [0.005, 0.01]
[[vary]]
key = "ground.friction"
values = [0, 0.4]
""")
        self.assertNotIn("output.snapshots", done.stderr)
        np.testing.assert_allclose(column(self.out, "depth_m"), [0.005, 0.005, 0.01, 0.01])
        h = history(self.out / "runs" / "0004")
        self.assertEqual(column(self.out, "force_y")[3], h["force_y"][-1])
        self.assertEqual(column(self.out, "pressure_max_pa")[3], h["pressure_max_pa"][-1])
        alone = self.folder / "alone"
        run("run", self.folder / "case.toml", "-o", alone, "--set", "ground.friction=0.4")
        self.assertEqual((alone / "history.csv").read_bytes(),
                         (self.out / "runs" / "0004" / "history.csv").read_bytes())

    def test_strains_are_in_the_table_and_told(self):
        self.case(replaced(replaced(SMALL, "end", None), "[time]", None)
                  .replace("snapshots = 11", "stress = false")
                  + "[analysis]\nkind = \"crush\"\ndepth = 0.01\nincrements = 5\n")
        text = "schema = 1\nbase = \"case.toml\"\n[[vary]]\nkey = \"analysis.depth\"\n"
        done = self.sweep(text=text + "values = [0.1, 0.001, 0.08]\n")
        said = [json.loads((self.out / "runs" / f"000{k}" / "run.json").read_text())
                for k in (1, 2, 3)]
        strain = column(self.out, "strain_max")
        np.testing.assert_array_equal(strain, [run["strain_max"] for run in said])
        np.testing.assert_array_equal(column(self.out, "jacobian_min"),
                                      [run["jacobian_min"] for run in said])
        self.assertTrue(strain[0] > strain[2] > 0.1 > strain[1])
        self.assertIn(f"2 of 3 runs done have a largest strain above 10 %, the largest "
                      f"{strain[0]:.3g} in run 1: ", done.stderr)
        self.assertNotIn("largest strain",
                         self.sweep("--overwrite", text=text + "values = [0.001]\n").stderr)

    def test_loads_of_a_rim_are_varied_and_tables_of_the_base_replaced(self):
        """What a member has is what the case alone would have, whatever the base says."""
        self.case(replaced(SMALL, "height", "height = 0.3")
                  + "[rim]\nfree = [\"height\", \"angular_velocity\"]\nmass = 100\ninertia = 1\n"
                    "force_y = [[0, 0], [0.01, -1e5]]\n[rim.support.y]\ndamping = 6e4\n")
        text = """schema = 1
base = "case.toml"
[[vary]]
key = "rim.force_y"
values = [-5e4, [[0, 0], [0.005, -1e5]]]
[[vary]]
key = "rim.torque"
values = [0, 1000]
[[vary]]
key = "rim.mass"
values = [50, 100]
"""
        listed = self.sweep("--dry-run", text=text).stdout
        self.assertIn("run 3 (rim.force_y = -50000.0, rim.torque = 1000, rim.mass = 50)", listed)
        self.assertIn("8 runs", listed)

    def test_one_pod_of_all_runs(self):
        self.sweep(text=STUDY.replace("base", "snapshots = true\nbase"))
        done = run("pod", self.out, "--field", "velocity", "-o", self.folder / "pod")
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads((self.folder / "pod" / "velocity-rotating" / "pod.json").read_text())
        self.assertEqual(found["snapshots"], 9 * 11)

    def test_no_snapshots_unless_asked_for(self):
        self.sweep()
        self.assertEqual(summary(self.out / "runs" / "0001")["snapshots"], 0)
        self.assertFalse((self.out / "runs" / "0001" / "checkpoint.h5").exists())
        done = run("pod", self.out, "-o", self.folder / "pod")
        self.assertEqual(done.returncode, 2)
        self.assertIn("snapshots = true", done.stderr)

    def test_dry_run_lists_and_writes_nothing(self):
        done = self.sweep("--dry-run")
        self.assertEqual(len(done.stdout.splitlines()), 10)
        self.assertIn("run 4 (ground.friction = 0.2, motion.speed = 9): 160 nodes", done.stdout)
        self.assertIn("9 runs", done.stdout.splitlines()[-1])
        self.assertFalse(self.out.exists())


class Refused(SweepTest):
    def refused(self, text, *expected):
        done = self.sweep(text=text, code=2)
        for piece in expected:
            self.assertIn(piece, done.stderr)
        self.assertFalse(self.out.exists())

    def test_an_unknown_key_and_an_empty_range(self):
        self.refused(STUDY.replace("ground.friction", "ground.frction")
                     .replace("[9, 11, 3]", "[9, 11, 0]"),
                     "study.toml:5:7: vary[0].key", "did you mean ground.friction?",
                     "study.toml:9:12: vary[1].linspace = [9, 11, 0]: is an empty range")

    def test_cases_that_are_wrong_for_some_members(self):
        self.refused(STUDY.replace("[0.0, 0.2, 0.4]", "[0.0, -0.2, 0.4]")
                     + "[[vary]]\nkey = \"motion.height\"\nvalues = [0.31, 0.2]\n",
                     "run 7 (ground.friction = -0.2, motion.speed = 9, motion.height = 0.31) "
                     "and 5 of 17 others: ", "run 2 (ground.friction = 0.0, motion.speed = 9, "
                     "motion.height = 0.2) and 5 of 17 others: ", "deep inside the ground")

    def test_members_that_cannot_be_built(self):
        self.refused(STUDY + "[[vary]]\nkey = \"motion.height\"\nvalues = [0.31, 0.2]\n",
                     "run 2 (ground.friction = 0.0, motion.speed = 9, motion.height = 0.2) and 8 "
                     "of 17 others: ", "deep inside the ground")

    def test_a_target_is_a_load_of_the_rim_now(self):
        target = ("schema = 1\nbase = \"case.toml\"\n[[vary]]\nkey = \"%s\"\n"
                  "target = { force_y = [1e5] }\n")
        self.refused(target % "motion.height", "study.toml:5:10: vary[0].target", "rim.force_y",
                     "free = [\"height\"]")
        self.refused(target % "analysis.depth", "values of analysis.depth")

    def test_a_load_of_what_is_held(self):
        self.case(SMALL + "[rim]\nfree = []\n")
        self.refused("schema = 1\nbase = \"case.toml\"\n[[vary]]\nkey = \"rim.force_y\"\n"
                     "values = [0, -1e5]\n", "run 2 (rim.force_y = -100000.0)",
                     "has no effect, because motion.height is held", "rim.free with \"height\"")

    def test_a_window_without_rows(self):
        self.refused(STUDY + "[window]\nfrom = 0.5\n", "there are not two rows")
        self.refused(STUDY + "[window]\nto = 0.5\n", "after time.end = 0.02 s")

    def test_no_base(self):
        self.refused(STUDY.replace("case.toml", "none.toml"), "none.toml: there is no such file")

    def test_another_sweep_in_the_directory(self):
        self.sweep()
        done = self.sweep(code=2)
        self.assertIn("--resume", done.stderr)
        done = self.sweep("--resume", text=STUDY.replace("0.4]", "0.5]"), code=2)
        self.assertIn("another sweep", done.stderr)
        done = self.sweep("--resume", "--set", "time.end=0.01", code=2)
        self.assertIn("another sweep", done.stderr)
        self.sweep("--overwrite", text=STUDY.replace("0.4]", "0.5]"))

    def test_what_has_changed_since(self):
        mesh = self.folder / "two-disks.msh"
        shutil.copy(ROOT / "cases" / "meshes" / "two-disks.msh", mesh)
        text = (ROOT / "cases" / "two-disks.toml").read_text()
        case = self.case(replaced(replaced(text, "file", 'file = "two-disks.msh"'), "end", "end = 2e-4"))
        study = ("schema = 1\nbase = \"case.toml\"\nset = [\"output.history_interval=1e-5\"]\n"
                 "[[vary]]\nkey = \"contact.friction\"\n"
                 "values = [0.1, 0.2]\n")
        self.sweep(text=study)
        kept = (self.out / "results.csv").read_bytes()
        for path, edit in ((case, lambda t: replaced(t, "end", "end = 3e-4")),
                           (mesh, lambda t: t + "$Comments\nmoved\n$EndComments\n"),
                           (self.folder / "study.toml", lambda t: t + "[window]\nto = 1e-4\n"),
                           (self.out / "sweep.json",
                            lambda t: t.replace('"build_id": "', '"build_id": "0'))):
            with self.subTest(path.name):
                before = path.read_text()
                path.write_text(edit(before))
                done = run("sweep", self.folder / "study.toml", "-o", self.out, "--resume")
                path.write_text(before)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn("--overwrite", done.stderr)
                self.assertEqual((self.out / "results.csv").read_bytes(), kept)
        done = run("sweep", self.folder / "study.toml", "-o", self.out, "--resume")
        self.assertIn("2 were there already", done.stderr)

    def test_default_directory(self):
        """The study's name in the working folder; of earlier versions, beside the study."""
        work = self.folder / "work"
        work.mkdir()
        study = self.study()
        before = study.with_suffix("")
        self.assertEqual(run("sweep", study, "-o", before, "--quiet").returncode, 0)
        done = run("sweep", study, "--resume", cwd=work)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"-o {before} to resume them", done.stderr)
        self.assertIn("9 were there already", done.stderr)
        done = run("sweep", study, "--quiet", cwd=work)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual((work / "study" / "results.csv").read_bytes(),
                         (before / "results.csv").read_bytes())

    def test_files_that_are_not_its_own(self):
        for name in ("results.csv", "sweep.h5", "timings.csv", "runs"):
            self.out.mkdir()
            (self.out / name).write_text("precious")
            for extra in ((), ("--overwrite",), ("--resume",)):
                self.assertIn("and no sweep", self.sweep(*extra, code=2).stderr)
            self.assertEqual((self.out / name).read_text(), "precious")
            shutil.rmtree(self.out)

    def test_a_damaged_record_can_be_overwritten(self):
        self.sweep()
        (self.out / "sweep.json").write_bytes(bytes(100))
        done = self.sweep("--resume", code=4)
        self.assertIn("sweep.json: is damaged: not JSON; give --overwrite to make the sweep anew",
                      done.stderr)
        self.sweep("--overwrite")

    def test_runs_that_were_damaged_since_are_made_again(self):
        text = STUDY.replace('base =', 'snapshots = true\nbase =')
        self.sweep(text=text)
        whole = {path: path.read_bytes() for path in sorted(self.out.glob("runs/*/*.[ch]*"))}
        history, contact, results = (self.out / "runs" / f"{run:04}" / name for run, name in (
            (2, "history.csv"), (4, "contact.csv"), (6, "results.h5")))
        history.write_bytes(whole[history].replace(b"\n0.0", b"\n0.1", 1))
        contact.write_bytes(whole[contact][:-40] + bytes(40))
        with h5py.File(results, "r+") as f:
            f["/fields/von_mises"][5, 7] = np.inf
        # A second link keeps each number of a file from being given to a new one.
        links = {path: self.out.parent / f"link{i}" for i, path in enumerate(whole)}
        for path, link in links.items():
            os.link(path, link)
        self.sweep("--resume", text=text)
        again = {path.parent.name for path, link in links.items() if not path.samefile(link)}
        self.assertEqual(again, {"0002", "0004", "0006"})
        for path, content in whole.items():
            self.assertEqual(path.read_bytes(), content, path)

    def test_settings_of_what_is_varied(self):
        self.assertIn("is varied", self.sweep("--set", "ground.friction=0.5", code=2).stderr)
        self.assertIn("snapshots = true",
                      self.sweep("--set", "output.snapshots=5", code=2).stderr)

    def test_a_run_in_the_directory(self):
        run("run", self.folder / "case.toml", "-o", self.out)
        self.assertIn("no sweep", self.sweep("--overwrite", code=2).stderr)
        self.assertTrue((self.out / "history.csv").exists())

    def test_two_at_once(self):
        self.case(replaced(SMALL, "end", "end = 100.0"))
        process = subprocess.Popen([PROGRAM, "sweep", str(self.study()), "-o", str(self.out)],
                                   stderr=subprocess.DEVNULL)
        deadline = time.time() + 60
        while not list(self.out.glob("runs/*/run.json")) and time.time() < deadline:
            time.sleep(0.01)
        done = run("sweep", self.study(), "-o", self.out, "--resume")
        process.kill()
        process.wait()
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("another rondo is at work here", done.stderr)


if __name__ == "__main__":
    unittest.main()

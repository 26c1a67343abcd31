# SPDX-License-Identifier: BSD-3-Clause
"""rondo fmu of wheels in three dimensions whose cases name files, meshes and roads, that come along; a car on four wheels."""
import os
import sys
import unittest
import unittest.mock

import numpy as np

from program import ROOT, history, run
from test_fmu_space import CASE, FORCES, STEP, SpaceTest, made, setUpModule  # noqa: F401

sys.path.insert(0, str(ROOT / "examples" / "fmu"))
import four_wheels  # noqa: E402


class Tyre(SpaceTest):
    def test_an_inflated_tyre_brings_its_mesh_along(self):
        """No program reads it where the FMU is loaded. Its forces are those of the run, which has what no mode has at
        its one spin, as the FMU has it between three up to 60 m/s."""
        case = ROOT / "cases" / "tyre-rolling.toml"
        down = ("motion.height=[[0,0.318],[1,-0.082]]", "output.history_interval=0", "time.end=0.03",
                "output.snapshots=0")
        words = [word for s in down for word in ("--set", s)]
        made("run", case, "--reduced", "--reduced-step", STEP, "-o", self.folder / "run", *words)
        own = history(self.folder / "run")
        folder = self.wheel_of("tyre", case, *down)
        with unittest.mock.patch.dict(os.environ, {"RONDO_MESH_READER": "/none"}):
            fmu = self.instance(folder)
        rows = []
        for k in range(150):
            fmu.step(k * STEP, STEP)
            rows.append(fmu.get("contact_force_x", "contact_force_y", "contact_force_z"))
        rows = np.array(rows)
        largest = rows[:, 2].max()
        self.assertGreater(largest, 800.0)
        for column, i, sign in (("force_x", 0, 1), ("force_lateral", 1, -1), ("force_y", 2, 1)):
            np.testing.assert_allclose(sign * rows[:, i], np.asarray(own[column])[-150:], rtol=0,
                                       atol=5e-5 * largest, err_msg=column)
        self.assertEqual(fmu.messages, [])
        mesh = folder / "resources" / "section.mesh"
        for damaged in (mesh.read_bytes()[:-9], mesh.read_bytes()[:30], b"something else"):
            mesh.write_bytes(damaged)
            other = self.instance(folder, begins=False)
            with self.assertRaisesRegex(RuntimeError, "damaged mesh of an FMU|no Gmsh mesh"):
                other.begin()


class Road(SpaceTest):
    def test_a_road_comes_along(self):
        """Its own file is gone when the FMU is loaded, whose forces are those of the run over the cobbles:
        as on flat ground but for what no mode has, which nodes on stones feel one by one."""
        road, case = self.folder / "stones.crg", self.folder / "on-stones.toml"
        road.write_bytes((ROOT / "cases" / "roads" / "cobbles.crg").read_bytes())
        case.write_text(CASE.read_text().replace('profile = "flat"', 'road = "stones.crg"\nroad_offset = 0.05'))
        down = ("motion.height=[[0,0.315],[1,-0.085]]", "output.history_interval=0", "time.end=0.06",
                "output.snapshots=0")
        words = [word for s in down for word in ("--set", s)]
        made("run", case, "--reduced", "--reduced-step", STEP, "-o", self.folder / "run", *words)
        own = history(self.folder / "run")
        folder = self.wheel_of("stones", case, *down)
        road.unlink()
        fmu = self.instance(folder)
        rows = []
        for k in range(300):
            fmu.step(k * STEP, STEP)
            rows.append(fmu.get(*FORCES[:3]))
        rows = np.array(rows)
        largest = rows[:, 2].max()
        self.assertGreater(largest, 1e4)
        for column, i, sign in (("force_x", 0, 1), ("force_lateral", 1, -1), ("force_y", 2, 1)):
            np.testing.assert_allclose(sign * rows[:, i], np.asarray(own[column])[-300:], rtol=0,
                                       atol=1e-4 * largest, err_msg=column)

    def test_a_road_in_two_files_is_refused(self):
        road, case = self.folder / "stones.crg", self.folder / "on-stones.toml"
        (self.folder / "heights.crg").write_bytes((ROOT / "cases" / "roads" / "cobbles.crg").read_bytes())
        road.write_text("$CT\nrefers\n$\n$ROAD_CRG_FILE\nheights.crg\n$\n$$$$\n")
        case.write_text(CASE.read_text().replace('profile = "flat"', 'road = "stones.crg"\nroad_offset = 0.05'))
        done = run("fmu", case, "-o", self.folder / "none.fmu")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("refers to another file", done.stderr)


class Example(SpaceTest):
    def test_a_car_on_four_wheels(self):
        """Its weight is on the wheels; in a turn to the left they push to the left, more of it on the right; over the
        cleat the left wheels come 0.87 m before the right ones."""
        wheel = self.wheel_of("car", ROOT / "cases" / "wheel3d-car.toml")
        lane, _ = four_wheels.drive(wheel, 10.0, 0.9, four_wheels.lane_change, 2)
        cleat, _ = four_wheels.drive(wheel, -5.0, 0.9, lambda t: 0.0, 1)
        lane, cleat = (dict(zip(four_wheels.COLUMNS, rows.T)) for rows in (lane, cleat))

        def of_wheels(table, name):
            return np.array([table[f"contact_force_{name}_{wheel}"] for wheel in four_wheels.WHEELS])

        settled = np.searchsorted(lane["time_s"], four_wheels.SETTLED)
        mass = 1040 + 4 * (20 + 23.3167)
        self.assertAlmostEqual(of_wheels(lane, "z")[:, settled].sum() / (mass * 9.81), 1.0, delta=0.01)
        left, right = of_wheels(lane, "z")[::2, -1].sum(), of_wheels(lane, "z")[1::2, -1].sum()
        self.assertGreater(right, 1.3 * left)
        self.assertAlmostEqual(of_wheels(lane, "y")[:, -1].sum() / (mass * lane["lateral_acceleration"][-1]), 1.0,
                               delta=0.03)
        self.assertGreater(lane["lateral_acceleration"][-1], 2.0)
        self.assertGreater(lane["y_m"][-1], 0.05)
        self.assertGreater(lane["roll_rad"][-1], 0.01)  # the left side rises
        late = cleat["time_s"] > four_wheels.SETTLED
        peaks = cleat["time_s"][late][of_wheels(cleat, "z")[:, late].argmax(axis=1)]
        self.assertAlmostEqual(peaks[1] - peaks[0], 1.5 * np.tan(0.5236) / four_wheels.SPEED, delta=0.004)
        self.assertAlmostEqual(peaks[2] - peaks[0], 2.6 / four_wheels.SPEED, delta=0.004)


if __name__ == "__main__":
    unittest.main()

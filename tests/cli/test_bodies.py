# SPDX-License-Identifier: BSD-3-Clause
"""The shipped cases of bodies from meshes and of free bodies, as docs/validation.md has them."""
import unittest

import h5py
import numpy as np
from program import ROOT, ProgramTest, history, run, said, summary


def mean_velocity(h, name, start, end):
    """Of a column of places, between the first rows at or after two times; the time midway."""
    time = h["time_s"][np.searchsorted(h["time_s"], (start, end))]
    place = h[name][np.searchsorted(h["time_s"], (start, end))]
    return (place[1] - place[0]) / (time[1] - time[0]), time.mean()


class Bodies(ProgramTest):
    def run_case(self, name, **settings):
        out = self.folder / "out"
        sets = [part for key, value in settings.items()
                for part in ("--set", f"{key.replace('__', '.')}={value}")]
        done = run("run", ROOT / "cases" / f"{name}.toml", "-o", out, "--quiet", *sets)
        self.assertEqual((done.returncode, said(done)), (0, ""))
        return out, history(out)

    def test_bar_on_wall(self):
        out, h = self.run_case("bar-on-wall")
        time, pressed = h["time_s"], h["force_y"] > 0
        step = summary(out)["step"]
        self.assertAlmostEqual(step, 0.003, delta=1e-12)  # 0.9 h/c
        self.assertAlmostEqual(time[pressed][0], 0.5, delta=step)
        self.assertAlmostEqual(time[pressed][-1], 0.5 + 2 / 3, delta=0.5 * 0.1**(2 / 3))
        self.assertAlmostEqual(mean_velocity(h, "center_y_m", 1.5, 2.0)[0], 9.9155, delta=5e-5)
        self.assertAlmostEqual(h["loss_impact"][-1], 50 / 200, delta=1e-9)  # E0/(2N)

    def test_bouncing_bar(self):
        _, h = self.run_case("bouncing-bar")
        self.assertAlmostEqual(1 - h["loss_impact"][-1] / 50, 0.99127, delta=5e-6)
        # As slender as it is, it has not begun to topple.
        self.assertLess(abs(h["angle_rad"][-1]), 1e-6)

    def test_block_slides(self):
        _, h = self.run_case("block-on-incline")
        (slow, before), (fast, after) = (mean_velocity(h, "center_x_m", t, t + 0.1)
                                         for t in (0.5, 0.8))
        acceleration = (fast - slow) / (after - before) / np.cos(np.pi / 6)
        self.assertAlmostEqual(acceleration, 2.356287, delta=1e-5)

    def test_block_sticks(self):
        out, _ = self.run_case("block-on-incline", ground__friction=0.87)
        with h5py.File(out / "results.h5") as file:
            u = file["snapshots/displacement"][:][:, file["mesh/boundary"][:]]
            late = file["frame/time"][:] >= 0.5
        travel = np.abs(u[late] - u[late][0]).max(axis=(0, 2))
        self.assertEqual((travel == 0.0).sum(), 8)  # to the last bit
        self.assertLess(travel.max(), 1e-6)  # the three that hang

    def test_thrown_disk(self):
        _, h = self.run_case("thrown-disk", disk__mesh__circumferential=120)
        speed, _ = mean_velocity(h, "center_x_m", 0.1, 0.199)
        # A polygon's corners take 20/N², masses at the nodes 5e-4 (docs/validation.md).
        self.assertAlmostEqual(speed / 0.580645, 1.0, delta=20 / 120**2 + 5e-4)

    def test_two_disks(self):
        out, h = self.run_case("two-disks")
        self.assertGreater(h["contact_nodes"].max(), 2)
        self.assertEqual(h["contact_nodes"][-1], 0)  # they have parted
        with h5py.File(out / "results.h5") as file:
            mass = file["mesh/mass"][:]
            place = file["mesh/coordinates"][:] + file["snapshots/displacement"][:]
            momentum = mass[:, None] * file["snapshots/velocity"][:]
        size = np.abs(momentum).sum(axis=(1, 2)).max()  # of the two disks, without their signs
        linear = momentum.sum(axis=1)
        angular = (place[..., 0] * momentum[..., 1] - place[..., 1] * momentum[..., 0]).sum(axis=1)
        # Written velocities are of the half step after the places: x × v differs by v × v = 0.
        self.assertLess(np.abs(linear - linear[0]).max(), 1e-12 * size)
        self.assertLess(np.abs(angular - angular[0]).max(), 1e-12 * size)
        self.assertGreater(abs(h["angle_rad"][-1]), 0.2)

    def test_tyre_section(self):
        out, h = self.run_case("tyre-section", time__end=0.03)
        self.assertTrue(2e4 < h["force_y"][-1] < 4e4)
        self.assertLess(summary(out)["energy_residual_relative"], 1e-12)
        self.assertGreater(h["work_load"][-1], 0.0)


if __name__ == "__main__":
    unittest.main()

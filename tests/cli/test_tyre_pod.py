# SPDX-License-Identifier: BSD-3-Clause
"""rondo pod of a tyre that rolls: three components, about the inflated state, in both frames."""
import json
import unittest

import h5py
import numpy as np

from pod_reference import reference, spectrum
from test_pod import PodTest
from test_tyre import GROUND, MOVING
from test_tyre import MESH as FULL
from test_tyre_rolling import MESH

ROLLING = (MOVING + GROUND).replace(str(FULL), str(MESH)).replace("mass = 20.0", "mass = 150.0").replace(
    "height = 0.308", "height = [[0.0, 0.3161], [0.01, 0.306]]").replace("end = 0.004", "end = 0.03").replace(
    "snapshots = 3", "snapshots = 21\nsnapshots_from = 0.01").replace("sectors = 24", "sectors = 40")


class Tyre(PodTest):
    def test_modes_have_three_components_and_are_about_the_inflated_state(self):
        out = self.make(ROLLING)
        for field, frame in (("displacement", "rotating"), ("displacement", "rectified"), ("velocity", "rectified")):
            with self.subTest(field=field, frame=frame):
                self.pod(out, "--field", field, "--frame", frame.replace("rotating", "co-rotating"), "--modes", 4)
                folder = f"{field}-{frame}"
                u, _, _ = self.check_against_numpy(out, reference(out, field, frame), folder)
                with h5py.File(out / "pod" / folder / "pod.h5") as file:
                    modes, places = file["/modes/spatial"][:], file["/mesh/coordinates"][:]
                    mass = np.repeat(file["/mesh/mass"][:], 3)
                self.assertEqual(modes.shape, (4, *places.shape))
                phi = modes.reshape(4, -1)
                np.testing.assert_allclose(phi * mass @ phi.T, np.eye(4), atol=1e-13)
                np.testing.assert_allclose(abs(np.sum(np.sqrt(mass) * phi * u[:, :4].T, axis=1)), 1.0, atol=1e-8)
        inflated = json.loads((out / "run.json").read_text())["inflation"]["outer_radius_m"]
        self.assertAlmostEqual(np.hypot(places[:, 0], places[:, 1]).max(), inflated, delta=1e-12)
        # The footprint stands still in space: there one mode is nearly all of it.
        first = [spectrum(out / "pod" / f"displacement-{frame}")["energy"][0] for frame in ("rotating", "rectified")]
        self.assertGreater(first[1], 0.9)
        self.assertLess(first[0], 0.8)


if __name__ == "__main__":
    unittest.main()

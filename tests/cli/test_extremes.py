# SPDX-License-Identifier: BSD-3-Clause
"""Numbers at the ends of the range of doubles: each case is done, refused or fails, and none ends by a signal."""
import os
import unittest
from concurrent.futures import ThreadPoolExecutor

from program import SMALL, ProgramTest, replaced, run

TINY = replaced(replaced(SMALL, "radial", "radial = 2"), "circumferential", "circumferential = 12")
TINY = replaced(TINY, "end", "end = 0.0005")
ROLLING = ["analysis.kind=steady-rolling", "motion.height=0.29"]
SOLID = ["disk.width=0.1", "disk.mesh.axial=2"]
CRUSH = ["analysis.kind=crush", "analysis.depth=0.01", "analysis.increments=2"]
ENDS = ("1e300", "1e-300", "5e-324")
BODY = ("material.youngs_modulus", "material.density")
SPUN = ("motion.angular_velocity", "damping.mass", "damping.stiffness", "motion.gravity")
# What was seen to abort, or to crash, and its neighbours: command, settings, keys.
SWEEPS = (
    ("run", ROLLING, (*BODY, *SPUN)),
    ("run", ROLLING + ["material.stress_stiffening=centrifugal"], ("material.density", "motion.angular_velocity")),
    ("run", ROLLING + SOLID, (*BODY, *SPUN, "disk.width")),
    ("run", SOLID, ("disk.width",)),
    ("run", CRUSH + ["analysis.solver=latin-pgd"], ("material.youngs_modulus", "analysis.depth")),
    ("modes", [], BODY),
    ("modes", ["disk.mesh.radial=1"], (*BODY, "motion.angular_velocity")),
)


class Extremes(ProgramTest):
    def test_none_ends_by_a_signal(self):
        case = self.case(TINY)
        jobs = [(command, [*settings, f"{key}={end}"])
                for command, settings, keys in SWEEPS for key in keys for end in ENDS]

        def end_of(job):
            number, (command, settings) = job
            more = [a for setting in settings for a in ("--set", setting)]
            done = run(command, case, "-o", self.folder / str(number), *more,
                       env={**os.environ, "OMP_NUM_THREADS": "1"})
            return done.returncode, done.stderr

        with ThreadPoolExecutor(os.cpu_count()) as pool:
            for (command, settings), (code, told) in zip(jobs, pool.map(end_of, enumerate(jobs))):
                self.assertIn(code, (0, 2, 3), (command, settings, told))
                self.assertNotIn("broken contract", told, (command, settings))

    def test_a_width_that_numbers_do_not_tell_from_none(self):
        more = [a for setting in (*SOLID, "disk.width=5e-324") for a in ("--set", setting)]
        done = run("check", self.case(TINY), *more)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("disk.width", done.stderr)


if __name__ == "__main__":
    unittest.main()

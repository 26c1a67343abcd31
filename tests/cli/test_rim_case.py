# SPDX-License-Identifier: BSD-3-Clause
"""[rim] from outside: what check tells, and who refuses or warns of it."""
import unittest

from program import ProgramTest, SMALL, line_of, replaced, run

RIM = """[rim]
free = ["height", "angular_velocity"]
mass = 100.0
inertia = 1.0
force_y = [[0, 0], [0.01, -1.0e5]]
[rim.support.y]
damping = 6.0e4
"""
WHEEL = replaced(SMALL, "height", "height = 0.3") + RIM


class RimCase(ProgramTest):
    def said(self, command, *arguments, text=WHEEL, code=0):
        done = run(command, self.case(text), *arguments)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def test_check_tells_the_rim(self):
        lines = self.said("check").stdout
        for line in ("rim                free height, angular_velocity; held speed\n",
                     "load at the end    force_y -100000 N/m, torque 0 N, brake 0 N\n",
                     "support along y    spring 0 N/m2 at rest at 0.3 m, dashpot 60000 N s/m2\n",
                     "slip at t = 0      "):
            self.assertIn(line, lines)
        self.assertNotIn("deflection", lines)  # of a free height nobody knows before
        self.assertNotIn("rim ", run("check", self.case(SMALL)).stdout)

    def test_faults_have_their_lines(self):
        held = WHEEL.replace('["height", "angular_velocity"]', "[]")
        line = line_of(held, "force_y")
        said = self.said("check", text=held, code=2).stderr
        self.assertIn(f"case.toml:{line}:11: rim.force_y", said)
        self.assertIn("has no effect, because motion.height is held", said)
        self.assertIn('rim.free with "height"', said)
        self.assertIn("rim.support.y.damping", said)

    def test_modes_are_those_of_a_rim_that_is_held(self):
        part = "[rim] has no effect on modes"
        self.assertIn(part, self.said("modes", "-o", self.folder / "modes").stderr)
        held = SMALL + "[rim]\nfree = []\n"
        self.assertNotIn(part, self.said("modes", "-o", self.folder / "held", text=held).stderr)


if __name__ == "__main__":
    unittest.main()

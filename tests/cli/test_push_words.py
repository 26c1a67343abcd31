# SPDX-License-Identifier: BSD-3-Clause
"""The words of `rondo check` on the way in which a wheel is pushed, against the signs of runs."""
import re
import unittest

from program import ROOT, SMALL, ProgramTest, history, replaced, run, settings, summary

STEADY = replaced((ROOT / "cases" / "wheel3d-steady.toml").read_text(), "slip_angle", None)
FREE = replaced(STEADY, "speed", None)
PLANE = "\n".join(line for line in SMALL.split("[time]")[0].splitlines() if not line.startswith("height"))
PLANE = PLANE.replace("[motion]", "[motion]\nheight = 0.29") + '\n[analysis]\nkind = "steady-rolling"\n'
PLANE_FREE = replaced(PLANE, "speed", None)
CROWNED = ["disk.crown_radius=0.2", "motion.height=0.296"]
COARSE = ["disk.mesh.circumferential=45"]
IN_TIME = (STEADY.replace('[analysis]\nkind = "steady-rolling"', "[time]\nend = 0.02\n[output]\nhistory_interval = 1e-3\nsnapshots = 0")
           .replace("circumferential = 90", "circumferential = 30").replace("height = 0.29 ", "height = [[0.0, 0.3001], [0.004, 0.297]] "))
RIM = SMALL.replace("height = [[0, 0.3], [0.004, 0.296]]", "height = 0.297\n[rim]\nfree = [\"angular_velocity\"]\ninertia = 0.1").replace(
    "end = 0.02", "end = 0.1")
COLUMN = re.compile(r"(?<!ISO )\b(force_x|force_lateral|moment_aligning) ([<>]) 0")
ISO = re.compile(r"ISO (F_x|F_y|M_z) ([<>]) 0")
OF_ISO = {"F_x": ("force_x", 1), "F_y": ("force_lateral", -1), "M_z": ("moment_aligning", 1)}


class PushWords(ProgramTest):
    def lines(self, text, *given):
        """What check says of pushes, by what pushes."""
        done = run("check", self.case(text), *settings(*given))
        self.assertEqual(done.returncode, 0, done.stderr)
        found = [line for line in done.stdout.splitlines() if line.startswith("push")]
        return {line[:18].strip(): line[19:] for line in found}

    def forces(self, text, *given):
        """Of a run: those of the steady state, or the means of its second half."""
        out = self.folder / "out"
        done = run("run", self.case(text), "-o", out, "--overwrite", "--quiet", *settings(*given))
        self.assertEqual(done.returncode, 0, done.stderr)
        if "steady" in summary(out):
            return summary(out)["steady"]
        rows = history(out)
        half = len(rows["time_s"]) // 2
        return {name: values[half:].mean() for name, values in rows.items()}

    def agree(self, text, *given, alone, signs, iso=True, size=1.0):
        """The words that are there, which signs they tell, and that the run has these."""
        lines = self.lines(text, *given)
        self.assertIn(alone, lines, lines)
        words = lines[alone]
        found = dict(COLUMN.findall(words))
        self.assertEqual(found, signs, words)
        forces = self.forces(text, *given)
        for name, sign in found.items():
            self.assertGreater(forces[name] * (1 if sign == ">" else -1), size, (words, forces[name]))
        for name, sign in ISO.findall(words):
            column, sense = OF_ISO[name]
            self.assertEqual(sign == ">", sense * forces[column] > 0, words)
        self.assertEqual(bool(ISO.search(words)), iso, words)
        if "force_lateral" in found:
            side = "right" if forces["force_lateral"] > 0 else "left"
            self.assertRegex(words, rf"to the {side}, force_lateral")
        return words

    def test_slip_angle(self):
        for angle, sign, turned in ((0.02, "<", "left"), (-0.02, ">", "right")):
            words = self.agree(STEADY, *COARSE, f"motion.slip_angle={angle}", alone="push of slip angle", size=100,
                               signs={"force_lateral": sign})
            self.assertIn(f"turned to the {turned} of its velocity by 1.146°", words)

    def test_slip_angle_backwards(self):
        for angle, sign, moves in ((0.02, ">", "left"), (-0.02, "<", "right")):
            words = self.agree(STEADY, *COARSE, "motion.speed=-10", "motion.angular_velocity=-33.76455", f"motion.slip_angle={angle}",
                               alone="push of slip angle", size=100, iso=False, signs={"force_lateral": sign})
            self.assertIn(f"backwards and moves to the {moves}", words)

    def test_slip_angle_in_time(self):
        for angle, sign in ((0.02, "<"), (-0.02, ">")):
            self.agree(IN_TIME, f"motion.slip_angle=[[0.0, 0.0], [0.004, {angle}]]", alone="push of slip angle", size=10,
                       signs={"force_lateral": sign})

    def test_slip_angle_that_changes_its_sign(self):
        text, given = IN_TIME, "motion.slip_angle=[[0.0, 0.02], [0.01, 0.02], [0.012, -0.02]]"
        words = self.lines(text, given)["push of slip angle"]
        self.assertIn("to the left and to the right of its velocity", words)
        self.assertIn("force_lateral < 0 and ISO F_y > 0 while motion.slip_angle > 0", words)
        self.forces(text, given)
        rows = history(self.folder / "out")
        for time, sign in ((0.0095, -1), (0.0195, 1)):
            row = abs(rows["time_s"] - time).argmin()
            self.assertGreater(sign * rows["force_lateral"][row], 1.0)

    def test_turn_slip(self):
        for turn, lateral, aligning, side in ((0.1, ">", "<", "left"), (-0.1, "<", ">", "right")):
            words = self.agree(STEADY, *COARSE, f"motion.turn_slip={turn}", alone="push of turn slip",
                               signs={"force_lateral": lateral, "moment_aligning": aligning})
            self.assertIn(f"bends to the {side}, with a radius of 10 m: most wheels are pushed outwards", words)
            self.agree(STEADY, *COARSE, "motion.speed=-10", "motion.angular_velocity=-33.76455", f"motion.turn_slip={turn}",
                       alone="push of turn slip", iso=False, signs={"force_lateral": lateral})

    def test_torque_at_a_large_slip_angle(self):
        """A small torque that brakes, and the ground pushes the wheel along its heading: friction sideways is larger."""
        given = ["motion.slip_angle=-0.2", "analysis.torque=-50", "ground.friction=1", *COARSE]
        self.assertIn("if the torque is well above that of rolling with this slip angle", self.lines(FREE, *given)["push of torque"])
        self.assertGreater(self.forces(FREE, *given)["force_x"], 100)

    def test_camber_of_a_crowned_and_of_a_flat_tread(self):
        """The words name both; the crowned wheel has the one, the flat one the other."""
        for camber, side, sign in ((0.05, "left", "<"), (-0.05, "right", ">")):
            given = f"motion.camber={camber}"
            words = self.lines(STEADY, given)["push of camber"]
            self.assertIn(f"leans its top to the {side} by 2.865°", words)
            self.assertIn(f"crowned tread on a short footprint is pushed to the {side} (force_lateral {sign} 0, ISO F_y", words)
            sense = -1 if sign == "<" else 1
            self.assertGreater(sense * self.forces(FREE, *CROWNED, given, "analysis.torque=0")["force_lateral"], 10)
            self.assertLess(sense * self.forces(FREE, given, "analysis.torque=0")["force_lateral"], -10)

    def test_torque_of_steady_rolling(self):
        for text, solid in ((FREE, True), (PLANE_FREE, False)):
            for torque, sign, word in ((200, ">", "driven"), (-200, "<", "braked")):
                given = [f"analysis.torque={torque}"] if solid else [f"analysis.torque={10 * torque}"]
                words = self.agree(text, *given, alone="push of torque", size=100, iso=solid, signs={"force_x": sign})
                self.assertIn(f"{word} by analysis.torque: the ground pushes it {'ahead' if sign == '>' else 'back'}", words)
        words = self.agree(FREE, "motion.angular_velocity=-33.76455", "analysis.torque=-200", alone="push of torque", size=100, iso=False,
                           signs={"force_x": "<"})
        self.assertIn("driven by analysis.torque: the ground pushes it towards -x", words)
        self.assertIn("rolls freely", self.lines(FREE, "analysis.torque=0")["push of torque"])

    def test_traction(self):
        for force, sign in ((300, ">"), (-300, "<")):
            self.agree(FREE, f"analysis.traction={force}", alone="push of traction", size=299, signs={"force_x": sign})

    def test_spin_against_speed(self):
        for text, solid in ((STEADY, True), (PLANE, False)):
            for speed, sign, word in ((9.3, ">", "driven"), (10.9, "<", "braked")):
                words = self.agree(text, f"motion.speed={speed}", alone="push of the spin", size=100, iso=solid, signs={"force_x": sign})
                self.assertTrue(words.startswith(word), words)
        words = self.agree(STEADY, "motion.speed=-9.3", "motion.angular_velocity=-33.76455", alone="push of the spin", size=100, iso=False,
                           signs={"force_x": "<"})
        self.assertTrue(words.startswith("driven"), words)
        words = self.lines(STEADY)["push of the spin"]  # at 10 m/s
        self.assertIn("near free rolling: V/w = 0.2962 m", words)
        self.assertFalse(COLUMN.search(words))

    def test_free_rolling_below_the_axle_and_beyond_the_tread(self):
        """What can be squeezed rolls freely at a V/w below the height of its axle, what cannot at one above its outer
        radius: between these radii and V/w no sign is told, which one would guess wrong."""
        fine = ["disk.mesh.circumferential=90", "disk.mesh.radial=6"]
        for given, sign in ((["material.poissons_ratio=0", "motion.height=0.2985", "motion.speed=9.9"], -1),  # V/w = 0.297 m
                            (["material.poissons_ratio=0.49", 'material.integration="b-bar"', "motion.height=0.285",
                              "motion.speed=10.35"], 1)):  # 0.3105 m
            words = self.lines(PLANE, *fine, *given)["push of the spin"]
            self.assertIn("near free rolling", words)
            self.assertFalse(COLUMN.search(words), words)
            self.assertGreater(sign * self.forces(PLANE, *fine, *given)["force_x"], 100)

    def test_spin_that_changes(self):
        text = RIM.split("[rim]")[0] + "[ground]" + RIM.split("[ground]")[1]
        given = "motion.speed=[[0, 9], [0.04, 9], [0.06, 11.2]]"
        self.assertIn("force_x > 0 while it is above, < 0 while it is below", self.lines(text, given)["push of the spin"])
        self.forces(text, given)
        rows = history(self.folder / "out")
        for first, last, sign in ((0.02, 0.04, 1), (0.06, 0.1, -1)):
            chosen = (rows["time_s"] > first) & (rows["time_s"] <= last)
            self.assertGreater(sign * rows["force_x"][chosen].mean(), 100)

    def test_torque_and_brake_of_a_rim(self):
        for given, name, sign in ((["rim.torque=2000"], "push of torque", ">"), (["rim.torque=-2000"], "push of torque", "<"),
                                  (["rim.brake=2000"], "push of the brake", "<")):
            self.agree(RIM, *given, alone=name, size=100, iso=False, signs={"force_x": sign})
        back = ["motion.speed=-10", "motion.angular_velocity=-33.333333"]
        self.agree(RIM, *back, "rim.brake=2000", alone="push of the brake", size=100, iso=False, signs={"force_x": ">"})
        self.assertIn("as if alone", self.lines(RIM, "rim.torque=2000", "rim.brake=2000")["pushes along"])

    def test_a_rim_that_is_pulled_as_well(self):
        """A torque that drives and a force that pulls the wheel faster than the torque: the ground pushes it back, and
        the words do not deny it."""
        rolls = replaced(RIM, "free", 'free = ["speed", "angular_velocity"]\nmass = 10.0')
        for given in (["rim.force_x=50000"], ["motion.slope=0.5", "motion.gravity=9.81"],
                      ["rim.support.x.stiffness=1e5"], ["rim.support.x.damping=1e3"]):
            words = self.lines(rolls, "rim.torque=100", *given)
            self.assertNotIn("push of torque", words)
            self.assertIn("the run tells the sign of force_x", words["pushes along"])
        self.assertIn("push of torque", self.lines(rolls, "rim.torque=100"))
        self.assertIn("the run tells", self.lines(RIM, "rim.torque=100", "motion.speed=[[0, 10], [0.1, 12]]")["pushes along"])
        self.assertLess(self.forces(rolls, "rim.torque=100", "rim.inertia=1", "rim.force_x=50000")["force_x"], -100)
        self.assertGreater(self.forces(rolls, "rim.torque=2000", "rim.inertia=1")["force_x"], 100)

    def test_where_nothing_pushes(self):
        words = self.lines(STEADY, "ground.friction=0", "motion.slip_angle=0.02")
        self.assertEqual(list(words), ["push"])
        self.assertIn("no friction", words["push"])
        forces = self.forces(STEADY, "ground.friction=0", "motion.slip_angle=0.02")
        self.assertLess(abs(forces["force_lateral"]) + abs(forces["force_x"]), 1e-6 * forces["force_y"])
        crush = ["analysis.kind=crush", "analysis.depth=0.01", "analysis.increments=4"]
        self.assertEqual(self.lines(SMALL, *crush), {})

    def test_several_at_once(self):
        words = self.lines(STEADY, "motion.slip_angle=0.02", "motion.camber=0.05")
        self.assertIn("as if alone", words["pushes to a side"])
        self.assertNotIn("pushes to a side", self.lines(STEADY, "motion.slip_angle=0.02"))


if __name__ == "__main__":
    unittest.main()

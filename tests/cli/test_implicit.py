# SPDX-License-Identifier: BSD-3-Clause
"""[[solver.implicit]] from outside: what is refused, what is told, kills and resuming."""
import re
import unittest

from program import ROOT, SMALL, ProgramTest, history, line_of, replaced, run, summary
from test_resume import Killed, LONG, ResumeTest

IMPLICIT = "[[solver.implicit]]\n"
BELT = SMALL + "[[material.region]]\nlayers = [2]\nyoungs_modulus = 2.0e9\n"
TYRE = (ROOT / "cases" / "tyre-section.toml").read_text().replace(
    'file = "meshes/', f'file = "{ROOT}/cases/meshes/')


def layers(*numbers):
    return IMPLICIT + f"layers = {list(numbers)}\n"


class Refused(ProgramTest):
    def refused(self, text, fragments, line="[[solver.implicit]]"):
        case = self.case(text)
        for command in ("check", "run"):
            done = run(command, case, *(["-o", self.folder / "out"] if command == "run" else []))
            self.assertEqual(done.returncode, 2, done.stderr)
            for fragment in fragments:
                self.assertIn(fragment, done.stderr)
            self.assertIn(f"case.toml:{line_of(text, line)}:", done.stderr)
            self.assertFalse((self.folder / "out").exists())

    def test_what_is_not_there(self):
        for table, fragments, line in [
                ("layers = [4]", ["solver.implicit[0].layers", "no layer 4", "1, at the rim, to 3"],
                 "layers"),
                ('region = "belt"', ["solver.implicit[0].region", "a [disk] has no physical surfaces"],
                 "region"),
                ("", ["solver.implicit[0]", "chooses no elements", "slower_than"], IMPLICIT.strip()),
                ("layers = [1]\nslower_than = 1e-5", ["by more than one key"], IMPLICIT.strip()),
                ("slower_than = 1e-9", ["chooses no element", "longer slower_than"],
                 IMPLICIT.strip()),
                ("slower_than = 0.0", ["solver.implicit[0].slower_than", "> 0"], "slower_than"),
                ("layers = []", ["solver.implicit[0].layers"], "layers"),
                ("layers = [1, 1]", ["solver.implicit[0].layers"], "layers")]:
            with self.subTest(table):
                self.refused(SMALL + IMPLICIT + table + "\n", fragments, line)
        self.refused(TYRE + IMPLICIT + 'region = "beltt"\n',
                     ["solver.implicit[0].region", "no cell of the mesh", "belt"], "region")
        self.refused(TYRE + layers(1), ["a [mesh] has no layers"], "layers")

    def test_what_it_does_not_go_with(self):
        printed = replaced(SMALL, "end", 'scheme = "as-printed"\nend = 0.02')
        self.refused(printed + layers(2), ["time.scheme", '"symplectic"'])
        rim = replaced(SMALL, "height", "height = 0.3") + (
            '[rim]\nfree = ["height"]\nmass = 100.0\nforce_y = -1e5\n')
        self.refused(rim + layers(2), ["[rim]", "a rim that follows [motion]"])
        free = SMALL[:SMALL.index("[motion]")].replace(
            "inner_radius = 0.15", 'inner_radius = 0.15\nrim = "free"') + (
                "[initial]\nvelocity = [1.0, 0.0]\n[time]\nend = 0.02\n")
        self.refused(free + layers(2), ["do not support free bodies", 'disk.rim = "bonded"'])

    def test_contacts_that_are_solved_elsewhere(self):
        sharp = SMALL.replace('profile = "flat"', "profile = [[-9, -0.1], [0, 0], [9, -0.1]]")
        self.refused(sharp + layers(3), ["sharp convex corners", "ground.fillet"])
        self.refused(TYRE + IMPLICIT + "slower_than = 1.0\n",
                     ["node", "other bodies", "away from the contact boundary"])
        for text in (sharp + layers(2), sharp.replace("friction", "fillet = 0.5\nfriction")
                     + layers(3)):
            done = run("check", self.case(text))
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_all_implicit_wants_a_step(self):
        text = SMALL + layers(1, 2, 3)
        done = run("check", self.case(text))
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("all elements are implicit", done.stderr)
        self.assertIn("time.step", done.stderr)
        text = replaced(text, "end", "end = 0.02\nstep = 1.0e-4")
        done = run("run", self.case(text), "-o", self.folder / "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        s = summary(self.folder / "out")
        self.assertEqual(s["steps"], 200)
        self.assertIsNone(s["critical_step"])
        self.assertLess(s["energy_residual_relative"], 1e-12)


class Told(ProgramTest):
    def run_ok(self, text, name, *extra):
        done = run("run", self.case(text), "-o", self.folder / name, *extra)
        self.assertEqual(done.returncode, 0, done.stderr)
        return summary(self.folder / name)

    def test_the_summary(self):
        plain = self.run_ok(BELT, "plain")
        self.assertNotIn("implicit_dofs", plain)
        self.assertNotIn("critical_step_plain", plain)
        s = self.run_ok(BELT + layers(2), "belt")
        self.assertEqual(s["implicit_dofs"], 2 * 2 * 40)  # both sides of a layer
        self.assertAlmostEqual(s["critical_step_plain"], plain["critical_step"],
                               delta=1e-9 * plain["critical_step"])
        self.assertGreater(s["critical_step"], 5.0 * plain["critical_step"])
        self.assertAlmostEqual(s["step"], 0.8 * s["critical_step"], delta=1e-12)
        self.assertLess(s["energy_residual_relative"], 1e-12)
        self.assertGreater(plain["steps"], 15 * s["steps"])

    def test_the_force_is_that_of_explicit_elements_where_the_step_is_small(self):
        for name, text in (("plain", BELT), ("belt", BELT + layers(2))):
            self.run_ok(text, name, "--set", f"time.safety={0.8 if name == 'plain' else 0.1}")
        force = [history(self.folder / name)["force_y"][-150:].mean() for name in ("plain", "belt")]
        self.assertAlmostEqual(force[1], force[0], delta=0.01 * force[0])

    def test_the_three_ways_to_choose_are_one(self):
        by_layer = self.run_ok(BELT + layers(2), "layer")
        own = (by_layer["critical_step_plain"] * by_layer["critical_step"]) ** 0.5
        self.run_ok(BELT + IMPLICIT + f"slower_than = {own}\n", "slow")
        self.run_ok(BELT + layers(2) + layers(2), "twice")
        for name in ("slow", "twice"):
            self.assertEqual((self.folder / name / "history.csv").read_bytes(),
                             (self.folder / "layer" / "history.csv").read_bytes(), name)

    def test_both_operators_agree(self):
        force = []
        for operator in ("cyclic", "sparse"):
            s = self.run_ok(BELT + layers(2, 3) + f'[solver]\noperator = "{operator}"\n', operator)
            self.assertEqual(s["operator"], operator)
            self.assertGreater(s["contact"]["clusters_solved"], 0)
            force.append(history(self.folder / operator)["force_y"])
        self.assertLess(abs(force[0] - force[1]).max(), 1e-6 * abs(force[0]).max())

    def test_check_tells_the_step(self):
        steps = []
        for text in (BELT, BELT + layers(2)):
            said = run("check", self.case(text)).stdout
            self.assertEqual("implicit elements  40 of 120 (160 dofs)" in said, text is not BELT)
            steps.append(float(re.search(r"^critical step +([0-9.e-]+)", said, re.M)[1]))
        self.assertGreater(steps[1], 5.0 * steps[0])

    def test_a_region_of_a_mesh(self):
        text = replaced(TYRE, "end", "end = 2e-4").replace("snapshots = 100", "snapshots = 2")
        s = self.run_ok(text + IMPLICIT + 'region = "carcass"\n', "tyre")
        self.assertGreater(s["implicit_dofs"], 0)
        self.assertEqual(s["operator"], "sparse")


class Layers(ProgramTest):
    """Materials by layers of a disk."""

    def refused(self, table, fragments):
        done = run("check", self.case(SMALL + table))
        self.assertEqual(done.returncode, 2, done.stderr)
        for fragment in fragments:
            self.assertIn(fragment, done.stderr)

    def test_wrong_layers(self):
        stiff = "youngs_modulus = 2.0e8\n"
        self.refused("[[material.region]]\nlayers = [4]\n" + stiff,
                     ["material.region[0].layers", "the disk has no layer 4"])
        self.refused("[[material.region]]\nlayers = [0]\n" + stiff, ["material.region[0].layers"])
        self.refused("[[material.region]]\nlayers = [2, 2]\n" + stiff, ["material.region[0].layers"])
        self.refused("[[material.region]]\n" + stiff, ["material.region[0].layers"])
        self.refused('[[material.region]]\nsurface = "belt"\n' + stiff,
                     ["material.region[0].surface", "a [disk] has no physical surfaces"])
        self.refused(2 * ("[[material.region]]\nlayers = [2]\n" + stiff),
                     ["material.region[1].layers", "has a material already", "material.region[0]"])

    def test_layers_of_the_same_material_change_no_bit(self):
        out = self.folder
        same = "[[material.region]]\nlayers = [2]\n[[material.region]]\nlayers = [1, 3]\n"
        for name, text in (("one", SMALL), ("layers", SMALL + same)):
            done = run("run", self.case(text), "-o", out / name)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((out / "one" / "history.csv").read_bytes(),
                         (out / "layers" / "history.csv").read_bytes())

    def test_all_layers_by_regions_are_the_material(self):
        """Soft underneath, every layer by the regions: the same as that material alone."""
        out = self.folder
        soft = replaced(SMALL, "youngs_modulus", "youngs_modulus = 1.0e6")
        region = "[[material.region]]\nlayers = [1, 2, 3]\nyoungs_modulus = 2.0e7\n"
        for name, text in (("one", SMALL), ("regions", soft + region)):
            done = run("run", self.case(text), "-o", out / name)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((out / "one" / "history.csv").read_bytes(),
                         (out / "regions" / "history.csv").read_bytes())


class Cases(ProgramTest):
    """The shipped cases say what to expect."""

    def runs(self, name, *extra):
        """(summary, history) of the case, and of the same with explicit elements."""
        found = []
        for kind, more in (("implicit", []), ("explicit", ["--set", "solver.implicit=[]"])):
            out = self.folder / kind
            done = run("run", ROOT / "cases" / f"{name}.toml", "-o", out, "--quiet", *extra, *more)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertLess(summary(out)["energy_residual_relative"], 1e-12)
            found.append((summary(out), history(out)))
        return found

    def test_belt(self):
        runs = self.runs("belt", "--set", "time.end=0.06")
        self.assertGreater(runs[1][0]["steps"], 50 * runs[0][0]["steps"])
        for column, bound in (("force_y", 0.003), ("force_x", 0.005)):
            mean = [h[column][h["time_s"] > 0.05].mean() for _, h in runs]
            self.assertLess(abs(mean[0] - mean[1]), bound * abs(mean[1]), column)

    def test_bar_with_a_fine_tip(self):
        noise = []
        for s, h in self.runs("bar-fine-tip"):
            force = h["force_y"][(h["time_s"] > 0.56) & (h["time_s"] < 1.1)]
            noise.append(((force - 30.0) ** 2).mean() ** 0.5)
            self.assertAlmostEqual(h["time_s"][h["force_y"] > 0][0], 0.5, delta=1.001 * s["step"])
        self.assertAlmostEqual(noise[0], 0.694, delta=0.001)
        self.assertAlmostEqual(noise[1], 14.03, delta=0.01)

    def test_tyre_section(self):
        runs = self.runs("tyre-section-implicit", "--set", "time.end=0.04")
        self.assertGreater(runs[1][0]["steps"], 2.3 * runs[0][0]["steps"])
        mean = [h["force_y"][h["time_s"] > 0.03].mean() for _, h in runs]
        self.assertLess(abs(mean[0] - mean[1]), 0.003 * mean[1])


class KilledWithImplicitElements(ResumeTest):
    kill_at_random_moments = Killed.kill_at_random_moments
    assert_readable = Killed.assert_readable

    def test_it_goes_on_to_the_same_bits(self):
        """At the ground: what the coupled contacts start from is kept, too."""
        text = replaced(LONG, "end", "end = 3.0") + layers(3)
        self.leave_alone(text)
        self.kill_at_random_moments(text, 5, seed=3)
        self.assertEqual(self.resume(text).returncode, 0)
        self.assert_same(self.out)
        self.assertGreater(summary(self.out)["contact"]["clusters_solved"], 0)


del Killed, ResumeTest  # their tests are run elsewhere

if __name__ == "__main__":
    unittest.main()

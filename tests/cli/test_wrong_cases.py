# SPDX-License-Identifier: BSD-3-Clause
"""Wrong cases: exit code 2, file and place named, the value and what is allowed, nothing left behind."""
import unittest

from program import LEDGE, ProgramTest, ROOT, line_of, replaced, run

# (what, line of cases/ledge-smooth.toml to replace, replacement, fragments expected in the message)
EDITS = [
    ("unknown key", "friction", "frictoin = 0.3", ["ground.frictoin", "ground.friction"]),
    ("unknown table", "[ground]", "[grund]", ["grund", "ground"]),
    ("a synonym", "youngs_modulus", "young = 2e7",
     ["material.young = 2e7: unknown key; did you mean material.youngs_modulus?"]),
    ("a symbol", "friction", "mu = 0.3", ["ground.mu", "did you mean ground.friction?"]),
    ("a synonym of a key elsewhere", "speed", "velocity = 10.0",
     ["motion.velocity", "did you mean motion.speed?"]),
    ("a load", "speed", "speed = 10.0\nload = 5e4",
     ["motion.load", "a load on the rim is rim.force_y", "[[load.pressure]]"]),
    ("wrong type", "youngs_modulus", 'youngs_modulus = "soft"', ["material.youngs_modulus", "string"]),
    ("boolean for number", "density", "density = true", ["material.density", "boolean"]),
    ("float for integer", "radial", "radial = 12.5", ["disk.mesh.radial", "12.5", "integer"]),
    ("NaN", "poissons_ratio", "poissons_ratio = nan", ["material.poissons_ratio", "nan"]),
    ("infinite", "speed", "speed = inf", ["motion.speed", "inf"]),
    ("inner > outer", "inner_radius", "inner_radius = 0.4", ["disk.inner_radius", "0.4", "0.3"]),
    ("inner = outer", "inner_radius", "inner_radius = 0.30", ["disk.inner_radius"]),
    ("negative radius", "outer_radius", "outer_radius = -0.3", ["disk.outer_radius", "> 0"]),
    ("zero layers", "radial", "radial = 0", ["disk.mesh.radial", "1 to 100000"]),
    ("two columns", "circumferential", "circumferential = 2", ["disk.mesh.circumferential", "3"]),
    ("layers that coincide", "radial", "radial = 100\ngrading = 10",
     ["disk.mesh.grading", "shortest edge"]),
    ("a film of rubber", "inner_radius", "inner_radius = 0.2999999999999999",
     ["disk.inner_radius", "shortest edge"]),
    ("no density to speak of", "density", "density = 1e-300",
     ["material.youngs_modulus", "frequency"]),
    ("stiffer than numbers", "youngs_modulus", "youngs_modulus = 1e300",
     ["material.youngs_modulus", "frequency"]),
    ("too many steps", "safety", "safety = 1e-20", ["time.end", "steps"]),
    ("absurd friction", "friction", "friction = 1e15", ["ground.friction", "0 to 100"]),
    ("grading below 1", "radial", "radial = 12\ngrading = 0.5", ["disk.mesh.grading", "1"]),
    ("mesh beyond memory", "circumferential", "circumferential = 9000000",
     ["disk.mesh.circumferential", "memory", "GB"]),
    ("incompressible", "poissons_ratio", "poissons_ratio = 0.5", ["material.poissons_ratio", "0.5"]),
    ("no stiffness", "youngs_modulus", "youngs_modulus = 0", ["material.youngs_modulus", "> 0"]),
    ("unstable rubber", "youngs_modulus",
     'model = "mooney-rivlin"\nc10 = 4e5\nc01 = -1e5',
     ["material.c01", "unstable", "equibiaxial", "0.5 to 2"]),
    ("a parameter of another model", "youngs_modulus",
     'model = "neo-hooke"\nshear_modulus = 1e6\nc10 = 5e5',
     ["material.c10", '"neo-hooke"', "shear_modulus = 2 c10"]),
    ("rubber that locks", "youngs_modulus",
     'model = "neo-hooke"\nshear_modulus = 1e6\nintegration = "full"',
     ["material.integration", "locks", "b-bar"]),
    ("unknown plane", "plane", 'plane = "shell"', ["material.plane", "shell", "strain"]),
    ("negative damping", "mass", "mass = -1.0", ["damping.mass", ">= 0"]),
    ("step too large", "safety", "step = 1.0e-3", ["time.step", "0.001", "above the critical step"]),
    ("both step and safety", "safety", "safety = 0.8\nstep = 1e-5", ["time.step", "time.safety"]),
    ("safety above 1", "safety", "safety = 1.1", ["time.safety", "1.1", "1"]),
    ("end in the past", "end", "end = -0.1", ["time.end", "> 0"]),
    ("unsorted table", "speed", "speed = [[0, 10], [0.2, 5], [0.1, 3]]", ["motion.speed", "increas"]),
    ("empty table", "height", "height = []", ["motion.height"]),
    ("table of triples", "height", "height = [[0, 1, 2]]", ["motion.height"]),
    ("one-point profile", "profile", "profile = [[0, 0]]", ["ground.profile", "two points"]),
    ("profile that goes back", "profile", "profile = [[0, 0], [1, 0], [0.5, 0]]",
     ["ground.profile", "left"]),
    ("fillet that does not fit", "fillet", "fillet = 0.2", ["ground.fillet", "does not fit"]),
    ("negative friction", "friction", "friction = -0.3", ["ground.friction", "0 to 100"]),
    ("restitution above 1", "restitution", "restitution = 1.5", ["ground.restitution", "1"]),
    ("schema from the future", "schema", "schema = 2", ["schema", "later version"]),
    ("no schema", "schema", None, ["schema"]),
    ("unknown scheme", "safety", 'safety = 0.8\nscheme = "rk4"', ["time.scheme", "rk4", "symplectic"]),
    ("unknown state", "state", 'state = "spinning"', ["initial.state", "stationary"]),
    ("negative snapshots", "snapshots = ", "snapshots = -1", ["output.snapshots", "-1"]),
    ("duplicate key", "friction", "friction = 0.3\nfriction = 0.4", ["friction"]),
    ("unclosed string", "title", 'title = "no end', ["case.toml:"]),
]


# What stands in the body at the start where no node of its boundary is: (what, case, settings).
WEDGE = "ground.profile=[[-10,0],[0.002,0],[0.005,0.1],[0.008,0],[10,0]]"
INSIDE = [
    ("a wedge", "rolling-flat", [WEDGE]),
    ("its tip rounded", "rolling-flat", [WEDGE, "ground.fillet=0.0004"]),
    ("a post whose top is above the body", "rolling-flat",
     ["ground.profile=[[-10,0],[0.204,0],[0.204,0.5],[0.206,0.5],[0.206,0],[10,0]]",
      "motion.speed=0"]),
    ("a free body", "thrown-disk",
     ["ground.profile=[[-10,0],[0.0030,0],[0.0035,0.02],[0.0040,0],[10,0]]"]),
    ("a block of a mesh", "block-on-incline",
     ["ground.profile=[[-10,0],[0.0030,0],[0.0045,0.02],[0.0060,0],[10,0]]", "initial.turn=0"]),
]


class WrongCases(ProgramTest):
    def refused(self, case, fragments, line=None, extra=()):
        """Exit 2, every fragment said, the place named, no results directory."""
        before = sorted(p.name for p in self.folder.iterdir())
        for command in ("run", "check"):
            done = run(command, case, *extra)
            said = done.stderr
            self.assertEqual(done.returncode, 2, said)
            self.assertEqual(done.stdout, "")
            for fragment in fragments:
                self.assertIn(fragment, said)
            if line is not None:
                self.assertIn(f"{case}:{line}:", said)
            self.assertEqual(sorted(p.name for p in self.folder.iterdir()), before)

    def place(self, what, text, line):
        """The line that is named: that of the edit, unless the fault shows elsewhere."""
        if line is None or what == "unclosed string":
            return None
        if what == "no density to speak of":
            return line_of(text, "youngs_modulus")
        if what == "too many steps":
            return line_of(text, "end")
        if what == "duplicate key":
            return line_of(text, "friction") + 1
        return line_of(text, line.split("\n")[-1].split(" ")[0])

    def test_edits(self):
        self.assertGreaterEqual(len(EDITS), 30)
        for what, key, line, fragments in EDITS:
            with self.subTest(what):
                text = replaced(LEDGE, key, line)
                self.refused(self.case(text), fragments, self.place(what, text, line))

    def test_start_inside_the_ground(self):
        text = replaced(replaced(LEDGE, "start_x", "start_x = 0.5"), "height", "height = 0.25")
        self.refused(self.case(text), ["motion.height", "inside the ground", "half an element"],
                     line_of(text, "height"))

    def test_ground_inside_the_body_between_its_nodes(self):
        for what, case, settings in INSIDE:
            with self.subTest(what):
                sets = [word for setting in settings for word in ("--set", setting)]
                self.refused(ROOT / "cases" / f"{case}.toml",
                             ["the ground stands", "deep inside the body at the start, at (",
                              "half an element"], extra=sets)

    def test_little_ground_inside_the_body_is_told(self):
        done = run("check", ROOT / "cases" / "rolling-flat.toml", "--set", "motion.height=0.3",
                   "--set", "ground.profile=[[-10,0],[0.002,0],[0.005,0.003],[0.008,0],[10,0]]")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("the ground stands 0.002", done.stderr)

    def test_no_stationary_state_beyond_the_softening_limit(self):
        text = replaced(LEDGE, "state", 'state = "stationary"')
        text = replaced(text, "angular_velocity", "angular_velocity = 5000.0")
        self.refused(self.case(text), ["motion.angular_velocity", "softening"],
                     line_of(text, "angular_velocity"))

    def test_all_faults_at_once(self):
        text = LEDGE
        for key, line in [("friction", "friction = -1"), ("inner_radius", "inner_radius = 9"),
                          ("density", "densty = 1100"), ("end", "end = 0")]:
            text = replaced(text, key, line)
        self.refused(self.case(text),
                     ["ground.friction", "disk.inner_radius", "material.densty", "material.density",
                      "time.end"])

    def test_missing_table(self):
        cut = LEDGE[: LEDGE.index("[material]")]
        self.refused(self.case(cut), ["material", "motion", "time"])

    def test_file_cut_in_the_middle_of_a_line(self):
        self.refused(self.case(LEDGE[: LEDGE.index("profile") + 12]), ["case.toml:"])

    def test_binary_rubbish(self):
        path = self.folder / "case.toml"
        path.write_bytes(bytes(range(256)) * 40)
        self.refused(path, [str(path)])

    def test_empty_file(self):
        self.refused(self.case(""), ["case.toml", "empty"])

    def test_missing_file_and_directory(self):
        self.refused(self.folder / "nowhere.toml", ["nowhere.toml"])
        self.refused(self.folder, [str(self.folder)])

    def test_wrong_set(self):
        case = self.case(LEDGE)
        self.refused(case, ["--set", "ground.fricton", "ground.friction"],
                     extra=["--set", "ground.fricton=0.5"])
        self.refused(case, ["ground.friction", "-1"], extra=["--set", "ground.friction=-1"])
        self.refused(case, ["--set"], extra=["--set", "nonsense"])
        self.refused(case, ["disk.mesh.radial", "string"], extra=["--set", "disk.mesh.radial=many"])

    def test_numbers_as_others_write_them(self):
        comma, minus = "it has a decimal comma: write 0.3", "it has the minus sign U+2212"
        exponent, quote = "it has an exponent with D", "it has the curly quotation mark U+201C"
        pair = "a comma divides items, a point is in a number"
        for line, said in (("friction = 0,3", comma), ("friction = \u22120.3", minus),
                           ("density = 1.1D3", exponent), ("height = [[0, \u22121]]", minus),
                           ("height = [[0, 0,3], [1, 0.3]]", pair),
                           ("scheme = \u201cmoreau-jean\u201d", quote)):
            text = replaced(LEDGE, line.split(" ")[0] if "scheme" not in line else "safety", line)
            self.refused(self.case(text), [said], line_of(text, line))
        case = self.case(LEDGE)
        for setting, said in (("ground.friction=0,3", comma), ("ground.friction=\u22120.3", minus),
                              ("material.density=1.1d3", exponent), ("motion.height=[[0, 0,3]]", pair),
                              ("ground.profile=\u201cflat\u201d", quote),
                              ("time.scheme=\u201csymplectic\u201d", quote)):
            self.refused(case, [f"--set {setting}: ", said], extra=["--set", setting])

    def test_a_fillet_that_fits_nowhere_on_a_measured_profile(self):
        points = "\n".join(f"{0.01 * k:.2f}, {0.001 * (k % 2)}" for k in range(20000))
        (self.folder / "road.csv").write_text(points)
        text = replaced(replaced(LEDGE, "profile", 'profile = "road.csv"'), "fillet", "fillet = 0.2")
        done = run("check", self.case(text))
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stderr.count("the fillet does not fit"), 5)
        self.assertRegex(done.stderr, "ground.fillet: and [0-9]+ more of this kind")
        self.assertLess(len(done.stderr.splitlines()), 9)

    def test_an_opencrg_road_is_no_profile(self):
        (self.folder / "road.dat").write_text("$CT ! comment\nCRG file example\n$ROAD_CRG\n$\n")
        text = replaced(LEDGE, "profile", 'profile = "road.dat"')
        self.refused(self.case(text), ["road.dat: ", "is an OpenCRG road file",
                                       "one section along the road"])


class WrongUsage(ProgramTest):
    def test_usage(self):
        case = self.case()
        for arguments in ([], ["roll"], ["run"], ["run", case, "--nonsense"],
                          ["run", case, "--threads", "0"], ["run", case, "--threads", "two"],
                          ["check", case, case]):
            with self.subTest(arguments):
                done = run(*arguments)
                self.assertEqual(done.returncode, 2)
                self.assertNotEqual(done.stderr, "")
        self.assertEqual([p.name for p in self.folder.iterdir()], ["case.toml"])

    def test_an_output_without_a_name(self):
        """As of a variable of the shell that is not set."""
        case = self.case()
        for arguments in (["run", case], ["modes", case], ["sweep", case], ["pod", self.folder],
                          ["reduce", self.folder], ["fmu", case], ["matrices", case]):
            done = run(*arguments, "-o", "", cwd=self.folder)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertRegex(done.stderr, "-o|--output")
        self.assertEqual([p.name for p in self.folder.iterdir()], ["case.toml"])


if __name__ == "__main__":
    unittest.main()

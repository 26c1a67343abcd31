# SPDX-License-Identifier: BSD-3-Clause
"""Members of run.json: what runs of all kinds write is what the schema says, and nothing else."""
import unittest

from program import ROOT, SMALL, ProgramTest, replaced, run, summary
from schemas import errors, main, needs_jsonschema, schema
from test_tyre_crush import TYRE
from test_tyre_steady_nonlinear import RADIUS, rolling

STILL = SMALL[:SMALL.index("[motion]")] + SMALL[SMALL.index("[ground]"):]
CRUSH = ["analysis.kind=crush", "analysis.depth=0.002", "analysis.increments=2"]
STEADY = ["analysis.kind=steady-rolling", "motion.height=0.296"]
WIDE = ["disk.width=0.05", "disk.mesh.axial=2"]
STEPPED = [*STEADY, *WIDE, "analysis.slip=upwind", "analysis.step_distance=0.1", "analysis.accept_scheme_power=true"]
RUBBER = SMALL.replace("youngs_modulus = 2.0e7\npoissons_ratio = 0.3",
                       'model = "neo-hooke"\nshear_modulus = 7e6\npoissons_ratio = 0.45')
RIM = "[rim]\nmass = 20.0\ninertia = 1.0\nfree = []\n"
BRIEF = "time.end=0.005"
RUNS = {  # name: case, settings
    "plain": (SMALL, []),
    "slow": (SMALL, ["motion.speed=9.9"]),
    "fast": (SMALL, ["motion.speed=10.1"]),
    "rim": (SMALL + RIM, [BRIEF]),
    "friction": (SMALL, [BRIEF, "ground.friction={coefficient=0.3, slip_speed=[[0, 1], [1, 1.2]]}"]),
    "rubber": (RUBBER, [BRIEF]),
    "hati": (SMALL, [BRIEF, "time.scheme=hati", "solver.hati.ratio=2", "solver.hati.fine.layers=[2,3]"]),
    "implicit": (SMALL + "[[solver.implicit]]\nlayers = [1]\n", [BRIEF]),
    "wheel": (SMALL, [BRIEF, *WIDE, "motion.height=0.3"]),
    "crush": (SMALL, CRUSH),
    "latin-pgd": (SMALL, [*CRUSH, "analysis.solver=latin-pgd"]),
    "steady": (SMALL, STEADY),
    "steady-load": (SMALL, ["analysis.kind=steady-rolling", "analysis.load=500", "analysis.traction=0"]),
    "steady-torque": (SMALL, [*STEADY, "analysis.torque=0"]),
    "steady-lossy": (SMALL, [*STEADY, "material.loss_factor=0.1", "material.loss_band=[1.0, 100.0]"]),
    "steady-friction": (SMALL, [*STEADY, "ground.friction={coefficient=0.3, slip_speed=[[0, 1], [1, 0.8]]}"]),
    "steady-wheel": (SMALL, [*STEADY, *WIDE, "analysis.estimate_slip_error=true"]),
    "steady-turned": (SMALL, [*STEPPED, "analysis.slip_angle_step=0.01"]),
    "steady-slipped": (SMALL, [*STEPPED, "analysis.slip_ratio_step=0.01"]),
}


def written(value, members, before=""):
    """(path, member of the schema) of all that a document has of these members."""
    for name, inner in value.items():
        member = members["properties"].get(name)
        yield before + name, member
        if member and "properties" in member and inner is not None:
            yield from written(inner, member, f"{before}{name}.")
        elif member and "properties" in member.get("items", {}):
            for one in inner:
                yield from written(one, member["items"], f"{before}{name}[].")


def known(members, before=""):
    """The same of all that the schema has."""
    for name, member in members["properties"].items():
        yield before + name, member
        for inner, mark in ((member, "."), (member.get("items", {}), "[].")):
            if "properties" in inner:
                yield from known(inner, f"{before}{name}{mark}")


@needs_jsonschema
class Members(ProgramTest):
    def made(self, name, *arguments, code=0):
        """Adds what it writes to self.seen."""
        done = run(*arguments, "-o", self.folder / name)
        self.assertEqual(done.returncode, code, done.stderr)
        found = summary(self.folder / name)
        self.assertEqual(errors("run.json", found), [], name)
        self.seen |= {path for path, _ in written(found, schema("run.json"))}

    def test_all_are_written_and_no_others(self):
        self.seen = set()
        for name, (text, settings) in RUNS.items():
            self.made(name, "run", self.case(text), *(part for text in settings for part in ("--set", text)))
        case, wheel = self.case(), self.folder / "wheel.h5"
        self.made("plain", "run", case, "--resume", "--set", "time.end=0.021")
        self.made("more", "run", case, *(part for text in [*CRUSH, "analysis.solver=latin-pgd"]
                                         for part in ("--set", text)), "--modes-from", self.folder / "latin-pgd")
        self.made("mesh", "run", ROOT / "cases" / "bar-on-wall.toml", "--set", "time.end=0.01")
        self.made("tyre", "run", ROOT / "cases" / "tyre-inflation.toml", "--set", "section.sectors=12")
        self.made("failed", "run", case, "--set", "initial.velocity=[1e20, 0]", code=3)
        self.made("wheel-of-case", "run", case, "--reduced", "--estimate", "--set", BRIEF)
        self.made("wheel-in-space", "run", case, "--reduced", "--modes", 5, "--set", BRIEF,
                  *(part for text in WIDE for part in ("--set", text)))
        self.made("wheel-in-the-air", "run", case, "--reduced", "--estimate", "--set", BRIEF, "--set",
                  "motion.height=0.4")
        self.made("modes", "modes", case, "--count", "2", "--diameters", "2")
        self.assertEqual(run("reduce", self.folder / "plain", "-o", wheel, "--modes", 5).returncode, 0)
        self.made("wheel-of-a-file", "run", case, "--reduced", wheel, "--set", BRIEF)
        tyre = self.case(rolling(RADIUS - 1e-3, more="speed = 3.1e-4"))
        self.made("tyre-steady", "run", tyre, "--set", "inflation.nonlinear=cords")
        pressed = self.case(TYRE.replace("depth = 0.01", "load = 500.0"))
        self.made("tyre-crush", "run", pressed, "--set", "inflation.nonlinear=cords")
        self.assertEqual({path for path, _ in known(schema("run.json"))} - self.seen, set())

    def test_each_has_a_meaning(self):
        for path, member in known(schema("run.json")):
            self.assertRegex(member["description"], r"^\S.+", path)


if __name__ == "__main__":
    main()

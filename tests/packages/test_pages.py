# SPDX-License-Identifier: BSD-3-Clause
"""Pages of man of the program that is built: each command has one, each option is on it, and neither
groff nor mandoc has anything to say of them. What --help cannot be read is an error."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts" / "pages"))
import help_text  # noqa: E402

PROGRAM = os.environ["RONDO"]


def said(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True,
                          env=os.environ | {"MANWIDTH": "100", "LC_ALL": "C.UTF-8"})


class Help(unittest.TestCase):
    def test_entries(self):
        one = help_text.entry("-c,--count INT:INT in [1 - 99]=20 Needs: --a", "how many")
        self.assertEqual((one.names, one.value, one.allowed, one.default, one.needs),
                         (["-c", "--count"], "integer", "1 to 99", "20", "--a"))
        two = help_text.entry("run TEXT ... REQUIRED", "Results: a | b-c")
        self.assertEqual((two.many, two.required, two.choices), (True, True, ["a", "b-c"]))

    def test_what_cannot_be_read_is_said(self):
        for head in ("--count INT and more", "What: is this", "--Bad"):
            with self.assertRaises(ValueError, msg=head):
                help_text.entry(head, "")
        with self.assertRaises(ValueError):
            help_text.read("no help\n")

    def test_a_blank_of_a_long_name_before_the_column(self):
        head = "  --contact-stride INT:INT in [1 - 1000000]"
        self.assertEqual(head[help_text.COLUMN - 1], " ")
        text = help_text.read(f"what\n\nOptions:\n{head}\n{' ' * 30}nodes\n  --velocity-tolerance FLOAT  the same\n")
        self.assertEqual([(one.names[0], one.meaning, one.allowed) for one in text.options],
                         [("--contact-stride", "nodes", "1 to 1000000"),
                          ("--velocity-tolerance", "the same", "")])


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.man = pathlib.Path(folder.name) / "man"
        (cls.man / "man1").mkdir(parents=True)
        (cls.man / "man1" / "rondo-gone.1").write_text("")
        told = said(sys.executable, "-B", ROOT / "scripts" / "pages" / "write.py", PROGRAM, "--changelog",
                    ROOT / "CHANGELOG.md", "--man", cls.man).stdout.split()
        cls.pages = sorted(cls.man.rglob("*.[15]"))
        assert sorted(map(pathlib.Path, told)) == cls.pages, told

    def test_each_command_and_option(self):
        helps = {name: said(PROGRAM, name, "--help").stdout
                 for name in re.findall(r"^  ([a-z]\S*)", said(PROGRAM, "--help").stdout.split("Subcommands:")[1]
                                        .split("\n\n")[0], re.MULTILINE)}
        self.assertGreater(len(helps), 5)
        self.assertEqual({page.name for page in self.pages},
                         {"rondo.1", "rondo-case.5", "rondo-mesh-reader.1"} | {f"rondo-{name}.1" for name in helps})
        for name, text in helps.items():
            page = (self.man / "man1" / f"rondo-{name}.1").read_text().replace(r"\-", "-")
            for option in re.findall(r"^  (?:-\w,)?(--[a-z-]+)", text, re.MULTILINE):
                self.assertIn(f"\\fB{option}\\fR", page, name)

    def test_help_is_of_whole_sentences(self):
        """Or of noun phrases, each understood without the one before it."""
        top, commands = help_text.of_program(PROGRAM)
        entries = [(name, one) for name, text in commands.items() for one in text.arguments + text.options]
        meanings = [(f"{name} {one.names[-1]}", one.meaning) for name, one in entries]
        meanings += [(one.names[0], one.meaning) for one in top.commands]
        self.assertGreater(len(meanings), 100)
        for name, meaning in meanings:
            self.assertRegex(meaning, r"^[A-Z]", name)
            self.assertNotRegex(meaning, r"(?i)likewise|^the same", name)

    def test_keys_of_cases(self):
        page = (self.man / "man5" / "rondo-case.5").read_text().replace(r"\-", "-")
        for key in ("ground.friction", "output.probe[].position", "rim.support.x.stiffness"):
            self.assertIn(f"\\fB{key}\\fR", page)
        self.assertGreater(page.count(".TP"), 100)

    def test_groff(self):
        if not shutil.which("man"):
            self.skipTest("LEFT OUT: no man (man-db; scripts/setup.sh --dev)")
        for page in self.pages:
            shown = said("man", "--warnings", "-l", page)
            self.assertEqual(shown.stderr, "", page)
            self.assertIn("SEE ALSO", shown.stdout)
            self.assertNotRegex(shown.stdout, r"\\[a-zA-Z(]", page)  # troff that was not understood

    def test_mandoc(self):
        if not shutil.which("mandoc"):
            self.skipTest("LEFT OUT: no mandoc (scripts/setup.sh --dev)")
        for page in self.pages:
            found = subprocess.run(["mandoc", "-T", "lint", "-W", "warning", page], capture_output=True, text=True)
            self.assertEqual(found.stdout + found.stderr, "", page)


if __name__ == "__main__":
    unittest.main()

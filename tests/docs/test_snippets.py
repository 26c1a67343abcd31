# SPDX-License-Identifier: BSD-3-Clause
"""What pages show and nobody runs: pieces of case and study files have keys and values that the program knows, and
README's table of questions names every command there is.

    RONDO=build/release/rondo python3 tests/docs/test_snippets.py"""
import json
import os
import re
import subprocess
import tomllib
import unittest

import jsonschema

from pages import ROOT, all_pages, blocks_of, page_name

RONDO = os.environ["RONDO"]
# Tables of other files than cases and studies.
OTHERS = {"docs/machine.md": ("rule",)}


def schema(kind):
    return json.loads(subprocess.run([RONDO, "schema", kind], check=True, capture_output=True).stdout)


def of_pieces(part):
    """The schema of a piece: what is there must be right; what is not may stand elsewhere, and with it what
    is said of several keys at once."""
    if isinstance(part, dict):
        kept = {key: of_pieces(value) for key, value in part.items() if key not in ("required", "allOf")}
        if kept.get("not") == {}:
            del kept["not"]
        if "oneOf" in kept and {} not in kept["oneOf"]:  # what tells them apart may stand elsewhere
            kept["anyOf"] = kept["oneOf"]
        return {key: value for key, value in kept.items() if key != "oneOf"}
    return [of_pieces(value) for value in part] if isinstance(part, list) else part


def faults(text, schemas):
    """What is wrong with a piece of a case or a study, which has `vary`, `base` or `sample`."""
    found = tomllib.loads(text)
    kind = "study" if {"vary", "base", "sample", "outputs"} & set(found) else "case"
    return [f"{'.'.join(map(str, error.absolute_path))}: {error.message}"
            for error in jsonschema.validators.validator_for(schemas[kind])(schemas[kind]).iter_errors(found)]


class Snippets(unittest.TestCase):
    schemas = {kind: of_pieces(schema(kind)) for kind in ("case", "study")}

    def test_every_piece_of_toml(self):
        wrong, n = [], 0
        for page in all_pages():
            for block in blocks_of(page_name(page), page.read_text()):
                if block.language != "toml" or set(tomllib.loads(block.text)) & set(OTHERS.get(block.page, ())):
                    continue
                n += 1
                wrong += [f"{block.place}: {fault}" for fault in faults(block.text, self.schemas)]
        self.assertFalse(wrong, "\n".join(wrong))
        self.assertGreater(n, 20)

    def test_wrong_pieces_are_found(self):
        for text in ("[ground]\nfrictoin = 0.3\n", "[ground]\nfriction = 'much'\n", "[[vary]]\nkey = 3\n"):
            self.assertNotEqual(faults(text, self.schemas), [], text)
        self.assertEqual(faults("[ground]\nfriction = 0.3\n", self.schemas), [])


class Questions(unittest.TestCase):
    """README's table: which command for which question."""

    text = (ROOT / "README.md").read_text()
    table = text[text.index("## Which command"):text.index("## Read on")]

    def test_every_command_answers_one(self):
        usage = subprocess.run([RONDO, "--help"], check=True, capture_output=True, text=True).stdout
        commands = re.findall(r"^  ([a-z]+) {2,}\S", usage[usage.index("Subcommands:"):], re.MULTILINE)
        self.assertIn("sweep", commands)
        for command in commands:
            self.assertRegex(self.table, rf"`(rondo )?{command}\b")
        for named in re.findall(r"`rondo (\w+)", self.table):
            self.assertIn(named, commands)

    def test_its_files_are_there(self):
        for path in re.findall(r"(?:cases|examples)/[\w/.-]+\.(?:toml|py)", self.table):
            self.assertTrue((ROOT / path).exists(), path)


if __name__ == "__main__":
    unittest.main()

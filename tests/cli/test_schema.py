# SPDX-License-Identifier: BSD-3-Clause
"""`rondo schema case|study`: what the schema takes and refuses is what the program does."""
import copy
import json
import tomllib

from program import LEDGE, ROOT, SMALL, ProgramTest, RunTest, replaced, run
from schemas import (dotted, errors, faults_of_check, faults_of_schema, file_of, main,
                     needs_jsonschema, read_toml, schema)

# (what, line of cases/ledge-smooth.toml to replace, replacement, key at fault)
WRONG = [
    ("unknown key", "friction", "frictoin = 0.3", "ground.frictoin"),
    ("unknown table", "[ground]", "[grund]", "grund"),
    ("wrong type", "youngs_modulus", 'youngs_modulus = "soft"', "material.youngs_modulus"),
    ("boolean for number", "density", "density = true", "material.density"),
    ("float for integer", "radial", "radial = 12.5", "disk.mesh.radial"),
    ("out of bounds", "friction", "friction = -0.1", "ground.friction"),
    ("on a bound that is out", "end", "end = 0", "time.end"),
    ("unknown choice", "plane", 'plane = "shell"', "material.plane"),
    ("empty table in time", "height", "height = []", "motion.height"),
    ("triples in time", "height", "height = [[0, 1, 2]]", "motion.height"),
    ("a key left out", "density", None, "material.density"),
    ("a table in the place of a list", "snapshots", "snapshots = 1\n[output.probe]\nname = 'a'",
     "output.probe"),
    ("an unknown key in a list", "snapshots", "snapshots = 1\n[[output.probe]]\nname = 'a'\n"
     "position = [0.2, 0.0]\nplace = 3", "output.probe[0].place"),
]


def holders(node, path=()):
    """(path, schema) of all keys that are no tables; 0 stands for a table of a list."""
    for name, inner in node["properties"].items():
        if "properties" in inner:
            yield from holders(inner, (*path, name))
            if inner["type"] == ["number", "object"]:  # a number, or a table in its place
                yield (*path, name), {**inner, "type": "number"}
        elif "properties" in inner.get("items", {}):
            yield from holders(inner["items"], (*path, name, 0))
        else:
            yield (*path, name), inner


def just_out(node):
    """Values just beyond the bounds of a schema of a number."""
    whole = node["type"] == "integer"
    for name, sign in ("minimum", -1), ("maximum", 1):
        if name in node:
            bound, is_open = node[name], node.get("exclusive" + name.title(), False)
            step = 1 if whole else 1e-9 * max(1.0, abs(bound))
            yield bound if is_open else bound + sign * step


def wrong_values(node):
    """Values that a key must not have: of another type, beyond its bounds, no choice of it."""
    if "anyOf" in node:  # a number, a text, or a table in time
        number, points = node["anyOf"]
        yield True
        yield [[0, 1, 2]]
        if number["type"] == "number":
            yield "a"
            for value in just_out(number):
                yield value
                yield [[0.0, value]]
        else:
            yield 1.5
            yield [[0.0, 1.0]]
    elif "enum" in node:
        if node["type"] == "string":
            yield from ("no such", 1, [])
    elif node["type"] in ("number", "integer"):
        yield from ("a", True, [1.0])
        if node["type"] == "integer":
            yield 3.5
        yield from just_out(node)
    elif node["type"] == "boolean":
        yield from (1, "true")
    elif node["type"] == "string":
        yield from (1, True)
        if node.get("minLength"):
            yield ""
    elif node["type"] == "array":
        yield from (1.5, "a", [{"a": 1}])
    else:
        raise AssertionError(node)


def placed(document, path, value):
    """A copy of the document with a value at a path; tables on the way are made."""
    document = copy.deepcopy(document)
    if path[0] in ("mesh", "section"):
        del document["disk"]
        document[path[0]] = {"file": "a.msh", "clamped": "rim"}
    here = document
    for part, after in zip(path, path[1:]):
        if isinstance(part, int):
            here = here[part]
        else:
            if isinstance(here.get(part), float):  # the number in the place of a table
                here[part] = {"coefficient": here[part]}
            here = here.setdefault(part, [{}] if after == 0 else {})
    here[path[-1]] = value
    return document


@needs_jsonschema
class OfCases(ProgramTest):
    def test_the_program_prints_what_is_shipped(self):
        for name in "case", "study":
            self.assertEqual(run("schema", name).stdout,
                             (ROOT / "cases" / "schema" / f"{name}.json").read_text())

    def test_shipped_files_are_valid_and_name_their_schema(self):
        for name, files in ("case", "cases/*.toml"), ("study", "cases/studies/*.toml"):
            found = sorted(ROOT.glob(files))
            self.assertGreater(len(found), 10)
            for path in found:
                with self.subTest(path.name):
                    self.assertEqual(errors(name, read_toml(path)), [])
                    first = path.read_text().splitlines()[0]
                    self.assertTrue(first.startswith("#:schema "), first)
                    target = path.parent / first.removeprefix("#:schema ")
                    self.assertEqual(json.loads(target.read_text()), schema(name))

    def test_wrong_cases_are_refused_where_the_program_refuses_them(self):
        self.assertEqual(errors("case", tomllib.loads(LEDGE)), [])
        for what, beginning, line, key in WRONG:
            with self.subTest(what):
                text = replaced(LEDGE, beginning, line)
                code, found = faults_of_check(self.case(text))
                self.assertEqual((code, key in found), (2, True), found)
                said = faults_of_schema("case", tomllib.loads(text))
                missing = key.rpartition(".")[0]
                self.assertIn(missing if line is None else key, said)

    def test_bodies_exclude_each_other(self):
        other = 'file = "a.msh"\nclamped = "rim"\n'
        for table in "mesh", "section":
            text = f"{SMALL}\n[{table}]\n{other}"
            self.assertEqual(faults_of_schema("case", tomllib.loads(text)), {""})
            code, found = faults_of_check(self.case(text))
            self.assertEqual((code, table in found), (2, True))
        both = {**tomllib.loads(SMALL), "mesh": tomllib.loads(other), "section": tomllib.loads(other)}
        del both["disk"]
        self.assertEqual(faults_of_schema("case", both), {""})
        self.assertIn("section", faults_of_check(self.case(file_of(both)))[1])
        none = tomllib.loads(SMALL)
        del none["disk"]
        self.assertEqual(faults_of_schema("case", none), {""})
        self.assertIn("disk", faults_of_check(self.case(file_of(none)))[1])

    def test_analyses_require_and_refuse_keys(self):
        small = tomllib.loads(SMALL)
        for path, value in ((("analysis", "kind"), "crush"),  # without a depth
                            (("analysis", "depth"), 0.01),  # in a dynamic case
                            (("analysis",), {"kind": "crush", "depth": 0.01, "increments": 2,
                                             "slip": "upwind"})):
            with self.subTest(path):
                document = placed(small, path, value)
                self.assertEqual(faults_of_schema("case", document), {""})
                self.assertEqual(faults_of_check(self.case(file_of(document)))[0], 2)
        crush = placed(small, ("analysis",), {"kind": "crush", "depth": 0.01, "increments": 2})
        del crush["time"]
        self.assertEqual(errors("case", crush), [])
        self.assertEqual(faults_of_check(self.case(file_of(crush))), (0, set()))
        del small["time"]
        self.assertEqual(faults_of_schema("case", small), {""})

    def test_every_wrong_value_of_every_key_is_refused_by_both(self):
        small, refused = tomllib.loads(SMALL), 0
        for path, node in holders(schema("case")):
            for value in wrong_values(node):
                document = placed(small, path, value)
                with self.subTest(path=dotted(path), value=value):
                    said = faults_of_schema("case", document)
                    self.assertTrue(any(key.startswith(dotted(path)) for key in said), said)
                    code, found = faults_of_check(self.case(file_of(document)))
                    self.assertEqual((code, dotted(path) in found), (2, True), found)
                    refused += 1
        self.assertGreater(refused, 400)

    def test_unknown_keys_of_every_table_are_refused_by_both(self):
        small = tomllib.loads(SMALL)
        for table in sorted({path[:-1] for path, _ in holders(schema("case"))}, key=str):
            with self.subTest(dotted(table)):
                path = (*table, "nothing")
                document = placed(small, path, 1)
                self.assertIn(dotted(path), faults_of_schema("case", document))
                self.assertIn(dotted(path), faults_of_check(self.case(file_of(document)))[1])

    def test_there_is_no_other_schema(self):
        done = run("schema", "cases")
        self.assertEqual(done.returncode, 2)
        for word in "cases", "case, study, check":
            self.assertIn(word, done.stderr)


@needs_jsonschema
class OfWhatIsWritten(RunTest):
    def test_the_case_of_results_is_valid(self):
        steady = ["analysis.kind=steady-rolling", "motion.height=0.296"]
        crush = ["analysis.kind=crush", "analysis.depth=[[0, 0], [3, 0.002]]", "analysis.increments=3"]
        rim = ["rim.free=['height']", "rim.mass=100", "rim.force_y=-100", "motion.height=0.3",
               "output.probe=[{name = 'p', position = [0.2, 0.0]}]",
               "material.region=[{layers = [1, 2], density = 900.0}]"]
        for k, settings in enumerate(([], steady, crush, rim)):
            with self.subTest(settings):
                out = self.folder / f"out{k}"
                sets = [part for text in settings for part in ("--set", text)]
                done = run("run", self.case(), "-o", out, *sets)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(errors("case", read_toml(out / "case.toml")), [])
                self.assertNotIn("#:schema", (out / "case.toml").read_text())


STUDY = {"schema": 1, "base": "case.toml", "vary": [{"key": "ground.friction", "values": [0.1, 0.2]}]}
WRONG_STUDIES = [
    (("base",), 3), (("base",), ""), (("bass",), "a"), (("snapshots",), 1), (("set",), ["a"]), (("schema",), 2),
    (("vary", 0, "key"), "ground.frictoin"), (("vary", 0, "key"), "analysis.kind"),
    (("vary", 0, "key"), "output.probe[0].name"), (("vary", 0, "values"), []),
    (("vary", 0, "values"), [1, 1.0]), (("vary", 0, "value"), [1]),
    (("vary", 0), {"key": "ground.friction"}),
    (("vary", 0), {"key": "ground.friction", "values": [0.1], "linspace": [0, 1, 3]}),
    (("vary", 0), {"key": "ground.friction", "linspace": [0, 1]}),
    (("vary", 0), {"key": "ground.friction", "linspace": [0, 1, 1]}),
    (("vary", 0), {"key": "ground.friction", "linspace": [0, 1, 2.0]}),
    (("vary", 0), {"key": "ground.friction", "linspace": [0, 1e301, 2]}),
    (("vary", 0), {"values": [0.1]}),
    (("vary", 0), {"keys": ["ground.friction"], "values": [[0.1], [0.2]]}),
    (("vary", 0), {"keys": ["ground.friction", "motion.speed"], "values": [0.1, 0.2]}),
    (("vary", 0), {"keys": ["ground.friction", "motion.speed"], "linspace": [0, 1, 3]}),
    (("vary", 0), {"keys": ["ground.friction", "motion.sped"], "values": [[0.1, 10]]}),
    (("vary", 0), {"key": "time.end", "keys": ["ground.friction", "motion.speed"], "values": [[0.1, 10]]}),
    (("columns",), "force_x"), (("columns",), ["force_x", "force_x"]),
    (("sample",), {"count": 0}), (("sample",), {"count": 3, "kind": "grid"}),
    (("sample",), {"count": 3, "seed": -1}), (("sample",), {}), (("window",), {"from": "a"}),
    (("window",), {"begin": 1}),
]


@needs_jsonschema
class OfStudies(ProgramTest):
    def test_wrong_studies_are_refused_by_both(self):
        self.case()

        def code_of(document):
            study = self.case(file_of(document), "study.toml")
            return run("sweep", study, "--dry-run").returncode

        self.assertEqual((errors("study", STUDY), code_of(STUDY)), ([], 0))
        list_key = copy.deepcopy(STUDY)
        list_key["vary"][0] = {"key": "material.region[0].density", "values": [900.0]}
        self.assertEqual(errors("study", list_key), [])
        together = {**STUDY, "columns": ["torque"], "vary": [
            {"keys": ["ground.friction", "motion.speed"], "values": [[0.1, 9], [0.2, 10]]}]}
        self.assertEqual((errors("study", together), code_of(together)), ([], 0))
        for path, value in WRONG_STUDIES:
            document = copy.deepcopy(STUDY)
            here = document
            for part in path[:-1]:
                here = here[part]
            here[path[-1]] = value
            with self.subTest(path=path, value=value):
                self.assertNotEqual(errors("study", document), [])
                self.assertEqual(code_of(document), 2)
        for name in "schema", "base", "vary":
            document = {key: value for key, value in STUDY.items() if key != name}
            self.assertNotEqual(errors("study", document), [])
            self.assertEqual(code_of(document), 2)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of schemas and documents share: the program's schemas, read by python3-jsonschema."""
import functools
import json
import sys
import tomllib
import unittest

from program import run

try:
    import jsonschema
except ImportError:
    jsonschema = None

SKIPPED = 77  # what ctest takes for it
needs_jsonschema = unittest.skipIf(jsonschema is None, "python3-jsonschema is not installed")


def main(has_all=jsonschema is not None):
    """unittest.main(), but a test of which parts are left out says that it was skipped."""
    program = unittest.main(exit=False, module="__main__")
    passed = program.result.wasSuccessful()
    sys.exit(0 if passed and has_all else SKIPPED if passed else 1)


@functools.cache
def schema(name):
    done = run("schema", name)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@functools.cache
def validator(name):
    jsonschema.Draft4Validator.check_schema(schema(name))
    return jsonschema.Draft4Validator(schema(name))


def errors(name, document):
    return list(validator(name).iter_errors(document))


def dotted(path):
    """["output", "probe", 0, "name"] to "output.probe[0].name"."""
    text = ""
    for part in path:
        text += f"[{part}]" if isinstance(part, int) else f".{part}" if text else part
    return text


def faults_of_schema(name, document):
    """Dotted paths of what is wrong; "" is the whole."""
    return {dotted(error.absolute_path) for error in errors(name, document)}


def faults_of_check(case):
    """(exit code, dotted keys) of `rondo check`."""
    done = run("check", case, "--json")
    return done.returncode, {fault["key"] for fault in json.loads(done.stdout)["faults"]}


def toml_of(value):
    """A value of JSON as TOML in one line."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {toml_of(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml_of, value)) + "]"
    return json.dumps(value)


def file_of(document):
    """A document as a TOML file: each table in a line, which is how the program reads it as well."""
    return "".join(f"{key} = {toml_of(value)}\n" for key, value in document.items())


def read_toml(path):
    return tomllib.loads(path.read_text())

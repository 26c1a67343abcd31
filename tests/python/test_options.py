# SPDX-License-Identifier: BSD-3-Clause
"""Keyword arguments of the functions against the table of options of the library (rondo/options.py)."""
import inspect

import pytest

import rondo
from rondo.options import OPTIONS

OWN = {"run": {"arguments"}, "sweep": {"jobs"}}  # what the command line has in another form


def keywords(function):
    """{name: "int | None = None"}"""
    return {one.name: f"{one.annotation} = {one.default}" for one in inspect.signature(function).parameters.values()
            if one.kind is one.KEYWORD_ONLY}


@pytest.mark.parametrize("command", OPTIONS)
def test_a_function_has_the_options_of_its_command(command):
    found = keywords(getattr(rondo, command))
    assert {name: text for name, text in found.items() if name not in OWN.get(command, ())} == {
        name: text for name, (text, _) in OPTIONS[command].items()}


@pytest.mark.parametrize("function", [rondo.solve, rondo.Simulation.__init__])
def test_others_that_run_a_case_have_some_of_them(function):
    found = keywords(function)
    assert "threads" in found
    assert found == {name: OPTIONS["run"][name][0] for name in found}


def test_help_tells_what_they_mean():
    for function, command in [(getattr(rondo, name), name) for name in OPTIONS] + [(rondo.solve, "run")]:
        for name in set(keywords(function)) & set(OPTIONS[command]):
            assert f"    {name}: {OPTIONS[command][name][1]}." in function.__doc__, name


@pytest.mark.parametrize("options, said", [
    ({"threads": 0}, r"threads = 0: is out of bounds.*1 to 1024"), ({"threads": True}, r"threads = True: is of a wrong type"),
    ({"threads": "two"}, r"threads = 'two': is of a wrong type \(allowed: a whole number\)"),
    ({"overwrite": True, "resume": True}, "resume.*continues what overwrite would remove.*one of the two"),
    ({"reduced_step": 2e-4}, "reduced_step = 0.0002: is an option of a reduced run.*with reduced = 'case', or a file of rondo.reduce"),
    ({"modes": 5}, "modes = 5: is an option of a reduced run")])
def test_what_the_command_line_refuses_is_refused(case, options, said):
    with pytest.raises(rondo.InputError, match=said):
        rondo.run(case, "out", **options)


def test_errors_call_options_by_their_names_in_python(case):
    for options, said in [({"spins": 5.0}, r"spins = 5\.0: is of a wrong type \(allowed: a list of numbers\)"),
                          ({"sweep": "0:1"}, "sweep = 0:1: is no sweep")]:
        with pytest.raises(rondo.InputError, match=f"^{said}"):
            rondo.modes(case, "out", **options)
    rondo.run(case, "out", {"time.end": 0.001})
    for options, said in [({"field": "heat"}, "field = heat: "), ({"from_time": 5.0, "to_time": 6.0}, "from_time, to_time = 5 to 6 s: ")]:
        with pytest.raises(rondo.InputError, match=f"^{said}"):
            rondo.pod("out", **options)

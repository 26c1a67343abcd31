# SPDX-License-Identifier: BSD-3-Clause
"""The pages of man: rondo(1), one of each command, and rondo-case(5), the keys of a case."""
from __future__ import annotations

import re
from typing import Any

from help_text import Entry, Help
from troff import Page, bold, italic, prose

MANUAL = {1: "User Commands", 5: "File Formats"}
EXIT = (("0", "done"), ("2", "wrong input: an option, a case, a study, a mesh"),
        ("3", "a numerical failure: the energy balance or the law of contact is broken, or no solution "
              "is found"),
        ("4", "files: one cannot be read or written, or is damaged"),
        ("130", "interrupted; what the results directory holds can be resumed"))
ENVIRONMENT = (("RONDO_MESH_READER", "the program that reads Gmsh files, if it is not the "
                "rondo-mesh-reader beside rondo"),)
FILES = (("history.csv", "forces, energies and ledger over time"),
         ("results.h5", "mesh and fields (HDF5)"),
         ("fields.vtkhdf, fields.xdmf", "the same for ParaView"),
         ("contact.csv, run.json, case.toml", "contacts, what the run was, the case as it was run"))
# Notes that say no more than the sections here.
SAID = re.compile(r"^(Exit codes: 0 done.*|Each command has its own help.*)$")


def _page(name: str, section: int, about: dict[str, str]) -> Page:
    return Page(name, section, about["date"], about["version"], MANUAL[section])


def _name(page: Page, name: str, meaning: str) -> None:
    page.heading("NAME").paragraph(f"{prose(name)} \\- {prose(meaning.split(': ')[0].split(';')[0])}")


def _sentences(entry: Entry) -> str:
    parts = [entry.meaning]
    if entry.allowed:
        parts.append(f"Allowed: {entry.allowed}.")
    if entry.default:
        parts.append(f"Default: {entry.default}.")
    if entry.needs:
        parts.append(f"Only with {entry.needs}.")
    if entry.excludes:
        parts.append(f"Not with {entry.excludes}.")
    if len(parts) > 1 and not parts[0].endswith("."):
        parts[0] += "."
    return prose(" ".join(parts))


def _option(page: Page, entry: Entry) -> None:
    term = ", ".join(bold(name) for name in entry.names)
    if entry.value:
        term += f" {italic(entry.value)}" + (r"\ ..." if entry.many else "")
    if entry.names[-1] == "--help":
        entry.meaning = "prints this help and ends"
    if entry.names[-1] == "--version":
        entry.meaning = "prints version and build and ends"
    page.item(term, _sentences(entry))


def _shown(argument: Entry) -> str:
    dots = r"\ ..." if argument.many else ""
    return f"{italic(argument.names[0])}{dots}" if argument.required else f"[{italic(argument.names[0])}{dots}]"


def _ends(page: Page, see: list[str]) -> Page:
    page.heading("SEE ALSO").paragraph(" ,\n".join(f".BR {prose(name[:-3])} {name[-3:]}" for name in see))
    page.paragraph(prose("The documentation: docs/ of the sources, /usr/share/doc/rondo/docs of Debian's "
                         "package."))
    return page


def _list(page: Page, heading: str, rows: tuple[tuple[str, str], ...]) -> None:
    page.heading(heading)
    for term, meaning in rows:
        page.item(bold(term), prose(meaning))


def _notes(page: Page, notes: list[str]) -> None:
    kept = " ".join(note for note in notes if not SAID.match(note.strip()))
    if kept:
        page.heading("NOTES").paragraph(prose(kept))


def command_page(name: str, text: Help, about: dict[str, str], see: list[str]) -> str:
    page = _page(f"rondo-{name}", 1, about)
    _name(page, f"rondo-{name}", text.meaning)
    page.heading("SYNOPSIS").paragraph(
        " ".join([bold(f"rondo {name}"), f"[{italic('options')}]", *map(_shown, text.arguments)]))
    page.heading("DESCRIPTION").paragraph(prose(text.meaning[:1].upper() + text.meaning[1:] + "."))
    for argument in text.arguments:
        page.item(italic(argument.names[0]), _sentences(argument))
    page.heading("OPTIONS")
    for option in text.options:
        _option(page, option)
    if text.examples:
        page.heading("EXAMPLES").commands(text.examples)
    _list(page, "EXIT STATUS", EXIT)
    _notes(page, text.notes)
    return _ends(page, see).text()


def top_page(text: Help, about: dict[str, str], see: list[str]) -> str:
    page = _page("rondo", 1, about)
    _name(page, "rondo", text.meaning.removeprefix("rondo: "))
    page.heading("SYNOPSIS").paragraph(f"{bold('rondo')} {italic('command')} [{italic('options')}] ...")
    page.heading("DESCRIPTION").paragraph(prose(
        "rondo computes how deformable disks, wheels and other bodies roll, in exact frictional contact "
        "with rigid ground. A case file says what is to be computed, in TOML and SI units; a run leaves a "
        "results directory."))
    page.heading("COMMANDS")
    for command in text.commands:
        page.item(bold(f"rondo {command.names[0]}"), prose(command.meaning))
    page.heading("OPTIONS")
    for option in text.options:
        _option(page, option)
    if text.examples:
        page.heading("EXAMPLES").commands(text.examples)
    _list(page, "EXIT STATUS", EXIT)
    _list(page, "ENVIRONMENT", ENVIRONMENT)
    _list(page, "FILES", FILES)
    _notes(page, text.notes)
    return _ends(page, see).text()


def reader_page(about: dict[str, str]) -> str:
    page = _page("rondo-mesh-reader", 1, about)
    _name(page, "rondo-mesh-reader", "reads Gmsh files for rondo")
    page.heading("DESCRIPTION").paragraph(prose(
        "Started by rondo, and by the package of Python, where a case names a mesh of Gmsh; not to be called "
        "by people. It is a program of its own since a damaged mesh may end it."))
    return _ends(page, ["rondo(1)", "rondo-case(5)"]).text()


def case_keys(schema: dict[str, Any], path: str = "") -> list[tuple[str, dict[str, Any]]]:
    """Every key by its path, in the order of the table; of lists of tables `[]`."""
    found = []
    for name, value in schema["properties"].items():
        key = f"{path}{name}"
        if "properties" in value:
            if isinstance(value.get("type"), list):  # a value, or a table in its place
                found.append((key, value))
            found += case_keys(value, key + ".")
        elif "properties" in value.get("items", {}) if isinstance(value.get("items"), dict) else False:
            found += case_keys(value["items"], key + "[].")
        else:
            found.append((key, value))
    return found


def _meaning(value: dict[str, Any]) -> str:
    texts = [value.get("description", "")] + [one.get("description", "") for one in value.get("anyOf", [])]
    return next((text for text in texts if text), "")


def case_page(schema: dict[str, Any], about: dict[str, str]) -> str:
    page = _page("rondo-case", 5, about)
    _name(page, "rondo-case", "case files of rondo")
    page.heading("DESCRIPTION").paragraph(prose(
        "A case file says everything about one run, in TOML and SI units. Keys here are written as --set "
        "takes them: ground.friction is the key friction of the table [ground]; of a list of tables, as "
        "output.probe[].name, the number of the table goes into the brackets, from 0."))
    page.paragraph(prose("rondo schema case prints the same for editors. `rondo check` tells what stands "
                         "between keys."))
    page.heading("KEYS")
    table = None
    for key, value in case_keys(schema):
        if key.rpartition(".")[0] != table:
            table = key.rpartition(".")[0]
            page.subheading(f"[{table}]" if table else "Top")
        first, _, facts = _meaning(value).partition("\n\n")
        first = first if first.endswith(".") else first + "."
        page.item(bold(key), prose(first), ".br", prose(facts or "Allowed: see the documentation."))
    page.heading("EXAMPLES").commands(["rondo check /usr/share/rondo/cases/ledge-smooth.toml",
                                       "rondo run case.toml --set ground.friction=0.6"])
    return _ends(page, ["rondo(1)", "rondo-run(1)", "rondo-check(1)"]).text()


def pages(top: Help, commands: dict[str, Help], schema: dict[str, Any],
          about: dict[str, str]) -> dict[str, str]:
    """File names and texts."""
    all_names = [f"rondo-{name}(1)" for name in commands] + ["rondo-case(5)"]
    made = {"rondo.1": top_page(top, about, all_names), "rondo-case.5": case_page(schema, about),
            "rondo-mesh-reader.1": reader_page(about)}
    for name, text in commands.items():
        others = ["rondo(1)"] + [one for one in all_names if one != f"rondo-{name}(1)"]
        made[f"rondo-{name}.1"] = command_page(name, text, about, others)
    return made

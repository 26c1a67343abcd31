# SPDX-License-Identifier: BSD-3-Clause
"""Writes the pages of man and the completion of bash, from what the program says of itself:
    write.py PROGRAM --changelog CHANGELOG.md [--man FOLDER] [--bash FILE]
The pages go into man1 and man5 of FOLDER, and those of commands that are no more are removed there. Their
date is that of the version in the changelog, or of the one before."""
from __future__ import annotations

import argparse
import json
import pathlib
import re

import completion
import help_text
import manual


def about(program: str, changelog: pathlib.Path | None) -> dict[str, str]:
    version = help_text.run(program, "--version").split()[1]
    text = changelog.read_text() if changelog else ""
    found = (re.search(rf"^## \[{re.escape(version)}\] - (\d.*)", text, re.MULTILINE)
             or re.search(r"^## .* - (\d.*)", text, re.MULTILINE))
    return {"version": version, "date": found[1] if found else ""}


def write(path: pathlib.Path, text: str) -> None:
    """And tells its name, for the list of what was installed."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    print(path)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("--changelog", type=pathlib.Path)
    parser.add_argument("--man", type=pathlib.Path)
    parser.add_argument("--bash", type=pathlib.Path)
    asked = parser.parse_args()
    top, commands = help_text.of_program(asked.program)
    schema = json.loads(help_text.run(asked.program, "schema", "case"))
    if asked.man:
        made = manual.pages(top, commands, schema, about(asked.program, asked.changelog))
        files = {asked.man / f"man{name[-1]}" / name: text for name, text in made.items()}
        for old in set(asked.man.glob("man[15]/rondo*.[15]")) - set(files):
            old.unlink()
        for path, text in files.items():
            write(path, text)
    if asked.bash:
        write(asked.bash, completion.script(top, commands, schema))


if __name__ == "__main__":
    main()

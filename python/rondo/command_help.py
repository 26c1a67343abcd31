# SPDX-License-Identifier: BSD-3-Clause
"""--help of the commands in Python, as the program's own commands have it: `rondo figures --help` reads as
`rondo run --help`, and the pages of man and the completion are written from both alike."""
from __future__ import annotations

import argparse
import pathlib
import textwrap
from typing import Any

COLUMN, WIDTH = 30, 100  # of descriptions, of the page


def output_path(text: str) -> pathlib.Path:
    """An empty name is a variable of the shell that is not set, not the working directory."""
    if not text:
        raise argparse.ArgumentTypeError("is empty: a name is to follow, or the option is to be left out")
    return pathlib.Path(text)


KINDS: dict[Any, str] = {int: "INT", float: "FLOAT", pathlib.Path: "TEXT", output_path: "TEXT", None: "TEXT"}


class CommandParser(argparse.ArgumentParser):
    """Of one command."""

    def format_help(self) -> str:
        arguments = [action for action in self._actions if not action.option_strings]
        options = [action for action in self._actions
                   if action.option_strings and action.help != argparse.SUPPRESS]
        names = "".join(f" {action.dest}{'...' if action.nargs == '+' else ''}" for action in arguments)
        text = f"{self.description} \nUsage: {self.prog} [OPTIONS]{names}\n"
        for title, actions in (("Positionals", arguments), ("Options", options)):
            if actions:
                text += f"\n{title}:\n{''.join(map(_entry, actions))}"
        return text + (f"\n{textwrap.fill(self.epilog, WIDTH)}\n" if self.epilog else "")


def _entry(action: argparse.Action) -> str:
    """A line, or two where the name is long."""
    head = f"  {','.join(action.option_strings) or action.dest}"
    if action.nargs != 0:
        head += f" {KINDS.get(action.type, 'INT')}"
        head += " ..." if action.nargs == "+" else f" x {action.nargs}" if action.nargs else ""
        head += " REQUIRED" if action.required or not action.option_strings else ""
    meaning = "Print this help message and exit" if action.dest == "help" else action.help or ""
    if "%(" in meaning:
        meaning %= vars(action)
    lines = textwrap.wrap(meaning, WIDTH - COLUMN, break_on_hyphens=False)
    start = head.ljust(COLUMN) if len(head) < COLUMN else f"{head}\n{'':{COLUMN}}"
    return start + f"\n{'':{COLUMN}}".join(lines) + "\n"

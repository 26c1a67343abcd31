# SPDX-License-Identifier: BSD-3-Clause
"""The case as run, with its comments, names and numbers told apart."""
from __future__ import annotations

import base64
import pathlib
import re

from ..data.errors import Error
from ..data.plain_files import bytes_of
from .document import note, told
from .encoding import escaped

_PARTS = re.compile(r"""(?P<comment>\#[^\n]*)|(?P<string>\"\"\".*?\"\"\"|"(?:\\.|[^"\\\n])*"|'[^'\n]*')
    |(?P<table>^\s*\[\[?[A-Za-z_][^\]\n]*\]\]?)|(?P<key>^\s*[A-Za-z_][\w.-]*(?=\s*=))
    |(?P<number>(?<![\w.])[+-]?\d[\d_]*(?:\.\d+)?(?:[eE][+-]?\d+)?(?!\w)|\btrue\b|\bfalse\b)""",
                    re.VERBOSE | re.MULTILINE | re.DOTALL)


def highlighted(text: str) -> str:
    """TOML as HTML."""
    parts, place = [], 0
    for found in _PARTS.finditer(text):
        parts.append(escaped(text[place:found.start()]))
        parts.append(f'<span class="{found.lastgroup}">{escaped(found.group())}</span>')
        place = found.end()
    parts.append(escaped(text[place:]))
    return "".join(parts)


def case_html(path: pathlib.Path) -> str:
    """The file, to read and to save."""
    try:
        data = bytes_of(path)
        text = data.decode()
    except (Error, ValueError) as reason:
        return note(f"{path.name} cannot be read: {told(reason, path.parent)}")
    link = (f'<a class="button" download="{escaped(path.name)}" href="data:application/toml;base64,'
            f'{base64.b64encode(data).decode()}">Save as a file</a>')
    return (f"<p>All that the program was told, defaults written out. <code>rondo run "
            f"{escaped(path.name)}</code> gives the same results to the last bit. {link}</p>"
            f'<pre class="case" tabindex="0"><code>{highlighted(text)}</code></pre>')

# SPDX-License-Identifier: BSD-3-Clause
"""One page of HTML that needs nothing besides itself: sections, data, style, scripts."""
from __future__ import annotations

import os
import pathlib
from collections.abc import Iterable, Sequence
from typing import Any

from .. import style
from ..data.errors import FileError
from .encoding import escaped, json_text
from .plotly import plotly

ASSETS = pathlib.Path(__file__).resolve().parent / "assets"
SCRIPTS = ("base.js", "scene2d.js", "scene3d.js", "viewer.js", "charts.js", "table.js", "sweep.js")
STEPS = 64  # colours of a scale
# Nothing is fetched, whatever a script should try.
POLICY = ("default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
          "img-src data: blob:")


class Document:
    """A page in the making. Texts given to it are HTML: what is of the user goes through escaped()."""

    def __init__(self, title: str, kind: str) -> None:
        self.title, self.kind = title, kind
        self._sections: list[tuple[str, str, str]] = []
        self._data: dict[str, Any] = {}

    def section(self, name: str, heading: str, content: str) -> None:
        if content:
            self._sections.append((name, heading, content))

    def data(self, name: str, values: Any) -> None:
        """For a script, which finds it by this name."""
        self._data[name] = values

    @property
    def charts(self) -> dict[str, Any]:
        """What chart() was given, by name."""
        return {name: values for name, values in self._data.items()
                if isinstance(values, dict) and "traces" in values}

    def viewer(self, name: str, values: Any, label: str) -> str:
        """A body on a canvas; label: what is seen, in words."""
        self.data(name, values)
        return (f'<div class="viewer" data-source="{name}" role="group" aria-label="{escaped(label)}">'
                "<noscript><p>The moving picture needs JavaScript, which is switched off here.</p>"
                "</noscript></div>")

    def chart(self, name: str, values: Any, label: str) -> str:
        """Curves that zoom."""
        self.data(name, values)
        return (f'<figure class="chart"><figcaption>{escaped(label)}</figcaption>'
                f'<div class="plot" data-source="{name}" role="img" aria-label="{escaped(label)}">'
                "<noscript><p>Curves need JavaScript, which is switched off here.</p></noscript>"
                "</div></figure>")

    def text(self) -> str:
        """The whole page."""
        inside = "".join(f'<a href="#{name}">{heading}</a>' for name, heading, _ in self._sections)
        sections = "".join(f'<section id="{name}"><h2>{heading}</h2>{content}</section>\n'
                           for name, heading, content in self._sections)
        data = "".join(f'<script type="application/json" id="data-{name}">{json_text(values)}'
                       "</script>\n" for name, values in self._data.items())
        return (f'<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
                f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">\n'
                '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
                '<meta name="color-scheme" content="light dark">\n'
                '<link rel="icon" href="data:,">\n'
                f"<title>{escaped(self.title)} – rondo</title>\n"
                f"<style>\n{_asset('report.css')}</style>\n</head>\n<body>\n"
                f'<header><p class="kind">rondo report · {escaped(self.kind)}</p>'
                f"<h1>{escaped(self.title)}</h1>"
                f'<nav aria-label="Sections">{inside}</nav></header>\n<main>\n{sections}</main>\n'
                f"<footer>{_footer()}</footer>\n{data}{self._scripts()}</body>\n</html>\n")

    def write(self, target: pathlib.Path) -> pathlib.Path:
        """Into a file, which is whole or is not there.
        @raise FileError: it cannot be written."""
        fresh = target.with_name(f".{target.name}.{os.getpid()}.tmp")
        try:
            fresh.write_bytes(self.text().encode("utf-8", "replace"))
            fresh.replace(target)
        except OSError as reason:
            raise FileError(f"{target}: cannot be written: {reason.strerror or reason}; choose another -o") from None
        finally:  # also at Ctrl-C
            fresh.unlink(missing_ok=True)
        return target

    def _scripts(self) -> str:
        colours = {"sequential": _colours(style.SEQUENTIAL), "diverging": _colours(style.DIVERGING)}
        scripts = [plotly()] if self._data else []
        scripts.append(f"window.rondo = {{colours: {json_text(colours)}}};\n"
                       + "".join(_asset(name) for name in SCRIPTS))
        return "".join(f"<script>\n{_inside(text)}\n</script>\n" for text in scripts)


def _inside(text: str) -> str:
    """A script that its own texts do not end."""
    return text.replace("</script", "<\\/script")


def _asset(name: str) -> str:
    return (ASSETS / name).read_text(encoding="utf-8")


def _colours(scale: Any) -> list[str]:
    return [_hexadecimal(scale(step / (STEPS - 1))) for step in range(STEPS)]


def _hexadecimal(colour: Sequence[float]) -> str:
    return "#" + "".join(f"{round(255 * part):02x}" for part in colour[:3])


def _footer() -> str:
    return ("Made by rondo, which is free software (BSD-3-Clause). This page is one file and asks no "
            "network for anything; curves are drawn by plotly.js (MIT licence).")


# Pieces that pages share


def paragraph(text: str, kind: str = "") -> str:
    return f'<p class="{kind}">{text}</p>' if kind else f"<p>{text}</p>"


def note(text: object) -> str:
    """What the reader has to know about what is shown, or is missing."""
    return f'<p class="note">{escaped(text)}</p>'


def told(reason: object, directory: pathlib.Path) -> str:
    """The words of an error without where the results lie: a page is the same from anywhere."""
    text = str(reason)
    for path in sorted({str(directory), str(directory.absolute())}, key=len, reverse=True):
        if directory.name:
            text = text.replace(path, directory.name)
    return text


def tiles(found: Iterable[tuple[str, str, str, str]]) -> str:
    """Figures as cards: what, value, one of "good", "warn", "bad", "", and what it means."""
    marks = {"good": "✓ ", "warn": "! ", "bad": "✗ ", "": ""}
    cards = "".join(f'<div class="tile {kind}"><dt>{escaped(what)}</dt><dd><b>{marks[kind]}'
                    f"{escaped(value)}</b><small>{escaped(meaning)}</small></dd></div>"
                    for what, value, kind, meaning in found)
    return f'<dl class="tiles">{cards}</dl>'


def table(head: Sequence[str], rows: Iterable[Sequence[object]], caption: str = "",
          kinds: Sequence[str] = ()) -> str:
    """Texts in rows; kinds: a class for each column, as "number"."""
    classes = [f' class="{kind}"' if kind else "" for kind in [*kinds, *[""] * len(head)]]
    top = "".join(f'<th scope="col"{which}>{escaped(name)}</th>' for name, which in zip(head, classes))
    body = "".join("<tr>" + "".join(f"<td{which}>{escaped(cell)}</td>"
                                    for cell, which in zip(row, classes)) + "</tr>" for row in rows)
    above = f"<caption>{escaped(caption)}</caption>" if caption else ""
    return (f'<div class="wide" tabindex="0" role="group" aria-label="{escaped(caption or "table")}">'
            f"<table>{above}<thead><tr>{top}</tr></thead><tbody>{body}</tbody></table></div>")


def folded(summary: str, content: str, is_open: bool = False) -> str:
    return f"<details{' open' if is_open else ''}><summary>{summary}</summary>{content}</details>"

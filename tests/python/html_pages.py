# SPDX-License-Identifier: BSD-3-Clause
"""Reads a report as a browser would: elements that must balance, links, data in its scripts."""
from __future__ import annotations

import base64
import json
import re
import zlib
from html.parser import HTMLParser
from typing import Any

import numpy as np

EMPTY = {"meta", "link", "br", "img", "input", "hr"}
TYPES = {"int16": "<i2", "uint8": "|u1", "uint16": "<u2", "uint32": "<u4", "float32": "<f4"}


class Page(HTMLParser):
    """elements: (name, attributes) in turn; text: what is seen; faults: what does not balance; data:
    by the name of the script; scripts: texts of the others."""

    def __init__(self, text: str) -> None:
        super().__init__(convert_charrefs=True)
        self.source = text
        self.elements: list[tuple[str, dict[str, Any]]] = []
        self.open: list[str] = []
        self.faults: list[str] = []
        self.text = ""
        self.data: dict[str, Any] = {}
        self.scripts: list[str] = []
        self.style = ""
        self._script: dict[str, Any] = {}
        self.feed(text)
        self.close()
        self.faults += [f"<{name}> is not closed" for name in self.open]
        names = [attributes["id"] for _, attributes in self.elements if "id" in attributes]
        self.faults += [f"id {name} twice" for name in {n for n in names if names.count(n) > 1}]

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        names = [name for name, _ in attrs]
        if len(set(names)) < len(names):
            self.faults.append(f"<{tag}>: an attribute twice")
        self.elements.append((tag, dict(attrs)))
        if tag in ("p", "h2", "table", "figure", "section") and "p" in self.open:
            self.faults.append(f"<{tag}> in <p>")
        if tag not in EMPTY:
            self.open.append(tag)
        self._script = dict(attrs) if tag == "script" else {}

    def handle_endtag(self, tag: str) -> None:
        if not self.open or self.open[-1] != tag:
            self.faults.append(f"</{tag}> in {self.open[-3:]}, line {self.getpos()[0]}")
            return
        self.open.pop()

    def handle_data(self, data: str) -> None:
        inside = self.open[-1] if self.open else ""
        if inside == "script":
            if self._script.get("type") == "application/json":
                self.data[self._script["id"].removeprefix("data-")] = json.loads(data)
            else:
                self.scripts.append(data)
        elif inside == "style":
            self.style += data
        else:
            self.text += data

    def fetched(self) -> list[str]:
        """What a browser would ask the network for."""
        found = []
        for tag, attributes in self.elements:
            for name in ("src", "srcset", "poster", "data", "action", "background"):
                if attributes.get(name) and not attributes[name].startswith("data:"):
                    found.append(f"{tag} {attributes[name][:60]}")
            if tag == "link" and not attributes.get("href", "").startswith("data:"):
                found.append(f"link {attributes}")
        return found + re.findall(r"url\([^)]*\)|@import[^;]*", self.style)


def unpacked(packed: dict[str, Any]) -> np.ndarray:
    """As assets/base.js."""
    kind = np.dtype(TYPES[packed["type"]])
    data = np.frombuffer(zlib.decompress(base64.b64decode(packed["data"])), dtype=np.uint8)
    values = data.reshape(kind.itemsize, -1).T.copy().view(kind).reshape(packed["shape"])
    if packed["differences"]:
        values = np.cumsum(values.astype(np.int64), axis=0).astype(kind)
    return values * packed.get("scale", 1) + packed.get("low", 0)

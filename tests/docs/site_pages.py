# SPDX-License-Identifier: BSD-3-Clause
"""The HTML of the built site, read without a browser: links, anchors, what it loads, counts of tags."""
import collections
import html.parser
import pathlib
import re
import urllib.parse

COUNTED = ("h1", "h2", "h3", "h4", "li", "table", "tr", "pre", "blockquote", "strong")
LOADED = {"script": "src", "img": "src", "link": "href", "iframe": "src", "source": "src", "video": "src"}


class Page(html.parser.HTMLParser):
    def __init__(self, text: str):
        super().__init__(convert_charrefs=True)
        self.ids: set[str] = set()
        self.links: list[str] = []
        self.loaded: list[str] = []
        self.tags: collections.Counter[str] = collections.Counter()
        self.shown: list[str] = []
        self.maths = 0
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        of = dict(attributes)
        self.ids |= {of[key] for key in ("id", "name") if of.get(key)}
        if tag == "a" and of.get("href"):
            self.links.append(of["href"])
        if tag in LOADED and of.get(LOADED[tag]) and of.get("rel") != "canonical":
            self.loaded.append(of[LOADED[tag]])
        self.maths += "arithmatex" in (of.get("class") or "").split()
        self.tags[tag] += 1

    def handle_data(self, data):
        self.shown.append(data)


def article(text: str) -> str:
    """What the page itself says, without navigation; a block of code is one `pre`."""
    inside = re.search(r"<article.*?>(.*)</article>", text, re.DOTALL)
    assert inside, "no article"
    return inside[1]


def read(site: pathlib.Path) -> dict[pathlib.Path, Page]:
    return {path: Page(path.read_text()) for path in sorted(site.rglob("*.html"))}


def dead(site: pathlib.Path, pages: dict[pathlib.Path, Page]) -> list[str]:
    """Links and loaded files of the pages that are not in the site; files of another host."""
    wrong = []
    for path, page in pages.items():
        for link in page.links + page.loaded:
            name = f"{path.relative_to(site)}: {link}"
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                if link in page.loaded or parts.scheme not in ("http", "https", "mailto"):
                    wrong.append(f"{name}: not of the site")
                continue
            goal = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
            anchor = urllib.parse.unquote(parts.fragment)
            if not goal.is_file():
                wrong.append(f"{name}: no such file")
            elif anchor and not anchor.startswith("__") and anchor not in pages[goal].ids:
                wrong.append(f"{name}: no such anchor")
    return wrong


def other_hosts(site: pathlib.Path) -> list[str]:
    """What the site's own styles and pages would load from elsewhere: url(...), @import."""
    found = []
    for path in site.rglob("*"):
        if path.suffix in (".css", ".html"):
            found += [f"{path.relative_to(site)}: {address}" for address in re.findall(
                r"""(?:url\(|@import )["']?((?:https?:)?//[^"')]+)""", path.read_text())]
    return found

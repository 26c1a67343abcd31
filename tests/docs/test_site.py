# SPDX-License-Identifier: BSD-3-Clause
"""The site that scripts/docs.sh makes: whole, without a dead link, without a network, with all that the sources
say. In a browser: test_site_browser.py."""
import collections
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import markdown_it

from pages import ROOT
import site_pages

BUILD = ROOT / "scripts" / "site" / "build.py"
sys.dont_write_bytecode = True
sys.path.insert(0, str(BUILD.parent))
import build  # noqa: E402
import github  # noqa: E402

MATHS = re.compile(r"(?<![\\$])(\$\$?)(?![\s$])(?:\\.|[^\\$])+?(?<!\s)\1", re.DOTALL)


def maths_of(text: str) -> int:
    """The equations of a page as GitHub counts them: $...$ and $$...$$ outside of code."""
    prose = "\n".join(part for fenced, part in github.split_fences(text) if not fenced)
    prose = re.sub(r"(`+)(?!`).*?(?<!`)\1(?!`)", "", prose, flags=re.DOTALL)
    return len(MATHS.findall(prose))


def tags_of(text: str) -> collections.Counter:
    """The tags of a page as another reader of Markdown, one that keeps to CommonMark, sees them."""
    html = markdown_it.MarkdownIt("commonmark").enable("table").render(text)
    return site_pages.Page(html).tags


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.site = pathlib.Path(cls.folder.name).resolve() / "site"
        subprocess.run(["/usr/bin/python3", BUILD, cls.site], check=True)
        cls.pages = site_pages.read(cls.site)
        cls.sources = {path: cls.site / ("index.html" if path == ROOT / "README.md" else re.sub(
            r"README\.html$", "index.html", path.relative_to(ROOT).with_suffix(".html").as_posix()))
            for pattern in build.PAGES for path in ROOT.glob(pattern)}

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def article(self, source):
        return site_pages.Page(site_pages.article(self.sources[source].read_text()))

    def test_no_dead_link_and_nothing_of_another_host(self):
        self.assertGreater(len(self.pages), 130)
        self.assertEqual(site_pages.dead(self.site, self.pages), [])
        self.assertEqual(site_pages.other_hosts(self.site), [])

    def test_every_page_is_there_with_its_headings_lists_tables_and_blocks(self):
        for source in self.sources:
            expected, found = tags_of(source.read_text()), self.article(source).tags
            wrong = {tag: (expected[tag], found[tag]) for tag in site_pages.COUNTED
                     if expected[tag] != found[tag]}
            self.assertEqual(wrong, {}, f"{source}: expected and found")

    def test_every_equation(self):
        total = 0
        for source in self.sources:
            expected = maths_of(source.read_text())
            self.assertEqual(self.article(source).maths, expected, source)
            total += expected
        self.assertGreater(total, 1000)

    def test_no_comment_and_no_markup_shows(self):
        for source in self.sources:
            text = re.sub(r"<(pre|code).*?</\1>", "", site_pages.article(self.sources[source].read_text()),
                          flags=re.DOTALL)
            shown = "".join(site_pages.Page(text).shown)
            for mark in ("<!--", "{: #", "](", "$$", "```", "| --", "|---"):
                self.assertNotIn(mark, shown, source)
            self.assertNotIn("<!-- ", text, source)

    def test_search_holds_every_page_and_case(self):
        index = json.loads((self.site / "search" / "search_index.json").read_text())
        found = {entry["location"].split("#")[0] for entry in index["docs"]}
        expected = {path.relative_to(self.site).as_posix() for path in self.pages}
        self.assertEqual(expected - found, set())
        for case in (*ROOT.glob("cases/*.toml"), *ROOT.glob("cases/studies/*.toml"), *ROOT.glob("examples/*.py")):
            self.assertIn(case.relative_to(ROOT).with_suffix(".html").as_posix(), found)
        text = next(entry["text"] for entry in index["docs"] if entry["location"] == "cases/wheel-abs.html")
        self.assertIn("braked in pulses", text)
        script = (self.site / "search" / "search_index.js").read_text()
        self.assertEqual(json.loads(script.removeprefix("window.rondo_search = ").rstrip(";\n"))["index"], index)


class Conversion(unittest.TestCase):
    def test_blank_lines_anchors_comments_and_links(self):
        text = "# A b\ntext:\n- x [y](z.md)\n<!-- long: no -->\n## A b\nwith (1):\n$$a\n=b$$\nend `[y](z.md)` [g](gone)\n"
        goal = {"z.md": "../z.md", "gone": None}.get
        self.assertEqual(github.converted(text, goal).split("\n"), [
            "# A b {: #a-b }", "text:", "", "- x [y](../z.md)", "", "## A b {: #a-b-1 }", "with (1):", "", "$$a",
            "=b$$", "", "end `[y](z.md)` g", ""])


class WhatIsRefused(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.stage = build.Stage(pathlib.Path(folder.name))

    def test_a_page_that_is_not_in_the_navigation(self):
        self.stage.sources.append(ROOT / "docs" / "new.md")
        with self.assertRaisesRegex(build.SiteError, r"not in the navigation: docs/new\.md: give each a line"):
            build.configuration(self.stage, pathlib.Path("site"))

    def test_a_link_to_nothing(self):
        with self.assertRaisesRegex(build.SiteError, r"docs/theory\.md: a link to \.\./gone\.toml"):
            self.stage.goal(ROOT / "docs" / "theory.md", "../gone.toml")

    def test_a_site_with_dead_links(self):
        site = self.stage.folder
        (site / "a.html").write_text('<a href="#no">a</a><a href="b.html">b</a><script src="http://x/y"></script>')
        self.assertEqual([text.rsplit(": ", 1)[1] for text in site_pages.dead(site, site_pages.read(site))],
                         ["no such anchor", "no such file", "not of the site"])


if __name__ == "__main__":
    unittest.main()

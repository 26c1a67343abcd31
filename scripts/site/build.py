# SPDX-License-Identifier: BSD-3-Clause
"""Builds the site of the documentation: python3 scripts/site/build.py FOLDER

Copies the pages, written for GitHub's reading, as mkdocs reads them, with pages of cases and examples, and
runs mkdocs on the copy, with every warning an error. The tree is only read."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import yaml  # type: ignore[import]

import github
import listings

ROOT = pathlib.Path(__file__).resolve().parents[2]
HERE = pathlib.Path(__file__).resolve().parent
KATEX = pathlib.Path("/usr/share/javascript/katex")
THEME = pathlib.Path("/usr/share/mkdocs/themes/material/assets/javascripts/workers")
PAGES = ("README.md", "CHANGELOG.md", "CONTRIBUTING.md", "docs/*.md", "docs/decisions/*.md", "bench/README.md",
         "studies/paper/README.md", "cases/meshes/README.md")
LISTED = {
    "cases": ("Cases", "*.toml", "Ready to run: `rondo run cases/NAME.toml -o results/NAME`. Each says what to "
              "expect. The keys: [case files](../docs/cases.md)."),
    "cases/studies": ("Studies", "*.toml", "Many runs each: `rondo sweep cases/studies/NAME.toml -o results/NAME`. "
                      "How: [studies and sweeps](../../docs/studies.md)."),
    "examples": ("Examples", "*.[pc]*", "To run and to change: `python3 examples/NAME.py` ([results in Python](../docs/python.md)); programs in "
                 "C++ are for [the library](../docs/library.md)."),
}


class SiteError(Exception):
    """What keeps the site from being built, and what to do."""


class Stage:
    """The copy that mkdocs reads: the folders of the project, so that relative links stay as they are."""

    def __init__(self, folder: pathlib.Path):
        self.folder = folder
        self.sources = sorted({page for pattern in PAGES for page in ROOT.glob(pattern)})

    def write(self, name: str, text: str) -> None:
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def page_for(self, target: pathlib.Path) -> str:
        """The page, as a path in the copy, of a file or folder of the project that is linked to."""
        name = target.relative_to(ROOT).as_posix()
        if target in self.sources or target.suffix in (".png", ".svg", ".gif"):
            return name
        if name in LISTED:
            return f"{name}/index.md"
        if target.parent.relative_to(ROOT).as_posix() in LISTED and target.is_file():
            return str(pathlib.PurePath(name).with_suffix(".md"))
        if (target / "README.md") in self.sources:
            return f"{name}/README.md"
        made = f"files/{name}.md"
        if not (self.folder / made).exists():
            self.write(made, listings.page_of_folder(name, target) if target.is_dir()
                       else listings.page_of(name, target))
        return made

    def goal(self, page: pathlib.Path, link: str) -> str:
        if re.match(r"[a-z]+:|#", link):
            return link
        path, _, name = link.partition("#")
        target = (page.parent / path).resolve()
        if not target.exists() or ROOT not in target.parents:
            raise SiteError(f"{page.relative_to(ROOT)}: a link to {link}, which is not in the project")
        to = os.path.relpath(ROOT / self.page_for(target), page.parent)
        return f"{to}#{name}" if name else to

    def pages(self) -> None:
        for page in self.sources:
            text = github.converted(page.read_text(), lambda link: self.goal(page, link))
            self.write(page.relative_to(ROOT).as_posix(), text)
        for folder, (heading, pattern, about) in LISTED.items():
            files = sorted((ROOT / folder).glob(pattern))
            self.write(f"{folder}/index.md", listings.index(heading, about, files))
            for file in files:
                name = file.relative_to(ROOT)
                self.write(str(name.with_suffix(".md")), listings.page_of(name.as_posix(), file))

    def assets(self) -> None:
        shutil.copytree(ROOT / "docs" / "figures", self.folder / "docs" / "figures")
        katex = self.folder / "site" / "katex"
        katex.mkdir(parents=True)
        for name in ("katex.min.js", "katex.min.css"):
            shutil.copy(KATEX / name, katex)
        shutil.copytree(KATEX / "fonts", katex / "fonts")
        for file in ("site.css", "site.js", "search_from_files.js"):
            shutil.copy(HERE / file, self.folder / "site")


def in_navigation(entry: object) -> list[str]:
    """The pages named by a piece of the navigation."""
    if isinstance(entry, str):
        return [entry]
    parts = entry.values() if isinstance(entry, dict) else entry
    return [page for part in parts for page in in_navigation(part)]  # type: ignore[attr-defined]


def expanded(entry: object, stage: Stage) -> object:
    """"folder/*" becomes its pages under their headings, the README first."""
    if isinstance(entry, dict):
        return {title: expanded(part, stage) for title, part in entry.items()}
    if isinstance(entry, list):
        return [expanded(part, stage) for part in entry]
    if not str(entry).endswith("/*"):
        return entry
    folder = ROOT / str(entry)[:-2]
    pages = sorted((page for page in stage.sources if page.parent == folder),
                   key=lambda page: (page.name != "README.md", page.name))
    return [{page.read_text().splitlines()[0].strip("# "): page.relative_to(ROOT).as_posix()} for page in pages]


def configuration(stage: Stage, site: pathlib.Path) -> dict[str, object]:
    settings = yaml.safe_load((HERE / "mkdocs.yml").read_text())
    settings["nav"] = expanded(settings["nav"], stage)
    listed = in_navigation(settings["nav"])
    missing = [str(page.relative_to(ROOT)) for page in stage.sources
               if page.relative_to(ROOT).as_posix() not in listed]
    if missing:
        raise SiteError(f"not in the navigation: {', '.join(missing)}: give each a line under `nav` in "
                        "scripts/site/mkdocs.yml")
    settings["theme"]["custom_dir"] = str(HERE / "overrides")
    settings["docs_dir"], settings["site_dir"] = str(stage.folder), str(site)
    return settings


def search_from_files(site: pathlib.Path) -> None:
    """What the search fetches, as scripts: a page opened as a file may load those, and fetch nothing."""
    worker, = THEME.glob("search.*.min.js")
    fetched = site / "search" / "search_index.json"
    index = json.loads(fetched.read_text())
    for entry in index["docs"]:
        entry["text"] = re.sub(r"\\[()\[\]]", "", entry["text"])  # marks of equations
    fetched.write_text(json.dumps(index, ensure_ascii=False))
    source = re.sub(r"\n//# sourceMappingURL=.*", "", worker.read_text())
    (site / "search" / "search_index.js").write_text(
        f"window.rondo_search = {json.dumps({'index': index, 'worker': source}, ensure_ascii=False)};\n")


def build(site: pathlib.Path) -> None:
    with tempfile.TemporaryDirectory() as folder:
        stage = Stage(pathlib.Path(folder) / "pages")
        stage.pages()
        stage.assets()
        config = pathlib.Path(folder) / "mkdocs.yml"
        config.write_text(yaml.safe_dump(configuration(stage, site), sort_keys=False, allow_unicode=True))
        done = subprocess.run(["/usr/bin/python3", "-m", "mkdocs", "build", "--strict", "--quiet", "--clean",
                               "-f", str(config)], text=True, capture_output=True)
    if done.returncode != 0:
        raise SiteError(f"mkdocs:\n{done.stdout}{done.stderr}")
    for name in ("404.html", "sitemap.xml", "sitemap.xml.gz"):  # of a site that has an address
        (site / name).unlink()
    search_from_files(site)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    try:
        build(pathlib.Path(sys.argv[1]).resolve())
    except SiteError as error:
        sys.exit(f"docs: {error}")

# SPDX-License-Identifier: BSD-3-Clause
"""Pages of what is no page: cases, studies, examples and files that the documentation links to."""
import html
import pathlib
import re

LANGUAGES = {".toml": "toml", ".py": "python", ".json": "json", ".cpp": "cpp", ".txt": "cmake"}


def heading_comment(text: str) -> list[str]:
    """The paragraphs of the comment or docstring at the head of a file."""
    if docstring := re.match(r'(?:#[^\n]*\n)*"""(.*?)"""', text, re.DOTALL):
        lines = docstring[1].splitlines()
    else:
        lines = []
        for line in text.splitlines():
            if not line.startswith(("#", "//")) or line.startswith("#include"):
                break
            if not line.startswith(("#:schema", "# SPDX", "// SPDX", "#!")):
                lines.append(line.lstrip("#/").strip())
    return [" ".join(part.split()) for part in "\n".join(lines).split("\n\n") if part.strip()]


def title(path: pathlib.Path, text: str) -> str:
    found = re.search(r'^title = "(.*)"', text, re.MULTILINE)
    return f"{path.stem}: {found[1]}" if found else path.name


def block(path: pathlib.Path, text: str) -> str:
    ticks = "````" if "```" in text else "```"
    return f"{ticks}{LANGUAGES.get(path.suffix, 'text')}\n{text.rstrip()}\n{ticks}\n"


def body(path: pathlib.Path, text: str) -> str:
    """Without the comment, which stands above as text."""
    if path.suffix != ".toml":
        return text
    lines = text.splitlines()
    while lines and lines[0].startswith("#"):
        lines.pop(0)
    return "\n".join(lines)


def page_of(name: str, file: pathlib.Path) -> str:
    text = file.read_text()
    paragraphs = "\n\n".join(f"<p>{html.escape(part)}</p>" for part in heading_comment(text))
    return (f"# {title(file, text)}\n\n<p><code>{html.escape(name)}</code></p>\n\n{paragraphs}\n\n"
            f"{block(file, body(file, text))}")


def page_of_folder(name: str, folder: pathlib.Path) -> str:
    parts = [f"## {file.name}\n\n{block(file, file.read_text())}"
             for file in sorted(folder.iterdir()) if file.is_file()]
    return f"# {name}\n\n" + "\n".join(parts)


def first_sentence(paragraphs: list[str]) -> str:
    return re.split(r"(?<=[.:;])\s", paragraphs[0])[0].rstrip(".:;") if paragraphs else ""


def index(heading: str, text: str, files: list[pathlib.Path]) -> str:
    rows = [f"| [{file.name}]({file.stem}.md) | {html.escape(first_sentence(heading_comment(file.read_text())))} |"
            .replace("*", r"\*") for file in files]
    return f"# {heading}\n\n{text}\n\n| file | |\n|---|---|\n" + "\n".join(rows) + "\n"

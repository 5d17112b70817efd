"""The site as plain files: `python -m tests.docs.site FOLDER` writes its pages and the mkdocs.yml that builds it.

A page keeps the links that it has in the repository. On the site a notebook is a page, a command has one of its own,
and what lies beside docs/ is under project/; links are rewritten to match. Any program that takes Markdown and an
mkdocs.yml can build the site of these files: it needs no hooks.
"""

from __future__ import annotations

import base64
import json
import os
import re
import shutil
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import yaml
from latex2mathml.converter import convert

from tests.docs.marking import anchor

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
COMMANDS = DOCS / "cli.md"
"""The page of all commands, of which each is a page of the site too."""
OUTSIDE = "project/"
"""Folder of the site for files that are not in docs/."""

BOOSTS = (
    ("install.md", 8.0),
    ("keywords/", 4.0),
    ("commands/", 4.0),
    ("faq.md", 2.0),
    ("tutorials/", 2.0),
    ("rules/", 0.8),
    ("studies/", 0.5),
    ("benchmarks.md", 0.3),
    ("api/", 0.7),
    (OUTSIDE, 0.3),
)
"""How much sooner than others a search shows the pages whose names begin so."""

_FENCED = re.compile(r"(^```.*?^```$)", re.MULTILINE | re.DOTALL)
_COMMENT = re.compile(r"\A<!--.*?-->\s*", re.DOTALL)
"""What a page that is made from the program begins with; MkDocs would not take the heading behind it as its title."""
_FILE_NAME = re.compile(r"(?<=\[)[\w/-]+\.(?:md|ipynb)(?=\]\(([^)\s#]+))")
"""The text of a link that only repeats the file."""
_TITLE = re.compile(r"^# (.+)$", re.MULTILINE)
_LISTED = re.compile(r"^##+ (.+)$|\]\(([\w-]+/[\w-]+\.md)\)", re.MULTILINE)
"""The headings of a page, and the pages of a folder that it links to."""
_ROW = re.compile(r"^\|.*$", re.MULTILINE)
_CODE = re.compile(r"`[^`]+`")
_FORMULA = re.compile(r"\$\$(.+?)\$\$|\$([^$\n]+)\$", re.DOTALL)
_TARGET = re.compile(r"(?<=\]\()(?![a-z]+:)([^)\s#]*)(?:#([^)\s]*))?(?=[)\s])")
_COMMAND = re.compile(r"^## mudline (\w+)$", re.MULTILINE)
_OPTIONS = re.compile(r"^\| option \|.*\n(?:\|.*\n)+", re.MULTILINE)
_HEADING = re.compile(r"^#+ (.+)$", re.MULTILINE)
_COMMON = "\nNot listed here: the [common options](#common-options).\n"
"""What follows the options on the page of a command."""


# ------------------------------------------------------------------------------------------------------ all of the site


def write(folder: Path) -> None:
    """Write docs/ and mkdocs.yml of the site into a folder, which is emptied first."""
    shutil.rmtree(folder, ignore_errors=True)
    for uri, content in files().items():
        path = folder / "docs" / uri
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
    (folder / "mkdocs.yml").write_text(_settings(), encoding="utf-8")


def files() -> dict[str, str | bytes]:
    """The content of every file of the site by its place: pages, pictures, notebooks, lists of folders."""
    found: dict[str, str | bytes] = {}
    sources = [path for path in sorted(DOCS.rglob("*")) if path.is_file()]
    for path in [*sources, *sorted(_linked_outside())]:
        uri = _uri(path)
        if path.suffix == ".ipynb":
            text, pictures = notebook_page(path)
            found |= {f"tutorials/{name}": picture for name, picture in pictures.items()}
            found[path.relative_to(DOCS).as_posix()] = path.read_bytes()
            found[uri] = _page(text, path, uri)
        elif path == COMMANDS:
            found |= {place: _page(text, path, place) for place, text in _command_pages().items()}
        else:
            found[uri] = (
                _page(path.read_text(encoding="utf-8"), path, uri) if path.suffix == ".md" else path.read_bytes()
            )
    for listed in sorted({path for page in DOCS.rglob("*.md") for path, _ in _targets(page) if _is_listed(path)}):
        names = sorted(path.name for path in listed.iterdir() if path.is_file())
        found[_uri(listed)] = f"# {listed.name}/\n\n" + "".join(f"* [{name}]({name})\n" for name in names)
    return found


def _page(markdown: str, source: Path, here: str) -> str:
    """A page with its links rewritten to where their targets are on the site, which begins with its title.

    A link that has the name of a file for its text gets the title of that page.
    """
    pieces = _FENCED.split(_COMMENT.sub("", markdown))
    for index in range(0, len(pieces), 2):
        titled = _FILE_NAME.sub(lambda match: _title(source.parent / match[1], match[0]), pieces[index])
        pieces[index] = _TARGET.sub(lambda match: _rewritten(match, source, here), _ROW.sub(_plain_bars, titled))
    boost = next((boost for name, boost in BOOSTS if here.startswith(name)), 1.0)
    if here.startswith("keywords/") and any(source.parent.glob(f"{source.stem}-*.md")):
        boost *= 3.0  # NODE is asked for, not NODE,CURVILINEAR
    head = f"---\nsearch:\n  boost: {boost}\n---\n\n" if boost != 1.0 else ""
    return head + "".join(pieces)


def _settings() -> str:
    """mkdocs.yml with the pages that its patterns stand for, for a folder that is not the project's."""
    text = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
    settings, _, nav = text.partition("\nnav:\n")
    settings = settings.replace("paths: [src]", f"paths: [{json.dumps(str(ROOT / 'src'))}]")
    pages = yaml.safe_dump({"nav": _expanded(yaml.safe_load(nav))}, sort_keys=False, allow_unicode=True, width=1000)
    return f"{settings}\n{pages}"


# ------------------------------------------------------------------------------------------------------------- commands


@cache
def _command_pages() -> dict[str, str]:
    """The page of all commands, with the options of each, and a page for each command, by their places."""
    head, *rest = _COMMAND.split(COMMANDS.read_text(encoding="utf-8"))
    kept = [head]
    pages: dict[str, str] = {}
    for name, text in zip(rest[::2], rest[1::2], strict=True):
        body, mark, behind = text.partition("\n## ")
        about = body.strip().partition("\n\n")[0]
        options = _OPTIONS.search(f"{body}\n")
        listed = f"{options[0]}\n" if options else ""
        page = f"commands/mudline-{name}.md"
        kept += [f"## mudline {name}\n\n{about}\n\n{listed}[More on `mudline {name}`]({page})\n{mark}{behind}"]
        body = _OPTIONS.sub(lambda table: f"{table[0]}{_COMMON}", f"{body}\n", count=1)
        pages[page] = f"# mudline {name}\n" + re.sub(r"^##(#+) ", r"#\1 ", body, flags=re.MULTILINE)
    return {"cli.md": "\n".join(kept)} | pages


@cache
def _places() -> dict[str, str]:
    """The page of the site that has a heading of the page of all commands, by the anchor of that heading."""
    return {
        anchor(heading): place
        for place, text in _command_pages().items()
        for heading in _HEADING.findall(_FENCED.sub("", text))
    }


# ------------------------------------------------------------------------------------------------------------ notebooks


def notebook_page(path: Path) -> tuple[str, dict[str, bytes]]:
    """Return a notebook as Markdown, and its pictures by their file names."""
    pictures: dict[str, bytes] = {}
    parts = []
    for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
        source = "".join(cell["source"])
        parts.append(_with_formulas(source) if cell["cell_type"] == "markdown" else f"```python\n{source}\n```")
        parts += [_output(output, path.stem, pictures) for output in cell.get("outputs", ())]
    title, _, rest = "\n\n".join(parts).partition("\n")
    download = f'<a href="{path.name}" download>Download this page as a Jupyter notebook</a>'
    return f"{title}\n\n{download}\n{rest}\n", pictures


def _with_formulas(text: str) -> str:
    """A text with MathML for its formulas, which are TeX between dollar signs; code may hold a dollar sign too."""
    pieces = re.split(r"(`[^`]*`)", text)
    pieces[::2] = [_FORMULA.sub(_formula, piece) for piece in pieces[::2]]
    return "".join(pieces)


def _formula(match: re.Match[str]) -> str:
    if match[1]:
        return f'<div class="formula">{convert(match[1], display="block")}</div>'
    return f"<span>{convert(match[2])}</span>"  # at the beginning of a line <math> would be a paragraph of its own


def _output(output: dict[str, Any], stem: str, pictures: dict[str, bytes]) -> str:
    data = output.get("data", {})
    if "image/png" in data:
        name = f"{stem}-{len(pictures) + 1}.png"
        pictures[name] = base64.b64decode(data["image/png"])
        return f"![What the cell above draws]({name})"
    text = "".join(output.get("text") or data["text/plain"])
    return f"```text\n{text.rstrip()}\n```"


# ------------------------------------------------------------------------------------------------- navigation and links


def _expanded(nav: Any) -> Any:  # noqa: ANN401 - lists, mappings and texts of YAML
    if isinstance(nav, dict):
        return {title: _expanded(entry) for title, entry in nav.items()}
    if not isinstance(nav, list):
        return nav
    return [each for entry in nav for each in (_pages(entry) if "*" in entry else [_expanded(entry)])]


def _pages(pattern: str) -> list[Any]:
    """The pages of a folder; under the headings of the page of its name, where there is one that links to them."""
    found = [path.relative_to(DOCS).as_posix() for path in sorted(DOCS.glob(pattern)) if path.stem != "README"]
    if not found:
        raise ValueError(f"no page matches {pattern!r}: correct nav in mkdocs.yml")
    index = (DOCS / pattern).parent.with_suffix(".md")
    if not index.is_file():
        return list(found)
    groups: dict[str, list[str]] = {}
    title = ""
    for heading, page in _LISTED.findall(index.read_text(encoding="utf-8")):
        title = heading or title
        if page in found:
            groups.setdefault(title, []).append(page)
    return [{title: pages} for title, pages in groups.items()]


def _linked_outside() -> set[Path]:
    """Files outside docs/ that the navigation has or its pages link to, and those that these link to."""
    found: set[Path] = set()
    beside = ("CODE_OF_CONDUCT.md", "CONTRIBUTING.md", "CHANGELOG.md", "SECURITY.md", "samples/README.md")
    waiting = [*DOCS.rglob("*.md"), *(ROOT / name for name in beside)]
    while waiting:
        page = waiting.pop()
        if page in found:
            continue
        if not page.is_relative_to(DOCS):
            found.add(page)
        if page.suffix == ".md":
            waiting += [path for path, _ in _targets(page) if path.is_file() and not path.is_relative_to(DOCS)]
    return found


def _targets(page: Path) -> Iterator[tuple[Path, str]]:
    """The files that a page links to, and the anchors in them."""
    for target, place in _TARGET.findall(_FENCED.sub("", page.read_text(encoding="utf-8"))):
        yield Path(os.path.normpath(page.parent / target)) if target else page, place


def _plain_bars(row: re.Match[str]) -> str:
    """A row of a table with `|` for `\\|` in code, where Python-Markdown would show the backslash."""
    return _CODE.sub(lambda code: code[0].replace("\\|", "|"), row[0])


def _title(path: Path, name: str) -> str:
    found = _TITLE.search(path.read_text(encoding="utf-8")) if path.suffix == ".md" and path.is_file() else None
    return found[1] if found else name


def _rewritten(match: re.Match[str], source: Path, here: str) -> str:
    target, place = match[1], match[2]
    path = Path(os.path.normpath(source.parent / target)) if target else source
    if not (path.is_file() and path.is_relative_to(ROOT)) and not _is_listed(path):
        return match[0]  # the builder of the site says that it is missing
    uri = _places().get(place or "", "cli.md") if path == COMMANDS else _uri(path)
    written = os.path.relpath(uri, Path(here).parent).replace(os.sep, "/") if uri != here else ""
    return f"{written}#{place}" if place else written


def _is_listed(path: Path) -> bool:
    """Whether a page lists the files of this folder; others have a README.md to link to."""
    return path.is_relative_to(DOCS) and path.is_dir() and not (path / "README.md").exists()


def _uri(path: Path) -> str:
    """The place of a file of the repository on the site."""
    if _is_listed(path):
        path /= "index.md"
    if not path.is_relative_to(DOCS):
        return OUTSIDE + path.relative_to(ROOT).as_posix()
    page = path.with_suffix(".md") if path.suffix == ".ipynb" else path
    return page.relative_to(DOCS).as_posix()


if __name__ == "__main__":
    write(Path(sys.argv[1]))

"""Hooks of MkDocs for what the site needs beyond docs/: notebooks as pages, linked files of the repository, its parts.

A page keeps the links that it has in the repository. On the site a notebook is a page, and what lies beside docs/ is
under project/; links are rewritten to match.
"""

from __future__ import annotations

import base64
import json
import os
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from latex2mathml.converter import convert
from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files, InclusionLevel
from mkdocs.structure.pages import Page

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
OUTSIDE = "project/"
"""Folder of the site for files that are not in docs/."""

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
_TARGET = re.compile(r"(?<=\]\()(?![a-z]+:|#)([^)\s#]+)")


def on_config(config: MkDocsConfig) -> MkDocsConfig:
    """Put the pages of a folder where the navigation has `*`."""
    config.nav = _expanded(config.nav)
    return config


def on_files(files: Files, *, config: MkDocsConfig) -> Files:
    """Add notebooks as pages, files outside docs/ that a page links to, and lists of folders that a page links to."""
    for notebook in sorted(DOCS.glob("tutorials/*.ipynb")):
        text, pictures = notebook_page(notebook)
        files.append(File.generated(config, _uri(notebook), content=text))
        for name, picture in pictures.items():
            files.append(File.generated(config, f"tutorials/{name}", content=picture))
    for path in sorted(_linked_outside()):
        files.append(File.generated(config, _uri(path), abs_src_path=str(path)))
    for folder in sorted({path for page in DOCS.rglob("*.md") for path in _targets(page) if _is_listed(path)}):
        names = sorted(path.name for path in folder.iterdir() if path.is_file())
        text = f"# {folder.name}/\n\n" + "".join(f"* [{name}]({name})\n" for name in names)
        files.append(File.generated(config, _uri(folder), content=text, inclusion=InclusionLevel.NOT_IN_NAV))
    return files


def on_page_markdown(markdown: str, *, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Rewrite the links of a page to where their targets are on the site, and let it begin with its title.

    A link that has the name of a file for its text gets the title of that page.
    """
    del config, files
    here = page.file.src_uri
    source = _source(here)
    pieces = _FENCED.split(_COMMENT.sub("", markdown))
    for index in range(0, len(pieces), 2):
        titled = _FILE_NAME.sub(lambda match: _title(source.parent / match[1], match[0]), pieces[index])
        pieces[index] = _TARGET.sub(lambda match: _rewritten(match[1], source, here), _ROW.sub(_plain_bars, titled))
    return "".join(pieces)


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
    beside = ("CONTRIBUTING.md", "CHANGELOG.md", "SECURITY.md", "samples/README.md")
    waiting = [*DOCS.rglob("*.md"), *(ROOT / name for name in beside)]
    while waiting:
        page = waiting.pop()
        if page in found:
            continue
        if not page.is_relative_to(DOCS):
            found.add(page)
        if page.suffix == ".md":
            waiting += [path for path in _targets(page) if path.is_file() and not path.is_relative_to(DOCS)]
    return found


def _targets(page: Path) -> Iterator[Path]:
    for target in _TARGET.findall(_FENCED.sub("", page.read_text(encoding="utf-8"))):
        yield Path(os.path.normpath(page.parent / target))


def _plain_bars(row: re.Match[str]) -> str:
    """A row of a table with `|` for `\\|` in code, where Python-Markdown would show the backslash."""
    return _CODE.sub(lambda code: code[0].replace("\\|", "|"), row[0])


def _title(path: Path, name: str) -> str:
    found = _TITLE.search(path.read_text(encoding="utf-8")) if path.suffix == ".md" and path.is_file() else None
    return found[1] if found else name


def _rewritten(target: str, source: Path, here: str) -> str:
    path = Path(os.path.normpath(source.parent / target))
    if not (path.is_file() and path.is_relative_to(ROOT)) and not _is_listed(path):
        return target  # MkDocs says that it is missing
    return os.path.relpath(_uri(path), Path(here).parent).replace(os.sep, "/")


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


def _source(uri: str) -> Path:
    """The file of the repository that a page of the site is made of; a notebook's folder is that of its page."""
    return ROOT / uri.removeprefix(OUTSIDE) if uri.startswith(OUTSIDE) else DOCS / uri

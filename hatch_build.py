"""What the build adds to the package: the tables of its grammars, and the README as an index shows it."""

from __future__ import annotations

import posixpath
import re
import sys
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface
from hatchling.metadata.plugin.interface import MetadataHookInterface

_LINK = re.compile(r"(!?)\[([^\]]*)\]\((?![a-z]+:|#)([^)\s#]+)(#[^)\s]*)?\)")
_FENCED = re.compile(r"(^```.*?^```$)", re.MULTILINE | re.DOTALL)
_TITLE = re.compile(r'^(```\w+) title="[^"]*"$', re.MULTILINE)


class TablesHook(BuildHookInterface[Any]):
    """Write the tables beside the grammars, where an editable installation reads them too."""

    PLUGIN_NAME = "custom"

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:  # noqa: ARG002 - hatchling's signature
        """Make the tables."""
        sys.path.insert(0, str(Path(self.root, "src")))
        from mudline.language.expression.parsing import MAKES  # noqa: PLC0415 - of this source, not of an installed one
        from mudline.language.syntax.grammars import save_tables  # noqa: PLC0415 - as above

        save_tables("deck")
        save_tables("blocks")
        save_tables("expression", MAKES)


class DescriptionHook(MetadataHookInterface):
    """Give the README to the index, which has none of the files that it links to."""

    PLUGIN_NAME = "custom"

    def update(self, metadata: dict[str, Any]) -> None:
        """Set the description; its links lead to the site that [project.urls] names."""
        text = Path(self.root, "README.md").read_text(encoding="utf-8")
        site = metadata.get("urls", {}).get("Documentation", "")
        metadata["readme"] = {"content-type": "text/markdown", "text": description(text, site)}


def description(readme: str, site: str) -> str:
    """Return the README with links to pages of a site; without one, the words of the links alone, and no pictures."""
    pieces = _FENCED.split(readme)
    pieces[::2] = [_LINK.sub(lambda link: _link(link, site), piece) for piece in pieces[::2]]
    return _TITLE.sub(r"\1", "".join(pieces))


def _link(link: re.Match[str], site: str) -> str:
    mark, words, target, place = link[1], link[2], link[3], link[4] or ""
    if not site:
        return "" if mark else words
    path = target.removeprefix("docs/") if target.startswith("docs/") else f"project/{target}"
    folder, name = posixpath.split(path)
    if name.endswith((".md", ".ipynb")):
        name = "index.html" if name == "README.md" else f"{posixpath.splitext(name)[0]}.html"
    return f"{mark}[{words}]({site.rstrip('/')}/{posixpath.join(folder, name)}{place})"

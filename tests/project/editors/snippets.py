"""The snippets of the extension for VS Code: the example of each keyword, as the language server completes it."""

from __future__ import annotations

import json

from mudline.language.keywords import catalogue
from mudline.tools.lsp.completion import snippet

SNIPPETS = "editors/vscode/snippets/mudline.json"


def snippets_text() -> str:
    """The whole file: of a keyword with different blocks in different sections, each with its section."""
    found: dict[str, dict[str, object]] = {}
    for keyword in catalogue.keywords():
        blocks = [block for block in catalogue.declarations(keyword) if block.example.startswith("*")]
        for block in blocks:
            name = f"*{keyword}" if len(blocks) == 1 else f"*{keyword} in ${block.sections[0]}"
            found[name] = {"prefix": f"*{keyword}", "body": snippet(block).split("\n"), "description": block.summary}
    return json.dumps(found, indent=1) + "\n"

"""The pages of docs/ that are made from the program. `make docs` writes them; a test holds them to it."""

from __future__ import annotations

from pathlib import Path

from mudline.lint.registry import rules
from tests.docs.keyword_page import keyword_page
from tests.docs.rule_pages import rule_index, rule_page

ROOT = Path(__file__).parents[2]

BY_HAND = frozenset({"DOC001", "DOC002", "DAT001", "RUN001"})
"""Codes that are no rules; their pages are written by hand."""


def pages() -> dict[str, str]:
    """The text of every page by its path in the repository."""
    fixed = {"docs/keywords.md": keyword_page(), "docs/rules/README.md": rule_index(rules())}
    return fixed | {f"docs/rules/{rule.code.code}.md": rule_page(rule) for rule in rules()}


def rule_files() -> set[str]:
    """The paths of the made pages of rules that are there."""
    there = (ROOT / "docs/rules").glob("*.md")
    return {page.relative_to(ROOT).as_posix() for page in there if page.stem not in BY_HAND}


def write() -> None:
    """Write the pages, and remove those that nothing makes any more."""
    wanted = pages()
    for path, text in wanted.items():
        file = ROOT / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8", newline="\n")
    for path in rule_files() - wanted.keys():
        (ROOT / path).unlink()


if __name__ == "__main__":
    write()

"""The pages of docs/ that are made from the program, and what commands print. `make docs` writes, a test holds them."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

from mudline.checks.registry import rules
from tests.docs.commands import output
from tests.docs.form_table import pages_with_laws, pages_with_tables
from tests.docs.keyword_index import keyword_index
from tests.docs.keyword_page import keyword_pages
from tests.docs.law_page import law_page
from tests.docs.layer_picture import layer_picture
from tests.docs.limits_page import limits_page
from tests.docs.refresh import copy_of_files, refreshed
from tests.docs.rule_pages import rule_index, rule_page
from tests.faults import report
from tests.faults.rates import run
from tests.project.editors.notepad import LANGUAGE, language_text
from tests.project.editors.snippets import SNIPPETS, snippets_text
from tests.project.editors.textmate import GRAMMAR, grammar_text

ROOT = Path(__file__).parents[2]

CONFIG_SCHEMA = "docs/schemas/config.json"

BY_HAND = frozenset({"DOC001", "DOC002", "DAT001", "EXP001", "MIG001", *(f"RUN00{n}" for n in range(1, 9))})
"""Codes that are no rules; their pages are written by hand."""


@cache
def pages() -> Mapping[str, str]:
    """The text of every page by its path in the repository; what it is made of does not change while this runs."""
    indexes = {"docs/keywords.md": keyword_index(), "docs/rules/README.md": rule_index(rules())}
    of_rules = {f"docs/rules/{rule.code.code}.md": rule_page(rule) for rule in rules()}
    single = {"docs/laws.md": law_page(), "docs/limits.md": limits_page(), "docs/architecture.svg": layer_picture()}
    return indexes | keyword_pages() | of_rules | single | pages_with_tables() | pages_with_laws()


def made_files() -> set[str]:
    """The paths of the made pages that are there: all of keywords, all of rules but those written by hand."""
    there = [page for folder in ("keywords", "rules") for page in (ROOT / "docs" / folder).glob("*.md")]
    return {page.relative_to(ROOT).as_posix() for page in there if page.stem not in BY_HAND}


def documents() -> list[Path]:
    """Every page of the project, also those written by hand."""
    return [
        *(ROOT / f"{name}.md" for name in ("README", "CHANGELOG", "CONTRIBUTING", "SECURITY")),
        *sorted(ROOT.glob("docs/**/*.md")),
    ]


def refresh() -> None:
    """Write anew what the commands on all pages print."""
    for page in documents():
        with TemporaryDirectory() as folder:  # a command may change the files that it is shown on
            copy_of_files(ROOT, Path(folder))
            os.chdir(folder)
            _refresh(page)
            os.chdir(ROOT)


def _refresh(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    by_hand: list[str] = []
    fresh = refreshed(text, by_hand)
    if fresh != text:
        page.write_text(fresh, encoding="utf-8", newline="\n")
    sys.stderr.writelines(f"{page}: cut the output by hand: {words}\n" for words in by_hand)


def write() -> None:
    """Write the pages and what editors use, and remove the pages that nothing makes any more."""
    wanted = pages()
    for path, text in wanted.items():
        file = ROOT / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8", newline="\n")
    made = {
        CONFIG_SCHEMA: output("mudline schema config"),
        GRAMMAR: grammar_text(),
        LANGUAGE: language_text(),
        SNIPPETS: snippets_text(),
    }
    for path, text in made.items():
        (ROOT / path).parent.mkdir(parents=True, exist_ok=True)
        (ROOT / path).write_text(text, encoding="utf-8", newline="\n")
    write_faults()
    for path in made_files() - wanted.keys():
        (ROOT / path).unlink()


def write_faults() -> None:
    """Write the page of how well faults are found."""
    report.write(run())


if __name__ == "__main__":
    write()
    refresh()

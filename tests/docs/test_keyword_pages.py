"""The pages of keywords: one each, with all its parts, and the rules that concern it."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import pytest

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import rules
from mudline.language.keywords import catalogue
from mudline.language.keywords.values import OpaqueKeyword
from tests.docs.blocks import Page
from tests.docs.keyword_index import keyword_index
from tests.docs.keyword_page import declarations, keyword_page, keyword_pages, page_name, title
from tests.docs.keyword_rules import Declared, keyword_of

DECLARED = declarations()


@pytest.fixture(scope="module")
def index() -> str:
    return keyword_index()


@pytest.mark.covered
def test_every_keyword_that_a_module_declares_has_a_page() -> None:
    assert set(map(keyword_of, DECLARED)) >= {
        keyword for keyword in catalogue.keywords() for section in catalogue.SECTIONS if known(section, keyword)
    }
    assert max(Counter(map(page_name, DECLARED)).values()) == 1
    assert len(keyword_pages()) == len(DECLARED)


def known(section: str, keyword: str) -> bool:
    return bool(catalogue.block_class(section, keyword) or catalogue.opaque_keyword(section, keyword))


@pytest.mark.covered
@pytest.mark.parametrize("declared", DECLARED, ids=title)
def test_page_has_all_its_parts(declared: Declared, index: str) -> None:
    page = Page(Path("page.md"), keyword_page(declared))
    headings = {"format", "example", "rules", "certain-and-inferred"} | (
        set() if isinstance(declared, OpaqueKeyword) else {"fields"}
    )
    assert headings <= page.anchors
    examples = [block.text for block in page.blocks]
    assert declared.example.rstrip("\n") + "\n" in examples
    assert f"](keywords/{page_name(declared)}.md) |" in index


@pytest.mark.parametrize("declared", DECLARED, ids=title)
def test_example_on_the_page_reads_without_a_finding(declared: Declared) -> None:
    text = f"${declared.sections[0]}\n{declared.example}"
    own = [rule for rule in rules() if rule.code.code.startswith("SYN")]
    assert [str(found) for found in lint_bytes(text.encode(), "deck.keyxm", own)] == []

"""Rows of one value wherever a block may have rows, and decks without nodes: findings, and no exception."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from mudline.checks.engine import LintSettings
from mudline.checks.fixing import lint_one
from mudline.checks.registry import rules
from mudline.checks.report import FileReport
from mudline.language.keywords import catalogue
from mudline.language.keywords.model import Block
from tests.helpers.builders.decks import CLEAN

NO_NODES = "$MODEL\n*ELEMENT\n 1, 1, 2\n*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=50000.0\n"
TRENCH = "*SEABED TRENCH\n SET=ALL\n GEOMETRY=0.5, 1.0, 3.0\n"


def linted(deck: str) -> FileReport:
    return lint_one("deck.keyxm", deck.encode(), LintSettings(rules()))


def cut(example: str) -> Iterator[str]:
    """Yield the example up to each of its lines, with a row of one value behind it."""
    lines = example.splitlines(keepends=True)
    for end in range(1, len(lines) + 1):
        yield "".join([*lines[:end], " 100\n"])


@pytest.mark.parametrize("declared", catalogue.block_classes())
def test_a_row_of_one_value_in_any_block(declared: type[Block]) -> None:
    for block in cut(declared.example):
        for deck in (CLEAN, NO_NODES):
            linted(deck + block)


@pytest.mark.parametrize("rows", ["PEAK=2000.0\n 100\n", "PEAK=TABLE\n 100\n 200\n"])
def test_a_short_row_of_a_trench_is_found_where_it_stands(rows: str) -> None:
    found = linted(f"$MODEL\n{TRENCH} {rows}").found
    assert ("SYN003", 6) in {(one.code, one.line) for one in found}


def test_a_lowered_trench_without_nodes() -> None:
    found = linted(f"{NO_NODES}{TRENCH} CENTRELINE=0, 0, 0, 10\n PEAK=2000.0\n LEVEL=LOWERED\n").found
    assert {one.code for one in found} == {"REF006"}

"""Deductions in the declarations of a deck's keywords: statements that no public page makes."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from mudline.language.deck.model import Deck, Opaque
from mudline.language.keywords.catalogue import opaque_keyword
from mudline.language.keywords.model import Part, record_schema
from mudline.language.keywords.table import Table


def inferences(deck: Deck) -> list[dict[str, Any]]:
    """Return each deduction once, with its keyword, its fields, and the number of blocks with these fields."""
    deductions: dict[tuple[str, str], tuple[list[str], int]] = {}
    for section in deck.own_sections:
        for block in section.blocks:
            touched: dict[str, list[str]] = {}
            for label, text in _of_block(section.name, block):
                labels = touched.setdefault(text, [])
                labels += [label] * (label not in labels)
            for text, labels in touched.items():
                known, count = deductions.get((block.keyword, text), ([], 0))
                deductions[block.keyword, text] = list(dict.fromkeys([*known, *labels])), count + 1
    return [
        {"keyword": keyword, "fields": [label for label in labels if label], "inferred": text, "blocks": count}
        for (keyword, text), (labels, count) in deductions.items()
    ]


def _of_block(section: str, block: Part | Opaque) -> Iterator[tuple[str, str]]:
    """Yield the name of each field with a deduction, and the deduction."""
    if isinstance(block, Opaque):
        kept = opaque_keyword(section, block.keyword)
        if kept is not None and kept.inferred:
            yield "", kept.inferred
        return
    for _, slot, value in block.walk():
        if slot.about.inferred:
            yield slot.label, slot.about.inferred
        if isinstance(value, Table):  # rows of a table are alike: its columns are enough
            columns = record_schema(slot.row).slots if slot.row else ()
            yield from ((column.label, column.about.inferred) for column in columns if column.about.inferred)

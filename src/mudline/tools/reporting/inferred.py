"""What no public page says of the keywords of a deck: the deductions of their declarations that touch it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from mudline.language.deck.model import Deck, Opaque
from mudline.language.keywords.catalogue import opaque_keyword
from mudline.language.keywords.model import Part, record_schema
from mudline.language.keywords.table import Table


def inferences(deck: Deck) -> list[dict[str, Any]]:
    """Each deduction once, with its keyword, the fields that it is about, and how many blocks have these."""
    found: dict[tuple[str, str], tuple[list[str], int]] = {}
    for section in deck.own_sections:
        for block in section.blocks:
            touched: dict[str, list[str]] = {}
            for label, text in _of_block(section.name, block):
                labels = touched.setdefault(text, [])
                labels += [label] * (label not in labels)
            for text, labels in touched.items():
                known, count = found.get((block.keyword, text), ([], 0))
                found[block.keyword, text] = list(dict.fromkeys([*known, *labels])), count + 1
    return [
        {"keyword": keyword, "fields": [one for one in labels if one], "inferred": text, "blocks": count}
        for (keyword, text), (labels, count) in found.items()
    ]


def _of_block(section: str, block: Part | Opaque) -> Iterator[tuple[str, str]]:
    """The name of each field with a deduction, and that."""
    if isinstance(block, Opaque):
        kept = opaque_keyword(section, block.keyword)
        if kept is not None and kept.inferred:
            yield "", kept.inferred
        return
    for _, slot, value in block.walk():
        if slot.about.inferred:
            yield slot.label, slot.about.inferred
        if isinstance(value, Table):  # rows of a table are alike: what its columns are is known without them
            columns = record_schema(slot.row).slots if slot.row else ()
            yield from ((one.label, one.about.inferred) for one in columns if one.about.inferred)

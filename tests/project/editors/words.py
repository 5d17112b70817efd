"""The words that editors colour, from the catalogue: sections, keywords, their settings and what these may be."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from mudline.language.keywords import catalogue
from mudline.language.keywords.model import Block, Part, record_schema


def words() -> dict[str, Any]:
    """Sections; known keywords; and of those whose lines are read the sections, and the choices of each setting."""
    read = {keyword: blocks for keyword in catalogue.keywords() if (blocks := catalogue.declarations(keyword))}
    return {
        "sections": sorted(catalogue.SECTIONS),
        "keywords": list(catalogue.keywords()),
        "read": {keyword: _words_of(blocks) for keyword, blocks in sorted(read.items())},
    }


def _words_of(blocks: list[type[Block]]) -> dict[str, Any]:
    """Of a keyword that means other things in other sections, what holds in any of them."""
    found: dict[str, list[str]] = {}
    for key, choices in (pair for block in blocks for pair in _each_setting(block)):
        found.setdefault(key, []).extend(choices)
    return {
        "sections": [section for block in blocks for section in block.sections],
        "slashes": any(block.slashes for block in blocks),
        "settings": {key: list(dict.fromkeys(choices)) for key, choices in sorted(found.items())},
    }


def _each_setting(part: type[Part]) -> Iterator[tuple[str, tuple[str, ...]]]:
    for slot in record_schema(part).slots:
        if slot.key:
            yield slot.key, slot.choices
        for record in slot.record.values():
            yield from _each_setting(record)

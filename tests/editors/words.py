"""The words that are coloured, from the catalogue: sections, keywords, their settings and what these may be."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

from mudline.keywords import catalogue
from mudline.keywords.model import Part, record_schema

WORDS = "src/mudline/highlighting/words.json"


def words() -> dict[str, Any]:
    """Sections; known keywords; and of those whose lines are read the sections, and the choices of each setting."""
    read = {keyword: block for keyword in catalogue.keywords() if (block := catalogue.declared(keyword))}
    return {
        "sections": sorted(catalogue.SECTIONS),
        "keywords": list(catalogue.keywords()),
        "read": {
            keyword: {
                "sections": list(block.sections),
                "slashes": block.slashes,
                "settings": {key: list(dict.fromkeys(choices)) for key, choices in sorted(_settings(block).items())},
            }
            for keyword, block in sorted(read.items())
        },
    }


def words_text() -> str:
    """The whole file."""
    return json.dumps(words(), indent=1) + "\n"


def _settings(part: type[Part]) -> dict[str, list[str]]:
    """The choices of every setting in the lines of a keyword."""
    found: dict[str, list[str]] = {}
    for key, choices in _each_setting(part):
        found.setdefault(key, []).extend(choices)
    return found


def _each_setting(part: type[Part]) -> Iterator[tuple[str, tuple[str, ...]]]:
    for slot in record_schema(part).slots:
        if slot.key:
            yield slot.key, slot.choices
        for record in slot.record.values():
            yield from _each_setting(record)

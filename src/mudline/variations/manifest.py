"""The list of the decks that were made, for programs."""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import Any

from mudline.variations.model import PlannedDeck

FORMAT = "mudline-expand/1"
MANIFEST = "manifest.json"
"""The file's name in the output folder."""


def manifest(source: str, decks: Iterable[PlannedDeck]) -> dict[str, Any]:
    """The list as plain values: the same for the same deck, whenever and wherever it is made."""
    return {
        "format": FORMAT,
        "source": source,
        "decks": [
            {
                "file": deck.path,
                "description": deck.description,
                "variations": list(deck.variations),
                "parameters": dict(deck.values),
            }
            for deck in decks
        ],
    }


def manifest_text(source: str, decks: Iterable[PlannedDeck]) -> str:
    """The list as JSON text."""
    return json.dumps(manifest(source, decks), indent=1, ensure_ascii=False) + "\n"

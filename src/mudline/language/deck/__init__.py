"""Decks as models: reading and writing keyword text, JSON and YAML."""

from __future__ import annotations

MARK = "mudline-deck/"
"""Beginning of the format name of a deck in JSON or YAML; a text without it is not a deck."""

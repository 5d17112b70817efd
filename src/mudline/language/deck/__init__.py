"""One file as models: reading and writing the keyword text, JSON and YAML."""

from __future__ import annotations

MARK = "mudline-deck/"
"""How the format of a deck in JSON or YAML begins; a text without it is not a deck."""

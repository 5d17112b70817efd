"""Names and numbers that one place of a deck uses and another one defines."""

from __future__ import annotations

from mudline.linting.rules.references import curves, lists, repeats, sets

__all__ = ["curves", "lists", "repeats", "sets"]

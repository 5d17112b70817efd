"""Names and numbers that one place of a deck uses and another one defines."""

from __future__ import annotations

from mudline.linting.rules.references import curves, files, lists, numbers, parameters, repeats, sets

__all__ = ["curves", "files", "lists", "numbers", "parameters", "repeats", "sets"]

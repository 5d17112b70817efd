"""Names and numbers that one place of a deck uses and another one defines."""

from __future__ import annotations

from mudline.linting.rules.references import curves, numbers, parameters, sets

__all__ = ["curves", "numbers", "parameters", "sets"]

"""Kinds of faults that the linter misses or buries, each with the reason; a test keeps the lists exact."""

from __future__ import annotations

MISSED: dict[str, str] = {}
"""Kinds of which at least one fault is missed."""

BURIED: dict[str, str] = {}
"""Kinds of which at least one fault is found and has more than one other finding beside it."""

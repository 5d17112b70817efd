"""How a deck is written: blanks, tabs, case, and lines that other programs may take for something else."""

from __future__ import annotations

from mudline.linting.rules.style import blanks, comments, exponents, heads

__all__ = ["blanks", "comments", "exponents", "heads"]

"""Where the grammar files are: inside an installed wheel, else in the checkout."""

from __future__ import annotations

from pathlib import Path


def grammar_file(name: str) -> Path:
    """Path of the grammar file `name`: the package's own copy first, the checkout's second."""
    packaged = Path(__file__).parent / "grammar" / name
    return packaged if packaged.exists() else Path(__file__).parents[2] / "grammar" / name

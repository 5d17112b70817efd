"""A copy of the checkout to build packages in: the build writes the tables of the grammars next to them."""

from __future__ import annotations

import shutil
from pathlib import Path

ROOT = Path(__file__).parents[2]
_LEFT_OUT = ("*cache*", ".git", ".venv", ".hypothesis", ".numba", ".bench", ".coverage*", "node_modules", "*.tables")


def copy_of_checkout(folder: Path) -> Path:
    """Copy the checkout into a folder; caches of other tests depend on the files of the original."""
    return shutil.copytree(ROOT, folder / "mudline", ignore=shutil.ignore_patterns(*_LEFT_OUT))

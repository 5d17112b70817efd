"""Packages of the checkout, built in a copy of it: a build writes the tables of the grammars next to them."""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from tests.helpers.processes import TIMEOUT

ROOT = Path(__file__).parents[2]
_LEFT_OUT = ("*cache*", ".git", ".venv", ".hypothesis", ".numba", ".bench", ".coverage*", "node_modules", "*.tables")


def build_packages(folder: Path) -> None:
    """Put the wheel and the source archive into a folder; caches of other tests depend on the files of the original."""
    with tempfile.TemporaryDirectory() as place:
        copy = shutil.copytree(ROOT, Path(place, "mudline"), ignore=shutil.ignore_patterns(*_LEFT_OUT))
        build(copy, folder)


def build(source: Path, folder: Path, *kinds: str) -> None:
    """Build the wheel and the source archive of a source, or one of them."""
    words = [sys.executable, "-m", "hatchling", "build", "-d", str(folder), *(f"-t{kind}" for kind in kinds)]
    subprocess.run(words, cwd=source, capture_output=True, timeout=TIMEOUT, check=True)

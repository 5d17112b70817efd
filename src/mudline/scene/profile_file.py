"""The points of a seabed profile from a text file: a point a line, fields parted by commas or blanks."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from mudline.keywords.text import shown
from mudline.scene.numbering import Floats
from mudline.syntax.rows import read_number
from mudline.syntax.source import Source

COMPILED = ".fcsbd"
LARGEST_FILE = 200_000_000
_PARTS = re.compile(r"[\s,]+")


class ProfileError(ValueError):
    """A file that holds no profile that can be read; the text says why."""


def read_profile(path: Path, columns: int) -> Floats:
    """The points (k, columns) in the order of the file; lines with C in column 1 are comments, blank ones count not.

    `columns` is 2 for Y and elevation of a profile, 3 for X, Y and Z of a surface. Raises OSError, or ProfileError for
    a compiled file and for the first line that is no point.
    """
    if path.suffix.lower() == COMPILED:
        raise ProfileError(
            f"a compiled profile ({COMPILED}) is binary and not public: it is kept; give a text file to have it read"
        )
    if path.stat().st_size > LARGEST_FILE:
        raise ProfileError(f"the file has more than {LARGEST_FILE // 10**6} million bytes: is it a profile?")
    return parse_profile(path.read_bytes(), path.name, columns)


def parse_profile(data: bytes, name: str, columns: int) -> Floats:
    """As `read_profile`, of a file's content."""
    source = Source.from_bytes(data, name)
    if not source.readable:
        raise ProfileError(source.problems[0].message)
    rows: list[list[float]] = []
    for number, line in enumerate(source.unified.split("\n"), 1):
        if line.strip() and not line.startswith("C"):
            rows.append(_point(line, columns, number))
    if len(rows) < 2:
        count = f"{len(rows)} point" + "s" * (len(rows) != 1)
        raise ProfileError(f"the file has {count}: a profile needs at least two lines `{_wanted(columns)}`")
    return np.array(rows, dtype=np.float64)


def _point(line: str, columns: int, number: int) -> list[float]:
    words = _PARTS.split(line.strip(" \t\r\n,"))
    if len(words) != columns:
        raise ProfileError(f"line {number}: expected {columns} numbers (`{_wanted(columns)}`), found {len(words)}")
    values: list[float] = []
    for word in words:
        value = read_number(word)
        if value is None:
            raise ProfileError(f"line {number}: {shown(word)} is no number")
        values.append(value)
    return values


def _wanted(columns: int) -> str:
    return "Y, elevation" if columns == 2 else "X, Y, Z"

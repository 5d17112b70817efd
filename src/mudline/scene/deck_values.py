"""Values that the parts of a deck give: numbers, files, legacy surfaces, units."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

from mudline.deck.model import Deck
from mudline.diagnostics import Where

if TYPE_CHECKING:
    from mudline.keywords.common import Surface


FOOT = 0.3048
POUND = 4.4482216152605

LENGTH_UNIT = {"metric": 1.0, "imperial": FOOT}
FORCE_UNIT = {"metric": 1.0, "imperial": POUND}

DEFAULT_DENSITY = {"metric": 1025.0, "imperial": 1025.0 * FOOT**4 / POUND}
DEFAULT_GRAVITY = {"metric": 9.81, "imperial": 9.81 / FOOT}
LARGEST_MOBILISATION = {"metric": 3.048, "imperial": 10.0}
"""Largest mobilisation length where none is given: 10 ft."""

LARGEST_FILE = 200_000_000
"""Bytes of a file that a deck names, at most."""

_LONGEST_NAME = 4096


def number(part: object, name: str, default: float = math.nan) -> float:
    """A value that is given and is a number, else `default`."""
    value = getattr(part, name, None)
    return float(value) if isinstance(value, float | int) else default


def surfaces(deck: Deck) -> list[tuple[Where, Surface]]:
    """The rigid surfaces of a deck, then the elastic ones, each in the order of the file; the last one holds."""
    found = deck.blocks_that(lambda declared: declared.facts.seabed_type)
    return sorted(found, key=lambda placed: placed[1].facts.seabed_type == "ELASTIC")


def file_name(written: str) -> str:
    """A file's name as a deck writes it, without quotes and with `/` between folders."""
    name = written.strip()
    if len(name) > 1 and name[0] == name[-1] == '"':
        name = name[1:-1]
    return name.replace("\\", "/")


def find_file(folder: Path | None, written: str) -> Path | None:
    """The regular file that a deck in `folder` names, or None when it is not there or may not be looked at.

    A name without a folder before it stands for a file beside the deck. A deck that came from no path (`folder` None)
    finds nothing.
    """
    name = file_name(written)
    if folder is None or not name or len(name) > _LONGEST_NAME or "\0" in name:
        return None
    path = folder / name
    try:
        return path if path.is_file() else None
    except OSError:
        return None

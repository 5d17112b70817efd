"""The forms of a deck, a module each: `write` makes a text of a deck, `read` a deck of the bytes of a file."""

from __future__ import annotations

from pathlib import PurePath
from pkgutil import iter_modules

KEYWORD = "keyword"
FORMS = tuple(sorted((found.name for found in iter_modules(__path__)), key=lambda name: (name != KEYWORD, name)))
"""The modules of this package, found without importing one; "keyword" is the first."""
_SUFFIXES = {f".{form}": form for form in FORMS if form != KEYWORD} | {".yml": "yaml"}


def form_of(name: str) -> str:
    """Return the form that the suffix of a file name means, which is its name, else "keyword"."""
    return _SUFFIXES.get(PurePath(name).suffix.lower(), KEYWORD)

"""The forms of a deck, a module each: `write` makes a text of a deck, `read` a deck of the bytes of a file."""

from __future__ import annotations

from functools import cache
from pkgutil import iter_modules

from mudline.basics.files import suffix_of

KEYWORD = "keyword"

SUFFIXES = (".keyxm", ".keyxi", ".keyx", ".das")
"""Suffixes of keyword text, in the order in which a name without a suffix is completed."""


@cache
def form_names() -> tuple[str, ...]:
    """Return the modules of this package, found without importing one; "keyword" is the first."""
    return tuple(sorted((found.name for found in iter_modules(__path__)), key=lambda name: (name != KEYWORD, name)))


def form_of(name: str) -> str:
    """Return the form that the suffix of a file name means, which is its name, else "keyword"."""
    end = name.rpartition(".")[2].lower()
    if end != "yml" and end not in form_names():  # asked for each of many decks
        return KEYWORD
    suffix = suffix_of(name)
    if suffix == "yml":
        return "yaml"
    return suffix if suffix in form_names() else KEYWORD

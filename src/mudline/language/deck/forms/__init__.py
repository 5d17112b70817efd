"""The forms of a deck, a module each: `write` makes a text of a deck, `read` a deck of the bytes of a file."""

from __future__ import annotations

import os
from functools import cache
from pkgutil import iter_modules

KEYWORD = "keyword"

SUFFIXES = (".keyxm", ".keyxi", ".keyx", ".das")
"""Suffixes of keyword text, in the order in which a name without a suffix is completed."""


@cache
def form_names() -> tuple[str, ...]:
    """Return the modules of this package, found without importing one; "keyword" is the first."""
    return tuple(sorted((found.name for found in iter_modules(__path__)), key=lambda name: (name != KEYWORD, name)))


def form_of(name: str) -> str:
    """Return the form that the suffix of a file name means, which is its name, else "keyword"."""
    suffix = os.path.splitext(name)[1].lower()  # noqa: PTH122 - called for many files
    form = "yaml" if suffix == ".yml" else suffix.removeprefix(".")
    return form if form in form_names() else KEYWORD

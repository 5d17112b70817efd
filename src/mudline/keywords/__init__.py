"""Classes of the keywords, such as `Ocean` of `*OCEAN`: `Deck.blocks` finds and `Deck.add` takes them.

`help(mudline.keywords.Ocean)` explains the fields, with units, ranges and defaults.
"""

from __future__ import annotations

from mudline.language.keywords import catalogue
from mudline.language.keywords.format import field_lines
from mudline.language.keywords.model import Block

_ENTRIES = {entry.name: entry for entry in catalogue.index() if not entry.kept}


def __getattr__(name: str) -> type[Block]:
    """Import the module of a class when the class is first used."""
    if name not in _ENTRIES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    declared: type[Block] = catalogue.load(_ENTRIES[name])
    globals()[name] = declared
    declared.__doc__ = "\n".join([f"*{_ENTRIES[name].keyword}: {declared.summary}", "", *field_lines(declared)])
    return declared


def __dir__() -> list[str]:
    return sorted(_ENTRIES)

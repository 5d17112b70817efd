"""The classes of the keywords, such as `Ocean` of `*OCEAN`: what `Deck.blocks` finds and `Deck.add` takes.

`help(mudline.keywords.Ocean)` says what the fields mean, with units, ranges and defaults.
"""

from __future__ import annotations

from mudline.language.keywords import catalogue
from mudline.language.keywords.format import field_lines
from mudline.language.keywords.index import ENTRIES
from mudline.language.keywords.model import Block

_ENTRIES = {entry.name: entry for entry in ENTRIES if not entry.kept}


def __getattr__(name: str) -> type[Block]:
    """A class, whose module is imported when it is first used."""
    if name not in _ENTRIES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    found = globals()[name] = catalogue.load(_ENTRIES[name])
    found.__doc__ = "\n".join([f"*{_ENTRIES[name].keyword}: {found.summary}", "", *field_lines(found)])
    return found


def __dir__() -> list[str]:
    return sorted(_ENTRIES)

"""Names of keywords that are not known: which known keyword one was to be, by its spelling and by its lines."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import NamedTuple

from mudline.language.diagnostics import Severity
from mudline.language.keywords import catalogue
from mudline.language.keywords.catalogue import suggest_keyword
from mudline.language.keywords.reader import read_block
from mudline.language.syntax.fields import first_key
from mudline.language.syntax.tree import Kind, RawBlock


@lru_cache(256)
def _suggested(keyword: str, section: str, but: tuple[str, ...]) -> str:
    """`suggest_keyword`, of keywords that stand in many decks, or in a deck that is read several times."""
    return suggest_keyword(keyword, section, None, but)


_TRIED = 4
"""Known names that an unknown one may have been, of which it is tried whether its lines read as theirs."""


class RawLines(NamedTuple):
    """The lines of a block whose keyword is not known, in the text where they stand."""

    text: str
    raw: RawBlock

    def meant(self, keyword: str, section: str) -> str:
        """The known keyword that one was to be: the nearest whose lines these may be; "" if there is none."""
        tried: tuple[str, ...] = ()
        while len(tried) < _TRIED and (near := _suggested(keyword, section, tried)):
            if self._may_be(near, section) or self._stands_apart(near):
                return near
            tried += (near,)
        return ""

    def _stands_apart(self, near: str) -> bool:
        """Whether the name is followed by words far behind it, as numbers of cards are, which all lines may have."""
        words = r"[ \t]+".join(map(re.escape, near.split(" ")))
        return (
            re.match(rf"\*[ \t]*{words}(?:[ \t]{{2,}}|\t)\S", self.text[slice(*self.raw.head.span)], re.IGNORECASE)
            is not None
        )

    def _may_be(self, near: str, section: str) -> bool:
        """Whether a keyword may stand in a section, and most of the lines read as its own."""
        elsewhere = section not in (catalogue.sections_of(near) or (section,))
        if elsewhere and section in catalogue.SECTIONS and section not in catalogue.CERTAIN_SECTIONS:
            return False
        declared = catalogue.declared(near, section)
        if declared is None:
            kept = [catalogue.load_opaque(entry) for entry in catalogue.entries(near)]
            keys = [key for one in kept for key in one.name_settings]
            return not keys or any(first_key(self.text, leaf.span) in keys for leaf in self.raw.leaves)
        found = read_block(
            self.text, RawBlock(self.raw.head, near, self.raw.leaves, self.raw.older), declared, last=False
        )
        start = self.raw.head.span.start
        places = (one.span.start for one in found.problems if one.span and one.weight is Severity.ERROR)
        faults = len({self.text.count("\n", start, place) for place in places})
        data = [leaf for leaf in self.raw.leaves if leaf.kind not in (Kind.BLANK, Kind.COMMENT)]
        lines = sum(self.text.count("\n", *leaf.span) or 1 for leaf in data)
        return not lines or 2 * max(faults, found.lost) < lines

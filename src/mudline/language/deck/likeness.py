"""Unknown keywords: the known keyword that was probably meant, by its spelling and by its lines."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import NamedTuple

from mudline.language.diagnostics import Severity
from mudline.language.keywords import catalogue
from mudline.language.keywords.catalogue import suggest_keyword
from mudline.language.keywords.reader import read_block
from mudline.language.syntax.fields import first_key
from mudline.language.syntax.tree import LeafKind, RawBlock


@lru_cache(256)
def _suggested(keyword: str, section: str, but: tuple[str, ...]) -> str:
    """Return `suggest_keyword`, cached for keywords of many decks, or of a deck that is read several times."""
    return suggest_keyword(keyword, section, None, but)


_TRIED = 4
"""Greatest number of similar known names whose lines are compared with those of an unknown name."""


class RawLines(NamedTuple):
    """Lines of a block with an unknown keyword, in the text where they stand."""

    text: str
    raw: RawBlock

    def meant(self, keyword: str, section: str) -> str:
        """Return the known keyword that was probably meant: the nearest whose lines these may be, or ""."""
        tried: tuple[str, ...] = ()
        while len(tried) < _TRIED and (near := _suggested(keyword, section, tried)):
            if self._may_be(near, section) or self._stands_apart(near):
                return near
            tried += (near,)
        return ""

    def _stands_apart(self, near: str) -> bool:
        """Return True if words follow far behind the name, like the numbers of cards; any line may have these."""
        words = r"[ \t]+".join(map(re.escape, near.split(" ")))
        return (
            re.match(rf"\*[ \t]*{words}(?:[ \t]{{2,}}|\t)\S", self.text[slice(*self.raw.head.span)], re.IGNORECASE)
            is not None
        )

    def _may_be(self, near: str, section: str) -> bool:
        """Return True if a keyword is allowed in a section, and most lines can be read as those of the keyword."""
        elsewhere = section not in (catalogue.sections_of(near) or (section,))
        if elsewhere and section in catalogue.SECTIONS and section not in catalogue.CERTAIN_SECTIONS:
            return False
        declared = catalogue.declared(near, section)
        if declared is None:
            kept = [catalogue.load_opaque(entry) for entry in catalogue.entries(near)]
            keys = [key for each in kept for key in each.name_settings]
            return not keys or any(first_key(self.text, leaf.span) in keys for leaf in self.raw.leaves)
        read = read_block(
            self.text, RawBlock(self.raw.head, near, self.raw.leaves, self.raw.older), declared, last=False
        )
        start = self.raw.head.span.start
        places = (each.span.start for each in read.problems if each.span and each.weight is Severity.ERROR)
        faults = len({self.text.count("\n", start, place) for place in places})
        data = [leaf for leaf in self.raw.leaves if leaf.kind not in (LeafKind.BLANK, LeafKind.COMMENT)]
        lines = sum(self.text.count("\n", *leaf.span) or 1 for leaf in data)
        return not lines or 2 * max(faults, read.lost) < lines

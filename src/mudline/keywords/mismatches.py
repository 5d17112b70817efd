"""Lines that stand where the grammar of their keyword has no place for them, in words."""

from __future__ import annotations

from bisect import bisect_left, insort
from collections.abc import Sequence

from mudline.codes import SYN001, SYN014
from mudline.diagnostics import Problem
from mudline.keywords.contents import Contents
from mudline.keywords.formats import lines_of
from mudline.keywords.grammar import Content, Mismatch
from mudline.keywords.model import Block
from mudline.keywords.text import shown
from mudline.syntax.fields import trimmed
from mudline.syntax.tree import RawBlock


class MismatchReport:
    """Tells of the mismatches of one block; `last`: nothing follows the block in the file."""

    def __init__(self, text: str, raw: RawBlock, declared: type[Block], contents: Contents, *, last: bool) -> None:
        self.text = text
        self.raw = raw
        self.declared = declared
        self.contents = contents
        self.last = last
        self.positions = [line.position for line in contents.lines]

    def tell(self, mismatches: Sequence[Mismatch]) -> None:
        """Tell of each, unless the line before it could not be read and may be what is missing."""
        for mismatch in mismatches:
            found = mismatch.found
            problem = self._misplaced(found, mismatch) if found else self._unfinished(mismatch)
            self.contents.findings.lose(None if self._excused(mismatch) else problem)

    def _unfinished(self, mismatch: Mismatch) -> Problem:
        code, what = (SYN014, "the file") if self.last else (SYN001, f"*{self.raw.name}")
        lines = self.contents.lines
        body = trimmed(self.text, *(lines[-1] if lines else self.raw.head).span)
        last_line = trimmed(self.text, self.text.rfind("\n", *body) + 1 or body.start, body.end)
        return Problem(code, f"{what} ends too early: expected {self._any_of(mismatch.expected)}", last_line)

    def _misplaced(self, found: Content, mismatch: Mismatch) -> Problem:
        span = trimmed(self.text, *found.span)
        if mismatch.missing:
            return Problem(SYN001, f"expected {self._any_of([mismatch.missing])} before this line", span)
        what = f"{found.key}=" if found.key else shown(self.text[slice(*span)])
        wanted = self._any_of(mismatch.expected) or "nothing more in this block"
        return Problem(SYN001, f"*{self.raw.name} has no place for {what} here: expected {wanted}", span)

    def _excused(self, mismatch: Mismatch) -> bool:
        """Whether a line that was dropped stands directly before; a line that is dropped now may excuse the next."""
        place = mismatch.found.position if mismatch.found else len(self.raw.leaves)
        index = bisect_left(self.positions, place)
        before = self.positions[index - 1] if index else -1
        dropped = self.contents.dropped
        if mismatch.found and not mismatch.missing:
            insort(dropped, place)
            return False
        return bisect_left(dropped, before) < bisect_left(dropped, place)

    def _any_of(self, terminals: Sequence[str]) -> str:
        return lines_of(self.declared, terminals)

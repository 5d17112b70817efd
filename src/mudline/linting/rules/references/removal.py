"""Taking curves out of the text."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable
from itertools import groupby

from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Repair, Span, Where
from mudline.keywords.reader import all_keys
from mudline.linting.suppression import MARK
from mudline.syntax.fields import first_key
from mudline.syntax.tree import Kind, Leaf


def removals(text: TextOrigin, unused: Iterable[Where]) -> dict[Where, Repair]:
    """For each curve of `*SEABED STIFFNESS` that is not used, its lines less; comments stay.

    The first curve of a block takes the whole block with it where none of its curves is used, unless a comment hides
    findings there: then it goes alone, as the others do.
    """
    found: dict[Where, Repair] = {}
    for block, places in groupby(sorted(unused), lambda where: where._replace(path=())):
        if (block.section, block.block) in text.read:  # not of a deck that this one continues
            found |= _of_block(text, block, list(places))
    return found


def _of_block(text: TextOrigin, block: Where, unused: list[Where]) -> dict[Where, Repair]:
    read = text.read[block.section, block.block]
    raw = text.tree.sections[block.section].blocks[block.block]
    source = text.source.unified
    length = len(unused[0].path)
    starts = {path: span.start for path, span in read.places.spans.items() if len(path) == length}
    lines = _by_curve(raw.leaves, source, all_keys(type(read.model)), sorted(starts.values()))
    found = {
        where: Repair("unsafe", "remove the curve", tuple((span, "") for span in lines[starts[where.path]]))
        for where in unused
    }
    if len(unused) == len(starts) and (len(starts) == 1 or not any(_hides(leaf, source) for leaf in raw.leaves)):
        spans = [raw.head.span, *(span for start in sorted(lines) for span in lines[start])]
        message = "remove the curve" if len(starts) == 1 else "remove the curves of this block"
        found[unused[0]] = Repair("unsafe", message, tuple((span, "") for span in spans))
    return found


def _by_curve(leaves: list[Leaf], source: str, keys: frozenset[str], starts: list[int]) -> dict[int, list[Span]]:
    """The lines of each curve without comments and blank lines; a curve is known by where it starts."""
    lines: dict[int, list[Span]] = {start: [] for start in starts}
    for leaf in leaves:
        at = bisect_right(starts, leaf.span.end - 1) - 1
        if at >= 0 and _counts(leaf, source, keys):
            lines[starts[at]].append(leaf.span)
    return lines


def _hides(leaf: Leaf, source: str) -> bool:
    return leaf.kind is Kind.COMMENT and MARK.match(source, *leaf.span) is not None


def _counts(leaf: Leaf, source: str, keys: frozenset[str]) -> bool:
    """Whether a line is part of the curve and not a comment."""
    if leaf.kind is Kind.UNDECIDED:
        return first_key(source, leaf.span) in keys
    return leaf.kind not in (Kind.COMMENT, Kind.BLANK)

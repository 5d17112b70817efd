"""Taking a curve out of the text."""

from __future__ import annotations

from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Repair, Where
from mudline.keywords.reader import all_keys
from mudline.syntax.fields import first_key
from mudline.syntax.tree import Kind, Leaf


def removal(text: TextOrigin, where: Where) -> Repair | None:
    """The lines of a curve of `*SEABED STIFFNESS` less, and its keyword if it has no other; comments stay."""
    read = text.read.get((where.section, where.block))
    if read is None:
        return None
    raw = text.tree.sections[where.section].blocks[where.block]
    starts = {path: span.start for path, span in read.places.spans.items() if len(path) == len(where.path)}
    first = starts[where.path]
    end = min((start for start in starts.values() if start > first), default=len(text.source.unified))
    lines = [leaf for leaf in raw.leaves if first < leaf.span.end <= end]
    keys = all_keys(type(read.model))
    gone = [leaf.span for leaf in lines if _counts(leaf, text.source.unified, keys)]
    if len(starts) == 1:
        gone.insert(0, raw.head.span)
    return Repair("unsafe", "remove the curve", tuple((span, "") for span in gone))


def _counts(leaf: Leaf, source: str, keys: frozenset[str]) -> bool:
    """Whether a line is part of the curve and not a comment."""
    if leaf.kind is Kind.UNDECIDED:
        return first_key(source, leaf.span) in keys
    return leaf.kind not in (Kind.COMMENT, Kind.BLANK)

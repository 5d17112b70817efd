"""Comments find their place among the items of a block."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from operator import attrgetter, itemgetter
from typing import NamedTuple

from mudline.diagnostics import Span
from mudline.keywords.builder import Built


class CommentLine(NamedTuple):
    """A comment: its position among the block's leaves, what follows the C, its place."""

    position: int
    text: str
    span: Span


def attach(comments: list[CommentLine], block: Built) -> list[str]:
    """Give each comment to the innermost record whose lines stand on both sides of it, before the item it precedes.

    Returns the texts of those behind the last line of the block: they belong to what follows it.
    """
    trailing: list[str] = []
    whole = _Places(block)
    owners: dict[int, Built] = {}
    for comment in comments:
        if block.last is not None and comment.position < block.last:
            places = whole.owner(comment.position)
            found = {"before": places.index(comment.position), "text": comment.text}
            places.record.values.setdefault("comments", []).append(found)
            owners[id(places.record)] = places.record
        else:
            trailing.append(comment.text)
    for owner in owners.values():  # a setting may be read in another place than it is written back to
        owner.values["comments"].sort(key=itemgetter("before"))
    return trailing


class _Places:
    """The places for comments in a record, in tables that are made once for all of its comments."""

    def __init__(self, record: Built) -> None:
        self.record = record
        self.within = sorted(
            (child for children in record.children.values() for child in children if child.last is not None),
            key=attrgetter("first"),
        )
        self.starts = [child.first for child in self.within]
        self.inner: dict[int, _Places] = {}
        self.items = sorted(record.items, key=attrgetter("position"))
        self.positions = [item.position for item in self.items]
        self.count, self.before = self._counts()

    def _counts(self) -> tuple[int, dict[tuple[int, int], int]]:
        """The number of items, and how many are written before those of an order and position."""
        before: dict[tuple[int, int], int] = {}
        count = 0
        for item in sorted(self.record.items, key=attrgetter("order", "position")):
            before.setdefault((item.order, item.position), count)
            count += item.count
        return count, before

    def owner(self, position: int) -> _Places:
        """Those of the innermost record that has lines on both sides of a position."""
        at = bisect_left(self.starts, position) - 1
        if at < 0:
            return self
        last = self.within[at].last
        if last is None or last <= position:
            return self
        if at not in self.inner:
            self.inner[at] = _Places(self.within[at])
        return self.inner[at].owner(position)

    def index(self, position: int) -> int:
        """Index, in the order in which the record is written, of the first item behind a position, or their number."""
        at = bisect_right(self.positions, position)
        if at == len(self.items):
            return self.count
        return self.before[self.items[at].order, self.items[at].position]

"""Comments find their place among the items of a block."""

from __future__ import annotations

from operator import itemgetter
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
    owners: list[Built] = []
    for comment in comments:
        if block.last is not None and comment.position < block.last:
            owner = block.owner(comment.position)
            before = owner.after(comment.position)
            index = owner.count if before is None else before
            owner.values.setdefault("comments", []).append({"before": index, "text": comment.text})
            owners.append(owner)
        else:
            trailing.append(comment.text)
    for owner in owners:  # a setting may stand in another place than it is written back to
        owner.values["comments"].sort(key=itemgetter("before"))
    return trailing

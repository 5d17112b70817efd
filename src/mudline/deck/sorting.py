"""Curves with their points in ascending order of ratio."""

from __future__ import annotations

import numpy as np

from mudline.deck.model import Deck
from mudline.keywords.model import Comment
from mudline.keywords.table import Table


def sort_curves(deck: Deck) -> list[str]:
    """Sort the points of every curve in place, comments before a point going with it.

    Returns the names of curves that were left as they are, because a ratio in them is an equation.
    """
    left: list[str] = []
    for _, block in deck.blocks_that(lambda declared: declared.facts.defines == "curves"):
        for curve in block.curves:
            if any(column == 0 for _, column in curve.points.words):
                left.append(getattr(curve, "name", None) or curve.set_name or "ALL")
                continue
            order = np.argsort(curve.points.values[:, 0], kind="stable")
            curve.comments = _moved(curve.comments, order.tolist())
            curve.points = _sorted(curve.points, order)
    return left


def _sorted(table: Table, order: np.ndarray[tuple[int], np.dtype[np.intp]]) -> Table:
    new_row = {old: new for new, old in enumerate(order.tolist())}
    words = {(new_row[row], column): word for (row, column), word in table.words.items()}
    return Table(table.values[order], table.lengths[order], words)


def _moved(comments: list[Comment], order: list[int]) -> list[Comment]:
    new_row = {old: new for new, old in enumerate(order)}
    moved = [comment.model_copy(update={"before": new_row.get(comment.before, len(order))}) for comment in comments]
    return sorted(moved, key=lambda comment: comment.before)

"""Lists of elements."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice
from typing import TYPE_CHECKING, cast

from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Code, Problem, Repair, Severity, Span, Where
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.scene.context import MOST_REPORTED

if TYPE_CHECKING:
    from mudline.keywords.library.element_sets import ElementSets, SetList

REF012 = Code("REF012", "long-list", Severity.WARNING)
LONGEST_LIST = 20


@rule(REF012)
def long_list(context: LintContext) -> Iterator[Problem]:
    """A line of a set lists more than 20 elements.

    The language allows 20 on a line. What stands behind them may be dropped when the deck is run, and those elements
    then lack the stiffness or the curve of their set without a word. Put the rest on lines of their own: lines of a set
    add up.

    Example:
         $MODEL
         *NODE
          1, 12.0, 0.0
          25, 12.0, 240.0
          GEN=1, 25
         *ELEMENT
          1, 1, 2
          GEN=1, 24
         *ELEMENT SETS
          SET=Coated Joints
        - 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 22, 24
        + 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20
        + 22, 24

    Finds: 11:73
    """
    for where, count in islice(_long(context), MOST_REPORTED):
        message = f"{count} elements on a line: the language allows {LONGEST_LIST}; put the rest on lines of their own"
        repair = _split(context.text, where, count) if context.text else None
        yield Problem(REF012, message, where=where._replace(path=(*where.path, LONGEST_LIST)), repair=repair)


def _long(context: LintContext) -> Iterator[tuple[Where, int]]:
    """Lists that are too long, and how many elements they have."""
    for where, block in context.deck.blocks("ELEMENT SETS"):
        for index, entry in enumerate(cast("ElementSets", block).sets):
            for number, member in enumerate(entry.members):
                count = len(cast("SetList", member).elements) if member.rule == "set_list" else 0
                if count > LONGEST_LIST:
                    yield where._replace(path=("sets", index, "members", number, "elements")), count


def _split(text: TextOrigin, where: Where, count: int) -> Repair | None:
    """A new line behind every 20 elements, indented as the line is; None where more than commas stands between them."""
    source = text.source.unified
    edits: list[tuple[Span, str]] = []
    line_break = _line_break(text.source.text, text.span(where))
    for following in range(LONGEST_LIST, count, LONGEST_LIST):
        places = [where._replace(path=(*where.path, at)) for at in (following - 1, following)]
        before, behind = (text.span(place) for place in places)
        if before is None or behind is None or not all(text.written(place) for place in places):
            return None
        between = source[before.end : behind.start]
        if between.strip(" \t") not in ("", ","):
            return None
        edits.append((Span(before.end, behind.start), line_break))
    return Repair("safe", f"put at most {LONGEST_LIST} elements on a line", tuple(edits))


def _line_break(text: str, line: Span | None) -> str:
    """A line end as the file has them, and the indentation of a line; at least a blank."""
    at = line.start if line else 0
    start = max(text.rfind("\n", 0, at), text.rfind("\r", 0, at)) + 1
    end = "\r\n" if "\r\n" in text else "\n" if "\n" in text else "\r" if "\r" in text else "\n"
    indentation = text[start:at]
    return end + (indentation or " ")

"""Element sets and their names."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, cast

from mudline.diagnostics import Code, Problem, Severity
from mudline.linting.context import LintContext
from mudline.linting.registry import rule

if TYPE_CHECKING:
    from mudline.keywords.library.element_sets import ElementSets

REF011 = Code("REF011", "long-name", Severity.WARNING)

LONGEST_NAME = 256


@rule(REF011)
def long_name(context: LintContext) -> Iterator[Problem]:
    """The name of a set has more than 256 characters.

    The language allows 256. A longer name may be cut when the deck is run, and names that differ only behind the cut
    would then be one set. Choose a shorter name.

    Example:
         $MODEL
         *NODE
          1, 12.0, 0.0
          2, 12.0, 10.0
         *ELEMENT
          1, 1, 2
         *ELEMENT SETS
        - SET=Eastern export flowline from the manifold to the platform between kilometre post 12.400 and kilometre\
 post 12.900 as surveyed before the trench was made and again after it was filled with the crossings of both cables\
 and the two mattresses that were laid on the eastern one in the second season
        + SET=Export KP 12.400 to 12.900
          1

    Finds: 8:6
    """
    for where, block in context.scene.deck.blocks("ELEMENT SETS"):
        for index, entry in enumerate(cast("ElementSets", block).sets):
            length = len(cast("str | None", entry.name) or "")
            if length > LONGEST_NAME:
                message = f"a set name of {length} characters: it must not be longer than {LONGEST_NAME}"
                yield Problem(REF011, message, where=where._replace(path=("sets", index, "name")))

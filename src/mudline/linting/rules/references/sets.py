"""Element sets and their names."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice
from typing import TYPE_CHECKING, cast

from mudline.codes import REF001, REF008, REF009, REF010
from mudline.diagnostics import Code, Problem, Severity
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.scene.context import MOST_TOLD
from mudline.variations.undefined import undefined_variations

if TYPE_CHECKING:
    from mudline.keywords.library.element_sets import ElementSets

REF011 = Code("REF011", "long-name", Severity.WARNING)

LONGEST_NAME = 256


@rule(REF001)
def undefined_set(context: LintContext) -> Iterator[Problem]:
    """A SET= names a set that the deck does not define.

    What stands below the SET= would reach no element: no stiffness, no diameter, no curve. Mostly the name is spelt
    differently in two places: case does not count in names, but blanks do. Define the set in *ELEMENT SETS, or correct
    the name. Where *LINES, which makes sets of its own, or the deck that *RESTART continues could define the set, this
    is a warning. Two more names are told here, as warnings too: a REPEAT= of *LINE PATH SECTIONS that names no group of
    *LINE SECTION GROUPS, and a LINE= there that *LINE PATHS does not name. And a VARIATIONS= of *COMBINATIONS that
    names no variation is an error, as no deck could be made.

    Bad:
        $MODEL
        *NODE
         1, -0.05, 0.0
         5, -0.05, 40.0
         GEN=1, 5
        *ELEMENT
         1, 1, 2
         GEN=1, 4
        *ELEMENT SETS
         SET=Touchdown
         GEN=1, 4
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=Touch Down
         STIFFNESS=50000.0

    Good:
        $MODEL
        *NODE
         1, -0.05, 0.0
         5, -0.05, 40.0
         GEN=1, 5
        *ELEMENT
         1, 1, 2
         GEN=1, 4
        *ELEMENT SETS
         SET=Touchdown
         GEN=1, 4
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=TOUCHDOWN
         STIFFNESS=50000.0

    Finds: 14:6
    """
    yield from context.told(REF001)
    yield from islice(undefined_variations(context.deck), MOST_TOLD)


@rule(REF008)
def subset_cycle(context: LintContext) -> Iterator[Problem]:
    """A SUBSET= leads back to its own set, or names no set.

    A set takes in all elements of its subsets. A set that is, through others, a subset of itself has no meaning, and a
    subset that does not exist leaves elements out. Remove one of the SUBSET= lines of the circle, or correct the name.

    Bad:
        $MODEL
        *NODE
         1, 12.0, 0.0
         2, 12.0, 10.0
        *ELEMENT
         1, 1, 2
        *ELEMENT SETS
         SET=Riser
         1
         SUBSET=Whole Line
         SET=Whole Line
         SUBSET=Riser

    Good:
        $MODEL
        *NODE
         1, 12.0, 0.0
         2, 12.0, 10.0
        *ELEMENT
         1, 1, 2
        *ELEMENT SETS
         SET=Riser
         1
         SET=Whole Line
         SUBSET=Riser

    Finds: 12:9
    """
    yield from context.told(REF008)


@rule(REF009)
def redefined_all(context: LintContext) -> Iterator[Problem]:
    """The predefined set ALL is defined again.

    ALL holds every element of the model, whatever else the deck says, so the lines below this SET= have no effect. Who
    reads the deck may believe that they have. Choose another name, or remove the lines.

    Bad:
        $MODEL
        *NODE
         1, 12.0, 0.0
         2, 12.0, 10.0
        *ELEMENT
         1, 1, 2
        *ELEMENT SETS
         SET=All
         1

    Good:
        $MODEL
        *NODE
         1, 12.0, 0.0
         2, 12.0, 10.0
        *ELEMENT
         1, 1, 2
        *ELEMENT SETS
         SET=Whole Line
         1

    Finds: 8:6
    """
    yield from context.told(REF009)


@rule(REF010)
def empty_set(context: LintContext) -> Iterator[Problem]:
    """A set has no element, or a GEN= generates nothing.

    Properties given to an empty set reach no element. A set without a line is a warning; a GEN= whose end comes before
    its start, whose increment does not lead to the end, or that would generate more than memory holds, is an error, as
    start and end may be exchanged or a digit wrong. Give the set its elements, or remove it.

    Bad:
        $MODEL
        *NODE
         1, 12.0, 0.0
         5, 12.0, 40.0
         GEN=1, 5
        *ELEMENT
         1, 1, 2
         GEN=1, 4
        *ELEMENT SETS
         SET=Upper
         GEN=4, 2

    Good:
        $MODEL
        *NODE
         1, 12.0, 0.0
         5, 12.0, 40.0
         GEN=1, 5
        *ELEMENT
         1, 1, 2
         GEN=1, 4
        *ELEMENT SETS
         SET=Upper
         GEN=2, 4

    Finds: 11:2
    """
    yield from context.told(REF010)


@rule(REF011)
def long_name(context: LintContext) -> Iterator[Problem]:
    """The name of a set has more than 256 characters.

    The language allows 256. A longer name may be cut when the deck is run, and names that differ only behind the cut
    would then be one set. Choose a shorter name.

    Bad:
        $MODEL
        *NODE
         1, 12.0, 0.0
         2, 12.0, 10.0
        *ELEMENT
         1, 1, 2
        *ELEMENT SETS
         SET=Eastern export flowline from the manifold to the platform between kilometre post 12.400 and kilometre post\
 12.900 as surveyed before the trench was made and again after it was filled with the crossings of both cables and the\
 two mattresses that were laid on the eastern one in the second season
         1

    Good:
        $MODEL
        *NODE
         1, 12.0, 0.0
         2, 12.0, 10.0
        *ELEMENT
         1, 1, 2
        *ELEMENT SETS
         SET=Export KP 12.400 to 12.900
         1

    Finds: 8:6
    """
    for where, block in context.scene.deck.blocks("ELEMENT SETS"):
        for index, entry in enumerate(cast("ElementSets", block).sets):
            length = len(cast("str | None", entry.name) or "")
            if length > LONGEST_NAME:
                message = f"a set name of {length} characters: it must not be longer than {LONGEST_NAME}"
                yield Problem(REF011, message, where=where._replace(path=("sets", index, "name")))

"""Nodes and elements by their numbers."""

from __future__ import annotations

from collections.abc import Iterator

from mudline.codes import REF005, REF006, REF007
from mudline.diagnostics import Problem
from mudline.linting.context import LintContext
from mudline.linting.registry import rule


@rule(REF005)
def undefined_element(context: LintContext) -> Iterator[Problem]:
    """A set or a GEN= uses an element that is not defined.

    The set is smaller than it was meant to be, so elements miss their stiffness, diameter or curve. This happens when a
    mesh is made coarser and the sets stay as they were. Correct the number, or define the element. A range of which
    only some elements exist is a warning.

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
         SET=Bend
         3, 4, 5

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
         SET=Bend
         3, 4

    Finds: 11:8
    """
    yield from context.told(REF005)


@rule(REF006)
def undefined_node(context: LintContext) -> Iterator[Problem]:
    """An element or a GEN= uses a node that is not defined.

    The element has no place and no length, and nothing can be said of its contact. Correct the number, or define the
    node. The same is told of nodes that *BOUNDARY holds, of which a range may lack some as a warning, and of NODE= in
    *P-Y and *T-Z. A node that only *LINES or the deck before a *RESTART can define is a warning, and so is a label that
    is spelt nearly as one that stands in *LINES or *LINE LOCATIONS.

    Bad:
        $MODEL
        *NODE
         1, 12.0, 0.0
         5, 12.0, 40.0
         GEN=1, 5
        *ELEMENT
         1, 1, 2
         GEN=1, 3
         4, 4, 6

    Good:
        $MODEL
        *NODE
         1, 12.0, 0.0
         5, 12.0, 40.0
         GEN=1, 5
        *ELEMENT
         1, 1, 2
         GEN=1, 3
         4, 4, 5

    Finds: 9:8
    """
    yield from context.told(REF006)


@rule(REF007)
def duplicate_id(context: LintContext) -> Iterator[Problem]:
    """A node or an element is defined twice.

    The later definition holds, and the earlier one is lost without a word: a line copied and half changed puts a kink
    into the pipe, or leaves an element out. Remove one of the two, or give it a number of its own.

    Bad:
        $MODEL
        *NODE
         1, 12.0, 0.0
         2, 12.0, 10.0
         3, 12.0, 20.0
         3, 12.0, 30.0

    Good:
        $MODEL
        *NODE
         1, 12.0, 0.0
         2, 12.0, 10.0
         3, 12.0, 20.0
         4, 12.0, 30.0

    Finds: 6:2
    """
    yield from context.told(REF007)

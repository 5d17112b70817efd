"""Names that are defined twice."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice
from typing import TYPE_CHECKING, cast

from mudline.deck.parameters import folded, list_items
from mudline.diagnostics import Code, Problem, Severity
from mudline.keywords.text import shown
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.scene.context import MOST_REPORTED
from mudline.scene.sets import ALL

if TYPE_CHECKING:
    from mudline.keywords.library.element_sets import ElementSets
    from mudline.keywords.library.parameters import Parameter

REF016 = Code("REF016", "repeated-set", Severity.WARNING)
REF017 = Code("REF017", "repeated-parameter", Severity.WARNING)


@rule(REF016)
def repeated_set(context: LintContext) -> Iterator[Problem]:
    """A set is defined twice: it holds the elements of both definitions.

    Who changes one of them believes that the set is changed, and the elements of the other one stay in it, with their
    stiffness and curve. Case does not count in names. Put the elements under one SET=, or choose another name.

    Example:
         $MODEL
         *NODE
          1, 12.0, 0.0
          5, 12.0, 40.0
          GEN=1, 5
         *ELEMENT
          1, 1, 2
          GEN=1, 4
         *ELEMENT SETS
          SET=Coated
        - 1, 2
        + 1, 2, 4
          SET=Bare
          3
        - SET=COATED
        - 4

    Finds: 14:6
    """
    yield from islice(_repeated_sets(context), MOST_REPORTED)


def _repeated_sets(context: LintContext) -> Iterator[Problem]:
    known = {ALL}
    for where, block in context.deck.blocks("ELEMENT SETS"):
        for index, entry in enumerate(cast("ElementSets", block).sets):
            name = cast("str | None", entry.name)
            if name is None:
                continue
            key = folded(name)
            if key in known and key != ALL:
                message = f"there is a set {shown(name)} already, and this one adds to it: put the elements into one"
                yield Problem(REF016, message, where=where._replace(path=("sets", index, "name")))
            known.add(key)


@rule(REF017)
def repeated_parameter(context: LintContext) -> Iterator[Problem]:
    """A parameter is defined twice: the later value holds everywhere.

    Also equations that stand before the second definition use its value, so the first one counts for nothing, though it
    is the one that a reader finds first. Items of a list have the name of the list in front, as in Soil_stiffness.
    Remove one of the two.

    Example:
         $PREPROCESSOR
         *PARAMETERS
        - depth, 850.0
        + depth, 910.0
          od, 0.3239
        - Depth, 910.0
         $MODEL
         *OCEAN
          =[depth], 1025.0, 9.81

    Finds: 5:2
    """
    known: set[str] = set()
    told = 0
    for where, block in context.deck.blocks("PARAMETERS", "PREPROCESSOR"):
        for index, parameter in enumerate(cast("list[Parameter]", block.parameters)):
            repeated: list[str] = []
            for name in _names(parameter):
                key = folded(name)
                if key in known:
                    repeated.append(name)
                known.add(key)
            if repeated and told < MOST_REPORTED:
                told += 1
                others = f" (and {len(repeated) - 1} more of this list)" if len(repeated) > 1 else ""
                message = (
                    f"parameter {shown(repeated[0])}{others} is defined a second time: this value holds; remove one"
                )
                yield Problem(REF017, message, where=where._replace(path=("parameters", index, "name")))


def _names(parameter: Parameter) -> list[str]:
    """The parameters that a line defines."""
    name, value = cast("str | None", parameter.name), cast("object", parameter.value)
    if name is None or value is None:
        return []
    if isinstance(value, str) and value.startswith("/"):
        return [item.name for item in list_items(name, value)[0]]
    return [name]

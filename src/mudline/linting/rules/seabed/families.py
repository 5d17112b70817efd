"""Families and dialects of keywords, and names that read as numbers."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from mudline.diagnostics import Code, Problem, Severity, Where
from mudline.keywords.catalogue import is_extension, is_superseded, supersedes
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.syntax.rows import read_number

SBD016 = Code("SBD016", "mixed-families", Severity.WARNING)
SBD017 = Code("SBD017", "curve-named-as-number", Severity.WARNING)
SBD018 = Code("SBD018", "extension-keyword", Severity.ERROR)


@rule(SBD016)
def mixed_families(context: LintContext) -> Iterator[Problem]:
    """The model has legacy and new seabed keywords.

    The manual does not say how the two add up, so the deck may mean something else to another version of the program.
    Here a block of *SEABED PROPERTIES that gives a stiffness holds over the legacy keywords (inferred). Keep one
    family.

    Example:
         $MODEL
        -*ELASTIC SURFACE
        - 50000.0, 0.3, 0.6
        +*SEABED PROPERTIES
        + TYPE=ELASTIC
        + SET=ALL
        + STIFFNESS=50000.0
        + FRICTION=0.3, 0.6
         *SEABED PROFILE
          TYPE=SLOPING
          SLOPE=2.0

    Finds: 4:1
    """
    legacy, new = _first(context, is_superseded), _first(context, supersedes)
    if not legacy or not new:
        return
    own = len(context.scene.deck.own_sections)
    where, keyword = max((place for place in (legacy, new) if place[0].section < own), default=legacy)
    other = (new if is_superseded(keyword) else legacy)[1]
    message = f"*{keyword} stands in one model with *{other}: their sum is not documented; keep one family of keywords"
    yield Problem(SBD016, message, where=where)


def _first(context: LintContext, fact: Callable[[str], bool]) -> tuple[Where, str] | None:
    deck = context.scene.deck
    names = filter(fact, deck.keywords())
    return min(((where, name) for name in names for where, _ in deck.blocks(name)), default=None)


@rule(SBD017)
def curve_named_as_number(context: LintContext) -> Iterator[Problem]:
    """The name of a curve reads as a number.

    STIFFNESS= takes a number or the name of a curve, and a number comes first: the elements get a linear stiffness of
    that value, and the curve is never used. Give the curve a name that begins with a letter.

    Example:
         $MODEL
         *SEABED STIFFNESS
        - CURVE=100
        + CURVE=Clay 100
          0.0, 0.0
          0.5, 4200.0
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
        - STIFFNESS=100
        + STIFFNESS=Clay 100

    Finds: 3:8
    """
    for curve in context.scene.laws.curves:
        if not curve.embedment and curve.named and read_number(curve.name) is not None:
            message = "the name of this curve reads as a number, and STIFFNESS= takes the number: choose another name"
            yield Problem(SBD017, message, where=curve.title)


@rule(SBD018)
def extension_keyword(context: LintContext) -> Iterator[Problem]:
    """An extension keyword stands in a deck for Flexcom.

    The keyword belongs to mudline alone: Flexcom does not know it and will not run the deck. It is found only where
    the deck is checked for that dialect. Remove it, or keep a copy of the deck for Flexcom.

    Example:
         $MODEL
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=50000.0
        -*SEABED SUCTION
        - SET=ALL
        - COHESION=5000.0
        + SUCTION=8000.0, 0.15

    Finds: 6:1
    Dialect: flexcom
    """
    if context.dialect != "flexcom":
        return
    for i, section in enumerate(context.deck.sections):
        for j, block in enumerate(section.blocks):
            if is_extension(block.keyword):
                message = f"*{block.keyword} is an extension that Flexcom does not know: remove it for that program"
                yield Problem(SBD018, message, where=Where(i, j))

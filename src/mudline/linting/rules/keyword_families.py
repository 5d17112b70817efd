"""Superseded keywords, decks that mix them with newer ones, and extension keywords in decks for Flexcom."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from mudline.diagnostics import Code, Problem, Repair, Severity, Where
from mudline.keywords.catalogue import is_extension, is_superseded, supersedes
from mudline.linting.rule import LintContext, rule
from mudline.syntax.edits import with_line_ends

LEG001 = Code("LEG001", "superseded-keyword", Severity.INFO)
SBD016 = Code("SBD016", "mixed-families", Severity.WARNING)
SBD018 = Code("SBD018", "extension-keyword", Severity.ERROR)


@rule(LEG001)
def superseded_keyword(context: LintContext) -> Iterator[Problem]:
    """The keyword is superseded by a newer one.

    It is still legal and keeps its meaning. The newer keywords can express more (profiles, friction by set), and new
    decks use them.

    Example:
         $MODEL
         *NODE
          1, 0.0, 0.0
          2, 0.0, 10.0
         *ELEMENT
          1, 1, 2
        -*ELASTIC SURFACE
        - 50000.0, 0.3, 0.5
        +*SEABED PROPERTIES
        + TYPE=ELASTIC
        + SET=ALL
        + STIFFNESS=50000.0
        + FRICTION=0.3, 0.5

    Finds: 7:1
    """
    if not context.superseded:
        return
    found = context.deck.blocks_that(lambda declared: declared.facts.superseded_by)
    for number, (where, block) in enumerate(found):
        newer = " and ".join(map(str, block.facts.superseded_by))
        message = f"*{block.keyword} is superseded by {newer}: `mudline migrate` rewrites the deck"
        yield Problem(LEG001, message, where=where, repair=None if number else _migration(context))


def _migration(context: LintContext) -> Repair | None:
    """What `mudline migrate` does, to all blocks at once; None where it refuses, or a second file is needed."""
    deck, text = context.deck, context.text
    if text is None or context.scene.errors():
        return None
    from mudline.migration.rewriting import refusals, rewrite, surfaces  # noqa: PLC0415 - few decks need it

    if any(refusals(deck)) or any(surface.profile is not None for _, surface in surfaces(deck)):
        return None
    edits = with_line_ends(text.source, rewrite(deck).edits)
    return Repair("unsafe", "write the newer keywords", tuple((edit.span, edit.text) for edit in edits))


@rule(SBD016)
def mixed_families(context: LintContext) -> Iterator[Problem]:
    """The model has legacy and new seabed keywords.

    The manual does not say how the two combine, so the deck may mean something else to another version of the program.
    Here a block of *SEABED PROPERTIES that gives a stiffness overrides the legacy keywords (inferred). Keep one family.

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
    legacy = _first(context, context.superseded)
    new = _first(context, filter(supersedes, context.keywords)) if legacy else None
    if not legacy or not new:
        return
    own = len(context.scene.deck.own_sections)
    where, keyword = max((place for place in (legacy, new) if place[0].section < own), default=legacy)
    other = (new if is_superseded(keyword) else legacy)[1]
    message = f"*{keyword} and *{other} are in one model, and how they combine is not documented: keep one family"
    yield Problem(SBD016, message, where=where)


def _first(context: LintContext, names: Iterable[str]) -> tuple[Where, str] | None:
    return min(((where, name) for name in names for where, _ in context.blocks(name)), default=None)


@rule(SBD018)
def extension_keyword(context: LintContext) -> Iterator[Problem]:
    """An extension keyword is used in a deck for Flexcom.

    The keyword belongs to mudline alone: Flexcom does not know it and will not run the deck. It is reported only where
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

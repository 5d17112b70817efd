"""Keywords as such: no section, keywords of other versions and programs or given twice, and decks of variations."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from mudline.basics.limits import LISTED
from mudline.checks.context import Found, Joined, LintContext, joint, of_variations
from mudline.checks.rules.model_parts import GEO006
from mudline.language.deck.parameters import name_key
from mudline.language.diagnostics import Blocks, Code, DeckError, Problem, Repair, Severity, Where
from mudline.language.keywords.catalogue import is_extension
from mudline.language.keywords.contents import is_name, is_read
from mudline.language.keywords.model import Block, FieldSpec, has_fields
from mudline.language.keywords.text import shown
from mudline.language.rules import rule
from mudline.language.syntax.edits import with_line_ends
from mudline.model.contact.input import LawKind
from mudline.model.scene.model import Scene
from mudline.model.scene.rules.seabed import SBD002

SYN019 = Code("SYN019", "no-section", Severity.ERROR)
LEG001 = Code("LEG001", "superseded-keyword", Severity.INFO)
REF022 = Code("REF022", "given-twice", Severity.WARNING)
SBD016 = Code("SBD016", "mixed-families", Severity.WARNING)
SBD018 = Code("SBD018", "extension-keyword", Severity.ERROR)
REF023 = Code("REF023", "cannot-expand", Severity.WARNING)


@rule(SYN019)
def no_section(context: LintContext) -> Iterator[Problem]:
    """The file has no section, so it is not a deck.

    An empty file is left by an interrupted copy or a full disk. A file of comments or text alone is a title whose deck
    is missing. Fetch the file again, or take it out of the folder of decks.

    Example:
         C Export riser, rev C
        +$MODEL
        +*OCEAN
        + 500.0, 1025.0, 9.81

    Finds: 1:1
    """
    deck = context.deck
    if deck.sections or any(problem.weight is Severity.ERROR for problem in deck.problems):
        return
    has = "has no $SECTION" if deck.comments or any(map(str.strip, deck.preamble)) else "is empty"
    yield Problem(SYN019, f"the file {has}: choose the file of a deck, or fetch it again")


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
    blocks = context.deck.blocks_with("superseded_by")
    for number, (where, block) in enumerate(place for place in blocks if place[1].subject == "seabed"):
        newer = " and ".join(map(str, block.facts.superseded_by))
        message = f"*{block.keyword} is superseded by {newer}: `mudline migrate` rewrites the deck"
        yield Problem(LEG001, message, where=where, repair=None if number else _migration(context))


def _migration(context: LintContext) -> Repair | None:
    """Return the repair of `mudline migrate` for all blocks at once; None if it refuses, or needs a second file.

    The folder is searched for decks that continue this deck only when repairs are made.
    """
    deck, text = context.deck, context.text
    if text is None or context.scene.errors():
        return None
    from mudline.editing.migration.refusals import (  # noqa: PLC0415 - few decks need it
        continuations_beside,
        refusals,
        surfaces,
    )
    from mudline.editing.migration.rewriting import MigrationRewriter, unused_definitions  # noqa: PLC0415 - as above

    continued_by, extended = continuations_beside(deck) if context.fixing else ([], False)
    profile = any(surface.profile is not None for _, surface in surfaces(deck))
    if profile or any(refusals(deck, context.scene, continued_by)):
        return None
    unused = unused_definitions(context.scene, extended=extended)
    edits = with_line_ends(text.source, MigrationRewriter(deck, unused).rewrite()[0])
    return Repair("unsafe", "write the newer keywords", tuple(edits))


@rule(SBD016)
def mixed_families(context: LintContext) -> Iterator[Problem]:
    """The model has legacy and new seabed keywords.

    The manual says that a non-linear curve is used if there is one. All else is inferred: of two curves, or of two
    numbers, that of the newer keywords is used. Another version of the program may read the deck otherwise. The message
    lists what each set gets, and the curves that no element gets. Keep one family.

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
    deck = context.scene.deck
    legacy, new = (
        min(
            ((where, block.keyword) for where, block in deck.blocks_with(fact) if block.subject == "seabed"),
            default=None,
        )
        for fact in ("superseded_by", "supersedes")
    )
    if not legacy or not new or context.problems_of(SBD002):
        return  # two types of seabed, of which one is removed: SBD002 reports them
    own = len(deck.own_sections)
    where, keyword = max((place for place in (legacy, new) if place[0].section < own), default=legacy)
    second = (new if keyword == legacy[1] else legacy)[1]
    message = f"*{keyword} and *{second} are in one model{_laws_by_set(context.scene)}: keep one family"
    yield Problem(SBD016, message, where=where)


def _laws_by_set(scene: Scene) -> str:
    """Return the law of each set in words, if both families give laws that are known: ` (SET=A gets curve clay)`."""
    laws = scene.laws
    if not scene.element_ids.size or laws.uncertain or len({set_law.family for set_law in laws.set_laws}) < 2:
        return ", and how they combine is partly inferred"
    used = np.unique(laws.of_element).tolist()
    parts = [
        f"SET={shown(laws.set_laws[index].set_.name)} gets {_called(scene, index)}" for index in used if index >= 0
    ]
    idle = [
        _called(scene, index)
        for index, set_law in enumerate(laws.set_laws)
        if set_law.kind is LawKind.CURVE and index not in used
    ]
    parts += [f"no element gets {name}" for name in idle]
    more = f", {len(parts) - LISTED} more" if len(parts) > LISTED else ""
    return f" (partly inferred: {', '.join(parts[:LISTED])}{more})"


def _called(scene: Scene, index: int) -> str:
    """Return the name of a set's law for a reader: `curve clay`, `stiffness 500`, `a rigid seabed`."""
    set_law = scene.laws.set_laws[index]
    match set_law.kind:
        case LawKind.CURVE if set_law.family == "legacy":
            return f"the curve of *EMBEDMENT for SET={shown(set_law.set_.name)}"
        case LawKind.CURVE:
            return f"curve {shown(scene.laws.curves[set_law.curve].name)}" if set_law.curve >= 0 else "an unknown curve"
        case LawKind.LINEAR:
            return f"stiffness {set_law.stiffness:.10g}"
        case LawKind.RIGID:
            return "a rigid seabed"
    return "no stiffness"


@rule(SBD018)
def extension_keyword(context: LintContext) -> Iterator[Problem]:
    """An extension keyword is used in a deck for Flexcom.

    The keyword belongs to mudline alone: Flexcom does not know it and will not run the deck. It is reported only where
    the deck is checked for that dialect. Remove it, or keep a copy of the deck for Flexcom.

    Example on seabed:
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
    for where, _, block in context.deck.every_block():
        if is_extension(block.keyword):
            message = f"*{block.keyword} is an extension that Flexcom does not know: remove it for that program"
            yield Problem(SBD018, message, where=where)


@rule(REF022)
def given_twice(context: LintContext) -> Iterator[Problem]:
    """A keyword that may be given once is given twice, or two records have the same set, vessel or heading.

    So are two records with the same frequency or depth. A run takes one of the two, and a change of the unused one has
    no effect. Mostly a copied block kept its first name. Of two sections or coefficients of a set the later one is
    used; for the others this is not documented. Remove one of them, or correct its name. Sets, curves, nodes, elements
    and seabed laws have their own rules.

    Example:
         $MODEL
         *OCEAN
          500.0, 1025.0, 9.81
        -*OCEAN
        - 450.0, 1025.0, 9.81

    Finds: 4:1
    """
    for i, section in enumerate(context.scene.deck.own_sections):
        seen: set[object] = set()
        for j, block in enumerate(section.blocks):
            if not isinstance(block, Block):
                continue
            if block.facts.once and block.keyword in seen and is_read(block):
                message = f"*{block.keyword} already stands in this ${section.name}: remove one of the two"
                yield Problem(REF022, message, where=Where(i, j))
            seen.add(block.keyword)
            for path, slot, value in block.walk(_is_unique) if has_fields(type(block), _is_unique) else ():
                known = is_name(value) or (isinstance(value, int | float) and math.isfinite(value))
                # The list of a block may go on in the next one, a list in a record may not.
                of_list = path[:-2] if len(path) <= len(("records", 0, "field")) else (j, *path[:-2])
                key = (block.keyword, *of_list, slot.name, name_key(str(value)))
                if known and value != "" and key in seen:
                    yield Problem(REF022, _words(slot, value, block), where=Where(i, j, path))
                seen.add(key)


def _is_unique(slot: FieldSpec) -> bool:
    return slot.about.unique


def _words(slot: FieldSpec, value: object, block: Block) -> str:
    held = "the later one holds" if block.facts.later_wins else "which of them holds is not documented"
    words = shown(value) if isinstance(value, str) else f"{value:g}"
    label = f"{slot.key}={words}" if slot.key else f"{slot.label} {words}"
    return f"{label} is already given in *{block.keyword}, and {held}: remove one of the two, or correct it"


@joint(GEO006)
def said_of_the_section(_: LintContext, found: Found) -> Iterator[Joined]:
    """Join a repeated section of a set to the finding that another set has none."""
    for problem in found[GEO006.code]:
        same = [repeat for repeat in found.get(REF022.code, ()) if repeat.where == problem.where]
        if same:
            yield Joined(problem, same)


# ----------------------------------------------------------------------------------------------------------- variations


@rule(REF023)
def cannot_expand(context: LintContext) -> Iterator[Problem]:
    """The decks that *VARIATION and *COMBINATIONS describe cannot be written.

    Parameters of one variation have different numbers of values, two decks would have one name, or a file cannot be
    added: `mudline expand` refuses the deck. Misspelt names of parameters, variations and keywords have their own
    rules. If one of them reports the deck, or the deck has errors, this rule reports nothing.

    Example:
         $PREPROCESSOR
         *PARAMETERS
          Offset, 0.0
          Period, 8.0
         *VARIATION
          NAME=Sea
          PARA=Offset, VALUE=-10.0, 0.0, 10.0
        - PARA=Period, VALUE=8.0, 10.0
        + PARA=Period, VALUE=8.0, 10.0, 12.0
         *COMBINATIONS
          DIRECTORY=Runs
          DESCRIPTION=All, FILENAME=T%Period%

    Finds: 6:2
    """
    named = context.written("COMBINATIONS", "PREPROCESSOR")
    faulty = any(problem.code.severity is Severity.ERROR for problem in context.deck.problems)
    if not named or faulty or any(True for _ in of_variations(context.deck)):
        return
    from mudline.editing.variations.planning import plan_faults  # noqa: PLC0415 - few decks have combinations

    try:
        faults = plan_faults(context.deck)
    except DeckError:  # reported elsewhere
        return
    for problem in {problem.where: problem for problem in reversed(faults)}.values():  # the first of a place
        yield replace(problem, code=REF023, blocks=Blocks.NEVER)

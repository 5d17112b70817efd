"""Names that are defined in one place and used in another: element sets, parameters, vessels, the water."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING, cast

from mudline.checks.context import LintContext, entries_of_sets
from mudline.checks.rules.style_lines import line_around
from mudline.language.deck.model import Deck
from mudline.language.deck.parameters import folded, list_items
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import Code, Problem, Repair, Severity, Span, Where
from mudline.language.keywords.text import shown
from mudline.language.keywords.unknown import is_unknown, known_name
from mudline.language.rules import rule
from mudline.language.syntax.edits import TextEdit, with_line_ends
from mudline.model.scene.references import THINGS, repeated
from mudline.model.scene.sets import ALL, LONGEST_NAME

if TYPE_CHECKING:
    from mudline.language.keywords.library.mesh import ElementSet, SetList
    from mudline.language.keywords.library.preprocessor import Parameter

REF011 = Code("REF011", "long-name", Severity.WARNING)
REF012 = Code("REF012", "long-list", Severity.WARNING)
REF016 = Code("REF016", "repeated-set", Severity.WARNING)
REF017 = Code("REF017", "repeated-parameter", Severity.WARNING)
REF018 = Code("REF018", "missing-ocean", Severity.WARNING)
REF020 = Code("REF020", "repeated-name", Severity.WARNING)

LONGEST_LIST = 20


@rule(REF011)
def long_name(context: LintContext) -> Iterator[Problem]:
    """The name of a set has more than 256 characters.

    The language allows 256. A longer name may be cut when the deck is run, and names that differ only after the cut
    would then be one set. Choose a shorter name.

    Example on sets:
        - SET=Eastern export flowline from the manifold to the platform between kilometre post 12.400 and kilometre\
 post 12.900 as surveyed before the trench was made and again after it was filled with the crossings of both cables\
 and the two mattresses that were laid on the eastern one in the second season
        + SET=Flowline

    Finds: 12:6
    """
    for where, entry in entries_of_sets(context.blocks("ELEMENT SETS")):
        length = len(cast("str | None", entry.name) or "")
        if length > LONGEST_NAME:
            message = f"a set name of {length} characters: it must not be longer than {LONGEST_NAME}"
            yield Problem(REF011, message, where=where.inside("name"))


@rule(REF012)
def long_list(context: LintContext) -> Iterator[Problem]:
    """A line of a set lists more than 20 elements.

    The language allows 20 on a line. Further elements may be dropped without a warning when the deck is run, and then
    lack the stiffness or the curve of their set. Put the rest on lines of their own: lines of a set add up.

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
    for where, entry in entries_of_sets(context.written("ELEMENT SETS")):
        for number, member in enumerate(entry.members):
            count = len(cast("SetList", member).elements) if member.rule == "set_list" else 0
            if count > LONGEST_LIST:
                place = where.inside("members", number, "elements")
                message = (
                    f"{count} elements on a line: the language allows {LONGEST_LIST}; put the rest on lines of their "
                    "own"
                )
                repair = _split(context.text, place, count) if context.text else None
                yield Problem(REF012, message, where=place.inside(LONGEST_LIST), repair=repair)


def _split(text: TextOrigin, where: Where, count: int) -> Repair | None:
    """Return a repair that breaks a line after every 20 elements; None if anything but commas is between them.

    New lines are indented as the line is.
    """
    source, line = text.source.unified, text.span(where)
    indentation = source[line_around(source, line.start).start : line.start] if line else ""
    edits: list[TextEdit] = []
    for following in range(LONGEST_LIST, count, LONGEST_LIST):
        places = [where.inside(at) for at in (following - 1, following)]
        before, behind = (text.span(place) for place in places)
        if before is None or behind is None or not all(text.written(place) for place in places):
            return None
        between = Span(before.end, behind.start)
        if source[slice(*between)].strip(" \t") not in ("", ","):
            return None
        edits.append(TextEdit(between, f"\n{indentation or ' '}"))
    ended = with_line_ends(text.source, edits)
    return Repair("safe", f"put at most {LONGEST_LIST} elements on a line", tuple((it.span, it.text) for it in ended))


@rule(REF016)
def repeated_set(context: LintContext) -> Iterator[Problem]:
    """A set is defined twice: it holds the elements of both definitions.

    A change of one definition does not remove the elements of the other one from the set. They keep its stiffness and
    curve. Names are case-insensitive. It is an info if the numbers of both lie apart, so that they add up. Put the
    elements under one SET=, or choose another name.

    Example on sets:
          1, 2
        + 3
          SET=Flowline
          GEN=3, 4
        - SET=RISER
        - 3

    Finds: 14:6
    """
    known: dict[str, list[tuple[int, int]]] = {}
    for where, entry in entries_of_sets(context.written("ELEMENT SETS")):
        name = known_name(entry.name)
        if name is None or (key := folded(name)) == ALL:
            continue
        own = [*_spans(entry)]
        if key in known:
            message = f"set {shown(name)} is already defined, and this adds to it: put its elements under one SET="
            apart = own and all(last < low or high < first for low, high in own for first, last in known[key])
            yield Problem(REF016, message, None, Severity.INFO if apart else None, where.inside("name"))
        known.setdefault(key, []).extend(own)


def _spans(entry: ElementSet) -> Iterator[tuple[int, int]]:
    """Yield the lowest and the highest number of each line of a set that has only numbers."""
    for member in entry.members:
        span = getattr(member, "generate", None)
        numbers = getattr(member, "elements", None) or ([span.start, span.end] if span else [])
        whole = [number for number in numbers if isinstance(number, int)]
        if whole:
            yield min(whole), max(whole)


@rule(REF020)
def repeated_name(context: LintContext) -> Iterator[Problem]:
    """Two vessels, or two other objects of one kind, have the same name.

    The language does not say which of them the name then refers to. Names are case-insensitive. Choose another name, or
    keep one of them. Sets and curves have their own rules.

    Example:
         $MODEL
         *VESSEL
          VESSEL=FPSO
          INITIAL POSITION=1005.0, 0.0, 0.0
        - VESSEL=fpso
        + VESSEL=Tanker
          INITIAL POSITION=1005.0, 250.0, 0.0

    Finds: 5:9
    """
    return repeated(context.scene.context, THINGS, REF020)


@rule(REF017)
def repeated_parameter(context: LintContext) -> Iterator[Problem]:
    """A parameter is defined twice: the later value applies everywhere.

    Equations before the second definition use its value too. A reader finds the first definition first, but it is
    overridden. Items of a list have the name of the list in front, as in Soil_stiffness. Remove one of the two.

    Example on parameters:
        - Depth, 910.0
          depth, 850.0

    Finds: 4:2
    """
    known: set[str] = set()
    for where, block in context.written("PARAMETERS", "PREPROCESSOR"):
        for index, parameter in enumerate(cast("list[Parameter]", block.parameters)):
            repeated: list[str] = []
            for name in _names(parameter):
                key = folded(name)
                if key in known:
                    repeated.append(name)
                known.add(key)
            if repeated:
                others = f" (and {len(repeated) - 1} more of this list)" if len(repeated) > 1 else ""
                message = (
                    f"parameter {shown(repeated[0])}{others} is defined twice, and this value overrides the earlier "
                    "one: remove one of them"
                )
                yield Problem(REF017, message, where=where.inside("parameters", index, "name"))


def _names(parameter: Parameter) -> list[str]:
    """Return the parameters that a line defines."""
    name, value = parameter.name, parameter.value
    if is_unknown(name) or is_unknown(value):
        return []
    if isinstance(value, str) and value.startswith("/"):
        return [item.name for item in list_items(name, value)[0]]
    return [name]


_WATER = re.compile(r"CURRENT|WAVE(?:-.*)?")


def in_water(deck: Deck) -> Iterator[tuple[Where, str]]:
    """Yield place and keyword of all waves and currents of load cases, read or not."""
    for i, section in enumerate(deck.sections):
        for j, block in enumerate(section.blocks if section.name == "LOAD CASE" else ()):
            if _WATER.fullmatch(block.keyword):
                yield Where(i, j), block.keyword


@rule(REF018)
def missing_ocean(context: LintContext) -> Iterator[Problem]:
    """A load case has waves or a current, and the model has no *OCEAN.

    Their velocities depend on the depth of the water, which *OCEAN gives in the model, with its density; the depth has
    no default. Give *OCEAN, or remove the waves and currents of a model in air. A deck with *RESTART takes the water
    from the deck that it continues.

    Example on held:
         $MODEL
        +*OCEAN
        + 500.0, 1025.0, 9.81

          GEN=1, 2
        |*HYDRODYNAMIC SETS
        | SET=ALL, TYPE=CONSTANT
        | 1.0

          3, 1
        |*WAVE-REGULAR
        | 3.0, 11.0, 180.0

    Finds: 17:1
    """
    scene = context.scene
    if "OCEAN" in context.keywords or not scene.element_ids.size or scene.context.possible_definition("OCEAN"):
        return
    for where, keyword in in_water(context.deck):
        if where.section < len(context.deck.own_sections):
            yield Problem(REF018, f"*{keyword} needs the depth of the water: give *OCEAN in $MODEL", where=where)
            return

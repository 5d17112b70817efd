"""Checks of names, labels and numbers in fields against those that the deck defines."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Sequence
from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple, cast

import numpy as np

from mudline.basics.limits import MOST_REPORTED
from mudline.language.codes.fields import SYN003
from mudline.language.codes.lines import SYN001, SYN005
from mudline.language.codes.references import REF001, REF005, REF006, REF010
from mudline.language.deck.model import Deck, Opaque, raw_lines
from mudline.language.deck.parameters import EvaluatedDeck, bare, folded, name_key
from mudline.language.diagnostics import Blocks, Code, Problem, Severity, Where
from mudline.language.keywords import catalogue
from mudline.language.keywords.contents import idents_given, is_read, kinds_of, names_given
from mudline.language.keywords.model import Block
from mudline.language.keywords.table import LARGEST_WHOLE
from mudline.language.keywords.text import shown
from mudline.language.keywords.values import Label, Names
from mudline.language.syntax.fields import canonical_key
from mudline.model.scene.context import Context
from mudline.model.scene.numbering import Indices, Numbered
from mudline.model.scene.sets import Sets

if TYPE_CHECKING:
    from mudline.language.keywords.library.attachments import DragChains
    from mudline.language.keywords.library.lines import LinePathSections, LineSectionGroups
    from mudline.language.keywords.library.loads import Boundary, FixedValues


CURVES = frozenset(
    {
        *(Names.MOMENT_CURVATURE, Names.FORCE_STRAIN, Names.TORQUE_TWIST, Names.STRESS_STRAIN),
        *(Names.DAMPER, Names.DRAG_LIFT, Names.PIP_STIFFNESS, Names.S_N_CURVE, Names.HARDENING),
    }
)
"""Kinds of curves except those of a seabed."""
THINGS = frozenset(
    {
        *(Names.VESSEL, Names.BODY, Names.AUXILIARY, Names.CABLE, Names.LINE, Names.SECTION_GROUP),
        *(Names.VECTOR, Names.AXIS, Names.GUIDE),
    }
)
"""Kinds of named objects that are not curves."""


def undefined(context: Context, kinds: Collection[Names], code: Code) -> Iterator[Problem]:
    """Yield names that are not defined; a warning if that is not certain, because not all was read."""
    for names in context.names_of(kinds):
        if not names.used or not (definers := catalogue.definers(names.kind)) or not context.deck.keywords():
            continue
        known = names.known
        doubt = _doubt(context, definers)
        advice = f"define it in {' or '.join(f'*{keyword}' for keyword in definers)}, or correct the name"
        for use in names.used:
            if name_key(use.name) in known or not use.name:
                continue
            message = f"{names.thing} {shown(use.name)} is not defined{context.hint(use.name, known)}: {advice}"
            severity = Severity.WARNING if doubt else None
            yield Problem(code, message + doubt, None, severity, use.where, blocks=Blocks.NEVER, lacks=use.name)


def _doubt(context: Context, definers: Collection[str]) -> str:
    """Return in words the unread line that may define an object; "" if there is none."""
    for where, _, block in context.deck.every_block():
        unsure = block.keyword in definers and (isinstance(block, Opaque) or not is_read(block))
        if unsure or (block.keyword in definers and context.deck.lost(where)):
            return f"; a line of *{block.keyword} that was not read may define it"
    words = (context.possible_definition(keyword) for keyword in definers)
    return next((f"; {definition}" for definition in words if definition), "")


def repeated(context: Context, kinds: Collection[Names], code: Code) -> Iterator[Problem]:
    """Yield names that are defined a second time."""
    for names in context.names_of(kinds):
        for definitions in names.defined.values():
            for later in definitions[1:]:
                message = (
                    f"{names.thing} {shown(later.name)} is already defined: choose another name, or keep one of them"
                )
                yield Problem(code, message, where=later.where)


def unused(context: Context, kinds: Collection[Names], code: Code) -> Iterator[Problem]:
    """Yield names that are not used: an info if the keywords that would use them are not read, or not in the deck."""
    raw = ""
    for names in context.names_of(kinds):
        used = {name_key(use.name) for use in names.used}
        users = catalogue.users(names.kind)
        for key, (first, *_) in names.defined.items():
            if key in used:
                continue
            if not raw:
                unread = (line for _, _, block in context.deck.every_block() for line in raw_lines(block))
                raw = "\n".join(map(folded, unread)) or "\n"
            if key in raw:
                continue
            by = f"name it in {' or '.join(f'*{keyword}' for keyword in users)}, or remove it" if users else "remove it"
            severity = None if users else Severity.INFO
            yield Problem(code, f"{names.thing} {shown(first.name)} is not used: {by}", None, severity, first.where)


def check_references(context: Context, sets: Sets, *, with_soil: bool) -> None:
    """Report undefined names of sets; those in soil springs only with `with_soil`.

    Postprocessing may have its own sets in addition to those of the model.
    """
    own: dict[str, str] | None = None
    for name, where in ((use.name, use.where) for use in context.names[Names.SET].used):
        section = context.deck.sections[where.section]
        if not with_soil and cast("Block", section.blocks[where.block]).facts.soil_springs:
            continue
        if section.name not in _OF_THE_MODEL and sets.find(name) is None:
            own = sets_of_postprocessing(context.deck) if own is None else own
            if name_key(name) in own or not context.deck.keywords():
                continue
        sets.check(name, where)


_OF_THE_MODEL = ("PREPROCESSOR", "MODEL", "LOAD CASE")


def sets_of_postprocessing(deck: Deck) -> dict[str, str]:
    """Return the sets that sections other than the model define, by their folded names."""
    sections = (section for section in deck.sections if section.name not in _OF_THE_MODEL)
    names = (name for section in sections for block in section.blocks for name in _sets_defined_by(block))
    return {name_key(name): bare(name) for name in names}


def _sets_defined_by(block: Block | Opaque) -> Iterator[str]:
    if not isinstance(block, Opaque):
        yield from (name for _, name in names_given(block, Names.SET, "defines"))
    elif block.keyword in catalogue.definers(Names.SET):
        for line in block.lines:
            key, equals, name = line.partition("=")
            if equals and canonical_key(key) == Names.SET.name:
                yield name


def check_idents(context: Context, nodes: Numbered, elements: Numbered) -> None:
    """Report undefined nodes and elements that keywords refer to, except where nodes and sets are made."""
    for where, _, block in context.deck.every_block():
        if type(block) is Opaque or not _names_idents(type(block)):
            continue
        for what, check in ((Names.NODE, _check_nodes), (Names.ELEMENT, _check_elements)):
            named = [(ident, where._replace(path=path)) for path, ident in idents_given(block, what)]
            check(context, nodes if what is Names.NODE else elements, named)


@cache
def _names_idents(block: type[Block]) -> bool:
    elsewhere = block.facts.defines or block.model_fields["keyword"].default == KEYWORD
    return not elsewhere and not kinds_of(block, "names").isdisjoint((Names.NODE, Names.ELEMENT))


def check_chains(context: Context) -> None:
    """Report every GEN= of `*DRAG CHAIN` that repeats the chain of a node without one before it."""
    known: set[object] = set()
    for where, block in context.blocks("DRAG CHAIN"):
        for index, chain in enumerate(cast("DragChains", block).chains):
            generate = getattr(chain, "generate", None)
            master = getattr(chain, "node", None) if generate is None else generate.master
            if generate is None:
                known.add(master)
            elif isinstance(master, int) and master not in known and "DRAG CHAIN" not in context.unread:
                message = f"GEN= repeats the chain of a node: node {master} has none before this line; define it above"
                context.report(REF010, message, where.inside("chains", index, "generate", 0), Severity.ERROR)


KEYWORD = "BOUNDARY"
"""Keyword with its own check: some nodes of its ranges may be undefined."""
FREEDOMS = range(1, 7)


def _check_elements(context: Context, elements: Numbered, named: Sequence[tuple[object, Where]]) -> None:
    """Report undefined numbers of elements, and in a deck with `*LABEL` undefined labels."""
    labelled = "LABEL" in context.deck.keywords() and not context.external_definers
    for ident, where in named if labelled else ():
        if isinstance(ident, Label):
            context.report_label(REF005, ident, where, "ELEMENT", blocks=Blocks.NEVER)
    numbers = [(ident, where) for ident, where in named if isinstance(ident, int) and not isinstance(ident, bool)]
    if not numbers or not (len(elements) or "ELEMENT" in context.deck.keywords()):
        return
    indices = elements.indices(np.array([number for number, _ in numbers], dtype=np.int64))
    for index in np.flatnonzero(indices < 0)[: MOST_REPORTED + 1].tolist():
        number, where = numbers[index]
        message = f"element {number} is not defined: define it in *ELEMENT, or correct the number"
        context.report_missing(REF005, message, where, "ELEMENT", number, blocks=Blocks.NEVER)


def _check_nodes(context: Context, nodes: Numbered, named: Sequence[tuple[object, Where]]) -> None:
    """Report undefined nodes, numbers or labels; any other value could not be read and is skipped."""
    if not named:
        return
    numbers: list[int] = []
    places: list[Where] = []
    shown_nodes = shows_nodes(context, nodes)
    for node, where in named:
        if isinstance(node, Label):
            if (shown_nodes or context.external_definers) and not context.is_guessed_label(where):
                context.report_label(REF006, node, where, "NODE")
        elif isinstance(node, int):
            numbers.append(node)
            places.append(where)
    missing = np.flatnonzero(nodes.indices(np.array(numbers, dtype=np.int64)) < 0)
    for index in missing[: MOST_REPORTED + 1].tolist() if shown_nodes else ():
        message = f"node {numbers[index]} is not defined: define it in *NODE, or correct the number"
        context.report_missing(REF006, message, places[index], "NODE", numbers[index])


def shows_nodes(context: Context, nodes: Numbered) -> bool:
    """Return True if the deck shows nodes: a deck without any has its model somewhere else."""
    return len(nodes) > 0 or "NODE" in context.deck.keywords()


def check_boundaries(context: Context, nodes: Numbered) -> None:
    """Report undefined nodes of `*BOUNDARY`, and degrees of freedom other than 1 to 6."""
    blocks = context.blocks(KEYWORD, "LOAD CASE")
    for where, block in blocks:
        if not cast("Boundary", block).types and not context.deck.lost(where):
            message = "*BOUNDARY is empty: give TYPE= and nodes below it, or remove it"
            context.report(SYN001, message, where, Severity.WARNING)
    named: list[tuple[object, Where]] = []
    for place, entry, values in _conditions(blocks):
        if values is None:
            named.append((entry.node, place.inside("node")))
            _check_freedom(context, entry.dof, place.inside("dof"))
        else:
            _check_range(context, nodes, values, place)
            ends = enumerate((values.start, values.end))
            named += [(end, place.inside(at)) for at, end in ends if isinstance(end, Label)]
    _check_nodes(context, nodes, named)


def _conditions(blocks: Iterable[tuple[Where, Any]]) -> Iterator[tuple[Where, Any, FixedValues | None]]:
    """Yield place and entry of each line of `*BOUNDARY` that is read, and the values of a GEN=."""
    for where, block in blocks:
        for i, held in enumerate(cast("Boundary", block).types):
            for j, entry in enumerate(held.entries):
                place = where.inside("types", i, "entries", j)
                if not hasattr(entry, "generate"):
                    yield place, entry, None
                elif entry.generate is not None:
                    yield place.inside("generate"), entry, entry.generate


class HeldNodes(NamedTuple):
    """Line of `*BOUNDARY`: its place, the degree of freedom, the indices of its nodes, and the value and fixation."""

    where: Where
    dof: int
    nodes: Indices
    how: tuple[object, object]


def held_nodes(deck: EvaluatedDeck, nodes: Numbered) -> Iterator[HeldNodes]:
    """Yield the nodes, among those of a model, that each line of `*BOUNDARY` of a deck holds.

    Lines whose form is not public are left out.
    """
    for place, entry, values in _conditions(deck.blocks(KEYWORD, "LOAD CASE")):
        numbers: tuple[Any, ...]
        if values is None:
            numbers, dof, value, where = (entry.node, entry.node, 1), entry.dof, entry.value, place.inside("dof")
        else:
            at, step = freedom_and_step(values)
            fields = (values.third, values.fourth, values.fifth, None)
            numbers, dof, value, where = (
                (values.start, values.end, cast("Any", step)),
                fields[at - 2],
                fields[at - 1],
                place,
            )
        whole = all(isinstance(number, int) and abs(number) <= LARGEST_WHOLE for number in numbers)
        if whole and numbers[2] > 0 and dof in FREEDOMS:
            yield HeldNodes(where, int(cast("int", dof)), nodes.between(*numbers), (value or 0.0, entry.fixation))


def _check_range(context: Context, nodes: Numbered, values: FixedValues, where: Where) -> None:
    """Report undefined nodes of a GEN=, without building them, and its degree of freedom."""
    at, step = freedom_and_step(values)
    freedom = (values.third, values.fourth)[at - 2]
    if freedom is None:
        message = "this GEN= has no degree of freedom: write start, end [, increment], dof [, displacement]"
        context.report(SYN003, message, where)
    else:
        _check_freedom(context, freedom, where.inside(at))
    start, end = values.start, values.end
    if not (isinstance(start, int) and isinstance(end, int) and isinstance(step, int)):
        return
    written = f"GEN= holds the nodes from {start} to {end} in steps of {step}"
    if end < start or step < 1:
        why = "the increment must be at least 1" if step < 1 else "the end must not come before the start"
        context.report(REF010, f"{written}: there are none, {why}", where, Severity.ERROR)
        return
    existing = len(nodes.between(start, end, step)) if len(nodes) else 0
    expected = (end - start) // step + 1
    if existing < expected and shows_nodes(context, nodes) and not context.possible_definition("NODE"):
        message = f"{written}: {expected - existing} of these {expected} are not defined; correct it, or define them"
        context.report(REF006, message, where, Severity.WARNING if existing else None)


def _check_freedom(context: Context, freedom: object, where: Where) -> None:
    if _is_no_freedom(freedom):
        expected = "expected 1 (vertical), 2 or 3 (horizontal), or 4 to 6 (rotations)"
        context.report(SYN005, f"{freedom} is not a degree of freedom: {expected}", where)


def freedom_and_step(values: FixedValues) -> tuple[int, object]:
    """Return the index of the degree of freedom in a GEN=, counted from 0, and the increment.

    With four values the third is the degree of freedom only if the fourth cannot be.
    """
    third, fourth = values.third, values.fourth
    if values.fifth is None and (
        fourth is None or (third is not None and _is_no_freedom(fourth) and not _is_no_freedom(third))
    ):
        return 2, 1
    return 3, 1 if third is None else third


def _is_no_freedom(freedom: object) -> bool:
    """Return True if a value is not a degree of freedom; an unreadable value may be one. Equations give 6.0 for 6."""
    known = isinstance(freedom, int | float) and not math.isnan(freedom)
    return known and freedom not in FREEDOMS


def check_lines(context: Context) -> None:
    """Report names of lines and groups in `*LINE PATH SECTIONS`: warnings at most."""
    blocks = (cast("LineSectionGroups", block) for _, block in context.blocks("LINE SECTION GROUPS"))
    groups = {name_key(group.name): group.name for block in blocks for group in block.groups if group.name}
    for where, block in context.blocks("LINE PATH SECTIONS"):
        for index, path in enumerate(cast("LinePathSections", block).paths):
            place = where.inside("paths", index)
            if path.line and "LINE PATHS" in context.external_definers:
                what = ("LINE=", "line", "*LINE PATHS")
                _check_name(context, what, path.line, place.inside("line"), context.labels)
            for number, section in enumerate(path.sections):
                if section.repeat:
                    what = ("REPEAT=", "group", "*LINE SECTION GROUPS")
                    _check_name(context, what, section.repeat, place.inside("sections", number, "repeat"), groups)


def _check_name(context: Context, what: tuple[str, str, str], name: str, where: Where, known: dict[str, str]) -> None:
    """Report an undefined name, given by a KEY for an object of a keyword; `known` has the names by folded form."""
    key, thing, keyword = what
    if name_key(name) in known:
        return
    message = f"{key} names no {thing}: {shown(name)} is not defined{context.hint(name, known)}; define it in {keyword}"
    source = context.possible_definition(keyword[1:])
    context.report(REF001, f"{message}; {source}" if source else message, where, Severity.WARNING)

"""Checks of names, labels and numbers in fields against those that the deck defines."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.basics.limits import MOST_REPORTED
from mudline.basics.spelling import same_marks
from mudline.language.codes.fields import SYN003
from mudline.language.codes.lines import SYN001, SYN005
from mudline.language.codes.references import REF001, REF005, REF006, REF010
from mudline.language.deck.model import Deck, NamedPlace, Opaque, raw_lines
from mudline.language.deck.parameters import bare, folded, name_key
from mudline.language.diagnostics import Blocks, Code, Problem, Severity, Where
from mudline.language.keywords import catalogue
from mudline.language.keywords.contents import idents_given, is_read, kinds_of, names_given
from mudline.language.keywords.model import Block
from mudline.language.keywords.text import shown
from mudline.language.keywords.values import Label, Names
from mudline.language.syntax.fields import canonical_key
from mudline.model.scene.context import Context
from mudline.model.scene.deck_values import makes_labels
from mudline.model.scene.laws import LawTable
from mudline.model.scene.numbering import Numbered
from mudline.model.scene.sets import Sets

if TYPE_CHECKING:
    from mudline.language.keywords.library.attachments import DragChains
    from mudline.language.keywords.library.lines import LinePathSections, LineSectionGroups
    from mudline.language.keywords.library.loads import Boundary, FixedRange, FixedValues
    from mudline.language.keywords.library.mesh import ElementRows, Elements
    from mudline.language.keywords.library.soil_springs import LateralSoil


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


@dataclass(eq=False)
class NamesOfKind:
    """Names of a kind: those that fields use, and those that they define, by their folded form."""

    used: list[NamedPlace] = field(default_factory=list)
    defined: dict[str, list[NamedPlace]] = field(default_factory=dict)

    @property
    def known(self) -> dict[str, str]:
        """Defined names, as first written, by their folded form."""
        return {key: given[0].name for key, given in self.defined.items()}


def names_of(context: Context, kinds: Collection[Names]) -> dict[Names, NamesOfKind]:
    """Return the names of some kinds that the fields of a deck give."""
    return {kind: names for kind, names in context.once(every_name).items() if kind in kinds}


def every_name(context: Context) -> dict[Names, NamesOfKind]:
    """Return the names of all kinds that the fields of a deck give; call it by `Context.once`."""
    names_by_kind: dict[Names, NamesOfKind] = defaultdict(NamesOfKind)
    for place in context.deck.names():
        names = names_by_kind[place.kind]
        if place.role == "names":
            names.used.append(place)
        else:
            names.defined.setdefault(name_key(place.name), []).append(place)
    return names_by_kind


def undefined(context: Context, kinds: Collection[Names], code: Code) -> Iterator[Problem]:
    """Yield names that are not defined; a warning if that is not certain, because not all was read."""
    for kind, names in names_of(context, kinds).items():
        if not names.used or not (definers := catalogue.definers(kind)) or not context.deck.keywords():
            continue
        known = names.known
        doubt = _doubt(context, definers)
        advice = f"define it in {' or '.join(f'*{keyword}' for keyword in definers)}, or correct the name"
        for use in names.used:
            if name_key(use.name) in known or not use.name:
                continue
            thing = kind.value.removeprefix("a ").removeprefix("an ")
            message = f"{thing} {shown(use.name)} is not defined{context.hint(use.name, known)}: {advice}"
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
    for kind, names in names_of(context, kinds).items():
        thing = kind.value.removeprefix("a ").removeprefix("an ")
        for definitions in names.defined.values():
            for later in definitions[1:]:
                message = f"{thing} {shown(later.name)} is already defined: choose another name, or keep one of them"
                yield Problem(code, message, where=later.where)


def unused(context: Context, kinds: Collection[Names], code: Code) -> Iterator[Problem]:
    """Yield names that are not used: an info if the keywords that would use them are not read, or not in the deck."""
    raw = ""
    for kind, names in names_of(context, kinds).items():
        used = {name_key(use.name) for use in names.used}
        users = catalogue.users(kind)
        for key, (first, *_) in names.defined.items():
            if key in used:
                continue
            if not raw:
                unread = (line for _, _, block in context.deck.every_block() for line in raw_lines(block))
                raw = "\n".join(map(folded, unread)) or "\n"
            if key in raw:
                continue
            thing = kind.value.removeprefix("a ").removeprefix("an ")
            by = f"name it in {' or '.join(f'*{keyword}' for keyword in users)}, or remove it" if users else "remove it"
            severity = None if users else Severity.INFO
            yield Problem(code, f"{thing} {shown(first.name)} is not used: {by}", None, severity, first.where)


_FREEDOMS = 6


def check_references(context: Context, sets: Sets, laws: LawTable, *, with_soil: bool) -> None:
    """Report undefined names of sets, and remember names of curves; names in soil springs only with `with_soil`.

    Postprocessing may have its own sets in addition to those of the model.
    """
    own: dict[str, str] | None = None
    for name, where in ((use.name, use.where) for use in context.once(every_name)[Names.SET].used):
        section = context.deck.sections[where.section]
        if not with_soil and cast("Block", section.blocks[where.block]).facts.soil_springs:
            continue
        if section.name not in _OF_THE_MODEL and sets.find(name) is None:
            own = sets_of_postprocessing(context.deck) if own is None else own
            if name_key(name) in own or not context.deck.keywords():
                continue
        sets.check(name, where)
    laws.referenced.update(folded(use.name) for use in context.once(every_name)[Names.CURVE].used)


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


def used_names(deck: Deck, *kinds: Names) -> Iterator[tuple[Where, str]]:
    """Return the names of some kinds that the fields of a deck use, with their places."""
    return ((place.where, place.name) for place in deck.names() if place.role == "names" and place.kind in kinds)


def check_soil(context: Context, nodes: Numbered) -> None:
    """Report every NODE= of soil springs that the deck does not define."""
    named = [
        (getattr(curve, "node", None), where.inside("sets", i, "curves", j, "node"))
        for where, block in context.deck.blocks_with("soil_springs")
        for i, springs in enumerate(cast("LateralSoil", block).sets)
        for j, curve in enumerate(springs.curves)
    ]
    _check_nodes(context, nodes, named)


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
    elsewhere = block.facts.defines or block.facts.soil_springs or block.model_fields["keyword"].default == KEYWORD
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


def _check_elements(context: Context, elements: Numbered, named: Sequence[tuple[object, Where]]) -> None:
    """Report undefined numbers of elements, and in a deck with `*LABEL` undefined labels."""
    for ident, where in named if "LABEL" in context.deck.keywords() else ():
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
            check_label(context, REF006, node, where)
            if shown_nodes and not context.is_guessed_label(where):
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
    named: list[tuple[object, Where]] = []
    for where, block in context.blocks("BOUNDARY", "LOAD CASE"):
        types = cast("Boundary", block).types
        if not types and not context.deck.lost(where):
            message = "*BOUNDARY is empty: give TYPE= and nodes below it, or remove it"
            context.report(SYN001, message, where, Severity.WARNING)
        for i, held in enumerate(types):
            for j, entry in enumerate(held.entries):
                place = where.inside("types", i, "entries", j)
                if hasattr(entry, "generate"):
                    span = cast("FixedRange", entry)
                    _check_range(context, nodes, span, place.inside("generate"))
                    ends = (getattr(span.generate, "start", None), getattr(span.generate, "end", None))
                    labels = enumerate(ends)
                    named += [(end, place.inside("generate", at)) for at, end in labels if isinstance(end, Label)]
                else:
                    named.append((entry.node, place.inside("node")))
                    _check_freedom(context, entry.dof, place.inside("dof"))
    _check_nodes(context, nodes, named)


def _check_range(context: Context, nodes: Numbered, entry: FixedRange, where: Where) -> None:
    """Report undefined nodes of a GEN=, without building them, and its degree of freedom."""
    values = cast("FixedValues | None", entry.generate)
    if values is None:
        return
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
    return known and freedom not in range(1, _FREEDOMS + 1)


def check_lines(context: Context) -> None:
    """Report names of lines and groups in `*LINE PATH SECTIONS`, and labels of elements and sets: warnings at most."""
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
    if not context.external_definers:
        return
    for where, block in context.blocks("ELEMENT"):
        for index, entry in enumerate(cast("Elements", block).entries):
            if hasattr(entry, "elements"):
                for (row, column), word in cast("ElementRows", entry).elements.words.items():
                    if isinstance(word, Label):
                        check_label(context, REF006, word, where.inside("entries", index, "elements", row, column))
    for where, block in context.blocks("ELEMENT SETS"):
        for inner, ident in idents_given(block, Names.ELEMENT):
            if isinstance(ident, Label):
                check_label(context, REF005, ident, where.inside(*inner))


def check_label(context: Context, code: Code, label: str, where: Where) -> None:
    """Report a label as a warning if it is spelt nearly as a label in an unread line.

    Other labels are not reported: lines are not read, and may make labels in ways that are not known.
    """
    name = bare(label)
    if not context.external_definers or folded(name) in context.labels:
        return
    near = context.near(name, context.labels)
    if near and same_marks(name, near) and not context.is_guessed_label(where):
        makers = " or ".join(f"*{keyword}" for keyword in context.external_definers if makes_labels(keyword))
        makers += " or *LABEL" if "LABEL" in context.deck.keywords() else ""
        message = f"label {shown(label)} is not in {makers} (did you mean {{{context.labels[near]}}}?)"
        context.report(code, f"{message}: correct it", where, Severity.WARNING)


def _check_name(context: Context, what: tuple[str, str, str], name: str, where: Where, known: dict[str, str]) -> None:
    """Report an undefined name, given by a KEY for an object of a keyword; `known` has the names by folded form."""
    key, thing, keyword = what
    if name_key(name) in known:
        return
    message = f"{key} names no {thing}: {shown(name)} is not defined{context.hint(name, known)}; define it in {keyword}"
    source = context.possible_definition(keyword[1:])
    context.report(REF001, f"{message}; {source}" if source else message, where, Severity.WARNING)

"""Names that keywords give to things and use of them: one check for all kinds that are no more than names.

Sets, force-embedment curves, nodes, elements, files and parameters are more, and are looked up where they are resolved.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass, field

from mudline.language.deck.model import Deck, NamedPlace, Opaque
from mudline.language.deck.parameters import bare, folded
from mudline.language.diagnostics import Blocks, Code, Problem, Severity, Where
from mudline.language.keywords import catalogue
from mudline.language.keywords.keeping import is_read, kept_lines
from mudline.language.keywords.text import shown
from mudline.language.keywords.values import Names
from mudline.model.scene.context import Context

CURVES = frozenset(
    {
        *(Names.MOMENT_CURVATURE, Names.FORCE_STRAIN, Names.TORQUE_TWIST, Names.STRESS_STRAIN),
        *(Names.DAMPER, Names.DRAG_LIFT, Names.PIP_STIFFNESS, Names.S_N_CURVE),
    }
)
"""Kinds of curves but those of a seabed."""
THINGS = frozenset(
    {
        *(Names.VESSEL, Names.BODY, Names.AUXILIARY, Names.CABLE, Names.LINE, Names.SECTION_GROUP),
        *(Names.VECTOR, Names.AXIS, Names.GUIDE),
    }
)
"""Kinds of things that have names and are no curves."""


@dataclass(eq=False)
class NamesOfKind:
    """The names of a kind: those that fields use, and those that they define, by their folded form."""

    used: list[NamedPlace] = field(default_factory=list)
    defined: dict[str, list[NamedPlace]] = field(default_factory=dict)


def names_of(context: Context, kinds: Collection[Names]) -> dict[Names, NamesOfKind]:
    """The names of some kinds that the fields of a deck give."""
    return {kind: names for kind, names in context.once(_every_name).items() if kind in kinds}


def names_used(context: Context, kind: Names) -> list[NamedPlace]:
    """The names of a kind, among them those of sets and force-embedment curves, that the fields of a deck use."""
    found = context.once(_every_name).get(kind)
    return found.used if found else []


def _every_name(context: Context) -> dict[Names, NamesOfKind]:
    found: dict[Names, NamesOfKind] = {}
    for one in context.deck.names():
        names = found.setdefault(one.kind, NamesOfKind())
        if one.role == "names":
            names.used.append(one)
        else:
            names.defined.setdefault(folded(bare(one.name)), []).append(one)
    return found


def undefined(context: Context, kinds: Collection[Names], code: Code) -> Iterator[Problem]:
    """Names that nothing defines; where that is not certain, because not all was read, a warning."""
    for kind, names in names_of(context, kinds).items():
        if not names.used or not (definers := catalogue.definers(kind)) or not context.deck.keywords():
            continue
        known = {key: given[0].name for key, given in names.defined.items()}
        doubt = _doubt(context, definers)
        advice = f"define it in {' or '.join(f'*{keyword}' for keyword in definers)}, or correct the name"
        for given in names.used:
            if folded(bare(given.name)) in known or not given.name:
                continue
            thing = kind.value.removeprefix("a ").removeprefix("an ")
            message = f"{thing} {shown(given.name)} is not defined{context.hint(given.name, known)}: {advice}"
            severity = Severity.WARNING if doubt else None
            yield Problem(code, message + doubt, None, severity, given.where, blocks=Blocks.NEVER, lacks=given.name)


def _doubt(context: Context, definers: Collection[str]) -> str:
    """What may define a thing besides the lines that were read, in words; "" where nothing may."""
    for i, section in enumerate(context.deck.sections):
        for j, block in enumerate(section.blocks):
            if block.keyword in definers and (
                isinstance(block, Opaque) or not is_read(block) or context.deck.lost(Where(i, j))
            ):
                return f"; a line of *{block.keyword} that was not read may define it"
    words = (context.possible_definition(keyword) for keyword in definers)
    return next((f"; {one}" for one in words if one), "")


def repeated(context: Context, kinds: Collection[Names], code: Code) -> Iterator[Problem]:
    """Names that are defined a second time."""
    for kind, names in names_of(context, kinds).items():
        thing = kind.value.removeprefix("a ").removeprefix("an ")
        for given in names.defined.values():
            for later in given[1:]:
                message = f"{thing} {shown(later.name)} is already defined: choose another name, or keep one of them"
                yield Problem(code, message, where=later.where)


def unused(context: Context, kinds: Collection[Names], code: Code) -> Iterator[Problem]:
    """Names that nothing uses: an info where the keywords that would use them are not read, or not in the deck."""
    raw = ""
    for kind, names in names_of(context, kinds).items():
        used = {folded(bare(one.name)) for one in names.used}
        users = catalogue.users(kind)
        for key, (first, *_) in names.defined.items():
            if key in used:
                continue
            raw = raw or _not_read(context.deck)
            if key in raw:
                continue
            thing = kind.value.removeprefix("a ").removeprefix("an ")
            by = f"name it in {' or '.join(f'*{keyword}' for keyword in users)}, or remove it" if users else "remove it"
            severity = None if users else Severity.INFO
            yield Problem(code, f"{thing} {shown(first.name)} is not used: {by}", None, severity, first.where)


def _not_read(deck: Deck) -> str:
    """The lines that are not read, which may use names; a line end where there are none."""
    blocks = (block for section in deck.sections for block in section.blocks)
    lines = (block.lines if isinstance(block, Opaque) else kept_lines(block) for block in blocks)
    return "\n".join(folded(line) for own in lines for line in own) or "\n"

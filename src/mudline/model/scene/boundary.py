"""Conditions of `*BOUNDARY`: their checks, the nodes that they hold, the vessels that move nodes, and their offsets."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple, cast

import numpy as np

from mudline.language.codes.fields import SYN003
from mudline.language.codes.lines import SYN001, SYN005
from mudline.language.codes.references import REF006, REF010
from mudline.language.deck.parameters import EvaluatedDeck, evaluated, folded
from mudline.language.diagnostics import Severity, Where
from mudline.language.keywords import catalogue
from mudline.language.keywords.table import LARGEST_WHOLE
from mudline.language.keywords.values import Label, Names
from mudline.language.syntax.rows import read_number
from mudline.model.scene.context import Context
from mudline.model.scene.deck_values import number
from mudline.model.scene.numbering import Floats, Indices, Numbered
from mudline.model.scene.references import KEYWORD, check_numbers, shows_nodes
from mudline.model.scene.resolved import ResolvedDeck

if TYPE_CHECKING:
    from mudline.language.keywords.library.loads import Boundary, FixedValues
    from mudline.language.keywords.library.vessel_motions import Offsets

FREEDOMS = range(1, 7)
TRANSLATIONS = frozenset({1, 2, 3})
NO_FREEDOMS: frozenset[int] = frozenset()


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
    check_numbers(context, Names.NODE, nodes, named)


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
        if values is None:
            numbers, dof, value, where = (entry.node, entry.node, 1), entry.dof, entry.value, place.inside("dof")
        else:
            at, step = freedom_and_step(values)
            numbers, where = (values.start, values.end, step), place
            dof, value = (values.third, values.fourth, values.fifth)[at - 2 : at]
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


def freedom_and_step(values: FixedValues) -> tuple[int, Any]:
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
    return isinstance(freedom, int | float) and not math.isnan(freedom) and freedom not in FREEDOMS


def nodes_on_vessels(scene: ResolvedDeck, deck: EvaluatedDeck) -> Iterator[tuple[int, frozenset[int], str]]:
    """Yield index, degrees of freedom and vessel of each node below TYPE=VESSEL, in lines whose form is not public.

    A line is `node, vessel`, or `node` below VESSEL=; a line without a degree of freedom holds all. A vessel without a
    name is "".
    """
    labels = {
        folded(f"{{{line.label}}}"): number(line.node, "number", 0.0)
        for _, block in deck.blocks("LABEL")
        for line in block.labels
    }
    types = (each for _, block in deck.blocks(KEYWORD, "LOAD CASE") for each in cast("Boundary", block).types)
    for lines in (each.unread for each in types if each.type_ == Names.VESSEL.name):
        vessel = ""
        for text in (line.text for line in lines):
            key, equals, name = text.partition("=")
            if equals and key.strip().upper() == Names.VESSEL.name:
                vessel = name.strip()
            first, *others = [word.strip() for word in text.split(",")]
            node = labels.get(folded(first), read_number(first))
            if node is None or not abs(node) <= LARGEST_WHOLE or node != int(node):
                continue
            own = next((word for word in others if word and read_number(word) is None), vessel)
            freedoms = [value for value in map(read_number, others) if value in FREEDOMS][:1]
            at = int(scene.nodes.indices(np.array([int(node)]))[0])
            if at >= 0:
                yield at, frozenset(map(int, cast("list[float]", freedoms))) or TRANSLATIONS, own


def held_freedoms(
    scene: ResolvedDeck, decks: Sequence[EvaluatedDeck] | None = None
) -> tuple[dict[int, frozenset[int]], dict[int, str]]:
    """Return the degrees of freedom in which `*BOUNDARY` holds nodes, by index, and the vessels that move nodes.

    `decks` are those whose conditions count, by default also the continued ones: a restart keeps what it does not
    change. A vessel without a name in `*BOUNDARY` is the only one of the decks, or "".
    """
    freedoms: dict[int, frozenset[int]] = {}
    vessels: dict[int, str] = {}
    every = [*(evaluated(base.deck)[0] for base in reversed(scene.deck.bases)), scene.deck]
    placed = (
        block for deck in every for keyword in catalogue.definers(Names.VESSEL) for _, block in deck.blocks(keyword)
    )
    known = [str(each.vessel) for block in placed for each in block.vessels]
    only = known[0] if len({folded(name) for name in known}) == 1 else ""
    for deck in every if decks is None else decks:
        for line in held_nodes(deck, scene.nodes):
            for node in line.nodes.tolist():
                freedoms[node] = freedoms.get(node, NO_FREEDOMS) | {line.dof}
        for node, axes, vessel in nodes_on_vessels(scene, deck):
            freedoms[node] = freedoms.get(node, NO_FREEDOMS) | axes
            vessels[node] = vessel or vessels.get(node, only)
    return freedoms, vessels


def vessel_offset(scene: ResolvedDeck, vessel: str) -> Floats:
    """Return the offset (3,) of a vessel in the deck's own load case; 0 without one."""
    offset = np.zeros(3)
    for _, block in scene.deck.blocks("OFFSET", "LOAD CASE"):
        for each in cast("Offsets", block).offsets:
            if vessel and folded(str(each.vessel)) == folded(vessel):
                offset = np.array([number(each.offset, axis, 0.0) for axis in "xyz"])
    return offset


class HeldLine(NamedTuple):
    """Line between two ends.

    number: its number in the deck, from 1.
    elements: indices of its elements (m,).
    nodes: indices of its nodes (m + 1,).
    held: freedoms held at each end.
    vessels: vessel of each end; "" for a vessel without a name.
    """

    number: int
    elements: Indices
    nodes: Indices
    held: tuple[frozenset[int], frozenset[int]]
    vessels: tuple[str, str]


def lines_between(scene: ResolvedDeck) -> Iterator[HeldLine]:
    """Yield the lines of a scene, cut at inner nodes that are held in all directions."""
    from mudline.model.contact.lines import lines_of  # noqa: PLC0415 - checking a deck does without it

    held, vessels = held_freedoms(scene)
    lines = lines_of(scene.element_nodes, np.nan_to_num(scene.length), len(scene.node_ids))
    number = 0
    for elements, nodes in zip(lines.elements, lines.nodes, strict=True):
        inner = [at for at in range(1, len(nodes) - 1) if held.get(int(nodes[at]), NO_FREEDOMS) >= TRANSLATIONS]
        for first, last in pairwise([0, *inner, len(nodes) - 1]):
            number += 1
            ends = int(nodes[first]), int(nodes[last])
            freedoms = (held.get(ends[0], NO_FREEDOMS), held.get(ends[1], NO_FREEDOMS))
            names = (vessels.get(ends[0], ""), vessels.get(ends[1], ""))
            yield HeldLine(number, elements[first:last], nodes[first : last + 1], freedoms, names)

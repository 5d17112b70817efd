"""Nodes that `*BOUNDARY` holds, and their held degrees of freedom; vessels that move nodes, and their offsets."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np

from mudline.language.deck.parameters import EvaluatedDeck, evaluated, folded
from mudline.language.keywords import catalogue
from mudline.language.keywords.table import LARGEST_WHOLE
from mudline.language.keywords.values import Names
from mudline.language.syntax.rows import read_number
from mudline.model.scene.deck_values import number
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Floats, Indices
from mudline.model.scene.references import FREEDOMS, KEYWORD, held_nodes

if TYPE_CHECKING:
    from mudline.language.keywords.library.loads import Boundary
    from mudline.language.keywords.library.vessel_motions import Offsets

TRANSLATIONS = frozenset({1, 2, 3})
NO_FREEDOMS: frozenset[int] = frozenset()


def nodes_on_vessels(scene: Scene, deck: EvaluatedDeck) -> Iterator[tuple[int, frozenset[int], str]]:
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
    scene: Scene, decks: Sequence[EvaluatedDeck] | None = None
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
        for line in scene.held if deck is scene.deck else held_nodes(deck, scene.nodes):
            for node in line.nodes.tolist():
                freedoms[node] = freedoms.get(node, NO_FREEDOMS) | {line.dof}
        for node, axes, vessel in nodes_on_vessels(scene, deck):
            freedoms[node] = freedoms.get(node, NO_FREEDOMS) | axes
            vessels[node] = vessel or vessels.get(node, only)
    return freedoms, vessels


def vessel_offset(scene: Scene, vessel: str) -> Floats:
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


def lines_between(scene: Scene) -> Iterator[HeldLine]:
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

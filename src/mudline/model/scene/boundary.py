"""Nodes that `*BOUNDARY` holds, and their held degrees of freedom; vessels that move nodes, and their offsets."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np

from mudline.language.deck.evaluated import evaluated
from mudline.language.deck.parameters import folded
from mudline.language.keywords import catalogue
from mudline.language.keywords.table import LARGEST_WHOLE
from mudline.language.keywords.values import Names
from mudline.language.syntax.rows import read_number
from mudline.model.contact.lines import lines_of
from mudline.model.scene.deck_values import number
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Floats, Indices
from mudline.model.scene.references import freedom_and_step

if TYPE_CHECKING:
    from mudline.language.keywords.library.loads import Boundary, BoundaryType
    from mudline.language.keywords.library.vessel_motions import Offsets

TRANSLATIONS = frozenset({1, 2, 3})


def conditions(scene: Scene, block_type: BoundaryType) -> Iterator[tuple[Indices, frozenset[int], float]]:
    """Yield nodes, degrees of freedom and displacement of each line; a vessel's line without a freedom holds all."""
    for start, end, step, freedom, value in _ranges(block_type):
        nodes = scene.nodes.between(start, end, step)
        if nodes.size:
            yield nodes, TRANSLATIONS if freedom is None else frozenset({freedom}), value


def _ranges(block_type: BoundaryType) -> Iterator[tuple[int, int, int, int | None, float]]:
    for entry in block_type.entries:
        if hasattr(entry, "generate"):
            values = entry.generate
            at, step = freedom_and_step(values)
            numbers = (values.start, values.end, step, (values.third, values.fourth)[at - 2])
            if all(isinstance(each, int | float) for each in numbers):
                start, end, step, freedom = (int(cast("int", each)) for each in numbers)
                yield start, end, max(1, step), freedom, number(values, "fifth", 0.0)
        elif isinstance(entry.node, int) and isinstance(entry.dof, int | float):
            yield entry.node, entry.node, 1, int(entry.dof), number(entry, "value", 0.0)
    for line in block_type.unread:
        words = [read_number(word.strip()) for word in line.text.split(",")]
        whole = [int(word) for word in words if word is not None and abs(word) <= LARGEST_WHOLE]
        if words[0] is not None and whole:
            yield whole[0], whole[0], 1, next(iter(whole[1:]), None), 0.0


def held_nodes(scene: Scene) -> tuple[dict[int, frozenset[int]], dict[int, str]]:
    """Return the degrees of freedom in which `*BOUNDARY` holds nodes, by index, and the vessels that move nodes.

    Continued decks count too: a restart keeps what it does not change.
    """
    freedoms: dict[int, frozenset[int]] = {}
    vessels: dict[int, str] = {}
    decks = [*(evaluated(base.deck)[0] for base in reversed(scene.deck.bases)), scene.deck]
    keywords = catalogue.definers(Names.VESSEL)
    placed = (block for deck in decks for keyword in keywords for _, block in deck.blocks(keyword))
    known = [str(each.vessel) for block in placed for each in block.vessels]
    only = known[0] if len({folded(name) for name in known}) == 1 else ""
    for deck in decks:
        for _, block in deck.blocks("BOUNDARY", "LOAD CASE"):
            for each in cast("Boundary", block).types:
                for nodes, axes, _ in conditions(scene, each):
                    for node in nodes.tolist():
                        freedoms[node] = freedoms.get(node, frozenset()) | axes
                        if each.type_ == "VESSEL":
                            vessels.setdefault(node, only)
                current = ""
                for line in each.unread if each.type_ == "VESSEL" else ():
                    current = _vessel_of_line(scene, line.text, current, vessels)
    return freedoms, vessels


def _vessel_of_line(scene: Scene, text: str, current: str, vessels: dict[int, str]) -> str:
    """Add the vessel of a node that a line names, `node, vessel` or below VESSEL=; return the current vessel."""
    key, equals, name = text.partition("=")
    if equals and key.strip().upper() == "VESSEL":
        return name.strip()
    words = [word.strip() for word in text.split(",")]
    node = read_number(words[0])
    own = next((word for word in words[1:] if word and read_number(word) is None), current)
    if node is not None and own and node == int(node):
        at = int(scene.nodes.indices(np.array([int(node)]))[0])
        if at >= 0:
            vessels[at] = own
    return current


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
    held, vessels = held_nodes(scene)
    lines = lines_of(scene.element_nodes, np.nan_to_num(scene.length), len(scene.node_ids))
    nothing: frozenset[int] = frozenset()
    number = 0
    for elements, nodes in zip(lines.elements, lines.nodes, strict=True):
        inner = [at for at in range(1, len(nodes) - 1) if held.get(int(nodes[at]), nothing) >= TRANSLATIONS]
        for first, last in pairwise([0, *inner, len(nodes) - 1]):
            number += 1
            ends = int(nodes[first]), int(nodes[last])
            freedoms = (held.get(ends[0], nothing), held.get(ends[1], nothing))
            names = (vessels.get(ends[0], ""), vessels.get(ends[1], ""))
            yield HeldLine(number, elements[first:last], nodes[first : last + 1], freedoms, names)

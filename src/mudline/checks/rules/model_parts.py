"""Parts of a whole model that lack something: nodes without elements, ends that hang free, elements without properties.

A deck without `$LOAD CASE`, or without `$MODEL`, is a part of a job, and nothing is missing in it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.checks.context import LintContext
from mudline.checks.rules.geometry import without_sections
from mudline.checks.rules.seabed_position import first_of
from mudline.language.deck.model import Opaque, raw_lines
from mudline.language.diagnostics import Code, Problem, Severity, Where
from mudline.language.keywords.catalogue import may_give
from mudline.language.keywords.contents import idents_given, kinds_of
from mudline.language.keywords.model import Block
from mudline.language.keywords.values import Gift, Names
from mudline.language.rules import rule
from mudline.language.syntax.rows import read_number
from mudline.model.scene.deck_values import number
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Mask

if TYPE_CHECKING:
    from mudline.language.keywords.library.curvilinear import Cables, CurvilinearNodes

GEO007 = Code("GEO007", "element-without-section", Severity.WARNING)
GEO009 = Code("GEO009", "node-without-element", Severity.INFO)
GEO010 = Code("GEO010", "end-not-held", Severity.INFO)
GEO011 = Code("GEO011", "short-cable", Severity.WARNING)
GEO012 = Code("GEO012", "node-beyond-cable", Severity.WARNING)

GEO015 = Code("GEO015", "no-elements", Severity.INFO)

_PARTS = ("MODEL", "LOAD CASE")
_ROUNDED = 1e-6
"""Relative rounding of a length."""
_OF_CABLE = ("node", "cable", "distance")


def _is_whole(context: LintContext) -> bool:
    """Return True if a deck shows a whole model and a load case of it, and no line of them is lost."""
    scene = context.scene
    reading = scene.context
    shown = {section.name for section in scene.deck.sections if section.name in _PARTS}
    if len(shown) < len(_PARTS) or not len(scene.element_ids) or reading.external_definers or reading.restart:
        return False
    kept: dict[str, int] = {}
    for where, section, block, lines in context.once(_with_lines):
        if section in _PARTS and block.keyword in reading.unread:
            read = 0 if type(block) is Opaque else len(lines)
            kept[block.keyword] = kept.get(block.keyword, 0) + read - scene.deck.lost(where)
    return all(kept.get(keyword, -1) >= 0 for keyword in reading.unread)


def _with_lines(context: LintContext) -> list[tuple[Where, str, Block | Opaque, list[str]]]:
    """Return place, section, block and lines that are passed through of every block of the scene's deck."""
    return [(*placed, raw_lines(placed[2])) for placed in context.scene.deck.every_block()]


def lacks(context: LintContext, *gifts: Gift) -> bool:
    """Return True if a model lacks something of these kinds: no unread line may give it."""
    return context.once(_is_whole) and not _unread_give(context, *gifts)


def _unread_give(context: LintContext, *gifts: Gift) -> bool:
    """Return True if an unread line may give a model something of these kinds."""
    return any(
        may_give(block.keyword, section, gift)
        for _, section, block, lines in context.once(_with_lines)
        if section in _PARTS and (lines or type(block) is Opaque)
        for gift in gifts
    )


@rule(GEO015)
def no_elements(context: LintContext) -> Iterator[Problem]:
    """The deck has a model with nodes and a load case, but no element.

    Without elements nothing lies on the seabed: no contact is checked or evaluated, and a deck without a finding may
    still be wrong. Add *ELEMENT or *LINES, if the deck is more than a part of a job. A deck that continues another
    one takes the elements from there.

    Example:
         $MODEL
         *NODE
          1, 50.0, 0.0
          3, 50.0, 20.0
          GEN=1, 3
        +*ELEMENT
        + 1, 1, 2
        + GEN=1, 2
         $LOAD CASE
         *BOUNDARY
          TYPE=CONSTANT
          1, 1
          3, 1

    Finds: 1:1
    """
    scene = context.scene
    models = [i for i, section in enumerate(context.deck.own_sections) if section.name == _PARTS[0]]
    shown = {section.name for section in scene.deck.sections if len(scene.node_ids)}
    reading = scene.context
    if len(scene.element_ids) or not shown.issuperset(_PARTS) or reading.external_definers or reading.restart:
        return
    if models and not reading.unread and not reading.misplaced and not _unread_give(context, "elements"):
        yield Problem(
            GEO015, "no elements, so there is no contact to check: add *ELEMENT or *LINES", where=Where(models[0], -1)
        )


@rule(GEO007)
def element_without_section(context: LintContext) -> Iterator[Problem]:
    """An element has no geometric properties, while others of its model have.

    No set with a line in *GEOMETRIC SETS holds it: it has neither stiffness nor weight. A range of a set ends too
    early, or a new part of the line was not put into a set. Extend the set, or give it a section. Decks with only the
    model or only the load case are left out. So are elements that take no properties, such as joints and springs.

    Example on held:
          GEN=1, 2
        |*ELEMENT SETS
        | SET=Pipe
        - 1
        + 1, 2
        |*GEOMETRIC SETS
        | OPTION=RIGID
        | SET=Pipe
        | 207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0

    Finds: 8:2
    """
    scene = context.scene
    if not context.blocks("GEOMETRIC SETS") or not lacks(context, "elements", "sections"):
        return
    bare = np.flatnonzero((scene.section_table.of_element < 0) & ~without_sections(scene))
    if bare.size and bare.size < len(scene.element_ids):
        what = first_of("element", scene.element_ids[bare[0]], bare.size)
        message = f"{what} without a line in *GEOMETRIC SETS: put it into a set that has one, or give it a section"
        yield Problem(GEO007, message, where=scene.table.numbered.where(int(bare[0])))


@rule(GEO009)
def node_without_element(context: LintContext) -> Iterator[Problem]:
    """A node belongs to no element, and nothing else refers to it.

    It has no effect. It is left over from an earlier layout, or the number of a node in *ELEMENT is wrong. Remove the
    node, or correct the element.

    Example on held:
          GEN=1, 3
        - 9, 50.0, 30.0

    Finds: 6:2
    """
    scene = context.scene
    if not lacks(context, "elements"):
        return
    used = np.zeros(len(scene.node_ids), dtype=np.bool_)
    ends = scene.element_nodes
    used[ends[ends >= 0]] = True
    used |= context.once(_named_nodes)
    free = np.flatnonzero(~used & _placed(scene))
    if free.size:
        what = first_of("node", scene.node_ids[free[0]], free.size)
        message = f"{what} of no element: remove it, or correct the element that should end there"
        yield Problem(GEO009, message, where=scene.nodes.where(int(free[0])))


@rule(GEO010)
def end_not_held(context: LintContext) -> Iterator[Problem]:
    """A line ends at a node that nothing holds.

    Neither *BOUNDARY nor a spring, a vessel or a body refers to the node, so the end is free. That is right for a pipe
    that is laid or hangs from one end, and otherwise a wrong number. Hold the node, or correct the number. A deck that
    holds no node at all is left out.

    Example on held:
        + 3, 1

    Finds: 4:2
    """
    scene = context.scene
    if not lacks(context, "elements", "supports") or (scene.element_nodes < 0).any():
        return
    counts = np.bincount(scene.element_nodes.ravel(), minlength=len(scene.node_ids))
    held = context.once(_named_nodes)
    free = np.flatnonzero((counts == 1) & ~held & _placed(scene))
    if free.size and held.any():
        what = first_of("node", scene.node_ids[free[0]], free.size)
        at, it = ("the end of a line is", "it") if free.size == 1 else ("ends of lines are", "them")
        message = f"{what} at {at} held by nothing: add {it} to *BOUNDARY, or leave {it} if the end is free"
        yield Problem(GEO010, message, where=scene.nodes.where(int(free[0])))


def _placed(scene: Scene) -> Mask:
    """Return a mask of the nodes whose place is known; nodes of a GEN= between undefined nodes have none."""
    x, y = scene.coordinates[:, 0], scene.coordinates[:, 1]
    return ~(np.isnan(x) & np.isnan(y))


def _named_nodes(context: LintContext) -> Mask:
    """Return a mask of the nodes that anything but an element refers to, also in lines whose form is not public."""
    scene = context.scene
    numbers: set[int] = set()
    for _, _, block, lines in context.once(_with_lines):
        if not isinstance(block, Opaque):
            if block.facts.defines in ("nodes", "elements"):
                continue
            if Names.NODE in kinds_of(type(block), "names"):
                numbers.update(ident for _, ident in idents_given(block, Names.NODE) if isinstance(ident, int))
        for word in (word for line in lines for word in line.replace("=", ",").split(",")):
            value = read_number(word.strip())
            if value is not None and value.is_integer() and abs(value) < 2**53:
                numbers.add(int(value))
    named = np.zeros(len(scene.node_ids), dtype=np.bool_)
    indices = scene.nodes.indices(np.array(sorted(numbers), dtype=np.int64)) if numbers else np.zeros(0, np.intp)
    named[indices[indices >= 0]] = True
    for line in scene.held:  # those of a GEN= among them
        named[line.nodes] = True
    return named


# ------------------------------------------------------------------------------------------------------- cables


@rule(GEO011)
def short_cable(context: LintContext) -> Iterator[Problem]:
    """A cable is shorter than the distance between the nodes at its ends.

    A cable hangs between its two nodes, so it is at least as long as the straight line. Its length does not fit a
    coordinate of its ends. Correct one of them.

    Example:
         $MODEL
         *NODE
          1, 0.0, 0.0
          41, 300.0, 400.0
         *CABLE
        - 1, 1, 41, 450.0
        + 1, 1, 41, 565.6

    Finds: 6:12
    """
    scene = context.scene
    for where, block in context.blocks("CABLE"):
        for index, cable in enumerate(cast("Cables", block).cables):
            ends = np.array([end for end in (cable.start, cable.end) if isinstance(end, int)], dtype=np.int64)
            places = scene.nodes.indices(ends)
            if len(places) < 2 or (places < 0).any():
                continue
            distance = float(np.linalg.norm(scene.coordinates[places[1]] - scene.coordinates[places[0]]))
            length = number(cable, "length")
            if length < distance * (1.0 - _ROUNDED):
                message = f"the cable is {length:g} long and its ends lie {distance:g} apart: correct one of them"
                yield Problem(GEO011, message, where=where.inside("cables", index, "length"))


@rule(GEO012)
def node_beyond_cable(context: LintContext) -> Iterator[Problem]:
    """A node lies farther along a cable than the cable is long.

    The distance of *NODE,CURVILINEAR counts from the start of the cable. Correct the distance, the number of the cable,
    or its length.

    Example:
         $MODEL
         *NODE
          1, 0.0, 0.0
          41, 300.0, 400.0
         *CABLE
          1, 1, 41, 565.6
         *NODE,CURVILINEAR
        - 2, 1, 600.0
        + 2, 1, 14.1

    Finds: 8:8
    """
    cables = (cable for _, block in context.blocks("CABLE") for cable in cast("Cables", block).cables)
    lengths = {float(cable.cable): number(cable, "length") for cable in cables if isinstance(cable.cable, int)}
    for where, block in context.blocks("NODE,CURVILINEAR"):
        for index, entry in enumerate(cast("CurvilinearNodes", block).entries):
            table = getattr(entry, "nodes", None)
            rows = [] if table is None or table.values.shape[1] < len(_OF_CABLE) else table.values.tolist()
            for row, (_, cable, distance) in enumerate(rows):
                length = lengths.get(cable, math.nan)
                if distance > length * (1.0 + _ROUNDED):
                    message = f"the node lies {distance:g} along a cable {length:g} long: correct one of them"
                    yield Problem(GEO012, message, where=where.inside("entries", index, "nodes", row, 2))

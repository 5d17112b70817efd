"""Overlaps of what elements and nodes are given: sections, coefficients, conditions; two elements in one place."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from mudline.checks.context import LintContext, entries_of_sets
from mudline.checks.rules.geometry import without_sections
from mudline.checks.rules.seabed_overlaps import overlaps, within
from mudline.checks.rules.seabed_position import first_of
from mudline.language.diagnostics import Code, Problem, Severity, Span, Where
from mudline.language.keywords import catalogue
from mudline.language.keywords.naming import is_name
from mudline.language.keywords.text import shown
from mudline.language.rules import rule
from mudline.language.syntax.fields import read_line
from mudline.language.syntax.rows import read_number
from mudline.model.scene.boundary import held_nodes
from mudline.model.scene.numbering import Indices
from mudline.model.scene.references import KEYWORD
from mudline.model.scene.unread_lines import is_of_vessels, unread_lines

GEO013 = Code("GEO013", "overlapping-properties", Severity.INFO)
GEO014 = Code("GEO014", "parallel-elements", Severity.WARNING)
BND001 = Code("BND001", "held-twice", Severity.WARNING)
BND002 = Code("BND002", "constant-and-vessel", Severity.WARNING)


@rule(GEO013)
def overlapping_properties(context: LintContext) -> Iterator[Problem]:
    """Elements have two sections, or two lines of coefficients, from two sets that overlap in part.

    The later line holds for the elements that both sets have. A set that refines a larger one given before it is usual,
    and not reported; sets that overlap in part are mostly a wrong end of a range. Correct the sets. A set that is given
    twice is reported as REF022, and seabed properties as SBD008.

    Example on sets:
          SET=Riser
        + 1, 2
        - GEN=1, 3
          SET=Flowline
          GEN=3, 4
        |*GEOMETRIC SETS
        | OPTION=RIGID
        | SET=Riser
        | 207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0
        | SET=Flowline
        | 207.0E9, 79.6E9, 0.3239, 0.2731, 7850.0

    Finds: 18:6
    """
    scene = context.scene
    count = len(scene.element_ids)
    blocks = scene.deck.blocks_with("gives")
    reported: dict[frozenset[str], tuple[str, Where, list[str]]] = {}
    for keyword in dict.fromkeys(block.keyword for _, block in blocks):
        places = [(where, scene.set_table.find(entry.set_name)) for where, entry in _named(context, keyword)]
        known = [(where, set_) for where, set_ in places if set_ is not None and set_.elements.size]
        for earlier, later, elements in overlaps([set_ for _, set_ in known], count):
            first, (where, second) = known[earlier][1], known[later]
            if within(first, second, count) or within(second, first, count) or first.open or second.open:
                continue
            which = first_of("element", scene.element_ids[elements.min()], elements.size)
            words = f"{which} the values of SET={shown(first.name)}: this line holds for them"
            pair = frozenset((first.name, second.name))
            reported.setdefault(pair, (words, where.inside("set"), []))[2].append(f"*{keyword}")
    for words, where, keywords in reported.values():
        also = f"{' and '.join(dict.fromkeys(keywords))} also give{'s' * (len(set(keywords)) == 1)}"
        yield Problem(GEO013, f"{also} {words}; correct the sets, if that is not meant", where=where)


@rule(GEO014)
def parallel_elements(context: LintContext) -> Iterator[Problem]:
    """Two elements lie between the same two nodes.

    Their stiffness, weight and drag add up. Springs, hinges and flex joints next to a pipe are left out. A second pipe
    is mostly a copied line of *ELEMENT, or has a wrong node number. Correct the nodes, or remove one of the elements.

    Example on held:
          GEN=1, 2
        - 3, 2, 1

    Finds: 9:2
    """
    scene = context.scene
    ends = scene.element_nodes
    joins = (ends[:, 0] >= 0) & (ends[:, 1] >= 0) & (ends[:, 0] != ends[:, 1])
    pairs = ends.min(axis=1) * len(scene.node_ids) + ends.max(axis=1)
    if np.diff(np.sort(pairs[joins])).all() or _has_unread_joints(context):
        return
    usable = np.flatnonzero(joins & ~without_sections(scene))
    _, firsts, same = np.unique(pairs[usable], return_index=True, return_inverse=True)
    twice = np.flatnonzero(firsts[same] != np.arange(len(usable)))
    if twice.size:
        first, second = usable[firsts[same[twice[0]]]], usable[twice[0]]
        which = first_of("element", scene.element_ids[second], twice.size)
        message = f"{which} between nodes that element {scene.element_ids[first]} joins already: correct the nodes, or"
        yield Problem(GEO014, f"{message} remove one", where=scene.table.numbered.where(int(second)))


def _has_unread_joints(context: LintContext) -> bool:
    unread = (keyword for keyword in context.keywords if catalogue.declared(keyword) is None)
    return any(map(catalogue.may_have_no_length, unread))


@rule(BND001)
def held_twice(context: LintContext) -> Iterator[Problem]:
    """A degree of freedom of a node is held twice.

    If the two values differ, one of them has no effect, and the language does not say which: a warning. The same value
    twice is an info. Remove one of the lines, or correct the node or the degree of freedom.

    Example on held:
          1, 1
        - 1, 1, 0.5
          3, 1

    Finds: 13:5
    """
    scene = context.scene
    lines = [line for line in held_nodes(scene) if line.where.section < len(context.deck.own_sections)]
    holders: dict[tuple[int, int], Indices] = {}
    for number, line in enumerate(lines):
        holder = holders.setdefault((line.where.section, line.dof), np.full(len(scene.node_ids), -1))
        again = line.nodes[holder[line.nodes] >= 0]
        if again.size:
            same = all(lines[earlier].how == line.how for earlier in set(holder[again].tolist()))
            before = lines[int(holder[again[0]])].how[0]
            values = "in the same way" if same else f"at {before}, and at {line.how[0]} here"
            node = first_of("node", scene.node_ids[again[0]], again.size)
            message = f"degree of freedom {line.dof} of {node} is held above {values}"
            severity = Severity.INFO if same else None
            yield Problem(BND001, f"{message}: remove one of the lines, or correct it", None, severity, line.where)
        holder[line.nodes] = number


@rule(BND002)
def constant_and_vessel(context: LintContext) -> Iterator[Problem]:
    """A node is held in place and follows a vessel in the same degree of freedom.

    It cannot do both, and the manual forbids it: a run stops, or one of the conditions has no effect. Remove one of
        them, or correct the node. The form of lines of TYPE=VESSEL is not public. A line with only a node and a vessel
        is taken to prescribe all degrees of freedom (inferred).

    Example:
         $MODEL
         *NODE
          1, 480.0, 0.0
          2, 490.0, 0.0
         *ELEMENT
          1, 1, 2
         *VESSEL
          VESSEL=Barge
          INITIAL POSITION=500.0, 0.0, 0.0
         $LOAD CASE
         *BOUNDARY
          TYPE=CONSTANT
          1, 1
          TYPE=VESSEL
        - 1, Barge
        + 2, Barge

    Finds: 15:2
    """
    scene = context.scene
    follows = any(is_of_vessels(context.deck, where) for where, _ in context.written(KEYWORD, "LOAD CASE"))
    held = list(held_nodes(scene)) if follows else []
    for where, keyword, line in unread_lines(scene.context) if held else ():
        if keyword != KEYWORD or not is_of_vessels(context.deck, where):
            continue
        first, *others = read_line(line, Span(0, len(line))).groups[0].fields
        node = read_number(first.text)
        if node is None or not node.is_integer():
            continue
        index = scene.nodes.indices(np.array([int(node)]))[0]
        here = (line_held for line_held in held if line_held.where.section == where.section)
        freedoms = {line_held.dof for line_held in here if index >= 0 and (line_held.nodes == index).any()}
        values = (read_number(field.text) for field in others)
        moved = {int(value) for value in values if value is not None} or freedoms
        both = sorted(freedoms & moved)
        if both:
            message = f"node {first.text} follows a vessel, and TYPE=CONSTANT holds it in degree of freedom {both[0]}"
            yield Problem(BND002, f"{message}: remove one of the two (inferred)", where=where.inside(*first.span))


def _named(context: LintContext, keyword: str) -> Iterator[tuple[Where, Any]]:
    return ((where, entry) for where, entry in entries_of_sets(context.blocks(keyword)) if is_name(entry.set_name))

"""Coordinates that do not fit those of the neighbours: mistyped nodes and elements, decimal commas."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from itertools import chain
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.checks.context import LintContext
from mudline.checks.rules.seabed_position import bounds_of, depths
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import Code, Problem, Severity, Where
from mudline.model.scene.deck_values import LENGTH_UNIT as METRES
from mudline.model.scene.deck_values import number
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Floats, Indices, Mask, blocks_of

if TYPE_CHECKING:
    from mudline.language.keywords.library.mesh import Nodes
    from mudline.language.keywords.table import Table

UNT006 = Code("UNT006", "suspicious-length", Severity.WARNING)

LONGEST_ELEMENT = 25.0
"""Times as long as the longer neighbour: meshes are graded in smaller steps."""
LONGEST_SKIP, AROUND = 5.0, 1.2
"""Likewise, of an element that leaves out a node at which the next one begins; the way by that node to its own way."""
TURNED = -0.985
"""Cosine between two elements of a line that runs back over itself, to 10 degrees."""
HIGHEST, HIGHEST_IN_USER_UNITS = 3.0, 10.0
"""Water depths that a model may be high."""
TALLEST = 500.0
"""m that a model may rise above the sea, as no wind turbine does."""
BETTER = 3.0
"""Times as far from its neighbours that a node with two halves of a number is as with the number."""
COMMA_ROWS = 1000
"""Rows of a table in which decimal commas are looked for."""

_HALVES = r"([-+]?[0-9]+),([0-9]+)"


def odd_coordinates(context: LintContext) -> Iterator[Problem]:
    """What UNT006 finds in nodes and elements."""
    scene = context.scene
    least, most = np.minimum.reduce(scene.length, initial=1.0), np.maximum.reduce(scene.length, initial=0.0)
    even = most <= LONGEST_ELEMENT * least  # not so where a length is not known
    far = {} if even else dict(_far_nodes(scene))
    return chain(
        () if even else _elements(scene, far), _turning_back(scene, far), _skipping(scene), _decimal_commas(context)
    )


def _elements(scene: Scene, far: Mapping[int, float]) -> Iterator[Problem]:
    for element, ratio in _longest_of_neighbours(scene):
        message = (
            f"element {scene.element_ids[element]} is {scene.length[element]:.4g} long, {ratio:.3g} times as long as "
            "the longer of its neighbours: correct the coordinates of its nodes"
        )
        yield Problem(UNT006, message, where=scene.table.numbered.where(element))

    for node, ratio in far.items():
        message = (
            f"node {scene.node_ids[node]} is {ratio:.3g} times as far from both of its neighbours as these are from "
            "theirs: correct its coordinates"
        )
        yield Problem(UNT006, message, where=scene.nodes.where(node))


def _beside(scene: Scene) -> tuple[Indices, Indices]:
    """Elements (k,) whose length is known and above 0, and the longest other one (m, 2) at each end of all; else -1."""
    ends, length = scene.element_nodes, scene.length
    usable = np.flatnonzero((ends >= 0).all(axis=1) & np.isfinite(length) & (length > 0.0))
    order = usable[np.argsort(length[usable], kind="stable")]
    nodes, elements = ends[order].ravel(), np.repeat(order, 2)
    by_node = np.argsort(nodes, kind="stable")  # of one node the longest element comes last
    nodes, elements = nodes[by_node], elements[by_node]
    last = np.flatnonzero(np.append(nodes[1:] != nodes[:-1], np.ones(min(len(nodes), 1), np.bool_)))
    longest, second = np.full((2, len(scene.node_ids)), -1, dtype=np.intp)
    longest[nodes[last]] = elements[last]
    shared = last[(last > 0) & (nodes[last - 1] == nodes[last])]
    second[nodes[shared]] = elements[shared - 1]
    found, of_usable = np.full(ends.shape, -1, dtype=np.intp), ends[usable]
    found[usable] = np.where(longest[of_usable] == usable[:, None], second[of_usable], longest[of_usable])
    return usable, found


def _far_nodes(scene: Scene) -> Iterator[tuple[int, float]]:
    """Index of each node between two elements that are both over 25 times as long as those beyond them, and how many.

    All four must be of one section, and no other element may end at one of their nodes.
    """
    ends, length, sections = scene.element_nodes, scene.length, scene.section_table.of_element
    usable, beside = _beside(scene)
    one, side = np.repeat(usable, 2), np.tile([0, 1], len(usable))
    middle, other = ends[one, side], beside[one, side]
    one, side, middle, other = (values[one < other] for values in (one, side, middle, other))
    turned = np.where(ends[other, 1] == middle, 1, 0)
    outer = np.column_stack([ends[one, 1 - side], ends[other, 1 - turned]])
    beyond = np.column_stack([beside[one, 1 - side], beside[other, 1 - turned]])
    alike = (_uses(scene)[np.column_stack([middle, outer])] == 2).all(axis=1) & (beyond >= 0).all(axis=1)
    alike &= (sections[np.column_stack([other, beyond])] == sections[one][:, None]).all(axis=1)
    shorter = np.minimum(length[one], length[other])
    alike &= np.linalg.norm(np.diff(scene.coordinates[outer], axis=1)[:, 0], axis=1) < shorter  # else the line goes on
    ratios = shorter[alike] / length[beyond[alike]].max(axis=1, initial=0.0)
    odd = ratios > LONGEST_ELEMENT
    yield from zip(middle[alike][odd].tolist(), ratios[odd].tolist(), strict=True)


def _longest_of_neighbours(scene: Scene) -> Iterator[tuple[int, float]]:
    """Index of each element that is over 25 times as long as any neighbour, at both ends, and how many times it is.

    All must be of one section, so that a tether or a rigid link beside a finely meshed pipe is not reported.
    """
    sections = scene.section_table.of_element
    usable, beside = _beside(scene)
    found = usable[(beside[usable] >= 0).all(axis=1)]
    ratios = scene.length[found] / scene.length[beside[found]].max(axis=1, initial=0.0)
    odd = (sections[beside[found]] == sections[found][:, None]).all(axis=1) & (ratios > LONGEST_ELEMENT)
    yield from zip(found[odd].tolist(), ratios[odd].tolist(), strict=True)


# ------------------------------------------------------------------------------------------- chains of elements


def _turning_back(scene: Scene, far: Mapping[int, float]) -> Iterator[Problem]:
    """Nodes at which a line turns back, and forward again at the next one or not; nothing else ends at these nodes.

    Nodes that are `far` from their neighbours are reported as such.
    """
    turns = [element for block in blocks_of(max(len(scene.element_nodes) - 1, 0)) for element in _turned(scene, block)]
    if not turns:
        return
    used, ids, sections = _uses(scene), scene.node_ids, scene.section_table.of_element
    told = -1
    for element in turns:
        one, other = scene.element_nodes[element].tolist()
        if used[one] != 2 or one in far or element == told:
            continue
        message = f"the line turns back at node {ids[one]}, as no pipe bends: correct the coordinates beside it"
        if element + 1 in turns:
            told = element + 1
            if used[other] != 2 or other in far or len(set(sections[element - 1 : element + 2].tolist())) > 1:
                continue
            message = (
                f"the line turns back at node {ids[one]} and forward again at node {ids[other]}: correct the "
                "coordinates of one of them"
            )
        yield Problem(UNT006, message, where=scene.nodes.where(one))


def _turned(scene: Scene, block: slice) -> list[int]:
    """Elements that run back over the one before them, which is of the block."""
    ends = scene.element_nodes[block.start : block.stop + 1]
    if _goes_forward(scene, ends):
        return []
    joined = (ends[:-1, 1] == ends[1:, 0]) & (ends[:-1] >= 0).all(axis=1) & (ends[1:] >= 0).all(axis=1)
    if not joined.any():
        return []
    steps = _directions(scene, ends)
    found: list[int] = (
        np.flatnonzero(joined & (np.sum(steps[:-1] * steps[1:], axis=1) < TURNED)) + 1 + block.start
    ).tolist()
    return found


def _goes_forward(scene: Scene, ends: Indices) -> bool:
    """Whether all of these elements have less than a right angle to the next one, as those of most lines have."""
    if not len(scene.coordinates):
        return False
    with np.errstate(all="ignore"):
        start, end = scene.coordinates.take(ends.T, axis=0)  # `take` takes a fifth of the time of an index
        steps = end - start
        return bool(np.minimum.reduce(np.add.reduce(steps[:-1] * steps[1:], axis=1)) > 0.0)


def _directions(scene: Scene, ends: Indices) -> Floats:
    """Unit vectors along elements with these nodes; NaN for one without length, or with one that is not finite."""
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        steps = scene.coordinates[ends[:, 1]] - scene.coordinates[ends[:, 0]]
        length = np.linalg.norm(steps, axis=1)[:, np.newaxis]  # 0 also where its square is too small for a number
        found: Floats = steps / np.where(length > 0.0, length, np.nan)
    return found


def _uses(scene: Scene) -> Indices:
    """How many elements end at each node."""
    ends = scene.element_nodes
    return np.bincount(ends[ends >= 0].ravel(), minlength=len(scene.node_ids))


def _skipping(scene: Scene) -> Iterator[Problem]:
    """Elements that end at a node further on, where the next one begins at a node at which nothing else ends."""
    ends, sections = scene.element_nodes, scene.section_table.of_element
    parts = []
    for block in blocks_of(max(len(ends) - 2, 0)):
        of_three, alike = ends[block.start : block.stop + 2], sections[block.start : block.stop + 2]
        if not np.count_nonzero(of_three[1:, 0] != of_three[:-1, 1]):
            continue  # each begins where the one before it ends
        before, here, behind = of_three[:-2], of_three[1:-1], of_three[2:]
        apart: Mask = (before[:, 1] == here[:, 0]) & (here[:, 1] != behind[:, 0])
        apart &= (before >= 0).all(axis=1) & (here >= 0).all(axis=1) & (behind >= 0).all(axis=1)
        apart &= (alike[:-2] == alike[1:-1]) & (alike[1:-1] == alike[2:])
        parts.append(np.flatnonzero(apart) + 1 + block.start)
    found = np.concatenate(parts) if parts else np.zeros(0, np.intp)
    if not found.size:
        return
    used = _uses(scene)
    found = found[(used[ends[found + 1, 0]] == 1) & (used[ends[found, 1]] >= 3)]
    places = scene.coordinates
    for element in found.tolist():
        (start, end), (begin, following) = ends[element].tolist(), ends[element + 1].tolist()
        way = float(np.linalg.norm(places[end] - places[start]))
        meant = float(np.linalg.norm(places[begin] - places[start]))
        around = meant + float(np.linalg.norm(places[end] - places[begin]))
        longest = LONGEST_SKIP * max(scene.length[element - 1], scene.length[element + 1])
        if (way > longest >= meant) or (end == following and around <= AROUND * way):
            ids = scene.node_ids
            message = (
                f"element {scene.element_ids[element]} ends at node {ids[end]}, and nothing joins it to node "
                f"{ids[begin]}, where the next element begins: is node {ids[begin]} meant?"
            )
            yield Problem(UNT006, message, where=scene.table.numbered.where(element))


# ------------------------------------------------------------------------------------------- decimal commas


def _decimal_commas(context: LintContext) -> Iterator[Problem]:
    """Rows of nodes with the halves of a number in two fields: one finding for each table."""
    text = context.text
    if text is None:
        return
    for where, block in context.written("NODE"):
        for index, entry in enumerate(cast("Nodes", block).entries):
            if not hasattr(entry, "nodes"):
                continue
            found = _split_rows(text, entry.nodes, where.inside("entries", index, "nodes"))
            if found:
                place, names, halves = found[0]
                message = f"decimal comma? {halves} is two fields here, {names}: write {halves.replace(',', '.')}"
                more = f"; so in {len(found)} rows of this block" if len(found) > 1 else ""
                yield Problem(UNT006, f"{message}{more}", where=place)


def _split_rows(text: TextOrigin, table: Table, where: Where) -> list[tuple[Where, str, str]]:
    """Places of the rows of a table of nodes that seem to hold a number in two fields, with its columns and halves."""
    values = table.values
    if values.shape[1] < 4:
        return []
    whole = np.isfinite(values) & (values == np.round(values))
    full = table.lengths == 4
    pairs = np.any(whole[:, 1:3] & whole[:, 2:4] & (values[:, 2:4] >= 0.0), axis=1) & full
    few = int(np.count_nonzero(full)) <= 0.5 * len(full)
    found: list[tuple[Where, str, str]] = []
    for row in np.flatnonzero(pairs)[:COMMA_ROWS].tolist():
        fields = _fields(text, where.inside(row))
        for column, names in ((1, "x and y"), (2, "y and z")) if len(fields) == 4 else ():
            halves = ",".join(fields[column : column + 2])
            if not re.fullmatch(_HALVES, halves):
                continue
            beside = [other for other in (row - 1, row + 1) if 0 <= other < len(table) and table.lengths[other] == 3]
            pointed = all(field.count(".") for other in beside for field in _fields(text, where.inside(other))[1:])
            number = float(halves.replace(",", "."))
            others = fields[: column + 1] + fields[column + 2 :]
            padded = any(map(_begins_with_zero, others))  # whole numbers with zeros in front, as programs write them
            if (_begins_with_zero(fields[column + 1]) and not padded) or (
                few and beside and _fits(table, row, column, number, beside, times=1.0 if pointed else BETTER)
            ):
                found.append((where.inside(row), names, halves))
                break
    return found


def _fields(text: TextOrigin, place: Where) -> list[str]:
    """The fields of a row as they are written."""
    span = text.span(place)
    return [] if span is None else [field.strip() for field in text.source.unified[slice(*span)].split(",")]


def _begins_with_zero(field: str) -> bool:
    return re.match("[-+]?0[0-9]", field) is not None


def _fits(table: Table, row: int, column: int, number: float, beside: list[int], *, times: float) -> bool:
    """Whether a node is that many times nearer to those of the rows beside it if two of its values are one number."""
    values = table.values
    meant = [number, values[row, 3]] if column == 1 else [values[row, 1], number]
    neighbours = np.array([[*values[other, 1:3], 0.0] for other in beside])
    written, corrected = (
        float(np.linalg.norm(neighbours - at, axis=1).sum()) for at in (values[row, 1:4], np.array([*meant, 0.0]))
    )
    return written > times * corrected


def height_over_depth(context: LintContext) -> Iterator[Problem]:
    """What UNT006 finds in the water depth, against the heights of nodes.

    Unless all of them lie above the sea, which GEO005 reports.
    """
    scene, oceans = context.scene, context.blocks("OCEAN")
    if not oceans or not len(scene.node_ids):
        return
    where, depth = oceans[-1][0], number(oceans[-1][1], "depth")
    bounds, metres = context.once(bounds_of), METRES.get(scene.units)
    height = bounds.highest
    above_sea = (height - depth) * (metres or math.inf)
    if not 0.0 < depth < math.inf or -bounds.deepest > depth or not height < math.inf:
        return
    if height > (HIGHEST if metres else HIGHEST_IN_USER_UNITS) * depth and above_sea > TALLEST:
        highest = scene.node_ids[context.once(depths).argmin()]
        message = (
            f"node {highest} lies {height:.5g} high in water {depth!r} deep, expected "
            "little more than the depth: write both in one unit (km, feet or mm?), and heights as X"
        )
        yield Problem(UNT006, message, where=where.inside("depth"))

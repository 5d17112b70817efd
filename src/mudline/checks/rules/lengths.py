"""Lengths and coordinates that do not fit each other: nodes, elements, cables, decimal commas, curves over lengths."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from itertools import chain

import numpy as np

from mudline.checks.context import LintContext
from mudline.checks.rules.curve_points import LARGEST_RATIO
from mudline.checks.rules.seabed_position import UNT006, height_over_depth
from mudline.checks.rules.unusual import of_code
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import Code, Problem, Severity, Where
from mudline.language.keywords.table import Table
from mudline.language.rules import rule
from mudline.model.scene.context import records_of
from mudline.model.scene.curves import SceneCurve
from mudline.model.scene.deck_values import number
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Floats, Indices, Mask, blocks_of, looked_up

GEO011 = Code("GEO011", "short-cable", Severity.WARNING)
GEO012 = Code("GEO012", "node-beyond-cable", Severity.WARNING)

LONGEST_ELEMENT = 25.0
"""Ratio of an element's length to its longer neighbour's, at most: meshes are graded in smaller steps."""
LONGEST_SKIP, AROUND = 5.0, 1.2
"""Limits for an element that skips a node at which the next element begins.

LONGEST_SKIP: ratio of its length to its longer neighbour's.
AROUND: ratio of the distance through the skipped node to its length.
"""
TURNED = -0.985
"""Cosine of the angle between two elements of a line that runs back over itself, to within 10 degrees."""
BETTER = 3.0
"""Ratio of distances to the neighbours, without and with the decimal comma, above which the comma is assumed."""
COMMA_ROWS = 1000
"""Number of rows of a table in which decimal commas are looked for."""
_HALVES = r"([-+]?[0-9]+),([0-9]+)"
FEWEST_POINTS, MOST_ROUND, ROUNDING = 3, 0.5, 1e-3
"""Limits for a curve that seems to be given over metres.

FEWEST_POINTS: number of points.
MOST_ROUND: share of its points whose ratios may be round numbers.
ROUNDING: relative rounding of a depth.
"""
_ROUNDED = 1e-6
"""Relative rounding of a length."""


@rule(UNT006)
def suspicious_length(context: LintContext) -> Iterator[Problem]:
    """A length does not fit the pipe: millimetres, inches, or a wall thickness in place of a diameter.

    Reported are, each with the likely unit:

    * an external diameter above 60 m (a spar hull of 37 m is legal); one above 2 m with the wall of a steel pipe, at
      least 90 mm and a 6th to a 50th of the diameter; one of a FLEXIBLE, MOORING or TRUSS section whose mass is below
      10 % or above 30 times that of the water that it displaces (0 and powers of ten are placeholders);
    * a drag or buoyancy diameter above 25 times the external one, 11.5 times in RIGID; an external one above 8 times
      both;
    * an internal diameter below a tenth of the external one in a steel pipe up to 2.5 m wide: the wall thickness;
    * a mobilisation length above 10 diameters and above 10 ft, the usual characteristic length;
    * a force-embedment curve with three points or more whose ratios become round numbers when divided by the diameter;
    * an element over 25 times as long as each of the neighbours at its two ends, all of one section; a node that is
      so far from both of its neighbours; a node at which a line turns back, as no pipe bends; an
      element that leaves out a node at which the next one begins, and ends where the line goes on;
    * a node row with one value more than the others, which fits its neighbours if two of them are a decimal comma;
    * nodes over three times as high above the seabed as the water is deep, and over 500 m above the sea.

    In user units whose *OCEAN does not tell them only ratios are checked: masses against displaced water, bores of
    walls as dense as steel, mobilisation lengths above 100 diameters, curves, elements, and nodes above ten depths.

    Example on pipe:
        - 207.0E9, 79.6E9, 323.9, 288.9, 7850.0
        + 207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0

    Finds: 12:19
    """
    yield from of_code(context, UNT006)
    for kind in (curves_over_lengths, odd_coordinates, height_over_depth):
        yield from kind(context)


def odd_coordinates(context: LintContext) -> Iterator[Problem]:
    """Yield the problems of UNT006 in nodes and elements."""
    scene = context.scene
    least, most = np.minimum.reduce(scene.length, initial=1.0), np.maximum.reduce(scene.length, initial=0.0)
    even = most <= LONGEST_ELEMENT * least  # not so where a length is not known; this saves much memory
    far = {} if even else dict(_far_nodes(scene))
    odd = () if even else _elements(scene, far)
    return chain(odd, _turning_back(scene, far), _skipping(scene), _decimal_commas(context))


def _elements(scene: Scene, far: Mapping[int, float]) -> Iterator[Problem]:
    """Yield elements that are over 25 times as long as their neighbours at both ends, and nodes too `far` from both."""
    sections = scene.section_table.of_element
    usable, beside = _beside(scene)
    inner = usable[(beside[usable] >= 0).all(axis=1)]
    ratios = scene.length[inner] / scene.length[beside[inner]].max(axis=1, initial=0.0)
    # All of them have one section: a tether or a rigid link next to a finely meshed pipe is not reported.
    odd = (sections[beside[inner]] == sections[inner][:, None]).all(axis=1) & (ratios > LONGEST_ELEMENT)
    for element, ratio in zip(inner[odd].tolist(), ratios[odd].tolist(), strict=True):
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
    """Return the elements (k,) of known length above 0, and the longest neighbour (m, 2) at each end of every element.

    A neighbour is an index of an element, -1 where there is none.
    """
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
    neighbours, of_usable = np.full(ends.shape, -1, dtype=np.intp), ends[usable]
    neighbours[usable] = np.where(longest[of_usable] == usable[:, None], second[of_usable], longest[of_usable])
    return usable, neighbours


def _far_nodes(scene: Scene) -> Iterator[tuple[int, float]]:
    """Yield the index of each node that lies too far from both neighbours, with the ratio of lengths.

    Both of its elements are over 25 times as long as those beyond them. All four elements must have one section, and no
    further element may end at one of their nodes.
    """
    ends, length, sections = scene.element_nodes, scene.length, scene.section_table.of_element
    usable, beside = _beside(scene)
    here, side = np.repeat(usable, 2), np.tile([0, 1], len(usable))
    middle, there = ends[here, side], beside[here, side]
    here, side, middle, there = (values[here < there] for values in (here, side, middle, there))
    turned = np.where(ends[there, 1] == middle, 1, 0)
    outer = np.column_stack([ends[here, 1 - side], ends[there, 1 - turned]])
    beyond = np.column_stack([beside[here, 1 - side], beside[there, 1 - turned]])
    alike = (_uses(scene)[np.column_stack([middle, outer])] == 2).all(axis=1) & (beyond >= 0).all(axis=1)
    alike &= (sections[np.column_stack([there, beyond])] == sections[here][:, None]).all(axis=1)
    shorter = np.minimum(length[here], length[there])
    alike &= np.linalg.norm(np.diff(scene.coordinates[outer], axis=1)[:, 0], axis=1) < shorter  # else the line goes on
    ratios = shorter[alike] / length[beyond[alike]].max(axis=1, initial=0.0)
    odd = ratios > LONGEST_ELEMENT
    yield from zip(middle[alike][odd].tolist(), ratios[odd].tolist(), strict=True)


# ------------------------------------------------------------------------------------------- chains of elements


def _turning_back(scene: Scene, far: Mapping[int, float]) -> Iterator[Problem]:
    """Yield problems at nodes where a line turns back, and perhaps forward again at the next node.

    Nodes at which a further element ends are left out. So are nodes `far` from their neighbours, which `_elements`
    reports.
    """
    turns = [element for block in blocks_of(max(len(scene.element_nodes) - 1, 0)) for element in _turned(scene, block)]
    if not turns:
        return
    used, ids, sections = _uses(scene), scene.node_ids, scene.section_table.of_element
    reported = -1
    for element in turns:
        first, second = scene.element_nodes[element].tolist()
        if used[first] != 2 or first in far or element == reported:
            continue
        message = f"the line turns back at node {ids[first]}, as no pipe bends: correct the coordinates beside it"
        if element + 1 in turns:
            reported = element + 1
            if used[second] != 2 or second in far or len(set(sections[element - 1 : element + 2].tolist())) > 1:
                continue
            message = (
                f"the line turns back at node {ids[first]} and forward again at node {ids[second]}: correct the "
                "coordinates of one of them"
            )
        yield Problem(UNT006, message, where=scene.nodes.where(first))


def _turned(scene: Scene, block: slice) -> list[int]:
    """Return the elements that run back over the element before them, which lies in the block."""
    ends = scene.element_nodes[block.start : block.stop + 1]
    joined = (ends[:-1, 1] == ends[1:, 0]) & (ends[:-1] >= 0).all(axis=1) & (ends[1:] >= 0).all(axis=1)
    if not joined.any():
        return []
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        steps = scene.coordinates.take(ends[:, 1], axis=0) - scene.coordinates.take(ends[:, 0], axis=0)
        length = np.linalg.norm(steps, axis=1)[:, np.newaxis]  # 0 also where its square is too small for a number
        steps /= np.where(length > 0.0, length, np.nan)
    turned = joined & (np.sum(steps[:-1] * steps[1:], axis=1) < TURNED)
    return [int(at) + 1 + block.start for at in np.flatnonzero(turned)]


def _uses(scene: Scene) -> Indices:
    """Return the number of elements (n,) that end at each node."""
    ends = scene.element_nodes
    return np.bincount(ends[ends >= 0].ravel(), minlength=len(scene.node_ids))


def _skipping(scene: Scene) -> Iterator[Problem]:
    """Yield problems at elements that end one node too far: nothing ends at the node where the next element begins."""
    ends, sections = scene.element_nodes, scene.section_table.of_element
    parts = []
    for block in blocks_of(max(len(ends) - 2, 0)):
        of_three, alike = ends[block.start : block.stop + 2], sections[block.start : block.stop + 2]
        before, here, behind = of_three[:-2], of_three[1:-1], of_three[2:]
        apart: Mask = (before[:, 1] == here[:, 0]) & (here[:, 1] != behind[:, 0])
        apart &= (before >= 0).all(axis=1) & (here >= 0).all(axis=1) & (behind >= 0).all(axis=1)
        apart &= (alike[:-2] == alike[1:-1]) & (alike[1:-1] == alike[2:])
        parts.append(np.flatnonzero(apart) + 1 + block.start)
    skipping = np.concatenate(parts) if parts else np.zeros(0, np.intp)
    if not skipping.size:
        return
    used = _uses(scene)
    skipping = skipping[(used[ends[skipping + 1, 0]] == 1) & (used[ends[skipping, 1]] >= 3)]
    places = scene.coordinates
    for element in skipping.tolist():
        (start, end), (begin, following) = ends[element].tolist(), ends[element + 1].tolist()
        length = float(np.linalg.norm(places[end] - places[start]))
        direct = float(np.linalg.norm(places[begin] - places[start]))
        around = direct + float(np.linalg.norm(places[end] - places[begin]))
        longest = LONGEST_SKIP * max(scene.length[element - 1], scene.length[element + 1])
        if (length > longest >= direct) or (end == following and around <= AROUND * length):
            ids = scene.node_ids
            message = (
                f"element {scene.element_ids[element]} ends at node {ids[end]}, and nothing joins it to node "
                f"{ids[begin]}, where the next element begins: is node {ids[begin]} meant?"
            )
            yield Problem(UNT006, message, where=scene.table.numbered.where(element))


# ------------------------------------------------------------------------------------------- decimal commas


def _decimal_commas(context: LintContext) -> Iterator[Problem]:
    """Yield one problem for each table of nodes with rows in which a decimal comma splits a number into two fields."""
    text = context.text
    if text is None:
        return
    for where, entry in records_of(context.written("NODE"), "entries"):
        split = _split_rows(text, entry.nodes, where.inside("nodes")) if hasattr(entry, "nodes") else []
        if split:
            place, names, halves = split[0]
            message = f"decimal comma? {halves} is two fields here, {names}: write {halves.replace(',', '.')}"
            more = f"; so in {len(split)} rows of this block" if len(split) > 1 else ""
            yield Problem(UNT006, f"{message}{more}", where=place)


def _split_rows(text: TextOrigin, table: Table, where: Where) -> list[tuple[Where, str, str]]:
    """Return the rows of a table of nodes that seem to hold a number split by a decimal comma.

    Each row has its place, the names of the two columns, and the number as it is written.
    """
    values = table.values
    if values.shape[1] < 4:
        return []
    whole = np.isfinite(values) & (values == np.round(values))
    full = table.lengths == 4
    pairs = np.any(whole[:, 1:3] & whole[:, 2:4] & (values[:, 2:4] >= 0.0), axis=1) & full
    few = int(np.count_nonzero(full)) <= 0.5 * len(full)
    split_rows: list[tuple[Where, str, str]] = []
    for row in np.flatnonzero(pairs)[:COMMA_ROWS].tolist():
        fields = _fields(text, where.inside(row))
        for column, names in ((1, "x and y"), (2, "y and z")) if len(fields) == 4 else ():
            halves = ",".join(fields[column : column + 2])
            if not re.fullmatch(_HALVES, halves):
                continue
            beside = [near for near in (row - 1, row + 1) if 0 <= near < len(table) and table.lengths[near] == 3]
            pointed = all(field.count(".") for near in beside for field in _fields(text, where.inside(near))[1:])
            number = float(halves.replace(",", "."))
            others = fields[: column + 1] + fields[column + 2 :]
            padded = any(map(_begins_with_zero, others))  # whole numbers with zeros in front, as programs write them
            if (_begins_with_zero(fields[column + 1]) and not padded) or (
                few and beside and _fits(table, row, column, number, beside, times=1.0 if pointed else BETTER)
            ):
                split_rows.append((where.inside(row), names, halves))
                break
    return split_rows


def _fields(text: TextOrigin, place: Where) -> list[str]:
    """Return the fields of a row as they are written."""
    span = text.span(place)
    return [] if span is None else [field.strip() for field in text.source.unified[slice(*span)].split(",")]


def _begins_with_zero(field: str) -> bool:
    return re.match("[-+]?0[0-9]", field) is not None


def _fits(table: Table, row: int, column: int, number: float, beside: list[int], *, times: float) -> bool:
    """Return True if a node lies closer to its neighbours when two of its fields are read as one number.

    Its distance from the nodes in the rows above and below must be more than `times` smaller.
    """
    values = table.values
    joined = [number, values[row, 3]] if column == 1 else [values[row, 1], number]
    neighbours = np.array([[*values[row_beside, 1:3], 0.0] for row_beside in beside])
    written, corrected = (
        float(np.linalg.norm(neighbours - at, axis=1).sum()) for at in (values[row, 1:4], np.array([*joined, 0.0]))
    )
    return written > times * corrected


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
    for where, cable in context.records("CABLE", "cables"):
        ends = np.array([end for end in (cable.start, cable.end) if isinstance(end, int)], dtype=np.int64)
        places = scene.nodes.indices(ends)
        if len(places) < 2 or (places < 0).any():
            continue
        distance = float(np.linalg.norm(scene.coordinates[places[1]] - scene.coordinates[places[0]]))
        length = number(cable, "length")
        if length < distance * (1.0 - _ROUNDED):
            message = f"the cable is {length:g} long and its ends lie {distance:g} apart: correct one of them"
            yield Problem(GEO011, message, where=where.inside("length"))


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
    cables = (cable for _, cable in context.records("CABLE", "cables") if isinstance(cable.cable, int))
    lengths = {float(cable.cable): number(cable, "length") for cable in cables}
    for where, entry in context.records("NODE,CURVILINEAR", "entries"):
        table = getattr(entry, "nodes", None)
        rows = [] if table is None or table.values.shape[1] < 3 else table.values.tolist()
        for row, (_, cable, distance) in enumerate(rows):
            length = lengths.get(cable, math.nan)
            if distance > length * (1.0 + _ROUNDED):
                message = f"the node lies {distance:g} along a cable {length:g} long: correct one of them"
                yield Problem(GEO012, message, where=where.inside("nodes", row, 2))


# -------------------------------------------------------------------------------------------------------------- curves


def curves_over_lengths(context: LintContext) -> Iterator[Problem]:
    """Yield the problems of UNT006 in curves: depths instead of ratios."""
    for curve, diameter in _in_lengths(context.scene):
        message = (
            f"every ratio of this curve is a round number of diameters of {diameter:.4g} (the last one "
            f"{curve.points[:, 0].max() / diameter:.3g}): if these are depths, write them divided by the diameter"
        )
        yield Problem(UNT006, message, where=curve.where)


def _in_lengths(scene: Scene) -> Iterator[tuple[SceneCurve, float]]:
    """Yield the curves whose ratios all become round numbers when multiplied by the diameter, with the diameter.

    Most of the ratios themselves are not round numbers. All elements on the curve must have one diameter.
    """
    laws = scene.laws
    ratios = {at: curve.points[curve.points[:, 0] != 0.0, 0] for at, curve in enumerate(laws.curves) if curve.usable}
    candidates = {at: each for at, each in ratios.items() if _may_be_lengths(each)}
    if not candidates:
        return
    curve_of_law = np.array([*(grant.curve for grant in laws.set_laws), -1], dtype=np.intp)
    of_element = looked_up(curve_of_law, laws.of_element)
    smallest, largest = np.full(len(laws.curves) + 1, np.inf), np.full(len(laws.curves) + 1, -np.inf)
    with np.errstate(invalid="ignore"):  # an element without a diameter makes both NaN
        np.minimum.at(smallest, of_element, scene.diameter)
        np.maximum.at(largest, of_element, scene.diameter)
    for index, ratios in candidates.items():
        diameter = float(smallest[index])
        if diameter == largest[index] and _is_round(ratios / diameter).all():
            yield laws.curves[index], diameter


def _may_be_lengths(ratios: Floats) -> bool:
    """Return True if most ratios of a curve are not round numbers, and CRV010 reports none of them."""
    usual = len(ratios) >= FEWEST_POINTS and ratios.max() <= LARGEST_RATIO
    return usual and bool(_is_round(ratios).mean() < MOST_ROUND)


def _is_round(values: Floats) -> Mask:
    """Return a mask of the numbers with two significant digits, within the rounding of the deck."""
    with np.errstate(divide="ignore", over="ignore", under="ignore", invalid="ignore"):
        digits = np.abs(values) / 10.0 ** np.floor(np.log10(np.abs(values)))  # inf for the smallest floats
        return np.abs(digits - digits.round(1)) <= ROUNDING * digits

"""Nodes and elements: tables and generators as numbers, coordinates, node indices and lengths."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np

from mudline.basics.limits import MOST_GENERATED, MOST_REPORTED
from mudline.language.codes.references import REF005, REF006, REF007, REF010
from mudline.language.diagnostics import Blocks, Problem, Severity, Where
from mudline.language.keywords.table import LARGEST_WHOLE, Table
from mudline.language.keywords.values import Label
from mudline.model.scene.context import Context
from mudline.model.scene.numbering import (
    DefinitionBatch,
    Definitions,
    Floats,
    Indices,
    Numbered,
    blocks_of,
    first_of,
    whole_numbers,
)

if TYPE_CHECKING:
    from mudline.language.keywords.library.mesh import ElementPattern, ElementRows, Elements, NodeRange, NodeRows, Nodes
    from mudline.model.scene.csv_file import ExternalElements


class _NodeLine(NamedTuple):
    """Nodes between two others, not yet placed."""

    batch: DefinitionBatch
    ends: tuple[int, int]


def read_nodes(context: Context, external: ExternalElements | None = None) -> Numbered:
    """Return the nodes of the model with their coordinates (n, 3); NaN where a coordinate is not known.

    Nodes that only `external` elements name have no coordinates.
    """
    gathered = Definitions()
    waiting: list[_NodeLine] = []
    for where, block in context.blocks("NODE"):
        for index, entry in enumerate(cast("Nodes", block).entries):
            place = where.inside("entries", index)
            if hasattr(entry, "nodes"):
                table = cast("NodeRows", entry).nodes
                coordinates = np.column_stack((table.column(1), table.column(2), table.column(3, default=0.0)))
                for row in _add_rows(gathered, table.column(0), coordinates, place, "nodes"):
                    context.misread("NODE", place.inside("nodes", row, 0))
            elif line := _node_line(context, gathered, entry.generate, place):
                if not _between(gathered, line):
                    waiting.append(line)
                gathered.add(line.batch)
    placeless = {line.batch.where for line in waiting if not _late(context, gathered, line)}
    if external is not None:
        extra = np.unique(external.nodes)
        extra = extra[gathered.resolve(3).indices(extra) < 0]
        gathered.add(DefinitionBatch(extra, np.full((len(extra), 3), np.nan), Where()))
    nodes = gathered.resolve(3)
    repeats = nodes.repeats
    if placeless and repeats.size:  # where a line of nodes ends is not known, nor which numbers it has
        repeats = repeats[[nodes.where_row(row) not in placeless for row in repeats.tolist()]]
    _report_repeats(context, nodes, repeats, "node")
    return nodes


def _add_rows(gathered: Definitions, numbers: Floats, values: Floats, where: Where, table: str) -> list[int]:
    """Add the rows of a table that have a number; return the other rows."""
    ids, known = whole_numbers(numbers)
    rows = known.nonzero()[0]
    gathered.add(DefinitionBatch(ids[rows], values.take(rows, axis=0), where, table, rows))
    unknown: list[int] = (~known).nonzero()[0][: MOST_REPORTED + 1].tolist()
    return unknown


def _node_line(context: Context, gathered: Definitions, range_: NodeRange, where: Where) -> _NodeLine | None:
    place = where.inside("generate")
    numbers = context.generator(range_)
    if numbers is None:
        context.unread.add("NODE")
        return None
    start, end, step = numbers
    count = -1 if step < 1 or end <= start or (end - start) % step else (end - start) // step - 1
    fault = f"GEN={start}, {end}, {step} does not lead from node {start} to node {end}: correct it" if count < 0 else ""
    if gathered.generated > MOST_GENERATED:  # said at the line that went beyond it
        return None
    if count > MOST_GENERATED - gathered.generated:
        gathered.generated += count
        fault = f"GEN={start}, {end}, {step} would make {count} nodes: {_most('nodes')}"
    if fault:
        context.report(REF010, fault, place, Severity.ERROR)
        context.doubtful.setdefault("NODE", []).append((min(start, end), max(start, end)))
        return None
    ids = np.arange(start + step, end, step, dtype=np.int64)
    return _NodeLine(DefinitionBatch(ids, np.full((count, 3), np.nan), place), (start, end))


def _most(objects: str) -> str:
    return f"the GEN= lines of a deck must not make more than {MOST_GENERATED} {objects}, overlaps counted"


def _between(gathered: Definitions, line: _NodeLine) -> bool:
    """Place the nodes of a line if its ends are defined by now; return True if they are.

    They have even distances, exactly if the spacing is a whole number.
    """
    first, last = (gathered.find(number) for number in line.ends)
    if first is None or last is None:
        return False
    count = len(line.batch.ids)
    for block in blocks_of(count):
        steps = np.arange(block.start + 1, block.stop + 1)[:, np.newaxis]
        with np.errstate(over="ignore", invalid="ignore"):
            line.batch.values[block] = first + (last - first) * steps / (count + 1)
    return True


def _late(context: Context, gathered: Definitions, line: _NodeLine) -> bool:
    """Place a line whose ends are defined only after it; return True if they are."""
    where = line.batch.where
    if _between(gathered, line):
        first, last = line.ends
        message = (
            f"GEN= places nodes between two that exist, and node {first} or {last} is defined only after this line: "
            "that definition is taken (inferred); put it first"
        )
        context.report(REF006, message, where, Severity.WARNING)
        return True
    for position, number in enumerate(line.ends):
        if gathered.find(number) is None:
            message = f"GEN= places nodes between two that exist: node {number} is not defined; define it in *NODE"
            context.report_missing(REF006, message, where.inside(position), "NODE", number)
    return False


class MeshElements(NamedTuple):
    """Elements with the indices of their nodes (m, 2), -1 for a node that is not known, and their lengths (m,)."""

    numbered: Numbered
    nodes: Indices
    length: Floats


def read_elements(context: Context, nodes: Numbered, external: ExternalElements | None = None) -> MeshElements:
    """Return the elements of the model, then those of a file, which replace them."""
    gathered = Definitions()
    for where, block in context.blocks("ELEMENT"):
        for index, entry in enumerate(cast("Elements", block).entries):
            place = where.inside("entries", index)
            if hasattr(entry, "elements"):
                table = cast("ElementRows", entry).elements
                _check_labels(context, table, place)
                ends = np.column_stack((table.column(1), table.column(2)))
                for row in _add_rows(gathered, table.column(0), ends, place, "elements"):
                    context.misread("ELEMENT", place.inside("elements", row, 0))
            else:
                _add_pattern(context, gathered, entry.generate, place)
    own = sum(len(batch.ids) for batch in gathered.batches)
    if external is not None:
        gathered.add(DefinitionBatch(external.ids, external.nodes.astype(np.float64), Where()))
    elements = gathered.resolve(2)
    _report_repeats(context, elements, elements.repeats[elements.repeats < own], "element")
    indices = _join(context, elements, nodes)
    length = _lengths(indices, nodes.values)
    if external is not None:
        at = elements.indices(external.ids)
        length[at] = np.where(np.isnan(external.length), length[at], external.length)
    return MeshElements(elements, indices, length)


def _check_labels(context: Context, table: Table, where: Where) -> None:
    """Report labels of nodes that are not defined."""
    out_of_sight = bool(context.external_definers)
    labels = [(row, column, word) for (row, column), word in table.words.items() if isinstance(word, Label)]
    ends = [(row, column, word) for row, column, word in labels if 0 < column < 3]
    for row, column, word in labels if out_of_sight else ends[: MOST_REPORTED + 1]:
        place = where.inside("elements", row, column)
        if not out_of_sight and context.is_guessed_label(place):
            context.cannot_place(place)
        else:
            context.report_label(REF006, word, place, "NODE", blocks=Blocks.ALWAYS)


def _add_pattern(context: Context, gathered: Definitions, pattern: ElementPattern, where: Where) -> None:
    place = where.inside("generate")
    numbers = context.generator(pattern)
    if numbers is None:
        context.unread.add("ELEMENT")
        return
    master, count, step = numbers
    if gathered.generated > MOST_GENERATED:  # said at the line that went beyond it
        return
    if fault := _pattern_fault(gathered, master, count, step):
        context.report(REF010, fault, place, Severity.ERROR)
        context.doubtful.setdefault("ELEMENT", []).append((master, LARGEST_WHOLE))
        return
    ends = gathered.find(master)
    if ends is None:
        message = (
            f"GEN= repeats an element that exists: element {master} is not defined before this line; define it there"
        )
        context.report_missing(REF005, message, place.inside(0), "ELEMENT", master)
        ends = np.full(2, np.nan)
    steps = np.arange(1, count, dtype=np.int64) * step
    gathered.add(DefinitionBatch(master + steps, ends + steps[:, np.newaxis], place))


def _pattern_fault(gathered: Definitions, master: int, count: int, step: int) -> str:
    if count < 1 or step < 1:
        return f"GEN={master}, {count}, {step}: the number of elements and the increment must be at least 1"
    if count - 1 > MOST_GENERATED - gathered.generated:
        gathered.generated += count - 1
        return f"GEN={master}, {count}, {step} would make {count - 1} elements: {_most('elements')}"
    if abs(master) + (count - 1) * step > LARGEST_WHOLE:
        return (
            f"GEN={master}, {count}, {step}: no element may have the number {master + (count - 1) * step}: correct it"
        )
    return ""


def _join(context: Context, elements: Numbered, nodes: Numbered) -> Indices:
    """Return node indices; each end at an undefined node is reported, a generator's once."""
    indices = np.empty(elements.values.shape, dtype=np.intp)
    missing_ends: list[Indices] = []
    for block in blocks_of(len(elements)):
        values = elements.values[block]
        numbered = np.abs(values) <= 2 * LARGEST_WHOLE
        numbers = np.where(numbered, values, 0).astype(np.int64)
        indices[block] = np.where(numbered, nodes.indices(numbers), -1)
        lacks = numbered & (indices[block] < 0)
        if np.count_nonzero(lacks):
            missing_ends.append(np.argwhere(lacks))
            missing_ends[-1][:, 0] += block.start
    if not missing_ends:
        return indices
    missing = np.concatenate(missing_ends)
    batches = elements.batches_of(elements.rows[missing[:, 0]])
    generators = np.array([not batch.table for batch in elements.batches], dtype=bool)[batches]
    _, firsts = np.unique(np.where(generators, batches, -1 - np.arange(len(missing))), return_index=True)
    for index, end in missing[np.sort(firsts)[: MOST_REPORTED + 1]].tolist():
        where = elements.where(index)
        number = int(elements.values[index, end])
        message = f"element {elements.ids[index]} ends at node {number}, which is not defined: define it"
        generated = not elements.batches[elements.batches_of(int(elements.rows[index]))].table
        place = where if generated else where.inside(end + 1)
        context.report_missing(REF006, message, place, "NODE", number, blocks=Blocks.ALWAYS)
    return indices


def _lengths(ends: Indices, coordinates: Floats) -> Floats:
    """Return distances between the nodes, NaN if one is not known."""
    length = np.full(len(ends), np.nan)
    for block in blocks_of(len(ends)):
        first, last = ends[block].T
        known = ((first >= 0) & (last >= 0)).nonzero()[0]
        points, others = (coordinates.take(end[known], axis=0) for end in (first, last))  # an index takes longer
        length[block][known] = distances(points, others)
    return length


_SMALLEST_SQUARE, _LARGEST_SQUARE = 1e-280, 1e280


def distances(points: Floats, others: Floats) -> Floats:
    """Return the distances (m,) between points (m, 3); infinite only if a float64 cannot hold them."""
    with np.errstate(all="ignore"):
        span = np.subtract(others, points)
        square = np.add.reduce(span**2, axis=1)
        lengths: Floats = np.sqrt(square)
        if np.count_nonzero(odd := (square < _SMALLEST_SQUARE) | (square > _LARGEST_SQUARE)):
            largest = np.abs(span[odd]).max(axis=1, initial=0.0)
            scale = np.where((largest > 0.0) & (largest < np.inf), largest, 1.0)
            lengths[odd] = scale * np.sqrt(((span[odd] / scale[:, None]) ** 2).sum(axis=1))
    return lengths


def _report_repeats(context: Context, numbered: Numbered, repeats: Indices, thing: str) -> None:
    """Report definitions (rows) whose number an earlier one has: each row of a table, a generator once."""
    if not repeats.size:
        return
    batches, begins = np.unique(numbered.batches_of(repeats), return_index=True)
    for index, rows in zip(batches.tolist(), np.split(repeats, begins[1:]), strict=False):
        batch = numbered.batches[index]
        for row in rows[: MOST_REPORTED + 1 if batch.table else 1].tolist():
            where, number = numbered.where_row(row), batch.ids[row - numbered.starts[index]]
            first = numbered.where_row(int(numbered.firsts[numbered.indices(np.array([number]))[0]]))
            same = np.array([number]) if batch.table else batch.ids[rows - numbered.starts[index]]
            message = f"{first_of(thing, same, 'is', 'are')} defined twice: the later definition holds; remove one"
            if first.section == where.section:
                context.note(Problem(REF007, message, where=where, blocks=Blocks.NEVER))
            else:
                message += " (inferred: the $MODEL sections of a file make one model)"
                context.report(REF007, message, where, Severity.WARNING)

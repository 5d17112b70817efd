"""Elements: tables and generators to numbers and node indices."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.codes import REF005, REF006, REF007, REF010
from mudline.diagnostics import Where
from mudline.keywords.table import Table
from mudline.keywords.text import shown
from mudline.scene.context import Context
from mudline.scene.external import ExternalElements
from mudline.scene.numbering import MOST_GENERATED, Batch, Floats, Gathered, Indices, Numbered

if TYPE_CHECKING:
    from mudline.keywords.library.element import ElementGenerate, ElementPattern, ElementRows, Elements


@dataclass(frozen=True, slots=True)
class ElementTable:
    """Elements with the indices of their nodes (m, 2), -1 for a node that is not known, and their lengths (m,)."""

    numbered: Numbered
    nodes: Indices
    length: Floats


def read_elements(context: Context, nodes: Numbered, external: ExternalElements | None = None) -> ElementTable:
    """The elements of the model, then those of a file, which replace them."""
    gathered = Gathered()
    for where, block in context.deck.blocks("ELEMENT"):
        for index, entry in enumerate(cast("Elements", block).entries):
            place = where._replace(path=("entries", index))
            if hasattr(entry, "elements"):
                _table(context, gathered, cast("ElementRows", entry).elements, place)
            else:
                _generate(context, gathered, cast("ElementGenerate", entry).generate, place)
    own = sum(len(batch.ids) for batch in gathered.batches)
    if external is not None:
        gathered.add(Batch(external.ids, external.nodes.astype(np.float64), Where()))
    elements = gathered.settle(2)
    for row in elements.repeats[elements.repeats < own].tolist():
        number = elements.id_of_row(row)
        context.tell(REF007, f"element {number} is defined twice: the later definition holds", elements.where_row(row))
    indices, length = _join(context, elements, nodes)
    if external is not None:
        at = elements.indices(external.ids)
        length[at] = np.where(np.isnan(external.length), length[at], external.length)
    return ElementTable(elements, indices, length)


def _table(context: Context, gathered: Gathered, table: Table, where: Where) -> None:
    numbers = table.column(0)
    ends = np.column_stack([table.column(1), table.column(2)])
    for (row, column), word in table.words.items():
        if column in (1, 2) and word is not None and not context.definers:
            message = f"node {shown(word)} is a label, and nothing in this deck makes labelled nodes"
            place = where._replace(path=(*where.path, "elements", row, column))
            context.tell_missing(REF006, message, place, "NODE")
    known = ~np.isnan(numbers)
    if known.all():
        gathered.add(Batch(numbers.astype(np.int64), ends, where, "elements"))
        return
    for row in np.flatnonzero(known).tolist():
        place = where._replace(path=(*where.path, "elements", row))
        gathered.add(Batch(numbers[row : row + 1].astype(np.int64), ends[row : row + 1], place))


def _generate(context: Context, gathered: Gathered, given: ElementPattern, where: Where) -> None:
    place = where._replace(path=(*where.path, "generate"))
    master, count, step = given.master, given.count, 1 if given.increment is None else given.increment
    if not (isinstance(master, int) and isinstance(count, int) and isinstance(step, int)):
        return
    if count < 1 or step < 1 or count > MOST_GENERATED:
        message = f"GEN={master}, {count}, {step}: count must be 1 to {MOST_GENERATED}, increment at least 1"
        context.tell(REF010, message, place, REF007.severity)
        return
    ends = gathered.find(master)
    if ends is None:
        message = f"GEN= repeats an element that exists: element {master} is not defined before this line"
        context.tell_missing(REF005, message, where._replace(path=(*where.path, "generate", 0)), "ELEMENT")
        ends = np.full(2, np.nan)
    steps = np.arange(1, count, dtype=np.int64) * step
    gathered.add(Batch(master + steps, ends + steps[:, np.newaxis], place))


def _join(context: Context, elements: Numbered, nodes: Numbered) -> tuple[Indices, Floats]:
    """Node indices and lengths; each end that names an undefined node is told, a generator's once."""
    given = ~np.isnan(elements.values)
    numbers = np.where(given, elements.values, 0).astype(np.int64)
    indices = np.where(given, nodes.indices(numbers), -1)
    told: set[Where] = set()
    for index, end in np.argwhere(given & (indices < 0)).tolist():
        where = elements.where(index)
        if where in told:
            continue
        told.add(where)
        message = f"element {elements.ids[index]} ends at node {numbers[index, end]}, which is not defined"
        generated = where.path[-1:] == ("generate",)
        place = where if generated else where._replace(path=(*where.path, end + 1))
        context.tell_missing(REF006, message, place, "NODE")
    length = np.full(len(elements), np.nan)
    known = (indices >= 0).all(axis=1)
    with np.errstate(over="ignore", invalid="ignore"):
        ends = nodes.values[indices[known]]
        length[known] = np.sqrt(((ends[:, 1] - ends[:, 0]) ** 2).sum(axis=1))
    return indices, length

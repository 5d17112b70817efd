"""Nodes: tables and generators to numbers and coordinates."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.codes import REF006, REF007, REF010
from mudline.diagnostics import Where
from mudline.scene.context import Context
from mudline.scene.external import ExternalElements
from mudline.scene.numbering import MOST_GENERATED, Batch, Floats, Gathered, Numbered

if TYPE_CHECKING:
    from mudline.keywords.library.node import NodeGenerate, NodeRange, NodeRows, Nodes


def read_nodes(context: Context, external: ExternalElements | None = None) -> Numbered:
    """The nodes of the model with their coordinates (n, 3); NaN where a coordinate could not be read.

    Nodes that only `external` elements name have no coordinates.
    """
    gathered = Gathered()
    for where, block in context.deck.blocks("NODE"):
        for index, entry in enumerate(cast("Nodes", block).entries):
            place = where._replace(path=("entries", index))
            if hasattr(entry, "nodes"):
                _table(gathered, cast("NodeRows", entry), place)
            else:
                _generate(context, gathered, cast("NodeGenerate", entry).generate, place)
    if external is not None:
        known = gathered.settle(3)
        extra = np.unique(external.nodes)
        extra = extra[known.indices(extra) < 0]
        gathered.add(Batch(extra, np.full((len(extra), 3), np.nan), Where()))
    nodes = gathered.settle(3)
    for row in nodes.repeats.tolist():
        number = nodes.id_of_row(row)
        context.tell(REF007, f"node {number} is defined twice: the later definition holds", nodes.where_row(row))
    return nodes


def _table(gathered: Gathered, entry: NodeRows, where: Where) -> None:
    table = entry.nodes
    numbers = table.column(0)
    values = np.column_stack([table.column(1), table.column(2), table.column(3, default=0.0)])
    known = ~np.isnan(numbers)
    if known.all():
        gathered.add(Batch(numbers.astype(np.int64), values, where, "nodes"))
        return
    for row in np.flatnonzero(known).tolist():  # a row without a number keeps its place in the numbering of rows
        place = where._replace(path=(*where.path, "nodes", row))
        gathered.add(Batch(numbers[row : row + 1].astype(np.int64), values[row : row + 1], place))


def _generate(context: Context, gathered: Gathered, given: NodeRange, where: Where) -> None:
    place = where._replace(path=(*where.path, "generate"))
    start, end, step = given.start, given.end, 1 if given.increment is None else given.increment
    if not (isinstance(start, int) and isinstance(end, int) and isinstance(step, int)):
        return
    if step < 1 or end <= start or (end - start) % step:
        message = f"GEN={start}, {end}, {step} does not lead from node {start} to node {end}"
        context.tell(REF010, message, place, REF007.severity)
        return
    count = (end - start) // step - 1
    if count > MOST_GENERATED:
        message = f"GEN= would make {count} nodes: at most {MOST_GENERATED} are made"
        context.tell(REF010, message, place, REF007.severity)
        return
    first, last = (_known(context, gathered, number, where, at) for at, number in enumerate((start, end)))
    fraction = np.arange(1, count + 1)[:, np.newaxis] / (count + 1)
    values = first + (last - first) * fraction
    numbers = np.arange(start + step, end, step, dtype=np.int64)
    gathered.add(Batch(numbers, values, place))


def _known(context: Context, gathered: Gathered, number: int, where: Where, at: int) -> Floats:
    found = gathered.find(number)
    if found is None:
        message = f"GEN= starts from nodes that exist: node {number} is not defined before this line"
        context.tell_missing(REF006, message, where._replace(path=(*where.path, "generate", at)), "NODE")
        return np.full(3, np.nan)
    return found

"""Nodes: tables and generators to numbers and coordinates."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.codes.references import REF006, REF010
from mudline.diagnostics import Severity, Where
from mudline.scene.context import Context
from mudline.scene.external import ExternalElements
from mudline.scene.numbering import MOST_GENERATED, Batch, Floats, Gathered, Numbered, blocks_of, whole_numbers
from mudline.scene.repeats import tell_repeats

if TYPE_CHECKING:
    from mudline.keywords.library.node import NodeRange, NodeRows, Nodes


@dataclass(frozen=True, slots=True)
class _Line:
    """Nodes between two others, not yet placed."""

    batch: Batch
    ends: tuple[int, int]

    def place(self, first: Floats, last: Floats) -> None:
        """Evenly spaced, exactly so where the spacing is a whole number."""
        count = len(self.batch.ids)
        for block in blocks_of(count):
            steps = np.arange(block.start + 1, block.stop + 1)[:, np.newaxis]
            with np.errstate(over="ignore", invalid="ignore"):
                self.batch.values[block] = first + (last - first) * steps / (count + 1)


def read_nodes(context: Context, external: ExternalElements | None = None) -> Numbered:
    """The nodes of the model with their coordinates (n, 3); NaN where a coordinate is not known.

    Nodes that only `external` elements name have no coordinates.
    """
    gathered = Gathered()
    waiting: list[_Line] = []
    for where, block in context.deck.blocks("NODE"):
        for index, entry in enumerate(cast("Nodes", block).entries):
            place = where._replace(path=("entries", index))
            if hasattr(entry, "nodes"):
                _table(context, gathered, cast("NodeRows", entry), place)
            elif line := _generate(context, gathered, entry.generate, place):
                gathered.add(line.batch)
                if not _between(gathered, line):
                    waiting.append(line)
    for line in waiting:
        _late(context, gathered, line)
    if external is not None:
        known = gathered.settle(3)
        extra = np.unique(external.nodes)
        extra = extra[known.indices(extra) < 0]
        gathered.add(Batch(extra, np.full((len(extra), 3), np.nan), Where()))
    nodes = gathered.settle(3)
    tell_repeats(context, nodes, nodes.repeats, "node")
    return nodes


def _table(context: Context, gathered: Gathered, entry: NodeRows, where: Where) -> None:
    table = entry.nodes
    numbers, known = whole_numbers(table.column(0))
    values = np.column_stack([table.column(1), table.column(2), table.column(3, default=0.0)])
    if known.all():
        gathered.add(Batch(numbers, values, where, "nodes"))
        return
    context.unread.add("NODE")
    rows = np.flatnonzero(known)
    gathered.add(Batch(numbers[rows], values[rows], where, "nodes", rows))


def _generate(context: Context, gathered: Gathered, given: NodeRange, where: Where) -> _Line | None:
    place = where._replace(path=(*where.path, "generate"))
    numbers = context.generator(given, place)
    if numbers is None:
        context.unread.add("NODE")
        return None
    start, end, step = numbers
    count = -1 if step < 1 or end <= start or (end - start) % step else (end - start) // step - 1
    fault = f"GEN={start}, {end}, {step} does not lead from node {start} to node {end}: correct it" if count < 0 else ""
    if count > MOST_GENERATED - gathered.generated:
        fault = (
            f"GEN={start}, {end}, {step} would make {count} nodes: a deck must not generate more than {MOST_GENERATED}"
        )
    if fault:
        context.tell(REF010, fault, place, Severity.ERROR)
        context.doubtful.setdefault("NODE", []).append((min(start, end), max(start, end)))
        return None
    ids = np.arange(start + step, end, step, dtype=np.int64)
    return _Line(Batch(ids, np.full((count, 3), np.nan), place), (start, end))


def _between(gathered: Gathered, line: _Line) -> bool:
    """Place the nodes of a line, if its ends are defined by now."""
    first, last = (gathered.find(number) for number in line.ends)
    if first is None or last is None:
        return False
    line.place(first, last)
    return True


def _late(context: Context, gathered: Gathered, line: _Line) -> None:
    """A line whose ends were not defined before it: they may stand behind it, or nowhere."""
    where = line.batch.where
    if _between(gathered, line):
        first, last = line.ends
        message = (
            f"GEN= places nodes between two that exist, and node {first} or {last} is defined only after this line: "
            "that definition is taken (inferred); put it first"
        )
        context.tell(REF006, message, where, Severity.WARNING)
        return
    for position, number in enumerate(line.ends):
        if gathered.find(number) is None:
            message = f"GEN= places nodes between two that exist: node {number} is not defined; define it in *NODE"
            context.tell_missing(REF006, message, where._replace(path=(*where.path, position)), "NODE", number)

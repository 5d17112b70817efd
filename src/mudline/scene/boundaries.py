"""`*BOUNDARY`: the nodes that it holds, and their degrees of freedom."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, cast

from mudline.codes.fields import SYN003
from mudline.codes.lines import SYN001
from mudline.codes.references import REF006, REF010
from mudline.codes.words import SYN005
from mudline.diagnostics import Severity, Where
from mudline.scene.context import Context
from mudline.scene.named_nodes import NamedNodes
from mudline.scene.numbering import Numbered

if TYPE_CHECKING:
    from mudline.keywords.library.boundary import Boundary, FixedNode, FixedRange, FixedValues

_MOST_FREEDOMS = 6


def check_boundaries(context: Context, nodes: Numbered) -> None:
    """Every line of `*BOUNDARY` against the nodes of the deck and the six degrees of freedom."""
    checker = _Checker(context, nodes)
    for where, block in context.deck.blocks("BOUNDARY", "LOAD CASE"):
        types = cast("Boundary", block).types
        if not types and not context.deck.origin.lost(where.section, where.block):
            message = "*BOUNDARY holds nothing: give TYPE= and nodes below it, or remove it"
            context.tell(SYN001, message, where, Severity.WARNING)
        for i, held in enumerate(types):
            for j, entry in enumerate(held.entries):
                place = where._replace(path=("types", i, "entries", j))
                if hasattr(entry, "generate"):
                    checker.range(cast("FixedRange", entry), place)
                else:
                    checker.node(entry, place)
    checker.named.tell()


class _Checker:
    def __init__(self, context: Context, nodes: Numbered) -> None:
        self.context = context
        self.nodes = nodes
        self.named = NamedNodes(context, nodes)

    def node(self, entry: FixedNode, where: Where) -> None:
        """A node with its degree of freedom."""
        self.named.add(entry.node, where._replace(path=(*where.path, "node")))
        if _is_none(entry.dof):
            self._tell_freedom(entry.dof, where._replace(path=(*where.path, "dof")))

    def range(self, entry: FixedRange, where: Where) -> None:
        """The nodes of a GEN=, and their degree of freedom."""
        place = where._replace(path=(*where.path, "generate"))
        values = cast("FixedValues | None", entry.generate)
        if values is None or self.context.deck.origin.damaged(place) or self.context.without_value(values, place):
            return
        at, step = _parted(values)
        freedom = (values.third, values.fourth)[at - 2]
        if freedom is None:
            message = "this GEN= has no degree of freedom: write start, end [, increment], dof [, displacement]"
            self.context.tell(SYN003, message, place)
        elif _is_none(freedom):
            self._tell_freedom(freedom, place._replace(path=(*place.path, at)))
        start, end = values.start, values.end
        if isinstance(start, int) and isinstance(end, int) and isinstance(step, int):
            self._nodes(start, end, step, place)

    def _tell_freedom(self, given: object, where: Where) -> None:
        message = f"{given} is no degree of freedom: expected 1 (vertical), 2 or 3 (horizontal), or 4 to 6 (rotations)"
        self.context.tell(SYN005, message, where)

    def _nodes(self, start: int, end: int, step: int, where: Where) -> None:
        """The nodes of a range, without building it: it may be as long as a slip of the pen makes it."""
        written = f"GEN= holds the nodes from {start} to {end} in steps of {step}"
        if end < start or step < 1:
            why = "the increment must be at least 1" if step < 1 else "the end must not come before the start"
            self.context.tell(REF010, f"{written}: there are none, {why}", where, Severity.ERROR)
            return
        found = len(self.nodes.between(start, end, step)) if len(self.nodes) else 0
        wanted = (end - start) // step + 1
        if found < wanted and self.named.judged and not self.context.supplier("NODE"):
            message = f"{written}: {wanted - found} of these {wanted} are not defined; correct it, or define them"
            self.context.tell(REF006, message, where, Severity.WARNING if found else None)


def _parted(values: FixedValues) -> tuple[int, object]:
    """Which value of a GEN= is the degree of freedom, counted from 0, and the increment.

    Of four values the third is taken for it only where the fourth cannot be one.
    """
    third, fourth = values.third, values.fourth
    if values.fifth is None and (fourth is None or (third is not None and _is_none(fourth) and not _is_none(third))):
        return 2, 1
    return 3, 1 if third is None else third


def _is_none(freedom: object) -> bool:
    """Whether a value is no degree of freedom; one that could not be read may be one. Equations give 6.0 for 6."""
    known = isinstance(freedom, int | float) and not math.isnan(freedom)
    return known and freedom not in range(1, _MOST_FREEDOMS + 1)

"""Nodes that keywords other than `*ELEMENT` name: whether the deck has them."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from mudline.codes.references import REF006
from mudline.diagnostics import Where
from mudline.keywords.text import shown
from mudline.keywords.values import Label
from mudline.scene.context import MOST_TOLD, Context
from mudline.scene.line_checks import check_label
from mudline.scene.numbering import Numbered


@dataclass(slots=True)
class NamedNodes:
    """Collects what names a node, number or label, and tells which of them the deck lacks."""

    context: Context
    nodes: Numbered
    numbers: list[int] = field(default_factory=list)
    places: list[Where] = field(default_factory=list)

    @property
    def judged(self) -> bool:
        """Whether the deck shows nodes at all: one without any has its model somewhere else."""
        return len(self.nodes) > 0 or "NODE" in self.context.deck.keywords()

    def add(self, node: object, where: Where) -> None:
        """Take note of a node; what is neither a number nor a label could not be read, and is no matter here."""
        if isinstance(node, Label):
            self._label(node, where)
        elif isinstance(node, int):
            self.numbers.append(node)
            self.places.append(where)

    def tell(self) -> None:
        """Tell of the numbers that nothing defines."""
        missing = np.flatnonzero(self.nodes.indices(np.array(self.numbers, dtype=np.int64)) < 0)
        for index in missing[: MOST_TOLD + 1].tolist() if self.judged else ():
            number = self.numbers[index]
            message = f"node {number} is not defined: define it in *NODE, or correct the number"
            self.context.tell_missing(REF006, message, self.places[index], "NODE", number)

    def _label(self, label: Label, where: Where) -> None:
        check_label(self.context, REF006, label, where)
        if self.judged and not self.context.definers and not self.context.doubted(where):
            message = f"node {shown(label)} is a label, and nothing in this deck makes labelled nodes: give a number"
            self.context.tell_missing(REF006, message, where, "NODE")

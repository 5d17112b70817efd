"""`*P-Y` and `*T-Z`: the sets and nodes that soil springs are given to."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from mudline.scene.context import Context
from mudline.scene.named_nodes import NamedNodes
from mudline.scene.numbering import Numbered
from mudline.scene.sets import Sets

if TYPE_CHECKING:
    from mudline.keywords.library.p_y import LateralSoil

_KEYWORDS = ("P-Y", "T-Z")


def check_soil(context: Context, sets: Sets, nodes: Numbered) -> None:
    """Every SET= and NODE= of soil springs against the sets and nodes of the deck."""
    named = NamedNodes(context, nodes)
    for keyword in _KEYWORDS:
        for where, block in context.deck.blocks(keyword):
            for i, springs in enumerate(cast("LateralSoil", block).sets):
                if springs.set_name is not None:
                    sets.find(springs.set_name, where._replace(path=("sets", i, "set")))
                for j, curve in enumerate(springs.curves):
                    named.add(getattr(curve, "node", None), where._replace(path=("sets", i, "curves", j, "node")))
    named.tell()

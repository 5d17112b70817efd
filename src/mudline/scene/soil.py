"""The nodes that soil springs are given to."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from mudline.scene.context import Context
from mudline.scene.named_nodes import NamedNodes
from mudline.scene.numbering import Numbered

if TYPE_CHECKING:
    from mudline.keywords.library.p_y import LateralSoil


def check_soil(context: Context, nodes: Numbered) -> None:
    """Every NODE= of soil springs against the nodes of the deck."""
    named = NamedNodes(context, nodes)
    for where, block in context.deck.blocks_that(lambda declared: declared.facts.soil_springs):
        for i, springs in enumerate(cast("LateralSoil", block).sets):
            for j, curve in enumerate(springs.curves):
                named.add(getattr(curve, "node", None), where._replace(path=("sets", i, "curves", j, "node")))
    named.tell()

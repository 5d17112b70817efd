"""Things that one keyword gives a name and others use: vessels, lines, bodies, vectors."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, cast

from mudline.language.diagnostics import Blocks, Code, Problem, Severity
from mudline.language.keywords.keeping import is_read
from mudline.language.rules import rule
from mudline.model.scene.names import THINGS, undefined

if TYPE_CHECKING:
    from mudline.language.keywords.library.curvilinear import CurvilinearNodes
    from mudline.model.scene.resolved import ResolvedDeck

REF019 = Code("REF019", "undefined-name", Severity.ERROR)


@rule(REF019, blocks=True)
def undefined_name(scene: ResolvedDeck) -> Iterator[Problem]:
    """A vessel, a line, a vector or another thing with a name is used, and the deck does not define it.

    Mostly the name is spelt differently in two places: case is ignored in names, spaces are not. Correct the name, or
    define the thing. It is a warning where a line that was not read, or the deck that *RESTART continues, may define
    it. Sets, curves, nodes and elements have rules of their own. The contact with the seabed does not depend on it.

    Example:
         $MODEL
         *VESSEL
          VESSEL=FPSO
          INITIAL POSITION=1005.0, 0.0, 0.0
         $LOAD CASE
         *OFFSET
        - VESSEL=FSPO
        + VESSEL=FPSO
          OFFSET=0.0, -8.0, 0.0

    Finds: 7:9
    """
    yield from undefined(scene.context, THINGS, REF019)
    yield from _cables(scene)


def _cables(scene: ResolvedDeck) -> Iterator[Problem]:
    """The cables, which have numbers, that nodes lie on."""
    blocks = scene.context.blocks("CABLE")
    cables = {cable.cable for _, block in blocks for cable in block.cables}
    doubt = any(not is_read(block) or scene.deck.lost(where) for where, block in blocks) or scene.context.restart
    for where, block in scene.context.blocks("NODE,CURVILINEAR"):
        for index, entry in enumerate(cast("CurvilinearNodes", block).entries):
            place = where.inside("entries", index)
            if hasattr(entry, "nodes"):
                rows = enumerate(entry.nodes.column(1).tolist())
                used = [(cable, place.inside("nodes", row, 1)) for row, cable in rows]
            else:
                used = [(entry.cable, place.inside("cable"))]
            for cable, at in used:
                if isinstance(cable, int | float) and math.isfinite(cable) and cable not in cables:
                    message = f"cable {cable:g} is not defined: define it in *CABLE, or correct the number"
                    severity = Severity.WARNING if doubt else None
                    yield Problem(REF019, message, None, severity, at, blocks=Blocks.NEVER, lacks=f"{cable:g}")

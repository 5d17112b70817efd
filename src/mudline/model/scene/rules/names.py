"""Things that one keyword gives a name and others use: vessels, lines, bodies, vectors."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from mudline.language.diagnostics import Code, Problem, Severity
from mudline.language.rules import rule
from mudline.model.scene.names import THINGS, undefined

if TYPE_CHECKING:
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
    return undefined(scene.context, THINGS, REF019)

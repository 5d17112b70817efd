"""The elastic seabed that extension keywords need."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from mudline.diagnostics import Code, Problem, Severity
from mudline.scene.checks.declaring import check

if TYPE_CHECKING:
    from mudline.scene.model import Scene

EXT001 = Code("EXT001", "extension-needs-elastic", Severity.ERROR)


@check(EXT001)
def extension_needs_elastic(scene: Scene) -> Iterator[Problem]:
    """An extension keyword stands in a model without an elastic seabed.

    The laws of the extensions act on penetration, and nothing penetrates a rigid seabed or none at all. Write
    *SEABED PROPERTIES with TYPE=ELASTIC, or remove the keyword.

    Example:
         $MODEL
         *SEABED PROPERTIES
        - TYPE=RIGID
        + TYPE=ELASTIC
          SET=ALL
        + STIFFNESS=50000.0
          FRICTION=0.3, 0.6
         *SEABED SUCTION
          SET=ALL
          COHESION=5000.0

    Finds: 6:1
    """
    reading, types = scene.context, scene.laws.types
    unclear = "SEABED PROPERTIES" in scene.deck.keywords() or reading.astray("SEABED PROPERTIES")
    if "ELASTIC" in types or (unclear and "RIGID" not in types):
        return
    supplier = "" if "RIGID" in types else reading.supplier("ELASTIC SURFACE")
    what = "the seabed is rigid" if "RIGID" in types else "the model has none"
    for where, block in scene.deck.blocks_that(lambda declared: declared.facts.extension):
        message = f"*{block.keyword} needs an elastic seabed, and {what}: write *SEABED PROPERTIES with TYPE=ELASTIC"
        if supplier:
            yield Problem(EXT001, f"{message}; {supplier}", None, Severity.WARNING, where)
        else:
            yield Problem(EXT001, message, where=where)

"""`*SEABED UNLOADING` against smoothing and nodal stiffness."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from mudline.contact.input import LawKind
from mudline.diagnostics import Code, Problem, Severity
from mudline.scene.checks.declaring import check
from mudline.scene.given import number
from mudline.scene.numbering import Mask

if TYPE_CHECKING:
    from mudline.scene.model import Scene

EXT009 = Code("EXT009", "unloading-conflict", Severity.ERROR)

_KEYWORD = "SEABED UNLOADING"


@check(EXT009)
def unloading_conflict(scene: Scene) -> Iterator[Problem]:
    """Unloading stands together with smoothing or a nodal stiffness, or its stiffness is not above 0.

    Smoothing and unloading both change the reaction near the seabed, and there is no law for the two together.
    *SEABED CONTACT smooths a linear law unless it says SMOOTHING=NONE. Write that, or remove the unloading; a stiffness
    divides and must be above 0. SMOOTHING=AUTO smooths nothing where the submerged weight is not known, or is not above
    0. NODAL STIFFNESS= replaces the law per unit length that would be unloaded.

    Example:
         $MODEL
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=50000.0
         *SEABED UNLOADING
          SET=ALL
        - STIFFNESS=0.0
        + STIFFNESS=500000.0

    Finds: 8:12
    """
    extension = scene.extensions.get(_KEYWORD)
    if extension is None:
        return
    smooth, nodal = _smoothed(scene), scene.law == LawKind.NODAL
    for index, (entry, where) in enumerate(zip(extension.entries, extension.places, strict=True)):
        stiffness, named = number(entry, "stiffness"), extension.of_element == index
        if stiffness <= 0.0:
            message = f"unloading stiffness {stiffness!r}: it must be above 0"
            yield Problem(EXT009, message, where=where._replace(path=(*where.path, "stiffness")))
        place = where._replace(path=(*where.path, "set"))
        both = np.flatnonzero(named & smooth)
        if both.size:
            message = (
                f"{both.size} elements (first: {scene.element_ids[both[0]]}) have smoothing too: "
                "write SMOOTHING=NONE in *SEABED CONTACT, or remove the unloading"
            )
            yield Problem(EXT009, message, where=place)
        at_nodes = np.flatnonzero(named & nodal)
        if at_nodes.size:
            message = (
                f"{at_nodes.size} elements (first: {scene.element_ids[at_nodes[0]]}) have NODAL STIFFNESS=, which does "
                "not unload along a line of its own: remove one of the two"
            )
            yield Problem(EXT009, message, where=place)


def _smoothed(scene: Scene) -> Mask:
    """Elements (m,) with a linear law that is smoothed."""
    found: Mask = np.zeros(len(scene.element_ids), dtype=np.bool_)
    if "SEABED CONTACT" in scene.extensions:
        from mudline.scene.contact_parts.smoothing import element_smoothing  # noqa: PLC0415 - only now is it needed

        found[element_smoothing(scene).rows] = True
    return found

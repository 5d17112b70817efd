"""`*SEABED UNLOADING`: the stiffness of elements on reversal."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mudline.contact.input import LawAssignment, LawKind
from mudline.scene.contact_parts.picking import picked, refuse, refuse_entry
from mudline.scene.given import number
from mudline.scene.numbering import Floats, Mask

if TYPE_CHECKING:
    from mudline.scene.extensions import Extension
    from mudline.scene.model import Scene

KEYWORD = "SEABED UNLOADING"


def unloading_lines(scene: Scene, smoothed: Mask) -> LawAssignment:
    """The elements on a curve or a linear law that unload on a line of their own.

    Raises RefusedError: a stiffness that is not above 0, or an element whose law is `smoothed` (m,) or nodal.
    """
    extension = scene.extensions[KEYWORD]
    for entry, where in zip(extension.entries, extension.places, strict=True):
        if not number(entry, "stiffness") > 0.0:
            refuse_entry(where, "stiffness", "the unloading stiffness is not above 0")
    named = extension.of_element >= 0
    nodal = named & (scene.law == LawKind.NODAL)
    refuse(extension, nodal, scene.element_ids, "a nodal stiffness has no unloading line: remove one of them")
    held = named & np.isin(scene.law, (LawKind.CURVE, LawKind.LINEAR))
    refuse(extension, held & smoothed, scene.element_ids, "there is smoothing too where the reaction unloads")
    rows = np.flatnonzero(held)
    return LawAssignment("unloading", rows, {"stiffness": given_stiffness(extension)[rows]})


def given_stiffness(extension: Extension) -> Floats:
    """The stiffness of the block that each element (m,) follows, NaN without one."""
    return picked((number(entry, "stiffness") for entry in extension.entries), extension.of_element)
